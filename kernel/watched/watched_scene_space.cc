// SPDX-License-Identifier: LGPL-3.0-or-later
#include "kernel/watched/watched_scene_space.h"

namespace gnomon {
namespace {

/// Where three planes of the grid meet, by Cramer's rule, in scene units.
std::array<mpq_class, 3> meeting_point(const Geometry& geometry,
                                       const std::array<ExactPlane<mpz_class>, 3>& planes) {
  std::array<mpq_class, 3> point;
  const mpz_class whole = determinant<mpz_class>(planes[0].n, planes[1].n, planes[2].n);
  for (std::size_t k = 0; k < 3; ++k) {
    std::array<Vector3<mpz_class>, 3> rows{planes[0].n, planes[1].n, planes[2].n};
    for (std::size_t i = 0; i < 3; ++i) rows[i][k] = planes[i].d;
    mpq_class at(determinant<mpz_class>(rows[0], rows[1], rows[2]), whole);
    at.canonicalize();
    point[k] = geometry.origin[k] + geometry.step * at;
  }
  return point;
}

}  // namespace

// On an input edge: where it meets the plane that cuts it.
std::array<mpq_class, 3> WatchedSceneSpace::exact_position(const Corner<Vertex>& corner) const {
  const ExactGeometry<mpz_class> exact(geometry());
  std::array<mpq_class, 3> point;
  const auto scene_units = [&](std::size_t k, const mpq_class& grid) {
    return mpq_class(geometry().origin[k] + geometry().step * grid);
  };
  if (corner.vertex.source != kMadeVertex) {
    const Vector3<mpz_class> grid = exact.position(corner.vertex.source);
    for (std::size_t k = 0; k < 3; ++k) point[k] = scene_units(k, grid[k]);
    return point;
  }
  const bool before_is_edge = edges().is_input_edge(corner.before);
  if (!before_is_edge && !edges().is_input_edge(corner.after)) {
    return meeting_point(geometry(),
                         {exact.plane(corner.support), exact.plane(corner.before.index()),
                          exact.plane(corner.after.index())});
  }
  const PlaneRef edge = before_is_edge ? corner.before : corner.after;
  const PlaneId cut = (before_is_edge ? corner.after : corner.before).index();
  const auto [a, b] = geometry().edges[edges().edge(edge)];
  const mpz_class at_a = exact.value(cut, a);
  mpq_class t(at_a, mpz_class(at_a - exact.value(cut, b)));
  t.canonicalize();
  const Vector3<mpz_class> from = exact.position(a), to = exact.position(b);
  for (std::size_t k = 0; k < 3; ++k) {
    point[k] = scene_units(k, from[k] + t * mpz_class(to[k] - from[k]));
  }
  return point;
}

}  // namespace gnomon
