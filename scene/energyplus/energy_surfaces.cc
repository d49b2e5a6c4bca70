// SPDX-License-Identifier: LGPL-3.0-or-later
// What the objects of an energy model refer to: rules, axes, zones, surfaces, openings.
#include <algorithm>
#include <charconv>
#include <utility>

#include "scene/energyplus/energy_scene.h"
#include "scene/files/readers.h"
#include "scene/model/decimal_arithmetic.h"

namespace gnomon::energy {

namespace {

constexpr std::size_t kFewestVertices = 3;

bool is_one_of(std::string_view text, std::initializer_list<std::string_view> words) {
  return std::ranges::any_of(words, [&](std::string_view word) { return same_word(text, word); });
}

Expected<bool> is_world_system(const EnergyModel& model, const EnergyField& field) {
  if (field.text.empty() || same_word(field.text, "Relative")) return false;
  if (is_one_of(field.text, {"World", "WCS", "WorldCoordinateSystem", "Absolute"})) return true;
  return model.error(ErrorCode::kFormat, "a coordinate system " + quoted_text(field.text),
                     "Relative or World", field.offset);
}

/// How many vertices an object announces and has. The rest of its fields is not used.
Expected<std::size_t> vertex_count(const EnergyModel& model, const EnergyObject& object) {
  std::size_t there = object.vertices.size();
  while (there > 0 && object.vertices[there - 1].text.empty()) --there;
  const EnergyField& field = object.field("number_of_vertices");
  std::size_t count = (there + 2) / 3;
  if (!field.text.empty() && !same_word(field.text, "autocalculate")) {
    auto announced = model.number(object, "number_of_vertices");
    if (!announced) return tl::unexpected(std::move(announced.error()));
    const mpq_class value = announced->exact();
    if (value.get_den() != 1 || value < 0) {
      return model.error(ErrorCode::kFormat, quoted_text(field.text) + " vertices",
                         "a number of vertices", field.offset);
    }
    if (value * 3 > there) {
      return model.error(ErrorCode::kFormat,
                         quoted_text(object.name()) + " announces " + field.text.substr(0, 40) +
                             " vertices and has " + std::to_string(there) + " coordinates",
                         "three coordinates for each vertex", field.offset);
    }
    count = value.get_num().get_ui();
  } else if (there % 3 != 0) {
    return model.error(
        ErrorCode::kFormat,
        quoted_text(object.name()) + " has " + std::to_string(there) + " coordinates",
        "three coordinates for each vertex", object.offset);
  }
  if (count < kFewestVertices) {
    return model.error(ErrorCode::kFormat,
                       quoted_text(object.name()) + " has " + std::to_string(count) +
                           (count == 1 ? " vertex" : " vertices"),
                       "at least 3 vertices", object.offset);
  }
  return count;
}

}  // namespace

Expected<Rules> read_rules(const EnergyModel& model) {
  const EnergyObject* rules = nullptr;
  for (const EnergyObject& object : model.objects) {
    if (object.type->kind != EnergyKind::kRules) continue;
    if (rules != nullptr) {
      return model.error(ErrorCode::kFormat, "a second GlobalGeometryRules", "one of them",
                         object.offset);
    }
    rules = &object;
  }
  if (rules == nullptr) {
    return model.error(ErrorCode::kFormat, "there is no GlobalGeometryRules",
                       "the direction and the coordinate system of all vertices", 0);
  }
  Rules result;
  const EnergyField& corner = rules->field("starting_vertex_position");
  if (is_one_of(corner.text, {"UpperLeftCorner", "ULC"})) {
    result.first = FirstCorner::kUpperLeft;
  } else if (is_one_of(corner.text, {"LowerLeftCorner", "LLC"})) {
    result.first = FirstCorner::kLowerLeft;
  } else if (is_one_of(corner.text, {"LowerRightCorner", "LRC"})) {
    result.first = FirstCorner::kLowerRight;
  } else if (is_one_of(corner.text, {"UpperRightCorner", "URC"})) {
    result.first = FirstCorner::kUpperRight;
  } else {
    return model.error(ErrorCode::kFormat, "a starting vertex position " + quoted_text(corner.text),
                       "UpperLeftCorner or another corner", corner.offset);
  }
  const EnergyField& direction = rules->field("vertex_entry_direction");
  result.is_clockwise = is_one_of(direction.text, {"Clockwise", "CW"});
  if (!result.is_clockwise && !is_one_of(direction.text, {"Counterclockwise", "CCW"})) {
    return model.error(ErrorCode::kFormat,
                       "a vertex entry direction " + quoted_text(direction.text),
                       "Counterclockwise or Clockwise", direction.offset);
  }
  const auto world = is_world_system(model, rules->field("coordinate_system"));
  if (!world) return tl::unexpected(world.error());
  const auto rectangles =
      is_world_system(model, rules->field("rectangular_surface_coordinate_system"));
  if (!rectangles) return tl::unexpected(rectangles.error());
  result.is_world = *world;
  result.is_rectangle_world = *rectangles;
  return result;
}

Expected<void> EnergyScene::read_axes() {
  bool has_site_shading = false;
  for (const EnergyObject& object : model_.objects) {
    const EnergyKind kind = object.type->kind;
    has_site_shading =
        has_site_shading || kind == EnergyKind::kSiteShading || kind == EnergyKind::kSiteRectangle;
    if (kind == EnergyKind::kRefused) {
      const std::string& rotation = object.fields[0].text;
      const bool is_harmless =
          object.has_field("building_rotation_for_appendix_g") &&
          (rotation.empty() || rotation.find_first_not_of("0.+-") == std::string::npos);
      if (is_harmless) continue;
      return model_.error(ErrorCode::kFormat,
                          std::string(object.type->name) + " is not carried out here",
                          "a file with the vertices that it makes", object.offset);
    }
    if (kind == EnergyKind::kBuilding) {
      auto north = model_.number(object, "north_axis", "0");
      if (!north) return tl::unexpected(std::move(north.error()));
      north_ = *std::move(north);
    }
    if (kind != EnergyKind::kZone) continue;
    Zone zone;
    auto zone_north = model_.number(object, "direction_of_relative_north", "0");
    if (!zone_north) return tl::unexpected(std::move(zone_north.error()));
    zone.north = *std::move(zone_north);
    std::size_t axis = 0;
    for (const char* field : {"x_origin", "y_origin", "z_origin"}) {
      auto coordinate = model_.number(object, field, "0");
      if (!coordinate) return tl::unexpected(std::move(coordinate.error()));
      zone.origin[axis++] = *std::move(coordinate);
    }
    const std::string key = lower_case(object.name());
    zone_angles_.emplace(key, angle_of(zone.north));
    if (!zones_.emplace(key, std::move(zone)).second) {
      return model_.error(ErrorCode::kId, "a second zone " + quoted_text(object.name()),
                          "names that differ", object.offset);
    }
  }
  building_angle_ = angle_of(north_);
  // What the site's shading has to do with the building can be said in the world's axes alone.
  is_turned_ = !options_.keep_axes || has_site_shading;
  return {};
}

/// The vertices of an object, counter-clockwise; the first stays the first.
Expected<std::vector<Position>> EnergyScene::loop_of(const EnergyObject& object) const {
  const auto count = vertex_count(model_, object);
  if (!count) return tl::unexpected(count.error());
  std::vector<Position> loop(*count);
  for (std::size_t i = 0; i < 3 * *count; ++i) {
    const EnergyField& field = object.vertices[i];
    auto number = Number::parse(field.text, NumberMeaning::kDecimal);
    if (!number) {
      return model_.error(number.error().code,
                          field.text.empty() ? "a coordinate is blank" : number.error().what,
                          number.error().expected, field.offset);
    }
    loop[i / 3][i % 3] = *std::move(number);
  }
  if (rules_.is_clockwise) std::reverse(loop.begin() + 1, loop.end());
  return loop;
}

Expected<Surface> EnergyScene::surface_of(const EnergyObject& object) const {
  Surface surface;
  if (object.type->kind == EnergyKind::kInterior) return surface;
  surface.zone = lower_case(object.field("zone_name").text);
  surface.is_rectangle = object.type->kind == EnergyKind::kRectangle;
  if (!surface.is_rectangle) {
    const EnergyField& condition = object.field("outside_boundary_condition");
    if (condition.text.empty()) {
      return model_.error(ErrorCode::kFormat,
                          quoted_text(object.name()) + " has no outside boundary condition",
                          "Outdoors, or another", object.offset);
    }
    surface.sees_the_sun = is_one_of(condition.text, {"Outdoors", "OtherSideConditionsModel"});
    if (!surface.sees_the_sun) return surface;
    auto loop = loop_of(object);
    if (!loop) return tl::unexpected(std::move(loop.error()));
    surface.loop = *std::move(loop);
    surface.frame = wall_frame(surface.loop, rules_.first);
  } else {
    surface.sees_the_sun = true;
    const bool is_roof = object.has_field("width");
    auto frame = frame_of_rectangle(model_, object, is_roof ? "0" : "90");
    if (!frame) return tl::unexpected(std::move(frame.error()));
    auto length = model_.number(object, "length");
    if (!length) return tl::unexpected(std::move(length.error()));
    auto height = model_.number(object, is_roof ? "width" : "height");
    if (!height) return tl::unexpected(std::move(height.error()));
    surface.loop = rectangle(*frame, Number(), Number(), *length, *height);
    surface.frame = *std::move(frame);
  }
  if (!is_world(surface) && !zones_.contains(surface.zone)) {
    return model_.error(ErrorCode::kIndex,
                        "there is no zone " + quoted_text(object.field("zone_name").text),
                        "the name of a zone, whose axes these coordinates are in", object.offset);
  }
  return surface;
}

Expected<WallFrame> frame_of_rectangle(const EnergyModel& model, const EnergyObject& object,
                                       const char* tilt_if_blank) {
  Number values[5];
  std::size_t count = 0;
  for (const char* field : {"azimuth_angle", "tilt_angle", "starting_x_coordinate",
                            "starting_y_coordinate", "starting_z_coordinate"}) {
    auto value = model.number(object, field, count == 1 ? tilt_if_blank : "0");
    if (!value) return tl::unexpected(std::move(value.error()));
    values[count++] = *std::move(value);
  }
  return wall_frame(values[0], values[1], {values[2], values[3], values[4]});
}

Expected<void> EnergyScene::read_surfaces() {
  for (const EnergyObject& object : model_.objects) {
    const EnergyKind kind = object.type->kind;
    if (kind != EnergyKind::kSurface && kind != EnergyKind::kRectangle &&
        kind != EnergyKind::kInterior) {
      continue;
    }
    auto surface = surface_of(object);
    if (!surface && options_.skip_bad) continue;  // listed when its polygon's turn comes
    if (!surface) return tl::unexpected(std::move(surface.error()));
    if (!surfaces_.emplace(lower_case(object.name()), *std::move(surface)).second) {
      return model_.error(ErrorCode::kId, "a second surface " + quoted_text(object.name()),
                          "names that differ", object.offset);
    }
  }
  return {};
}

const Surface* EnergyScene::base_of(const EnergyObject& object, std::string_view field) const {
  const auto found = surfaces_.find(lower_case(object.field(field).text));
  return found == surfaces_.end() ? nullptr : &found->second;
}

Expected<Opening> EnergyScene::opening_of(const EnergyObject& object, const Surface& base) {
  Opening opening;
  opening.base = &base;
  if (object.type->kind == EnergyKind::kWindow) {
    if (is_world(base) != rules_.is_world) {
      return model_.error(ErrorCode::kFormat,
                          quoted_text(object.name()) + " and its surface are in different axes",
                          "the same coordinate system for both kinds of surfaces", object.offset);
    }
    auto loop = loop_of(object);
    if (!loop) return tl::unexpected(std::move(loop.error()));
    opening.loop = *std::move(loop);
    const std::size_t corner = lower_left(rules_.first, opening.loop.size());
    std::rotate(opening.loop.begin(), opening.loop.begin() + static_cast<std::ptrdiff_t>(corner),
                opening.loop.end());
    if (dot(area_vector(opening.loop), area_vector(base.loop)).sign() < 0) {
      ++turned_openings_;
      std::reverse(opening.loop.begin() + 1, opening.loop.end());
    }
    opening.width = length_of(difference(opening.loop[1], opening.loop[0]));
    opening.height = length_of(difference(opening.loop.back(), opening.loop[0]));
    return opening;
  }
  if (!base.frame) {
    return model_.error(ErrorCode::kFormat,
                        quoted_text(object.name()) +
                            " is placed by length and height in a "
                            "horizontal surface, which has no left corner",
                        "FenestrationSurface:Detailed, with vertices", object.offset);
  }
  Number values[4];
  std::size_t count = 0;
  for (const char* field : {"starting_x_coordinate", "starting_z_coordinate", "length", "height"}) {
    auto value = model_.number(object, field, count < 2 ? "0" : nullptr);
    if (!value) return tl::unexpected(std::move(value.error()));
    values[count++] = *std::move(value);
  }
  opening.loop = rectangle(*base.frame, values[0], values[1], values[2], values[3]);
  opening.width = {values[2], base.frame->is_rounded};
  opening.height = {values[3], base.frame->is_rounded};
  return opening;
}

Expected<void> EnergyScene::read_openings() {
  for (const EnergyObject& object : model_.objects) {
    const EnergyKind kind = object.type->kind;
    if (kind != EnergyKind::kWindow && kind != EnergyKind::kRectangularWindow) continue;
    const Surface* const base = base_of(object, "building_surface_name");
    if (base == nullptr || !base->sees_the_sun) continue;  // told of when its polygon's turn comes
    auto opening = opening_of(object, *base);
    if (!opening && options_.skip_bad) continue;
    if (!opening) return tl::unexpected(std::move(opening.error()));
    holes_[lower_case(object.field("building_surface_name").text)].push_back(opening->loop);
    if (!openings_.emplace(lower_case(object.name()), *std::move(opening)).second) {
      return model_.error(ErrorCode::kId, "a second window or door " + quoted_text(object.name()),
                          "names that differ", object.offset);
    }
  }
  return {};
}

}  // namespace gnomon::energy
