// SPDX-License-Identifier: GPL-3.0-or-later
// The whole act on results that tell of several lights at once, and of pieces of lights: exact
// kernels are identical, and what is changed is found.
#include "fuzz/check/judged_scene.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "gnomon/oracle/witness_check.h"
#include "gnomon/scene/generate.h"

namespace gnomon::fuzz {
namespace {

struct Made {
  Scene scene;
  PreparedScene prepared;
};

Made make(const std::string& generator, std::map<std::string, std::int64_t> parameters,
          std::uint64_t seed) {
  Made made;
  made.scene = generate(generator, parameters, seed).value();
  made.prepared = prepare(made.scene).value();
  return made;
}

ShadowOptions exact_options() {
  ShadowOptions options;
  options.output.exact_points = true;
  options.output.exact_fractions = true;
  options.tuning.jobs = 1;
  return options;
}

TEST(JudgedScene, SeveralLightsTogetherByEveryMethodThatCan) {
  const std::vector<Made> scenes = [] {
    std::vector<Made> made;
    made.push_back(make("solids", {}, 1));
    made.push_back(make("lattice", {{"light", 2}}, 3));
    made.push_back(make("slanted-through", {}, 1));
    return made;
  }();
  for (const Made& made : scenes) {
    const JudgedScene judged(made.scene, made.prepared);
    for (const MethodId method : {MethodId::kSvbsp, MethodId::kReceiver}) {
      SCOPED_TRACE(made.scene.name + " " + std::string(method_info(method).name));
      ShadowOptions options = exact_options();
      options.method.point = method;
      options.output.combined = true;
      Judged done = judged.classify_and_judge(options, "plane", {});
      ASSERT_TRUE(done.report);
      EXPECT_EQ(done.report->verdict, oracle::Verdict::kIdentical) << done.report->reason;
      Claims& claims = done.classified->claims;
      ASSERT_TRUE(claims.combined);
      EXPECT_EQ(oracle::check_witnesses(made.scene, made.prepared, claims).violations, 0u);
      bool changed = false;
      for (SharedPolygon& polygon : *claims.combined) {
        for (SharedFragment& fragment : polygon.fragments) {
          if (changed || fragment.lit_by.empty()) continue;
          fragment.lit_by.pop_back();
          changed = true;
        }
      }
      EXPECT_TRUE(changed);
      EXPECT_EQ(judged.judge(claims, {})->verdict, oracle::Verdict::kFailed);
      EXPECT_GT(oracle::check_witnesses(made.scene, made.prepared, claims).violations, 0u);
    }
  }
}

TEST(JudgedScene, PiecesOfLights) {
  const Made made = make("panel-contacts", {}, 1);
  const JudgedScene judged(made.scene, made.prepared);
  ShadowOptions options = exact_options();
  options.method.area = MethodId::kPieces;
  Judged done = judged.classify_and_judge(options, "plane", {});
  ASSERT_TRUE(done.report) << to_string(*done.unjudged);
  EXPECT_EQ(done.report->verdict, oracle::Verdict::kIdentical) << done.report->reason;
  Claims& claims = done.classified->claims;
  ASSERT_GT(claims.lights.size(), 1u);
  EXPECT_EQ(oracle::check_witnesses(made.scene, made.prepared, claims).violations, 0u);
  claims.lights.pop_back();
  const auto report = judged.judge(claims, {});
  ASSERT_TRUE(report);
  EXPECT_EQ(report->verdict, oracle::Verdict::kFailed);
  EXPECT_NE(report->reason.find("do not add up"), std::string::npos) << report->reason;
  EXPECT_GT(oracle::check_witnesses(made.scene, made.prepared, claims).violations, 0u);
}

}  // namespace
}  // namespace gnomon::fuzz
