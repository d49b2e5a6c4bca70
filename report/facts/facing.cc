// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/facts/facing.h"

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "report/sides/part_area.h"

namespace gnomon::report {

namespace {

/// Sign of the plane of `loop`, as it is oriented, at a grid point.
Sign sign_at(const std::array<mpz_class, 3>& normal, const std::array<mpz_class, 3>& origin,
             const std::array<mpz_class, 3>& point) {
  mpz_class value = 0;
  for (int k = 0; k < 3; ++k) value += normal[k] * (point[k] - origin[k]);
  return sign_of(value);
}

std::array<mpz_class, 3> grid_point(const PreparedScene& scene, VertexId vertex) {
  const GridPositions& grid = scene.geometry.grid;
  return {grid.at(vertex, 0), grid.at(vertex, 1), grid.at(vertex, 2)};
}

/// Of three corners that are not in one line, which the corners of a prepared light are not.
std::array<mpz_class, 3> light_normal(const PreparedLight& light) {
  std::array<mpz_class, 3> normal;
  const auto& loop = light.area_loop;
  for (int k = 0; k < 3; ++k) {
    const int u = (k + 1) % 3, v = (k + 2) % 3;
    normal[k] = (loop[1][u] - loop[0][u]) * (loop[2][v] - loop[0][v]) -
                (loop[1][v] - loop[0][v]) * (loop[2][u] - loop[0][u]);
  }
  return normal;
}

}  // namespace

Sign sign_at_light(const PreparedScene& scene, const Part& part, const LightPoint& light) {
  const std::array<mpz_class, 3> normal = doubled_area_vector(scene, part);
  const VertexId vertex = scene.loop(part)[0];
  mpz_class value = 0;
  for (int k = 0; k < 3; ++k) {
    const mpz_class from = light.directional ? mpz_class(0) : scene.geometry.grid.at(vertex, k);
    value += normal[k] * (light.grid[k] - from);
  }
  return sign_of(value);
}

bool sees_area_light(const PreparedScene& scene, const Part& part, Side side,
                     const PreparedLight& light) {
  if (side == Side::kBack && !part.two_sided) return false;
  const std::array<mpz_class, 3> plane = doubled_area_vector(scene, part),
                                 origin = grid_point(scene, scene.loop(part)[0]),
                                 emitting = light_normal(light);
  const Sign wanted = side == Side::kFront ? Sign::kPositive : Sign::kNegative;
  return std::ranges::any_of(
             light.area_loop,
             [&](const auto& corner) { return sign_at(plane, origin, corner) == wanted; }) &&
         std::ranges::any_of(scene.loop(part), [&](VertexId vertex) {
           return sign_at(emitting, light.area_loop[0], grid_point(scene, vertex)) ==
                  Sign::kPositive;
         });
}

bool cuts_area_light(const PreparedScene& scene, const Part& part, const PreparedLight& light) {
  const std::array<mpz_class, 3> plane = doubled_area_vector(scene, part),
                                 origin = grid_point(scene, scene.loop(part)[0]);
  bool front = false, back = false;
  for (const std::array<mpz_class, 3>& corner : light.area_loop) {
    const Sign sign = sign_at(plane, origin, corner);
    front = front || sign == Sign::kPositive;
    back = back || sign == Sign::kNegative;
  }
  return front && back;
}

bool reaches_behind(const PreparedScene& scene, const Part& part, const PreparedLight& light) {
  const std::array<mpz_class, 3> emitting = light_normal(light);
  bool front = false, back = false;
  for (const VertexId vertex : scene.loop(part)) {
    const Sign sign = sign_at(emitting, light.area_loop[0], grid_point(scene, vertex));
    front = front || sign == Sign::kPositive;
    back = back || sign == Sign::kNegative;
  }
  return front && back;
}

namespace {

/// The sum over all sides that face or see a light, once a light, of what `area` says of their
/// part.
template <class Area>
double sum_of_facing(const PreparedScene& scene, const std::vector<std::uint32_t>& lights,
                     const Area& area) {
  double sum = 0;
  for (const Part& part : scene.parts) {
    std::size_t sides = 0;
    for (const std::uint32_t index : lights) {
      const PreparedLight& light = scene.lights[index];
      if (light.has_area()) {
        for (const Side side : {Side::kFront, Side::kBack}) {
          sides += sees_area_light(scene, part, side, light) ? 1 : 0;
        }
        continue;
      }
      const Sign sign = sign_at_light(scene, part, light.point);
      if (sign == Sign::kPositive || (sign == Sign::kNegative && part.two_sided)) ++sides;
    }
    if (sides > 0) sum += static_cast<double>(sides) * area(part);
  }
  return sum;
}

}  // namespace

double facing_area(const PreparedScene& scene, const std::vector<std::uint32_t>& lights) {
  return sum_of_facing(scene, lights,
                       [&](const Part& part) { return part_area(scene, part).middle(); });
}

double relative_facing_area(const PreparedScene& scene, const std::vector<std::uint32_t>& lights) {
  return sum_of_facing(scene, lights, [&](const Part& part) { return relative_area(scene, part); });
}

double relative_area(const PreparedScene& scene, const Part& part) {
  // The grid's box is 2^b wide.
  const auto square = 2 * static_cast<long>(scene.position_bits) + 1;
  std::array<double, 3> vector;
  const std::array<mpz_class, 3> doubled = doubled_area_vector(scene, part);
  for (std::size_t k = 0; k < 3; ++k) {
    long exponent = 0;
    const double mantissa = mpz_get_d_2exp(&exponent, doubled[k].get_mpz_t());
    vector[k] = std::ldexp(mantissa, static_cast<int>(exponent - square));
  }
  return std::hypot(vector[0], vector[1], vector[2]);
}

}  // namespace gnomon::report
