// SPDX-License-Identifier: LGPL-3.0-or-later
// The method blots in a leaf of the tree of light space (algorithms/blots): the blots of a cell are
// forgotten with it. With sectors=off a leaf is all that is in one chart. And of a piece that a
// solid hides, which of its faces do. Bodies of sector_tree.h.
#ifndef GNOMON_ALGORITHMS_SECTORS_BLOTS_LEAF_H
#define GNOMON_ALGORITHMS_SECTORS_BLOTS_LEAF_H

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "algorithms/sectors/sector_tree.h"

namespace gnomon {

/// What BlotClipping asks of the cell.
template <SectorSpaceModel Space>
struct SectorTree<Space>::BlotCell {
  SectorTree& tree;
  const LightChart* chart;

  bool bounds_all(PlaneRef edge) const { return tree.is_cell_plane(edge); }
  bool stopped() const { return tree.stopped(); }
  bool gives_up(std::size_t pieces) const {
    return tree.stopped() || (!Space::kExact && tree.gives_up(pieces));
  }
  ChartBox box_of(const LoopView<Vertex>& loop) const {
    return chart == nullptr ? ChartBox{} : tree.box_of(*chart, loop);
  }
};

template <SectorSpaceModel Space>
void SectorTree<Space>::clip_by_blots(std::uint32_t begin, std::uint32_t end,
                                      const LightChart* chart) {
  const std::uint32_t loops_mark = loops_.size(), planes_mark = space_.plane_mark();
  list_pieces(begin, end);
  const typename BlotClipping<Space>::Setting setting{list_setting(), *context_->solids,
                                                      context_->outlines};
  blots_.run(setting, pieces_, BlotCell{*this, chart}, clipped_);
  output_.vanished += blots_.take_vanished();
  put_out_clipped();
  loops_.truncate(loops_mark);
  space_.release_planes(planes_mark);
}

/// The faces of a solid that hide some of a piece each. They tile its outline, so that a piece
/// inside of that needs all of them.
template <SectorSpaceModel Space>
std::vector<std::uint32_t> SectorTree<Space>::faces_hiding(const LoopRange& loop,
                                                           std::uint32_t solid) {
  std::vector<std::uint32_t> parts;
  const PlaneId support = context_->scene.parts[loop.part].plane;
  for (const SolidsOfLight::Face& face : context_->solids->solids[solid].faces) {
    const std::uint32_t mark = loops_.size();
    if (clip_.clip(space_, face.planes, loop, support, loops_) != ConePlace::kOutside) {
      parts.push_back(face.part);
    }
    loops_.truncate(mark);
  }
  return parts;
}

/// Names who hides a fragment: its state is a part, or the number of parts and a solid.
template <SectorSpaceModel Space>
void SectorTree<Space>::name_caster(const LoopRange& loop, SectorState state, Fragment& fragment) {
  const auto parts = static_cast<std::uint32_t>(context_->scene.parts.size());
  if (state < parts || context_->solids == nullptr ||
      state - parts >= context_->solids->solids.size()) {
    fragment.caster = state;
    return;
  }
  std::vector<std::uint32_t> faces = faces_hiding(loop, state - parts);
  if (faces.empty()) faces.push_back(context_->solids->solids[state - parts].faces[0].part);
  const auto polygon_of = [&](std::uint32_t part) { return context_->scene.parts[part].polygon; };
  if (std::ranges::all_of(faces, [&](std::uint32_t part) {
        return polygon_of(part) == polygon_of(faces.front());
      })) {
    fragment.caster = faces.front();
    return;
  }
  fragment.caster = Fragment::kNoCaster;
  fragment.casters = static_cast<std::uint32_t>(output_.caster_sets.size());
  output_.caster_sets.push_back(std::move(faces));
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SECTORS_BLOTS_LEAF_H
