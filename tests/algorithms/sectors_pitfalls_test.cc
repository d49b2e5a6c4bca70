// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes made to trip the sectors algorithm: vertices and edges on the planes between its sectors,
// rooms that hide everything outside, many polygons at one projected point or line, stacks of
// nearly coincident borders, long crossing sticks, polygons seen edge-on. By definition, by the
// oracle, or by SVBSP.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "exact_check.h"
#include "fuzz/generate/scene_pen.h"
#include "gnomon/scene/generate.h"
#include "scene/base/random.h"
#include "witness_check.h"

namespace gnomon::test {
namespace {

using namespace fuzz;  // families and pens

/// Sectors with several sizes of cells against SVBSP, exactly; witnesses of the first.
void expect_agreement(Scene made) {
  std::string why;
  const auto scene = Case::make(std::move(made), &why);
  ASSERT_TRUE(scene) << why;
  ShadowOptions options = options_for(KernelId::kPlane);
  options.output.exact_points = false;
  options.method.point = MethodId::kSvbsp;
  const std::vector<mpq_class> svbsp = lit_fractions(*scene, options);
  options.method.point = MethodId::kSectors;
  for (const std::uint32_t leaf_size : {16u, 4u, 1u}) {
    options.tuning.leaf_size = leaf_size;
    options.tuning.task_size = leaf_size == 4 ? 1 : 0;
    ASSERT_EQ(lit_fractions(*scene, options), svbsp) << "leaves of " << leaf_size;
  }
  options.output.exact_points = true;
  const Expected<ShadowResult> result = compute_shadows(scene->prepared(), options);
  ASSERT_TRUE(result);
  EXPECT_EQ(find_false_witness(*scene, *result), "");
}

// --- The planes between the sectors ---

/// Points of few directions from the origin, so that vertices and edges lie in x = +-y, x = +-z,
/// y = +-z and on their lines.
Triple diagonal_point(Random& random) {
  const std::int64_t size = random.between(1, 4);
  Triple p{};
  for (std::int64_t& x : p) x = size * random.between(-1, 1);
  return p;
}

Scene diagonal_scene(std::uint64_t seed, int count) {
  Random random(seed);
  ScenePen pen;
  for (int i = 0; i < count;) {
    const Triple a = diagonal_point(random), b = diagonal_point(random), c = diagonal_point(random);
    if (is_zero(cross(b - a, c - a))) continue;
    pen.two_sided(random.chance(3, 4)).casts(!random.chance(1, 8)).polygon({a, b, c});
    ++i;
  }
  pen.lamp({0, 0, 0});
  if (random.chance(1, 2)) pen.lamp(diagonal_point(random));
  if (random.chance(1, 3)) pen.sun({1, random.between(-1, 1), random.between(-1, 1)});
  return pen.take();
}

TEST(SectorPlanes, HoldVerticesAndEdges) {
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    const auto scene = Case::make(diagonal_scene(seed, 2 + static_cast<int>(seed % 7)));
    ASSERT_TRUE(scene);
    ASSERT_EQ(check_exact(*scene), "") << seed << "\n" << text_of(scene->scene());
  }
}

TEST(SectorPlanes, HoldVerticesAndEdgesOfMany) {
  for (std::uint64_t seed = 1000; seed < 1004; ++seed) expect_agreement(diagonal_scene(seed, 90));
}

TEST(SectorPlanes, CutPolygonsAroundTheLamp) {
  // Three large squares around the lamp, nested, each cut by all planes between the sectors.
  ScenePen pen;
  pen.two_sided(true);
  for (const std::int64_t k : {2, 3, 5}) pen.box({-k, -k, -k}, {k, k, k}, true);
  pen.polygon({{-9, -9, -1}, {9, -9, -1}, {9, 9, -1}, {-9, 9, -1}});
  pen.polygon({{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}});
  pen.lamp({0, 0, 0});
  const auto scene = Case::make(pen.take());
  ASSERT_TRUE(scene);
  EXPECT_EQ(check_exact(*scene), "");
}

// --- Occlusion ---

Scene closed_room(bool lamp_inside, std::int64_t outside) {
  Random random(7);
  ScenePen pen;
  pen.two_sided(true).box({-10, -10, -10}, {10, 10, 10}, true);
  pen.polygon({{-3, -3, -5}, {3, -3, -5}, {3, 3, -5}, {-3, 3, -5}});
  for (std::int64_t i = 0; i < outside; ++i) {
    Triple p{};
    const auto far = static_cast<std::size_t>(random.below(3));
    for (std::int64_t& x : p) x = random.between(-60, 60);
    p[far] = (random.chance(1, 2) ? 1 : -1) * random.between(20, 60);
    Triple u{}, v{};
    while (is_zero(cross(u, v))) {
      for (std::int64_t& x : u) x = random.between(-5, 5);
      for (std::int64_t& x : v) x = random.between(-5, 5);
    }
    // In front of the room's walls as seen from the room: all of it is outside.
    pen.polygon({p, p + u, p + u + v, p + v});
  }
  pen.lamp(lamp_inside ? Triple{1, 2, 3} : Triple{70, 75, 80});
  return pen.take();
}

TEST(Occlusion, ClosedRoomHidesAllThatIsOutside) {
  const auto scene = Case::make(closed_room(true, 900));
  ASSERT_TRUE(scene);
  ASSERT_GT(scene->prepared().parts.size(), 900u);
  for (const std::uint32_t leaf_size : {16u, 1u}) {
    ShadowOptions options = options_for(KernelId::kPlane);
    options.method.point = MethodId::kSectors;
    options.tuning.leaf_size = leaf_size;
    const Expected<ShadowResult> result = compute_shadows(scene->prepared(), options);
    ASSERT_TRUE(result);
    const LightResult& light = result->lights[0];
    std::size_t facing = 0;
    for (std::uint32_t i = 7; i < light.parts.size(); ++i) {
      ASSERT_EQ(light.exact_fractions[i].lit, 0) << i;
      ASSERT_EQ(light.parts[i].lit.upper, 0) << i;
      facing += light.parts[i].reason == ShadowReason::kNone ? 1 : 0;
    }
    EXPECT_GT(facing, 800u);
    EXPECT_EQ(find_false_witness(*scene, *result), "");
    // Hidden parts leave early: whole, or in few pieces.
    EXPECT_LT(light.fragment_total, 4 * light.parts.size());
  }
}

TEST(Occlusion, RoomSeenFromOutside) { expect_agreement(closed_room(false, 300)); }

TEST(Occlusion, LampInTheInnermostOfNestedBoxes) {
  ScenePen pen;
  pen.two_sided(true);
  for (std::int64_t k = 60; k >= 1; --k) pen.box({-k, -k, -k}, {k, k, k}, k % 2 == 0);
  pen.lamp({0, 0, 0});
  const auto scene = Case::make(pen.take());
  ASSERT_TRUE(scene);
  for (const MethodId algorithm : kAlgorithms) {
    ShadowOptions options = options_for(KernelId::kPlane);
    options.method.point = algorithm;
    const Expected<ShadowResult> result = compute_shadows(scene->prepared(), options);
    ASSERT_TRUE(result);
    const std::size_t n = result->lights[0].parts.size();
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_EQ(result->lights[0].exact_fractions[i].lit, i + 6 >= n ? 1 : 0) << i;
    }
    EXPECT_EQ(find_false_witness(*scene, *result), "");
  }
}

// --- Many polygons at one point or line ---

/// n triangles, the k-th at depth k, all with a vertex on one line through the lamp (or parallel to
/// the sun), and with few directions of the others.
Scene one_projected_point(std::int64_t n, bool sun) {
  Random random(11);
  ScenePen pen;
  for (std::int64_t k = 1; k <= n; ++k) {
    const std::int64_t scale = sun ? 1 : k;
    Triple u{}, v{};
    while (u[0] * v[1] - u[1] * v[0] <= 0) {
      u = {random.between(-3, 3), random.between(-3, 3), 0};
      v = {random.between(-3, 3), random.between(-3, 3), 0};
    }
    const Triple tip{0, 0, -k};
    pen.casts(k % 9 != 0).polygon({tip, tip + scale * u, tip + scale * v});
  }
  const std::int64_t m = sun ? 4 : 4 * (n + 1);
  pen.polygon({{-m, -m, -n - 1}, {m, -m, -n - 1}, {m, m, -n - 1}, {-m, m, -n - 1}});
  if (sun) {
    pen.sun({0, 0, 1});
  } else {
    pen.lamp({0, 0, 0});
  }
  return pen.take();
}

TEST(OneProjectedPoint, AllDepthsFromALamp) { expect_agreement(one_projected_point(200, false)); }
TEST(OneProjectedPoint, AllDepthsFromTheSun) { expect_agreement(one_projected_point(200, true)); }

/// Tiny triangles at many depths, all within a hair around one direction: no box in floats tells
/// them apart.
TEST(OneProjectedPoint, WithinTheNoiseOfABox) {
  Random random(12);
  ScenePen pen;
  const std::int64_t one = std::int64_t{1} << 40;
  for (std::int64_t k = 1; k <= 120; ++k) {
    const auto at = [&] {
      return Triple{k * (one / 3 + random.between(-9, 9)), k * (one / 5 + random.between(-9, 9)),
                    -k * one};
    };
    const Triple a = at(), b = at(), c = at();
    if (is_zero(cross(b - a, c - a))) continue;
    pen.two_sided(true).polygon({a, b, c});
  }
  pen.lamp({0, 0, 0}).sun({1, 1, 3});
  expect_agreement(pen.take());
}

TEST(OneProjectedLine, Fans) {
  for (const std::int64_t kind : {0, 1, 2}) {
    const Expected<Scene> scene =
        generate("radial-fan", {{"n", 150}, {"kind", kind}, {"light", 2}}, 1);
    ASSERT_TRUE(scene);
    expect_agreement(*scene);
  }
}

/// Polygons whose planes miss the lamp by a hair: each is seen as nearly a line.
TEST(OneProjectedLine, EdgeOn) {
  Random random(13);
  ScenePen pen;
  const std::int64_t one = std::int64_t{1} << 30;
  for (std::int64_t k = 1; k <= 90; ++k) {
    const std::int64_t hair = random.between(-2, 2), w = random.between(1, 4) * one;
    pen.two_sided(true).polygon(
        {{-w, hair, -k * one}, {w, hair, -k * one}, {w, hair, -(k + 5) * one}});
  }
  pen.polygon({{-9 * one, -one, -200 * one},
               {9 * one, -one, -200 * one},
               {9 * one, one, -200 * one},
               {-9 * one, one, -200 * one}});
  pen.lamp({0, 0, 0}).sun({0, 0, 1});
  expect_agreement(pen.take());
}

// --- Borders and crossings ---

TEST(NearlyCoincidentBorders, StackOfSheets) {
  Random random(14);
  ScenePen pen;
  const std::int64_t one = std::int64_t{1} << 20;
  const std::int64_t n = 30;
  for (std::int64_t k = 1; k <= n; ++k) {
    const auto border = [&] { return k * one + random.between(-3, 3); };
    const std::int64_t x0 = -border(), x1 = border(), y0 = -border(), y1 = border();
    pen.polygon({{x0, y0, -k * one}, {x1, y0, -k * one}, {x1, y1, -k * one}, {x0, y1, -k * one}});
  }
  pen.lamp({0, 0, 0}).sun({0, 0, 1});
  expect_agreement(pen.take());
}

TEST(CrossingPolygons, LongSticks) {
  const Expected<Scene> scene = generate("crossing-sticks", {{"n", 150}, {"light", 2}}, 3);
  ASSERT_TRUE(scene);
  expect_agreement(*scene);
}

TEST(CoplanarPolygons, ManyInOnePlane) {
  // Overlapping and doubled, two-sided, some that do not cast, lit through each other.
  Random random(15);
  ScenePen pen;
  std::vector<Triple> last;
  for (int i = 0; i < 250; ++i) {
    const std::int64_t x = random.between(0, 20), y = random.between(0, 20),
                       z = 3 * random.between(0, 1), w = random.between(1, 8),
                       h = random.between(1, 8);
    std::vector<Triple> loop = {{x, y, z}, {x + w, y, z}, {x + w, y + h, z}, {x, y + h, z}};
    for (Triple& p : loop) p[2] += p[0] - p[1];
    if (i % 10 == 9) loop = last;
    last = loop;
    pen.two_sided(random.chance(1, 2)).casts(!random.chance(1, 6)).polygon(loop);
  }
  pen.lamp({7, 9, 40}).sun({1, 2, 9}).lamp({5, 5, -40});
  expect_agreement(pen.take());
}

}  // namespace
}  // namespace gnomon::test
