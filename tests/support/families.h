// SPDX-License-Identifier: GPL-3.0-or-later
// Families of small random scenes for the exact suite: few polygons, much degeneracy, every
// magnitude. The same family and seed give the same scene everywhere.
#ifndef GNOMON_TESTS_SUPPORT_FAMILIES_H
#define GNOMON_TESTS_SUPPORT_FAMILIES_H

#include <cstdint>
#include <string>
#include <vector>

#include "gnomon/scene/scene.h"

namespace gnomon::test {

struct Family {
  std::string name;  // CamelCase: it becomes part of a test's name
  Scene (*make)(std::uint64_t seed);
  unsigned blocks = 1;    // tests
  unsigned scenes = 100;  // a test
};

const std::vector<Family>& families();
const Family& family_by_name(const std::string& name);

/// The same scene times 2^exponent, lights too (directions included).
Scene scaled(const Scene& scene, int exponent);

}  // namespace gnomon::test

#endif  // GNOMON_TESTS_SUPPORT_FAMILIES_H
