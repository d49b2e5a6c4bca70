// SPDX-License-Identifier: GPL-3.0-or-later
// The bounds of the plane kernel's filter, computed again: the constants of filter_bounds.h by
// following each formula term by term, and rays and their errors against exact ones, on grids from
// 2 bits to hundreds and for lamps near and far. (The bounds of values and positions in volume
// space are held against rationals in plane_volume_space_test.cc, those of charts and planar points
// in sector_space_test.h.)
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "kernel/implicit/filter_bounds.h"
#include "kernel/implicit/implicit_light_space.h"
#include "scene/base/random.h"

namespace gnomon {
namespace {

using Space = ImplicitLightSpace<>;
using Rational3 = std::array<mpq_class, 3>;

mpz_class random_integer(Random& random, unsigned bits) {
  mpz_class value = 0;
  for (unsigned i = 0; i < bits; i += 16) value = (value << 16) + random.between(0, 0xffff);
  return value >> ((bits + 15) / 16 * 16 - bits);
}

/// Random vertices, an edge between each two neighbours, and one support plane.
Geometry random_geometry(Random& random, unsigned bits, VertexId vertices) {
  Geometry geometry;
  geometry.step = 1;
  std::vector<mpz_class> coordinates;
  for (VertexId v = 0; v < vertices; ++v) {
    std::array<double, 3> nearest;
    for (double& x : nearest) {
      coordinates.push_back(random_integer(random, bits));
      x = coordinates.back().get_d();
    }
    geometry.positions.push_back(nearest);
  }
  for (VertexId v = 0; v + 1 < vertices; ++v) geometry.edges.push_back({v, v + 1});
  geometry.grid = GridPositions::from(std::move(coordinates));
  geometry.planes.push_back({0, 1, 2});
  return geometry;
}

/// As the kernel scales it: by a power of two, the largest component in [1/2, 1), after the z of a
/// ray or the x and y of a plane of a directional light were multiplied by 2^stretch.
Rational3 normalized(const std::array<mpz_class, 3>& v, const std::array<unsigned, 3>& stretch) {
  std::array<mpz_class, 3> scaled;
  std::size_t most = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    scaled[k] = v[k] << stretch[k];
    if (sgn(scaled[k]) != 0) most = std::max(most, mpz_sizeinbase(scaled[k].get_mpz_t(), 2));
  }
  Rational3 result;
  for (std::size_t k = 0; k < 3; ++k) {
    result[k] = mpq_class(scaled[k], mpz_class(1) << most);
    result[k].canonicalize();
  }
  return result;
}

std::array<mpz_class, 3> q(const Geometry& geometry, const LightPoint& light, VertexId v) {
  const GridPositions& grid = geometry.grid;
  const std::array<mpz_class, 3> p = {grid.at(v, 0), grid.at(v, 1), grid.at(v, 2)};
  const auto& l = light.grid;
  if (LightIntegers(geometry, light).far) {
    LightPoint direction = light;
    direction.directional = true;
    const auto [x, y, z] = LightAxes::of(direction);
    return {p[x] * l[z] - p[z] * l[x], p[y] * l[z] - p[z] * l[y], l[z] - p[z]};
  }
  if (!light.directional) return {l[0] - p[0], l[1] - p[1], l[2] - p[2]};
  const auto [x, y, z] = LightAxes::of(light);
  return {p[x] * l[z] - p[z] * l[x], p[y] * l[z] - p[z] * l[y], l[z]};
}

template <class T>
std::array<T, 3> cross(const std::array<T, 3>& a, const std::array<T, 3>& b) {
  return {T(a[1] * b[2] - a[2] * b[1]), T(a[2] * b[0] - a[0] * b[2]), T(a[0] * b[1] - a[1] * b[0])};
}

void expect_within(const Space::Vertex& vertex, const Rational3& exact, const char* what) {
  if (std::isinf(vertex.bound)) return;  // of a zero vector: small grids have some
  // The bound is at least three times the error of a component (3.01 e + 14.1 u m).
  const mpq_class most = mpq_class(static_cast<double>(vertex.bound)) / 3;
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_LE(abs(mpq_class(vertex.ray[k]) - exact[k]), most) << what << " " << k;
    EXPECT_LE(abs(exact[k]), 2) << what << " " << k;
  }
}

/// A number of a formula to first order: its magnitude at most, and its error at most in units of
/// u.
struct Term {
  double size = 1, error = 0;
};
Term operator+(const Term& a, const Term& b) {
  return {a.size + b.size, a.error + b.error + a.size + b.size};
}
Term operator*(const Term& a, const Term& b) {
  return {a.size * b.size, a.size * b.error + b.size * a.error + a.size * b.size};
}
/// Of relative errors.
Term operator/(const Term& a, const Term& b) { return {1, a.error + b.error + 1}; }
/// A component of a cross product, and a dot product: plus and minus are alike.
Term cross_of(const Term& a, const Term& b) { return a * b + a * b; }
Term dot_of(const Term& a, const Term& b) { return a * b + a * b + a * b; }

/// The constant covers the count, without more slack than `most` times it.
void expect_covers(double constant, double count, double most, const char* what) {
  EXPECT_LE(count, constant / Ball::kUnit) << what;
  EXPECT_LE(constant / Ball::kUnit, most * count) << what;
}

constexpr Term kExact{1, 0}, kConverted{1, 2};

TEST(FilterConstants, OfSpace) {
  const Term offset{3, 6};
  expect_covers(SceneBounds::kPlaneError, (dot_of(kConverted, kExact) + offset).error, 2.5,
                "n . x - d");
  expect_covers(SceneBounds::value(1) - SceneBounds::value(0), 3 / Ball::kUnit, 1.01, "of x");
  // The parameter: 5/4 v over 3/4 gap.
  EXPECT_LE(1.25 / 0.75, SceneBounds::parameter(1, 1));
}

TEST(FilterConstants, OfLightSpace) {
  expect_covers(LightBounds::ray(0, 1), dot_of(kConverted, kExact).error, 1.01, "n . r");
  expect_covers(3 * LightBounds::kMadeError, cross_of(kConverted, kConverted).error, 1.01, "m x n");
  expect_covers(LightBounds::kDepthPlane, (kConverted / kConverted).error, 1.6, "n / h");
  const Term depth{1, LightBounds::kDepthPlane / Ball::kUnit};
  expect_covers(LightBounds::depth(1, 0, 1), dot_of(depth, kExact).error, 1.04, "depth . r");
  const Term half{0.5, depth.error / 2};
  expect_covers(LightBounds::kDepthDifference, (half + half).error, 1.02, "difference");
  const Term difference{1, LightBounds::kDepthDifference / Ball::kUnit}, ray{2, 0};
  expect_covers(LightBounds::depth_difference(1, 0), dot_of(difference, ray).error, 1.03,
                "differences . r");
  // In units of 2u.
  EXPECT_LE((half + half).error / 2, LightBounds::cut_slack(1, 1) - 1);
  const Term quotient = kConverted / kConverted;
  expect_covers(LightBounds::kAccurate, quotient.error + 2 + 1, 2.1, "h r / (n . r)");
}

TEST(FilterConstants, OfVolumes) {
  expect_covers(VolumeBounds::kOffset, dot_of(kConverted, kConverted).error, 1, "n . a");
  const Term offset{3, VolumeBounds::kOffset / Ball::kUnit};
  expect_covers(VolumeBounds::kPlaneError, (dot_of(kConverted, kExact) + offset).error, 1.2,
                "n . x - d");
  expect_covers(VolumeBounds::kCross, cross_of(kConverted, kConverted).error, 1.02, "n x n");
  const Term minor{2, VolumeBounds::kCross / Ball::kUnit};
  expect_covers(VolumeBounds::kDeterminant, dot_of(minor, kConverted).error, 1.03, "determinant");
  // Sums of residuals or values times minors: together the factors are 1, and no sum is above 2.
  const Term moved = minor * kExact, offset_of = minor * kConverted;
  EXPECT_LE(moved.error + 2 + 2, 19);
  EXPECT_LE(offset_of.error + 2 + 2, 25);
  EXPECT_LE(VolumeBounds::kDeterminant, 67 * Ball::kUnit);
  // A difference of values of different signs is as large as either.
  const Term gap{1, 2 + 1};
  expect_covers(VolumeBounds::kParameter, (kConverted / gap).error, 1.02, "parameter");
  expect_covers(VolumeBounds::kQuotient, (kConverted / kConverted).error, 1.02, "x / w");
  // With the errors of the points as 0, and as 1u, of which a difference has two.
  const Term way{1, 1}, rough{1, 1 + 2};
  const double exact = dot_of(kConverted, cross_of(way, way)).error;
  EXPECT_LE(exact, VolumeBounds::turn(0) / Ball::kUnit);
  EXPECT_LE(dot_of(kConverted, cross_of(rough, rough)).error,
            VolumeBounds::turn(Ball::kUnit) / Ball::kUnit);
}

/// A far lamp is as a sun, and stands on any side of the scene.
enum class Kind { kLamp, kSun, kFarLamp };
std::string name_of(Kind kind) {
  return kind == Kind::kLamp ? "Point" : kind == Kind::kSun ? "Directional" : "Far";
}

class FilterBound : public testing::TestWithParam<std::tuple<unsigned, Kind>> {};

TEST_P(FilterBound, RaysOfVerticesAndCrossings) {
  const auto [bits, kind] = GetParam();
  const bool directional = kind == Kind::kSun, parallel = kind != Kind::kLamp;
  Random random(bits + 1000 * static_cast<unsigned>(kind));
  for (int round = 0; round < 20; ++round) {
    const Geometry geometry = random_geometry(random, bits, 12);
    LightPoint light;
    light.directional = directional;
    for (mpz_class& x : light.grid) x = random_integer(random, bits) + 1;
    if (kind == Kind::kFarLamp) {
      for (mpz_class& x : light.grid) {
        const std::uint64_t how = random.below(4);
        if (how < 2) x = random_integer(random, bits + 30 + 40 * static_cast<unsigned>(round));
        if (how % 2 == 0) x = -x;
      }
      light.grid[random.below(3)] =
          random_integer(random, 2 * bits + 14) + (mpz_class(1) << (bits + 13));
    }
    Space::SceneSpace scene(geometry, {});
    Space space(scene, light, {});
    const unsigned stretch = parallel ? geometry.grid.bits() : 0;
    const SceneEdges names = scene.edges();
    std::vector<PlaneRef> planes;
    std::vector<Rational3> exact_planes;
    for (EdgeId edge = 0; edge < geometry.edges.size(); ++edge) {
      planes.push_back(space.import_edge(names.of_edge(edge, false), 0, false, {}, {}));
      const auto [a, b] = geometry.edges[edge];
      std::array<mpz_class, 3> normal = cross(q(geometry, light, a), q(geometry, light, b));
      if (parallel) {  // the common factor
        LightPoint direction = light;
        direction.directional = true;
        for (mpz_class& x : normal) x /= abs(light.grid[LightAxes::of(direction).z]);
      }
      exact_planes.push_back(normalized(normal, {stretch, stretch, 0}));
    }
    for (VertexId v = 0; v < geometry.positions.size(); ++v) {
      const Space::Vertex vertex = space.import_vertex(scene.input_vertex(v));
      expect_within(vertex, normalized(q(geometry, light, v), {0, 0, stretch}), "input vertex");
      if (bits > 10) {
        EXPECT_LE(vertex.bound, 21 * 0x1p-53);
      }
    }
    for (std::size_t i = 0; i < planes.size(); ++i) {
      for (std::size_t j = 0; j < planes.size(); ++j) {
        Space::Vertex vertex;
        space.finish_vertex(vertex, planes[i], planes[j]);
        expect_within(vertex, cross(exact_planes[i], exact_planes[j]), "crossing");
        if (bits > 10) {
          EXPECT_LE(vertex.bound, 66 * 0x1p-53);
        }
      }
    }
    if (HasFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(AllMagnitudes, FilterBound,
                         testing::Combine(testing::Values(2u, 10u, 20u, 31u, 40u, 63u, 64u, 130u,
                                                          400u),
                                          testing::Values(Kind::kLamp, Kind::kSun, Kind::kFarLamp)),
                         [](const auto& info) {
                           return name_of(std::get<1>(info.param)) +
                                  std::to_string(std::get<0>(info.param));
                         });

}  // namespace
}  // namespace gnomon
