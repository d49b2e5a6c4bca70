// SPDX-License-Identifier: LGPL-3.0-or-later
// The class of a convex piece of a receiver under one light, with the witness or the reason of it.
#ifndef GNOMON_ALGORITHMS_PARTITION_PIECE_CLASS_H
#define GNOMON_ALGORITHMS_PARTITION_PIECE_CLASS_H

#include <cstdint>

#include "gnomon/algorithms/shadow_result.h"

namespace gnomon {

struct PieceClass {
  LightState state = LightState::kLit;
  std::uint32_t caster = Fragment::kNoCaster;  // the witness
  ShadowReason reason = ShadowReason::kNone;
  std::uint32_t casters = Fragment::kNoCaster;  // as Fragment::casters, of a FragmentSink's sets
  friend bool operator==(const PieceClass&, const PieceClass&) = default;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PARTITION_PIECE_CLASS_H
