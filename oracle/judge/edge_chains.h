// SPDX-License-Identifier: GPL-3.0-or-later
// Whether loops tile a polygon exactly: the edges of all loops, taken with their directions, must
// cancel against those of the polygon, once edges are led through the vertices that lie on them. No
// area is added up and no pair of loops is compared. Proven in docs (oracle, "Tilings by edges").
//
// Exactness: exact. Vertices are one if they have one number; the frame only tells where to look,
// with a bound for its error, and doubts are settled by the given predicate.
#ifndef GNOMON_ORACLE_JUDGE_EDGE_CHAINS_H
#define GNOMON_ORACLE_JUDGE_EDGE_CHAINS_H

#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "oracle/geometry/planar_loop.h"

namespace gnomon::oracle {

/// Where vertices are in a frame of their plane, and exact predicates on them.
struct VertexFrame {
  std::function<const PlanarPoint&(std::uint32_t)> place;
  long double error = 0;  // of a coordinate of a place
  /// Which way three vertices turn: 0 if they are on one line.
  std::function<int(std::uint32_t, std::uint32_t, std::uint32_t)> turn;
  /// Of two points of one line, whether the first comes first in some order along it.
  std::function<bool(std::uint32_t, std::uint32_t)> before;
};

class EdgeChains {
 public:
  /// The loop's edges count once, or if `sign` is -1 against those that do.
  void add(std::span<const std::uint32_t> loop, int sign);

  /// All edges cancel as they are, without a look at where vertices are.
  bool cancel();
  /// The same where vertices may lie on edges. Requires: cancel() was called.
  bool cancel_led_through(const VertexFrame& frame);

 private:
  struct Edge {
    std::uint32_t from = 0, to = 0;  // from < to
    int count = 0;                   // forward less backward
  };
  void push(std::uint32_t from, std::uint32_t to, int count);

  std::vector<Edge> edges_;
};

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_JUDGE_EDGE_CHAINS_H
