// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/cityjson/city_reader.h"

#include <algorithm>
#include <utility>

#include "scene/base/text_file.h"
#include "scene/files/usable_id.h"
#include "scene/model/decimal_arithmetic.h"

namespace gnomon {

namespace {

/// More levels than this are not told of.
constexpr std::size_t kMostLevels = 32;

bool is_version(std::string_view text, std::string_view version) {
  return text == version || (text.starts_with(version) && text[version.size()] == '.');
}

}  // namespace

CityReader::CityReader(const std::string& file, const ReadOptions& options)
    : file_(file), options_(options) {
  scene_.file = file;
  scene_.name = name_from_file(file);
  // "house.city.json" is a house.
  if (scene_.name.ends_with(".city")) scene_.name.resize(scene_.name.size() - 5);
  scene_.numbers = options.numbers.value_or(NumberMeaning::kDecimal);
}

// --------------------------------------------------------------------------------- what stands
// once

Expected<void> CityReader::read_version(const JsonNode& root) {
  const char* const expected = "\"1.0\", \"1.1\" or \"2.0\"";
  const auto version = root.find("version");
  if (!version) return root.tape().missing(root, "version", expected);
  if (!version->is_string()) return root.tape().wrong_kind(*version, expected);
  version_ = version->string();
  if (is_version(version_, "1.0") || is_version(version_, "1.1") || is_version(version_, "2.0")) {
    return {};
  }
  return root.tape().error(*version, ErrorCode::kFormat,
                           "CityJSON of version " + quoted_text(version_), expected);
}

Expected<void> CityReader::read_templates(const JsonNode& root) {
  const JsonTape& tape = root.tape();
  const auto templates = root.find("geometry-templates");
  if (!templates) return {};
  if (!templates->is_object()) return tape.wrong_kind(*templates, "an object");
  const auto list = templates->find("templates");
  if (!list) return tape.missing(*templates, "templates", "an array of geometries");
  if (!list->is_array()) return tape.wrong_kind(*list, "an array of geometries");
  const auto vertices = templates->find("vertices-templates");
  if (!vertices) return tape.missing(*templates, "vertices-templates", "an array of vertices");
  const auto nodes = CityVertices::read(*vertices);
  if (!nodes) return tl::unexpected(nodes.error());
  for (std::uint32_t i = 0; i < nodes->size(); ++i) {
    auto position = exact_position(nodes->node(tape, i));
    if (!position) return tl::unexpected(std::move(position.error()));
    template_vertices_.push_back(*std::move(position));
  }
  for (JsonNode at = list->begin(); at != list->end(); at = at.next()) {
    if (!at.is_object()) return tape.wrong_kind(at, "a geometry: an object");
    auto found = candidate(at);
    if (!found) return tl::unexpected(std::move(found.error()));
    Template& shape = templates_.emplace_back();
    if (!*found) continue;
    if ((*found)->type == nullptr) {
      return tape.error(at, ErrorCode::kFormat, "a template that is an instance of a template",
                        "a geometry with surfaces");
    }
    auto geometry = read_city_geometry(at, *(*found)->type, nodes->size(), options_.skip_bad);
    if (!geometry) return tl::unexpected(std::move(geometry.error()));
    shape = {*std::move(geometry), std::move((*found)->lod)};
  }
  return {};
}

Expected<void> CityReader::read_city(const JsonTape& tape) {
  const JsonNode root = tape.root();
  if (!root.is_object()) return tape.wrong_kind(root, "a CityJSON object in braces");
  if (const auto again = root.repeated_key()) {
    return tape.error(*again, ErrorCode::kFormat,
                      "the key " + quoted_text(again->string()) + " stands here twice",
                      "each key once");
  }
  const auto type = root.find("type");
  if (!type) return tape.missing(root, "type", "\"CityJSON\"");
  if (!type->is_text("CityJSON")) {
    return tape.error(*type, ErrorCode::kFormat, "this is not the type of a CityJSON file",
                      "\"CityJSON\"");
  }
  if (auto done = read_version(root); !done) return done;
  if (!options_.lod.empty()) {
    auto lod = Number::parse(options_.lod, NumberMeaning::kDecimal);
    if (!lod) {
      return fail(ErrorCode::kUsage, "--lod " + options_.lod + " is no level of detail",
                  "a number such as 2 or 2.2");
    }
    wanted_lod_ = *std::move(lod);
  }
  if (const auto transform = root.find("transform")) {
    auto read = read_city_transform(*transform);
    if (!read) return tl::unexpected(std::move(read.error()));
    transform_ = *std::move(read);
  } else if (!is_version(version_, "1.0")) {
    return tape.missing(root, "transform", "an object with scale and translate, as of version 1.1");
  }
  if (const auto metadata = root.find("metadata"); metadata && metadata->is_object()) {
    const auto system = metadata->find("referenceSystem");
    if (system && system->is_string()) reference_system_ = system->string();
  }
  if (auto done = read_templates(root); !done) return done;
  return read_objects(tape, 0);
}

Expected<void> CityReader::read_feature(const JsonTape& tape, std::uint64_t line_offset) {
  const JsonNode root = tape.root();
  if (!root.is_object()) return tape.wrong_kind(root, "a CityJSONFeature in braces");
  if (const auto again = root.repeated_key()) {
    return tape.error(*again, ErrorCode::kFormat,
                      "the key " + quoted_text(again->string()) + " stands here twice",
                      "each key once");
  }
  const auto type = root.find("type");
  if (!type) return tape.missing(root, "type", "\"CityJSONFeature\"");
  if (!type->is_text("CityJSONFeature")) {
    return tape.error(*type, ErrorCode::kFormat, "this is not the type of a feature",
                      "\"CityJSONFeature\", as in all lines but the first");
  }
  return read_objects(tape, line_offset);
}

// ------------------------------------------------------------------------------------- city
// objects

Expected<void> CityReader::read_objects(const JsonTape& tape, std::uint64_t offset) {
  const JsonNode root = tape.root();
  const auto objects = root.find("CityObjects");
  if (!objects) return tape.missing(root, "CityObjects", "an object with the city objects");
  if (!objects->is_object()) return tape.wrong_kind(*objects, "an object with the city objects");
  const auto list = root.find("vertices");
  if (!list) return tape.missing(root, "vertices", "an array of vertices");
  auto vertices = CityVertices::read(*list);
  if (!vertices) return tl::unexpected(std::move(vertices.error()));
  Unit unit{tape, *std::move(vertices), {}, offset};
  unit.of_vertex.assign(unit.vertices.size(), kNone);
  const std::size_t first_vertex = scene_.vertices.size(), first_polygon = scene_.polygons.size();
  for (JsonNode key = objects->begin(); key != objects->end(); key = key.next().next()) {
    if (auto done = read_object(unit, key, key.next()); !done) return done;
  }
  sort_vertices(unit, first_vertex, first_polygon);
  return {};
}

Expected<void> CityReader::read_object(Unit& unit, const JsonNode& key, const JsonNode& object) {
  const JsonTape& tape = unit.tape;
  if (!object.is_object()) return tape.wrong_kind(object, "a city object in braces");
  const std::string name = key.string();
  prefix_ = usable_id(name) + "/";
  if (!prefixes_.insert(prefix_).second) {
    return tape.error(key, ErrorCode::kId, "a second city object " + quoted_text(name),
                      "ids that differ");
  }
  const auto list = object.find("geometry");
  if (!list) return {};
  if (!list->is_array()) return tape.wrong_kind(*list, "an array of geometries");
  std::vector<Candidate> candidates;
  for (JsonNode at = list->begin(); at != list->end(); at = at.next()) {
    if (!at.is_object()) return tape.wrong_kind(at, "a geometry: an object");
    auto found = candidate(at);
    if (!found) return tl::unexpected(std::move(found.error()));
    if (*found) candidates.push_back(**std::move(found));
  }
  auto picked = chosen(candidates);
  if (!picked) return tl::unexpected(std::move(picked.error()));
  PolygonGroup group{name, {}};
  for (const Candidate& geometry : *picked) {
    auto done = geometry.type == nullptr ? add_instance(unit, geometry, group.polygons)
                                         : add_geometry(unit, geometry, group.polygons);
    if (!done) return done;
  }
  const bool is_plain_solid = picked->size() == 1 && picked->front().type != nullptr &&
                              picked->front().type->name == kSolidType &&
                              picked->front().node.find("boundaries")->size() == 1;
  if (is_plain_solid) solids_.push_back(usable_id(name));
  if (!group.polygons.empty()) objects_.push_back(std::move(group));
  return {};
}

Expected<std::optional<CityReader::Candidate>> CityReader::candidate(const JsonNode& geometry) {
  const JsonTape& tape = geometry.tape();
  const char* const expected = "a type of geometry such as \"Solid\"";
  const auto type = geometry.find("type");
  if (!type) return tape.missing(geometry, "type", expected);
  if (!type->is_string()) return tape.wrong_kind(*type, expected);
  Candidate result{geometry, nullptr, 0, {}};
  const std::string name = type->string();
  if (name == kInstanceType) {
    const auto index = geometry.find("template");
    if (!index) return tape.missing(geometry, "template", "the index of a template");
    auto number = city_index(*index, templates_.size(), "template");
    if (!number) return tl::unexpected(std::move(number.error()));
    result.template_index = *number;
    result.lod = templates_[*number].lod;
    return std::optional(std::move(result));
  }
  result.type = city_geometry_type(name);
  if (result.type == nullptr) {
    return tape.error(*type, ErrorCode::kFormat, "a geometry of type " + quoted_text(name),
                      expected);
  }
  if (!result.type->has_surfaces()) {
    ++passed_over_[name];
    return std::nullopt;
  }
  auto lod = level_of_detail(geometry);
  if (!lod) return tl::unexpected(std::move(lod.error()));
  result.lod = *std::move(lod);
  return std::optional(std::move(result));
}

/// The geometries of the level that was asked for, else of the highest; none has the lowest.
Expected<std::vector<CityReader::Candidate>> CityReader::chosen(
    const std::vector<Candidate>& candidates) {
  std::vector<Candidate> result;
  std::optional<Number> level = wanted_lod_;
  for (const Candidate& candidate : candidates) {
    if (!candidate.lod) continue;
    if (lods_.size() < kMostLevels && std::ranges::find(lods_, *candidate.lod) == lods_.end()) {
      lods_.push_back(*candidate.lod);
    }
    if (!wanted_lod_ && (!level || candidate.lod->exact() > level->exact())) level = candidate.lod;
  }
  for (const Candidate& candidate : candidates) {
    if (candidate.lod == level) result.push_back(candidate);
  }
  if (result.empty() && !candidates.empty()) ++without_lod_;
  return result;
}

// -----------------------------------------------------------------------------------------
// surfaces

Expected<VertexId> CityReader::add_vertex(Position position, const JsonNode& node) {
  for (Number& coordinate : position) {
    bool underflow = false;
    auto number = as_meant(std::move(coordinate), scene_.numbers, underflow);
    if (!number) {
      return node.tape().error(node, number.error().code, number.error().what,
                               number.error().expected);
    }
    if (underflow) ++underflows_;
    coordinate = *std::move(number);
  }
  if (scene_.vertices.size() == kNone - 1) {
    return node.tape().error(node, ErrorCode::kLimit, "too many vertices", "at most 4294967294");
  }
  scene_.vertices.push_back(std::move(position));
  return static_cast<VertexId>(scene_.vertices.size() - 1);
}

Expected<VertexId> CityReader::vertex(Unit& unit, std::uint32_t index) {
  VertexId& known = unit.of_vertex[index];
  if (known != kNone) return known;
  const JsonNode node = unit.vertices.node(unit.tape, index);
  auto position = exact_position(node);
  if (!position) return tl::unexpected(std::move(position.error()));
  auto added = add_vertex(transformed(*std::move(position), transform_), node);
  if (added) known = *added;
  return added;
}

template <class Vertex>
Expected<void> CityReader::add_surface(const CityGeometry& geometry, const CitySurface& surface,
                                       std::uint64_t offset, bool reversed, const Vertex& vertex,
                                       std::vector<std::uint32_t>& group) {
  Polygon polygon;
  std::optional<Error> bad = surface.bad;
  for (const std::vector<std::uint32_t>& ring : surface.rings) {
    std::vector<VertexId> loop;
    for (const std::uint32_t index : ring) {
      auto id = vertex(index);
      if (!id && !options_.skip_bad) return tl::unexpected(std::move(id.error()));
      if (!id && !bad) bad = std::move(id.error());
      loop.push_back(id.value_or(0));
    }
    if (reversed) std::ranges::reverse(loop);
    if (polygon.loop.empty()) {
      polygon.loop.assign(loop.begin(), loop.end());
    } else {
      polygon.holes.push_back(std::move(loop));
    }
  }
  const auto number = static_cast<std::uint32_t>(scene_.polygons.size());
  if (bad) {
    problems_.push_back({number, *std::move(bad)});
    polygon.loop.clear();
    polygon.holes.clear();
  }
  polygon.id = prefix_ + std::to_string(group.size());
  if (!geometry.is_solid) polygon.two_sided = true;
  group.push_back(number);
  if (surface.kind) {
    const std::string& kind = geometry.kinds[*surface.kind];
    kinds_.add(kind, number);
  }
  offsets_.push_back(offset);
  scene_.polygons.push_back(std::move(polygon));
  return {};
}

Expected<void> CityReader::add_geometry(Unit& unit, const Candidate& candidate,
                                        std::vector<std::uint32_t>& group) {
  auto geometry =
      read_city_geometry(candidate.node, *candidate.type, unit.vertices.size(), options_.skip_bad);
  if (!geometry) return tl::unexpected(std::move(geometry.error()));
  const std::size_t first = scene_.polygons.size();
  for (const CitySurface& surface : geometry->surfaces) {
    auto done = add_surface(
        *geometry, surface, unit.offset + surface.offset, false,
        [&](std::uint32_t index) { return vertex(unit, index); }, group);
    if (!done) return done;
  }
  look_outwards(*geometry, first);
  return {};
}

Expected<void> CityReader::add_instance(Unit& unit, const Candidate& candidate,
                                        std::vector<std::uint32_t>& group) {
  const JsonNode node = candidate.node;
  const auto boundaries = node.find("boundaries");
  if (!boundaries) return unit.tape.missing(node, "boundaries", "an array with one vertex index");
  if (!boundaries->is_array() || boundaries->size() != 1) {
    return unit.tape.error(*boundaries, ErrorCode::kFormat, "this is not the place of an instance",
                           "an array with one vertex index");
  }
  const auto index = city_index(boundaries->begin(), unit.vertices.size(), "vertex");
  if (!index) return tl::unexpected(index.error());
  auto anchor = exact_position(unit.vertices.node(unit.tape, *index));
  if (!anchor) return tl::unexpected(std::move(anchor.error()));
  const Position place = transformed(*std::move(anchor), transform_);
  const auto entries = node.find("transformationMatrix");
  if (!entries) return unit.tape.missing(node, "transformationMatrix", "16 numbers, row by row");
  const auto matrix = CityMatrix::read(*entries);
  if (!matrix) return tl::unexpected(matrix.error());
  const CityGeometry& shape = templates_[candidate.template_index].geometry;
  std::unordered_map<std::uint32_t, VertexId> added;
  const auto moved = [&](std::uint32_t of_template) -> Expected<VertexId> {
    const auto known = added.find(of_template);
    if (known != added.end()) return known->second;
    auto id = add_vertex(matrix->apply(template_vertices_[of_template], place), node);
    if (id) added.emplace(of_template, *id);
    return id;
  };
  const std::size_t first = scene_.polygons.size();
  for (const CitySurface& surface : shape.surfaces) {
    auto done =
        add_surface(shape, surface, unit.offset + node.offset(), matrix->mirrors(), moved, group);
    if (!done) return done;
  }
  look_outwards(shape, first);
  return {};
}

}  // namespace gnomon
