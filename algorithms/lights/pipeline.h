// SPDX-License-Identifier: LGPL-3.0-or-later
// Several lights in a pipeline (Chin & Feiner 1989, sec. 5; Slater 1992, sec. 8): the fragments
// that one light leaves are classified by the next, front to back from that light, so that each
// fragment at the end carries the set of lights that reach all of it.
//
// Shadows grow from the scene's own polygons, never from fragments of earlier lights (the "more
// coherent fragments" of 1989, sec. 6): planes stay of bounded degree, and what a light does not
// reach does not depend on the order of the lights.
#ifndef GNOMON_ALGORITHMS_LIGHTS_PIPELINE_H
#define GNOMON_ALGORITHMS_LIGHTS_PIPELINE_H

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <utility>
#include <vector>

#include "algorithms/lights/carried_loops.h"
#include "algorithms/partition/classified_loop.h"
#include "algorithms/scene_bsp/scene_bsp.h"

namespace gnomon {

/// Lights together have one bit each in 64.
inline Expected<void> check_light_count(std::size_t lights) {
  constexpr std::size_t kMost = 64;
  if (lights <= kMost) return {};
  return fail(ErrorCode::kLimit, std::to_string(lights) + " lights together", "at most 64");
}

template <LightSpaceModel Space>
class Pipeline {
 public:
  using Vertex = typename Space::Vertex;
  using SceneVertex = typename Space::SceneSpace::Vertex;

  /// One run a light, in order.
  Pipeline(const PreparedScene& scene, std::deque<LightScene<Space>>& lights,
           const SceneBsp<SceneVertex>& bsp)
      : scene_(scene), lights_(lights), bsp_(bsp), carrier_(lights) {
    for (auto& items : items_) items.resize(bsp.pieces.size());
    for (auto& run : last_run_) run.resize(bsp.pieces.size());
  }

  /// Classifies the fragments of a piece by the current run: `classify(loop, output)` puts out what
  /// becomes of a loop. Requires: nothing behind the piece casts a shadow yet.
  template <class Classify>
  void filter(std::uint32_t piece, Side side, std::uint32_t run, const Classify& classify) {
    std::vector<Item>& items = items_[index_of(side)][piece];
    const LoopRange& range = bsp_.pieces[piece];
    if (items.empty()) {
      items.push_back({carrier_.from_scene(bsp_.loops.view(range, plane_of(range.part))), 0});
    }
    std::vector<Item> next;
    for (const Item& item : items) {
      output_.clear();
      classify(carrier_.to_light(item.loop, range.part, side, run), output_);
      for (const ClassifiedLoop& fragment : output_.fragments) {
        const auto loop = output_.loops.view(fragment.loop, plane_of(range.part));
        next.push_back({carrier_.from_light(loop, item.loop, side, run), item.lit_by});
        if (fragment.state == LightState::kLit) next.back().lit_by |= std::uint64_t{1} << run;
      }
    }
    items = std::move(next);
    last_run_[index_of(side)][piece] = run;
  }

  /// The fragments, as the result tells of them.
  void put_out(const RunTask& task, ShadowResult& result) {
    const RunOptions options = run_options_of(task.options);
    for (std::uint32_t piece = 0; piece < bsp_.pieces.size(); ++piece) {
      const std::uint32_t part = bsp_.pieces[piece].part;
      for (const Side side : {Side::kFront, Side::kBack}) {
        const std::uint32_t run = last_run_[index_of(side)][piece];
        for (const Item& item : items_[index_of(side)][piece]) {
          CombinedFragment fragment{part, side, item.lit_by};
          // In the space of the last light that the side faces.
          export_loop(lights_[run].space, scene_.geometry, options,
                      carrier_.to_light(item.loop, part, side, run), fragment,
                      result.combined_points, result.combined_exact_points);
          result.combined.push_back(fragment);
        }
      }
    }
    const auto key = [&](const CombinedFragment& fragment) {
      return std::pair(scene_.parts[fragment.part].polygon, -static_cast<int>(fragment.side));
    };
    std::ranges::stable_sort(result.combined, {}, key);
  }

 private:
  struct Item {
    CarriedLoop<Vertex> loop;
    std::uint64_t lit_by = 0;  // bit i: run i
  };
  static std::size_t index_of(Side side) { return side == Side::kFront ? 0 : 1; }
  PlaneId plane_of(std::uint32_t part) const { return scene_.parts[part].plane; }

  const PreparedScene& scene_;
  std::deque<LightScene<Space>>& lights_;
  const SceneBsp<SceneVertex>& bsp_;
  LoopCarrier<Space> carrier_;
  std::array<std::vector<std::vector<Item>>, 2> items_;  // by side and piece; empty: not yet
  std::array<std::vector<std::uint32_t>, 2> last_run_;
  ClassifiedLoops<Vertex> output_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_LIGHTS_PIPELINE_H
