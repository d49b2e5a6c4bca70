// SPDX-License-Identifier: LGPL-3.0-or-later
#include "kernel/implicit/implicit_scene_space.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel/signs/fp_environment.h"

namespace gnomon {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

template <class Stats>
ImplicitSceneSpace<Stats>::ImplicitSceneSpace(const Geometry& geometry, const KernelOptions&)
    : geometry_(&geometry), bits_(geometry.grid.bits()) {
  for (int k = 0; k < 3; ++k) origin_[k] = geometry.origin[k].get_d();
  const mpq_class extent = geometry.step * mpq_class(mpz_class(1) << bits_);
  scale_ = extent.get_d();
  planes_.resize(geometry.planes.size());
  tbb::parallel_for(std::size_t{0}, planes_.size(),
                    [&](std::size_t id) { planes_[id] = filtered(static_cast<PlaneId>(id)); });
}

template <class Stats>
typename ImplicitSceneSpace<Stats>::FilteredPlane ImplicitSceneSpace<Stats>::filtered(
    PlaneId id) const {
  // n scaled by 2^-2b, d by 2^-3b: relative error at most 2u each.
  std::array<double, 4> value;
  const bool narrow = geometry_->grid.is_narrow();
  with_widths(narrow ? narrowest_width(side_of_support_bits(bits_)) : IntegerWidth::kUnbounded,
              support_normal_bits(bits_) + 1, [&]<class Normal, class Int>() {
                using Position =
                    std::conditional_t<std::is_same_v<Int, mpz_class>, mpz_class, std::int64_t>;
                const ExactGeometry<Position> exact(*geometry_);
                const Vector3<Normal> n = exact.template normal<Normal>(id);
                const Int d = dot<Int>(n, exact.position(geometry_->planes[id].a));
                for (int k = 0; k < 3; ++k) value[k] = to_double_scaled(n[k], 2L * bits_);
                value[3] = to_double_scaled(d, 3L * bits_);
              });
  FilteredPlane plane;
  const double largest = std::max({std::fabs(value[0]), std::fabs(value[1]), std::fabs(value[2])});
  // Scaling by a power of two is exact only while nothing is subnormal.
  if (largest < 0x1p-900) return plane;
  int exponent = 0;
  std::frexp(largest, &exponent);
  for (int k = 0; k < 3; ++k) plane.n[k] = std::ldexp(value[k], -exponent);
  plane.d = std::ldexp(value[3], -exponent);
  plane.usable = true;
  return plane;
}

template <class Stats>
typename ImplicitSceneSpace<Stats>::Vertex ImplicitSceneSpace<Stats>::input_vertex(
    VertexId v) const {
  Vertex vertex;
  vertex.source = v;
  vertex.error = 2 * Ball::kUnit;
  const GridPositions& grid = geometry_->grid;
  const double narrow_scale = grid.is_narrow() ? 1 / static_cast<double>(1ULL << bits_) : 0;
  for (int k = 0; k < 3; ++k) {
    vertex.x[k] = grid.is_narrow() ? static_cast<double>(grid.narrow(v, k)) * narrow_scale
                                   : to_double_scaled(grid.wide(v, k), bits_);
  }
  return vertex;
}

template <class Stats>
std::array<Ball, 4> ImplicitSceneSpace<Stats>::plane_enclosure(PlaneId id) const {
  const FilteredPlane& plane = planes_[id];
  // A small component may have underflowed before the plane was scaled up by at most 2^900.
  constexpr double kUnderflow = 0x1p-170;
  std::array<Ball, 4> result;
  for (int k = 0; k < 4; ++k) {
    const double value = k < 3 ? plane.n[k] : plane.d;
    result[k] = plane.usable ? Ball(value, 2 * Ball::kUnit * std::fabs(value) + kUnderflow)
                             : Ball(0, kInfinity);
  }
  return result;
}

template <class Stats>
Side ImplicitSceneSpace<Stats>::side_of_plane(PlaneRef ref, const Corner<Vertex>& corner) {
  const PlaneId plane = ref.index();
  const Vertex& vertex = corner.vertex;
  if (plane == corner.support || corner.before.index() == plane || corner.after.index() == plane) {
    stats_.count(Stage::kIdentity);
    return Side::kOn;
  }
  if (vertex.source != kMadeVertex) {
    const SupportTriple& triple = geometry_->planes[plane];
    if (vertex.source == triple.a || vertex.source == triple.b || vertex.source == triple.c) {
      stats_.count(Stage::kIdentity);
      return Side::kOn;
    }
  }
  const FilteredPlane& filtered = planes_[plane];
  const double value = filtered.n[0] * vertex.x[0] + filtered.n[1] * vertex.x[1] +
                       filtered.n[2] * vertex.x[2] - filtered.d;
  const double bound = error_bound(vertex.error);
  if (filtered.usable && std::fabs(value) > bound) {
    stats_.count(Stage::kFilter);
    return (value > 0) != ref.flipped() ? Side::kFront : Side::kBack;
  }
  const Sign sign = exact_side(plane, corner);
  if (sign == Sign::kZero) stats_.count_zero();
  return side_of(ref.flipped() ? -sign : sign);
}

// The widths are those of the precision plan, by kind of vertex (docs/exactness.md).
template <class Stats>
Sign ImplicitSceneSpace<Stats>::exact_side(PlaneId plane, const Corner<Vertex>& corner) {
  if (corner.vertex.source != kMadeVertex) {
    const IntegerWidth width = narrowest_width(side_of_support_bits(bits_));
    stats_.count(exact_stage(width));
    return with_width(width, [&]<class Int>() {
      return sign_of(ExactGeometry<Int>(*geometry_).value(plane, corner.vertex.source));
    });
  }
  const SceneEdges names = edges();
  const bool before_is_edge = names.is_input_edge(corner.before);
  if (before_is_edge || names.is_input_edge(corner.after)) {
    const EdgeId edge = names.edge(before_is_edge ? corner.before : corner.after);
    const PlaneId cut = (before_is_edge ? corner.after : corner.before).index();
    const IntegerWidth width = narrowest_width(edge_against_plane_bits(bits_));
    stats_.count(exact_stage(width));
    return with_widths(width, support_value_bits(bits_), [&]<class Value, class Int>() {
      return side_of_edge_point<Value, Int>(plane, geometry_->edges[edge], cut);
    });
  }
  const IntegerWidth width = narrowest_width(four_planes_bits(bits_));
  stats_.count(exact_stage(width));
  return with_widths(width, support_normal_bits(bits_), [&]<class Factor, class Int>() {
    return side_of_plane_point<Factor, Int>(
        plane, {corner.support, corner.before.index(), corner.after.index()});
  });
}

// With values P and Q of the two planes at the ends u, v: the point is (P(v) u - P(u) v) over
// P(v) - P(u), so that Q there is (P(v) Q(u) - P(u) Q(v)) over the same.
template <class Stats>
template <class Value, class Int>
Sign ImplicitSceneSpace<Stats>::side_of_edge_point(PlaneId plane, EdgeEnds edge,
                                                   PlaneId cut) const {
  const ExactGeometry<Value> exact(*geometry_);
  const Value p_u = exact.value(cut, edge.a), p_v = exact.value(cut, edge.b),
              q_u = exact.value(plane, edge.a), q_v = exact.value(plane, edge.b);
  return sign_of(Int(multiply<Int>(p_v, q_u) - multiply<Int>(p_u, q_v))) *
         sign_of(Value(p_v - p_u));
}

// Planes p, q, r meet in the point (d_p q x r + d_q r x p + d_r p x q) / (p . q x r), by their
// normals; a fourth, t, has there the value
// (d_p (t . q x r) + d_q (t . r x p) + d_r (t . p x q) - d_t (p . q x r)) / (p . q x r).
template <class Stats>
template <class Factor, class Int>
Sign ImplicitSceneSpace<Stats>::side_of_plane_point(PlaneId plane,
                                                    const std::array<PlaneId, 3>& others) const {
  using Offset = Product<Int, Factor, Factor>;
  using Cross = Product<Int, Factor, Factor>;
  using Minor = Product<Int, Factor, Cross>;
  const ExactGeometry<Factor> exact(*geometry_);
  const auto normal = [&](PlaneId id) {
    const SupportTriple& triple = geometry_->planes[id];
    const Vector3<Factor> a = exact.position(triple.a);
    return cross(difference(exact.position(triple.b), a), difference(exact.position(triple.c), a));
  };
  const auto offset = [&](const Vector3<Factor>& n, PlaneId id) {
    return dot<Offset>(n, exact.position(geometry_->planes[id].a));
  };
  const Vector3<Factor> p = normal(others[0]), q = normal(others[1]), r = normal(others[2]),
                        t = normal(plane);
  const Vector3<Cross> qr = cross<Cross>(q, r), rp = cross<Cross>(r, p), pq = cross<Cross>(p, q);
  const Minor w = dot<Minor>(p, qr);
  const Int value = multiply<Int>(offset(p, others[0]), dot<Minor>(t, qr)) +
                    multiply<Int>(offset(q, others[1]), dot<Minor>(t, rp)) +
                    multiply<Int>(offset(r, others[2]), dot<Minor>(t, pq)) -
                    multiply<Int>(offset(t, plane), w);
  return sign_of(value) * sign_of(w);
}

template <class Stats>
typename ImplicitSceneSpace<Stats>::Vertex ImplicitSceneSpace<Stats>::crossing(
    PlaneRef plane, PlaneRef, bool, const Corner<Vertex>& from, const Corner<Vertex>& to) const {
  const FilteredPlane& filtered = planes_[plane.index()];
  const auto value = [&](const Vertex& v) {
    return filtered.n[0] * v.x[0] + filtered.n[1] * v.x[1] + filtered.n[2] * v.x[2] - filtered.d;
  };
  const double at_from = value(from.vertex), at_to = value(to.vertex);
  const double input_error = std::max(from.vertex.error, to.vertex.error);
  const double value_error = error_bound(input_error);
  const double gap = std::fabs(at_from - at_to);
  const bool known = filtered.usable && gap > 8 * value_error;
  // Unknown: anything on the edge will do, since an infinite error keeps the filter from using it.
  const double t = gap > 0 ? std::clamp(at_from / (at_from - at_to), 0.0, 1.0) : 0.5;
  Vertex vertex;
  double span = 0;
  for (int k = 0; k < 3; ++k) {
    const double step = to.vertex.x[k] - from.vertex.x[k];
    vertex.x[k] = from.vertex.x[k] + t * step;
    span = std::max(span, std::fabs(step));
  }
  // t = f / (f - g): each of f, g errs by value_error, so t errs by at most 2 value_error / (gap -
  // 2 value_error) <= 2.7 value_error / gap, plus two roundings.
  const double t_error = 2.7 * value_error / gap + 4 * Ball::kUnit;
  vertex.error = known ? (input_error + (span + 2 * input_error) * t_error) * 1.01 + 8 * Ball::kUnit
                       : kInfinity;
  return vertex;
}

template class ImplicitSceneSpace<NoStats>;
template class ImplicitSceneSpace<CountStats>;
}  // namespace gnomon
