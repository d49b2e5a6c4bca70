// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a point or directional light is seen from many points, each decided exactly: the test of
// visibility.h, asked of those casters alone that a raster finds before the point and doubles with
// a certified error do not decide.
//
// Exactness: exact. A point on a border between light and shadow is said to be on it, and only
// such a one (neighbourhood.h).
#ifndef GNOMON_ORACLE_VISIBILITY_POINT_SIGHT_H
#define GNOMON_ORACLE_VISIBILITY_POINT_SIGHT_H

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "gnomon/kernel/sign.h"
#include "gnomon/oracle/visibility.h"
#include "gnomon/result/claims.h"
#include "gnomon/scene/prepare.h"
#include "oracle/geometry/bounded.h"
#include "oracle/visibility/light_index.h"

namespace gnomon::oracle {

/// A point of the scene on its grid, with what doubles lose.
BoundedVector on_grid(const Geometry& geometry, const RationalPoint& point);

class PointSight {
 public:
  /// Requires: a point or directional light. Keeps references to its arguments.
  PointSight(const PreparedScene& scene, const PreparedLight& light);
  /// For another light of the same scene, with whose sight it shares what is not of the light.
  PointSight(const PointSight& other, const PreparedLight& light);

  const PreparedScene& scene() const { return scene_; }
  /// The side of a part that faces the light, whether it receives or not; kOn if the light is in
  /// its plane.
  Side facing(std::uint32_t part) const { return states_[part].facing; }
  bool casts(std::uint32_t part) const { return states_[part].casts; }
  /// What a point of coplanar parts of one polygon, all of which hold it, sees on the side that
  /// faces the light; lit with a caster if the way to the light touches one whose shadow is nowhere
  /// near on the polygon. Thread-safe. Cost: what is before the point as seen from the light.
  PointVisibility at(std::span<const std::uint32_t> parts, const RationalPoint& point) const;

  /// The casters that may hide the light from a point, and few others.
  std::vector<std::uint32_t> casters_before(const RationalPoint& point) const;

  /// A part as doubles have it.
  struct SeenPart {
    std::vector<BoundedVector> loop;  // on the grid
    BoundedVector normal;
  };
  const SeenPart& seen(std::uint32_t part) const { return (*parts_)[part]; }
  bool directional() const { return light_.point.directional; }
  /// The light's place on the grid, or the direction to it.
  const BoundedVector& place() const { return place_; }

 private:
  struct State {
    Side facing = Side::kOn;
    bool receives = false, casts = false;
  };
  using SeenParts = std::vector<SeenPart>;

  PointSight(const PreparedScene& scene, const PreparedLight& light,
             std::shared_ptr<const SeenParts> parts, VisibilityTest exact);

  /// kPositive: the part certainly hides the light; kNegative: certainly not, and does not touch
  /// the way to it; kZero: not certain.
  Sign hides(std::uint32_t caster, const BoundedVector& point, const BoundedVector& way) const;

  const PreparedScene& scene_;
  const PreparedLight& light_;
  std::shared_ptr<const SeenParts> parts_;
  std::vector<State> states_;
  BoundedVector place_;
  LightIndex index_;
  VisibilityTest exact_;
};

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_VISIBILITY_POINT_SIGHT_H
