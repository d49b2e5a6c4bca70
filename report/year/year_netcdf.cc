// SPDX-License-Identifier: GPL-3.0-or-later
// Years as netCDF-4, by the CF conventions, compressed: dimensions side and time; lit(side, time),
// in single precision, the times, and where the sun stood. Written beside its place and moved there
// when it is whole.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <system_error>
#include <utility>

#include "report/year/netcdf_library.h"
#include "report/year/year_writer.h"

namespace gnomon::report {

namespace {

class YearNetcdf final : public YearWriter {
 public:
  YearNetcdf(const NetcdfLibrary& netcdf, std::filesystem::path file, const YearHead& head)
      : netcdf_(netcdf),
        file_(std::move(file)),
        temporary_(file_.string() + ".part"),
        head_(&head) {}
  YearNetcdf(const YearNetcdf&) = delete;
  YearNetcdf& operator=(const YearNetcdf&) = delete;
  ~YearNetcdf() override {
    if (is_open_) netcdf_.abort(id_);
    std::error_code ignored;
    std::filesystem::remove(temporary_, ignored);
  }

  Expected<void> begin();
  Expected<void> add(const suns::SunTime& sun, std::span<const double> lit) override;
  Expected<void> finish(const std::string& checksum) override;

 private:
  /// The first failure of a call of the library is kept.
  void call(int status) {
    if (status_ == NC_NOERR) status_ = status;
  }
  Expected<void> done() const {
    if (status_ == NC_NOERR) return {};
    return fail(ErrorCode::kFile,
                file_.string() + " cannot be written: " + netcdf_.strerror(status_));
  }
  void text(int variable, const char* name, std::string_view value) {
    call(netcdf_.put_att_text(id_, variable, name, value.size(), value.data()));
  }
  int number(const char* name, const char* long_name, const char* units);
  void define_lit();
  void flush();

  // Rows are handed over so many at a time, which is also how they lie in the file.
  static constexpr std::size_t kRowsOfChunk = 256, kSidesOfChunk = 256;
  static constexpr std::size_t kTimesOfChunk = 1024;  // of variables by time alone
  static constexpr int kDeflate = 5;

  NetcdfLibrary netcdf_;
  std::filesystem::path file_, temporary_;
  const YearHead* head_;
  bool is_open_ = false;
  int id_ = 0, status_ = NC_NOERR;
  int time_dimension_ = 0, side_dimension_ = 0;
  int time_ = 0, lit_ = 0, azimuth_ = 0, altitude_ = 0;
  std::array<int, 3> sun_{};
  std::size_t rows_ = 0;  // in the file
  std::vector<double> times_, azimuths_, altitudes_;
  std::vector<float> lits_;  // by side, then by row of the chunk
  std::array<std::vector<double>, 3> suns_;
};

/// A variable by time.
int YearNetcdf::number(const char* name, const char* long_name, const char* units) {
  int variable = 0;
  call(netcdf_.def_var(id_, name, NC_DOUBLE, 1, &time_dimension_, &variable));
  call(netcdf_.def_var_chunking(id_, variable, NC_CHUNKED, &kTimesOfChunk));
  text(variable, "long_name", long_name);
  text(variable, "units", units);
  return variable;
}

void YearNetcdf::define_lit() {
  // The hours of one side follow each other, since they are alike: half the size of the other way.
  const std::array<int, 2> dimensions{side_dimension_, time_dimension_};
  call(netcdf_.def_var(id_, "lit", NC_FLOAT, 2, dimensions.data(), &lit_));
  const std::array<std::size_t, 2> chunk{
      std::max<std::size_t>(1, std::min(kSidesOfChunk, head_->sides.size())), kRowsOfChunk};
  call(netcdf_.def_var_chunking(id_, lit_, NC_CHUNKED, chunk.data()));
  if (head_->digits < YearHead::kAllDigits) {
    const int bits = static_cast<int>(std::ceil(head_->digits * std::log2(10.0)));
    call(netcdf_.def_var_quantize(id_, lit_, NC_QUANTIZE_BITROUND, bits));
  }
  call(netcdf_.def_var_deflate(id_, lit_, 0, 1, kDeflate));
  text(lit_, "long_name", "lit share of the side's area; 0 at night and where it faces away");
  text(lit_, "units", "1");
}

Expected<void> YearNetcdf::begin() {
  call(netcdf_.create(temporary_.c_str(), NC_NETCDF4 | NC_CLOBBER, &id_));
  if (auto created = done(); !created) return created;
  is_open_ = true;
  call(netcdf_.def_dim(id_, "time", NC_UNLIMITED, &time_dimension_));
  call(netcdf_.def_dim(id_, "side", head_->sides.size(), &side_dimension_));
  const suns::Place& place = head_->suns.place;
  // Times are counted in UTC, which readers take for granted.
  time_ =
      number("time", "time at which the sun was looked at", "seconds since 1970-01-01 00:00:00");
  text(time_, "standard_name", "time");
  text(time_, "calendar", "proleptic_gregorian");
  int side = 0;
  call(netcdf_.def_var(id_, "side", NC_STRING, 1, &side_dimension_, &side));
  azimuth_ = number("sun_azimuth", "from north, clockwise", "degree");
  altitude_ = number("sun_altitude", "over the horizon", "degree");
  sun_ = {number("sun_x", "direction to the sun, as the scene has it, exactly", "1"),
          number("sun_y", "direction to the sun, as the scene has it, exactly", "1"),
          number("sun_z", "direction to the sun, as the scene has it, exactly", "1")};
  define_lit();
  text(NC_GLOBAL, "Conventions", "CF-1.8");
  text(NC_GLOBAL, "source", "gnomon year");
  text(NC_GLOBAL, "scene", head_->scene);
  text(NC_GLOBAL, "geometry", head_->geometry);
  text(NC_GLOBAL, "kernel", head_->kernel);
  text(NC_GLOBAL, "sun_model", suns::name_of(head_->suns.model));
  call(netcdf_.put_att_double(id_, NC_GLOBAL, "latitude", NC_DOUBLE, 1, &place.latitude));
  call(netcdf_.put_att_double(id_, NC_GLOBAL, "longitude", NC_DOUBLE, 1, &place.longitude));
  const double zone = static_cast<double>(place.zone.count()) / 60;
  call(netcdf_.put_att_double(id_, NC_GLOBAL, "time_zone", NC_DOUBLE, 1, &zone));
  call(netcdf_.enddef(id_));
  std::vector<const char*> names;
  for (const std::string& name : head_->sides) names.push_back(name.c_str());
  call(netcdf_.put_var_string(id_, side, names.data()));
  return done();
}

Expected<void> YearNetcdf::add(const suns::SunTime& sun, std::span<const double> lit) {
  const auto utc = sun.at.time_since_epoch() - head_->suns.place.zone;
  times_.push_back(static_cast<double>(std::chrono::seconds(utc).count()));
  azimuths_.push_back(sun.angles.azimuth);
  altitudes_.push_back(sun.angles.altitude);
  for (std::size_t k = 0; k < 3; ++k) suns_[k].push_back(1e-6 * sun.direction[k]);
  if (lits_.empty()) lits_.resize(kRowsOfChunk * lit.size());
  for (std::size_t side = 0; side < lit.size(); ++side) {
    lits_[side * kRowsOfChunk + times_.size() - 1] = static_cast<float>(lit[side]);
  }
  if (times_.size() == kRowsOfChunk) flush();
  return done();
}

void YearNetcdf::flush() {
  const std::size_t count = times_.size();
  if (count == 0) return;
  const auto put = [&](int variable, std::vector<double>& values) {
    call(netcdf_.put_vara_double(id_, variable, &rows_, &count, values.data()));
    values.clear();
  };
  put(azimuth_, azimuths_);
  put(altitude_, altitudes_);
  for (std::size_t k = 0; k < 3; ++k) put(sun_[k], suns_[k]);
  const std::array<std::size_t, 2> start{0, rows_}, counts{head_->sides.size(), count};
  if (count < kRowsOfChunk) {  // the last rows: without the gaps of those that did not come
    for (std::size_t side = 1; side < head_->sides.size(); ++side) {
      std::copy_n(lits_.begin() + static_cast<std::ptrdiff_t>(side * kRowsOfChunk), count,
                  lits_.begin() + static_cast<std::ptrdiff_t>(side * count));
    }
  }
  call(netcdf_.put_vara_float(id_, lit_, start.data(), counts.data(), lits_.data()));
  put(time_, times_);
  rows_ += count;
}

Expected<void> YearNetcdf::finish(const std::string& checksum) {
  flush();
  call(netcdf_.redef(id_));
  text(NC_GLOBAL, "checksum", checksum);
  is_open_ = false;
  call(netcdf_.close(id_));
  if (auto closed = done(); !closed) return closed;
  std::error_code error;
  std::filesystem::rename(temporary_, file_, error);
  if (error) return fail(ErrorCode::kFile, file_.string() + ": " + error.message());
  return {};
}

}  // namespace

Expected<std::unique_ptr<YearWriter>> open_year_netcdf(const std::filesystem::path& file,
                                                       const YearHead& head) {
  const auto netcdf = NetcdfLibrary::load();
  if (!netcdf) return tl::unexpected(netcdf.error());
  auto writer = std::make_unique<YearNetcdf>(*netcdf, file, head);
  if (auto begun = writer->begin(); !begun) return tl::unexpected(std::move(begun.error()));
  return writer;
}

}  // namespace gnomon::report
