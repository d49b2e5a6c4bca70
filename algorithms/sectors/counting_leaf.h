// SPDX-License-Identifier: LGPL-3.0-or-later
// How many casters lie between each point of a receiver and the light, in a leaf of the tree of
// light space: every nearer caster cuts every piece of the receiver, and none is left out because
// another hides the same (no culling above, either). Bodies of sector_tree.h.
//
// Guarantee on exact kernels: the pieces tile the receiver's piece of the cell, and each has the
// same number of casters, by the definition of shadow, between all its inner points and the light.
// Cost: k casters over one receiver make up to k^2 pieces, as many as their borders cut it into.
#ifndef GNOMON_ALGORITHMS_SECTORS_COUNTING_LEAF_H
#define GNOMON_ALGORITHMS_SECTORS_COUNTING_LEAF_H

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

#include "algorithms/partition/fragment_stays.h"
#include "algorithms/sectors/sector_tree.h"
#include "algorithms/sectors/subtraction.h"

namespace gnomon {

template <SectorSpaceModel Space>
void SectorTree<Space>::count_casters(std::uint32_t receiver,
                                      std::span<const std::uint32_t> casters,
                                      const LightChart* chart) {
  const SectorItem& item = items_[receiver];
  const PlaneId support = context_->scene.parts[item.part].plane;
  const std::uint32_t loops_mark = loops_.size(), planes_mark = space_.plane_mark();
  counted_.assign(1, {{item.first, item.count, item.part}, 0, true, item});
  for (const std::uint32_t c : casters) {
    const SectorItem& caster = items_[c];
    if (c == receiver || caster.part == item.part || !caster.overlaps(item)) continue;
    const Relation how = relation(item, caster);
    if (how == Relation::kNone) continue;
    planes_between(item, caster, how);
    next_counted_.clear();
    for (CountedPiece& piece : counted_) {
      if (chart != nullptr && !piece.located) {
        piece.box = box_of(*chart, view(piece.loop));
        piece.located = true;
      }
      if (!piece.box.overlaps(caster) ||
          clip_.clip(space_, caster_planes_, piece.loop, support, loops_) == ConePlace::kOutside) {
        next_counted_.push_back(piece);
        continue;
      }
      for (const LoopRange& outside : clip_.outside()) {
        next_counted_.push_back({outside, piece.count, false, {}});
      }
      const LoopRange inside = clip_.inside();
      if (inside.count < 3) continue;  // vanished (rounded kernels)
      const bool whole = inside.first == piece.loop.first;
      next_counted_.push_back({inside, piece.count + 1, whole && piece.located, piece.box});
    }
    counted_.swap(next_counted_);
  }
  output_.vanished += clip_.take_vanished();
  const auto same = [&](const CountedPiece& piece) {
    return piece.count == counted_.front().count;
  };
  if (!counted_.empty() && std::ranges::all_of(counted_, same)) {
    states_[receiver] = counted_.front().count;
  } else {
    for (const CountedPiece& piece : counted_) put_counted(piece.loop, piece.count);
    states_[receiver] = kMixed;
  }
  loops_.truncate(loops_mark);
  space_.release_planes(planes_mark);
}

/// Puts out the share that a piece has of its part.
template <SectorSpaceModel Space>
void SectorTree<Space>::put_counted(const LoopRange& range, std::uint32_t count) {
  const LoopView<Vertex> loop = view(range);
  if (!fragment_stays(space_, loop, context_->rules)) return;
  if (++output_.piece_count % kPieceBatch == 0 &&
      context_->pieces.fetch_add(kPieceBatch, std::memory_order_relaxed) + kPieceBatch >
          context_->options.limits.fragments) {
    context_->stopped.store(true, std::memory_order_relaxed);
  }
  const Ball whole = context_->areas[loop.part];
  Fraction share;
  share.enclosure = twice_area(space_, context_->charts, loop,
                               Space::kExact ? PartMeasure<Space>::kWidest * whole.middle
                                             : std::numeric_limits<double>::infinity()) /
                    whole;
  if constexpr (Space::kExact) {
    if (context_->options.output.exact_fractions ||
        !(share.enclosure.radius < PartMeasure<Space>::kWidest)) {
      const Part& part = context_->scene.parts[loop.part];
      mpq_class& exact_whole = exact_areas_[loop.part];
      if (sgn(exact_whole) == 0) exact_whole = twice_exact_area(context_->scene, part);
      share.exact = twice_exact_area(space_, chart_of(context_->scene.geometry, part.plane), loop) /
                    exact_whole;
      share.has_exact = true;
      const double value = share.exact.get_d();  // truncated: within one unit in the last place
      share.enclosure = Ball(value, 2 * Ball::kUnit * value + Ball::kTiny);
    }
  }
  output_.counted.push_back({loop.part, count, std::move(share)});
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SECTORS_COUNTING_LEAF_H
