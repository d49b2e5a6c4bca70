// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/hidden_lines/edge_survey.h"

#include <utility>

namespace gnomon {

namespace {

/// One edge before the surface. With E the viewer and x(t) = a + t (b - a), the bracket [p, q,
/// x(t)] of an edge (p, q) of a polygon is linear in t; it is negative where the polygon is, as
/// seen from E.
class EdgeSurveyor {
 public:
  EdgeSurveyor(const SeenSurface& surface, EdgeEnds edge)
      : surface_(surface), signs_(surface.signs()), a_(edge.a), b_(edge.b) {}

  EdgeSurvey survey() {
    std::vector<std::uint32_t> found;
    surface_.find_contour(surface_.shaft(a_, b_), found);
    survey_.contour_tests = found.size();
    for (const std::uint32_t i : found) pass_behind(surface_.contour()[i]);
    found.clear();
    surface_.find_parts_on(a_, b_, found);
    survey_.polygon_tests = found.size();
    for (const std::uint32_t i : found) go_through(surface_.parts()[i]);
    sort_and_merge(survey_.breakpoints);
    return std::move(survey_);
  }

  BothSides count_at_start() const {
    std::vector<std::uint32_t> found;
    surface_.find_parts(surface_.shaft(a_, a_), found);
    BothSides count;
    for (const std::uint32_t i : found) {
      const SeenPart& seen = surface_.parts()[i];
      const int side = surface_.side(seen, a_);
      if (side > 0 || (side == 0 && surface_.side(seen, b_) >= 0)) continue;
      count += next_to_start(seen);
    }
    return count;
  }

 private:
  /// The edge passes behind a contour edge where the plane of edge and viewer cuts it, moved a
  /// little to the left or to the right, so that a vertex in the plane is on its other side.
  void pass_behind(const ContourEdge& contour) {
    const EdgeEnds ends = surface_.ends(contour.edge.index());
    const VertexId p = contour.edge.flipped() ? ends.b : ends.a;
    const VertexId q = contour.edge.flipped() ? ends.a : ends.b;
    const int of_p = signs_.bracket(a_, b_, p), of_q = signs_.bracket(a_, b_, q);
    const bool left = (of_p >= 0) != (of_q >= 0), right = (of_p > 0) != (of_q > 0);
    if (!left && !right) {
      if (of_p == 0 && of_q == 0) lie_in_plane(p, q);
      return;
    }
    const int at_a = signs_.bracket(p, q, a_), at_b = signs_.bracket(p, q, b_);
    if (at_a == at_b) return;  // not both zero: else (p, q) were in the plane
    // The viewer sees a point y of the contour edge and a point x of the edge in one place. With E
    // = 0, a [b,p,q] - b [a,p,q] + p [a,b,q] - q [a,b,p] = 0 says that y ([a,b,q] - [a,b,p]) = x
    // ([p,q,a] - [p,q,b]). The first factor less the second is det(b - a, p - a, q - a). So y is
    // strictly between E and x if and only if all three have one sign. Along a direction both
    // factors are equal, and the determinant alone tells.
    const int sense = of_q != 0 ? of_q : -of_p;
    if ((at_a != 0 ? at_a : -at_b) != sense) return;
    if (signs_.volume(a_, b_, p, q) != sense) return;
    if (at_a == 0) survey_.is_start_clear = false;
    if (at_b == 0) survey_.is_end_clear = false;
    if (at_a == 0 || at_b == 0) return;
    const std::int64_t change =
        at_b < 0 ? std::int64_t{contour.multiplicity} : -std::int64_t{contour.multiplicity};
    add(signs_.exact_bracket(p, q, a_), signs_.exact_bracket(p, q, b_),
        {left ? change : 0, right ? change : 0});
  }

  /// A contour edge in the plane of edge and viewer may be in front of an end. Whether it is would
  /// take more to find out than the count there: the ends are counted anew.
  void lie_in_plane(VertexId p, VertexId q) {
    if (signs_.are_collinear(a_, b_, p) && signs_.are_collinear(a_, b_, q)) return;
    survey_.is_start_clear = survey_.is_end_clear = false;
  }

  void add(mpz_class at_start, mpz_class at_end, BothSides change) {
    if (change == BothSides{}) return;
    survey_.breakpoints.emplace_back(std::move(at_start), std::move(at_end), change);
  }

  /// Where the edge goes through a polygon's plane, inside of the polygon or on its border, the
  /// polygon begins or ends to hide it.
  void go_through(const SeenPart& seen) {
    const int side_a = surface_.side(seen, a_), side_b = surface_.side(seen, b_);
    if ((side_a < 0) == (side_b < 0)) return;
    const BothSides hidden = next_to_plane(seen, side_b < 0);
    if (hidden == BothSides{}) return;
    if (side_a == 0) {
      survey_.at_start += hidden;
    } else if (side_b == 0) {
      survey_.at_end += hidden;
    } else {
      add(surface_.exact_side(seen, a_), surface_.exact_side(seen, b_),
          side_b < 0 ? hidden : -hidden);
    }
  }

  /// Whether the polygon hides what is just behind its plane. Requires: one end of the edge is
  /// behind it, the other is not; `ends_behind`: it is b.
  BothSides next_to_plane(const SeenPart& seen, bool ends_behind) const {
    // The plane's point x is inside of (p, q) if det(b - a, p - a, q - a), which is (b - a) . ((p -
    // x) x (q - x)), has the sign of (b - a) . n, n the normal on the viewer's side.
    const int inside = ends_behind ? -1 : 1;
    BothSides hidden{1, 1};
    for (std::uint32_t k = 0; k < surface_.edge_count(seen); ++k) {
      const DirectedEdge edge = surface_.edge(seen, k);
      const int side = signs_.volume(a_, b_, edge.from, edge.to);
      if (side == inside) continue;
      if (side == -inside) return {};
      // x is on the line of (p, q), where the bracket is zero; which sign does it get behind?
      const int at_a = signs_.bracket(edge.from, edge.to, a_);
      const int at_b = signs_.bracket(edge.from, edge.to, b_);
      const int growth = at_b != 0 ? at_b : -at_a;
      if (growth == 0) {
        keep_side_of(seen, hidden);
      } else if ((ends_behind ? growth : -growth) > 0) {
        return {};
      }
    }
    return hidden;
  }

  /// Whether the polygon is seen next to the start. Requires: these points are behind its plane.
  BothSides next_to_start(const SeenPart& seen) const {
    BothSides hidden{1, 1};
    for (std::uint32_t k = 0; k < surface_.edge_count(seen); ++k) {
      const DirectedEdge edge = surface_.edge(seen, k);
      int sign = signs_.bracket(edge.from, edge.to, a_);
      if (sign == 0) sign = signs_.bracket(edge.from, edge.to, b_);
      if (sign > 0) return {};
      if (sign == 0) keep_side_of(seen, hidden);
    }
    return hidden;
  }

  /// An edge of the polygon is in the plane of edge and viewer: the polygon is on one side of it.
  void keep_side_of(const SeenPart& seen, BothSides& hidden) const {
    for (std::uint32_t k = 0; k < surface_.edge_count(seen); ++k) {
      const int side = signs_.bracket(a_, b_, surface_.edge(seen, k).from);
      if (side == 0) continue;
      (side < 0 ? hidden.right : hidden.left) = 0;
      return;
    }
  }

  const SeenSurface& surface_;
  const ViewSigns& signs_;
  VertexId a_, b_;
  EdgeSurvey survey_;
};

}  // namespace

EdgeSurvey survey_edge(const SeenSurface& surface, EdgeEnds edge) {
  return EdgeSurveyor(surface, edge).survey();
}

BothSides count_at_start(const SeenSurface& surface, EdgeEnds edge) {
  return EdgeSurveyor(surface, edge).count_at_start();
}

}  // namespace gnomon
