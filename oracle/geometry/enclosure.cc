// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnomon/oracle/enclosure.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::oracle {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Outward only where the double is not exact: keeps 0, 1 and small integers as single points.
template <class Exact>
Enclosure around(double truncated, const Exact& value) {
  if (!std::isfinite(truncated)) {
    const double largest = std::numeric_limits<double>::max();
    return value > 0 ? Enclosure{largest, kInfinity} : Enclosure{-kInfinity, -largest};
  }
  const int order = cmp(value, Exact(truncated));
  if (order == 0) return {truncated, truncated};
  return order > 0 ? Enclosure{truncated, round_up(truncated)}
                   : Enclosure{round_down(truncated), truncated};
}

}  // namespace

double round_down(double value) { return std::nextafter(value, -kInfinity); }
double round_up(double value) { return std::nextafter(value, kInfinity); }

Enclosure enclose(const mpq_class& value) { return around(value.get_d(), value); }
Enclosure enclose(const mpz_class& value) {
  if (mpz_sizeinbase(value.get_mpz_t(), 2) > 1023) return around(sgn(value) * kInfinity, value);
  return around(value.get_d(), value);
}

Enclosure operator+(Enclosure a, Enclosure b) {
  if (a.is_zero()) return b;
  if (b.is_zero()) return a;
  return {round_down(a.lower + b.lower), round_up(a.upper + b.upper)};
}

Enclosure operator-(Enclosure a, Enclosure b) { return a + Enclosure{-b.upper, -b.lower}; }

Enclosure operator*(Enclosure a, Enclosure b) {
  if (a.is_zero() || b.is_zero()) return {};
  const double products[] = {a.lower * b.lower, a.lower * b.upper, a.upper * b.lower,
                             a.upper * b.upper};
  for (double product : products) {
    if (std::isnan(product)) return {-kInfinity, kInfinity};
  }
  return {round_down(*std::min_element(products, products + 4)),
          round_up(*std::max_element(products, products + 4))};
}

Enclosure operator/(Enclosure a, Enclosure b) {
  if (a.is_zero()) return {};
  const double quotients[] = {a.lower / b.lower, a.lower / b.upper, a.upper / b.lower,
                              a.upper / b.upper};
  for (double quotient : quotients) {
    if (std::isnan(quotient)) return {-kInfinity, kInfinity};
  }
  return {round_down(*std::min_element(quotients, quotients + 4)),
          round_up(*std::max_element(quotients, quotients + 4))};
}

Enclosure square_root(Enclosure a) {
  if (a.is_zero()) return {};
  const double low = std::max(a.lower, 0.0);
  return {low == 0 ? 0.0 : std::max(0.0, round_down(std::sqrt(low))), round_up(std::sqrt(a.upper))};
}

Enclosure greater_of(Enclosure a, Enclosure b) {
  return {std::max(a.lower, b.lower), std::max(a.upper, b.upper)};
}

Enclosure not_negative(Enclosure a) { return {std::max(a.lower, 0.0), std::max(a.upper, 0.0)}; }

Enclosure enclose_square_root(const mpq_class& value) {
  if (sgn(value) <= 0) return {};
  // sqrt(v) = sqrt(v 4^k) / 2^k, k chosen so that v 4^k is near 1.
  const long bits = static_cast<long>(mpz_sizeinbase(value.get_num_mpz_t(), 2)) -
                    static_cast<long>(mpz_sizeinbase(value.get_den_mpz_t(), 2));
  const long half = bits / 2;
  mpq_class scaled = value;
  if (half > 0) {
    mpq_div_2exp(scaled.get_mpq_t(), scaled.get_mpq_t(), 2 * static_cast<mp_bitcnt_t>(half));
  } else {
    mpq_mul_2exp(scaled.get_mpq_t(), scaled.get_mpq_t(), 2 * static_cast<mp_bitcnt_t>(-half));
  }
  const Enclosure root = square_root(enclose(scaled));
  const int shift = static_cast<int>(std::clamp(half, -5000L, 5000L));
  Enclosure result{std::ldexp(root.lower, shift), std::ldexp(root.upper, shift)};
  if (result.upper < 1e-300 || !std::isfinite(result.upper)) {
    result = {std::max(0.0, round_down(result.lower)), round_up(result.upper)};
  }
  return result;
}

}  // namespace gnomon::oracle
