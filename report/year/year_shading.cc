// SPDX-License-Identifier: GPL-3.0-or-later
// The table that EnergyPlus writes (eplusshading.csv) and imports (Schedule:File:Shading): "Surface
// Name" and the names, then a row a step with the time of its end. Reference: EnergyPlus,
// Input Output Reference, "Schedule:File:Shading".
#include <fmt/format.h>

#include <utility>

#include "report/text/csv_field.h"
#include "report/year/year_writer.h"
#include "scene/base/output_file.h"

namespace gnomon::report {

namespace {

class YearShading final : public YearWriter {
 public:
  YearShading(OutputFile output, const YearHead& head) : output_(std::move(output)) {
    for (std::size_t i = 0; i < head.sides.size(); ++i) {
      if (!head.sides[i].ends_with("#back") && !head.sides[i].ends_with("#gross"))
        columns_.push_back(i);
    }
  }
  Expected<void> begin(const YearHead& head) {
    std::string text = "Surface Name";
    for (const std::size_t column : columns_) {
      text += ',';
      append_csv_field(text, head.sides[column]);
    }
    return output_.write(text + "\n");
  }
  Expected<void> add(const suns::SunTime& sun, std::span<const double> lit) override {
    row_ = suns::end_of_step_text(sun.end);
    for (const std::size_t column : columns_) {
      fmt::format_to(std::back_inserter(row_), ",{:.8f}", lit[column]);
    }
    row_ += '\n';
    return output_.write(row_);
  }
  Expected<void> finish(const std::string&) override { return output_.commit(); }

 private:
  OutputFile output_;
  std::vector<std::size_t> columns_;
  std::string row_;
};

}  // namespace

Expected<std::unique_ptr<YearWriter>> open_shading_table(const std::filesystem::path& file,
                                                         const YearHead& head) {
  auto output = OutputFile::open(file);
  if (!output) return tl::unexpected(std::move(output.error()));
  auto writer = std::make_unique<YearShading>(std::move(*output), head);
  if (auto begun = writer->begin(head); !begun) return tl::unexpected(std::move(begun.error()));
  return writer;
}

}  // namespace gnomon::report
