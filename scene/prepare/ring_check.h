// SPDX-License-Identifier: LGPL-3.0-or-later
// Whether the rings of a polygon are legal (see polygon_cut.h), exactly.
#ifndef GNOMON_SCENE_PREPARE_RING_CHECK_H
#define GNOMON_SCENE_PREPARE_RING_CHECK_H

#include <fmt/format.h>

#include <optional>
#include <set>
#include <utility>

#include "scene/prepare/chart.h"

namespace gnomon::scene_detail {

template <class Int>
class RingCheck {
 public:
  RingCheck(CutInput<Int>& input, const Chart<Int>& chart) : input_(input), chart_(chart) {}

  /// Also makes holes clockwise, and puts vertices of one ring that lie inside an edge of another
  /// into that edge, so that from here on rings meet in vertices and whole edges only.
  std::optional<CutProblem> run() {
    for (std::size_t r = 0; r < input_.rings.size(); ++r) {
      if (auto problem = check_simple(r)) return problem;
    }
    for (std::size_t r = 1; r < input_.rings.size(); ++r) {
      Ring& hole = input_.rings[r];
      if (chart_.area(hole) > 0) std::reverse(hole.begin() + 1, hole.end());
    }
    if (!needs_tracing()) return std::nullopt;
    if (auto problem = share_touching_vertices()) return problem;
    if (auto problem = check_crossings()) return problem;
    return check_containment();
  }

  /// Some ring touches itself or another: region_components() must trace them anew.
  bool needs_tracing() const { return touches_ || input_.rings.size() > 1; }

 private:
  std::string edge_name(std::uint32_t a, std::uint32_t b) const {
    return fmt::format("{}-{}", chart_.key(a), chart_.key(b));
  }

  /// The loop runs along an edge oftener than back. That is found without the square of what
  /// follows: a small file may go round a few vertices a hundred thousand times.
  std::optional<CutProblem> check_repeated_edges(std::size_t r) {
    const Ring& ring = input_.rings[r];
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges(ring.size());
    for (std::size_t i = 0; i < ring.size(); ++i) edges[i] = {ring[i], ring[after(ring, i)]};
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
      while (end < edges.size() && edges[end] == edges[i]) ++end;
      if (end - i < 2) continue;
      const auto [a, b] = edges[i];
      const auto back = std::equal_range(edges.begin(), edges.end(), std::pair{b, a});
      if (end - i < 2 + static_cast<std::size_t>(back.second - back.first)) continue;
      return CutProblem{r, fmt::format("runs along the edge {} twice", edge_name(a, b))};
    }
    return std::nullopt;
  }

  std::optional<CutProblem> check_simple(std::size_t r) {
    if (auto problem = check_repeated_edges(r)) return problem;
    const Ring& ring = input_.rings[r];
    const std::size_t n = ring.size();
    // Edges sorted by their left end; only edges whose x ranges overlap are compared.
    std::vector<std::uint32_t> order(n);
    const auto left = [&](std::uint32_t i) -> const Int& {
      return std::min(chart_.x(ring[i]), chart_.x(ring[after(ring, i)]));
    };
    for (std::uint32_t i = 0; i < n; ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
      return left(i) < left(j) || (left(i) == left(j) && i < j);
    });
    for (std::size_t s = 0; s < n; ++s) {
      const std::uint32_t i = order[s];
      const std::uint32_t a = ring[i], b = ring[after(ring, i)];
      if (chart_.same_place(a, b)) {
        return CutProblem{
            r, fmt::format("touches itself: vertices {} and {} coincide in the projection",
                           chart_.key(a), chart_.key(b))};
      }
      const Int& right = std::max(chart_.x(a), chart_.x(b));
      for (std::size_t t = s + 1; t < n && left(order[t]) <= right; ++t) {
        const std::uint32_t j = order[t];
        const std::uint32_t c = ring[j], d = ring[after(ring, j)];
        if (after(ring, i) == j || after(ring, j) == i) {
          const std::uint32_t p = after(ring, i) == j ? a : c;
          const std::uint32_t v = after(ring, i) == j ? b : d;
          const std::uint32_t q = after(ring, i) == j ? d : b;
          if (chart_.turn(p, v, q) == Sign::kZero && !chart_.inside_segment(p, q, v)) {
            return CutProblem{r, fmt::format("turns back on itself at vertex {} in the projection",
                                             chart_.key(v))};
          }
          continue;
        }
        if (!chart_.meet(a, b, c, d)) continue;
        const bool crosses = chart_.cross_properly(a, b, c, d);
        // Coming back to a vertex, or along an edge, is no crossing: keyhole loops do that on
        // purpose.
        const bool shares_vertex = a == c || a == d || b == c || b == d;
        if (crosses || (!input_.planar && !shares_vertex)) {
          return CutProblem{
              r, fmt::format("{} itself: edges {} and {}", crosses ? "crosses" : "touches",
                             i < j ? edge_name(a, b) : edge_name(c, d),
                             i < j ? edge_name(c, d) : edge_name(a, b))};
        }
        touches_ = true;
      }
    }
    return std::nullopt;
  }

  std::optional<CutProblem> share_touching_vertices() {
    std::vector<Ring> rings(input_.rings.size());
    for (std::size_t r = 0; r < rings.size(); ++r) {
      const Ring& ring = input_.rings[r];
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const std::uint32_t a = ring[i], b = ring[after(ring, i)];
        rings[r].push_back(a);
        std::vector<std::uint32_t> inside;
        for (std::size_t s = 0; s < rings.size(); ++s) {
          for (const std::uint32_t v : input_.rings[s]) {
            if (!input_.planar && s != r && v != a && v != b &&
                (chart_.same_place(a, v) || chart_.same_place(b, v))) {
              return CutProblem{
                  s, fmt::format("touches another ring in the projection only, at vertex {}",
                                 chart_.key(v))};
            }
            if (chart_.inside_segment(a, b, v)) inside.push_back(v);
          }
        }
        if (inside.empty()) continue;
        if (!input_.planar) {
          return CutProblem{
              r, fmt::format("touches vertex {} of another ring in the projection, inside "
                             "the edge {}",
                             chart_.key(inside[0]), edge_name(a, b))};
        }
        std::sort(inside.begin(), inside.end(), [&](std::uint32_t v, std::uint32_t w) {
          return v != w && (chart_.x(v) != chart_.x(w)
                                ? (chart_.x(v) < chart_.x(w)) == (chart_.x(a) < chart_.x(b))
                                : (chart_.y(v) < chart_.y(w)) == (chart_.y(a) < chart_.y(b)));
        });
        inside.erase(std::unique(inside.begin(), inside.end()), inside.end());
        rings[r].insert(rings[r].end(), inside.begin(), inside.end());
      }
    }
    input_.rings = std::move(rings);
    return std::nullopt;
  }

  std::optional<CutProblem> check_crossings() const {
    const auto& rings = input_.rings;
    for (std::size_t r = 0; r < rings.size(); ++r) {
      for (std::size_t s = r + 1; s < rings.size(); ++s) {
        for (std::size_t i = 0; i < rings[r].size(); ++i) {
          const std::uint32_t a = rings[r][i], b = rings[r][after(rings[r], i)];
          for (std::size_t j = 0; j < rings[s].size(); ++j) {
            const std::uint32_t c = rings[s][j], d = rings[s][after(rings[s], j)];
            if (!chart_.cross_properly(a, b, c, d)) continue;
            return CutProblem{
                s, fmt::format("crosses {}: edges {} and {}", r == 0 ? "the loop" : "another hole",
                               edge_name(c, d), edge_name(a, b))};
          }
        }
      }
    }
    return std::nullopt;
  }

  std::optional<CutProblem> check_containment() const {
    const auto& rings = input_.rings;
    // Holes run clockwise here, the loop the other way.
    std::vector<std::multiset<DirectedEdge>> edges;
    for (const Ring& ring : rings) edges.push_back(edges_without_hairs(ring));
    for (std::size_t r = 1; r < rings.size(); ++r) {
      for (const auto& [a, b] : edges[r]) {
        // On the loop a hole's edge runs against it if the hole is inside.
        const bool leaves = edges[0].contains({a, b}) || (!edges[0].contains({b, a}) &&
                                                          !chart_.middle_is_inside(edges[0], a, b));
        if (leaves) return CutProblem{r, "leaves the loop at edge " + edge_name(a, b)};
        for (std::size_t s = 1; s < rings.size(); ++s) {
          if (s == r) continue;
          const bool overlaps =
              edges[s].contains({a, b}) ||
              (!edges[s].contains({b, a}) && chart_.middle_is_inside(edges[s], a, b));
          if (overlaps) {
            return CutProblem{r,
                              fmt::format("overlaps hole {} at edge {}", s - 1, edge_name(a, b))};
          }
        }
      }
    }
    return std::nullopt;
  }

  CutInput<Int>& input_;
  const Chart<Int>& chart_;
  bool touches_ = false;
};

}  // namespace gnomon::scene_detail

#endif  // GNOMON_SCENE_PREPARE_RING_CHECK_H
