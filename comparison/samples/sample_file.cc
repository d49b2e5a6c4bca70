// SPDX-License-Identifier: GPL-3.0-or-later
#include "comparison/samples/sample_file.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/base/ascii_case.h"
#include "scene/base/text_file.h"

namespace gnomon::comparison {

namespace {

constexpr const char* kHead = "light,x,y,z,visible or light,x,y,z,visible,polygon";

/// The first few ids, as examples of what was expected.
template <class Entry>
std::string ids_of(const std::vector<Entry>& entries) {
  constexpr std::size_t kExamples = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(entries.size(), kExamples); ++i) {
    text += (i == 0 ? "" : ", ") + quoted_text(entries[i].id);
  }
  return text + (entries.size() > kExamples ? ", ..." : "");
}

}  // namespace

const std::array<std::string_view, SampleFile::kColumns>& SampleFile::names() {
  static constexpr std::array<std::string_view, kColumns> kNames{"light", "x",       "y",
                                                                 "z",     "visible", "polygon"};
  return kNames;
}

bool is_sample_file(const std::filesystem::path& file) {
  std::error_code failed;
  if (file == "-" || !std::filesystem::is_regular_file(file, failed)) return false;
  auto csv = CsvReader::open(file);
  if (!csv) return false;
  csv->skip_comments();
  const auto head = csv->next();
  if (!head || !*head) return false;
  const auto has = [&](std::string_view name) {
    return std::ranges::any_of(csv->fields(),
                               [&](const CsvField& field) { return same_word(field.text, name); });
  };
  return has("light") && has("visible") && has("x") && has("y");
}

SampleFile::SampleFile(CsvReader csv, const Scene& scene, const PreparedScene& prepared)
    : csv_(std::move(csv)), scene_(&scene), prepared_(&prepared) {
  for (std::uint32_t i = 0; i < scene.lights.size(); ++i) lights_.emplace(scene.lights[i].id, i);
  for (std::uint32_t i = 0; i < scene.polygons.size(); ++i) {
    polygons_.emplace(scene.polygons[i].id, i);
  }
}

Expected<SampleFile> SampleFile::open(const std::filesystem::path& path, const Scene& scene,
                                      const PreparedScene& prepared) {
  auto csv = CsvReader::open(path);
  if (!csv) return tl::unexpected(std::move(csv.error()));
  SampleFile file(*std::move(csv), scene, prepared);
  file.csv_.skip_comments();
  if (auto done = file.read_head(); !done) return tl::unexpected(std::move(done.error()));
  return file;
}

Expected<void> SampleFile::rewind() {
  if (auto done = csv_.rewind(); !done) return done;
  const auto head = csv_.next();
  return head ? Expected<void>() : tl::unexpected(head.error());
}

Expected<void> SampleFile::read_head() {
  auto more = csv_.next();
  if (!more) return tl::unexpected(std::move(more.error()));
  if (!*more)
    return csv_.wrong(ErrorCode::kFormat, 0, "an empty file", std::string("a first line ") + kHead);
  columns_ = csv_.fields().size();
  // A comma at the end of a line begins no column.
  while (columns_ > 0 && csv_.fields()[columns_ - 1].text.empty()) --columns_;
  for (std::size_t i = 0; i < columns_; ++i) {
    const std::string_view text = csv_.fields()[i].text;
    const auto name = std::ranges::find_if(
        names(), [&](std::string_view known) { return same_word(text, known); });
    if (name == names().end()) {
      passed_over_.emplace_back(text);
      continue;
    }
    auto& column = column_[static_cast<std::size_t>(name - names().begin())];
    if (column) {
      return csv_.wrong(ErrorCode::kFormat, i, quoted_text(text) + " stands twice",
                        "each column once");
    }
    column = i;
  }
  for (std::size_t column = 0; column < kPolygon; ++column) {
    if (column_[column]) continue;
    return csv_.wrong(ErrorCode::kFormat, columns_,
                      "no column " + quoted_text(names()[column]) + " in the first line", kHead);
  }
  return {};
}

Expected<bool> SampleFile::next(SampleRow& row) {
  auto more = csv_.next();
  if (!more || !*more) return more;
  row = {};
  row.line = csv_.line();
  if (auto done = check_length(); !done) return tl::unexpected(std::move(done.error()));
  for (const auto read : {&SampleFile::read_light, &SampleFile::read_point,
                          &SampleFile::read_visible, &SampleFile::read_polygon}) {
    if (auto done = (this->*read)(row); !done) return tl::unexpected(std::move(done.error()));
  }
  return true;
}

tl::unexpected<Error> SampleFile::wrong_at_end(std::string what, std::string expected) const {
  return csv_.wrong(ErrorCode::kFormat, csv_.fields().size(), std::move(what), std::move(expected));
}

tl::unexpected<Error> SampleFile::wrong(ErrorCode code, Column column, std::string what,
                                        std::string expected) const {
  return csv_.wrong(code, *column_[column], std::move(what), std::move(expected));
}

Expected<void> SampleFile::check_length() const {
  std::size_t end = csv_.fields().size();
  while (end > columns_ && csv_.fields()[end - 1].text.empty()) --end;
  if (end == columns_) return {};
  return csv_.wrong(ErrorCode::kFormat, std::min(end, columns_),
                    std::to_string(end) + " fields in a row",
                    std::to_string(columns_) + ", as in the first line");
}

Expected<void> SampleFile::read_light(SampleRow& row) const {
  const std::string_view text = text_of(kLight);
  const auto light = lights_.find(text);
  if (light == lights_.end()) {
    return wrong(ErrorCode::kId, kLight, quoted_text(text) + " is no light of the scene",
                 "the id of one, such as " + ids_of(scene_->lights));
  }
  row.sample.light = light->second;
  return {};
}

Expected<void> SampleFile::read_point(SampleRow& row) const {
  constexpr std::array kAxes{kX, kY, kZ};
  for (std::size_t k = 0; k < kAxes.size(); ++k) {
    const std::string_view text = text_of(kAxes[k]);
    const auto number = Number::parse(text, scene_->numbers);
    if (!number) {
      return wrong(number.error().code, kAxes[k],
                   text.empty() ? "an empty field" : number.error().what,
                   "a coordinate, scene units");
    }
    row.sample.point[k] = number->exact();
  }
  return {};
}

Expected<void> SampleFile::read_visible(SampleRow& row) const {
  const std::string_view text = text_of(kVisible);
  const auto number = parse_written(text);
  if (!number) {
    return wrong(ErrorCode::kNumber, kVisible,
                 text.empty() ? "an empty field" : quoted_text(text) + " is no number",
                 "0, 1, or the share of the light that is visible");
  }
  row.visible = *number;
  if (!std::isfinite(number->value)) return {};
  const auto exact = Number::parse(text, NumberMeaning::kDecimal);
  row.sample.visible = exact ? exact->exact() : mpq_class(number->value);
  return {};
}

Expected<void> SampleFile::read_polygon(SampleRow& row) const {
  if (prepared_->parts.empty()) {
    return wrong(ErrorCode::kFormat, kLight, "a sample of a scene without polygons", "a polygon");
  }
  if (!column_[kPolygon] || text_of(kPolygon).empty()) return {};
  const std::string_view text = text_of(kPolygon);
  const std::size_t mark = text.find('#');
  const auto polygon = polygons_.find(text.substr(0, mark));
  const std::string_view side = mark == std::string_view::npos ? "" : text.substr(mark);
  if (polygon == polygons_.end() || !(side.empty() || side == "#front" || side == "#back")) {
    return wrong(ErrorCode::kId, kPolygon, quoted_text(text) + " is no polygon of the scene",
                 "the id of one, such as " + ids_of(scene_->polygons));
  }
  const std::uint32_t index = polygon->second;
  if (side == "#back" && !scene_->is_two_sided(scene_->polygons[index])) {
    return wrong(ErrorCode::kId, kPolygon, quoted_text(text) + ": the polygon has one side",
                 quoted_text(scene_->polygons[index].id));
  }
  if (prepared_->first_part[index] == prepared_->first_part[index + 1]) {
    return wrong(ErrorCode::kId, kPolygon, quoted_text(text) + " has no area, and so no samples",
                 "a polygon that was not dropped");
  }
  row.sample.polygon = index;
  if (!side.empty()) row.sample.side = side == "#back" ? Side::kBack : Side::kFront;
  return {};
}

}  // namespace gnomon::comparison
