// SPDX-License-Identifier: GPL-3.0-or-later
// KnownWrong: what rounded kernels get wrong, one test for each warning about precision that the
// papers give for point lights. The oracle names the failure; the kernel `plane` is identical on
// the same scene. A test fails when a rounded kernel turns right: then the scene no longer shows
// anything.
//
// The seventh warning, the limited field of view of a perspective mapping, does not apply: no
// kernel maps the scene, and a lamp in a closed room (i_lamp_inside) is only hard for float with a
// thickness.
#include <gtest/gtest.h>

#include <string>

#include "exact_check.h"

namespace gnomon::test {
namespace {

class KnownWrong : public testing::Test {
 protected:
  void load(const std::string& name) {
    case_ = Case::make(regression_scene(name));
    ASSERT_TRUE(case_);
    ASSERT_EQ(check_exact(*case_), "");
    const oracle::Report plane = judged("plane");
    EXPECT_EQ(plane.verdict, oracle::Verdict::kIdentical);
    EXPECT_EQ(plane.totals.misclassified.upper, 0);
    EXPECT_EQ(plane.totals.uncovered.upper, 0);
    EXPECT_EQ(plane.totals.overlapping.upper, 0);
  }
  oracle::Report judged(const std::string& policy) {
    const Expected<ShadowResult> result =
        compute_shadows(case_->prepared(), options_by_name(policy));
    EXPECT_TRUE(result);
    return judge(*case_, *result, false);
  }
  /// Failed, with the worst place and why.
  oracle::Report failed(const std::string& policy) {
    const oracle::Report report = judged(policy);
    EXPECT_EQ(report.verdict, oracle::Verdict::kFailed) << policy << " turned right";
    EXPECT_TRUE(report.worst && !report.worst->text.empty()) << policy;
    return report;
  }
  static double share(const oracle::Enclosure& part, const oracle::Report& report) {
    return part.lower / report.totals.area.upper;
  }

  std::unique_ptr<Case> case_;
};

TEST_F(KnownWrong, Warning1PlanesComputedAnewFromFragments) {
  load("i_plane_recomputed");
  for (const std::string policy : {"double@0", "longdouble@0", "epick"}) {
    const oracle::Report report = failed(policy);
    ASSERT_TRUE(report.worst);
    EXPECT_EQ(report.worst->found, oracle::ShadeClass::kShadow) << policy;
    EXPECT_EQ(report.worst->truth, oracle::ShadeClass::kLit) << policy;
    EXPECT_GT(report.totals.width.lower, 1.0) << policy;  // a blunder, not a sliver
  }
  // The same number types with planes that are copied are right.
  for (const std::string policy :
       {"double+identity@0", "longdouble+identity@0", "epick+identity"}) {
    EXPECT_NE(judged(policy).verdict, oracle::Verdict::kFailed) << policy;
  }
}

TEST_F(KnownWrong, Warning2PiecesOfAnEdgeAreNotCollinear) {
  load("i_crack_in_needle");
  for (const std::string policy : {"double@0", "double@1e-12", "double+identity@0",
                                   "double+identity@1e-12", "epick", "epick+identity"}) {
    const oracle::Report report = failed(policy);
    // The fragments no longer tile the needle: something is covered by nothing or lies outside.
    EXPECT_GT(report.totals.uncovered.lower + report.totals.overlapping.lower, 0) << policy;
    EXPECT_GT(report.totals.outside.lower, 0) << policy;
    EXPECT_GT(report.totals.worst_uncovered, 1e-9) << policy;
  }
}

TEST_F(KnownWrong, Warning3VerticesOnTheEdgesOfOthers) {
  load("i_crack_in_needle");
  for (const std::string policy : {"double@0", "double@1e-12", "double+identity@0"}) {
    const oracle::Report report = failed(policy);
    EXPECT_GT(report.totals.t_vertices, 0u) << policy;
    EXPECT_GT(report.totals.uncovered.lower, 0) << policy;
  }
}

TEST_F(KnownWrong, Warning4LightInThePlane) {
  load("i_light_in_plane");
  for (const std::string policy : {"float@0", "float@1e-12", "double@0", "double+identity@0",
                                   "longdouble@0", "epick", "epick+identity"}) {
    const oracle::Report report = failed(policy);
    ASSERT_TRUE(report.worst);
    EXPECT_EQ(report.worst->found, oracle::ShadeClass::kLit) << policy;
    EXPECT_EQ(report.worst->truth, oracle::ShadeClass::kShadow) << policy;
    EXPECT_NE(report.worst->text.find("in its plane"), std::string::npos) << report.worst->text;
  }
  // Here a thickness helps; a lamp far away takes that back, see the next.
  EXPECT_NE(judged("double@1e-12").verdict, oracle::Verdict::kFailed);
}

TEST_F(KnownWrong, Warning4LampFarAwayInThePlane) {
  load("i_light_in_plane_far");
  for (const std::string policy :
       {"float@0", "double@0", "double@1e-12", "double+identity@0", "double+identity@1e-12"}) {
    const oracle::Report report = failed(policy);
    ASSERT_TRUE(report.worst);
    EXPECT_EQ(report.worst->truth, oracle::ShadeClass::kShadow) << policy;
  }
  EXPECT_NE(judged("epick").verdict, oracle::Verdict::kFailed);
}

TEST_F(KnownWrong, Warning4SunInThePlane) {
  load("i_sun_in_plane");
  failed("float@1e-12");  // a thickness below what the number type rounds is worse than none
  EXPECT_EQ(judged("float@0").verdict, oracle::Verdict::kIdentical);
}

TEST_F(KnownWrong, CoplanarPolygonsShadowEachOther) {
  load("i_panes_of_decimals");
  for (const std::string policy : {"float@0", "float@1e-12", "double@0", "longdouble@0", "epick"}) {
    failed(policy);
  }
  EXPECT_NE(judged("double+identity@0").verdict, oracle::Verdict::kFailed);
}

TEST_F(KnownWrong, LampNearAVertex) {
  load("i_lamp_near_vertex");
  for (const std::string policy : {"float@0", "double@0", "double@1e-12", "double+identity@0",
                                   "double+identity@1e-12", "epick"}) {
    const oracle::Report report = failed(policy);
    EXPECT_GT(share(report.totals.misclassified, report), 1e-9) << policy;
  }
}

}  // namespace
}  // namespace gnomon::test
