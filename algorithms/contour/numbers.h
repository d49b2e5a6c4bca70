// SPDX-License-Identifier: LGPL-3.0-or-later
// The numbers that the contour method computes with, and where on an edge something begins or ends.
//
// The method decides signs of input corners against lines and planes, and computes parameters on
// edges, depths and areas. How far these can be trusted is one of three:
//  * certified (kernel `plane`): doubles with proven bounds. Every sign of a corner is exact; what
//    the bounds leave open about parameters is carried along as "perhaps".
//  * rounded: the kernel's own numbers, taken at their word.
//  * exact: rationals.
#ifndef GNOMON_ALGORITHMS_CONTOUR_NUMBERS_H
#define GNOMON_ALGORITHMS_CONTOUR_NUMBERS_H

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "kernel/signs/ball.h"

namespace gnomon {

enum class Trust : std::uint8_t { kCertified, kRounded, kExact };

/// `asks_kernel`: signs of corners are always the kernel's, not those of the numbers.
template <class Scalar, Trust trust, bool asks_kernel = trust == Trust::kExact>
struct ContourNumbers {
  using T = Scalar;
  static constexpr bool kAsksKernel = asks_kernel;
  static constexpr Trust kTrust = trust;
  static constexpr bool kCertified = trust == Trust::kCertified;
  static constexpr bool kExact = trust == Trust::kExact;
};

template <class T>
using Vector = std::array<T, 3>;

template <class T>
T dot_product(const Vector<T>& a, const Vector<T>& b) {
  return T(T(a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]);
}
template <class T>
Vector<T> cross_product(const Vector<T>& a, const Vector<T>& b) {
  return {T(a[1] * b[2] - a[2] * b[1]), T(a[2] * b[0] - a[0] * b[2]), T(a[0] * b[1] - a[1] * b[0])};
}
template <class T>
int sign_of_value(const T& x) {
  if constexpr (std::is_same_v<T, mpq_class>) {
    return sgn(x);
  } else {
    return int{x > 0} - int{x < 0};
  }
}

/// What a place on an edge is, so that two places that are one are known to be, whatever their
/// doubles say: an end of the edge, the crossing with the line of another edge, a vertex on it, or
/// the crossing with a support plane. A name is blurred where the place may be that of another
/// within the bounds: then it says what to compare with, and not where the place is.
class PlaceName {
 public:
  enum class Kind : std::uint8_t { kNone, kFrom, kTo, kLine = 4, kVertex, kSupport };

  constexpr PlaceName() = default;
  static constexpr PlaceName from() { return PlaceName(1); }
  static constexpr PlaceName to() { return PlaceName(2); }
  static constexpr PlaceName line(std::uint32_t edge) { return PlaceName(4 | code(edge)); }
  static constexpr PlaceName vertex(std::uint32_t vertex) { return PlaceName(5 | code(vertex)); }
  static constexpr PlaceName support(std::uint32_t plane) { return PlaceName(6 | code(plane)); }
  bool is_known() const { return code_ != 0; }
  bool is_blurred() const { return (code_ & kBlurred) != 0; }
  PlaceName blurred() const { return is_known() ? PlaceName(code_ | kBlurred) : *this; }
  /// kNone if it does not say where the place is.
  Kind kind() const { return is_blurred() ? Kind::kNone : static_cast<Kind>(code_ & 7); }
  /// Of the edge, the vertex or the plane.
  std::uint32_t index() const { return static_cast<std::uint32_t>(code_ >> 3); }
  friend constexpr bool operator==(PlaceName a, PlaceName b) {
    return ((a.code_ ^ b.code_) & ~kBlurred) == 0;
  }

 private:
  static constexpr std::uint64_t kBlurred = std::uint64_t{1} << 63;
  constexpr explicit PlaceName(std::uint64_t code) : code_(code) {}
  static constexpr std::uint64_t code(std::uint32_t index) { return std::uint64_t{index} << 3; }
  std::uint64_t code_ = 0;  // 0: not known to be anything
};

/// A place on an edge from a to b: a + t (b - a) on the rays of its ends.
template <class Numbers>
struct Place {
  using T = typename Numbers::T;
  T t{};
  double error = 0;  // certified: |true - t| is at most this; else 0
  PlaceName name;

  static Place from() { return {T(0), 0, PlaceName::from()}; }
  static Place to() { return {T(1), 0, PlaceName::to()}; }
};

/// Whether two places are one by what they are.
template <class Numbers>
bool is_same_place(const Place<Numbers>& p, const Place<Numbers>& q) {
  return p.name.is_known() && p.name == q.name;
}
/// Whether p is certainly before q.
template <class Numbers>
bool certainly_before(const Place<Numbers>& p, const Place<Numbers>& q) {
  if constexpr (Numbers::kCertified) {
    return q.t - p.t > p.error + q.error;
  } else {
    return p.t < q.t;
  }
}
/// Whether nothing is between p and q, for certain, if p is not before q by the numbers.
template <class Numbers>
bool certainly_no_gap(const Place<Numbers>& p, const Place<Numbers>& q) {
  if constexpr (Numbers::kCertified) {
    return is_same_place(p, q) || p.t - q.t > p.error + q.error;
  } else {
    return !(p.t < q.t);
  }
}

/// The place where a value that is linear along an edge is zero, from its values at the ends, which
/// have opposite signs. Certified: each value is off by at most e, `error`. With gap g = |s| + |s'|
/// > 8e of the computed values, the true gap is at least 3/4 g and the true |s| + |s'| at most 5/4
/// g, so that t = s / (s - s') is off by at most e (|s| + |s'|) / (g 3/4 g) = 1.67 e / g; the gap
/// and the quotient round by 2u of t.
template <class Numbers>
[[gnu::always_inline]] inline Place<Numbers> zero_between(const typename Numbers::T& at_from,
                                                          const typename Numbers::T& at_to,
                                                          double error, PlaceName name) {
  using T = typename Numbers::T;
  Place<Numbers> place;
  const T gap = at_from - at_to;
  place.t = at_from / gap;
  place.name = name;
  if constexpr (Numbers::kCertified) {
    const double size = gap < 0 ? -gap : gap;
    // What has underflowed says nothing, whatever its bound.
    constexpr double kLeast = 0x1p-900;
    if (size > 8 * error && size > kLeast) {
      place.error = 1.7 * error / size + 2.1 * Ball::kUnit;
    } else {
      place.t = 0.5;
      place.error = 1;
    }
    if (!(place.t >= 0)) place.t = 0;
    if (!(place.t <= 1)) place.t = 1;
  }
  return place;
}

/// The one of two places that the numbers choose, where it may be the other. Its bound holds for
/// that, too: the later one of s and t >= s is off to the lower side by at most the bound of t, and
/// to the upper side by that or as far as s may reach beyond t.
template <class Numbers>
Place<Numbers> chosen_of(const Place<Numbers>& chosen, const Place<Numbers>& other) {
  Place<Numbers> result = chosen;
  if constexpr (Numbers::kCertified) {
    if (is_same_place(chosen, other)) {
      if (other.name.is_blurred()) result.name = result.name.blurred();
      return result;
    }
    const double distance = other.t < chosen.t ? chosen.t - other.t : other.t - chosen.t;
    if (distance > chosen.error + other.error) return result;
    result.error = std::max(chosen.error, other.error - distance);
    result.name = {};
  }
  return result;
}
/// The earlier and the later of two places.
template <class Numbers>
Place<Numbers> earlier_of(const Place<Numbers>& p, const Place<Numbers>& q) {
  return q.t < p.t ? chosen_of(q, p) : chosen_of(p, q);
}
template <class Numbers>
Place<Numbers> later_of(const Place<Numbers>& p, const Place<Numbers>& q) {
  return q.t > p.t ? chosen_of(q, p) : chosen_of(p, q);
}

/// Makes a stretch of what may have no length: false if it certainly has none. Where that is open,
/// it is left with none, and with ends that are off by as much as it may have.
template <class Numbers>
bool shorten(Place<Numbers>& low, Place<Numbers>& high) {
  if (low.t < high.t) return true;
  if constexpr (Numbers::kCertified) {
    if (certainly_before(high, low)) return false;
    low.error = high.error = low.error + high.error;
    low.t = high.t;
    low.name = high.name = {};
    return true;
  }
  return false;
}

/// The same of a stretch that hides something. If the numbers say that it has a length, and it may
/// have none, its ends are blurred: what is seen on both sides of it is only together what it is
/// without the stretch, and must not be found from where one end would be alone.
template <class Numbers>
bool shorten_cover(Place<Numbers>& low, Place<Numbers>& high) {
  if (Numbers::kCertified && low.t < high.t && !certainly_before(low, high)) {
    low.name = low.name.blurred();
    high.name = high.name.blurred();
  }
  return shorten(low, high);
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_NUMBERS_H
