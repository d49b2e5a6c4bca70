// SPDX-License-Identifier: LGPL-3.0-or-later
#include "kernel/cgal/epick_space.h"

#include "kernel/cgal/epick_predicates.h"

namespace gnomon {

using namespace epick_detail;

EpickSceneSpace::EpickSceneSpace(const Geometry& geometry, const KernelOptions& options)
    : geometry_(&geometry), identity_(options.identity) {}

EpickPlane EpickSceneSpace::support(PlaneId plane) const {
  const SupportTriple& triple = geometry_->planes[plane];
  EpickPlane result;
  result.a = geometry_->positions[triple.a];
  result.b = geometry_->positions[triple.b];
  result.c = geometry_->positions[triple.c];
  return result;
}

Side EpickSceneSpace::side_of_support(PlaneId id, const Vertex& vertex) const {
  const SupportTriple& triple = geometry_->planes[id];
  const auto& at = geometry_->positions;
  return side_of(orientation(at[triple.a], at[triple.b], at[triple.c], vertex.x));
}

Side EpickSceneSpace::side_of_plane(PlaneRef ref, const Corner<Vertex>& corner) const {
  const PlaneId id = ref.index();
  if (identity_ && (corner.before.index() == id || corner.after.index() == id ||
                    is_known_on_support(*geometry_, id, corner))) {
    return Side::kOn;
  }
  const Side side = side_of_support(id, corner.vertex);
  return ref.flipped() ? opposite(side) : side;
}

EpickVertex EpickSceneSpace::crossing(PlaneRef ref, PlaneRef, bool, const Corner<Vertex>& from,
                                      const Corner<Vertex>& to) const {
  return meeting_point(coefficients(support(ref.index())), from.vertex.x, to.vertex.x);
}

EpickLightSpace::EpickLightSpace(SceneSpace& scene, const LightPoint& light, const KernelOptions&)
    : Base(scene, scene.identity()),
      light_(light),
      axes_(LightAxes::of(light)),
      chart_(scene.geometry(), light, light.nearest) {}

Sign EpickLightSpace::light_side(PlaneId id) const {
  const EpickPlane plane = scene().support(id);
  if (!light_.directional) return orientation(plane.a, plane.b, plane.c, light_.nearest);
  // ((b - a) x (c - a)) . d = (d x (b - a)) . (c - a)
  return direction_orientation(plane.a, light_.nearest, plane.b, plane.c);
}

EpickPlane EpickLightSpace::shadow_plane_of(const Vertex& from, const Vertex& to) const {
  EpickPlane plane;
  plane.kind = light_.directional ? EpickPlane::Kind::kDirection : EpickPlane::Kind::kPoints;
  plane.a = from.x;
  plane.b = light_.nearest;
  plane.c = to.x;
  return plane;
}

// The same planes as in coordinate_space_impl.h, with exact coefficients.
PlaneRef EpickLightSpace::add_prefix_plane(const PrefixPlane& prefix) {
  std::array<mpq_class, 3> normal, point;
  std::array<mpq_class, 3> light;
  for (int k = 0; k < 3; ++k) light[k] = light_.nearest[k];
  if (!light_.directional) {
    for (int k = 0; k < 3; ++k) normal[k] = -prefix.n[k];
    point = light;
  } else {
    const bool first = sgn(prefix.n[0]) != 0;
    const mpz_class& along = first ? prefix.n[0] : prefix.n[1];
    const int u = first ? axes_.x : axes_.y, z = axes_.z;
    normal[u] = along * light[z];
    normal[z] = -along * light[u];
    const Geometry& geometry = scene().geometry();
    point = geometry.origin;
    mpq_class ratio(prefix.n[2], along);
    ratio.canonicalize();
    point[u] -= geometry.step * ratio;
  }
  EpickPlane::Linear linear;
  linear.exact[3] = 0;
  for (int k = 0; k < 3; ++k) {
    linear.exact[k] = normal[k];
    linear.exact[3] += normal[k] * point[k];
  }
  for (int k = 0; k < 4; ++k) linear.enclosure[k] = enclose(linear.exact[k]);
  EpickPlane plane;
  plane.kind = EpickPlane::Kind::kLinear;
  plane.linear = std::make_shared<const EpickPlane::Linear>(std::move(linear));
  return add(std::move(plane));
}

Side EpickLightSpace::side(const EpickPlane& plane, const Vertex& vertex) const {
  if (plane.kind != EpickPlane::Kind::kLinear) return side_of_points(plane, vertex.x);
  const Point& v = vertex.x;
  if (!is_finite(v)) return Side::kOn;
  const auto& e = plane.linear->enclosure;
  const Ball near = e[0] * Ball(v[0]) + e[1] * Ball(v[1]) + e[2] * Ball(v[2]) - e[3];
  if (near.is_finite() && near.lower() > 0) return Side::kFront;
  if (near.is_finite() && near.upper() < 0) return Side::kBack;
  mpq_class exact = -plane.linear->exact[3];
  for (int k = 0; k < 3; ++k) exact += plane.linear->exact[k] * mpq_class(v[k]);
  return side_of(sign_of(exact));
}

EpickVertex EpickLightSpace::meet(const EpickPlane& plane, const Vertex& from,
                                  const Vertex& to) const {
  if (plane.kind != EpickPlane::Kind::kLinear) {
    return meeting_point(coefficients(plane), from.x, to.x);
  }
  const auto& e = plane.linear->enclosure;
  return meeting_point({e[0].middle, e[1].middle, e[2].middle, -e[3].middle}, from.x, to.x);
}

std::array<Ball, 3> EpickLightSpace::position(const Corner<Vertex>& corner) const {
  return {Ball(corner.vertex.x[0]), Ball(corner.vertex.x[1]), Ball(corner.vertex.x[2])};
}

std::array<mpq_class, 3> EpickLightSpace::exact_position(const Corner<Vertex>& corner) const {
  return exact_point(corner.vertex.x);
}

}  // namespace gnomon
