// SPDX-License-Identifier: GPL-3.0-or-later
// What a kernel computed, in the form that the oracle judges: exact points, ids instead of indices.
// Rounded points are taken as the numbers that they are.
#ifndef GNOMON_REPORT_SIDES_CANDIDATE_FROM_RESULT_H
#define GNOMON_REPORT_SIDES_CANDIDATE_FROM_RESULT_H

#include <string>

#include "gnomon/algorithms/shadow_result.h"
#include "gnomon/oracle/candidate.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"

namespace gnomon::report {

/// Uses LightResult::exact_points where they were kept, else `points`. A fragment with a vertex
/// that is no finite number cannot be judged and is left out: its area counts as uncovered. Exact
/// fractions are claimed if `claim_fractions` (they must have been computed). Umbra of area lights
/// is claimed per caster.
oracle::Candidate candidate_from_result(const Scene& scene, const PreparedScene& prepared,
                                        const ShadowResult& result, std::string name,
                                        bool claim_fractions);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_SIDES_CANDIDATE_FROM_RESULT_H
