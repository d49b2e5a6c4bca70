// SPDX-License-Identifier: GPL-3.0-or-later
// How far a point of a polygon is from where light and shadow of a point or directional light meet,
// and whether a point of the other class is within a width of it.
//
// Exactness: the distance is a lower bound, computed in doubles (on the scene's grid, so that what
// is lost is next to nothing of the scene's size, wherever it lies): the lines in which the planes
// of a shadow (point_regions.h) meet the polygon's plane. That a point of the other class is near
// is proved by one that is decided exactly; where none is found, none is claimed.
#ifndef GNOMON_ORACLE_JUDGE_NEAR_BORDER_H
#define GNOMON_ORACLE_JUDGE_NEAR_BORDER_H

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "gnomon/result/claims.h"
#include "oracle/visibility/point_sight.h"

namespace gnomon::oracle {

/// Steps in a polygon's plane: exact points at given distances from one of its points.
class PlaneSteps {
 public:
  PlaneSteps(const PreparedScene& scene, std::uint32_t part);

  /// `x`, `y`: scene units, along two axes of the plane.
  RationalPoint from(const RationalPoint& point, double x, double y) const;
  /// A vector of the grid along the two axes.
  std::array<double, 2> along_axes(const std::array<double, 3>& vector) const;
  double step() const { return step_; }

 private:
  std::array<RationalPoint, 2> axes_;  // scene units
  std::array<std::array<double, 3>, 2> unit_{};
  std::array<double, 2> lengths_{};  // of the axes
  double step_ = 1;                  // of the grid
};

struct BorderDistance {
  double at_least = 0;                  // scene units; infinite if nothing casts
  std::optional<std::uint32_t> caster;  // of that border
  bool within = false;                  // a point of the other class is within the width
};

/// `is_other`: whether a point of the polygon's plane is of the other class.
/// Cost: for a lit point all casters, in doubles.
BorderDistance distance_from_border(const PointSight& sight, std::uint32_t part,
                                    const RationalPoint& point, bool is_lit, double width,
                                    const std::function<bool(const RationalPoint&)>& is_other);

/// Exact points of a part's plane all around a point, the farthest a little less than a width away.
std::vector<RationalPoint> points_around(const PlaneSteps& steps, const RationalPoint& point,
                                         double width);

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_JUDGE_NEAR_BORDER_H
