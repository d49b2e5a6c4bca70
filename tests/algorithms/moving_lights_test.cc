// SPDX-License-Identifier: GPL-3.0-or-later
// Lights together that move, and their order: every step is what a run of the scene with its lights
// there puts out, byte for byte; what is done again is counted; and neither the order of lights nor
// what trees grow from changes a class at any point.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/run/compute.h"
#include "fuzz/generate/families.h"
#include "gnomon/algorithms/method_options.h"
#include "gnomon/algorithms/shadows.h"
#include "gnomon/scene/generate.h"
#include "report/json/result_json.h"
#include "solve.h"

namespace gnomon::test {
namespace {

/// A place on the grid of the scene's vertices and in their box: each coordinate is that of some
/// vertex, so that it is often in planes of polygons. Lights there leave the grid as it is.
Position place_of(const Scene& scene, std::uint64_t seed) {
  Position place;
  std::uint64_t state = seed * 0x9e3779b97f4a7c15u + 1;
  for (std::size_t k = 0; k < 3; ++k) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    place[k] = scene.vertices[(state >> 33) % scene.vertices.size()][k];
  }
  return place;
}

Light light_at(std::string id, Position place, LightType type = LightType::kPoint) {
  Light light;
  light.id = std::move(id);
  light.type = type;
  light.position = std::move(place);
  return light;
}

constexpr std::size_t kLights = 3;

/// The scene under three lights, at places that a seed gives.
Scene under_three_lights(Scene scene, std::uint64_t seed) {
  scene.lights.clear();
  for (std::uint64_t i = 0; i < kLights; ++i) {
    scene.lights.push_back(light_at("lamp" + std::to_string(i), place_of(scene, 10 * seed + i)));
  }
  return scene;
}

ShadowOptions together(KernelId kernel) {
  ShadowOptions options = options_for(kernel);
  options.output.points = true;
  options.output.combined = true;
  options.tuning.jobs = 1;
  return options;
}

std::string json_of(const Scene& scene, const PreparedScene& prepared, const ShadowResult& result) {
  report::ResultJsonOptions json;
  json.fragments = json.exact_loops = json.combined = true;
  json.exact_fractions = result.exact;
  report::StringSink sink;
  report::write_result_json(sink, scene, prepared, result, json);
  return sink.text();
}

/// The moved light's places, each in the slot of the light that moves.
struct Moves {
  std::size_t slot = 0;
  std::vector<Position> places;
};

/// The scene at a step, 0 being the first.
Scene at_step(Scene scene, const Moves& moves, std::size_t step) {
  if (step > 0) scene.lights[moves.slot].position = moves.places[step - 1];
  return scene;
}

struct Steps {
  Scene scene;  // with a light for each place
  PreparedScene prepared;
  std::vector<ShadowResult> results;
};

/// Every step of the moves.
Steps run_steps(const Scene& scene, const Moves& moves, ShadowOptions options) {
  Steps steps{scene, {}, {}};
  options.lights = {0, 1, 2};
  for (const Position& place : moves.places) {
    options.steps.push_back(options.lights);
    options.steps.back()[moves.slot] = static_cast<std::uint32_t>(steps.scene.lights.size());
    const Light& light = scene.lights[moves.slot];
    steps.scene.lights.push_back(light_at(light.id, place, light.type));
  }
  steps.prepared = prepare(steps.scene).value();
  options.control.step_done = [&](const ShadowResult& result) {
    steps.results.push_back(result);
    return true;
  };
  const auto done = compute_shadows(steps.prepared, options);
  EXPECT_TRUE(done) << to_string(done.error());
  return steps;
}

std::vector<KernelId> kernels_there() {
  std::vector<KernelId> kernels;
  for (const KernelInfo& kernel : kernel_list()) {
    if (has_kernel(kernel.id)) kernels.push_back(kernel.id);
  }
  return kernels;
}

/// Calls check(scene, seed) for so many scenes of each family, under three lights, that can be
/// prepared.
void for_each_scene(unsigned scenes,
                    const std::function<void(const Scene&, std::uint64_t)>& check) {
  for (const fuzz::Family& family : fuzz::families()) {
    for (std::uint64_t seed = 500; seed < 500 + scenes; ++seed) {
      Scene scene = family.make(seed);
      if (scene.vertices.empty()) continue;
      scene = under_three_lights(std::move(scene), seed);
      if (!prepare(scene)) continue;
      SCOPED_TRACE(family.name + " seed " + std::to_string(seed));
      check(scene, seed);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

TEST(MovingLights, EveryStepIsByteForByteARunFromNothing) {
  std::size_t compared = 0;
  for (const KernelId kernel : kernels_there()) {
    for_each_scene(2, [&](const Scene& scene, std::uint64_t seed) {
      for (std::size_t slot = 0; slot < kLights; ++slot) {
        SCOPED_TRACE(std::string(kernel_info(kernel).name) + ", light " + std::to_string(slot));
        const Moves moves{slot, {place_of(scene, 10 * seed + 7), place_of(scene, 10 * seed + 8)}};
        const Steps steps = run_steps(scene, moves, together(kernel));
        ASSERT_EQ(steps.results.size(), 3u);
        for (std::size_t step = 0; step < steps.results.size(); ++step) {
          const Scene fresh = at_step(scene, moves, step);
          const PreparedScene prepared = prepare(fresh).value();
          const auto result = compute_shadows(prepared, together(kernel));
          ASSERT_TRUE(result) << to_string(result.error());
          ASSERT_EQ(json_of(steps.scene, steps.prepared, steps.results[step]),
                    json_of(fresh, prepared, *result))
              << "step " << step << '\n'
              << text_of(fresh);
          ++compared;
        }
      }
    });
  }
  EXPECT_GT(compared, 1000u);
}

// Off the grid and outside the box: then the grid of all steps is another than that of each, and
// nearest numbers may differ in their last digits. What is exact does not.
TEST(MovingLights, WhereTheGridIsAnotherWhatIsExactIsTheSame) {
  for (const KernelId kernel : {KernelId::kPlane, KernelId::kRational, KernelId::kEpeck}) {
    if (!has_kernel(kernel)) continue;
    for_each_scene(1, [&](const Scene& scene, std::uint64_t seed) {
      Position far = place_of(scene, 10 * seed + 7);
      far[2] = Number(77.0 + 1.0 / 1024);
      const Moves moves{seed % kLights, {far}};
      const Steps steps = run_steps(scene, moves, together(kernel));
      ASSERT_EQ(steps.results.size(), 2u);
      for (std::size_t step = 0; step < 2; ++step) {
        const PreparedScene prepared = prepare(at_step(scene, moves, step)).value();
        const ShadowResult fresh = compute_shadows(prepared, together(kernel)).value();
        const ShadowResult& moved = steps.results[step];
        ASSERT_EQ(moved.combined.size(), fresh.combined.size());
        for (std::size_t i = 0; i < fresh.combined.size(); ++i) {
          ASSERT_EQ(moved.combined[i].lit_by, fresh.combined[i].lit_by);
        }
        ASSERT_EQ(moved.combined_exact_points, fresh.combined_exact_points);
        for (std::size_t light = 0; light < kLights; ++light) {
          const auto& own = moved.lights[light].exact_fractions;
          ASSERT_EQ(own.size(), fresh.lights[light].exact_fractions.size());
          for (std::size_t i = 0; i < own.size(); ++i) {
            ASSERT_EQ(own[i].lit, fresh.lights[light].exact_fractions[i].lit);
          }
        }
      }
    });
  }
}

// Suns move too, and a light may come to stand in the plane of a polygon.
TEST(MovingLights, ASunMovesByItsDirection) {
  Scene scene = generate("room", {}, 1).value();
  scene.lights = {light_at("lamp", place_of(scene, 1)),
                  light_at("sun", {Number(1.0), Number(2.0), Number(4.0)}, LightType::kDirectional),
                  light_at("other", place_of(scene, 2))};
  const Moves moves{
      1, {{Number(0.0), Number(0.0), Number(1.0)}, {Number(-3.0), Number(1.0), Number(2.0)}}};
  for (const KernelId kernel : kernels_there()) {
    const Steps steps = run_steps(scene, moves, together(kernel));
    for (std::size_t step = 0; step < 3; ++step) {
      const Scene fresh = at_step(scene, moves, step);
      const PreparedScene prepared = prepare(fresh).value();
      EXPECT_EQ(json_of(steps.scene, steps.prepared, steps.results[step]),
                json_of(fresh, prepared, compute_shadows(prepared, together(kernel)).value()));
    }
  }
}

/// `options` with an option of svbsp.
ShadowOptions with(ShadowOptions options, const std::string& method) {
  const MethodSelection selection = parse_method(method).value();
  options.method.point = selection.id;
  options.method.options = selection.values;
  return options;
}

// Steps with each order of lights, and with trees from fragments, where trees are made again behind
// the light that moves.
TEST(MovingLights, EveryOrderAndEveryGrowthMovesAlike) {
  for (const std::string method : {"svbsp:light-order=facing", "svbsp:grow=fragments",
                                   "svbsp:light-order=facing,grow=fragments"}) {
    for (const KernelId kernel : {KernelId::kRational, KernelId::kDouble}) {
      for_each_scene(1, [&](const Scene& scene, std::uint64_t seed) {
        const Moves moves{seed % kLights,
                          {place_of(scene, 10 * seed + 7), place_of(scene, 10 * seed + 8)}};
        const ShadowOptions options = with(together(kernel), method);
        const Steps steps = run_steps(scene, moves, options);
        for (std::size_t step = 0; step < steps.results.size(); ++step) {
          const Scene fresh = at_step(scene, moves, step);
          const PreparedScene prepared = prepare(fresh).value();
          ASSERT_EQ(json_of(steps.scene, steps.prepared, steps.results[step]),
                    json_of(fresh, prepared, compute_shadows(prepared, options).value()))
              << method << " step " << step;
        }
      });
    }
  }
}

TEST(MovingLights, OnlyWhatChangesIsDoneAgain) {
  const Scene scene = generate("room", {}, 1).value();
  Scene three = under_three_lights(scene, 3);
  for (std::size_t slot = 0; slot < kLights; ++slot) {
    const Moves moves{slot, {place_of(scene, 31), place_of(scene, 32)}};
    const Steps steps = run_steps(three, moves, together(KernelId::kPlane));
    const TogetherCounts& first = steps.results[0].together;
    EXPECT_EQ(first.trees, kLights);
    EXPECT_EQ(first.trees_built, kLights);
    EXPECT_EQ(first.filters, first.filters_from_nothing);
    for (std::size_t step = 1; step < 3; ++step) {
      const TogetherCounts& counts = steps.results[step].together;
      EXPECT_EQ(counts.trees_built, 1u);
      if (slot == 0) {
        EXPECT_EQ(counts.filters, counts.filters_from_nothing);
      } else {
        EXPECT_LT(counts.filters, counts.filters_from_nothing);
        EXPECT_GT(counts.filters, 0u);
      }
    }
    // What is before the light is kept, but not for the last step.
    EXPECT_EQ(first.kept_bytes > 0, slot > 0);
    EXPECT_EQ(steps.results[2].together.kept_bytes, 0u);
  }
}

TEST(MovingLights, WhereNothingMovesNothingIsDone) {
  const Scene scene = under_three_lights(generate("room", {}, 1).value(), 3);
  const PreparedScene prepared = prepare(scene).value();
  ShadowOptions options = together(KernelId::kPlane);
  options.steps = {{0, 1, 2}};
  std::vector<std::string> results;
  options.control.step_done = [&](const ShadowResult& result) {
    if (!results.empty()) {
      EXPECT_EQ(result.together.filters, 0u);
    }
    results.push_back(json_of(scene, prepared, result));
    return true;
  };
  ASSERT_TRUE(compute_shadows(prepared, options));
  ASSERT_EQ(results.size(), 2u);
  EXPECT_EQ(results[0], results[1]);
}

// One tree at a time unless lights move; then those that filter again.
TEST(MovingLights, TreesAreDroppedWhenTheyAreOfNoMoreUse) {
  const Scene scene = under_three_lights(generate("room", {}, 1).value(), 3);
  const PreparedScene prepared = prepare(scene).value();
  const TogetherCounts fresh =
      compute_shadows(prepared, together(KernelId::kPlane)).value().together;
  EXPECT_LT(fresh.tree_bytes_at_once, fresh.tree_bytes);
  EXPECT_EQ(fresh.kept_bytes, 0u);
  // Behind the first light all other trees are kept; before the last one none is.
  const Position place = place_of(scene, 31);
  const ShadowOptions options = together(KernelId::kPlane);
  EXPECT_GT(run_steps(scene, {0, {place}}, options).results[0].together.tree_bytes_at_once,
            fresh.tree_bytes_at_once);
  EXPECT_EQ(run_steps(scene, {2, {place}}, options).results[0].together.tree_bytes_at_once,
            fresh.tree_bytes_at_once);
}

// The classes at every point are the same whichever light comes first, and whatever trees grow
// from: the judge finds the exact answer of each light in the sets.
TEST(LightsTogether, NeitherOrderNorGrowthChangesAClass) {
  for (const std::string method :
       {"svbsp", "svbsp:light-order=facing", "svbsp:light-order=moving", "svbsp:grow=fragments"}) {
    for (const KernelId kernel : {KernelId::kPlane, KernelId::kRational, KernelId::kEpeck}) {
      if (!has_kernel(kernel)) continue;
      ShadowOptions options = with(together(kernel), method);
      if (kernel == KernelId::kPlane && options.method.options.grow == GrowFrom::kFragments) {
        continue;
      }
      for_each_scene(1, [&](const Scene& scene, std::uint64_t) {
        const auto made = Case::make(scene);
        const auto result = compute_shadows(made->prepared(), options);
        ASSERT_TRUE(result) << to_string(result.error());
        const oracle::Report report = judge(*made, *result);
        ASSERT_EQ(report.verdict, oracle::Verdict::kIdentical)
            << method << ": " << report.reason << '\n'
            << text_of(scene);
      });
    }
  }
}

// A finished tree that forgets when it was made is noticed.
TEST(LightsTogether, ATreeWithoutTimesIsWrong) {
  Rules rules;
  rules.later_volumes_do_not_count = false;
  std::size_t failed = 0;
  for_each_scene(1, [&](const Scene& scene, std::uint64_t) {
    const auto made = Case::make(scene);
    const auto result = compute_with(made->prepared(), together(KernelId::kPlane), rules);
    ASSERT_TRUE(result) << to_string(result.error());
    failed += judge(*made, *result).verdict == oracle::Verdict::kFailed ? 1 : 0;
  });
  EXPECT_GT(failed, 10u);
}

TEST(LightsTogether, WhatCannotBeDoneIsSaid) {
  const Scene scene = under_three_lights(generate("room", {}, 1).value(), 3);
  const PreparedScene prepared = prepare(scene).value();
  const auto error_of = [&](const ShadowOptions& options) {
    const auto result = compute_shadows(prepared, options);
    return result ? std::string("none") : to_string(result.error());
  };
  EXPECT_NE(error_of(with(together(KernelId::kPlane), "svbsp:grow=fragments"))
                .find("grow=fragments on kernel plane: "),
            std::string::npos);
  ShadowOptions options = together(KernelId::kPlane);
  options.steps = {{0, 1}};
  EXPECT_NE(error_of(options).find("one by one"), std::string::npos);  // nobody takes the steps
  options.control.step_done = [](const ShadowResult&) { return true; };
  EXPECT_NE(error_of(options).find("a step of 2 lights"), std::string::npos);
  options.steps = {{0, 1, 3}};
  EXPECT_NE(error_of(options).find("light 3 of a step"), std::string::npos);
  options.steps = {{0, 2, 1}};
  EXPECT_NE(error_of(with(options, "basic")).find("need svbsp, not basic"), std::string::npos);
  EXPECT_EQ(error_of(options), "none");
  options.control.step_done = [](const ShadowResult&) { return false; };
  EXPECT_NE(error_of(options).find("interrupted"), std::string::npos);
}

}  // namespace
}  // namespace gnomon::test
