// SPDX-License-Identifier: LGPL-3.0-or-later
// The writer of CityJSON 2.0. Coordinates are integers times a power of ten plus the least
// coordinate of each axis, exactly. Polygons called OBJECT/0, OBJECT/1, ... are the surfaces of one
// object; any other is an object of its own.
#include <rapidjson/stringbuffer.h>
#include <rapidjson/writer.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "gnomon/scene/groups.h"
#include "scene/files/writers.h"
#include "scene/json/json_text.h"
#include "scene/json/json_value.h"
#include "scene/model/decimal_arithmetic.h"

namespace gnomon {

namespace {

using CityWriter = rapidjson::Writer<rapidjson::StringBuffer>;

struct CityObject {
  std::string name;
  std::vector<std::uint32_t> polygons;
  bool is_solid = false;
};

/// "house/3" is surface 3 of house.
std::optional<std::pair<std::string_view, std::size_t>> object_and_number(std::string_view id) {
  const std::size_t slash = id.rfind('/');
  if (slash == std::string_view::npos || slash + 1 == id.size()) return std::nullopt;
  const std::string_view digits = id.substr(slash + 1);
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc{} || std::to_string(number) != digits ||
      end != digits.data() + digits.size()) {
    return std::nullopt;
  }
  return std::pair(id.substr(0, slash), number);
}

/// What a reader of such files kept of the one that the scene came from.
struct Kept {
  std::set<std::string> solids;
  std::vector<std::string> kinds;  // of surfaces; each is a group, too
  std::string reference_system;
};

Kept kept_in(const Scene& scene) {
  Kept kept;
  if (scene.extra.find("\"cityjson\"") == std::string::npos) return kept;
  rapidjson::Document extra;
  extra.Parse<kJsonFlags>(scene.extra.data(), scene.extra.size());
  if (extra.HasParseError() || !extra.IsObject()) return kept;
  const JsonValue* city = find_member(extra, "cityjson");
  if (city == nullptr || !city->IsObject()) return kept;
  const auto texts = [&](const char* key) {
    std::vector<std::string> result;
    const JsonValue* list = find_member(*city, key);
    if (list == nullptr || !list->IsArray()) return result;
    for (const JsonValue& element : list->GetArray()) {
      if (auto text = text_of(&element)) result.push_back(*std::move(text));
    }
    return result;
  };
  for (std::string& name : texts("solids")) kept.solids.insert(std::move(name));
  kept.kinds = texts("semantics");
  kept.reference_system = text_of(find_member(*city, "referenceSystem")).value_or("");
  return kept;
}

std::vector<CityObject> objects_of(const Scene& scene, const Kept& kept) {
  std::vector<CityObject> objects;
  std::unordered_set<std::string> names;
  for (std::uint32_t i = 0; i < scene.polygons.size(); ++i) {
    const std::string& id = scene.polygons[i].id;
    const auto parts = object_and_number(id);
    const bool goes_on = parts && parts->second != 0 && !objects.empty() &&
                         objects.back().name == parts->first &&
                         objects.back().polygons.size() == parts->second;
    if (!goes_on) {
      const bool begins = parts && parts->second == 0;
      std::string name = begins ? std::string(parts->first) : id;
      // "a" and "a/0" cannot both be of an object a.
      while (!names.insert(name).second) name = name == id ? name + "/" : id;
      objects.push_back({std::move(name), {}, false});
    }
    objects.back().polygons.push_back(i);
  }
  for (CityObject& object : objects) {
    object.is_solid = kept.solids.contains(object.name) &&
                      std::ranges::none_of(object.polygons, [&](std::uint32_t polygon) {
                        return scene.is_two_sided(scene.polygons[polygon]);
                      });
  }
  return objects;
}

/// The ids that the objects' surfaces get when the file is read.
bool keeps_id(const Scene& scene, const CityObject& object, std::size_t surface) {
  return scene.polygons[object.polygons[surface]].id == object.name + "/" + std::to_string(surface);
}

void write_words(CityWriter& writer, std::string_view text) {
  writer.String(text.data(), static_cast<rapidjson::SizeType>(text.size()));
}

std::string vertex_pointer(std::size_t vertex, std::size_t axis) {
  return "/vertices/" + std::to_string(vertex) + "/" + std::to_string(axis);
}

/// A coordinate as the file has it: a decimal, or a double by its shortest text.
Expected<Number> decimal_coordinate(const Scene& scene, std::size_t vertex, std::size_t axis) {
  const Number& number = scene.vertices[vertex][axis];
  if (number.is_decimal() || number.is_zero()) return number;
  auto text = number.to_text(scene.numbers);
  if (text) return Number::parse(*text, NumberMeaning::kDecimal);
  text.error().where.pointer = vertex_pointer(vertex, axis);
  return tl::unexpected(std::move(text.error()));
}

/// Vertices as integers.
class IntegerVertices {
 public:
  /// Errors: kNumber, kLimit, with the JSON pointer of a coordinate.
  static Expected<IntegerVertices> of(const Scene& scene) {
    IntegerVertices result;
    std::vector<Position> positions;
    for (std::size_t i = 0; i < scene.vertices.size(); ++i) {
      Position& position = positions.emplace_back();
      for (std::size_t axis = 0; axis < position.size(); ++axis) {
        auto number = decimal_coordinate(scene, i, axis);
        if (!number) return tl::unexpected(std::move(number.error()));
        if (!number->is_zero()) result.exponent_ = std::min(result.exponent_, number->exponent());
        position[axis] = *std::move(number);
      }
    }
    for (std::size_t axis = 0; axis < result.least_.size(); ++axis) {
      const auto coordinate = [axis](const Position& position) { return position[axis].exact(); };
      const auto least = std::ranges::min_element(positions, {}, coordinate);
      if (least != positions.end()) result.least_[axis] = (*least)[axis];
    }
    for (std::size_t i = 0; i < positions.size(); ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const Number rest = decimal_difference(positions[i][axis], result.least_[axis]);
        mpz_class power;
        mpz_ui_pow_ui(
            power.get_mpz_t(), 10,
            static_cast<unsigned long>(rest.is_zero() ? 0 : rest.exponent() - result.exponent_));
        result.integers_.push_back(mpz_class(rest.mantissa() * power).get_str());
        if (result.integers_.back().size() <= Number::kMaxDecimalDigits) continue;
        return fail(ErrorCode::kLimit, "an integer of more than 1000 digits",
                    "coordinates of less different magnitudes, or JSON",
                    ErrorPlace{scene.file, 0, 0, vertex_pointer(i, axis)});
      }
    }
    return result;
  }

  void write(CityWriter& writer) const {
    write_words(writer, "transform");
    writer.StartObject();
    const std::string step = Number::from_short_decimal(1, exponent_).to_text();
    write_words(writer, "scale");
    write_numbers(writer, {step, step, step});
    write_words(writer, "translate");
    write_numbers(writer, {least_[0].to_text(), least_[1].to_text(), least_[2].to_text()});
    writer.EndObject();
    write_words(writer, "vertices");
    writer.StartArray();
    for (std::size_t i = 0; i < integers_.size(); i += 3) {
      write_numbers(writer, {integers_[i], integers_[i + 1], integers_[i + 2]});
    }
    writer.EndArray();
  }

 private:
  static void write_numbers(CityWriter& writer, const std::array<std::string, 3>& numbers) {
    writer.StartArray();
    for (const std::string& number : numbers) {
      writer.RawValue(number.data(), number.size(), rapidjson::kNumberType);
    }
    writer.EndArray();
  }

  std::vector<std::string> integers_;  // three for each vertex
  Position least_;
  std::int32_t exponent_ = 0;
};

void write_ring(CityWriter& writer, const auto& loop) {
  writer.StartArray();
  for (const VertexId vertex : loop) writer.Uint(vertex);
  writer.EndArray();
}

void write_surfaces(CityWriter& writer, const Scene& scene, const CityObject& object) {
  writer.StartArray();
  for (const std::uint32_t index : object.polygons) {
    const Polygon& polygon = scene.polygons[index];
    writer.StartArray();
    write_ring(writer, polygon.loop);
    for (const auto& hole : polygon.holes) write_ring(writer, hole);
    writer.EndArray();
  }
  writer.EndArray();
}

/// The kinds of the object's surfaces; nothing if none has one.
void write_semantics(CityWriter& writer, const CityObject& object,
                     const std::vector<std::string>& kinds,
                     const std::unordered_map<std::uint32_t, std::size_t>& kind_of) {
  std::vector<std::optional<std::size_t>> values;
  std::vector<std::size_t> used;
  for (const std::uint32_t polygon : object.polygons) {
    const auto kind = kind_of.find(polygon);
    values.emplace_back();
    if (kind == kind_of.end()) continue;
    const auto known = std::ranges::find(used, kind->second);
    values.back() = static_cast<std::size_t>(known - used.begin());
    if (known == used.end()) used.push_back(kind->second);
  }
  if (used.empty()) return;
  write_words(writer, "semantics");
  writer.StartObject();
  write_words(writer, "surfaces");
  writer.StartArray();
  for (const std::size_t kind : used) {
    writer.StartObject();
    write_words(writer, "type");
    write_words(writer, kinds[kind]);
    writer.EndObject();
  }
  writer.EndArray();
  write_words(writer, "values");
  if (object.is_solid) writer.StartArray();
  writer.StartArray();
  for (const auto& value : values) value ? writer.Uint64(*value) : writer.Null();
  writer.EndArray();
  if (object.is_solid) writer.EndArray();
  writer.EndObject();
}

/// "attributes": the lit share of the object's area under each light, and of each of its surfaces.
void write_sunlit(CityWriter& writer, const CityObject& object, const CitySunlit& sunlit) {
  write_words(writer, "attributes");
  writer.StartObject();
  write_words(writer, "sunlit");
  writer.StartObject();
  for (const CitySunlit::UnderLight& light : sunlit.lights) {
    double lit = 0, whole = 0;
    for (const std::uint32_t polygon : object.polygons) {
      lit += light.shares[polygon] * sunlit.areas[polygon];
      whole += sunlit.areas[polygon];
    }
    write_words(writer, light.name);
    const double share = whole > 0 ? lit / whole : 0;
    writer.Double(std::isfinite(share) ? share : 0);
  }
  writer.EndObject();
  write_words(writer, "sunlit_surfaces");
  writer.StartObject();
  for (const CitySunlit::UnderLight& light : sunlit.lights) {
    write_words(writer, light.name);
    writer.StartArray();
    for (const std::uint32_t polygon : object.polygons) writer.Double(light.shares[polygon]);
    writer.EndArray();
  }
  writer.EndObject();
  writer.EndObject();
}

void write_object(CityWriter& writer, const Scene& scene, const CityObject& object,
                  const std::vector<std::string>& kinds,
                  const std::unordered_map<std::uint32_t, std::size_t>& kind_of,
                  const CitySunlit& sunlit) {
  write_words(writer, object.name);
  writer.StartObject();
  write_words(writer, "type");
  write_words(writer, "OtherConstruction");
  if (!sunlit.lights.empty()) write_sunlit(writer, object, sunlit);
  write_words(writer, "geometry");
  writer.StartArray();
  writer.StartObject();
  write_words(writer, "type");
  write_words(writer, object.is_solid ? "Solid" : "MultiSurface");
  write_words(writer, "lod");
  write_words(writer, "2");
  write_words(writer, "boundaries");
  if (object.is_solid) writer.StartArray();
  write_surfaces(writer, scene, object);
  if (object.is_solid) writer.EndArray();
  write_semantics(writer, object, kinds, kind_of);
  writer.EndObject();
  writer.EndArray();
  writer.EndObject();
}

}  // namespace

Expected<std::string> write_cityjson(const Scene& scene) {
  return write_sunlit_cityjson(scene, {});
}

Expected<std::string> write_sunlit_cityjson(const Scene& scene, const CitySunlit& sunlit) {
  const Kept kept = kept_in(scene);
  auto vertices = IntegerVertices::of(scene);
  if (!vertices) return tl::unexpected(std::move(vertices.error()));
  std::unordered_map<std::uint32_t, std::size_t> kind_of;
  if (!kept.kinds.empty()) {
    auto groups = polygon_groups(scene);
    if (!groups) return tl::unexpected(std::move(groups.error()));
    for (const PolygonGroup& group : *groups) {
      const auto kind = std::ranges::find(kept.kinds, group.name);
      if (kind == kept.kinds.end()) continue;
      for (const std::uint32_t polygon : group.polygons) {
        kind_of.emplace(polygon, static_cast<std::size_t>(kind - kept.kinds.begin()));
      }
    }
  }
  rapidjson::StringBuffer buffer;
  CityWriter writer(buffer);
  writer.StartObject();
  write_words(writer, "type");
  write_words(writer, "CityJSON");
  write_words(writer, "version");
  write_words(writer, "2.0");
  if (!kept.reference_system.empty()) {
    write_words(writer, "metadata");
    writer.StartObject();
    write_words(writer, "referenceSystem");
    write_words(writer, kept.reference_system);
    writer.EndObject();
  }
  write_words(writer, "CityObjects");
  writer.StartObject();
  for (const CityObject& object : objects_of(scene, kept)) {
    write_object(writer, scene, object, kept.kinds, kind_of, sunlit);
  }
  writer.EndObject();
  vertices->write(writer);
  writer.EndObject();
  return std::string(buffer.GetString(), buffer.GetSize()) + "\n";
}

std::vector<std::string> left_out_of_cityjson(const Scene& scene) {
  std::size_t ids = 0, one_sided = 0, silent = 0;
  for (const CityObject& object : objects_of(scene, kept_in(scene))) {
    for (std::size_t i = 0; i < object.polygons.size(); ++i) {
      const Polygon& polygon = scene.polygons[object.polygons[i]];
      if (!keeps_id(scene, object, i)) ++ids;
      if (!polygon.casts) ++silent;
      if (!object.is_solid && !scene.is_two_sided(polygon)) ++one_sided;
    }
  }
  const auto polygons = [](std::size_t count) {
    return std::to_string(count) + (count == 1 ? " polygon" : " polygons");
  };
  std::vector<std::string> warnings;
  if (ids != 0) {
    warnings.push_back(polygons(ids) + ": the id becomes that of an object, and is read with /0");
  }
  if (one_sided != 0) {
    warnings.push_back(polygons(one_sided) +
                       " with one side: the format has them in solids only, and reads two sides");
  }
  if (silent != 0) warnings.push_back("casts of " + polygons(silent) + " left out");
  if (!scene.lights.empty()) {
    warnings.push_back(std::to_string(scene.lights.size()) +
                       (scene.lights.size() == 1 ? " light" : " lights") + " left out");
  }
  if (!scene.extra.empty() && scene.extra.find("\"cityjson\"") == std::string::npos) {
    warnings.emplace_back("\"extra\" left out");
  }
  if (scene.numbers == NumberMeaning::kDouble) {
    warnings.emplace_back("the numbers are doubles: read the file with --numbers double");
  }
  return warnings;
}

}  // namespace gnomon
