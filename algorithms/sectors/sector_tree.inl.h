// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies of sector_tree.h, instantiated one kernel a source: this file has how cells are made and
// split, and includes the others.
#ifndef GNOMON_ALGORITHMS_SECTORS_SECTOR_TREE_INL_H
#define GNOMON_ALGORITHMS_SECTORS_SECTOR_TREE_INL_H

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/partition/kd_tree.h"
#include "algorithms/sectors/blots_leaf.h"
#include "algorithms/sectors/counting_leaf.h"
#include "algorithms/sectors/float_filters.h"
#include "algorithms/sectors/join.h"
#include "algorithms/sectors/sector_tree.h"
#include "algorithms/sectors/subtraction.h"
#include "algorithms/sectors/two_pass_leaf.h"

namespace gnomon {

// The planes x = y and x = -y, and z = s, z = -s for s = x, -x, y, -y.
template <SectorSpaceModel Space>
void SectorTree<Space>::add_sector_planes() {
  const auto add = [&](int axis, int sign, int other, int other_sign) {
    PrefixPlane plane;
    plane.n[static_cast<std::size_t>(axis)] = sign;
    plane.n[static_cast<std::size_t>(other)] = other_sign;
    return space_.add_prefix_plane(plane);
  };
  if (context_->light.directional || is_far_) {
    // There are no sectors, but a plane is added so that cell planes have a first number.
    sector_planes_[0] = add(0, 1, 2, 0);
    first_cell_plane_ = sector_planes_[0].index();
    return;
  }
  sector_planes_[0] = add(0, 1, 1, -1);
  first_cell_plane_ = sector_planes_[0].index();
  sector_planes_[1] = add(0, 1, 1, 1);
  for (int i = 0; i < 4; ++i) {
    const int major = i / 2, sign = i % 2 == 0 ? 1 : -1;
    sector_planes_[static_cast<std::size_t>(2 + 2 * i)] = add(major, sign, 2, -1);
    sector_planes_[static_cast<std::size_t>(3 + 2 * i)] = add(major, sign, 2, 1);
  }
}

template <SectorSpaceModel Space>
SectorCell SectorTree<Space>::root_cell() const {
  SectorCell cell;
  if (context_->light.directional) {
    cell.level = SectorCell::kChart;
    const int z = LightAxes::of(context_->light).z;
    cell.chart = {0, 1, 2, sgn(context_->light.grid[static_cast<std::size_t>(z)])};
  } else if (const std::optional<LightChart> chart = far_chart()) {
    cell.level = SectorCell::kChart;
    cell.chart = *chart;
  }
  return cell;
}

template <SectorSpaceModel Space>
PlaneRef SectorTree<Space>::add_split_plane(const ChartSplit& split, const LightChart& chart) {
  const PrefixPlane plane = plane_of(split, chart, context_->light.directional || is_far_,
                                     context_->scene.geometry.grid.bits());
  if constexpr (requires { space_.add_plane_of_far_chart(plane); }) {
    if (is_far_) return space_.add_plane_of_far_chart(plane);
  }
  return space_.add_prefix_plane(plane);
}

template <SectorSpaceModel Space>
SectorCell SectorTree<Space>::cell_of(const LoopView<Vertex>& loop) {
  SectorCell cell = root_cell();
  while (cell.level < SectorCell::kChart) {
    SectorCell above, below;
    const PlaneRef plane = next_sector_plane(cell, above, below);
    const Placement placement = record_.decide(space_, plane, loop);
    if (placement == Placement::kSpanning) break;
    cell = placement == Placement::kFront ? above : below;
  }
  return cell;
}

template <SectorSpaceModel Space>
std::vector<typename SectorTree<Space>::Task> SectorTree<Space>::plan(std::vector<SectorItem> items,
                                                                      const SectorCell& cell,
                                                                      bool located,
                                                                      std::uint32_t task_size) {
  items_ = std::move(items);
  states_.assign(items_.size(), kUndecided);
  root_size_ = items_.size();
  std::vector<Task> tasks;
  Frame root;
  root.cell = cell;
  root.located = located;
  root.end = static_cast<std::uint32_t>(items_.size());
  stack_.assign(1, root);
  descend(task_size, &tasks);
  return tasks;
}

template <SectorSpaceModel Space>
void SectorTree<Space>::set_states(const Task& task) {
  std::copy(task.states.begin(), task.states.end(), states_.begin() + task.begin);
}

template <SectorSpaceModel Space>
std::span<const SectorState> SectorTree<Space>::finish() {
  for (const Range& children : joins_) join(children);
  return {states_.data(), root_size_};
}

template <SectorSpaceModel Space>
void SectorTree<Space>::run(Task& task, const SectorTree& planner) {
  items_.assign(planner.items_.begin() + task.begin, planner.items_.begin() + task.end);
  // Items move about in their cell; `parent` says which they are.
  for (std::uint32_t i = 0; i < items_.size(); ++i) {
    items_[i].first = loops_.append(planner.view(items_[i])).first;
    items_[i].parent = i;
  }
  states_.assign(items_.size(), kUndecided);
  for (const PlaneRef edge : task.edges) set_bounds_cell(edge, true);
  Frame root;
  root.cell = task.cell;
  root.end = static_cast<std::uint32_t>(items_.size());
  root.located = task.cell.level == SectorCell::kChart;
  stack_.assign(1, root);
  descend(0, nullptr);
  task.states.assign(items_.size(), kUndecided);
  for (std::size_t i = 0; i < items_.size(); ++i) task.states[items_[i].parent] = states_[i];
  for (const PlaneRef edge : task.edges) set_bounds_cell(edge, false);
  loops_.clear();
  exact_areas_.clear();
}

// Puts a cell on the stack if it has items. Takes it by value, because the stack may move.
template <SectorSpaceModel Space>
void SectorTree<Space>::enter(SectorCell cell, Range items, bool located) {
  if (items.begin == items.end) return;
  Frame frame;
  frame.cell = cell;
  frame.begin = items.begin;
  frame.end = items.end;
  frame.located = located;
  stack_.push_back(frame);
}

template <SectorSpaceModel Space>
void SectorTree<Space>::descend(std::uint32_t task_size, std::vector<Task>* tasks) {
  while (!stack_.empty() && !stopped()) {
    Frame& frame = stack_.back();
    if (frame.stage == 0) {
      ++output_.nodes;
      if (!frame.located && frame.cell.level == SectorCell::kChart) {
        for (std::uint32_t i = frame.begin; i < frame.end; ++i) {
          locate(frame.cell.chart, items_[i]);
        }
        frame.located = true;
      }
      const std::uint32_t open_end =
          context_->leaf_method == LeafMethod::kSubtract ? cull(frame.begin, frame.end) : frame.end;
      const bool receives = std::any_of(items_.begin() + frame.begin, items_.begin() + open_end,
                                        [](const SectorItem& item) { return item.receives != 0; });
      if (!receives && open_end > frame.begin) {
        stack_.pop_back();
        continue;
      }
      const std::uint32_t open = open_end - frame.begin;
      if (open > 0 && tasks != nullptr && open <= task_size) {
        tasks->push_back({frame.cell, splitting_edges(), frame.begin, open_end, {}});
        stack_.pop_back();
        continue;
      }
      const bool is_leaf = is_small(open) && tasks == nullptr && !wants_chart(frame.cell);
      if (open == 0 || is_leaf || !split(frame, open_end)) {
        leaf(frame.begin, open_end, frame.located ? &frame.cell.chart : nullptr);
        stack_.pop_back();
        continue;
      }
      frame.stage = 1;
      if (frame.edge.valid()) set_bounds_cell(frame.edge, true);
      enter(frame.front_cell, {frame.middle, frame.children_end}, frame.located);
    } else if (frame.stage == 1) {
      frame.stage = 2;
      enter(frame.back_cell, {frame.children, frame.middle}, frame.located);
    } else {
      const Range children{frame.children, frame.children_end};
      if (frame.edge.valid()) set_bounds_cell(frame.edge, false);
      if (tasks != nullptr) {
        joins_.push_back(children);
      } else {
        join(children);
        items_.resize(children.begin);
        states_.resize(children.begin);
        loops_.truncate(frame.loops_mark);
        space_.release_planes(frame.planes_mark);
      }
      stack_.pop_back();
    }
  }
}

template <SectorSpaceModel Space>
bool SectorTree<Space>::split(Frame& frame, std::uint32_t open_end) {
  frame.loops_mark = loops_.size();
  frame.planes_mark = space_.plane_mark();
  while (frame.cell.level < SectorCell::kChart) {
    if (split_by_sector_plane(frame, open_end)) return true;
  }
  if (!frame.located) {
    for (std::uint32_t i = frame.begin; i < open_end; ++i) locate(frame.cell.chart, items_[i]);
    frame.located = true;
  }
  if (context_->leaf_method == LeafMethod::kBlots && is_small(open_end - frame.begin)) return false;
  const bool by_contour = !context_->contour.empty();
  if (by_contour ? split_by_edge(frame, open_end, true) : split_by_axis(frame, open_end)) {
    return true;
  }
  const std::uint32_t size = open_end - frame.begin;
  return size > std::size_t{kLargeLeaf} * context_->options.tuning.leaf_size &&
         split_by_edge(frame, open_end, false);
}

/// At the value of an axis of the chart. Requires: the items have boxes.
template <SectorSpaceModel Space>
bool SectorTree<Space>::split_by_axis(Frame& frame, std::uint32_t open_end) {
  const std::uint32_t size = open_end - frame.begin;
  const std::optional<ChartSplit> chosen = chooser_.choose({items_.data() + frame.begin, size});
  if (!chosen) return false;
  const PlaneRef plane = add_split_plane(*chosen, frame.cell.chart);
  frame.front_cell = frame.back_cell = frame.cell;
  partition(frame, open_end, plane, &*chosen);
  // Boxes are only bounds, and the plane's value was rounded: the plane may separate nothing, and
  // then would separate nothing the next time either.
  const std::uint32_t back = frame.middle - frame.children;
  const std::uint32_t front = frame.children_end - frame.middle;
  if (std::max(back, front) < size) return true;
  items_.resize(frame.children);
  states_.resize(frame.children);
  loops_.truncate(frame.loops_mark);
  space_.release_planes(frame.planes_mark);
  return false;
}

/// By the plane of an edge, which bounds the cells below from then on.
template <SectorSpaceModel Space>
bool SectorTree<Space>::split_by_edge(Frame& frame, std::uint32_t open_end, bool of_contour) {
  frame.edge = choose_edge_plane(frame.begin, open_end, of_contour);
  if (!frame.edge.valid()) return false;
  frame.front_cell = frame.back_cell = frame.cell;
  partition(frame, open_end, frame.edge, nullptr);
  return true;
}

/// Of the frames on the stack.
template <SectorSpaceModel Space>
std::vector<PlaneRef> SectorTree<Space>::splitting_edges() const {
  std::vector<PlaneRef> edges;
  for (const Frame& frame : stack_) {
    if (frame.edge.valid()) edges.push_back(frame.edge);
  }
  return edges;
}

// Returns the next of the planes between the sectors, and the cells on its two sides.
template <SectorSpaceModel Space>
PlaneRef SectorTree<Space>::next_sector_plane(const SectorCell& cell, SectorCell& above,
                                              SectorCell& below) const {
  above = below = cell;
  const bool x_rules = cell.above_first == cell.above_second;
  const int sign = cell.above_second ? 1 : -1, major = x_rules ? 0 : 1;
  const auto wedge = static_cast<std::size_t>(2 * (2 * major + (sign > 0 ? 0 : 1)));
  ++above.level;
  ++below.level;
  switch (cell.level) {
    case 0:
      above.above_first = true;
      return sector_planes_[0];
    case 1:
      above.above_second = true;
      return sector_planes_[1];
    case 2:  // s - z: below it is the sector around +z
      below.level = SectorCell::kChart;
      below.chart = {0, 1, 2, 1};
      return sector_planes_[2 + wedge];
    default:  // s + z
      below.chart = {0, 1, 2, -1};
      above.chart = {2, 1 - major, major, sign};
      return sector_planes_[3 + wedge];
  }
}

// Splits a cell by the next of the planes between the sectors. Returns false if all items are on
// one side, which becomes the frame's cell.
template <SectorSpaceModel Space>
bool SectorTree<Space>::split_by_sector_plane(Frame& frame, std::uint32_t open_end) {
  SectorCell above, below;
  const PlaneRef plane = next_sector_plane(frame.cell, above, below);
  bool front = false, back = false;
  for (std::uint32_t i = frame.begin; i < open_end; ++i) {
    const Placement placement = record_.decide(space_, plane, view(items_[i]));
    front |= placement == Placement::kFront || placement == Placement::kSpanning;
    back |= placement != Placement::kFront;
  }
  if (!front || !back) {
    frame.cell = front ? above : below;
    return false;
  }
  frame.front_cell = above;
  frame.back_cell = below;
  partition(frame, open_end, plane, nullptr);
  return true;
}

// Many polygons around one direction are separated by no box, but perhaps by one of their own
// edges. Chooses the edge, of the contour if so asked, that splits a sample best; none if no edge
// pays.
template <SectorSpaceModel Space>
PlaneRef SectorTree<Space>::choose_edge_plane(std::uint32_t begin, std::uint32_t end,
                                              bool of_contour) {
  constexpr std::uint32_t kSample = 64, kCandidates = 8;
  const std::uint32_t n = end - begin;
  const std::uint32_t stride = std::max(1u, n / kSample);
  std::uint32_t sampled = 0;
  for (std::uint32_t i = begin; i < end; i += stride) ++sampled;
  PlaneRef best;
  double best_cost = kSplitGrowth * 0.9 * n_log_n(sampled);
  const auto consider = [&](PlaneRef plane) {
    std::size_t front = 0, back = 0;
    for (std::uint32_t i = begin; i < end; i += stride) {
      const Placement placement = record_.decide(space_, plane, view(items_[i]));
      front += placement == Placement::kFront || placement == Placement::kSpanning;
      back += placement != Placement::kFront;
    }
    const double cost = n_log_n(front) + n_log_n(back);
    if (front < sampled && back < sampled && cost < best_cost) {
      best_cost = cost;
      best = plane;
    }
  };
  // Most edges are of no contour: more polygons are asked then, and one edge of each is tried.
  const std::uint32_t candidates = of_contour ? std::min(n, 4 * kCandidates) : kCandidates;
  for (std::uint32_t c = 0; c < candidates; ++c) {
    const SectorItem& item = items_[begin + static_cast<std::uint32_t>(
                                                std::uint64_t{n} * (2 * c + 1) / (2 * candidates))];
    for (std::uint32_t e = 0; e < item.count; ++e) {
      const PlaneRef plane = loops_.edge(item.first + (e + c) % item.count);
      if (is_cell_plane(plane) || (of_contour && !is_of_contour(plane))) continue;
      consider(plane);
      if (of_contour) break;
    }
  }
  return best;
}

// Makes the children of the open items: first those behind the plane, then those in front. If
// `split` is given, boxes decide what they can.
template <SectorSpaceModel Space>
void SectorTree<Space>::partition(Frame& frame, std::uint32_t open_end, PlaneRef plane,
                                  const ChartSplit* split) {
  frame.children = static_cast<std::uint32_t>(items_.size());
  front_items_.clear();
  const auto axis = static_cast<std::size_t>(split != nullptr ? split->axis : 0);
  for (std::uint32_t i = frame.begin; i < open_end; ++i) {
    SectorItem child = items_[i];
    child.parent = i;
    if (frame.edge.valid()) child.fresh = 1;  // the cell may end at its own edge
    Placement placement;
    if (split != nullptr && static_cast<double>(child.low[axis]) >= split->value) {
      placement = Placement::kFront;
    } else if (split != nullptr && static_cast<double>(child.high[axis]) <= split->value) {
      placement = Placement::kBack;
    } else {
      placement = record_.decide(space_, plane, view(child));
    }
    if (placement == Placement::kFront) {
      front_items_.push_back(child);
    } else if (placement != Placement::kSpanning) {
      items_.push_back(child);
    } else {
      ++output_.work[Counter::kCellCuts];
      loops_.reserve_more(2 * std::size_t{child.count} + 4);
      const SplitChildren pieces =
          make_children(space_, plane, view(child), record_, crossings_, loops_);
      child.fresh = covers(child) ? 0 : 1;  // culling by what covers both has been done
      const auto add = [&](const LoopRange& piece, const SectorCell& cell,
                           std::vector<SectorItem>& list) {
        if (piece.count < 3) {
          ++output_.vanished;
          return;
        }
        child.first = piece.first;
        child.count = piece.count;
        if (frame.located) locate(cell.chart, child);
        list.push_back(child);
      };
      add(pieces.back, frame.back_cell, items_);
      add(pieces.front, frame.front_cell, front_items_);
    }
  }
  frame.middle = static_cast<std::uint32_t>(items_.size());
  items_.insert(items_.end(), front_items_.begin(), front_items_.end());
  frame.children_end = static_cast<std::uint32_t>(items_.size());
  states_.resize(items_.size(), kUndecided);
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SECTORS_SECTOR_TREE_INL_H
