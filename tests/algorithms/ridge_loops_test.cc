// SPDX-License-Identifier: GPL-3.0-or-later
// Loops of ridge edges: of shapes whose loops are known, and on random solids by what must hold of
// their areas: all loops add up to all facing polygons, and external less hole loops are the shadow
// on a floor, as the exact kernels find it.
#include "gnomon/algorithms/ridge_loops.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "algorithms/ridge_edges/loop_depth.h"
#include "exact_check.h"
#include "gnomon/algorithms/components.h"
#include "scene/base/random.h"
#include "scene/base/vectors.h"
#include "solid_cells.h"

namespace gnomon {
namespace {

using test::Case;
using test::Cell;
using test::Cells;
using test::doubled_area;
using test::lamp;
using test::random_cells;
using test::random_map;
using test::same;
using test::shadow_of;
using test::steep_light;
using test::sun;
using test::Whole;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<RidgeLoops> loops_of(const Case& scene,
                                 OpenComponents open = OpenComponents::kRefused) {
  auto loops = ridge_loops(scene.scene(), scene.prepared(), 0, open);
  EXPECT_TRUE(loops) << to_string(loops.error());
  return loops ? *std::move(loops) : std::vector<RidgeLoops>();
}

std::vector<RidgeLoops> loops_of(Scene scene, const Light& light,
                                 OpenComponents open = OpenComponents::kRefused) {
  scene.lights = {light};
  const auto prepared = Case::make(scene);
  EXPECT_TRUE(prepared);
  return loops_of(*prepared, open);
}

std::size_t count(const RidgeLoops& loops, LoopKind kind) {
  return static_cast<std::size_t>(std::ranges::count(loops.loops, kind, &RidgeLoop::kind));
}
std::size_t count(const RidgeLoops& loops, RidgeKind kind) {
  return static_cast<std::size_t>(std::ranges::count(loops.edges, kind, &RidgeEdge::kind));
}

struct Areas {
  mpq_class all = 0, shadow = 0;  // of all loops, of external and hole loops
};

Areas areas_of(const std::vector<RidgeLoops>& components) {
  Areas areas;
  for (const RidgeLoops& loops : components) {
    for (const RidgeLoop& loop : loops.loops) {
      const mpq_class own = doubled_area(loops, loop);
      areas.all += own;
      if (loop.kind != LoopKind::kInternal) areas.shadow += own;
      EXPECT_EQ(loop.kind == LoopKind::kHole, own < 0 && loop.depth == 1);
    }
  }
  return areas;
}

/// Of all facing parts, by their own loops.
mpq_class facing_area(const Case& scene, const std::vector<RidgeLoops>& components) {
  const PreparedScene& prepared = scene.prepared();
  const LightDirections directions(prepared.geometry, prepared.lights[0].point);
  const auto solids = find_components(prepared);
  mpq_class sum = 0;
  for (const RidgeLoops& loops : components) {
    for (const std::uint32_t part : solids[loops.component].parts) {
      std::vector<std::array<mpz_class, 3>> rays;
      for (const VertexId vertex : prepared.loop(prepared.parts[part])) {
        rays.push_back(directions.exported(directions.of[vertex].exact));
      }
      // Those that look away are clockwise.
      if (const mpq_class own = doubled_area(rays); own > 0) sum += own;
    }
  }
  return sum;
}

/// At each stretch of a loop the depth rises to the loop's, and each edge is walked from its start
/// to its end, once, but for what was cancelled.
void expect_whole(const Case& scene, const std::vector<RidgeLoops>& components) {
  const PreparedScene& prepared = scene.prepared();
  const LightDirections directions(prepared.geometry, prepared.lights[0].point);
  std::vector<Side> facing(prepared.parts.size(), Side::kOn);
  for (std::uint32_t i = 0; i < facing.size(); ++i) {
    std::vector<std::array<mpz_class, 3>> rays;
    for (const VertexId vertex : prepared.loop(prepared.parts[i])) {
      rays.push_back(directions.of[vertex].exact);
    }
    const mpz_class turn = dot(rays[0], cross(rays[1], rays[2]));
    if (turn > 0) facing[i] = Side::kFront;
  }
  const auto solids = find_components(prepared);
  for (const RidgeLoops& loops : components) {
    const FacingCones cones(prepared, solids[loops.component].parts, facing, directions.of);
    std::size_t steps = 0;
    for (const RidgeLoop& loop : loops.loops) {
      steps += loop.steps.size();
      for (std::size_t i = 0; i < loop.steps.size(); ++i) {
        const LoopStep &step = loop.steps[i],
                       &next = loop.steps[i + 1 == loop.steps.size() ? 0 : i + 1];
        const auto back = [&](std::uint32_t index) {
          auto ray = loops.rays[index];
          ray[2] *= directions.unit;
          return ray;
        };
        const auto from = back(step.ray), to = back(next.ray);
        // Where several run along one another the depth changes by as many.
        EXPECT_GE(cones.depth_left_of(from, to), loop.depth);
        EXPECT_LT(cones.depth_left_of(to, from), loop.depth);
        // Going on along the edge is no jump.
        if (step.edge == next.edge) {
          EXPECT_FALSE(next.imaginary);
        }
      }
    }
    if (loops.cancelled == 0) {
      EXPECT_GE(steps, loops.edges.size());
    }
  }
}

TEST(RidgeLoops, OfABoxIsItsOutline) {
  Cells box;
  box.add({0, 0, 0});
  const auto loops = loops_of(box.surface(same), sun({1, 2, 3}));
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_EQ(loops[0].facing_parts, 3u);
  EXPECT_EQ(count(loops[0], RidgeKind::kVisible), 6u);
  EXPECT_EQ(count(loops[0], RidgeKind::kHidden), 0u);
  ASSERT_EQ(loops[0].loops.size(), 1u);
  EXPECT_EQ(loops[0].loops[0].kind, LoopKind::kExternal);
  EXPECT_EQ(loops[0].loops[0].steps.size(), 6u);
  EXPECT_TRUE(loops[0].crossings.empty());
}

TEST(RidgeLoops, OfASmallBlockOnALargeOneAreTwo) {
  // Its shadow lies on the large block: a loop of its own, and wholly internal, though half of its
  // edges are VREs.
  Cells blocks;
  blocks.add_box({0, 0, 0}, {7, 7, 1});
  blocks.add_box({3, 3, 1}, {4, 4, 2});
  const auto loops = loops_of(blocks.surface(same), sun({1, 1, 2}));
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_EQ(count(loops[0], LoopKind::kExternal), 1u);
  EXPECT_EQ(count(loops[0], LoopKind::kInternal), 1u);
  EXPECT_EQ(count(loops[0], RidgeKind::kHidden), 2u);  // where the block's far sides stand
  EXPECT_TRUE(loops[0].crossings.empty());
}

TEST(RidgeLoops, OfABlockWhoseShadowLeavesTheOtherCross) {
  Cells blocks;
  blocks.add_box({0, 0, 0}, {7, 7, 1});
  blocks.add_box({0, 3, 1}, {1, 4, 5});
  Scene scene = blocks.surface([](const Whole& p) {
    return Whole{16 * p[0], 16 * p[1], 16 * p[2]};
  });
  const auto loops = loops_of(scene, sun({3, 1, 2}));
  ASSERT_EQ(loops.size(), 1u);
  ASSERT_FALSE(loops[0].crossings.empty());
  for (const PseudoIntersection& crossing : loops[0].crossings) {
    EXPECT_NE(crossing.nearer, PseudoIntersection::kTouch);
  }
  EXPECT_EQ(count(loops[0], LoopKind::kExternal), 1u);
  const bool jumps = std::ranges::any_of(loops[0].loops, [](const RidgeLoop& loop) {
    return std::ranges::any_of(loop.steps, &LoopStep::imaginary);
  });
  EXPECT_TRUE(jumps);
}

TEST(RidgeLoops, OfAFrameHaveAHole) {
  Cells frame;
  frame.add_box({0, 0, 0}, {5, 5, 1});
  for (int x = 1; x < 4; ++x) {
    for (int y = 1; y < 4; ++y) frame.remove({x, y, 0});
  }
  for (const Light& light : {sun({1, 0, 4}), lamp({2, 2, 30})}) {
    const auto loops = loops_of(frame.surface(same), light);
    ASSERT_EQ(loops.size(), 1u);
    EXPECT_EQ(count(loops[0], LoopKind::kExternal), 1u);
    EXPECT_EQ(count(loops[0], LoopKind::kHole), 1u);
    EXPECT_EQ(loops[0].loops.size(), 2u);
  }
}

TEST(RidgeLoops, OfARoomAroundTheLampIsNone) {
  Scene room = [] {
    Cells box;
    box.add_box({0, 0, 0}, {3, 3, 3});
    box.remove({1, 1, 1});
    return box.surface(same);
  }();
  // Half units: the lamp is in the middle of the cell that is missing.
  for (Position& vertex : room.vertices) {
    for (Number& c : vertex) c = Number(2 * c.nearest());
  }
  const auto loops = loops_of(room, lamp({3, 3, 3}));
  ASSERT_EQ(loops.size(), 1u);  // the walls of the cell; the outside looks away
  EXPECT_EQ(loops[0].facing_parts, 6u);
  EXPECT_TRUE(loops[0].edges.empty());
  EXPECT_TRUE(loops[0].loops.empty());
}

TEST(RidgeLoops, OfAWindowAroundTheLampIsAHole) {
  // A shell around the lamp with one way out: light passes through one hole, and there is no
  // outside to be external to.
  Cells shell;
  shell.add_box({0, 0, 0}, {5, 5, 5});
  for (int x = 1; x < 4; ++x) {
    for (int y = 1; y < 4; ++y) {
      for (int z = 1; z < 4; ++z) shell.remove({x, y, z});
    }
  }
  shell.remove({2, 2, 4});
  Scene scene = shell.surface([](const Whole& p) { return Whole{2 * p[0], 2 * p[1], 2 * p[2]}; });
  const auto loops = loops_of(scene, lamp({5, 5, 5}));
  ASSERT_EQ(loops.size(), 1u);
  ASSERT_EQ(loops[0].loops.size(), 1u);
  EXPECT_EQ(loops[0].loops[0].kind, LoopKind::kHole);
}

TEST(RidgeLoops, OpenComponentsAreRefusedUnlessAllowed) {
  Cells box;
  box.add({0, 0, 0});
  Scene scene = box.surface(same);
  scene.polygons.pop_back();
  scene.lights = {sun({1, 2, 3})};
  const auto open = Case::make(scene);
  ASSERT_TRUE(open);
  const auto refused = ridge_loops(open->scene(), open->prepared(), 0);
  ASSERT_FALSE(refused);
  EXPECT_THAT(to_string(refused.error()), HasSubstr("has no partner"));
  const auto loops = loops_of(*open, OpenComponents::kAllowed);
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_GT(count(loops[0], RidgeKind::kBorder), 0u);
  EXPECT_EQ(areas_of(loops).all, facing_area(*open, loops));
}

TEST(RidgeLoops, AreaLightsAreRefused) {
  Cells box;
  box.add({0, 0, 0});
  Scene scene = box.surface(same);
  Light panel;
  panel.id = "panel";
  panel.type = LightType::kArea;
  panel.loop = {test::at({0, 0, 9}), test::at({0, 1, 9}), test::at({1, 1, 9})};
  scene.lights = {panel};
  const auto lit = Case::make(scene);
  ASSERT_TRUE(lit);
  const auto refused = ridge_loops(lit->scene(), lit->prepared(), 0);
  ASSERT_FALSE(refused);
  EXPECT_THAT(to_string(refused.error()), HasSubstr("'panel' has an area"));
}

class RidgeLoopsOfSolids : public testing::TestWithParam<bool> {};

TEST_P(RidgeLoopsOfSolids, AreasAreThoseOfPolygonsAndShadows) {
  std::size_t crossings = 0, holes = 0, internal = 0, cancelled = 0, reflex = 0;
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    Random random(seed);
    const Cells cells = random_cells(random);
    Scene scene = cells.surface(random_map(random, GetParam()));
    scene.lights = {steep_light(random)};
    const auto solid = Case::make(scene);
    ASSERT_TRUE(solid);
    const auto loops = loops_of(*solid);
    const Areas areas = areas_of(loops);
    EXPECT_EQ(areas.all, facing_area(*solid, loops)) << "seed " << seed;
    expect_whole(*solid, loops);
    for (const RidgeLoops& own : loops) {
      crossings += own.crossings.size();
      holes += count(own, LoopKind::kHole);
      internal += count(own, LoopKind::kInternal);
      cancelled += own.cancelled;
      reflex += count(own, RidgeKind::kHidden);
      EXPECT_LE(own.pairs, own.all_pairs());
    }
    if (loops.size() == 1) {
      EXPECT_EQ(areas.shadow, shadow_of(scene)) << "seed " << seed;
    }
    if (HasFailure()) break;
  }
  EXPECT_GT(crossings, 100u);
  EXPECT_GT(holes, 0u);
  EXPECT_GT(internal, 50u);
  EXPECT_GT(reflex, 100u);
  if (!GetParam()) {
    EXPECT_GT(cancelled, 0u);
  }
}

INSTANTIATE_TEST_SUITE_P(Cells, RidgeLoopsOfSolids, testing::Bool(),
                         [](const auto& info) { return info.param ? "sheared" : "on_a_lattice"; });

}  // namespace
}  // namespace gnomon
