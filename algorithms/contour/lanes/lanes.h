// SPDX-License-Identifier: LGPL-3.0-or-later
// The inner loops of the contour method, four doubles or eight floats at a time: signs of corners
// against lines, and overlaps of boxes along a sweep. They are compiled once for each level of
// vector instructions (level.inl.h) and called through the table of the level that the machine has
// (simd_level.h).
//
// Guarantee: every level gives the same bits. Each value is computed by the operations that stand
// beside its function, in that order, each rounded once; no level may fuse a product with a sum.
//
// This header is included by sources that are compiled for vector instructions which the machine
// may lack. It includes no header that defines inline functions, since of several copies of an
// inline function the linker keeps any one, for everybody.
#ifndef GNOMON_ALGORITHMS_CONTOUR_LANES_LANES_H
#define GNOMON_ALGORITHMS_CONTOUR_LANES_LANES_H

#include <cstddef>
#include <cstdint>

namespace gnomon {

/// Boxes of a chart in the order of their low u, as arrays of equal length. After the last box
/// there are at least eight more places in each array; those of low_u hold NaN, which ends every
/// search.
struct SweepList {
  const float* low_u;
  const float* low_v;
  const float* high_u;
  const float* high_v;
  const std::uint32_t* traits;  // a pair is reported if the two boxes together have kAllTraits
  std::uint32_t count;
  std::uint32_t base;  // the number of the first box, by which pairs are reported
};

/// The traits that two boxes must have between them to be reported, as bits.
inline constexpr std::uint32_t kAllTraits = 7;

/// Which targets a query is tested with, so that no pair is found from both sides.
enum class SweepOrder : std::uint8_t {
  kAfter,     // queries and targets are one list: the targets after the query
  kNotBelow,  // targets whose low u is the query's or above it
  kAbove,     // targets whose low u is above the query's
};

/// Where a sweep goes on, and what it has found.
struct SweepState {
  std::uint32_t query = 0;     // the next query
  std::uint32_t target = 0;    // no target before this one is for that query
  std::uint64_t found = 0;     // pairs so far
  std::uint64_t capacity = 0;  // places in each of the two arrays
  std::uint32_t* queries = nullptr;
  std::uint32_t* targets = nullptr;
};

/// Bit k tells the sign of corner k; neither bit is set where the bound does not decide.
struct CornerSigns {
  std::uint64_t positive;
  std::uint64_t negative;
};

/// Bit 4 i + k tells the sign of corner k against line i.
struct BlockSigns {
  std::uint16_t positive;
  std::uint16_t negative;
};

/// A block of four corners or of four lines: the first coordinates of all four, then the second
/// ones, then the third ones. Blocks follow one another without gaps.
inline constexpr std::size_t kBlockDoubles = 12;
/// The most blocks that a call of corner_signs takes.
inline constexpr std::uint32_t kMostBlocks = 16;

/// The functions of one level.
struct Lanes {
  /// The signs of (a x_k + b y_k) + c z_k for the corners k of `blocks` blocks, where `line` is
  /// a, b, c: positive where the value > bound, negative where it is < -bound.
  /// Requires: bound >= 0, blocks <= kMostBlocks.
  CornerSigns (*corner_signs)(const double* line, double bound, const double* corners,
                              std::uint32_t blocks);

  /// The same for a block of four lines and one block of corners; the bound of line i is errors[i]
  /// * reach.
  BlockSigns (*block_signs)(const double* lines, const double* errors, double reach,
                            const double* corners);

  /// The same, which also puts the value of line i at corner k into values[4 i + k].
  BlockSigns (*block_values)(const double* lines, const double* errors, double reach,
                             const double* corners, double* values);

  /// Writes the pairs of a query and a target whose closed boxes overlap and which have all traits
  /// between them, as numbers of the lists, by queries and then by targets; adds the number of
  /// pairs of each query to query_counts[query]. Returns whether all queries are done; else there
  /// is less room than the next query may need, and the sweep goes on from `state` when it has at
  /// least target count + 8 free places.
  /// Requires: no NaN but behind the boxes; low <= high.
  bool (*sweep)(const SweepList& queries, const SweepList& targets, SweepOrder order,
                SweepState& state, std::uint32_t* query_counts);
};

/// One table a level; those above the baseline exist on x86-64 only, and their functions must not
/// be called on a machine without the instructions.
namespace lanes_baseline {
extern const Lanes kLanes;
}
namespace lanes_avx2 {
extern const Lanes kLanes;
}
namespace lanes_avx512 {
extern const Lanes kLanes;
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_LANES_LANES_H
