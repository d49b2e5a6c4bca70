// SPDX-License-Identifier: LGPL-3.0-or-later
// Straight lines in space as exact numbers, so that edges on one line are found whether or not they
// have an end in common: where polygons meet in T-junctions, they have none.
#ifndef GNOMON_ALGORITHMS_PARTITION_EXACT_LINE_H
#define GNOMON_ALGORITHMS_PARTITION_EXACT_LINE_H

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon {

/// Continues a hash by one more integer.
std::uint64_t hash_of(const mpz_class& number, std::uint64_t seed);

/// Direction and moment of a line, without common factor, the first number that is not 0 positive:
/// equal lines have equal numbers.
struct ExactLine {
  std::array<mpz_class, 6> numbers;
  std::uint64_t hash = 0;
  friend bool operator==(const ExactLine& a, const ExactLine& b) {
    return a.hash == b.hash && a.numbers == b.numbers;
  }
};

/// The line through A / u and B / v. Requires: two different points.
ExactLine line_through(const std::array<mpz_class, 3>& a, const mpz_class& u,
                       const std::array<mpz_class, 3>& b, const mpz_class& v);

/// The numbers of the lines that are equal, together; groups and members in order of number.
std::vector<std::vector<std::uint32_t>> group_equal_lines(std::span<const ExactLine> lines);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PARTITION_EXACT_LINE_H
