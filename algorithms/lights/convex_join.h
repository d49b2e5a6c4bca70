// SPDX-License-Identifier: LGPL-3.0-or-later
// Two fragments of one part that share a whole edge, as one where the two are convex together (Chin
// & Feiner 1989, sec. 6; Slater 1992, figure 6): at both ends of the edge the next vertex of the
// one is not behind the edge of the other.
//
// Exactness: the kernel's decisions, of degree 6 as all sides of vertices, and more for edges that
// were cut for other lights.
#ifndef GNOMON_ALGORITHMS_LIGHTS_CONVEX_JOIN_H
#define GNOMON_ALGORITHMS_LIGHTS_CONVEX_JOIN_H

#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/partition/loop_store.h"
#include "kernel/concept/kernel_concept.h"

namespace gnomon {

template <LightSpaceModel Space>
class ConvexJoin {
 public:
  using Vertex = typename Space::Vertex;
  using Loop = LoopView<Vertex>;

  explicit ConvexJoin(Space& space) : space_(space) {}

  /// Puts a and b together across edge i of a, which is edge j of b, into joined(); false if they
  /// do not share all of it, or are not convex together.
  bool join(const Loop& a, std::uint32_t i, const Loop& b, std::uint32_t j) {
    const std::uint32_t n = a.size(), m = b.size();
    // The edge runs from a's vertex i, which is b's j + 1, to a's i + 1, which is b's j.
    const std::uint32_t start = i, end = a.next(i);
    const std::uint32_t before = a.previous(i), after = a.next(i);  // edges of a
    const std::uint32_t b_next = b.next(j), b_before = b.previous(j);
    const PlaneRef own_before = plane_of(a, before), own_after = plane_of(a, after);
    if (!same_vertex(a, start, plane_of(b, b_next), b.vertices[b_next]) ||
        !same_vertex(a, end, plane_of(b, b_before), b.vertices[j])) {
      return false;
    }
    const Side at_start = space_.side_of_plane(own_before, b.corner(b.next(b_next)));
    const Side at_end = space_.side_of_plane(own_after, b.corner(b_before));
    if (at_start == Side::kBack || at_end == Side::kBack) return false;
    joined_.clear();
    edges_from_.clear();
    part_ = a.part;
    support_ = a.support;
    // All of a from the end of the edge to its start, then b's other vertices; a straight angle is
    // no vertex.
    for (std::uint32_t k = 0; k < n; ++k) {
      const std::uint32_t at = (end + k) % n;
      if (at == end && at_end == Side::kOn) continue;
      if (at == start) {
        if (at_start != Side::kOn) push(a.vertices[at], b, b_next, true);
      } else {
        push(a.vertices[at], a, at, false);
      }
    }
    for (std::uint32_t k = 2; k < m; ++k) {
      const std::uint32_t at = (j + k) % m;
      push(b.vertices[at], b, at, true);
    }
    if (joined_.size() < 3) return false;
    for (std::uint32_t k = 0; k < joined_.size(); ++k) {
      if (joined_.vertex(k).source != kMadeVertex) continue;
      space_.finish_vertex(joined_.vertex(k), joined_.edge(k == 0 ? joined_.size() - 1 : k - 1),
                           joined_.edge(k));
    }
    return true;
  }

  /// Valid until the next call of join().
  Loop joined() const { return joined_.view({0, joined_.size(), part_}, support_); }
  /// Where the edges of joined() come from.
  struct EdgeFrom {
    bool of_second = false;  // of b
    std::uint32_t edge = 0;
  };
  std::span<const EdgeFrom> edges_from() const { return edges_from_; }

 private:
  void push(const Vertex& vertex, const Loop& loop, std::uint32_t edge, bool of_second) {
    joined_.push(vertex, loop.edges[edge]);
    edges_from_.push_back({of_second, edge});
  }
  /// The plane of an edge, also of a kernel that knows none by itself.
  PlaneRef plane_of(const Loop& loop, std::uint32_t edge) {
    return space_.shadow_plane(loop.edges[edge], loop.vertices[edge],
                               loop.vertices[loop.next(edge)]);
  }
  bool same_vertex(const Loop& a, std::uint32_t at, PlaneRef through, const Vertex& other) {
    if (a.vertices[at].source != kMadeVertex || other.source != kMadeVertex) {
      return a.vertices[at].source == other.source;
    }
    return space_.side_of_plane(through, a.corner(at)) == Side::kOn;
  }

  Space& space_;
  LoopStore<Vertex> joined_;
  std::vector<EdgeFrom> edges_from_;
  std::uint32_t part_ = 0;
  PlaneId support_ = 0;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_LIGHTS_CONVEX_JOIN_H
