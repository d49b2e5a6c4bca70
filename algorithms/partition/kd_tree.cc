// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/partition/kd_tree.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace gnomon {
namespace {

/// A split leaves about six tenths of the members on the larger side at most, so that this depth
/// needs more than 10^8 boxes.
constexpr int kDeepest = 40;

/// A multiple of 2^-kBits: exact in every kernel.
double rounded(double value) {
  return std::ldexp(std::nearbyint(std::ldexp(value, KdSplit::kBits)), -KdSplit::kBits);
}

class Planner {
 public:
  Planner(std::span<const Box> boxes, const KdRules& rules) : boxes_(boxes), rules_(rules) {}

  bool is_below(std::uint32_t i, const KdSplit& split) const {
    const double low = boxes_[i].low[static_cast<std::size_t>(split.axis)];
    return rules_.touching_counts ? low <= split.value : low < split.value;
  }
  bool is_above(std::uint32_t i, const KdSplit& split) const {
    const double high = boxes_[i].high[static_cast<std::size_t>(split.axis)];
    return rules_.touching_counts ? high >= split.value : high > split.value;
  }

  /// The best split at the middle of the boxes along an axis; no axis if none pays.
  KdSplit choose(const std::vector<std::uint32_t>& members) {
    const std::size_t n = members.size();
    KdSplit best;
    double best_cost = kSplitGrowth * n_log_n(n);
    for (int axis = 0; axis < rules_.axes; ++axis) {
      const KdSplit split{axis, rounded(median(members, static_cast<std::size_t>(axis)))};
      if (!(split.value > rules_.least && split.value < rules_.most)) continue;
      std::size_t below = 0, above = 0;
      for (const std::uint32_t i : members) {
        below += is_below(i, split);
        above += is_above(i, split);
      }
      const double cost = n_log_n(below) + n_log_n(above);
      if (below < n && above < n && cost < best_cost) {
        best_cost = cost;
        best = split;
      }
    }
    return best;
  }

 private:
  double median(const std::vector<std::uint32_t>& members, std::size_t axis) {
    middles_.clear();
    for (const std::uint32_t i : members) {
      middles_.push_back((boxes_[i].low[axis] + boxes_[i].high[axis]) / 2);
    }
    const std::size_t half = members.size() / 2;
    std::nth_element(middles_.begin(), middles_.begin() + static_cast<std::ptrdiff_t>(half),
                     middles_.end());
    return middles_[half];
  }

  std::span<const Box> boxes_;
  const KdRules& rules_;
  std::vector<double> middles_;
};

}  // namespace

double n_log_n(std::size_t n) {
  static const std::vector<double> kTable = [] {
    std::vector<double> table(4096, 0.0);
    for (std::size_t i = 2; i < table.size(); ++i) {
      table[i] = static_cast<double>(i) * std::log2(static_cast<double>(i));
    }
    return table;
  }();
  return n < kTable.size() ? kTable[n] : static_cast<double>(n) * std::log2(static_cast<double>(n));
}

void grow_kd_tree(std::span<const Box> boxes, const KdRules& rules, std::int32_t parent,
                  bool is_front, const AddKdNode& add) {
  struct Task {
    std::vector<std::uint32_t> members;
    std::int32_t parent;
    bool is_front;
    int depth;
  };
  Planner planner(boxes, rules);
  Task all{{}, parent, is_front, 0};
  for (std::uint32_t i = 0; i < boxes.size(); ++i) all.members.push_back(i);
  std::vector<Task> stack;
  stack.push_back(std::move(all));
  while (!stack.empty()) {
    const Task task = std::move(stack.back());
    stack.pop_back();
    if (task.members.size() <= rules.leaf_size || task.depth >= kDeepest) continue;
    const KdSplit split = planner.choose(task.members);
    if (split.axis < 0) continue;
    const std::int32_t node = add(split, task.parent, task.is_front);
    Task above{{}, node, true, task.depth + 1}, below{{}, node, false, task.depth + 1};
    for (const std::uint32_t i : task.members) {
      if (planner.is_above(i, split)) above.members.push_back(i);
      if (planner.is_below(i, split)) below.members.push_back(i);
    }
    stack.push_back(std::move(above));
    stack.push_back(std::move(below));
  }
}

}  // namespace gnomon
