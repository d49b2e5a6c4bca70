// SPDX-License-Identifier: LGPL-3.0-or-later
// The scene in order as seen from a light: the nodes of the scene BSP front to back, and of each
// node the pieces that face the light. They are coplanar, so that none of them shadows another; no
// piece of a later group is in front of one of an earlier group.
#ifndef GNOMON_ALGORITHMS_LIGHTS_LIGHT_GROUPS_H
#define GNOMON_ALGORITHMS_LIGHTS_LIGHT_GROUPS_H

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/lights/light_scene.h"
#include "algorithms/scene_bsp/scene_bsp.h"
#include "algorithms/scene_bsp/scene_bsp.inl.h"

namespace gnomon {

/// All parts that face one of the lights at least, only which have to be in order for them.
template <LightSpaceModel Space>
std::vector<std::uint32_t> parts_that_face(const PreparedScene& scene,
                                           const LightScenes<Space>& lights) {
  std::vector<bool> needed(scene.parts.size(), false);
  for (const auto& light : lights) {
    for (const std::uint32_t part : light->facing.parts) needed[part] = true;
  }
  std::vector<std::uint32_t> parts;
  for (std::uint32_t i = 0; i < scene.parts.size(); ++i) {
    if (needed[i]) parts.push_back(i);
  }
  return parts;
}

/// The scene BSP of these parts. The result gets its counts and time. Errors: kInterrupted, kLimit.
template <SceneSpaceModel SceneSpace>
Expected<SceneBsp<typename SceneSpace::Vertex>> order_scene(const RunTask& task,
                                                            SceneSpace& scene_space,
                                                            std::span<const std::uint32_t> parts,
                                                            ShadowResult& result) {
  const double start = cpu_seconds();
  const ShadowOptions& options = task.options;
  auto bsp = build_scene_bsp(scene_space, task.scene, parts, options.method.seed, result.identity,
                             options.control.interrupted, options.limits.fragments, task.rules,
                             options.method.options.roots);
  if (bsp.interrupted) return stopped_by(RunOutcome::kInterrupted, options);
  if (bsp.too_many) return stopped_by(RunOutcome::kTooManyFragments, options);
  result.scene_bsp_seconds = cpu_seconds() - start;
  result.bsp_nodes = bsp.nodes.size();
  result.bsp_depth = bsp.depth;
  for (const BspNode& node : bsp.nodes) result.bsp_fragments += node.count;
  return bsp;
}

/// Calls visit(pieces) for each group, front to back; `pieces` are indices into SceneBsp::pieces.
/// visit() returns kDone to go on. progress(i) gets the number of nodes done.
template <LightSpaceModel Space, class Progress, class Visit>
RunOutcome for_each_group(const LightScene<Space>& light,
                          const SceneBsp<typename Space::SceneSpace::Vertex>& bsp,
                          const Progress& progress, const Visit& visit) {
  const std::vector<std::uint32_t> order = front_to_back(bsp.nodes, [&](PlaneId plane) {
    const std::vector<Sign>& known = light.facing.plane_signs;  // of the parts' planes
    return plane < known.size() ? known[plane] : light.space.light_side(plane);
  });
  std::vector<std::uint32_t> pieces;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if ((i & 63) == 0) {
      const std::atomic<bool>* interrupted = light.options.interrupted;
      if (interrupted != nullptr && interrupted->load(std::memory_order_relaxed)) {
        return RunOutcome::kInterrupted;
      }
      progress(i);
    }
    const BspNode& node = bsp.nodes[order[i]];
    pieces.clear();
    for (std::uint32_t k = 0; k < node.count; ++k) {
      const std::uint32_t piece = bsp.node_pieces[node.first + k];
      const std::uint32_t part = bsp.pieces[piece].part;
      if (light.facing.facing[part].faces() && !light.region.is_dropped(part)) {
        pieces.push_back(piece);
      }
    }
    const RunOutcome outcome = visit(std::span<const std::uint32_t>(pieces));
    if (outcome != RunOutcome::kDone) return outcome;
  }
  return RunOutcome::kDone;
}

/// Progress of several lights that take the same number of steps each.
class LightProgress {
 public:
  LightProgress(const RunControl& control, std::size_t steps, std::size_t lights)
      : control_(control), steps_(steps), total_(static_cast<double>(steps * lights)) {}
  void operator()(std::size_t light, std::size_t step) const {
    if (control_.progress) control_.progress(static_cast<double>(light * steps_ + step) / total_);
  }

 private:
  const RunControl& control_;
  std::size_t steps_;
  double total_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_LIGHTS_LIGHT_GROUPS_H
