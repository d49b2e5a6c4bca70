// SPDX-License-Identifier: GPL-3.0-or-later
// A plane as seen from the eye, as integers and as doubles with a bound: what the oracle of
// pictures asks of it, first in doubles, then exactly.
//
// Bounds, with u = 2^-53: components are at most 1 and off by 2u (GMP truncates), as is the value
// at the eye of itself. Everything is in grid units times 2^-b, seen from the eye.
#ifndef GNOMON_ORACLE_IMAGE_CERTIFIED_PLANE_H
#define GNOMON_ORACLE_IMAGE_CERTIFIED_PLANE_H

#include <gmpxx.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace gnomon::oracle {

using Integer3 = std::array<mpz_class, 3>;
using Double3 = std::array<double, 3>;

inline constexpr double kRoundoff = 0x1p-53;

inline Integer3 difference_of(const Integer3& a, const Integer3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Integer3 cross_of(const Integer3& a, const Integer3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline mpz_class dot_of(const Integer3& a, const Integer3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline double dot_of(const Double3& a, const Double3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The direction of a sample.
struct SampleRay {
  Integer3 exact;
  Double3
      d{};  // the same, or of a moved ray a power of two of it, off by at most 2u of the largest
  double largest = 0;
};

/// -1, 0, 1, or 2 where doubles do not tell.
inline int certain_sign(double value, double bound) {
  return value > bound ? 1 : value < -bound ? -1 : 2;
}

class CertifiedPlane {
 public:
  CertifiedPlane() = default;
  /// n . q + at_eye for a point q from the eye, in grid units of `bits` bits.
  CertifiedPlane(Integer3 n, mpz_class at_eye, unsigned bits)
      : n_(std::move(n)), at_eye_(std::move(at_eye)) {
    long most = std::numeric_limits<long>::min();
    for (const mpz_class& x : n_) most = std::max(most, exponent_of(x));
    usable_ = sgn(n_[0]) != 0 || sgn(n_[1]) != 0 || sgn(n_[2]) != 0;
    if (!usable_) return;
    for (std::size_t k = 0; k < 3; ++k) d_[k] = scaled(n_[k], most);
    eye_ = scaled(at_eye_, most + static_cast<long>(bits));
    usable_ = sgn(at_eye_) == 0 || std::fabs(eye_) > 0x1p-900;
  }

  const Integer3& n() const { return n_; }
  const mpz_class& at_eye() const { return at_eye_; }
  int side_of_eye() const { return sgn(at_eye_); }
  double eye() const { return eye_; }

  /// n . d in doubles, and a bound of its error: 12u of the components, 8u of roundings.
  double along(const SampleRay& ray) const { return dot_of(d_, ray.d); }
  double along_bound(const SampleRay& ray) const {
    return usable_ ? 24 * kRoundoff * ray.largest : std::numeric_limits<double>::infinity();
  }
  int side_of(const SampleRay& ray) const {
    const int sign = certain_sign(along(ray), along_bound(ray));
    return sign != 2 ? sign : sgn(dot_of(n_, ray.exact));
  }
  /// The sign at a point that is off by `error` in each coordinate; 2 where doubles do not tell. 3
  /// times that error, and 2u + 3u + 6u of 3 |q| + |at_eye| from the operands and roundings.
  int certain_side_at(const Double3& q, double largest, double error) const {
    if (!usable_) return 2;
    return certain_sign(dot_of(d_, q) + eye_,
                        3.1 * error + 16 * kRoundoff * (3 * largest + std::fabs(eye_)));
  }

 private:
  static long exponent_of(const mpz_class& x) {
    return sgn(x) == 0 ? std::numeric_limits<long>::min()
                       : static_cast<long>(mpz_sizeinbase(x.get_mpz_t(), 2));
  }
  static double scaled(const mpz_class& x, long shift) {
    long exponent = 0;
    const double mantissa = mpz_get_d_2exp(&exponent, x.get_mpz_t());
    const long power = exponent - shift;
    return power < -1000  ? 0
           : power > 1000 ? std::numeric_limits<double>::infinity()
                          : std::ldexp(mantissa, static_cast<int>(power));
  }

  Integer3 n_;
  mpz_class at_eye_;
  Double3 d_{};
  double eye_ = 0;
  bool usable_ = false;
};

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_IMAGE_CERTIFIED_PLANE_H
