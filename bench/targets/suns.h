// SPDX-License-Identifier: GPL-3.0-or-later
// The suns of a year, as an annual study of a building takes them.
#ifndef GNOMON_BENCH_TARGETS_SUNS_H
#define GNOMON_BENCH_TARGETS_SUNS_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::bench {

/// Directions to the sun at 48 degrees north, x east, y north, z up, as whole numbers of some
/// 10,000 length: every hour of a year in which it stands above the horizon, in order of time, and
/// of these `count` at even distances. Requires: count <= kHoursOfSun.
inline constexpr std::size_t kHoursOfSun = 4380;
std::vector<std::array<std::int64_t, 3>> suns_of_a_year(std::size_t count);

}  // namespace gnomon::bench

#endif  // GNOMON_BENCH_TARGETS_SUNS_H
