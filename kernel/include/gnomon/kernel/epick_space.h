// SPDX-License-Identifier: LGPL-3.0-or-later
// The kernel `epick`: CGAL's exact predicates on rounded points. A shadow plane is three points
// (two of an edge and the light, or two and a direction), never coefficients; a crossing is rounded
// to doubles.
//
// Guarantee: each decision is exact *for the rounded points*; since crossings are rounded before
// anything is asked about them, answers on degenerate scenes are wrong all the same. This is what a
// program gets that swaps its number type for an exact-predicates kernel and nothing else.
// Reference: CGAL 5.5, Exact_predicates_inexact_constructions_kernel.
#ifndef GNOMON_KERNEL_EPICK_SPACE_H
#define GNOMON_KERNEL_EPICK_SPACE_H

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "gnomon/kernel/ball.h"
#include "gnomon/kernel/corner.h"
#include "gnomon/kernel/geometry.h"
#include "gnomon/kernel/kernel_options.h"
#include "gnomon/kernel/light_space.h"
#include "gnomon/kernel/predicate_stats.h"
#include "gnomon/kernel/sign.h"

namespace gnomon {

struct EpickVertex {
  std::array<double, 3> x{};
  VertexId source = kMadeVertex;
};

/// A plane through a, oriented by two further points, or by a direction and a point.
struct EpickPlane {
  enum class Kind : std::uint8_t { kPoints, kDirection, kLinear };
  Kind kind = Kind::kPoints;
  // kPoints: front where ((b - a) x (c - a)) . (v - a) > 0; kDirection: where (b x (c - a)) . (v -
  // a) > 0.
  std::array<double, 3> a{}, b{}, c{};
  std::uint32_t linear = 0;  // kLinear: index of exact coefficients (prefix planes)
  VertexId from = kMadeVertex, to = kMadeVertex;
};

class EpickSceneSpace {
 public:
  using Vertex = EpickVertex;
  static constexpr bool kExact = false;

  EpickSceneSpace(const Geometry& geometry, const KernelOptions& options);

  Vertex input_vertex(VertexId v) const { return {geometry_->positions[v], v}; }
  Side side_of_plane(PlaneRef plane, const Corner<Vertex>& corner);
  Vertex crossing(PlaneRef plane, PlaneRef, bool, const Corner<Vertex>& from,
                  const Corner<Vertex>& to) const;
  const Geometry& geometry() const { return *geometry_; }
  SceneEdges edges() const { return {static_cast<std::uint32_t>(geometry_->planes.size())}; }
  std::array<double, 3> approximate(const Vertex& vertex) const { return vertex.x; }
  bool identity() const { return identity_; }
  EpickPlane support(PlaneId plane) const;
  StageCounts stage_counts() const { return {}; }

 private:
  const Geometry* geometry_;
  bool identity_;
};

class EpickLightSpace {
 public:
  using SceneSpace = EpickSceneSpace;
  using Vertex = EpickVertex;
  static constexpr bool kExact = false;

  EpickLightSpace(SceneSpace& scene, const LightPoint& light, const KernelOptions& options);

  bool knows_identity() const { return identity_; }
  Sign light_side(PlaneId plane) const;
  PlaneRef import_edge(PlaneRef scene_edge, PlaneId support, bool reversed, const Vertex& from,
                       const Vertex& to);
  Vertex import_vertex(const Vertex& vertex) const { return vertex; }
  /// Vertices carry coordinates, so that an edge cut for another light needs no plane here.
  PlaneRef import_cut(const EpickLightSpace&, PlaneRef, PlaneId) { return {}; }
  void finish_vertex(Vertex&, PlaneRef, PlaneRef) const {}
  PlaneRef shadow_plane(PlaneRef edge, const Vertex& from, const Vertex& to);
  PlaneRef add_prefix_plane(const PrefixPlane& plane);
  Side side_of_plane(PlaneRef plane, const Corner<Vertex>& corner);
  Vertex crossing(PlaneRef plane, PlaneRef, bool, const Corner<Vertex>& from,
                  const Corner<Vertex>& to) const;
  std::array<Ball, 3> position(const Corner<Vertex>& corner) const;
  std::array<mpq_class, 3> exact_position(const Corner<Vertex>& corner) const;
  std::string describe(PlaneRef plane) const;
  StageCounts stage_counts() const { return {}; }

 private:
  /// n . v - d with exact coefficients.
  struct LinearPlane {
    std::array<mpq_class, 4> exact;
    std::array<Ball, 4> enclosure;
  };
  PlaneRef add(const EpickPlane& plane) {
    planes_.push_back(plane);
    return PlaneRef(static_cast<std::uint32_t>(planes_.size() - 1));
  }
  EpickPlane shadow_plane_of(const Vertex& from, const Vertex& to) const;
  Sign sign(const EpickPlane& plane, const std::array<double, 3>& v) const;

  SceneSpace* scene_;
  bool identity_;
  LightPoint light_;
  LightAxes axes_;
  std::vector<EpickPlane> planes_;
  std::vector<LinearPlane> linear_;
  std::vector<std::uint32_t> plane_of_edge_;
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_EPICK_SPACE_H
