// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/building/uncut_openings.h"

#include <utility>

#include "gnomon/scene/unusable.h"

namespace gnomon {

namespace {

/// A scene of one polygon, with the vertices of its rings alone.
class LonePolygon {
 public:
  LonePolygon(const Scene& scene, const Polygon& polygon) : from_(scene) {
    alone_.numbers = scene.numbers;
    Polygon& copy = alone_.polygons.emplace_back();
    copy.id = polygon.id;
    copy.loop = taken_over(polygon.loop);
  }

  void add_hole(const std::vector<VertexId>& hole) {
    alone_.polygons.front().holes.push_back(taken_over(hole));
  }
  void take_hole_back() { alone_.polygons.front().holes.pop_back(); }

  Expected<bool> is_usable() const {
    const auto problems = unusable_polygons(alone_);
    if (!problems) return tl::unexpected(problems.error());
    return problems->empty();
  }

 private:
  std::vector<VertexId> taken_over(const std::vector<VertexId>& ring) {
    std::vector<VertexId> ids;
    for (const VertexId vertex : ring) {
      ids.push_back(static_cast<VertexId>(alone_.vertices.size()));
      alone_.vertices.push_back(from_.vertices[vertex]);
    }
    return ids;
  }

  const Scene& from_;
  Scene alone_;
};

}  // namespace

Expected<std::vector<std::size_t>> unusable_holes(const Scene& scene, const Polygon& polygon) {
  std::vector<std::size_t> unusable;
  if (polygon.holes.empty()) return unusable;
  LonePolygon whole(scene, polygon);
  for (const std::vector<VertexId>& hole : polygon.holes) whole.add_hole(hole);
  auto usable = whole.is_usable();
  if (!usable) return tl::unexpected(std::move(usable.error()));
  if (*usable) return unusable;
  LonePolygon tried(scene, polygon);
  usable = tried.is_usable();
  if (!usable) return tl::unexpected(std::move(usable.error()));
  if (!*usable) return unusable;
  for (std::size_t i = 0; i < polygon.holes.size(); ++i) {
    tried.add_hole(polygon.holes[i]);
    usable = tried.is_usable();
    if (!usable) return tl::unexpected(std::move(usable.error()));
    if (*usable) continue;
    unusable.push_back(i);
    tried.take_hole_back();
  }
  return unusable;
}

}  // namespace gnomon
