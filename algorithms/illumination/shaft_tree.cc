// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/illumination/shaft_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace gnomon {
namespace {

constexpr std::uint32_t kNoParent = 0xffffffffu;

void extend(ShaftBox& box, const ShaftBox& other) {
  for (int k = 0; k < 3; ++k) {
    box.low[k] = std::min(box.low[k], other.low[k]);
    box.high[k] = std::max(box.high[k], other.high[k]);
  }
}

}  // namespace

ShaftTree::ShaftTree(std::vector<ShaftBox> boxes) : boxes_(std::move(boxes)) {
  order_.resize(boxes_.size());
  std::iota(order_.begin(), order_.end(), 0u);
  if (boxes_.empty()) return;
  struct Task {
    std::uint32_t begin, end, parent;  // parent: whose second child this is
  };
  std::vector<Task> tasks{{0, static_cast<std::uint32_t>(boxes_.size()), kNoParent}};
  while (!tasks.empty()) {
    const Task task = tasks.back();
    tasks.pop_back();
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    if (task.parent != kNoParent) nodes_[task.parent].first = index;
    Node node{boxes_[order_[task.begin]], task.begin, task.end - task.begin};
    const auto centre = [&](std::uint32_t caster, int k) {
      return boxes_[caster].low[k] + boxes_[caster].high[k];
    };
    std::array<double, 3> least{}, most{};
    for (std::uint32_t i = task.begin; i < task.end; ++i) {
      extend(node.box, boxes_[order_[i]]);
      for (int k = 0; k < 3; ++k) {
        const double value = centre(order_[i], k);
        least[k] = i == task.begin ? value : std::min(least[k], value);
        most[k] = i == task.begin ? value : std::max(most[k], value);
      }
    }
    if (node.count > kLeafSize) {
      node.count = 0;
      int axis = 0;
      for (int k = 1; k < 3; ++k) {
        if (most[k] - least[k] > most[axis] - least[axis]) axis = k;
      }
      const std::uint32_t middle = task.begin + (task.end - task.begin) / 2;
      std::nth_element(order_.begin() + task.begin, order_.begin() + middle,
                       order_.begin() + task.end, [&](std::uint32_t a, std::uint32_t b) {
                         return std::pair(centre(a, axis), a) < std::pair(centre(b, axis), b);
                       });
      tasks.push_back({middle, task.end, index});
      tasks.push_back({task.begin, middle, kNoParent});
    }
    nodes_.push_back(node);
  }
}

void ShaftTree::find(const LightShaft& shaft, std::vector<std::uint32_t>& found) const {
  if (nodes_.empty()) return;
  std::vector<std::uint32_t> stack{0};
  while (!stack.empty()) {
    const std::uint32_t index = stack.back();
    stack.pop_back();
    const Node& node = nodes_[index];
    if (shaft.misses(node.box)) continue;
    if (node.count == 0) {
      stack.push_back(node.first);
      stack.push_back(index + 1);
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      if (!shaft.misses(boxes_[order_[i]])) found.push_back(order_[i]);
    }
  }
}

}  // namespace gnomon
