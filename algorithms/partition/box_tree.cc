// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/partition/box_tree.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "algorithms/partition/in_parallel.h"

namespace gnomon {

// Nodes stand in the order in which a left child follows its parent, and a right child what is
// below the left one. How many these are depends on the number of members alone, so that every node
// has its place before what is above it is made: halves can be sorted by different threads.
BoxTree::BoxTree(std::vector<Box> boxes, std::vector<std::uint32_t> members, unsigned jobs)
    : boxes_(std::move(boxes)), order_(std::move(members)) {
  if (order_.empty()) return;
  const auto size = static_cast<std::uint32_t>(order_.size());
  nodes_.resize(node_count(size));
  std::vector<Task> level{{0, size, 0}};
  // All tasks of a level are of the same size, up to one member.
  while (jobs != 1 && level.front().end - level.front().begin > kMembersOfAThread) {
    std::vector<Task> next(2 * level.size());
    tbb::parallel_for(std::size_t{0}, level.size(),
                      [&](std::size_t i) { make_node(level[i], next[2 * i], next[2 * i + 1]); });
    level = std::move(next);
  }
  in_parallel(jobs, static_cast<std::uint32_t>(level.size()), 1,
              [&](std::uint32_t begin, std::uint32_t end) {
                for (std::uint32_t i = begin; i < end; ++i) make_subtree(level[i]);
              });
}

std::uint32_t BoxTree::node_count(std::uint32_t members) {
  // On each level nodes have `size` members or one more.
  std::uint32_t size = members, few = 1, many = 0, count = 0;
  while (few + many > 0) {
    count += few + many;
    if (size <= kLeafSize) few = 0;
    if (size + 1 <= kLeafSize) many = 0;
    // 2 h is halved into h and h, and 2 h + 1 into h and h + 1.
    const bool odd = size % 2 != 0;
    const std::uint32_t half_few = odd ? few : 2 * few + many;
    many = odd ? few + 2 * many : many;
    few = half_few;
    size /= 2;
  }
  return count;
}

bool BoxTree::make_node(const Task& task, Task& left, Task& right) {
  Node& node = nodes_[task.node];
  node.begin = task.begin;
  node.end = task.end;
  for (std::uint32_t i = task.begin; i < task.end; ++i) node.box.add(boxes_[order_[i]]);
  if (task.end - task.begin <= kLeafSize) return false;
  const std::uint32_t half = halve(task);
  left = {task.begin, half, task.node + 1};
  right = {half, task.end, left.node + node_count(half - task.begin)};
  node.right = right.node;
  return true;
}

void BoxTree::make_subtree(const Task& task) {
  std::vector<Task> tasks{task};
  while (!tasks.empty()) {
    const Task own = tasks.back();
    tasks.pop_back();
    Task left, right;
    if (!make_node(own, left, right)) continue;
    tasks.push_back(right);
    tasks.push_back(left);
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
