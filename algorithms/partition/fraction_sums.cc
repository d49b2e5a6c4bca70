// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/partition/fraction_sums.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon {

void FractionSums::add_enclosure(std::uint32_t part, const Ball& fraction) {
  // Scaling by 2^60 is exact; conversion truncates, so that one more unit is outwards.
  constexpr double kScale = static_cast<double>(std::int64_t{1} << kBits);
  const auto middle = static_cast<std::int64_t>(fraction.middle * kScale);
  const auto radius = static_cast<std::int64_t>(fraction.radius * kScale) + 2;
  first_[part].fetch_add(middle - radius, std::memory_order_relaxed);
  second_[part].fetch_add(middle + radius, std::memory_order_relaxed);
}

Interval FractionSums::enclosure(std::uint32_t part) const {
  // Conversion of 62 bits to a double rounds: the next double outwards is safe.
  const double low = static_cast<double>(first_[part].load(std::memory_order_relaxed));
  const double high = static_cast<double>(second_[part].load(std::memory_order_relaxed));
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {std::clamp(std::ldexp(std::nextafter(low, -kInfinity), -kBits), 0.0, 1.0),
          std::clamp(std::ldexp(std::nextafter(high, kInfinity), -kBits), 0.0, 1.0)};
}

void FractionSums::add_rounded(std::uint32_t part, bool lit, double fraction) {
  std::atomic<std::int64_t>& sum = lit ? first_[part] : second_[part];
  if (!(std::fabs(fraction) < 2)) {
    sum.store(kPoison, std::memory_order_relaxed);
    return;
  }
  const auto units = static_cast<std::int64_t>(std::ldexp(fraction, kBits));
  std::int64_t old = sum.load(std::memory_order_relaxed);
  while (old != kPoison &&
         !sum.compare_exchange_weak(old, std::abs(old + units) < kPoison ? old + units : kPoison,
                                    std::memory_order_relaxed)) {
  }
}

double FractionSums::rounded(std::uint32_t part, bool lit) const {
  const std::int64_t sum = (lit ? first_ : second_)[part].load(std::memory_order_relaxed);
  if (sum == kPoison) return std::numeric_limits<double>::quiet_NaN();
  return std::ldexp(static_cast<double>(sum), -kBits);
}

}  // namespace gnomon
