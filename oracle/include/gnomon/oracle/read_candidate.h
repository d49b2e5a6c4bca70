// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a result file (docs: formats, "Result"), ours or a foreign program's, as a candidate.
//
// Needs lights[].id, polygons[].id, `side` where both sides count, and fragments[].{class, loop};
// `background` lets a light list one class only, `"umbra": "per-caster"` says what umbra means
// (both also for all lights at the top); unknown keys are ignored. `exact_loop` with coordinates as
// "p/q" is preferred to `loop`. Coordinates mean what the scene's numbers mean.
#ifndef GNOMON_ORACLE_READ_CANDIDATE_H
#define GNOMON_ORACLE_READ_CANDIDATE_H

#include <string>
#include <string_view>

#include "gnomon/kernel/error.h"
#include "gnomon/oracle/candidate.h"
#include "gnomon/scene/scene.h"

namespace gnomon::oracle {

/// Errors: kFile, kSyntax (with line and column), kFormat, kNumber (with the JSON pointer).
Expected<Candidate> read_candidate(const std::string& path, const Scene& scene);
/// The same from text; `file` is for messages.
Expected<Candidate> parse_candidate(std::string_view text, const std::string& file,
                                    const Scene& scene);

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_READ_CANDIDATE_H
