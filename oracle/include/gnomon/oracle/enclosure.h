// SPDX-License-Identifier: GPL-3.0-or-later
// Certified enclosures: a pair of doubles with the true value between them, for sums and roots
// whose exact value would grow without bound. Every operation rounds outward by nextafter, which is
// sound because each of its correctly rounded steps is off by at most half a unit in the last
// place.
#ifndef GNOMON_ORACLE_ENCLOSURE_H
#define GNOMON_ORACLE_ENCLOSURE_H

#include <gmpxx.h>

#include <string>

namespace gnomon::oracle {

struct Enclosure {
  double lower = 0, upper = 0;

  double middle() const { return lower + (upper - lower) / 2; }
  bool is_zero() const { return lower == 0 && upper == 0; }
  bool contains(double value) const { return lower <= value && value <= upper; }
};

double round_down(double value);
double round_up(double value);

/// The narrowest enclosure that one conversion gives; exact doubles become a single point.
Enclosure enclose(const mpq_class& value);
Enclosure enclose(const mpz_class& value);

Enclosure operator+(Enclosure a, Enclosure b);
Enclosure operator-(Enclosure a, Enclosure b);
Enclosure operator*(Enclosure a, Enclosure b);
/// Requires: b does not contain 0.
Enclosure operator/(Enclosure a, Enclosure b);
/// Requires: a.upper >= 0; a negative lower bound counts as 0.
Enclosure square_root(Enclosure a);
/// Both bounds at least those of either.
Enclosure greater_of(Enclosure a, Enclosure b);
/// Cuts an enclosure of something that cannot be negative.
Enclosure not_negative(Enclosure a);

/// An enclosure of sqrt(value) that neither overflows nor underflows before the result does.
Enclosure enclose_square_root(const mpq_class& value);

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_ENCLOSURE_H
