// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/algorithms/mutation.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "algorithms/partition/rules.h"
#include "gnomon/algorithms/shadows.h"

namespace gnomon {

namespace {

constexpr std::string_view kChin1989 = "Chin & Feiner 1989";
constexpr std::string_view kChin1992 = "Chin & Feiner 1992";

constexpr std::array kMutations = {
    MutationInfo{Mutation::kPlanesFromFragments, "planes-from-fragments",
                 "the plane of a fragment is computed again from its own rounded vertices",
                 kChin1989},
    MutationInfo{Mutation::kVerticesPerSide, "vertices-per-side",
                 "the vertex where an edge is split is computed again for each side", kChin1992},
    MutationInfo{Mutation::kCoplanarInSequence, "coplanar-in-sequence",
                 "a polygon casts before those in its own plane have been classified", kChin1989},
    MutationInfo{Mutation::kLightInPlaneFaces, "light-in-plane-faces",
                 "a light in a polygon's plane counts as in front of it", kChin1989},
    MutationInfo{Mutation::kUnionWithoutContinuedPlanes, "union-without-continued-planes",
                 "a shadow volume is not continued behind the volumes in its way", kChin1992},
    MutationInfo{Mutation::kThicknessTooLarge, "thickness-too-large",
                 "planes are so thick that features of the scene vanish in them", kChin1989},
    MutationInfo{Mutation::kThicknessTooSmall, "thickness-too-small",
                 "planes have no thickness, although vertices are rounded", kChin1989},
    MutationInfo{Mutation::kTVerticesLeftIn, "t-vertices-left-in",
                 "a vertex on a neighbour's edge is left out of the neighbour", kChin1992},
    MutationInfo{Mutation::kStraddlingLightFaces, "straddling-light-faces",
                 "an area light on both sides of a plane counts as in front of it", kChin1992},
    MutationInfo{Mutation::kSliversDropped, "slivers-dropped", "thin fragments are left out",
                 kChin1989},
    MutationInfo{Mutation::kOnSwapped, "on-swapped",
                 "what lies on a plane is put on its other side", kChin1989},
};

}  // namespace

std::span<const MutationInfo> mutations() { return kMutations; }

std::optional<Mutation> mutation_by_name(std::string_view name) {
  for (const MutationInfo& info : kMutations) {
    if (info.name == name) return info.mutation;
  }
  return std::nullopt;
}

namespace {

bool has_thickness(KernelId kernel) {
  return kernel == KernelId::kFloat || kernel == KernelId::kDouble ||
         kernel == KernelId::kLongDouble;
}

/// Kernels that can go on with a polygon that the light sees edge-on, where light space has no area
/// for it: those that keep the coordinates of their vertices.
bool keeps_coordinates(KernelId kernel) {
  return has_thickness(kernel) || kernel == KernelId::kRational;
}

}  // namespace

bool applies_to(Mutation mutation, KernelId kernel, Algorithm algorithm) {
  const bool svbsp = algorithm == Algorithm::kSvbsp, receiver = algorithm == Algorithm::kReceiver;
  switch (mutation) {
    case Mutation::kNone:
      return true;
    case Mutation::kPlanesFromFragments:
      return svbsp && kernel == KernelId::kDouble;
    case Mutation::kVerticesPerSide:
      return kernel == KernelId::kDouble;
    case Mutation::kCoplanarInSequence:
      return svbsp;
    case Mutation::kLightInPlaneFaces:
      return receiver || (svbsp && keeps_coordinates(kernel));
    case Mutation::kThicknessTooLarge:
    case Mutation::kThicknessTooSmall:
      return has_thickness(kernel);
    case Mutation::kSliversDropped:
      return true;
    case Mutation::kOnSwapped:
      return !receiver;
    case Mutation::kUnionWithoutContinuedPlanes:
    case Mutation::kTVerticesLeftIn:
    case Mutation::kStraddlingLightFaces:
      return false;
  }
  return false;
}

bool applies_to(Mutation mutation, KernelId kernel, AreaAlgorithm algorithm) {
  if (mutation == Mutation::kNone) return true;
  if (algorithm == AreaAlgorithm::kPieces) return false;
  const bool merged = algorithm == AreaAlgorithm::kMerged;
  switch (mutation) {
    case Mutation::kVerticesPerSide:
      return kernel == KernelId::kDouble;
    case Mutation::kThicknessTooLarge:
    case Mutation::kThicknessTooSmall:
      return has_thickness(kernel);
    case Mutation::kUnionWithoutContinuedPlanes:
      return merged;
    case Mutation::kStraddlingLightFaces:
    case Mutation::kSliversDropped:
      return true;
    case Mutation::kOnSwapped:
      return !merged;
    case Mutation::kNone:
    case Mutation::kPlanesFromFragments:
    case Mutation::kCoplanarInSequence:
    case Mutation::kLightInPlaneFaces:  // what holds an area light is in its plane, and behind it
    case Mutation::kTVerticesLeftIn:
      return false;
  }
  return false;
}

namespace {

/// A fragment with a made vertex and on average narrower than kSliver times the distance of its
/// farthest vertices. In doubles: a mistake need not be exact.
bool is_sliver(const LoopShape& loop) {
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

Rules rules_of(Mutation mutation) {
  Rules rules;
  switch (mutation) {
    case Mutation::kNone:
    case Mutation::kPlanesFromFragments:
    case Mutation::kVerticesPerSide:
    case Mutation::kThicknessTooLarge:
    case Mutation::kThicknessTooSmall:
      break;  // wrong kernels, or a kernel used in a wrong way
    case Mutation::kCoplanarInSequence:
      rules.coplanar_classified_first = false;
      break;
    case Mutation::kLightInPlaneFaces:
      rules.light_in_plane_does_not_reach = false;
      break;
    case Mutation::kUnionWithoutContinuedPlanes:
      rules.volumes_continue_behind_others = false;
      break;
    case Mutation::kTVerticesLeftIn:
      rules.neighbour_vertices_are_in_the_face = false;
      break;
    case Mutation::kStraddlingLightFaces:
      rules.straddling_light_is_cut = false;
      break;
    case Mutation::kSliversDropped:
      rules.fragment_stays = [](const LoopShape& loop) { return !is_sliver(loop); };
      break;
    case Mutation::kOnSwapped:
      rules.on_goes_to_its_own_side = false;
      break;
  }
  return rules;
}

std::string_view name_of(Mutation mutation) {
  for (const MutationInfo& info : kMutations) {
    if (info.mutation == mutation) return info.name;
  }
  return {};
}

}  // namespace gnomon
