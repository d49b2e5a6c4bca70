// SPDX-License-Identifier: LGPL-3.0-or-later
// A prepared scene as one point or directional light sees it: what every method that works in light
// space starts from. Which parts face the light, and parts and pieces of them as loops of its light
// space, counter-clockwise seen from the light.
#ifndef GNOMON_ALGORITHMS_LIGHTS_LIGHT_SCENE_H
#define GNOMON_ALGORITHMS_LIGHTS_LIGHT_SCENE_H

#include <cstdint>
#include <memory>
#include <vector>

#include "algorithms/partition/classified_loop.h"
#include "algorithms/partition/import_export.h"
#include "algorithms/partition/light_region.h"
#include "algorithms/partition/run_task.h"

namespace gnomon {

/// Not copied or moved: trees and sinks refer to it.
template <LightSpaceModel Space>
struct LightScene {
  using SceneSpace = typename Space::SceneSpace;
  using SceneVertex = typename SceneSpace::Vertex;
  using Vertex = typename Space::Vertex;

  LightScene(const RunTask& task, SceneSpace& scene_of_light, std::uint32_t light_index)
      : scene(task.scene),
        options(run_options_of(task.options)),
        rules(task.rules),
        light(light_index),
        scene_space(scene_of_light),
        space(scene_of_light, task.scene.lights[light_index].point, task.options.kernel.options()),
        facing(task.scene, space, task.rules),
        // What lights leave together is told of all that they face.
        region(task.scene, light_index, space, scene_of_light, facing,
               task.combined.empty() ? RegionCull::kDrop : RegionCull::kKeep) {}
  LightScene(const LightScene&) = delete;
  LightScene& operator=(const LightScene&) = delete;

  const Part& part(std::uint32_t index) const { return scene.parts[index]; }
  PlaneId plane_of(std::uint32_t part) const { return scene.parts[part].plane; }
  bool casts(std::uint32_t part) const {
    return casts_under(scene.lights[light], scene.parts[part]);
  }
  /// Calls inside(loop) for what of a loop is in the light's region; the rest is put out.
  template <class Inside>
  void clip_to_region(const LoopView<Vertex>& loop, ClassifiedLoops<Vertex>& output,
                      const Inside& inside) {
    clip_.clip(
        space, region, loop, [&](const LoopView<Vertex>& piece) { output.add_outside(piece); },
        inside);
  }
  /// The same, where shadows are painted: put(loop) gets what is outside.
  template <class Put, class Inside>
  void clip_and_paint(const LoopView<Vertex>& loop, const Put& put, const Inside& inside) {
    clip_.clip(space, region, loop, put, inside);
  }
  const LightPoint& light_point() const { return scene.lights[light].point; }

  /// Appends a piece of a part that faces the light to `store`.
  LoopRange import(const LoopView<SceneVertex>& piece, LoopStore<Vertex>& store) {
    const LoopRange range{store.size(), piece.size(), piece.part};
    store.resize(range.first + range.count);
    import_loop(space, piece, facing.facing[piece.part].side == Side::kBack, store, range.first);
    return range;
  }
  /// Appends a whole part.
  LoopRange import_part(std::uint32_t index, LoopStore<Vertex>& store) {
    return import(part_loop(scene_space, scene, index, whole_), store);
  }
  /// The same, where planes of edges are looked at from now on: a kernel without identity computes
  /// them here, once a loop.
  LoopRange with_edge_planes(const LoopRange& range, LoopStore<Vertex>& store) {
    if (space.knows_identity()) return range;
    for (std::uint32_t i = 0; i < range.count; ++i) {
      PlaneRef& edge = store.edge(range.first + i);
      edge = space.shadow_plane(edge, store.vertex(range.first + i),
                                store.vertex(range.first + (i + 1 == range.count ? 0 : i + 1)));
    }
    return range;
  }

  const PreparedScene& scene;
  const RunOptions options;
  const Rules& rules;
  std::uint32_t light;
  SceneSpace& scene_space;
  Space space;
  FacingParts facing;
  LightRegion region;

 private:
  RegionClip<Space> clip_;
  LoopStore<SceneVertex> whole_;
};

/// The scene as each of several lights sees it. One may be put in the place of another between two
/// runs.
template <LightSpaceModel Space>
using LightScenes = std::vector<std::unique_ptr<LightScene<Space>>>;

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_LIGHTS_LIGHT_SCENE_H
