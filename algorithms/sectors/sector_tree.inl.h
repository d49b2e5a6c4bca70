// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies of sector_tree.h, instantiated one kernel a source.
#ifndef GNOMON_ALGORITHMS_SECTORS_SECTOR_TREE_INL_H
#define GNOMON_ALGORITHMS_SECTORS_SECTOR_TREE_INL_H

#include <cmath>

#include "algorithms/partition/fragment_stays.h"
#include "algorithms/sectors/sector_tree.h"

namespace gnomon {

/// A float that is not larger; exact bounds in doubles become certified floats. What is larger than
/// all floats has the largest below it, and not infinity.
inline float float_below(double x) {
  constexpr float kMost = std::numeric_limits<float>::max();
  const double below = x - std::fabs(x) * 0x1p-22 - 0x1p-140;
  if (below >= static_cast<double>(kMost)) return kMost;
  if (below <= -static_cast<double>(kMost)) return -std::numeric_limits<float>::infinity();
  return static_cast<float>(below);
}
inline float float_above(double x) { return -float_below(-x); }

// The planes x = y and x = -y, and z = s, z = -s for s = x, -x, y, -y.
template <SectorSpaceModel Space>
void SectorTree<Space>::add_sector_planes() {
  const auto add = [&](int axis, int sign, int other, int other_sign) {
    PrefixPlane plane;
    plane.n[static_cast<std::size_t>(axis)] = sign;
    plane.n[static_cast<std::size_t>(other)] = other_sign;
    return space_.add_prefix_plane(plane);
  };
  if (context_->light.directional) {
    // No sectors; a plane all the same, so that cell planes have a first number.
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
  }
  return cell;
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
  Frame root;
  root.cell = task.cell;
  root.end = static_cast<std::uint32_t>(items_.size());
  root.located = task.cell.level == SectorCell::kChart;
  stack_.assign(1, root);
  descend(0, nullptr);
  task.states.assign(items_.size(), kUndecided);
  for (std::size_t i = 0; i < items_.size(); ++i) task.states[items_[i].parent] = states_[i];
  loops_.clear();
  exact_areas_.clear();
}

// Puts a cell on the stack, if anything is in it. By value: what refers to the stack would move.
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
      const std::uint32_t open_end = cull(frame.begin, frame.end);
      const std::uint32_t open = open_end - frame.begin;
      if (open > 0 && tasks != nullptr && open <= task_size) {
        tasks->push_back({frame.cell, frame.begin, open_end, {}});
        stack_.pop_back();
        continue;
      }
      if (open == 0 || (open <= context_->options.leaf_size && tasks == nullptr) ||
          !split(frame, open_end)) {
        leaf(frame.begin, open_end, frame.located ? &frame.cell.chart : nullptr);
        stack_.pop_back();
        continue;
      }
      frame.stage = 1;
      enter(frame.front_cell, {frame.middle, frame.children_end}, frame.located);
    } else if (frame.stage == 1) {
      frame.stage = 2;
      enter(frame.back_cell, {frame.children, frame.middle}, frame.located);
    } else {
      const Range children{frame.children, frame.children_end};
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
void SectorTree<Space>::locate(const LightChart& chart, SectorItem& item) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const LoopView<Vertex> loop = view(item);
  std::array<double, 3> low{kInfinity, kInfinity, kInfinity};
  std::array<double, 3> high{-kInfinity, -kInfinity, -kInfinity};
  bool known = true;
  for (std::uint32_t i = 0; i < loop.size(); ++i) {
    const ChartPoint p = space_.chart_point(chart, loop.corner(i));
    low = {std::min(low[0], p.u - p.uv_error), std::min(low[1], p.v - p.uv_error),
           std::min(low[2], p.z - p.z_error)};
    high = {std::max(high[0], p.u + p.uv_error), std::max(high[1], p.v + p.uv_error),
            std::max(high[2], p.z + p.z_error)};
    known = known && p.uv_error < kInfinity && p.z_error < kInfinity;
  }
  const bool finite = known && std::fabs(low[0]) < kInfinity && std::fabs(low[1]) < kInfinity &&
                      std::fabs(high[0]) < kInfinity && std::fabs(high[1]) < kInfinity;
  if (!finite) {
    low = {-kInfinity, -kInfinity, -kInfinity};
    high = {kInfinity, kInfinity, kInfinity};
  }
  item.low = {float_below(low[0]), float_below(low[1])};
  item.high = {float_above(high[0]), float_above(high[1])};
  item.z_low = float_below(low[2]);
  item.z_high = float_above(high[2]);
}

/// All edges of the clipped polygon are the cell's own.
template <SectorSpaceModel Space>
bool SectorTree<Space>::covers(const SectorItem& item) const {
  for (std::uint32_t i = 0; i < item.count; ++i) {
    if (!is_cell_plane(loops_.edge(item.first + i))) return false;
  }
  return true;
}

// Whether a vertex of the item is nearer to the light than the plane, and whether one is behind it.
template <SectorSpaceModel Space>
bool SectorTree<Space>::any_nearer(const SectorItem& item, PlaneId plane, bool& any_behind) {
  const LoopView<Vertex> loop = view(item);
  const Side nearer =
      context_->facing.plane_signs[plane] == Sign::kPositive ? Side::kFront : Side::kBack;
  bool any = false;
  any_behind = false;
  for (std::uint32_t i = 0; i < loop.size(); ++i) {
    const Side side = space_.side_of_support(plane, loop.corner(i));
    any |= side == nearer;
    any_behind |= side == opposite(nearer);
  }
  return any;
}

/// No vertex of the item is nearer than the part's plane, and one is behind it.
template <SectorSpaceModel Space>
bool SectorTree<Space>::is_behind(const SectorItem& item, std::uint32_t part) {
  const PlaneId plane = context_->scene.parts[part].plane;
  if (context_->scene.parts[item.part].plane == plane) {
    return !context_->rules.on_goes_to_its_own_side;
  }
  const LoopView<Vertex> loop = view(item);
  const Side nearer =
      context_->facing.plane_signs[plane] == Sign::kPositive ? Side::kFront : Side::kBack;
  bool any = false;
  for (std::uint32_t i = 0; i < loop.size(); ++i) {
    const Side side = space_.side_of_support(plane, loop.corner(i));
    if (side == nearer) return false;
    any |= side != Side::kOn;
  }
  return any;
}

// How much of the receiver is behind the caster's plane, as far as both are in the cell: kNone also
// if the caster is nowhere in front of the receiver's plane. (Two polygons that do not cross have
// one of them on one side of the other's plane.)
template <SectorSpaceModel Space>
typename SectorTree<Space>::Relation SectorTree<Space>::relation(const SectorItem& receiver,
                                                                 const SectorItem& caster) {
  if (caster.z_high <= receiver.z_low) return Relation::kNone;
  if (receiver.z_high < caster.z_low) return Relation::kBehind;
  const PlaneId own = context_->scene.parts[receiver.part].plane;
  const PlaneId other = context_->scene.parts[caster.part].plane;
  if (own == other) {
    return context_->rules.on_goes_to_its_own_side ? Relation::kNone : Relation::kBehind;
  }
  bool behind = false;
  const bool nearer = any_nearer(receiver, other, behind);
  if (!behind) return Relation::kNone;
  if (!nearer) return Relation::kBehind;
  const bool caster_nearer = any_nearer(caster, own, behind);
  if (!caster_nearer) return Relation::kNone;
  return behind ? Relation::kCrossing : Relation::kBehind;
}

/// Keeps the undecided items of [begin, end) in front; returns their end.
template <SectorSpaceModel Space>
std::uint32_t SectorTree<Space>::move_decided_last(std::uint32_t begin, std::uint32_t end) {
  std::uint32_t open_end = begin;
  for (std::uint32_t i = begin; i < end; ++i) {
    if (states_[i] != kUndecided) continue;
    if (i != open_end) {
      std::swap(items_[i], items_[open_end]);
      std::swap(states_[i], states_[open_end]);
    }
    ++open_end;
  }
  return open_end;
}

// What is behind a polygon that covers the cell is in its shadow there.
template <SectorSpaceModel Space>
std::uint32_t SectorTree<Space>::cull(std::uint32_t begin, std::uint32_t end) {
  order_.clear();
  for (std::uint32_t i = begin; i < end; ++i) {
    if (!items_[i].fresh) continue;
    items_[i].fresh = 0;
    if (context_->scene.parts[items_[i].part].casts && covers(items_[i])) order_.push_back(i);
  }
  if (order_.empty()) return end;
  std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
    if (items_[a].z_high != items_[b].z_high) return items_[a].z_high > items_[b].z_high;
    return items_[a].part < items_[b].part;
  });
  for (const std::uint32_t cover : order_) {
    if (states_[cover] != kUndecided) continue;
    for (std::uint32_t i = begin; i < end; ++i) {
      if (i == cover || states_[i] != kUndecided) continue;
      // Only what is behind as a whole leaves; a leaf does the rest.
      const SectorItem& item = items_[i];
      const SectorItem& in_front = items_[cover];
      if (in_front.z_high <= item.z_low) continue;
      if (item.z_high < in_front.z_low || is_behind(item, in_front.part)) {
        states_[i] = in_front.part;
      }
    }
  }
  return move_decided_last(begin, end);
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
  const std::uint32_t size = open_end - frame.begin;
  if (const std::optional<SectorSplit> chosen =
          chooser_.choose({items_.data() + frame.begin, size})) {
    const PlaneRef plane =
        space_.add_prefix_plane(plane_of(*chosen, frame.cell.chart, context_->light.directional,
                                         context_->scene.geometry.grid.bits()));
    frame.front_cell = frame.back_cell = frame.cell;
    partition(frame, open_end, plane, &*chosen);
    // Boxes are only bounds, and the plane's value was rounded: it may be that nothing is
    // separated, and would not be the next time.
    const std::uint32_t back = frame.middle - frame.children;
    const std::uint32_t front = frame.children_end - frame.middle;
    if (std::max(back, front) < size) return true;
    items_.resize(frame.children);
    states_.resize(frame.children);
    loops_.truncate(frame.loops_mark);
    space_.release_planes(frame.planes_mark);
  }
  if (size > std::size_t{kLargeLeaf} * context_->options.leaf_size) {
    const PlaneRef plane = choose_edge_plane(frame.begin, open_end);
    if (plane.valid()) {
      frame.front_cell = frame.back_cell = frame.cell;
      partition(frame, open_end, plane, nullptr);
      return true;
    }
  }
  return false;
}

// The next of the planes between the sectors, and the cells on its two sides.
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

// By the next of the planes between the sectors. False: all items are on one side, which becomes
// the frame's cell.
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

// Many polygons around one direction: no box separates them, but their own edges may. The edge that
// splits a sample best; none if it does not pay.
template <SectorSpaceModel Space>
PlaneRef SectorTree<Space>::choose_edge_plane(std::uint32_t begin, std::uint32_t end) {
  constexpr std::uint32_t kSample = 64, kCandidates = 8;
  const std::uint32_t n = end - begin;
  const std::uint32_t stride = std::max(1u, n / kSample);
  std::uint32_t sampled = 0;
  for (std::uint32_t i = begin; i < end; i += stride) ++sampled;
  PlaneRef best;
  double best_cost = SplitChooser::kGrowth * 0.9 * n_log_n(sampled);
  for (std::uint32_t c = 0; c < kCandidates; ++c) {
    const SectorItem& item =
        items_[begin +
               static_cast<std::uint32_t>(std::uint64_t{n} * (2 * c + 1) / (2 * kCandidates))];
    for (std::uint32_t e = 0; e < item.count; ++e) {
      const PlaneRef plane = loops_.edge(item.first + e);
      if (is_cell_plane(plane)) continue;
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
    }
  }
  return best;
}

// Children of the open items: those behind the plane first, then those in front. With `split`,
// boxes decide what they can.
template <SectorSpaceModel Space>
void SectorTree<Space>::partition(Frame& frame, std::uint32_t open_end, PlaneRef plane,
                                  const SectorSplit* split) {
  frame.children = static_cast<std::uint32_t>(items_.size());
  front_items_.clear();
  const auto axis = static_cast<std::size_t>(split != nullptr ? split->axis : 0);
  for (std::uint32_t i = frame.begin; i < open_end; ++i) {
    SectorItem child = items_[i];
    child.parent = i;
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
      loops_.reserve_more(2 * std::size_t{child.count} + 4);
      const SplitChildren pieces =
          make_children(space_, plane, view(child), record_, crossings_, loops_);
      child.fresh = covers(child) ? 0 : 1;  // what covers both has been culled behind already
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

template <SectorSpaceModel Space>
ChartBox SectorTree<Space>::box_of(const LightChart& chart, const LoopView<Vertex>& loop) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double low_u = kInfinity, low_v = kInfinity, high_u = -kInfinity, high_v = -kInfinity;
  double error = 0;
  for (std::uint32_t i = 0; i < loop.size(); ++i) {
    const ChartPoint p = space_.chart_point(chart, loop.corner(i));
    low_u = std::min(low_u, p.u);
    low_v = std::min(low_v, p.v);
    high_u = std::max(high_u, p.u);
    high_v = std::max(high_v, p.v);
    error = std::max(error, p.uv_error);
  }
  if (!(error < kInfinity)) return {};
  ChartBox box;
  box.low = {float_below(low_u - error), float_below(low_v - error)};
  box.high = {float_above(high_u + error), float_above(high_v + error)};
  return box;
}

template <SectorSpaceModel Space>
void SectorTree<Space>::leaf(std::uint32_t begin, std::uint32_t end, const LightChart* chart) {
  order_.clear();
  for (std::uint32_t i = begin; i < end; ++i) {
    if (context_->scene.parts[items_[i].part].casts) order_.push_back(i);
  }
  // What hides most goes first, so that little is left for the others to cut. Where very many small
  // ones are, the nearest first: then most pairs need not be looked at.
  const auto area = [](const ChartBox& box) {
    return (box.high[0] - box.low[0]) * (box.high[1] - box.low[1]);
  };
  bool nearest_first = end - begin > kLargeLeaf * context_->options.leaf_size;
  if (nearest_first) {
    ChartBox all = items_[begin];
    float sum = 0;
    for (std::uint32_t i = begin; i < end; ++i) {
      for (std::size_t k = 0; k < 2; ++k) {
        all.low[k] = std::min(all.low[k], items_[i].low[k]);
        all.high[k] = std::max(all.high[k], items_[i].high[k]);
      }
      sum += area(items_[i]);
    }
    nearest_first = sum < 0.1f * static_cast<float>(end - begin) * area(all);
  }
  const auto weight = [&](const SectorItem& item) {
    return nearest_first ? item.z_high : area(item);
  };
  std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
    const float own = weight(items_[a]), other = weight(items_[b]);
    return own != other ? own > other : items_[a].part < items_[b].part;
  });
  for (std::uint32_t i = begin; i < end && !stopped(); ++i)
    subtract_casters(i, order_, nearest_first, chart);
}

template <SectorSpaceModel Space>
void SectorTree<Space>::subtract_casters(std::uint32_t receiver,
                                         std::span<const std::uint32_t> casters, bool nearest_first,
                                         const LightChart* chart) {
  const SectorItem& item = items_[receiver];
  const std::uint32_t loops_mark = loops_.size(), planes_mark = space_.plane_mark();
  const LoopRange whole{item.first, item.count, item.part};
  lit_.assign(1, {whole, true, item});
  bool cut = false;
  SectorState state = kAllLit;
  for (const std::uint32_t c : casters) {
    const SectorItem& caster = items_[c];
    if (caster.z_high <= item.z_low) {
      if (nearest_first) break;  // so are all that follow
      continue;
    }
    if (c == receiver || !caster.overlaps(item)) continue;
    const Relation how = relation(item, caster);
    if (how == Relation::kNone) continue;
    caster_planes_.clear();
    for (std::uint32_t i = 0; i < caster.count; ++i) {
      const PlaneRef edge = loops_.edge(caster.first + i);
      if (!is_cell_plane(edge)) caster_planes_.push_back(edge);
    }
    if (how == Relation::kCrossing) {
      const auto& parts = context_->scene.parts;
      const PlaneId other = parts[caster.part].plane;
      const PlaneRef front = space_.cut_of_supports(parts[item.part].plane, other);
      const bool faces = context_->facing.plane_signs[other] == Sign::kPositive;
      caster_planes_.push_back(faces ? -front : front);  // behind the caster
    }
    still_lit_.clear();
    for (LitPiece& piece : lit_) {
      if (chart != nullptr && !piece.located) {
        piece.box = box_of(*chart, view(piece.loop));
        piece.located = true;
      }
      LoopRange inside;
      if (!piece.box.overlaps(caster) || !clip(piece, inside)) {
        still_lit_.push_back(piece);
        continue;
      }
      if (inside.first == whole.first) {
        state = caster.part;  // one caster has it all
      } else {
        cut = true;
        if (inside.count >= 3) emit(inside, caster.part);
      }
    }
    lit_.swap(still_lit_);
    if (lit_.empty()) break;
  }
  if (cut) {
    for (const LitPiece& piece : lit_) emit(piece.loop, kAllLit);
    state = kMixed;
  }
  states_[receiver] = state;
  loops_.truncate(loops_mark);
  space_.release_planes(planes_mark);
}

// The part of a piece that is inside all caster_planes_; what is outside goes to still_lit_. False:
// it is all outside, and untouched. `inside` is the piece itself if nothing was cut.
template <SectorSpaceModel Space>
bool SectorTree<Space>::clip(const LitPiece& piece, LoopRange& inside) {
  spanning_.clear();
  for (const PlaneRef plane : caster_planes_) {
    SplitRecord& record = spanning_.empty() ? first_record_ : record_;
    switch (record.decide(space_, plane, view(piece.loop))) {
      case Placement::kFront:
        break;
      case Placement::kSpanning:
        spanning_.push_back(plane);
        break;
      case Placement::kBack:
      case Placement::kOn:
        return false;
    }
  }
  inside = piece.loop;
  const std::uint32_t loops_mark = loops_.size();
  const std::size_t lit_mark = still_lit_.size();
  for (std::size_t i = 0; i < spanning_.size(); ++i) {
    const PlaneRef plane = spanning_[i];
    const SplitRecord& record = i == 0 ? first_record_ : record_;
    if (i > 0) {
      const Placement placement = record_.decide(space_, plane, view(inside));
      if (placement == Placement::kFront) continue;
      if (placement != Placement::kSpanning) {  // inside each plane somewhere, but nowhere of all
        loops_.truncate(loops_mark);
        still_lit_.resize(lit_mark);
        return false;
      }
    }
    loops_.reserve_more(2 * std::size_t{inside.count} + 4);
    const SplitChildren pieces =
        make_children(space_, plane, view(inside), record, crossings_, loops_);
    if (pieces.back.count >= 3) {
      still_lit_.push_back({pieces.back, false, {}});
    } else {
      ++output_.vanished;
    }
    inside = pieces.front;
    if (inside.count < 3) {
      ++output_.vanished;
      break;
    }
  }
  return true;
}

// What came to the same end in both children is one piece of the parent; other pieces are put out.
template <SectorSpaceModel Space>
void SectorTree<Space>::join(Range children) {
  for (std::uint32_t i = children.begin; i < children.end; ++i) {
    SectorState& parent = states_[items_[i].parent];
    if (states_[i] == kUndecided) continue;
    parent = parent == kUndecided || parent == states_[i] ? states_[i] : kMixed;
  }
  for (std::uint32_t i = children.begin; i < children.end; ++i) {
    const SectorItem& item = items_[i];
    if (states_[item.parent] != kMixed || states_[i] == kMixed || states_[i] == kUndecided)
      continue;
    emit({item.first, item.count, item.part}, states_[i]);
  }
}

template <SectorSpaceModel Space>
void SectorTree<Space>::emit(const LoopRange& loop, SectorState state) {
  if (!fragment_stays(space_, view(loop), context_->rules)) return;
  if (++output_.piece_count % kPieceBatch == 0 &&
      context_->pieces.fetch_add(kPieceBatch, std::memory_order_relaxed) + kPieceBatch >
          context_->options.max_fragments) {
    context_->stopped.store(true, std::memory_order_relaxed);
  }
  const bool lit = state == kAllLit;
  // The lit fraction of an exact kernel gives the other.
  if (lit || !Space::kExact) emit_area(loop, lit);
  const RunOptions& options = context_->options;
  if (!options.keeps_any_points()) return;
  SectorOutput::Piece piece{loop.part, {}};
  piece.fragment.state = lit ? LightState::kLit : LightState::kShadow;
  piece.fragment.caster = state;
  export_loop(space_, context_->scene.geometry, options, view(loop), piece.fragment, output_.points,
              output_.exact_points);
  output_.pieces.push_back(piece);
}

template <SectorSpaceModel Space>
void SectorTree<Space>::emit_area(const LoopRange& range, bool lit) {
  const LoopView<Vertex> loop = view(range);
  const Ball whole = context_->areas[loop.part];
  const Ball area = twice_area(
      loop, [&](const auto& corner) { return planar_point(space_, context_->charts, corner); });
  if constexpr (!Space::kExact) {
    context_->sums.add_rounded(loop.part, lit, area.middle / whole.middle);
  } else {
    Ball fraction = area / whole;
    constexpr double kWidest = PartMeasure<Space>::kWidest;
    if constexpr (requires { space_.accurate_planar_point(loop.corner(0)); }) {
      if (!(fraction.radius < kWidest)) {
        fraction =
            twice_area(loop,
                       [&](const auto& corner) { return space_.accurate_planar_point(corner); }) /
            whole;
      }
    }
    if (context_->options.exact_fractions || !(fraction.radius < kWidest)) {
      const Part& part = context_->scene.parts[loop.part];
      mpq_class& exact_whole = exact_areas_[loop.part];
      if (sgn(exact_whole) == 0) exact_whole = twice_exact_area(context_->scene, part);
      mpq_class exact =
          twice_exact_area(space_, chart_of(context_->scene.geometry, part.plane), loop) /
          exact_whole;
      const double value = exact.get_d();  // truncated: within one unit in the last place
      fraction = Ball(value, 2 * Ball::kUnit * value + Ball::kTiny);
      if (context_->options.exact_fractions) {
        output_.exact_lit.emplace_back(loop.part, std::move(exact));
      }
    }
    context_->sums.add_enclosure(loop.part, fraction);
  }
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SECTORS_SECTOR_TREE_INL_H
