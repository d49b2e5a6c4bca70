// SPDX-License-Identifier: GPL-3.0-or-later
// The kernel `epick` is exact on the points that it has, rounded as they are: every side that it
// tells is compared with rational arithmetic on the same doubles.
#include <gtest/gtest.h>

#include <cmath>

#include "kernel/cgal/epick_space.h"
#include "triangle_soup.h"

namespace gnomon::test {
namespace {

Rationals rational(const std::array<double, 3>& x) {
  return {mpq_class(x[0]), mpq_class(x[1]), mpq_class(x[2])};
}

/// Points between the corners of a lattice, rounded: a third of the way, or in the plane by
/// intention.
std::array<double, 3> rounded_point(Random& random, double size) {
  std::array<double, 3> x;
  for (double& c : x) {
    c = size * static_cast<double>(random.between(0, 9)) / 3.0;
    if (random.chance(1, 4)) c = std::nextafter(c, random.chance(1, 2) ? INFINITY : -INFINITY);
  }
  return x;
}

class EpickScale : public testing::TestWithParam<int> {};

TEST_P(EpickScale, SceneSidesAreExactOnRoundedPoints) {
  Random random(11);
  const double size = std::ldexp(1.0, GetParam());
  int zeros = 0;
  for (int round = 0; round < 60; ++round) {
    const TriangleSoup soup = random_soup(random, SoupKind::kLattice, 4, 4, GetParam() - 2);
    EpickSceneSpace space(soup.geometry(), {});
    for (int point = 0; point < 40; ++point) {
      EpickVertex vertex{rounded_point(random, size), kMadeVertex};
      const Corner<EpickVertex> corner{space.edges().of_edge(0, false), vertex,
                                       space.edges().of_edge(1, false), 0};
      for (PlaneId plane = 0; plane < soup.size(); ++plane) {
        const SupportTriple& t = soup.geometry().planes[plane];
        const Rationals a = rational(soup.geometry().positions[t.a]);
        const Rationals n = cross(minus(rational(soup.geometry().positions[t.b]), a),
                                  minus(rational(soup.geometry().positions[t.c]), a));
        const int truth = sgn(dot(n, minus(rational(vertex.x), a)));
        zeros += truth == 0 ? 1 : 0;
        ASSERT_EQ(static_cast<int>(space.side_of_plane(PlaneRef(plane), corner)), truth);
        ASSERT_EQ(static_cast<int>(space.side_of_plane(PlaneRef(plane, true), corner)), -truth);
      }
    }
  }
  EXPECT_GT(zeros, 0);
}

TEST_P(EpickScale, ShadowPlaneSidesAreExactOnRoundedPoints) {
  Random random(12);
  const double size = std::ldexp(1.0, GetParam());
  int zeros = 0;
  for (int round = 0; round < 60; ++round) {
    const TriangleSoup soup = random_soup(random, SoupKind::kLattice, 4, 3, GetParam() - 2);
    EpickSceneSpace scene(soup.geometry(), {.identity = true});
    LightPoint light;
    light.directional = round % 2 == 0;
    for (std::size_t k = 0; k < 3; ++k) {
      light.grid[k] = static_cast<long>(random.between(light.directional ? -3 : 0, 12));
      light.nearest[k] = light.directional ? light.grid[k].get_d()
                                           : std::ldexp(light.grid[k].get_d(), GetParam() - 2);
    }
    if (light.grid == Integers{0, 0, 0}) continue;
    EpickLightSpace space(scene, light, {.identity = true});
    for (std::uint32_t triangle = 0; triangle < soup.size(); ++triangle) {
      const Sign facing = space.light_side(triangle);
      const auto& loop = soup.loop(triangle);
      const auto at = [&](VertexId v) { return rational(soup.geometry().positions[v]); };
      const Rationals l = rational(light.nearest);
      const Rationals normal =
          cross(minus(at(loop[1]), at(loop[0])), minus(at(loop[2]), at(loop[0])));
      EXPECT_EQ(static_cast<int>(facing),
                sgn(dot(normal, light.directional ? l : minus(l, at(loop[0])))));
      if (facing != Sign::kPositive) continue;
      for (std::uint32_t i = 0; i < 3; ++i) {
        const VertexId a = loop[i], b = loop[(i + 1) % 3], c = loop[(i + 2) % 3];
        const PlaneRef edge = soup.edge(triangle, i);
        const PlaneRef plane =
            space.import_edge(scene.edges().of_edge(edge.index(), edge.flipped()), triangle, false,
                              scene.input_vertex(a), scene.input_vertex(b));
        Rationals n = cross(minus(at(b), at(a)), light.directional ? l : minus(l, at(a)));
        if (dot(n, minus(at(c), at(a))) < 0) {  // interior in front
          for (mpq_class& x : n) x = -x;
        }
        for (int point = 0; point < 30; ++point) {
          EpickVertex vertex{rounded_point(random, size), kMadeVertex};
          const PlaneRef other(plane.index() + 1);
          const Corner<EpickVertex> corner{other, vertex, other, triangle};
          const int truth = sgn(dot(n, minus(rational(vertex.x), at(a))));
          zeros += truth == 0 ? 1 : 0;
          ASSERT_EQ(static_cast<int>(space.side_of_plane(plane, corner)), truth);
        }
      }
    }
  }
  EXPECT_GT(zeros, 0);
}

INSTANTIATE_TEST_SUITE_P(Scales, EpickScale, testing::Values(-200, -40, 0, 40, 200),
                         [](const auto& info) {
                           return (info.param < 0 ? "Down" : "Up") +
                                  std::to_string(std::abs(info.param));
                         });

TEST(Epick, RoundingThePointIsWhatGoesWrong) {
  // (1/3, 1/3, 1/3) is on the plane x + y + z = 1 of these corners exactly; the nearest doubles are
  // not: the predicate is right about a point that is wrong.
  const TriangleSoup soup(
      {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}}}}, 0);
  EpickSceneSpace space(soup.geometry(), {});
  const double third = 1.0 / 3.0;
  EpickVertex vertex{{third, third, third}, kMadeVertex};
  const Corner<EpickVertex> corner{space.edges().of_edge(0, false), vertex,
                                   space.edges().of_edge(1, false), 1};
  EXPECT_NE(space.side_of_plane(PlaneRef(0), corner), Side::kOn);
}

}  // namespace
}  // namespace gnomon::test
