// SPDX-License-Identifier: GPL-3.0-or-later
// The kinds of scenes that campaigns count: what the generators start from, and the degeneracies
// that moves put into them (docs: generators). A kind is a statement about a scene that exact
// arithmetic can decide; kind_predicates.h decides it.
#ifndef GNOMON_FUZZ_SCENE_KINDS_H
#define GNOMON_FUZZ_SCENE_KINDS_H

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace gnomon::fuzz {

/// Kinds up to kFile say what a scene was made from; the families (families.h, then
/// area_families.h) follow the last of these. New ones go before kFirstFamily, at the end of their
/// group: ids are not kept in files, names are.
enum class Kind : std::uint16_t {
  // Bases.
  kSoupUniform,
  kSoupClustered,
  kSoupLattice,
  kSoupMixedSizes,
  kScene,
  kFile,
  // Sides.
  kOneSided,
  kTwoSided,
  // Shapes of single polygons.
  kNonConvex,
  kHoles,
  kAlmostPlanar,
  kSliver,
  kNeedle,
  // Polygons to each other.
  kCoplanar,
  kOverlap,
  kDuplicate,
  kBackToBack,
  kSharedEdge,
  kSharedVertex,
  kTJunction,
  kEdgeOverlap,
  kVertexInFace,
  kEdgeInFace,
  kCrossing,
  kNestedBoxes,
  kNextafter,
  kNearParallel,
  // Point and directional lights.
  kLightInPlane,
  kLightOnFace,
  kLightOnEdge,
  kLightOnEdgeLine,
  kLightAtVertex,
  kLightFar,
  kLightNear,
  kGrazingLight,
  kSunInPlane,
  kSunAlongEdge,
  kGrazingSun,
  kShadowEdges,
  kShadowVertexOnEdge,
  kShadowVertices,
  kCyclicOverlap,
  // Area lights.
  kAreaVertex,
  kAreaEdge,
  kAreaEdgeOverlap,
  kAreaInPlane,
  kAreaOnCaster,
  kAreaInside,
  kAreaVertexInFace,
  kAreaTouched,
  kAreaStraddled,
  kAreaCut,
  kAreaVertexInPlane,
  kAreaEdgeInPlane,
  kAreaParallelEdge,
  kAreaGrazing,
  kAreaSliver,
  kAreaSmall,
  kAreaHuge,
  // The whole scene.
  kMixedMagnitudes,
  kScaledUp,
  kScaledDown,
  kLargeOffset,
  kDecimals,
  kFirstFamily,
};

struct KindInfo {
  std::string_view name;     // as on the command line, such as "t-junction"
  std::string_view meaning;  // one sentence
  bool area = false;         // needs an area light
};

/// Every kind; the index is the kind's number.
std::span<const KindInfo> kinds();
std::optional<std::uint16_t> kind_by_name(std::string_view name);

inline std::uint16_t id_of(Kind kind) { return static_cast<std::uint16_t>(kind); }
/// The kind of families()[family], and that of area_families()[family].
std::uint16_t kind_of_family(std::size_t family);
std::uint16_t kind_of_area_family(std::size_t family);

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_SCENE_KINDS_H
