// SPDX-License-Identifier: GPL-3.0-or-later
// The scenes of tests/regressions/area: each shows one thing about area lights and says which in
// "extra", with fractions of lit, penumbra and umbra that were worked out by hand. y_*: every
// kernel gets it right. i_*: rounded kernels may differ, and those listed under "wrong" must: when
// one turns right, the list is out of date.
#include <gtest/gtest.h>
#include <rapidjson/document.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "area_check.h"

namespace gnomon::test {
namespace {

const std::vector<std::string> kRoundedPolicies = {"float@1e-6",
                                                   "float+identity@1e-6",
                                                   "double@1e-12",
                                                   "double+identity@1e-12",
                                                   "longdouble@1e-12",
                                                   "epick",
                                                   "longdouble+identity@0",
                                                   "epick+identity"};

std::vector<std::string> names() {
  std::vector<std::string> names;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(GNOMON_REGRESSIONS) + "/area")) {
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

class AreaRegression : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    case_ = Case::make(regression_scene("area/" + GetParam()));
    ASSERT_TRUE(case_);
    extra_.Parse(case_->scene().extra.c_str());
    ASSERT_TRUE(extra_.IsObject()) << "no \"extra\"";
    ASSERT_TRUE(extra_.HasMember("shows") && extra_["shows"].IsString());
  }

  oracle::Report judged(const std::string& policy) {
    const Expected<ShadowResult> result =
        compute_shadows(case_->prepared(), options_by_name(policy, Algorithm::kSectors));
    EXPECT_TRUE(result) << to_string(result.error());
    return judge(*case_, *result, false);
  }

  std::unique_ptr<Case> case_;
  rapidjson::Document extra_;
};

TEST_P(AreaRegression, ExactKernelsAndOracleAgree) { EXPECT_EQ(check_area_exact(*case_), ""); }

TEST_P(AreaRegression, FractionsAreThoseWorkedOutByHand) {
  if (GetParam().starts_with("i_")) GTEST_SKIP() << "found by a search";
  ASSERT_TRUE(extra_.HasMember("fractions"));
  for (const auto& light : extra_["fractions"].GetObject()) {
    for (const auto& polygon : light.value.GetObject()) {
      const Fractions3 found = area_fractions_of(*case_, options_for(KernelId::kPlane),
                                                 light.name.GetString(), polygon.name.GetString());
      const auto expected = polygon.value.GetArray();
      ASSERT_EQ(expected.Size(), 3u);
      EXPECT_EQ(found.lit, mpq_class(expected[0].GetString())) << polygon.name.GetString();
      EXPECT_EQ(found.penumbra, mpq_class(expected[1].GetString())) << polygon.name.GetString();
      EXPECT_EQ(found.umbra, mpq_class(expected[2].GetString())) << polygon.name.GetString();
    }
  }
}

TEST_P(AreaRegression, RoundedKernels) {
  if (GetParam().starts_with("y_")) {
    for (const std::string& policy : kRoundedPolicies) {
      // A float's rounding is no blunder.
      const oracle::Report report = judged(policy);
      EXPECT_LT(report.totals.width.upper, 1e-4) << policy << ": " << report.reason;
    }
    return;
  }
  ASSERT_TRUE(extra_.HasMember("wrong"));
  for (const auto& policy : extra_["wrong"].GetArray()) {
    const oracle::Report report = judged(policy.GetString());
    EXPECT_EQ(report.verdict, oracle::Verdict::kFailed) << policy.GetString() << " turned right";
    ASSERT_TRUE(report.worst) << policy.GetString();
    EXPECT_NE(report.reason, "");
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, AreaRegression, testing::ValuesIn(names()),
                         [](const auto& info) { return info.param; });

TEST(AreaRegressions, AreThere) { EXPECT_GT(names().size(), 8u); }

/// The papers' warnings about precision that concern area lights, each shown by the oracle.
class AreaKnownWrong : public testing::Test {
 protected:
  void load(const std::string& name) {
    case_ = Case::make(regression_scene("area/" + name));
    ASSERT_TRUE(case_);
  }
  oracle::Report failed(const std::string& policy) {
    const Expected<ShadowResult> result =
        compute_shadows(case_->prepared(), options_by_name(policy, Algorithm::kSectors));
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
  EXPECT_EQ(report.worst->found, oracle::ShadeClass::kLit);
  EXPECT_GT(report.totals.width.lower, 0.1);
}

TEST_F(AreaKnownWrong, Warning4LightInThePlaneOfAPolygon) {
  load("i_decimals");
  for (const std::string policy : {"double@0", "longdouble@0", "epick"}) {
    const oracle::Report report = failed(policy);
    EXPECT_EQ(report.worst->found, oracle::ShadeClass::kLit) << policy;
    EXPECT_EQ(report.worst->truth, oracle::ShadeClass::kUmbra) << policy;
  }
  // A thickness helps here, and harms where the light is just in front.
  load("i_thickness_too_large");
  EXPECT_EQ(failed("double@1e-12").worst->truth, oracle::ShadeClass::kLit);
}

TEST_F(AreaKnownWrong, Warning5MissingPenumbraIsAnError) {
  for (const std::string name : {"i_light_shares_features", "i_needles"}) {
    load(name);
    const oracle::Report report = failed("double@0");
    EXPECT_EQ(report.worst->found, oracle::ShadeClass::kLit) << name;
    EXPECT_EQ(report.worst->truth, oracle::ShadeClass::kPenumbra) << name;
  }
}

TEST_F(AreaKnownWrong, Warning6LightCutByAPolygonsPlane) {
  load("i_light_cut");
  EXPECT_EQ(failed("double@0").worst->truth, oracle::ShadeClass::kPenumbra);
  load("i_light_cut_rounded_points");
  EXPECT_EQ(failed("epick").worst->truth, oracle::ShadeClass::kPenumbra);
}

}  // namespace
}  // namespace gnomon::test
