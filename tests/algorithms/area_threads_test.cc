// SPDX-License-Identifier: GPL-3.0-or-later
// Threads under area lights: on scenes that are large enough for several blocks of volumes, rounds
// of trees and halves of hierarchies, every number of threads gives the same result, byte for byte,
// the same counters, and the same stages of decisions.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "fuzz/generate/scene_pen.h"
#include "gnomon/algorithms/shadows.h"
#include "gnomon/scene/generate.h"
#include "gnomon/scene/prepare.h"
#include "report/json/result_json.h"

namespace gnomon::test {
namespace {

Scene made(const char* generator, const std::map<std::string, std::int64_t>& parameters) {
  Expected<Scene> scene = generate(generator, parameters, 3);
  EXPECT_TRUE(scene) << to_string(scene.error());
  return *std::move(scene);
}

/// A roof below the light that has all of a field of tiles in its umbra: cells of the umbra tree
/// are full after its volume, the first one, and take no piece of later rounds.
Scene roof() {
  fuzz::ScenePen pen;
  pen.polygon({{-90, -90, 190}, {90, -90, 190}, {90, 90, 190}, {-90, 90, 190}});
  for (std::int64_t i = 0; i < 30; ++i) {
    for (std::int64_t k = 0; k < 22; ++k) {
      const std::int64_t x = 4 * i - 60, y = 4 * k - 44, z = (7 * i + 5 * k) % 23;
      pen.polygon({{x, y, z}, {x + 3, y, z}, {x + 3, y + 3, z + 1}, {x, y + 3, z + 1}});
    }
  }
  return pen.panel({{-5, -5, 200}, {-5, 5, 200}, {5, 5, 200}, {5, -5, 200}}).take();
}

/// Many small polygons under a small and a large light, whose planes cut the lights so that volumes
/// have planes through cut corners; boxes on a floor; and the roof.
std::vector<Scene> scenes_for(KernelId kernel) {
  std::vector<Scene> scenes{made("quads", {{"n", 600}, {"area", 1}, {"area_size", 50}})};
  if (kernel == KernelId::kRational || kernel == KernelId::kEpeck) return scenes;  // they are slow
  scenes.push_back(made("quads", {{"n", 1300}, {"area", 1}}));
  scenes.push_back(made("city", {{"n", 250}, {"area", 1}}));
  scenes.push_back(roof());
  return scenes;
}

struct Answer {
  std::string json;
  StageCounts stages;
  std::vector<LightResult> lights;
};

Answer answer_of(const Scene& scene, const PreparedScene& prepared, const ShadowOptions& options) {
  const auto result = compute_shadows(prepared, options);
  EXPECT_TRUE(result) << to_string(result.error());
  if (!result) return {};
  report::ResultJsonOptions json;
  json.fragments = true;
  json.combined = options.output.combined;
  json.exact_loops = options.output.exact_points;
  report::StringSink sink;
  report::write_result_json(sink, scene, prepared, *result, json);
  return {sink.text(), result->stages, result->lights};
}

bool same_stages(const StageCounts& a, const StageCounts& b) {
  return a.identity == b.identity && a.filter == b.filter && a.by_width() == b.by_width() &&
         a.exactly_zero == b.exactly_zero;
}

ShadowOptions thread_options(KernelId kernel, MethodId method) {
  ShadowOptions options;
  options.kernel.id = kernel;
  options.method.area = method;
  const bool is_exact = kernel == KernelId::kPlane && method != MethodId::kContour;
  options.output.exact_points = is_exact;
  options.output.points = !is_exact;
  options.output.stage_counts = kernel == KernelId::kPlane;
  return options;
}

void expect_threads_change_nothing(const Scene& scene, ShadowOptions options) {
  const Expected<PreparedScene> prepared = prepare(scene);
  ASSERT_TRUE(prepared) << to_string(prepared.error());
  options.tuning.jobs = 1;
  const Answer one = answer_of(scene, *prepared, options);
  EXPECT_EQ(one.stages.total() > 0, options.output.stage_counts);
  for (const unsigned jobs : {2u, 4u, 8u}) {
    SCOPED_TRACE(std::to_string(jobs) + " threads");
    options.tuning.jobs = jobs;
    const Answer many = answer_of(scene, *prepared, options);
    EXPECT_TRUE(many.json == one.json);  // megabytes: no difference is printed
    EXPECT_TRUE(same_stages(one.stages, many.stages));
    ASSERT_EQ(one.lights.size(), many.lights.size());
    for (std::size_t i = 0; i < one.lights.size(); ++i) {
      EXPECT_EQ(one.lights[i].work, many.lights[i].work);
      EXPECT_EQ(one.lights[i].tree_nodes, many.lights[i].tree_nodes);
      EXPECT_EQ(one.lights[i].dropped_slivers, many.lights[i].dropped_slivers);
    }
  }
}

class AreaThreads : public testing::TestWithParam<KernelId> {};

TEST_P(AreaThreads, ChangeNothing) {
  for (const Scene& scene : scenes_for(GetParam())) {
    for (const MethodId method : {MethodId::kReceiver, MethodId::kMerged, MethodId::kContour}) {
      SCOPED_TRACE(scene.name + ", method " + std::to_string(static_cast<int>(method)));
      expect_threads_change_nothing(scene, thread_options(GetParam(), method));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kernels, AreaThreads,
                         testing::Values(KernelId::kPlane, KernelId::kDouble, KernelId::kRational,
                                         KernelId::kEpick, KernelId::kEpeck),
                         [](const auto& info) {
                           return std::string(kernel_info(info.param).name);
                         });

/// Of several lights in a pipeline, the later ones add to planes of the earlier; and end caps and
/// interleaved trees have planes of their own.
TEST(AreaThreads, ChangeNothingOfLightsTogether) {
  for (const MethodId method : {MethodId::kReceiver, MethodId::kMerged}) {
    ShadowOptions options = thread_options(KernelId::kPlane, method);
    options.output.combined = true;
    options.method.point = method;
    expect_threads_change_nothing(made("city", {{"n", 150}, {"area", 2}}), options);
  }
}

TEST(AreaThreads, ChangeNothingOfCapsAndInterleavedTrees) {
  ShadowOptions options = thread_options(KernelId::kPlane, MethodId::kMerged);
  options.method.options.caps = true;
  expect_threads_change_nothing(made("quads", {{"n", 700}, {"area", 1}}), options);
  options.method.options.caps = false;
  options.method.options.interleaved = true;
  expect_threads_change_nothing(made("quads", {{"n", 300}, {"area", 1}}), options);
}

}  // namespace
}  // namespace gnomon::test
