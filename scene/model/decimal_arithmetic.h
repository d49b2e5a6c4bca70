// SPDX-License-Identifier: LGPL-3.0-or-later
// Exact sums and products of decimal fractions, for readers of formats whose coordinates are
// computed from several numbers of the file. Nothing is rounded before as_meant().
#ifndef GNOMON_SCENE_MODEL_DECIMAL_ARITHMETIC_H
#define GNOMON_SCENE_MODEL_DECIMAL_ARITHMETIC_H

#include "gnomon/scene/number.h"

namespace gnomon {

// Requires of all: decimal numbers, or 0. Exactness: exact.
Number decimal_sum(const Number& a, const Number& b);
Number decimal_difference(const Number& a, const Number& b);
Number decimal_product(const Number& a, const Number& b);
Number negated_decimal(const Number& a);

/// Has its denominator no factors but 2 and 5?
bool is_decimal_fraction(const mpq_class& value);
/// Requires: is_decimal_fraction(value).
Number decimal_of(const mpq_class& value);
/// The decimal of `places` digits behind the point that is nearest to the value, ties away from 0.
Number rounded_decimal(const mpq_class& value, unsigned places);

/// A decimal as a scene of that meaning holds it: itself, or the double nearest to it. `underflow`
/// is set as by Number::parse(). Errors, without a place: kLimit (a decimal beyond what
/// Number::parse() takes), kNumber (beyond the range of doubles).
Expected<Number> as_meant(Number decimal, NumberMeaning meaning, bool& underflow);

}  // namespace gnomon

#endif  // GNOMON_SCENE_MODEL_DECIMAL_ARITHMETIC_H
