// SPDX-License-Identifier: GPL-3.0-or-later
// Axes of difficulty: their scenes, the sweep with its bisection, and the rules of
// docs/extremes.md, each of which fails here if it stops holding.
#include "comparison/extremes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "comparison/extremes_text.h"
#include "comparison/run_measurement.h"
#include "gnomon/scene/prepare.h"
#include "tests/support/test_directory.h"

namespace gnomon::comparison {
namespace {

using testing::AllOf;
using testing::HasSubstr;

RunRequest request_of(const ExtremeAxis& axis, int step, bool sheared, const std::string& kernel,
                      const std::string& system) {
  RunRequest request;
  request.scene = extreme_name(axis, step, sheared);
  request.system = system;
  request.kernel = kernel;
  request.repeat = 1;
  request.certify_up_to = 1000;
  if (axis.name == "area-light") request.lights = LightsAsked::kArea;
  return request;
}

TEST(Extremes, EveryStepOfEveryAxisIsAScene) {
  for (const ExtremeAxis& axis : extreme_axes()) {
    for (const bool sheared : {false, true}) {
      for (int step = axis.first; step <= axis.last; step += axis.stride) {
        const std::string name = extreme_name(axis, step, sheared);
        const auto scene = extreme_by_name(name);
        ASSERT_TRUE(scene) << name;
        EXPECT_FALSE(scene->lights.empty()) << name;
        EXPECT_TRUE(prepare(*scene)) << name;
      }
    }
  }
  for (const char* name : {"extreme:", "extreme:offset", "extreme:offset:61", "extreme:offset:1x",
                           "extreme:offset:1:turned", "extreme:nosuch:1"}) {
    EXPECT_FALSE(SceneSource::parse(name)) << name;
  }
}

/// Hard steps of every axis, on kernel plane.
TEST(Extremes, ExactIsExact) {
  for (const ExtremeAxis& axis : extreme_axes()) {
    const bool many = axis.name == "tiles" || axis.name == "nested" || axis.name == "fan";
    const int hard = many ? axis.first + (axis.last - axis.first) / 2 : axis.last;
    for (const int step : {axis.first, hard}) {
      const std::string system = axis.name == "area-light" ? "receiver" : "sectors";
      const Measurement done = measure(request_of(axis, step, false, "plane", system));
      ASSERT_TRUE(done.judgement) << axis.name << ' ' << step << ": " << done.why;
      EXPECT_TRUE(done.judgement->confirms) << axis.name << ' ' << step;
    }
  }
}

struct SafeRange {
  const char* axis;
  int last;  // of the steps in which double is right
};

/// docs/extremes.md, "Where double is safe": double with the default thickness, by sectors.
TEST(Extremes, WhereDoubleIsSafe) {
  for (const auto& [name, last] :
       {SafeRange{"offset", 17}, SafeRange{"scale-up", 300}, SafeRange{"scale-down", 300},
        SafeRange{"slivers", 18}, SafeRange{"near-parallel", 18}, SafeRange{"far-lamp", 500},
        SafeRange{"near-lamp", 20}, SafeRange{"low-lamp", 18}, SafeRange{"grazing-sun", 18},
        SafeRange{"gap", 30}, SafeRange{"detail", 18}, SafeRange{"mixed", 11},
        SafeRange{"tiles", 8}, SafeRange{"nested", 12}, SafeRange{"fan", 6}}) {
    const ExtremeAxis* const axis = axis_by_name(name);
    ASSERT_NE(axis, nullptr) << name;
    const int stride = std::max(1, (last - axis->first) / 3);
    for (const bool sheared : {false, true}) {
      for (int step = last; step >= axis->first; step -= stride) {
        const Measurement done = measure(request_of(*axis, step, sheared, "double", "sectors"));
        ASSERT_TRUE(done.judgement) << name << ' ' << step << ": " << done.why;
        EXPECT_NE(done.judgement->verdict, "failed")
            << name << ' ' << step << (sheared ? " sheared" : "") << ": worst share "
            << done.judgement->worst_share << ", width " << done.judgement->width;
      }
    }
  }
}

class Sweeps : public testing::Test {
 protected:
  /// A run that is right up to step 21 of an axis.
  RunProgram script() const {
    const auto told = [](const std::string& verdict, double share) {
      Measurement measured;
      measured.runs = 1;
      measured.seconds = 1;
      measured.judgement.emplace();
      measured.judgement->verdict = verdict;
      measured.judgement->worst_share = share;
      measured.judgement->breaks = "misclassified: found lit, true shadow";
      return "echo '" + measurement_text(measured) + "'";
    };
    const std::string path = directory_.file("run.sh");
    std::ofstream(path) << "#!/bin/sh\nk=${1#*extreme:*:}\nk=${k%%\\\"*}\nif [ $k -le 21 ]; then\n"
                        << told("within tolerance", 1e-15) << "\nelse\n"
                        << told("failed", 0.5) << "\nfi\n";
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    return {path, {}};
  }
  ExtremesPlan plan() const {
    ExtremesPlan plan;
    plan.axes = {axis_by_name("offset")};
    plan.runs.systems = {"sectors"};
    plan.runs.kernels = {"double"};
    plan.runs.limits = {5, 0};
    plan.steps = 4;
    return plan;
  }
  test::TestDirectory directory_;
};

TEST_F(Sweeps, BisectionFindsTheStep) {
  RunLog log;
  ExtremesPlan asked = plan();
  const auto coarse = find_extremes(asked, script(), log);
  ASSERT_TRUE(coarse) << to_string(coarse.error());
  ASSERT_EQ(coarse->curves.size(), 1u);
  EXPECT_EQ(coarse->curves[0].first_failure, 40);
  EXPECT_EQ(coarse->curves[0].last_right, 20);
  EXPECT_EQ(failure_of(*coarse->curves[0].rows.back()), "misclassified");
  asked.bisect = true;
  const auto fine = find_extremes(asked, script(), log);
  ASSERT_TRUE(fine);
  EXPECT_EQ(fine->curves[0].first_failure, 22);
  EXPECT_EQ(fine->curves[0].last_right, 21);
  EXPECT_THAT(extremes_text(*fine, true), HasSubstr("fails at k"));
  EXPECT_THAT(extremes_csv(*fine), HasSubstr("offset,22,sectors,double,,misclassified,0.5"));
  report::StringSink json;
  write_extremes_json(json, *fine);
  EXPECT_THAT(json.text(), HasSubstr("\"first_failure\": 22"));
  report::StringSink plot;
  write_extremes_plot(plot, *fine);
  EXPECT_THAT(plot.text(), AllOf(HasSubstr("offset, sectors"), HasSubstr("double"),
                                 HasSubstr("below 1e-17"), HasSubstr("</svg>")));
}

TEST_F(Sweeps, ARangeThatAnAxisLacksIsAnError) {
  ExtremesPlan asked = plan();
  asked.from = 50;
  asked.to = 70;
  RunLog log;
  const auto found = find_extremes(asked, script(), log);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::kUsage);
  EXPECT_THAT(extreme_axes_text(), HasSubstr("grazing-sun"));
}

}  // namespace
}  // namespace gnomon::comparison
