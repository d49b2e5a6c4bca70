// SPDX-License-Identifier: GPL-3.0-or-later
// The mistakes that the papers warn of, as variants of the algorithms that are wrong on purpose
// (docs/bug-zoo.md): whoever judges results must notice each of them. One at a time. The algorithms
// know nothing of them: a mistake is a wrong rule (algorithms/partition/rules.h), a wrong kernel
// (mutant_space.h), or planes of a wrong thickness.
#ifndef GNOMON_FUZZ_MISTAKES_MISTAKE_H
#define GNOMON_FUZZ_MISTAKES_MISTAKE_H

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "algorithms/partition/rules.h"
#include "gnomon/algorithms/method.h"
#include "gnomon/kernel/kernel_list.h"

namespace gnomon::fuzz {

enum class Mistake : std::uint8_t {
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
  kCoplanarDiesEarly,    // a volume dropped before all of the new one's plane have received it
  kTileClosedEarly,      // a tile closed before all of the new one's plane have received
  kClosedTileKeepsDead,  // a closed tile that keeps naming a volume that was dropped
  kBspEdgesLeftOut,      // edges made by the scene BSP bound no shadow volume
  kSupportBeforeEdges,   // a support plane above the edges of its volume
  kCollinearLeftOut,     // a polygon with an edge on the line of another's counts as nothing there
  kCasterSetsDiffer,     // backs cast where edges act, and hide nothing
  kFarCornerDecides,     // equal depth along an edge decided by a corner on either side of it
  kTieTurnsPlane,      // a sample in a plane moved in all of the formula, which turns its own plane
  kBacksHide,          // one-sided polygons hide what is behind them from an eye at their back
  kEyeAlwaysLit,       // shadow volumes that hold the eye are not counted
  kEyeByFirstSurface,  // the eye in shadow iff the ray leaves a volume before it enters one
  kEyeCountedOnce,     // an eye on the plane of a volume is outside it for all samples
  kWallsKeepOrder,     // walls kept in the order of depth in which they were met
  kOnePerspective,     // what a light sees mapped by one perspective division
  kCombinedBitLost,    // lights together: fragments that one light tells apart become one
  kBlotAbsorbedEarly,  // a blot dropped before all in the planes of its heir have received it
  kPairsInOrder,       // crossings of a ridge loop paired as neighbours along a row
  kHolesWithoutDirection,  // a pair taken for shadow whichever way it runs
  kHiddenDepthStrict,      // what lies on a hidden face taken as before it
};

struct MistakeInfo {
  Mistake mistake = Mistake::kNone;
  std::string_view name;      // such as "coplanar-in-sequence"
  std::string_view sentence;  // what the variant does wrong
  std::string_view source;    // who warns of it
};

/// All but kNone, in order of the enumeration.
std::span<const MistakeInfo> mistakes();
std::optional<Mistake> mistake_by_name(std::string_view name);
/// Empty for kNone.
std::string_view name_of(Mistake mistake);

/// Whether it is a mistake about several lights together; others are made one by one.
bool is_of_lights_together(Mistake mistake);

/// Whether a mistake is one that this method can make on this kernel, for point and directional
/// lights, and for area lights. Of kNone it is true. Requires: a method, not kAutomatic.
bool applies_to(Mistake mistake, KernelId kernel, MethodId method);
bool applies_to_area(Mistake mistake, KernelId kernel, MethodId method);

/// The rules of the definition with the mistake in them; those of the definition if the mistake is
/// in the kernel or in the thickness of its planes.
Rules rules_of(Mistake mistake);

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_MISTAKES_MISTAKE_H
