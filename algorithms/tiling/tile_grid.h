// SPDX-License-Identifier: LGPL-3.0-or-later
// Which tiles a loop of light space meets, and which of them it holds wholly (Slater 1992, sec. 5).
//
// A loop is cut by a border in the middle of the block of tiles that it may meet, and so on down to
// single tiles: what has no area in a tile does not meet it. A piece that holds its whole block
// does so for every tile of the block at once: all of its edges are on the block's borders. (The
// paper asks for the sides of a tile's four corners, which says the same.)
//
// Exactness: on exact kernels both answers are exact. Explicit stack; a loop takes O(tiles that its
// border meets * log n) cuts.
#ifndef GNOMON_ALGORITHMS_TILING_TILE_GRID_H
#define GNOMON_ALGORITHMS_TILING_TILE_GRID_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "algorithms/partition/loop_store.h"
#include "algorithms/partition/split.h"
#include "algorithms/tiling/tile_borders.h"
#include "kernel/concept/kernel_concept.h"

namespace gnomon {

/// Tiles of one face: columns [low[0], high[0]) along u, rows [low[1], high[1]) along v.
struct TileBlock {
  std::uint32_t face = 0;
  std::array<std::uint32_t, 2> low{}, high{};

  std::uint32_t size(int axis) const {
    return high[static_cast<std::size_t>(axis)] - low[static_cast<std::size_t>(axis)];
  }
  bool is_tile() const { return size(0) == 1 && size(1) == 1; }
  int longer_axis() const { return size(0) >= size(1) ? 0 : 1; }
  /// The border that cuts it in two along its longer axis. Requires: not one tile.
  std::uint32_t middle() const {
    const auto axis = static_cast<std::size_t>(longer_axis());
    return low[axis] + (high[axis] - low[axis]) / 2;
  }
  TileBlock above() const {
    TileBlock block = *this;
    block.low[static_cast<std::size_t>(longer_axis())] = middle();
    return block;
  }
  TileBlock below() const {
    TileBlock block = *this;
    block.high[static_cast<std::size_t>(longer_axis())] = middle();
    return block;
  }
};

struct MetTiles {
  TileBlock block;
  bool interior = false;  // the loop holds every tile of the block; else the block is one tile
};

template <SectorSpaceModel Space>
class TileGrid {
 public:
  using Vertex = typename Space::Vertex;

  TileGrid(Space& space, TileBorders borders)
      : space_(space),
        borders_(std::move(borders)),
        planes_(std::size_t{2} * borders_.faces() * (borders_.tiles() + 1)) {}

  const TileBorders& borders() const { return borders_; }
  TileBlock face(std::uint32_t face) const {
    return {face, {0, 0}, {borders_.tiles(), borders_.tiles()}};
  }
  /// The border as a plane of the space, made when it is first asked for.
  PlaneRef border(std::uint32_t face, int axis, std::uint32_t index) {
    PlaneRef& plane =
        planes_[(std::size_t{2} * face + static_cast<std::size_t>(axis)) * (borders_.tiles() + 1) +
                index];
    if (!plane.valid()) plane = space_.add_prefix_plane(borders_.border(face, axis, index));
    return plane;
  }
  PlaneRef middle(const TileBlock& block) {
    return border(block.face, block.longer_axis(), block.middle());
  }
  /// The four planes around a face of the cube, all in front of it.
  std::array<PlaneRef, 4> pyramid(std::uint32_t face) {
    const std::uint32_t n = borders_.tiles();
    return {border(face, 0, 0), -border(face, 0, n), border(face, 1, 0), -border(face, 1, n)};
  }

  /// Appends the tiles that a loop meets to `met`, each once.
  void find(const LoopView<Vertex>& loop, std::vector<MetTiles>& met);
  /// Cuts of a loop by a border so far.
  std::uint64_t cuts() const { return cuts_; }

 private:
  struct Piece {
    LoopRange loop;
    TileBlock block;
  };
  /// Where the doubles of the corners put a loop on a face.
  enum class Located : std::uint8_t { kUnknown, kInside };
  Located locate(const LoopView<Vertex>& loop, TileBlock& block) const;
  /// Appends what of a loop is on a face; false if nothing is.
  bool clip_to_face(const LoopView<Vertex>& loop, std::uint32_t face, LoopRange& clipped);
  void descend(const LoopRange& loop, const TileBlock& block, PlaneId support,
               std::vector<MetTiles>& met);
  bool holds(const LoopView<Vertex>& loop, const TileBlock& block);

  Space& space_;
  TileBorders borders_;
  std::vector<PlaneRef> planes_;
  std::uint64_t cuts_ = 0;
  // Workspace, kept to save allocations.
  std::vector<Piece> stack_;
  LoopStore<Vertex> work_;
  SplitRecord record_;
  std::vector<Vertex> crossings_;
};

template <SectorSpaceModel Space>
void TileGrid<Space>::find(const LoopView<Vertex>& loop, std::vector<MetTiles>& met) {
  for (std::uint32_t face = 0; face < borders_.faces(); ++face) {
    TileBlock block = this->face(face);
    const bool alone = locate(loop, block) == Located::kInside;
    work_.clear();
    LoopRange clipped;
    if (alone || borders_.directional()) {
      clipped = work_.append(loop);
    } else if (!clip_to_face(loop, face, clipped)) {
      continue;
    }
    descend(clipped, block, loop.support, met);
    if (alone) return;
  }
}

// Bounds of doubles narrow the block, and often say that the loop is on this face alone.
template <SectorSpaceModel Space>
typename TileGrid<Space>::Located TileGrid<Space>::locate(const LoopView<Vertex>& loop,
                                                          TileBlock& block) const {
  const LightChart chart = borders_.chart(block.face);
  std::array<double, 2> low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (std::uint32_t i = 0; i < loop.size(); ++i) {
    const ChartPoint point = space_.chart_point(chart, loop.corner(i));
    const std::array<double, 2> at{point.u, point.v};
    for (std::size_t k = 0; k < 2; ++k) {
      // An unknown point has an infinite error, and leaves the block as it is.
      low[k] = std::min(low[k], at[k] - point.uv_error);
      high[k] = std::max(high[k], at[k] + point.uv_error);
    }
  }
  bool inside = true;
  for (std::size_t k = 0; k < 2; ++k) {
    const int axis = static_cast<int>(k);
    const double first = borders_.coordinate(axis, 0);
    const double last = borders_.coordinate(axis, borders_.tiles());
    // A tile more on each side pays for the rounding of what follows.
    const double width = (last - first) / borders_.tiles();
    const double begin = std::floor((low[k] - first) / width) - 1;
    const double end = std::ceil((high[k] - first) / width) + 1;
    if (begin > block.low[k] && begin < block.high[k]) {
      block.low[k] = static_cast<std::uint32_t>(begin);
    }
    if (end < block.high[k] && end > block.low[k]) {
      block.high[k] = static_cast<std::uint32_t>(end);
    }
    inside = inside && low[k] > first + width * 0x1p-20 && high[k] < last - width * 0x1p-20;
  }
  return inside ? Located::kInside : Located::kUnknown;
}

template <SectorSpaceModel Space>
bool TileGrid<Space>::clip_to_face(const LoopView<Vertex>& loop, std::uint32_t face,
                                   LoopRange& clipped) {
  const std::array<PlaneRef, 4> planes = pyramid(face);
  clipped = work_.append(loop);
  for (const PlaneRef plane : planes) {
    const LoopView<Vertex> here = work_.view(clipped, loop.support);
    switch (record_.decide(space_, plane, here)) {
      case Placement::kFront:
        break;
      case Placement::kBack:
      case Placement::kOn:
        return false;
      case Placement::kSpanning:
        ++cuts_;
        work_.reserve_more(2 * std::size_t{clipped.count} + 4);
        clipped = make_children(space_, plane, work_.view(clipped, loop.support), record_,
                                crossings_, work_)
                      .front;
        if (clipped.count < 3) return false;
        break;
    }
  }
  return true;
}

template <SectorSpaceModel Space>
void TileGrid<Space>::descend(const LoopRange& loop, const TileBlock& block, PlaneId support,
                              std::vector<MetTiles>& met) {
  stack_.assign(1, {loop, block});
  while (!stack_.empty()) {
    const Piece piece = stack_.back();
    stack_.pop_back();
    // What is left of a piece's own loops on the stack comes before it.
    work_.truncate(piece.loop.first + piece.loop.count);
    const bool interior = holds(work_.view(piece.loop, support), piece.block);
    if (interior || piece.block.is_tile()) {
      met.push_back({piece.block, interior});
      continue;
    }
    const PlaneRef plane = middle(piece.block);
    switch (record_.decide(space_, plane, work_.view(piece.loop, support))) {
      case Placement::kFront:
        stack_.push_back({piece.loop, piece.block.above()});
        break;
      case Placement::kBack:
        stack_.push_back({piece.loop, piece.block.below()});
        break;
      case Placement::kOn:  // only where rounding flattens all of it
        break;
      case Placement::kSpanning: {
        ++cuts_;
        work_.reserve_more(2 * std::size_t{piece.loop.count} + 4);
        const SplitChildren children = make_children(space_, plane, work_.view(piece.loop, support),
                                                     record_, crossings_, work_);
        if (children.back.count >= 3) stack_.push_back({children.back, piece.block.below()});
        if (children.front.count >= 3) stack_.push_back({children.front, piece.block.above()});
        break;
      }
    }
  }
}

// A convex loop inside a rectangle all of whose edges are on the rectangle's border is the
// rectangle.
template <SectorSpaceModel Space>
bool TileGrid<Space>::holds(const LoopView<Vertex>& loop, const TileBlock& block) {
  std::array<PlaneRef, 4> around;
  for (int axis = 0; axis < 2; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    around[2 * k] = border(block.face, axis, block.low[k]);
    around[2 * k + 1] = border(block.face, axis, block.high[k]);
  }
  for (std::uint32_t i = 0; i < loop.size(); ++i) {
    const bool on_border = std::ranges::any_of(around, [&](PlaneRef plane) {
      return loop.edges[i].same_plane(plane) ||
             (space_.side_of_plane(plane, loop.corner(i)) == Side::kOn &&
              space_.side_of_plane(plane, loop.corner(loop.next(i))) == Side::kOn);
    });
    if (!on_border) return false;
  }
  return true;
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_TILING_TILE_GRID_H
