// SPDX-License-Identifier: LGPL-3.0-or-later
// Many outlines on one receiver: the chart is halved into cells until few outlines meet in one.
// Only then are edges cut where cells meet, at one place for both sides, so that a cell keeps
// nothing and its border adds nothing. A cell that one outline holds has no edge that is seen.
#include <algorithm>
#include <cmath>

#include "algorithms/area_contour/four_doubles.h"
#include "algorithms/area_contour/outline_union.h"

namespace gnomon::area_contour {
namespace {

/// Cells with more outlines are halved if that keeps some apart, in the middle of some of their
/// ends.
constexpr std::uint32_t kLeaf = 128, kAsked = 64, kHolders = 3;
constexpr int kDeepest = 40, kMostInVain = 4;
/// Of the receiver's size: cells do not meet where outlines end.
constexpr double kAside = 0.7351e-7;
/// Lines that turn less against an axis run along it.
constexpr double kAlong = 0x1p-900;

}  // namespace

inline float OutlineUnion::size_of(const Box& box) {
  return (box.high[0] - box.low[0]) * (box.high[1] - box.low[1]);
}

/// Whether all of a rectangle is certainly inside of an outline.
GNOMON_FOR_AVX2 bool OutlineUnion::holds(const Outline& outline, const double (&low)[2],
                                         const double (&high)[2]) const {
  for (std::uint32_t i = outline.first; i < outline.end; ++i) {
    const Doubles &a = row(blocks_[i].a), &b = row(blocks_[i].b);
    const Doubles x = a > 0 ? a * low[0] : a * high[0], y = b > 0 ? b * low[1] : b * high[1];
    const Bits inside = x + y + row(blocks_[i].c) > row(blocks_[i].error) + slack_;
    if (!all(inside)) return false;
  }
  return true;
}

/// Where the box around an outline ends in a cell; beyond all numbers where it does not.
inline OutlineUnion::Box OutlineUnion::ends_in(const Cell& cell, const Outline& outline) const {
  Box ends = kEverything;
  for (int k = 0; k < 2; ++k) {
    if (cell.low[k] - margin_ < outline.box.low[k]) ends.low[k] = outline.box.low[k];
    if (cell.high[k] + margin_ > outline.box.high[k]) ends.high[k] = outline.box.high[k];
  }
  return ends;
}

/// Whether a box and the cell have more in common than the inside of an outline. `ends`: those of
/// its box in the cell.
inline bool OutlineUnion::is_outside(const Outline& outline, const Cell& cell, const Box& ends,
                                     const Box& box) const {
  const bool leaves = (box.low[0] < ends.low[0]) | (box.low[1] < ends.low[1]) |
                      (box.high[0] > ends.high[0]) | (box.high[1] > ends.high[1]);
  if (leaves) return true;
  double low[2], high[2];
  for (int k = 0; k < 2; ++k) {
    low[k] = std::max<double>(box.low[k], cell.low[k] - margin_);
    high[k] = std::min<double>(box.high[k], cell.high[k] + margin_);
  }
  return !holds(outline, low, high);
}

/// Drops outlines that a large one holds in the cell: it hides their edges and what they hide. True
/// if one holds all of the cell.
bool OutlineUnion::drop_held(Cell& cell) {
  const double area = (cell.high[0] - cell.low[0]) * (cell.high[1] - cell.low[1]);
  for (std::uint32_t i = cell.first; i < cell.end; ++i) {
    const Outline& holder = outlines_[members_[i].outline];
    // The largest come first, and sizes are rounded by far less than that.
    if (i >= cell.first + kHolders && size_of(members_[i].box) < 0.999 * area) break;
    const Box ends = ends_in(cell, holder);
    if (!is_outside(holder, cell, ends, kEverything)) return true;
    if (i >= cell.first + kHolders) continue;
    std::uint32_t end = i + 1;
    for (std::uint32_t k = end; k < cell.end; ++k) {
      if (is_outside(holder, cell, ends, members_[k].box)) members_[end++] = members_[k];
    }
    cell.end = end;
  }
  members_.resize(cell.end);
  return false;
}

/// Of each edge what lies in the cell; from >= to where that is nothing. The place where an edge
/// meets a border depends on the two alone, so that cells on both sides have it. Its coordinate
/// there is off by less than the slack.
GNOMON_FOR_AVX2 void OutlineUnion::clip(const LineBlock& block, const Cell& cell,
                                        LineBlock& part) const {
  Doubles from = row(block.from), to = row(block.to);
  for (int axis = 0; axis < 2; ++axis) {
    const Doubles origin = -row(block.c) * (axis == 0 ? row(block.a) : row(block.b));
    const Doubles slope = axis == 0 ? row(block.b) : -row(block.a);
    const Bits rises = slope > kAlong, falls = slope < -kAlong;
    const Doubles inverse = 1 / slope;
    const Doubles enters = (cell.low[axis] - origin) * inverse,
                  leaves = (cell.high[axis] - origin) * inverse;
    from = (rises & (enters > from)) ? enters : (falls & (leaves > from)) ? leaves : from;
    to = (rises & (leaves < to)) ? leaves : (falls & (enters < to)) ? enters : to;
    const Bits is_beside =
        ~rises & ~falls & ((origin <= cell.low[axis]) | (origin > cell.high[axis]));
    to = is_beside ? from : to;
  }
  row(part.from) = from;
  row(part.to) = to;
}

/// Halves the cell between the ends of its outlines' boxes, across its longer side. False if that
/// keeps none apart.
bool OutlineUnion::halve(const Cell& cell) {
  const int axis = cell.high[0] - cell.low[0] >= cell.high[1] - cell.low[1] ? 0 : 1;
  ends_.clear();
  const std::uint32_t every = 1 + (cell.end - cell.first) / kAsked;
  for (std::uint32_t i = cell.first; i < cell.end; i += every) {
    const Box& box = members_[i].box;
    for (const double end : {box.low[axis], box.high[axis]}) {
      if (end > cell.low[axis] && end < cell.high[axis]) ends_.push_back(end);
    }
  }
  if (ends_.empty()) return false;
  const auto middle = ends_.begin() + static_cast<std::ptrdiff_t>(ends_.size() / 2);
  std::nth_element(ends_.begin(), middle, ends_.end());
  const double at = *middle + kAside * receiver_->reach;
  if (!(at > cell.low[axis]) || !(at < cell.high[axis])) return false;
  // The cell's own list is needed no more once the children's are known; the high one's lies below,
  // since the low one is taken first.
  high_members_.clear();
  const std::uint32_t count = cell.end - cell.first;
  std::uint32_t lows = 0;
  for (std::uint32_t i = cell.first; i < cell.end; ++i) {
    const Member member = members_[i];
    if (member.box.high[axis] >= at - margin_) high_members_.push_back(member);
    if (member.box.low[axis] <= at + margin_) members_[cell.first + lows++] = member;
  }
  const auto highs = static_cast<std::uint32_t>(high_members_.size());
  Cell low = cell, high = cell;
  low.high[axis] = high.low[axis] = at;
  low.depth = high.depth = cell.depth + 1;
  low.in_vain = 10 * lows > 9 * count ? cell.in_vain + 1 : 0;
  high.in_vain = 10 * highs > 9 * count ? cell.in_vain + 1 : 0;
  members_.resize(cell.first + lows);
  members_.insert(members_.begin() + cell.first, high_members_.begin(), high_members_.end());
  high.end = low.first = cell.first + highs;
  low.end = low.first + lows;
  cells_.push_back(high);
  cells_.push_back(low);
  return true;
}

/// Adds what is seen of the edges of a cell's outlines, of those that are cut that in the cell.
void OutlineUnion::add_leaf(const Cell& cell, bool is_cut) {
  leaf_.clear();
  for (std::uint32_t i = cell.first; i < cell.end; ++i) {
    const std::uint32_t k = (i - cell.first) % 8;
    if (k == 0) {
      BoxBlock& block = leaf_.emplace_back();
      std::ranges::fill(block.x[0], std::numeric_limits<float>::infinity());
    }
    BoxBlock& block = leaf_.back();
    const auto& [box, outline] = members_[i];
    block.x[0][k] = box.low[0];
    block.y[0][k] = box.low[1];
    block.x[1][k] = box.high[0];
    block.y[1][k] = box.high[1];
    block.outline[k] = outline;
  }
  LineBlock part;
  for (std::uint32_t i = cell.first; i < cell.end; ++i) {
    const std::uint32_t number = members_[i].outline;
    for (std::uint32_t b = outlines_[number].first; b < outlines_[number].end; ++b) {
      const LineBlock& block = blocks_[b];
      if (is_cut) clip(block, cell, part);
      const LineBlock& ends = is_cut ? part : block;
      for (std::uint32_t k = 0; k < 4; ++k) {
        if (ends.from[k] < ends.to[k]) {
          add_edge(edge_on(4 * b + k, number, ends.from[k], ends.to[k]));
        }
      }
    }
  }
}

/// All outlines, the largest first, since they hide most.
void OutlineUnion::sort_members() {
  order_.clear();
  for (const Outline& outline : outlines_) order_.add(size_of(outline.box));
  members_.clear();
  for (const std::uint32_t number : order_.sorted()) {
    members_.push_back({outlines_[number].box, number});
  }
}

void OutlineUnion::add_cells() {
  sort_members();
  margin_ = 4 * slack_ + most_error_;
  Cell whole;
  whole.end = static_cast<std::uint32_t>(members_.size());
  const bool is_cut = whole.end > kLeaf;
  for (int k = 0; k < 2; ++k) {
    whole.low[k] = kInfinity;
    whole.high[k] = -kInfinity;
    for (const Member& member : members_) {
      whole.low[k] = std::min<double>(whole.low[k], member.box.low[k]);
      whole.high[k] = std::max<double>(whole.high[k], member.box.high[k]);
    }
  }
  cells_.assign(1, whole);
  while (!cells_.empty()) {
    Cell cell = cells_.back();
    cells_.pop_back();
    members_.resize(cell.end);
    if (drop_held(cell)) continue;
    if (cell.end - cell.first > kLeaf && cell.depth < kDeepest && cell.in_vain < kMostInVain &&
        halve(cell)) {
      continue;
    }
    add_leaf(cell, is_cut);
  }
}

}  // namespace gnomon::area_contour
