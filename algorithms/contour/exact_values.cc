// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/contour/exact_values.h"

#include <algorithm>
#include <cmath>

#include "gnomon/kernel/precision_plan.h"
#include "kernel/implicit/exact_geometry.h"
#include "kernel/implicit/scaled_doubles.h"

namespace gnomon {

// Of a sun det(q_a, q_b, q_c) = d_z^2 (d . (b - a) x (c - a)), and r has the first two components
// of q scaled by 2^-s, and the third by 2^(b - s) (light_rays.h). Positions and d of size 1 leave
// d_z^2 2^(3 (b + e - s)).
ExactValues::ExactValues(const LightIntegers& light, unsigned ray_bits)
    : light_(light), shift_(3 * static_cast<long>(light.q_bits)) {
  if (!light.is_parallel()) return;
  const long b = static_cast<long>(light.grid_bits()), e = static_cast<long>(light.light_bits);
  shift_ = 2 * b + e;
  const double d_z = to_double_scaled(light.light.grid[static_cast<std::size_t>(light.axes.z)], e);
  unit_ = std::ldexp(d_z * d_z, static_cast<int>(3 * (b + e - static_cast<long>(ray_bits))));
}

template <class Int>
auto ExactValues::line_of(VertexId a, VertexId b) const {
  using Position = PositionFor<Int>;
  const ExactGeometry<Position> exact(*light_.geometry);
  const Vector3<Position> l = light_.position<Position>();
  const Vector3<Position> p = exact.position(a), q = exact.position(b);
  return [=, to_light = light_.far ? difference(l, p) : l,
          parallel = light_.is_parallel()](VertexId v) {
    const Vector3<Position> r = exact.position(v);
    return parallel ? determinant<Int>(to_light, difference(q, p), difference(r, p))
                    : determinant<Int>(difference(l, p), difference(l, q), difference(l, r));
  };
}

double ExactValues::line(VertexId a, VertexId b, VertexId v) const {
  return with_width(width_of(light_.narrow, light_.side_bits),
                    [&]<class Int>() { return to_double_scaled(line_of<Int>(a, b)(v), shift_); });
}

namespace {

/// An integer is the value times 2^shift, so that the value is no more than pairs of doubles hold.
struct ScaledPair {
  DoubleDouble value;
  long shift = 0;
};
template <class Int>
ScaledPair scaled_pair(const Int& value) {
  return {double_double(value)};
}
template <std::size_t Limbs>
ScaledPair scaled_pair(const WideInteger<Limbs>& value) {
  constexpr int kShift = Limbs > 14 ? 512 : 0;
  return {double_double(value, kShift), kShift};
}
template <>
ScaledPair scaled_pair(const mpz_class& value) {
  const long shift = std::max(0L, long{bits_of(value)} - 900);
  return {double_double(mpz_class(value >> static_cast<unsigned>(shift))), shift};
}

/// The zero between two values; nothing if they have one sign.
template <class Int>
std::optional<DoubleDouble> zero_of(const Int& at_from, const Int& at_to) {
  if (sign_of(at_from) == sign_of(at_to)) return std::nullopt;
  const ScaledPair from = scaled_pair(at_from), gap = scaled_pair(Int(at_from - at_to));
  const DoubleDouble zero = from.value / gap.value;
  const int power = static_cast<int>(from.shift - gap.shift);
  if (power == 0) return zero;
  return DoubleDouble{std::ldexp(zero.high, power), std::ldexp(zero.low, power)};
}

}  // namespace

// One bit more, for the difference of two values.
std::optional<DoubleDouble> ExactValues::crossing(VertexId a, VertexId b, VertexId from,
                                                  VertexId to) const {
  return with_width(width_of(light_.narrow, light_.side_bits + 1), [&]<class Int>() {
    const auto value = line_of<Int>(a, b);
    return zero_of<Int>(value(from), value(to));
  });
}

std::optional<DoubleDouble> ExactValues::crossing(PlaneId plane, VertexId from, VertexId to) const {
  const unsigned bits = side_of_support_bits(light_.grid_bits()) + 1;
  return with_width(narrowest_width(bits), [&]<class Int>() {
    const ExactGeometry<Int> exact(*light_.geometry);
    return zero_of<Int>(exact.value(plane, from), exact.value(plane, to));
  });
}

double ExactValues::depth(PlaneId plane, VertexId v) const {
  const unsigned b = light_.grid_bits();
  const unsigned bits = std::max(2 * b + light_.q_bits, 3 * b) + 4;
  return with_widths(
      width_of(light_.narrow, bits), support_normal_bits(b) + 1, [&]<class Normal, class Int>() {
        using Position = PositionFor<Int>;
        const ExactGeometry<Position> exact(*light_.geometry);
        const Vector3<Normal> n = exact.template normal<Normal>(plane);
        const Vector3<Position> l = light_.position<Position>();
        const Vector3<Position> corner = exact.position(light_.geometry->planes[plane].a);
        const Int height = dot<Int>(n, difference(l, corner));
        const long shift = excess_bits(height);
        return to_double_scaled(dot<Int>(n, difference(l, exact.position(v))), shift) /
               to_double_scaled(height, shift);
      });
}

double ExactValues::support(PlaneId plane, VertexId v) const {
  const unsigned b = light_.grid_bits();
  return with_width(narrowest_width(side_of_support_bits(b)), [&]<class Int>() {
    return to_double_scaled(ExactGeometry<Int>(*light_.geometry).value(plane, v),
                            3 * static_cast<long>(b));
  });
}

}  // namespace gnomon
