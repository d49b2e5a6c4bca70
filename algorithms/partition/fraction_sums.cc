// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/partition/fraction_sums.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The largest double that is at most the integer, and the smallest that is at least it.
double below(Int128 value) {
  const auto nearest = static_cast<double>(value);
  return static_cast<Int128>(nearest) <= value ? nearest : std::nextafter(nearest, -kInfinity);
}
double above(Int128 value) { return -below(-value); }

}  // namespace

void FractionSums::add_fixed(std::uint32_t part, std::size_t end, Int128 value) {
  std::atomic<std::int64_t>* const words = &words_[kWords * part + 2 * end];
  const auto low = static_cast<std::uint64_t>(value);
  const auto before = static_cast<std::uint64_t>(
      words[0].fetch_add(static_cast<std::int64_t>(low), std::memory_order_relaxed));
  // Carries arrive in any order, and all of them before the sum is read.
  const std::int64_t carry = before + low < before ? 1 : 0;
  const std::int64_t high = static_cast<std::int64_t>(value >> 64) + carry;
  if (high != 0) words[1].fetch_add(high, std::memory_order_relaxed);
}

Int128 FractionSums::fixed(std::uint32_t part, std::size_t end) const {
  const std::atomic<std::int64_t>* const words = &words_[kWords * part + 2 * end];
  const auto low = static_cast<std::uint64_t>(words[0].load(std::memory_order_relaxed));
  const std::int64_t high = words[1].load(std::memory_order_relaxed);
  return static_cast<Int128>(static_cast<UInt128>(high) << 64 | low);
}

void FractionSums::add_enclosure(std::uint32_t part, const PairBall& fraction) {
  // Scaling by 2^120 is exact; each of three conversions truncates.
  constexpr double kScale = 0x1p120;
  const Int128 middle = static_cast<Int128>(fraction.middle.high * kScale) +
                        static_cast<Int128>(fraction.middle.low * kScale);
  const Int128 radius = static_cast<Int128>(fraction.radius * kScale) + 3;
  add_fixed(part, 0, middle - radius);
  add_fixed(part, 1, middle + radius);
}

Interval FractionSums::enclosure(std::uint32_t part) const {
  return {std::clamp(std::ldexp(below(fixed(part, 0)), -kBits), 0.0, 1.0),
          std::clamp(std::ldexp(above(fixed(part, 1)), -kBits), 0.0, 1.0)};
}

Interval FractionSums::rest(std::uint32_t part) const {
  constexpr Int128 kOne = Int128{1} << kBits;
  return {std::clamp(std::ldexp(below(kOne - fixed(part, 1)), -kBits), 0.0, 1.0),
          std::clamp(std::ldexp(above(kOne - fixed(part, 0)), -kBits), 0.0, 1.0)};
}

void FractionSums::add_rounded(std::uint32_t part, bool lit, double fraction) {
  std::atomic<std::int64_t>& sum = words_[kWords * part + (lit ? 0 : 1)];
  if (!(std::fabs(fraction) < 2)) {
    sum.store(kPoison, std::memory_order_relaxed);
    return;
  }
  const auto units = static_cast<std::int64_t>(std::ldexp(fraction, kRoundedBits));
  std::int64_t old = sum.load(std::memory_order_relaxed);
  while (old != kPoison &&
         !sum.compare_exchange_weak(old, std::abs(old + units) < kPoison ? old + units : kPoison,
                                    std::memory_order_relaxed)) {
  }
}

double FractionSums::rounded(std::uint32_t part, bool lit) const {
  const std::int64_t sum = words_[kWords * part + (lit ? 0 : 1)].load(std::memory_order_relaxed);
  if (sum == kPoison) return std::numeric_limits<double>::quiet_NaN();
  return std::ldexp(static_cast<double>(sum), -kRoundedBits);
}

}  // namespace gnomon
