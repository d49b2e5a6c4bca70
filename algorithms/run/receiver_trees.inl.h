// SPDX-License-Identifier: LGPL-3.0-or-later
// How the trees of one light grow (1992): all casters before any receiver, or both in the order of
// a scene BSP. Bodies of receiver_run.h.
#ifndef GNOMON_ALGORITHMS_RUN_RECEIVER_TREES_INL_H
#define GNOMON_ALGORITHMS_RUN_RECEIVER_TREES_INL_H

#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "algorithms/run/receiver_run.h"

namespace gnomon {

template <VolumeSpaceModel Space>
bool ReceiverRun<Space>::order_scene() {
  if (order_) return true;
  std::vector<std::uint32_t> parts(scene_.parts.size());
  std::iota(parts.begin(), parts.end(), 0u);
  const bool identity = empty_result(options_).identity;
  auto bsp = build_scene_bsp(scene_space_, scene_, parts, options_.method.seed, identity,
                             options_.control.interrupted, options_.limits.fragments, rules_);
  if (bsp.too_many) pieces_ = options_.limits.fragments + 1;
  if (bsp.too_many || bsp.interrupted) {
    stopped_ = true;
    return false;
  }
  order_ = std::move(bsp.nodes);
  return true;
}

template <VolumeSpaceModel Space>
bool ReceiverRun<Space>::is_done(typename Trees::Outcome outcome) {
  if (outcome == Trees::Outcome::kTooManyNodes) {
    pieces_ = options_.limits.fragments + 1;
    stopped_ = true;
  }
  return outcome == Trees::Outcome::kDone;
}

template <VolumeSpaceModel Space>
bool ReceiverRun<Space>::begin_trees(const LightInSpace<Space>& light, Trees& trees,
                                     FilteredSides<Vertex>& filtered) {
  std::vector<std::uint32_t> receivers;
  {
    Workspace workspace(space_.fork(), rules_);
    for (std::uint32_t i = 0; i < scene_.parts.size(); ++i) {
      if (stopped()) return false;
      bool takes_one = false;
      for (const Side side : {Side::kFront, Side::kBack}) {
        if (side == Side::kBack && !scene_.parts[i].two_sided) break;
        if (!light.sight(workspace, i, side).sees() ||
            !trees.takes(workspace.space, workspace.record, plane_of_side(scene_.parts[i], side))) {
          continue;
        }
        filtered.take(i, side);
        takes_one = true;
      }
      if (takes_one) receivers.push_back(i);
    }
    stages_ += workspace.space.stage_counts();
  }
  trees.begin(receivers);
  return true;
}

template <VolumeSpaceModel Space>
bool ReceiverRun<Space>::build_trees(const LightInSpace<Space>& light, double from, double to,
                                     Trees& trees, WorkCounts& counts) {
  FilteredSides<Vertex> sides;
  if (!begin_trees(light, trees, sides)) return false;
  std::vector<std::uint32_t> volumes;
  if (is_interleaved()) {
    if (!order_scene()) return false;
    volumes = Order(space_, light, scene_, *order_, rules_).volumes();
  } else {
    volumes = trees.near_first();
  }
  const auto step = [&](double share) {
    if (options_.control.progress) options_.control.progress(from + (to - from) * share);
    return !stopped();
  };
  const auto outcome = trees.cast_all(volumes, jobs(), step, [&] { return stopped(); });
  stages_ += trees.stage_counts();
  counts[Counter::kNodes] += trees.node_count();
  counts.at_least(Counter::kDepth, trees.depth());
  return is_done(outcome);
}

template <VolumeSpaceModel Space>
bool ReceiverRun<Space>::interleave(const LightInSpace<Space>& light, double from, double to,
                                    Trees& trees, FilteredSides<Vertex>& filtered,
                                    LightResult& result) {
  if (!begin_trees(light, trees, filtered) || !order_scene()) return false;
  const Order order(space_, light, scene_, *order_, rules_);
  Workspace workspace(space_.fork(), rules_);
  using Outcome = typename Trees::Outcome;
  Outcome outcome = Outcome::kDone;
  std::uint64_t steps = 0, fragments = 0;
  const double all = static_cast<double>(order.piece_count() + light.volumes().size() + 1);
  const auto goes_on = [&] {
    if (options_.control.progress && (steps & 15) == 0) {
      options_.control.progress(from + (to - from) * (static_cast<double>(steps) / all));
    }
    ++steps;
    return !stopped();
  };
  const auto receive = [&](const Loop& piece) {
    if (!goes_on()) return false;
    const std::uint32_t part = piece.part;
    for (const Side side : {Side::kFront, Side::kBack}) {
      if (!filtered.has(part, side)) continue;
      ++result.work[Counter::kScenePieces];
      cut(workspace, light, taken_by(workspace, &trees, part, side),
          plane_of_side(scene_.parts[part], side), piece,
          [&](const PieceClass& state, const Loop& loop) {
            filtered.add(part, side, state, loop);
            return ++fragments <= options_.limits.fragments;
          });
      if (fragments <= options_.limits.fragments) continue;
      outcome = Outcome::kTooManyNodes;
      return false;
    }
    return true;
  };
  const auto cast = [&](std::uint32_t volume) {
    if (!goes_on()) return false;
    if (trees.cast(volume)) return true;
    outcome = Outcome::kTooManyNodes;
    return false;
  };
  if (!order.visit(receive, cast) && outcome == Outcome::kDone) outcome = Outcome::kStopped;
  stages_ += workspace.space.stage_counts();
  result.dropped_slivers += order.vanished();
  if (workspace.trees) result.dropped_slivers += workspace.trees->filter.vanished();
  result.work[Counter::kNodes] = trees.node_count();
  result.work.at_least(Counter::kDepth, trees.depth());
  return is_done(outcome);
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_RUN_RECEIVER_TREES_INL_H
