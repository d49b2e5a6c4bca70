// SPDX-License-Identifier: LGPL-3.0-or-later
#include "kernel/cgal/epeck_space.h"

#include "kernel/cgal/epeck_numbers.h"

namespace gnomon {

using namespace epeck_detail;

EpeckSceneSpace::EpeckSceneSpace(const Geometry& geometry, const KernelOptions&)
    : geometry_(&geometry), step_(geometry.step.get_d()) {
  for (int k = 0; k < 3; ++k) origin_[k] = geometry.origin[k].get_d();
  points_.reserve(geometry.positions.size());
  for (VertexId v = 0; v < geometry.positions.size(); ++v) {
    points_.emplace_back(number_from(geometry.grid.at(v, 0)), number_from(geometry.grid.at(v, 1)),
                         number_from(geometry.grid.at(v, 2)));
  }
  support_.reserve(geometry.planes.size());
  for (const SupportTriple& triple : geometry.planes) {
    support_.emplace_back(points_[triple.a], points_[triple.b], points_[triple.c]);
  }
}

Side EpeckSceneSpace::side_of_support(PlaneId plane, const Vertex& vertex) const {
  return side_of(support_[plane], vertex.point);
}

Side EpeckSceneSpace::side_of_plane(PlaneRef ref, const Corner<Vertex>& corner) const {
  const PlaneId id = ref.index();
  if (corner.before.index() == id || corner.after.index() == id ||
      is_known_on_support(*geometry_, id, corner)) {
    return Side::kOn;
  }
  const Side side = side_of_support(id, corner.vertex);
  return ref.flipped() ? opposite(side) : side;
}

EpeckVertex EpeckSceneSpace::crossing(PlaneRef plane, PlaneRef, bool, const Corner<Vertex>& from,
                                      const Corner<Vertex>& to) const {
  return meeting_point(support_[plane.index()], from.vertex.point, to.vertex.point);
}

std::array<double, 3> EpeckSceneSpace::approximate(const Vertex& vertex) const {
  std::array<double, 3> point;
  for (int k = 0; k < 3; ++k) point[k] = origin_[k] + step_ * CGAL::to_double(vertex.point[k]);
  return point;
}

EpeckLightSpace::EpeckLightSpace(SceneSpace& scene, const LightPoint& light, const KernelOptions&)
    : Base(scene, true),
      light_(light),
      axes_(LightAxes::of(light)),
      chart_(light, mpq_class(mpz_class(1) << scene.geometry().grid.bits())) {
  const Number x = number_from(light.grid[0]), y = number_from(light.grid[1]),
               z = number_from(light.grid[2]);
  if (light.directional) {
    direction_ = Epeck::Vector_3(x, y, z);
  } else {
    position_ = Epeck::Point_3(x, y, z);
  }
  for (int k = 0; k < 3; ++k) enclosed_position_[k] = gnomon::enclose(mpq_class(light.grid[k]));
}

Sign EpeckLightSpace::light_side(PlaneId plane) const {
  const Epeck::Plane_3& support = scene().support(plane);
  if (!light_.directional) return static_cast<Sign>(static_cast<int>(side_of(support, position_)));
  return static_cast<Sign>(static_cast<int>(CGAL::sign(support.orthogonal_vector() * direction_)));
}

Epeck::Plane_3 EpeckLightSpace::shadow_plane_of(const Vertex& from, const Vertex& to) const {
  // Normal (towards the light) x (to - from): see orientation.h.
  const Epeck::Point_3& a = from.point;
  return light_.directional ? Epeck::Plane_3(a, a + direction_, to.point)
                            : Epeck::Plane_3(a, position_, to.point);
}

// In grid coordinates: see coordinate_space_impl.h.
PlaneRef EpeckLightSpace::add_prefix_plane(const PrefixPlane& prefix) {
  if (!light_.directional) {
    const Epeck::Vector_3 normal(number_from(-prefix.n[0]), number_from(-prefix.n[1]),
                                 number_from(-prefix.n[2]));
    return add(Epeck::Plane_3(position_, normal));
  }
  const bool first = sgn(prefix.n[0]) != 0;
  const Number along = number_from(first ? prefix.n[0] : prefix.n[1]);
  const int u = first ? axes_.x : axes_.y, z = axes_.z;
  // Not default-constructed: CGAL's default zero has an interval that is not initialized.
  const Number zero(0);
  std::array<Number, 3> normal{zero, zero, zero}, point = normal;
  normal[u] = along * direction_[z];
  normal[z] = -along * direction_[u];
  point[u] = -number_from(prefix.n[2]) / along;
  return add(Epeck::Plane_3(Epeck::Point_3(point[0], point[1], point[2]),
                            Epeck::Vector_3(normal[0], normal[1], normal[2])));
}

Side EpeckLightSpace::side(const Epeck::Plane_3& plane, const Vertex& vertex) const {
  return side_of(plane, vertex.point);
}

EpeckVertex EpeckLightSpace::meet(const Epeck::Plane_3& plane, const Vertex& from,
                                  const Vertex& to) const {
  return meeting_point(plane, from.point, to.point);
}

std::array<Ball, 3> EpeckLightSpace::position(const Corner<Vertex>& corner) const {
  const Epeck::Point_3& p = corner.vertex.point;
  return {epeck_detail::enclose(p.x()), epeck_detail::enclose(p.y()), epeck_detail::enclose(p.z())};
}

std::array<mpq_class, 3> EpeckLightSpace::exact_position(const Corner<Vertex>& corner) const {
  return exact_point(scene().geometry(), corner.vertex.point);
}

ChartPoint EpeckLightSpace::chart_point(const LightChart& chart,
                                        const Corner<Vertex>& corner) const {
  std::array<Ball, 3> from = position(corner);
  if (!light_.directional) {
    for (int k = 0; k < 3; ++k) from[k] = enclosed_position_[k] - from[k];
  }
  return chart_(chart, from);
}

}  // namespace gnomon
