// SPDX-License-Identifier: LGPL-3.0-or-later
// How other polygons lie to the edges of one polygon, by signs of input corners: bodies are in
// survey_signs.h, survey_intervals.h and survey_creases.h.
//
// The interval of an edge inside a convex polygon is found without looking at where anything meets:
// the line of the edge splits the corners of the polygon into left and right, and the two edges of
// the polygon that go across are where the line enters and leaves it; on which sides of *their*
// lines the two ends of the edge are tells whether the interval has any length, and whether its
// ends are the edge's own. All of these are signs of input corners, so that a certified kernel
// knows exactly which intervals there are, and doubles only say where they end.
#ifndef GNOMON_ALGORITHMS_CONTOUR_EDGE_SURVEY_H
#define GNOMON_ALGORITHMS_CONTOUR_EDGE_SURVEY_H

#include <array>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "algorithms/contour/facing_polygons.h"
#include "algorithms/contour/input_sides.h"
#include "algorithms/contour/lanes/lanes.h"
#include "algorithms/contour/line_through.h"
#include "algorithms/contour/stretches.h"

namespace gnomon {

/// The crease of two polygons from one end of the first one's chord to the other, the side on which
/// the first is nearer on its left.
template <class Numbers>
struct Crease {
  using T = typename Numbers::T;
  std::uint32_t other = 0;   // the caster that passes through
  Vector<T> from, to, line;  // rays of its ends, and the line through them
  double end_error = 0;      // certified: of a component of `from` and `to`
  double line_error = 0;     // certified: of a component of `line`
};

template <class Numbers, class Sides>
class EdgeSurvey {
 public:
  using T = typename Numbers::T;
  /// Whether signs are found four lines and four corners at a time.
  static constexpr bool kInBlocks = std::is_same_v<T, double> && !Numbers::kAsksKernel;
  EdgeSurvey(const LightRays<Numbers>& light, const FacingPolygons<Numbers>& polygons, Sides& sides,
             const Lanes& lanes)
      : light_(&light), polygons_(&polygons), sides_(&sides), lanes_(&lanes) {}

  /// Sign of the line of edge k of p at corner j of q; its value in `value`.
  int side(std::uint32_t p, std::uint32_t k, std::uint32_t q, std::uint32_t j, T& value);
  int undecided_side(std::uint32_t p, std::uint32_t k, std::uint32_t q, std::uint32_t j);
  int undecided_nearer(std::uint32_t q, std::uint32_t p, std::uint32_t j);
  /// The signs of the lines of all edges of p at the corners of q, for sides_of_line(). False: no
  /// corner of q is inside of one of the lines, so that the two do not overlap.
  bool find_signs(std::uint32_t p, std::uint32_t q);
  /// Where the line of edge k of polygon p goes through polygon q. Requires: find_signs(p, q).
  LineThrough through(std::uint32_t p, std::uint32_t k, std::uint32_t q);
  /// The same without find_signs().
  LineThrough through_by_one(std::uint32_t p, std::uint32_t k, std::uint32_t q);
  /// The same for polygons of at most four corners in doubles, as one block of signs; what the
  /// numbers leave open is decided.
  BlockSigns block_signs(std::uint32_t p, std::uint32_t q);
  /// Where the line goes whose signs of four corners are in a block, of a polygon of n corners.
  LineThrough through_block(std::uint32_t q, unsigned left, unsigned right) const;
  /// Decisions that the numbers made, without the kernel; those of find_nearer() are not counted.
  std::uint64_t filtered() const { return filtered_; }
  /// Whether, by find_signs(), no corner is inside of edge k's line.
  bool is_outside(std::uint32_t k) const { return sets_[k].left == 0; }
  /// False if all corners are on one side of edge k's line, by find_signs().
  bool may_go_through(std::uint32_t k, std::uint32_t q) const {
    const std::uint32_t count = polygons_->polygons[q].count;
    if (count > CornerSet::kMost) return true;
    const std::uint64_t all = ~std::uint64_t{0} >> (CornerSet::kMost - count);
    return sets_[k].left != all && sets_[k].right != all;
  }
  /// The signs and values of the lines of q at the corners of p, for interval_in_block(). False:
  /// all corners are on or beyond one of the lines, so that the two do not overlap.
  bool find_values(std::uint32_t q, std::uint32_t p);
  /// As interval(), from find_values(q, p).
  bool interval_in_block(std::uint32_t p, std::uint32_t k, std::uint32_t q,
                         const LineThrough& through, Stretch<Numbers>& stretch);
  /// The interval of edge k of p in q, which its line goes `through`. False: there is none.
  bool interval(std::uint32_t p, std::uint32_t k, std::uint32_t q, const LineThrough& through,
                Stretch<Numbers>& stretch);
  /// The depth of q's plane on the ray of corner j of p.
  T depth(std::uint32_t q, std::uint32_t p, std::uint32_t j) const;
  double depth_error(std::uint32_t q, std::uint32_t p) const;
  /// 1 if corner j of p is nearer than the plane of q, -1 if it is behind, 0 on it; `depth`: of q
  /// there.
  int nearer(std::uint32_t q, std::uint32_t p, std::uint32_t j, const T& depth);
  /// The corners of p that are nearer than the plane of q, to the left, and those that are behind
  /// it, to the right, as far as the numbers tell. Requires: at most CornerSet::kMost corners.
  CornerSet find_nearer(std::uint32_t q, std::uint32_t p) const;
  /// Whether p has corners that are nearer than the plane of q, and such that are behind it; what
  /// comes after both is not asked for. `known`: find_nearer(q, p), or nothing.
  SidesOfPlane sides_of_plane(std::uint32_t p, std::uint32_t q, const CornerSet& known);
  SidesOfPlane sides_of_plane(std::uint32_t p, std::uint32_t q) {
    const bool few = polygons_->polygons[p].count <= CornerSet::kMost;
    return sides_of_plane(p, q, few ? find_nearer(q, p) : CornerSet{});
  }
  /// How much nearer corner j of p is than the plane of q, in units of depth, and the bound of
  /// that.
  T depth_over(std::uint32_t p, std::uint32_t q, std::uint32_t j) const;
  double depth_over_error(std::uint32_t p, std::uint32_t q) const;
  /// 1 if polygon p is nearer than the plane of q on the inner side of its edge, which lies in
  /// that plane; 0 if the planes are one.
  int nearer_beside(std::uint32_t q, std::uint32_t p);
  /// The same, taken from the corner of q that is farthest from edge k of p, whichever its side:
  /// wrong, and what Rules::equal_depth_by_its_planes turns to.
  int nearer_by_far_corner(std::uint32_t q, std::uint32_t p, std::uint32_t k);

  /// Where the plane of q cuts polygon p, what is nearer than q on the left: kBoth if corners are
  /// on both sides.
  LineThrough through_plane(std::uint32_t p, std::uint32_t q);
  /// Where the line of a crease of p goes through polygon q; `open`: the bounds do not tell.
  LineThrough through_crease(const Crease<Numbers>& crease, std::uint32_t p, std::uint32_t q,
                             bool& open);
  bool interval_of_crease(const Crease<Numbers>& crease, std::uint32_t q,
                          const LineThrough& through, Stretch<Numbers>& stretch, bool& open) const;
  /// Whether an end of a crease of p is nearer than the plane of q, and by how much.
  MaybeSign crease_nearer(const Crease<Numbers>& crease, const Vector<T>& end, std::uint32_t p,
                          std::uint32_t q, T& by) const;
  double crease_depth_error(const Crease<Numbers>& crease, std::uint32_t p, std::uint32_t q) const;

 private:
  unsigned ends_on_lines(const FacingPolygon& own, const FacingPolygon& other) const;
  LineThrough name_ends(std::uint32_t q, LineCover cover, bool zero_is_left) const;
  void find_sign(std::uint32_t p, std::uint32_t k, std::uint32_t q, std::uint32_t j,
                 CornerSet& set);
  LineThrough through_set(std::uint32_t q, const CornerSet& set) const;
  Place<Numbers> meeting(std::uint32_t p, std::uint32_t k, std::uint32_t q, std::uint32_t edge,
                         std::uint32_t corner, const T& at_from, const T& at_to,
                         double error) const;
  LineThrough ends_of_set(std::uint32_t q, std::uint64_t left, std::uint64_t zero,
                          LineCover cover) const;
  /// From signs_, of which so many are on the left and on the right.
  LineThrough through_signs(std::uint32_t q, std::uint32_t left, std::uint32_t right) const;

  const LightRays<Numbers>* light_;
  const FacingPolygons<Numbers>* polygons_;
  Sides* sides_;
  const Lanes* lanes_;
  std::uint64_t filtered_ = 0;
  struct {  // by line and corner, as BlockSigns
    BlockSigns signs;
    std::uint16_t zero;  // decided to be so
    std::array<double, 16> values;
  } block_{};
  std::vector<CornerSet> sets_;     // of each edge of a polygon: the corners of another
  std::vector<std::int8_t> signs_;  // of the corners of a polygon against a line
};

}  // namespace gnomon

#include "algorithms/contour/survey_creases.h"
#include "algorithms/contour/survey_intervals.h"
#include "algorithms/contour/survey_signs.h"

#endif  // GNOMON_ALGORITHMS_CONTOUR_EDGE_SURVEY_H
