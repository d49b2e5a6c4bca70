// SPDX-License-Identifier: GPL-3.0-or-later
// Families of small random scenes: few polygons, much degeneracy, every magnitude. The exact suites
// and campaigns draw from them, and regressions name them by seed: the same family and seed give
// the same scene everywhere and always.
#ifndef GNOMON_FUZZ_GENERATE_FAMILIES_H
#define GNOMON_FUZZ_GENERATE_FAMILIES_H

#include <cstdint>
#include <string>
#include <vector>

#include "gnomon/scene/scene.h"

namespace gnomon::fuzz {

struct Family {
  std::string name;  // CamelCase, as in names of tests
  Scene (*make)(std::uint64_t seed);
  unsigned blocks = 1;    // tests that an exact suite makes of it
  unsigned scenes = 100;  // seeds in each of them
  /// Drawn by the generators `mix` and `area-mix`. A family that joins them changes the scene of
  /// every seed.
  bool in_mix = true;
};

const std::vector<Family>& families();
const Family& family_by_name(const std::string& name);

/// The same scene times 2^exponent, lights too (directions included).
Scene scaled(const Scene& scene, int exponent);

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_GENERATE_FAMILIES_H
