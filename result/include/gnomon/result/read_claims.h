// SPDX-License-Identifier: LGPL-3.0-or-later
// Reads a result file (docs: formats, "Result"), ours or a foreign program's.
//
// Needs lights[].id, polygons[].id, `side` where both sides count, and fragments[].{class, loop};
// `background` lets a light list one class only, `"umbra": "per-caster"` says what umbra means
// (both also for all lights at the top); unknown keys are ignored. `exact_loop` with coordinates as
// "p/q" is preferred to `loop`. Coordinates mean what the scene's numbers mean.
#ifndef GNOMON_RESULT_READ_CLAIMS_H
#define GNOMON_RESULT_READ_CLAIMS_H

#include <string>
#include <string_view>

#include "gnomon/kernel/error.h"
#include "gnomon/result/claims.h"
#include "gnomon/scene/scene.h"

namespace gnomon {

/// Errors: kFile, kSyntax (with line and column), kFormat, kNumber (with the JSON pointer).
Expected<Claims> read_claims(const std::string& path, const Scene& scene);
/// The same from text; `file` is for messages.
Expected<Claims> parse_claims(std::string_view text, const std::string& file, const Scene& scene);

}  // namespace gnomon

#endif  // GNOMON_RESULT_READ_CLAIMS_H
