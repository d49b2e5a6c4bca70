// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies of coordinate_space.h, instantiated one number type a source.
#ifndef GNOMON_KERNEL_COORDINATE_COORDINATE_SPACE_INL_H
#define GNOMON_KERNEL_COORDINATE_COORDINATE_SPACE_INL_H

#include <cmath>
#include <span>

#include "kernel/coordinate/coordinate_space.h"

namespace gnomon {
namespace coordinate_detail {

template <class T>
std::array<T, 3> cross(const std::array<T, 3>& a, const std::array<T, 3>& b) {
  return {T(a[1] * b[2] - a[2] * b[1]), T(a[2] * b[0] - a[0] * b[2]), T(a[0] * b[1] - a[1] * b[0])};
}
template <class T>
std::array<T, 3> minus(const std::array<T, 3>& a, const std::array<T, 3>& b) {
  return {T(a[0] - b[0]), T(a[1] - b[1]), T(a[2] - b[2])};
}
template <class T>
T dot(const std::array<T, 3>& a, const std::array<T, 3>& b) {
  return T(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
}
inline double to_double(const mpq_class& value) { return value.get_d(); }
template <class T>
requires std::is_floating_point_v<T>
double to_double(T value) { return static_cast<double>(value); }
inline mpq_class length_of(const std::array<mpq_class, 3>&) {
  return 0;
}  // never needed: no thickness
template <class T>
requires std::is_floating_point_v<T> T length_of(const std::array<T, 3>& v) {
  return std::hypot(v[0], v[1], v[2]);
}
template <class T>
Sign side_of_zero(const T& value, const T& thickness) {
  return value > thickness ? Sign::kPositive : value < -thickness ? Sign::kNegative : Sign::kZero;
}
/// Scene's diagonal in scene units, from the nearest doubles; lights do not count.
inline double diagonal(const Geometry& geometry) {
  std::array<double, 3> low{}, high{};
  bool first = true;
  const std::size_t count = geometry.positions.size() - geometry.light_vertices;
  for (const auto& p : std::span(geometry.positions).first(count)) {
    for (int k = 0; k < 3; ++k) {
      low[k] = first ? p[k] : std::fmin(low[k], p[k]);
      high[k] = first ? p[k] : std::fmax(high[k], p[k]);
    }
    first = false;
  }
  return std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
}

}  // namespace coordinate_detail

template <class T>
CoordinatePlanes<T>::CoordinatePlanes(const Geometry& geometry, const KernelOptions& options)
    : geometry_(&geometry),
      identity_(kExact || options.identity),
      thickness_(0),
      relative_thickness_(0) {
  if constexpr (!kExact) {
    if (options.thickness > 0) {
      relative_thickness_ = static_cast<T>(options.thickness);
      thickness_ = static_cast<T>(options.thickness * coordinate_detail::diagonal(geometry));
    }
  }
}

template <class T>
CoordinatePlane<T> CoordinatePlanes<T>::plane_from(std::array<T, 3> normal,
                                                   const std::array<T, 3>& point) const {
  CoordinatePlane<T> plane;
  if constexpr (!kExact) {
    if (thickness_ > 0) {  // a thickness is a distance, so the normal needs unit length
      const T length = std::hypot(normal[0], normal[1], normal[2]);
      if (length > 0) {
        for (T& x : normal) x /= length;
      }
    }
  }
  plane.n = std::move(normal);
  plane.d = coordinate_detail::dot(plane.n, point);
  return plane;
}

template <class T>
CoordinatePlane<T> CoordinatePlanes<T>::plane_through(const Vertex& a, const Vertex& b,
                                                      const Vertex& c) const {
  using namespace coordinate_detail;
  return plane_from(cross(minus(b.x, a.x), minus(c.x, a.x)), a.x);
}

template <class T>
CoordinateVertex<T> CoordinatePlanes<T>::crossing(const CoordinatePlane<T>& plane,
                                                  const Vertex& from, const Vertex& to) const {
  const T at_from = value(plane, from), at_to = value(plane, to);
  const T t = at_from / T(at_from - at_to);
  Vertex result;
  for (int k = 0; k < 3; ++k) result.x[k] = from.x[k] + t * T(to.x[k] - from.x[k]);
  return result;
}

template <class T>
CoordinateVertex<T> CoordinatePlanes<T>::input_vertex(VertexId v) const {
  Vertex vertex;
  vertex.source = v;
  for (int k = 0; k < 3; ++k) {
    if constexpr (kExact) {
      vertex.x[k] = geometry_->origin[k] + geometry_->step * geometry_->grid.at(v, k);
    } else {
      vertex.x[k] = static_cast<T>(geometry_->positions[v][k]);
    }
  }
  return vertex;
}

template <class T>
CoordinateSceneSpace<T>::CoordinateSceneSpace(const Geometry& geometry,
                                              const KernelOptions& options)
    : geometry_(&geometry), planes_(geometry, options) {
  support_.reserve(geometry.planes.size());
  for (const SupportTriple& triple : geometry.planes) {
    CoordinatePlane<T> plane =
        planes_.plane_through(planes_.input_vertex(triple.a), planes_.input_vertex(triple.b),
                              planes_.input_vertex(triple.c));
    support_.push_back(std::move(plane));
  }
}

template <class T>
Side CoordinateSceneSpace<T>::side_of_plane(PlaneRef ref, const Corner<Vertex>& corner) const {
  const PlaneId plane = ref.index();
  if (planes_.identity() && (corner.before.index() == plane || corner.after.index() == plane ||
                             is_known_on_support(*geometry_, plane, corner))) {
    return Side::kOn;
  }
  const Side side = side_of_support(plane, corner.vertex);
  return ref.flipped() ? opposite(side) : side;
}

template <class T>
std::array<double, 3> CoordinateSceneSpace<T>::approximate(const Vertex& vertex) const {
  using coordinate_detail::to_double;
  return {to_double(vertex.x[0]), to_double(vertex.x[1]), to_double(vertex.x[2])};
}

namespace coordinate_detail {

/// Position in scene units, or direction.
template <class T>
std::array<T, 3> light_of(const Geometry& geometry, const LightPoint& light) {
  std::array<T, 3> result;
  for (int k = 0; k < 3; ++k) {
    if constexpr (std::is_same_v<T, mpq_class>) {
      result[k] = light.directional ? mpq_class(light.grid[k])
                                    : mpq_class(geometry.origin[k] + geometry.step * light.grid[k]);
    } else {
      result[k] = static_cast<T>(light.nearest[k]);
    }
  }
  return result;
}

/// The numbers themselves; zero for one that is not finite.
template <class T>
std::array<mpq_class, 3> exact_point(const std::array<T, 3>& x) {
  std::array<mpq_class, 3> point;
  for (int k = 0; k < 3; ++k) {
    if constexpr (std::is_same_v<T, mpq_class>) {
      point[k] = x[k];
    } else if constexpr (std::is_same_v<T, long double>) {
      // A long double has 64 bits: two doubles hold it exactly.
      const double high = static_cast<double>(x[k]);
      const double low = static_cast<double>(x[k] - static_cast<long double>(high));
      point[k] = std::isfinite(high) ? mpq_class(mpq_class(high) + mpq_class(low)) : mpq_class(0);
    } else {
      const double value = static_cast<double>(x[k]);
      point[k] = std::isfinite(value) ? mpq_class(value) : mpq_class(0);
    }
  }
  return point;
}

}  // namespace coordinate_detail

template <class T>
CoordinateLightSpace<T>::CoordinateLightSpace(SceneSpace& scene, const LightPoint& light,
                                              const KernelOptions&)
    : Base(scene, scene.arithmetic().identity()),
      planes_(scene.arithmetic()),
      directional_(light.directional),
      light_(coordinate_detail::light_of<T>(scene.geometry(), light)),
      axes_(LightAxes::of(light)),
      chart_(make_chart(scene.geometry(), light, light_)) {}

template <class T>
typename CoordinateLightSpace<T>::Chart CoordinateLightSpace<T>::make_chart(
    const Geometry& geometry, const LightPoint& light, const std::array<T, 3>& kept) {
  if constexpr (kExact) {
    return Chart(light, grid_extent(geometry));
  } else {
    return Chart(geometry, light, {Wide(kept[0]), Wide(kept[1]), Wide(kept[2])});
  }
}

template <class T>
Sign CoordinateLightSpace<T>::light_side_of(const CoordinatePlane<T>& plane) const {
  const T value = coordinate_detail::dot(plane.n, light_);
  if (directional_) {
    // The thickness of a plane of the scene's size, as an angle to a direction.
    const T thickness = planes_.relative_thickness() * coordinate_detail::length_of(light_);
    return coordinate_detail::side_of_zero(value, thickness);
  }
  Vertex light;
  light.x = light_;
  return static_cast<Sign>(planes_.side(plane, light));
}

template <class T>
CoordinatePlane<T> CoordinateLightSpace<T>::shadow_plane_of(const Vertex& from,
                                                            const Vertex& to) const {
  using namespace coordinate_detail;
  const std::array<T, 3> towards = directional_ ? light_ : minus(light_, from.x);
  return planes_.plane_from(coordinate_detail::cross(towards, minus(to.x, from.x)), from.x);
}

// Point light: n . q with q = L - v is n . L - n . v. Directional light: n_u q_u + n_z q_z is
// d_z (n_u U + n_z) with U = x_u - x_z d_u / d_z in grid units: a plane with normal n_u (d_z e_u -
// d_u e_z) through the grid point -n_z / n_u on axis u.
template <class T>
PlaneRef CoordinateLightSpace<T>::add_prefix_plane(const PrefixPlane& prefix) {
  const auto number = [](const auto& exact) {
    if constexpr (kExact) {
      return T(exact);
    } else {
      return static_cast<T>(exact.get_d());
    }
  };
  std::array<T, 3> normal{}, point = light_;
  if (!directional_) {
    for (int k = 0; k < 3; ++k) normal[k] = -number(prefix.n[k]);
  } else {
    const bool first = sgn(prefix.n[0]) != 0;
    const mpz_class& along = first ? prefix.n[0] : prefix.n[1];
    const int u = first ? axes_.x : axes_.y, z = axes_.z;
    normal[u] = number(along) * light_[z];
    normal[z] = -(number(along) * light_[u]);
    const Geometry& geometry = this->scene().geometry();
    for (int k = 0; k < 3; ++k) {
      mpq_class coordinate = geometry.origin[k];
      if (k == u) {
        mpq_class ratio(prefix.n[2], along);
        ratio.canonicalize();
        coordinate -= geometry.step * ratio;
      }
      point[k] = number(coordinate);
    }
  }
  return this->add(planes_.plane_from(std::move(normal), point));
}

template <class T>
std::array<Ball, 3> CoordinateLightSpace<T>::position(const Corner<Vertex>& corner) const {
  std::array<Ball, 3> point;
  for (int k = 0; k < 3; ++k) {
    if constexpr (kExact) {
      point[k] = enclose(corner.vertex.x[k]);
    } else {
      point[k] = Ball(static_cast<double>(corner.vertex.x[k]));
    }
  }
  return point;
}

template <class T>
std::array<mpq_class, 3> CoordinateLightSpace<T>::exact_position(
    const Corner<Vertex>& corner) const {
  return coordinate_detail::exact_point(corner.vertex.x);
}

// The differences are exact: enclosing the coordinates first would lose what is near the light.
// Clang before 16 instantiates the body even where the constraint does not hold.
template <class T>
ChartPoint CoordinateLightSpace<T>::enclosed_chart_point(
    const LightChart& chart, const Vertex& vertex) const requires std::is_same_v<T, mpq_class> {
  if constexpr (kExact) {
    const Geometry& geometry = this->scene().geometry();
    std::array<Ball, 3> from;
    for (int k = 0; k < 3; ++k) {
      from[k] = directional_ ? enclose(mpq_class(vertex.x[k] - geometry.origin[k]))
                             : enclose(mpq_class(light_[k] - vertex.x[k]));
    }
    return chart_(chart, from);
  } else {
    return {};
  }
}

}  // namespace gnomon

#define GNOMON_INSTANTIATE_COORDINATE_SPACE(T) \
  template class CoordinatePlanes<T>;          \
  template class CoordinateSceneSpace<T>;      \
  template class CoordinateLightSpace<T>

#endif  // GNOMON_KERNEL_COORDINATE_COORDINATE_SPACE_INL_H
