// SPDX-License-Identifier: LGPL-3.0-or-later
// Makes the doubles of support planes and of vertices in space.
#include "kernel/implicit/scene_planes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "kernel/implicit/exact_geometry.h"
#include "kernel/implicit/scaled_doubles.h"
#include "kernel/signs/fp_environment.h"

namespace gnomon {

ScenePlanes::ScenePlanes(const Geometry& geometry)
    : geometry_(&geometry), bits_(geometry.grid.bits()) {
  for (int k = 0; k < 3; ++k) origin_[k] = geometry.origin[k].get_d();
  const mpq_class extent = geometry.step * mpq_class(mpz_class(1) << bits_);
  scale_ = extent.get_d();
  planes_.resize(geometry.planes.size());
  tbb::parallel_for(std::size_t{0}, planes_.size(),
                    [&](std::size_t id) { planes_[id] = make_filtered(static_cast<PlaneId>(id)); });
}

ScenePlanes::FilteredPlane ScenePlanes::make_filtered(PlaneId id) const {
  // n scaled by 2^-2b, d by 2^-3b: each off by at most 2u of itself.
  Double3 n;
  double d = 0;
  with_widths(width_of(geometry_->grid.is_narrow(), side_of_support_bits(bits_)),
              support_normal_bits(bits_) + 1, [&]<class Normal, class Int>() {
                const ExactGeometry<PositionFor<Int>> exact(*geometry_);
                const Vector3<Normal> normal = exact.template normal<Normal>(id);
                const Int offset = dot<Int>(normal, exact.position(geometry_->planes[id].a));
                for (int k = 0; k < 3; ++k) n[k] = to_double_scaled(normal[k], 2L * bits_);
                d = to_double_scaled(offset, 3L * bits_);
              });
  FilteredPlane plane;
  const double size = largest(n);
  // Scaling by a power of two is exact only while nothing is subnormal.
  if (size < 0x1p-900) return plane;
  const double scale = normalizer(size);
  for (int k = 0; k < 3; ++k) plane.n[k] = n[k] * scale;
  plane.d = d * scale;
  plane.usable = true;
  return plane;
}

ScenePlanes::Vertex ScenePlanes::input_vertex(VertexId v) const {
  Vertex vertex;
  vertex.source = v;
  vertex.error = SceneBounds::kInputError;
  const GridPositions& grid = geometry_->grid;
  const double narrow_scale = grid.is_narrow() ? 1 / static_cast<double>(1ULL << bits_) : 0;
  for (int k = 0; k < 3; ++k) {
    vertex.x[k] = grid.is_narrow() ? static_cast<double>(grid.narrow(v, k)) * narrow_scale
                                   : to_double_scaled(grid.wide(v, k), bits_);
  }
  return vertex;
}

std::array<Ball, 4> ScenePlanes::plane_enclosure(PlaneId id) const {
  const FilteredPlane& plane = planes_[id];
  // A small component may have underflowed, to within 2^-1074, before the plane was scaled up by at
  // most 2^900.
  constexpr double kUnderflow = 0x1p-170;
  std::array<Ball, 4> result;
  for (int k = 0; k < 4; ++k) {
    const double value = k < 3 ? plane.n[k] : plane.d;
    result[k] = plane.usable ? Ball(value, 2 * Ball::kUnit * std::fabs(value) + kUnderflow)
                             : Ball(0, kUnknownError);
  }
  return result;
}

ScenePlanes::Vertex ScenePlanes::crossing(PlaneRef ref, PlaneRef, bool, const Corner<Vertex>& from,
                                          const Corner<Vertex>& to) const {
  const FilteredPlane& plane = planes_[ref.index()];
  const double at_from = plane.value(from.vertex.x), at_to = plane.value(to.vertex.x);
  const double end_error = std::max(from.vertex.error, to.vertex.error);
  const double value_error = SceneBounds::value(end_error);
  const double gap = std::fabs(at_from - at_to);
  const bool known = plane.usable && gap > SceneBounds::kLeastGap * value_error;
  // Unknown: anything on the edge will do, since an infinite error keeps the filter from using it.
  const double t = gap > 0 ? std::clamp(at_from / (at_from - at_to), 0.0, 1.0) : 0.5;
  Vertex vertex;
  double span = 0;
  for (int k = 0; k < 3; ++k) {
    const double step = to.vertex.x[k] - from.vertex.x[k];
    vertex.x[k] = from.vertex.x[k] + t * step;
    span = std::max(span, std::fabs(step));
  }
  vertex.error =
      known ? SceneBounds::crossing(end_error, span, SceneBounds::parameter(value_error, gap))
            : kUnknownError;
  return vertex;
}

}  // namespace gnomon
