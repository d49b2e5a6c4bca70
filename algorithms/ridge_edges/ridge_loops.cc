// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/algorithms/ridge_loops.h"

#include <utility>

#include "algorithms/ridge_edges/light_directions.h"
#include "algorithms/ridge_edges/loop_depth.h"
#include "algorithms/ridge_edges/ridge_arcs.h"
#include "algorithms/ridge_edges/separate_loops.h"
#include "gnomon/algorithms/components.h"
#include "gnomon/algorithms/facing_sides.h"

namespace gnomon {

namespace {

RidgeLoop described(const PreparedScene& scene, const StretchLoop& strung,
                    std::span<const Stretch> stretches, const RidgeArcs& arcs,
                    const FacingCones& cones) {
  RidgeLoop loop;
  std::vector<const DirectionVector*> rays;
  for (std::size_t i = 0; i < strung.size(); ++i) {
    const Stretch& stretch = stretches[strung[i]];
    const Stretch& before = stretches[strung[i == 0 ? strung.size() - 1 : i - 1]];
    const bool imaginary = before.edge != stretch.edge &&
                           !arcs.meet_in_space(scene, before.edge, stretch.edge, stretch.from_ray);
    loop.steps.push_back({stretch.from_ray, stretch.edge, imaginary});
    rays.push_back(&arcs.rays()[stretch.from_ray].exact);
  }
  const Stretch& first = stretches[strung.front()];
  loop.depth =
      cones.depth_left_of(arcs.rays()[first.from_ray].exact, arcs.rays()[first.to_ray].exact) -
      first.inner;
  if (loop.depth > 1) {
    loop.kind = LoopKind::kInternal;
  } else {
    loop.kind = is_counter_clockwise(rays) ? LoopKind::kExternal : LoopKind::kHole;
  }
  return loop;
}

Expected<RidgeLoops> loops_of(const PreparedScene& scene, const Component& component,
                              std::span<const Side> facing, const LightDirections& directions,
                              const std::atomic<bool>* interrupted) {
  RidgeLoops result;
  const FacingCones cones(scene, component.parts, facing, directions.of);
  result.facing_parts = static_cast<std::uint32_t>(cones.size());
  result.edges = ridge_edges_of(scene, component.parts, facing);
  RidgeArcs arcs(scene, directions.of, result.edges);
  if (!arcs.cut(scene, result, interrupted)) {
    return fail(ErrorCode::kInterrupted, "interrupted");
  }
  const std::vector<Stretch> stretches = arcs.stretches(result.cancelled);
  for (const StretchLoop& strung : separate_loops(stretches, arcs)) {
    if (interrupted != nullptr && interrupted->load(std::memory_order_relaxed)) {
      return fail(ErrorCode::kInterrupted, "interrupted");
    }
    result.loops.push_back(described(scene, strung, stretches, arcs, cones));
  }
  for (const FilteredVector& ray : arcs.rays()) {
    result.rays.push_back(directions.exported(ray.exact));
  }
  return result;
}

}  // namespace

const char* name_of(LoopKind kind) {
  switch (kind) {
    case LoopKind::kExternal:
      return "external";
    case LoopKind::kHole:
      return "hole";
    case LoopKind::kInternal:
      break;
  }
  return "internal";
}

Expected<std::vector<RidgeLoops>> ridge_loops(const Scene& scene, const PreparedScene& prepared,
                                              std::uint32_t light, OpenComponents open,
                                              const std::atomic<bool>* interrupted) {
  if (prepared.lights[light].has_area()) {
    return fail(ErrorCode::kUsage, "light '" + scene.lights[light].id + "' has an area",
                "a point or directional light");
  }
  const LightPoint& point = prepared.lights[light].point;
  const std::vector<Side> facing = facing_sides(prepared, point);
  const LightDirections directions(prepared.geometry, point);
  const std::vector<Component> components = find_components(prepared);
  std::vector<RidgeLoops> result;
  for (std::uint32_t i = 0; i < components.size(); ++i) {
    const Component& component = components[i];
    if (!component.is_closed && open == OpenComponents::kRefused) {
      return fail(ErrorCode::kGeometry, unpaired_edge_text(scene, prepared, component.unpaired),
                  "closed solids; --open takes borders for ridge edges");
    }
    auto loops = loops_of(prepared, component, facing, directions, interrupted);
    if (!loops) return tl::unexpected(std::move(loops.error()));
    if (loops->facing_parts == 0) continue;
    loops->component = i;
    result.push_back(*std::move(loops));
  }
  return result;
}

}  // namespace gnomon
