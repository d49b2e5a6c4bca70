// SPDX-License-Identifier: GPL-3.0-or-later
// What a kernel computed, in the form that the oracle judges: exact points, ids instead of indices.
// Rounded points are taken as the numbers that they are.
#ifndef GNOMON_REPORT_SIDES_CLAIMS_OF_H
#define GNOMON_REPORT_SIDES_CLAIMS_OF_H

#include <string>

#include "gnomon/algorithms/shadow_result.h"
#include "gnomon/result/claims.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"
#include "report/sides/polygon_sides.h"

namespace gnomon::report {

/// Uses exact points where they were kept, else the nearest ones. A fragment with a vertex that is
/// no finite number cannot be judged and is left out: its area counts as uncovered. What the result
/// has of several lights at once is claimed besides, where it is not empty. Umbra
/// of area lights is claimed per caster. Of a method without fragments shares alone are claimed.
/// `sides`: of the same result; the exact shares in them are
/// claimed.
Claims claims_of(const Scene& scene, const PreparedScene& prepared, const ShadowResult& result,
                 const SidesByLight& sides, std::string name);
/// The same where nobody else reads the sides. Exact fractions are claimed if `claim_fractions`
/// (they must have been computed).
Claims claims_of(const Scene& scene, const PreparedScene& prepared, const ShadowResult& result,
                 std::string name, bool claim_fractions);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_SIDES_CLAIMS_OF_H
