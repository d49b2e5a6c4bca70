// SPDX-License-Identifier: LGPL-3.0-or-later
// Many outlines on one receiver: the chart is halved into cells until few outlines meet in one, and
// edges are taken cell by cell. Only edges are cut where cells meet, at one place for both sides,
// so that a cell keeps nothing and its border adds nothing. A cell that one outline holds has no
// edge that is seen.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "algorithms/area_contour/outline_union.h"

namespace gnomon::area_contour {
namespace {

/// Cells with more outlines are halved if that keeps some apart, in the middle of some of their
/// ends.
constexpr std::uint32_t kLeaf = 64, kAsked = 64;
constexpr int kDeepest = 40, kMostInVain = 4;
/// Of the receiver's size: cells do not meet where outlines end.
constexpr double kAside = 0.7351e-7;

}  // namespace

/// Whether all that lies in the cell is inside of one outline.
bool OutlineUnion::is_held(const Cell& cell) const {
  const double low[] = {cell.box.low[0] - margin_, cell.box.low[1] - margin_};
  const double high[] = {cell.box.high[0] + margin_, cell.box.high[1] + margin_};
  for (std::uint32_t i = cell.first_outline; i < cell.end_outline; ++i) {
    const Outline& outline = outlines_[cell_outlines_[i]];
    if (outline.box.low[0] > low[0] || outline.box.low[1] > low[1] ||
        outline.box.high[0] < high[0] || outline.box.high[1] < high[1]) {
      continue;
    }
    bool holds = true;
    for (std::uint32_t k = outline.first; holds && k < outline.first + outline.count; ++k) {
      const OutlineLine& line = lines_[k];
      const double least = line.a * (line.a > 0 ? low[0] : high[0]) +
                           line.b * (line.b > 0 ? low[1] : high[1]) + line.c;
      holds = least > line.error + slack_;
    }
    if (holds) return true;
  }
  return false;
}

/// Puts a part of an edge, or two of it, where it lies of a line across an axis.
void OutlineUnion::divide(const Part& part, int axis, double at) {
  const OutlineLine& line = lines_[edges_[part.edge].line];
  const double origin = -line.c * (axis == 0 ? line.a : line.b);
  const double slope = axis == 0 ? line.b : -line.a;
  const double from = origin + slope * part.from, to = origin + slope * part.to;
  if (from <= at && to <= at) {
    low_edges_.push_back(part);
  } else if (from >= at && to >= at) {
    high_edges_.push_back(part);
  } else {
    const double place = std::clamp((at - origin) / slope, part.from, part.to);
    (slope > 0 ? low_edges_ : high_edges_).push_back({part.edge, part.from, place});
    (slope > 0 ? high_edges_ : low_edges_).push_back({part.edge, place, part.to});
  }
}

/// The edge, ended where cells meet.
OutlineUnion::Edge OutlineUnion::edge_of(const Part& part) const {
  Edge edge = edges_[part.edge];
  Stretch& stretch = edge.stretch;
  const bool begins = part.from > stretch.low.outer, ends = part.to < stretch.high.outer;
  if (begins) {
    if (stretch.low.inner <= part.from) stretch.low = {part.from, part.from};
    stretch.low.outer = part.from;
  }
  if (ends) {
    if (stretch.high.inner >= part.to) stretch.high = {part.to, part.to};
    stretch.high.outer = part.to;
  }
  if (begins || ends) edge.box = box_of(lines_[edge.line], part.from, part.to);
  return edge;
}

/// Halves the cell between the ends of its outlines' boxes, across its longer side. False if that
/// keeps none apart.
bool OutlineUnion::halve(const Cell& cell, std::vector<Cell>& cells) {
  const double width = cell.box.high[0] - cell.box.low[0],
               height = cell.box.high[1] - cell.box.low[1];
  const int axis = width >= height ? 0 : 1;
  ends_.clear();
  const std::uint32_t every = 1 + (cell.end_outline - cell.first_outline) / kAsked;
  for (std::uint32_t i = cell.first_outline; i < cell.end_outline; i += every) {
    const Box& box = outlines_[cell_outlines_[i]].box;
    for (const double end : {box.low[axis], box.high[axis]}) {
      if (end > cell.box.low[axis] && end < cell.box.high[axis]) ends_.push_back(end);
    }
  }
  if (ends_.empty()) return false;
  const auto middle = ends_.begin() + static_cast<std::ptrdiff_t>(ends_.size() / 2);
  std::nth_element(ends_.begin(), middle, ends_.end());
  const double at = *middle + kAside * receiver_->reach;
  if (!(at > cell.box.low[axis]) || !(at < cell.box.high[axis])) return false;
  low_edges_.clear();
  high_edges_.clear();
  for (std::uint32_t i = cell.first_edge; i < cell.end_edge; ++i) {
    divide(cell_edges_[i], axis, at);
  }
  high_outlines_.clear();
  Cell low = cell, high = cell;
  low.box.high[axis] = high.box.low[axis] = at;
  low.depth = high.depth = cell.depth + 1;
  // The cell's own lists are needed no more once the children's are known; the high one's lie
  // below, since the low one is taken first.
  const std::uint32_t count = cell.end_outline - cell.first_outline;
  std::uint32_t lows = 0;
  for (std::uint32_t i = cell.first_outline; i < cell.end_outline; ++i) {
    const std::uint32_t outline = cell_outlines_[i];
    const Box& box = outlines_[outline].box;
    if (box.high[axis] >= at - margin_) high_outlines_.push_back(outline);
    if (box.low[axis] <= at + margin_) cell_outlines_[cell.first_outline + lows++] = outline;
  }
  const auto highs = static_cast<std::uint32_t>(high_outlines_.size());
  low.in_vain = 10 * lows > 9 * count ? cell.in_vain + 1 : 0;
  high.in_vain = 10 * highs > 9 * count ? cell.in_vain + 1 : 0;
  cell_outlines_.resize(cell.first_outline + lows);
  cell_outlines_.insert(cell_outlines_.begin() + cell.first_outline, high_outlines_.begin(),
                        high_outlines_.end());
  high.first_outline = cell.first_outline;
  high.end_outline = low.first_outline = cell.first_outline + highs;
  low.end_outline = low.first_outline + lows;
  cell_edges_.resize(cell.first_edge);
  cell_edges_.insert(cell_edges_.end(), high_edges_.begin(), high_edges_.end());
  high.first_edge = cell.first_edge;
  high.end_edge = low.first_edge = static_cast<std::uint32_t>(cell_edges_.size());
  cell_edges_.insert(cell_edges_.end(), low_edges_.begin(), low_edges_.end());
  low.end_edge = static_cast<std::uint32_t>(cell_edges_.size());
  cells.push_back(high);
  cells.push_back(low);
  return true;
}

void OutlineUnion::add_cells() {
  const auto count = static_cast<std::uint32_t>(outlines_.size());
  cell_outlines_.resize(count);
  std::iota(cell_outlines_.begin(), cell_outlines_.end(), 0u);
  // The largest first, since they hide most.
  sizes_.clear();
  for (const Outline& outline : outlines_) {
    const Box& box = outline.box;
    sizes_.push_back((box.high[0] - box.low[0]) * (box.high[1] - box.low[1]));
  }
  std::ranges::stable_sort(cell_outlines_, std::greater{},
                           [&](std::uint32_t outline) { return sizes_[outline]; });
  if (count <= kLeaf) {
    for (const Edge& edge : edges_) add_edge(edge, cell_outlines_);
    return;
  }
  margin_ = 4 * slack_;
  for (const OutlineLine& line : lines_) margin_ = std::max(margin_, 4 * slack_ + line.error);
  cell_edges_.clear();
  for (std::uint32_t i = 0; i < edges_.size(); ++i) {
    cell_edges_.push_back({i, edges_[i].stretch.low.outer, edges_[i].stretch.high.outer});
  }
  Cell whole{outlines_[0].box, 0, count, 0, static_cast<std::uint32_t>(edges_.size())};
  for (const Outline& outline : outlines_) {
    for (int k = 0; k < 2; ++k) {
      whole.box.low[k] = std::min(whole.box.low[k], outline.box.low[k]);
      whole.box.high[k] = std::max(whole.box.high[k], outline.box.high[k]);
    }
  }
  std::vector<Cell> cells{whole};
  while (!cells.empty()) {
    const Cell cell = cells.back();
    cells.pop_back();
    cell_outlines_.resize(cell.end_outline);
    cell_edges_.resize(cell.end_edge);
    if (cell.first_edge == cell.end_edge || is_held(cell)) continue;
    if (cell.end_outline - cell.first_outline > kLeaf && cell.depth < kDeepest &&
        cell.in_vain < kMostInVain && halve(cell, cells)) {
      continue;
    }
    const std::span<const std::uint32_t> others{cell_outlines_.data() + cell.first_outline,
                                                cell.end_outline - cell.first_outline};
    for (std::uint32_t i = cell.first_edge; i < cell.end_edge; ++i) {
      add_edge(edge_of(cell_edges_[i]), others);
    }
  }
}

}  // namespace gnomon::area_contour
