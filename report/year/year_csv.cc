// SPDX-License-Identifier: GPL-3.0-or-later
// Years as CSV: the time as ISO 8601 with its zone, the sun's direction, and a column a side.
#include <fmt/format.h>

#include <utility>

#include "report/text/csv_field.h"
#include "report/text/number_text.h"
#include "report/year/year_writer.h"
#include "scene/base/output_file.h"

namespace gnomon::report {

namespace {

class YearCsv final : public YearWriter {
 public:
  YearCsv(OutputFile output, const YearHead& head) : output_(std::move(output)), head_(&head) {}

  Expected<void> begin() {
    std::string text = "time,sun_x,sun_y,sun_z";
    for (const std::string& side : head_->sides) {
      text += ',';
      append_csv_field(text, side);
    }
    return output_.write(text + "\n");
  }
  Expected<void> add(const suns::SunTime& sun, std::span<const double> lit) override {
    row_ = suns::iso_text(sun.at, head_->suns.place.zone);
    for (const std::int32_t millionths : sun.direction) {
      fmt::format_to(std::back_inserter(row_), ",{:.6f}", 1e-6 * millionths);
    }
    const std::size_t used = row_.size();
    row_.resize(used + lit.size() * (kLongestShortest + 1) + 1);
    char* at = row_.data() + used;
    for (const double share : lit) {
      *at++ = ',';
      at = write_shortest(at, share);
    }
    *at++ = '\n';
    row_.resize(static_cast<std::size_t>(at - row_.data()));
    return output_.write(row_);
  }
  Expected<void> finish(const std::string&) override { return output_.commit(); }

 private:
  OutputFile output_;
  const YearHead* head_;
  std::string row_;
};

}  // namespace

Expected<std::unique_ptr<YearWriter>> open_year_csv(const std::filesystem::path& file,
                                                    const YearHead& head) {
  auto output = OutputFile::open(file);
  if (!output) return tl::unexpected(std::move(output.error()));
  auto writer = std::make_unique<YearCsv>(std::move(*output), head);
  if (auto begun = writer->begin(); !begun) return tl::unexpected(std::move(begun.error()));
  return writer;
}

Expected<std::unique_ptr<YearWriter>> open_year_table(const std::filesystem::path& file,
                                                      const YearHead& head) {
  if (file == "-" || file.extension() == ".csv") return open_year_csv(file, head);
  if (file.extension() == ".npy") return open_year_npy(file, head);
  if (file.extension() == ".nc") return open_year_netcdf(file, head);
  return fail(ErrorCode::kUsage, file.string() + ": its ending names no format of years",
              "FILE.csv, FILE.npy or FILE.nc");
}

}  // namespace gnomon::report
