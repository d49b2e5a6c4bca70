// SPDX-License-Identifier: LGPL-3.0-or-later
// How many facing polygons a loop has on its left, and whether it goes round them or round light.
#ifndef GNOMON_ALGORITHMS_RIDGE_EDGES_LOOP_DEPTH_H
#define GNOMON_ALGORITHMS_RIDGE_EDGES_LOOP_DEPTH_H

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "algorithms/ridge_edges/light_directions.h"
#include "gnomon/kernel/sign.h"
#include "gnomon/scene/prepare.h"
#include "scene/geometry/box_tree.h"

namespace gnomon {

/// The facing parts of a component as cones of directions.
class FacingCones {
 public:
  FacingCones(const PreparedScene& scene, std::span<const std::uint32_t> parts,
              std::span<const Side> facing, std::span<const FilteredVector> directions);

  /// How many hold the directions just left of the middle of a stretch between two rays.
  std::uint32_t depth_left_of(const DirectionVector& from, const DirectionVector& to) const;
  std::size_t size() const { return starts_.size() - 1; }

 private:
  bool holds(std::uint32_t cone, const FilteredVector& middle, const FilteredVector& left,
             const FilteredVector& ahead) const;

  std::vector<FilteredVector> normals_;  // of the planes through light and edges, inwards
  std::vector<std::uint32_t> starts_{0};
  std::optional<scene_detail::BoxTree> tree_;  // of the cones on the unit sphere
};

/// Whether a loop of rays is counter-clockwise as the light sees it, that is, goes round less than
/// half of all directions on its left.
bool is_counter_clockwise(std::span<const DirectionVector* const> loop);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_RIDGE_EDGES_LOOP_DEPTH_H
