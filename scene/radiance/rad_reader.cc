// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/radiance/rad_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "scene/base/text_file.h"
#include "scene/files/usable_id.h"
#include "scene/radiance/seams.h"

namespace gnomon {

namespace {

constexpr std::size_t kMostPolygons = 50'000'000;

template <std::size_t count>
bool is_one_of(std::string_view word, const std::string_view (&words)[count]) {
  return std::find(std::begin(words), std::end(words), word) != std::end(words);
}

constexpr std::string_view kSurfaces[] = {"sphere", "bubble", "cone",     "cup", "cylinder",
                                          "tube",   "ring",   "instance", "mesh"};
constexpr std::string_view kSeenThrough[] = {"glass",    "dielectric", "interface", "trans",
                                             "trans2",   "transfunc",  "transdata", "mist",
                                             "BTDFfunc", "prism1",     "prism2"};
/// Patterns and textures: the material is what they modify.
constexpr std::string_view kPatterns[] = {
    "texfunc",   "texdata",   "brightfunc", "brightdata", "brighttext", "colorfunc", "colordata",
    "colorpict", "colortext", "specfunc",   "specdata",   "specfile",   "specpict",  "spectrum"};

}  // namespace

RadReader::RadReader(const std::string& text, const std::string& file, const ReadOptions& options)
    : builder_(file, options, NumberMeaning::kDecimal) {
  // The text outlives the reader: it is not copied.
  open_.push_back({std::shared_ptr<const std::string>(std::shared_ptr<void>(), &text),
                   file,
                   byte_order_mark(text),
                   {},
                   {},
                   {},
                   0,
                   0});
}

RadReader::Matter RadReader::matter_of(const std::string& modifier) {
  if (modifier == "void") return Matter::kNothing;
  const auto found = modifiers_.find(modifier);
  return found == modifiers_.end() ? Matter::kOpaque : found->second;
}

Expected<void> RadReader::define(Primitive given) {
  const bool is_surface = given.type == "polygon" || given.type == "source";
  if (is_surface && !here().modifier.empty()) given.modifier = here().modifier;
  if (given.type == "polygon") return add_polygon(given);
  if (given.type == "source") return add_source(given);
  if (is_one_of(given.type, kSurfaces)) {
    ++left_out_[given.type];
    return {};
  }
  Matter matter = Matter::kOpaque;
  if (given.type == "alias") {
    matter = matter_of(given.reals[0].text);
  } else if (is_one_of(given.type, kPatterns)) {
    matter = matter_of(given.modifier);
  } else if (is_one_of(given.type, kSeenThrough)) {
    matter = Matter::kSeenThrough;
  } else if (given.type == "light") {
    matter = Matter::kLamp;
  } else if (given.type == "glow") {
    // Beyond the radius it lights nothing; with 0 it is only seen.
    constexpr std::size_t kRadius = 3;
    matter = Matter::kLamp;
    if (given.reals.size() > kRadius) {
      const auto radius = Number::parse(given.reals[kRadius].text, NumberMeaning::kDecimal);
      if (radius && radius->is_zero()) matter = Matter::kOpaque;
    }
  } else if (given.type == "illum" || given.type == "spotlight") {
    matter = Matter::kOtherLamp;
  } else if (given.type == "antimatter") {
    matter = Matter::kNothing;
  }
  modifiers_[given.name] = matter;
  return {};
}

Expected<Position> RadReader::position(const Primitive& primitive, std::size_t first) {
  Position result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Word& word = primitive.reals[first + axis];
    auto number = Number::parse(word.text, NumberMeaning::kDecimal);
    if (!number) {
      return error(number.error().code, number.error().what, number.error().expected, word.offset);
    }
    result[axis] = *std::move(number);
  }
  return result;
}

std::string RadReader::light_id(const std::string& name) {
  std::string id = usable_id(here().prefix + name);
  if (id.empty()) id = "light";
  for (std::string free = id;; free = id + "/" + std::to_string(++light_names_[id])) {
    if (light_names_.try_emplace(free, 0).second) return free;
  }
}

Expected<void> RadReader::add_source(const Primitive& source) {
  constexpr std::size_t kReals = 4;
  if (source.reals.size() != kReals) {
    return error(ErrorCode::kFormat,
                 "a source of " + std::to_string(source.reals.size()) + " reals",
                 "a direction and an angle: 4", source.offset);
  }
  const auto direction = position(source, 0);
  if (!direction) return tl::unexpected(direction.error());
  const auto angle = Number::parse(source.reals[3].text, NumberMeaning::kDecimal);
  if (!angle) {
    return error(angle.error().code, angle.error().what, angle.error().expected,
                 source.reals[3].offset);
  }
  if (matter_of(source.modifier) != Matter::kLamp || angle->exact() > 90) {
    ++skies_;
    return {};
  }
  auto to_light = builder_.as_meant(here().transform.apply_to_direction(*direction));
  if (!to_light) {
    return error(to_light.error().code, to_light.error().what, to_light.error().expected,
                 source.offset);
  }
  if ((*to_light)[0].is_zero() && (*to_light)[1].is_zero() && (*to_light)[2].is_zero()) {
    return error(ErrorCode::kGeometry, "the direction of a source is 0 0 0",
                 "a vector that is not 0", source.offset);
  }
  Light light;
  light.id = light_id(source.name);
  light.type = LightType::kDirectional;
  light.position = *std::move(to_light);
  builder_.scene().lights.push_back(std::move(light));
  if (!angle->is_zero()) ++discs_;
  return {};
}

Expected<std::vector<Position>> RadReader::corners(const Primitive& polygon) {
  constexpr std::size_t kFewest = 9;
  if (polygon.reals.size() < kFewest || polygon.reals.size() % 3 != 0) {
    return error(ErrorCode::kFormat,
                 "a polygon of " + counted_as(polygon.reals.size(), "real", "reals"),
                 "three for each vertex, and at least 3 vertices", polygon.offset);
  }
  std::vector<Position> result;
  for (std::size_t i = 0; i < polygon.reals.size(); i += 3) {
    auto corner = position(polygon, i);
    if (!corner) return tl::unexpected(std::move(corner.error()));
    result.push_back(here().transform.apply(*corner));
  }
  if (here().transform.mirrors()) std::reverse(result.begin(), result.end());
  return result;
}

/// It emits from its front, and casts nothing: a light is no polygon.
Expected<void> RadReader::add_lamp(const Primitive& lamp, const std::vector<Position>& corners) {
  Light light;
  light.type = LightType::kArea;
  for (const Position& corner : corners) {
    auto position = builder_.as_meant(corner);
    if (!position) {
      return error(position.error().code, position.error().what, position.error().expected,
                   lamp.offset);
    }
    light.loop.push_back(*std::move(position));
  }
  light.id = light_id(lamp.name);
  builder_.scene().lights.push_back(std::move(light));
  return {};
}

Expected<void> RadReader::add_polygon(const Primitive& polygon) {
  const Matter matter = matter_of(polygon.modifier);
  if (matter == Matter::kNothing || matter == Matter::kOtherLamp) {
    ++(matter == Matter::kNothing ? nothing_ : other_lamps_);
    return {};
  }
  const std::size_t offset = here().depth == 0 ? polygon.offset : here().main_offset;
  std::string id = usable_id(here().prefix + polygon.name);
  if (id.empty()) id = "polygon";
  const auto add = [&]() -> Expected<void> {
    const auto positions = corners(polygon);
    if (!positions) return tl::unexpected(positions.error());
    if (matter == Matter::kLamp) return add_lamp(polygon, *positions);
    if (builder_.polygon_count() >= kMostPolygons) {
      return error(ErrorCode::kLimit, "too many polygons, of all files together",
                   "at most 50 millions", polygon.offset);
    }
    auto loop = builder_.vertices(*positions);
    if (!loop) {
      return error(loop.error().code, loop.error().what, loop.error().expected, polygon.offset);
    }
    LoopWithHoles parts = without_seams(builder_.scene(), *std::move(loop));
    Polygon& added = builder_.add_renamed(id, offset);
    added.loop = std::move(parts.loop);
    added.holes = std::move(parts.holes);
    builder_.put_into_groups(usable_text(polygon.modifier), {});
    if (matter == Matter::kSeenThrough) ++seen_through_;
    if (!modifiers_.contains(polygon.modifier)) ++undefined_;
    return {};
  };
  auto done = add();
  if (done || !builder_.skips_bad() || done.error().code == ErrorCode::kLimit) return done;
  builder_.add_bad(id, offset, std::move(done.error()));
  return {};
}

void RadReader::warn() {
  if (!commands_.empty()) {
    std::size_t count = 0;
    std::string names;
    for (const auto& [name, times] : commands_) {
      count += times;
      names += (names.empty() ? "" : ", ") + (name.empty() ? "nothing" : name);
    }
    builder_.warn(counted_as(count, "command is", "commands are") + " not run (" + names +
                  "), and what it would write is missing: 'xform -e FILE' writes a file without "
                  "commands");
  }
  for (const auto& [type, count] : left_out_) {
    builder_.warn(counted_as(count, "surface", "surfaces") + " of type " + type +
                  " left out: only polygons are flat");
  }
  builder_.warn_of(
      seen_through_, "polygon of glass or another material that lets light through counts",
      "polygons of glass or other materials that let light through count", " as opaque");
  builder_.warn_of(undefined_, "polygon has a modifier", "polygons have modifiers",
                   " that no file here defines: opaque");
  builder_.warn_of(nothing_, "polygon", "polygons", " of void or antimatter left out");
  builder_.warn_of(other_lamps_, "polygon", "polygons", " of illum or spotlight left out");
  builder_.warn_of(skies_, "source", "sources",
                   " left out: no light, or wider than half of the sky");
  builder_.warn_of(discs_, "source is", "sources are",
                   " taken as a direction: the angle of the disc does not count");
  if (turned_ != 0) {
    builder_.warn(
        fmt::format("{} turned by angles with a cosine and a sine of 12 digits: up to "
                    "{:.1g} degrees off, lengths by {:.1g} of themselves",
                    counted_as(turned_, "file is", "files are"), error_, stretch_));
  }
}

}  // namespace gnomon
