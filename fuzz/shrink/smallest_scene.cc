// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/shrink/smallest_scene.h"

#include <array>
#include <set>
#include <string>

#include "fuzz/scene/scene_coordinates.h"
#include "fuzz/scene/scene_steps.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/write.h"
#include "scene/base/text_hash.h"

namespace gnomon::fuzz {

namespace {

std::uint64_t repairs_of(const PreparedScene& prepared) {
  return static_cast<std::uint64_t>(
      std::ranges::count_if(prepared.notes, [](const PreparationNote& note) {
        return note.repair == Repair::kNotPlanar || note.repair == Repair::kNotConvex;
      }));
}

/// The size without `repairs`, which only prepare() knows.
SceneSize size_unprepared(const Scene& scene) {
  SceneSize size;
  size.polygons = scene.polygons.size();
  size.lights = scene.lights.size();
  size.vertices = scene.vertices.size();
  size.flags = flags_of(scene);
  size.names = long_names_of(scene);
  for (const Polygon& polygon : scene.polygons) {
    size.holes += polygon.holes.size();
    size.corners += polygon.loop.size();
    for (const auto& hole : polygon.holes) size.corners += hole.size();
  }
  for (const Light& light : scene.lights) size.corners += light.loop.size();
  std::array<std::set<std::pair<std::string, bool>>, kAxes> distinct;
  for (const Position* position : points_of(scene)) {
    for (std::size_t axis = 0; axis < kAxes; ++axis) {
      const Number& number = (*position)[axis];
      size.bits += bits_of(number);
      distinct[axis].emplace(number.to_text(), number.is_decimal());
    }
  }
  for (const auto& values : distinct) size.values += values.size();
  return size;
}

}  // namespace

SceneSize size_of(const Scene& scene) {
  SceneSize size = size_unprepared(scene);
  if (const auto prepared = prepare(scene)) size.repairs = repairs_of(*prepared);
  return size;
}

SmallestScene::SmallestScene(Scene scene, const StillFails& fails, const ShrinkOptions& options)
    : fails_(fails),
      options_(options),
      start_(Clock::now()),
      best_(std::move(scene)),
      range_(options.range_of != nullptr ? *options.range_of : best_) {
  for (const std::string_view name :
       {"moves", "tidying", "polygons", "lights", "holes", "corners", "flags", "vertices", "scene",
        "axes", "values", "points", "coordinates", "names"}) {
    result_.passes.push_back({name});
  }
  result_.before = size_of(best_);
  size_ = result_.before;
}

bool SmallestScene::out_of_time() const {
  if (options_.interrupted != nullptr && *options_.interrupted) return true;
  if (options_.most_tries != 0 && result_.tries >= options_.most_tries) return true;
  if (options_.seconds <= 0) return false;
  return std::chrono::duration<double>(Clock::now() - start_).count() >= options_.seconds;
}

bool SmallestScene::is_in_range(const Scene& scene) const {
  return options_.free_range || range_.holds(scene);
}

bool SmallestScene::attempt(Scene candidate, bool any_size) {
  if (stopped_) return false;
  SceneSize size = size_unprepared(candidate);
  if (!any_size && !(size < size_ && is_in_range(candidate))) return false;
  const auto text = scene_to_text(candidate, SceneFormat::kJson);
  if (!text) return false;  // a decimal of too many digits
  if (!tried_.insert(text_hash(text->text)).second) {
    ++result_.repeated;
    return false;
  }
  const auto prepared = prepare(candidate);
  if (!prepared) {
    ++result_.refused;
    return false;
  }
  size.repairs = repairs_of(*prepared);
  if (!any_size && !(size < size_)) return false;
  if (out_of_time()) {
    stopped_ = true;
    return false;
  }
  ++result_.tries;
  ++pass_->tries;
  const bool improved = fails_(candidate);
  if (improved) {
    ++result_.accepted;
    ++pass_->accepted;
    best_ = std::move(candidate);
    size_ = size;
    if (any_size) range_ = CoordinateRange(best_);
  }
  if (options_.progress) {
    options_.progress({best_, size_, pass_->name, result_.tries, result_.accepted, improved});
  }
  return improved;
}

bool SmallestScene::attempt_tidy(Scene candidate) {
  Scene tidy = tidied(candidate);
  return attempt(std::move(tidy)) || attempt(std::move(candidate));
}

ShrinkResult SmallestScene::take_result(std::uint64_t rounds, bool locally_minimal) {
  result_.rounds = rounds;
  result_.locally_minimal = locally_minimal;
  result_.scene = std::move(best_);
  result_.after = size_;
  return std::move(result_);
}

}  // namespace gnomon::fuzz
