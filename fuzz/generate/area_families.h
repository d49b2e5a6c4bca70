// SPDX-License-Identifier: GPL-3.0-or-later
// Families of small random scenes under area lights: those of families.h with a light put through
// their own vertices, and lattices in which lights and polygons share vertices, edges and planes,
// cut each other and stand behind each other.
#ifndef GNOMON_FUZZ_GENERATE_AREA_FAMILIES_H
#define GNOMON_FUZZ_GENERATE_AREA_FAMILIES_H

#include <vector>

#include "fuzz/generate/families.h"

namespace gnomon::fuzz {

const std::vector<Family>& area_families();

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_GENERATE_AREA_FAMILIES_H
