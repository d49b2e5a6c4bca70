// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/volume_trees/balanced_prefix.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gnomon {
namespace {

constexpr double kGrowth = 1.1;  // split only while f(below) + f(above) < kGrowth f(all)
constexpr int kDeepest = 40;

double n_log_n(std::size_t n) {
  return n < 2 ? 0 : static_cast<double>(n) * std::log2(static_cast<double>(n));
}

/// A multiple of 2^-kBits: exact in every kernel.
double rounded(double value) {
  return std::ldexp(std::nearbyint(std::ldexp(value, SpacePrefix::kBits)), -SpacePrefix::kBits);
}

struct Split {
  int axis = -1;
  double value = 0;
};

class Planner {
 public:
  explicit Planner(std::span<const Box> boxes) : boxes_(boxes) {}

  Split choose(const std::vector<std::uint32_t>& members) {
    const std::size_t n = members.size();
    Split best;
    double best_cost = kGrowth * n_log_n(n);
    for (int axis = 0; axis < 3; ++axis) {
      centres_.clear();
      for (const std::uint32_t i : members) {
        centres_.push_back((boxes_[i].low[axis] + boxes_[i].high[axis]) / 2);
      }
      std::nth_element(centres_.begin(), centres_.begin() + static_cast<std::ptrdiff_t>(n / 2),
                       centres_.end());
      const double value = rounded(centres_[n / 2]);
      if (!(value > 0 && value < 1)) continue;
      std::size_t below = 0, above = 0;
      for (const std::uint32_t i : members) {
        below += boxes_[i].low[axis] <= value;
        above += boxes_[i].high[axis] >= value;
      }
      const double cost = n_log_n(below) + n_log_n(above);
      if (below < n && above < n && cost < best_cost) {
        best_cost = cost;
        best = {axis, value};
      }
    }
    return best;
  }

 private:
  std::span<const Box> boxes_;
  std::vector<double> centres_;
};

}  // namespace

SpacePrefix plan_space_prefix(std::span<const Box> receivers, std::uint32_t leaf_size) {
  struct Task {
    std::vector<std::uint32_t> members;
    std::int32_t parent = -1;
    bool front = false;
    int depth = 0;
  };
  SpacePrefix prefix;
  Planner planner(receivers);
  std::vector<Task> stack(1);
  for (std::uint32_t i = 0; i < receivers.size(); ++i) stack.front().members.push_back(i);
  while (!stack.empty()) {
    Task task = std::move(stack.back());
    stack.pop_back();
    if (task.members.size() <= leaf_size || task.depth >= kDeepest) continue;
    const Split split = planner.choose(task.members);
    if (split.axis < 0) continue;
    const auto index = static_cast<std::int32_t>(prefix.nodes.size());
    prefix.nodes.push_back({split.axis, split.value, SpacePrefix::kLeaf, SpacePrefix::kLeaf});
    if (task.parent >= 0) {
      SpacePrefix::Node& parent = prefix.nodes[static_cast<std::size_t>(task.parent)];
      (task.front ? parent.front : parent.back) = index;
    }
    Task above{{}, index, true, task.depth + 1}, below{{}, index, false, task.depth + 1};
    // What touches the plane goes both ways: boxes are rounded.
    for (const std::uint32_t i : task.members) {
      if (receivers[i].high[split.axis] >= split.value) above.members.push_back(i);
      if (receivers[i].low[split.axis] <= split.value) below.members.push_back(i);
    }
    stack.push_back(std::move(above));
    stack.push_back(std::move(below));
  }
  return prefix;
}

}  // namespace gnomon
