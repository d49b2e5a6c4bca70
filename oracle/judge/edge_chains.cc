// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/judge/edge_chains.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace gnomon::oracle {

namespace {

/// The vertices that lie inside of an edge, in order from its start.
class VerticesOnEdges {
 public:
  VerticesOnEdges(std::vector<std::uint32_t> vertices, const VertexFrame& frame)
      : frame_(frame), vertices_(std::move(vertices)) {
    std::ranges::sort(vertices_, {}, [&](std::uint32_t v) { return frame_.place(v).x; });
  }

  std::vector<std::uint32_t> on(std::uint32_t from, std::uint32_t to) const {
    const PlanarPoint a = frame_.place(from), b = frame_.place(to);
    const long double dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
    // A point and the ends of the edge are off by one error each in either coordinate: across and
    // along the edge by less than 6 errors together, where its direction means something at all.
    const long double doubt = 16 * frame_.error;
    const bool has_direction = length > 16 * doubt;
    std::vector<std::uint32_t> found;
    const long double low = std::min(a.x, b.x) - doubt, high = std::max(a.x, b.x) + doubt;
    auto next = std::ranges::lower_bound(vertices_, low, {},
                                         [&](std::uint32_t v) { return frame_.place(v).x; });
    for (; next != vertices_.end() && !(frame_.place(*next).x > high); ++next) {
      const long double ux = frame_.place(*next).x - a.x, uy = frame_.place(*next).y - a.y;
      if (has_direction && std::fabs(uy * dx - ux * dy) > doubt * length) continue;
      if (is_inside(from, to, *next)) found.push_back(*next);
    }
    const bool forward = frame_.before(from, to);
    std::ranges::sort(found, [&](std::uint32_t v, std::uint32_t w) {
      return forward ? frame_.before(v, w) : frame_.before(w, v);
    });
    return found;
  }

 private:
  /// Exact: on the line, and between its ends in the order of all points of the line.
  bool is_inside(std::uint32_t from, std::uint32_t to, std::uint32_t vertex) const {
    if (vertex == from || vertex == to) return false;
    const bool after = frame_.before(from, vertex);
    return after == frame_.before(vertex, to) && frame_.turn(from, to, vertex) == 0;
  }

  const VertexFrame& frame_;
  std::vector<std::uint32_t> vertices_;  // from left to right
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
  const VerticesOnEdges on_edges(std::move(vertices), frame);
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
