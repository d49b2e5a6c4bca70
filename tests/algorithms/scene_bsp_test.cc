// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>
#include <type_traits>

#include "kernel/coordinate/coordinate_kernels.h"
#include "kernel/implicit/implicit_kernel.h"
#include "scene_bsp_order_test.h"

namespace gnomon::test {
namespace {

using Kernels = testing::Types<ImplicitKernel::LightSpace, RationalKernel::LightSpace>;
/// What the tests' names say.
struct KernelNames {
  template <class Space>
  static std::string GetName(int) {
    return std::is_same_v<Space, ImplicitKernel::LightSpace> ? "plane" : "rational";
  }
};
INSTANTIATE_TYPED_TEST_SUITE_P(Kernels, SceneBspOrder, Kernels, KernelNames);

/// A wall across x = 0 that reaches far, and a small sheet across the plane z = 0 in the middle,
/// whose plane the wall crosses and which crosses the wall's.
PreparedScene wall_and_sheet() {
  Scene scene;
  const auto face = [&](const std::vector<std::array<double, 3>>& corners) {
    Polygon& polygon = scene.polygons.emplace_back();
    polygon.id = std::to_string(scene.polygons.size());
    for (const auto& [x, y, z] : corners) {
      polygon.loop.push_back(static_cast<VertexId>(scene.vertices.size()));
      scene.vertices.push_back({Number(x), Number(y), Number(z)});
    }
  };
  face({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}});
  face({{0, -9, -9}, {0, 9, -9}, {0, 9, 9}, {0, -9, 9}});
  return prepare(scene).value();
}

TEST(SceneBsp, RootsAreTheFirstOrThoseFarthestOut) {
  const PreparedScene scene = wall_and_sheet();
  const std::vector<std::uint32_t> parts = {0, 1};
  EXPECT_EQ(outside_first(scene, parts), (std::vector<std::uint32_t>{1, 0}));
  EXPECT_EQ(outside_first(scene, std::vector<std::uint32_t>{0}), (std::vector<std::uint32_t>{0}));
  ImplicitKernel::LightSpace::SceneSpace space(scene.geometry, {true, 0});
  const auto root = [&](Roots roots) {
    const auto bsp = build_scene_bsp(space, scene, parts, 1, true, nullptr, 100, {}, roots);
    EXPECT_EQ(bsp.node_pieces.size(), 3u);
    return bsp.nodes.front().plane;
  };
  EXPECT_EQ(root(Roots::kFed), scene.parts[0].plane);
  EXPECT_EQ(root(Roots::kOutside), scene.parts[1].plane);
}

TEST(SceneBsp, PartsKeepTheirOrderWhereTheyReachEquallyFar) {
  const PreparedScene scene = prepare(generate("touching-boxes", {}, 1).value()).value();
  std::vector<std::uint32_t> parts(scene.parts.size());
  for (std::uint32_t i = 0; i < parts.size(); ++i) parts[i] = i;
  std::vector<std::uint32_t> fed = outside_first(scene, parts);
  EXPECT_NE(fed, parts);
  EXPECT_EQ(outside_first(scene, fed), fed);
  std::ranges::sort(fed);
  EXPECT_EQ(fed, parts);
}

}  // namespace
}  // namespace gnomon::test
