// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/cityjson/city_geometry.h"

#include <charconv>
#include <utility>

#include "scene/base/text_file.h"

namespace gnomon {

namespace {

constexpr CityGeometryType kTypes[] = {
    {"MultiPoint", 1, false},    {"MultiLineString", 2, false},
    {"MultiSurface", 3, false},  {"CompositeSurface", 3, false},
    {"Solid", 4, true},          {"MultiSolid", 5, true},
    {"CompositeSolid", 5, true},
};

constexpr int kRingDepth = 1, kSurfaceDepth = 2, kSolidDepth = 4;
constexpr std::size_t kFewestVertices = 3;

const char* expected_at(int depth) {
  switch (depth) {
    case kRingDepth:
      return "a ring: an array of vertex indices";
    case kSurfaceDepth:
      return "a surface: an array of rings";
    case 3:
      return "an array of surfaces";
    case 4:
      return "a solid: an array of shells";
    default:
      return "an array of solids";
  }
}

/// Follows "boundaries" and the semantics' "values" side by side.
class GeometryReader {
 public:
  GeometryReader(CityGeometry& geometry, std::size_t vertices, bool keep_bad)
      : geometry_(geometry), vertices_(vertices), keep_bad_(keep_bad) {}

  Expected<void> read(const JsonNode& boundaries, int depth, std::optional<JsonNode> values) {
    if (!boundaries.is_array()) return boundaries.tape().wrong_kind(boundaries, expected_at(depth));
    if (depth == kSurfaceDepth) return read_surface(boundaries, values);
    if (depth == kSolidDepth) {
      ++solid_;
      shell_ = 0;
    }
    if (depth == kSurfaceDepth + 1) ++shell_;
    if (values && values->is_null()) values.reset();
    if (values && !values->is_array()) {
      return values->tape().wrong_kind(*values, "an array as deep as that of the surfaces");
    }
    std::optional<JsonNode> value = values ? std::optional(values->begin()) : std::nullopt;
    for (JsonNode at = boundaries.begin(); at != boundaries.end(); at = at.next()) {
      if (value && *value == values->end()) return count_differs(*values);
      if (auto done = read(at, depth - 1, value); !done) return done;
      if (value) value = value->next();
    }
    if (value && !(*value == values->end())) return count_differs(*values);
    return {};
  }

 private:
  static tl::unexpected<Error> count_differs(const JsonNode& values) {
    return values.tape().error(values, ErrorCode::kFormat,
                               "semantics for " + std::to_string(values.size()) + " of these",
                               "a value for each surface, or null");
  }

  Expected<void> read_surface(const JsonNode& rings, const std::optional<JsonNode>& kind) {
    CitySurface surface;
    surface.offset = rings.offset();
    surface.solid = solid_;
    surface.is_outer = solid_ != 0 && shell_ == 1;
    if (kind && !kind->is_null()) {
      auto index = city_index(*kind, geometry_.kinds.size(), "semantic surface");
      if (!index) return tl::unexpected(std::move(index.error()));
      surface.kind = *index;
    }
    if (rings.begin() == rings.end()) {
      auto error = rings.tape().error(rings, ErrorCode::kFormat, "a surface without rings",
                                      "its outer ring");
      if (!keep_bad_) return error;
      surface.bad = std::move(error.value());
    }
    for (JsonNode ring = rings.begin(); ring != rings.end(); ring = ring.next()) {
      if (auto done = read_ring(ring, surface); !done) {
        const bool is_of_surface = done.error().code == ErrorCode::kIndex || ring.is_array();
        if (!keep_bad_ || !is_of_surface) return done;
        if (!surface.bad) surface.bad = std::move(done.error());
      }
    }
    geometry_.surfaces.push_back(std::move(surface));
    return {};
  }

  Expected<void> read_ring(const JsonNode& node, CitySurface& surface) {
    if (!node.is_array()) return node.tape().wrong_kind(node, expected_at(kRingDepth));
    std::vector<std::uint32_t> ring;
    for (JsonNode at = node.begin(); at != node.end(); at = at.next()) {
      auto index = city_index(at, vertices_, "vertex");
      if (!index) return tl::unexpected(std::move(index.error()));
      ring.push_back(*index);
    }
    if (ring.size() < kFewestVertices) {
      return node.tape().error(
          node, ErrorCode::kFormat,
          "a ring of " + std::to_string(ring.size()) + (ring.size() == 1 ? " vertex" : " vertices"),
          "at least 3 vertices");
    }
    surface.rings.push_back(std::move(ring));
    return {};
  }

  CityGeometry& geometry_;
  std::size_t vertices_;
  bool keep_bad_;
  std::uint32_t solid_ = 0, shell_ = 0;  // counted from 1
};

/// The types of the surfaces that the semantics list.
Expected<std::vector<std::string>> read_kinds(const JsonNode& semantics) {
  const auto surfaces = semantics.find("surfaces");
  if (!surfaces) return semantics.tape().missing(semantics, "surfaces", "an array of objects");
  if (!surfaces->is_array()) return semantics.tape().wrong_kind(*surfaces, "an array of objects");
  std::vector<std::string> kinds;
  for (JsonNode at = surfaces->begin(); at != surfaces->end(); at = at.next()) {
    if (!at.is_object()) return at.tape().wrong_kind(at, "an object with a type");
    const auto type = at.find("type");
    if (!type) return at.tape().missing(at, "type", "a type such as \"RoofSurface\"");
    if (!type->is_string()) return at.tape().wrong_kind(*type, "a type such as \"RoofSurface\"");
    kinds.push_back(type->string());
  }
  return kinds;
}

}  // namespace

const CityGeometryType* city_geometry_type(std::string_view name) {
  for (const CityGeometryType& type : kTypes) {
    if (type.name == name) return &type;
  }
  return nullptr;
}

Expected<std::uint32_t> city_index(const JsonNode& node, std::size_t count, const char* what) {
  const JsonTape& tape = node.tape();
  if (!node.is_number()) return tape.wrong_kind(node, std::string("the index of a ") + what);
  const std::string_view text = node.number();
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_whole = error == std::errc{} && end == text.data() + text.size();
  if (is_whole && value < count) return value;
  if (!is_whole && text.find_first_of(".eE") != std::string_view::npos) {
    return tape.error(node, ErrorCode::kFormat, quoted_text(text) + " is not an integer",
                      std::string("the index of a ") + what);
  }
  return tape.error(node, ErrorCode::kIndex,
                    "index " + std::string(text.substr(0, 40)) + " is not that of a " + what,
                    count == 0 ? std::string("the index of a ") + what + ", of which there is none"
                               : "0 to " + std::to_string(count - 1));
}

Expected<CityGeometry> read_city_geometry(const JsonNode& geometry, const CityGeometryType& type,
                                          std::size_t vertices, bool keep_bad) {
  const JsonTape& tape = geometry.tape();
  CityGeometry result;
  result.is_solid = type.is_solid;
  const auto boundaries = geometry.find("boundaries");
  if (!boundaries) return tape.missing(geometry, "boundaries", expected_at(type.depth));
  std::optional<JsonNode> values;
  const auto semantics = geometry.find("semantics");
  if (semantics && !semantics->is_null()) {
    if (!semantics->is_object()) return tape.wrong_kind(*semantics, "an object");
    auto kinds = read_kinds(*semantics);
    if (!kinds) return tl::unexpected(std::move(kinds.error()));
    result.kinds = *std::move(kinds);
    values = semantics->find("values");
  }
  GeometryReader reader(result, vertices, keep_bad);
  if (auto done = reader.read(*boundaries, type.depth, values); !done) {
    return tl::unexpected(std::move(done.error()));
  }
  return result;
}

Expected<std::optional<Number>> level_of_detail(const JsonNode& geometry) {
  const auto lod = geometry.find("lod");
  if (!lod) return std::nullopt;
  const char* const expected = "a level of detail such as \"2\" or \"2.2\"";
  if (!lod->is_string() && !lod->is_number()) return geometry.tape().wrong_kind(*lod, expected);
  const std::string text = lod->is_string() ? lod->string() : std::string(lod->number());
  auto number = Number::parse(text, NumberMeaning::kDecimal);
  if (!number) {
    return geometry.tape().error(*lod, ErrorCode::kFormat,
                                 quoted_text(text) + " is not a level of detail", expected);
  }
  return std::optional<Number>(*std::move(number));
}

}  // namespace gnomon
