// SPDX-License-Identifier: LGPL-3.0-or-later
// The kernel's own decisions about input corners: on which side of the line of an edge, or of a
// support plane, a corner is. The contour method asks them where its numbers do not tell.
#ifndef GNOMON_ALGORITHMS_CONTOUR_INPUT_SIDES_H
#define GNOMON_ALGORITHMS_CONTOUR_INPUT_SIDES_H

#include <cstdint>
#include <optional>
#include <utility>

#include "algorithms/contour/facing_polygons.h"
#include "algorithms/contour/scene_memo.h"
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

/// Whether a vertex is on the line through the ends of an edge, so that it is on the edge's line in
/// every light. Exact where positions are integers of 64 bits, of which differences are, too, and
/// products of two are of 128; else it says no.
inline bool is_on_line(const Geometry& geometry, const EdgeEnds& ends, VertexId vertex) {
  if (!geometry.grid.is_narrow()) return false;
  const std::int64_t* a = geometry.grid.narrow_point(ends.a);
  const std::int64_t* b = geometry.grid.narrow_point(ends.b);
  const std::int64_t* p = geometry.grid.narrow_point(vertex);
  for (int k = 0; k < 3; ++k) {
    const int next = k == 2 ? 0 : k + 1;
    const auto product = [&](int i, int j) { return Int128{b[i] - a[i]} * Int128{p[j] - a[j]}; };
    if (product(k, next) != product(next, k)) return false;
  }
  return true;
}

template <LightSpaceModel Space, class Numbers>
class InputSides {
 public:
  /// `facing`, `polygons` and `memos` must outlive it. Without memos, that is nullptr, the space is
  /// asked each time.
  InputSides(const PreparedScene& scene, typename Space::SceneSpace& scene_space, Space space,
             const FacingParts& facing, const FacingPolygons<Numbers>& polygons, SceneMemos* memos)
      : geometry_(&scene.geometry),
        facing_(&facing),
        polygons_(&polygons),
        memos_(memos),
        space_(std::move(space)) {
    if constexpr (!KnowsInputSides<Space> && Numbers::kAsksKernel) import(scene, scene_space);
  }

  Space& space() { return space_; }
  /// For another thread.
  InputSides fork() const {
    InputSides result = *this;
    result.remembered_ = 0;
    return result;
  }
  /// How often the memos knew, which the space does not count.
  std::uint64_t remembered() const { return remembered_; }

  /// Sign of the line of edge k of polygon p at corner j of q: positive inside.
  int of_line(std::uint32_t p, std::uint32_t k, std::uint32_t q, std::uint32_t j) {
    const FacingPolygon& own = polygons_->polygons[p];
    const FacingPolygon& other = polygons_->polygons[q];
    if constexpr (KnowsInputSides<Space>) {
      const PlaneRef edge = polygons_->edge(own, k);
      const VertexId vertex = polygons_->vertex(other, j);
      if (memos_ != nullptr && is_known_on_line(edge.index(), vertex)) return 0;
      return static_cast<int>(space_.side_of_edge(edge, vertex));
    } else {
      return static_cast<int>(space_.side_of_plane(loops_.edge(own.first + k), corner(other, j)));
    }
  }
  /// 1 if corner j of q is nearer to the light than the plane of p, -1 if it is behind it, 0 on it.
  int of_support(std::uint32_t p, std::uint32_t q, std::uint32_t j) {
    const PlaneId plane = polygons_->polygons[p].plane;
    if (plane == polygons_->polygons[q].plane) return 0;
    const int side = side_of_support(p, q, j);
    return facing_->plane_signs[plane] == Sign::kPositive ? side : -side;
  }
  /// Whether corners of q are nearer to the light than the plane of p, and whether some are behind
  /// it. Requires: has_memo().
  SidesOfPlane of_support(std::uint32_t p, std::uint32_t q) {
    const FacingPolygon& other = polygons_->polygons[q];
    const PlaneId plane = polygons_->polygons[p].plane;
    if (plane == other.plane) return {};
    constexpr unsigned kFront = 1, kBack = 2;
    ++remembered_;
    const unsigned sides = memos_->parts.value(plane, other.part, [&] {
      --remembered_;
      unsigned found = 0;
      for (std::uint32_t j = 0; j < other.count && found != (kFront | kBack); ++j) {
        const int side = side_of_support(p, q, j);
        found |= side > 0 ? kFront : side < 0 ? kBack : 0;
      }
      return found;
    });
    const bool front = (sides & kFront) != 0, back = (sides & kBack) != 0;
    if (facing_->plane_signs[plane] == Sign::kPositive) return {front, back};
    return {back, front};
  }
  bool has_memo() const { return memos_ != nullptr; }

 private:
  using Vertex = typename Space::Vertex;

  bool is_known_on_line(EdgeId edge, VertexId vertex) {
    constexpr unsigned kOn = 1, kOff = 2;
    const unsigned known = memos_->lines.value(edge, vertex, [&] {
      return is_on_line(*geometry_, geometry_->edges[edge], vertex) ? kOn : kOff;
    });
    remembered_ += known == kOn;
    return known == kOn;
  }
  /// The side of the plane of p on which corner j of q is, in the plane's own orientation.
  int side_of_support(std::uint32_t p, std::uint32_t q, std::uint32_t j) {
    const FacingPolygon& other = polygons_->polygons[q];
    const PlaneId plane = polygons_->polygons[p].plane;
    if constexpr (KnowsInputSides<Space>) {
      const VertexId vertex = polygons_->vertex(other, j);
      const auto find = [&] { return static_cast<int>(space_.side_of_support_at(plane, vertex)); };
      if (memos_ == nullptr) return find();
      ++remembered_;
      const unsigned known = memos_->vertices.value(plane, vertex, [&] {
        --remembered_;
        return static_cast<unsigned>(find() + 2);
      });
      return static_cast<int>(known) - 2;
    } else {
      return static_cast<int>(space_.side_of_support(plane, corner(other, j)));
    }
  }

  void import(const PreparedScene& scene, typename Space::SceneSpace& scene_space) {
    LoopStore<typename Space::SceneSpace::Vertex> whole;
    loops_.resize(static_cast<std::uint32_t>(polygons_->edges.size()));
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

  const Geometry* geometry_;
  const FacingParts* facing_;
  const FacingPolygons<Numbers>* polygons_;
  SceneMemos* memos_;
  std::uint64_t remembered_ = 0;
  Space space_;
  LoopStore<Vertex> loops_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_INPUT_SIDES_H
