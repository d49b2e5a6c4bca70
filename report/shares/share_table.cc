// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/shares/share_table.h"

#include <algorithm>

#include "gnomon/algorithms/method.h"
#include "report/json/json_writer.h"
#include "report/text/csv_field.h"
#include "report/text/npy.h"
#include "report/text/number_text.h"

namespace gnomon::report {

std::optional<ShareFormat> share_format(const std::filesystem::path& file) {
  if (file.extension() == ".csv") return ShareFormat::kCsv;
  if (file.extension() == ".npy") return ShareFormat::kNpy;
  return std::nullopt;
}

ShareTable::ShareTable(const Scene& scene, const PreparedScene& prepared,
                       std::span<const std::uint32_t> lights, ShareFormat format)
    : scene_(scene), prepared_(prepared), format_(format), columns_(scene, prepared) {
  const bool any_area = std::ranges::any_of(
      lights, [&](std::uint32_t light) { return prepared.lights[light].has_area(); });
  classes_ = any_area ? std::vector<std::string_view>{"lit", "penumbra", "umbra"}
                      : std::vector<std::string_view>{"lit"};
  values_.resize(classes_.size() * columns_.size());
}

const std::string& ShareTable::light_id(std::uint32_t light) const {
  return scene_.lights[prepared_.lights[light].light].id;
}

std::string ShareTable::head(std::size_t lights) const {
  return format_ == ShareFormat::kCsv ? csv_head() : npy_head(lights);
}

std::string ShareTable::csv_head() const {
  std::string text = "light";
  if (classes_.size() > 1) text += ",class";
  for (const std::string& name : columns_.names()) {
    text += ',';
    append_csv_field(text, name);
  }
  return text + "\n";
}

std::string ShareTable::npy_head(std::size_t lights) const {
  std::vector<std::size_t> shape{lights, columns_.size()};
  if (classes_.size() > 1) shape.push_back(classes_.size());
  return report::npy_head(shape);
}

std::string_view ShareTable::row(const LightResult& light) {
  read(light);
  lights_.push_back(light_id(light.light));
  const std::string_view method = method_info(light.method).name;
  if (!std::ranges::count(methods_, method)) methods_.push_back(method);
  row_.clear();
  if (format_ == ShareFormat::kCsv) {
    append_csv(light.light);
  } else {
    append_npy();
  }
  return row_;
}

void ShareTable::read(const LightResult& light) {
  const std::size_t columns = columns_.size();
  const bool area = prepared_.lights[light.light].has_area();
  for (std::size_t i = 0; i < columns; ++i) {
    const Shares shares = columns_.shares(light, i);
    values_[i] = shares.lit.middle();
    if (classes_.size() == 1) continue;
    values_[columns + i] = shares.penumbra.middle();
    values_[2 * columns + i] = (area ? shares.umbra : shares.shadow).middle();
  }
}

void ShareTable::append_csv(std::uint32_t light) {
  const std::size_t columns = columns_.size();
  for (std::size_t k = 0; k < classes_.size(); ++k) {
    append_csv_field(row_, light_id(light));
    if (classes_.size() > 1) {
      row_ += ',';
      row_ += classes_[k];
    }
    const std::size_t used = row_.size();
    row_.resize(used + columns * (kLongestShortest + 1) + 1);
    char* at = row_.data() + used;
    for (std::size_t i = 0; i < columns; ++i) {
      *at++ = ',';
      at = write_shortest(at, values_[k * columns + i]);
    }
    *at++ = '\n';
    row_.resize(static_cast<std::size_t>(at - row_.data()));
  }
}

void ShareTable::append_npy() {
  row_.resize(values_.size() * sizeof(double));
  char* at = row_.data();
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    for (std::size_t k = 0; k < classes_.size(); ++k) {
      at = put_double(at, values_[k * columns_.size() + i]);
    }
  }
}

void ShareTable::write_names(TextSink& sink, KernelId kernel, std::string_view geometry_digest,
                             std::string_view file) const {
  JsonWriter json(sink);
  const auto list = [&](std::string_view name, const auto& names) {
    json.key(name);
    json.begin_array();
    for (const auto& one : names) json.value(std::string_view(one));
    json.end_array();
  };
  json.begin_object();
  json.member("format", "gnomon-shares");
  json.member("version", 1);
  json.member("table", file);
  json.member("scene", scene_.name);
  json.member("geometry", geometry_digest);
  json.member("kernel", kernel_info(kernel).name);
  json.member("exact", kernel_info(kernel).exact);
  std::vector<std::string> dropped;
  for (const PreparationNote& note : prepared_.notes) {
    if (note.repair == Repair::kZeroArea) dropped.push_back(scene_.polygons[note.polygon].id);
  }
  list("algorithms", methods_);
  list("classes", classes_);
  list("dropped", dropped);
  list("lights", lights_);
  list("sides", columns_.names());
  json.end_object();
  json.finish();
}

}  // namespace gnomon::report
