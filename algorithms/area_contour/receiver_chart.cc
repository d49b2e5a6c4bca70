// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/area_contour/receiver_chart.h"

#include <algorithm>
#include <cmath>

#include "kernel/signs/ball.h"

namespace gnomon::area_contour {
namespace {

/// Choices, not bounds: lines of smaller slopes against the receiver's plane, errors that are
/// larger against its size, and receivers of less area against it are left to exact arithmetic.
constexpr double kLeastSlope = 0x1p-20, kMostError = 0x1p-30, kLeastArea = 0x1p-20;

}  // namespace

bool ReceiverChart::make(const Point3& n, const std::vector<Point3>& loop, double input_error,
                         double plane_error) {
  dropped_ = 2;
  for (const std::size_t k : {1u, 0u}) {
    if (std::fabs(n[k]) > std::fabs(n[dropped_])) dropped_ = k;
  }
  u_ = (dropped_ + 1) % 3;
  v_ = (dropped_ + 2) % 3;
  slope_u_ = n[u_] / n[dropped_];
  slope_v_ = n[v_] / n[dropped_];
  origin_ = loop[0];
  input_error_ = input_error;
  plane_error_ = plane_error;
  corners.clear();
  double square = 0, turn = 0;
  for (const Point3& x : loop) {
    corners.push_back({x[u_] - origin_[u_], x[v_] - origin_[v_]});
    const auto& [u, v] = corners.back();
    square = std::max(square, u * u + v * v);
  }
  for (std::uint32_t i = 0; i < size(); ++i) {
    const auto &p = corners[i], &q = corners[next(i)];
    turn += p[0] * q[1] - p[1] * q[0];
  }
  reversed = turn < 0;
  if (reversed) std::reverse(corners.begin() + 1, corners.end());
  reach = std::sqrt(square) * (1 + 8 * Ball::kUnit);
  error = 2 * input_error + 2 * Ball::kUnit * reach;
  return std::fabs(turn) > kLeastArea * square && error < kMostError * reach;
}

// With slopes s of the receiver's dropped coordinate w against the others, the plane on it is
// (n_u - n_w s_u) u + (n_v - n_w s_v) v plus its value at the origin. A slope is off by 5u of
// itself and at most 1; so a product n_w s by 8u of itself with its rounding, and a coefficient by
// 3u |n_u| + 9u |n_w| with that of the difference: less than 12u. That is 12u (|u| + |v|) of the
// sum, at most 12u sqrt(2) = 17u of `reach`.
//
// The value at the origin is n . (x - p) for a point p of the plane: factors are off by 2u and 2u,
// and by the errors of two points, products round by u and sums by 2u: 8u of the sum of magnitudes,
// and 3 * 2 * input_error * 1.01. Without such a point it is n . x - d, as the kernel bounds it.
bool ReceiverChart::add_line(const PlaneDoubles& plane, CornerMask before, CornerMask behind,
                             std::vector<OutlineLine>& lines) const {
  const Point3& n = plane.n;
  double value = 0, value_error = plane_error_;
  if (plane.point != nullptr) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double term = n[k] * (origin_[k] - (*plane.point)[k]);
      value += term;
      sum += std::fabs(term);
    }
    value_error = 8 * Ball::kUnit * sum + 6.1 * input_error_;
  } else {
    value = n[0] * origin_[0] + n[1] * origin_[1] + n[2] * origin_[2] - plane.d;
  }
  const double sign = plane.plane.flipped() ? -1 : 1;
  const double a = sign * (n[u_] - n[dropped_] * slope_u_);
  const double b = sign * (n[v_] - n[dropped_] * slope_v_);
  const double slope = std::sqrt(a * a + b * b);
  if (!(slope > kLeastSlope)) return false;
  OutlineLine line;
  line.a = a / slope;
  line.b = b / slope;
  line.c = sign * value / slope;
  // What `slope` itself is off by is a factor of all. The quotients round by u of numbers whose sum
  // is at most 2 reach.
  line.error =
      (value_error + 17.1 * Ball::kUnit * reach) / slope * (1 + 0x1p-40) + 4 * Ball::kUnit * reach;
  line.plane = plane.plane;
  line.before = before;
  line.behind = behind;
  lines.push_back(line);
  return line.error < kMostError * reach;
}

}  // namespace gnomon::area_contour
