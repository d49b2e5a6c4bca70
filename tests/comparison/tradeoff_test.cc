// SPDX-License-Identifier: GPL-3.0-or-later
// Speed against accuracy: the plan, the front, thicknesses, changes of scenes, the log.
#include "comparison/tradeoff.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "comparison/run_measurement.h"
#include "comparison/scene_change.h"
#include "comparison/tradeoff_text.h"
#include "gnomon/algorithms/shadows.h"
#include "gnomon/scene/prepare.h"
#include "tests/support/test_directory.h"

namespace gnomon::comparison {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

TradeoffPlan plan_of(const std::string& scene) {
  TradeoffPlan plan;
  plan.scenes = {*SceneSource::parse(scene)};
  plan.systems = {"sectors"};
  plan.kernels = {"double", "double+thin", "epick", "plane"};
  plan.thicknesses = {0, 1e-12, 1e-3};
  plan.limits = {5, 0};
  return plan;
}

TEST(TradeoffPlan, OnlyKernelsWithAThicknessOfTheirOwnChoiceAreSwept) {
  const auto runs = tradeoff_runs(plan_of("city:n=4"));
  ASSERT_TRUE(runs);
  std::vector<std::string> rows;
  for (const Planned& planned : *runs) {
    rows.push_back(planned.request.kernel + (planned.request.thickness
                                                 ? " " + std::to_string(*planned.request.thickness)
                                                 : std::string()));
  }
  EXPECT_THAT(rows, ElementsAre("double 0.000000", "double 0.000000", "double 0.001000",
                                "double+thin", "epick", "plane"));
}

TEST(TradeoffPlan, BothKindsOfLights) {
  TradeoffPlan plan = plan_of("city:n=2,area=2");
  plan.systems = {};
  plan.kernels = {"plane"};
  bool area = false, point = false;
  const auto runs = tradeoff_runs(plan);
  ASSERT_TRUE(runs);
  for (const Planned& planned : *runs) {
    (planned.request.lights == LightsAsked::kArea ? area : point) = true;
  }
  EXPECT_TRUE(area && point);
}

/// A script in place of `gnomon measure`, which tells by the request what was measured.
class Tradeoffs : public testing::Test {
 protected:
  RunProgram script(const std::string& body) const {
    const std::string path = directory_.file("run.sh");
    std::ofstream(path) << "#!/bin/sh\n" << body << '\n';
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    return {path, {}};
  }
  static std::string told(double seconds, double error, const std::string& verdict) {
    Measurement measured;
    measured.polygons = 21;
    measured.runs = 1;
    measured.seconds = seconds;
    measured.judgement.emplace();
    measured.judgement->verdict = verdict;
    measured.judgement->worst_share = error;
    return "echo '" + measurement_text(measured) + "'";
  }
  test::TestDirectory directory_;
};

TEST_F(Tradeoffs, FrontThicknessesAndTexts) {
  const RunProgram program =
      script("case \"$1\" in\n*'\"thickness\": 1e-12'*) " + told(1, 1e-15, "within tolerance") +
             " ;;\n*'\"thickness\": 0.001'*) " + told(2, 1e-2, "failed") +
             " ;;\n*epick*) kill -SEGV $$ ;;\n" + "*plane*) " + told(3, 0, "identical") +
             " ;;\n*) " + told(2, 1e-15, "within tolerance") + " ;;\nesac");
  RunLog log;
  const auto tradeoff = find_tradeoff(plan_of("city:n=4"), program, log);
  ASSERT_TRUE(tradeoff) << to_string(tradeoff.error());
  std::vector<bool> front;
  for (const TradeoffRow& row : tradeoff->rows) front.push_back(row.on_front);
  EXPECT_THAT(front, ElementsAre(false, true, false, false, false, true));
  EXPECT_EQ(tradeoff->rows[4].measurement.end, RunEnd::kCrashed);

  const auto verdicts = thickness_verdicts(*tradeoff);
  ASSERT_THAT(verdicts, SizeIs(1));
  ASSERT_THAT(verdicts[0].right, SizeIs(1));
  EXPECT_EQ(verdicts[0].right[0].from, 0);
  EXPECT_EQ(verdicts[0].right[0].to, 1e-12);
  EXPECT_EQ(thickness_scores(verdicts).front().thickness, 1e-12);

  EXPECT_THAT(tradeoff_text(*tradeoff, true), HasSubstr("--try 1e-12"));
  EXPECT_THAT(tradeoff_text(*tradeoff, false), HasSubstr("crashed"));
  EXPECT_THAT(thickness_text(*tradeoff), HasSubstr("best single thickness 1e-12"));
  EXPECT_THAT(tradeoff_csv(*tradeoff), HasSubstr(",crashed,"));
  report::StringSink json, plot;
  write_tradeoff_json(json, *tradeoff);
  EXPECT_THAT(json.text(), HasSubstr("\"gnomon-tradeoff\""));
  write_tradeoff_plot(plot, *tradeoff);
  EXPECT_THAT(plot.text(), HasSubstr("</svg>"));
}

TEST_F(Tradeoffs, WhatTheLogHasIsNotRunAgain) {
  const std::string path = directory_.file("runs.log"), count = directory_.file("count");
  const RunProgram program = script("echo x >> " + count + "\n" + told(1, 0, "identical"));
  {
    auto log = RunLog::open(path);
    ASSERT_TRUE(log);
    ASSERT_TRUE(find_tradeoff(plan_of("city:n=4"), program, *log));
    EXPECT_EQ(log->size(), 6u);
  }
  std::ofstream(path, std::ios::app) << "{\"scene\": \"cut o";  // in the middle of a line
  auto log = RunLog::open(path);
  ASSERT_TRUE(log) << to_string(log.error());
  const auto again = find_tradeoff(plan_of("city:n=4"), program, *log);
  ASSERT_TRUE(again);
  EXPECT_THAT(again->rows, SizeIs(6));
  std::ifstream runs(count);
  EXPECT_EQ(std::count(std::istreambuf_iterator<char>(runs), {}, 'x'), 6);

  std::ofstream(path) << "{\"format\": \"gnomon-scene\"}\n";
  const auto wrong = RunLog::open(path);
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().code, ErrorCode::kFormat);
  EXPECT_THAT(wrong.error().what, HasSubstr("line 1"));
}

/// Exact shares of a scene on kernel plane.
SideShares exact_shares(const Scene& scene) {
  const auto prepared = prepare(scene);
  EXPECT_TRUE(prepared);
  ShadowOptions options;
  options.output.exact_fractions = true;
  const auto result = compute_shadows(*prepared, options);
  EXPECT_TRUE(result);
  return shares_of(scene, *prepared, *result, true);
}

TEST(SceneChanges, ChangeNoExactAnswer) {
  for (const char* name : {"city:n=6", "room", "lattice:n=12", "grazing", "figure-6", "stairs",
                           "family-decimals", "family-crossing"}) {
    const auto source = SceneSource::parse(name);
    ASSERT_TRUE(source) << name;
    const auto scene = source->make({}, 3);
    ASSERT_TRUE(scene) << name;
    const SideShares before = exact_shares(*scene);
    for (const SceneChange& change : scene_changes()) {
      const Difference difference = difference_of(before, exact_shares(change.make(*scene)));
      EXPECT_EQ(difference.sides, 0u) << name << ", " << change.name << ": " << difference.worst;
    }
  }
}

TEST(SceneChanges, AreTold) {
  RunRequest request;
  request.scene = "city";
  request.size = 60;
  request.system = "svbsp";
  request.kernel = "double";
  request.repeat = 1;
  request.change = "polygons reversed";
  const Measurement rounded = measure(request);
  ASSERT_TRUE(rounded.difference) << rounded.why;
  request.kernel = "plane";
  const Measurement exact = measure(request);
  ASSERT_TRUE(exact.difference);
  EXPECT_EQ(exact.difference->sides, 0u);
  request.change = "nothing";
  EXPECT_EQ(measure(request).end, RunEnd::kRefused);
}

TEST(SceneChanges, SidesThatOneLacksAreDark) {
  const SideShares before = {{{"sun", "a", Side::kFront}, 0.5}, {{"sun", "b", Side::kFront}, 0}};
  const SideShares after = {{{"sun", "a", Side::kFront}, 0.5}, {{"sun", "c", Side::kBack}, 0.25}};
  const Difference difference = difference_of(before, after);
  EXPECT_EQ(difference.sides, 1u);
  EXPECT_EQ(difference.worst_share, 0.25);
  EXPECT_THAT(difference.worst, HasSubstr("polygon c (back)"));
}

}  // namespace
}  // namespace gnomon::comparison
