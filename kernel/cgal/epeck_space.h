// SPDX-License-Identifier: LGPL-3.0-or-later
// The kernel `epeck`: CGAL's lazy exact constructions, as one would use them today. Points, planes
// and crossings are CGAL objects on the scene's grid; every decision is exact.
//
// Guarantee: exact. Price: each construction is a node of a lazy expression, and a decision that
// the interval cannot make evaluates the whole expression in rationals. Reference: CGAL 5.5,
// Exact_predicates_exact_constructions_kernel.
#ifndef GNOMON_KERNEL_CGAL_EPECK_SPACE_H
#define GNOMON_KERNEL_CGAL_EPECK_SPACE_H

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <vector>

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

using Epeck = CGAL::Exact_predicates_exact_constructions_kernel;

struct EpeckVertex {
  Epeck::Point_3 point;
  VertexId source = kMadeVertex;
};

class EpeckSceneSpace {
 public:
  using Vertex = EpeckVertex;
  static constexpr bool kExact = true;

  EpeckSceneSpace(const Geometry& geometry, const KernelOptions& options);

  Vertex input_vertex(VertexId v) const { return {points_[v], v}; }
  Side side_of_plane(PlaneRef plane, const Corner<Vertex>& corner) const;
  /// By arithmetic alone, in the plane's own orientation.
  Side side_of_support(PlaneId plane, const Vertex& vertex) const;
  Vertex crossing(PlaneRef plane, PlaneRef, bool, const Corner<Vertex>& from,
                  const Corner<Vertex>& to) const;
  const Geometry& geometry() const { return *geometry_; }
  SceneEdges edges() const { return {static_cast<std::uint32_t>(geometry_->planes.size())}; }
  /// In scene units.
  std::array<double, 3> approximate(const Vertex& vertex) const;
  const Epeck::Plane_3& support(PlaneId plane) const { return support_[plane]; }
  StageCounts stage_counts() const { return {}; }

 private:
  const Geometry* geometry_;
  std::vector<Epeck::Point_3> points_;
  std::vector<Epeck::Plane_3> support_;
  std::array<double, 3> origin_{};
  double step_ = 1;
};

class EpeckLightSpace
    : public ConstructedLightSpace<EpeckLightSpace, EpeckSceneSpace, Epeck::Plane_3> {
  using Base = ConstructedLightSpace<EpeckLightSpace, EpeckSceneSpace, Epeck::Plane_3>;

 public:
  /// Deciding may evaluate a lazy number that another fork holds too.
  static constexpr bool kParallel = false;

  EpeckLightSpace(SceneSpace& scene, const LightPoint& light, const KernelOptions& options);

  Sign light_side(PlaneId plane) const;
  PlaneRef add_prefix_plane(const PrefixPlane& plane);
  /// Grid units.
  std::array<Ball, 3> position(const Corner<Vertex>& corner) const;
  /// Scene units.
  std::array<mpq_class, 3> exact_position(const Corner<Vertex>& corner) const;
  /// Requires: for a directional light, its one chart.
  ChartPoint chart_point(const LightChart& chart, const Corner<Vertex>& corner) const;

 private:
  friend Base;
  Epeck::Plane_3 shadow_plane_of(const Vertex& from, const Vertex& to) const;
  Side side(const Epeck::Plane_3& plane, const Vertex& vertex) const;
  Vertex meet(const Epeck::Plane_3& plane, const Vertex& from, const Vertex& to) const;

  LightPoint light_;
  LightAxes axes_;
  Epeck::Point_3 position_;    // point light
  Epeck::Vector_3 direction_;  // directional light
  std::array<Ball, 3> enclosed_position_;
  EnclosedChart chart_;
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_CGAL_EPECK_SPACE_H
