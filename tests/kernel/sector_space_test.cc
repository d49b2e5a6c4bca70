// SPDX-License-Identifier: GPL-3.0-or-later
#include "sector_space_test.h"

#include <array>
#include <string>

#include "kernel/cgal/epick_space.h"
#include "kernel/coordinate/coordinate_space.h"
#include "kernel/implicit/implicit_light_space.h"

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

}  // namespace
}  // namespace gnomon::test
