// SPDX-License-Identifier: LGPL-3.0-or-later
#include "kernel/cgal/epick_volume_space.h"

#include "kernel/cgal/epick_predicates.h"
#include "kernel/concept/chart_formulas.h"
#include "kernel/concept/kernel_concept.h"
#include "kernel/signs/nearest_double.h"

namespace gnomon {

using namespace epick_detail;

static_assert(VolumeSpaceModel<EpickVolumeSpace>);

namespace {

/// Are b - a and d parallel, or one of them zero? Exact: one clear component tells, rationals
/// otherwise.
bool is_parallel(const Point& a, const Point& b, const Point& d) {
  for (int k = 0; k < 3; ++k) {
    const int u = (k + 1) % 3, v = (k + 2) % 3;
    const Ball value =
        (Ball(b[u]) - Ball(a[u])) * Ball(d[v]) - (Ball(b[v]) - Ball(a[v])) * Ball(d[u]);
    if (value.is_finite() && (value.lower() > 0 || value.upper() < 0)) return false;
  }
  for (int k = 0; k < 3; ++k) {
    const int u = (k + 1) % 3, v = (k + 2) % 3;
    const mpq_class value = (mpq_class(b[u]) - mpq_class(a[u])) * mpq_class(d[v]) -
                            (mpq_class(b[v]) - mpq_class(a[v])) * mpq_class(d[u]);
    if (sgn(value) != 0) return false;
  }
  return true;
}

}  // namespace

EpickVolumeSpace::EpickVolumeSpace(const SceneSpace& scene, const KernelOptions&)
    : Base(scene, scene.identity()),
      inverse_extent_(nearest_double(1 / grid_extent(scene.geometry()))) {
  for (int k = 0; k < 3; ++k) origin_[k] = nearest_double(scene.geometry().origin[k]);
}

std::optional<EpickPlane> EpickVolumeSpace::plane_of(const Vertex& a, const Vertex& b,
                                                     const Vertex& c) const {
  if (!is_finite(a.x) || !is_finite(b.x) || !is_finite(c.x) ||
      CGAL::collinear(cgal(a.x), cgal(b.x), cgal(c.x))) {
    return std::nullopt;
  }
  EpickPlane plane;
  plane.a = a.x;
  plane.b = b.x;
  plane.c = c.x;
  return plane;
}

std::optional<EpickPlane> EpickVolumeSpace::plane_of(const Vertex& a, const Vertex& b,
                                                     const LightPoint& direction) const {
  if (!is_finite(a.x) || !is_finite(b.x) || is_parallel(a.x, b.x, direction.nearest)) {
    return std::nullopt;
  }
  // Front where (direction x (a - b)) . (v - b) > 0, and direction x (a - b) = (b - a) x direction.
  EpickPlane plane;
  plane.kind = EpickPlane::Kind::kDirection;
  plane.a = b.x;
  plane.b = direction.nearest;
  plane.c = a.x;
  return plane;
}

EpickPlane EpickVolumeSpace::axis_plane(int axis, double value) const {
  const Geometry& geometry = this->geometry();
  EpickPlane plane;
  const double coordinate =
      nearest_double(mpq_class(geometry.origin[axis] + mpq_class(value) * grid_extent(geometry)));
  plane.a[axis] = plane.b[axis] = plane.c[axis] = coordinate;
  plane.b[(axis + 1) % 3] = 1;
  plane.c[(axis + 2) % 3] = 1;
  return plane;
}

EpickVertex EpickVolumeSpace::axis_point(const std::array<double, 3>& fractions) const {
  EpickVertex vertex;
  for (int k = 0; k < 3; ++k) vertex.x[k] = axis_plane(k, fractions[k]).a[k];
  return vertex;
}

Side EpickVolumeSpace::side(const EpickPlane& plane, const Vertex& vertex) const {
  return side_of_points(plane, vertex.x);
}

EpickVertex EpickVolumeSpace::meet(const EpickPlane& plane, const Vertex& from,
                                   const Vertex& to) const {
  return meeting_point(coefficients(plane), from.x, to.x);
}

std::array<Ball, 3> EpickVolumeSpace::position(const Corner<Vertex>& corner) const {
  std::array<Ball, 3> point;
  for (int k = 0; k < 3; ++k) {
    point[k] = Ball((corner.vertex.x[k] - origin_[k]) * inverse_extent_);
  }
  return point;
}

std::array<mpq_class, 3> EpickVolumeSpace::exact_position(const Corner<Vertex>& corner) const {
  return exact_point(corner.vertex.x);
}

}  // namespace gnomon
