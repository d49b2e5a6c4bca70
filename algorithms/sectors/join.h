// SPDX-License-Identifier: LGPL-3.0-or-later
// From cells back to polygons: pieces that the planes of cells cut apart are joined where they have
// the same class and caster; all other pieces are put out and measured. Bodies of sector_tree.h.
#ifndef GNOMON_ALGORITHMS_SECTORS_JOIN_H
#define GNOMON_ALGORITHMS_SECTORS_JOIN_H

#include <atomic>
#include <cstdint>
#include <utility>

#include "algorithms/partition/fragment_stays.h"
#include "algorithms/sectors/sector_tree.h"

namespace gnomon {

// Pieces of both children that have the same state are one piece of the parent; others are put out.
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
  if (context_->leaf_method == LeafMethod::kCount) return put_counted(loop, state);
  const RegionPlace place =
      context_->region == nullptr ? RegionPlace::kInside : context_->region->place(loop.part);
  if (place == RegionPlace::kInside) return emit_inside(loop, state);
  if (place == RegionPlace::kOutside) return emit_outside(loop);
  const std::uint32_t loops_mark = loops_.size(), planes_mark = space_.plane_mark();
  region_clip_.clip(
      space_, *context_->region, view(loop),
      [&](const LoopView<Vertex>& piece) { emit_outside(loops_.append(piece)); },
      [&](const LoopView<Vertex>& piece) { emit_inside(loops_.append(piece), state); });
  loops_.truncate(loops_mark);
  space_.release_planes(planes_mark);
}

template <SectorSpaceModel Space>
void SectorTree<Space>::emit_inside(const LoopRange& loop, SectorState state, ShadowReason reason) {
  if (!fragment_stays(space_, view(loop), context_->rules)) return;
  if (++output_.piece_count % kPieceBatch == 0 &&
      context_->pieces.fetch_add(kPieceBatch, std::memory_order_relaxed) + kPieceBatch >
          context_->options.limits.fragments) {
    context_->stopped.store(true, std::memory_order_relaxed);
  }
  const bool lit = state == kAllLit && reason == ShadowReason::kNone;
  if (!lit) ++output_.work[Counter::kShadowPolygons];
  // On an exact kernel the lit fraction gives the shadowed one.
  if (lit || !Space::kExact) emit_area(loop, lit);
  const RunOptions& options = context_->options;
  if (!options.keeps_any_points()) return;
  SectorOutput::Piece piece{loop.part, {}};
  piece.fragment.state = lit ? LightState::kLit : LightState::kShadow;
  name_caster(loop, state, piece.fragment);
  piece.fragment.reason = reason;
  export_loop(space_, context_->scene.geometry, options, view(loop), piece.fragment, output_.points,
              output_.exact_points);
  output_.pieces.push_back(piece);
}

/// The loop's share of its part; nothing is known where the radius is not below PartMeasure's
/// widest.
template <SectorSpaceModel Space>
PairBall SectorTree<Space>::fraction_of(const LoopView<Vertex>& loop) const {
  if constexpr (requires { space_.pair_planar_point(loop.corner(0)); }) {
    if (!context_->pair_areas.empty()) {
      const PairBall area = twice_pair_area(
          loop, [&](const auto& corner) { return space_.pair_planar_point(corner); });
      return area / context_->pair_areas[loop.part];
    }
  }
  const Ball whole = context_->areas[loop.part];
  const Ball area = twice_area(
      loop, [&](const auto& corner) { return planar_point(space_, context_->charts, corner); });
  const Ball fraction = area / whole;
  if constexpr (requires { space_.accurate_planar_point(loop.corner(0)); }) {
    if (!(fraction.radius < PartMeasure<Space>::kWidest)) {
      const Ball accurate = twice_area(
          loop, [&](const auto& corner) { return space_.accurate_planar_point(corner); });
      return PairBall(accurate / whole);
    }
  }
  return PairBall(fraction);
}

template <SectorSpaceModel Space>
void SectorTree<Space>::emit_area(const LoopRange& range, bool lit) {
  const LoopView<Vertex> loop = view(range);
  if constexpr (!Space::kExact) {
    const Ball area = twice_area(
        loop, [&](const auto& corner) { return planar_point(space_, context_->charts, corner); });
    context_->sums.add_rounded(loop.part, lit, area.middle / context_->areas[loop.part].middle);
  } else {
    PairBall fraction;
    const bool exactly = context_->options.output.exact_fractions;
    if (!exactly) fraction = fraction_of(loop);
    const double widest =
        context_->pair_areas.empty() ? PartMeasure<Space>::kWidest : PairBall::kWidest;
    if (exactly || !(fraction.radius < widest)) {
      const Part& part = context_->scene.parts[loop.part];
      mpq_class& exact_whole = exact_areas_[loop.part];
      if (sgn(exact_whole) == 0) exact_whole = twice_exact_area(context_->scene, part);
      mpq_class exact =
          twice_exact_area(space_, chart_of(context_->scene.geometry, part.plane), loop) /
          exact_whole;
      fraction = PairBall::of(exact);
      if (exactly) output_.exact_lit.emplace_back(loop.part, std::move(exact));
    }
    context_->sums.add_enclosure(loop.part, fraction);
  }
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SECTORS_JOIN_H
