// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/geometry/box_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace gnomon::oracle {

BoxTree::BoxTree(std::vector<PlanarBox> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  if (!boxes_.empty()) grow(0, static_cast<std::uint32_t>(boxes_.size()));
}

void BoxTree::grow(std::uint32_t first, std::uint32_t last) {
  constexpr std::uint32_t kLeaf = 6;
  const auto at = static_cast<std::uint32_t>(nodes_.size());
  PlanarBox box = boxes_[order_[first]];
  for (std::uint32_t i = first + 1; i < last; ++i) {
    const PlanarBox& own = boxes_[order_[i]];
    box.low = {std::min(box.low.x, own.low.x), std::min(box.low.y, own.low.y)};
    box.high = {std::max(box.high.x, own.high.x), std::max(box.high.y, own.high.y)};
  }
  nodes_.push_back({box, first, last, 0});
  if (last - first <= kLeaf) return;
  const bool wide = box.high.x - box.low.x >= box.high.y - box.low.y;
  const std::uint32_t middle = first + (last - first) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const PlanarBox &p = boxes_[a], &q = boxes_[b];
                     return wide ? p.low.x + p.high.x < q.low.x + q.high.x
                                 : p.low.y + p.high.y < q.low.y + q.high.y;
                   });
  grow(first, middle);
  nodes_[at].second = static_cast<std::uint32_t>(nodes_.size());
  grow(middle, last);
}

}  // namespace gnomon::oracle
