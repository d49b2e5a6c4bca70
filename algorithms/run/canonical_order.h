// SPDX-License-Identifier: LGPL-3.0-or-later
// A prepared scene written down in one of the many ways that mean the same: loops start at their
// smallest vertex, and polygons come in the lexicographic order of their loops.
//
// What a rounded kernel finds depends on the order in which it computes. In any rotation of a loop,
// and in any order, the polygons are the same scene (docs: semantics, "Scene"), so that every run
// on a rounded kernel works on this copy, whichever method it takes. Exact kernels need none.
//
// Guarantee: the same scene, with the same vertices, edges and planes. Only indices of polygons and
// parts differ, and where loops start.
#ifndef GNOMON_ALGORITHMS_RUN_CANONICAL_ORDER_H
#define GNOMON_ALGORITHMS_RUN_CANONICAL_ORDER_H

#include <cstdint>
#include <vector>

#include "gnomon/algorithms/shadow_result.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

class CanonicalOrder {
 public:
  /// `keep_order`: only loops are turned, and polygons stay in the order of the file.
  CanonicalOrder(const PreparedScene& scene, bool keep_order);

  /// The scene in this order: the one given if it is in it already. Without notes.
  const PreparedScene& scene() const { return changed_ ? copy_ : scene_; }
  /// Puts what a run on scene() found into the order of the original.
  void restore(LightResult& light) const;
  void restore(ShadowResult& result) const;

 private:
  void sort_polygons();
  void copy();
  void add_polygon(std::uint32_t polygon);

  const PreparedScene& scene_;
  bool changed_ = false;
  PreparedScene copy_;
  std::vector<std::uint32_t> starts_;    // by original part: the position of its smallest vertex
  std::vector<std::uint32_t> polygons_;  // the original index of each polygon
  std::vector<std::uint32_t> parts_;     // the original index of each part
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_RUN_CANONICAL_ORDER_H
