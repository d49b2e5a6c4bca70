// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies of coordinate_volume_space.h, instantiated one number type a source.
#ifndef GNOMON_KERNEL_COORDINATE_COORDINATE_VOLUME_SPACE_INL_H
#define GNOMON_KERNEL_COORDINATE_COORDINATE_VOLUME_SPACE_INL_H

#include <cmath>
#include <utility>

#include "kernel/concept/chart_formulas.h"
#include "kernel/concept/kernel_concept.h"
#include "kernel/coordinate/coordinate_space.inl.h"
#include "kernel/coordinate/coordinate_volume_space.h"
#include "kernel/signs/nearest_double.h"

namespace gnomon {
namespace coordinate_detail {

/// Itself, or the nearest double as a number of a float type.
template <class Number>
Number number_from(const mpq_class& value) {
  if constexpr (std::is_same_v<Number, mpq_class>) {
    return value;
  } else {
    return static_cast<Number>(nearest_double(value));
  }
}

template <class T>
bool is_plane(const CoordinatePlane<T>& plane) {
  if constexpr (std::is_same_v<T, mpq_class>) {
    return sgn(plane.n[0]) != 0 || sgn(plane.n[1]) != 0 || sgn(plane.n[2]) != 0;
  } else {
    const bool is_finite = std::isfinite(plane.n[0]) && std::isfinite(plane.n[1]) &&
                           std::isfinite(plane.n[2]) && std::isfinite(plane.d);
    return is_finite && (plane.n[0] != 0 || plane.n[1] != 0 || plane.n[2] != 0);
  }
}

}  // namespace coordinate_detail

template <class T>
CoordinateVolumeSpace<T>::CoordinateVolumeSpace(const SceneSpace& scene, const KernelOptions&)
    : Base(scene, scene.arithmetic().identity()),
      planes_(scene.arithmetic()),
      inverse_extent_(
          coordinate_detail::number_from<Wide>(mpq_class(1 / grid_extent(scene.geometry())))) {
  for (int k = 0; k < 3; ++k) {
    origin_[k] = coordinate_detail::number_from<Wide>(scene.geometry().origin[k]);
  }
}

template <class T>
std::optional<CoordinatePlane<T>> CoordinateVolumeSpace<T>::plane_from(
    std::array<T, 3> normal, const std::array<T, 3>& point) const {
  CoordinatePlane<T> plane = planes_.plane_from(std::move(normal), point);
  if (!coordinate_detail::is_plane(plane)) return std::nullopt;
  return plane;
}

template <class T>
std::optional<CoordinatePlane<T>> CoordinateVolumeSpace<T>::plane_of(const Vertex& a,
                                                                     const Vertex& b,
                                                                     const Vertex& c) const {
  using namespace coordinate_detail;
  return plane_from(coordinate_detail::cross(minus(b.x, a.x), minus(c.x, a.x)), a.x);
}

template <class T>
std::optional<CoordinatePlane<T>> CoordinateVolumeSpace<T>::plane_of(
    const Vertex& a, const Vertex& b, const LightPoint& direction) const {
  using namespace coordinate_detail;
  const std::array<T, 3> to_light = light_of<T>(this->geometry(), direction);
  return plane_from(coordinate_detail::cross(minus(b.x, a.x), to_light), a.x);
}

template <class T>
CoordinatePlane<T> CoordinateVolumeSpace<T>::axis_plane(int axis, double value) const {
  const Geometry& geometry = this->geometry();
  CoordinatePlane<T> plane;
  plane.n[axis] = 1;
  plane.d = coordinate_detail::number_from<T>(
      mpq_class(geometry.origin[axis] + mpq_class(value) * grid_extent(geometry)));
  return plane;
}

template <class T>
typename CoordinateVolumeSpace<T>::Vertex CoordinateVolumeSpace<T>::axis_point(
    const std::array<double, 3>& fractions) const {
  Vertex vertex;
  for (int k = 0; k < 3; ++k) vertex.x[k] = axis_plane(k, fractions[k]).d;
  return vertex;
}

template <class T>
std::array<Ball, 3> CoordinateVolumeSpace<T>::position(const Corner<Vertex>& corner) const {
  std::array<Ball, 3> point;
  for (int k = 0; k < 3; ++k) {
    const Wide fraction = Wide(Wide(corner.vertex.x[k]) - origin_[k]) * inverse_extent_;
    if constexpr (kExact) {
      point[k] = enclose(fraction);
    } else {
      point[k] = Ball(static_cast<double>(fraction));
    }
  }
  return point;
}

template <class T>
std::array<Ball, 3> CoordinateVolumeSpace<T>::offset(
    VertexId origin, const Corner<Vertex>& corner) const requires std::is_same_v<T, mpq_class> {
  if constexpr (kExact) {  // as in coordinate_space_impl.h
    const Vertex from = planes_.input_vertex(origin);
    std::array<Ball, 3> step;
    for (int k = 0; k < 3; ++k) {
      step[k] = enclose(mpq_class((corner.vertex.x[k] - from.x[k]) * inverse_extent_));
    }
    return step;
  } else {
    return {};
  }
}

template <class T>
std::array<mpq_class, 3> CoordinateVolumeSpace<T>::exact_position(
    const Corner<Vertex>& corner) const {
  return coordinate_detail::exact_point(corner.vertex.x);
}

template <class T>
std::array<double, 3> CoordinateVolumeSpace<T>::nearest_position(
    const Corner<Vertex>& corner) const {
  if (corner.vertex.source != kMadeVertex && kExact) {
    return this->geometry().positions[corner.vertex.source];
  }
  std::array<double, 3> point;
  for (int k = 0; k < 3; ++k) {
    if constexpr (kExact) {
      point[k] = nearest_double(corner.vertex.x[k]);
    } else {
      point[k] = static_cast<double>(corner.vertex.x[k]);
    }
  }
  return point;
}

}  // namespace gnomon

#define GNOMON_INSTANTIATE_COORDINATE_VOLUME_SPACE(T) \
  template class CoordinateVolumeSpace<T>;            \
  static_assert(VolumeSpaceModel<CoordinateVolumeSpace<T>>)

#endif  // GNOMON_KERNEL_COORDINATE_COORDINATE_VOLUME_SPACE_INL_H
