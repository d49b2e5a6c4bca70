// SPDX-License-Identifier: LGPL-3.0-or-later
// The table of methods. A new method is a room, a row and a case here, and a line of
// gnomon_compile_on_kernels() in algorithms/CMakeLists.txt.
#include "algorithms/run/methods.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>

#include "algorithms/angular_table/by_ridge_edges.h"
#include "algorithms/contour/by_contour.h"
#include "algorithms/run/by_receiver.h"
#include "algorithms/run/on_every_kernel.h"
#include "algorithms/scan_out/by_scan_out.h"
#include "algorithms/sectors/by_sectors.h"
#include "algorithms/shadow_polygons/by_shadow_polygons.h"
#include "algorithms/svbsp/by_svbsp.h"
#include "algorithms/svbsp_full/by_svbsp_full.h"
#include "algorithms/tiling/by_volumes.h"
#include "algorithms/zbuffer/by_zbuffer.h"

namespace gnomon {

struct WatchedKernel;

namespace {

using enum Counter;
constexpr std::array<std::string_view, 3> kBasicOptions = {"cover", "prune", "roots"};
constexpr std::array<std::string_view, 4> kTilingOptions = {"tiles", "cover", "prune", "roots"};
constexpr std::array<std::string_view, 1> kSvbspFullOptions = {"order"};
constexpr std::array<std::string_view, 1> kSectorsOptions = {"split"};
constexpr std::array<std::string_view, 2> kTwoPassOptions = {"cells", "cover"};
constexpr std::array<std::string_view, 3> kBlotsOptions = {"sectors", "outlines", "cover"};
constexpr std::array<std::string_view, 5> kSvbspOptions = {"light-order", "grow", "edges", "merge",
                                                           "roots"};
constexpr std::array<std::string_view, 1> kReceiverOptions = {"casters"};
constexpr std::array<std::string_view, 3> kMergedOptions = {"casters", "interleaved", "caps"};
constexpr std::array kSvbspCounters = {kScenePieces,  kShadowPolygons,  kNodes,     kDepth,
                                       kLongestChain, kMeanFilterDepth, kTreeBytes, kMerged};
constexpr std::array kReceiverCounters = {kVolumes, kSolids, kVolumePlanes};
constexpr std::array kMergedCounters = {kScenePieces,  kVolumes, kSolids,
                                        kVolumePlanes, kNodes,   kDepth};
constexpr std::array kBasicCounters = {kScenePieces, kVolumes, kTests,  kCovered,
                                       kDied,        kClips,   kNulled, kShadowPolygons};
constexpr std::array kTilingCounters = {
    kScenePieces,      kVolumes,        kTests,           kCovered,     kDied,      kClips,
    kNulled,           kShadowPolygons, kTileWrites,      kClosedTiles, kTileBytes, kMeanMet,
    kFirstQuartileMet, kMedianMet,      kThirdQuartileMet};
constexpr std::array kSvbspFullCounters = {kVolumes, kShadowPolygons, kNodes, kDepth};
constexpr std::array kContourCounters = {kIntervals, kSegments, kDarkPolygons, kOpenPolygons};
constexpr std::array<std::string_view, 1> kZbufferOptions = {"order"};
constexpr std::array kZbufferCounters = {kSamples, kSpans, kDepthTests, kCasterTests,
                                         kDepthComplexity};
constexpr std::array<std::string_view, 6> kShadowPolygonsOptions = {
    "volumes", "count", "near", "far", "neighbours", "order"};
constexpr std::array kShadowPolygonsCounters = {
    kSamples,     kSpans,          kDepthTests,      kWalls,     kActiveWalls,    kWallTests,
    kWallSamples, kNeighbourTests, kNeighbourMisses, kWallBytes, kDepthComplexity};
constexpr std::array<std::string_view, 2> kScanOutOptions = {"lists", "lazy"};
constexpr std::array kScanOutCounters = {kSamples,      kSpans,       kEvents,         kDepthTests,
                                         kOverlapTests, kTileWrites,  kListEntries,    kLongestList,
                                         kListBytes,    kCasterTests, kDepthComplexity};
constexpr std::array<std::string_view, 6> kRidgeEdgesOptions = {
    "rows", "pairing", "depth", "interpolate", "hemisphere", "order"};
constexpr std::array kRidgeEdgesCounters = {
    kSamples,        kSpans,      kDepthTests, kRidgeLoops, kTableRows,    kTableSpans,
    kTableStretches, kTableBytes, kLookUps,    kSpanTests,  kStretchTests, kDepthComplexity};
constexpr std::array kSectorsCounters = {kShadowPolygons, kCellCuts};
constexpr std::array kTwoPassCounters = {kClips, kShadowPolygons, kLists, kLongestList,
                                         kDeepestStack};

constexpr std::array kBlotsCounters = {
    kSubObjects,   kSolids, kHidingPairs,    kCycles, kBlots,       kAbsorbed,    kBlotCuts,
    kBoxShortcuts, kClips,  kShadowPolygons, kLists,  kLongestList, kDeepestStack};

/// The first of the rows that can do what is asked is what the command line's `auto` takes.
constexpr std::array kObjectMethods = {
    Method{.id = MethodId::kSectors,
           .name = "sectors",
           .summary = "needs no order",
           .source = "Slater 1992, tiles, in light space",
           .lights = {.point = true},
           .explains = true,
           .threads = true,
           .options = kSectorsOptions,
           .counters = kSectorsCounters},
    Method{.id = MethodId::kContour,
           .name = "contour",
           .summary = "edges seen from the light, classes and shares alone",
           .source = "Gnomon; hidden lines as Appel 1967 has them, boundary integrals",
           .lights = {.point = true, .area = true},
           .threads = true,
           .names_casters = false,
           .makes_fragments = false,
           .counters = kContourCounters},
    Method{.id = MethodId::kSvbsp,
           .name = "svbsp",
           .summary = "front to back by a scene BSP",
           .source = "Chin & Feiner 1989",
           .lights = {.point = true},
           .combines_lights = true,
           .explains = true,
           .leaves_out_steps = true,
           .moves_lights = true,
           .options = kSvbspOptions,
           .counters = kSvbspCounters},
    Method{.id = MethodId::kReceiver,
           .name = "receiver",
           .summary = "each polygon against its casters",
           .source = "Nishita & Nakamae 1983; Chin & Feiner 1992",
           .lights = {.point = true, .area = true},
           .combines_lights = true,
           .explains = true,
           .threads = true,
           .options = kReceiverOptions,
           .counters = kReceiverCounters},
    Method{.id = MethodId::kMerged,
           .name = "merged",
           .summary = "trees of all casters' volumes",
           .source = "Chin & Feiner 1992; Thibault & Naylor 1987",
           .lights = {.point = true, .area = true},
           .combines_lights = true,
           .explains = true,
           .leaves_out_steps = true,
           .threads = true,
           .options = kMergedOptions,
           .counters = kMergedCounters},
    Method{.id = MethodId::kPieces,
           .name = "pieces",
           .summary = "the light cut by polygon planes, classes for each piece",
           .source = "Chin & Feiner 1992",
           .lights = {.area = true},
           .chosen_by_name = false},
    Method{.id = MethodId::kBasic,
           .name = "basic",
           .summary = "each polygon against all shadow volumes before it",
           .source = "Slater 1992, section 3",
           .lights = {.point = true},
           .combines_lights = true,
           .explains = true,
           .overlays = true,
           .options = kBasicOptions,
           .counters = kBasicCounters},
    Method{.id = MethodId::kTiling,
           .name = "tiling",
           .summary = "the same, against those in its tiles of a cube around the light",
           .source = "Slater 1992, section 5",
           .lights = {.point = true},
           .combines_lights = true,
           .explains = true,
           .overlays = true,
           .options = kTilingOptions,
           .counters = kTilingCounters},
    Method{.id = MethodId::kSvbspFull,
           .name = "svbsp-full",
           .summary = "complete shadow volumes in two passes, no order",
           .source = "Chin & Feiner 1989, sections 4 and 8",
           .lights = {.point = true},
           .explains = true,
           .options = kSvbspFullOptions,
           .counters = kSvbspFullCounters},
    Method{.id = MethodId::kTwoPass,
           .name = "two-pass",
           .summary = "polygons clip each other as seen from the light, no order",
           .source = "Atherton, Weiler & Greenberg 1978; Crow 1977, class two",
           .lights = {.point = true},
           .explains = true,
           .overlays = true,
           .threads = true,
           .options = kTwoPassOptions,
           .counters = kTwoPassCounters},
    Method{.id = MethodId::kBlots,
           .name = "blots",
           .summary = "convex solids front to back, each cut by the outlines before it",
           .source = "Crow 1977, class two; Clark's hierarchy",
           .lights = {.point = true},
           .explains = true,
           .overlays = true,
           .threads = true,
           .options = kBlotsOptions,
           .counters = kBlotsCounters},
};

constexpr std::array kImageMethods = {
    Method{.id = MethodId::kZbuffer,
           .name = "zbuffer",
           .summary = "the nearest polygon at each sample, each caster tested there",
           .source = "Catmull 1974; exact samples: docs/image-space.md",
           .lights = {.point = true},
           .domain = Domain::kImageSpace,
           .needs = {.camera = true},
           .threads = true,
           .names_casters = false,
           .makes_fragments = false,
           .options = kZbufferOptions,
           .counters = kZbufferCounters},
    Method{.id = MethodId::kShadowPolygons,
           .name = "shadow-polygons",
           .summary = "walls of shadow volumes, counted along the ray of each sample",
           .source = "Crow 1977, class three; the stencil shadow volume",
           .lights = {.point = true},
           .domain = Domain::kImageSpace,
           .needs = {.camera = true},
           .threads = true,
           .names_casters = false,
           .makes_fragments = false,
           .counts_casters = true,
           .options = kShadowPolygonsOptions,
           .counters = kShadowPolygonsCounters},
    Method{.id = MethodId::kScanOut,
           .name = "scan-out",
           .summary = "spans of visible polygons, each against the list of its casters",
           .source = "Crow 1977, class one; Appel 1967; Bouknight & Kelley 1970",
           .lights = {.point = true},
           .domain = Domain::kImageSpace,
           .needs = {.camera = true},
           .threads = true,
           .names_casters = false,
           .makes_fragments = false,
           .options = kScanOutOptions,
           .counters = kScanOutCounters},
    Method{
        .id = MethodId::kRidgeEdges,
        .name = "ridge-edges",
        .summary = "an angular table of the outlines of solids, looked up while polygons are drawn",
        .source = "Thakur, Cheng & Miura, section 3",
        .lights = {.point = true},
        .domain = Domain::kImageSpace,
        .needs = {.closed_meshes = true, .camera = true, .one_hemisphere = true},
        .threads = true,
        .names_casters = false,
        .makes_fragments = false,
        .options = kRidgeEdgesOptions,
        .counters = kRidgeEdgesCounters},
};

template <template <class> class Run>
auto on_kernel(KernelId kernel) {
  static constexpr std::array kFunctions = on_every_kernel<Run>();
  return kFunctions[static_cast<std::size_t>(kernel)];
}

}  // namespace

std::span<const Method> methods(Domain domain) {
  if (domain == Domain::kObjectSpace) return kObjectMethods;
  return kImageMethods;
}

const Method& method_info(MethodId id) {
  const auto found = std::ranges::find(kObjectMethods, id, &Method::id);
  return found != kObjectMethods.end() ? *found
                                       : *std::ranges::find(kImageMethods, id, &Method::id);
}

std::string_view name_of(Domain domain) {
  return domain == Domain::kObjectSpace ? "object space" : "image space";
}

std::vector<std::string_view> names_of(const MethodNeeds& needs) {
  std::vector<std::string_view> names;
  if (needs.closed_meshes) names.emplace_back("closed meshes");
  if (needs.camera) names.emplace_back("a camera");
  if (needs.one_hemisphere)
    names.emplace_back("all polygons ahead of the light as the picture looks");
  return names;
}

std::string name_of(LightKinds lights) {
  std::string name = lights.point ? "point, directional" : "";
  if (lights.area) name += name.empty() ? "area" : ", area";
  return name;
}

std::vector<std::string_view> abilities(const Method& method) {
  std::vector<std::string_view> names;
  if (method.combines_lights) names.emplace_back("combined");
  if (method.explains) names.emplace_back("explain");
  if (method.overlays) names.emplace_back("overlay");
  if (method.moves_lights) names.emplace_back("moving");
  if (method.threads) names.emplace_back("threads");
  if (method.names_casters) names.emplace_back("witness");
  return names;
}

std::optional<MethodId> method_by_name(std::string_view name, Domain domain) {
  for (const Method& method : methods(domain)) {
    if (method.chosen_by_name && method.name == name) return method.id;
  }
  return std::nullopt;
}

std::string method_names(LightKinds lights, Domain domain) {
  std::string names;
  for (const Method& method : methods(domain)) {
    const bool takes = (lights.point && method.lights.point) || (lights.area && method.lights.area);
    if (!method.chosen_by_name || !takes) continue;
    names += (names.empty() ? "" : ", ") + std::string(method.name);
  }
  return names;
}

namespace {

/// pick.operator()<Run>() of the class template that runs a method.
template <class Pick>
MethodFunction run_of(MethodId method, const Pick& pick) {
  switch (method) {
    case MethodId::kSectors:
    case MethodId::kTwoPass:
    case MethodId::kBlots:  // all three run in cells of light space
      return pick.template operator()<BySectors>();
    case MethodId::kContour:
      return pick.template operator()<ByContour>();
    case MethodId::kSvbsp:
      return pick.template operator()<BySvbsp>();
    case MethodId::kBasic:
    case MethodId::kTiling:
      return pick.template operator()<ByVolumes>();
    case MethodId::kSvbspFull:
      return pick.template operator()<BySvbspFull>();
    case MethodId::kReceiver:
    case MethodId::kMerged:
    case MethodId::kPieces:
      return pick.template operator()<ByReceiver>();
    case MethodId::kAutomatic:
    case MethodId::kZbuffer:  // pixel_function() has those of image space
    case MethodId::kShadowPolygons:
    case MethodId::kScanOut:
    case MethodId::kRidgeEdges:
      break;
  }
  return nullptr;
}

}  // namespace

MethodFunction method_function(MethodId method, KernelId kernel) {
  return run_of(method, [&]<template <class> class Run>() { return on_kernel<Run>(kernel); });
}

PixelFunction pixel_function(MethodId method, KernelId kernel) {
  switch (method) {
    case MethodId::kZbuffer:
      return on_kernel<ByZbuffer>(kernel);
    case MethodId::kShadowPolygons:
      return on_kernel<ByShadowPolygons>(kernel);
    case MethodId::kScanOut:
      return on_kernel<ByScanOut>(kernel);
    case MethodId::kRidgeEdges:
      return on_kernel<ByRidgeEdges>(kernel);
    default:
      return nullptr;
  }
}

MethodFunction watched_function(MethodId method, KernelId) {
  return run_of(method, []<template <class> class Run>() -> MethodFunction {
    if constexpr (std::is_same_v<Run<WatchedKernel>, ByContour<WatchedKernel>>) {
      return nullptr;
    } else {
      return &Run<WatchedKernel>::run;
    }
  });
}

}  // namespace gnomon
