// SPDX-License-Identifier: LGPL-3.0-or-later
// The kernel `plane` in the light space of one point or directional light: on which side of a plane
// through the light is a vertex of a fragment, and which of two polygons is nearer?
//
// A plane is its provenance: an input edge (q_a x q_b), the cut of two support planes, or explicit
// integers (a trace of a scene BSP split, a prefix plane, a plane of another light). A vertex is an
// input vertex, or the ray in which the planes of its two edges meet, n_before x n_after, in that
// order. Both carry doubles with proven error bounds for the filter; what the filter leaves open
// goes to identity, and then is computed again from the provenance in integers.
//
// The depth plane of a support plane n . x = d with value h at the light is n / h (for a
// directional light: the height at which a line to the light meets it): a linear function of rays
// that is larger where the plane is nearer. Comparing two of them decides which polygon shadows
// which; this is the exact form of a depth buffer's 1 / z.
//
// Guarantee: every decision is exact on every input, whatever the magnitudes. Planes and rays are
// scaled by powers of two so that the largest component is in [1/2, 1) (made rays: at most 2), so
// that bounds are multiples of u that no underflow can touch; what cannot be scaled so is left to
// integers. Degree: 3 for input vertices, 6 for crossings, 9 / 12 / 15 with one, two, three cuts.
// Reference: Chin & Feiner 1989, sec. 4; docs/exactness.md.
#ifndef GNOMON_KERNEL_IMPLICIT_IMPLICIT_LIGHT_SPACE_H
#define GNOMON_KERNEL_IMPLICIT_IMPLICIT_LIGHT_SPACE_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "kernel/concept/light_space.h"
#include "kernel/implicit/implicit_scene_space.h"
#include "kernel/numbers/double_double.h"

namespace gnomon {

template <class Stats = NoStats>
class ImplicitLightSpace {
 public:
  using SceneSpace = ImplicitSceneSpace<Stats>;
  static constexpr bool kExact = true;
  static constexpr bool kParallel = true;

  /// 32 bytes, as a vertex of three doubles and a number is.
  struct Vertex {
    std::array<double, 3> ray{};  // positive multiple of the direction in q coordinates, |.| <= 2
    /// Bound of the error of n . ray for a plane of slack 1; at least three times the error of any
    /// component. Infinite: the doubles say nothing.
    float bound = 0;
    VertexId source = kMadeVertex;
  };

  ImplicitLightSpace(SceneSpace& scene, const LightPoint& light, const KernelOptions& options);

  /// Whether an edge's plane is the one that cut it; always.
  bool knows_identity() const { return true; }
  /// Sign of the support plane at the light: whether its front faces the light.
  Sign light_side(PlaneId plane) const;

  /// The plane of a scene-space edge in this light space, interior in front. `reversed` tells that
  /// the loop was reversed to be counter-clockwise from the light (a back side faces it). `from`
  /// and `to` are the edge's vertices in the order of the reversed loop.
  PlaneRef import_edge(PlaneRef scene_edge, PlaneId support, bool reversed, const Vertex& from,
                       const Vertex& to);
  Vertex import_vertex(const typename SceneSpace::Vertex& vertex) const;
  /// The plane through this light and the line in which a plane of another light cuts `support`,
  /// same sides: how an edge made by one light's tree goes on to the next (1989, sec. 5).
  PlaneRef import_cut(const ImplicitLightSpace& other, PlaneRef plane, PlaneId support);
  /// Completes a made vertex once the planes of its edges are known.
  void finish_vertex(Vertex& vertex, PlaneRef before, PlaneRef after) const;
  /// A fragment edge is its own shadow plane.
  PlaneRef shadow_plane(PlaneRef edge, const Vertex&, const Vertex&) { return edge; }
  PlaneRef add_prefix_plane(const PrefixPlane& plane);

  /// A plane and its doubles, to test many vertices against.
  struct LoadedPlane {
    std::array<double, 3> n;
    double slack;
    PlaneRef plane;
  };
  LoadedPlane load(PlaneRef ref) const {
    const FilteredPlane& plane = filtered(ref);
    return {plane.n, plane.slack, ref};
  }
  /// Identities: (1) the planes of the corner's edges contain it; (2) the plane of edge (a, b)
  /// contains the input vertices a and b. Exactness: always.
  Side side_of_plane(const LoadedPlane& plane, const Corner<Vertex>& corner) {
    const std::array<double, 3>& r = corner.vertex.ray;
    const double value = plane.n[0] * r[0] + plane.n[1] * r[1] + plane.n[2] * r[2];
    if (std::fabs(value) > plane.slack * static_cast<double>(corner.vertex.bound)) {
      stats_.count(Stage::kFilter);
      return (value > 0) != plane.plane.flipped() ? Side::kFront : Side::kBack;
    }
    return undecided_side(plane.plane, corner);
  }
  Side side_of_plane(PlaneRef plane, const Corner<Vertex>& corner) {
    return side_of_plane(load(plane), corner);
  }
  /// Where the edge `edge`, leaving the front of `plane` (kFront first) or entering it, meets it.
  Vertex crossing(PlaneRef plane, PlaneRef edge, bool leaving, const Corner<Vertex>&,
                  const Corner<Vertex>&) const {
    // Counter-clockwise and inside positive: leaving the front, the cut edge follows the edge.
    return leaving ? made_vertex(edge, plane) : made_vertex(plane, edge);
  }

  /// Side of the corner's point, on the support plane of its loop, of another support plane.
  /// Identities: the corner lies on a cut of the two; it is one of the three vertices that define
  /// the plane. Degree 3 and 9.
  Side side_of_support(PlaneId plane, const Corner<Vertex>& corner);
  /// The front is the part of `first` in front of `second`. Degree 5.
  PlaneRef cut_of_supports(PlaneId first, PlaneId second);

  /// See the concept SectorSpaceModel.
  ImplicitLightSpace fork() const;
  void make_edge_planes(EdgeId begin, EdgeId end);
  std::uint32_t plane_mark() const { return static_cast<std::uint32_t>(own_.size()); }
  void release_planes(std::uint32_t mark);

  /// Certified for every vertex whose doubles say something.
  ChartPoint chart_point(const LightChart& chart, const Corner<Vertex>& corner) const;
  /// The corner's point in a frame of its support plane: two components of q, scaled; for a
  /// directional light the chart's, which is an affine map of the plane.
  PlanarPoint planar_point(const Corner<Vertex>& corner) const;
  /// The same, computed from integers: relative error 16u whatever meets there at what angle.
  PlanarPoint accurate_planar_point(const Corner<Vertex>& corner) const;
  /// Enclosure of the corner's position on its support plane, in grid units times 2^-b.
  std::array<Ball, 3> position(const Corner<Vertex>& corner) const;
  /// The same, exactly, in scene units.
  std::array<mpq_class, 3> exact_position(const Corner<Vertex>& corner) const;
  /// The nearest doubles of exact_position(), at a fraction of its cost; nothing where some 100
  /// bits do not tell them (an exact tie, a light in the plane of many bits).
  std::optional<std::array<double, 3>> nearest_position(const Corner<Vertex>& corner) const;
  /// In words, for explanations: "the shadow plane of edge 4-7", ...
  std::string describe(PlaneRef plane) const;
  StageCounts stage_counts() const { return stats_.counts(); }

 private:
  /// Doubles of a plane: largest |n_k| in [1/2, 1), each off by at most 2u * slack, slack >= 1.
  struct FilteredPlane {
    std::array<double, 3> n{};
    double slack = kNotMade;  // infinite: the doubles say nothing
  };
  static constexpr double kNotMade = 0;
  /// Where a plane that is no edge's comes from: a and b are support planes, or b is kExplicit and
  /// a an index into explicit_.
  struct Source {
    std::uint32_t a = 0, b = kExplicit;
  };
  static constexpr std::uint32_t kExplicit = 0xffffffffu;
  struct Explicit {
    Vector3<mpz_class> n;
    unsigned bits = 0;  // of the largest component's magnitude
  };
  /// n / h of a support plane, in the units of stretched rays; see the head of the file.
  struct DepthPlane {
    std::array<double, 3> n{};  // each off by at most 8u |n_k|
    double magnitude = 0;       // largest |n_k|; infinite: the doubles say nothing
    Sign at_light = Sign::kZero;
  };
  /// What forks have in common.
  struct Shared {
    const Geometry* geometry = nullptr;
    SceneSpace* scene = nullptr;
    LightPoint light;
    LightAxes axes;
    unsigned light_bits = 0;  // magnitude bits of the light's coordinates
    unsigned q_bits = 0;      // magnitude bits of q
    unsigned side_bits = 0;   // signed bits of the side of an edge plane of an input vertex
    unsigned edge_bits = 0;   // magnitude bits of an edge plane
    unsigned cut_bits = 0;    // magnitude bits of a cut of two support planes
    int stretch = 0;          // z of the doubles is scaled by 2^stretch (directional lights)
    bool narrow = false;      // grid and light fit into 64 bits
    double grid_scale = 1;    // 2^-q_bits, if narrow
    std::array<std::int64_t, 3> narrow_light{};
    std::array<DoubleDouble, 3> origin;               // of the grid, scene units
    std::array<std::optional<std::int64_t>, 3> zero;  // coordinate 0, if it is on the grid
    DoubleDouble step;                                // scene units per grid unit
    std::array<Ball, 3> light_enclosure;  // position times 2^-b, or direction times a power of two
    std::vector<FilteredPlane> edges;     // by EdgeId
    std::vector<DepthPlane> depths;       // by PlaneId
  };

  Side undecided_side(PlaneRef plane, const Corner<Vertex>& corner);
  /// Of an input vertex and a point light: two components of L - v, each converted once.
  PlanarPoint input_planar_point(const Corner<Vertex>& corner) const {
    const auto [u, v] = kept_axes(shared_->depths[corner.support]);
    const std::int64_t* x = shared_->geometry->grid.narrow_point(corner.vertex.source);
    const std::array<std::int64_t, 3>& l = shared_->narrow_light;
    PlanarPoint point;
    point.x = static_cast<double>(l[u] - x[u]) * shared_->grid_scale;
    point.y = static_cast<double>(l[v] - x[v]) * shared_->grid_scale;
    point.error = Ball::kUnit * std::max(std::fabs(point.x), std::fabs(point.y));
    return point;
  }
  /// The two axes that remain when that of the normal's largest component is dropped.
  static std::array<int, 2> kept_axes(const DepthPlane& plane) {
    const double x = std::fabs(plane.n[0]), y = std::fabs(plane.n[1]), z = std::fabs(plane.n[2]);
    if (z >= x && z >= y) return {0, 1};
    return y >= x ? std::array{2, 0} : std::array{1, 2};
  }
  std::uint32_t edge_count() const { return static_cast<std::uint32_t>(shared_->edges.size()); }
  bool is_edge(PlaneRef plane) const { return plane.index() < edge_count(); }
  const FilteredPlane& filtered(PlaneRef plane) const {
    const std::uint32_t index = plane.index();
    return index < edge_count() ? shared_->edges[index] : own_[index - edge_count()];
  }
  const Source& source(PlaneRef plane) const { return sources_[plane.index() - edge_count()]; }
  bool is_cut_of(PlaneRef plane, PlaneId first, PlaneId second) const;

  /// Components are two products of factors below 1 that err by 2u times their slack, so by
  /// 2 (2u f_m + 2u f_n (1 + 2u f_m)), and roundings of 4u; the ray is below 2.
  Vertex made_vertex(PlaneRef before, PlaneRef after) const {
    const FilteredPlane& m = filtered(before);
    const FilteredPlane& n = filtered(after);
    const double sign = before.flipped() != after.flipped() ? -1 : 1;
    Vertex vertex;
    vertex.ray = {sign * (m.n[1] * n.n[2] - m.n[2] * n.n[1]),
                  sign * (m.n[2] * n.n[0] - m.n[0] * n.n[2]),
                  sign * (m.n[0] * n.n[1] - m.n[1] * n.n[0])};
    constexpr double kSlack = ray_bound(4.01 * Ball::kUnit, 0);
    constexpr double kRest = ray_bound(4.01 * Ball::kUnit, 2);
    vertex.bound = rounded_up(kSlack * (m.slack + n.slack) + kRest);
    return vertex;
  }
  /// The error of n . r for |n_k| <= 1, |r_k| <= m, errors 2u f of n and e of r is at most
  ///   3 e + 6 u f (m + e) from the operands, and 8 u m from three products and two sums,
  /// and so at most f (3.01 e + 14.1 u m) for 1 <= f <= 2^40: the slack of the plane times this
  /// bound of the ray.
  static constexpr double ray_bound(double error, double magnitude) {
    return 3.01 * error + 14.1 * Ball::kUnit * magnitude;
  }
  /// A float that is not smaller.
  static constexpr float rounded_up(double bound) {
    return static_cast<float>(bound * (1 + 0x1p-22));
  }
  /// The error of a component that a bound was made from.
  static double error_of(const Vertex& vertex) {
    const double magnitude = vertex.source == kMadeVertex ? 2 : 1;
    return (static_cast<double>(vertex.bound) - ray_bound(0, magnitude)) * (1 / 3.0);
  }
  /// Bound of depth . r for a ray of error e and magnitude m: 3 e |depth| and 24u |depth| (m + e)
  /// from the operands, 8u |depth| m from roundings.
  static double depth_error(const DepthPlane& depth, double error, double magnitude) {
    return depth.magnitude * (3.01 * error + 33 * Ball::kUnit * magnitude);
  }
  /// Bound of a ray of an input vertex: normalized, one conversion a component.
  static constexpr float kInputBound = rounded_up(ray_bound(2 * Ball::kUnit, 1));
  template <class Int>
  Vector3<Int> q(VertexId v) const;
  template <class Int>
  Vector3<Int> light() const;
  template <class Int>
  Vector3<Int> permuted(const Vector3<Int>& v) const {
    return {v[shared_->axes.x], v[shared_->axes.y], v[shared_->axes.z]};
  }
  template <class Int>
  Vector3<Int> edge_normal(const EdgeEnds& ends) const;
  template <class Int>
  Vector3<Int> cut_normal(const ExactPlane<Int>& i, const ExactPlane<Int>& j) const;
  template <class Int>
  Vector3<Int> exact_normal(PlaneRef plane) const;
  bool is_zero(const Corner<Vertex>& corner, int axis) const;
  unsigned factor_bits(const Corner<Vertex>& corner) const;
  /// The ray of a made corner, exactly, in the type of a product of two planes.
  template <class Factor, class Int>
  auto ray(const Corner<Vertex>& corner) const {
    return cross<Product<Int, Factor, Factor>>(exact_normal<Factor>(corner.before),
                                               exact_normal<Factor>(corner.after));
  }
  Side undecided_depth(PlaneId plane, const Corner<Vertex>& corner);
  Sign input_depth(PlaneId plane, VertexId vertex);
  Sign exact_sign(PlaneRef plane, const Corner<Vertex>& corner);
  /// Calls predicate.operator()<Factor, Int>() with the narrowest integers for vectors of
  /// `factor_bits` and a value of `width_bits`, or with GMP's if not `narrow`.
  template <class Predicate>
  Sign decide(bool narrow, unsigned factor_bits, unsigned width_bits, const Predicate& predicate);
  unsigned bits_of(PlaneRef plane) const;
  bool is_narrow(PlaneRef plane) const;
  template <class Int>
  FilteredPlane filtered_from(const Vector3<Int>& normal) const;
  void make_depth_planes();
  template <class Normal, class Int>
  DepthPlane depth_plane(PlaneId id) const;
  PlaneRef add(const FilteredPlane& plane, Source source);
  PlaneRef add_explicit(Vector3<mpz_class> normal);
  PlaneRef trace(PlaneId support, const ExactPlane<mpz_class>& cut);
  ExactPlane<mpz_class> in_scene(PlaneRef plane) const;
  std::array<mpq_class, 3> exact_grid_position(const Corner<Vertex>& corner) const;

  /// Exact depths of input vertices found lately: neighbours in a scene ask again and again.
  struct DepthMemo {
    std::uint64_t key = 0;  // (plane, vertex) + 1
    Sign sign = Sign::kZero;
  };
  std::vector<DepthMemo> depth_memo_ = std::vector<DepthMemo>(1024);
  std::shared_ptr<Shared> shared_;
  // Planes after those of the edges; a stack.
  std::vector<FilteredPlane> own_;
  std::vector<Source> sources_;
  std::vector<Explicit> explicit_;
  std::unordered_map<std::uint64_t, PlaneRef> traces_;     // (support plane, cutting plane)
  std::map<std::array<std::uint64_t, 3>, PlaneRef> cuts_;  // (other light, its plane, support)
  [[no_unique_address]] Stats stats_;
};

// In the chart a direction is (r_u, r_v) / |r_w|, and the depth plane gives z. With e the error of
// a component and w = |r_w|, e / w <= 2^-10, quotients err by (1 + |u|) e / w (1 + 2^-9) and three
// roundings.
template <class Stats>
inline ChartPoint ImplicitLightSpace<Stats>::chart_point(const LightChart& chart,
                                                         const Corner<Vertex>& corner) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::array<double, 3>& r = corner.vertex.ray;
  const DepthPlane& depth = shared_->depths[corner.support];
  const double error = error_of(corner.vertex);
  const double w = chart.sign * r[chart.w];
  ChartPoint point;
  point.uv_error = point.z_error = kInfinity;
  if (!(error < w * 0x1p-10)) return point;
  const double inverse = 1 / w, relative = error * inverse;
  point.u = chart.sign * r[chart.u] * inverse;
  point.v = chart.sign * r[chart.v] * inverse;
  point.z = (depth.n[0] * r[0] + depth.n[1] * r[1] + depth.n[2] * r[2]) * inverse;
  const double most = std::max(std::fabs(point.u), std::fabs(point.v));
  point.uv_error = 1.01 * (1 + most) * relative + 3 * Ball::kUnit * most;
  point.z_error = 1.01 * depth_error(depth, error, 2) * inverse +
                  std::fabs(point.z) * (1.01 * relative + 3 * Ball::kUnit);
  return point;
}

// On the ray r the plane is met in q = r / (depth . r); errors as in chart_point.
template <class Stats>
inline PlanarPoint ImplicitLightSpace<Stats>::planar_point(const Corner<Vertex>& corner) const {
  const std::array<double, 3>& r = corner.vertex.ray;
  const double error = error_of(corner.vertex);
  PlanarPoint point;
  if (corner.vertex.source != kMadeVertex && shared_->narrow && !shared_->light.directional) {
    return input_planar_point(corner);
  }
  point.error = std::numeric_limits<double>::infinity();
  double inverse, relative;
  if (shared_->light.directional) {
    inverse = 1 / r[2];
    relative = error * std::fabs(inverse);
    point.x = r[0] * inverse;
    point.y = r[1] * inverse;
  } else {
    const DepthPlane& depth = shared_->depths[corner.support];
    const double magnitude = std::max({std::fabs(r[0]), std::fabs(r[1]), std::fabs(r[2])});
    inverse = 1 / (depth.n[0] * r[0] + depth.n[1] * r[1] + depth.n[2] * r[2]);
    relative = depth_error(depth, error, magnitude) * std::fabs(inverse);
    const auto [u, v] = kept_axes(depth);
    point.x = r[u] * inverse;
    point.y = r[v] * inverse;
  }
  if (!(relative < 0x1p-10)) return point;
  const double most = std::max(std::fabs(point.x), std::fabs(point.y));
  point.error = 1.01 * (error * std::fabs(inverse) + most * relative) + 3 * Ball::kUnit * most;
  return point;
}

extern template class ImplicitLightSpace<NoStats>;
extern template class ImplicitLightSpace<CountStats>;

}  // namespace gnomon

#endif  // GNOMON_KERNEL_IMPLICIT_IMPLICIT_LIGHT_SPACE_H
