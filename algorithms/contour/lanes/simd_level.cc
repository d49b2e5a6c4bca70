// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/contour/lanes/simd_level.h"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string>

namespace gnomon {
namespace {

std::optional<SimdLevel> forced_level;

std::vector<SimdLevel> levels_of_this_machine() {
  std::vector<SimdLevel> levels = {SimdLevel::kBaseline};
#if defined(__x86_64__)
  __builtin_cpu_init();
  if (!__builtin_cpu_supports("avx2")) return levels;
  levels.push_back(SimdLevel::kAvx2);
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl")) {
    levels.push_back(SimdLevel::kAvx512);
  }
#endif
  return levels;
}

Expected<SimdLevel> level_of_environment() {
  const char* name = std::getenv("GNOMON_SIMD");
  if (name == nullptr) return simd_levels().back();
  return parse_simd_level(name);
}

}  // namespace

std::string_view name_of(SimdLevel level) {
  switch (level) {
    case SimdLevel::kBaseline:
#if defined(__x86_64__)
      return "sse2";
#else
      return "baseline";
#endif
    case SimdLevel::kAvx2:
      return "avx2";
    case SimdLevel::kAvx512:
      return "avx512";
  }
  return "";
}

const std::vector<SimdLevel>& simd_levels() {
  static const std::vector<SimdLevel> kLevels = levels_of_this_machine();
  return kLevels;
}

const Lanes& lanes([[maybe_unused]] SimdLevel level) {
#if defined(__x86_64__)
  if (level == SimdLevel::kAvx2) return lanes_avx2::kLanes;
  if (level == SimdLevel::kAvx512) return lanes_avx512::kLanes;
#endif
  return lanes_baseline::kLanes;
}

Expected<SimdLevel> parse_simd_level(std::string_view name) {
  for (const SimdLevel level : {SimdLevel::kBaseline, SimdLevel::kAvx2, SimdLevel::kAvx512}) {
    if (name != name_of(level)) continue;
    if (std::ranges::count(simd_levels(), level) > 0) return level;
    return fail(ErrorCode::kUsage,
                "GNOMON_SIMD is " + std::string(name) + ", which this machine does not have",
                std::string(name_of(simd_levels().back())) + " at most");
  }
  return fail(ErrorCode::kUsage, "GNOMON_SIMD is '" + std::string(name) + "'",
              std::string(name_of(SimdLevel::kBaseline)) + ", avx2 or avx512");
}

Expected<SimdLevel> chosen_simd_level() {
  static const Expected<SimdLevel> kLevel = level_of_environment();
  return forced_level ? Expected<SimdLevel>(*forced_level) : kLevel;
}

ForcedSimdLevel::ForcedSimdLevel(SimdLevel level) { forced_level = level; }
ForcedSimdLevel::~ForcedSimdLevel() { forced_level.reset(); }

}  // namespace gnomon
