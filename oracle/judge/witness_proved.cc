// SPDX-License-Identifier: GPL-3.0-or-later
// Sides whose loops are exact and whose claims hold: proved by signs of integers (side_proof.h).
// Nothing is called false here: what is not proved goes to witness_exact.cc.
#include <algorithm>

#include "oracle/geometry/group_overlay.h"
#include "oracle/geometry/scene_point.h"
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
  if (!fragment.reason.empty()) return true;    // holds, or is_proved() did not come here
  if (!fragment.casters.empty()) return false;  // looked at in rational numbers
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
  std::map<PlaneId, std::vector<const ClaimedFragment*>> fragments;
  for (const ClaimedFragment& fragment : polygon.fragments) {
    const std::optional<PlaneId> plane = plane_of(fragment, families);
    if (!plane) return false;
    fragments[*plane].push_back(&fragment);
  }
  for (const auto& [plane, parts] : families) {
    if (optional.contains(plane) && !fragments.contains(plane)) continue;
    SideProof proof(prepared_, *light_, polygon.side, std::move(fragments[plane]), parts);
    if (!is_proved(polygon, parts, proof)) return false;
  }
  return true;
}

bool WitnessChecker::is_proved(const ClaimedPolygon& polygon,
                               const std::vector<std::uint32_t>& parts, SideProof& proof) const {
  const bool faces = is_facing(parts.front(), polygon.side);
  for (const ClaimedFragment* fragment : proof.fragments()) {
    if (fragment->state == LightState::kShadow && !fragment->reason.empty() &&
        !shadow_reason_holds(parts.front(), polygon.side, *fragment)) {
      return false;
    }
  }
  if (!proof.tiles()) return false;
  for (std::size_t i = 0; i < proof.fragments().size(); ++i) {
    if (!is_proved(*proof.fragments()[i], i, faces, proof)) return false;
  }
  // Shares are claimed of the whole polygon.
  const std::uint32_t index = prepared_.parts[parts.front()].polygon;
  const bool is_all = parts.size() == prepared_.first_part[index + 1] - prepared_.first_part[index];
  return !is_all || proof.has_shares_of(polygon);
}

std::optional<PlaneId> WitnessChecker::plane_of(const ClaimedFragment& fragment,
                                                const Families& families) const {
  // In the only plane the proof itself sees whether it lies there.
  if (families.size() == 1) return families.begin()->first;
  std::optional<PlaneId> found;
  std::vector<Integers4> points;
  for (const RationalPoint& point : fragment.loop) points.push_back(scene_point(point));
  for (const auto& [plane, parts] : families) {
    const Integers4 support = scene_plane(prepared_.geometry, support_of(prepared_, parts.front()));
    if (std::ranges::any_of(
            points, [&](const Integers4& point) { return sign_of_product(support, point) != 0; })) {
      continue;
    }
    if (found) return std::nullopt;
    found = plane;
  }
  return found;
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
