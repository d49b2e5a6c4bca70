// SPDX-License-Identifier: LGPL-3.0-or-later
// Which polygon of a cell hides which: a polygon that covers the cell hides all that is behind it,
// and in a leaf the nearer casters are subtracted from each receiver. Bodies of sector_tree.h.
#ifndef GNOMON_ALGORITHMS_SECTORS_SUBTRACTION_H
#define GNOMON_ALGORITHMS_SECTORS_SUBTRACTION_H

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "algorithms/partition/depth.h"
#include "algorithms/sectors/float_filters.h"
#include "algorithms/sectors/sector_tree.h"

namespace gnomon {

/// Whether all edges of the clipped polygon are planes of the cell.
template <SectorSpaceModel Space>
bool SectorTree<Space>::covers(const SectorItem& item) const {
  for (std::uint32_t i = 0; i < item.count; ++i) {
    if (!is_cell_plane(loops_.edge(item.first + i))) return false;
  }
  return true;
}

/// Whether no vertex of the item is nearer than the part's plane and one is behind it.
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

// Tells how much of the receiver is behind the caster's plane, within the cell. The answer is kNone
// also if the caster is nowhere in front of the receiver's plane. (Of two polygons that do not
// cross, one is on one side of the other's plane.)
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
  const DepthSides of_receiver = depth_sides(space_, context_->facing, other, view(receiver));
  if (!of_receiver.behind) return Relation::kNone;
  if (!of_receiver.nearer) return Relation::kBehind;
  const DepthSides of_caster = depth_sides(space_, context_->facing, own, view(caster));
  if (!of_caster.nearer) return Relation::kNone;
  return of_caster.behind ? Relation::kCrossing : Relation::kBehind;
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

// Polygons behind one that covers the cell are in its shadow there: they leave the cell.
template <SectorSpaceModel Space>
std::uint32_t SectorTree<Space>::cull(std::uint32_t begin, std::uint32_t end) {
  order_.clear();
  for (std::uint32_t i = begin; i < end; ++i) {
    if (!items_[i].fresh) continue;
    items_[i].fresh = 0;
    if (context_->casts(items_[i].part) && covers(items_[i])) order_.push_back(i);
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
      // Only polygons that are wholly behind leave; a leaf subtracts the others.
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
void SectorTree<Space>::leaf(std::uint32_t begin, std::uint32_t end, const LightChart* chart) {
  if (context_->leaf_method == LeafMethod::kTwoPass) {
    clip_lists(begin, end);
    return;
  }
  if (context_->leaf_method == LeafMethod::kBlots) {
    clip_by_blots(begin, end, chart);
    return;
  }
  order_.clear();
  for (std::uint32_t i = begin; i < end; ++i) {
    if (context_->casts(items_[i].part)) order_.push_back(i);
  }
  if (context_->leaf_method == LeafMethod::kCount) {
    for (std::uint32_t i = begin; i < end && !stopped(); ++i) count_casters(i, order_, chart);
    return;
  }
  // The largest casters go first, so that little is left for the others to cut. Where there are
  // very many small ones, the nearest go first: most pairs are then skipped.
  const auto area = [](const ChartBox& box) {
    return (box.high[0] - box.low[0]) * (box.high[1] - box.low[1]);
  };
  bool nearest_first = end - begin > kLargeLeaf * context_->options.tuning.leaf_size;
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
  for (std::uint32_t i = begin; i < end && !stopped(); ++i) {
    if (items_[i].receives) subtract_casters(i, order_, nearest_first, chart);
  }
}

/// The planes of a caster, in whose common front the receiver lies behind it: caster_planes_.
template <SectorSpaceModel Space>
void SectorTree<Space>::planes_between(const SectorItem& receiver, const SectorItem& caster,
                                       Relation how) {
  caster_planes_.clear();
  for (std::uint32_t i = 0; i < caster.count; ++i) {
    const PlaneRef edge = loops_.edge(caster.first + i);
    if (!is_cell_plane(edge)) caster_planes_.push_back(edge);
  }
  if (how != Relation::kCrossing) return;
  const auto& parts = context_->scene.parts;
  // Behind the caster.
  caster_planes_.push_back(
      -depth_cut(space_, context_->facing, parts[receiver.part].plane, parts[caster.part].plane));
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
    planes_between(item, caster, how);
    still_lit_.clear();
    for (LitPiece& piece : lit_) {
      if (!Space::kExact && gives_up(still_lit_.size())) break;
      if (chart != nullptr && !piece.located) {
        piece.box = box_of(*chart, view(piece.loop));
        piece.located = true;
      }
      if (!piece.box.overlaps(caster) ||
          clip_.clip(space_, caster_planes_, piece.loop, context_->scene.parts[item.part].plane,
                     loops_) == ConePlace::kOutside) {
        still_lit_.push_back(piece);
        continue;
      }
      for (const LoopRange& outside : clip_.outside()) still_lit_.push_back({outside, false, {}});
      const LoopRange inside = clip_.inside();
      if (inside.first == whole.first) {
        state = caster.part;  // one caster has it all
      } else {
        cut = true;
        if (inside.count >= 3) emit(inside, caster.part);
      }
    }
    lit_.swap(still_lit_);
    if (lit_.empty() || (!Space::kExact && stopped())) break;
  }
  output_.vanished += clip_.take_vanished();
  if (cut) {
    for (const LitPiece& piece : lit_) emit(piece.loop, kAllLit);
    state = kMixed;
  }
  states_[receiver] = state;
  loops_.truncate(loops_mark);
  space_.release_planes(planes_mark);
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SECTORS_SUBTRACTION_H
