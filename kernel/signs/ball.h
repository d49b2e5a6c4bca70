// SPDX-License-Identifier: LGPL-3.0-or-later
// Midpoint-radius arithmetic: a Ball encloses a real number, |true - middle| <= radius, without any
// change of the rounding mode. Used for areas and positions that must come with a certificate.
//
// Exactness: every operation encloses the exact result for all values in its operands. Each
// rounding of round-to-nearest errs by at most u |result| with u = 2^-53, or by 2^-1075 where it
// underflows; radii themselves are rounded, so each is inflated by 1 + 8u, which covers up to six
// roundings of non-negative terms, plus kTiny for underflow. Reference: S. M. Rump, Fast and
// parallel interval arithmetic, BIT 39 (1999), sec. 2-3.
#ifndef GNOMON_KERNEL_SIGNS_BALL_H
#define GNOMON_KERNEL_SIGNS_BALL_H

#include <cmath>
#include <limits>

namespace gnomon {

struct Ball {
  static constexpr double kUnit = 0x1p-53;
  static constexpr double kInflate = 1 + 8 * kUnit;
  static constexpr double kTiny = 0x1p-1060;

  double middle = 0;
  double radius = 0;

  constexpr Ball() = default;
  constexpr explicit Ball(double exact) : middle(exact) {}
  constexpr Ball(double middle_value, double radius_value)
      : middle(middle_value), radius(radius_value) {}

  double lower() const { return std::nextafter(middle - radius, -kInfinity); }
  double upper() const { return std::nextafter(middle + radius, kInfinity); }
  bool is_finite() const { return std::isfinite(middle) && std::isfinite(radius); }

  friend Ball operator-(const Ball& a) { return {-a.middle, a.radius}; }
  friend Ball operator+(const Ball& a, const Ball& b) {
    const double middle = a.middle + b.middle;
    return {middle, (a.radius + b.radius + kUnit * std::fabs(middle)) * kInflate + kTiny};
  }
  friend Ball operator-(const Ball& a, const Ball& b) { return a + -b; }
  friend Ball operator*(const Ball& a, const Ball& b) {
    const double middle = a.middle * b.middle;
    const double radius = std::fabs(a.middle) * b.radius +
                          a.radius * (std::fabs(b.middle) + b.radius) + kUnit * std::fabs(middle);
    return {middle, radius * kInflate + kTiny};
  }
  /// Infinite radius if b may be zero.
  friend Ball operator/(const Ball& a, const Ball& b) {
    // |b| - radius is at least this, rounded down.
    const double least = (std::fabs(b.middle) - b.radius) * (1 - 4 * kUnit);
    if (!(least > 0)) return {0, kInfinity};
    const double middle = a.middle / b.middle;
    const double radius =
        (a.radius + std::fabs(middle) * b.radius) / least + 2 * kUnit * std::fabs(middle);
    return {middle, radius * kInflate + kTiny};
  }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_SIGNS_BALL_H
