// SPDX-License-Identifier: GPL-3.0-or-later
// The scenes of tests/regressions: each shows one thing, says which in "extra", and gives exact
// fractions that were worked out by hand. y_*: every kernel under every policy gets it right by
// both algorithms. i_*: rounded kernels may differ, and those that are listed under "wrong" for an
// algorithm must: when one turns right, the list is out of date. What only one algorithm gets wrong
// the other must get right: sectors computes planes from input polygons alone.
#include <gtest/gtest.h>
#include <rapidjson/document.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "exact_check.h"

namespace gnomon::test {
namespace {

const std::vector<std::string> kRoundedPolicies = {
    "float@0",      "float@1e-12",  "float+identity@0",      "float+identity@1e-12",
    "double@0",     "double@1e-12", "double+identity@0",     "double+identity@1e-12",
    "longdouble@0", "epick",        "longdouble+identity@0", "epick+identity"};

std::vector<std::string> names() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(GNOMON_REGRESSIONS)) {
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

class Regression : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    case_ = Case::make(regression_scene(GetParam()));
    ASSERT_TRUE(case_);
    extra_.Parse(case_->scene().extra.c_str());
    ASSERT_TRUE(extra_.IsObject()) << "no \"extra\"";
    ASSERT_TRUE(extra_.HasMember("shows") && extra_["shows"].IsString());
  }

  oracle::Report judged(const std::string& policy, Algorithm algorithm) {
    const Expected<ShadowResult> result =
        compute_shadows(case_->prepared(), options_by_name(policy, algorithm));
    EXPECT_TRUE(result) << to_string(result.error());
    return judge(*case_, *result, false);
  }

  /// "wrong" of the scene.
  std::vector<std::string> wrong(Algorithm algorithm) {
    std::vector<std::string> policies;
    for (const auto& policy : extra_["wrong"][name_of(algorithm).c_str()].GetArray()) {
      policies.push_back(policy.GetString());
    }
    return policies;
  }

  std::unique_ptr<Case> case_;
  rapidjson::Document extra_;
};

TEST_P(Regression, ExactKernelsAndOracleAgree) { EXPECT_EQ(check_exact(*case_), ""); }

TEST_P(Regression, FractionsAreThoseWorkedOutByHand) {
  ASSERT_TRUE(extra_.HasMember("lit"));
  const auto check = [&](const ShadowOptions& options) {
    for (const auto& light : extra_["lit"].GetObject()) {
      for (const auto& polygon : light.value.GetObject()) {
        mpq_class expected(polygon.value.GetString());
        expected.canonicalize();
        EXPECT_EQ(
            lit_fraction_of(*case_, options, light.name.GetString(), polygon.name.GetString()),
            expected)
            << light.name.GetString() << ", " << polygon.name.GetString();
      }
    }
  };
  ShadowOptions options = options_for(KernelId::kPlane);
  options.algorithm = Algorithm::kSvbsp;
  for (options.seed = 1; options.seed <= 8; ++options.seed) check(options);  // orders of splitting
  options.algorithm = Algorithm::kSectors;
  for (options.leaf_size = 0; options.leaf_size <= 4; ++options.leaf_size) check(options);
}

TEST_P(Regression, RoundedKernels) {
  for (const Algorithm algorithm : kAlgorithms) {
    SCOPED_TRACE(name_of(algorithm));
    if (GetParam().starts_with("y_")) {
      for (const std::string& policy : kRoundedPolicies) {
        const oracle::Report report = judged(policy, algorithm);
        EXPECT_NE(report.verdict, oracle::Verdict::kFailed) << policy << ": " << report.reason;
      }
      continue;
    }
    ASSERT_TRUE(extra_.HasMember("wrong"));
    EXPECT_EQ(judged("plane", algorithm).verdict, oracle::Verdict::kIdentical);
    for (const std::string& policy : wrong(algorithm)) {
      const oracle::Report report = judged(policy, algorithm);
      EXPECT_EQ(report.verdict, oracle::Verdict::kFailed) << policy << " turned right";
      ASSERT_TRUE(report.worst) << policy;
      EXPECT_NE(report.worst->kind, oracle::ErrorKind::kNone);
      EXPECT_NE(report.worst->text, "");
      EXPECT_NE(report.reason, "");
    }
  }
}

TEST_P(Regression, WhatOneAlgorithmGetsWrongAndTheOtherDoesNot) {
  if (!extra_.HasMember("wrong")) GTEST_SKIP() << "every kernel is right";
  for (const Algorithm algorithm : kAlgorithms) {
    const std::vector<std::string> own = wrong(algorithm);
    for (const std::string& policy : wrong(kAlgorithms[algorithm == kAlgorithms[0] ? 1 : 0])) {
      if (std::find(own.begin(), own.end(), policy) != own.end()) continue;
      const oracle::Report report = judged(policy, algorithm);
      EXPECT_NE(report.verdict, oracle::Verdict::kFailed)
          << policy << " by " << name_of(algorithm) << ": " << report.reason;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Regression, testing::ValuesIn(names()),
                         [](const auto& info) { return info.param; });

TEST(Regressions, AreThere) { EXPECT_GT(names().size(), 10u); }

TEST(Regressions, SlantedThroughIsSplitAtAll) {
  // The scene would show nothing if no order of splitting cut A.
  const auto scene = Case::make(regression_scene("y_slanted_through"));
  ASSERT_TRUE(scene);
  unsigned split = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    ShadowOptions options = options_for(KernelId::kPlane);
    options.algorithm = Algorithm::kSvbsp;
    options.seed = seed;
    const Expected<ShadowResult> result = compute_shadows(scene->prepared(), options);
    ASSERT_TRUE(result);
    split += result->bsp_fragments > scene->prepared().parts.size() ? 1 : 0;
  }
  EXPECT_GT(split, 0u);
}

}  // namespace
}  // namespace gnomon::test
