// SPDX-License-Identifier: LGPL-3.0-or-later
// Which level of vector instructions the inner loops run on: the best that the machine has, unless
// the environment variable GNOMON_SIMD or a test asks for another. Answers do not depend on it.
#ifndef GNOMON_ALGORITHMS_CONTOUR_LANES_SIMD_LEVEL_H
#define GNOMON_ALGORITHMS_CONTOUR_LANES_SIMD_LEVEL_H

#include <cstdint>
#include <string_view>
#include <vector>

#include "algorithms/contour/lanes/lanes.h"
#include "gnomon/kernel/error.h"

namespace gnomon {

enum class SimdLevel : std::uint8_t {
  kBaseline,  // what every machine of the architecture has; on x86-64, SSE2
  kAvx2,
  kAvx512,  // F, DQ and VL, in vectors of 256 bits
};

/// "sse2" (elsewhere than on x86-64 "baseline"), "avx2", "avx512".
std::string_view name_of(SimdLevel level);

/// The levels of this machine, the best one last.
const std::vector<SimdLevel>& simd_levels();

/// The functions of a level. Requires: the machine has it.
const Lanes& lanes(SimdLevel level);

/// The level of this name. Errors: kUsage, if there is none or if this machine lacks it.
Expected<SimdLevel> parse_simd_level(std::string_view name);

/// The level that runs are to use: what GNOMON_SIMD names, which is read once, else the best one of
/// this machine. Errors: kUsage, as above.
Expected<SimdLevel> chosen_simd_level();

/// For tests: what chosen_simd_level returns while this object lives. One at a time, and none while
/// other threads run. Requires: the machine has the level.
class ForcedSimdLevel {
 public:
  explicit ForcedSimdLevel(SimdLevel level);
  ~ForcedSimdLevel();
  ForcedSimdLevel(const ForcedSimdLevel&) = delete;
  ForcedSimdLevel& operator=(const ForcedSimdLevel&) = delete;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_LANES_SIMD_LEVEL_H
