// SPDX-License-Identifier: GPL-3.0-or-later
// Sides whose loops are exact and whose claims hold: proved by signs of integers (side_proof.h).
// Nothing is called false here: what is not proved goes to witness_exact.cc.
#include <algorithm>

#include "oracle/judge/side_proof.h"
#include "oracle/judge/witness_checker.h"

namespace gnomon::oracle {

namespace {

/// Convex loops alone that tile all of a side, with witnesses.
bool can_be_proved(const ClaimedPolygon& polygon) {
  return !polygon.fragments.empty() && !polygon.penumbra_fraction && !polygon.umbra_fraction &&
         std::ranges::all_of(polygon.fragments, [](const ClaimedFragment& own) {
           return own.loop.size() >= 3 && own.holes.empty() &&
                  (own.state == LightState::kLit || own.state == LightState::kShadow);
         });
}

}  // namespace

bool WitnessChecker::is_proved(const ClaimedFragment& fragment, std::size_t index, bool faces,
                               SideProof& proof) {
  if (fragment.state == LightState::kLit) return faces && proof.is_lit(index);
  if (!fragment.reason.empty()) return true;  // holds, or is_proved() did not come here
  if (fragment.caster.empty()) return !faces;
  const auto caster = polygon_index_.find(fragment.caster);
  return faces && caster != polygon_index_.end() && proof.is_shadowed_by(index, caster->second);
}

bool WitnessChecker::is_proved(const ClaimedPolygon& polygon, const Families& families) {
  if (light_->is_area() || terms_.block != Block::kLights || terms_.cover != Cover::kPartition ||
      left_out() || families.size() != 1 || !can_be_proved(polygon)) {
    return false;
  }
  const std::vector<std::uint32_t>& parts = families.begin()->second;
  const bool faces = is_facing(parts.front(), polygon.side);
  std::size_t exact = 0, witnesses = 0;
  for (const ClaimedFragment& fragment : polygon.fragments) {
    exact += fragment.exact ? 1 : 0;
    if (fragment.state == LightState::kLit) continue;
    ++witnesses;
    if (!fragment.reason.empty() && !shadow_reason_holds(parts.front(), polygon.side, fragment)) {
      return false;
    }
  }
  SideProof proof(prepared_, *light_, polygon, parts);
  if (!proof.tiles()) return false;
  for (std::size_t i = 0; i < polygon.fragments.size(); ++i) {
    if (!is_proved(polygon.fragments[i], i, faces, proof)) return false;
  }
  if (!proof.has_claimed_shares()) return false;
  report_.fragments += polygon.fragments.size();
  report_.exact_fragments += exact;
  report_.witnesses += witnesses;
  return true;
}

}  // namespace gnomon::oracle
