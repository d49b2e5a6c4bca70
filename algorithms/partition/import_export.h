// SPDX-License-Identifier: LGPL-3.0-or-later
// What every shadow algorithm does first and last for one light: which side of each part faces it,
// parts as loops in light space, and loops as the points that the caller asked for.
#ifndef GNOMON_ALGORITHMS_PARTITION_IMPORT_EXPORT_H
#define GNOMON_ALGORITHMS_PARTITION_IMPORT_EXPORT_H

#include <array>
#include <cstdint>
#include <ctime>
#include <utility>
#include <vector>

#include "algorithms/partition/fractions.h"
#include "algorithms/partition/loop_store.h"
#include "algorithms/partition/rules.h"
#include "algorithms/partition/run_options.h"
#include "gnomon/algorithms/shadow_result.h"
#include "gnomon/scene/prepare.h"
#include "kernel/concept/kernel_concept.h"

namespace gnomon {

/// CPU time of this process in seconds.
inline double cpu_seconds() {
  return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

/// How a part stands to a light.
struct Facing {
  Side side = Side::kFront;  // the part's side that faces
  ShadowReason reason = ShadowReason::kNone;
  bool faces() const { return reason == ShadowReason::kNone; }
};

inline Facing facing_of(const Part& part, Sign plane_at_light, const Rules& rules) {
  if (plane_at_light == Sign::kZero) {
    if (!rules.light_in_plane_does_not_reach) return {};
    return {Side::kFront, ShadowReason::kLightInPlane};
  }
  const Sign at_light = part.flipped ? -plane_at_light : plane_at_light;
  if (at_light == Sign::kPositive) return {Side::kFront, ShadowReason::kNone};
  if (part.two_sided) return {Side::kBack, ShadowReason::kNone};
  return {Side::kFront, ShadowReason::kFacesAway};
}

/// The sides of all parts that face one light.
struct FacingParts {
  std::vector<Sign> plane_signs;     // of the support planes at the light
  std::vector<Facing> facing;        // per part
  std::vector<std::uint32_t> parts;  // those that face
  std::uint64_t edges = 0;           // of those

  template <LightSpaceModel Space>
  FacingParts(const PreparedScene& scene, const Space& space, const Rules& rules) {
    plane_signs.reserve(scene.geometry.planes.size());
    for (PlaneId plane = 0; plane < scene.geometry.planes.size(); ++plane) {
      plane_signs.push_back(space.light_side(plane));
    }
    facing.reserve(scene.parts.size());
    for (std::uint32_t i = 0; i < scene.parts.size(); ++i) {
      const Part& part = scene.parts[i];
      facing.push_back(facing_of(part, plane_signs[part.plane], rules));
      if (facing.back().faces()) {
        parts.push_back(i);
        edges += part.count;
      }
    }
  }
};

/// Writes a scene-space loop to store[first ...] as a loop of light space, counter-clockwise seen
/// from the light; `reversed`: its back faces the light.
template <LightSpaceModel Space>
void import_loop(Space& space, const LoopView<typename Space::SceneSpace::Vertex>& loop,
                 bool reversed, LoopStore<typename Space::Vertex>& store, std::uint32_t first) {
  const std::uint32_t n = loop.size();
  // Reversed: vertex i becomes n - 1 - i, and the edge that ended in it now starts from it.
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t from = reversed ? n - 1 - i : i;
    store.vertex(first + i) = space.import_vertex(loop.vertices[from]);
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t edge = reversed ? loop.previous(n - 1 - i) : i;
    store.edge(first + i) =
        space.import_edge(loop.edges[edge], loop.support, reversed, store.vertex(first + i),
                          store.vertex(first + (i + 1 == n ? 0 : i + 1)));
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    auto& vertex = store.vertex(first + i);
    if (vertex.source == kMadeVertex) {
      space.finish_vertex(vertex, store.edge(first + (i == 0 ? n - 1 : i - 1)),
                          store.edge(first + i));
    }
  }
}

/// A whole part as a loop of a space that names input edges as scene space does, in `store` (which
/// is cleared).
template <class SceneSpace>
LoopView<typename SceneSpace::Vertex> part_loop(const SceneSpace& space, const PreparedScene& scene,
                                                std::uint32_t index,
                                                LoopStore<typename SceneSpace::Vertex>& store) {
  const Part& part = scene.parts[index];
  const auto vertices = scene.loop(part);
  const auto edges = scene.edges(part);
  const SceneEdges names = space.edges();
  store.clear();
  for (std::uint32_t i = 0; i < part.count; ++i) {
    store.push(space.input_vertex(vertices[i]),
               names.of_edge(edges[i].index(), edges[i].flipped()));
  }
  return store.view({0, part.count, index}, part.plane);
}

inline std::array<double, 3> nearest_doubles(const std::array<mpq_class, 3>& point) {
  return {nearest_double(point[0]), nearest_double(point[1]), nearest_double(point[2])};
}

/// Appends a corner of a loop to the points that the options ask for.
template <LightSpaceModel Space>
void export_corner(const Space& space, const Geometry& geometry, const RunOptions& options,
                   const Corner<typename Space::Vertex>& corner,
                   std::vector<std::array<double, 3>>& points,
                   std::vector<std::array<mpq_class, 3>>& exact_points) {
  const bool input = corner.vertex.source != kMadeVertex;
  if constexpr (requires { space.nearest_position(corner); }) {
    if (!options.output.exact_points) {
      if (const auto nearest = space.nearest_position(corner)) {
        points.push_back(*nearest);
        return;
      }
    }
  }
  if (options.output.exact_points || (!input && Space::kExact)) {
    std::array<mpq_class, 3> exact = space.exact_position(corner);
    if (options.output.points) {
      points.push_back(input ? geometry.positions[corner.vertex.source] : nearest_doubles(exact));
    }
    if (options.output.exact_points) exact_points.push_back(std::move(exact));
  } else if (input) {
    points.push_back(geometry.positions[corner.vertex.source]);
  } else {
    const std::array<Ball, 3> point = space.position(corner);
    points.push_back({point[0].middle, point[1].middle, point[2].middle});
  }
}

/// The same for all vertices of a loop; the fragment gets their range.
template <LightSpaceModel Space, class OutputFragment>
void export_loop(const Space& space, const Geometry& geometry, const RunOptions& options,
                 const LoopView<typename Space::Vertex>& loop, OutputFragment& fragment,
                 std::vector<std::array<double, 3>>& points,
                 std::vector<std::array<mpq_class, 3>>& exact_points) {
  fragment.first =
      static_cast<std::uint32_t>(options.output.points ? points.size() : exact_points.size());
  fragment.count = loop.size();
  for (std::uint32_t i = 0; i < loop.size(); ++i) {
    export_corner(space, geometry, options, loop.corner(i), points, exact_points);
  }
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PARTITION_IMPORT_EXPORT_H
