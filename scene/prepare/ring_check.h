// SPDX-License-Identifier: LGPL-3.0-or-later
// Whether the rings of a polygon are legal (see polygon_cut.h), exactly.
//
// What a ring runs along there and back, a hair or the bridge of a keyhole, bounds nothing: it is
// taken away before other rings are looked at, so that it may lie anywhere among them. A ring that
// crosses itself is refused even where a hair does it: its loop intersects itself. A hair is found
// once vertices that lie in edges are put into them.
#ifndef GNOMON_SCENE_PREPARE_RING_CHECK_H
#define GNOMON_SCENE_PREPARE_RING_CHECK_H

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "scene/prepare/edge_index.h"

namespace gnomon::scene_detail {

/// Cost: O(n log n), and what touches.
template <class Int>
class RingCheck {
 public:
  RingCheck(CutInput<Int>& input, const Chart<Int>& chart) : input_(input), chart_(chart) {}

  /// Also makes holes clockwise.
  std::optional<CutProblem> run() {
    for (std::size_t r = 0; r < input_.rings.size(); ++r) {
      if (auto problem = check_repeated_edges(r)) return problem;
      if (auto problem = check_lengths(r)) return problem;
    }
    std::optional<EdgeIndex<Int>> index(std::in_place, chart_, edges_of_rings());
    input_.tell(0.1);
    if (auto problem = find_touching_vertices(*index)) return problem;
    input_.tell(0.3);
    if (take_edges_apart(index->edges())) index.emplace(chart_, edges_);
    if (drop_hairs()) {
      if (auto problem = check_crossings(*index, &RingCheck::crosses_itself)) return problem;
      index.emplace(chart_, edges_);
    }
    if (auto problem = check_crossings(*index, &RingCheck::is_crossing)) return problem;
    input_.tell(0.5);
    turn_holes();
    if (!needs_tracing()) return std::nullopt;
    return check_containment(*index);
  }

  /// Some ring touches itself or another: RegionTracer must trace edges() anew.
  bool needs_tracing() const { return touches_ || input_.rings.size() > 1; }
  /// Of all rings, without hairs, cut where vertices lie in them: so rings meet in vertices and
  /// whole edges only.
  const std::vector<RingEdge>& edges() const { return edges_; }

 private:
  static CutProblem stop() { return {0, "interrupted", true}; }
  std::string edge_name(std::uint32_t a, std::uint32_t b) const {
    return fmt::format("{}-{}", chart_.key(a), chart_.key(b));
  }
  /// Of the ring's edge that this one is a piece of.
  std::string edge_name(const RingEdge& edge) const {
    const Ring& ring = input_.rings[edge.ring];
    return edge_name(ring[edge.whole], ring[after(ring, edge.whole)]);
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

  /// In the projection vertices may coincide, and an edge may turn back on the one before.
  std::optional<CutProblem> check_lengths(std::size_t r) const {
    if (input_.planar) return std::nullopt;
    const Ring& ring = input_.rings[r];
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const std::uint32_t p = ring[before(ring, i)], v = ring[i], q = ring[after(ring, i)];
      if (chart_.same_place(v, q)) {
        return CutProblem{
            r, fmt::format("touches itself: vertices {} and {} coincide in the projection",
                           chart_.key(v), chart_.key(q))};
      }
      if (p != q && chart_.turn(p, v, q) == Sign::kZero && !chart_.inside_segment(p, q, v)) {
        return CutProblem{
            r, fmt::format("turns back on itself at vertex {} in the projection", chart_.key(v))};
      }
    }
    return std::nullopt;
  }

  std::vector<RingEdge> edges_of_rings() const {
    std::vector<RingEdge> edges;
    for (std::uint32_t r = 0; r < input_.rings.size(); ++r) {
      const Ring& ring = input_.rings[r];
      for (std::uint32_t i = 0; i < ring.size(); ++i) {
        edges.push_back({ring[i], ring[after(ring, i)], r, i});
      }
    }
    return edges;
  }

  /// Fills inside_: the vertices that lie in each edge. A polygon that is not planar must have none
  /// of another ring.
  std::optional<CutProblem> find_touching_vertices(const EdgeIndex<Int>& index) {
    const std::vector<RingEdge>& edges = index.edges();
    inside_.assign(edges.size(), {});
    std::vector<std::uint8_t> seen(input_.x.size());
    std::optional<std::pair<std::uint32_t, CutProblem>> first;
    for (std::uint32_t s = 0; s < input_.rings.size(); ++s) {
      for (const std::uint32_t v : input_.rings[s]) {
        if (std::exchange(seen[v], 1) != 0) {
          touches_ = true;  // a ring comes back to it, or another comes along
          if (input_.planar) continue;
        }
        if (input_.stopped()) return stop();
        index.for_each_near(v, v, [&](std::uint32_t i) {
          const RingEdge& edge = edges[i];
          if (v == edge.a || v == edge.b) return;
          if (input_.planar) {
            if (chart_.inside_segment(edge.a, edge.b, v)) inside_[i].push_back(v);
          } else if (edge.ring != s && (!first || i < first->first)) {
            if (auto problem = touches_in_projection(edge, v, s)) first.emplace(i, *problem);
          }
        });
      }
    }
    if (first) return std::move(first->second);
    return std::nullopt;
  }

  std::optional<CutProblem> touches_in_projection(const RingEdge& edge, std::uint32_t v,
                                                  std::uint32_t ring_of_v) const {
    if (chart_.same_place(edge.a, v) || chart_.same_place(edge.b, v)) {
      return CutProblem{
          ring_of_v,
          fmt::format("touches another ring in the projection only, at vertex {}", chart_.key(v))};
    }
    if (!chart_.inside_segment(edge.a, edge.b, v)) return std::nullopt;
    return CutProblem{edge.ring, fmt::format("touches vertex {} of another ring in the projection, "
                                             "inside the edge {}",
                                             chart_.key(v), edge_name(edge))};
  }

  /// Makes edges_: pieces of edges between the vertices in them. True if they are not the edges as
  /// they were.
  bool take_edges_apart(const std::vector<RingEdge>& edges) {
    for (std::size_t i = 0; i < edges.size(); ++i) {
      RingEdge piece = edges[i];
      std::vector<std::uint32_t>& inside = inside_[i];
      touches_ = touches_ || !inside.empty();
      const std::uint32_t a = piece.a, b = piece.b;
      std::sort(inside.begin(), inside.end(), [&](std::uint32_t v, std::uint32_t w) {
        return v != w && (chart_.x(v) != chart_.x(w)
                              ? (chart_.x(v) < chart_.x(w)) == (chart_.x(a) < chart_.x(b))
                              : (chart_.y(v) < chart_.y(w)) == (chart_.y(a) < chart_.y(b)));
      });
      for (const std::uint32_t v : inside) {
        piece.b = v;
        edges_.push_back(piece);
        piece.a = v;
      }
      piece.b = b;
      edges_.push_back(piece);
    }
    inside_.clear();
    return edges_.size() != edges.size();
  }

  /// Of each ring, edges that it runs along there and back, as often as it does. True if there are
  /// any.
  bool drop_hairs() {
    if (!touches_) return false;
    std::vector<std::uint32_t> order(edges_.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    const auto ends = [&](std::uint32_t i) {
      const RingEdge& edge = edges_[i];
      return std::tuple(edge.ring, std::min(edge.a, edge.b), std::max(edge.a, edge.b));
    };
    std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
      return std::pair(ends(i), i) < std::pair(ends(j), j);
    });
    std::vector<std::uint8_t> dropped(edges_.size());
    std::vector<std::uint32_t> open;  // of one pair of ends, all in one direction
    for (std::size_t k = 0; k < order.size(); ++k) {
      const std::uint32_t i = order[k];
      if (k > 0 && ends(order[k - 1]) != ends(i)) open.clear();
      if (open.empty() || edges_[open.back()].a == edges_[i].a) {
        open.push_back(i);
      } else {
        dropped[i] = dropped[open.back()] = 1;
        open.pop_back();
      }
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      if (dropped[i] == 0) edges_[kept++] = edges_[i];
    }
    const bool any = kept != edges_.size();
    edges_.resize(kept);
    return any;
  }

  /// The first pair of edges of which `crosses` is true: of a ring with itself before those of two
  /// rings.
  std::optional<CutProblem> check_crossings(const EdgeIndex<Int>& index,
                                            bool (RingCheck::*crosses)(const RingEdge&,
                                                                       const RingEdge&)
                                                const) const {
    const std::vector<RingEdge>& edges = index.edges();
    using Place = std::tuple<bool, std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>;
    std::optional<Place> first;
    std::pair<std::uint32_t, std::uint32_t> pair;
    for (std::uint32_t i = 0; i < edges.size(); ++i) {
      if (input_.stopped()) return stop();
      index.for_each_near(edges[i].a, edges[i].b, [&](std::uint32_t j) {
        if (j <= i || !(this->*crosses)(edges[i], edges[j])) return;
        const RingEdge &e = edges[i], &f = edges[j];
        const Place place{e.ring != f.ring, e.ring, f.ring, e.whole, f.whole};
        if (first && *first <= place) return;
        first = place;
        pair = {i, j};
      });
    }
    if (!first) return std::nullopt;
    const RingEdge &e = edges[pair.first], &f = edges[pair.second];
    if (e.ring != f.ring) {
      return CutProblem{f.ring, fmt::format("crosses {}: edges {} and {}",
                                            e.ring == 0 ? "the loop" : "another hole", edge_name(f),
                                            edge_name(e))};
    }
    return CutProblem{e.ring, fmt::format("{} itself: edges {} and {}",
                                          crosses_itself(e, f) ? "crosses" : "touches",
                                          edge_name(e), edge_name(f))};
  }

  bool crosses_itself(const RingEdge& e, const RingEdge& f) const {
    return e.ring == f.ring && chart_.cross_properly(e.a, e.b, f.a, f.b);
  }

  bool is_crossing(const RingEdge& e, const RingEdge& f) const {
    if (chart_.cross_properly(e.a, e.b, f.a, f.b)) return true;
    // Coming back to a vertex, or along an edge, is no crossing: keyhole loops do that on purpose.
    // What is left of a planar polygon meets nowhere else.
    if (input_.planar || e.ring != f.ring) return false;
    const bool shares_vertex = e.a == f.a || e.a == f.b || e.b == f.a || e.b == f.b;
    return !shares_vertex && chart_.meet(e.a, e.b, f.a, f.b);
  }

  void turn_holes() {
    std::vector<std::uint8_t> turned(input_.rings.size());
    for (std::size_t r = 1; r < input_.rings.size(); ++r) {
      Ring& hole = input_.rings[r];
      if (!(chart_.area(hole) > 0)) continue;
      std::reverse(hole.begin() + 1, hole.end());
      turned[r] = 1;
    }
    for (RingEdge& edge : edges_) {
      if (turned[edge.ring] != 0) std::swap(edge.a, edge.b);
    }
  }

  std::optional<CutProblem> check_containment(const EdgeIndex<Int>& index) const {
    // Holes run clockwise here, the loop the other way.
    using Named = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>;  // ring, ends
    std::vector<Named> sorted;
    for (const RingEdge& edge : edges_) sorted.emplace_back(edge.a, edge.b, edge.ring);
    std::sort(sorted.begin(), sorted.end());
    // The rings that have the edge.
    const auto rings_of = [&](std::uint32_t a, std::uint32_t b) {
      std::vector<std::uint32_t> rings;
      for (auto at = std::lower_bound(sorted.begin(), sorted.end(), Named{a, b, 0});
           at != sorted.end() && std::get<0>(*at) == a && std::get<1>(*at) == b; ++at) {
        rings.push_back(std::get<2>(*at));
      }
      return rings;
    };
    const auto contains = [](const std::vector<std::uint32_t>& rings, std::uint32_t ring) {
      return std::find(rings.begin(), rings.end(), ring) != rings.end();
    };
    for (const RingEdge& edge : edges_) {
      if (edge.ring == 0) continue;
      if (input_.stopped()) return stop();
      const auto around = index.rings_around(edge.a, edge.b), along = rings_of(edge.a, edge.b),
                 against = rings_of(edge.b, edge.a);
      // On the loop a hole's edge runs against it if the hole is inside.
      if (contains(along, 0) || (!contains(against, 0) && !contains(around, 0))) {
        return CutProblem{edge.ring, "leaves the loop at edge " + edge_name(edge.a, edge.b)};
      }
      const auto overlaps = [&](std::uint32_t s) {
        return s != 0 && s != edge.ring &&
               (contains(along, s) || (!contains(against, s) && contains(around, s)));
      };
      for (const auto* rings : {&along, &around}) {
        const auto s = std::find_if(rings->begin(), rings->end(), overlaps);
        if (s == rings->end()) continue;
        return CutProblem{edge.ring, fmt::format("overlaps hole {} at edge {}", *s - 1,
                                                 edge_name(edge.a, edge.b))};
      }
    }
    return std::nullopt;
  }

  CutInput<Int>& input_;
  const Chart<Int>& chart_;
  std::vector<std::vector<std::uint32_t>> inside_;  // by edge, before hairs are dropped
  std::vector<RingEdge> edges_;
  bool touches_ = false;
};

}  // namespace gnomon::scene_detail

#endif  // GNOMON_SCENE_PREPARE_RING_CHECK_H
