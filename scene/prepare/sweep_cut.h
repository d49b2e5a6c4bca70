// SPDX-License-Identifier: LGPL-3.0-or-later
// Triangulates a large polygon by a sweep: rule 3 of polygon_cut.h for more corners than ears are
// clipped of.
//
// Vertices are taken in order of x, then y, as if the plane were sheared a little, so that no two
// lie above each other. Diagonals from vertices at which a piece of the region begins or ends
// beside another cut the region into faces that are monotone (Garey, Johnson, Preparata, Tarjan
// 1978; de Berg et al., "Computational Geometry", chapter 3), and these are triangulated by a
// stack. A shear keeps every turn as it is, so that all decisions are those of the chart.
//
// Why no triangle is flat: a vertex that sees the stack from the other chain lies strictly below
// the line of each two vertices of the stack (strictly above, mirrored), since the stack is reflex
// and its first edge lies above the edge from the stack's first vertex; that edge holds no vertex,
// for edges have been cut where vertices lie in them. On the same chain only strict turns are cut
// off.
#ifndef GNOMON_SCENE_PREPARE_SWEEP_CUT_H
#define GNOMON_SCENE_PREPARE_SWEEP_CUT_H

#include <algorithm>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "scene/prepare/ear_clipper.h"
#include "scene/prepare/region_loops.h"

namespace gnomon::scene_detail {

/// Cost: O(n log n).
template <class Int>
class SweepCut {
 public:
  /// Requires: components of one polygon, as RegionTracer makes them.
  SweepCut(const Chart<Int>& chart, const std::vector<RegionComponent>& components)
      : chart_(chart), status_(Below{this}) {
    for (const RegionComponent& component : components) {
      add(component.loop);
      for (const Ring& hole : component.holes) add(hole);
    }
  }
  SweepCut(const SweepCut&) = delete;
  SweepCut& operator=(const SweepCut&) = delete;

  /// False if the components were not what is required, or if the run was stopped.
  bool run(std::vector<Triangle>& triangles) {
    find_events();
    for (const std::uint32_t v : events_) {
      if (chart_.stopped() || !sweep_over(v)) return false;
    }
    return status_.empty() && triangulate_faces(triangles);
  }

 private:
  struct Edge {
    std::uint32_t left, right;  // vertices, in the order of the sweep
    bool inside_is_above;
    // Of the interval above the edge, if that is inside: the last vertex that it met, and whether
    // two intervals became one there and no diagonal leads to it yet.
    std::uint32_t helper = 0;
    bool merged = false;
  };
  struct Point {
    std::uint32_t vertex;
  };
  /// Order of the status: from below to above, of edges that the sweep line meets.
  struct Below {
    using is_transparent = void;
    const SweepCut* sweep;
    bool operator()(std::uint32_t e, std::uint32_t f) const { return sweep->is_below(e, f); }
    bool operator()(std::uint32_t e, Point p) const {
      return sweep->side_of(p.vertex, e) == Sign::kPositive;
    }
    bool operator()(Point p, std::uint32_t e) const {
      return sweep->side_of(p.vertex, e) == Sign::kNegative;
    }
  };
  using Status = std::set<std::uint32_t, Below>;

  bool comes_before(std::uint32_t v, std::uint32_t w) const {
    if (chart_.x(v) != chart_.x(w)) return chart_.x(v) < chart_.x(w);
    return chart_.y(v) < chart_.y(w);
  }
  /// Positive: above the edge.
  Sign side_of(std::uint32_t v, std::uint32_t e) const {
    return chart_.turn(edges_[e].left, edges_[e].right, v);
  }
  bool is_below(std::uint32_t e, std::uint32_t f) const {
    if (e == f) return false;
    const Edge &a = edges_[e], &b = edges_[f];
    if (a.left == b.left) return side_of(b.right, e) == Sign::kPositive;
    if (comes_before(a.left, b.left)) return side_of(b.left, e) == Sign::kPositive;
    return side_of(a.left, f) == Sign::kNegative;
  }

  void add(const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const std::uint32_t a = ring[i], b = ring[after(ring, i)];
      halves_.push_back({a, b});
      if (comes_before(a, b)) {
        edges_.push_back({a, b, true});
      } else {
        edges_.push_back({b, a, false});
      }
    }
  }

  /// All vertices in order, and the edges that begin in each.
  void find_events() {
    by_left_.resize(edges_.size());
    for (std::uint32_t e = 0; e < edges_.size(); ++e) by_left_[e] = e;
    std::sort(by_left_.begin(), by_left_.end(), [&](std::uint32_t e, std::uint32_t f) {
      const std::uint32_t v = edges_[e].left, w = edges_[f].left;
      return v == w ? e < f : comes_before(v, w);
    });
    for (const Edge& edge : edges_) {
      events_.push_back(edge.left);
      events_.push_back(edge.right);
    }
    std::sort(events_.begin(), events_.end(),
              [&](std::uint32_t v, std::uint32_t w) { return comes_before(v, w); });
    events_.erase(std::unique(events_.begin(), events_.end()), events_.end());
  }

  bool sweep_over(std::uint32_t v) {
    auto end = status_.lower_bound(Point{v});
    auto begin = end;
    while (end != status_.end() && edges_[*end].right == v) ++end;
    // An edge that ends in v is neither above nor below it, and so not before `begin`.
    const bool has_lower = begin != status_.begin();
    Edge* const lower = has_lower ? &edges_[*std::prev(begin)] : nullptr;
    const bool lower_inside = has_lower && lower->inside_is_above;
    const bool something_ends = begin != end;
    if (lower_inside) join(*lower, v, !something_ends);
    for (auto at = begin; at != end; ++at) {
      if (edges_[*at].inside_is_above) join(edges_[*at], v, false);
    }
    status_.erase(begin, end);
    const bool something_begins = next_ < by_left_.size() && edges_[by_left_[next_]].left == v;
    for (; next_ < by_left_.size() && edges_[by_left_[next_]].left == v; ++next_) {
      const std::uint32_t e = by_left_[next_];
      if (!status_.insert(e).second) return false;
      edges_[e].helper = v;
    }
    if (lower_inside) {
      lower->helper = v;
      lower->merged = !something_begins;
    }
    return true;
  }

  /// A diagonal from v to the helper of an interval that v meets, if one is needed.
  void join(const Edge& edge, std::uint32_t v, bool always) {
    if (!always && !edge.merged) return;
    halves_.push_back({v, edge.helper});
    halves_.push_back({edge.helper, v});
  }

  // Faces: half-edges leaving a vertex are sorted counter-clockwise, those to the right first.

  /// The direction from v to a comes before that to b.
  bool is_before_around(std::uint32_t v, std::uint32_t a, std::uint32_t b) const {
    const bool a_right = comes_before(v, a), b_right = comes_before(v, b);
    if (a_right != b_right) return a_right;
    return chart_.turn(v, a, b) == Sign::kPositive;
  }

  bool triangulate_faces(std::vector<Triangle>& triangles) {
    std::sort(halves_.begin(), halves_.end(), [&](const DirectedEdge& g, const DirectedEdge& h) {
      if (g.first != h.first) return g.first < h.first;
      return is_before_around(g.first, g.second, h.second);
    });
    first_.assign(chart_.size() + 1, 0);
    for (const DirectedEdge& half : halves_) ++first_[half.first + 1];
    for (std::size_t v = 0; v + 1 < first_.size(); ++v) first_[v + 1] += first_[v];
    std::vector<std::uint8_t> done(halves_.size());
    Ring face;
    for (std::uint32_t start = 0; start < halves_.size(); ++start) {
      if (done[start] != 0) continue;
      if (chart_.stopped()) return false;
      face.clear();
      std::uint32_t h = start;
      do {
        if (done[h] != 0) return false;
        done[h] = 1;
        face.push_back(halves_[h].first);
        h = next_of(h);
      } while (h != start);
      if (!triangulate(face, triangles)) return false;
    }
    return true;
  }

  /// The half-edge that leaves the end of h first clockwise from where h came.
  std::uint32_t next_of(std::uint32_t h) const {
    const auto [u, v] = halves_[h];
    const std::uint32_t begin = first_[v], end = first_[v + 1];
    if (end - begin == 1) return begin;
    const auto at = std::lower_bound(halves_.begin() + begin, halves_.begin() + end, u,
                                     [&, w = v](const DirectedEdge& half, std::uint32_t from) {
                                       return is_before_around(w, half.second, from);
                                     });
    const auto place = static_cast<std::uint32_t>(at - halves_.begin());
    return (place == begin ? end : place) - 1;
  }

  /// A monotone face, counter-clockwise.
  bool triangulate(const Ring& face, std::vector<Triangle>& triangles) {
    if (face.size() < 3) return false;
    const auto before_in_face = [&](std::uint32_t v, std::uint32_t w) {
      return comes_before(v, w);
    };
    const auto [low, high] = std::minmax_element(face.begin(), face.end(), before_in_face);
    const auto first = static_cast<std::size_t>(low - face.begin()),
               last = static_cast<std::size_t>(high - face.begin());
    // From both ends of the loop at once: along the lower chain, and back along the upper one.
    order_.clear();
    std::size_t lower = first, upper = before(face, first);
    order_.push_back({face[first], true});
    lower = after(face, lower);
    while (order_.size() < face.size()) {
      const bool take_lower =
          lower != last && (upper == last || comes_before(face[lower], face[upper]));
      if (lower == last && upper == last) break;
      if (take_lower) {
        order_.push_back({face[lower], true});
        lower = after(face, lower);
      } else {
        order_.push_back({face[upper], false});
        upper = before(face, upper);
      }
      if (!comes_before(order_[order_.size() - 2].vertex, order_.back().vertex)) return false;
    }
    order_.push_back({face[last], true});
    return order_.size() == face.size() && cut_along_chains(triangles);
  }

  bool cut_along_chains(std::vector<Triangle>& triangles) {
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      const Sign turn = chart_.turn(a, b, c);
      if (turn == Sign::kZero) return false;
      if (turn == Sign::kNegative) std::swap(b, c);
      triangles.push_back({a, b, c});
      return true;
    };
    stack_.assign(order_.begin(), order_.begin() + 2);
    for (std::size_t i = 2; i < order_.size(); ++i) {
      const ChainVertex now = order_[i];
      const ChainVertex previous = stack_.back();
      if (i + 1 == order_.size() || now.lower != previous.lower) {
        for (std::size_t k = 0; k + 1 < stack_.size(); ++k) {
          if (!add(now.vertex, stack_[k].vertex, stack_[k + 1].vertex)) return false;
        }
        stack_.assign({previous, now});
        continue;
      }
      const Sign inwards = now.lower ? Sign::kPositive : Sign::kNegative;
      while (stack_.size() >= 2) {
        const std::uint32_t a = stack_[stack_.size() - 2].vertex, b = stack_.back().vertex;
        if (chart_.turn(a, b, now.vertex) != inwards) break;
        if (!add(now.vertex, a, b)) return false;
        stack_.pop_back();
      }
      stack_.push_back(now);
    }
    return true;
  }

  struct ChainVertex {
    std::uint32_t vertex;
    bool lower;  // on the lower chain
  };

  const Chart<Int>& chart_;
  std::vector<Edge> edges_;
  std::vector<DirectedEdge> halves_;  // the inside to the left: edges, and diagonals twice
  std::vector<std::uint32_t> events_, by_left_;
  std::size_t next_ = 0;  // into by_left_
  Status status_;
  std::vector<std::uint32_t> first_;  // by vertex: its first half-edge
  std::vector<ChainVertex> order_, stack_;
};

}  // namespace gnomon::scene_detail

#endif  // GNOMON_SCENE_PREPARE_SWEEP_CUT_H
