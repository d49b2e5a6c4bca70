// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/sides/lit_centroid.h"

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "report/sides/part_area.h"

namespace gnomon::report {

namespace {

using Point = std::array<mpq_class, 3>;

/// Area in a chart, and the integral of the position over it.
struct Moments {
  mpq_class area = 0;
  Point sum{};

  void add(const Moments& other, const mpq_class& weight) {
    area += weight * other.area;
    for (std::size_t k = 0; k < 3; ++k) sum[k] += weight * other.sum[k];
  }
};

/// The loop of a fragment; none if a vertex is not a number.
std::optional<std::vector<Point>> loop_of(const LightResult& light, const Fragment& fragment) {
  std::vector<Point> loop(fragment.count);
  for (std::uint32_t i = 0; i < fragment.count; ++i) {
    if (!light.exact_points.empty()) {
      loop[i] = light.exact_points[fragment.first + i];
      continue;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const double coordinate = light.points[fragment.first + i][k];
      if (!std::isfinite(coordinate)) return std::nullopt;
      loop[i][k] = coordinate;
    }
  }
  return loop;
}

/// Six times the moments of a convex loop, the axis dropped.
Moments moments_of(const std::vector<Point>& loop, std::size_t axis) {
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  Moments result;
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    const Point &a = loop[0], &b = loop[i], &c = loop[i + 1];
    const mpq_class twice = abs((b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]));
    result.area += 3 * twice;
    for (std::size_t k = 0; k < 3; ++k) result.sum[k] += twice * (a[k] + b[k] + c[k]);
  }
  return result;
}

std::size_t largest_axis(const std::array<mpz_class, 3>& normal) {
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (mpz_cmpabs(normal[k].get_mpz_t(), normal[axis].get_mpz_t()) > 0) axis = k;
  }
  return axis;
}

}  // namespace

std::optional<LitCentroid> lit_centroid(const PreparedScene& scene, const LightResult& light,
                                        const ClassifiedSide& side) {
  Moments all;
  for (std::size_t i = 0; i < side.parts.size(); ++i) {
    const PartSide& own = side.parts[i];
    if (!own.sees()) continue;
    const Part& part = scene.parts[scene.first_part[side.polygon] + i];
    const std::array<mpz_class, 3> normal = doubled_area_vector(scene, part);
    const std::size_t axis = largest_axis(normal);
    Moments lit;
    for (std::uint32_t f = 0; f < own.result->fragment_count; ++f) {
      const Fragment& fragment = light.fragments[own.result->first_fragment + f];
      if (fragment.state != LightState::kLit) continue;
      const auto loop = loop_of(light, fragment);
      if (!loop) return std::nullopt;
      lit.add(moments_of(*loop, axis), 1);
    }
    if (side.coplanar) {
      all.add(lit, 1);
      continue;
    }
    // Areas in different planes: each chart's by how much it shrinks its plane.
    const mpq_class& step = scene.geometry.step;
    const mpq_class in_chart = step * step * abs(normal[axis]) / 2;
    all.add(lit, precise_area(scene, part) / in_chart);
  }
  if (all.area == 0) return std::nullopt;
  LitCentroid result;
  result.exact = side.coplanar && !light.exact_points.empty();
  for (std::size_t k = 0; k < 3; ++k) result.point[k] = all.sum[k] / all.area;
  return result;
}

}  // namespace gnomon::report
