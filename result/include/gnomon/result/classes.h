// SPDX-License-Identifier: LGPL-3.0-or-later
// The words that a result is told in: the class of a fragment, the side of a polygon, the reason of
// a darkness without a caster, how fragments cover a polygon; and the only names that files,
// messages and tables have for them.
// Algorithms, oracle, report and tests share this vocabulary and nothing that decides.
#ifndef GNOMON_RESULT_CLASSES_H
#define GNOMON_RESULT_CLASSES_H

#include <cstdint>
#include <optional>
#include <string_view>

#include "gnomon/kernel/sign.h"

namespace gnomon {

/// The class of a fragment under one light. A point or directional light knows kLit and kShadow, an
/// area light kLit, kPenumbra and kUmbra.
enum class LightState : std::uint8_t { kLit, kShadow, kPenumbra, kUmbra };

/// Why a part, or a fragment of one, is in shadow without any caster.
enum class ShadowReason : std::uint8_t {
  kNone,
  kFacesAway,
  kLightInPlane,
  kBehindLight,
  kOutsideRegion
};

/// What the fragments of a side mean together. kPartition: they tile it, and none overlaps another.
/// kOverlay: they are painted over each other in their order, so that the last one that holds a
/// point tells its class.
enum class Cover : std::uint8_t { kPartition, kOverlay };

/// Where a result tells of its lights. kLights: light by light. kCombined: fragments with the
/// lights that reach them. kOverlay: shadows of several lights painted on shadows.
enum class Block : std::uint8_t { kLights, kCombined, kOverlay };

/// "lit", "shadow", "penumbra", "umbra".
const char* name_of(LightState state);
/// "front" or "back", as a polygon's side. Requires: not kOn.
const char* name_of(Side side);
/// "faces-away", "light-in-plane", "behind-light", "outside-region"; empty for kNone.
const char* name_of(ShadowReason reason);
/// "partition" or "overlay".
const char* name_of(Cover cover);
/// "lights", "combined" or "overlay": the key in a result file.
const char* name_of(Block block);

/// The value with that name; none if no value has it. kNone has no name.
std::optional<LightState> light_state_by_name(std::string_view name);
std::optional<Side> side_by_name(std::string_view name);
std::optional<ShadowReason> shadow_reason_by_name(std::string_view name);
std::optional<Cover> cover_by_name(std::string_view name);

}  // namespace gnomon

#endif  // GNOMON_RESULT_CLASSES_H
