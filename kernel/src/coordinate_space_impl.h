// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies of coordinate_space.h, instantiated one number type a source.
#ifndef GNOMON_KERNEL_SRC_COORDINATE_SPACE_IMPL_H
#define GNOMON_KERNEL_SRC_COORDINATE_SPACE_IMPL_H

#include <cmath>

#include "gnomon/kernel/coordinate_space.h"

namespace gnomon {
namespace coordinate_detail {

inline constexpr std::uint32_t kNone = 0xffffffffu;

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
/// Scene's diagonal in scene units, from the nearest doubles.
inline double diagonal(const Geometry& geometry) {
  std::array<double, 3> low{}, high{};
  bool first = true;
  for (const auto& p : geometry.positions) {
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
Side CoordinateSceneSpace<T>::side_of_plane(PlaneRef ref, const Corner<Vertex>& corner) {
  const PlaneId plane = ref.index();
  if (planes_.identity()) {
    if (plane == corner.support || corner.before.index() == plane ||
        corner.after.index() == plane) {
      return Side::kOn;
    }
    const VertexId source = corner.vertex.source;
    const SupportTriple& triple = geometry_->planes[plane];
    if (source != kMadeVertex && (source == triple.a || source == triple.b || source == triple.c)) {
      return Side::kOn;
    }
  }
  const Side side = planes_.side(support_[plane], corner.vertex);
  return ref.flipped() ? opposite(side) : side;
}

template <class T>
std::array<double, 3> CoordinateSceneSpace<T>::approximate(const Vertex& vertex) const {
  using coordinate_detail::to_double;
  return {to_double(vertex.x[0]), to_double(vertex.x[1]), to_double(vertex.x[2])};
}

template <class T>
CoordinateLightSpace<T>::CoordinateLightSpace(SceneSpace& scene, const LightPoint& light,
                                              const KernelOptions&)
    : scene_(&scene),
      identity_(scene.arithmetic().identity()),
      directional_(light.directional),
      axes_(LightAxes::of(light)) {
  const Geometry& geometry = scene.geometry();
  for (int k = 0; k < 3; ++k) {
    if constexpr (kExact) {
      light_[k] = light.directional ? mpq_class(light.grid[k])
                                    : mpq_class(geometry.origin[k] + geometry.step * light.grid[k]);
    } else {
      light_[k] = static_cast<T>(light.nearest[k]);
    }
  }
  plane_of_edge_.assign(geometry.edges.size(), coordinate_detail::kNone);
}

template <class T>
Sign CoordinateLightSpace<T>::light_side(PlaneId id) const {
  const CoordinatePlane<T>& plane = scene_->support(id);
  const T value = coordinate_detail::dot(plane.n, light_);
  if (directional_) {
    // The thickness of a plane of the scene's size, as an angle to a direction.
    const T thickness =
        scene_->arithmetic().relative_thickness() * coordinate_detail::length_of(light_);
    return coordinate_detail::side_of_zero(value, thickness);
  }
  Vertex light;
  light.x = light_;
  return static_cast<Sign>(scene_->arithmetic().side(plane, light));
}

template <class T>
CoordinatePlane<T> CoordinateLightSpace<T>::shadow_plane_of(const Vertex& from,
                                                            const Vertex& to) const {
  using namespace coordinate_detail;
  const std::array<T, 3> towards = directional_ ? light_ : minus(light_, from.x);
  return scene_->arithmetic().plane_from(coordinate_detail::cross(towards, minus(to.x, from.x)),
                                         from.x);
}

template <class T>
PlaneRef CoordinateLightSpace<T>::import_edge(PlaneRef scene_edge, PlaneId, bool reversed,
                                              const Vertex& from, const Vertex& to) {
  if (!identity_) return {};  // shadow_plane computes it if and when the fragment is inserted
  const SceneEdges names = scene_->edges();
  if (!names.is_input_edge(scene_edge)) return add(shadow_plane_of(from, to));
  const EdgeId edge = names.edge(scene_edge);
  const EdgeEnds ends = scene_->geometry().edges[edge];
  if (plane_of_edge_[edge] == coordinate_detail::kNone) {
    plane_of_edge_[edge] = static_cast<std::uint32_t>(planes_.size());
    CoordinatePlane<T> plane =
        shadow_plane_of(scene_->input_vertex(ends.a), scene_->input_vertex(ends.b));
    plane.a = ends.a;
    plane.b = ends.b;
    add(std::move(plane));
  }
  return PlaneRef(plane_of_edge_[edge], scene_edge.flipped() != reversed);
}

template <class T>
PlaneRef CoordinateLightSpace<T>::shadow_plane(PlaneRef edge, const Vertex& from,
                                               const Vertex& to) {
  return identity_ ? edge : add(shadow_plane_of(from, to));
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
    const Geometry& geometry = scene_->geometry();
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
  return add(scene_->arithmetic().plane_from(std::move(normal), point));
}

template <class T>
Side CoordinateLightSpace<T>::side_of_plane(PlaneRef ref, const Corner<Vertex>& corner) {
  const CoordinatePlane<T>& plane = planes_[ref.index()];
  if (identity_) {
    if (ref.same_plane(corner.before) || ref.same_plane(corner.after)) return Side::kOn;
    const VertexId source = corner.vertex.source;
    if (source != kMadeVertex && (source == plane.a || source == plane.b)) return Side::kOn;
  }
  const Side side = scene_->arithmetic().side(plane, corner.vertex);
  return ref.flipped() ? opposite(side) : side;
}

template <class T>
std::array<Ball, 3> CoordinateLightSpace<T>::position(const Corner<Vertex>& corner) const {
  std::array<Ball, 3> point;
  for (int k = 0; k < 3; ++k) {
    const double x = coordinate_detail::to_double(corner.vertex.x[k]);
    point[k] = kExact ? Ball(x, 2 * Ball::kUnit * std::fabs(x)) : Ball(x);
  }
  return point;
}

template <class T>
std::array<mpq_class, 3> CoordinateLightSpace<T>::exact_position(
    const Corner<Vertex>& corner) const {
  std::array<mpq_class, 3> point;
  for (int k = 0; k < 3; ++k) {
    if constexpr (kExact) {
      point[k] = corner.vertex.x[k];
    } else if constexpr (std::is_same_v<T, long double>) {
      // A long double has 64 bits: two doubles hold it exactly.
      const double high = static_cast<double>(corner.vertex.x[k]);
      const double low = static_cast<double>(corner.vertex.x[k] - static_cast<long double>(high));
      point[k] = std::isfinite(high) ? mpq_class(mpq_class(high) + mpq_class(low)) : mpq_class(0);
    } else {
      const double x = static_cast<double>(corner.vertex.x[k]);
      point[k] = std::isfinite(x) ? mpq_class(x) : mpq_class(0);
    }
  }
  return point;
}

template <class T>
std::string CoordinateLightSpace<T>::describe(PlaneRef ref) const {
  const CoordinatePlane<T>& plane = planes_[ref.index()];
  if (plane.a == kMadeVertex) return "a shadow plane through two computed vertices";
  return "the shadow plane of edge " + std::to_string(plane.a) + "-" + std::to_string(plane.b);
}

}  // namespace gnomon

#define GNOMON_INSTANTIATE_COORDINATE_SPACE(T) \
  template class CoordinatePlanes<T>;          \
  template class CoordinateSceneSpace<T>;      \
  template class CoordinateLightSpace<T>

#endif  // GNOMON_KERNEL_SRC_COORDINATE_SPACE_IMPL_H
