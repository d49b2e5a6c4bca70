// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/geometry/plane_frame.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace gnomon::oracle {

namespace {

/// The first 64 bits of an integer: mantissa 2^exponent, off by less than 2^-63 of it.
struct Leading {
  long double mantissa = 0;
  long exponent = 0;
};

Leading leading(const mpz_class& value) {
  constexpr std::size_t kBits = 64;
  static_assert(sizeof(unsigned long) * 8 == kBits);
  const std::size_t bits = mpz_sizeinbase(value.get_mpz_t(), 2);
  Leading result;
  if (bits <= kBits) {
    result.mantissa = static_cast<long double>(mpz_get_ui(value.get_mpz_t()));
  } else {
    mpz_class top;
    mpz_tdiv_q_2exp(top.get_mpz_t(), value.get_mpz_t(), bits - kBits);
    result = {static_cast<long double>(mpz_get_ui(top.get_mpz_t())),
              static_cast<long>(bits - kBits)};
  }
  if (sgn(value) < 0) result.mantissa = -result.mantissa;
  return result;
}

long double scaled(long double value, long exponent) {
  constexpr long kMost = 100'000;
  return std::ldexp(value, static_cast<int>(std::clamp(exponent, -kMost, kMost)));
}

long double ratio(const mpz_class& numerator, const mpz_class& denominator) {
  const Leading n = leading(numerator), d = leading(denominator);
  return scaled(n.mantissa / d.mantissa, n.exponent - d.exponent);
}

__extension__ typedef __int128 Int128;

/// Three products of such numbers and one more number fit in 128 bits.
constexpr std::size_t kSmallBits = 62;

bool is_small(const mpz_class& value) { return mpz_sizeinbase(value.get_mpz_t(), 2) <= kSmallBits; }

std::optional<std::array<std::int64_t, 3>> small_of(const Integers3& vector) {
  if (!is_small(vector[0]) || !is_small(vector[1]) || !is_small(vector[2])) return std::nullopt;
  return std::array<std::int64_t, 3>{vector[0].get_si(), vector[1].get_si(), vector[2].get_si()};
}

/// An integer of 128 bits, off by less than 2^-63 of it.
Leading leading(Int128 value) { return {static_cast<long double>(value), 0}; }

Int128 product_of(const std::array<std::int64_t, 3>& a, const std::array<std::int64_t, 3>& b) {
  return static_cast<Int128>(a[0]) * b[0] + static_cast<Int128>(a[1]) * b[1] +
         static_cast<Int128>(a[2]) * b[2];
}

/// A vector of integers without its length, and the length times 2^-exponent.
struct Direction {
  std::array<long double, 3> unit{};
  long double length = 0;
  long exponent = 0;
};

Direction direction_of(const Integers3& vector) {
  Direction result;
  std::array<Leading, 3> parts;
  for (int k = 0; k < 3; ++k) {
    parts[k] = leading(vector[k]);
    result.exponent = std::max(result.exponent, parts[k].exponent);
  }
  for (int k = 0; k < 3; ++k) {
    result.unit[k] = scaled(parts[k].mantissa, parts[k].exponent - result.exponent);
  }
  const auto& u = result.unit;
  result.length = std::sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
  for (long double& component : result.unit) component /= result.length;
  return result;
}

}  // namespace

long double nearest(const mpq_class& value) { return ratio(value.get_num(), value.get_den()); }

PlaneFrame::PlaneFrame(const Geometry& geometry, std::span<const Integers3> loop)
    : origin_(loop[0]), step_(nearest(geometry.step)) {
  ExactPlane plane = plane_of(loop);
  reduce(plane);
  along_ = minus(loop[1], loop[0]);
  across_ = cross(plane.normal, along_);
  const Direction along = direction_of(along_), across = direction_of(across_);
  along_length_ = scaled(along.length, along.exponent);
  across_length_ = scaled(across.length, across.exponent);
  x_axis_ = along.unit;
  y_axis_ = across.unit;
  normal_ = direction_of(plane.normal).unit;
  const auto small_origin = small_of(origin_), small_along = small_of(along_),
             small_across = small_of(across_);
  if (small_origin && small_along && small_across) {
    small_ = {*small_origin, *small_along, *small_across};
  }
  for (int k = 0; k < 3; ++k) {
    base_[k] = nearest(mpq_class(geometry.origin[k] + geometry.step * origin_[k]));
  }
}

PlaneFrame::Vector PlaneFrame::from_origin(const RationalPoint& point) const {
  Vector result;
  for (int k = 0; k < 3; ++k) result[k] = nearest(point[k]) - base_[k];
  return result;
}

namespace {

long double dot(const std::array<long double, 3>& a, const std::array<long double, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace

PlanarPoint PlaneFrame::at(const RationalPoint& point) const {
  const Vector offset = from_origin(point);
  return {dot(x_axis_, offset), dot(y_axis_, offset)};
}

PlanarPoint PlaneFrame::at(const HomogeneousPoint& point) const {
  Integers3 offset;
  for (int k = 0; k < 3; ++k) offset[k] = point.xyz[k] - origin_[k] * point.w;
  // Exact up to here, so that both coordinates are right by their own measure, however narrow a
  // loop is.
  return {ratio(oracle::dot(along_, offset), point.w) / along_length_ * step_,
          ratio(oracle::dot(across_, offset), point.w) / across_length_ * step_};
}

PlanarLoop PlaneFrame::loop_at(std::span<const RationalPoint> loop) const {
  PlanarLoop result;
  for (const RationalPoint& point : loop) result.push_back(at(point));
  return result;
}

long double PlaneFrame::height(const RationalPoint& point) const {
  return dot(normal_, from_origin(point));
}

std::optional<PlanarLine> PlaneFrame::trace(const ExactPlane& plane) const {
  // Slopes along the two axes, and the value at the origin, all times 2^exponent.
  Leading a, b, c;
  if (const auto normal = small_of(plane.normal); normal && small_ && is_small(plane.offset)) {
    a = leading(product_of(*normal, small_->along));
    b = leading(product_of(*normal, small_->across));
    c = leading(product_of(*normal, small_->origin) - plane.offset.get_si());
  } else {
    a = leading(oracle::dot(plane.normal, along_));
    b = leading(oracle::dot(plane.normal, across_));
    c = leading(value_at(plane, origin_));
  }
  if (a.mantissa == 0 && b.mantissa == 0) return std::nullopt;
  const long exponent = std::max(a.exponent, b.exponent);
  const long double slope_x = scaled(a.mantissa, a.exponent - exponent) / along_length_;
  const long double slope_y = scaled(b.mantissa, b.exponent - exponent) / across_length_;
  const long double slope = std::sqrt(slope_x * slope_x + slope_y * slope_y);
  return PlanarLine{slope_x / slope, slope_y / slope,
                    scaled(c.mantissa / slope, c.exponent - exponent) * step_};
}

}  // namespace gnomon::oracle
