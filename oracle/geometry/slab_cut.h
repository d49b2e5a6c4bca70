// SPDX-License-Identifier: GPL-3.0-or-later
// A region of the overlay between edges of its cells, cut into trapezoids: slabs run along one
// direction from vertex to vertex, and in each of them the region lies between pairs of edges.
//
// Exactness: exact. Doubles only decide what they can prove.
#ifndef GNOMON_ORACLE_GEOMETRY_SLAB_CUT_H
#define GNOMON_ORACLE_GEOMETRY_SLAB_CUT_H

#include <gmpxx.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "oracle/geometry/chart.h"
#include "oracle/geometry/overlay.h"

namespace gnomon::oracle {

/// A rational that is not reduced, which costs more than all else here; the denominator is
/// positive.
struct Fraction {
  mpz_class numerator, denominator = 1;
};

/// Slabs are cut along a direction (p, q) that is as far from parallel to all long edges as
/// possible: then the two edges that bound a trapezoid are near everywhere in it, however the
/// region winds.
struct SlabDirection {
  int p = 0, q = 1;
  ChartPoint turn(const ChartPoint& point) const {
    return {q * point.x - p * point.y, p * point.x + q * point.y, point.w};
  }
  /// The inverse: back to the chart. Not reduced.
  ChartPoint turn_back(const Fraction& x, const Fraction& y) const {
    const mpz_class u = x.numerator * y.denominator, v = y.numerator * x.denominator;
    return {q * u + p * v, q * v - p * u, (p * p + q * q) * x.denominator * y.denominator};
  }
};

/// A place where slabs begin and end: the number of one in their order.
using Stop = std::size_t;
constexpr Stop kNoStop = std::numeric_limits<Stop>::max();

/// An edge of a boundary between two vertices of the overlay, from its first stop to its last.
struct SlabEdge {
  std::uint32_t left = 0, right = 0;
  Stop first = kNoStop, last = kNoStop;
  std::optional<ChartLine> line{};  // turned as slabs are; made when first asked for
};

/// The boundary's edges of a region, turned so that slabs are upright, and the region between them
/// as trapezoids, slab by slab. Edges do not cross, so that which of two is above the other is
/// decided once, where the later one begins.
class SlabCut {
 public:
  explicit SlabCut(const Overlay& overlay, SlabDirection direction = {})
      : overlay_(&overlay), direction_(direction) {}

  void add(std::uint32_t from, std::uint32_t to) { edges_.push_back({from, to}); }
  const std::vector<SlabEdge>& edges() const { return edges_; }
  SlabDirection direction() const { return direction_; }
  std::uint32_t vertex_at(Stop stop) const { return stops_[stop]; }
  /// Calls `use(below, above, stop)` for each trapezoid, which lies between two edges, numbers of
  /// edges(), and between a stop and the next; it returns false to stop.
  template <class Use>
  void cut(const Use& use);
  /// The point of an edge at a stop that is none of its ends. Not reduced.
  ChartPoint corner(std::size_t edge, Stop stop);
  /// In a trapezoid. Not reduced.
  ChartPoint middle(std::size_t below, std::size_t above, Stop stop);

 private:
  void find_stops();
  bool is_above(const SlabEdge& edge, const SlabEdge& other) const;
  Fraction x_of(Stop stop) const {
    const ChartPoint turned = direction_.turn(overlay_->point(stops_[stop]));
    return {turned.x, turned.w};
  }
  const ChartLine& line_of(std::size_t edge);

  const Overlay* overlay_;
  SlabDirection direction_;
  std::vector<SlabEdge> edges_;
  std::vector<std::uint32_t> stops_;  // a vertex at each
};

template <class Use>
void SlabCut::cut(const Use& use) {
  find_stops();
  std::vector<std::vector<std::size_t>> beginning(stops_.size());
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    if (edges_[e].first < edges_[e].last) beginning[edges_[e].first].push_back(e);
  }
  std::vector<std::size_t> across;  // the edges that cross the slab, upwards
  for (Stop stop = 0; stop + 1 < stops_.size(); ++stop) {
    std::erase_if(across, [&](std::size_t e) { return edges_[e].last <= stop; });
    for (const std::size_t e : beginning[stop]) {
      across.insert(
          std::ranges::partition_point(
              across, [&](std::size_t other) { return is_above(edges_[e], edges_[other]); }),
          e);
    }
    for (std::size_t i = 0; i + 1 < across.size(); i += 2) {
      if (!use(across[i], across[i + 1], stop)) return;
    }
  }
}

/// What is known of an edge at a stop. Two slabs meet there, one after the other.
template <class Corner>
struct KnownCorner {
  Stop stop = kNoStop;
  Corner corner{};
};

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_GEOMETRY_SLAB_CUT_H
