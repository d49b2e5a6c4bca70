// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/partition/exact_line.h"

#include <unordered_map>

namespace gnomon {

std::uint64_t hash_of(const mpz_class& number, std::uint64_t seed) {
  // Multiply and fold: every bit of a limb reaches every bit of the hash.
  const auto mix = [&](std::uint64_t value) {
    seed = (seed ^ value) * 0x9e3779b97f4a7c15u;
    seed ^= seed >> 32;
  };
  const std::size_t limbs = mpz_size(number.get_mpz_t());
  mix(static_cast<std::uint64_t>(limbs) * 2 + (sgn(number) < 0 ? 1 : 0));
  for (std::size_t i = 0; i < limbs; ++i) mix(mpz_getlimbn(number.get_mpz_t(), i));
  return seed;
}

ExactLine line_through(const std::array<mpz_class, 3>& a, const mpz_class& u,
                       const std::array<mpz_class, 3>& b, const mpz_class& v) {
  // Direction u B - v A and moment A x B, both times 1 / (u v).
  ExactLine line;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    line.numbers[k] = u * b[k] - v * a[k];
    line.numbers[3 + k] = a[i] * b[j] - a[j] * b[i];
  }
  mpz_class factor = 0;
  int sign = 0;
  for (const mpz_class& number : line.numbers) {
    if (factor != 1) factor = gcd(factor, number);
    if (sign == 0) sign = sgn(number);
  }
  if (sign < 0) factor = -factor;
  for (mpz_class& number : line.numbers) {
    if (factor != 1) mpz_divexact(number.get_mpz_t(), number.get_mpz_t(), factor.get_mpz_t());
    line.hash = hash_of(number, line.hash);
  }
  return line;
}

std::vector<std::vector<std::uint32_t>> group_equal_lines(std::span<const ExactLine> lines) {
  const auto hash = [&](std::uint32_t line) { return static_cast<std::size_t>(lines[line].hash); };
  const auto same = [&](std::uint32_t a, std::uint32_t b) { return lines[a] == lines[b]; };
  std::unordered_map<std::uint32_t, std::size_t, decltype(hash), decltype(same)> numbers(
      lines.size(), hash, same);
  std::vector<std::vector<std::uint32_t>> groups;
  for (std::uint32_t line = 0; line < lines.size(); ++line) {
    const auto [at, is_new] = numbers.emplace(line, groups.size());
    if (is_new) groups.emplace_back();
    groups[at->second].push_back(line);
  }
  return groups;
}

}  // namespace gnomon
