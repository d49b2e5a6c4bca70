// SPDX-License-Identifier: LGPL-3.0-or-later
// Polygons of an energy model, in the order of the file.
#include "scene/energyplus/energy_scene.h"

#include <algorithm>
#include <utility>

#include "scene/files/readers.h"
#include "scene/files/usable_id.h"
#include "scene/model/decimal_arithmetic.h"

namespace gnomon::energy {

namespace {

/// (x, y) clockwise by the angle, z as it is.
Position turned(const Position& a, const Angle& angle) {
  return {
      decimal_sum(decimal_product(a[0], angle.cosine), decimal_product(a[1], angle.sine)),
      decimal_difference(decimal_product(a[1], angle.cosine), decimal_product(a[0], angle.sine)),
      a[2]};
}

/// What a surface or an opening is, in EnergyPlus' words, whatever class it was written as.
std::string kind_of(const EnergyObject& object) {
  constexpr std::string_view kWords[] = {"Wall",   "Roof", "Ceiling",   "Floor",
                                         "Window", "Door", "GlassDoor", "TubularDaylightDome"};
  if (object.has_field("surface_type")) {
    const std::string& type = object.field("surface_type").text;
    for (const std::string_view word : kWords) {
      if (same_word(type, word)) return std::string(word);
    }
    return usable_text(type);
  }
  const std::string_view name = object.type->name;
  if (name.starts_with("GlazedDoor")) return "GlassDoor";
  for (const std::string_view word : kWords) {
    if (name.starts_with(word)) return std::string(word);
  }
  return "Surface";
}

}  // namespace

EnergyScene::EnergyScene(const EnergyModel& model, const ReadOptions& options)
    : model_(model), options_(options) {
  scene_.file = model.file;
  scene_.name = name_from_file(model.file);
  scene_.numbers = options.numbers.value_or(NumberMeaning::kDecimal);
}

Expected<ReadResult> EnergyScene::build() {
  auto rules = read_rules(model_);
  if (!rules) return tl::unexpected(std::move(rules.error()));
  rules_ = *std::move(rules);
  for (const auto step :
       {&EnergyScene::read_axes, &EnergyScene::read_surfaces, &EnergyScene::read_openings}) {
    if (auto done = (this->*step)(); !done) return tl::unexpected(std::move(done.error()));
  }
  for (const EnergyObject& object : model_.objects) {
    const std::size_t before = scene_.polygons.size();
    auto done = add(object);
    if (done) continue;
    if (!options_.skip_bad || done.error().code == ErrorCode::kId) {
      return tl::unexpected(std::move(done.error()));
    }
    scene_.polygons.resize(before);
    offsets_.resize(before);
    problems_.push_back({static_cast<std::uint32_t>(before), std::move(done.error())});
    scene_.polygons.emplace_back().id = usable_id(object.name());
    offsets_.push_back(object.offset);
  }
  ReadResult result;
  finish(result);
  return result;
}

Expected<void> EnergyScene::add(const EnergyObject& object) {
  switch (object.type->kind) {
    case EnergyKind::kSurface:
    case EnergyKind::kRectangle:
    case EnergyKind::kInterior:
      return add_surface(object);
    case EnergyKind::kWindow:
    case EnergyKind::kRectangularWindow:
      return add_opening(object);
    case EnergyKind::kSiteShading:
    case EnergyKind::kBuildingShading:
      return add_detached(object);
    case EnergyKind::kZoneShading:
      return add_attached(object);
    case EnergyKind::kSiteRectangle:
    case EnergyKind::kBuildingRectangle:
      return add_detached_rectangle(object);
    case EnergyKind::kOverhang:
      return add_overhang(object);
    case EnergyKind::kFin:
      return add_fins(object);
    default:
      return {};
  }
}

// ----------------------------------------------------------------------------- vertices and groups

Expected<std::vector<VertexId>> EnergyScene::vertices_of(const EnergyObject& object,
                                                         const std::vector<Position>& loop,
                                                         const Axes& axes) {
  std::vector<VertexId> ids;
  for (Position position : loop) {
    if (axes.zone != nullptr) {
      position = sum(turned(position, zone_angles_.at(*axes.zone)), zones_.at(*axes.zone).origin);
    }
    if (axes.of_building && is_turned_) position = turned(position, building_angle_);
    std::string key;
    for (Number& coordinate : position) {
      bool underflow = false;
      auto number = as_meant(std::move(coordinate), scene_.numbers, underflow);
      if (!number) {
        return model_.error(number.error().code, number.error().what, number.error().expected,
                            object.offset);
      }
      if (underflow) ++underflows_;
      coordinate = *std::move(number);
      key += coordinate.to_text() + " ";
    }
    const auto [place, is_new] =
        vertex_index_.try_emplace(key, static_cast<VertexId>(scene_.vertices.size()));
    if (is_new) scene_.vertices.push_back(std::move(position));
    ids.push_back(place->second);
  }
  return ids;
}

Expected<Polygon*> EnergyScene::add_polygon(const EnergyObject& object, const std::string& name,
                                            const std::vector<Position>& loop, const Axes& axes) {
  const std::string id = usable_id(name);
  if (id.empty()) {
    return model_.error(ErrorCode::kId, "a surface without a name", "a name", object.offset);
  }
  const auto number = static_cast<std::uint32_t>(scene_.polygons.size());
  if (!polygon_index_.emplace(lower_case(id), number).second) {
    return model_.error(ErrorCode::kId, "a second surface " + quoted_text(name),
                        "names that differ", object.offset);
  }
  auto vertices = vertices_of(object, loop, axes);
  if (!vertices) return tl::unexpected(std::move(vertices.error()));
  Polygon& polygon = scene_.polygons.emplace_back();
  polygon.id = id;
  polygon.loop.assign(vertices->begin(), vertices->end());
  offsets_.push_back(object.offset);
  return &polygon;
}

/// The last polygon.
void EnergyScene::put_into_groups(const std::string& zone, const std::string& kind) {
  const auto polygon = static_cast<std::uint32_t>(scene_.polygons.size() - 1);
  // A zone's name may be written in several ways.
  if (!zone.empty()) zone_groups_.add(usable_text(lower_case(zone)), polygon);
  kind_groups_.add(kind, polygon);
}

// ---------------------------------------------------------------------------- surfaces and
// openings

Expected<void> EnergyScene::add_surface(const EnergyObject& object) {
  const auto found = surfaces_.find(lower_case(object.name()));
  if (found == surfaces_.end()) return tl::unexpected(surface_of(object).error());
  const Surface& surface = found->second;
  if (!surface.sees_the_sun) {
    ++interior_;
    return {};
  }
  const Axes axes = axes_of(surface);
  auto polygon = add_polygon(object, object.name(), surface.loop, axes);
  if (!polygon) return tl::unexpected(std::move(polygon.error()));
  for (const std::vector<Position>& hole : holes_[found->first]) {
    auto vertices = vertices_of(object, hole, axes);
    if (!vertices) return tl::unexpected(std::move(vertices.error()));
    (*polygon)->holes.push_back(*std::move(vertices));
  }
  if (surface.is_rectangle && surface.frame->is_rounded) rounded_.push_back((*polygon)->id);
  if (object.has_field("sun_exposure") && same_word(object.field("sun_exposure").text, "NoSun")) {
    ++unexposed_;
  }
  put_into_groups(object.field("zone_name").text, kind_of(object));
  return {};
}

Expected<void> EnergyScene::add_opening(const EnergyObject& object) {
  const EnergyField& name = object.field("building_surface_name");
  const Surface* const base = base_of(object, "building_surface_name");
  if (base == nullptr) {
    return model_.error(ErrorCode::kIndex, "there is no surface " + quoted_text(name.text),
                        "the name of a wall, roof or floor", object.offset);
  }
  if (!base->sees_the_sun) {
    ++interior_;
    return {};
  }
  const auto found = openings_.find(lower_case(object.name()));
  if (found == openings_.end()) return tl::unexpected(opening_of(object, *base).error());
  auto polygon = add_polygon(object, object.name(), found->second.loop, axes_of(*base));
  if (!polygon) return tl::unexpected(std::move(polygon.error()));
  if (object.type->kind == EnergyKind::kRectangularWindow && base->frame->is_rounded) {
    rounded_.push_back((*polygon)->id);
  }
  const auto multiplier = model_.number(object, "multiplier", "1");
  if (multiplier && multiplier->exact() > 1) ++multiplied_;
  put_into_groups(base->zone, kind_of(object));
  return {};
}

// ------------------------------------------------------------------------------------------
// shading

Expected<void> EnergyScene::add_shade(const EnergyObject& object, const std::string& name,
                                      const std::vector<Position>& loop, const Axes& axes) {
  auto polygon = add_polygon(object, name, loop, axes);
  if (!polygon) return tl::unexpected(std::move(polygon.error()));
  (*polygon)->two_sided = true;
  put_into_groups({}, "Shading");
  return {};
}

void EnergyScene::note_schedule(const EnergyObject& object) {
  const std::string& schedule = object.field("transmittance_schedule_name").text;
  if (!schedule.empty()) ++schedules_[usable_id(schedule)];
}

Expected<void> EnergyScene::add_detached(const EnergyObject& object) {
  const auto loop = loop_of(object);
  if (!loop) return tl::unexpected(loop.error());
  const bool is_of_building = object.type->kind == EnergyKind::kBuildingShading;
  auto done =
      add_shade(object, object.name(), *loop, {nullptr, is_of_building && !rules_.is_world});
  if (done) note_schedule(object);
  return done;
}

Expected<void> EnergyScene::add_attached(const EnergyObject& object) {
  const auto loop = loop_of(object);
  if (!loop) return tl::unexpected(loop.error());
  const std::string& name = object.field("base_surface_name").text;
  const Surface* base = base_of(object, "base_surface_name");
  if (base == nullptr) {
    const auto opening = openings_.find(lower_case(name));
    if (opening != openings_.end()) base = opening->second.base;
  }
  if (base == nullptr || (!rules_.is_world && !zones_.contains(base->zone))) {
    return model_.error(ErrorCode::kIndex, "there is no surface " + quoted_text(name),
                        "the name of a surface, in whose zone it is", object.offset);
  }
  auto done =
      add_shade(object, object.name(), *loop, rules_.is_world ? Axes{} : Axes{&base->zone, true});
  if (done) note_schedule(object);
  return done;
}

Expected<void> EnergyScene::add_detached_rectangle(const EnergyObject& object) {
  const bool is_of_building = object.type->kind == EnergyKind::kBuildingRectangle;
  if (is_of_building && rules_.is_world != rules_.is_rectangle_world) {
    return model_.error(ErrorCode::kFormat,
                        "Shading:Building where the two coordinate systems differ",
                        "Shading:Building:Detailed, with vertices", object.offset);
  }
  const auto frame = frame_of_rectangle(model_, object, "90");
  if (!frame) return tl::unexpected(frame.error());
  const auto length = model_.number(object, "length");
  if (!length) return tl::unexpected(length.error());
  const auto height = model_.number(object, "height");
  if (!height) return tl::unexpected(height.error());
  auto done =
      add_shade(object, object.name(), rectangle(*frame, Number(), Number(), *length, *height),
                {nullptr, is_of_building && !rules_.is_rectangle_world});
  if (done && frame->is_rounded) rounded_.push_back(scene_.polygons.back().id);
  return done;
}

}  // namespace gnomon::energy
