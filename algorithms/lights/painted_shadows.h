// SPDX-License-Identifier: LGPL-3.0-or-later
// Several lights as shadows painted on shadows (Slater 1992, sec. 6): a piece is painted with the
// shadow polygons of the first light; then the piece, and each shadow polygon on it, is a target of
// the second light, and so on. A shadow polygon belongs to the target that it was cut from, and is
// dark for all lights that its target is dark for, and for its own.
//
// Invariant on exact kernels: at every point the lights that do not reach it are the union of the
// sets of the polygons that hold it, and one of these polygons has exactly that set. So whoever
// paints them by level (how many lights: the size of the set) sees the right set everywhere.
#ifndef GNOMON_ALGORITHMS_LIGHTS_PAINTED_SHADOWS_H
#define GNOMON_ALGORITHMS_LIGHTS_PAINTED_SHADOWS_H

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "algorithms/lights/carried_loops.h"
#include "algorithms/scene_bsp/scene_bsp.h"

namespace gnomon {

template <LightSpaceModel Space>
class PaintedShadows {
 public:
  using Vertex = typename Space::Vertex;
  using SceneVertex = typename Space::SceneSpace::Vertex;

  PaintedShadows(const PreparedScene& scene, const LightScenes<Space>& lights,
                 const SceneBsp<SceneVertex>& bsp)
      : scene_(scene), lights_(lights), bsp_(bsp), carrier_(lights) {
    for (auto& painted : painted_) painted.resize(bsp.pieces.size());
  }

  /// Paints the shadows of the current run on a piece and on what is painted there:
  /// `paint(loop, put)` calls put(inside) for each shadow polygon on a loop. Requires: nothing
  /// behind the piece casts a shadow yet.
  template <class Paint>
  void filter(std::uint32_t piece, Side side, std::uint32_t run, const Paint& paint) {
    std::vector<Painted>& painted = painted_[index_of(side)][piece];
    const LoopRange& range = bsp_.pieces[piece];
    const std::size_t before = painted.size();
    const std::uint64_t bit = std::uint64_t{1} << run;
    const CarriedLoop<Vertex> whole =
        carrier_.from_scene(bsp_.loops.view(range, scene_.parts[range.part].plane));
    const auto paint_on = [&](const CarriedLoop<Vertex>& target, std::uint32_t owner,
                              std::uint32_t level, std::uint64_t dark_for) {
      paint(carrier_.to_light(target, range.part, side, run), [&](const LoopView<Vertex>& inside) {
        painted.push_back({carrier_.from_light(inside, target, side, run), level + 1,
                           dark_for | bit, owner, run});
      });
    };
    paint_on(whole, PaintedPolygon::kNoOwner, 0, 0);
    for (std::uint32_t i = 0; i < before; ++i) {
      const Painted target = painted[i];  // painting moves the others
      paint_on(target.loop, i, target.level, target.dark_for);
    }
  }

  /// The polygons by polygon, side and level, as the result tells of them.
  void put_out(const RunTask& task, ShadowResult& result) {
    const RunOptions options = run_options_of(task.options);
    std::vector<PaintedPolygon> all;
    for (std::uint32_t piece = 0; piece < bsp_.pieces.size(); ++piece) {
      const std::uint32_t part = bsp_.pieces[piece].part;
      for (const Side side : {Side::kFront, Side::kBack}) {
        const auto base = static_cast<std::uint32_t>(all.size());
        for (const Painted& painted : painted_[index_of(side)][piece]) {
          PaintedPolygon polygon{part, side, painted.level, painted.dark_for};
          if (painted.owner != PaintedPolygon::kNoOwner) polygon.on = base + painted.owner;
          export_loop(lights_[painted.run]->space, scene_.geometry, options,
                      carrier_.to_light(painted.loop, part, side, painted.run), polygon,
                      result.overlay_points, result.overlay_exact_points);
          all.push_back(polygon);
        }
      }
    }
    std::vector<std::uint32_t> order(all.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(order, {}, [&](std::uint32_t i) {
      return std::tuple(scene_.parts[all[i].part].polygon, -static_cast<int>(all[i].side),
                        all[i].level);
    });
    std::vector<std::uint32_t> place(all.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) place[order[i]] = i;
    for (const std::uint32_t i : order) {
      result.overlay.push_back(all[i]);
      std::uint32_t& owner = result.overlay.back().on;
      if (owner != PaintedPolygon::kNoOwner) owner = place[owner];
    }
  }

 private:
  struct Painted {
    CarriedLoop<Vertex> loop;
    std::uint32_t level = 1;
    std::uint64_t dark_for = 0;                      // bit i: run i
    std::uint32_t owner = PaintedPolygon::kNoOwner;  // of the same piece
    std::uint32_t run = 0;                           // whose shadow it is
  };
  static std::size_t index_of(Side side) { return side == Side::kFront ? 0 : 1; }

  const PreparedScene& scene_;
  const LightScenes<Space>& lights_;
  const SceneBsp<SceneVertex>& bsp_;
  LoopCarrier<Space> carrier_;
  std::array<std::vector<std::vector<Painted>>, 2> painted_;  // by side and piece
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_LIGHTS_PAINTED_SHADOWS_H
