// SPDX-License-Identifier: LGPL-3.0-or-later
// The kernel `epick`: CGAL's exact predicates on rounded points. A shadow plane is three points
// (two of an edge and the light, or two and a direction), never coefficients; a crossing is rounded
// to doubles.
//
// Guarantee: each decision is exact *for the rounded points*; since crossings are rounded before
// anything is asked about them, answers on degenerate scenes are wrong all the same. This is what a
// program gets that swaps its number type for an exact-predicates kernel and nothing else.
// Reference: CGAL 5.5, Exact_predicates_inexact_constructions_kernel.
#ifndef GNOMON_KERNEL_CGAL_EPICK_SPACE_H
#define GNOMON_KERNEL_CGAL_EPICK_SPACE_H

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <memory>

#include "gnomon/kernel/geometry.h"
#include "gnomon/kernel/kernel_options.h"
#include "gnomon/kernel/sign.h"
#include "gnomon/kernel/stage_counts.h"
#include "kernel/concept/chart_formulas.h"
#include "kernel/concept/constructed_light_space.h"
#include "kernel/concept/light_space.h"
#include "kernel/signs/ball.h"
#include "kernel/signs/corner.h"

namespace gnomon {

struct EpickVertex {
  std::array<double, 3> x{};
  VertexId source = kMadeVertex;
};

/// A plane through a, oriented by two further points, or by a direction and a point; or exact
/// coefficients.
struct EpickPlane {
  enum class Kind : std::uint8_t { kPoints, kDirection, kLinear };
  /// n . v - d.
  struct Linear {
    std::array<mpq_class, 4> exact;
    std::array<Ball, 4> enclosure;
  };
  Kind kind = Kind::kPoints;
  // kPoints: front where ((b - a) x (c - a)) . (v - a) > 0; kDirection: where (b x (c - a)) . (v -
  // a) > 0.
  std::array<double, 3> a{}, b{}, c{};
  std::shared_ptr<const Linear> linear;  // kLinear (prefix planes)
};

class EpickSceneSpace {
 public:
  using Vertex = EpickVertex;
  static constexpr bool kExact = false;

  EpickSceneSpace(const Geometry& geometry, const KernelOptions& options);

  Vertex input_vertex(VertexId v) const { return {geometry_->positions[v], v}; }
  Side side_of_plane(PlaneRef plane, const Corner<Vertex>& corner) const;
  /// By CGAL's predicate alone, in the plane's own orientation.
  Side side_of_support(PlaneId plane, const Vertex& vertex) const;
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

class EpickLightSpace : public ConstructedLightSpace<EpickLightSpace, EpickSceneSpace, EpickPlane> {
  using Base = ConstructedLightSpace<EpickLightSpace, EpickSceneSpace, EpickPlane>;

 public:
  /// CGAL's filtered predicates keep no state.
  static constexpr bool kParallel = true;

  EpickLightSpace(SceneSpace& scene, const LightPoint& light, const KernelOptions& options);

  Sign light_side(PlaneId plane) const;
  PlaneRef add_prefix_plane(const PrefixPlane& plane);
  std::array<Ball, 3> position(const Corner<Vertex>& corner) const;
  std::array<mpq_class, 3> exact_position(const Corner<Vertex>& corner) const;
  /// Requires: for a directional light, its one chart.
  ChartPoint chart_point(const LightChart& chart, const Corner<Vertex>& corner) const {
    return chart_(chart, corner.vertex.x);
  }

 private:
  friend Base;
  EpickPlane shadow_plane_of(const Vertex& from, const Vertex& to) const;
  Side side(const EpickPlane& plane, const Vertex& vertex) const;
  Vertex meet(const EpickPlane& plane, const Vertex& from, const Vertex& to) const;

  LightPoint light_;
  LightAxes axes_;
  RoundedChart<double> chart_;
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_CGAL_EPICK_SPACE_H
