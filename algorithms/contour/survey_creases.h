// SPDX-License-Identifier: LGPL-3.0-or-later
// Creases against other polygons. Bodies of edge_survey.h.
#ifndef GNOMON_ALGORITHMS_CONTOUR_SURVEY_CREASES_H
#define GNOMON_ALGORITHMS_CONTOUR_SURVEY_CREASES_H

#include "algorithms/contour/edge_survey.h"

namespace gnomon {

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
  const std::array<int, 4> signs = {
      value_of(through.in, crease.from, in_from), value_of(through.in, crease.to, in_to),
      value_of(through.out, crease.from, out_from), value_of(through.out, crease.to, out_to)};
  if (open) return false;
  const IntervalEnds ends =
      ends_of_interval([&](bool leaves, bool at_to) { return signs[2 * leaves + at_to]; });
  if (!ends.meets) return false;
  stretch.low = ends.starts_inside ? Place<Numbers>::from()
                                   : zero_between<Numbers>(in_from, in_to, error, PlaceName());
  stretch.high = ends.ends_inside ? Place<Numbers>::to()
                                  : zero_between<Numbers>(out_from, out_to, error, PlaceName());
  if constexpr (!Numbers::kCertified) return stretch.low.t < stretch.high.t;
  return true;
}

template <class Numbers, class Sides>
MaybeSign EdgeSurvey<Numbers, Sides>::crease_nearer(const Crease<Numbers>& crease,
                                                    const Vector<T>& end, std::uint32_t p,
                                                    std::uint32_t q, T& by) const {
  const Vector<T>& own = light_->depths[polygons_->polygons[p].plane];
  by = T((light_->of_heights ? dot_product(own, end) : T(1)) -
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
        largest(light_->depths[other]) + (light_->of_heights ? largest(light_->depths[own]) : 0);
    return 1.1 * depth_over_error(p, q) + 3.1 * size * crease.end_error;
  }
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_SURVEY_CREASES_H
