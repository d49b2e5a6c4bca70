// SPDX-License-Identifier: LGPL-3.0-or-later
// An area light cut into pieces by the planes of polygons: each piece is then wholly on one side of
// every polygon, and a light of its own. Chin & Feiner (1992, "Preprocess") do so before anything
// else, by those polygons alone that have a part in front of the light's plane.
//
// Exactness: that of the space. The pieces tile the light. Their edges are those of the light and
// support planes, so that volumes of pieces stay of bounded degree: no piece is put on a grid.
#ifndef GNOMON_ALGORITHMS_VOLUME_TREES_LIGHT_BY_PLANES_H
#define GNOMON_ALGORITHMS_VOLUME_TREES_LIGHT_BY_PLANES_H

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/partition/loop_store.h"
#include "algorithms/partition/split.h"
#include "kernel/concept/kernel_concept.h"

namespace gnomon {

template <class Vertex>
struct LightCut {
  LoopStore<Vertex> loops;
  std::vector<LoopRange> pieces;
  std::uint64_t vanished = 0;  // pieces that rounding lost: 0 on exact kernels
};

/// Makes the pieces in the order of a BSP tree of the planes, pieces in front first. Returns false
/// if there are more than `most`.
template <VolumeSpaceModel Space>
bool cut_light(Space& space, const LoopView<typename Space::Vertex>& light,
               std::span<const PlaneRef> planes, std::uint64_t most,
               LightCut<typename Space::Vertex>& result) {
  using Vertex = typename Space::Vertex;
  LightCut<Vertex> next;
  SplitRecord record;
  std::vector<Vertex> crossings;
  result.loops.clear();
  result.pieces.assign(1, result.loops.append(light));
  for (const PlaneRef plane : planes) {
    next.loops.clear();
    next.pieces.clear();
    bool cut = false;
    for (const LoopRange& range : result.pieces) {
      const LoopView<Vertex> piece = result.loops.view(range, light.support);
      if (record.decide(space, plane, piece) != Placement::kSpanning) {
        next.pieces.push_back(next.loops.append(piece));
        continue;
      }
      cut = true;
      const SplitChildren children =
          make_children(space, plane, piece, record, crossings, next.loops);
      for (const LoopRange& child : {children.front, children.back}) {
        if (child.count >= 3) {
          next.pieces.push_back(child);
        } else {
          ++result.vanished;
        }
      }
    }
    if (!cut) continue;
    std::swap(result.loops, next.loops);
    std::swap(result.pieces, next.pieces);
    if (result.pieces.size() > most) return false;
  }
  return true;
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_VOLUME_TREES_LIGHT_BY_PLANES_H
