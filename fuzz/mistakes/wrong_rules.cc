// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>

#include "fuzz/mistakes/mistake.h"

namespace gnomon::fuzz {

namespace {

/// A fragment with a made vertex and on average narrower than kSliver times the distance of its
/// farthest vertices. In doubles: a mistake need not be exact.
bool is_thin(const LoopShape& loop) {
  constexpr double kSliver = 1.0 / 64;
  double longest = 0;
  std::array<double, 3> area{}, before{};
  const std::array<double, 3>& first = loop.corners[0];
  for (std::size_t i = 0; i < loop.corners.size(); ++i) {
    const std::array<double, 3>& point = loop.corners[i];
    std::array<double, 3> step{}, last{};
    for (std::size_t k = 0; k < 3; ++k) {
      step[k] = point[k] - first[k];
      last[k] = before[k] - first[k];
    }
    longest = std::max(longest, step[0] * step[0] + step[1] * step[1] + step[2] * step[2]);
    for (std::size_t k = 0; i > 1 && k < 3; ++k) {
      const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
      area[k] += last[u] * step[v] - last[v] * step[u];
    }
    before = point;
  }
  return !loop.is_input && std::hypot(area[0], area[1], area[2]) / 2 < kSliver * longest;
}

}  // namespace

Rules rules_of(Mistake mistake) {
  Rules rules;
  switch (mistake) {
    case Mistake::kNone:
    case Mistake::kPlanesFromFragments:
    case Mistake::kVerticesPerSide:
    case Mistake::kThicknessTooLarge:
    case Mistake::kThicknessTooSmall:
      break;
    case Mistake::kCoplanarInSequence:
      rules.coplanar_classified_first = false;
      break;
    case Mistake::kLightInPlaneFaces:
      rules.light_in_plane_does_not_reach = false;
      break;
    case Mistake::kUnionWithoutContinuedPlanes:
      rules.volumes_continue_behind_others = false;
      break;
    case Mistake::kTVerticesLeftIn:
      rules.neighbour_vertices_are_in_the_face = false;
      break;
    case Mistake::kStraddlingLightFaces:
      rules.straddling_light_is_cut = false;
      break;
    case Mistake::kSliversDropped:
      rules.fragment_stays = [](const LoopShape& loop) { return !is_thin(loop); };
      break;
    case Mistake::kCoplanarDiesEarly:
      rules.volumes_die_after_their_plane_received = false;
      break;
    case Mistake::kTileClosedEarly:
      rules.tiles_close_after_their_plane_received = false;
      break;
    case Mistake::kClosedTileKeepsDead:
      rules.closed_tiles_pass_to_the_killer = false;
      break;
    case Mistake::kBspEdgesLeftOut:
      rules.edges_of_splits_bound_volumes = false;
      break;
    case Mistake::kSupportBeforeEdges:
      rules.edges_above_supports = false;
      break;
    case Mistake::kCollinearLeftOut:
      rules.edges_on_a_line_count = false;
      break;
    case Mistake::kCasterSetsDiffer:
      rules.casters_are_the_same_in_each_step = false;
      break;
    case Mistake::kFarCornerDecides:
      rules.equal_depth_by_its_planes = false;
      break;
    case Mistake::kTieTurnsPlane:
      rules.planes_stay_at_ties = false;
      break;
    case Mistake::kBacksHide:
      rules.backs_are_transparent = false;
      break;
    case Mistake::kEyeAlwaysLit:
      rules.eye_may_be_in_shadow = false;
      break;
    case Mistake::kEyeByFirstSurface:
      rules.eye_in_several_volumes_counts_all = false;
      break;
    case Mistake::kEyeCountedOnce:
      rules.eye_on_planes_counts_by_sample = false;
      break;
    case Mistake::kWallsKeepOrder:
      rules.order_of_walls_is_verified = false;
      break;
    case Mistake::kOnePerspective:
      rules.light_looks_all_around = false;
      break;
    case Mistake::kCombinedBitLost:
      rules.merged_fragments_agree_on_every_light = false;
      break;
    case Mistake::kBlotAbsorbedEarly:
      rules.blots_absorbed_after_their_planes_received = false;
      break;
    case Mistake::kPairsInOrder:
      rules.crossings_pair_by_arcs = false;
      break;
    case Mistake::kHolesWithoutDirection:
      rules.holes_have_a_direction = false;
      break;
    case Mistake::kHiddenDepthStrict:
      rules.on_a_hidden_face_is_behind_it = false;
      break;
    case Mistake::kOnSwapped:
      rules.on_goes_to_its_own_side = false;
      break;
  }
  return rules;
}

}  // namespace gnomon::fuzz
