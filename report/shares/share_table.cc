// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/shares/share_table.h"

#include <algorithm>
#include <bit>

#include "gnomon/algorithms/method.h"
#include "report/json/json_writer.h"
#include "report/sides/polygon_sides.h"
#include "report/text/number_text.h"

namespace gnomon::report {

namespace {

/// As RFC 4180 has it: in quotes where it holds a comma, a quote or a line break.
void append_field(std::string& text, std::string_view field) {
  if (field.find_first_of(",\"\r\n") == std::string_view::npos) {
    text += field;
    return;
  }
  text += '"';
  for (const char c : field) {
    if (c == '"') text += '"';
    text += c;
  }
  text += '"';
}

/// Little-endian.
char* put_double(char* at, double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  for (unsigned shift = 0; shift < 64; shift += 8) *at++ = static_cast<char>(bits >> shift & 0xff);
  return at;
}

}  // namespace

std::optional<ShareFormat> share_format(const std::filesystem::path& file) {
  if (file.extension() == ".csv") return ShareFormat::kCsv;
  if (file.extension() == ".npy") return ShareFormat::kNpy;
  return std::nullopt;
}

ShareTable::ShareTable(const Scene& scene, const PreparedScene& prepared,
                       std::span<const std::uint32_t> lights, ShareFormat format)
    : scene_(scene), prepared_(prepared), format_(format), weights_(prepared) {
  for (std::uint32_t polygon = 0; polygon + 1 < prepared.first_part.size(); ++polygon) {
    if (prepared.first_part[polygon] == prepared.first_part[polygon + 1]) continue;  // dropped
    columns_.push_back({polygon, Side::kFront});
    if (scene.is_two_sided(scene.polygons[polygon])) columns_.push_back({polygon, Side::kBack});
  }
  const bool any_area = std::ranges::any_of(
      lights, [&](std::uint32_t light) { return prepared.lights[light].has_area(); });
  classes_ = any_area ? std::vector<std::string_view>{"lit", "penumbra", "umbra"}
                      : std::vector<std::string_view>{"lit"};
  values_.resize(classes_.size() * columns_.size());
}

/// No id holds a "#".
std::string ShareTable::name_of(const Column& column) const {
  const std::string& id = scene_.polygons[column.polygon].id;
  return column.side == Side::kFront ? id : id + "#back";
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
  for (const Column& column : columns_) {
    text += ',';
    append_field(text, name_of(column));
  }
  return text + "\n";
}

/// NumPy's format 1.0: a magic text, the version, the length of the dictionary, and that,
/// padded with spaces so that the numbers begin at a multiple of 64.
std::string ShareTable::npy_head(std::size_t lights) const {
  constexpr std::size_t kSize = 192, kBefore = 10;
  std::string text = "{'descr': '<f8', 'fortran_order': False, 'shape': (" +
                     std::to_string(lights) + ", " + std::to_string(columns_.size());
  if (classes_.size() > 1) text += ", " + std::to_string(classes_.size());
  text += "), }";
  text.resize(kSize - kBefore - 1, ' ');
  text += '\n';
  return std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(text.size()) + '\0' + text;
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
    const Shares shares =
        side_shares(prepared_, light, columns_[i].polygon, columns_[i].side, weights_);
    values_[i] = shares.lit.middle();
    if (classes_.size() == 1) continue;
    values_[columns + i] = shares.penumbra.middle();
    values_[2 * columns + i] = (area ? shares.umbra : shares.shadow).middle();
  }
}

void ShareTable::append_csv(std::uint32_t light) {
  const std::size_t columns = columns_.size();
  for (std::size_t k = 0; k < classes_.size(); ++k) {
    append_field(row_, light_id(light));
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
  std::vector<std::string> sides, dropped;
  for (const Column& column : columns_) sides.push_back(name_of(column));
  for (const PreparationNote& note : prepared_.notes) {
    if (note.repair == Repair::kZeroArea) dropped.push_back(scene_.polygons[note.polygon].id);
  }
  list("algorithms", methods_);
  list("classes", classes_);
  list("dropped", dropped);
  list("lights", lights_);
  list("sides", sides);
  json.end_object();
  json.finish();
}

}  // namespace gnomon::report
