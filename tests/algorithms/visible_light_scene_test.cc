// SPDX-License-Identifier: GPL-3.0-or-later
// The visible part of an area light as a shadow: on the families of area lights every exact kernel
// finds by shadow algorithms what the clipping of the light in its own plane finds, and the oracle
// confirms it.
#include "gnomon/scene/visible_light_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "exact_check.h"
#include "fuzz/generate/area_families.h"
#include "fuzz/generate/scene_pen.h"
#include "gnomon/algorithms/visible_light.h"
#include "method_variants.h"

namespace gnomon::test {
namespace {

using fuzz::Family;
using fuzz::ScenePen;
using testing::HasSubstr;

/// A vertex of a polygon's loop, and a part in whose plane it lies.
struct Place {
  std::uint32_t part = 0;
  VertexId vertex = 0;
};

std::vector<Place> corners_of(const Case& scene) {
  std::vector<Place> places;
  const PreparedScene& prepared = scene.prepared();
  for (std::uint32_t i = 0; i < prepared.parts.size(); ++i) {
    const auto loop = prepared.loop(prepared.parts[i]);
    for (const VertexId vertex : scene.scene().polygons[prepared.parts[i].polygon].loop) {
      const VertexId own = prepared.vertex_of_input[vertex];
      if (std::ranges::find(loop, own) != loop.end()) places.push_back({i, vertex});
    }
  }
  return places;
}

std::array<mpq_class, 3> exact(const Position& position) {
  return {position[0].exact(), position[1].exact(), position[2].exact()};
}

/// The exact lit share of the first polygon, by a kernel and the method of its turn; -1 if it is
/// not one part.
mpq_class lit_share(const Case& seen, KernelId kernel, const MethodSelection& method) {
  if (seen.prepared().first_part[1] != 1) return -1;
  ShadowOptions options = with_method(options_for(kernel), method);
  const auto result = compute_shadows(seen.prepared(), options);
  EXPECT_TRUE(result) << to_string(result.error());
  return result ? result->lights[0].exact_fractions[0].lit : mpq_class(-1);
}

class VisibleLightScene : public testing::TestWithParam<Family> {};

TEST_P(VisibleLightScene, LitIsWhatThePointSees) {
  const std::vector<MethodSelection> methods = method_variants();
  std::vector<MethodSelection> exact_methods;
  for (const MethodSelection& method : methods) {
    // The contour method knows no regions.
    if (method_info(method.id).lights.point && method_info(method.id).makes_fragments) {
      exact_methods.push_back(method);
    }
  }
  constexpr std::size_t kPlaces = 6, kEnough = 60;
  std::size_t compared = 0, partly = 0, cut = 0, turn = 0;
  for (std::uint64_t seed = 1; seed <= 100 && compared < kEnough; ++seed) {
    const auto scene = Case::make(GetParam().make(seed));
    if (!scene) continue;
    const std::vector<Place> places = corners_of(*scene);
    for (std::uint32_t l = 0; l < scene->prepared().lights.size(); ++l) {
      if (!scene->is_area(l)) continue;
      const LightVisibility visibility(scene->prepared(), l);
      const std::string id = scene->scene().lights[scene->prepared().lights[l].light].id;
      for (std::size_t k = 0; k < std::min(kPlaces, places.size()); ++k) {
        const auto& [part, vertex] = places[places.size() * k / std::min(kPlaces, places.size())];
        const Position& point = scene->scene().vertices[vertex];
        const VisibleLight truth = visibility.at(part, Side::kFront, exact(point));
        const Part& own = scene->prepared().parts[part];
        // A bent polygon has no plane of its own; where all of the light is in front none is
        // needed.
        const std::string& receiver = scene->scene().polygons[own.polygon].id;
        auto made = visible_light_scene(scene->scene(), {id, point, receiver, Side::kFront});
        if (!made && truth.in_front == 1) {
          made = visible_light_scene(scene->scene(), {id, point, {}, Side::kFront});
        }
        if (!made) continue;
        if (truth.in_front != 1) ++cut;
        const auto seen = Case::make(*made);
        ASSERT_TRUE(seen);
        const KernelId kernel =
            std::array{KernelId::kPlane, KernelId::kRational, KernelId::kEpeck}[turn % 3];
        const MethodSelection& method = exact_methods[turn / 3 % exact_methods.size()];
        ++turn;
        const mpq_class lit = lit_share(*seen, kernel, method);
        if (lit < 0) continue;
        EXPECT_EQ(lit, truth.visible)
            << "seed " << seed << ", light " << id << ", vertex " << vertex << ", by "
            << text_of(method) << " on " << kernel_info(kernel).name << "\n"
            << text_of(*made);
        if (seed == 1 && k == 0) {
          EXPECT_EQ(check_methods(*seen), "");
        }
        ++compared;
        if (lit > 0 && lit < 1) ++partly;
        if (HasFailure()) return;
      }
    }
  }
  EXPECT_GE(compared, kEnough / 2);
  EXPECT_GE(partly, 1u);
  EXPECT_GE(cut, 1u);
}

INSTANTIATE_TEST_SUITE_P(Families, VisibleLightScene, testing::ValuesIn(fuzz::area_families()),
                         [](const auto& info) { return info.param.name; });

Scene lit_room() {
  ScenePen pen;
  pen.polygon({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}});
  pen.polygon({{1, 1, 2}, {1, 3, 2}, {2, 3, 2}, {2, 1, 2}});  // looks down
  pen.panel({{0, 0, 4}, {0, 4, 4}, {4, 4, 4}, {4, 0, 4}});
  Scene scene = pen.take();
  scene.lights[0].id = "panel";
  return scene;
}

TEST(VisibleLightSceneOf, AShadeThatLooksAwayFromTheLightHidesNothing) {
  // From the middle of the floor the shade at half the height hides twice its extent of the panel:
  // x in [0, 2], y in [0, 4], half of it. It looks down here, away from the light: nothing.
  const Position middle{Number(2.0), Number(2.0), Number(0.0)};
  Scene scene = lit_room();
  for (const bool looks_up : {false, true}) {
    if (looks_up) std::ranges::reverse(scene.polygons[1].loop);
    const auto made = visible_light_scene(scene, {{}, middle, {}, Side::kFront});
    ASSERT_TRUE(made) << to_string(made.error());
    const auto seen = Case::make(*made);
    ASSERT_TRUE(seen);
    EXPECT_EQ(lit_share(*seen, KernelId::kPlane, {MethodId::kSectors, {}}),
              looks_up ? mpq_class(1, 2) : mpq_class(1));
  }
}

TEST(VisibleLightSceneOf, WhatCastsNothingIsLeftOutAndIdsStayUnique) {
  Scene scene = lit_room();
  scene.polygons[0].casts = false;
  scene.polygons[1].id = "panel";
  const auto seen = visible_light_scene(scene, {"panel", scene.vertices[0], {}, Side::kFront});
  ASSERT_TRUE(seen);
  ASSERT_EQ(seen->polygons.size(), 2u);
  EXPECT_EQ(seen->polygons[0].id, "panel-light");
  EXPECT_EQ(seen->polygons[1].id, "panel");
}

TEST(VisibleLightSceneOf, LightsThatAreNone) {
  Scene scene = lit_room();
  const auto error_of = [&](const std::string& id, const std::string& receiver = {}) {
    const auto seen = visible_light_scene(scene, {id, scene.vertices[0], receiver, Side::kFront});
    return seen ? std::string("none") : to_string(seen.error());
  };
  EXPECT_THAT(error_of("lamp"), HasSubstr("no light 'lamp'"));
  EXPECT_THAT(error_of("panel", "cupboard"), HasSubstr("no polygon 'cupboard'"));
  scene.vertices[0][2] = Number(0.5);
  EXPECT_THAT(error_of("panel", "0"), HasSubstr("'0' is not planar"));
  scene.lights.push_back(scene.lights[0]);
  scene.lights.back().id = "second";
  EXPECT_THAT(error_of(""), HasSubstr("one of: panel, second"));
  scene.lights[0].type = LightType::kPoint;
  EXPECT_THAT(error_of("panel"), HasSubstr("'panel' is no area light"));
  EXPECT_EQ(error_of(""), "none");
}

}  // namespace
}  // namespace gnomon::test
