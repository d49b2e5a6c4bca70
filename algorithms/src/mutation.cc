// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/algorithms/mutation.h"

#include <array>

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

std::string_view name_of(Mutation mutation) {
  for (const MutationInfo& info : kMutations) {
    if (info.mutation == mutation) return info.name;
  }
  return {};
}

}  // namespace gnomon
