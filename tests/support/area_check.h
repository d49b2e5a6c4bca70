// SPDX-License-Identifier: GPL-3.0-or-later
// What every exact kernel promises under area lights, as one check of one scene: fractions of lit,
// penumbra and umbra that add up to exactly 1, equal each other on all kernels and by all
// algorithms, and come from fragments that the oracle calls identical and whose claims hold.
#ifndef GNOMON_TESTS_SUPPORT_AREA_CHECK_H
#define GNOMON_TESTS_SUPPORT_AREA_CHECK_H

#include <string>

#include "solve.h"

namespace gnomon::test {

/// Empty if all is well; else the first thing that is wrong.
std::string check_area_exact(const Case& scene);

/// Of classes and shares by contour, held against exact ones by `receiver`: every class is told for
/// certain, and bounds hold.
std::string check_area_contour(const Case& scene);

/// Exact lit, penumbra and umbra of one side of a polygon of one part.
struct Fractions3 {
  mpq_class lit, penumbra, umbra;
  friend bool operator==(const Fractions3&, const Fractions3&) = default;
};
Fractions3 area_fractions_of(const Case& scene, const ShadowOptions& options,
                             const std::string& light, const std::string& polygon,
                             Side side = Side::kFront);

}  // namespace gnomon::test

#endif  // GNOMON_TESTS_SUPPORT_AREA_CHECK_H
