// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/partition/box_tree.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <ranges>
#include <utility>

#include "algorithms/partition/in_parallel.h"

namespace gnomon {

// Nodes stand in the order in which a left child follows its parent, and a right child what is
// below the left one. How many these are depends on the number of members alone, so that every node
// has its place before what is above it is made: halves can be sorted by different threads.
class BoxTree::Maker {
 public:
  explicit Maker(BoxTree& tree) : tree_(tree) {
    members_.reserve(tree.order_.size());
    for (const std::uint32_t number : tree.order_) {
      const auto& [low, high] = tree.boxes_[number];
      members_.push_back({{low[0] + high[0], low[1] + high[1], low[2] + high[2]}, number});
    }
  }

  void make(unsigned jobs) {
    const auto size = static_cast<std::uint32_t>(members_.size());
    tree_.nodes_.resize(node_count(size));
    std::vector<Task> level{{0, size, 0}};
    std::vector<std::uint32_t> above;  // nodes
    // All tasks of a level are of the same size, up to one member.
    while (jobs != 1 && level.front().end - level.front().begin > kMembersOfAThread) {
      for (const Task& task : level) above.push_back(task.node);
      std::vector<Task> next(2 * level.size());
      tbb::parallel_for(std::size_t{0}, level.size(),
                        [&](std::size_t i) { make_node(level[i], next[2 * i], next[2 * i + 1]); });
      level = std::move(next);
    }
    in_parallel(jobs, static_cast<std::uint32_t>(level.size()), 1,
                [&](std::uint32_t begin, std::uint32_t end) {
                  for (std::uint32_t i = begin; i < end; ++i) make_subtree(level[i]);
                });
    for (const std::uint32_t node : above | std::views::reverse) find_box(node);
  }

 private:
  /// Fewer members are sorted by one thread.
  static constexpr std::uint32_t kMembersOfAThread = 2048;
  struct Task {
    std::uint32_t begin, end;
    std::uint32_t node;  // that is made of these members
  };
  /// They are sorted with what they are sorted by, which else would be fetched from everywhere.
  struct Member {
    std::array<double, 3> middle;  // of its box, twice
    std::uint32_t number;
  };

  /// Nodes of a hierarchy of so many members. Cost: O(log n).
  static std::uint32_t node_count(std::uint32_t members) {
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

  /// Makes a node without its box; says whether it has children, and then of which members.
  bool make_node(const Task& task, Task& left, Task& right) {
    Node& node = tree_.nodes_[task.node];
    node.begin = task.begin;
    node.end = task.end;
    if (task.end - task.begin <= kLeafSize) return false;
    const std::uint32_t half = halve(task);
    left = {task.begin, half, task.node + 1};
    right = {half, task.end, left.node + node_count(half - task.begin)};
    node.right = right.node;
    return true;
  }

  void make_subtree(const Task& task) {
    std::vector<Task> tasks{task};
    while (!tasks.empty()) {
      const Task own = tasks.back();
      tasks.pop_back();
      Task left, right;
      if (!make_node(own, left, right)) continue;
      tasks.push_back(right);
      tasks.push_back(left);
    }
    for (std::uint32_t i = task.begin; i < task.end; ++i) tree_.order_[i] = members_[i].number;
    // Children come after their parents.
    for (std::uint32_t i = task.node + node_count(task.end - task.begin); i-- > task.node;) {
      find_box(i);
    }
  }

  /// Sorts the members of a task by the axis along which their middles are spread most, as far as
  /// needed to tell the lower half from the upper one; returns where the upper one begins.
  std::uint32_t halve(const Task& task) {
    const auto begin = members_.begin();
    Box middles;
    std::for_each(begin + task.begin, begin + task.end,
                  [&](const Member& member) { middles.add(member.middle); });
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k) {
      if (middles.high[k] - middles.low[k] > middles.high[axis] - middles.low[axis]) axis = k;
    }
    const std::uint32_t half = task.begin + (task.end - task.begin) / 2;
    std::nth_element(begin + task.begin, begin + half, begin + task.end,
                     [&](const Member& a, const Member& b) {
                       const double x = a.middle[axis], y = b.middle[axis];
                       return x < y || (x == y && a.number < b.number);
                     });
    return half;
  }

  /// Requires: those of its children are found, and what is below it is in order.
  void find_box(std::uint32_t number) {
    Node& node = tree_.nodes_[number];
    if (node.right == 0) {
      for (const std::uint32_t member : tree_.members(node)) node.box.add(tree_.boxes_[member]);
      return;
    }
    node.box = tree_.nodes_[number + 1].box;
    node.box.add(tree_.nodes_[node.right].box);
  }

  BoxTree& tree_;
  std::vector<Member> members_;  // in the tree's order, in the end
};

BoxTree::BoxTree(std::vector<Box> boxes, std::vector<std::uint32_t> members, unsigned jobs)
    : boxes_(std::move(boxes)), order_(std::move(members)) {
  if (!order_.empty()) Maker(*this).make(jobs);
}

}  // namespace gnomon
