// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/angular_table/table_chart.h"

#include <utility>

#include "scene/base/vectors.h"

namespace gnomon {

namespace {

mpz_class value(const GridPlane& function, const DirectionVector& point) {
  return dot(function.n, point) - function.d;
}

GridPlane negated(GridPlane plane) {
  for (mpz_class& c : plane.n) c = -c;
  plane.d = -plane.d;
  return plane;
}

/// a f + b g, with coefficients that have no common divisor.
GridPlane combined(const mpz_class& a, const GridPlane& f, const mpz_class& b, const GridPlane& g) {
  GridPlane result;
  for (std::size_t k = 0; k < 3; ++k) result.n[k] = a * f.n[k] + b * g.n[k];
  result.d = a * f.d + b * g.d;
  mpz_class divisor = gcd(gcd(result.n[0], result.n[1]), gcd(result.n[2], result.d));
  if (divisor > 1) {
    for (mpz_class& c : result.n) c /= divisor;
    result.d /= divisor;
  }
  return result;
}

/// The linear function with this gradient that is zero at a point.
GridPlane zero_at(DirectionVector gradient, const DirectionVector& point) {
  const mpz_class d = dot(gradient, point);
  return {std::move(gradient), d};
}

DirectionVector integers(const std::array<std::int32_t, 3>& v) { return {v[0], v[1], v[2]}; }

/// Of a sun: across its rays, rows along the first of the picture's axes that is not along them.
TableChart chart_of_sun(const std::array<DirectionVector, 3>& frame, const DirectionVector& sun) {
  constexpr std::array<std::pair<std::size_t, std::size_t>, 3> kAxes = {{{0, 1}, {0, 2}, {1, 2}}};
  TableChart chart;
  chart.is_flat = true;
  chart.ahead = {{0, 0, 0}, -1};
  for (const auto& [along, other] : kAxes) {
    DirectionVector across = cross(frame[other], sun);
    const DirectionVector upwards = cross(frame[along], sun);
    const int turn = sgn(dot(cross(across, upwards), sun));
    if (turn == 0) continue;
    if (turn < 0) {
      for (mpz_class& c : across) c = -c;
    }
    chart.across = {std::move(across), 0};
    chart.upwards = {upwards, 0};
    break;
  }
  return chart;
}

/// The functions that are ahead, to the right and up in each of six pyramids, as turns of the
/// three: which one, and its sign.
struct Turn {
  std::array<std::pair<std::size_t, int>, 3> of;
};
constexpr std::array<Turn, 6> kTurns = {{{{{{0, 1}, {1, 1}, {2, 1}}}},
                                         {{{{0, -1}, {1, 1}, {2, -1}}}},
                                         {{{{2, -1}, {1, 1}, {0, 1}}}},
                                         {{{{2, 1}, {1, 1}, {0, -1}}}},
                                         {{{{0, 1}, {2, -1}, {1, 1}}}},
                                         {{{{0, 1}, {2, 1}, {1, -1}}}}}};

}  // namespace

DirectionVector TableChart::of(const DirectionVector& point) const {
  return {value(across, point), value(upwards, point), value(ahead, point)};
}

GridPlane TableChart::row(const mpq_class& t) const {
  return combined(t.get_den(), upwards, -t.get_num(), ahead);
}

GridPlane TableChart::column(const mpq_class& s) const {
  return combined(s.get_den(), across, -s.get_num(), ahead);
}

GridPlane TableChart::border(Border border) const {
  const bool to_sides = border == kRight || border == kLeft;
  const int sign = border == kRight || border == kTop ? -1 : 1;
  return combined(1, ahead, sign, to_sides ? across : upwards);
}

mpz_class TableChart::inside(Border border, const DirectionVector& direction) {
  const mpz_class& c = direction[border == kRight || border == kLeft ? 0 : 1];
  return border == kRight || border == kTop ? mpz_class(direction[2] - c)
                                            : mpz_class(direction[2] + c);
}

std::vector<TableChart> charts_of(const ImageFrame& frame, const LightPoint& light,
                                  Hemisphere hemisphere) {
  const std::array<DirectionVector, 3> axes = {integers(frame.right), integers(frame.up),
                                               integers(frame.forward)};
  if (light.directional) return {chart_of_sun(axes, light.grid)};
  const mpz_class det = dot(cross(axes[0], axes[1]), axes[2]);
  // The dual basis, times the sign of the determinant, so that it grows along the axes.
  std::array<GridPlane, 3> functions;
  for (std::size_t k = 0; k < 3; ++k) {
    functions[k] = zero_at(cross(axes[(k + 1) % 3], axes[(k + 2) % 3]), light.grid);
    if (det < 0) functions[k] = negated(std::move(functions[k]));
  }
  // Right, up and forward of a picture are left-handed: then loops turn as the light sees them.
  if (det > 0) functions[0] = negated(std::move(functions[0]));
  std::vector<TableChart> charts;
  for (const Turn& turn : kTurns) {
    TableChart& chart = charts.emplace_back();
    const std::array<GridPlane*, 3> to = {&chart.across, &chart.upwards, &chart.ahead};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [which, sign] = turn.of[k];
      *to[k] = sign > 0 ? functions[which] : negated(functions[which]);
    }
    chart.is_pyramid = hemisphere == Hemisphere::kCube;
    if (hemisphere == Hemisphere::kOne) break;
  }
  return charts;
}

}  // namespace gnomon
