// SPDX-License-Identifier: LGPL-3.0-or-later
// The volumes that a target of `tiling` is tested against: S(p), those that the tiles name which it
// meets (Slater 1992, sec. 5).
#ifndef GNOMON_ALGORITHMS_TILING_TILE_VOLUMES_H
#define GNOMON_ALGORITHMS_TILING_TILE_VOLUMES_H

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/tiling/tile_cells.h"
#include "algorithms/tiling/tile_lists.h"

namespace gnomon {

template <SectorSpaceModel Space>
class TileVolumes {
 public:
  using Vertex = typename Space::Vertex;
  using Loop = LoopView<Vertex>;

  TileVolumes(LightScene<Space>& light, VolumeList<Space>& volumes, std::uint32_t tiles)
      : light_(light),
        volumes_(volumes),
        grid_(light.space,
              TileBorders(light.scene, light.light_point(), light.facing.parts, tiles)),
        lists_(grid_.borders().faces(), tiles),
        cells_(light, grid_, volumes) {}

  /// Where in light space a loop is: the tiles that it meets.
  using Place = std::vector<MetTiles>;
  Place find(const Loop& loop) {
    Place met;
    grid_.find(loop, met);
    return met;
  }
  /// S(p), ascending: the living volumes that tiles name. Valid until the next call of any
  /// function.
  std::span<const VolumeId> at(const Place& met) {
    named_.clear();
    ++stamp_;
    stamps_.resize(volumes_.size(), 0);
    lists_.for_each_entry(met, [&](VolumeId id) {
      if (stamps_[id] == stamp_ || !volumes_.is_alive(id)) return;
      stamps_[id] = stamp_;
      named_.push_back(id);
    });
    std::ranges::sort(named_);
    return named_;
  }
  /// Remembers p_i of a target that is tested against so many volumes.
  void count_target(std::size_t named) {
    if (volumes_.size() == 0) return;
    shares_.push_back(static_cast<std::uint32_t>(named * kMillion / volumes_.size()));
  }
  /// Writes the volume of a piece into the tiles that the piece meets.
  void insert(VolumeId id, const Place& met) {
    lists_.write(id, met, light_.rules.closed_tiles_pass_to_the_killer,
                 [&](VolumeId other) { return volumes_.is_alive(other); });
  }
  std::uint64_t subtract(const Loop& target, std::span<const VolumeId> volumes,
                         ClassifiedLoops<Vertex>& output) {
    return cells_.subtract(target, volumes, output);
  }

  void count(WorkCounts& counts) const {
    counts[Counter::kTileWrites] = lists_.writes();
    counts[Counter::kClosedTiles] = lists_.closed();
    counts[Counter::kTileBytes] = lists_.bytes();
    std::vector<std::uint32_t> sorted = shares_;
    std::ranges::sort(sorted);
    if (sorted.empty()) return;
    std::uint64_t sum = 0;
    for (const std::uint32_t share : sorted) sum += share;
    const auto at = [&](std::size_t quarter) { return sorted[(sorted.size() - 1) * quarter / 4]; };
    counts[Counter::kMeanMet] = sum / sorted.size();
    counts[Counter::kFirstQuartileMet] = at(1);
    counts[Counter::kMedianMet] = at(2);
    counts[Counter::kThirdQuartileMet] = at(3);
  }
  std::uint64_t vanished() const { return cells_.vanished(); }

 private:
  static constexpr std::uint64_t kMillion = 1'000'000;

  LightScene<Space>& light_;
  VolumeList<Space>& volumes_;
  TileGrid<Space> grid_;
  TileLists lists_;
  TileCells<Space> cells_;
  std::vector<VolumeId> named_;
  std::vector<std::uint64_t> stamps_;  // by volume: the last target that met it
  std::uint64_t stamp_ = 0;
  std::vector<std::uint32_t> shares_;  // p_i of every target, in millionths
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_TILING_TILE_VOLUMES_H
