// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume_space_test.h"

#include <array>
#include <string>

#include "kernel/cgal/epick_volume_space.h"
#include "kernel/coordinate/coordinate_volume_space.h"
#include "kernel/implicit/implicit_volume_space.h"

namespace gnomon::test {
namespace {

using Kernels = testing::Types<CoordinateVolumeSpace<float>, CoordinateVolumeSpace<double>,
                               CoordinateVolumeSpace<long double>, CoordinateVolumeSpace<mpq_class>,
                               EpickVolumeSpace, ImplicitVolumeSpace<NoStats>>;
/// What the tests' names say for the types above, in the same order.
struct KernelNames {
  template <class Kernel>
  static std::string GetName(int i) {
    return std::array{"float", "double", "long_double", "rational", "epick", "plane"}[i];
  }
};
INSTANTIATE_TYPED_TEST_SUITE_P(Kernels, VolumeSpace, Kernels, KernelNames);
using ExactKernels = testing::Types<CoordinateVolumeSpace<mpq_class>, ImplicitVolumeSpace<NoStats>>;
/// What the tests' names say for the types above, in the same order.
struct ExactKernelNames {
  template <class Kernel>
  static std::string GetName(int i) {
    return std::array{"rational", "plane"}[i];
  }
};
INSTANTIATE_TYPED_TEST_SUITE_P(Kernels, ExactVolumeSpace, ExactKernels, ExactKernelNames);

TEST(VolumeSpaceThickness, AnAddedPlaneHasIt) {
  // The diagonal is 3000; the second triangle's corners are 1, 2 and 3 from the plane z = 0. A
  // light far away is no part of the diagonal.
  const TriangleSoup soup({{{{0, 0, 0}, {2000, 0, 0}, {0, 2000, 0}}},
                           {{{1000, 1000, 1}, {1000, 0, 2}, {0, 1000, 3}}},
                           {{{1000, 1000, 1}, {1000, 0, 2}, {2000, 2000, 1000}}}},
                          0);
  for (const double thickness : {0.0, 1.5, 2.5}) {
    const KernelOptions options{.identity = true, .thickness = thickness / 3000};
    const CoordinateSceneSpace<double> scene(soup.geometry(), options);
    CoordinateVolumeSpace<double> space(scene, options);
    const VolumeLoop<CoordinateVolumeSpace<double>> floor(soup, space, 0), other(soup, space, 1);
    const LightPoint along = light_at(soup.geometry(), {1, 5, 0}, true);
    for (const PlaneRef plane :
         {PlaneRef(0), space.add_plane(floor.corner(0), floor.corner(1), floor.corner(2)),
          space.add_plane(floor.corner(0), floor.corner(1), along), space.add_axis_plane(2, 0)}) {
      for (std::uint32_t i = 0; i < 3; ++i) {
        const double distance = other.vertices[i].x[2];
        const Side expected = distance > thickness ? Side::kFront : Side::kOn;
        EXPECT_EQ(space.side_of_plane(plane, other.corner(i)), expected)
            << thickness << ' ' << distance;
      }
    }
  }
}

/// Without identity a rounded kernel computes, and rounding says what it says.
TEST(VolumeSpaceIdentity, IsAPolicyOfRoundedKernels) {
  Random random(41);
  int off = 0;
  for (int round = 0; round < 50; ++round) {
    const TriangleSoup soup = random_soup(random, SoupKind::kFull, 53, 3, -7);
    for (const bool identity : {false, true}) {
      const KernelOptions options{.identity = identity, .thickness = 0};
      const CoordinateSceneSpace<double> scene(soup.geometry(), options);
      CoordinateVolumeSpace<double> space(scene, options);
      EXPECT_EQ(space.knows_identity(), identity);
      const VolumeLoop<CoordinateVolumeSpace<double>> loop(soup, space, 0), other(soup, space, 1);
      const PlaneRef plane = space.add_plane(loop.corner(0), loop.corner(1), other.corner(0));
      for (const Side side : {space.side_of_plane(plane, loop.corner(1)),
                              space.side_of_plane(plane, other.corner(0))}) {
        off += side != Side::kOn ? 1 : 0;
        if (identity) {
          EXPECT_EQ(side, Side::kOn);
        }
      }
    }
  }
  EXPECT_GT(off, 0);
}

/// A normal that over- or underflows is no plane.
TEST(VolumeSpaceRange, ANormalThatIsNotANumberIsNoPlane) {
  for (const int exponent : {-1070, -600, 0, 600, 1000}) {
    const TriangleSoup soup({{{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}}}}, exponent);
    for (const double thickness : {0.0, 1e-9}) {
      const KernelOptions options{.identity = true, .thickness = thickness};
      const CoordinateSceneSpace<double> scene(soup.geometry(), options);
      CoordinateVolumeSpace<double> space(scene, options);
      const VolumeLoop<CoordinateVolumeSpace<double>> loop(soup, space, 0);
      const PlaneRef plane = space.add_plane(loop.corner(0), loop.corner(1), loop.corner(2));
      EXPECT_EQ(plane.valid(), exponent == 0) << exponent;
      // CGAL's test of the same three points is exact.
      const EpickSceneSpace rounded_scene(soup.geometry(), options);
      EpickVolumeSpace rounded(rounded_scene, options);
      const VolumeLoop<EpickVolumeSpace> points(soup, rounded, 0);
      EXPECT_TRUE(rounded.add_plane(points.corner(0), points.corner(1), points.corner(2)).valid());
    }
  }
}

}  // namespace
}  // namespace gnomon::test
