// SPDX-License-Identifier: LGPL-3.0-or-later
// What a method did, in numbers that are the same on every machine and with any number of threads:
// the work that the papers count (Slater 1992, sec. 6; Chin & Feiner 1989, table 1), beside the
// seconds that nobody can repeat. Each method names the counters that it fills (Method::counters).
#ifndef GNOMON_ALGORITHMS_WORK_COUNTS_H
#define GNOMON_ALGORITHMS_WORK_COUNTS_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace gnomon {

enum class Counter : std::uint8_t {
  kScenePieces,      // pieces of the scene BSP that face the light
  kVolumes,          // shadow volumes made
  kTests,            // pairs of a target and a shadow volume
  kCovered,          // targets wholly inside one volume
  kDied,             // volumes dropped, since a later one holds all that they shadow
  kClips,            // cuts of a loop by a plane
  kNulled,           // pairs of a target and a volume that have no common area
  kShadowPolygons,   // pieces of targets inside volumes, as the method puts them out
  kNodes,            // of the tree of planes
  kDepth,            // of that tree
  kLongestChain,     // nodes of that tree one below another, each the only child of the one before
  kMeanFilterDepth,  // of the cells that loops came to
  kTreeBytes,        // memory of that tree
  kTileWrites,       // entries made in tiles
  kClosedTiles,      // tiles that one volume holds wholly
  kTileBytes,        // memory of the tiles
  kMeanMet,          // |S(p)| / i of a target: volumes that its tiles name, of all so far
  kFirstQuartileMet,
  kMedianMet,
  kThirdQuartileMet,
  kLists,            // lists of polygons that were clipped by one of them
  kLongestList,      // polygons in the longest of them
  kDeepestStack,     // lists that waited at the same time
  kCellCuts,         // cuts of a polygon by a plane between cells of light space
  kIntervals,        // of edges inside other polygons
  kSegments,         // of edges that take light from what is behind them
  kDarkPolygons,     // proven to be so before they are met
  kOpenPolygons,     // that bounds left open, and exact subtraction found
  kSamples,          // of a picture, on some polygon
  kSpans,            // of samples of a row that a polygon covers
  kDepthTests,       // comparisons of two polygons along a span
  kCasterTests,      // pairs of a span and a polygon that may shadow it
  kWalls,            // shadow polygons of all lights that the eye does not see edge-on
  kActiveWalls,      // of them, those in one row
  kWallTests,        // pairs of a span and a wall or cap whose depths are compared
  kWallSamples,      // pairs of a sample and a wall that its ray comes through
  kNeighbourTests,   // comparisons of a neighbour in depth with what is seen
  kNeighbourMisses,  // samples that neighbours alone would have counted otherwise
  kWallBytes,        // memory of walls and caps
  kDepthComplexity,  // polygons that face the eye and cover a sample, of all samples
  kSolids,           // convex solids that cast as wholes
  kVolumePlanes,     // of all shadow volumes
  kMerged,           // fragments that went into neighbours
  kEvents,           // where spans of a row begin or end
  kOverlapTests,     // pairs of polygons whose outlines are compared
  kListEntries,      // polygons on lists of possible casters
  kListBytes,        // memory of these lists
  kSubObjects,       // convex solids and polygons by themselves, in each cell of light space
  kHidingPairs,      // of sub-objects, the first of which may hide something of the second
  kCycles,           // sets of sub-objects that hide each other, taken apart into polygons
  kBlots,            // convex outlines made, whole or partial
  kAbsorbed,         // of these, dropped since a later one holds them
  kBlotCuts,         // sub-objects, or polygons of them, cut by a blot
  kBoxShortcuts,     // sub-objects decided as a whole: before all blots, or inside one
  kRidgeLoops,       // of the outlines of objects
  kTableRows,        // of angular tables
  kTableSpans,       // of shadow, in all rows of them
  kTableStretches,   // of faces that tell distances, in all rows of them
  kTableBytes,       // memory of angular tables
  kLookUps,          // rows fetched from an angular table
  kSpanTests,        // pairs of samples in one row and a span of it
  kStretchTests,     // pairs of samples in one row and a stretch of it
};
inline constexpr std::size_t kCounterCount = static_cast<std::size_t>(Counter::kStretchTests) + 1;

/// How the counts of two lights, or of two parts of one run, make one.
enum class CountKind : std::uint8_t { kSum, kMost };

struct CounterInfo {
  Counter counter{};
  std::string_view name;     // such as "shadow polygons"
  std::string_view summary;  // what one of them is
  CountKind kind = CountKind::kSum;
  /// Not 1: the count is a share, in units of one over this.
  std::uint64_t denominator = 1;
};
/// In order of the enumeration.
std::span<const CounterInfo> counter_infos();
const CounterInfo& counter_info(Counter counter);

class WorkCounts {
 public:
  std::uint64_t& operator[](Counter counter) { return counts_[static_cast<std::size_t>(counter)]; }
  std::uint64_t operator[](Counter counter) const {
    return counts_[static_cast<std::size_t>(counter)];
  }
  void at_least(Counter counter, std::uint64_t count) {
    if ((*this)[counter] < count) (*this)[counter] = count;
  }
  /// Adds sums, keeps the larger of what is a maximum or a share.
  WorkCounts& operator+=(const WorkCounts& other);
  friend bool operator==(const WorkCounts&, const WorkCounts&) = default;

 private:
  std::array<std::uint64_t, kCounterCount> counts_{};
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_WORK_COUNTS_H
