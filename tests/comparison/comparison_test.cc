// SPDX-License-Identifier: GPL-3.0-or-later
// The plan, the runner of processes (with shell scripts in place of the program), growth, tables.
#include "comparison/comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "comparison/comparison_text.h"
#include "gnomon/algorithms/method.h"
#include "tests/support/test_directory.h"

namespace gnomon::comparison {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

ComparePlan plan_of(const std::vector<std::string>& scenes) {
  ComparePlan plan;
  for (const std::string& scene : scenes) plan.scenes.push_back(*SceneSource::parse(scene));
  plan.kernels = {"double", "plane"};
  plan.limits = {5, 0};
  return plan;
}

TEST(Plan, ScenesBySizeSystemAndKernel) {
  ComparePlan plan = plan_of({"quads", "room"});
  plan.sizes = {40, 10};
  plan.systems = {"svbsp", "basic"};
  const auto planned = planned_runs(plan);
  ASSERT_TRUE(planned);
  std::vector<std::string> rows;
  for (const auto& [request, polygons] : *planned) {
    rows.push_back(request.scene + ' ' + std::to_string(polygons) + ' ' + request.system + ' ' +
                   request.kernel);
  }
  EXPECT_THAT(rows,
              ElementsAre("quads 10 svbsp double", "quads 10 svbsp plane", "quads 10 basic double",
                          "quads 10 basic plane", "quads 40 svbsp double", "quads 40 svbsp plane",
                          "quads 40 basic double", "quads 40 basic plane", "room 106 svbsp double",
                          "room 106 svbsp plane", "room 106 basic double", "room 106 basic plane"));
}

TEST(Plan, WithoutSystemsAllThatTakeTheLights) {
  std::size_t point = 0, area = 0;
  for (const Method& method : methods()) {
    point += method.lights.point && method.chosen_by_name ? 1 : 0;
    area += method.lights.area && method.chosen_by_name ? 1 : 0;
  }
  EXPECT_THAT(*planned_runs(plan_of({"figure-6"})), SizeIs(2 * area));
  // Of both kinds of lights, the point lights.
  EXPECT_THAT(*planned_runs(plan_of({"city:n=2,area=2"})), SizeIs(2 * point));
}

TEST(Plan, ASizeThatGivesASceneAgainIsLeftOut) {
  ComparePlan plan = plan_of({"tetra"});
  plan.systems = {"svbsp"};
  plan.kernels = {"double"};
  plan.sizes = {300, 400, 1100};
  EXPECT_THAT(*planned_runs(plan), SizeIs(2));
}

TEST(Plan, SlowKernelsMayBeLeftOutOfLargeScenes) {
  ComparePlan plan = plan_of({"quads"});
  plan.systems = {"svbsp"};
  plan.sizes = {10, 40};
  plan.most_polygons["plane"] = 10;
  EXPECT_THAT(*planned_runs(plan), SizeIs(3));
}

TEST(Growth, IsTheSlopeOfLogarithms) {
  EXPECT_NEAR(growth_exponent({100, 1000, 10000}, {1, 100, 10000}), 2, 1e-12);
  EXPECT_NEAR(growth_exponent({10, 100}, {5, 50}), 1, 1e-12);
  // Least squares, not the ends.
  EXPECT_NEAR(growth_exponent({1, std::exp(1.0), std::exp(2.0)}, {1, std::exp(1.0), 1}), 0, 1e-12);
}

/// A script in place of `gnomon measure`; the request is its argument.
class Processes : public testing::Test {
 protected:
  RunProgram script(const std::string& body) const {
    const std::string path = directory_.file("run.sh");
    std::ofstream(path) << "#!/bin/sh\n" << body << '\n';
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    return {path, {}};
  }
  static std::string told(double seconds, const std::string& checksum) {
    Measurement measured;
    measured.polygons = 9;
    measured.runs = 1;
    measured.seconds = seconds;
    measured.checksum = checksum;
    return "echo '" + measurement_text(measured) + "'\n";
  }
  Measurement run(const std::string& body, const RunLimits& limits = {5, 0}) const {
    const auto measured = run_in_process(script(body), request_, limits);
    EXPECT_TRUE(measured) << to_string(measured.error());
    return measured ? *measured : Measurement{};
  }

  test::TestDirectory directory_;
  RunRequest request_{"city", 100, 1, "svbsp", "double", LightsAsked::kPoint, 0, 0};
};

TEST_F(Processes, TheLastWordCounts) {
  const Measurement measured = run(told(1, "") + told(1, "abc"));
  EXPECT_EQ(measured.end, RunEnd::kMeasured);
  EXPECT_EQ(measured.checksum, "abc");
}

TEST_F(Processes, EveryEndIsARow) {
  EXPECT_EQ(run("sleep 60", {0.2, 0}).end, RunEnd::kTime);
  EXPECT_EQ(run("kill -SEGV $$").end, RunEnd::kCrashed);
  EXPECT_THAT(run("kill -SEGV $$").why, HasSubstr("signal 11"));
  EXPECT_EQ(run("echo 'gnomon: out of memory' >&2; exit 3").end, RunEnd::kMemory);
  EXPECT_EQ(run("echo 'GNU MP: Cannot allocate memory' >&2; kill -ABRT $$").end, RunEnd::kMemory);
  EXPECT_EQ(run("exit 7").end, RunEnd::kCrashed);
  EXPECT_EQ(run("echo nonsense").end, RunEnd::kCrashed);
}

TEST_F(Processes, ALimitLeavesWhatWasToldBefore) {
  const Measurement measured = run(told(2, "abc") + "sleep 60", {0.5, 0});
  EXPECT_EQ(measured.end, RunEnd::kTime);
  EXPECT_TRUE(measured.timed());
  EXPECT_EQ(measured.checksum, "abc");
  EXPECT_THAT(measured.why, HasSubstr("while it was judged"));
}

TEST_F(Processes, AProgramThatIsNotThereIsAnError) {
  const auto measured = run_in_process({"/nowhere/gnomon", {}}, request_, {5, 0});
  ASSERT_FALSE(measured);
  EXPECT_EQ(measured.error().code, ErrorCode::kFile);
}

TEST_F(Processes, RatiosGrowthAndWhatIsNotRun) {
  ComparePlan plan = plan_of({"quads"});
  plan.sizes = {10, 100, 1000};
  plan.systems = {"svbsp", "basic", "tiling"};
  plan.kernels = {"double"};
  plan.limits.seconds = 1;
  // svbsp is linear, basic crashes at 100, tiling takes too long from 100 on.
  const std::string body =
      "case \"$1\" in\n"
      "*'\"size\": 100,'*basic*) kill -SEGV $$;;\n"
      "*'\"size\": 10,'*) s=1;; *'\"size\": 100,'*) s=10;; *) s=100;; esac\n"
      "case \"$1\" in *tiling*) [ $s = 1 ] || sleep 60;; *basic*) s=$((s * 3));; esac\n"
      "echo '" +
      measurement_text([] {
        Measurement measured;
        measured.runs = 1;
        measured.seconds = 0.5;
        return measured;
      }()) +
      "' | sed \"s/\\\"seconds\\\": 0.5/\\\"seconds\\\": $s.0/\"\n";
  const auto comparison = compare(plan, script(body));
  ASSERT_TRUE(comparison) << to_string(comparison.error());
  ASSERT_THAT(comparison->rows, SizeIs(9));
  EXPECT_FALSE(comparison->interrupted);
  EXPECT_THAT(comparison->contradictions, IsEmpty());
  EXPECT_EQ(comparison->rows[0].ratio, 1);
  EXPECT_EQ(comparison->rows[1].ratio, 3);
  EXPECT_EQ(comparison->rows[4].measurement.end, RunEnd::kCrashed);
  EXPECT_EQ(comparison->rows[5].measurement.end, RunEnd::kTime);
  EXPECT_EQ(comparison->rows[7].ratio, 3);
  EXPECT_EQ(comparison->rows[8].measurement.end, RunEnd::kNotRun);
  ASSERT_THAT(comparison->growth, SizeIs(2));
  EXPECT_EQ(comparison->growth[0].system, "svbsp");
  EXPECT_NEAR(comparison->growth[0].exponent, 1, 1e-9);
  EXPECT_EQ(comparison->growth[0].last, 6u);
  EXPECT_EQ(comparison->growth[1].sizes, 2u);

  const std::string table = comparison_text(*comparison, {.commands = true});
  EXPECT_THAT(table, AllOf(HasSubstr("crashed: signal 11"), HasSubstr("time limit: no end within"),
                           HasSubstr("not run: too much at size 100"), HasSubstr("n^1"),
                           HasSubstr("gnomon compare quads --size 1000 --algorithm tiling")));
  const std::string csv = comparison_csv(*comparison, true);
  EXPECT_EQ(std::ranges::count(csv, '\n'), 10);
  EXPECT_THAT(csv, HasSubstr("\nquads,10,10,svbsp,double,measured,"));
  EXPECT_THAT(comparison_csv(*comparison, false), Not(HasSubstr("seconds")));
  report::StringSink json;
  write_comparison_json(json, *comparison, false);
  EXPECT_THAT(json.text(), AllOf(HasSubstr("\"end\": \"not run\""), Not(HasSubstr("cpu_seconds")),
                                 Not(HasSubstr("growth"))));
}

TEST_F(Processes, ExactKernelsThatDifferAreContradictions) {
  ComparePlan plan = plan_of({"quads:n=4"});
  plan.systems = {"svbsp", "basic"};
  plan.kernels = {"plane"};
  Measurement measured;
  measured.exact = true;
  measured.runs = 1;
  measured.seconds = 1;
  measured.checksum = "aaaa";
  const std::string body = "echo '" + measurement_text(measured) +
                           "' | case \"$1\" in *basic*) sed s/aaaa/bbbb/;; *) cat;; esac";
  const auto comparison = compare(plan, script(body));
  ASSERT_TRUE(comparison);
  EXPECT_THAT(comparison->contradictions,
              ElementsAre(AllOf(HasSubstr("plane/basic"), HasSubstr("plane/svbsp"))));
  EXPECT_THAT(comparison_text(*comparison), HasSubstr("a bug of ours"));
}

TEST_F(Processes, AnInterruptKeepsTheRowsThatAreThere) {
  ComparePlan plan = plan_of({"quads:n=4"});
  plan.systems = {"svbsp", "basic"};
  plan.kernels = {"double"};
  std::atomic<bool> stop = false;
  CompareControl control;
  control.interrupted = &stop;
  control.progress = [&](const RunRequest& request, std::size_t, std::size_t) {
    if (request.system == "basic") stop = true;
  };
  const auto comparison = compare(plan, script(told(1, "x") + "sleep 0.2"), control);
  ASSERT_TRUE(comparison);
  EXPECT_TRUE(comparison->interrupted);
  EXPECT_THAT(comparison->rows, SizeIs(1));
}

TEST(Commands, RepeatTheRow) {
  RunRequest request{"city:light=1",      100, 7,           "tiling:tiles=8", "double+thin",
                     LightsAsked::kPoint, 3,   kCertifyUpTo};
  EXPECT_EQ(command_of(request, {}),
            "gnomon compare city:light=1 --size 100 --seed 7 --algorithm tiling:tiles=8 --kernel "
            "double+thin --repeat 3");
  request = {"my scene's.json", {}, 1, "svbsp", "plane", LightsAsked::kPoint, 0, 0};
  EXPECT_EQ(command_of(request, {5, 100}),
            "gnomon compare 'my scene'\\''s.json' --algorithm svbsp --kernel plane "
            "--certify-up-to 0 --time 5 --memory 100");
}

}  // namespace
}  // namespace gnomon::comparison
