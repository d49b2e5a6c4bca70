// SPDX-License-Identifier: LGPL-3.0-or-later
// Several lights in a pipeline (Chin & Feiner 1989, sec. 5; Slater 1992, sec. 8): the fragments
// that one light leaves are classified by the next, front to back from that light, so that each
// fragment at the end carries the set of lights that reach all of it.
//
// Where shadows grow from the scene's own polygons, not from fragments of earlier lights (the "more
// coherent fragments" of 1989, sec. 6), planes stay of bounded degree, and what a light does not
// reach does not depend on the order of the lights.
#ifndef GNOMON_ALGORITHMS_LIGHTS_PIPELINE_H
#define GNOMON_ALGORITHMS_LIGHTS_PIPELINE_H

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/lights/carried_loops.h"
#include "algorithms/lights/merge_together.h"
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

  /// A loop, and its points once it has been put out: they do not depend on a light.
  struct StoredLoop {
    explicit StoredLoop(CarriedLoop<Vertex> stored) : loop(std::move(stored)) {}
    CarriedLoop<Vertex> loop;
    bool has_points = false;
    std::vector<std::array<double, 3>> points;
    std::vector<std::array<mpq_class, 3>> exact_points;
  };
  /// A fragment, and the lights that reach all of it so far: bit i stands for light i. Copies share
  /// the loop.
  struct Item {
    std::shared_ptr<StoredLoop> stored;
    std::uint64_t lit_by = 0;
  };
  /// The items of a side of a piece, and the last light that it faces.
  struct PieceItems {
    std::uint32_t first = 0, count = 0;  // into Items::all; none: not yet
    std::uint32_t last_run = 0;
  };
  /// What the lights so far have left of every piece.
  struct Items {
    std::vector<Item> all;
    std::array<std::vector<PieceItems>, 2> of;  // by side and piece
    std::uint64_t bytes() const;
  };

  /// The lights must outlive it; a run is the index of one of them.
  Pipeline(const PreparedScene& scene, const LightScenes<Space>& lights,
           const SceneBsp<SceneVertex>& bsp)
      : scene_(scene), lights_(lights), bsp_(bsp), carrier_(lights) {
    start_again();
  }

  /// Forgets what all lights have left.
  void start_again() {
    items_.all.clear();
    for (auto& pieces : items_.of) pieces.assign(bsp_.pieces.size(), {});
  }
  /// Goes back to what some lights had left. They must be where they were.
  void start_from(const Items& items) { items_ = items; }
  const Items& items() const { return items_; }

  /// The loops that filter() would classify.
  std::vector<CarriedLoop<Vertex>> loops_of(std::uint32_t piece, Side side) {
    std::vector<CarriedLoop<Vertex>> loops;
    for (const Item& item : items_of(piece, side)) loops.push_back(item.stored->loop);
    return loops;
  }
  /// One of them in the space of a light. Valid until the next call, or that of filter().
  LoopView<Vertex> to_light(const CarriedLoop<Vertex>& loop, std::uint32_t piece, Side side,
                            std::uint32_t run) {
    return carrier_.to_light(loop, bsp_.pieces[piece].part, side, run);
  }

  /// Classifies the fragments of a piece by a run: `classify(loop, output)` puts out what becomes
  /// of a loop, as nothing behind the piece casts a shadow. `is_last`: no other light cuts them.
  template <class Classify>
  void filter(std::uint32_t piece, Side side, std::uint32_t run, bool is_last,
              const Classify& classify) {
    const LoopRange& range = bsp_.pieces[piece];
    next_.clear();
    for (Item& item : items_of(piece, side)) {
      ++filtered_;
      output_.clear();
      const LoopView<Vertex> whole = carrier_.to_light(item.stored->loop, range.part, side, run);
      classify(whole, output_);
      for (const ClassifiedLoop& fragment : output_.fragments) {
        const auto loop = output_.loops.view(fragment.loop, plane_of(range.part));
        const bool lit = fragment.state == LightState::kLit;
        const std::uint64_t lit_by = item.lit_by | (lit ? std::uint64_t{1} << run : 0);
        if (has_same_edges(loop, whole)) {
          if (is_last) add_points(*item.stored, whole, run);
          next_.push_back({item.stored, lit_by});
          continue;
        }
        next_.push_back({store(carrier_.from_light(loop, item.stored->loop, side, run)), lit_by});
        if (is_last) {
          add_points(*item.stored, whole, run);
          add_points_of_piece(*next_.back().stored, loop, *item.stored, whole, run);
        }
      }
    }
    PieceItems& own = items_.of[index_of(side)][piece];
    if (next_.size() != own.count) {  // what was there before stays behind
      own.first = static_cast<std::uint32_t>(items_.all.size());
      own.count = static_cast<std::uint32_t>(next_.size());
      items_.all.resize(items_.all.size() + next_.size());
    }
    std::ranges::move(next_, items_.all.begin() + own.first);
    own.last_run = run;
  }

  /// The same where the run has one class for all of the piece.
  void classify_all(std::uint32_t piece, Side side, std::uint32_t run, bool lit) {
    if (lit) {
      for (Item& item : items_of(piece, side)) item.lit_by |= std::uint64_t{1} << run;
    } else {
      items_of(piece, side);
    }
    items_.of[index_of(side)][piece].last_run = run;
  }

  /// Drops what was left behind by pieces that were cut.
  void tidy() {
    std::vector<Item> all;
    all.reserve(items_.all.size());
    for (auto& pieces : items_.of) {
      for (PieceItems& own : pieces) {
        const auto from = items_.all.begin() + own.first;
        own.first = static_cast<std::uint32_t>(all.size());
        std::move(from, from + own.count, std::back_inserter(all));
      }
    }
    items_.all = std::move(all);
  }

  /// Loops that filter() has classified.
  std::uint64_t filtered() const { return filtered_; }

  /// The fragments, as the result tells of them; by MergeOf::kConvex neighbours that the same
  /// lights reach are merged. What is kept for later steps stays as it is.
  void put_out(const RunTask& task, ShadowResult& result) {
    const RunOptions options = run_options_of(task.options);
    std::vector<std::uint32_t> marks;
    for (const auto& light : lights_) marks.push_back(light->space.plane_mark());
    if (options.output.merge && task.options.method.options.merge == MergeOf::kConvex) {
      put_out_merged(task.rules, result);
    } else {
      put_out_all(options, result);
    }
    for (std::size_t i = 0; i < marks.size(); ++i) lights_[i]->space.release_planes(marks[i]);
    const auto key = [&](const CombinedFragment& fragment) {
      return std::pair(scene_.parts[fragment.part].polygon, -static_cast<int>(fragment.side));
    };
    std::ranges::stable_sort(result.combined, {}, key);
  }

 private:
  void put_out_all(const RunOptions& options, ShadowResult& result) {
    for (std::uint32_t piece = 0; piece < bsp_.pieces.size(); ++piece) {
      const std::uint32_t part = bsp_.pieces[piece].part;
      for (const Side side : {Side::kFront, Side::kBack}) {
        const PieceItems& own = items_.of[index_of(side)][piece];
        const std::uint32_t run = own.last_run;
        for (const Item& item : std::span(items_.all).subspan(own.first, own.count)) {
          StoredLoop& stored = *item.stored;
          // In the space of the last light that the side faces.
          if (!stored.has_points) {
            add_points(stored, carrier_.to_light(stored.loop, part, side, run), run);
          }
          put_out(stored, {part, side, item.lit_by}, options, result);
        }
      }
    }
  }
  void put_out_merged(const Rules& rules, ShadowResult& result) {
    std::vector<std::vector<std::uint32_t>> pieces_of(scene_.parts.size());
    for (std::uint32_t piece = 0; piece < bsp_.pieces.size(); ++piece) {
      pieces_of[bsp_.pieces[piece].part].push_back(piece);
    }
    for (std::uint32_t part = 0; part < scene_.parts.size(); ++part) {
      for (const Side side : {Side::kFront, Side::kBack}) {
        put_out_merged(part, side, pieces_of[part], rules, result);
      }
    }
  }
  /// All fragments of a side, in the space of the last light that it faces.
  void put_out_merged(std::uint32_t part, Side side, std::span<const std::uint32_t> pieces,
                      const Rules& rules, ShadowResult& result) {
    const auto& of_side = items_.of[index_of(side)];
    const auto some =
        std::ranges::find_if(pieces, [&](std::uint32_t piece) { return of_side[piece].count > 0; });
    if (some == pieces.end()) return;
    const std::uint32_t run = of_side[*some].last_run;  // of all of them
    LightScene<Space>& light = *lights_[run];
    const std::uint32_t mark = light.space.plane_mark();
    MergeTogether<Space> merge(light.space, rules);
    for (const std::uint32_t piece : pieces) {
      const PieceItems& own = of_side[piece];
      for (const Item& item : std::span(items_.all).subspan(own.first, own.count)) {
        const CarriedLoop<Vertex>& carried = item.stored->loop;
        merge.add(carrier_.to_light(carried, part, side, run), item.lit_by,
                  [&](std::uint32_t edge) { return carrier_.origin_of(carried, edge); });
      }
    }
    merge.run();
    merge.for_each([&](const LoopView<Vertex>& loop, std::uint64_t lit_by) {
      CombinedFragment fragment{part, side, lit_by};
      export_loop(light.space, scene_.geometry, light.options, loop, fragment,
                  result.combined_points, result.combined_exact_points);
      result.combined.push_back(fragment);
    });
    light.space.release_planes(mark);
  }

  static std::shared_ptr<StoredLoop> store(CarriedLoop<Vertex> loop) {
    return std::make_shared<StoredLoop>(std::move(loop));
  }
  /// Whether a piece of a loop is the loop: no cut is in it.
  static bool has_same_edges(const LoopView<Vertex>& piece, const LoopView<Vertex>& loop) {
    return std::ranges::equal(piece.edges, loop.edges);
  }
  /// Adds the points of a loop, which is `loop` in the space of a light.
  void add_points(StoredLoop& stored, const LoopView<Vertex>& loop, std::uint32_t run) const {
    if (stored.has_points) return;
    Fragment range;
    export_loop(lights_[run]->space, scene_.geometry, lights_[run]->options, loop, range,
                stored.points, stored.exact_points);
    stored.has_points = true;
  }
  /// The same for a piece that was cut out of a loop that has points: a corner between the same
  /// edges is the same.
  void add_points_of_piece(StoredLoop& stored, const LoopView<Vertex>& piece,
                           const StoredLoop& from, const LoopView<Vertex>& loop,
                           std::uint32_t run) const {
    for (std::uint32_t i = 0; i < piece.size(); ++i) {
      const PlaneRef before = piece.edges[piece.previous(i)], after = piece.edges[i];
      std::uint32_t k = 0;
      while (k < loop.size() && !(before.valid() && after.valid() && loop.edges[k] == after &&
                                  loop.edges[loop.previous(k)] == before)) {
        ++k;
      }
      if (k == loop.size()) {
        export_corner(lights_[run]->space, scene_.geometry, lights_[run]->options, piece.corner(i),
                      stored.points, stored.exact_points);
        continue;
      }
      if (!from.points.empty()) stored.points.push_back(from.points[k]);
      if (!from.exact_points.empty()) stored.exact_points.push_back(from.exact_points[k]);
    }
    stored.has_points = true;
  }
  static void put_out(const StoredLoop& stored, CombinedFragment fragment,
                      const RunOptions& options, ShadowResult& result) {
    fragment.first =
        static_cast<std::uint32_t>(options.output.points ? result.combined_points.size()
                                                         : result.combined_exact_points.size());
    fragment.count = static_cast<std::uint32_t>(stored.loop.vertices.size());
    result.combined_points.insert(result.combined_points.end(), stored.points.begin(),
                                  stored.points.end());
    result.combined_exact_points.insert(result.combined_exact_points.end(),
                                        stored.exact_points.begin(), stored.exact_points.end());
    result.combined.push_back(fragment);
  }
  static std::size_t index_of(Side side) { return side == Side::kFront ? 0 : 1; }
  PlaneId plane_of(std::uint32_t part) const { return scene_.parts[part].plane; }
  std::span<Item> items_of(std::uint32_t piece, Side side) {
    PieceItems& own = items_.of[index_of(side)][piece];
    const LoopRange& range = bsp_.pieces[piece];
    if (own.count == 0) {
      own.first = static_cast<std::uint32_t>(items_.all.size());
      own.count = 1;
      items_.all.push_back(
          {store(carrier_.from_scene(bsp_.loops.view(range, plane_of(range.part)))), 0});
    }
    return std::span(items_.all).subspan(own.first, own.count);
  }

  const PreparedScene& scene_;
  const LightScenes<Space>& lights_;
  const SceneBsp<SceneVertex>& bsp_;
  LoopCarrier<Space> carrier_;
  Items items_;
  std::vector<Item> next_;
  std::uint64_t filtered_ = 0;
  ClassifiedLoops<Vertex> output_;
};

template <LightSpaceModel Space>
std::uint64_t Pipeline<Space>::Items::bytes() const {
  std::uint64_t sum = all.capacity() * sizeof(Item);
  for (const auto& pieces : of) sum += pieces.capacity() * sizeof(PieceItems);
  for (const Item& item : all) {
    const CarriedLoop<Vertex>& loop = item.stored->loop;
    sum += sizeof(StoredLoop) + loop.vertices.capacity() * sizeof(Vertex) +
           loop.edges.capacity() * sizeof(EdgeOrigin);
  }
  return sum;
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_LIGHTS_PIPELINE_H
