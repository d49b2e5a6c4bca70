// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/tiling/tile_borders.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "algorithms/partition/chart_split.h"

namespace gnomon {

namespace {

/// The vertices of some parts in the chart of a directional light, times d_z 2^b: integers.
class Shadow {
 public:
  Shadow(const Geometry& geometry, const LightPoint& light)
      : grid_(geometry.grid), axes_(LightAxes::of(light)) {
    for (std::size_t k = 0; k < 3; ++k) d_[k] = light.grid[k];
  }

  mpz_class exact(VertexId v, int axis) const {
    const int k = axis == 0 ? axes_.x : axes_.y;
    const mpz_class& along = d_[static_cast<std::size_t>(k)];
    return position(v, k) * depth() - position(v, axes_.z) * along;
  }
  /// In units of 2^b grid steps: below 2, whatever b is.
  double rounded(VertexId v, int axis) const {
    const int k = axis == 0 ? axes_.x : axes_.y;
    const mpz_class& along = d_[static_cast<std::size_t>(k)];
    return value(v, k) - value(v, axes_.z) * ratio(along, depth());
  }
  const mpz_class& depth() const { return d_[static_cast<std::size_t>(axes_.z)]; }

 private:
  mpz_class position(VertexId v, int k) const {
    return grid_.is_narrow() ? mpz_class(static_cast<long>(grid_.narrow(v, k))) : grid_.wide(v, k);
  }
  double value(VertexId v, int k) const {
    const int bits = static_cast<int>(grid_.bits());
    if (grid_.is_narrow()) return std::ldexp(static_cast<double>(grid_.narrow(v, k)), -bits);
    long exponent = 0;
    const double mantissa = mpz_get_d_2exp(&exponent, grid_.wide(v, k).get_mpz_t());
    return std::ldexp(mantissa, static_cast<int>(exponent) - bits);
  }
  static double ratio(const mpz_class& a, const mpz_class& b) {
    long a_exponent = 0, b_exponent = 0;
    const double top = mpz_get_d_2exp(&a_exponent, a.get_mpz_t());
    const double bottom = mpz_get_d_2exp(&b_exponent, b.get_mpz_t());
    return std::ldexp(top / bottom, static_cast<int>(a_exponent - b_exponent));
  }

  const GridPositions& grid_;
  LightAxes axes_;
  std::array<mpz_class, 3> d_;
};

/// The exact extremes of the vertices along an axis, times |d_z| 2^b. Doubles leave out the
/// vertices that are too far from an extreme for their rounding to matter.
struct Extremes {
  mpz_class low, high;
};
Extremes extremes(const Shadow& shadow, std::span<const VertexId> vertices, int axis) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const VertexId v : vertices) {
    low = std::min(low, shadow.rounded(v, axis));
    high = std::max(high, shadow.rounded(v, axis));
  }
  // |rounded - exact| is below 8 roundings of 2^-53 of numbers below 2.
  constexpr double kMargin = 0x1p-45;
  std::vector<mpz_class> lows, highs;
  for (const VertexId v : vertices) {
    const double here = shadow.rounded(v, axis);
    const bool may_be_low = here <= low + kMargin, may_be_high = here >= high - kMargin;
    if (!may_be_low && !may_be_high) continue;
    mpz_class exact = shadow.exact(v, axis);
    if (sgn(shadow.depth()) < 0) exact = -exact;
    if (may_be_low) lows.push_back(exact);
    if (may_be_high) highs.push_back(exact);
  }
  return {*std::ranges::min_element(lows), *std::ranges::max_element(highs)};
}

}  // namespace

TileBorders::TileBorders(const PreparedScene& scene, const LightPoint& light,
                         std::span<const std::uint32_t> parts, std::uint32_t tiles)
    : tiles_(tiles), directional_(light.directional), grid_bits_(scene.geometry.grid.bits()) {
  if (!directional_ || parts.empty()) return;
  std::vector<VertexId> vertices;
  for (const std::uint32_t part : parts) {
    const auto loop = scene.loop(scene.parts[part]);
    vertices.insert(vertices.end(), loop.begin(), loop.end());
  }
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  const Shadow shadow(scene.geometry, light);
  sign_ = sgn(shadow.depth());
  // In units of 2^-kBits: value * 2^kBits / (|d_z| 2^b), rounded outward.
  const mpz_class denominator = abs(shadow.depth()) << grid_bits_;
  for (int axis = 0; axis < 2; ++axis) {
    const Extremes ends = extremes(shadow, vertices, axis);
    const mpz_class scaled_low = ends.low << kBits, scaled_high = ends.high << kBits;
    mpz_class low, high;
    mpz_fdiv_q(low.get_mpz_t(), scaled_low.get_mpz_t(), denominator.get_mpz_t());
    mpz_cdiv_q(high.get_mpz_t(), scaled_high.get_mpz_t(), denominator.get_mpz_t());
    Axis& own = axes_[static_cast<std::size_t>(axis)];
    own.low = low.get_si();
    const std::int64_t span = high.get_si() - own.low;
    own.width = std::max<std::int64_t>(1, (span + tiles_ - 1) / tiles_);
  }
}

LightChart TileBorders::chart(std::uint32_t face) const {
  if (directional_) return {0, 1, 2, sign_};
  const int w = static_cast<int>(face / 2);
  return {(w + 1) % 3, (w + 2) % 3, w, face % 2 == 0 ? 1 : -1};
}

PrefixPlane TileBorders::border(std::uint32_t face, int axis, std::uint32_t index) const {
  const LightChart chart = this->chart(face);
  if (directional_) {
    const Axis& own = axes_[static_cast<std::size_t>(axis)];
    ChartSplit split;
    split.axis = axis;
    split.steps = own.low + own.width * std::int64_t{index};
    split.bits = kBits;
    return plane_of(split, chart, true, grid_bits_);
  }
  // q_axis / q_w > (2 index - n) / n, times n |q_w|.
  PrefixPlane plane;
  const long n = tiles_, numerator = 2 * static_cast<long>(index) - n;
  plane.n[static_cast<std::size_t>(axis == 0 ? chart.u : chart.v)] = chart.sign * n;
  plane.n[static_cast<std::size_t>(chart.w)] = -chart.sign * numerator;
  return plane;
}

double TileBorders::coordinate(int axis, std::uint32_t index) const {
  if (directional_) {
    const Axis& own = axes_[static_cast<std::size_t>(axis)];
    return std::ldexp(static_cast<double>(own.low + own.width * std::int64_t{index}), -kBits);
  }
  return (2.0 * index - tiles_) / tiles_;
}

}  // namespace gnomon
