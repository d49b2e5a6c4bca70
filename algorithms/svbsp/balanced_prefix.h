// SPDX-License-Identifier: LGPL-3.0-or-later
// The balanced prefix: a small tree of planes through the light that stands at the top of the SVBSP
// tree. Inserted front to back, an SVBSP tree degenerates into chains; below a k-d split of light
// space the chains stay short, and filtering takes O(log n) again.
//
// For a point light the first planes are x = +-y, then y = +-z or x = +-z, which part light space
// into twelve pyramids with one chart each; a directional light needs one chart. In each, a k-d
// tree on the polygons' boxes, 8 a leaf. Everything here is a heuristic on doubles: whatever planes
// come out, they are exact planes through the light, and the answer does not depend on them.
#ifndef GNOMON_ALGORITHMS_SVBSP_BALANCED_PREFIX_H
#define GNOMON_ALGORITHMS_SVBSP_BALANCED_PREFIX_H

#include <cstdint>
#include <span>
#include <vector>

#include "gnomon/scene/prepare.h"
#include "kernel/concept/light_space.h"

namespace gnomon {

struct PrefixNode {
  static constexpr std::int32_t kLeaf = -1;
  PrefixPlane plane;
  std::int32_t front = kLeaf, back = kLeaf;
};

struct PrefixTree {
  std::vector<PrefixNode> nodes;  // nodes[0] is the root; empty if there is no prefix
};

/// Plans a prefix for the parts that face the light. Fewer than 64 parts get none.
PrefixTree plan_prefix(const PreparedScene& scene, const LightPoint& light,
                       std::span<const std::uint32_t> parts);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SVBSP_BALANCED_PREFIX_H
