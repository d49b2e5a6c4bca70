// SPDX-License-Identifier: LGPL-3.0-or-later
#include "fractions.h"

#include <algorithm>
#include <utility>

#include "gnomon/kernel/plane_scene_space.h"

namespace gnomon {

Chart chart_of(const Geometry& geometry, PlaneId plane) {
  const Vector3<mpz_class> n = ExactGeometry<mpz_class>(geometry).plane(plane).n;
  int dropped = 2;
  for (const int k : {1, 0}) {
    if (mpz_cmpabs(n[static_cast<std::size_t>(k)].get_mpz_t(),
                   n[static_cast<std::size_t>(dropped)].get_mpz_t()) > 0) {
      dropped = k;
    }
  }
  return {(dropped + 1) % 3, (dropped + 2) % 3};
}

double nearest_double(const mpq_class& value) {
  // GMP truncates towards zero: the answer is that or the next double away from zero.
  const double low = value.get_d();
  const double high = std::nextafter(low, sgn(value) > 0 ? INFINITY : -INFINITY);
  if (!std::isfinite(low) || !std::isfinite(high)) return low;
  const mpq_class to_low = abs(value - mpq_class(low)), to_high = abs(mpq_class(high) - value);
  if (to_low != to_high) return to_low < to_high ? low : high;
  int exponent = 0;
  const double mantissa = std::ldexp(std::frexp(low, &exponent), 53);
  return std::fmod(mantissa, 2) == 0 ? low : high;
}

std::array<double, 3> nearest_doubles(const std::array<mpq_class, 3>& point) {
  return {nearest_double(point[0]), nearest_double(point[1]), nearest_double(point[2])};
}

void FractionSum::add(Fraction fraction) {
  sum_ = sum_ + fraction.enclosure;
  if (!fraction.has_exact) return;
  mpq_class carry = std::move(fraction.exact);
  std::size_t level = 0;
  for (; level < partial_.size() && filled_[level]; ++level) {
    carry += partial_[level];
    partial_[level] = 0;
    filled_[level] = false;
  }
  if (level == partial_.size()) {
    partial_.emplace_back();
    filled_.push_back(false);
  }
  partial_[level] = std::move(carry);
  filled_[level] = true;
}

Interval FractionSum::interval(bool certified) const {
  if (!certified) return {sum_.middle, sum_.middle};
  return {std::clamp(sum_.lower(), 0.0, 1.0), std::clamp(sum_.upper(), 0.0, 1.0)};
}

mpq_class FractionSum::exact() const {
  mpq_class total = 0;
  for (const mpq_class& partial : partial_) total += partial;
  return total;
}

}  // namespace gnomon
