// SPDX-License-Identifier: GPL-3.0-or-later
// Rational numbers of any size as decimals: also those that no double is near.
#ifndef GNOMON_REPORT_TEXT_DECIMAL_TEXT_H
#define GNOMON_REPORT_TEXT_DECIMAL_TEXT_H

#include <gmpxx.h>

#include <string>

namespace gnomon::report {

/// At most `digits` significant digits, without zeros at the end, and an exponent of ten:
/// "7.5e-361", "-1e+02", "0". Off by at most half a unit of the last digit that it may have.
std::string decimal_text(const mpq_class& value, int digits = 17);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_TEXT_DECIMAL_TEXT_H
