// SPDX-License-Identifier: GPL-3.0-or-later
// The method `contour` beside sectors: polygons of many corners, lamps inside scenes, scales and
// places far out, all recorded scenes; and that neither threads nor a second light change a bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "exact_check.h"
#include "fuzz/generate/generator.h"
#include "fuzz/generate/scene_pen.h"
#include "gnomon/scene/generate.h"
#include "gnomon/scene/read.h"
#include "scene/base/random.h"

namespace gnomon::test {
namespace {

using fuzz::ScenePen;
using fuzz::Triple;
using fuzz::operator+;

/// A convex polygon of n corners on two parabolas, in a plane of any slope.
std::vector<Triple> blade(int n, Random& random) {
  const auto any = [&](std::int64_t most) {
    return static_cast<std::int64_t>(random.next() % static_cast<std::uint64_t>(2 * most + 1)) -
           most;
  };
  const std::int64_t slope_x = any(2), slope_y = any(2), low = any(40);
  const Triple move{any(400), any(400), 0};
  const bool turned = random.next() % 2 == 0;
  std::vector<Triple> loop;
  const auto put = [&](std::int64_t x, std::int64_t y) {
    if (turned) std::swap(x, y);
    x += move[0];
    y += move[1];
    loop.push_back({x, y, 20 * low + slope_x * x + slope_y * y});
  };
  const int below = n / 2 + n % 2, above = n / 2;
  // y = x^2 from left to right, then a flatter arc back.
  for (int i = 0; i < below; ++i) put(8 * i, i * i);
  const std::int64_t last = 8 * (below - 1), height = std::int64_t{below} * below + above * above;
  for (int i = above - 1; i >= 0; --i) {
    const std::int64_t x = above == 1 ? last / 2 : last * i / (above - 1);
    put(x, height - (i - above / 2) * (i - above / 2));
  }
  if (turned) std::ranges::reverse(loop);
  return loop;
}

TEST(Contour, PolygonsOfManyCorners) {
  for (const int corners : {5, 6, 7, 8, 9, 12, 13, 16, 17, 31, 64, 100}) {
    Random random(static_cast<std::uint64_t>(corners));
    const int scenes = corners > 20 ? 2 : 6;
    for (int i = 0; i < scenes; ++i) {
      ScenePen pen;
      pen.two_sided(i % 2 == 0);
      for (int k = 0; k < 6; ++k) pen.polygon(blade(k % 3 == 2 ? 5 : corners, random));
      pen.sun({1, 2, 30}).sun({0, 0, 1}).lamp({40, 30, 5000}).lamp({100, -100, 700});
      const auto scene = Case::make(pen.take());
      ASSERT_TRUE(scene) << corners;
      ASSERT_EQ(check_contour(*scene), "") << corners << '\n' << text_of(scene->scene());
    }
  }
}

/// Two sheets cross a third one in one line, which is the edge of yet another in the plane of the
/// nearer of the two: the crease with that one is the border, whichever comes first.
TEST(Contour, CreasesInOneLine) {
  std::vector<std::vector<Triple>> sheets = {
      {{32, 0, 0}, {0, 16, 0}, {0, 32, 0}, {32, 16, 0}},
      {{0, 0, 32}, {16, 32, 0}, {48, 32, -32}, {32, 0, 0}},
      {{0, 64, 0}, {-16, 80, 16}, {-16, 64, 32}, {0, 32, 32}, {32, 0, 0}},
      {{0, 32, 32}, {64, -32, -32}, {8, 32, 16}}};
  std::ranges::sort(sheets);
  do {
    ScenePen pen;
    pen.two_sided(true);
    for (const std::vector<Triple>& sheet : sheets) pen.polygon(sheet);
    pen.lamp({-5, 48, 27});
    const auto scene = Case::make(pen.take());
    ASSERT_TRUE(scene);
    ASSERT_EQ(check_contour(*scene), "") << text_of(scene->scene());
  } while (std::ranges::next_permutation(sheets).found);
}

/// Of three casters behind an edge the bounds leave open who of the first two is nearer. The third
/// is known to be before the one and behind the other, which must not be passed over.
TEST(Contour, TopWhereAnOrderIsOpen) {
  const auto generator = fuzz::Generator::parse("family-needles");
  ASSERT_TRUE(generator);
  const auto scene = Case::make(generator->make(214).scene);
  ASSERT_TRUE(scene);
  EXPECT_EQ(check_contour(*scene), "") << text_of(scene->scene());
}

/// A stretch that may be there or not, between the plane of another polygon and its edge: where its
/// ends are found each by itself from sharper values, what is on both sides of it overlaps.
TEST(Contour, StretchesThatMayHaveNoLength) {
  const auto generator = fuzz::Generator::parse("mix");
  ASSERT_TRUE(generator);
  for (const std::uint64_t seed : {20405075u, 20984103u}) {
    const auto scene = Case::make(generator->make(seed).scene);
    ASSERT_TRUE(scene);
    EXPECT_EQ(check_contour(*scene), "") << text_of(scene->scene());
  }
}

/// Boxes around a lamp, and a room around all of it: polygons on all sides of the light.
TEST(Contour, LampsInsideScenes) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Random random(seed);
    const auto any = [&](std::int64_t low, std::int64_t high) {
      return low +
             static_cast<std::int64_t>(random.next() % static_cast<std::uint64_t>(high - low + 1));
    };
    ScenePen pen;
    pen.box({-20, -20, -20}, {20, 20, 20}, true);
    for (int k = 0; k < 7; ++k) {
      const Triple low{any(-18, 12), any(-18, 12), any(-18, 12)};
      pen.box(low, low + Triple{any(1, 6), any(1, 6), any(1, 6)});
    }
    pen.lamp({0, 0, 0}).lamp({any(-15, 15), any(-15, 15), any(-15, 15)}).lamp({-20, 3, 3});
    const auto scene = Case::make(pen.take());
    ASSERT_TRUE(scene) << seed;
    ASSERT_EQ(check_contour(*scene), "") << "seed " << seed << '\n' << text_of(scene->scene());
  }
}

TEST(Contour, FamiliesOfTheGenerator) {
  using Parameters = std::map<std::string, std::int64_t>;
  const std::vector<std::pair<const char*, Parameters>> families = {
      {"city", {{"n", 12}, {"light", 2}}},
      {"city", {{"n", 12}, {"inside", 1}}},
      {"quads", {{"n", 60}}},
      {"lattice", {{"n", 40}, {"light", 2}}},
      {"coplanar-tiles", {{"n", 40}, {"light", 2}}},
      {"crossing-sticks", {{"light", 2}}},
      {"grazing", {{"n", 20}, {"light", 2}}},
      {"holed-wall", {}},
      {"comb", {{"light", 2}}},
      {"room", {}}};
  for (const auto& [name, parameters] : families) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const Expected<Scene> made = generate(name, parameters, seed);
      ASSERT_TRUE(made) << to_string(made.error());
      const auto scene = Case::make(*made);
      ASSERT_TRUE(scene);
      ASSERT_EQ(check_contour(*scene), "") << name << " seed " << seed;
    }
  }
}

/// A short form of the campaigns (`gnomon fuzz --kernel plane/contour`).
class ContourCampaign : public testing::TestWithParam<const char*> {};

TEST_P(ContourCampaign, AgreesWithSectors) {
  const auto generator = fuzz::Generator::parse(GetParam());
  ASSERT_TRUE(generator);
  unsigned checked = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const auto scene = Case::make(generator->make(seed).scene);
    if (!scene) continue;
    ++checked;
    ASSERT_EQ(check_contour(*scene), "") << "seed " << seed << '\n' << text_of(scene->scene());
  }
  EXPECT_GT(checked, 100u);
}

INSTANTIATE_TEST_SUITE_P(Generators, ContourCampaign,
                         testing::Values("mix", "family-small-lattice", "soup-lattice",
                                         "family-decimals", "family-crossing-sticks",
                                         "family-needles", "family-mixed-magnitudes"),
                         [](const auto& info) {
                           std::string name(info.param);
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

TEST(Contour, AllRecordedScenes) {
  unsigned checked = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(GNOMON_REGRESSIONS)) {
    if (entry.path().extension() != ".json") continue;
    Expected<ReadResult> read = read_scene(entry.path());
    if (!read) continue;
    const auto scene = Case::make(std::move(read->scene));
    if (!scene) continue;
    ++checked;
    EXPECT_EQ(check_contour(*scene), "") << entry.path();
  }
  EXPECT_GT(checked, 150u);
}

bool same_bits(const LightResult& a, const LightResult& b) {
  return std::ranges::equal(a.parts, b.parts, [](const PartResult& p, const PartResult& q) {
    return p.part == q.part && p.side == q.side && p.reason == q.reason &&
           p.lit.lower == q.lit.lower && p.lit.upper == q.lit.upper &&
           p.shadow.lower == q.shadow.lower && p.shadow.upper == q.shadow.upper;
  });
}

void expect_same_bits(const std::string& name, int size, KernelId kernel, bool exact) {
  const Expected<Scene> made = generate(name, {{"n", size}}, 5);
  ASSERT_TRUE(made) << to_string(made.error());
  const Expected<PreparedScene> scene = prepare(*made);
  ASSERT_TRUE(scene);
  ShadowOptions options;
  options.kernel.id = kernel;
  options.method.point = MethodId::kContour;
  options.output.exact_fractions = exact;
  options.tuning.jobs = 1;
  const auto first = compute_shadows(*scene, options);
  ASSERT_TRUE(first);
  for (const unsigned jobs : {2u, 3u, 7u}) {
    options.tuning.jobs = jobs;
    const auto again = compute_shadows(*scene, options);
    ASSERT_TRUE(again);
    for (std::size_t l = 0; l < first->lights.size(); ++l) {
      EXPECT_TRUE(same_bits(first->lights[l], again->lights[l])) << name << ' ' << jobs;
      EXPECT_EQ(first->lights[l].work, again->lights[l].work) << name << ' ' << jobs;
    }
  }
}

TEST(Contour, ThreadsChangeNoBit) {
  for (const char* name : {"city", "quads", "lattice"}) {
    expect_same_bits(name, 400, KernelId::kPlane, false);
    expect_same_bits(name, 24, KernelId::kPlane, true);
    expect_same_bits(name, 400, KernelId::kDouble, false);
    expect_same_bits(name, 400, KernelId::kEpick, false);
  }
  expect_same_bits("city", 4200, KernelId::kPlane, false);  // in space order
}

void expect_lights_to_be_alone(const PreparedScene& scene) {
  ShadowOptions options;
  options.method.point = MethodId::kContour;
  const auto together = compute_shadows(scene, options);
  ASSERT_TRUE(together);
  for (std::uint32_t light = 0; light < together->lights.size(); ++light) {
    options.lights = {light};
    const auto alone = compute_shadows(scene, options);
    ASSERT_TRUE(alone);
    EXPECT_TRUE(same_bits(together->lights[light], alone->lights[0])) << light;
    EXPECT_EQ(together->lights[light].work, alone->lights[0].work) << light;
  }
}

/// What is kept from one light to the next changes nothing.
TEST(Contour, LightsDoNotKnowOfEachOther) {
  ScenePen pen;
  Random random(7);
  for (int k = 0; k < 8; ++k) pen.polygon(blade(5 + k, random));
  pen.box({-5, -5, -5}, {9, 9, 9});
  pen.sun({1, 2, 30}).lamp({2, 2, 2}).sun({0, 0, -1}).lamp({500, 1, 40}).sun({0, 0, 1});
  const auto scene = Case::make(pen.take());
  ASSERT_TRUE(scene);
  expect_lights_to_be_alone(scene->prepared());
}

/// The same of walls that stand on the ground and roofs at one height, so that integers are asked,
/// and of a scene that suns have in space order.
TEST(Contour, SunsOverACityDoNotKnowOfEachOther) {
  for (const int houses : {60, 840}) {
    Expected<Scene> made = generate("city", {{"n", houses}}, 5);
    ASSERT_TRUE(made);
    const Light lamp = made->lights.front();
    for (const Triple& to_light : std::vector<Triple>{
             {1, 0, 1}, {3, 4, 2}, {-30, 1, 5}, {30, 1, 5}, {0, 0, 1}, {1, 40, 9}}) {
      Light sun = lamp;
      sun.id = "sun" + std::to_string(made->lights.size());
      sun.type = LightType::kDirectional;
      for (int k = 0; k < 3; ++k) sun.position[k] = Number(static_cast<double>(to_light[k]));
      made->lights.push_back(sun);
    }
    made->lights.push_back(lamp);
    made->lights.back().id = "again";
    const Expected<PreparedScene> scene = prepare(*made);
    ASSERT_TRUE(scene);
    expect_lights_to_be_alone(*scene);
  }
}

}  // namespace
}  // namespace gnomon::test
