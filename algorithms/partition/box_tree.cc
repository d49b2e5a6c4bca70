// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/partition/box_tree.h"

#include <algorithm>
#include <utility>

namespace gnomon {

BoxTree::BoxTree(std::vector<Box> boxes, std::vector<std::uint32_t> members)
    : boxes_(std::move(boxes)), order_(std::move(members)) {
  if (order_.empty()) return;
  std::vector<Task> tasks{{0, static_cast<std::uint32_t>(order_.size()), kNoParent}};
  while (!tasks.empty()) {
    const Task task = tasks.back();
    tasks.pop_back();
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    if (task.parent != kNoParent) nodes_[task.parent].right = index;
    Node node{{}, task.begin, task.end, 0};
    for (std::uint32_t i = task.begin; i < task.end; ++i) node.box.add(boxes_[order_[i]]);
    nodes_.push_back(node);
    if (task.end - task.begin <= kLeafSize) continue;
    const std::uint32_t half = halve(task);
    tasks.push_back({half, task.end, index});
    tasks.push_back({task.begin, half, kNoParent});  // next: the left child follows
  }
}

/// Sorts the members of a task by the axis along which their middles are spread most, as far as
/// needed to tell the lower half from the upper one; returns where the upper one begins.
std::uint32_t BoxTree::halve(const Task& task) {
  Box middles;
  for (std::uint32_t i = task.begin; i < task.end; ++i) {
    const std::uint32_t number = order_[i];
    middles.add(std::array{middle(number, 0), middle(number, 1), middle(number, 2)});
  }
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (middles.high[k] - middles.low[k] > middles.high[axis] - middles.low[axis]) axis = k;
  }
  const std::uint32_t half = task.begin + (task.end - task.begin) / 2;
  const auto begin = order_.begin();
  std::nth_element(begin + task.begin, begin + half, begin + task.end,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const double x = middle(a, axis), y = middle(b, axis);
                     return x < y || (x == y && a < b);
                   });
  return half;
}

}  // namespace gnomon
