// SPDX-License-Identifier: LGPL-3.0-or-later
// The mistakes that the papers warn of, as variants of the algorithms that are wrong on purpose
// (docs/bug-zoo.md): whoever judges results must notice each of them. One at a time; kNone is what
// everybody else runs, and costs nothing.
#ifndef GNOMON_ALGORITHMS_MUTATION_H
#define GNOMON_ALGORITHMS_MUTATION_H

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace gnomon {

struct Rules;

enum class Mutation : std::uint8_t {
  kNone,
  kPlanesFromFragments,          // a fragment's support plane computed again from its own vertices
  kVerticesPerSide,              // a split edge's vertex computed again for each side
  kCoplanarInSequence,           // a coplanar polygon inserted before its neighbours are classified
  kLightInPlaneFaces,            // a light in a polygon's plane taken as in front of it
  kUnionWithoutContinuedPlanes,  // a volume not continued behind those in its way (1992, fig. 6)
  kThicknessTooLarge,            // planes so thick that features vanish in them
  kThicknessTooSmall,            // planes of no thickness, with rounded vertices
  kTVerticesLeftIn,              // a vertex on a neighbour's edge left out of the neighbour
  kStraddlingLightFaces,         // an area light on both sides of a plane taken as in front of it
  kSliversDropped,               // thin fragments left out
  kOnSwapped,                    // what lies on a plane put on the other side
};

/// What kThicknessTooLarge makes of ShadowOptions::thickness.
inline constexpr double kThicknessTooLarge = 0x1p-7;

struct MutationInfo {
  Mutation mutation = Mutation::kNone;
  std::string_view name;     // such as "coplanar-in-sequence"
  std::string_view mistake;  // one sentence: what the variant does wrong
  std::string_view source;   // who warns of it
};

/// All but kNone, in order of the enumeration.
std::span<const MutationInfo> mutations();
std::optional<Mutation> mutation_by_name(std::string_view name);
/// The rules with the mistake in them.
Rules rules_of(Mutation mutation);
/// Empty for kNone.
std::string_view name_of(Mutation mutation);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_MUTATION_H
