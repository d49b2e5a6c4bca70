// SPDX-License-Identifier: GPL-3.0-or-later
// Years as NumPy arrays: doubles by row and side, and FILE.npy.json with the names of both.
#include <fmt/format.h>

#include <array>
#include <utility>

#include "report/json/json_writer.h"
#include "report/text/npy.h"
#include "report/text/text_sink.h"
#include "report/year/year_writer.h"
#include "scene/base/output_file.h"

namespace gnomon::report {

namespace {

class YearNpy final : public YearWriter {
 public:
  YearNpy(std::filesystem::path file, OutputFile output, const YearHead& head)
      : file_(std::move(file)), output_(std::move(output)), head_(&head) {}

  Expected<void> begin() { return output_.write(head_of(head_->rows)); }
  Expected<void> add(const suns::SunTime& sun, std::span<const double> lit) override {
    row_.resize(lit.size() * sizeof(double));
    char* at = row_.data();
    for (const double share : lit) at = put_double(at, share);
    suns_.push_back(sun);
    return output_.write(row_);
  }
  Expected<void> finish(const std::string& checksum) override {
    if (suns_.size() < head_->rows) {
      if (auto done = output_.write_over_start(head_of(suns_.size())); !done) return done;
    }
    if (auto done = output_.commit(); !done) return done;
    return write_file(file_.string() + ".json", names(checksum));
  }

 private:
  std::string head_of(std::size_t rows) const {
    return npy_head(std::array{rows, head_->sides.size()});
  }
  std::string names(const std::string& checksum) const;

  std::filesystem::path file_;
  OutputFile output_;
  const YearHead* head_;
  std::vector<suns::SunTime> suns_;  // of the rows so far
  std::string row_;
};

std::string YearNpy::names(const std::string& checksum) const {
  StringSink sink;
  JsonWriter json(sink);
  json.begin_object();
  json.member("format", "gnomon-year");
  json.member("version", 1);
  json.member("table", file_.filename().string());
  json.member("scene", head_->scene);
  json.member("geometry", head_->geometry);
  json.member("kernel", head_->kernel);
  json.member("sun_model", suns::name_of(head_->suns.model));
  json.member("checksum", checksum);
  json.key("times");
  json.begin_array();
  for (const suns::SunTime& sun : suns_) {
    json.value(suns::iso_text(sun.at, head_->suns.place.zone));
  }
  json.end_array();
  json.key("suns");
  json.begin_array();
  for (const suns::SunTime& sun : suns_) {
    json.begin_array();
    for (const std::int32_t millionths : sun.direction) json.value(1e-6 * millionths);
    json.end_array();
  }
  json.end_array();
  json.key("sides");
  json.begin_array();
  for (const std::string& side : head_->sides) json.value(std::string_view(side));
  json.end_array();
  json.end_object();
  json.finish();
  return sink.text();
}

}  // namespace

Expected<std::unique_ptr<YearWriter>> open_year_npy(const std::filesystem::path& file,
                                                    const YearHead& head) {
  auto output = OutputFile::open(file);
  if (!output) return tl::unexpected(std::move(output.error()));
  auto writer = std::make_unique<YearNpy>(file, std::move(*output), head);
  if (auto begun = writer->begin(); !begun) return tl::unexpected(std::move(begun.error()));
  return writer;
}

}  // namespace gnomon::report
