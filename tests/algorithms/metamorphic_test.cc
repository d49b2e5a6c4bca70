// SPDX-License-Identifier: GPL-3.0-or-later
// What must not change the exact answer, by any method: how it is computed (prefix, merging,
// the seed of the BSP; the sizes of cells), how the scene is written down (order, rotation of
// loops, duplicates), and maps of space that carry light and shadow with them. And what may change
// it in one direction only: a further caster lights nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "exact_check.h"
#include "fuzz/generate/families.h"
#include "gnomon/scene/generate.h"
#include "method_variants.h"
#include "scene/base/random.h"

namespace gnomon::test {
namespace {

using namespace fuzz;  // families and pens

/// Per light and polygon, the lit fractions of its parts, sorted.
using Answer = std::map<std::string, std::vector<mpq_class>>;

Answer answer_of(const Case& scene, const ShadowOptions& options) {
  Answer answer;
  const std::vector<mpq_class> lit = lit_fractions(scene, options);
  const PreparedScene& prepared = scene.prepared();
  for (std::size_t i = 0; i < lit.size(); ++i) {
    const Part& part = prepared.parts[i % prepared.parts.size()];
    const PreparedLight& light = prepared.lights[i / prepared.parts.size()];
    answer[scene.scene().lights[light.light].id + "/" + scene.scene().polygons[part.polygon].id]
        .push_back(lit[i]);
  }
  for (auto& [place, fractions] : answer) std::sort(fractions.begin(), fractions.end());
  return answer;
}

std::string difference(const Answer& a, const Answer& b) {
  if (a.size() != b.size()) return "not the same polygons";
  for (const auto& [place, fractions] : a) {
    const auto other = b.find(place);
    if (other == b.end()) return place + " is missing";
    if (other->second != fractions) {
      return place + ": lit " + fractions[0].get_str() + " against " + other->second[0].get_str();
    }
  }
  return {};
}

/// Every polygon of these is exactly planar, so that no triangulation depends on the axes.
const std::vector<std::string> kPlanarFamilies = {"Generic",       "Lattice",       "Crossing",
                                                  "CoplanarTiles", "TouchingBoxes", "NestedBoxes",
                                                  "Grazing",       "Needles",       "SmallLattice"};

class Metamorphic : public testing::TestWithParam<std::tuple<std::string, MethodId>> {
 protected:
  static Scene scene_of(std::uint64_t seed) {
    return family_by_name(std::get<0>(GetParam())).make(seed);
  }
  /// Cells are small: so few polygons would all be in one.
  static ShadowOptions options() {
    ShadowOptions options = with_small_cells(options_for(KernelId::kPlane));
    options.method.point = std::get<1>(GetParam());
    return options;
  }
  static Answer answer(const Scene& scene) {
    const auto prepared = Case::make(scene);
    return prepared ? answer_of(*prepared, options()) : Answer{};
  }

  /// The default methods get more.
  const std::uint64_t kScenes =
      std::ranges::find(kAlgorithms, std::get<1>(GetParam())) != kAlgorithms.end() ? 24 : 6;
  static constexpr std::uint64_t kFirstSeed = 700000;

  /// For each scene of the family: the changed scene has the same answer.
  void same_after(const std::function<void(Scene&, Random&)>& change) {
    for (std::uint64_t seed = kFirstSeed; seed < kFirstSeed + kScenes; ++seed) {
      Random random(seed);
      const Scene scene = scene_of(seed);
      Scene changed = scene;
      change(changed, random);
      const Answer before = answer(scene), after = answer(changed);
      ASSERT_EQ(difference(before, after), "") << "seed " << seed << "\n"
                                               << text_of(scene) << text_of(changed);
    }
  }
};

void for_each_position(Scene& scene, const std::function<void(Position&)>& change) {
  for (Position& vertex : scene.vertices) change(vertex);
  for (Light& light : scene.lights) change(light.position);
}

TEST_P(Metamorphic, OptionsOfTheAlgorithm) {
  for (std::uint64_t seed = kFirstSeed; seed < kFirstSeed + kScenes; ++seed) {
    const auto scene = Case::make(scene_of(seed));
    if (!scene) continue;
    const Answer first = answer_of(*scene, options());
    for (unsigned variant = 1; variant < 8; ++variant) {
      ShadowOptions varied = options();
      varied.output.merge = (variant & 1) == 0;
      varied.method.prefix = (variant & 2) == 0;
      varied.method.seed = variant & 4 ? 99 * variant : 1;
      varied.output.stage_counts = (variant & 1) != 0;
      varied.tuning.leaf_size = variant & 1 ? 16 : variant & 2 ? 0 : 3;
      varied.tuning.task_size = variant & 2 ? 1 : 5 * (variant & 4);
      ASSERT_EQ(difference(first, answer_of(*scene, varied)), "")
          << "variant " << variant << ", seed " << seed << "\n"
          << text_of(scene->scene());
    }
  }
}

TEST_P(Metamorphic, OrderOfPolygons) {
  same_after([](Scene& scene, Random& random) { random.shuffle(std::span(scene.polygons)); });
}

TEST_P(Metamorphic, RotationOfLoops) {
  same_after([](Scene& scene, Random& random) {
    for (Polygon& polygon : scene.polygons) {
      const auto turn = static_cast<std::ptrdiff_t>(random.below(polygon.loop.size()));
      std::rotate(polygon.loop.begin(), polygon.loop.begin() + turn, polygon.loop.end());
    }
  });
}

TEST_P(Metamorphic, PowersOfTwo) {
  for (const int exponent : {-700, -31, 1, 64, 650}) {
    same_after([&](Scene& scene, Random&) { scene = scaled(scene, exponent); });
  }
}

TEST_P(Metamorphic, CyclicAxes) {
  same_after([](Scene& scene, Random&) {
    for_each_position(scene, [](Position& p) { std::rotate(p.begin(), p.begin() + 1, p.end()); });
  });
}

TEST_P(Metamorphic, MirroredAxes) {
  same_after([](Scene& scene, Random& random) {
    const auto k = static_cast<std::size_t>(random.below(3));
    for_each_position(scene, [&](Position& p) { std::swap(p[k], p[(k + 1) % 3]); });
    for (Polygon& polygon : scene.polygons) std::reverse(polygon.loop.begin(), polygon.loop.end());
  });
}

TEST_P(Metamorphic, PointReflection) {
  same_after([](Scene& scene, Random&) {
    for_each_position(scene, [](Position& p) {
      for (Number& x : p) x = Number::from_dyadic(-x.mantissa(), x.exponent());
    });
    for (Polygon& polygon : scene.polygons) std::reverse(polygon.loop.begin(), polygon.loop.end());
  });
}

TEST_P(Metamorphic, Duplicates) {
  // A second polygon in the place of the first shadows what the first does, and not the first.
  for (std::uint64_t seed = kFirstSeed; seed < kFirstSeed + kScenes; ++seed) {
    const Scene scene = scene_of(seed);
    Scene doubled = scene;
    Polygon copy = doubled.polygons[seed % doubled.polygons.size()];
    const std::string original = copy.id;
    copy.id += " again";
    doubled.polygons.push_back(copy);
    Answer before = answer(scene), after = answer(doubled);
    for (const Light& light : scene.lights) {
      const auto again = after.find(light.id + "/" + copy.id);
      if (again == after.end()) continue;
      EXPECT_EQ(again->second, after[light.id + "/" + original]) << seed;
      after.erase(again);
    }
    ASSERT_EQ(difference(before, after), "") << "seed " << seed << "\n" << text_of(doubled);
  }
}

TEST_P(Metamorphic, OneMoreCasterLightsNothing) {
  for (std::uint64_t seed = kFirstSeed; seed < kFirstSeed + kScenes; ++seed) {
    const Scene scene = scene_of(seed);
    if (scene.polygons.size() < 2) continue;
    Scene fewer = scene;
    fewer.polygons.erase(fewer.polygons.begin() +
                         static_cast<std::ptrdiff_t>(seed % fewer.polygons.size()));
    const Answer without = answer(fewer), with = answer(scene);
    for (const auto& [place, fractions] : without) {
      const auto other = with.find(place);
      ASSERT_NE(other, with.end());
      for (std::size_t i = 0; i < fractions.size(); ++i) {
        ASSERT_LE(other->second[i], fractions[i]) << place << " seed " << seed << "\n"
                                                  << text_of(scene);
      }
    }
  }
}

TEST_P(Metamorphic, EachLightForItself) {
  for (std::uint64_t seed = kFirstSeed; seed < kFirstSeed + kScenes; ++seed) {
    const auto scene = Case::make(scene_of(seed));
    if (!scene) continue;
    const std::vector<mpq_class> all = lit_fractions(*scene, options());
    std::vector<mpq_class> one_by_one;
    for (std::uint32_t light = 0; light < scene->prepared().lights.size(); ++light) {
      ShadowOptions alone = options();
      alone.lights = {light};
      for (mpq_class& lit : lit_fractions(*scene, alone)) one_by_one.push_back(std::move(lit));
    }
    ASSERT_EQ(all, one_by_one) << "seed " << seed << "\n" << text_of(scene->scene());
  }
}

INSTANTIATE_TEST_SUITE_P(
    Families, Metamorphic,
    testing::Combine(testing::ValuesIn(kPlanarFamilies), testing::ValuesIn(object_methods())),
    [](const auto& info) {
      return std::get<0>(info.param) + "_" + test_name_of({std::get<1>(info.param), {}});
    });

/// Scenes large enough for the balanced prefix and for cells, which small ones do without.
struct LargeScene {
  std::string generator;
  std::map<std::string, std::int64_t> parameters;
};

class LargeScenes : public testing::TestWithParam<LargeScene> {};

TEST_P(LargeScenes, AlgorithmPrefixAndScaleChangeNothing) {
  const Expected<Scene> made = generate(GetParam().generator, GetParam().parameters, 1);
  ASSERT_TRUE(made) << to_string(made.error());
  const auto scene = Case::make(*made);
  ASSERT_TRUE(scene);
  ASSERT_GE(scene->prepared().parts.size(), 64u);
  // Certified bounds of the fractions are compared: exact ones take minutes here.
  ShadowOptions options;
  const Expected<ShadowResult> first = compute_shadows(scene->prepared(), options);
  ASSERT_TRUE(first);
  for (const int exponent : {0, -900, 900}) {
    const auto changed = Case::make(scaled(*made, exponent));
    ASSERT_TRUE(changed);
    for (const int variant : {0, 1, 2, 3}) {
      options.method.point = variant < 2 ? MethodId::kSvbsp : MethodId::kSectors;
      options.method.prefix = options.output.merge = variant != 0;
      options.method.seed = variant;
      options.tuning.leaf_size = variant == 2 ? 2 : 16;
      options.tuning.task_size = variant == 2 ? 10 : 0;
      const Expected<ShadowResult> second = compute_shadows(changed->prepared(), options);
      ASSERT_TRUE(second);
      for (std::size_t l = 0; l < first->lights.size(); ++l) {
        for (std::size_t i = 0; i < first->lights[l].parts.size(); ++i) {
          const PartResult &a = first->lights[l].parts[i], &b = second->lights[l].parts[i];
          ASSERT_EQ(a.reason, b.reason);
          ASSERT_LE(a.lit.lower, b.lit.upper) << i << " times 2^" << exponent;
          ASSERT_LE(b.lit.lower, a.lit.upper) << i << " times 2^" << exponent;
          ASSERT_LT(b.lit.upper - b.lit.lower, 1e-6);
        }
      }
    }
  }
  for (const MethodId algorithm : kAlgorithms) {
    ShadowOptions exact;
    exact.method.point = algorithm;
    exact.output.exact_points = true;
    const Expected<ShadowResult> result = compute_shadows(scene->prepared(), exact);
    ASSERT_TRUE(result);
    const oracle::Report report = judge(*scene, *result);
    EXPECT_EQ(report.verdict, oracle::Verdict::kIdentical) << report.reason;
  }
}

INSTANTIATE_TEST_SUITE_P(Generators, LargeScenes,
                         testing::Values(LargeScene{"lattice",
                                                    {{"n", 66}, {"size", 3}, {"light", 0}}},
                                         LargeScene{"touching-boxes", {{"n", 14}, {"light", 2}}},
                                         LargeScene{"crossing-sticks", {{"n", 64}, {"light", 0}}},
                                         LargeScene{"grazing", {{"n", 64}, {"light", 2}}},
                                         LargeScene{"needles", {{"n", 64}, {"light", 2}}}),
                         [](const auto& info) {
                           std::string name = info.param.generator;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace gnomon::test
