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

/// Where the place is on its edge, from integers; as it is where it has no name.
template <class Numbers, class Sides>
auto ContourWalk<Numbers, Sides>::sharpest(std::uint32_t k, const PlaceOnEdge& place) const
    -> SharpestPlace {
  const FacingPolygon& own = polygons_->polygons[p_];
  const std::uint32_t next = k + 1 == own.count ? 0 : k + 1;
  const VertexId a = polygons_->vertex(own, k), b = polygons_->vertex(own, next);
  const ExactValues& exact = *light_->exact;
  std::optional<DoubleDouble> t;
  switch (place.name.kind()) {
    case PlaceName::Kind::kLine: {
      const EdgeEnds ends = exact.ends(place.name.index());
      t = exact.crossing(ends.a, ends.b, a, b);
      break;
    }
    case PlaceName::Kind::kVertex:
      t = exact.crossing(place.name.index(),
                         polygons_->vertex(own, next + 1 == own.count ? 0 : next + 1), a, b);
      break;
    case PlaceName::Kind::kSupport:
      t = exact.crossing(place.name.index(), a, b);
      break;
    default:
      break;
  }
  if (!t) return {{place.t, 0}, place.error};
  return {*t, ExactValues::kCrossing};
}

/// `receiver`: what is behind the edge, or nothing for the edge's own polygon. The integral from
/// low to high, or, if `perhaps`, all that it may be. First from doubles of doubles, unless these
/// are what it was found from; then from places in pairs of doubles, of which the difference is
/// known to the last digit, however little of the edge it is.
template <class Numbers, class Sides>
void ContourWalk<Numbers, Sides>::sharpen(std::uint32_t k, const Behind<Numbers>* receiver,
                                          const PlaceOnEdge& low, const PlaceOnEdge& high,
                                          bool perhaps, double& share, double& error) const {
  if (light_->planes.empty()) {
    const double most = perhaps ? ContourBounds::kSharpest : ContourBounds::kSharp;
    const PlaceOnEdge first = sharpened(k, low, most), last = sharpened(k, high, most);
    integrate_sharp(k, receiver, {first.t, last.t - first.t, first.error, last.error}, perhaps,
                    share, error);
    if (perhaps ? error <= kLeast : is_sharp(low, high, error)) return;
  }
  const SharpestPlace first = sharpest(k, low), last = sharpest(k, high);
  const DoubleDouble width = last.t - first.t;
  integrate_sharp(k, receiver, {first.t.high, width.high, first.error, last.error}, perhaps, share,
                  error);
}

template <class Numbers, class Sides>
void ContourWalk<Numbers, Sides>::integrate_sharp(std::uint32_t k, const Behind<Numbers>* receiver,
                                                  SharpStretch stretch, bool perhaps, double& share,
                                                  double& error) const {
  const std::uint32_t q = receiver == nullptr ? p_ : receiver->polygon;
  const FacingPolygon& own = polygons_->polygons[p_];
  const ExactValues& exact = *light_->exact;
  const VertexId from = polygons_->vertex(own, k);
  const VertexId to = polygons_->vertex(own, k + 1 == own.count ? 0 : k + 1);
  // What may have a length has none if it ends before it begins, but for what that is off by.
  PlaceOnEdge first, last;
  first.error = stretch.first_error;
  last.error = stretch.last_error;
  if (stretch.width < 0) {
    first.error -= stretch.width;
    stretch.width = 0;
  }
  last.t = stretch.width;
  double value_error;
  const double value =
      light_->sharp_value(from, to, polygons_->vertex(polygons_->polygons[q], 0),
                          perhaps ? ContourBounds::kSharpest : ContourBounds::kSharp, value_error);
  const double unit = light_->unit();
  value_error = unit * (value_error + 6.1 * Ball::kUnit * std::fabs(value));
  const double rate = value * unit * measure_->scale[q];
  double sharp = receiver == nullptr ? rate * stretch.width : -rate * stretch.width;
  double depth_low = 1, depth_high = 1, depth_error = 0, depth_rate = 0;
  if (receiver != nullptr && !light_->directional) {
    const double depth_from = exact.depth(plane(q), from), depth_to = exact.depth(plane(q), to);
    depth_rate = depth_to - depth_from;
    depth_low = depth_from + stretch.first * depth_rate;
    depth_high = depth_from + (stretch.first + stretch.width) * depth_rate;
    // An end may be where the plane is behind the light. Between the ends round: the rate, the
    // place, their product, and the sum, 1u or 2u each of the greater one.
    depth_error = (ExactValues::kDepth + 9.2 * Ball::kUnit) *
                  std::max(std::fabs(depth_from), std::fabs(depth_to));
    sharp /= depth_low * depth_high;
  }
  if (perhaps) first.error += stretch.width;
  const double bound = share_error(q, rate, value_error, first, last, depth_low, depth_high,
                                   depth_error, depth_rate);
  if (!(bound < error)) return;
  error = bound;
  share = perhaps ? 0 : sharp;
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_CONTOUR_SHARPEN_H
