// SPDX-License-Identifier: LGPL-3.0-or-later
// On which sides of lines and planes the corners of polygons are, and where lines go through
// polygons. Bodies of edge_survey.h.
#ifndef GNOMON_ALGORITHMS_CONTOUR_SURVEY_SIGNS_H
#define GNOMON_ALGORITHMS_CONTOUR_SURVEY_SIGNS_H

#include <bit>
#include <limits>

#include "algorithms/contour/edge_survey.h"

namespace gnomon {

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

// Which corners of the second polygon are ends of edges of the first one, as BlockSigns; anything
// of corners that there are not.
template <class Numbers, class Sides>
unsigned EdgeSurvey<Numbers, Sides>::ends_on_lines(const FacingPolygon& own,
                                                   const FacingPolygon& other) const {
  typedef VertexId Four __attribute__((vector_size(16), aligned(4), may_alias));
  constexpr Four kBits = {1, 2, 4, 8};
  const VertexId* vertices = &polygons_->vertices[own.first];
  const Four others = *reinterpret_cast<const Four*>(&polygons_->vertices[other.first]);
  Four same = {0, 0, 0, 0};
  for (std::uint32_t k = 0; k < own.count; ++k) {
    const Four vertex = {vertices[k], vertices[k], vertices[k], vertices[k]};
    same |= (Four)(others == vertex) & (kBits << 4 * k);
  }
  const unsigned starts = (same[0] | same[1]) | (same[2] | same[3]);
  // Edge k ends in the corner after k.
  return starts | starts >> 4 | starts << 4 * (own.count - 1);
}

template <class Numbers, class Sides>
[[gnu::always_inline]] inline BlockSigns EdgeSurvey<Numbers, Sides>::block_signs(std::uint32_t p,
                                                                                 std::uint32_t q) {
  const FacingPolygon& own = polygons_->polygons[p];
  const FacingPolygon& other = polygons_->polygons[q];
  BlockSigns signs = lanes_->block_signs(polygons_->lines[own.block].x,
                                         &polygons_->line_error[4 * std::size_t{own.block}],
                                         polygons_->reach[q], polygons_->corners[other.block].x);
  const unsigned valid = valid_signs(own.count, other.count);
  signs.positive = static_cast<std::uint16_t>(signs.positive & valid);
  signs.negative = static_cast<std::uint16_t>(signs.negative & valid);
  filtered_ += own.count * other.count;
  if constexpr (Numbers::kCertified) {
    unsigned open = valid & ~(signs.positive | signs.negative);
    if (open == 0) return signs;
    filtered_ -= static_cast<unsigned>(std::popcount(open));
    for (open &= ~ends_on_lines(own, other); open != 0; open &= open - 1) {
      const auto bit = static_cast<std::uint32_t>(std::countr_zero(open));
      const int sign = undecided_side(p, bit / 4, q, bit % 4);
      if (sign > 0) signs.positive = static_cast<std::uint16_t>(signs.positive | 1u << bit);
      if (sign < 0) signs.negative = static_cast<std::uint16_t>(signs.negative | 1u << bit);
    }
  }
  return signs;
}

template <class Numbers, class Sides>
[[gnu::always_inline]] inline LineThrough EdgeSurvey<Numbers, Sides>::through_block(
    std::uint32_t q, unsigned left, unsigned right) const {
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
        const BlockSigns signs =
            lanes_->block_signs(polygons_->lines[own.block + k / 4].x, errors, reach, corners);
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

// --- Depths. ---

template <class Numbers, class Sides>
[[gnu::always_inline]] inline auto EdgeSurvey<Numbers, Sides>::depth(std::uint32_t q,
                                                                     std::uint32_t p,
                                                                     std::uint32_t j) const -> T {
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
    const T difference = (light_->of_heights ? depth(p, p, j) : T(1)) - depth_of_other;
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
  if (sides_->has_memo()) return sides_->of_support(q, p, j);
  const VertexId vertex = polygons_->vertex(polygons_->polygons[p], j);
  const FacingPolygon& other = polygons_->polygons[q];
  for (std::uint32_t i = 0; i < other.count; ++i) {
    if (polygons_->vertex(other, i) == vertex) return 0;
  }
  return sides_->of_support(q, p, j);
}

// The depth at a polygon's own corner is 1 for a near lamp, exactly.
template <class Numbers, class Sides>
auto EdgeSurvey<Numbers, Sides>::depth_over(std::uint32_t p, std::uint32_t q, std::uint32_t j) const
    -> T {
  return T((light_->of_heights ? depth(p, p, j) : T(1)) - depth(q, p, j));
}

// The difference rounds by u of at most 3 M R of each depth (kDepth has room for it).
template <class Numbers, class Sides>
double EdgeSurvey<Numbers, Sides>::depth_over_error(std::uint32_t p, std::uint32_t q) const {
  double bound = 1.1 * light_->depth_error[polygons_->polygons[q].plane];
  if (light_->of_heights) bound += 1.1 * light_->depth_error[polygons_->polygons[p].plane];
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

// Corners that the numbers leave open are asked for last: most often they are on the plane.
template <class Numbers, class Sides>
SidesOfPlane EdgeSurvey<Numbers, Sides>::sides_of_plane(std::uint32_t p, std::uint32_t q,
                                                        const CornerSet& known) {
  const std::uint32_t n = polygons_->polygons[p].count;
  SidesOfPlane sides{known.left != 0, known.right != 0};
  if (sides.both()) return sides;
  if constexpr (Numbers::kCertified) {
    const bool told = n <= CornerSet::kMost &&
                      (known.left | known.right) == ~std::uint64_t{0} >> (CornerSet::kMost - n);
    if (!told && sides_->has_memo()) return sides_->of_support(q, p);
  }
  for (std::uint32_t j = 0; j < n && !sides.both(); ++j) {
    if (j < CornerSet::kMost && ((known.left | known.right) >> j & 1) != 0) continue;
    const int sign = nearer(q, p, j, depth(q, p, j));
    sides.nearer |= sign > 0;
    sides.behind |= sign < 0;
  }
  return sides;
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

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_SURVEY_SIGNS_H
