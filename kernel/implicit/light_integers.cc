// SPDX-License-Identifier: LGPL-3.0-or-later
// The widths of one light's integers, and its planes seen from the scene.
#include "kernel/implicit/light_integers.h"

#include <algorithm>

#include "gnomon/kernel/precision_plan.h"
#include "kernel/implicit/scaled_doubles.h"

namespace gnomon {

LightIntegers::LightIntegers(const Geometry& scene, const LightPoint& point)
    : geometry(&scene),
      light(point),
      axes(LightAxes::of(point)),
      light_bits(bits_of(point.grid)),
      narrow(scene.grid.is_narrow() && light_bits <= 63) {
  // The grid's bits are those of the vertices; a lamp may stand far outside.
  const bool directional = light.directional;
  const unsigned b = directional ? grid_bits() : std::max(grid_bits(), light_bits);
  q_bits = light_space_bits(directional, b, light_bits);
  edge_bits = edge_plane_bits(directional, b, light_bits).largest();
  side_bits = side_of_edge_bits(directional, b, light_bits);
  cut_bits = cut_plane_bits(directional, b, light_bits).largest();
  if (narrow) {
    for (int k = 0; k < 3; ++k) narrow_light[k] = light.grid[k].get_si();
  }
}

// m . q with q = L - v is -m . v + m . L; for a directional light m . q = m_x (x d_z - z d_x) +
// m_y (y d_z - z d_y) + m_z d_z.
ExactPlane<mpz_class> LightIntegers::in_scene(const Vector3<mpz_class>& m) const {
  ExactPlane<mpz_class> plane;
  if (!light.directional) {
    for (int k = 0; k < 3; ++k) plane.n[k] = -m[k];
    plane.d = -dot(m, light.grid);
    return plane;
  }
  const auto [x, y, z] = axes;
  const Vector3<mpz_class>& d = light.grid;
  plane.n[x] = m[0] * d[z];
  plane.n[y] = m[1] * d[z];
  plane.n[z] = -(m[0] * d[x] + m[1] * d[y]);
  plane.d = -m[2] * d[z];
  return plane;
}

}  // namespace gnomon
