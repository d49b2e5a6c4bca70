// SPDX-License-Identifier: LGPL-3.0-or-later
// The interval of an edge inside another polygon. Bodies of edge_survey.h.
#ifndef GNOMON_ALGORITHMS_CONTOUR_SURVEY_INTERVALS_H
#define GNOMON_ALGORITHMS_CONTOUR_SURVEY_INTERVALS_H

#include "algorithms/contour/edge_survey.h"

namespace gnomon {

template <class Numbers, class Sides>
bool EdgeSurvey<Numbers, Sides>::find_values(std::uint32_t q, std::uint32_t p) {
  const FacingPolygon& own = polygons_->polygons[p];
  const FacingPolygon& other = polygons_->polygons[q];
  block_.signs = lanes_->block_values(
      polygons_->lines[other.block].x, &polygons_->line_error[4 * std::size_t{other.block}],
      polygons_->reach[p], polygons_->corners[own.block].x, block_.values.data());
  block_.zero = 0;
  const unsigned valid = valid_signs(other.count, own.count);
  return lines_with_any(valid & ~unsigned{block_.signs.negative}) == (valid & 0x1111u);
}

template <class Numbers, class Sides>
bool EdgeSurvey<Numbers, Sides>::interval_in_block(std::uint32_t p, std::uint32_t k,
                                                   std::uint32_t q, const LineThrough& through,
                                                   Stretch<Numbers>& stretch) {
  const std::uint32_t next = k + 1 == polygons_->polygons[p].count ? 0 : k + 1;
  const auto sign = [&](std::uint32_t edge, std::uint32_t j) {
    const std::uint32_t bit = 4 * edge + j;
    if (block_.signs.positive >> bit & 1) return 1;
    if (block_.signs.negative >> bit & 1) return -1;
    if (!Numbers::kCertified || block_.zero >> bit & 1) return 0;
    const int decided = undecided_side(q, edge, p, j);
    std::uint16_t& set = decided > 0   ? block_.signs.positive
                         : decided < 0 ? block_.signs.negative
                                       : block_.zero;
    set = static_cast<std::uint16_t>(set | 1u << bit);
    return decided;
  };
  const unsigned inside = block_.signs.positive, known = inside | block_.signs.negative;
  const unsigned in_from = 1u << (4 * through.in + k), in_to = 1u << (4 * through.in + next);
  const unsigned out_from = 1u << (4 * through.out + k), out_to = 1u << (4 * through.out + next);
  IntervalEnds ends;
  if ((~known & (in_from | in_to | out_from | out_to)) == 0) {
    ends = ends_of_known_interval((inside & in_from) != 0, (inside & in_to) != 0,
                                  (inside & out_from) != 0, (inside & out_to) != 0);
  } else {
    ends = ends_of_interval([&](bool leaves, bool at_to) {
      return sign(leaves ? through.out : through.in, at_to ? next : k);
    });
  }
  if (!ends.meets) return false;
  const auto place = [&](std::uint32_t edge, std::uint32_t corner) {
    return meeting(p, k, q, edge, corner, block_.values[4 * edge + k],
                   block_.values[4 * edge + next],
                   polygons_->error_of_line(polygons_->polygons[q], edge) * polygons_->reach[p]);
  };
  stretch.low = ends.starts_inside ? Place<Numbers>::from() : place(through.in, through.in_corner);
  stretch.high = ends.ends_inside ? Place<Numbers>::to() : place(through.out, through.out_corner);
  if constexpr (!Numbers::kCertified) return stretch.low.t < stretch.high.t;
  return true;
}

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
  const Vector<T> out = polygons_->line(other, through.out);
  const double out_error = polygons_->error_of_line(other, through.out) * reach;
  const T out_from = dot_product(out, from), out_to = dot_product(out, to);
  const IntervalEnds ends = ends_of_interval([&](bool leaves, bool at_to) {
    if (leaves) return sign(through.out, at_to ? out_to : out_from, out_error, at_to ? next : k);
    return sign(through.in, at_to ? in_to : in_from, in_error, at_to ? next : k);
  });
  if (!ends.meets) return false;
  stretch.low = ends.starts_inside
                    ? Place<Numbers>::from()
                    : meeting(p, k, q, through.in, through.in_corner, in_from, in_to, in_error);
  stretch.high = ends.ends_inside ? Place<Numbers>::to()
                                  : meeting(p, k, q, through.out, through.out_corner, out_from,
                                            out_to, out_error);
  if constexpr (!Numbers::kCertified) return stretch.low.t < stretch.high.t;
  return true;
}

// Where edge k of p crosses the line of an edge of q, with the values of that line at the ends, or
// those of the edge's plane, which are much less off.
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
    if (const EdgePlanes& planes = light_->planes; !planes.empty()) {
      const EdgePlanes::Plane& plane = planes.of(polygons_->edge(other, edge).index());
      const VertexId next = polygons_->vertex(own, k + 1 == own.count ? 0 : k + 1);
      double from_size, to_size;
      const double from = planes.value(plane, polygons_->vertex(own, k), from_size);
      const double to = planes.value(plane, next, to_size);
      return zero_between<Numbers>(from, to, planes.error(std::max(from_size, to_size)), name);
    }
  }
  return zero_between<Numbers>(at_from, at_to, Numbers::kCertified ? light_->proven(error) : 0,
                               name);
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_SURVEY_INTERVALS_H
