// SPDX-License-Identifier: GPL-3.0-or-later
// Soups: few independent polygons in a box, with lights in and around it.
#ifndef GNOMON_FUZZ_GENERATE_SOUPS_H
#define GNOMON_FUZZ_GENERATE_SOUPS_H

#include <cstdint>

#include "gnomon/scene/scene.h"
#include "scene/base/random.h"

namespace gnomon::fuzz {

enum class Soup : std::uint8_t {
  kUniform,     // anywhere in the box, coordinates of 6 to 53 bits
  kClustered,   // small, round one to three places
  kLattice,     // on a lattice of 3 to 6 points an axis (add_lattice)
  kMixedSizes,  // sizes from 1 to 2^-30 of the box
};

/// Two to five polygons, seldom up to twelve; one or two lights, area lights if `area`. All
/// polygons one-sided, all two-sided, or either. All loops are exactly planar.
Scene make_soup(Soup soup, bool area, Random& random);

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_GENERATE_SOUPS_H
