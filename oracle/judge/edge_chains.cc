// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/judge/edge_chains.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

namespace gnomon::oracle {

namespace {

/// The vertices that lie inside of an edge, in order from its start.
class VerticesOnEdges {
 public:
  VerticesOnEdges(std::vector<std::uint32_t> vertices, const EdgeChains::Place& place,
                  const EdgeChains::Turn& turn, long double error)
      : place_(place), turn_(turn), error_(error), vertices_(std::move(vertices)) {
    std::ranges::sort(vertices_, {}, [&](std::uint32_t v) { return place_(v).x; });
  }

  /// None: the frame cannot tell whether, or in which order.
  std::optional<std::vector<std::uint32_t>> on(std::uint32_t from, std::uint32_t to) const {
    const PlanarPoint a = place_(from), b = place_(to);
    const long double dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
    // Along the edge, a point and its ends are off by 2 error each, and the direction by as much.
    const long double doubt = 16 * error_;
    if (!(length > 4 * doubt)) return std::nullopt;
    std::vector<std::pair<long double, std::uint32_t>> found;
    const long double low = std::min(a.x, b.x) - doubt, high = std::max(a.x, b.x) + doubt;
    auto next =
        std::ranges::lower_bound(vertices_, low, {}, [&](std::uint32_t v) { return place_(v).x; });
    for (; next != vertices_.end() && place_(*next).x <= high; ++next) {
      if (*next == from || *next == to) continue;
      const long double ux = place_(*next).x - a.x, uy = place_(*next).y - a.y;
      const long double along = (ux * dx + uy * dy) / length;
      const long double off = (uy * dx - ux * dy) / length;
      if (std::fabs(off) > doubt || along < -doubt || along > length + doubt) continue;
      if (turn_(from, to, *next) != 0) continue;
      if (!(along > doubt && along < length - doubt)) return std::nullopt;
      found.emplace_back(along, *next);
    }
    std::ranges::sort(found);
    std::vector<std::uint32_t> result;
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (i > 0 && !(found[i].first - found[i - 1].first > doubt)) return std::nullopt;
      result.push_back(found[i].second);
    }
    return result;
  }

 private:
  const EdgeChains::Place& place_;
  const EdgeChains::Turn& turn_;
  long double error_;
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

bool EdgeChains::cancel_led_through(const Place& place, const Turn& turn, long double error) {
  std::vector<std::uint32_t> vertices;
  for (const Edge& own : edges_) {
    vertices.push_back(own.from);
    vertices.push_back(own.to);
  }
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  const VerticesOnEdges on_edges(std::move(vertices), place, turn, error);
  const std::vector<Edge> whole = std::exchange(edges_, {});
  for (const Edge& own : whole) {
    const auto through = on_edges.on(own.from, own.to);
    if (!through) return false;
    std::uint32_t from = own.from;
    for (const std::uint32_t vertex : *through) {
      push(from, vertex, own.count);
      from = vertex;
    }
    push(from, own.to, own.count);
  }
  return cancel();
}

}  // namespace gnomon::oracle
