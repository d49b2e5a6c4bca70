// SPDX-License-Identifier: LGPL-3.0-or-later
// The balanced top of a tree of planes: a k-d split of boxes, by which the SVBSP tree's prefix cuts
// the charts of light space and the prefix of the trees of shadow volumes cuts space itself.
//
// A heuristic on doubles: whatever it plans, the planes made of it are exact, and no answer depends
// on them.
#ifndef GNOMON_ALGORITHMS_PARTITION_KD_TREE_H
#define GNOMON_ALGORITHMS_PARTITION_KD_TREE_H

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "algorithms/partition/box.h"

namespace gnomon {

/// n log2 n.
double n_log_n(std::size_t n);

/// Where a k-d split of n members into some below and some above (or both) pays: while f(below) +
/// f(above) < kSplitGrowth f(n), f = n_log_n.
inline constexpr double kSplitGrowth = 1.1;

/// A plane of a k-d tree: `value` along `axis`, a multiple of 2^-kBits.
struct KdSplit {
  static constexpr int kBits = 20;
  int axis = -1;
  double value = 0;
};

/// How far to split.
struct KdRules {
  int axes = 3;                 // the first so many of a box
  double least = 0, most = 1;   // values of splits lie between, exclusively
  bool touching_counts = true;  // whether a box is on a side that it only touches
  std::size_t leaf_size = 1;    // leaves with so many boxes are not split
};

/// Puts a split in the tree, as the front or back child of a node, and returns its number. The
/// front is where the coordinate is larger.
using AddKdNode =
    std::function<std::int32_t(const KdSplit& split, std::int32_t parent, bool is_front)>;

/// Grows a tree over boxes as a child of `parent`, parents before children.
void grow_kd_tree(std::span<const Box> boxes, const KdRules& rules, std::int32_t parent,
                  bool is_front, const AddKdNode& add);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PARTITION_KD_TREE_H
