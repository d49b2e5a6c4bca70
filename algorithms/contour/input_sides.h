// SPDX-License-Identifier: LGPL-3.0-or-later
// The kernel's own decisions about input corners: on which side of the line of an edge, or of a
// support plane, a corner is. The contour method asks them where its numbers do not tell.
#ifndef GNOMON_ALGORITHMS_CONTOUR_INPUT_SIDES_H
#define GNOMON_ALGORITHMS_CONTOUR_INPUT_SIDES_H

#include <cstdint>
#include <optional>
#include <utility>

#include "algorithms/contour/facing_polygons.h"
#include "algorithms/partition/import_export.h"
#include "algorithms/partition/loop_store.h"
#include "kernel/concept/kernel_concept.h"

namespace gnomon {

/// A light space that decides about input vertices by their numbers alone.
template <class Space>
concept KnowsInputSides = requires(Space& space, PlaneRef edge, PlaneId plane, VertexId vertex) {
  { space.side_of_edge(edge, vertex) } -> std::same_as<Side>;
  { space.side_of_support_at(plane, vertex) } -> std::same_as<Side>;
};

template <LightSpaceModel Space, class Numbers>
class InputSides {
 public:
  /// `facing` and `polygons` must outlive it.
  InputSides(const PreparedScene& scene, typename Space::SceneSpace& scene_space, Space space,
             const FacingParts& facing, const FacingPolygons<Numbers>& polygons)
      : facing_(&facing), polygons_(&polygons), space_(std::move(space)) {
    if constexpr (!KnowsInputSides<Space> && Numbers::kAsksKernel) import(scene, scene_space);
  }

  Space& space() { return space_; }
  /// For another thread.
  InputSides fork() const { return *this; }

  /// Sign of the line of edge k of polygon p at corner j of q: positive inside.
  int of_line(std::uint32_t p, std::uint32_t k, std::uint32_t q, std::uint32_t j) {
    const FacingPolygon& own = polygons_->polygons[p];
    const FacingPolygon& other = polygons_->polygons[q];
    if constexpr (KnowsInputSides<Space>) {
      return static_cast<int>(
          space_.side_of_edge(polygons_->edge(own, k), polygons_->vertex(other, j)));
    } else {
      return static_cast<int>(space_.side_of_plane(loops_.edge(own.first + k), corner(other, j)));
    }
  }
  /// 1 if corner j of q is nearer to the light than the plane of p, -1 if it is behind it, 0 on it.
  int of_support(std::uint32_t p, std::uint32_t q, std::uint32_t j) {
    const FacingPolygon& other = polygons_->polygons[q];
    const PlaneId plane = polygons_->polygons[p].plane;
    if (plane == other.plane) return 0;
    int side;
    if constexpr (KnowsInputSides<Space>) {
      side = static_cast<int>(space_.side_of_support_at(plane, polygons_->vertex(other, j)));
    } else {
      side = static_cast<int>(space_.side_of_support(plane, corner(other, j)));
    }
    return facing_->plane_signs[plane] == Sign::kPositive ? side : -side;
  }

 private:
  using Vertex = typename Space::Vertex;

  void import(const PreparedScene& scene, typename Space::SceneSpace& scene_space) {
    LoopStore<typename Space::SceneSpace::Vertex> whole;
    loops_.resize(static_cast<std::uint32_t>(polygons_->vertices.size()));
    if (space_.knows_identity()) {
      space_.make_edge_planes(0, static_cast<EdgeId>(scene.geometry.edges.size()));
    }
    for (const FacingPolygon& p : polygons_->polygons) {
      import_loop(space_, part_loop(scene_space, scene, p.part, whole), p.reversed, loops_,
                  p.first);
      if (space_.knows_identity()) continue;
      for (std::uint32_t k = 0; k < p.count; ++k) {
        loops_.edge(p.first + k) =
            space_.shadow_plane(loops_.edge(p.first + k), loops_.vertex(p.first + k),
                                loops_.vertex(p.first + (k + 1 == p.count ? 0 : k + 1)));
      }
    }
  }
  Corner<Vertex> corner(const FacingPolygon& p, std::uint32_t j) const {
    return loops_.view({p.first, p.count, p.part}, p.plane).corner(j);
  }

  const FacingParts* facing_;
  const FacingPolygons<Numbers>* polygons_;
  Space space_;
  LoopStore<Vertex> loops_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_INPUT_SIDES_H
