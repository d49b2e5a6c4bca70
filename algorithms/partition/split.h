// SPDX-License-Identifier: LGPL-3.0-or-later
// Splitting a convex loop by a plane, in two steps: first a record of which vertex lies on which
// side (decisions only), then the children made from it (constructions only).
//
// On exact kernels the sides of a convex loop form at most one run in front and one behind, and
// both children are convex with at least three vertices. On rounded kernels anything can happen;
// the children are made by the same rule (keep what is in front or on, insert a crossing wherever
// the side changes), and one with fewer than three vertices is reported, not repaired. Reference:
// Sutherland & Hodgman, Reentrant polygon clipping (1974), for a single plane.
#ifndef GNOMON_ALGORITHMS_PARTITION_SPLIT_H
#define GNOMON_ALGORITHMS_PARTITION_SPLIT_H

#include <cstdint>
#include <vector>

#include "algorithms/partition/loop_store.h"
#include "gnomon/kernel/sign.h"
#include "kernel/concept/kernel_concept.h"
#include "kernel/signs/corner.h"

namespace gnomon {

enum class Placement : std::uint8_t { kFront, kBack, kOn, kSpanning };

/// The combinatorial record: a side a vertex.
class SplitRecord {
 public:
  /// Asks the kernel for the side of every vertex.
  template <DecisionSpace Space>
  Placement decide(Space& space, PlaneRef plane, const LoopView<typename Space::Vertex>& loop) {
    const std::uint32_t n = loop.size();
    if (sides_.size() < n) sides_.resize(n);
    // A kernel that keeps its planes elsewhere reads this one once.
    const auto loaded = load(space, plane);
    bool front = false, back = false;
    PlaneRef before = loop.edges[n - 1];
    for (std::uint32_t i = 0; i < n; ++i) {
      const PlaneRef after = loop.edges[i];
      const Side side = space.side_of_plane(
          loaded, Corner<typename Space::Vertex>{before, loop.vertices[i], after, loop.support});
      sides_[i] = side;
      front |= side == Side::kFront;
      back |= side == Side::kBack;
      before = after;
    }
    if (front && back) return Placement::kSpanning;
    return front ? Placement::kFront : back ? Placement::kBack : Placement::kOn;
  }
  Side side(std::uint32_t i) const { return sides_[i]; }

 private:
  template <class Space>
  static auto load(const Space& space, PlaneRef plane) {
    if constexpr (requires { space.load(plane); }) {
      return space.load(plane);
    } else {
      return plane;
    }
  }

  std::vector<Side> sides_;  // at least as many as the last loop had vertices
};

struct SplitChildren {
  LoopRange front, back;  // count < 3: vanished (rounded kernels only)
};

/// A space may have crossing_of_child(plane, edge, kept, lost), the vertex of a split edge as the
/// child sees it that keeps the corner `kept`; without it both children have the same vertex.
///
/// Appends both children of `loop` to `store`, back first. `loop` must not live in `store`
/// (appending may move it). The cut edge of the front child lies in `plane`, that of the back child
/// in its opposite, so that the interior stays in front of every edge.
template <DecisionSpace Space>
SplitChildren make_children(const Space& space, PlaneRef plane,
                            const LoopView<typename Space::Vertex>& loop, const SplitRecord& record,
                            std::vector<typename Space::Vertex>& crossings,
                            LoopStore<typename Space::Vertex>& store) {
  using Vertex = typename Space::Vertex;
  const std::uint32_t n = loop.size();
  // Each crossing is constructed once and shared by both children, unless the space makes one for
  // each child.
  constexpr bool kShared = !requires(const Corner<Vertex>& corner) {
    space.crossing_of_child(plane, plane, corner, corner);
  };
  crossings.clear();
  for (std::uint32_t i = 0; i < n; ++i) {
    const Side here = record.side(i), there = record.side(loop.next(i));
    if (here != Side::kOn && there == opposite(here)) {
      crossings.push_back(space.crossing(plane, loop.edges[i], here == Side::kFront, loop.corner(i),
                                         loop.corner(loop.next(i))));
    }
  }
  const auto make = [&](Side kept) {
    const PlaneRef cut = kept == Side::kFront ? plane : -plane;
    LoopRange range{store.size(), 0, loop.part};
    std::size_t crossing = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
      const Side here = record.side(i), there = record.side(loop.next(i));
      if (here != opposite(kept)) {
        const bool leaves_here = here == Side::kOn && there == opposite(kept);
        store.push(loop.vertices[i], leaves_here ? cut : loop.edges[i]);
      }
      if (here != Side::kOn && there == opposite(here)) {
        const Vertex& vertex = crossings[crossing++];
        if constexpr (kShared) {
          store.push(vertex, here == kept ? cut : loop.edges[i]);
        } else {
          const Corner<Vertex> from = loop.corner(i), to = loop.corner(loop.next(i));
          store.push(here == kept ? space.crossing_of_child(plane, loop.edges[i], from, to)
                                  : space.crossing_of_child(plane, loop.edges[i], to, from),
                     here == kept ? cut : loop.edges[i]);
        }
      }
    }
    range.count = store.size() - range.first;
    return range;
  };
  SplitChildren children;
  children.back = make(Side::kBack);
  children.front = make(Side::kFront);
  return children;
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PARTITION_SPLIT_H
