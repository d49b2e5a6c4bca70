// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/kinds/scene_view.h"

#include <array>
#include <span>
#include <utility>

#include "fuzz/scene/scene_coordinates.h"

namespace gnomon::fuzz {

namespace {

/// All positions of polygons and lights on one grid. `take` gives them back in the order in which
/// they were added.
class CommonGrid {
 public:
  void add(const Position& position) {
    for (const Number& number : position) numbers_.push_back(&number);
  }
  void build(NumberMeaning meaning) { grid_ = on_grid(numbers_, meaning); }
  Integers take() {
    next_ += 3;
    return {grid_.values[next_ - 3], grid_.values[next_ - 2], grid_.values[next_ - 1]};
  }
  Loop take(std::size_t count) {
    Loop loop;
    for (std::size_t i = 0; i < count; ++i) loop.push_back(take());
    return loop;
  }

 private:
  std::vector<const Number*> numbers_;
  GridValues grid_;
  std::size_t next_ = 0;
};

CommonGrid grid_of(const Scene& scene) {
  CommonGrid grid;
  for (const Polygon& polygon : scene.polygons) {
    for (const VertexId v : polygon.loop) grid.add(scene.vertices[v]);
  }
  for (const Light& light : scene.lights) {
    if (light.is_point()) grid.add(light.position);
    for (const Position& corner : light.loop) grid.add(corner);
  }
  grid.build(scene.numbers);
  return grid;
}

/// A direction needs no common grid: only its ratios matter.
Apex apex_at_infinity(const Light& light, NumberMeaning meaning) {
  CommonGrid grid;
  grid.add(light.position);
  grid.build(meaning);
  return {grid.take(), 0};
}

}  // namespace

SceneView::SceneView(const Scene& of) : scene(of) {
  CommonGrid grid = grid_of(of);
  for (const Polygon& polygon : of.polygons) {
    Loop loop = grid.take(polygon.loop.size());
    corners.insert(corners.end(), loop.begin(), loop.end());
    faces.push_back(face_of(std::move(loop), !polygon.holes.empty()));
  }
  for (const Light& light : of.lights) {
    if (light.is_point()) apexes.push_back({grid.take(), 1});
    if (light.has_area()) {
      panels.push_back(face_of(grid.take(light.loop.size()), false));
    }
  }
  for (const Light& light : of.lights) {
    if (!light.is_directional()) continue;
    apexes.push_back(apex_at_infinity(light, of.numbers));
  }
  if (!corners.empty()) extent = extent_of(corners);
}

}  // namespace gnomon::fuzz
