// SPDX-License-Identifier: LGPL-3.0-or-later
// The three-valued answers that every decision of the toolkit has: a sign, or a side of a plane.
//
// No algorithm compares numbers; it switches over one of these, and so cannot forget "on".
#ifndef GNOMON_KERNEL_SIGN_H
#define GNOMON_KERNEL_SIGN_H

#include <cstdint>

namespace gnomon {

enum class Sign : std::int8_t { kNegative = -1, kZero = 0, kPositive = 1 };

/// Where a vertex lies with respect to an oriented plane; see orientation.h for what "front" means.
enum class Side : std::int8_t { kBack = -1, kOn = 0, kFront = 1 };

constexpr Sign operator-(Sign sign) { return static_cast<Sign>(-static_cast<int>(sign)); }
constexpr Sign operator*(Sign a, Sign b) {
  return static_cast<Sign>(static_cast<int>(a) * static_cast<int>(b));
}
constexpr Side opposite(Side side) { return static_cast<Side>(-static_cast<int>(side)); }
constexpr Side side_of(Sign sign) { return static_cast<Side>(sign); }

/// The sign of a number of any ordered type; NaN counts as zero ("nothing can be said").
template <class Number>
constexpr Sign sign_of(const Number& value) {
  return value > 0 ? Sign::kPositive : value < 0 ? Sign::kNegative : Sign::kZero;
}

}  // namespace gnomon

#endif  // GNOMON_KERNEL_SIGN_H
