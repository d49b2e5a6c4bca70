// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/algorithms/mutation.h"

#include <array>

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

bool applies_to(Mutation mutation, KernelId kernel, MethodId algorithm) {
  const bool svbsp = algorithm == MethodId::kSvbsp, receiver = algorithm == MethodId::kReceiver;
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

bool applies_to_area(Mutation mutation, KernelId kernel, MethodId algorithm) {
  if (mutation == Mutation::kNone) return true;
  if (algorithm == MethodId::kPieces) return false;
  const bool merged = algorithm == MethodId::kMerged;
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

std::string_view name_of(Mutation mutation) {
  for (const MutationInfo& info : kMutations) {
    if (info.mutation == mutation) return info.name;
  }
  return {};
}

}  // namespace gnomon
