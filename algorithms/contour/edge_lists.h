// SPDX-License-Identifier: LGPL-3.0-or-later
// What the other polygons are on each edge of one polygon: which of them hide it and where, and
// which lie behind it.
//
// The interval of an edge inside a convex polygon is found without looking at where anything meets:
// the line of the edge splits the corners of the polygon into left and right, and the two edges of
// the polygon that go across are where the line enters and leaves it; on which sides of *their*
// lines the two ends of the edge are tells whether the interval has any length, and whether its
// ends are the edge's own. All of these are signs of input corners, so that a certified kernel
// knows exactly which intervals there are, and doubles only say where they end.
#ifndef GNOMON_ALGORITHMS_CONTOUR_EDGE_LISTS_H
#define GNOMON_ALGORITHMS_CONTOUR_EDGE_LISTS_H

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include "algorithms/contour/facing_polygons.h"
#include "algorithms/contour/input_sides.h"
#include "algorithms/contour/lanes/lanes.h"

namespace gnomon {

template <class Numbers>
struct Stretch {  // of an edge
  Place<Numbers> low, high;
};

/// A polygon behind an edge, or beside it on its outer side, with its depth at the edge's ends.
template <class Numbers>
struct Behind {
  Place<Numbers> low, high;
  typename Numbers::T depth_from{}, depth_to{};
  double depth_error = 0;  // certified
  std::uint32_t polygon = 0;
  bool covers_both = false;  // else on the outer side alone
};

/// What is on one edge. Kept from polygon to polygon, for its memory.
template <class Numbers>
struct EdgeLists {
  std::vector<Stretch<Numbers>> hidden;  // by a caster above the edge's polygon on its inner side
  std::vector<Stretch<Numbers>> taken;   // where another acts in its place, or nothing is behind it
  std::vector<Behind<Numbers>> behind;   // below the edge
  std::vector<Behind<Numbers>> level;    // whose plane holds the edge, and which it may act on
  std::vector<Behind<Numbers>> beside;   // casters at the edge's own depth on its outer side alone
  // What is hidden from the edge's first end on, and to its last: until where, and from where.
  Place<Numbers> first, last;

  void clear() {
    hidden.clear();
    taken.clear();
    behind.clear();
    level.clear();
    beside.clear();
    first = Place<Numbers>::from();
    last = Place<Numbers>::to();
  }
};

/// Which sides of a line a polygon covers along it.
enum class LineCover : std::uint8_t { kNone, kBoth, kInner, kOuter };

/// Where the line of an edge goes through a polygon: it enters through edge `in` and leaves through
/// edge `out`, or through a corner of these that is on the line.
struct LineThrough {
  static constexpr std::uint32_t kNoCorner = 0xffffffffu;
  LineCover cover = LineCover::kNone;
  std::uint32_t in = 0, out = 0;
  std::uint32_t in_corner = kNoCorner, out_corner = kNoCorner;
};

/// Corners of a polygon on the left and on the right of a line, as bits; the others are on it.
struct CornerSet {
  static constexpr std::uint32_t kMost = 64;
  std::uint64_t left = 0, right = 0;
};

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

/// A sign that bounds may leave open.
struct MaybeSign {
  int sign = 0;
  bool known = true;
};

/// Where a line goes through a polygon of three or four corners, by the set of those on its left:
/// it enters through an edge from the left to the right, and leaves through one back.
struct BlockEnds {
  std::uint8_t in = 0, out = 0;
};
constexpr BlockEnds ends_of_block(unsigned n, unsigned left) {
  BlockEnds ends;
  for (unsigned k = n; k-- > 0;) {
    const bool here = left >> k & 1, then = left >> (k + 1) % n & 1;
    if (here && !then) ends.in = static_cast<std::uint8_t>(k);
    if (!here && then) ends.out = static_cast<std::uint8_t>(k);
  }
  return ends;
}
inline constexpr auto kBlockEnds = [] {
  std::array<std::array<BlockEnds, 16>, 2> table{};
  for (unsigned n = 3; n <= 4; ++n) {
    for (unsigned left = 0; left < 1u << n; ++left) table[n - 3][left] = ends_of_block(n, left);
  }
  return table;
}();
/// The bits of BlockSigns that are of lines and corners that there are.
constexpr unsigned valid_signs(std::uint32_t lines, std::uint32_t corners) {
  return (0x1111u >> 4 * (4 - lines)) * ((1u << corners) - 1);
}

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
  BlockSigns block_signs(std::uint32_t p, std::uint32_t q) requires(kInBlocks);
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
  std::vector<CornerSet> sets_;     // of each edge of a polygon: the corners of another
  std::vector<std::int8_t> signs_;  // of the corners of a polygon against a line
};

template <class Numbers, class Sides>
int EdgeSurvey<Numbers, Sides>::side(std::uint32_t p, std::uint32_t k, std::uint32_t q,
                                     std::uint32_t j, T& value) {
  if constexpr (!Numbers::kAsksKernel) {
    const FacingPolygon& own = polygons_->polygons[p];
    value = dot_product(polygons_->line(own, k), polygons_->corner(polygons_->polygons[q], j));
    const double bound = polygons_->error_of_line(own, k) * polygons_->reach[q];
    ++filtered_;
    if (value > bound) return 1;
    if (value < -bound) return -1;
    if constexpr (!Numbers::kCertified) return 0;
    --filtered_;
  }
  return undecided_side(p, k, q, j);
}

// What the numbers leave open: an end of the edge is on its line, all else the kernel decides.
template <class Numbers, class Sides>
int EdgeSurvey<Numbers, Sides>::undecided_side(std::uint32_t p, std::uint32_t k, std::uint32_t q,
                                               std::uint32_t j) {
  const FacingPolygon& own = polygons_->polygons[p];
  const VertexId vertex = polygons_->vertex(polygons_->polygons[q], j);
  if constexpr (Numbers::kCertified) {
    if (vertex == polygons_->vertex(own, k) ||
        vertex == polygons_->vertex(own, k + 1 == own.count ? 0 : k + 1)) {
      return 0;
    }
  }
  return sides_->of_line(p, k, q, j);
}

// The line enters where it goes from corners on the left to corners on the right.
template <class Numbers, class Sides>
LineThrough EdgeSurvey<Numbers, Sides>::name_ends(std::uint32_t q, LineCover cover,
                                                  bool zero_is_left) const {
  const FacingPolygon& other = polygons_->polygons[q];
  const std::uint32_t n = other.count;
  const auto is_left = [&](std::uint32_t j) {
    return signs_[j] > 0 || (signs_[j] == 0 && zero_is_left);
  };
  // A corner on the line is where the line crosses the two edges that meet there.
  const auto corner = [&](std::uint32_t edge, std::uint32_t next) {
    return signs_[edge] == 0 ? edge : signs_[next] == 0 ? next : LineThrough::kNoCorner;
  };
  LineThrough result;
  bool enters = false, leaves = false;
  for (std::uint32_t j = 0; j < n; ++j) {
    const std::uint32_t next = j + 1 == n ? 0 : j + 1;
    const bool left = is_left(j), then_left = is_left(next);
    if (left && !then_left && !enters) {
      enters = true;
      result.in = j;
      result.in_corner = corner(j, next);
    } else if (!left && then_left && !leaves) {
      leaves = true;
      result.out = j;
      result.out_corner = corner(j, next);
    }
  }
  if (enters && leaves) result.cover = cover;
  return result;
}

template <class Numbers, class Sides>
void EdgeSurvey<Numbers, Sides>::find_sign(std::uint32_t p, std::uint32_t k, std::uint32_t q,
                                           std::uint32_t j, CornerSet& set) {
  T value;
  const int sign = side(p, k, q, j, value);
  set.left |= std::uint64_t{sign > 0} << j;
  set.right |= std::uint64_t{sign < 0} << j;
}

template <class Numbers, class Sides>
BlockSigns EdgeSurvey<Numbers, Sides>::block_signs(std::uint32_t p,
                                                   std::uint32_t q) requires(kInBlocks) {
  const FacingPolygon& own = polygons_->polygons[p];
  const FacingPolygon& other = polygons_->polygons[q];
  const double reach = polygons_->reach[q];
  const double* errors = &polygons_->line_error[4 * std::size_t{own.block}];
  const double bounds[4] = {errors[0] * reach, errors[1] * reach, errors[2] * reach,
                            errors[3] * reach};
  BlockSigns signs =
      lanes_->block_signs(polygons_->lines[own.block].x, bounds, polygons_->corners[other.block].x);
  const unsigned valid = valid_signs(own.count, other.count);
  signs.positive = static_cast<std::uint16_t>(signs.positive & valid);
  signs.negative = static_cast<std::uint16_t>(signs.negative & valid);
  filtered_ += static_cast<unsigned>(std::popcount(unsigned{signs.positive} | signs.negative));
  if constexpr (Numbers::kCertified) {
    for (unsigned open = valid & ~(signs.positive | signs.negative); open != 0; open &= open - 1) {
      const auto bit = static_cast<std::uint32_t>(std::countr_zero(open));
      const int sign = undecided_side(p, bit / 4, q, bit % 4);
      if (sign > 0) signs.positive = static_cast<std::uint16_t>(signs.positive | 1u << bit);
      if (sign < 0) signs.negative = static_cast<std::uint16_t>(signs.negative | 1u << bit);
    }
  }
  return signs;
}

template <class Numbers, class Sides>
LineThrough EdgeSurvey<Numbers, Sides>::through_block(std::uint32_t q, unsigned left,
                                                      unsigned right) const {
  const std::uint32_t n = polygons_->polygons[q].count;
  if ((left | right) == (1u << n) - 1) {
    if (left == 0 || right == 0) return {};
    const BlockEnds ends = kBlockEnds[n - 3][left];
    return {LineCover::kBoth, ends.in, ends.out};
  }
  return through_set(q, {left, right});
}

// Four lines and four corners at once where numbers are doubles and decide; what they leave open is
// decided one by one.
template <class Numbers, class Sides>
bool EdgeSurvey<Numbers, Sides>::find_signs(std::uint32_t p, std::uint32_t q) {
  const FacingPolygon& own = polygons_->polygons[p];
  const FacingPolygon& other = polygons_->polygons[q];
  if (sets_.size() < own.count) sets_.resize(own.count);
  if (other.count > CornerSet::kMost) return true;
  const std::uint64_t all = ~std::uint64_t{0} >> (CornerSet::kMost - other.count);
  if constexpr (kInBlocks) {
    const double reach = polygons_->reach[q];
    const auto settle = [&](std::uint32_t k, CornerSet set) {
      set.left &= all;
      set.right &= all;
      filtered_ += static_cast<unsigned>(std::popcount(set.left | set.right));
      if constexpr (Numbers::kCertified) {
        for (std::uint64_t open = all & ~(set.left | set.right); open != 0; open &= open - 1) {
          find_sign(p, k, q, static_cast<std::uint32_t>(std::countr_zero(open)), set);
        }
      }
      sets_[k] = set;
    };
    const double* corners = polygons_->corners[other.block].x;
    if (other.count <= 4) {
      for (std::uint32_t k = 0; k < own.count; k += 4) {
        const double* errors = &polygons_->line_error[4 * std::size_t{own.block} + k];
        const double bounds[4] = {errors[0] * reach, errors[1] * reach, errors[2] * reach,
                                  errors[3] * reach};
        const BlockSigns signs =
            lanes_->block_signs(polygons_->lines[own.block + k / 4].x, bounds, corners);
        for (std::uint32_t i = 0; i < 4 && k + i < own.count; ++i) {
          settle(k + i, {std::uint64_t{signs.positive} >> 4 * i & 15,
                         std::uint64_t{signs.negative} >> 4 * i & 15});
          if (sets_[k + i].left == 0) return false;
        }
      }
    } else {
      for (std::uint32_t k = 0; k < own.count; ++k) {
        const Vector<double> line = polygons_->line(own, k);
        const CornerSigns signs = lanes_->corner_signs(
            line.data(), polygons_->error_of_line(own, k) * reach, corners, other.blocks());
        settle(k, {signs.positive, signs.negative});
        if (sets_[k].left == 0) return false;
      }
    }
  } else {
    for (std::uint32_t k = 0; k < own.count; ++k) {
      sets_[k] = {};
      for (std::uint32_t j = 0; j < other.count; ++j) find_sign(p, k, q, j, sets_[k]);
      if (sets_[k].left == 0) return false;
    }
  }
  return true;
}

// The line enters where it goes from corners on the left to corners on the right.
template <class Numbers, class Sides>
LineThrough EdgeSurvey<Numbers, Sides>::ends_of_set(std::uint32_t q, std::uint64_t left,
                                                    std::uint64_t zero, LineCover cover) const {
  const FacingPolygon& other = polygons_->polygons[q];
  const std::uint32_t n = other.count;
  const std::uint64_t all = ~std::uint64_t{0} >> (CornerSet::kMost - n);
  const std::uint64_t next = (left >> 1 | left << (n - 1)) & all;  // bit j: corner j + 1
  const std::uint64_t entering = left & ~next, leaving = ~left & next & all;
  LineThrough result;
  if (entering == 0 || leaving == 0) return result;  // rounded signs that are no polygon's
  result.cover = cover;
  result.in = static_cast<std::uint32_t>(std::countr_zero(entering));
  result.out = static_cast<std::uint32_t>(std::countr_zero(leaving));
  if (zero != 0) {
    // A corner on the line is where the line crosses the two edges that meet there.
    const auto corner = [&](std::uint32_t edge) {
      const std::uint32_t then = edge + 1 == n ? 0 : edge + 1;
      return zero >> edge & 1 ? edge : zero >> then & 1 ? then : LineThrough::kNoCorner;
    };
    result.in_corner = corner(result.in);
    result.out_corner = corner(result.out);
  }
  return result;
}

template <class Numbers, class Sides>
LineThrough EdgeSurvey<Numbers, Sides>::through_set(std::uint32_t q, const CornerSet& set) const {
  const std::uint64_t all = ~std::uint64_t{0} >> (CornerSet::kMost - polygons_->polygons[q].count);
  const std::uint64_t zero = all & ~(set.left | set.right);
  if (set.left != 0 && set.right != 0) return ends_of_set(q, set.left, zero, LineCover::kBoth);
  if ((zero & (zero - 1)) == 0 || zero == all) return {};  // fewer than two corners on the line
  return set.left != 0 ? ends_of_set(q, set.left, zero, LineCover::kInner)
                       : ends_of_set(q, zero, zero, LineCover::kOuter);
}

template <class Numbers, class Sides>
LineThrough EdgeSurvey<Numbers, Sides>::through(std::uint32_t p, std::uint32_t k, std::uint32_t q) {
  if (polygons_->polygons[q].count > CornerSet::kMost) return through_by_one(p, k, q);
  return through_set(q, sets_[k]);
}

template <class Numbers, class Sides>
LineThrough EdgeSurvey<Numbers, Sides>::through_by_one(std::uint32_t p, std::uint32_t k,
                                                       std::uint32_t q) {
  const std::uint32_t n = polygons_->polygons[q].count;
  signs_.resize(n);
  std::uint32_t left = 0, right = 0;
  T value;
  for (std::uint32_t j = 0; j < n; ++j) {
    const int sign = side(p, k, q, j, value);
    signs_[j] = static_cast<std::int8_t>(sign);
    left += sign > 0;
    right += sign < 0;
  }
  return through_signs(q, left, right);
}

template <class Numbers, class Sides>
LineThrough EdgeSurvey<Numbers, Sides>::through_signs(std::uint32_t q, std::uint32_t left,
                                                      std::uint32_t right) const {
  const auto n = static_cast<std::uint32_t>(signs_.size());
  if (left != 0 && right != 0) return name_ends(q, LineCover::kBoth, false);
  if (left + right + 2 > n || left + right == 0) return {};
  return left != 0 ? name_ends(q, LineCover::kInner, false) : name_ends(q, LineCover::kOuter, true);
}

// An end of the edge that is on the line where it enters is inside if the other end is. For
// polygons in all directions around a lamp: the edge and the part of its line in the polygon are
// arcs of one great circle, each shorter than half of it, so that an edge that starts on the inner
// side of both lines meets the polygon at once or not at all.
template <class Numbers, class Sides>
bool EdgeSurvey<Numbers, Sides>::interval(std::uint32_t p, std::uint32_t k, std::uint32_t q,
                                          const LineThrough& through, Stretch<Numbers>& stretch) {
  const FacingPolygon& own = polygons_->polygons[p];
  const FacingPolygon& other = polygons_->polygons[q];
  const std::uint32_t next = k + 1 == own.count ? 0 : k + 1;
  const Vector<T> from = polygons_->corner(own, k), to = polygons_->corner(own, next);
  const double reach = polygons_->reach[p];
  const auto sign = [&](std::uint32_t edge, const T& value, double bound, std::uint32_t j) {
    if constexpr (!Numbers::kAsksKernel) {
      ++filtered_;
      if (value > bound) return 1;
      if (value < -bound) return -1;
      if constexpr (!Numbers::kCertified) return 0;
      --filtered_;
    }
    return undecided_side(q, edge, p, j);
  };
  const Vector<T> in = polygons_->line(other, through.in);
  const double in_error = polygons_->error_of_line(other, through.in) * reach;
  const T in_from = dot_product(in, from), in_to = dot_product(in, to);
  const int enters_from = sign(through.in, in_from, in_error, k);
  bool starts_inside = enters_from > 0;
  if (!starts_inside) {
    if (sign(through.in, in_to, in_error, next) <= 0) return false;
    starts_inside = enters_from == 0;
  }
  const Vector<T> out = polygons_->line(other, through.out);
  const double out_error = polygons_->error_of_line(other, through.out) * reach;
  const T out_from = dot_product(out, from), out_to = dot_product(out, to);
  const int leaves_to = sign(through.out, out_to, out_error, next);
  if ((starts_inside || leaves_to < 0) && sign(through.out, out_from, out_error, k) <= 0) {
    return false;
  }
  stretch.low = starts_inside
                    ? Place<Numbers>::from()
                    : meeting(p, k, q, through.in, through.in_corner, in_from, in_to, in_error);
  stretch.high = leaves_to >= 0 ? Place<Numbers>::to()
                                : meeting(p, k, q, through.out, through.out_corner, out_from,
                                          out_to, out_error);
  if constexpr (!Numbers::kCertified) return stretch.low.t < stretch.high.t;
  return true;
}

// Where edge k of p crosses the line of an edge of q, with the values of that line at the ends.
// From exact positions they are found again, as differences from an end of q's edge, which are much
// less off for short edges.
template <class Numbers, class Sides>
Place<Numbers> EdgeSurvey<Numbers, Sides>::meeting(std::uint32_t p, std::uint32_t k,
                                                   std::uint32_t q, std::uint32_t edge,
                                                   std::uint32_t corner, const T& at_from,
                                                   const T& at_to, double error) const {
  const FacingPolygon& own = polygons_->polygons[p];
  const FacingPolygon& other = polygons_->polygons[q];
  const PlaceName name = corner != LineThrough::kNoCorner
                             ? PlaceName::vertex(polygons_->vertex(other, corner))
                             : PlaceName::line(polygons_->edge(other, edge).index());
  if constexpr (Numbers::kCertified) {
    if (!light_->positions.empty()) {
      // The same end, whichever polygon asks.
      const PlaneRef ref = polygons_->edge(other, edge);
      const VertexId base =
          polygons_->vertex(other, ref.flipped() ? (edge + 1 == other.count ? 0 : edge + 1) : edge);
      const Vector<double> line = polygons_->line(other, edge);
      double from_size, to_size;
      const Vector<double> from = light_->difference(polygons_->vertex(own, k), base, from_size);
      const Vector<double> to =
          light_->difference(polygons_->vertex(own, k + 1 == own.count ? 0 : k + 1), base, to_size);
      return zero_between<Numbers>(
          dot_product(line, from), dot_product(line, to),
          polygons_->error_of_line(other, edge) * std::max(from_size, to_size), name);
    }
  }
  return zero_between<Numbers>(at_from, at_to, error, name);
}

template <class Numbers, class Sides>
auto EdgeSurvey<Numbers, Sides>::depth(std::uint32_t q, std::uint32_t p, std::uint32_t j) const
    -> T {
  return dot_product(light_->depths[polygons_->polygons[q].plane],
                     polygons_->corner(polygons_->polygons[p], j));
}

template <class Numbers, class Sides>
double EdgeSurvey<Numbers, Sides>::depth_error(std::uint32_t q, std::uint32_t p) const {
  if constexpr (!Numbers::kCertified) return 0;
  return light_->depth_error[polygons_->polygons[q].plane] * polygons_->reach[p];
}

template <class Numbers, class Sides>
int EdgeSurvey<Numbers, Sides>::nearer(std::uint32_t q, std::uint32_t p, std::uint32_t j,
                                       const T& depth_of_other) {
  const PlaneId own = polygons_->polygons[p].plane, other = polygons_->polygons[q].plane;
  if (own == other) return 0;
  if constexpr (Numbers::kAsksKernel) {
    return sides_->of_support(q, p, j);
  } else {
    const T difference = (light_->directional ? depth(p, p, j) : T(1)) - depth_of_other;
    const double bound = Numbers::kCertified ? depth_over_error(p, q) : light_->depth_error[other];
    ++filtered_;
    if (difference > bound) return 1;
    if (difference < -bound) return -1;
    if constexpr (!Numbers::kCertified) return 0;
    --filtered_;
    return undecided_nearer(q, p, j);
  }
}

// A corner of both polygons is on both planes; all else the kernel decides.
template <class Numbers, class Sides>
int EdgeSurvey<Numbers, Sides>::undecided_nearer(std::uint32_t q, std::uint32_t p,
                                                 std::uint32_t j) {
  const VertexId vertex = polygons_->vertex(polygons_->polygons[p], j);
  const FacingPolygon& other = polygons_->polygons[q];
  for (std::uint32_t i = 0; i < other.count; ++i) {
    if (polygons_->vertex(other, i) == vertex) return 0;
  }
  return sides_->of_support(q, p, j);
}

// The depth at a polygon's own corner is 1 for a point light, exactly.
template <class Numbers, class Sides>
auto EdgeSurvey<Numbers, Sides>::depth_over(std::uint32_t p, std::uint32_t q, std::uint32_t j) const
    -> T {
  return T((light_->directional ? depth(p, p, j) : T(1)) - depth(q, p, j));
}

// The difference rounds by u of at most 3 M R of each depth (kDepth has room for it).
template <class Numbers, class Sides>
double EdgeSurvey<Numbers, Sides>::depth_over_error(std::uint32_t p, std::uint32_t q) const {
  double bound = 1.1 * light_->depth_error[polygons_->polygons[q].plane];
  if (light_->directional) bound += 1.1 * light_->depth_error[polygons_->polygons[p].plane];
  return bound * polygons_->reach[p] + Ball::kUnit;
}

// Depths are compared as one linear function of the corners' rays, which is not as sharp as
// nearer(), but takes four corners at a time.
template <class Numbers, class Sides>
CornerSet EdgeSurvey<Numbers, Sides>::find_nearer(std::uint32_t q, std::uint32_t p) const {
  const FacingPolygon& own = polygons_->polygons[p];
  const PlaneId other = polygons_->polygons[q].plane;
  if constexpr (!kInBlocks) {
    return {};
  } else {
    if (own.plane == other) return {};
    const Vector<double>&a = light_->depths[own.plane], &b = light_->depths[other];
    const Vector<double> line{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    double bound = 1.1 * (light_->depth_error[own.plane] + light_->depth_error[other]);
    if constexpr (Numbers::kCertified) bound *= polygons_->reach[p];
    if (!(bound < std::numeric_limits<double>::infinity())) return {};
    const CornerSigns signs =
        lanes_->corner_signs(line.data(), bound, polygons_->corners[own.block].x, own.blocks());
    const std::uint64_t all = ~std::uint64_t{0} >> (CornerSet::kMost - own.count);
    return {signs.positive & all, signs.negative & all};
  }
}

template <class Numbers, class Sides>
int EdgeSurvey<Numbers, Sides>::nearer_beside(std::uint32_t q, std::uint32_t p) {
  for (std::uint32_t j = 0; j < polygons_->polygons[p].count; ++j) {
    const int sign = nearer(q, p, j, depth(q, p, j));
    if (sign != 0) return sign;
  }
  return 0;
}

template <class Numbers, class Sides>
int EdgeSurvey<Numbers, Sides>::nearer_by_far_corner(std::uint32_t q, std::uint32_t p,
                                                     std::uint32_t k) {
  std::uint32_t far = 0;
  T most(-1);
  for (std::uint32_t j = 0; j < polygons_->polygons[q].count; ++j) {
    T value = dot_product(polygons_->line(polygons_->polygons[p], k),
                          polygons_->corner(polygons_->polygons[q], j));
    if (value < 0) value = T(-value);
    if (value > most) {
      most = value;
      far = j;
    }
  }
  return -nearer(p, q, far, depth(p, q, far));
}

// --- Creases. ---

template <class Numbers, class Sides>
LineThrough EdgeSurvey<Numbers, Sides>::through_plane(std::uint32_t p, std::uint32_t q) {
  const std::uint32_t n = polygons_->polygons[p].count;
  signs_.resize(n);
  std::uint32_t left = 0, right = 0;
  for (std::uint32_t j = 0; j < n; ++j) {
    const int sign = nearer(q, p, j, depth(q, p, j));
    signs_[j] = static_cast<std::int8_t>(sign);
    left += sign > 0;
    right += sign < 0;
  }
  return through_signs(p, left, right);
}

// The line is where the depths of its two polygons are equal, the first one's greater on its left.
template <class Numbers, class Sides>
LineThrough EdgeSurvey<Numbers, Sides>::through_crease(const Crease<Numbers>& crease,
                                                       std::uint32_t p, std::uint32_t q,
                                                       bool& open) {
  const FacingPolygon& other = polygons_->polygons[q];
  const PlaneId first = polygons_->polygons[p].plane;
  const PlaneId second = polygons_->polygons[crease.other].plane;
  signs_.resize(other.count);
  std::uint32_t left = 0, right = 0;
  for (std::uint32_t j = 0; j < other.count; ++j) {
    const Vector<T> corner = polygons_->corner(other, j);
    const T value =
        T(dot_product(light_->depths[first], corner) - dot_product(light_->depths[second], corner));
    int sign = sign_of_value(value);
    if constexpr (Numbers::kCertified) {
      const double bound =
          1.1 * (light_->depth_error[first] + light_->depth_error[second]) * polygons_->reach[q];
      if (!(std::fabs(value) > bound)) {
        open = true;
        return {};
      }
    }
    signs_[j] = static_cast<std::int8_t>(sign);
    left += sign > 0;
    right += sign < 0;
  }
  return through_signs(q, left, right);
}

template <class Numbers, class Sides>
bool EdgeSurvey<Numbers, Sides>::interval_of_crease(const Crease<Numbers>& crease, std::uint32_t q,
                                                    const LineThrough& through,
                                                    Stretch<Numbers>& stretch, bool& open) const {
  const FacingPolygon& other = polygons_->polygons[q];
  double error = 0;
  const auto value_of = [&](std::uint32_t edge, const Vector<T>& end, T& value) {
    const Vector<T> line = polygons_->line(other, edge);
    value = dot_product(line, end);
    if constexpr (Numbers::kCertified) {
      error = std::max(error,
                       polygons_->error_of_line(other, edge) * (largest(end) + crease.end_error) +
                           3.1 * largest(line) * crease.end_error);
      if (!(std::fabs(value) > error)) open = true;
    }
    return sign_of_value(value);
  };
  T in_from, in_to, out_from, out_to;
  const int enters_from = value_of(through.in, crease.from, in_from);
  const int enters_to = value_of(through.in, crease.to, in_to);
  const int leaves_from = value_of(through.out, crease.from, out_from);
  const int leaves_to = value_of(through.out, crease.to, out_to);
  if (open) return false;
  const bool starts_inside = enters_from > 0 || (enters_from == 0 && enters_to > 0);
  if (!starts_inside && !(enters_from < 0 && enters_to > 0)) return false;
  if (starts_inside ? leaves_from <= 0 : (leaves_to < 0 && leaves_from <= 0)) return false;
  stretch.low = starts_inside ? Place<Numbers>::from()
                              : zero_between<Numbers>(in_from, in_to, error, PlaceName());
  stretch.high = leaves_to >= 0 ? Place<Numbers>::to()
                                : zero_between<Numbers>(out_from, out_to, error, PlaceName());
  if constexpr (!Numbers::kCertified) return stretch.low.t < stretch.high.t;
  return true;
}

template <class Numbers, class Sides>
MaybeSign EdgeSurvey<Numbers, Sides>::crease_nearer(const Crease<Numbers>& crease,
                                                    const Vector<T>& end, std::uint32_t p,
                                                    std::uint32_t q, T& by) const {
  const Vector<T>& own = light_->depths[polygons_->polygons[p].plane];
  by = T((light_->directional ? dot_product(own, end) : T(1)) -
         dot_product(light_->depths[polygons_->polygons[q].plane], end));
  MaybeSign result{sign_of_value(by), true};
  if constexpr (Numbers::kCertified) {
    result.known = std::fabs(by) > crease_depth_error(crease, p, q);
  }
  return result;
}

template <class Numbers, class Sides>
double EdgeSurvey<Numbers, Sides>::crease_depth_error(const Crease<Numbers>& crease,
                                                      std::uint32_t p, std::uint32_t q) const {
  if constexpr (!Numbers::kCertified) {
    return 0;
  } else {
    const PlaneId own = polygons_->polygons[p].plane, other = polygons_->polygons[q].plane;
    const double size =
        largest(light_->depths[other]) + (light_->directional ? largest(light_->depths[own]) : 0);
    return 1.1 * depth_over_error(p, q) + 3.1 * size * crease.end_error;
  }
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_EDGE_LISTS_H
