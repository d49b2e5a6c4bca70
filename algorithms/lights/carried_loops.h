// SPDX-License-Identifier: LGPL-3.0-or-later
// Loops carried from one light to the next. Between lights a loop is stored without any light's
// space: each edge by who made it (the scene, or what was done for light j), from which every space
// derives its plane.
#ifndef GNOMON_ALGORITHMS_LIGHTS_CARRIED_LOOPS_H
#define GNOMON_ALGORITHMS_LIGHTS_CARRIED_LOOPS_H

#include <cstdint>
#include <utility>
#include <vector>

#include "algorithms/lights/light_scene.h"
#include "algorithms/partition/loop_store.h"

namespace gnomon {

/// EdgeOrigin says who made an edge: the scene (an input edge or support plane) or a light's run.
struct EdgeOrigin {
  static constexpr std::uint32_t kScene = 0xffffffffu;
  std::uint32_t light = kScene;  // index of the run
  PlaneRef plane;                // in scene space or in that light's space
  friend bool operator==(const EdgeOrigin&, const EdgeOrigin&) = default;
};

/// A loop in counter-clockwise order of its part's loop (seen from the front).
template <class Vertex>
struct CarriedLoop {
  std::vector<Vertex> vertices;
  std::vector<EdgeOrigin> edges;
};

/// Takes loops into the spaces of lights and back.
template <LightSpaceModel Space>
class LoopCarrier {
 public:
  using Vertex = typename Space::Vertex;
  using SceneVertex = typename Space::SceneSpace::Vertex;
  using Carried = CarriedLoop<Vertex>;

  /// The lights must outlive it.
  explicit LoopCarrier(const LightScenes<Space>& lights) : lights_(lights) {}

  Carried from_scene(const LoopView<SceneVertex>& loop) const {
    Carried carried;
    for (std::uint32_t i = 0; i < loop.size(); ++i) {
      carried.vertices.push_back(lights_.front()->space.import_vertex(loop.vertices[i]));
      carried.edges.push_back({EdgeOrigin::kScene, loop.edges[i]});
    }
    return carried;
  }

  /// The loop in the space of light `run`, counter-clockwise as seen from it, on whichever side of
  /// the part. Valid until the next call.
  LoopView<Vertex> to_light(const Carried& carried, std::uint32_t part_index, Side side,
                            std::uint32_t run) {
    LightScene<Space>& light = *lights_[run];
    Space& space = light.space;
    const PlaneId support = light.plane_of(part_index);
    const bool reversed = side == Side::kBack;
    const auto n = static_cast<std::uint32_t>(carried.vertices.size());
    loop_.clear();
    order_.clear();
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t from = reversed ? n - 1 - i : i;
      Vertex vertex = carried.vertices[from];
      if (vertex.source != kMadeVertex) {
        vertex = space.import_vertex(light.scene_space.input_vertex(vertex.source));
      }
      loop_.push(std::move(vertex), PlaneRef());
      order_.push_back(reversed ? (from == 0 ? n - 1 : from - 1) : i);
    }
    for (std::uint32_t i = 0; i < n; ++i) {
      const EdgeOrigin& origin = carried.edges[order_[i]];
      if (origin.light == EdgeOrigin::kScene) {
        loop_.edge(i) = space.import_edge(origin.plane, support, reversed, loop_.vertex(i),
                                          loop_.vertex(i + 1 == n ? 0 : i + 1));
      } else if (origin.light == run) {
        loop_.edge(i) = origin.plane;
      } else {
        loop_.edge(i) = space.import_cut(lights_[origin.light]->space, origin.plane, support);
      }
    }
    for (std::uint32_t i = 0; i < n; ++i) {
      if (loop_.vertex(i).source == kMadeVertex) {
        space.finish_vertex(loop_.vertex(i), loop_.edge(i == 0 ? n - 1 : i - 1), loop_.edge(i));
      }
    }
    return loop_.view({0, loop_.size(), part_index}, support);
  }

  /// Who made an edge of the loop that to_light() gave last, from `carried`.
  const EdgeOrigin& origin_of(const Carried& carried, std::uint32_t edge) const {
    return carried.edges[order_[edge]];
  }
  /// Takes a piece of the loop that to_light() gave last back from the light's space; edges that
  /// `from`, that loop, has keep their origin.
  Carried from_light(const LoopView<Vertex>& piece, const Carried& from, Side side,
                     std::uint32_t run) const {
    const bool reversed = side == Side::kBack;
    const std::uint32_t n = piece.size();
    Carried carried;
    carried.vertices.resize(n);
    carried.edges.resize(n);
    for (std::uint32_t i = 0; i < n; ++i) {
      EdgeOrigin origin{run, piece.edges[i]};
      for (std::uint32_t k = 0; k < loop_.size(); ++k) {
        if (piece.edges[i].valid() && loop_.edge(k) == piece.edges[i]) {
          origin = from.edges[order_[k]];
          break;
        }
      }
      const std::uint32_t vertex = reversed ? n - 1 - i : i;
      const std::uint32_t edge = reversed ? (vertex == 0 ? n - 1 : vertex - 1) : i;
      carried.vertices[vertex] = piece.vertices[i];
      carried.edges[edge] = origin;
    }
    return carried;
  }

 private:
  const LightScenes<Space>& lights_;
  LoopStore<Vertex> loop_;
  std::vector<std::uint32_t> order_;  // loop_ edge -> edge of the carried loop
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_LIGHTS_CARRIED_LOOPS_H
