// SPDX-License-Identifier: GPL-3.0-or-later
// A foreign result that tells how much of every polygon is lit, and not where: no fragments, only a
// fraction or an area a class. Enough to be judged by recorded fractions.
#ifndef GNOMON_FUZZ_CORPUS_CLAIMED_SHARES_H
#define GNOMON_FUZZ_CORPUS_CLAIMED_SHARES_H

#include <string>
#include <string_view>
#include <vector>

#include "fuzz/corpus/recorded.h"
#include "gnomon/kernel/error.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"

namespace gnomon::fuzz {

/// True if no polygon of the result lists fragments. Errors: kSyntax.
Expected<bool> has_shares_alone(std::string_view result_json);

/// The first side whose shares differ from the recorded ones by more than the tolerance, in words;
/// empty if all agree. A class is an object with "fraction" (a number, or "p/q") or "area" (scene
/// units squared), or such a fraction itself; a class left out is what the others leave. Under an
/// area light only `lit` counts unless the light says "umbra": "per-caster". Errors: kSyntax,
/// kFormat with the JSON pointer.
Expected<std::string> compare_shares(std::string_view result_json, const Scene& scene,
                                     const PreparedScene& prepared,
                                     const std::vector<RecordedLight>& recorded, double tolerance);

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_CORPUS_CLAIMED_SHARES_H
