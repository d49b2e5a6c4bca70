// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/building/honeybee_reader.h"

#include <algorithm>
#include <array>
#include <utility>

#include "scene/base/text_file.h"
#include "scene/building/length_units.h"
#include "scene/files/usable_id.h"
#include "scene/model/decimal_arithmetic.h"

namespace gnomon {

HoneybeeReader::HoneybeeReader(const JsonTape& tape, const std::string& file,
                               const ReadOptions& options)
    : tape_(tape),
      builder_(file, options, NumberMeaning::kDecimal),
      factor_(Number::from_short_decimal(1, 0)) {}

template <class Each>
Expected<void> HoneybeeReader::for_each(const JsonNode& object, std::string_view key,
                                        const Each& each) const {
  const auto list = object.find(key);
  if (!list || list->is_null()) return {};
  if (!list->is_array()) return tape_.wrong_kind(*list, "an array");
  for (JsonNode node = list->begin(); node != list->end(); node = node.next()) {
    if (!node.is_object()) return tape_.wrong_kind(node, "an object");
    if (auto done = each(node); !done) return done;
  }
  return {};
}

tl::unexpected<Error> HoneybeeReader::at(const JsonNode& node, const Error& error) const {
  return tape_.error(node, error.code, error.what, error.expected);
}

Expected<ReadResult> HoneybeeReader::read() {
  const JsonNode root = tape_.root();
  if (!root.is_object()) return tape_.wrong_kind(root, "a Model: an object");
  const auto type = root.find("type");
  if (!type) return tape_.missing(root, "type", "\"Model\"");
  if (!type->is_text("Model")) {
    return tape_.error(
        *type, ErrorCode::kFormat,
        "this is no Model" + (type->is_string() ? ", but " + quoted_text(type->string()) : ""),
        "\"Model\", which holds rooms, faces and shades");
  }
  if (root.find("buildings")) {
    return tape_.error(*type, ErrorCode::kFormat, "this is a model of dragonfly (DFJSON)",
                       "the HBJSON that dragonfly makes of it");
  }
  if (auto done = read_units(root); !done) return tl::unexpected(std::move(done.error()));
  const auto all = [&]() -> Expected<void> {
    auto done = for_each(root, "rooms", [&](const JsonNode& room) { return read_room(room); });
    if (!done) return done;
    done =
        for_each(root, "orphaned_faces", [&](const JsonNode& face) { return read_face(face, {}); });
    if (!done) return done;
    for (const auto& [key, kind] :
         {std::pair("orphaned_apertures", "Aperture"), std::pair("orphaned_doors", "Door")}) {
      done = for_each(root, key, [&, kind = kind](const JsonNode& opening) {
        return read_opening({opening, {}, kind}, nullptr);
      });
      if (!done) return done;
    }
    done =
        for_each(root, "orphaned_shades", [&](const JsonNode& shade) { return read_shade(shade); });
    if (!done) return done;
    return for_each(root, "shade_meshes",
                    [&](const JsonNode& mesh) { return read_shade_mesh(mesh); });
  }();
  if (!all) return tl::unexpected(all.error());
  warn();
  std::vector<std::pair<std::string, std::string>> facts = {{"units", "\"" + units_ + "\""}};
  if (!tolerance_.empty()) facts.emplace_back("tolerance", tolerance_);
  builder_.write_extra("honeybee", facts);
  return builder_.finish();
}

Expected<void> HoneybeeReader::read_units(const JsonNode& root) {
  if (const auto units = root.find("units"); units && !units->is_null()) {
    if (!units->is_string()) return tape_.wrong_kind(*units, "a unit of length, as text");
    const LengthUnit* const known = length_unit(units->string());
    if (known == nullptr) {
      return tape_.error(*units, ErrorCode::kFormat, "units " + quoted_text(units->string()),
                         shown_length_units());
    }
    units_ = known->name;
    factor_ = known->metres();
  }
  const auto tolerance = root.find("tolerance");
  if (tolerance && tolerance->is_number()) {
    // In metres, as all that is told.
    const auto number = Number::parse(tolerance->number(), NumberMeaning::kDecimal);
    if (!number) return at(*tolerance, number.error());
    if (number->sign() > 0) tolerance_ = decimal_product(*number, factor_).to_text();
  }
  return {};
}

// ------------------------------------------------------------------------------------- geometry

Expected<Position> HoneybeeReader::position(const JsonNode& list) const {
  if (!list.is_array()) return tape_.wrong_kind(list, "a point: an array of three numbers");
  Position result;
  std::size_t count = 0;
  for (JsonNode node = list.begin(); node != list.end(); node = node.next(), ++count) {
    if (!node.is_number()) return tape_.wrong_kind(node, "a coordinate");
    if (count >= result.size()) continue;
    auto number = Number::parse(node.number(), NumberMeaning::kDecimal);
    if (!number) return at(node, number.error());
    result[count] = decimal_product(*number, factor_);
  }
  if (count != result.size()) {
    return tape_.error(list, ErrorCode::kFormat, "a point of " + std::to_string(count) + " numbers",
                       "three coordinates");
  }
  return result;
}

Expected<std::vector<Position>> HoneybeeReader::loop(const JsonNode& list) const {
  if (!list.is_array()) return tape_.wrong_kind(list, "an array of points");
  std::vector<Position> corners;
  for (JsonNode node = list.begin(); node != list.end(); node = node.next()) {
    auto corner = position(node);
    if (!corner) return tl::unexpected(std::move(corner.error()));
    corners.push_back(*std::move(corner));
  }
  constexpr std::size_t kFewest = 3;
  if (corners.size() < kFewest) {
    return tape_.error(list, ErrorCode::kFormat,
                       "a loop of " + counted_as(corners.size(), "vertex", "vertices"),
                       "at least 3 vertices");
  }
  return corners;
}

Expected<HoneybeeReader::Face3D> HoneybeeReader::face3d(const JsonNode& object) const {
  const auto geometry = object.find("geometry");
  if (!geometry) return tape_.missing(object, "geometry", "a Face3D");
  if (!geometry->is_object()) return tape_.wrong_kind(*geometry, "a Face3D: an object");
  const auto boundary = geometry->find("boundary");
  if (!boundary) return tape_.missing(*geometry, "boundary", "an array of points");
  Face3D result;
  auto outer = loop(*boundary);
  if (!outer) return tl::unexpected(std::move(outer.error()));
  result.boundary = *std::move(outer);
  const auto holes = geometry->find("holes");
  if (!holes || holes->is_null()) return result;
  if (!holes->is_array()) return tape_.wrong_kind(*holes, "an array of holes");
  for (JsonNode node = holes->begin(); node != holes->end(); node = node.next()) {
    auto hole = loop(node);
    if (!hole) return tl::unexpected(std::move(hole.error()));
    result.holes.push_back(*std::move(hole));
  }
  return result;
}

Expected<std::string> HoneybeeReader::name_of(const JsonNode& object) const {
  const auto name = object.find("identifier");
  if (!name) return tape_.missing(object, "identifier", "a text");
  if (!name->is_string()) return tape_.wrong_kind(*name, "a text");
  return usable_id(name->string());
}

Expected<bool> HoneybeeReader::sees_the_sun(const JsonNode& object) const {
  const auto condition = object.find("boundary_condition");
  if (!condition || condition->is_null()) return true;
  if (!condition->is_object()) return tape_.wrong_kind(*condition, "an object");
  const auto type = condition->find("type");
  if (!type) return tape_.missing(*condition, "type", "\"Outdoors\", \"Surface\", \"Ground\", ...");
  return type->is_text("Outdoors");
}

Expected<void> HoneybeeReader::add_face3d(const Surface& surface, const Face3D& geometry) {
  const auto name = name_of(surface.node);
  if (!name) return tl::unexpected(name.error());
  auto polygon = builder_.add(*name, surface.node.offset());
  if (!polygon) return at(surface.node, polygon.error());
  auto outer = builder_.vertices(geometry.boundary);
  if (!outer) return at(surface.node, outer.error());
  (*polygon)->loop = *std::move(outer);
  for (const std::vector<Position>& hole : geometry.holes) {
    auto inner = builder_.vertices(hole);
    if (!inner) return at(surface.node, inner.error());
    (*polygon)->holes.push_back(*std::move(inner));
  }
  if (surface.room.empty()) (*polygon)->two_sided = true;
  return {};
}

Expected<void> HoneybeeReader::add(const Surface& surface, std::vector<Position>* boundary) {
  const std::size_t before = builder_.polygon_count();
  Expected<void> done;
  auto geometry = face3d(surface.node);
  if (geometry) {
    done = add_face3d(surface, *geometry);
  } else {
    done = tl::unexpected(std::move(geometry.error()));
  }
  if (done) {
    builder_.put_into_groups(usable_text(surface.room), surface.kind);
    if (boundary != nullptr) *boundary = std::move(geometry->boundary);
    return {};
  }
  const auto name = name_of(surface.node);
  if (!builder_.skips_bad() || done.error().code == ErrorCode::kId || !name) return done;
  builder_.take_back(before);
  builder_.add_bad(*name, surface.node.offset(), std::move(done.error()));
  return {};
}

// ------------------------------------------------------------------------------ rooms and shades

Expected<void> HoneybeeReader::read_room(const JsonNode& room) {
  const auto name = name_of(room);
  if (!name) return tl::unexpected(name.error());
  auto done = for_each(room, "faces", [&](const JsonNode& face) { return read_face(face, *name); });
  if (!done) return done;
  count_indoor_shades(room);
  return read_outdoor_shades(room);
}

/// A face of a room, or of none.
Expected<void> HoneybeeReader::read_face(const JsonNode& face, const std::string& room) {
  const auto sees = sees_the_sun(face);
  if (!sees) return tl::unexpected(sees.error());
  const auto type = face.find("face_type");
  const bool is_air = type && type->is_text("AirBoundary");
  if (!*sees || is_air) {
    ++(is_air ? air_boundaries_ : interior_);
    for (const char* key : {"apertures", "doors"}) {
      auto counted = for_each(face, key, [&](const JsonNode&) -> Expected<void> {
        ++interior_;
        return {};
      });
      if (!counted) return counted;
    }
    return {};
  }
  constexpr std::array<const char*, 3> kKinds = {"Wall", "RoofCeiling", "Floor"};
  const auto* const kind =
      std::ranges::find_if(kKinds, [&](const char* known) { return type && type->is_text(known); });
  std::vector<Position> boundary;
  auto done = add({face, room, kind == kKinds.end() ? "Face" : *kind}, &boundary);
  if (!done) return done;
  const OpeningPlane plane(boundary);
  for (const auto& [key, opening_kind] :
       {std::pair("apertures", "Aperture"), std::pair("doors", "Door")}) {
    done = for_each(face, key, [&, kind = opening_kind](const JsonNode& opening) {
      return read_opening({opening, room, kind}, &plane);
    });
    if (!done) return done;
  }
  count_indoor_shades(face);
  return read_outdoor_shades(face);
}

Expected<void> HoneybeeReader::read_opening(const Surface& opening, const OpeningPlane* wall) {
  const auto sees = sees_the_sun(opening.node);
  if (!sees) return tl::unexpected(sees.error());
  if (!*sees) {
    ++interior_;
    return {};
  }
  std::vector<Position> boundary;
  if (auto done = add(opening, &boundary); !done) return done;
  if (wall != nullptr) {
    ++openings_;
    const double distance = wall->distance(boundary);
    if (distance > 0) ++off_plane_;
    farthest_ = std::max(farthest_, distance);
  }
  count_indoor_shades(opening.node);
  return read_outdoor_shades(opening.node);
}

void HoneybeeReader::count_indoor_shades(const JsonNode& owner) {
  const auto shades = owner.find("indoor_shades");
  if (shades && shades->is_array()) indoor_shades_ += shades->size();
}

Expected<void> HoneybeeReader::read_outdoor_shades(const JsonNode& owner) {
  return for_each(owner, "outdoor_shades",
                  [&](const JsonNode& shade) { return read_shade(shade); });
}

namespace {

/// "properties": {"energy": {"transmittance_schedule": ...}}.
bool has_transmittance(const JsonNode& shade) {
  const auto properties = shade.find("properties");
  if (!properties || !properties->is_object()) return false;
  const auto energy = properties->find("energy");
  if (!energy || !energy->is_object()) return false;
  const auto schedule = energy->find("transmittance_schedule");
  return schedule && !schedule->is_null();
}

}  // namespace

Expected<void> HoneybeeReader::read_shade(const JsonNode& shade) {
  if (has_transmittance(shade)) ++transmitting_;
  return add({shade, {}, "Shade"});
}

/// A mesh of triangles and quadrilaterals: polygons NAME/0, NAME/1, ...
Expected<void> HoneybeeReader::read_shade_mesh(const JsonNode& mesh) {
  const auto name = name_of(mesh);
  if (!name) return tl::unexpected(name.error());
  if (has_transmittance(mesh)) ++transmitting_;
  const auto geometry = mesh.find("geometry");
  if (!geometry) return tape_.missing(mesh, "geometry", "a Mesh3D");
  if (!geometry->is_object()) return tape_.wrong_kind(*geometry, "a Mesh3D: an object");
  const auto list = geometry->find("vertices");
  if (!list) return tape_.missing(*geometry, "vertices", "an array of points");
  if (!list->is_array()) return tape_.wrong_kind(*list, "an array of points");
  std::vector<VertexId> vertices;
  for (JsonNode node = list->begin(); node != list->end(); node = node.next()) {
    const auto corner = position(node);
    if (!corner) return tl::unexpected(corner.error());
    const auto vertex = builder_.vertex(*corner);
    if (!vertex) return at(node, vertex.error());
    vertices.push_back(*vertex);
  }
  const auto faces = geometry->find("faces");
  if (!faces) return tape_.missing(*geometry, "faces", "an array of arrays of indices");
  if (!faces->is_array()) return tape_.wrong_kind(*faces, "an array of arrays of indices");
  std::size_t number = 0;
  for (JsonNode face = faces->begin(); face != faces->end(); face = face.next(), ++number) {
    if (!face.is_array()) return tape_.wrong_kind(face, "an array of indices");
    std::vector<VertexId> loop;
    for (JsonNode index = face.begin(); index != face.end(); index = index.next()) {
      const auto value =
          index.is_number() ? Number::parse(index.number(), NumberMeaning::kDecimal) : Number();
      if (!index.is_number()) return tape_.wrong_kind(index, "an index");
      if (!value || value->sign() < 0 || value->exponent() < 0 ||
          value->exact() >= static_cast<unsigned long>(vertices.size())) {
        return tape_.error(index, ErrorCode::kIndex,
                           quoted_text(index.number()) + " is not the index of a vertex",
                           "0 to " + std::to_string(vertices.size()) + " less 1");
      }
      loop.push_back(vertices[value->exact().get_num().get_ui()]);
    }
    constexpr std::size_t kFewest = 3;
    if (loop.size() < kFewest) {
      return tape_.error(face, ErrorCode::kFormat,
                         "a face of " + counted_as(loop.size(), "vertex", "vertices"),
                         "at least 3 vertices");
    }
    auto polygon = builder_.add(*name + "/" + std::to_string(number), face.offset());
    if (!polygon) return at(mesh, polygon.error());
    (*polygon)->loop = std::move(loop);
    (*polygon)->two_sided = true;
    builder_.put_into_groups({}, "Shade");
  }
  return {};
}

void HoneybeeReader::warn() {
  builder_.warn_of(interior_, "interior surface", "interior surfaces",
                   " left out: what does not face the outdoors neither casts nor receives");
  builder_.warn_of(air_boundaries_, "air boundary", "air boundaries",
                   " left out: there is nothing in them");
  builder_.warn_of(indoor_shades_, "indoor shade", "indoor shades", " left out");
  builder_.warn_of(transmitting_, "shade with a transmittance schedule counts",
                   "shades with a transmittance schedule count", " as opaque");
  if (off_plane_ != 0) {
    const std::string distance = tolerance_.empty() ? Number(farthest_).to_text() : tolerance_;
    builder_.warn(std::to_string(off_plane_) + " of " +
                  counted_as(openings_, "aperture or door", "apertures and doors") +
                  " not exactly in the plane of the face, by up to " + shown_length(farthest_) +
                  " m" +
                  (tolerance_.empty() ? "" : " (the model's tolerance is " + tolerance_ + " m)") +
                  ": what is before the face shades it; 'gnomon convert --snap " + distance +
                  " --parent' puts them into it");
  }
}

}  // namespace gnomon
