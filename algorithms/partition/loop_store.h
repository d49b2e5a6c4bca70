// SPDX-License-Identifier: LGPL-3.0-or-later
// Convex loops in two flat arrays: no allocation a loop, usable as an arena (append only) and as a
// stack (truncate).
#ifndef GNOMON_ALGORITHMS_PARTITION_LOOP_STORE_H
#define GNOMON_ALGORITHMS_PARTITION_LOOP_STORE_H

#include <cstdint>
#include <vector>

#include "kernel/signs/corner.h"

namespace gnomon {

/// A loop in a LoopStore, and the part that it is a piece of.
struct LoopRange {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  std::uint32_t part = 0;
};

template <class Vertex>
class LoopStore {
 public:
  std::uint32_t size() const { return static_cast<std::uint32_t>(edges_.size()); }
  void push(Vertex vertex, PlaneRef edge) {
    vertices_.push_back(std::move(vertex));
    edges_.push_back(edge);
  }
  void truncate(std::uint32_t size) { resize(size); }
  void resize(std::uint32_t size) {
    vertices_.resize(size);
    edges_.resize(size);
  }
  /// Makes room, so that views stay valid while up to `more` vertices are pushed.
  void reserve_more(std::size_t more) {
    if (vertices_.size() + more <= vertices_.capacity()) return;
    vertices_.reserve(2 * (vertices_.size() + more));
    edges_.reserve(2 * (vertices_.size() + more));
  }
  void clear() { truncate(0); }
  LoopView<Vertex> view(const LoopRange& range, PlaneId support) const {
    return {{vertices_.data() + range.first, range.count},
            {edges_.data() + range.first, range.count},
            support,
            range.part};
  }
  /// Appends a copy of a loop of another store and returns its range here.
  LoopRange append(const LoopView<Vertex>& loop) {
    const LoopRange range{size(), loop.size(), loop.part};
    vertices_.insert(vertices_.end(), loop.vertices.begin(), loop.vertices.end());
    edges_.insert(edges_.end(), loop.edges.begin(), loop.edges.end());
    return range;
  }
  Vertex& vertex(std::uint32_t index) { return vertices_[index]; }
  const Vertex& vertex(std::uint32_t index) const { return vertices_[index]; }
  PlaneRef& edge(std::uint32_t index) { return edges_[index]; }
  PlaneRef edge(std::uint32_t index) const { return edges_[index]; }

 private:
  std::vector<Vertex> vertices_;
  std::vector<PlaneRef> edges_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PARTITION_LOOP_STORE_H
