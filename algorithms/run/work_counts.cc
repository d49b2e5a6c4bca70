// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/algorithms/work_counts.h"

#include <algorithm>

namespace gnomon {

namespace {

constexpr std::uint64_t kMillion = 1'000'000;
constexpr CountKind kSum = CountKind::kSum, kMost = CountKind::kMost;

constexpr std::array<CounterInfo, kCounterCount> kCounters = {{
    {Counter::kScenePieces, "scene pieces", "pieces of the scene BSP that face the light", kSum},
    {Counter::kVolumes, "volumes", "shadow volumes made", kSum},
    {Counter::kTests, "tests", "pairs of a target and a shadow volume", kSum},
    {Counter::kCovered, "covered", "targets wholly inside one volume", kSum},
    {Counter::kDied, "died", "volumes dropped, since a later one holds all that they shadow", kSum},
    {Counter::kClips, "clips", "cuts of a loop by a plane", kSum},
    {Counter::kNulled, "nulled", "pairs of a target and a volume without common area", kSum},
    {Counter::kShadowPolygons, "shadow polygons", "pieces of targets inside volumes", kSum},
    {Counter::kNodes, "nodes", "of the tree of planes", kSum},
    {Counter::kDepth, "depth", "of the tree of planes", kMost},
    {Counter::kLongestChain, "longest chain", "nodes below each other without a branch", kMost},
    {Counter::kMeanFilterDepth, "mean filter depth", "of the cells that loops came to", kMost,
     kMillion},
    {Counter::kTreeBytes, "tree bytes", "memory of the tree of planes", kMost},
    {Counter::kTileWrites, "tile writes", "entries made in tiles", kSum},
    {Counter::kClosedTiles, "closed tiles", "tiles that one volume holds wholly", kSum},
    {Counter::kTileBytes, "tile bytes", "memory of the tiles", kMost},
    {Counter::kMeanMet, "mean p", "share of all volumes so far that a target's tiles name", kMost,
     kMillion},
    {Counter::kFirstQuartileMet, "first quartile of p", "of the same share", kMost, kMillion},
    {Counter::kMedianMet, "median p", "of the same share", kMost, kMillion},
    {Counter::kThirdQuartileMet, "third quartile of p", "of the same share", kMost, kMillion},
    {Counter::kLists, "lists", "lists of polygons that one of them clipped", kSum},
    {Counter::kLongestList, "longest list", "polygons in the longest list", kMost},
    {Counter::kDeepestStack, "deepest stack", "lists that waited at the same time", kMost},
    {Counter::kCellCuts, "cell cuts", "cuts of polygons by planes between cells", kSum},
    {Counter::kIntervals, "intervals", "of edges inside other polygons", kSum},
    {Counter::kSegments, "segments", "of edges that take light from what is behind them", kSum},
    {Counter::kDarkPolygons, "dark polygons", "proven to be so before they are met", kSum},
    {Counter::kOpenPolygons, "open polygons", "left open by bounds, found by exact subtraction",
     kSum},
    {Counter::kSamples, "samples", "of the picture, on some polygon", kSum},
    {Counter::kSpans, "spans", "of samples of a row that a polygon covers", kSum},
    {Counter::kDepthTests, "depth tests", "comparisons of two polygons along a span", kSum},
    {Counter::kCasterTests, "caster tests", "pairs of a span and a polygon that may shadow it",
     kSum},
    {Counter::kWalls, "walls", "shadow polygons that the eye does not see edge-on", kMost},
    {Counter::kActiveWalls, "active walls", "most of them in one row", kMost},
    {Counter::kWallTests, "wall tests", "spans and walls or caps whose depths are compared", kSum},
    {Counter::kWallSamples, "wall samples", "samples and walls that their rays come through", kSum},
    {Counter::kNeighbourTests, "neighbour tests", "of a neighbour in depth and what is seen", kSum},
    {Counter::kNeighbourMisses, "neighbour misses", "samples that neighbours alone get wrong",
     kSum},
    {Counter::kWallBytes, "wall bytes", "memory of walls and caps", kMost},
    {Counter::kDepthComplexity, "depth complexity", "polygons that cover a sample, on average",
     kMost, kMillion},
    {Counter::kSolids, "solids", "convex ones that cast as wholes", kSum},
    {Counter::kVolumePlanes, "volume planes", "of all shadow volumes", kSum},
    {Counter::kMerged, "merged", "fragments that went into neighbours", kSum},
    {Counter::kEvents, "events", "where spans of a row begin or end", kSum},
    {Counter::kOverlapTests, "overlap tests", "pairs of polygons whose outlines are compared",
     kSum},
    {Counter::kListEntries, "list entries", "polygons on lists of possible casters", kSum},
    {Counter::kListBytes, "list bytes", "memory of lists of possible casters", kMost},
    {Counter::kSubObjects, "sub-objects", "convex solids and polygons by themselves, by cells",
     kSum},
    {Counter::kHidingPairs, "hiding pairs", "sub-objects, one of which may hide some of the other",
     kSum},
    {Counter::kCycles, "cycles", "sets of sub-objects that hide each other", kSum},
    {Counter::kBlots, "blots", "outlines made, whole or partial", kSum},
    {Counter::kAbsorbed, "absorbed", "blots dropped, since a later one holds them", kSum},
    {Counter::kBlotCuts, "blot cuts", "sub-objects, or polygons of them, cut by a blot", kSum},
    {Counter::kBoxShortcuts, "shortcuts", "sub-objects before all blots, or wholly inside one",
     kSum},
    {Counter::kRidgeLoops, "ridge loops", "of the outlines of objects", kMost},
    {Counter::kTableRows, "table rows", "of angular tables", kMost},
    {Counter::kTableSpans, "table spans", "of shadow, in all rows", kMost},
    {Counter::kTableStretches, "table stretches", "of faces that tell distances, in all rows",
     kMost},
    {Counter::kTableBytes, "table bytes", "memory of angular tables", kMost},
    {Counter::kLookUps, "look-ups", "rows fetched from an angular table", kSum},
    {Counter::kSpanTests, "span tests", "of samples in one row and a span of it", kSum},
    {Counter::kStretchTests, "stretch tests", "of samples in one row and a face's stretch of it",
     kSum},
}};

}  // namespace

std::span<const CounterInfo> counter_infos() { return kCounters; }

const CounterInfo& counter_info(Counter counter) {
  return kCounters[static_cast<std::size_t>(counter)];
}

WorkCounts& WorkCounts::operator+=(const WorkCounts& other) {
  for (const CounterInfo& info : kCounters) {
    std::uint64_t& own = (*this)[info.counter];
    const std::uint64_t more = other[info.counter];
    own = info.kind == CountKind::kSum ? own + more : std::max(own, more);
  }
  return *this;
}

}  // namespace gnomon
