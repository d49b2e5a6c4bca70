// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers as text, the same in every locale.
#ifndef GNOMON_REPORT_TEXT_NUMBER_TEXT_H
#define GNOMON_REPORT_TEXT_NUMBER_TEXT_H

#include <cstddef>
#include <cstdint>
#include <string>

namespace gnomon::report {

/// The shortest text that reads back to the same double; "nan", "inf" and "-inf" otherwise.
std::string shortest(double value);
/// Writes the same to an array that has room for it, and returns its end.
inline constexpr std::size_t kLongestShortest = 32;
char* write_shortest(char* text, double value);
/// At most `digits` significant digits, for people: 0.333333, 1.5e-17, 0.
std::string rounded(double value, int digits = 6);
/// A count with thin groups of three: 1234567 becomes 1,234,567.
std::string grouped(std::uint64_t count);
/// A share in per cent: 12.3 %.
std::string percent(double share);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_TEXT_NUMBER_TEXT_H
