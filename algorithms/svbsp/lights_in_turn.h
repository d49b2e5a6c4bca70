// SPDX-License-Identifier: LGPL-3.0-or-later
// Several lights in a pipeline of SVBSP trees (Chin & Feiner 1989, secs. 3, 5 and 6), and what of
// it is done again when some of them move: the trees of those, and the filtering of what the lights
// before them have left by them and by all that follow. The scene BSP is the same from everywhere,
// and the tree of a light that stays where it is stays as it is, since it is permanent (svbsp.h).
//
// Guarantee: a step has the result, bit for bit, that it would have as the first one.
#ifndef GNOMON_ALGORITHMS_SVBSP_LIGHTS_IN_TURN_H
#define GNOMON_ALGORITHMS_SVBSP_LIGHTS_IN_TURN_H

#include <algorithm>
#include <cstdint>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "algorithms/lights/light_groups.h"
#include "algorithms/lights/pipeline.h"
#include "algorithms/svbsp/svbsp_run.h"

namespace gnomon {

template <LightSpaceModel Space>
class LightsInTurn {
 public:
  using Order = SceneBsp<typename Space::SceneSpace::Vertex>;

  /// Whether trees can grow from fragments: kernels that construct vertices have planes through any
  /// two of them.
  static constexpr bool kGrowsFromFragments = Space::kMakesPlanesOfVertices;

  /// Light i of every step is light i here, whose bit is i. `bsp` holds all parts.
  LightsInTurn(const RunTask& task, typename Space::SceneSpace& scene_space, const Order& bsp)
      : task_(task),
        scene_space_(scene_space),
        bsp_(bsp),
        lights_(task.lights.size()),
        pipeline_(task.scene, lights_, bsp),
        slots_(task.lights.size()),
        kept_(task.lights.size()),
        progress_(task.options.control, 2 * bsp.nodes.size(),
                  task.lights.size() * (task.options.steps.size() + 1)) {
    for (const LightList& step : task.options.steps) {
      for (std::size_t i = 0; i < step.size(); ++i) {
        slots_[i].moves = slots_[i].moves || step[i] != task.lights[i];
      }
    }
  }

  /// Step 0 is that of the task's lights. Steps in their order. Adds the lights, the fragments and
  /// the counts to `result`.
  RunOutcome run_step(std::size_t step, ShadowResult& result);
  /// Needs the results of the lights, those of a step, for the next one.
  void take_back(std::vector<LightResult> results) {
    for (std::size_t i = 0; i < results.size(); ++i) slots_[i].own = std::move(results[i]);
  }

 private:
  struct Slot {
    bool moves = false;                    // at some step
    bool moved = true;                     // at this one
    std::unique_ptr<SvbspRun<Space>> run;  // while its tree is of use
    LightResult own;
    std::uint64_t own_tree_bytes = 0, own_vanished = 0;
    std::uint64_t filtered = 0;  // loops that it classified in the pipeline
    std::uint64_t vanished = 0;  // there
  };

  const LightList& lights_at(std::size_t step) const {
    return step == 0 ? task_.lights : task_.options.steps[step - 1];
  }
  const MethodOptionValues& values() const { return task_.options.method.options; }
  bool is_last(std::size_t step) const { return step == task_.options.steps.size(); }

  void move_lights(std::size_t step);
  std::vector<std::uint32_t> order_of_lights() const;
  /// Whether what has been left before this place in the order is worth a copy.
  bool is_start(std::size_t place, std::size_t step) const {
    return place > 0 && !is_last(step) &&
           (slots_[order_[place]].moves || values().light_order == LightOrder::kFacing);
  }
  bool keeps_tree(std::size_t place, std::size_t step) const;
  RunOutcome run_light(std::size_t place, std::size_t start, std::size_t changed, std::size_t step,
                       TogetherCounts& counts);
  std::uint64_t tree_bytes() const {
    std::uint64_t sum = 0;
    for (const Slot& slot : slots_) sum += slot.run ? slot.run->tree_bytes() : 0;
    return sum;
  }
  void count(TogetherCounts& counts) const;

  const RunTask& task_;
  typename Space::SceneSpace& scene_space_;
  const Order& bsp_;
  LightScenes<Space> lights_;
  Pipeline<Space> pipeline_;
  std::vector<Slot> slots_;
  std::vector<std::uint32_t> order_;  // of lights, first in the pipeline first
  // By place in the order: what the lights before it have left.
  std::vector<std::optional<typename Pipeline<Space>::Items>> kept_;
  LightProgress progress_;
};

template <LightSpaceModel Space>
RunOutcome LightsInTurn<Space>::run_step(std::size_t step, ShadowResult& result) {
  move_lights(step);
  const std::vector<std::uint32_t> order = order_of_lights();
  std::size_t changed = 0;  // the first place at which anything is new
  while (changed < order.size() && changed < order_.size() && order_[changed] == order[changed] &&
         !slots_[order[changed]].moved) {
    ++changed;
  }
  order_ = order;
  TogetherCounts counts;
  if (changed < order.size()) {
    std::size_t start = changed;
    while (start > 0 && !kept_[start]) --start;
    if (start > 0) {
      pipeline_.start_from(*kept_[start]);
    } else {
      pipeline_.start_again();
    }
    for (std::size_t place = start; place < order.size(); ++place) {
      const RunOutcome outcome = run_light(place, start, changed, step, counts);
      if (outcome != RunOutcome::kDone) return outcome;
    }
  }
  for (Slot& slot : slots_) {
    slot.own.dropped_slivers = slot.own_vanished + slot.vanished;
    if (!put_light(task_.options, std::move(slot.own), result)) return RunOutcome::kInterrupted;
  }
  pipeline_.put_out(task_, result);
  count(counts);
  result.together = counts;
  for (const auto& light : lights_) result.stages += light->space.stage_counts();
  return RunOutcome::kDone;
}

template <LightSpaceModel Space>
void LightsInTurn<Space>::move_lights(std::size_t step) {
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const std::uint32_t light = lights_at(step)[i];
    Slot& slot = slots_[i];
    slot.moved = !lights_[i] || lights_[i]->light != light;
    if (!slot.moved) continue;
    slot.run.reset();
    lights_[i] = std::make_unique<LightScene<Space>>(task_, scene_space_, light);
  }
}

/// A light that is early in the order has little left to cut, and is seldom done again.
template <LightSpaceModel Space>
std::vector<std::uint32_t> LightsInTurn<Space>::order_of_lights() const {
  std::vector<std::uint32_t> order(slots_.size());
  std::iota(order.begin(), order.end(), 0u);
  if (values().light_order == LightOrder::kFile) return order;
  const auto facing = [&](std::uint32_t i) { return lights_[i]->facing.parts.size(); };
  // Numbers that change from step to step would move a light that stays where it is.
  std::ranges::stable_sort(order, {}, [&](std::uint32_t i) {
    const bool last = values().light_order == LightOrder::kMoving && slots_[i].moves;
    return std::pair(last, last ? 0 : facing(i));
  });
  return order;
}

/// Whether a later step filters by this tree as it is.
template <LightSpaceModel Space>
bool LightsInTurn<Space>::keeps_tree(std::size_t place, std::size_t step) const {
  if (is_last(step) || values().grow == GrowFrom::kFragments) return false;
  const std::uint32_t light = order_[place];
  if (lights_at(step + 1)[light] != lights_at(step)[light]) return false;
  if (values().light_order == LightOrder::kFacing) return true;
  return std::any_of(order_.begin(), order_.begin() + static_cast<std::ptrdiff_t>(place),
                     [&](std::uint32_t before) { return slots_[before].moves; });
}

template <LightSpaceModel Space>
RunOutcome LightsInTurn<Space>::run_light(std::size_t place, std::size_t start, std::size_t changed,
                                          std::size_t step, TogetherCounts& counts) {
  const std::uint32_t light = order_[place];
  Slot& slot = slots_[light];
  if (!is_start(place, step)) {
    kept_[place].reset();
  } else if (place > start || !kept_[place]) {  // where it starts, it is what was kept
    kept_[place] = pipeline_.items();
  }
  const std::uint64_t filtered_before = pipeline_.filtered();
  const auto progress = [&](std::size_t half) {
    return [this, step, place, half](std::size_t nodes) {
      progress_(step * order_.size() + place, half * bsp_.nodes.size() + nodes);
    };
  };
  const bool is_last_light = place + 1 == order_.size();
  const bool from_fragments = values().grow == GrowFrom::kFragments;
  RunOutcome outcome = RunOutcome::kDone;
  if (!slot.run || (from_fragments && place > changed)) {
    ++counts.trees_built;
    if (from_fragments && !slot.moved) {
      lights_[light] =
          std::make_unique<LightScene<Space>>(task_, scene_space_, lights_at(step)[light]);
    }
    slot.run = std::make_unique<SvbspRun<Space>>(*lights_[light], values());
    outcome = from_fragments ? slot.run->grow_from_fragments(bsp_, pipeline_, light, is_last_light,
                                                             progress(0))
                             : slot.run->grow(bsp_, progress(0));
    if (outcome != RunOutcome::kDone) return outcome;
    slot.own_tree_bytes = slot.run->tree_bytes();
    slot.own = slot.run->finish(bsp_);
    slot.own_vanished = slot.own.dropped_slivers;
    slot.own.method = MethodId::kSvbsp;
  }
  if (!from_fragments)
    outcome = slot.run->classify(bsp_, pipeline_, light, is_last_light, progress(1));
  slot.filtered = pipeline_.filtered() - filtered_before;
  slot.vanished = slot.run->vanished_in_pipeline();
  pipeline_.tidy();
  counts.filters += slot.filtered;
  counts.tree_bytes_at_once = std::max(counts.tree_bytes_at_once, tree_bytes());
  if (!keeps_tree(place, step)) slot.run.reset();
  return outcome;
}

template <LightSpaceModel Space>
void LightsInTurn<Space>::count(TogetherCounts& counts) const {
  counts.trees = slots_.size();
  for (const Slot& slot : slots_) {
    counts.filters_from_nothing += slot.filtered;
    counts.tree_bytes += slot.own_tree_bytes;
  }
  for (const auto& items : kept_) {
    if (items) counts.kept_bytes += items->bytes();
  }
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SVBSP_LIGHTS_IN_TURN_H
