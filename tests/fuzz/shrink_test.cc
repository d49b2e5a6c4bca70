// SPDX-License-Identifier: GPL-3.0-or-later
// Shrinking keeps the failure and takes away all else: on predicates whose smallest scenes are
// known, and on real failures of rounded kernels.
#include "fuzz/shrink/shrink.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "fuzz/check/check.h"
#include "fuzz/generate/area_families.h"
#include "fuzz/generate/families.h"
#include "fuzz/shrink/coordinate_range.h"
#include "fuzz/shrink/still_fails.h"
#include "gnomon/scene/generate.h"
#include "gnomon/scene/prepare.h"
#include "solve.h"

namespace gnomon::fuzz {
namespace {

using test::text_of;

Scene made(const char* name) {
  Expected<Scene> scene = generate(name);
  EXPECT_TRUE(scene) << name;
  return std::move(*scene);
}

/// Two polygons share an edge, whichever way they run along it.
bool has_a_shared_edge(const Scene& scene) {
  std::set<std::pair<VertexId, VertexId>> seen;
  for (const Polygon& polygon : scene.polygons) {
    std::set<std::pair<VertexId, VertexId>> own;
    for (std::size_t i = 0; i < polygon.loop.size(); ++i) {
      own.insert(std::minmax(polygon.loop[i], polygon.loop[(i + 1) % polygon.loop.size()]));
    }
    for (const auto& edge : own) {
      if (!seen.insert(edge).second) return true;
    }
  }
  return false;
}

TEST(Shrink, TwoPolygonsThatShareAnEdge) {
  const Scene scene = made("table-chair");
  ASSERT_TRUE(has_a_shared_edge(scene));
  const ShrinkResult result = shrink(scene, has_a_shared_edge);
  EXPECT_TRUE(result.locally_minimal);
  EXPECT_TRUE(has_a_shared_edge(result.scene));
  EXPECT_EQ(result.after.polygons, 2u) << text_of(result.scene);
  EXPECT_EQ(result.after.lights, 0u);
  EXPECT_EQ(result.after.corners, 6u);
  EXPECT_LE(result.after.vertices, 4u);
  EXPECT_LE(result.after.bits, 2u) << text_of(result.scene);
  EXPECT_EQ(result.after, size_of(result.scene));
  EXPECT_LT(result.after, result.before);
  EXPECT_TRUE(prepare(result.scene));
}

TEST(Shrink, KeepsThePolygonsFlagsAndLightsThatMatter) {
  const Scene scene = made("table-chair");
  const auto fails = [](const Scene& tried) {
    return tried.polygons.size() >= 3 && !tried.lights.empty() &&
           tried.lights[0].position[2] == Number(1.0) &&
           std::ranges::any_of(tried.polygons, [](const Polygon& p) { return !p.casts; });
  };
  Scene marked = scene;
  marked.polygons[5].casts = false;
  marked.polygons[6].casts = false;
  marked.polygons[7].two_sided = true;
  marked.extra = "{\"note\": 1}";
  marked.lights.resize(1);
  marked.lights[0].position[2] = Number(1.0);
  ASSERT_TRUE(fails(marked));
  const ShrinkResult result = shrink(marked, fails);
  EXPECT_TRUE(result.locally_minimal);
  EXPECT_EQ(result.after.polygons, 3u);
  EXPECT_EQ(result.after.lights, 1u);
  EXPECT_EQ(result.after.flags, 1u) << text_of(result.scene);
  EXPECT_EQ(result.after.bits, 1u) << text_of(result.scene);
  EXPECT_EQ(result.scene.polygons[0].id, "a");
  EXPECT_TRUE(result.scene.extra.empty());
}

TEST(Shrink, DecimalsBecomeDoublesAndCoordinatesGetShort) {
  Scene scene;
  scene.numbers = NumberMeaning::kDecimal;
  const auto number = [](const char* text) {
    return *Number::parse(text, NumberMeaning::kDecimal);
  };
  for (const char* z : {"1234.5678", "1234.5679"}) {
    for (const auto& [x, y] : {std::pair{"0.1", "0.2"}, {"17.3", "0.2"}, {"0.1", "1e3"}}) {
      scene.vertices.push_back({number(x), number(y), number(z)});
    }
  }
  scene.polygons = {{"first long name", {0, 1, 2}, {}, {}, true},
                    {"second long name", {3, 4, 5}, {}, {}, true}};
  const auto fails = [](const Scene& tried) {
    if (tried.polygons.size() != 2) return false;
    const Number& one = tried.vertices[tried.polygons[0].loop[0]][2];
    const Number& two = tried.vertices[tried.polygons[1].loop[0]][2];
    return one.exact() < two.exact();
  };
  ASSERT_TRUE(fails(scene));
  const ShrinkResult result = shrink(scene, fails);
  EXPECT_TRUE(result.locally_minimal);
  EXPECT_EQ(result.scene.numbers, NumberMeaning::kDouble);
  EXPECT_EQ(result.after.flags, 0u);
  EXPECT_LE(result.after.bits, 3u) << text_of(result.scene);
  EXPECT_EQ(result.after.names, 0u);
}

TEST(Shrink, WhatNeedsAllDigitsKeepsThem) {
  const Scene scene = family_by_name("Needles").make(3);
  // A coordinate of many bits is what "fails": everything else goes.
  const auto most_bits = [](const Scene& tried) {
    std::size_t most = 0;
    for (const Position& vertex : tried.vertices) {
      for (const Number& value : vertex) {
        if (!value.is_zero())
          most = std::max(most, mpz_sizeinbase(value.mantissa().get_mpz_t(), 2));
      }
    }
    return most;
  };
  const std::size_t bits = most_bits(scene);
  ASSERT_GE(bits, 8u);
  const auto fails = [&](const Scene& tried) {
    return !tried.polygons.empty() && most_bits(tried) >= bits;
  };
  ShrinkOptions options;
  options.free_range = true;
  const ShrinkResult result = shrink(scene, fails, options);
  EXPECT_TRUE(result.locally_minimal);
  EXPECT_EQ(result.after.polygons, 1u);
  EXPECT_LE(result.after.bits, bits + 4) << text_of(result.scene);
  // In the range of the scene the digits stand behind the point, which costs more.
  const ShrinkResult within = shrink(scene, fails);
  EXPECT_TRUE(within.locally_minimal);
  EXPECT_EQ(within.after.polygons, 1u);
  EXPECT_TRUE(CoordinateRange(scene).holds(within.scene)) << text_of(within.scene);
}

TEST(Shrink, TheRangeIsThatOfEachAxisAndZero) {
  Scene scene = made("figure-6");
  const CoordinateRange range(scene);
  EXPECT_TRUE(range.holds(scene));
  scene.vertices[0] = {Number(0.0), Number(0.0), Number(0.0)};
  EXPECT_TRUE(range.holds(scene));
  scene.vertices[0][1] = Number(1e6);
  EXPECT_FALSE(range.holds(scene));
}

TEST(Shrink, SimplerScenesComeFirst) {
  const Scene scene = made("table-chair");
  Scene without_sharing = family_by_name("Needles").make(1);
  std::vector<Scene> simpler = {without_sharing, made("figure-4f"), made("figure-6")};
  const bool first = has_a_shared_edge(simpler[0]);
  ASSERT_FALSE(first);
  std::vector<std::size_t> asked;
  ShrinkOptions options;
  options.simpler = simpler;
  const auto fails = [&](const Scene& tried) {
    asked.push_back(tried.polygons.size());
    return has_a_shared_edge(tried);
  };
  shrink(scene, fails, options);
  ASSERT_GE(asked.size(), 2u);
  EXPECT_EQ(asked[0], simpler[0].polygons.size());
  EXPECT_EQ(asked[1], simpler[1].polygons.size());
}

TEST(Shrink, IsTheSameEveryTimeAndAsksNothingTwice) {
  const Scene scene = made("table-chair");
  std::set<std::string> asked;
  const auto fails = [&](const Scene& tried) {
    EXPECT_TRUE(asked.insert(text_of(tried)).second) << "asked twice";
    return has_a_shared_edge(tried);
  };
  const ShrinkResult one = shrink(scene, fails);
  asked.clear();
  const ShrinkResult two = shrink(scene, fails);
  EXPECT_EQ(text_of(one.scene), text_of(two.scene));
  EXPECT_EQ(one.tries, two.tries);
  EXPECT_EQ(asked.size(), two.tries);
}

TEST(Shrink, InterruptedItReturnsTheBestAndGoesOnFromThere) {
  const Scene scene = made("table-chair");
  const ShrinkResult whole = shrink(scene, has_a_shared_edge);
  ASSERT_TRUE(whole.locally_minimal);
  for (std::uint64_t stop : {0u, 1u, 5u, 13u, 20u}) {
    std::atomic<bool> interrupted = false;
    ShrinkOptions options;
    options.interrupted = &interrupted;
    std::uint64_t tries = 0;
    const auto fails = [&](const Scene& tried) {
      if (++tries >= stop) interrupted = true;
      return has_a_shared_edge(tried);
    };
    if (stop == 0) interrupted = true;
    const ShrinkResult part = shrink(scene, fails, options);
    EXPECT_FALSE(part.locally_minimal);
    EXPECT_EQ(part.tries, stop);
    EXPECT_TRUE(has_a_shared_edge(part.scene));
    EXPECT_LE(part.after, part.before);
    const ShrinkResult rest = shrink(part.scene, has_a_shared_edge);
    EXPECT_TRUE(rest.locally_minimal);
    EXPECT_EQ(rest.after.polygons, whole.after.polygons);
    EXPECT_EQ(rest.after.corners, whole.after.corners);
  }
}

TEST(Shrink, EndsAtTheLimitOfTries) {
  ShrinkOptions options;
  options.most_tries = 7;
  std::uint64_t told = 0, improvements = 0;
  options.progress = [&](const ShrinkProgress& progress) {
    ++told;
    improvements += progress.improved ? 1 : 0;
    EXPECT_EQ(progress.tries, told);
    EXPECT_EQ(progress.accepted, improvements);
    EXPECT_EQ(progress.size, size_of(progress.best));
  };
  const ShrinkResult result = shrink(made("table-chair"), has_a_shared_edge, options);
  EXPECT_EQ(result.tries, 7u);
  EXPECT_EQ(told, 7u);
  EXPECT_EQ(result.accepted, improvements);
  EXPECT_FALSE(result.locally_minimal);
}

TEST(Shrink, FailuresOfRoundedKernelsGetSmall) {
  std::size_t shrunken = 0;
  for (const auto& [family, subject] :
       {std::pair{"Needles", "double+thin"}, {"Needles", "float"}, {"MixedMagnitudes", "double"}}) {
    CheckOptions options;
    options.subjects = {*parse_subject(subject)};
    options.properties = {Property::kOracle};
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      const Scene scene = family_by_name(family).make(seed);
      const CaseReport report = check_scene(scene, options);
      if (report.failures.empty()) continue;
      const Failure& failure = report.failures.front();
      const ShrinkResult result = shrink(scene, fails_like(failure, options));
      EXPECT_TRUE(result.locally_minimal);
      EXPECT_TRUE(fails_like(failure, options)(result.scene)) << failure.signature();
      EXPECT_LE(result.after.polygons, 3u) << text_of(result.scene);
      EXPECT_LT(result.after, result.before);
      ++shrunken;
      break;
    }
  }
  EXPECT_EQ(shrunken, 3u);
}

TEST(Shrink, ABlunderStaysABlunder) {
  CaseReport report;
  Failure failure{Property::kOracle, "double", "misclassified", {}, {}, {}};
  failure.share = 0.5;
  report.failures = {failure};
  EXPECT_TRUE(fails_alike(report, failure));
  report.failures[0].share = 1e-7;
  EXPECT_FALSE(fails_alike(report, failure));
  failure.share = 1e-8;
  EXPECT_TRUE(fails_alike(report, failure));
  failure.subject = "float";
  EXPECT_FALSE(fails_alike(report, failure));
}

TEST(Shrink, OnlyWhatAFailureNeedsIsChecked) {
  CheckOptions options;
  options.subjects = {*parse_subject("double"), *parse_subject("plane"), *parse_subject("epeck")};
  const auto names = [&](Property property, const char* subject) {
    const CheckOptions own = narrowed(options, {property, subject, "x", {}, {}, {}});
    EXPECT_EQ(own.properties, std::vector{property});
    std::vector<std::string> result;
    for (const Subject& one : own.subjects) result.push_back(name_of(one));
    return result;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(names(Property::kOracle, "double"), Names({"double"}));
  EXPECT_EQ(names(Property::kAgreement, "epeck"), Names({"plane", "epeck"}));
  EXPECT_EQ(names(Property::kMetamorphic, "plane"), Names({"plane"}));
  EXPECT_EQ(names(Property::kPreparation, "prepare"), Names());
}

}  // namespace
}  // namespace gnomon::fuzz
