// SPDX-License-Identifier: GPL-3.0-or-later
// Which casters may shadow a receiver: the culling that all per-receiver peers are given.
//
// Method: directions from the light are drawn in the six charts of a cube around it; each caster is
// clipped to the cube's faces, and a bounding-volume hierarchy per face holds its boxes with the
// least depth. What a query finds must further pass a test by separating planes: the edges of both
// polygons, and the two support planes. Guarantee: none that shadows is left out, for all
// comparisons allow for rounding.
#ifndef GNOMON_BENCH_PEERS_CASTER_SEARCH_H
#define GNOMON_BENCH_PEERS_CASTER_SEARCH_H

#include <array>
#include <cstdint>
#include <vector>

#include "peers/light_view.h"

namespace gnomon::bench {

class CasterSearch {
 public:
  explicit CasterSearch(const LightView& view);

  /// Sorted, each once, the receiver not among them.
  void casters_of(std::uint32_t receiver, std::vector<std::uint32_t>& casters);

 private:
  /// In the chart of one face of the cube; depth is the coordinate along its axis.
  struct Box {
    std::array<double, 2> low{}, high{};
    double nearest = 0, farthest = 0;
    std::uint32_t part = 0;
  };
  struct Node {
    Box bounds;
    std::uint32_t first = 0, count = 0;  // boxes, if count > 0; else children first, first + 1
  };
  struct Hierarchy {
    std::vector<Box> boxes;
    std::vector<Node> nodes;
  };

  bool box_on_face(std::uint32_t part, int face, Box& box);
  static void build(Hierarchy& hierarchy);
  void query(const Hierarchy& hierarchy, const Box& box, std::vector<std::uint32_t>& found);
  bool may_shadow(std::uint32_t receiver, std::uint32_t caster) const;

  const LightView& view_;
  std::array<Hierarchy, 6> faces_;
  std::vector<Point<double>> loop_, clipped_;  // workspace
  std::vector<std::uint32_t> pending_;
};

}  // namespace gnomon::bench

#endif  // GNOMON_BENCH_PEERS_CASTER_SEARCH_H
