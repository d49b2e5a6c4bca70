// SPDX-License-Identifier: LGPL-3.0-or-later
// Snapping: vertices that are all but one become one, and polygons that are all but in one plane
// come to lie in it, exactly. Rounds of both until nothing moves any more.
//
// A plane is that of the largest of its polygons that is planar as it stands, whose vertices stay;
// the others' move to points of that plane which a file can hold (rational_space.h), and stay in
// the planes of all planar polygons that have them too. What cannot be done stays as it is, and
// what would fold a polygon is taken back.
#ifndef GNOMON_SCENE_REPAIR_SNAP_H
#define GNOMON_SCENE_REPAIR_SNAP_H

#include <set>

#include "gnomon/scene/repair.h"
#include "scene/intent/local_points.h"
#include "scene/repair/rational_space.h"

namespace gnomon::scene_detail {

/// A scene in one round: prepared, with what stands where in exact numbers.
class SnapRound {
 public:
  SnapRound(const Scene& scene, PreparedScene prepared);
  SnapRound(const SnapRound&) = delete;
  SnapRound& operator=(const SnapRound&) = delete;

  const Scene& scene() const { return scene_; }
  const PreparedScene& prepared() const { return prepared_; }
  const LocalPoints& points() const { return points_; }

  /// Where the vertex is now, moves of this round included.
  const RationalPoint& at(VertexId vertex);
  void move(VertexId vertex, RationalPoint to) { position_[vertex] = std::move(to); }
  /// The vertices of the scene that are this one.
  std::span<const std::uint32_t> inputs(VertexId vertex) const {
    return {inputs_.data() + first_input_[vertex], first_input_[vertex + 1] - first_input_[vertex]};
  }
  /// Distinct vertices of the loop and the holes.
  std::vector<VertexId> outline(std::uint32_t polygon) const;
  std::span<const std::uint32_t> polygons_at(VertexId vertex) const {
    return {polygons_.data() + first_polygon_[vertex],
            first_polygon_[vertex + 1] - first_polygon_[vertex]};
  }
  /// The plane that holds all of the polygon, as it is now; nothing if it is bent or was dropped.
  std::optional<RationalPlane> plane_of(std::uint32_t polygon);

 private:
  const Scene& scene_;
  PreparedScene prepared_;
  LocalPoints points_;
  std::vector<std::uint32_t> first_input_, inputs_, first_polygon_, polygons_;
  std::vector<std::optional<RationalPoint>> position_;
};

/// Moves the vertices of polygons that are nearer than `distance` to one plane into it; returns how
/// many planes were made one. `pinned`: vertices of the scene that stay.
std::size_t flatten_planes(SnapRound& round, const mpq_class& distance,
                           const std::set<std::uint32_t>& pinned);

/// Snaps the scene. Errors: those of prepare().
Expected<SnapReport> snap(Scene& scene, const mpq_class& distance);

}  // namespace gnomon::scene_detail

#endif  // GNOMON_SCENE_REPAIR_SNAP_H
