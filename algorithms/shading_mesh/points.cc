// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/shading_mesh/points.h"

#include <cmath>

#include "algorithms/partition/exact_line.h"
#include "kernel/signs/nearest_double.h"

namespace gnomon {

std::array<mpq_class, 3> ExactPoint::rational() const {
  std::array<mpq_class, 3> result;
  for (std::size_t k = 0; k < 3; ++k) {
    result[k] = mpq_class(numerator[k], denominator);
    result[k].canonicalize();
  }
  return result;
}

ExactPoint exact_point(const std::array<mpq_class, 3>& point) {
  ExactPoint result;
  result.denominator = point[0].get_den();
  for (std::size_t k = 1; k < 3; ++k) {
    result.denominator = lcm(result.denominator, point[k].get_den());
  }
  // No factor is common to all four: the highest power of a prime in the denominator comes from
  // one of the rationals, whose numerator it does not divide.
  for (std::size_t k = 0; k < 3; ++k) {
    result.numerator[k] = result.denominator / point[k].get_den() * point[k].get_num();
  }
  return result;
}

void make_primitive(ExactPoint& point) {
  mpz_class factor = point.denominator;
  for (const mpz_class& number : point.numerator) {
    if (factor == 1) break;
    factor = gcd(factor, number);
  }
  factor = abs(factor);
  if (sgn(point.denominator) < 0) factor = -factor;
  if (factor == 1) return;
  for (mpz_class* number :
       {&point.numerator[0], &point.numerator[1], &point.numerator[2], &point.denominator}) {
    mpz_divexact(number->get_mpz_t(), number->get_mpz_t(), factor.get_mpz_t());
  }
}

namespace {

/// The double nearest to a quotient. Requires: denominator > 0.
double nearest_quotient(const mpz_class& numerator, const mpz_class& denominator) {
  if (sgn(numerator) == 0) return 0;
  // A quotient of 63 or 64 bits whose last bit stands for whatever follows: rounding it to 53 bits
  // rounds the true value, ties included.
  constexpr long kBits = 64;
  const long shift = kBits + static_cast<long>(mpz_sizeinbase(denominator.get_mpz_t(), 2)) - 1 -
                     static_cast<long>(mpz_sizeinbase(numerator.get_mpz_t(), 2));
  if (shift < -900 || shift > 900) {  // near the ends of the range of doubles
    mpq_class value(numerator, denominator);
    value.canonicalize();
    return nearest_double(value);
  }
  mpz_class dividend = abs(numerator), divisor = denominator, quotient, rest;
  if (shift >= 0) {
    dividend <<= static_cast<unsigned long>(shift);
  } else {
    divisor <<= static_cast<unsigned long>(-shift);
  }
  mpz_tdiv_qr(quotient.get_mpz_t(), rest.get_mpz_t(), dividend.get_mpz_t(), divisor.get_mpz_t());
  const std::uint64_t bits = mpz_getlimbn(quotient.get_mpz_t(), 0) | (sgn(rest) != 0 ? 1u : 0u);
  const double magnitude = std::ldexp(static_cast<double>(bits), static_cast<int>(-shift));
  return sgn(numerator) < 0 ? -magnitude : magnitude;
}

}  // namespace

std::array<double, 3> nearest_doubles(const ExactPoint& point) {
  std::array<double, 3> result{};
  for (std::size_t k = 0; k < 3; ++k) {
    result[k] = nearest_quotient(point.numerator[k], point.denominator);
  }
  return result;
}

ExactPoint middle(const ExactPoint& a, const ExactPoint& b) {
  ExactPoint result;
  for (std::size_t k = 0; k < 3; ++k) {
    result.numerator[k] = a.numerator[k] * b.denominator + b.numerator[k] * a.denominator;
  }
  result.denominator = 2 * a.denominator * b.denominator;
  make_primitive(result);
  return result;
}

int compare(const ExactPoint& a, const ExactPoint& b, int axis) {
  const auto k = static_cast<std::size_t>(axis);
  return cmp(a.numerator[k] * b.denominator, b.numerator[k] * a.denominator);
}

NewPoint new_point(ExactPoint exact) {
  const std::array<double, 3> nearest = nearest_doubles(exact);
  return {std::move(exact), nearest};
}

std::uint32_t PointTable::insert(NewPoint point) {
  const auto number = static_cast<std::uint32_t>(exact_.size());
  std::uint64_t hash = hash_of(point.exact.denominator, 0);
  for (const mpz_class& coordinate : point.exact.numerator) hash = hash_of(coordinate, hash);
  exact_.push_back(std::move(point.exact));
  nearest_.push_back(point.nearest);
  hashes_.push_back(hash);
  const auto [at, is_new] = numbers_.insert(number);
  if (!is_new) {
    exact_.pop_back();
    nearest_.pop_back();
    hashes_.pop_back();
  }
  return *at;
}

int PointTable::compare(std::uint32_t a, std::uint32_t b, int axis) const {
  const auto k = static_cast<std::size_t>(axis);
  if (nearest_[a][k] != nearest_[b][k]) return nearest_[a][k] < nearest_[b][k] ? -1 : 1;
  return gnomon::compare(exact_[a], exact_[b], axis);
}

}  // namespace gnomon
