// SPDX-License-Identifier: LGPL-3.0-or-later
// Reads a result file (docs: formats, "Result"), ours or a foreign program's.
//
// Needs lights[].id, polygons[].id, `side` where both sides count, and fragments[].{class, loop},
// or where shares alone will do `lit`, `shadow`, `penumbra`, `umbra`, each a fraction (a number,
// "p/q", or an object with "fraction") or an object with "area"; `background` lets a light list one
// class only, `listed` lets it tell of some classes alone, `cover` says whether loops are painted
// over each other, `"umbra": "per-caster"` what umbra means (all also for all lights at the top).
// `combined` and `overlay` tell of several lights at once; with either `lights` may be missing.
// Unknown keys are ignored. `exact_loop` and `exact_holes` with coordinates as "p/q" are preferred
// to `loop` and `holes`. Coordinates mean what the scene's numbers mean.
#ifndef GNOMON_RESULT_READ_CLAIMS_H
#define GNOMON_RESULT_READ_CLAIMS_H

#include <cstdint>
#include <string>
#include <string_view>

#include "gnomon/kernel/error.h"
#include "gnomon/result/claims.h"
#include "gnomon/scene/scene.h"

namespace gnomon {

/// Whether a polygon may tell its shares instead of fragments.
enum class SharesAlone : std::uint8_t { kRefused, kTaken };

/// Errors: kFile, kSyntax (with line and column), kFormat, kNumber (with the JSON pointer).
Expected<Claims> read_claims(const std::string& path, const Scene& scene,
                             SharesAlone shares = SharesAlone::kRefused);
/// The same from text; `file` is for messages.
Expected<Claims> parse_claims(std::string_view text, const std::string& file, const Scene& scene,
                              SharesAlone shares = SharesAlone::kRefused);

}  // namespace gnomon

#endif  // GNOMON_RESULT_READ_CLAIMS_H
