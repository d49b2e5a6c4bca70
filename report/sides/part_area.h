// SPDX-License-Identifier: GPL-3.0-or-later
// Areas of parts and polygons: exact up to one square root.
#ifndef GNOMON_REPORT_SIDES_PART_AREA_H
#define GNOMON_REPORT_SIDES_PART_AREA_H

#include <gmpxx.h>

#include <array>
#include <cstdint>

#include "gnomon/algorithms/shadow_result.h"
#include "gnomon/scene/prepare.h"

namespace gnomon::report {

/// Twice the part's area vector on the scene's grid, in the orientation of its own front.
std::array<mpz_class, 3> doubled_area_vector(const PreparedScene& scene, const Part& part);
/// Bounds of the part's area in scene units squared; [0, infinity] beyond the range of doubles.
Interval part_area(const PreparedScene& scene, const Part& part);
/// The double nearest to the part's area, scene units squared.
double nearest_area(const PreparedScene& scene, const Part& part);
/// The area of a polygon's parts, to far more digits than a double has.
mpq_class precise_area(const PreparedScene& scene, std::uint32_t polygon);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_SIDES_PART_AREA_H
