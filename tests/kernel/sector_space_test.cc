// SPDX-License-Identifier: GPL-3.0-or-later
#include "sector_space_test.h"

#include <array>
#include <string>

#include "kernel/cgal/epick_space.h"
#include "kernel/coordinate/coordinate_space.h"
#include "kernel/implicit/implicit_light_space.h"
#include "kernel/signs/nearest_double.h"

namespace gnomon::test {

template <>
inline constexpr bool kDepthsPerDirection<ImplicitLightSpace<NoStats>> = true;

namespace {

using Kernels = testing::Types<CoordinateLightSpace<float>, CoordinateLightSpace<double>,
                               CoordinateLightSpace<long double>, CoordinateLightSpace<mpq_class>,
                               EpickLightSpace, ImplicitLightSpace<NoStats>>;
/// What the tests' names say for the types above, in the same order.
struct KernelNames {
  template <class Kernel>
  static std::string GetName(int i) {
    return std::array{"float", "double", "long_double", "rational", "epick", "plane"}[i];
  }
};
INSTANTIATE_TYPED_TEST_SUITE_P(Kernels, SectorSpace, Kernels, KernelNames);

TEST(SectorSpaceThickness, ASupportPlaneHasIt) {
  // The diagonal is 3000; the second triangle's corners are 1, 2 and 3 from the plane z = 0.
  const TriangleSoup soup({{{{0, 0, 0}, {2000, 0, 0}, {0, 2000, 0}}},
                           {{{1000, 1000, 1}, {1000, 0, 2}, {2000, 2000, 1000}}},
                           {{{1000, 1000, 1}, {1000, 0, 2}, {0, 1000, 3}}}},
                          0);
  for (const double thickness : {0.0, 1.5, 2.5}) {
    const KernelOptions options{.identity = true, .thickness = thickness / 3000};
    CoordinateSceneSpace<double> scene(soup.geometry(), options);
    CoordinateLightSpace<double> space(scene, light_at(soup.geometry(), {1, 1, 2000}, false),
                                       options);
    const auto loop = Loop<CoordinateLightSpace<double>>::import(soup, scene, space, 2);
    const PlaneRef cut = space.cut_of_supports(2, 0);
    for (std::uint32_t i = 0; i < 3; ++i) {
      const auto corner = loop.view().corner(i);
      const double distance = corner.vertex.x[2];
      const Side expected = distance > thickness ? Side::kFront : Side::kOn;
      EXPECT_EQ(space.side_of_support(0, corner), expected) << thickness << ' ' << distance;
      EXPECT_EQ(space.side_of_plane(cut, corner), expected) << thickness << ' ' << distance;
    }
  }
}

/// Under a far lamp (LightIntegers::far) kernel `plane` has one chart, as of a sun, and points of a
/// plane by two coordinates on the grid's scale: each against the exact point, from all directions
/// and distances, in planes that all but hold the lamp, too.
TEST(FarLamp, ChartsAndPlanarPointsEncloseTheTruth) {
  using Space = ImplicitLightSpace<NoStats>;
  Random random(11);
  int finite = 0, planar = 0, made = 0;
  for (const unsigned bits : {7u, 20u, 40u, 60u}) {
    for (int round = 0; round < 60; ++round) {
      const SoupKind kind = kSoupKinds[static_cast<std::size_t>(round) % std::size(kSoupKinds)];
      const TriangleSoup soup = random_soup(random, kind, bits, 4);
      const Geometry& geometry = soup.geometry();
      const std::array distances = {13u, 20u, 50u, 53u, 100u, 400u};
      const unsigned far = geometry.grid.bits() + distances[random.below(distances.size())];
      LightPoint light;
      for (mpz_class& x : light.grid) {
        if (random.below(2) == 0)
          x = mpz_class(static_cast<long>(random.between(-1000, 1000))) << (far - 10);
        if (random.below(3) == 0) x += static_cast<long>(random.below(1 << 6));
      }
      light.grid[random.below(3)] = (mpz_class(1) << far) + static_cast<long>(random.below(1000));
      Space::SceneSpace scene(geometry, {});
      Space space(scene, light, {});
      const std::optional<LightChart> chart = space.far_chart();
      ASSERT_TRUE(chart);
      LightPoint direction = light;
      direction.directional = true;
      const auto [ax, ay, az] = LightAxes::of(direction);
      const mpz_class extent = mpz_class(1) << geometry.grid.bits();
      const auto check = [&](const Loop<Space>& loop) {
        const auto& triple = geometry.planes[loop.support];
        const Integers normal = cross(minus(soup.at(triple.b), soup.at(triple.a)),
                                      minus(soup.at(triple.c), soup.at(triple.a)));
        for (std::uint32_t i = 0; i < loop.view().size(); ++i) {
          const auto corner = loop.view().corner(i);
          const Rationals x = grid_position(space, geometry, corner);
          const auto& l = light.grid;
          const mpq_class w = 1 - x[az] / l[az];
          const ChartPoint point = space.far_chart_point(*chart, corner);
          if (std::isfinite(point.uv_error)) {
            ++finite;
            ASSERT_TRUE(
                encloses(point.u, point.uv_error, (x[ax] - x[az] * l[ax] / l[az]) / w / extent));
            ASSERT_TRUE(
                encloses(point.v, point.uv_error, (x[ay] - x[az] * l[ay] / l[az]) / w / extent));
          }
          // The two coordinates whose plane is not steep, whichever the kernel takes for them.
          const auto is_kept = [&](const PlanarPoint& p, int u, int v) {
            return encloses(p.x, p.error, x[u] / extent) && encloses(p.y, p.error, x[v] / extent);
          };
          made += corner.vertex.source == kMadeVertex ? 1 : 0;
          const PlanarPair pair = space.pair_planar_point(corner);
          const PlanarPoint of_pair{pair.x.high, pair.y.high, pair.error + 0x1p-52};
          for (const PlanarPoint& p :
               {space.planar_point(corner), space.accurate_planar_point(corner), of_pair}) {
            if (!std::isfinite(p.error)) continue;
            ++planar;
            const auto is_largest = [&](int k) {
              const mpz_class size = abs(normal[k]);
              const mpz_class most = size + (size >> 40);  // doubles may choose otherwise
              return most >= abs(normal[(k + 1) % 3]) && most >= abs(normal[(k + 2) % 3]);
            };
            ASSERT_TRUE((is_largest(0) && is_kept(p, 1, 2)) ||
                        (is_largest(1) && is_kept(p, 2, 0)) || (is_largest(2) && is_kept(p, 0, 1)))
                << p.x << ' ' << p.y << " +- " << p.error;
          }
          const std::array<Ball, 3> position = space.position(corner);
          for (int k = 0; k < 3; ++k) {
            if (!position[k].is_finite()) continue;
            ASSERT_TRUE(encloses(position[k].middle, position[k].radius, x[k] / extent));
          }
          const auto nearest = space.nearest_position(corner);
          for (int k = 0; nearest && k < 3; ++k) {
            const mpq_class truth = geometry.origin[k] + geometry.step * x[k];
            ASSERT_EQ((*nearest)[k], nearest_double(truth));
          }
        }
      };
      for (std::uint32_t i = 0; i < soup.size(); ++i) {
        if (space.light_side(i) == Sign::kZero) continue;
        const Loop<Space> loop = Loop<Space>::import(soup, scene, space, i);
        check(loop);
        const auto j = static_cast<PlaneId>(random.below(soup.size()));
        if (testing::Test::HasFatalFailure() || !meet_in_line(soup, i, j)) continue;
        if (space.light_side(j) == Sign::kZero) continue;
        const PlaneRef cut = space.cut_of_supports(i, j);
        check(loop.clipped(space, cut, loop.sides(space, cut)));
        // A plane of the chart: u > 1/8.
        const PrefixPlane split{{chart->sign * 8, 0, -chart->sign * extent}};
        const PlaneRef plane = space.add_plane_of_far_chart(split);
        for (std::uint32_t k = 0; k < 3; ++k) {
          const auto corner = loop.view().corner(k);
          const Rationals x = grid_position(space, geometry, corner);
          const mpq_class u = (x[ax] - x[az] * light.grid[ax] / light.grid[az]) /
                              (1 - x[az] / light.grid[az]) / extent;
          ASSERT_EQ(static_cast<int>(space.side_of_plane(plane, corner)), sgn(u - mpq_class(1, 8)));
        }
        if (HasFatalFailure()) return;
      }
    }
  }
  EXPECT_GT(finite, 1000);
  EXPECT_GT(planar, 3000);
  EXPECT_GT(made, 100);
}

}  // namespace
}  // namespace gnomon::test
