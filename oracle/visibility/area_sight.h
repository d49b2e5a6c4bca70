// SPDX-License-Identifier: GPL-3.0-or-later
// How much of an area light is seen from many points, each decided exactly: the test of
// area_visibility.h, asked of those casters alone that doubles with a certified error do not put
// outside of what lies between the point and the light.
//
// Exactness: exact.
#ifndef GNOMON_ORACLE_VISIBILITY_AREA_SIGHT_H
#define GNOMON_ORACLE_VISIBILITY_AREA_SIGHT_H

#include <cstdint>
#include <vector>

#include "gnomon/kernel/sign.h"
#include "gnomon/oracle/area_visibility.h"
#include "gnomon/result/claims.h"
#include "gnomon/scene/prepare.h"
#include "oracle/geometry/bounded.h"
#include "oracle/geometry/box_tree.h"

namespace gnomon::oracle {

class AreaSight {
 public:
  /// Requires: an area light. Keeps references to its arguments.
  AreaSight(const PreparedScene& scene, const PreparedLight& light);

  /// What a point of a part sees of the light from one side, with fractions. Thread-safe.
  AreaPointVisibility at(std::uint32_t part, Side side, const RationalPoint& point) const;

 private:
  struct SeenPart {
    std::vector<BoundedVector> loop;  // on the grid
    BoundedVector normal;
  };

  /// Does all of a loop certainly lie behind a plane through a point?
  static bool is_behind(const std::vector<BoundedVector>& loop, const BoundedVector& normal,
                        const BoundedVector& point);
  std::vector<std::uint32_t> casters_before(std::uint32_t part, Side side,
                                            const BoundedVector& point) const;

  const PreparedScene& scene_;
  std::vector<SeenPart> parts_;
  std::vector<BoundedVector> light_;  // on the grid
  BoundedVector light_normal_;
  SpaceTree tree_;  // of casters, on the grid
  std::vector<std::uint32_t> casters_;
  AreaVisibility exact_;
};

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_VISIBILITY_AREA_SIGHT_H
