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
                               SideProof& proof) const {
  if (fragment.state == LightState::kLit) return faces && proof.is_lit(index);
  if (!fragment.reason.empty()) return true;  // holds, or is_proved() did not come here
  if (fragment.caster.empty()) return !faces;
  const auto caster = polygon_index_.find(fragment.caster);
  return faces && caster != polygon_index_.end() && proof.is_shadowed_by(index, caster->second);
}

bool WitnessChecker::is_proved(const ClaimedPolygon& polygon) {
  const auto known = polygon_index_.find(polygon.id);
  if (known == polygon_index_.end() || light_->is_area() || terms_.shares_alone ||
      terms_.block != Block::kLights || terms_.cover != Cover::kPartition || left_out() ||
      !can_be_proved(polygon)) {
    return false;
  }
  std::set<PlaneId> optional;
  const Families families = families_on(known->second, polygon.side, optional);
  if (families.size() != 1) return false;
  const std::vector<std::uint32_t>& parts = families.begin()->second;
  for (const ClaimedFragment& fragment : polygon.fragments) {
    if (fragment.state == LightState::kShadow && !fragment.reason.empty() &&
        !shadow_reason_holds(parts.front(), polygon.side, fragment)) {
      return false;
    }
  }
  const bool faces = is_facing(parts.front(), polygon.side);
  SideProof proof(prepared_, *light_, polygon, parts);
  if (!proof.tiles()) return false;
  for (std::size_t i = 0; i < polygon.fragments.size(); ++i) {
    if (!is_proved(polygon.fragments[i], i, faces, proof)) return false;
  }
  return proof.has_claimed_shares();
}

void WitnessChecker::count_proved(const ClaimedPolygon& polygon) {
  ++report_.polygons;
  report_.fragments += polygon.fragments.size();
  for (const ClaimedFragment& fragment : polygon.fragments) {
    report_.exact_fragments += fragment.exact ? 1 : 0;
    report_.witnesses += fragment.state == LightState::kLit ? 0 : 1;
  }
}

}  // namespace gnomon::oracle
