// SPDX-License-Identifier: LGPL-3.0-or-later
#include "kernel/implicit/implicit_light_space.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "kernel/implicit/exact_shadow_plane.h"
#include "kernel/signs/fp_environment.h"

namespace gnomon {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kUnit = Ball::kUnit;

double largest(const std::array<double, 3>& v) {
  return std::max({std::fabs(v[0]), std::fabs(v[1]), std::fabs(v[2])});
}

/// 2^-k with largest |v| * 2^-k in [1/2, 1). Requires: v is finite and normal.
double normalizer(double magnitude) {
  int exponent = 0;
  std::frexp(magnitude, &exponent);
  return std::ldexp(1.0, -exponent);
}

/// The largest slack for which the bound of a ray (ray_bound) holds.
constexpr double kMostSlack = 0x1p40;

unsigned bits(const Vector3<mpz_class>& v) {
  std::size_t most = 1;
  for (const mpz_class& x : v) most = std::max(most, mpz_sizeinbase(x.get_mpz_t(), 2));
  return static_cast<unsigned>(most);
}

mpz_class normal_dot(const Vector3<mpz_class>& n, const std::array<mpz_class, 3>& v) {
  return n[0] * v[0] + n[1] * v[1] + n[2] * v[2];
}

/// Nearest double, or within one unit in the last place: relative error 2u. Infinite beyond
/// doubles.
template <class Int>
double to_double(const Int& value) {
  if constexpr (kLimbsOf<Int> == 1 || kLimbsOf<Int> == 2) {
    return static_cast<double>(value);
  } else {
    return to_double_scaled(value, 0);
  }
}

/// For integers that may be beyond doubles: the bits of a magnitude; else 0.
template <class Int>
long excess_bits(const Int& value) {
  if constexpr (std::is_same_v<Int, mpz_class>) {
    return static_cast<long>(mpz_sizeinbase(value.get_mpz_t(), 2));
  } else {
    return 0;
  }
}

/// The vector as doubles, scaled by a power of two so that the largest component is in [1/2, 1),
/// after component k was multiplied by 2^stretch[k]. Relative error of each at most 2u, or 2^-1074
/// where it underflows. False: all zero.
template <class Int>
bool to_normalized(const Vector3<Int>& v, const std::array<int, 3>& stretch,
                   std::array<double, 3>& result) {
  if constexpr (std::is_same_v<Int, mpz_class>) {
    long most = std::numeric_limits<long>::min();
    for (int k = 0; k < 3; ++k) {
      if (sgn(v[k]) == 0) continue;
      most = std::max(most, static_cast<long>(mpz_sizeinbase(v[k].get_mpz_t(), 2)) + stretch[k]);
    }
    if (most == std::numeric_limits<long>::min()) return false;
    for (int k = 0; k < 3; ++k) result[k] = to_double_scaled(v[k], most - stretch[k]);
  } else {
    for (int k = 0; k < 3; ++k) {
      result[k] = to_double(v[k]);
      if (stretch[k] != 0) result[k] = std::ldexp(result[k], stretch[k]);
    }
    const double magnitude = largest(result);
    if (magnitude == 0) return false;
    const double scale = normalizer(magnitude);
    for (double& x : result) x *= scale;
  }
  return true;
}

}  // namespace

template <class Stats>
ImplicitLightSpace<Stats>::ImplicitLightSpace(SceneSpace& scene, const LightPoint& light,
                                              const KernelOptions&)
    : shared_(std::make_shared<Shared>()) {
  Shared& shared = *shared_;
  shared.geometry = &scene.geometry();
  shared.scene = &scene;
  shared.light = light;
  shared.axes = LightAxes::of(light);
  const unsigned grid_bits = shared.geometry->grid.bits(), light_bits = bits(light.grid);
  // The grid's bits are those of the vertices; a lamp may stand far outside.
  const unsigned b = light.directional ? grid_bits : std::max(grid_bits, light_bits);
  shared.light_bits = light_bits;
  shared.q_bits = light_space_bits(light.directional, b, light_bits);
  shared.edge_bits = edge_plane_bits(light.directional, b, light_bits).largest();
  shared.side_bits = side_of_edge_bits(light.directional, b, light_bits);
  shared.cut_bits = cut_plane_bits(light.directional, b, light_bits).largest();
  shared.stretch = light.directional ? static_cast<int>(b) : 0;
  shared.narrow = shared.geometry->grid.is_narrow() && light_bits <= 63;
  if (shared.narrow) {
    shared.grid_scale = std::ldexp(1.0, -static_cast<int>(shared.q_bits));
    for (int k = 0; k < 3; ++k) shared.narrow_light[k] = light.grid[k].get_si();
  }
  const unsigned shift = light.directional ? light_bits : grid_bits;
  for (int k = 0; k < 3; ++k) {
    const double value = to_double_scaled(light.grid[k], shift);
    shared.light_enclosure[k] = Ball(value, 2 * kUnit * std::fabs(value) + Ball::kTiny);
  }
  for (int k = 0; k < 3; ++k) shared.origin[k] = double_double(shared.geometry->origin[k]);
  shared.step = double_double(shared.geometry->step);
  for (int k = 0; k < 3; ++k) {
    const mpq_class zero = -shared.geometry->origin[k] / shared.geometry->step;
    const bool on_grid = zero.get_den() == 1 && mpz_sizeinbase(zero.get_num_mpz_t(), 2) <= b &&
                         sgn(zero) >= 0 && b <= 63;
    if (on_grid) shared.zero[k] = zero.get_num().get_si();
  }
  shared.edges.resize(shared.geometry->edges.size());
  make_depth_planes();
}

template <class Stats>
ImplicitLightSpace<Stats> ImplicitLightSpace<Stats>::fork() const {
  ImplicitLightSpace result = *this;
  result.stats_ = {};
  return result;
}

template <class Stats>
Sign ImplicitLightSpace<Stats>::light_side(PlaneId plane) const {
  return shared_->depths[plane].at_light;
}

template <class Stats>
template <class Int>
Vector3<Int> ImplicitLightSpace<Stats>::q(VertexId v) const {
  const Vector3<Int> p = ExactGeometry<Int>(*shared_->geometry).position(v);
  const Vector3<Int> l = light<Int>();
  if (!shared_->light.directional) return difference(l, p);
  const auto [x, y, z] = shared_->axes;
  return {Int(p[x] * l[z] - p[z] * l[x]), Int(p[y] * l[z] - p[z] * l[y]), l[z]};
}

template <class Stats>
template <class Int>
Vector3<Int> ImplicitLightSpace<Stats>::light() const {
  if constexpr (std::is_same_v<Int, mpz_class>) {
    return shared_->light.grid;
  } else {
    const std::array<std::int64_t, 3>& l = shared_->narrow_light;
    return {integer_from<Int>(l[0]), integer_from<Int>(l[1]), integer_from<Int>(l[2])};
  }
}

// The doubles of a directional light's q are scaled by 2^b in z: q = (x d_z - z d_x, y d_z - z d_y,
// d_z) has two components of b + e bits and one of e bits, and an error bound in the largest
// component would say nothing about the smallest. Scaling q by diag(1, 1, 2^b) scales normals by
// diag(2^b, 2^b, 1), up to a positive factor: no sign changes.
template <class Stats>
template <class Int>
typename ImplicitLightSpace<Stats>::FilteredPlane ImplicitLightSpace<Stats>::filtered_from(
    const Vector3<Int>& normal) const {
  const int stretch = shared_->stretch;
  FilteredPlane plane;
  plane.slack = to_normalized(normal, {stretch, stretch, 0}, plane.n) ? 1 : kInfinity;
  return plane;
}

template <class Stats>
void ImplicitLightSpace<Stats>::make_edge_planes(EdgeId begin, EdgeId end) {
  Shared& shared = *shared_;
  const auto make = [&]<class Int>() {
    for (EdgeId edge = begin; edge < end; ++edge) {
      shared.edges[edge] = filtered_from(edge_normal<Int>(shared.geometry->edges[edge]));
    }
  };
  // One bit more for the difference of two products.
  with_width(shared.narrow ? narrowest_width(shared.edge_bits + 2) : IntegerWidth::kUnbounded,
             make);
}

template <class Stats>
template <class Int>
Vector3<Int> ImplicitLightSpace<Stats>::edge_normal(const EdgeEnds& ends) const {
  const auto normal = [&]<class Position>() {
    const ExactGeometry<Position> exact(*shared_->geometry);
    const Vector3<Position> l = light<Position>();
    const Vector3<Position> a = exact.position(ends.a), b = exact.position(ends.b);
    if (!shared_->light.directional) return point_shadow_plane<Int>(l, a, b);
    return directional_shadow_plane<Int>(permuted(l), permuted(a), permuted(b));
  };
  if constexpr (std::is_same_v<Int, mpz_class>) {
    return normal.template operator()<mpz_class>();
  } else {
    return normal.template operator()<std::int64_t>();
  }
}

template <class Stats>
template <class Normal, class Int>
typename ImplicitLightSpace<Stats>::DepthPlane ImplicitLightSpace<Stats>::depth_plane(
    PlaneId id) const {
  using Position = std::conditional_t<std::is_same_v<Int, mpz_class>, mpz_class, std::int64_t>;
  const Shared& shared = *shared_;
  const ExactGeometry<Position> exact(*shared.geometry);
  const Vector3<Normal> normal = exact.template normal<Normal>(id);
  const Vector3<Position> l = light<Position>();
  const Vector3<Position> corner = exact.position(shared.geometry->planes[id].a);
  const Int height =
      shared.light.directional ? dot<Int>(normal, l) : dot<Int>(normal, difference(l, corner));
  DepthPlane depth;
  depth.at_light = sign_of(height);
  depth.magnitude = kInfinity;
  if (depth.at_light == Sign::kZero) return depth;
  // Scaled such that nothing of usual size over- or underflows.
  const unsigned b = shared.geometry->grid.bits();
  double h;
  if (shared.light.directional) {
    const auto [x, y, z] = shared.axes;
    const unsigned e = shared.light_bits;
    h = to_double_scaled(height, 2 * b + e);
    const double sign = sgn(shared.light.grid[z]) < 0 ? -1 : 1;
    depth.n = {-sign * to_double_scaled(normal[x], 2 * b) / h,
               -sign * to_double_scaled(normal[y], 2 * b) / h,
               sign * to_double_scaled(dot<Int>(normal, corner), 3 * b) / h};
  } else {
    const unsigned B = shared.q_bits;
    h = to_double_scaled(height, 2 * b + B);
    for (int k = 0; k < 3; ++k) depth.n[k] = to_double_scaled(normal[k], 2 * b) / h;
  }
  const double magnitude = largest(depth.n);
  // Neither the quotient nor its operands have lost bits to underflow.
  if (magnitude > 0x1p-900 && magnitude < 0x1p900 && std::fabs(h) > 0x1p-900 &&
      magnitude * std::fabs(h) > 0x1p-900) {
    depth.magnitude = magnitude;
  }
  return depth;
}

template <class Stats>
void ImplicitLightSpace<Stats>::make_depth_planes() {
  Shared& shared = *shared_;
  shared.depths.resize(shared.geometry->planes.size());
  const auto make = [&]<class Normal, class Int>() {
    tbb::parallel_for(std::size_t{0}, shared.depths.size(), [&](std::size_t id) {
      shared.depths[id] = depth_plane<Normal, Int>(static_cast<PlaneId>(id));
    });
  };
  const unsigned b = shared.geometry->grid.bits();
  // n . (L - A), n . d and the plane's offset n . A; one bit more for the difference in a normal.
  const unsigned bits =
      shared.light.directional ? 2 * b + shared.light_bits : 2 * b + shared.q_bits;
  const unsigned most = std::max(bits, 3 * b) + 4;
  with_widths(shared.narrow ? narrowest_width(most) : IntegerWidth::kUnbounded,
              support_normal_bits(b) + 1, make);
}

template <class Stats>
PlaneRef ImplicitLightSpace<Stats>::add(const FilteredPlane& plane, Source source) {
  own_.push_back(plane);
  sources_.push_back(source);
  return PlaneRef(edge_count() + static_cast<std::uint32_t>(own_.size()) - 1);
}

template <class Stats>
void ImplicitLightSpace<Stats>::release_planes(std::uint32_t mark) {
  for (std::size_t i = mark; i < sources_.size(); ++i) {
    if (sources_[i].b == kExplicit) explicit_.pop_back();
  }
  own_.resize(mark);
  sources_.resize(mark);
}

template <class Stats>
PlaneRef ImplicitLightSpace<Stats>::add_explicit(Vector3<mpz_class> normal) {
  const FilteredPlane plane = filtered_from(normal);
  const unsigned width = bits(normal);
  explicit_.push_back({std::move(normal), width});
  return add(plane, {static_cast<std::uint32_t>(explicit_.size() - 1), kExplicit});
}

template <class Stats>
PlaneRef ImplicitLightSpace<Stats>::add_prefix_plane(const PrefixPlane& plane) {
  return add_explicit(plane.n);
}

// The plane through the light and the line in which support plane i is cut by plane j, positive on
// the part of i in front of j. Point light: P_j(v) = P_j(L) - n_j . q, and on plane i n_i . q =
// P_i(L), so that P_i(L) P_j(v) = (P_j(L) n_i - P_i(L) n_j) . q, with P_i(L) made positive.
// Directional light with H = n . d > 0 for i: H_i P_j - H_j P_i is constant along d; in q
// coordinates it is (N_x, N_y, -o) . q / d_z, N = H_i n_j - H_j n_i, o = H_i d_j - H_j d_i.
template <class Stats>
template <class Int>
Vector3<Int> ImplicitLightSpace<Stats>::cut_normal(const ExactPlane<Int>& i,
                                                   const ExactPlane<Int>& j) const {
  const LightAxes& axes = shared_->axes;
  const Vector3<Int> l = light<Int>();
  const bool directional = shared_->light.directional;
  Int hi = dot(i.n, l), hj = dot(j.n, l);
  Vector3<Int> normal;
  if (!directional) {
    hi = hi - i.d;
    hj = hj - j.d;
    for (int k = 0; k < 3; ++k) normal[k] = hj * i.n[k] - hi * j.n[k];
  } else {
    normal[0] = hi * j.n[axes.x] - hj * i.n[axes.x];
    normal[1] = hi * j.n[axes.y] - hj * i.n[axes.y];
    normal[2] = hj * i.d - hi * j.d;
  }
  // Plane i oriented to the light, and d_z positive.
  const bool flip =
      (sign_of(hi) == Sign::kNegative) != (directional && sign_of(l[axes.z]) == Sign::kNegative);
  if (flip) {
    for (Int& x : normal) x = -x;
  }
  return normal;
}

template <class Stats>
PlaneRef ImplicitLightSpace<Stats>::trace(PlaneId support, const ExactPlane<mpz_class>& cut) {
  return add_explicit(cut_normal(ExactGeometry<mpz_class>(*shared_->geometry).plane(support), cut));
}

// Both planes usable: the normal is the difference of the depth planes, up to a positive factor.
template <class Stats>
PlaneRef ImplicitLightSpace<Stats>::cut_of_supports(PlaneId first, PlaneId second) {
  const DepthPlane& i = shared_->depths[first];
  const DepthPlane& j = shared_->depths[second];
  const double sum = i.magnitude + j.magnitude;
  FilteredPlane plane;
  plane.slack = kInfinity;
  for (int k = 0; k < 3; ++k) plane.n[k] = i.n[k] - j.n[k];
  const double magnitude = largest(plane.n);
  if (sum < kInfinity && magnitude > sum * 0x1p-40) {
    const double scale = normalizer(magnitude) * static_cast<int>(j.at_light);
    for (double& x : plane.n) x *= scale;
    // Components are off by 8u of each operand and a rounding: 9.1u of the sum. In units of 2u.
    plane.slack = 1 + 4.6 * sum * std::fabs(scale);
    if (!(plane.slack <= kMostSlack)) plane.slack = kInfinity;
  }
  return add(plane, {first, second});
}

template <class Stats>
bool ImplicitLightSpace<Stats>::is_cut_of(PlaneRef ref, PlaneId first, PlaneId second) const {
  if (is_edge(ref)) return false;
  const Source& from = source(ref);
  return from.b != kExplicit &&
         ((from.a == first && from.b == second) || (from.a == second && from.b == first));
}

// A plane of another light in three dimensions: m . q with q = L - v is -m . v + m . L; for a
// directional light m . q = m_x (x d_z - z d_x) + m_y (y d_z - z d_y) + m_z d_z.
template <class Stats>
ExactPlane<mpz_class> ImplicitLightSpace<Stats>::in_scene(PlaneRef ref) const {
  const Vector3<mpz_class> m = exact_normal<mpz_class>(PlaneRef(ref.index()));
  const LightPoint& light = shared_->light;
  ExactPlane<mpz_class> plane;
  if (!light.directional) {
    for (int k = 0; k < 3; ++k) plane.n[k] = -m[k];
    plane.d = -normal_dot(m, light.grid);
    return plane;
  }
  const auto [x, y, z] = shared_->axes;
  const std::array<mpz_class, 3>& d = light.grid;
  plane.n[x] = m[0] * d[z];
  plane.n[y] = m[1] * d[z];
  plane.n[z] = -(m[0] * d[x] + m[1] * d[y]);
  plane.d = -m[2] * d[z];
  return plane;
}

template <class Stats>
PlaneRef ImplicitLightSpace<Stats>::import_cut(const ImplicitLightSpace& other, PlaneRef ref,
                                               PlaneId support) {
  const std::array<std::uint64_t, 3> key{reinterpret_cast<std::uintptr_t>(&other), ref.index(),
                                         support};
  auto found = cuts_.find(key);
  if (found == cuts_.end()) {
    found = cuts_.emplace(key, trace(support, other.in_scene(ref))).first;
  }
  return ref.flipped() ? -found->second : found->second;
}

template <class Stats>
PlaneRef ImplicitLightSpace<Stats>::import_edge(PlaneRef scene_edge, PlaneId support, bool reversed,
                                                const Vertex&, const Vertex&) {
  const SceneEdges names = shared_->scene->edges();
  if (names.is_input_edge(scene_edge)) {
    const EdgeId edge = names.edge(scene_edge);
    if (shared_->edges[edge].slack == kNotMade) make_edge_planes(edge, edge + 1);
    return PlaneRef(edge, scene_edge.flipped() != reversed);
  }
  const std::uint64_t key = (std::uint64_t{support} << 32) | scene_edge.index();
  auto found = traces_.find(key);
  if (found == traces_.end()) {
    const ExactPlane<mpz_class> cut =
        ExactGeometry<mpz_class>(*shared_->geometry).plane(scene_edge.index());
    found = traces_.emplace(key, trace(support, cut)).first;
  }
  return scene_edge.flipped() ? -found->second : found->second;
}

template <class Stats>
typename ImplicitLightSpace<Stats>::Vertex ImplicitLightSpace<Stats>::import_vertex(
    const typename SceneSpace::Vertex& vertex) const {
  Vertex result;
  result.source = vertex.source;
  if (vertex.source == kMadeVertex) return result;
  const std::array<int, 3> stretch{0, 0, shared_->stretch};
  bool some = false;
  with_width(
      shared_->narrow ? narrowest_width(shared_->q_bits + 1) : IntegerWidth::kUnbounded,
      [&]<class Int>() { some = to_normalized(q<Int>(vertex.source), stretch, result.ray); });
  result.bound = some ? kInputBound : std::numeric_limits<float>::infinity();
  return result;
}

template <class Stats>
void ImplicitLightSpace<Stats>::finish_vertex(Vertex& vertex, PlaneRef before,
                                              PlaneRef after) const {
  vertex = made_vertex(before, after);
}

template <class Stats>
Side ImplicitLightSpace<Stats>::undecided_side(PlaneRef ref, const Corner<Vertex>& corner) {
  if (ref.same_plane(corner.before) || ref.same_plane(corner.after)) {
    stats_.count(Stage::kIdentity);
    return Side::kOn;
  }
  const Vertex& vertex = corner.vertex;
  if (vertex.source != kMadeVertex && is_edge(ref)) {
    const EdgeEnds ends = shared_->geometry->edges[ref.index()];
    if (vertex.source == ends.a || vertex.source == ends.b) {
      stats_.count(Stage::kIdentity);
      return Side::kOn;
    }
  }
  return side_of(exact_sign(ref, corner));
}

template <class Stats>
Side ImplicitLightSpace<Stats>::side_of_support(PlaneId plane, const Corner<Vertex>& corner) {
  if (plane == corner.support) {
    stats_.count(Stage::kIdentity);
    return Side::kOn;
  }
  const DepthPlane& own = shared_->depths[corner.support];
  const DepthPlane& other = shared_->depths[plane];
  const std::array<double, 3>& r = corner.vertex.ray;
  const double value = (own.n[0] - other.n[0]) * r[0] + (own.n[1] - other.n[1]) * r[1] +
                       (own.n[2] - other.n[2]) * r[2];
  // With M the sum of the magnitudes, |r| <= 2 and e <= bound / 3: differences err by 9.1u M, so
  // their products with r by 3 (M e + 9.1u M (2 + e)), and roundings are 16u M.
  const double bound =
      (own.magnitude + other.magnitude) * (static_cast<double>(corner.vertex.bound) + 72 * kUnit);
  if (std::fabs(value) > bound) {
    stats_.count(Stage::kFilter);
    return (value > 0) == (other.at_light == Sign::kPositive) ? Side::kFront : Side::kBack;
  }
  return undecided_depth(plane, corner);
}

template <class Stats>
Side ImplicitLightSpace<Stats>::undecided_depth(PlaneId plane, const Corner<Vertex>& corner) {
  if (corner.vertex.source != kMadeVertex) return side_of(input_depth(plane, corner.vertex.source));
  if (is_cut_of(corner.before, corner.support, plane) ||
      is_cut_of(corner.after, corner.support, plane)) {
    stats_.count(Stage::kIdentity);
    return Side::kOn;
  }
  // A vertex on an edge of its own polygon lies between the edge's ends: two decisions of degree 3
  // often save one of degree 9. A polygon that shares the edge is the common case.
  for (const PlaneRef ref : {corner.before, corner.after}) {
    if (!is_edge(ref)) continue;
    const EdgeEnds ends = shared_->geometry->edges[ref.index()];
    if (input_depth(corner.support, ends.a) != Sign::kZero ||
        input_depth(corner.support, ends.b) != Sign::kZero) {
      continue;  // an edge of another polygon
    }
    const Sign a = input_depth(plane, ends.a), b = input_depth(plane, ends.b);
    if (a == b) return side_of(a);
    if (a == Sign::kZero) return side_of(b);
    if (b == Sign::kZero) return side_of(a);
  }
  const Shared& shared = *shared_;
  const bool narrow = shared.narrow && is_narrow(corner.before) && is_narrow(corner.after);
  const unsigned n = shared.cut_bits, m = bits_of(corner.before), l = bits_of(corner.after);
  const Sign sign = decide(
      narrow, std::max({n, m, l}), side_of_crossing_bits(n, m, l), [&]<class Factor, class Int>() {
        const ExactGeometry<Factor> exact(*shared.geometry);
        return sign_of_determinant<Int>(cut_normal(exact.plane(corner.support), exact.plane(plane)),
                                        exact_normal<Factor>(corner.before),
                                        exact_normal<Factor>(corner.after));
      });
  return side_of(sign);
}

template <class Stats>
Sign ImplicitLightSpace<Stats>::input_depth(PlaneId plane, VertexId vertex) {
  const Geometry& geometry = *shared_->geometry;
  const SupportTriple& triple = geometry.planes[plane];
  if (vertex == triple.a || vertex == triple.b || vertex == triple.c) {
    stats_.count(Stage::kIdentity);
    return Sign::kZero;
  }
  const std::uint64_t key = (std::uint64_t{plane} << 32 | vertex) + 1;
  DepthMemo& memo = depth_memo_[(plane * 0x9e3779b9u ^ vertex * 0x85ebca6bu) >> 22];
  if (memo.key == key) {
    stats_.count(Stage::kIdentity);
    return memo.sign;
  }
  const unsigned b = geometry.grid.bits();
  const Sign sign = decide(true, b, side_of_support_bits(b), [&]<class, class Int>() {
    return sign_of(ExactGeometry<Int>(geometry).value(plane, vertex));
  });
  memo = {key, sign};
  return sign;
}

template <class Stats>
Sign ImplicitLightSpace<Stats>::exact_sign(PlaneRef ref, const Corner<Vertex>& corner) {
  const Shared& shared = *shared_;
  const VertexId input = corner.vertex.source;
  if (input != kMadeVertex && is_edge(ref)) {
    const EdgeEnds ends = shared.geometry->edges[ref.index()];
    const Sign sign = decide(shared.narrow, 0, shared.side_bits, [&]<class, class Int>() {
      using Position = std::conditional_t<std::is_same_v<Int, mpz_class>, mpz_class, std::int64_t>;
      const ExactGeometry<Position> exact(*shared.geometry);
      return side_of_shadow_plane<Int>(shared.light.directional, light<Position>(),
                                       exact.position(ends.a), exact.position(ends.b),
                                       exact.position(input));
    });
    return ref.flipped() ? -sign : sign;
  }
  if (input != kMadeVertex) {
    return decide(shared.narrow && is_narrow(ref), std::max(bits_of(ref), shared.q_bits),
                  side_of_input_vertex_bits(bits_of(ref), shared.q_bits),
                  [&]<class Factor, class Int>() {
                    return sign_of(dot<Int>(exact_normal<Factor>(ref), q<Factor>(input)));
                  });
  }
  const bool narrow =
      shared.narrow && is_narrow(ref) && is_narrow(corner.before) && is_narrow(corner.after);
  const unsigned n = bits_of(ref), m = bits_of(corner.before), l = bits_of(corner.after);
  return decide(narrow, std::max({n, m, l}), side_of_crossing_bits(n, m, l),
                [&]<class Factor, class Int>() {
                  return sign_of_determinant<Int>(exact_normal<Factor>(ref),
                                                  exact_normal<Factor>(corner.before),
                                                  exact_normal<Factor>(corner.after));
                });
}

template <class Stats>
template <class Predicate>
Sign ImplicitLightSpace<Stats>::decide(bool narrow, unsigned factor_bits, unsigned width_bits,
                                       const Predicate& predicate) {
  const IntegerWidth width = narrow ? narrowest_width(width_bits) : IntegerWidth::kUnbounded;
  stats_.count(exact_stage(width));
  const Sign sign = with_widths(width, factor_bits, predicate);
  if (sign == Sign::kZero) stats_.count_zero();
  return sign;
}

template <class Stats>
unsigned ImplicitLightSpace<Stats>::bits_of(PlaneRef plane) const {
  if (is_edge(plane)) return shared_->edge_bits;
  const Source& from = source(plane);
  return from.b == kExplicit ? explicit_[from.a].bits : shared_->cut_bits;
}

template <class Stats>
bool ImplicitLightSpace<Stats>::is_narrow(PlaneRef plane) const {
  if (is_edge(plane)) return true;
  const Source& from = source(plane);
  return from.b != kExplicit || explicit_[from.a].bits <= 63;
}

template <class Stats>
template <class Int>
Vector3<Int> ImplicitLightSpace<Stats>::exact_normal(PlaneRef ref) const {
  Vector3<Int> n;
  if (is_edge(ref)) {
    n = edge_normal<Int>(shared_->geometry->edges[ref.index()]);
  } else if (const Source& from = source(ref); from.b == kExplicit) {
    for (int k = 0; k < 3; ++k) n[k] = integer_from<Int>(explicit_[from.a].n[k]);
  } else {
    const ExactGeometry<Int> exact(*shared_->geometry);
    n = cut_normal(exact.plane(from.a), exact.plane(from.b));
  }
  if (ref.flipped()) {
    for (Int& x : n) x = -x;
  }
  return n;
}

/// For with_widths(): planes that meet in a made corner, and its support normal.
template <class Stats>
unsigned ImplicitLightSpace<Stats>::factor_bits(const Corner<Vertex>& corner) const {
  return std::max({bits_of(corner.before), bits_of(corner.after),
                   support_normal_bits(shared_->geometry->grid.bits()) + 1});
}

// The same from integers: q = h r / (n . r), each factor rounded once, so that nothing cancels.
template <class Stats>
PlanarPoint ImplicitLightSpace<Stats>::accurate_planar_point(const Corner<Vertex>& corner) const {
  const Shared& shared = *shared_;
  const VertexId input = corner.vertex.source;
  const bool made = input == kMadeVertex;
  if (!made && shared.narrow && !shared.light.directional) return input_planar_point(corner);
  PlanarPoint point;
  point.error = kInfinity;
  const auto [u, v] = kept_axes(shared.depths[corner.support]);
  // The corner's ray r, its plane's normal n and value h at the light, up to one common factor.
  // Clang 14 captures structured bindings by name alone.
  const auto place = [&, u = u, v = v]<class Normal, class Int, class Ray>(const Vector3<Ray>& r) {
    std::array<double, 4> value;
    long power;  // of two; unbounded integers may be beyond doubles, and give theirs away first
    if (shared.light.directional) {
      const long top = std::max(excess_bits(r[0]), excess_bits(r[1])), low = excess_bits(r[2]);
      value = {to_double_scaled(r[0], top), to_double_scaled(r[1], top),
               to_double_scaled(r[2], low), 1};
      power = top - low - shared.stretch;
    } else {
      using Position = std::conditional_t<std::is_same_v<Int, mpz_class>, mpz_class, std::int64_t>;
      const ExactGeometry<Position> exact(*shared.geometry);
      const Vector3<Normal> n = exact.template normal<Normal>(corner.support);
      const VertexId a = shared.geometry->planes[corner.support].a;
      const Int height = dot<Int>(n, difference(light<Position>(), exact.position(a)));
      const Int slope = dot<Int>(n, r);
      const long top = std::max(excess_bits(r[u]), excess_bits(r[v])), low = excess_bits(slope),
                 far = excess_bits(height);
      value = {to_double_scaled(r[u], top), to_double_scaled(r[v], top),
               to_double_scaled(slope, low), to_double_scaled(height, far)};
      power = top - low + far - static_cast<long>(shared.q_bits);
    }
    point.x = std::ldexp(value[0] / value[2] * value[3], static_cast<int>(power));
    point.y = std::ldexp(value[1] / value[2] * value[3], static_cast<int>(power));
  };
  const unsigned plane_bits = 2 * shared.geometry->grid.bits() + 1;
  if (made) {
    // Of the ray, or of L - A: planes of a prefix have so few bits that it may be the longer.
    const unsigned bits =
        std::max(bits_of(corner.before) + bits_of(corner.after) + 2, shared.q_bits);
    const bool narrow = shared.narrow && is_narrow(corner.before) && is_narrow(corner.after);
    with_widths(narrow ? narrowest_width(bits + plane_bits + 3) : IntegerWidth::kUnbounded,
                factor_bits(corner), [&]<class Factor, class Int>() {
                  place.template operator()<Factor, Int>(ray<Factor, Int>(corner));
                });
  } else {
    place.template operator()<mpz_class, mpz_class>(q<mpz_class>(input));
  }
  const double most = std::max(std::fabs(point.x), std::fabs(point.y));
  if (most < 0x1p900) point.error = 16 * kUnit * most + 0x1p-900;
  return point;
}

// On the ray r the support plane i is met where P_i(v) = 0. Point light: v = L - s r with
// s = P_i(L) / (n_i . r). Directional: U = r_x / r_z and V = r_y / r_z are x - z d_x / d_z and
// y - z d_y / d_z, so that z = (o - n_x U - n_y V) d_z / H and x, y follow.
template <class Stats>
std::array<Ball, 3> ImplicitLightSpace<Stats>::position(const Corner<Vertex>& corner) const {
  const Vertex& vertex = corner.vertex;
  std::array<Ball, 3> point;
  if (vertex.source != kMadeVertex) {
    const typename SceneSpace::Vertex input = shared_->scene->input_vertex(vertex.source);
    for (int k = 0; k < 3; ++k) {
      point[k] = Ball(input.x[k], input.error * input.x[k] + Ball::kTiny);
    }
    return point;
  }
  const std::array<Ball, 4> plane = shared_->scene->plane_enclosure(corner.support);
  const std::array<Ball, 3>& l = shared_->light_enclosure;
  std::array<Ball, 3> r;
  for (int k = 0; k < 3; ++k) r[k] = Ball(vertex.ray[k], static_cast<double>(vertex.bound));
  Ball height = plane[0] * l[0] + plane[1] * l[1] + plane[2] * l[2];
  if (!shared_->light.directional) {
    height = height - plane[3];
    const Ball s = height / (plane[0] * r[0] + plane[1] * r[1] + plane[2] * r[2]);
    for (int k = 0; k < 3; ++k) point[k] = l[k] - s * r[k];
    return point;
  }
  const auto [x, y, z] = shared_->axes;
  // q_x / q_z = (x d_z - z d_x) / d_z is in grid units; the stretch of z makes it units of 2^b.
  const Ball u = r[0] / r[2], v = r[1] / r[2];
  point[z] = (plane[3] - plane[x] * u - plane[y] * v) * l[z] / height;
  point[x] = u + point[z] * l[x] / l[z];
  point[y] = v + point[z] * l[y] / l[z];
  return point;
}

template <class Stats>
std::array<mpq_class, 3> ImplicitLightSpace<Stats>::exact_position(
    const Corner<Vertex>& corner) const {
  std::array<mpq_class, 3> point = exact_grid_position(corner);
  for (int k = 0; k < 3; ++k)
    point[k] = shared_->geometry->origin[k] + shared_->geometry->step * point[k];
  return point;
}

// Whether coordinate `axis` of a made corner is exactly 0, which no bound can tell: much of a scene
// stands on z = 0. A point light's L - h r / (n . r) is G if (L - G) (n . r) = h r.
template <class Stats>
bool ImplicitLightSpace<Stats>::is_zero(const Corner<Vertex>& corner, int axis) const {
  const Shared& shared = *shared_;
  const std::optional<std::int64_t> zero = shared.zero[axis];
  const bool narrow = shared.narrow && is_narrow(corner.before) && is_narrow(corner.after);
  if (!zero || !narrow || shared.light.directional) return false;
  const unsigned b = std::max(shared.geometry->grid.bits(), shared.q_bits);
  const unsigned bits = bits_of(corner.before) + bits_of(corner.after) + 2;
  bool result = false;
  const auto test = [&]<class Factor, class Int>() {
    if constexpr (!std::is_same_v<Int, mpz_class>) {
      const ExactGeometry<std::int64_t> exact(*shared.geometry);
      const Vector3<Factor> n = exact.normal<Factor>(corner.support);
      const Vector3<std::int64_t> a = exact.position(shared.geometry->planes[corner.support].a);
      const Vector3<std::int64_t> l = light<std::int64_t>();
      const auto r = ray<Factor, Int>(corner);
      const Int left = multiply<Int>(l[axis] - *zero, dot<Int>(n, r));
      const Int right = multiply<Int>(dot<Int>(n, difference(l, a)), r[axis]);
      result = sign_of(Int(left - right)) == Sign::kZero;
    }
  };
  with_widths(narrowest_width(bits + 3 * b + 6), factor_bits(corner), test);
  return result;
}

// The formulas of exact_grid_position in pairs of doubles, from integers. A point light's vertex is
// L - h r / (n . r); a directional light's is z = (d - n_x U - n_y V) d_z / H and so on with
// U = r_x / r_z. Every factor errs by less than 2^-100 of itself, and sums are of terms whose
// magnitudes are added up; the bound is 2^-94 of those.
template <class Stats>
std::optional<std::array<double, 3>> ImplicitLightSpace<Stats>::nearest_position(
    const Corner<Vertex>& corner) const {
  const Shared& shared = *shared_;
  if (corner.vertex.source != kMadeVertex) {
    return shared.geometry->positions[corner.vertex.source];
  }
  std::array<DoubleDouble, 3> grid;  // grid units
  std::array<double, 3> terms;       // sums of magnitudes
  const auto locate = [&]<class Factor, class Int>() {
    using Position = std::conditional_t<std::is_same_v<Int, mpz_class>, mpz_class, std::int64_t>;
    const ExactGeometry<Position> exact(*shared.geometry);
    const Vector3<Factor> n = exact.template normal<Factor>(corner.support);
    const Vector3<Position> a = exact.position(shared.geometry->planes[corner.support].a);
    const Vector3<Position> l = light<Position>();
    const auto r = ray<Factor, Int>(corner);
    if (!shared.light.directional) {
      const DoubleDouble s =
          double_double(dot<Int>(n, difference(l, a))) / double_double(dot<Int>(n, r));
      for (int k = 0; k < 3; ++k) {
        const DoubleDouble at = double_double(l[k]), step = s * double_double(r[k]);
        grid[k] = at - step;
        terms[k] = std::fabs(at.high) + std::fabs(step.high);
      }
      return;
    }
    const auto [x, y, z] = shared.axes;
    const DoubleDouble u = double_double(r[0]) / double_double(r[2]);
    const DoubleDouble v = double_double(r[1]) / double_double(r[2]);
    const DoubleDouble dz = double_double(l[z]), scale = dz / double_double(dot<Int>(n, l));
    const DoubleDouble d = double_double(dot<Int>(n, a));
    const DoubleDouble nu = double_double(n[x]) * u, nv = double_double(n[y]) * v;
    const DoubleDouble dx = double_double(l[x]) / dz, dy = double_double(l[y]) / dz;
    grid[z] = (d - nu - nv) * scale;
    terms[z] =
        (std::fabs(d.high) + std::fabs(nu.high) + std::fabs(nv.high)) * std::fabs(scale.high);
    grid[x] = u + grid[z] * dx;
    terms[x] = std::fabs(u.high) + terms[z] * std::fabs(dx.high);
    grid[y] = v + grid[z] * dy;
    terms[y] = std::fabs(v.high) + terms[z] * std::fabs(dy.high);
  };
  // Of the ray, or of L - A, as in accurate_planar_point; of a direction or a position.
  const unsigned bits = std::max(bits_of(corner.before) + bits_of(corner.after) + 2, shared.q_bits);
  const bool narrow = shared.narrow && is_narrow(corner.before) && is_narrow(corner.after);
  const unsigned plane_bits = std::max(2 * shared.geometry->grid.bits() + 1, shared.light_bits + 1);
  with_widths(narrow ? narrowest_width(bits + plane_bits + 3) : IntegerWidth::kUnbounded,
              factor_bits(corner), locate);
  std::array<double, 3> result;
  for (int k = 0; k < 3; ++k) {
    const DoubleDouble offset = grid[k] * shared.step;
    const double most = terms[k] * std::fabs(shared.step.high) + std::fabs(shared.origin[k].high);
    const std::optional<double> nearest =
        gnomon::nearest_double(shared.origin[k] + offset, 0x1p-94 * most);
    if (nearest) {
      result[k] = *nearest;
    } else if (is_zero(corner, k)) {
      result[k] = 0;
    } else {
      return std::nullopt;
    }
  }
  return result;
}

template <class Stats>
std::array<mpq_class, 3> ImplicitLightSpace<Stats>::exact_grid_position(
    const Corner<Vertex>& corner) const {
  std::array<mpq_class, 3> point;
  if (corner.vertex.source != kMadeVertex) {
    for (int k = 0; k < 3; ++k) point[k] = shared_->geometry->grid.at(corner.vertex.source, k);
    return point;
  }
  const Vector3<mpz_class> r =
      cross(exact_normal<mpz_class>(corner.before), exact_normal<mpz_class>(corner.after));
  const ExactPlane<mpz_class> plane =
      ExactGeometry<mpz_class>(*shared_->geometry).plane(corner.support);
  if (!shared_->light.directional) {
    const mpz_class height = normal_dot(plane.n, shared_->light.grid) - plane.d;
    mpq_class s(height, dot(plane.n, r));
    s.canonicalize();
    for (int k = 0; k < 3; ++k) point[k] = shared_->light.grid[k] - s * r[k];
    return point;
  }
  const auto [x, y, z] = shared_->axes;
  mpq_class u(r[0], r[2]), v(r[1], r[2]);
  u.canonicalize();
  v.canonicalize();
  const mpz_class height = normal_dot(plane.n, shared_->light.grid);
  const mpz_class& dz = shared_->light.grid[z];
  point[z] = (plane.d - plane.n[x] * u - plane.n[y] * v) * dz / height;
  point[x] = u + point[z] * shared_->light.grid[x] / dz;
  point[y] = v + point[z] * shared_->light.grid[y] / dz;
  return point;
}

template <class Stats>
std::string ImplicitLightSpace<Stats>::describe(PlaneRef ref) const {
  if (!is_edge(ref)) return "a plane through the light along a cut";
  const EdgeEnds ends = shared_->geometry->edges[ref.index()];
  return "the shadow plane of edge " + std::to_string(ends.a) + "-" + std::to_string(ends.b);
}

template class ImplicitLightSpace<NoStats>;
template class ImplicitLightSpace<CountStats>;

}  // namespace gnomon
