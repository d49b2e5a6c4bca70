// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/kernel/plane_scene_space.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gnomon/kernel/fp_environment.h"

namespace gnomon {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

template <class Stats>
PlaneSceneSpace<Stats>::PlaneSceneSpace(const Geometry& geometry, const KernelOptions&)
    : geometry_(&geometry), bits_(geometry.grid.bits()) {
  for (int k = 0; k < 3; ++k) origin_[k] = geometry.origin[k].get_d();
  const mpq_class extent = geometry.step * mpq_class(mpz_class(1) << bits_);
  scale_ = extent.get_d();
  planes_.resize(geometry.planes.size());
  const ExactGeometry<mpz_class> wide(geometry);
  const ExactGeometry<Int128> narrow(geometry);
  // 3 b + 5 bits hold every intermediate of a support plane.
  const bool fits = geometry.grid.is_narrow() && 3 * bits_ + 5 <= 128;
  for (PlaneId id = 0; id < planes_.size(); ++id) {
    FilteredPlane& plane = planes_[id];
    std::array<double, 4> value;  // n scaled by 2^-2b, d by 2^-3b: relative error at most 2u each
    if (fits) {
      const ExactPlane<Int128> exact = narrow.plane(id);
      for (int k = 0; k < 3; ++k) {
        value[k] = std::ldexp(static_cast<double>(exact.n[k]), -2 * static_cast<int>(bits_));
      }
      value[3] = std::ldexp(static_cast<double>(exact.d), -3 * static_cast<int>(bits_));
    } else {
      const ExactPlane<mpz_class> exact = wide.plane(id);
      for (int k = 0; k < 3; ++k) value[k] = to_double_scaled(exact.n[k], 2L * bits_);
      value[3] = to_double_scaled(exact.d, 3L * bits_);
    }
    const double largest =
        std::max({std::fabs(value[0]), std::fabs(value[1]), std::fabs(value[2])});
    // Scaling by a power of two is exact only while nothing is subnormal.
    if (largest < 0x1p-900) continue;
    int exponent = 0;
    std::frexp(largest, &exponent);
    for (int k = 0; k < 3; ++k) plane.n[k] = std::ldexp(value[k], -exponent);
    plane.d = std::ldexp(value[3], -exponent);
    plane.usable = true;
  }
}

template <class Stats>
typename PlaneSceneSpace<Stats>::Vertex PlaneSceneSpace<Stats>::input_vertex(VertexId v) const {
  Vertex vertex;
  vertex.source = v;
  vertex.error = 2 * Ball::kUnit;
  for (int k = 0; k < 3; ++k) {
    vertex.x[k] = geometry_->grid.is_narrow()
                      ? std::ldexp(static_cast<double>(geometry_->grid.narrow(v, k)),
                                   -static_cast<int>(bits_))
                      : to_double_scaled(geometry_->grid.wide(v, k), bits_);
  }
  return vertex;
}

template <class Stats>
std::array<Ball, 4> PlaneSceneSpace<Stats>::plane_enclosure(PlaneId id) const {
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
Side PlaneSceneSpace<Stats>::side_of_plane(PlaneRef ref, const Corner<Vertex>& corner) {
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
  // All intermediates of the exact stage, by kind of vertex (docs/exactness.md).
  const bool made = vertex.source == kMadeVertex;
  const SceneEdges names = edges();
  const bool on_edge =
      made && (names.is_input_edge(corner.before) || names.is_input_edge(corner.after));
  const unsigned bits = !made ? 3 * bits_ + 5 : on_edge ? 6 * bits_ + 10 : 9 * bits_ + 16;
  const IntegerWidth width =
      geometry_->grid.is_narrow() ? width_for(bits) : IntegerWidth::kUnbounded;
  Sign sign = Sign::kZero;
  switch (width) {
    case IntegerWidth::k128:
      stats_.count(Stage::kExact128);
      sign = exact_side<Int128>(plane, corner);
      break;
    case IntegerWidth::k512:
      stats_.count(Stage::kExact512);
      sign = exact_side<Int512>(plane, corner);
      break;
    case IntegerWidth::kUnbounded:
      stats_.count(Stage::kExactUnbounded);
      sign = exact_side<mpz_class>(plane, corner);
      break;
  }
  if (sign == Sign::kZero) stats_.count_zero();
  return side_of(ref.flipped() ? -sign : sign);
}

template <class Stats>
template <class Int>
ExactPoint<Int> PlaneSceneSpace<Stats>::exact_point(const Corner<Vertex>& corner) const {
  const ExactGeometry<Int> exact(*geometry_);
  if (corner.vertex.source != kMadeVertex) {
    return {exact.position(corner.vertex.source), integer_from<Int>(std::int64_t{1})};
  }
  const SceneEdges names = edges();
  const bool before_is_edge = names.is_input_edge(corner.before);
  if (before_is_edge || names.is_input_edge(corner.after)) {
    const EdgeEnds ends =
        geometry_->edges[names.edge(before_is_edge ? corner.before : corner.after)];
    const PlaneId cut = (before_is_edge ? corner.after : corner.before).index();
    const ExactPlane<Int> plane = exact.plane(cut);
    const Vector3<Int> a = exact.position(ends.a), b = exact.position(ends.b);
    const Int at_a = dot(plane.n, a) - plane.d, at_b = dot(plane.n, b) - plane.d;
    // a + t (b - a) with t = at_a / (at_a - at_b), over the common denominator.
    ExactPoint<Int> point;
    point.w = at_b - at_a;
    for (int k = 0; k < 3; ++k) point.x[k] = Int(at_b * a[k] - at_a * b[k]);
    if (sign_of(point.w) == Sign::kNegative) {
      point.w = -point.w;
      for (Int& x : point.x) x = -x;
    }
    return point;
  }
  const ExactPlane<Int> p = exact.plane(corner.support), q = exact.plane(corner.before.index()),
                        r = exact.plane(corner.after.index());
  const Vector3<Int> qr = cross(q.n, r.n), rp = cross(r.n, p.n), pq = cross(p.n, q.n);
  ExactPoint<Int> point;
  point.w = dot(p.n, qr);
  for (int k = 0; k < 3; ++k) point.x[k] = Int(p.d * qr[k] + q.d * rp[k] + r.d * pq[k]);
  if (sign_of(point.w) == Sign::kNegative) {
    point.w = -point.w;
    for (Int& x : point.x) x = -x;
  }
  return point;
}

template <class Stats>
template <class Int>
Sign PlaneSceneSpace<Stats>::exact_side(PlaneId plane, const Corner<Vertex>& corner) const {
  const ExactPoint<Int> point = exact_point<Int>(corner);
  const ExactPlane<Int> exact = ExactGeometry<Int>(*geometry_).plane(plane);
  return sign_of(Int(dot(exact.n, point.x) - exact.d * point.w));
}

template <class Stats>
typename PlaneSceneSpace<Stats>::Vertex PlaneSceneSpace<Stats>::crossing(
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

template class PlaneSceneSpace<NoStats>;
template class PlaneSceneSpace<CountStats>;
template ExactPoint<mpz_class> PlaneSceneSpace<NoStats>::exact_point<mpz_class>(
    const Corner<Vertex>&) const;
template ExactPoint<mpz_class> PlaneSceneSpace<CountStats>::exact_point<mpz_class>(
    const Corner<Vertex>&) const;

}  // namespace gnomon
