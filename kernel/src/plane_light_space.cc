// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/kernel/plane_light_space.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "gnomon/kernel/fp_environment.h"

namespace gnomon {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kUnit = Ball::kUnit;
// Below this a product of three factors may have lost bits to underflow; see the header.
constexpr double kLeastBound = 0x1p-900;

double largest(const std::array<double, 3>& v) {
  return std::max({std::fabs(v[0]), std::fabs(v[1]), std::fabs(v[2])});
}

/// For a vector that was rounded once: relative error 2u, unless underflow took part of it.
void set_bound(const std::array<double, 3>& v, double& magnitude, double& error) {
  magnitude = largest(v);
  error = magnitude >= kLeastBound && magnitude < kInfinity ? 2 * kUnit * magnitude : kInfinity;
}

unsigned bits(const Vector3<mpz_class>& v) {
  std::size_t most = 1;
  for (const mpz_class& x : v) most = std::max(most, mpz_sizeinbase(x.get_mpz_t(), 2));
  return static_cast<unsigned>(most);
}

mpz_class normal_dot(const Vector3<mpz_class>& n, const std::array<mpz_class, 3>& v) {
  return n[0] * v[0] + n[1] * v[1] + n[2] * v[2];
}

}  // namespace

template <class Stats>
PlaneLightSpace<Stats>::PlaneLightSpace(SceneSpace& scene, const LightPoint& light,
                                        const KernelOptions&)
    : geometry_(&scene.geometry()), scene_(&scene), light_(light), axes_(LightAxes::of(light)) {
  const unsigned grid_bits = geometry_->grid.bits();
  // The grid's bits are those of the vertices; a lamp may stand far outside.
  const unsigned b = light.directional ? grid_bits : std::max(grid_bits, bits(light.grid));
  q_bits_ = light_space_bits(light.directional, b, bits(light.grid));
  edge_bits_ = shadow_plane_bits(q_bits_);
  stretch_ = light.directional ? static_cast<int>(b) : 0;
  narrow_ = geometry_->grid.is_narrow() && q_bits_ <= 62 && bits(light.grid) <= 62;
  if (narrow_) {
    for (int k = 0; k < 3; ++k) narrow_light_[k] = light.grid[k].get_si();
  }
  const unsigned shift = light.directional ? bits(light.grid) : grid_bits;
  for (int k = 0; k < 3; ++k) {
    const double value = to_double_scaled(light.grid[k], shift);
    light_enclosure_[k] = Ball(value, 2 * kUnit * std::fabs(value) + Ball::kTiny);
  }
  plane_of_edge_.assign(geometry_->edges.size(), kExplicit);
}

// The doubles of a directional light's q are scaled by 2^b in z: q = (x d_z - z d_x, y d_z - z d_y,
// d_z) has two components of b + e bits and one of e bits, and an error bound in the largest
// component would say nothing about the smallest. Scaling q by diag(1, 1, 2^b) scales normals by
// diag(2^b, 2^b, 1), up to a positive factor: no sign changes.
template <class Stats>
std::array<double, 3> PlaneLightSpace<Stats>::scaled(const Vector3<mpz_class>& v, bool is_normal,
                                                     unsigned magnitude_bits) const {
  std::array<double, 3> result;
  for (int k = 0; k < 3; ++k) {
    const bool grows = stretch_ != 0 && (is_normal ? k < 2 : k == 2);
    result[k] = to_double_scaled(v[k], static_cast<long>(magnitude_bits) - (grows ? stretch_ : 0));
  }
  return result;
}

template <class Stats>
std::array<double, 3> PlaneLightSpace<Stats>::scaled(const Vector3<Int128>& v, bool is_normal,
                                                     unsigned magnitude_bits) const {
  std::array<double, 3> result;
  for (int k = 0; k < 3; ++k) {
    const bool grows = stretch_ != 0 && (is_normal ? k < 2 : k == 2);
    result[k] = std::ldexp(static_cast<double>(v[k]),
                           -static_cast<int>(magnitude_bits) + (grows ? stretch_ : 0));
  }
  return result;
}

template <class Stats>
Sign PlaneLightSpace<Stats>::light_side(PlaneId plane) const {
  const ExactPlane<mpz_class> exact = ExactGeometry<mpz_class>(*geometry_).plane(plane);
  const mpz_class value = normal_dot(exact.n, light_.grid);
  return sign_of(light_.directional ? value : mpz_class(value - exact.d));
}

template <class Stats>
template <class Int>
Vector3<Int> PlaneLightSpace<Stats>::q(VertexId v) const {
  const Vector3<Int> p = ExactGeometry<Int>(*geometry_).position(v);
  Vector3<Int> l;
  for (int k = 0; k < 3; ++k) {
    if constexpr (std::is_same_v<Int, mpz_class>) {
      l[k] = light_.grid[k];
    } else {
      l[k] = integer_from<Int>(narrow_light_[k]);
    }
  }
  if (!light_.directional) return difference(l, p);
  const auto [x, y, z] = axes_;
  return {Int(p[x] * l[z] - p[z] * l[x]), Int(p[y] * l[z] - p[z] * l[y]), l[z]};
}

template <class Stats>
template <class Int>
Vector3<Int> PlaneLightSpace<Stats>::exact_normal(PlaneRef ref) const {
  const Plane& plane = planes_[ref.index()];
  Vector3<Int> n;
  if (plane.b == kExplicit) {
    for (int k = 0; k < 3; ++k) n[k] = integer_from<Int>(explicit_[plane.a][k]);
  } else {
    n = cross(q<Int>(plane.a), q<Int>(plane.b));
  }
  if (ref.flipped()) {
    for (Int& x : n) x = -x;
  }
  return n;
}

template <class Stats>
PlaneRef PlaneLightSpace<Stats>::add_explicit(Vector3<mpz_class> normal) {
  Plane plane;
  plane.a = static_cast<std::uint32_t>(explicit_.size());
  const unsigned width = bits(normal);
  plane.n = scaled(normal, true, width);
  set_bound(plane.n, plane.magnitude, plane.error);
  explicit_bits_.push_back(width);
  explicit_.push_back(std::move(normal));
  planes_.push_back(plane);
  return PlaneRef(static_cast<std::uint32_t>(planes_.size() - 1));
}

template <class Stats>
PlaneRef PlaneLightSpace<Stats>::add_prefix_plane(const PrefixPlane& plane) {
  return add_explicit(plane.n);
}

// The plane through the light and the line in which support plane i is cut by plane j, positive on
// the part of i in front of j. Point light: P_j(v) = P_j(L) - n_j . q, and on plane i n_i . q =
// P_i(L), so that P_i(L) P_j(v) = (P_j(L) n_i - P_i(L) n_j) . q, with P_i(L) made positive.
// Directional light with H = n . d > 0 for i: H_i P_j - H_j P_i is constant along d; in q
// coordinates it is (N_x, N_y, -o) . q / d_z, N = H_i n_j - H_j n_i, o = H_i d_j - H_j d_i.
template <class Stats>
PlaneRef PlaneLightSpace<Stats>::trace(PlaneId support, const ExactPlane<mpz_class>& j) {
  const ExactPlane<mpz_class> i = ExactGeometry<mpz_class>(*geometry_).plane(support);
  mpz_class hi = normal_dot(i.n, light_.grid), hj = normal_dot(j.n, light_.grid);
  if (!light_.directional) {
    hi -= i.d;
    hj -= j.d;
  }
  Vector3<mpz_class> normal;
  if (!light_.directional) {
    for (int k = 0; k < 3; ++k) normal[k] = hj * i.n[k] - hi * j.n[k];
  } else {
    const mpz_class o = hi * j.d - hj * i.d;
    normal[0] = hi * j.n[axes_.x] - hj * i.n[axes_.x];
    normal[1] = hi * j.n[axes_.y] - hj * i.n[axes_.y];
    normal[2] = -o;
    if (sgn(light_.grid[axes_.z]) < 0) {
      for (mpz_class& x : normal) x = -x;
    }
  }
  if (sgn(hi) < 0) {  // plane i was not oriented to the light
    for (mpz_class& x : normal) x = -x;
  }
  return add_explicit(std::move(normal));
}

// A plane of another light in three dimensions: m . q with q = L - v is -m . v + m . L; for a
// directional light m . q = m_x (x d_z - z d_x) + m_y (y d_z - z d_y) + m_z d_z.
template <class Stats>
ExactPlane<mpz_class> PlaneLightSpace<Stats>::in_scene(PlaneRef ref) const {
  const Vector3<mpz_class> m = exact_normal<mpz_class>(PlaneRef(ref.index()));
  ExactPlane<mpz_class> plane;
  if (!light_.directional) {
    for (int k = 0; k < 3; ++k) plane.n[k] = -m[k];
    plane.d = -normal_dot(m, light_.grid);
    return plane;
  }
  const auto [x, y, z] = axes_;
  const std::array<mpz_class, 3>& d = light_.grid;
  plane.n[x] = m[0] * d[z];
  plane.n[y] = m[1] * d[z];
  plane.n[z] = -(m[0] * d[x] + m[1] * d[y]);
  plane.d = -m[2] * d[z];
  return plane;
}

template <class Stats>
PlaneRef PlaneLightSpace<Stats>::import_cut(const PlaneLightSpace& other, PlaneRef ref,
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
PlaneRef PlaneLightSpace<Stats>::import_edge(PlaneRef scene_edge, PlaneId support, bool reversed,
                                             const Vertex&, const Vertex&) {
  const SceneEdges names = scene_->edges();
  if (!names.is_input_edge(scene_edge)) {
    const std::uint64_t key = (std::uint64_t{support} << 32) | scene_edge.index();
    auto found = traces_.find(key);
    if (found == traces_.end()) {
      const ExactPlane<mpz_class> cut =
          ExactGeometry<mpz_class>(*geometry_).plane(scene_edge.index());
      found = traces_.emplace(key, trace(support, cut)).first;
    }
    return scene_edge.flipped() ? -found->second : found->second;
  }
  const EdgeId edge = names.edge(scene_edge);
  if (plane_of_edge_[edge] == kExplicit) {
    const EdgeEnds ends = geometry_->edges[edge];
    Plane plane;
    plane.a = ends.a;
    plane.b = ends.b;
    if (narrow_ && edge_bits_ <= 126) {
      plane.n = scaled(cross(q<Int128>(ends.a), q<Int128>(ends.b)), true, edge_bits_);
    } else {
      plane.n = scaled(cross(q<mpz_class>(ends.a), q<mpz_class>(ends.b)), true, edge_bits_);
    }
    set_bound(plane.n, plane.magnitude, plane.error);
    plane_of_edge_[edge] = static_cast<std::uint32_t>(planes_.size());
    planes_.push_back(plane);
  }
  return PlaneRef(plane_of_edge_[edge], scene_edge.flipped() != reversed);
}

template <class Stats>
typename PlaneLightSpace<Stats>::Vertex PlaneLightSpace<Stats>::import_vertex(
    const typename SceneSpace::Vertex& vertex) const {
  Vertex result;
  result.source = vertex.source;
  if (vertex.source == kMadeVertex) return result;
  if (narrow_) {
    result.ray = scaled(q<Int128>(vertex.source), false, q_bits_);
  } else {
    result.ray = scaled(q<mpz_class>(vertex.source), false, q_bits_);
  }
  set_bound(result.ray, result.magnitude, result.error);
  return result;
}

template <class Stats>
void PlaneLightSpace<Stats>::finish_vertex(Vertex& vertex, PlaneRef before, PlaneRef after) const {
  const Plane& m = planes_[before.index()];
  const Plane& n = planes_[after.index()];
  for (int k = 0; k < 3; ++k) {
    const int i = k == 2 ? 0 : k + 1, j = k == 0 ? 2 : k - 1;
    vertex.ray[k] = m.n[i] * n.n[j] - m.n[j] * n.n[i];
  }
  if (before.flipped() != after.flipped()) {
    for (double& x : vertex.ray) x = -x;
  }
  vertex.magnitude = largest(vertex.ray);
  // Two products whose factors err by m.error and n.error; three roundings of at most |m||n| each.
  vertex.error = 2.01 * (m.magnitude * n.error + m.error * (n.magnitude + n.error)) +
                 4.01 * kUnit * m.magnitude * n.magnitude;
  if (!(vertex.magnitude >= kLeastBound)) vertex.error = kInfinity;
}

template <class Stats>
typename PlaneLightSpace<Stats>::Vertex PlaneLightSpace<Stats>::crossing(
    PlaneRef plane, PlaneRef edge, bool leaving, const Corner<Vertex>&,
    const Corner<Vertex>&) const {
  Vertex vertex;
  // Counter-clockwise and inside positive: leaving the front, the cut edge follows the edge.
  if (leaving) {
    finish_vertex(vertex, edge, plane);
  } else {
    finish_vertex(vertex, plane, edge);
  }
  return vertex;
}

template <class Stats>
Side PlaneLightSpace<Stats>::side_of_plane(PlaneRef ref, const Corner<Vertex>& corner) {
  if (ref.same_plane(corner.before) || ref.same_plane(corner.after)) {
    stats_.count(Stage::kIdentity);
    return Side::kOn;
  }
  const Plane& plane = planes_[ref.index()];
  const Vertex& vertex = corner.vertex;
  if (vertex.source != kMadeVertex && plane.b != kExplicit &&
      (vertex.source == plane.a || vertex.source == plane.b)) {
    stats_.count(Stage::kIdentity);
    return Side::kOn;
  }
  const double value =
      plane.n[0] * vertex.ray[0] + plane.n[1] * vertex.ray[1] + plane.n[2] * vertex.ray[2];
  // Three products, each erring by |n| e_r + e_n (|r| + e_r), and five roundings of at most 3
  // |n||r|.
  const double bound =
      3.01 * (plane.magnitude * vertex.error + plane.error * (vertex.magnitude + vertex.error)) +
      10 * kUnit * plane.magnitude * vertex.magnitude;
  if (std::fabs(value) > bound && bound >= kLeastBound && std::fabs(value) < kInfinity) {
    stats_.count(Stage::kFilter);
    return side_of((value > 0) != ref.flipped() ? Sign::kPositive : Sign::kNegative);
  }
  const bool made = vertex.source == kMadeVertex;
  const unsigned width_bits =
      made ? side_of_crossing_bits(bits_of(ref), bits_of(corner.before), bits_of(corner.after))
           : side_of_input_vertex_bits(bits_of(ref), q_bits_);
  const bool small =
      narrow_ && is_small(ref) && (!made || (is_small(corner.before) && is_small(corner.after)));
  Sign sign = Sign::kZero;
  switch (small ? width_for(width_bits) : IntegerWidth::kUnbounded) {
    case IntegerWidth::k128:
      stats_.count(Stage::kExact128);
      sign = exact_side<Int128>(ref, corner);
      break;
    case IntegerWidth::k512:
      stats_.count(Stage::kExact512);
      sign = exact_side<Int512>(ref, corner);
      break;
    case IntegerWidth::kUnbounded:
      stats_.count(Stage::kExactUnbounded);
      sign = exact_side<mpz_class>(ref, corner);
      break;
  }
  if (sign == Sign::kZero) stats_.count_zero();
  return side_of(sign);
}

template <class Stats>
template <class Int>
Sign PlaneLightSpace<Stats>::exact_side(PlaneRef plane, const Corner<Vertex>& corner) const {
  const Vector3<Int> n = exact_normal<Int>(plane);
  if (corner.vertex.source != kMadeVertex) {
    return sign_of(dot(n, q<Int>(corner.vertex.source)));
  }
  return sign_of_determinant(n, exact_normal<Int>(corner.before), exact_normal<Int>(corner.after));
}

// On the ray r the support plane i is met where P_i(v) = 0. Point light: v = L - s r with
// s = P_i(L) / (n_i . r). Directional: U = r_x / r_z and V = r_y / r_z are x - z d_x / d_z and
// y - z d_y / d_z, so that z = (o - n_x U - n_y V) d_z / H and x, y follow.
template <class Stats>
std::array<Ball, 3> PlaneLightSpace<Stats>::position(const Corner<Vertex>& corner) const {
  const Vertex& vertex = corner.vertex;
  std::array<Ball, 3> point;
  if (vertex.source != kMadeVertex) {
    const typename SceneSpace::Vertex input = scene_->input_vertex(vertex.source);
    for (int k = 0; k < 3; ++k) {
      point[k] = Ball(input.x[k], input.error * input.x[k] + Ball::kTiny);
    }
    return point;
  }
  const std::array<Ball, 4> plane = scene_->plane_enclosure(corner.support);
  const std::array<Ball, 3>& l = light_enclosure_;
  std::array<Ball, 3> r;
  for (int k = 0; k < 3; ++k) r[k] = Ball(vertex.ray[k], vertex.error);
  Ball height = plane[0] * l[0] + plane[1] * l[1] + plane[2] * l[2];
  if (!light_.directional) {
    height = height - plane[3];
    const Ball s = height / (plane[0] * r[0] + plane[1] * r[1] + plane[2] * r[2]);
    for (int k = 0; k < 3; ++k) point[k] = l[k] - s * r[k];
    return point;
  }
  const auto [x, y, z] = axes_;
  // q_x / q_z = (x d_z - z d_x) / d_z is in grid units; the stretch of z makes it units of 2^b.
  const Ball u = r[0] / r[2], v = r[1] / r[2];
  point[z] = (plane[3] - plane[x] * u - plane[y] * v) * l[z] / height;
  point[x] = u + point[z] * l[x] / l[z];
  point[y] = v + point[z] * l[y] / l[z];
  return point;
}

template <class Stats>
std::array<mpq_class, 3> PlaneLightSpace<Stats>::exact_position(
    const Corner<Vertex>& corner) const {
  std::array<mpq_class, 3> point = exact_grid_position(corner);
  for (int k = 0; k < 3; ++k) point[k] = geometry_->origin[k] + geometry_->step * point[k];
  return point;
}

template <class Stats>
std::array<mpq_class, 3> PlaneLightSpace<Stats>::exact_grid_position(
    const Corner<Vertex>& corner) const {
  std::array<mpq_class, 3> point;
  if (corner.vertex.source != kMadeVertex) {
    for (int k = 0; k < 3; ++k) point[k] = geometry_->grid.at(corner.vertex.source, k);
    return point;
  }
  const Vector3<mpz_class> r =
      cross(exact_normal<mpz_class>(corner.before), exact_normal<mpz_class>(corner.after));
  const ExactPlane<mpz_class> plane = ExactGeometry<mpz_class>(*geometry_).plane(corner.support);
  if (!light_.directional) {
    const mpz_class height = normal_dot(plane.n, light_.grid) - plane.d;
    mpq_class s(height, dot(plane.n, r));
    s.canonicalize();
    for (int k = 0; k < 3; ++k) point[k] = light_.grid[k] - s * r[k];
    return point;
  }
  const auto [x, y, z] = axes_;
  mpq_class u(r[0], r[2]), v(r[1], r[2]);
  u.canonicalize();
  v.canonicalize();
  const mpz_class height = normal_dot(plane.n, light_.grid);
  const mpz_class& dz = light_.grid[z];
  point[z] = (plane.d - plane.n[x] * u - plane.n[y] * v) * dz / height;
  point[x] = u + point[z] * light_.grid[x] / dz;
  point[y] = v + point[z] * light_.grid[y] / dz;
  return point;
}

template <class Stats>
std::string PlaneLightSpace<Stats>::describe(PlaneRef ref) const {
  const Plane& plane = planes_[ref.index()];
  if (plane.b == kExplicit) return "a plane through the light along a cut";
  return "the shadow plane of edge " + std::to_string(plane.a) + "-" + std::to_string(plane.b);
}

template class PlaneLightSpace<NoStats>;
template class PlaneLightSpace<CountStats>;

}  // namespace gnomon
