// SPDX-License-Identifier: LGPL-3.0-or-later
// Boundary integrals of the contour method: what a stretch of an edge adds to a polygon's share, or
// takes from it. Bodies of contour_walk.h.
//
// The area of the triangle between corner c of a polygon R and the points in which the rays r(s)
// and r(t) of an edge meet R's plane is, in units that all stretches over R share, det(c, r(s),
// r(t)) / (w(s) w(t)) with w the depth n / h of R's plane on a ray, which is 1 at c (point lights;
// of a sun the rays themselves are points of a chart and there is no w). As r is linear, r(s) x
// r(t) = (t - s) n with the line n of the edge, so that this is (t - s) (n . c) / (w(s) w(t)).
#ifndef GNOMON_ALGORITHMS_CONTOUR_CONTOUR_INTEGRALS_H
#define GNOMON_ALGORITHMS_CONTOUR_CONTOUR_INTEGRALS_H

#include "algorithms/contour/contour_walk.h"

namespace gnomon {

/// n . c for edge k of p and corner 0 of q, and its error.
template <class Numbers, class Sides>
auto ContourWalk<Numbers, Sides>::value_of(std::uint32_t k, std::uint32_t q, double& error) const
    -> T {
  const FacingPolygon& own = polygons_->polygons[p_];
  const FacingPolygon& other = polygons_->polygons[q];
  if constexpr (Numbers::kCertified) {
    if (!light_->planes.empty()) {
      return light_->planes.value(polygons_->edge(own, k), polygons_->vertex(other, 0), error);
    }
    error = light_->proven(polygons_->error_of_line(own, k) * polygons_->reach[q]);
  }
  return dot_product(polygons_->line(own, k), polygons_->corner(other, 0));
}

template <class Numbers, class Sides>
void ContourWalk<Numbers, Sides>::add_own(std::uint32_t k, const Segment<Numbers>& segment) {
  ContourSum<Numbers>& sum = sums_[p_];
  sum.flags |= segment.sure ? kHoldsLit : kPerhapsLit;
  const std::uint32_t n = polygons_->polygons[p_].count;
  if (k == 0 || k + 1 == n) return;  // corner 0 is on it
  double value_error = 0;
  const T rate = T(value_of(k, p_, value_error) * measure_->scale[p_]);
  T share = T(T(segment.high.t - segment.low.t) * rate);
  double error = 0;
  if constexpr (Numbers::kCertified) {
    error = share_error(p_, rate, value_error, segment.low, segment.high, 1, 1, 0, 0);
    if (!is_sharp(segment.low, segment.high, error)) {
      sharpen(k, nullptr, segment.low, segment.high, false, share, error);
      if (!is_sharp(segment.low, segment.high, error)) sum.flags |= kContourOpen;
    }
  }
  sum.add(share, error);
}

/// Bound of the error of (t - s) (n . c) scale / (w(s) w(t)) in doubles; the scale is a number like
/// any other here, and what it is off by is seen to at the end (contour_classes.h).
///
/// With V = |n . c| scale: the derivative by t is V / w(t)^2, that by s alike, so that a place off
/// by e moves the integral by V e / w^2, w the least wherever the place may be. Where w changes by
/// less than 2^-10 of itself on the way, that is within 1 %; else doubled. n . c is off by its
/// bound, each w by `depth_error`; n . c scale, t - s, three products and a quotient round by 6u.
/// `depth_rate`: by how much w changes along the edge.
template <class Numbers, class Sides>
inline double ContourWalk<Numbers, Sides>::share_error(std::uint32_t q, double rate,
                                                       double line_value_error,
                                                       const PlaceOnEdge& low,
                                                       const PlaceOnEdge& high, double depth_low,
                                                       double depth_high, double depth_error,
                                                       double depth_rate) const {
  const double value_error = line_value_error * measure_->scale[q];
  const double least = std::min(depth_low, depth_high) - depth_error;
  const double change = (std::fabs(depth_rate) + depth_error) * std::max(low.error, high.error);
  if (!(depth_error + change < 0.25 * least)) return std::numeric_limits<double>::infinity();
  const double width = std::fabs(high.t - low.t), size = std::fabs(rate) + value_error;
  const double places = (change < 0x1p-10 * least ? 1.01 : 2) * (low.error + high.error);
  const double sum = size * (places + 6 * Ball::kUnit * width) + width * value_error;
  if (depth_error == 0) return 1.01 * sum;
  const double inverse = 1 / least;
  return 1.01 * inverse * inverse *
         (sum + (depth_error < 0x1p-10 * least ? 2.1 : 3) * size * width * depth_error * inverse);
}

/// w of a plane behind edge k at two places of it. Of a far lamp it is 1 + perspective (height - z)
/// at the edge's ends, whose second term is off by that much of what a height is off by, of the
/// rounding of the difference and the product (2u), and of perspective (5u) and z (2u) besides; 1 +
/// that rounds by u, and in between by 3u.
template <class Numbers, class Sides>
auto ContourWalk<Numbers, Sides>::quotients(std::uint32_t k, const Behind<Numbers>& receiver,
                                            const PlaceOnEdge& low, const PlaceOnEdge& high) const
    -> Quotients {
  if (light_->heights.empty()) {
    return {depth_at(receiver, low), depth_at(receiver, high), kDepthBetween * receiver.depth_error,
            T(receiver.depth_to - receiver.depth_from)};
  }
  const FacingPolygon& own = polygons_->polygons[p_];
  const T& z_from = light_->heights[polygons_->vertex(own, k)];
  const T& z_to = light_->heights[polygons_->vertex(own, k + 1 == own.count ? 0 : k + 1)];
  const T from = T(1 + light_->perspective * T(receiver.depth_from - z_from));
  const T to = T(1 + light_->perspective * T(receiver.depth_to - z_to));
  Quotients result;
  result.change = T(to - from);
  result.low = T(from + low.t * result.change);
  result.high = T(from + high.t * result.change);
  if constexpr (Numbers::kCertified) {
    const double size = std::max(std::fabs(receiver.depth_from) + std::fabs(z_from),
                                 std::fabs(receiver.depth_to) + std::fabs(z_to));
    result.error = 1.01 * light_->perspective * (receiver.depth_error + 10 * Ball::kUnit * size) +
                   4.1 * Ball::kUnit * std::max(std::fabs(from), std::fabs(to));
  }
  return result;
}

template <class Numbers, class Sides>
void ContourWalk<Numbers, Sides>::take_from(std::uint32_t k, const Behind<Numbers>& receiver,
                                            const PlaceOnEdge& low, const PlaceOnEdge& high) {
  ++segments_;
  const std::uint32_t q = receiver.polygon;
  ContourSum<Numbers>& sum = sums_[q];
  sum.flags |= kHoldsLit | kHoldsShadow;
  double value_error = 0;
  const T rate = T(value_of(k, q, value_error) * measure_->scale[q]);
  T share = T(T(low.t - high.t) * rate);
  double error = 0;
  if (!light_->directional) {
    const Quotients w = quotients(k, receiver, low, high);
    share = T(share / T(w.low * w.high));
    if constexpr (Numbers::kCertified) {
      error = share_error(q, rate, value_error, low, high, w.low, w.high, w.error, w.change);
    }
  } else if constexpr (Numbers::kCertified) {
    error = share_error(q, rate, value_error, low, high, 1, 1, 0, 0);
  }
  if constexpr (Numbers::kCertified) {
    if (!is_sharp(low, high, error)) {
      sharpen(k, &receiver, low, high, false, share, error);
      if (!is_sharp(low, high, error)) sum.flags |= kContourOpen;
    }
  }
  sum.add(share, error);
}

// Nothing is taken, but up to the whole sliver might be.
template <class Numbers, class Sides>
void ContourWalk<Numbers, Sides>::take_perhaps(std::uint32_t k, const Behind<Numbers>& receiver,
                                               const PlaceOnEdge& low, const PlaceOnEdge& high) {
  if constexpr (Numbers::kCertified) {
    const std::uint32_t q = receiver.polygon;
    ContourSum<Numbers>& sum = sums_[q];
    sum.flags |= kPerhapsLit | kPerhapsShadow;
    double value_error = 0;
    const double rate = value_of(k, q, value_error) * measure_->scale[q];
    PlaceOnEdge first = low, last = high;
    first.error += std::fabs(high.t - low.t);
    double error;
    if (light_->directional) {
      error = share_error(q, rate, value_error, first, last, 1, 1, 0, 0);
    } else {
      const Quotients w = quotients(k, receiver, low, high);
      error = share_error(q, rate, value_error, first, last, w.low, w.high, w.error, w.change);
    }
    double share = 0;
    if (!(error <= kLeast)) sharpen(k, &receiver, low, high, true, share, error);
    if (!(error <= kLeast)) sum.flags |= kContourOpen;
    sum.add(share, error);
  }
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_CONTOUR_INTEGRALS_H
