// SPDX-License-Identifier: LGPL-3.0-or-later
// Boundary integrals once more, from values that are rounded once: where the doubles' bounds leave
// more of a share open than its printed digits allow. Bodies of contour_walk.h.
//
// A place that has a name is found again by it: by the values of that line, or plane, at the two
// ends of the edge. A place that may be one of two has none, and stays as it is.
#ifndef GNOMON_ALGORITHMS_CONTOUR_CONTOUR_SHARPEN_H
#define GNOMON_ALGORITHMS_CONTOUR_CONTOUR_SHARPEN_H

#include "algorithms/contour/contour_walk.h"

namespace gnomon {

template <class Numbers, class Sides>
auto ContourWalk<Numbers, Sides>::sharpened(std::uint32_t k, const PlaceOnEdge& place,
                                            double most) const -> PlaceOnEdge {
  const FacingPolygon& own = polygons_->polygons[p_];
  const std::uint32_t next = k + 1 == own.count ? 0 : k + 1;
  const VertexId a = polygons_->vertex(own, k), b = polygons_->vertex(own, next);
  double at_a, at_b, a_error, b_error;
  const auto by_line = [&](VertexId from, VertexId to) {
    at_a = light_->sharp_value(from, to, a, most, a_error);
    at_b = light_->sharp_value(from, to, b, most, b_error);
  };
  switch (place.name.kind()) {
    case PlaceName::Kind::kLine: {
      const EdgeEnds ends = light_->exact->ends(place.name.index());
      by_line(ends.a, ends.b);
      break;
    }
    case PlaceName::Kind::kVertex:
      // The line through it and another corner of the polygon, which is not on the edge's line.
      by_line(place.name.index(), polygons_->vertex(own, next + 1 == own.count ? 0 : next + 1));
      break;
    case PlaceName::Kind::kSupport:
      at_a = light_->exact->support(place.name.index(), a);
      at_b = light_->exact->support(place.name.index(), b);
      a_error = ExactValues::kSupport * std::fabs(at_a);
      b_error = ExactValues::kSupport * std::fabs(at_b);
      break;
    default:
      return place;
  }
  if ((at_a > 0) == (at_b > 0) && (at_a < 0) == (at_b < 0)) return place;
  const PlaceOnEdge result =
      zero_between<Numbers>(at_a, at_b, std::max(a_error, b_error), place.name);
  return result.error < place.error ? result : place;
}

/// `receiver`: what is behind the edge, or nothing for the edge's own polygon. The integral from
/// low to high, or, if `perhaps`, all that it may be.
template <class Numbers, class Sides>
void ContourWalk<Numbers, Sides>::sharpen(std::uint32_t k, const Behind<Numbers>* receiver,
                                          const PlaceOnEdge& low, const PlaceOnEdge& high,
                                          bool perhaps, double& share, double& error) const {
  const std::uint32_t q = receiver == nullptr ? p_ : receiver->polygon;
  const FacingPolygon& own = polygons_->polygons[p_];
  const ExactValues& exact = *light_->exact;
  const double most = perhaps ? ContourBounds::kSharpest : ContourBounds::kSharp;
  PlaceOnEdge first = sharpened(k, low, most), last = sharpened(k, high, most);
  // What may have a length has none if it ends before it begins, but for what that is off by.
  if (last.t < first.t) {
    first.error += first.t - last.t;
    last.t = first.t;
  }
  double value_error;
  const double value = light_->sharp_value(
      polygons_->vertex(own, k), polygons_->vertex(own, k + 1 == own.count ? 0 : k + 1),
      polygons_->vertex(polygons_->polygons[q], 0), most, value_error);
  const double unit = exact.unit();
  value_error = unit * (value_error + 6.1 * Ball::kUnit * std::fabs(value));
  const double rate = value * unit * measure_->scale[q];
  double sharp = rate * (receiver == nullptr ? last.t - first.t : first.t - last.t);
  double depth_low = 1, depth_high = 1, depth_error = 0, depth_rate = 0;
  if (receiver != nullptr && !light_->directional) {
    const VertexId next = polygons_->vertex(own, k + 1 == own.count ? 0 : k + 1);
    const double from = exact.depth(plane(q), polygons_->vertex(own, k));
    const double to = exact.depth(plane(q), next);
    depth_rate = to - from;
    depth_low = from + first.t * depth_rate;
    depth_high = from + last.t * depth_rate;
    depth_error = (ExactValues::kDepth + 3 * Ball::kUnit) * std::max(from, to);
    sharp /= depth_low * depth_high;
  }
  if (perhaps) first.error += std::fabs(last.t - first.t);
  const double bound = share_error(q, rate, value_error, first, last, depth_low, depth_high,
                                   depth_error, depth_rate);
  if (!(bound < error)) return;
  error = bound;
  share = perhaps ? 0 : sharp;
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_CONTOUR_SHARPEN_H
