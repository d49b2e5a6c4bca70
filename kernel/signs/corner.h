// SPDX-License-Identifier: LGPL-3.0-or-later
// A vertex of a loop in its context: the two edges that meet in it, each by the signed plane that
// the edge lies in, and the support plane of the loop.
//
// The context is what lets a kernel *know*: a vertex made by cutting with plane T has T as one of
// its edges' planes, and is on T whatever rounded coordinates say (identity). For the kernel
// `plane` the context *is* the vertex: the point where the three planes meet.
#ifndef GNOMON_KERNEL_SIGNS_CORNER_H
#define GNOMON_KERNEL_SIGNS_CORNER_H

#include <cstdint>
#include <span>

#include "gnomon/kernel/geometry.h"
#include "gnomon/kernel/orientation.h"

namespace gnomon {

/// Source of a vertex that an algorithm made; others are input vertices.
inline constexpr VertexId kMadeVertex = 0xffffffffu;

template <class Vertex>
struct Corner {
  PlaneRef before;  // of the edge that ends here
  const Vertex& vertex;
  PlaneRef after;  // of the edge that starts here
  PlaneId support;
};

/// A convex loop: vertex i, and the signed plane of the edge from vertex i to i + 1, interior in
/// front. In scene space the plane of an uncut edge is a name only: see SceneEdges.
template <class Vertex>
struct LoopView {
  std::span<const Vertex> vertices;
  std::span<const PlaneRef> edges;
  PlaneId support = 0;
  std::uint32_t part = 0;

  std::uint32_t size() const { return static_cast<std::uint32_t>(vertices.size()); }
  std::uint32_t next(std::uint32_t i) const { return i + 1 == size() ? 0 : i + 1; }
  std::uint32_t previous(std::uint32_t i) const { return i == 0 ? size() - 1 : i - 1; }
  Corner<Vertex> corner(std::uint32_t i) const {
    return {edges[previous(i)], vertices[i], edges[i], support};
  }
};

/// How edges are named in scene space: index < planes is a support plane that cut the loop (signed,
/// interior in front); index - planes is an input edge, flipped if the loop runs from its b to its
/// a.
struct SceneEdges {
  std::uint32_t planes = 0;
  bool is_input_edge(PlaneRef ref) const { return ref.index() >= planes; }
  EdgeId edge(PlaneRef ref) const { return ref.index() - planes; }
  PlaneRef of_edge(EdgeId edge, bool flipped) const { return PlaneRef(planes + edge, flipped); }
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_SIGNS_CORNER_H
