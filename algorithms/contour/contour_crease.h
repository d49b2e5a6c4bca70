// SPDX-License-Identifier: LGPL-3.0-or-later
// Where another caster passes through a polygon: the line in which they meet is an edge of both, a
// crease. Bodies of contour_walk.h.
//
// The ends of a crease are no input corners. Certified numbers decide about them by bounds; where
// these do not tell, the polygon is open and found otherwise.
#ifndef GNOMON_ALGORITHMS_CONTOUR_CONTOUR_CREASE_H
#define GNOMON_ALGORITHMS_CONTOUR_CONTOUR_CREASE_H

#include "algorithms/contour/contour_walk.h"

namespace gnomon {

// The chord of the polygon along the plane of q, if each passes through the other's plane.
template <class Numbers, class Sides>
bool ContourWalk<Numbers, Sides>::find_crease(std::uint32_t q, Crease<Numbers>& crease) {
  const FacingPolygon& own = polygons_->polygons[p_];
  if (!survey_.sides_of_plane(p_, q, nearer_).both()) return false;
  if (!survey_.sides_of_plane(q, p_).both()) return false;
  const LineThrough chord = survey_.through_plane(p_, q);
  if (chord.cover != LineCover::kBoth) return false;
  if (survey_.through_plane(q, p_).cover != LineCover::kBoth) return false;
  crease.other = q;
  double end_error = 0;
  const auto end_of = [&](std::uint32_t k) {
    const std::uint32_t next = k + 1 == own.count ? 0 : k + 1;
    const T at_k = survey_.depth_over(p_, q, k), at_next = survey_.depth_over(p_, q, next);
    const double error = Numbers::kCertified ? survey_.depth_over_error(p_, q) : 0;
    const PlaceOnEdge place = zero_between<Numbers>(at_k, at_next, error, PlaceName());
    const Vector<T> a = polygons_->corner(own, k), b = polygons_->corner(own, next);
    Vector<T> ray;
    double span = 0;
    for (int i = 0; i < 3; ++i) {
      const T difference = b[i] - a[i];
      ray[i] = a[i] + place.t * difference;
      if constexpr (Numbers::kCertified) span = std::max(span, std::fabs(difference));
    }
    end_error = std::max(end_error, 1.01 * span * place.error);
    return ray;
  };
  crease.from = end_of(chord.in);
  crease.to = end_of(chord.out);
  const Vector<T> along{T(crease.to[0] - crease.from[0]), T(crease.to[1] - crease.from[1]),
                        T(crease.to[2] - crease.from[2])};
  crease.line = cross_product(crease.from, along);
  if constexpr (Numbers::kCertified) {
    // Rays of corners are off by at most 8u, or 2u `reach`; a + t (b - a) rounds by 4u `reach`.
    const double reach = polygons_->reach[p_], length = largest(along);
    crease.end_error = end_error + 16 * Ball::kUnit * reach;
    // Factors off by e and 2e: (2 reach + length) e in each product, two products; roundings.
    crease.line_error =
        2.1 * (2 * reach + length) * crease.end_error + 8 * Ball::kUnit * reach * length;
  }
  return true;
}

template <class Numbers, class Sides>
void ContourWalk<Numbers, Sides>::crease(std::uint32_t q) {
  if (plane(q) == plane(p_)) return;
  Crease<Numbers> crease;
  if (!find_crease(q, crease)) return;
  ContourSum<Numbers>& sum = sums_[p_];
  Stretch<Numbers> inside;
  bool open = false;
  const LineThrough through_other = survey_.through_crease(crease, p_, q, open);
  const bool meets = through_other.cover == LineCover::kBoth &&
                     survey_.interval_of_crease(crease, q, through_other, inside, open);
  if (open) {
    sum.flags |= kContourOpen;
    return;
  }
  if (!meets) return;
  covers_.clear();
  for (const std::uint32_t other : neighbours_) {
    if (other != q && casts(other) && plane(other) != plane(p_)) {
      hide_crease(crease, other, open);
    }
    if (open) {
      sum.flags |= kContourOpen;
      return;
    }
  }
  const Segment<Numbers> whole{inside.low, inside.high, certainly_before(inside.low, inside.high)};
  uncovered<Numbers>({&whole, 1}, covers_, free_);
  T rate = T(dot_product(crease.line, polygons_->corner(polygons_->polygons[p_], 0)) *
             measure_->scale[p_]);
  double per_unit = 1;
  if constexpr (Numbers::kCertified) {
    per_unit = 1 / light_->unit_of_lines();
    rate *= per_unit;
  }
  for (const Segment<Numbers>& segment : free_) {
    sum.flags |= segment.sure ? kHoldsLit | kHoldsShadow : kPerhapsLit | kPerhapsShadow;
    double error = 0;
    if constexpr (Numbers::kCertified) {
      const double reach = polygons_->reach[p_];
      const double value_error =
          (3.1 * crease.line_error + 34 * Ball::kUnit * largest(crease.line)) * reach * per_unit;
      error = share_error(p_, rate, value_error, segment.low, segment.high, 1, 1, 0, 0);
      if (!(error <= 2 * kLeast)) sum.flags |= kContourOpen;
    }
    sum.add(T(T(segment.high.t - segment.low.t) * rate), error);
  }
}

// What hides the crease on its inner side, or takes its place on the outer one.
template <class Numbers, class Sides>
void ContourWalk<Numbers, Sides>::hide_crease(const Crease<Numbers>& crease, std::uint32_t other,
                                              bool& open) {
  const LineThrough through = survey_.through_crease(crease, p_, other, open);
  if (through.cover == LineCover::kNone || open) return;
  Stretch<Numbers> stretch;
  if (!survey_.interval_of_crease(crease, other, through, stretch, open) || open) return;
  T at_from, at_to;
  const MaybeSign from = survey_.crease_nearer(crease, crease.from, p_, other, at_from);
  const MaybeSign to = survey_.crease_nearer(crease, crease.to, p_, other, at_to);
  if (!from.known || !to.known) {
    open = true;
    return;
  }
  if (from.sign == 0 && to.sign == 0) {
    // Three planes in one line. Depths that are equal on it differ by multiples of it.
    const auto slope = [&](std::uint32_t a, std::uint32_t b) {
      return sign_of_value(T(dot_product(light_->depths[plane(a)], crease.line) -
                             dot_product(light_->depths[plane(b)], crease.line)));
    };
    // On the outer side the nearest caster's crease, or its edge, is the border; of several casters
    // of its plane that go across, the first one's.
    const int order_inside = slope(other, crease.other);
    if (through.cover == LineCover::kOuter) {
      if (order_inside < 0) covers_.push_back(stretch);
    } else if (slope(p_, other) < 0) {
      covers_.push_back(stretch);
    } else if (through.cover == LineCover::kBoth &&
               (order_inside < 0 || (order_inside == 0 && other < crease.other))) {
      covers_.push_back(stretch);
    }
    return;
  }
  if (from.sign >= 0 && to.sign >= 0) return;
  if (from.sign > 0 || to.sign > 0) {
    const double error = Numbers::kCertified ? survey_.crease_depth_error(crease, p_, other) : 0;
    const PlaceOnEdge pierced = zero_between<Numbers>(at_from, at_to, error, PlaceName());
    if (from.sign < 0) {
      stretch.high = earlier_of(stretch.high, pierced);
    } else {
      stretch.low = later_of(stretch.low, pierced);
    }
    if (!shorten_cover(stretch.low, stretch.high)) return;
  }
  covers_.push_back(stretch);
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_CONTOUR_CREASE_H
