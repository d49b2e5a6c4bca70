// SPDX-License-Identifier: GPL-3.0-or-later
// Relations between a scene's answer and that of a scene made from it: what must not change the
// exact answer (how the scene is written down; maps of space that carry light and shadow with
// them), and what may change it in one direction only. They need no oracle, and so find what
// kernels and oracle might have wrong together.
//
// Exactness: relations are between exact fractions, and hold bit for bit. The one of rounded
// kernels is between their doubles.
#ifndef GNOMON_FUZZ_MOVES_METAMORPHIC_H
#define GNOMON_FUZZ_MOVES_METAMORPHIC_H

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "gnomon/algorithms/shadows.h"
#include "gnomon/kernel/error.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"

namespace gnomon::fuzz {

struct RelationInfo {
  std::string_view id;  // such as "mirror"
  std::string_view meaning;
};

/// All relations there are.
std::span<const RelationInfo> relations();

struct BrokenRelation {
  std::string light, polygon;  // empty if of the whole scene
  std::string text;            // one sentence
};

/// Checks relation number `relation` on the scene; `seed` chooses what is turned, moved, split.
/// Nothing where the relation holds, or says nothing of such a scene. Requires: options of an exact
/// kernel. Errors: those of compute_shadows, for either scene.
Expected<std::optional<BrokenRelation>> check_relation(std::size_t relation, const Scene& scene,
                                                       const PreparedScene& prepared,
                                                       const ShadowOptions& options,
                                                       std::uint64_t seed);

/// What a rounded kernel promises: its answer, right or wrong, depends neither on the order of
/// polygons nor on where their loops start. Compared are the doubles of all shares of each light,
/// bit for bit, whichever of two polygons in one place has which. `seed` chooses how the scene is
/// written down anew. Errors: those of compute_shadows(), for either scene.
Expected<std::optional<BrokenRelation>> check_written_otherwise(const Scene& scene,
                                                                const PreparedScene& prepared,
                                                                const ShadowOptions& options,
                                                                std::uint64_t seed);

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_MOVES_METAMORPHIC_H
