// SPDX-License-Identifier: LGPL-3.0-or-later
// Which edges of a scene lie on one line, and how they lie to each other there. Casters that meet
// at a T-junction have no edge in common, only a line.
#ifndef GNOMON_ALGORITHMS_ILLUMINATION_EDGE_LINES_H
#define GNOMON_ALGORITHMS_ILLUMINATION_EDGE_LINES_H

#include <cstdint>
#include <vector>

#include "gnomon/kernel/geometry.h"

namespace gnomon {

/// Where an edge lies on its line. The ends of all edges of a line are numbered along it: their
/// ranks.
struct EdgeOnLine {
  std::uint32_t line = 0;
  std::uint32_t low = 0, high = 1;  // ranks of its ends, low < high
  bool runs_down = false;           // its end a, from which the kernel directs it, has rank `high`

  bool meets(const EdgeOnLine& other) const {
    return line == other.line && low < other.high && other.low < high;
  }
};

class EdgeLines {
 public:
  /// Exact, for all edges of the scene.
  explicit EdgeLines(const Geometry& geometry);

  const EdgeOnLine& operator[](EdgeId edge) const { return edges_[edge]; }
  /// The rank of one of the edge's ends.
  std::uint32_t rank(EdgeId edge, VertexId end) const {
    const EdgeOnLine& at = edges_[edge];
    return (ends_[edge].a == end) == at.runs_down ? at.high : at.low;
  }

 private:
  const std::vector<EdgeEnds>& ends_;
  std::vector<EdgeOnLine> edges_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_ILLUMINATION_EDGE_LINES_H
