// SPDX-License-Identifier: GPL-3.0-or-later
// The bounds of the contour method's doubles (ContourBounds, zero_between), each held against the
// same values in rationals.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "algorithms/contour/light_rays.h"
#include "gnomon/scene/prepare.h"
#include "kernel/implicit/implicit_kernel.h"
#include "scene/base/random.h"

namespace gnomon {
namespace {

using Numbers = ContourNumbers<double, Trust::kCertified>;
using Space = ImplicitLightSpace<NoStats>;
using Exact3 = std::array<mpq_class, 3>;

mpq_class power_of_two(int exponent) {
  mpq_class result(1);
  if (exponent >= 0) {
    mpq_mul_2exp(result.get_mpq_t(), result.get_mpq_t(), static_cast<unsigned>(exponent));
  } else {
    mpq_div_2exp(result.get_mpq_t(), result.get_mpq_t(), static_cast<unsigned>(-exponent));
  }
  return result;
}
mpq_class exact_dot(const Exact3& a, const Exact3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Exact3 exact_cross(const Exact3& a, const Exact3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Exact3 exact_difference(const Exact3& a, const Exact3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

double unit(Random& random) { return static_cast<double>(random.next() >> 11) * 0x1p-53; }

/// A light space in doubles, and the same in rationals.
struct BothRays {
  BothRays(const PreparedScene& scene, std::uint32_t light)
      : point(scene.lights[light].point),
        scene_space(scene.geometry, {}),
        space(scene_space, point, {}),
        integers(scene.geometry, point) {
    make_light_rays(space, scene.geometry, point, 1, rays);
    const bool from_doubles = !rays.positions.empty();
    const int b = static_cast<int>(integers.grid_bits()), e = static_cast<int>(integers.light_bits);
    const int q = static_cast<int>(integers.q_bits);
    const mpq_class scale = power_of_two(from_doubles   ? -(b + e)
                                         : integers.far ? -(b + e + 1)
                                                        : -q);
    for (VertexId v = 0; v < rays.rays.size(); ++v) {
      const Vector3<mpz_class> at =
          integers.far ? integers.far_ray<mpz_class>(v) : integers.q<mpz_class>(v);
      Exact3 ray{mpq_class(at[0]) * scale, mpq_class(at[1]) * scale, mpq_class(at[2]) * scale};
      if (integers.is_parallel()) ray[2] *= power_of_two(b);
      exact.push_back(ray);
    }
  }
  Exact3 exact_depth(const Geometry& geometry, PlaneId id) const {
    const ExactPlane<mpz_class> plane = ExactGeometry<mpz_class>(geometry).plane(id);
    const Vector3<mpz_class>& l = point.grid;
    const int b = static_cast<int>(integers.grid_bits()), e = static_cast<int>(integers.light_bits);
    Exact3 depth;
    if (integers.is_parallel()) {
      const auto [x, y, z] = integers.axes;
      const mpz_class height =
          integers.far ? mpz_class(dot(plane.n, l) - plane.d) : mpz_class(dot(plane.n, l));
      const mpq_class factor = power_of_two(e) * (sgn(l[z]) < 0 ? -1 : 1) / mpq_class(height);
      return {-factor * plane.n[x], -factor * plane.n[y], factor * plane.d * power_of_two(-b)};
    }
    const mpq_class height = dot(plane.n, l) - plane.d;
    for (int k = 0; k < 3; ++k) {
      depth[k] = mpq_class(plane.n[k]) / height * power_of_two(static_cast<int>(integers.q_bits));
    }
    return depth;
  }

  /// n / h of a plane at a vertex, from its depth there.
  double quotient(PlaneId id, VertexId v, double& error) const {
    const double reach = rays.reach > 0 ? rays.reach : largest(rays.rays[v]);
    const double height = dot_product(rays.depths[id], rays.rays[v]);
    error = rays.perspective * (rays.depth_error[id] * reach + 1e-15 * std::fabs(height)) + 1e-15;
    return 1 + rays.perspective * (height - rays.heights[v]);
  }
  /// The determinant of three rays, of a sun or a far lamp less its unit.
  mpq_class determinant(VertexId a, VertexId b, VertexId v) const {
    mpq_class result = exact_dot(exact_cross(exact[a], exact[b]), exact[v]);
    if (integers.is_parallel()) result /= unit_of_sun();
    return result;
  }
  mpq_class unit_of_sun() const {
    const mpq_class d_z = mpq_class(point.grid[static_cast<std::size_t>(integers.axes.z)]) *
                          power_of_two(-static_cast<int>(integers.light_bits));
    const int s =
        static_cast<int>(rays.positions.empty() ? integers.grid_bits() + integers.light_bits + 1
                                                : integers.grid_bits() + integers.light_bits);
    const int one = static_cast<int>(integers.grid_bits() + integers.light_bits);
    return d_z * d_z * power_of_two(3 * (one - s));
  }

  /// The value of an edge's plane against the same; how near it comes to its bound.
  double hold_plane(EdgeId edge, VertexId a, VertexId b, VertexId v) const {
    const mpq_class truth = determinant(a, b, v);
    double error, of_flipped;
    const double value = rays.planes.value(PlaneRef(edge), v, error);
    const mpq_class off = abs(truth - mpq_class(value));
    EXPECT_LE(off, mpq_class(error)) << edge << ' ' << v;
    EXPECT_EQ(rays.planes.value(PlaneRef(edge, true), v, of_flipped), -value);
    EXPECT_EQ(of_flipped, error);
    return error == 0 ? 0 : mpq_class(off / mpq_class(error)).get_d();
  }

  /// sharp_value() and the kernels' integers, against the determinant of three rays.
  void hold_sharp(VertexId a, VertexId b, VertexId v) const {
    const mpq_class truth = determinant(a, b, v);
    if (integers.is_parallel()) {
      const mpq_class unit = unit_of_sun();
      ASSERT_LE(abs(mpq_class(rays.exact->unit()) - unit), mpq_class(ExactValues::kUnit) * unit);
    }
    for (const double most : {0.0, ContourBounds::kSharpest, ContourBounds::kSharp, 1.0}) {
      double error;
      const double sharp = rays.sharp_value(a, b, v, most, error);
      ASSERT_LE(abs(truth - mpq_class(sharp)), mpq_class(error));
      ASSERT_LE(error, std::max(most, ExactValues::kLine) * std::fabs(sharp) + Ball::kTiny);
    }
    ASSERT_LE(abs(truth - mpq_class(rays.exact->line(a, b, v))),
              mpq_class(ExactValues::kLine) * abs(truth));
  }

  /// Where an edge crosses the line of another, or a plane, against rationals.
  void hold_crossings(const Geometry& geometry, VertexId a, VertexId b, VertexId from,
                      VertexId to) const {
    const auto hold = [](const std::optional<DoubleDouble>& t, const mpq_class& at_from,
                         const mpq_class& at_to) {
      ASSERT_EQ(t.has_value(), sgn(at_from) != sgn(at_to));
      if (!t) return;
      const mpq_class truth = at_from / (at_from - at_to);
      ASSERT_LE(abs(truth - mpq_class(t->high) - mpq_class(t->low)),
                mpq_class(ExactValues::kCrossing) * truth);
    };
    hold(rays.exact->crossing(a, b, from, to), determinant(a, b, from), determinant(a, b, to));
    const ExactGeometry<mpz_class> in_grid(geometry);
    for (PlaneId id = 0; id < geometry.planes.size(); ++id) {
      hold(rays.exact->crossing(id, from, to), in_grid.value(id, from), in_grid.value(id, to));
    }
  }

  LightPoint point;
  Space::SceneSpace scene_space;
  Space space;
  LightIntegers integers;
  LightRays<Numbers> rays;
  std::vector<Exact3> exact;
};

/// `kFar`: as many times the scene's size away as `far_bits` says, in any direction.
enum class Kind { kLamp, kSun, kFar };

/// Instead of bits: coordinates of 53 bits and any size down to 2^-260 of the largest.
constexpr int kMixed = 130;

/// Triangles of random corners with so many bits, and a light: a lamp or a sun of as many.
PreparedScene random_scene(Random& random, int bits, Kind kind, int far_bits) {
  Scene scene;
  const auto coordinate = [&] {
    if (bits == kMixed) {
      const int exponent = static_cast<int>(random.below(2 * kMixed)) - kMixed;
      return Number(std::ldexp(0.5 + unit(random) / 2, exponent));
    }
    const auto value = static_cast<double>(random.below(std::uint64_t{1} << bits));
    return Number(value);
  };
  for (int i = 0; i < 30; ++i) scene.vertices.push_back({coordinate(), coordinate(), coordinate()});
  for (std::uint32_t i = 0; i + 2 < 30; i += 3) {
    Polygon polygon;
    polygon.id = std::to_string(i);
    polygon.loop = {i, i + 1, i + 2};
    polygon.two_sided = true;
    scene.polygons.push_back(polygon);
  }
  Light light;
  light.id = "light";
  light.type = kind == Kind::kSun ? LightType::kDirectional : LightType::kPoint;
  light.position = {coordinate(), coordinate(), coordinate()};
  if (kind == Kind::kFar) {
    // One coordinate is large, the others are large, of the scene's size, or 0.
    const std::uint64_t largest = random.below(3);
    for (std::uint64_t k = 0; k < 3; ++k) {
      double x = std::ldexp(0.5 + unit(random) / 2, bits + far_bits);
      if (k != largest && random.below(2) == 0) x = std::ldexp(unit(random), bits);
      if (k != largest && random.below(4) == 0) x = 0;
      if (bits != kMixed) x = std::round(x);
      light.position[k] = Number(random.below(2) == 0 ? -x : x);
    }
  }
  scene.lights.push_back(light);
  return prepare(scene).value();
}

class ContourBoundsTest : public testing::TestWithParam<std::tuple<int, Kind>> {};

TEST_P(ContourBoundsTest, HoldLinesAndDepths) {
  const auto [bits, kind] = GetParam();
  const bool sun = kind != Kind::kLamp;
  Random random(static_cast<std::uint64_t>(bits) * 2 + static_cast<std::uint64_t>(kind));
  constexpr double kUnderflow = 0x1p-900;  // FacingPolygons adds it
  double closest = 0, closest_plane = 0;
  for (int round = 0; round < 20; ++round) {
    constexpr std::array kFarBits = {14, 30, 50, 51, 52, 80, 500};
    const PreparedScene scene = random_scene(
        random, bits, kind, kFarBits[static_cast<std::size_t>(round) % kFarBits.size()]);
    const BothRays both(scene, 0);
    ASSERT_EQ(both.integers.far, kind == Kind::kFar);
    const LightRays<Numbers>& rays = both.rays;
    for (EdgeId edge = 0; edge < scene.geometry.edges.size(); ++edge) {
      const auto [from, to] = scene.geometry.edges[edge];
      const Exact3 line =
          exact_cross(both.exact[from], exact_difference(both.exact[to], both.exact[from]));
      for (VertexId v = 0; v < rays.rays.size(); ++v) {
        const double reach = rays.reach > 0 ? rays.reach : largest(rays.rays[v]);
        const double bound = rays.line_error[edge] * reach;
        const mpq_class off = abs(exact_dot(line, both.exact[v]) -
                                  mpq_class(dot_product(rays.lines[edge], rays.rays[v])));
        ASSERT_LE(off, mpq_class(bound + kUnderflow)) << edge << ' ' << v;
        closest = std::max(closest, off.get_d() / (bound + kUnderflow));
        // What no product or sum can have rounded is exact.
        if (rays.proven(bound) == 0) {
          ASSERT_EQ(off, 0) << edge << ' ' << v;
        }
        both.hold_sharp(from, to, v);
        both.hold_crossings(scene.geometry, from, to, v, v == 0 ? 1 : v - 1);
        if (!rays.planes.empty()) {
          closest_plane = std::max(closest_plane, both.hold_plane(edge, from, to, v));
        }
      }
    }
    for (PlaneId id = 0; id < scene.geometry.planes.size(); ++id) {
      if (both.space.light_side(id) == Sign::kZero || !std::isfinite(rays.depth_error[id]))
        continue;
      const Exact3 depth = both.exact_depth(scene.geometry, id);
      for (VertexId v = 0; v < rays.rays.size(); ++v) {
        const double reach = rays.reach > 0 ? rays.reach : largest(rays.rays[v]);
        const mpq_class off = abs(exact_dot(depth, both.exact[v]) -
                                  mpq_class(dot_product(rays.depths[id], rays.rays[v])));
        ASSERT_LE(off, mpq_class(rays.depth_error[id] * reach)) << id << ' ' << v;
        if (both.integers.far) {
          const ExactPlane<mpz_class> plane = ExactGeometry<mpz_class>(scene.geometry).plane(id);
          const mpq_class truth = mpq_class(dot(plane.n, both.integers.q<mpz_class>(v))) /
                                  mpq_class(dot(plane.n, both.point.grid) - plane.d);
          double error;
          const double quotient = both.quotient(id, v, error);
          ASSERT_LE(abs(truth - mpq_class(quotient)),
                    mpq_class(error + 1e-15 * std::fabs(quotient)));
          ASSERT_LE(abs(truth - mpq_class(rays.exact->depth(id, v))),
                    mpq_class(ExactValues::kDepth) * abs(truth));
        } else if (!both.point.directional) {
          const mpq_class sharp = exact_dot(depth, both.exact[v]);
          ASSERT_LE(abs(sharp - mpq_class(rays.exact->depth(id, v))),
                    mpq_class(ExactValues::kDepth) * abs(sharp));
        }
      }
    }
  }
  // A bound that nothing comes near would say little. Of few bits all doubles are exact.
  if (bits > 10) {
    EXPECT_GT(closest, sun ? 0.002 : 0.01);
  }
  // Lamps have planes where their rays are no doubles.
  if (bits != kMixed && (bits > 52 || (sun && bits > 20))) {
    EXPECT_GT(closest_plane, 0.1);
  }
}

INSTANTIATE_TEST_SUITE_P(BitsAndLights, ContourBoundsTest,
                         testing::Combine(testing::Values(4, 20, 40, 52, 61, kMixed),
                                          testing::Values(Kind::kLamp, Kind::kSun, Kind::kFar)));

TEST(ZeroBetween, IsOffByLessThanItsError) {
  Random random(7);
  for (int i = 0; i < 20000; ++i) {
    const double scale = std::ldexp(1.0, static_cast<int>(random.below(40)) - 20);
    const double at_from = unit(random) * scale, at_to = -unit(random) * scale;
    const double error = unit(random) * scale * 0.2;
    const Place<Numbers> place = zero_between<Numbers>(at_from, at_to, error, PlaceName());
    for (const double first : {-1.0, 1.0}) {
      for (const double second : {-1.0, 1.0}) {
        const mpq_class s = mpq_class(at_from) + mpq_class(first) * mpq_class(error);
        const mpq_class t = mpq_class(at_to) + mpq_class(second) * mpq_class(error);
        if (sgn(s) < 0 || sgn(t) > 0 || s == t) continue;  // not opposite: not asked for
        ASSERT_LE(abs(s / (s - t) - mpq_class(place.t)), mpq_class(place.error)) << i;
      }
    }
  }
}

}  // namespace
}  // namespace gnomon
