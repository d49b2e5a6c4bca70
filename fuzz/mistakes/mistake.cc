// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/mistakes/mistake.h"

#include <array>

namespace gnomon::fuzz {

namespace {

constexpr std::string_view kChin1989 = "Chin & Feiner 1989";
constexpr std::string_view kChin1992 = "Chin & Feiner 1992";
constexpr std::string_view kSlater1992 = "Slater 1992";
constexpr std::string_view kAppel1967 = "Appel 1967";
constexpr std::string_view kCrow1977 = "Crow 1977";
constexpr std::string_view kThakur = "Thakur, Cheng & Miura";

constexpr std::array kMistakes = {
    MistakeInfo{Mistake::kPlanesFromFragments, "planes-from-fragments",
                "the plane of a fragment is computed again from its own rounded vertices",
                kChin1989},
    MistakeInfo{Mistake::kVerticesPerSide, "vertices-per-side",
                "the vertex where an edge is split is computed again for each side", kChin1992},
    MistakeInfo{Mistake::kCoplanarInSequence, "coplanar-in-sequence",
                "a polygon casts before those in its own plane have been classified", kChin1989},
    MistakeInfo{Mistake::kLightInPlaneFaces, "light-in-plane-faces",
                "a light in a polygon's plane counts as in front of it", kChin1989},
    MistakeInfo{Mistake::kUnionWithoutContinuedPlanes, "union-without-continued-planes",
                "a shadow volume is not continued behind the volumes in its way", kChin1992},
    MistakeInfo{Mistake::kThicknessTooLarge, "thickness-too-large",
                "planes are so thick that features of the scene vanish in them", kChin1989},
    MistakeInfo{Mistake::kThicknessTooSmall, "thickness-too-small",
                "planes have no thickness, although vertices are rounded", kChin1989},
    MistakeInfo{Mistake::kTVerticesLeftIn, "t-vertices-left-in",
                "a vertex on a neighbour's edge is left out of the neighbour", kChin1992},
    MistakeInfo{Mistake::kStraddlingLightFaces, "straddling-light-faces",
                "an area light on both sides of a plane counts as in front of it", kChin1992},
    MistakeInfo{Mistake::kSliversDropped, "slivers-dropped", "thin fragments are left out",
                kChin1989},
    MistakeInfo{Mistake::kOnSwapped, "on-swapped", "what lies on a plane is put on its other side",
                kChin1989},
    MistakeInfo{Mistake::kCoplanarDiesEarly, "coplanar-dies-early",
                "a volume is dropped before all polygons of the new one's plane have received it",
                kSlater1992},
    MistakeInfo{Mistake::kTileClosedEarly, "tile-closed-early",
                "a tile is closed before all polygons of the new volume's plane have received",
                kSlater1992},
    MistakeInfo{Mistake::kClosedTileKeepsDead, "closed-tile-keeps-dead",
                "a closed tile goes on naming a volume that a later one made needless",
                kSlater1992},
    MistakeInfo{Mistake::kBspEdgesLeftOut, "bsp-edges-left-out",
                "edges that the scene BSP made do not bound shadow volumes", kChin1989},
    MistakeInfo{Mistake::kSupportBeforeEdges, "support-before-edges",
                "the support plane of a complete volume stands above its edges in the tree",
                kChin1989},
    MistakeInfo{Mistake::kCollinearLeftOut, "collinear-left-out",
                "a polygon with an edge on the line of another's edge counts as nothing there",
                kAppel1967},
    MistakeInfo{Mistake::kCasterSetsDiffer, "caster-sets-differ",
                "backs that the light sees cast shadows by their edges, and hide no edge",
                kAppel1967},
    MistakeInfo{Mistake::kFarCornerDecides, "far-corner-decides",
                "which of two is nearer beside an edge, a corner on any side of it decides",
                kAppel1967},
    MistakeInfo{Mistake::kTieTurnsPlane, "tie-turns-plane",
                "a sample in a plane is moved in all of the formula, so that its own plane turns",
                kCrow1977},
    MistakeInfo{Mistake::kBacksHide, "backs-hide",
                "one-sided polygons hide what is behind them from an eye at their back", kCrow1977},
    MistakeInfo{Mistake::kEyeAlwaysLit, "eye-always-lit",
                "shadow volumes that hold the eye are not counted", kCrow1977},
    MistakeInfo{Mistake::kEyeByFirstSurface, "eye-by-first-surface",
                "the eye counts as in one volume if the ray leaves one first, else as in none",
                kCrow1977},
    MistakeInfo{Mistake::kEyeCountedOnce, "eye-counted-once",
                "an eye on a plane of a shadow volume counts as outside it for all samples",
                kCrow1977},
    MistakeInfo{Mistake::kWallsKeepOrder, "walls-keep-order",
                "walls are kept in the order of depth in which a row first meets them", kCrow1977},
    MistakeInfo{Mistake::kOnePerspective, "one-perspective",
                "what a lamp sees is mapped by one division, also beside and behind it", kCrow1977},
    MistakeInfo{Mistake::kCombinedBitLost, "combined-bit-lost",
                "fragments that one of several lights together tells apart become one, dark for it",
                kChin1989},
    MistakeInfo{Mistake::kBlotAbsorbedEarly, "blot-absorbed-early",
                "an outline absorbs a blot before all in its object's planes have received that",
                kCrow1977},
    MistakeInfo{Mistake::kPairsInOrder, "pairs-in-order",
                "crossings of an outline and a row are paired in their order along the row",
                kThakur},
    MistakeInfo{Mistake::kHolesWithoutDirection, "holes-without-direction",
                "a pair of crossings is shadow between them, also where it runs around a hole",
                kThakur},
    MistakeInfo{Mistake::kHiddenDepthStrict, "hidden-depth-strict",
                "what lies on a face that the light does not see counts as before it", kThakur},
};

}  // namespace

std::span<const MistakeInfo> mistakes() { return kMistakes; }

std::optional<Mistake> mistake_by_name(std::string_view name) {
  for (const MistakeInfo& info : kMistakes) {
    if (info.name == name) return info.mistake;
  }
  return std::nullopt;
}

std::string_view name_of(Mistake mistake) {
  for (const MistakeInfo& info : kMistakes) {
    if (info.mistake == mistake) return info.name;
  }
  return {};
}

bool is_of_lights_together(Mistake mistake) { return mistake == Mistake::kCombinedBitLost; }

namespace {

bool has_thickness(KernelId kernel) { return kernel_info(kernel).has_thickness; }

/// Those of samples.
bool applies_to_pictures(Mistake mistake, MethodId method) {
  switch (mistake) {
    case Mistake::kNone:
    case Mistake::kTieTurnsPlane:
    case Mistake::kBacksHide:
      return true;
    case Mistake::kEyeAlwaysLit:
    case Mistake::kEyeByFirstSurface:
    case Mistake::kEyeCountedOnce:
    case Mistake::kWallsKeepOrder:
    case Mistake::kOnePerspective:
      return method == MethodId::kShadowPolygons;
    case Mistake::kPairsInOrder:
    case Mistake::kHolesWithoutDirection:
    case Mistake::kHiddenDepthStrict:
      return method == MethodId::kRidgeEdges;
    default:
      return false;
  }
}

/// Kernels that can go on with a polygon that the light sees edge-on, where light space has no area
/// for it: those that keep the coordinates of their vertices.
bool keeps_coordinates(KernelId kernel) {
  return has_thickness(kernel) || kernel == KernelId::kRational;
}

}  // namespace

bool applies_to(Mistake mistake, KernelId kernel, MethodId method) {
  const bool svbsp = method == MethodId::kSvbsp, receiver = method == MethodId::kReceiver,
             merged = method == MethodId::kMerged;
  const bool by_volumes = method == MethodId::kBasic || method == MethodId::kTiling;
  const bool by_order = svbsp || by_volumes;
  // It makes no fragments, and where polygons are it asks of input corners alone.
  const bool contour = method == MethodId::kContour;
  if (method_info(method).domain == Domain::kImageSpace)
    return applies_to_pictures(mistake, method);
  switch (mistake) {
    case Mistake::kNone:
      return true;
    case Mistake::kPlanesFromFragments:
      return svbsp && kernel == KernelId::kDouble;
    case Mistake::kVerticesPerSide:
      return kernel == KernelId::kDouble && !by_volumes && method != MethodId::kSvbspFull &&
             !contour;
    case Mistake::kCoplanarInSequence:
      return by_order;
    case Mistake::kLightInPlaneFaces:
      return receiver || (svbsp && keeps_coordinates(kernel));
    case Mistake::kThicknessTooLarge:
    case Mistake::kThicknessTooSmall:
      return has_thickness(kernel);
    case Mistake::kSliversDropped:
      return !contour;
    case Mistake::kOnSwapped:
      return !receiver && !merged && !contour;
    case Mistake::kCoplanarDiesEarly:
      return by_volumes;
    case Mistake::kTileClosedEarly:
    case Mistake::kClosedTileKeepsDead:
      return method == MethodId::kTiling;
    case Mistake::kBspEdgesLeftOut:
    case Mistake::kCombinedBitLost:  // of lights together, where it merges across splits
      return svbsp;
    case Mistake::kBlotAbsorbedEarly:
      return method == MethodId::kBlots;
    case Mistake::kSupportBeforeEdges:
      return method == MethodId::kSvbspFull;
    case Mistake::kCollinearLeftOut:
    case Mistake::kCasterSetsDiffer:
    case Mistake::kFarCornerDecides:
      return contour;
    case Mistake::kUnionWithoutContinuedPlanes:
      return merged;
    case Mistake::kTVerticesLeftIn:
    case Mistake::kStraddlingLightFaces:
    case Mistake::kTieTurnsPlane:
    case Mistake::kBacksHide:
    case Mistake::kEyeAlwaysLit:
    case Mistake::kEyeByFirstSurface:
    case Mistake::kEyeCountedOnce:
    case Mistake::kWallsKeepOrder:
    case Mistake::kOnePerspective:
    case Mistake::kPairsInOrder:
    case Mistake::kHolesWithoutDirection:
    case Mistake::kHiddenDepthStrict:
      return false;
  }
  return false;
}

bool applies_to_area(Mistake mistake, KernelId kernel, MethodId method) {
  if (mistake == Mistake::kNone) return true;
  if (method == MethodId::kPieces) return false;
  const bool merged = method == MethodId::kMerged;
  switch (mistake) {
    case Mistake::kVerticesPerSide:
      return kernel == KernelId::kDouble;
    case Mistake::kThicknessTooLarge:
    case Mistake::kThicknessTooSmall:
      return has_thickness(kernel);
    case Mistake::kUnionWithoutContinuedPlanes:
      return merged;
    case Mistake::kStraddlingLightFaces:
    case Mistake::kSliversDropped:
      return true;
    case Mistake::kOnSwapped:
      return !merged;
    case Mistake::kNone:
    case Mistake::kPlanesFromFragments:
    case Mistake::kCoplanarInSequence:
    case Mistake::kLightInPlaneFaces:  // what holds an area light is in its plane, and behind it
    case Mistake::kTVerticesLeftIn:
    case Mistake::kCoplanarDiesEarly:
    case Mistake::kTileClosedEarly:
    case Mistake::kClosedTileKeepsDead:
    case Mistake::kBspEdgesLeftOut:
    case Mistake::kBlotAbsorbedEarly:
    case Mistake::kSupportBeforeEdges:
    case Mistake::kCollinearLeftOut:
    case Mistake::kCasterSetsDiffer:
    case Mistake::kFarCornerDecides:
    case Mistake::kTieTurnsPlane:
    case Mistake::kBacksHide:
    case Mistake::kEyeAlwaysLit:
    case Mistake::kEyeByFirstSurface:
    case Mistake::kEyeCountedOnce:
    case Mistake::kWallsKeepOrder:
    case Mistake::kOnePerspective:
    case Mistake::kPairsInOrder:
    case Mistake::kHolesWithoutDirection:
    case Mistake::kHiddenDepthStrict:
    case Mistake::kCombinedBitLost:
      return false;
  }
  return false;
}

}  // namespace gnomon::fuzz
