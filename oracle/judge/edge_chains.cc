// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/judge/edge_chains.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>

namespace gnomon::oracle {

namespace {

/// The vertices that lie inside of an edge, in order from its start.
class VerticesOnEdges {
 public:
  VerticesOnEdges(const std::vector<std::uint32_t>& vertices, const VertexFrame& frame)
      : frame_(frame) {
    for (const std::uint32_t v : vertices) by_x_.push_back({frame.place(v), v});
    by_y_ = by_x_;
    std::ranges::sort(by_x_, {}, &across);
    std::ranges::sort(by_y_, {}, &up);
  }

  std::vector<std::uint32_t> on(std::uint32_t from, std::uint32_t to) const {
    const PlanarPoint a = frame_.place(from), b = frame_.place(to);
    const long double dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
    // A point and the ends of the edge are off by one error each in either coordinate: across and
    // along the edge by less than 6 errors together, where its direction means something at all.
    const long double doubt = 16 * frame_.error;
    const bool has_direction = length > 16 * doubt;
    std::vector<std::uint32_t> found;
    for (const Placed& own : fewest_near(a, b, doubt)) {
      const long double ux = own.place.x - a.x, uy = own.place.y - a.y;
      if (has_direction && std::fabs(uy * dx - ux * dy) > doubt * length) continue;
      if (is_inside(from, to, own.vertex)) found.push_back(own.vertex);
    }
    const bool forward = frame_.before(from, to);
    std::ranges::sort(found, [&](std::uint32_t v, std::uint32_t w) {
      return forward ? frame_.before(v, w) : frame_.before(w, v);
    });
    return found;
  }

 private:
  struct Placed {
    PlanarPoint place;
    std::uint32_t vertex = 0;
  };
  static long double across(const Placed& own) { return own.place.x; }
  static long double up(const Placed& own) { return own.place.y; }

  /// Those between two ends along x, or along y if there are fewer.
  std::span<const Placed> fewest_near(const PlanarPoint& a, const PlanarPoint& b,
                                      long double doubt) const {
    const auto between = [&](const std::vector<Placed>& placed, auto key, long double p,
                             long double q) {
      const auto first = std::ranges::lower_bound(placed, std::min(p, q) - doubt, {}, key);
      const auto last = std::ranges::upper_bound(placed, std::max(p, q) + doubt, {}, key);
      return std::span<const Placed>(first, std::max(first, last));
    };
    const std::span<const Placed> in_x = between(by_x_, &across, a.x, b.x);
    const std::span<const Placed> in_y = between(by_y_, &up, a.y, b.y);
    return in_x.size() < in_y.size() ? in_x : in_y;
  }
  /// Exact: on the line, and between its ends in the order of all points of the line.
  bool is_inside(std::uint32_t from, std::uint32_t to, std::uint32_t vertex) const {
    if (vertex == from || vertex == to) return false;
    const bool after = frame_.before(from, vertex);
    return after == frame_.before(vertex, to) && frame_.turn(from, to, vertex) == 0;
  }

  const VertexFrame& frame_;
  std::vector<Placed> by_x_, by_y_;
};

}  // namespace

void EdgeChains::push(std::uint32_t from, std::uint32_t to, int count) {
  if (from == to) return;
  if (from > to) {
    std::swap(from, to);
    count = -count;
  }
  edges_.push_back({from, to, count});
}

void EdgeChains::add(std::span<const std::uint32_t> loop, int sign) {
  for (std::size_t i = 0; i < loop.size(); ++i) {
    push(loop[i], loop[i + 1 < loop.size() ? i + 1 : 0], sign);
  }
}

bool EdgeChains::cancel() {
  std::ranges::sort(edges_, {}, [](const Edge& own) { return std::tie(own.from, own.to); });
  std::vector<Edge> left;
  for (std::size_t i = 0; i < edges_.size();) {
    Edge sum{edges_[i].from, edges_[i].to, 0};
    for (; i < edges_.size() && edges_[i].from == sum.from && edges_[i].to == sum.to; ++i) {
      sum.count += edges_[i].count;
    }
    if (sum.count != 0) left.push_back(sum);
  }
  edges_ = std::move(left);
  return edges_.empty();
}

bool EdgeChains::cancel_led_through(const VertexFrame& frame) {
  std::vector<std::uint32_t> vertices;
  for (const Edge& own : edges_) {
    vertices.push_back(own.from);
    vertices.push_back(own.to);
  }
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  const VerticesOnEdges on_edges(vertices, frame);
  const std::vector<Edge> whole = std::exchange(edges_, {});
  for (const Edge& own : whole) {
    std::uint32_t from = own.from;
    for (const std::uint32_t vertex : on_edges.on(own.from, own.to)) {
      push(from, vertex, own.count);
      from = vertex;
    }
    push(from, own.to, own.count);
  }
  return cancel();
}

}  // namespace gnomon::oracle
