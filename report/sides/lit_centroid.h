// SPDX-License-Identifier: GPL-3.0-or-later
// The centroid of what is lit of a polygon's side, from its fragments: where the lit part balances.
//
// Exactness: from exact loops, of a polygon whose parts lie in one plane, a rational point (areas
// in one plane are proportional to areas in a chart of it); of others and by rounded kernels the
// nearest doubles of what the fragments say, with areas to 160 bits.
#ifndef GNOMON_REPORT_SIDES_LIT_CENTROID_H
#define GNOMON_REPORT_SIDES_LIT_CENTROID_H

#include <gmpxx.h>

#include <array>
#include <optional>

#include "report/sides/polygon_sides.h"

namespace gnomon::report {

struct LitCentroid {
  std::array<mpq_class, 3> point;  // scene units
  bool exact = false;              // `point` is the centroid itself, not one close to it
};

/// None if nothing is lit, or a rounded fragment has a vertex that is not a number. Requires: the
/// light's result keeps points, exact ones if its kernel is exact; its fragments tile the polygons
/// (no Cover::kOverlay).
std::optional<LitCentroid> lit_centroid(const PreparedScene& scene, const LightResult& light,
                                        const ClassifiedSide& side);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_SIDES_LIT_CENTROID_H
