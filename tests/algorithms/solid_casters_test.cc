// SPDX-License-Identifier: GPL-3.0-or-later
// Closed convex solids that cast as wholes: fewer planes, the same classes, also where solids
// touch, share planes with receivers, and go through each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "exact_check.h"
#include "gnomon/oracle/witness_check.h"
#include "scene/base/random.h"
#include "witness_check.h"

namespace gnomon::test {
namespace {

void add_box(Scene& scene, const std::string& id, const std::array<std::int64_t, 6>& at) {
  const auto first = static_cast<VertexId>(scene.vertices.size());
  for (int i = 0; i < 8; ++i) {
    scene.vertices.push_back({Number(static_cast<double>(at[i & 1 ? 3 : 0])),
                              Number(static_cast<double>(at[i & 2 ? 4 : 1])),
                              Number(static_cast<double>(at[i & 4 ? 5 : 2]))});
  }
  constexpr std::array<std::array<VertexId, 4>, 6> kFaces = {
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (std::size_t f = 0; f < kFaces.size(); ++f) {
    Polygon& polygon = scene.polygons.emplace_back();
    polygon.id = id + std::to_string(f);
    for (const VertexId v : kFaces[f]) polygon.loop.push_back(first + v);
  }
}

Scene with_lights(Scene scene) {
  Light& lamp = scene.lights.emplace_back();
  lamp.id = "lamp";
  lamp.position = {Number(3.0), Number(5.0), Number(11.0)};
  Light& sun = scene.lights.emplace_back();
  sun.id = "sun";
  sun.type = LightType::kDirectional;
  sun.position = {Number(2.0), Number(1.0), Number(3.0)};
  Light& inside = scene.lights.emplace_back();
  inside.id = "inside";
  inside.position = {Number(1.5), Number(1.5), Number(0.5)};
  return scene;
}

ShadowOptions by(MethodId method, CastersAre casters, KernelId kernel = KernelId::kPlane) {
  ShadowOptions options = options_for(kernel);
  options.method.point = method;
  options.method.options.casters = casters;
  return options;
}
ShadowOptions by_receiver(CastersAre casters) { return by(MethodId::kReceiver, casters); }

TEST(SolidCasters, ACubeHasNinePlanes) {
  Scene scene;
  add_box(scene, "box", {0, 0, 0, 1, 1, 1});
  add_box(scene, "floor", {-8, -8, -1, 9, 9, 0});
  scene.lights.emplace_back();
  scene.lights[0].id = "lamp";
  scene.lights[0].position = {Number(3.0), Number(4.0), Number(5.0)};
  const auto own = Case::make(scene);
  const auto polygons = compute_shadows(own->prepared(), by_receiver(CastersAre::kPolygons));
  const auto solids = compute_shadows(own->prepared(), by_receiver(CastersAre::kSolids));
  ASSERT_TRUE(polygons && solids);
  const WorkCounts &few = solids->lights[0].work, &many = polygons->lights[0].work;
  EXPECT_EQ(few[Counter::kSolids], 2u);
  EXPECT_EQ(few[Counter::kVolumes], 2u);
  // The box shows three faces, the floor its top alone.
  EXPECT_EQ(few[Counter::kVolumePlanes], 9u + 5u);
  EXPECT_EQ(many[Counter::kVolumePlanes], 15u + 5u);
  for (std::size_t i = 0; i < solids->lights[0].parts.size(); ++i) {
    EXPECT_EQ(solids->lights[0].exact_fractions[i].lit, polygons->lights[0].exact_fractions[i].lit);
  }
}

/// On a small lattice boxes touch, share planes and go through each other.
Scene boxes(std::uint64_t seed) {
  Random random(seed);
  Scene scene;
  for (int i = 0; i < 4; ++i) {
    std::array<std::int64_t, 6> at{};
    for (std::size_t k = 0; k < 3; ++k) {
      at[k] = random.between(0, 4);
      at[k + 3] = at[k] + random.between(1, 3);
    }
    add_box(scene, std::string(1, static_cast<char>('a' + i)), at);
  }
  add_box(scene, "floor", {-6, -6, -1, 12, 12, 0});
  if (seed % 3 == 0) scene.polygons[seed % 24].casts = false;
  if (seed % 4 == 0) scene.two_sided = true;
  return with_lights(std::move(scene));
}

TEST(SolidCasters, SameClassesInContactAndPenetration) {
  std::size_t sets = 0;
  for (std::uint64_t seed = 0; seed < 25; ++seed) {
    const auto own = Case::make(boxes(seed));
    ASSERT_TRUE(own);
    SCOPED_TRACE("seed " + std::to_string(seed) + "\n" + text_of(own->scene()));
    const auto polygons = compute_shadows(own->prepared(), by_receiver(CastersAre::kPolygons));
    const auto solids = compute_shadows(own->prepared(), by_receiver(CastersAre::kSolids));
    ASSERT_TRUE(polygons && solids);
    for (std::size_t l = 0; l < solids->lights.size(); ++l) {
      const LightResult &one = polygons->lights[l], &other = solids->lights[l];
      ASSERT_EQ(one.parts.size(), other.parts.size());
      for (std::size_t i = 0; i < one.parts.size(); ++i) {
        ASSERT_EQ(one.exact_fractions[i].lit, other.exact_fractions[i].lit) << i;
      }
      sets += other.caster_sets.size();
    }
    ASSERT_EQ(find_false_witness(*own, *solids), "");
    oracle::WitnessOptions strict;
    strict.tolerance = 0;
    const auto report =
        oracle::check_witnesses(own->scene(), own->prepared(), claims_of(*own, *solids), strict);
    ASSERT_EQ(report.violations, 0u) << report.findings.front().text;
  }
  EXPECT_GT(sets, 50u);
}

TEST(SolidCasters, OracleAgrees) {
  const auto own = Case::make(boxes(7));
  const auto solids = compute_shadows(own->prepared(), by_receiver(CastersAre::kSolids));
  ASSERT_TRUE(solids);
  EXPECT_EQ(judge(*own, *solids).verdict, oracle::Verdict::kIdentical);
}

// --- In the volume trees ---

TEST(SolidCasters, TreesHoldFewerVolumesAndNodes) {
  std::uint64_t few_nodes = 0, many_nodes = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const auto own = Case::make(boxes(seed));
    const auto polygons =
        compute_shadows(own->prepared(), by(MethodId::kMerged, CastersAre::kPolygons));
    const auto solids =
        compute_shadows(own->prepared(), by(MethodId::kMerged, CastersAre::kSolids));
    ASSERT_TRUE(polygons && solids);
    for (std::size_t l = 0; l < solids->lights.size(); ++l) {
      const WorkCounts &few = solids->lights[l].work, &many = polygons->lights[l].work;
      EXPECT_LE(few[Counter::kVolumes], many[Counter::kVolumes]);
      EXPECT_LE(few[Counter::kVolumePlanes], many[Counter::kVolumePlanes]);
      few_nodes += few[Counter::kNodes];
      many_nodes += many[Counter::kNodes];
    }
  }
  EXPECT_LT(few_nodes, many_nodes);
}

TEST(SolidCasters, TreesAgreeWithTheOracleOnExactKernels) {
  std::size_t sets = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const auto own = Case::make(boxes(seed));
    ASSERT_TRUE(own);
    SCOPED_TRACE("seed " + std::to_string(seed) + "\n" + text_of(own->scene()));
    const auto polygons = compute_shadows(own->prepared(), by_receiver(CastersAre::kPolygons));
    for (const KernelId kernel : kExactKernels) {
      for (const bool interleaved : {false, true}) {
        ShadowOptions options = by(MethodId::kMerged, CastersAre::kSolids, kernel);
        options.method.options.interleaved = interleaved;
        options.output.combined = seed % 3 == 0;
        const auto solids = compute_shadows(own->prepared(), options);
        ASSERT_TRUE(solids) << to_string(solids.error());
        for (std::size_t l = 0; l < solids->lights.size(); ++l) {
          const LightResult &one = polygons->lights[l], &other = solids->lights[l];
          for (std::size_t i = 0; i < one.parts.size(); ++i) {
            ASSERT_EQ(one.exact_fractions[i].lit, other.exact_fractions[i].lit) << i;
          }
          sets += other.caster_sets.size();
        }
        ASSERT_EQ(find_false_witness(*own, *solids), "");
        if (kernel != KernelId::kPlane) continue;
        ASSERT_EQ(judge(*own, *solids).verdict, oracle::Verdict::kIdentical);
      }
    }
  }
  EXPECT_GT(sets, 50u);
}

}  // namespace
}  // namespace gnomon::test
