// SPDX-License-Identifier: GPL-3.0-or-later
// A scene in space order is the same scene: the same loops at the same positions in the same
// planes, and the same answers.
#include "algorithms/contour/space_order.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "gnomon/algorithms/shadows.h"
#include "gnomon/scene/generate.h"

namespace gnomon {
namespace {

PreparedScene made(const std::string& name, const std::string& parameter, std::int64_t n) {
  return prepare(generate(name, {{parameter, n}}).value()).value();
}

std::vector<PreparedScene> scenes() {
  std::vector<PreparedScene> result;
  for (const int n : {1, 20, 300}) result.push_back(made("city", "n", n));
  for (const int n : {1, 500}) result.push_back(made("quads", "n", n));
  result.push_back(made("slater-room", "n", 200));
  return result;
}

TEST(SpaceOrder, HasEveryPartOnce) {
  for (const PreparedScene& scene : scenes()) {
    const SpaceOrder order(scene);
    const PreparedScene& other = order.scene();
    ASSERT_EQ(other.parts.size(), scene.parts.size());
    ASSERT_EQ(other.geometry.edges.size(), scene.geometry.edges.size());
    ASSERT_EQ(other.geometry.planes.size(), scene.geometry.planes.size());
    LightResult numbers;
    for (std::uint32_t i = 0; i < scene.parts.size(); ++i) {
      PartResult& part = numbers.parts.emplace_back();
      part.part = part.first_fragment = i;
    }
    order.restore(numbers);
    for (std::uint32_t i = 0; i < scene.parts.size(); ++i) {
      ASSERT_EQ(numbers.parts[i].part, i);
      const Part& a = scene.parts[i];
      const Part& b = other.parts[numbers.parts[i].first_fragment];
      ASSERT_EQ(a.polygon, b.polygon);
      ASSERT_EQ(a.count, b.count);
      ASSERT_EQ(a.flipped, b.flipped);
      for (std::uint32_t k = 0; k < a.count; ++k) {
        const VertexId u = scene.loop(a)[k], v = other.loop(b)[k];
        EXPECT_EQ(scene.geometry.positions[u], other.geometry.positions[v]);
        for (int axis = 0; axis < 3; ++axis) {
          EXPECT_EQ(scene.geometry.grid.at(u, axis), other.geometry.grid.at(v, axis));
        }
        // Edge k runs from corner k to the next.
        const PlaneRef edge = other.edges(b)[k];
        const EdgeEnds ends = other.geometry.edges[edge.index()];
        EXPECT_LT(ends.a, ends.b);
        EXPECT_EQ(edge.flipped() ? ends.b : ends.a, v);
        EXPECT_EQ(edge.flipped() ? ends.a : ends.b, other.loop(b)[k + 1 == b.count ? 0 : k + 1]);
      }
      const SupportTriple& plane = scene.geometry.planes[a.plane];
      const SupportTriple& moved = other.geometry.planes[b.plane];
      EXPECT_EQ(scene.geometry.positions[plane.a], other.geometry.positions[moved.a]);
      EXPECT_EQ(scene.geometry.positions[plane.b], other.geometry.positions[moved.b]);
      EXPECT_EQ(scene.geometry.positions[plane.c], other.geometry.positions[moved.c]);
    }
  }
}

TEST(SpaceOrder, ChangesNoAnswer) {
  for (const PreparedScene& scene : scenes()) {
    const SpaceOrder order(scene);
    ShadowOptions options;
    options.method.point = MethodId::kContour;
    options.output.exact_fractions = true;
    auto asked = compute_shadows(scene, options);
    auto found = compute_shadows(order.scene(), options);
    if (!asked) continue;  // a room under an area light
    ASSERT_TRUE(found);
    ASSERT_EQ(asked->lights.size(), found->lights.size());
    for (std::size_t l = 0; l < asked->lights.size(); ++l) {
      order.restore(found->lights[l]);
      const LightResult &a = asked->lights[l], &b = found->lights[l];
      ASSERT_EQ(a.parts.size(), b.parts.size());
      for (std::size_t i = 0; i < a.parts.size(); ++i) {
        EXPECT_EQ(a.parts[i].reason, b.parts[i].reason);
        EXPECT_EQ(a.parts[i].side, b.parts[i].side);
        EXPECT_EQ(a.exact_fractions[i].lit, b.exact_fractions[i].lit);
      }
    }
  }
}

// A run in space order (the scene is large enough) and one by sectors agree.
TEST(SpaceOrder, IsUndoneForTheCaller) {
  const PreparedScene scene = made("city", "n", 4200);
  ASSERT_TRUE(SpaceOrder::pays(scene, false));
  ASSERT_TRUE(SpaceOrder::pays(made("city", "n", 840), true));
  ShadowOptions options;
  options.method.point = MethodId::kContour;
  const auto found = compute_shadows(scene, options);
  options.method.point = MethodId::kSectors;
  const auto asked = compute_shadows(scene, options);
  ASSERT_TRUE(found && asked);
  ASSERT_EQ(asked->lights.size(), found->lights.size());
  for (std::size_t l = 0; l < asked->lights.size(); ++l) {
    const LightResult &a = asked->lights[l], &b = found->lights[l];
    ASSERT_EQ(a.parts.size(), b.parts.size());
    for (std::uint32_t i = 0; i < a.parts.size(); ++i) {
      EXPECT_EQ(b.parts[i].part, i);
      EXPECT_EQ(a.parts[i].reason, b.parts[i].reason);
      EXPECT_EQ(a.parts[i].lit.lower == 1, b.parts[i].lit.lower == 1);
      EXPECT_EQ(a.parts[i].lit.upper == 0, b.parts[i].lit.upper == 0);
      EXPECT_LE(a.parts[i].lit.lower, b.parts[i].lit.upper);
      EXPECT_LE(b.parts[i].lit.lower, a.parts[i].lit.upper);
    }
  }
}

}  // namespace
}  // namespace gnomon
