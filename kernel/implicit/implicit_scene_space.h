// SPDX-License-Identifier: LGPL-3.0-or-later
// The kernel `plane` in three dimensions, where the scene BSP decides: on which side of the support
// plane P_j does a vertex of a fragment lie?
//
// A vertex is never constructed. It is an input vertex, or where an input edge meets a support
// plane, or where two support planes cut the support plane of the loop; its doubles are a hint with
// a proven error bound. Decisions: identity, then the filter, then exact integers of the width that
// the precision plan allows.
//
// Guarantee: every side is exact, on every input.
// Degree: 3 (input vertex), 6 (edge and plane), 9 (three planes). Reference: docs/exactness.md.
#ifndef GNOMON_KERNEL_IMPLICIT_IMPLICIT_SCENE_SPACE_H
#define GNOMON_KERNEL_IMPLICIT_IMPLICIT_SCENE_SPACE_H

#include <array>
#include <cstdint>
#include <vector>

#include "gnomon/kernel/geometry.h"
#include "gnomon/kernel/kernel_options.h"
#include "gnomon/kernel/precision_plan.h"
#include "gnomon/kernel/sign.h"
#include "gnomon/kernel/stage_counts.h"
#include "kernel/numbers/exact_integer.h"
#include "kernel/signs/ball.h"
#include "kernel/signs/corner.h"

namespace gnomon {

/// A support plane with exact integer coefficients on the grid: n . x - d.
template <class Int>
struct ExactPlane {
  Vector3<Int> n;
  Int d;
};

/// Reads the grid's integers as Int. Requires: what is asked for fits into Int.
template <class Int>
class ExactGeometry {
 public:
  explicit ExactGeometry(const Geometry& geometry) : geometry_(&geometry) {}

  Vector3<Int> position(VertexId v) const {
    const GridPositions& grid = geometry_->grid;
    if (grid.is_narrow()) {
      return {integer_from<Int>(grid.narrow(v, 0)), integer_from<Int>(grid.narrow(v, 1)),
              integer_from<Int>(grid.narrow(v, 2))};
    }
    return {integer_from<Int>(grid.wide(v, 0)), integer_from<Int>(grid.wide(v, 1)),
            integer_from<Int>(grid.wide(v, 2))};
  }
  /// n: support_normal_bits(); d = n . a: support_value_bits().
  ExactPlane<Int> plane(PlaneId id) const {
    const SupportTriple& triple = geometry_->planes[id];
    const Vector3<Int> a = position(triple.a);
    const Vector3<Int> n =
        cross(difference(position(triple.b), a), difference(position(triple.c), a));
    return {n, dot(n, a)};
  }
  /// n alone, kept in Normal. Requires: Int holds positions, Normal one bit more than
  /// support_normal_bits().
  template <class Normal>
  Vector3<Normal> normal(PlaneId id) const {
    const SupportTriple& triple = geometry_->planes[id];
    const Vector3<Int> a = position(triple.a);
    return cross<Normal>(difference(position(triple.b), a), difference(position(triple.c), a));
  }
  /// n . (x - a) of a support plane at an input vertex: side_of_support_bits().
  Int value(PlaneId id, VertexId v) const {
    if constexpr (!std::is_same_v<Int, mpz_class>) {
      if (geometry_->grid.is_narrow()) return value_from<std::int64_t>(id, v);
    }
    return value_from<Int>(id, v);
  }

 private:
  template <class Factor>
  Int value_from(PlaneId id, VertexId v) const {
    const ExactGeometry<Factor> exact(*geometry_);
    const SupportTriple& triple = geometry_->planes[id];
    const Vector3<Factor> a = exact.position(triple.a);
    return determinant<Int>(difference(exact.position(v), a),
                            difference(exact.position(triple.b), a),
                            difference(exact.position(triple.c), a));
  }

  const Geometry* geometry_;
};

template <class Stats = NoStats>
class ImplicitSceneSpace {
 public:
  static constexpr bool kExact = true;

  /// Doubles in grid units times 2^-b, so that every coordinate is in [0, 1]; `error` bounds the
  /// distance of each to the true coordinate (infinite: the doubles say nothing).
  struct Vertex {
    std::array<double, 3> x{};
    double error = 0;
    VertexId source = kMadeVertex;
  };

  ImplicitSceneSpace(const Geometry& geometry, const KernelOptions& options);

  Vertex input_vertex(VertexId v) const;
  /// Side of the corner's vertex; kOn is exact. Identities: (1) the support plane itself and the
  /// planes of the corner's two edges contain it; (2) a plane contains the input vertices that
  /// define it.
  Side side_of_plane(PlaneRef plane, const Corner<Vertex>& corner);
  /// Where the edge from `from` to `to`, which has the two ends strictly on different sides of
  /// `plane`, meets it. Only the doubles are computed; the vertex is the corner that the caller
  /// puts it in.
  Vertex crossing(PlaneRef plane, PlaneRef edge, bool leaving, const Corner<Vertex>& from,
                  const Corner<Vertex>& to) const;

  const Geometry& geometry() const { return *geometry_; }
  SceneEdges edges() const { return {static_cast<std::uint32_t>(geometry_->planes.size())}; }
  /// In scene units, for heuristics only.
  std::array<double, 3> approximate(const Vertex& vertex) const {
    std::array<double, 3> point;
    for (int k = 0; k < 3; ++k) point[k] = origin_[k] + scale_ * vertex.x[k];
    return point;
  }
  /// Enclosures of n and d of a support plane for positions in grid units times 2^-b, up to a
  /// common positive factor; of infinite radius where doubles cannot hold it.
  std::array<Ball, 4> plane_enclosure(PlaneId plane) const;
  StageCounts stage_counts() const { return stats_.counts(); }

 private:
  struct FilteredPlane {
    std::array<double, 3> n{};  // |n_k| < 1
    double d = 0;               // |d| < 3
    bool usable = false;
  };
  /// |computed n . x - d - true value| for plane and vertex below: 3 (error of x) + (error of n and
  /// d: 3 * 2u + 6u) + rounding of 3 products and 3 sums of values below 3 (18u), doubled for
  /// slack.
  static double error_bound(double vertex_error) { return 3.01 * vertex_error + 64 * Ball::kUnit; }

  FilteredPlane filtered(PlaneId plane) const;
  Sign exact_side(PlaneId plane, const Corner<Vertex>& corner);
  /// The side of `plane` that the point has where the edge meets the plane `cut`.
  template <class Value, class Int>
  Sign side_of_edge_point(PlaneId plane, EdgeEnds edge, PlaneId cut) const;
  /// The side of `plane` that the point of three others has.
  template <class Factor, class Int>
  Sign side_of_plane_point(PlaneId plane, const std::array<PlaneId, 3>& others) const;

  const Geometry* geometry_;
  std::vector<FilteredPlane> planes_;
  std::array<double, 3> origin_{};
  double scale_ = 1;
  unsigned bits_;
  Stats stats_;
};

extern template class ImplicitSceneSpace<NoStats>;
extern template class ImplicitSceneSpace<CountStats>;

}  // namespace gnomon

#endif  // GNOMON_KERNEL_IMPLICIT_IMPLICIT_SCENE_SPACE_H
