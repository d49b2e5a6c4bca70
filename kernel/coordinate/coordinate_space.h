// SPDX-License-Identifier: LGPL-3.0-or-later
// The kernels whose vertices are coordinates: float, double, long double (rounded), and GMP
// rationals (exact). The same formulas, plainly written, as the papers and most programs have them:
// a plane is n . x - d, its value is compared with a thickness, a crossing is a + t (b - a).
//
// Guarantee: with T = mpq_class every decision and construction is exact. With a float type nothing
// is guaranteed: `identity` and `thickness` (kernel_options.h) are the two policies that practice
// knows, and what remains wrong is what the oracle measures. Reference: Chin & Feiner 1989, sec. 7
// (planes of input polygons are copied to their fragments).
#ifndef GNOMON_KERNEL_COORDINATE_COORDINATE_SPACE_H
#define GNOMON_KERNEL_COORDINATE_COORDINATE_SPACE_H

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <type_traits>
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

template <class T>
struct CoordinateVertex {
  std::array<T, 3> x{};
  VertexId source = kMadeVertex;
};

template <class T>
struct CoordinatePlane {
  std::array<T, 3> n{};
  T d{};
};

/// The arithmetic that both spaces share.
template <class T>
class CoordinatePlanes {
 public:
  using Vertex = CoordinateVertex<T>;
  static constexpr bool kExact = std::is_same_v<T, mpq_class>;

  CoordinatePlanes(const Geometry& geometry, const KernelOptions& options);

  /// Normal (b - a) x (c - a), of unit length if T rounds and the plane is used with a thickness.
  CoordinatePlane<T> plane_through(const Vertex& a, const Vertex& b, const Vertex& c) const;
  CoordinatePlane<T> plane_from(std::array<T, 3> normal, const std::array<T, 3>& point) const;
  T value(const CoordinatePlane<T>& plane, const Vertex& vertex) const {
    return T(plane.n[0] * vertex.x[0] + plane.n[1] * vertex.x[1] + plane.n[2] * vertex.x[2] -
             plane.d);
  }
  Side side(const CoordinatePlane<T>& plane, const Vertex& vertex) const {
    const T v = value(plane, vertex);
    // Without branches, which would be mispredicted half of the time.
    return static_cast<Side>(int{v > thickness_} - int{v < -thickness_});
  }
  Vertex crossing(const CoordinatePlane<T>& plane, const Vertex& from, const Vertex& to) const;
  Vertex input_vertex(VertexId v) const;
  bool identity() const { return identity_; }
  const T& thickness() const { return thickness_; }
  const T& relative_thickness() const { return relative_thickness_; }

 private:
  const Geometry* geometry_;
  bool identity_;
  T thickness_;           // in scene units; 0 for exact T
  T relative_thickness_;  // as a fraction of the scene's diagonal
};

template <class T>
class CoordinateSceneSpace {
 public:
  using Vertex = CoordinateVertex<T>;
  static constexpr bool kExact = CoordinatePlanes<T>::kExact;

  CoordinateSceneSpace(const Geometry& geometry, const KernelOptions& options);

  Vertex input_vertex(VertexId v) const { return planes_.input_vertex(v); }
  Side side_of_plane(PlaneRef plane, const Corner<Vertex>& corner) const;
  /// By arithmetic alone, in the plane's own orientation.
  Side side_of_support(PlaneId plane, const Vertex& vertex) const {
    return planes_.side(support_[plane], vertex);
  }
  Vertex crossing(PlaneRef plane, PlaneRef, bool, const Corner<Vertex>& from,
                  const Corner<Vertex>& to) const {
    return planes_.crossing(support_[plane.index()], from.vertex, to.vertex);
  }
  const Geometry& geometry() const { return *geometry_; }
  SceneEdges edges() const { return {static_cast<std::uint32_t>(geometry_->planes.size())}; }
  std::array<double, 3> approximate(const Vertex& vertex) const;
  const CoordinatePlane<T>& support(PlaneId plane) const { return support_[plane]; }
  const CoordinatePlanes<T>& arithmetic() const { return planes_; }
  StageCounts stage_counts() const { return {}; }

 private:
  const Geometry* geometry_;
  CoordinatePlanes<T> planes_;
  std::vector<CoordinatePlane<T>> support_;
};

template <class T>
class CoordinateLightSpace
    : public ConstructedLightSpace<CoordinateLightSpace<T>, CoordinateSceneSpace<T>,
                                   CoordinatePlane<T>> {
  using Base =
      ConstructedLightSpace<CoordinateLightSpace, CoordinateSceneSpace<T>, CoordinatePlane<T>>;

 public:
  using SceneSpace = CoordinateSceneSpace<T>;
  using Vertex = CoordinateVertex<T>;
  static constexpr bool kExact = SceneSpace::kExact;
  /// GMP numbers are only read by what forks share.
  static constexpr bool kParallel = true;

  CoordinateLightSpace(SceneSpace& scene, const LightPoint& light, const KernelOptions& options);

  Sign light_side(PlaneId plane) const { return light_side_of(this->scene().support(plane)); }
  Sign light_side_of(const CoordinatePlane<T>& plane) const;
  PlaneRef add_prefix_plane(const PrefixPlane& plane);
  std::array<Ball, 3> position(const Corner<Vertex>& corner) const;
  /// Scene units.
  std::array<mpq_class, 3> exact_position(const Corner<Vertex>& corner) const;
  /// Requires: for a directional light, its one chart.
  ChartPoint chart_point(const LightChart& chart, const Corner<Vertex>& corner) const {
    if constexpr (kExact) {
      return enclosed_chart_point(chart, corner.vertex);
    } else {
      return chart_(chart, corner.vertex.x);
    }
  }

 private:
  friend Base;
  using Wide = std::conditional_t<std::is_same_v<T, long double>, long double, double>;
  using Chart = std::conditional_t<kExact, EnclosedChart, RoundedChart<Wide>>;

  static Chart make_chart(const Geometry& geometry, const LightPoint& light,
                          const std::array<T, 3>& kept);
  CoordinatePlane<T> shadow_plane_of(const Vertex& from, const Vertex& to) const;
  Side side(const CoordinatePlane<T>& plane, const Vertex& vertex) const {
    return planes_.side(plane, vertex);
  }
  Vertex meet(const CoordinatePlane<T>& plane, const Vertex& from, const Vertex& to) const {
    return planes_.crossing(plane, from, to);
  }
  ChartPoint enclosed_chart_point(const LightChart& chart,
                                  const Vertex& vertex) const requires std::is_same_v<T, mpq_class>;

  CoordinatePlanes<T> planes_;  // the scene space's
  bool directional_;
  std::array<T, 3> light_;  // position or to_light
  LightAxes axes_;
  Chart chart_;
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_COORDINATE_COORDINATE_SPACE_H
