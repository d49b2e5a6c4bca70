// SPDX-License-Identifier: GPL-3.0-or-later
// KnownWrong, area lights: the papers' warnings about precision that concern them, each shown by
// the oracle. A test fails when a rounded kernel turns right: then the scene no longer shows
// anything.
#include <gtest/gtest.h>

#include <string>

#include "area_check.h"

namespace gnomon::test {
namespace {

class AreaKnownWrong : public testing::Test {
 protected:
  void load(const std::string& name) {
    case_ = Case::make(regression_scene(name));
    ASSERT_TRUE(case_);
  }
  oracle::Report failed(const std::string& policy) {
    const Expected<ShadowResult> result =
        compute_shadows(case_->prepared(), options_by_name(policy, MethodId::kSectors));
    EXPECT_TRUE(result);
    oracle::Report report = judge(*case_, *result, false);
    EXPECT_EQ(report.verdict, oracle::Verdict::kFailed) << policy << " turned right";
    EXPECT_TRUE(report.worst) << policy;
    return report;
  }
  std::unique_ptr<Case> case_;
};

TEST_F(AreaKnownWrong, Warning1And2PlanesAndEdgesOfFragments) {
  // Without identity an edge's pieces are not on the plane that cut them: a whole umbra is lost.
  load("i_crossing");
  const oracle::Report report = failed("double@0");
  EXPECT_EQ(report.worst->found, LightState::kLit);
  EXPECT_GT(report.totals.width.lower, 0.1);
}

TEST_F(AreaKnownWrong, Warning4LightInThePlaneOfAPolygon) {
  load("i_decimals");
  for (const std::string policy : {"double@0", "longdouble@0", "epick"}) {
    const oracle::Report report = failed(policy);
    EXPECT_EQ(report.worst->found, LightState::kLit) << policy;
    EXPECT_EQ(report.worst->truth, LightState::kUmbra) << policy;
  }
  // A thickness helps here, and harms where the light is just in front.
  load("i_thickness_too_large");
  EXPECT_EQ(failed("double@1e-12").worst->truth, LightState::kLit);
}

TEST_F(AreaKnownWrong, Warning5MissingPenumbraIsAnError) {
  for (const std::string name : {"i_light_shares_features", "i_needles"}) {
    load(name);
    const oracle::Report report = failed("double@0");
    EXPECT_EQ(report.worst->found, LightState::kLit) << name;
    EXPECT_EQ(report.worst->truth, LightState::kPenumbra) << name;
  }
}

TEST_F(AreaKnownWrong, Warning6LightCutByAPolygonsPlane) {
  load("i_light_cut");
  EXPECT_EQ(failed("double@0").worst->truth, LightState::kPenumbra);
  load("i_light_cut_rounded_points");
  EXPECT_EQ(failed("epick").worst->truth, LightState::kPenumbra);
}

}  // namespace
}  // namespace gnomon::test
