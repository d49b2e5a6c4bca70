// SPDX-License-Identifier: LGPL-3.0-or-later
// The kernel `plane` in three dimensions with planes through three corners: where shadow volumes of
// area lights are made, and loops are cut by them.
//
// A plane is its provenance: three input vertices (a support plane, or a face of a volume; nearly
// all are), or explicit integers without a common divisor (planes through corners of a cut light,
// along a direction, and of axes). A vertex is never constructed: it is an input vertex, or the
// point where the planes that its corner names meet. Both carry doubles for the filter, which is
// one dot product and one comparison; what it leaves open goes to identity, and then is computed
// from the provenance in integers of the width that the bits of the planes at hand ask for.
//
// Guarantee: every decision is exact on every input, whatever the magnitudes. Coordinates are
// scaled to [0, 1] and normals so that the largest component is in [1/2, 1): bounds are multiples
// of u that no underflow can touch. A made vertex whose doubles would be poor (planes that meet at
// a small angle) has them computed from the integers once, when it is made.
// Degree: 3 (input vertex), 6 (edge and plane), 9 (three planes), while the light is not cut.
// Reference: Chin & Feiner 1992, sec. 3; docs/exactness.md.
#ifndef GNOMON_KERNEL_IMPLICIT_IMPLICIT_VOLUME_SPACE_H
#define GNOMON_KERNEL_IMPLICIT_IMPLICIT_VOLUME_SPACE_H

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "kernel/implicit/implicit_scene_space.h"
#include "kernel/numbers/double_double.h"

namespace gnomon {

template <class Stats = NoStats>
class ImplicitVolumeSpace {
 public:
  using SceneSpace = ImplicitSceneSpace<Stats>;
  static constexpr bool kExact = true;
  static constexpr bool kParallel = true;

  /// Doubles in grid units times 2^-b, so that every coordinate of the scene is in [0, 1].
  struct Vertex {
    std::array<double, 3> x{};
    /// Bound of the error of n . x - d in doubles, for every plane: see vertex_bound(). Infinite:
    /// the doubles say nothing.
    float bound = 0;
    VertexId source = kMadeVertex;
  };

  ImplicitVolumeSpace(const SceneSpace& scene, const KernelOptions& options);

  ImplicitVolumeSpace fork() const;
  const Geometry& geometry() const { return *shared_->geometry; }
  SceneEdges edges() const { return {shared_->plane_count}; }
  Vertex input_vertex(VertexId v) const;

  /// Through three points, counter-clockwise seen from the front; not valid() if they are on a
  /// line. Degree: 2 for three input vertices, 5 or 8 with a corner that one or two support planes
  /// cut off a light.
  PlaneRef add_plane(const Corner<Vertex>& a, const Corner<Vertex>& b, const Corner<Vertex>& c);
  /// The same with the third point at infinity, where a directional light is (or at a point light).
  PlaneRef add_plane(const Corner<Vertex>& a, const Corner<Vertex>& b, const LightPoint& light);
  /// Exactly where the coordinate is `value` 2^b grid units. Requires: value in [0, 1].
  PlaneRef add_axis_plane(int axis, double value);
  /// The made vertex where three such planes meet. Requires: values in [0, 1].
  Vertex axis_point(const std::array<double, 3>& values) const {
    Vertex vertex;
    vertex.x = values;
    vertex.bound = rounded_up(vertex_bound(0, 1));
    return vertex;
  }
  std::uint32_t plane_mark() const { return static_cast<std::uint32_t>(own_.size()); }
  void release_planes(std::uint32_t mark) {
    own_.resize(mark);
    while (!explicit_.empty() && explicit_.back().owner >= mark) {
      if (explicit_.back().is_wide()) wide_.pop_back();
      explicit_.pop_back();
    }
  }

  /// A plane and its doubles, to test many vertices against.
  struct LoadedPlane {
    std::array<double, 3> n;
    double d;
    PlaneRef plane;
  };
  LoadedPlane load(PlaneRef ref) const {
    const Plane& plane = plane_at(ref.index());
    return {plane.n, plane.d, ref};
  }
  /// Identities: (1) the support plane and the planes of the corner's edges contain it, whatever
  /// their number if the same three vertices define them; (2) a plane contains the input vertices
  /// that define it, and so every point on the line through two of them: of an input edge, or in
  /// which two planes meet that they define, too. Exactness: always.
  Side side_of_plane(const LoadedPlane& plane, const Corner<Vertex>& corner) {
    const std::array<double, 3>& x = corner.vertex.x;
    const double value = plane.n[0] * x[0] + plane.n[1] * x[1] + plane.n[2] * x[2] - plane.d;
    if (std::fabs(value) > static_cast<double>(corner.vertex.bound)) {
      stats_.count(Stage::kFilter);
      // Without a branch, which would be mispredicted half of the time.
      return static_cast<Side>(2 * int{(value > 0) != plane.plane.flipped()} - 1);
    }
    return undecided_side(plane.plane, corner);
  }
  Side side_of_plane(PlaneRef plane, const Corner<Vertex>& corner) {
    return side_of_plane(load(plane), corner);
  }
  /// Where the edge `edge` of the loop meets `plane`, which has the edge's ends strictly on
  /// different sides. Only the doubles are computed; the vertex is the corner that the caller puts
  /// it in.
  Vertex crossing(PlaneRef plane, PlaneRef edge, bool leaving, const Corner<Vertex>& from,
                  const Corner<Vertex>& to) const;

  /// Enclosures in grid units times 2^-b; of made vertices by what their doubles are known to.
  std::array<Ball, 3> position(const Corner<Vertex>& corner) const;
  /// The same as seen from vertex `origin`, with errors that are small against the distances from
  /// it: areas of small polygons are then not measured on the scale of the scene.
  std::array<Ball, 3> offset(VertexId origin, const Corner<Vertex>& corner) const;
  /// Scene units.
  std::array<mpq_class, 3> exact_position(const Corner<Vertex>& corner) const;
  /// The nearest doubles of exact_position(), mostly from some 100 bits.
  std::array<double, 3> nearest_position(const Corner<Vertex>& corner) const;
  StageCounts stage_counts() const { return stats_.counts(); }

 private:
  /// n . x - d with the largest |n_k| in [1/2, 1), |d| < 3; the error of each n_k is at most 2u
  /// |n_k|, and that of d 20u. Provenance: three input vertices, or an index into explicit_ and
  /// kExplicit twice. 48 bytes.
  struct Plane {
    std::array<double, 3> n{};
    double d = 0;
    std::array<std::uint32_t, 3> source{};

    bool is_explicit() const { return source[1] == kExplicit; }
    bool has(VertexId v) const { return source[0] == v || source[1] == v || source[2] == v; }
  };
  static constexpr std::uint32_t kExplicit = kMadeVertex;
  /// A plane through a point of the scene's box, by integers: |d| and every |n . x - d| with x in
  /// the box are at most 3 D times the largest |n_k|.
  struct Explicit {
    ExactPlane<Int128> plane;       // below 2^kNarrowBits
    std::uint32_t wide = kNotWide;  // or an index into wide_
    unsigned bits = 0;              // of the largest |n_k|
    std::uint32_t owner = 0;        // its index in own_

    bool is_wide() const { return wide != kNotWide; }
  };
  static constexpr std::uint32_t kNotWide = 0xffffffffu;
  static constexpr unsigned kNarrowBits = 126;
  /// What forks have in common.
  struct Shared {
    const Geometry* geometry = nullptr;
    std::uint32_t plane_count = 0, edge_count = 0;
    unsigned b = 0;                          // bits of the grid
    bool narrow = false;                     // positions fit into 64 bits
    bool fixed = false;                      // or into 128
    double grid_scale = 0;                   // 2^-b, if fixed
    std::vector<Vector3<Int128>> positions;  // if fixed and not narrow
    std::vector<Plane> supports;
    std::array<DoubleDouble, 3> origin;  // of the grid, scene units
    DoubleDouble step;                   // scene units per grid unit
  };
  /// A point as vertex `origin` + x / w, in grid units.
  template <class Int>
  struct ExactPoint {
    VertexId origin = 0;
    Vector3<Int> x{};
    Int w{};
  };
  /// Homogeneous coordinates, w > 0, no common divisor.
  template <class Int>
  struct Homogeneous {
    Vector3<Int> x{};
    Int w{};
  };
  /// Made corners of lights that planes were put through lately.
  struct PointMemo {
    std::array<std::uint32_t, 3> key{kMadeVertex, kMadeVertex, kMadeVertex};
    Homogeneous<mpz_class> point;
    Homogeneous<Int128> narrow;  // the same, if `bits` is at most kNarrowBits
    unsigned bits = 0;           // of the largest coordinate
  };
  static constexpr std::size_t kPointMemos = 64;

  static constexpr double kUnit = Ball::kUnit;
  /// Error of n . x - d in doubles for exact x with |x_k| <= 1: 6u for n, 20u for d, and 14u for
  /// roundings; 8u of slack for terms of second order and what underflows.
  static constexpr double kPlaneError = 48 * kUnit;
  /// The same for x off by `error` in each coordinate, |x_k| <= magnitude, magnitude >= 1.
  static constexpr double vertex_bound(double error, double magnitude) {
    return 3.01 * error + kPlaneError * magnitude;
  }
  /// Of a coordinate: the bound is 3.01 times that and at least kPlaneError.
  static double error_of(const Vertex& vertex) {
    return (static_cast<double>(vertex.bound) - kPlaneError) / 3;
  }
  /// A float that is not smaller.
  static constexpr float rounded_up(double bound) {
    return static_cast<float>(bound * (1 + 0x1p-22));
  }

  bool is_input_edge(PlaneRef ref) const {
    return ref.index() - shared_->plane_count < shared_->edge_count;
  }
  EdgeEnds ends_of(PlaneRef edge) const {
    return shared_->geometry->edges[edge.index() - shared_->plane_count];
  }
  /// Requires: not the name of an input edge.
  const Plane& plane_at(std::uint32_t index) const {
    const Shared& shared = *shared_;
    return index < shared.plane_count ? shared.supports[index]
                                      : own_[index - shared.plane_count - shared.edge_count];
  }
  PlaneRef last_plane() const {
    return PlaneRef(shared_->plane_count + shared_->edge_count +
                    static_cast<std::uint32_t>(own_.size()) - 1);
  }

  static std::array<double, 3> input_point(const Shared& shared, VertexId v);
  static bool plane_through(const Shared& shared, const std::array<VertexId, 3>& vertices,
                            Plane& plane);
  PlaneRef add_through(const std::array<VertexId, 3>& vertices) {
    Plane plane;
    if (!plane_through(*shared_, vertices, plane)) return {};
    own_.push_back(plane);
    return last_plane();
  }
  /// Makes it primitive; not valid() if n is zero.
  PlaneRef add_explicit(ExactPlane<mpz_class> plane);
  /// As it is. Requires: below 2^kNarrowBits, and the grid is fixed.
  PlaneRef add_narrow(const ExactPlane<Int128>& plane);
  /// Through two input vertices and a made corner, if 128 bits hold it.
  std::optional<PlaneRef> add_through_made(VertexId p, VertexId q, const Corner<Vertex>& made);
  /// Through an input vertex and two made corners of one edge, if 128 bits hold it.
  std::optional<PlaneRef> add_through_edge(const Corner<Vertex>& p, const Corner<Vertex>& q,
                                           const Corner<Vertex>& r);
  Homogeneous<mpz_class> homogeneous(const Corner<Vertex>& corner);
  /// Valid until the next call.
  const PointMemo& made_point(const Corner<Vertex>& corner);

  Side undecided_side(PlaneRef plane, const Corner<Vertex>& corner);
  Sign exact_side(const Plane& plane, const Corner<Vertex>& corner);
  Sign exact_side_of_input(const Plane& plane, VertexId v);
  template <class Predicate>
  Sign decide(unsigned factor_bits, unsigned width_bits, const Predicate& predicate);

  unsigned normal_bits(const Plane& plane) const {
    return plane.is_explicit() ? explicit_[plane.source[0]].bits : support_normal_bits(shared_->b);
  }
  /// Magnitude of the value at a vertex.
  unsigned value_bits(const Plane& plane) const {
    return plane.is_explicit() ? volume_value_bits(explicit_[plane.source[0]].bits, shared_->b)
                               : support_value_bits(shared_->b);
  }
  /// Requires: the grid is narrow for std::int64_t, and fixed and not narrow for Int128.
  template <class Position>
  static Vector3<Position> position_of(const Shared& shared, VertexId v);
  /// Calls f.template operator()<Position>() with the type in which positions are kept, for use
  /// with integers `Int`.
  template <class Int, class F>
  static auto with_position(const Shared& shared, const F& f);
  template <class Factor>
  Vector3<Factor> exact_normal(const Plane& plane) const;
  /// n . v - d, for the normal as exact_normal() gives it.
  template <class Value, class Factor>
  Value exact_value(const Plane& plane, const Vector3<Factor>& normal, VertexId v) const;
  /// For a made corner: the planes that meet there, and a vertex in as many of them as possible.
  struct Meet {
    std::array<const Plane*, 3> planes;
    VertexId pivot = 0;
  };
  Meet meet_of(const Corner<Vertex>& corner) const {
    return {{&plane_at(corner.support), &plane_at(corner.before.index()),
             &plane_at(corner.after.index())}};
  }
  template <class Factor, class Int>
  Sign side_of_meet(const Plane& plane, const Meet& meet) const;
  /// Calls f(ExactPoint<Int>) with integers that hold a made corner's point, seen from `pivot` if
  /// it is where three planes meet.
  template <class F>
  void with_exact_point(const Corner<Vertex>& corner, bool unbounded, VertexId pivot,
                        const F& f) const;
  /// A vertex that defines one of a made corner's planes, or any.
  VertexId some_pivot(const Corner<Vertex>& corner) const;
  /// (n . v - d) 2^-b of the doubles' normal: off by at most 2u of itself.
  double accurate_value(const Plane& plane, VertexId v) const;
  std::array<Ball, 3> input_offset(VertexId from, VertexId to) const;
  std::array<Ball, 3> exact_offset(VertexId origin, const Corner<Vertex>& corner) const;
  /// Doubles from the integers: off by at most 8u.
  Vertex repaired(const Corner<Vertex>& corner) const;

  std::shared_ptr<const Shared> shared_;
  std::vector<Plane> own_;  // a stack
  std::vector<Explicit> explicit_;
  std::vector<ExactPlane<mpz_class>> wide_;
  std::vector<PointMemo> points_;
  [[no_unique_address]] Stats stats_;
};

extern template class ImplicitVolumeSpace<NoStats>;
extern template class ImplicitVolumeSpace<CountStats>;

}  // namespace gnomon

#endif  // GNOMON_KERNEL_IMPLICIT_IMPLICIT_VOLUME_SPACE_H
