// SPDX-License-Identifier: LGPL-3.0-or-later
// The widths of one light's integers, and its planes seen from the scene.
#include "kernel/implicit/light_integers.h"

#include <algorithm>

#include "gnomon/kernel/precision_plan.h"
#include "kernel/implicit/scaled_doubles.h"

namespace gnomon {

namespace {

/// Bits of a box that holds the grid, from 0 on, and a lamp.
unsigned bits_of_box(unsigned grid_bits, const Vector3<mpz_class>& lamp) {
  unsigned bits = grid_bits;
  for (const mpz_class& x : lamp) {
    bits = std::max(bits, bits_of(sgn(x) < 0 ? mpz_class((mpz_class(1) << grid_bits) - x) : x));
  }
  return bits;
}

// Of a lamp L whose coordinates are below E = 2^e, at least 2^12 times those of vertices, so that
// |L - v| < 1.001 E. (L - a) x (a - b): 2.1 D E; P_j(L) n_i - P_i(L) n_j: 3.1 D^2 E D^2, twice. The
// side of an input vertex is that of a sun, (L - a) . ((b - a) x (c - a)): 3.1 D^2 E.
constexpr unsigned far_edge_bits(unsigned b, unsigned e) { return b + e + 2; }
constexpr unsigned far_cut_bits(unsigned b, unsigned e) { return 4 * b + e + 3; }

}  // namespace

LightIntegers::LightIntegers(const Geometry& scene, const LightPoint& point)
    : geometry(&scene),
      light(point),
      axes(LightAxes::of(point)),
      light_bits(bits_of(point.grid)),
      far(!point.directional && light_bits >= grid_bits() + kFarBits) {
  // The grid's bits are those of the vertices; a lamp may stand far outside.
  const bool directional = light.directional;
  const unsigned b = directional ? grid_bits() : bits_of_box(grid_bits(), light.grid);
  narrow = scene.grid.is_narrow() && (directional ? light_bits : b) <= 63;
  q_bits = light_space_bits(directional, b, light_bits);
  edge_bits = edge_plane_bits(directional, b, light_bits).largest();
  side_bits = side_of_edge_bits(directional, b, light_bits);
  cut_bits = cut_plane_bits(directional, b, light_bits).largest();
  if (far) {
    LightPoint direction = light;
    direction.directional = true;
    axes = LightAxes::of(direction);
    edge_bits = far_edge_bits(grid_bits(), light_bits);
    side_bits = side_of_edge_bits(true, grid_bits(), light_bits);
    cut_bits = far_cut_bits(grid_bits(), light_bits);
  }
  if (narrow) {
    for (int k = 0; k < 3; ++k) narrow_light[k] = light.grid[k].get_si();
  }
}

Vector3<mpz_class> LightIntegers::in_far_rays(const Vector3<mpz_class>& n) const {
  Vector3<mpz_class> plane = {-n[axes.x], -n[axes.y], dot(n, light.grid)};
  if (sgn(light.grid[axes.z]) < 0) {
    for (mpz_class& x : plane) x = -x;
  }
  return plane;
}

// n . r with r = (q_z L_x - q_x L_z, q_z L_y - q_y L_z, q_z).
Vector3<mpz_class> LightIntegers::from_far_rays(const Vector3<mpz_class>& n) const {
  const auto [x, y, z] = axes;
  const Vector3<mpz_class>& l = light.grid;
  Vector3<mpz_class> plane;
  plane[x] = -n[0] * l[z];
  plane[y] = -n[1] * l[z];
  plane[z] = n[0] * l[x] + n[1] * l[y] + n[2];
  return plane;
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
