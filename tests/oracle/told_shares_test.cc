// SPDX-License-Identifier: GPL-3.0-or-later
// Files that tell shares alone: right within their digits, wrong beyond, and never more than that.
#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "gnomon/oracle/verdict.h"
#include "gnomon/result/read_claims.h"
#include "scene_builder.h"

namespace gnomon::oracle {
namespace {

/// 15/16 of the floor is lit; the bent one lies in two planes, and the quad casts nothing on it.
BuiltScene table() {
  return SceneBuilder()
      .polygon("floor", {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}})
      .polygon("quad", {{1, 1, 1}, {2, 1, 1}, {2, 2, 1}, {1, 2, 1}})
      .polygon("bent", {{9, 0, 0}, {10, 0, 0}, {10, 1, 1}, {9, 1, 0}})
      .sun("sun", {0, 0, 1})
      .build();
}

Report judged(const BuiltScene& built, const std::string& polygons,
              std::optional<double> tolerance = {}, const std::string& terms = "",
              bool strict = false) {
  const std::string light = built.scene.lights.front().id;
  const Expected<Claims> claims = parse_claims(
      R"({"lights": [{"id": ")" + light + R"(", )" + terms + R"("polygons": [)" + polygons + "]}]}",
      "r.json", built.scene, SharesAlone::kTaken);
  EXPECT_TRUE(claims) << to_string(claims.error());
  CertifyOptions options;
  options.share_tolerance = tolerance;
  options.strict = strict;
  return certified(built, *claims, options);
}

const std::string kOthers = R"(, {"id": "quad", "lit": 1}, {"id": "bent", "lit": 1, "shadow": 0})";

std::string floor_lit(const std::string& share) {
  return R"({"id": "floor", "lit": )" + share + "}" + kOthers;
}

TEST(ToldShares, AgreeWithinHalfAUnitOfTheLastDigit) {
  const BuiltScene built = table();
  for (const std::string share :
       {"0.9375", "0.938", "0.94", "0.9", "\"15/16\"", "{\"area\": 15}", "{\"area\": 15.0}",
        "{\"fraction\": 0.93750}", "0.93750000000000022", "{\"area\": 15.000000000000004}"}) {
    const Report report = judged(built, floor_lit(share));
    EXPECT_EQ(report.verdict, Verdict::kSharesAgree) << share << ": " << report.reason;
    EXPECT_EQ(report.told_shares, 4u);
    EXPECT_FALSE(report.confirms_exact());
    EXPECT_EQ(report.notes.size(), 1u);
  }
  for (const std::string share :
       {"0.9374", "0.936", "0.93", "0.8", "\"14/16\"", "{\"area\": 14}", "{\"area\": 14.9}", "1",
        "-0.9375", "\"15000001/16000000\"", "0.93750000500000022", "0.93750000001"}) {
    const Report report = judged(built, floor_lit(share));
    EXPECT_EQ(report.verdict, Verdict::kFailed) << share;
    ASSERT_TRUE(report.worst);
    EXPECT_EQ(report.worst->polygon, "floor");
    EXPECT_NE(
        report.reason.find(share.find("area") == std::string::npos ? "truly 15/16" : "truly 15;"),
        std::string::npos)
        << report.reason;
    EXPECT_EQ(report.totals.wrong_polygons, 1u);
  }
}

TEST(ToldShares, ToleranceThatIsAskedForTakesThePlaceOfDigits) {
  const BuiltScene built = table();
  EXPECT_EQ(judged(built, floor_lit("0.9"), 0.03).verdict, Verdict::kFailed);
  EXPECT_EQ(judged(built, floor_lit("0.93751"), 1e-4).verdict, Verdict::kSharesAgree);
  EXPECT_EQ(judged(built, floor_lit("{\"area\": 15.001}"), 1e-4).verdict, Verdict::kSharesAgree);
  EXPECT_EQ(judged(built, floor_lit("{\"area\": 15.01}"), 1e-4).verdict, Verdict::kFailed);
  EXPECT_EQ(judged(built, floor_lit("0.9375"), {}, "", true).verdict, Verdict::kSharesAgree);
  EXPECT_EQ(judged(built, floor_lit("0.938"), {}, "", true).verdict, Verdict::kFailed);
}

TEST(ToldShares, OfSeveralPlanesAreEnclosed) {
  const BuiltScene built = table();
  EXPECT_EQ(judged(built, R"({"id": "floor", "lit": 0.9375}, {"id": "quad", "lit": "1"},
                             {"id": "bent", "lit": 0.999999})")
                .verdict,
            Verdict::kFailed);
}

TEST(ToldShares, WhatIsMissingOrUnknownFailsByName) {
  const BuiltScene built = table();
  const Report report =
      judged(built, R"({"id": "floor", "lit": 0.9375}, {"id": "desk", "lit": 1})");
  EXPECT_EQ(report.verdict, Verdict::kFailed);
  ASSERT_EQ(report.problems.size(), 3u);
  EXPECT_EQ(report.problems[0], "light 'sun': polygon 'quad' (front) is missing");
  EXPECT_EQ(report.problems[2], "light 'sun': no polygon 'desk' in the scene");
  const Report area_class =
      judged(built, R"({"id": "floor", "lit": 0.9375, "umbra": 0.0625, "penumbra": 0})" + kOthers);
  EXPECT_EQ(area_class.verdict, Verdict::kFailed);
  ASSERT_EQ(area_class.problems.size(), 1u);
  EXPECT_EQ(
      area_class.problems[0],
      "light 'sun': polygon 'floor' has a share of class 'umbra'; lit or shadow was expected");
}

TEST(ToldShares, WithFragmentsBesidesEachIsJudgedAsItIsTold) {
  const BuiltScene built = table();
  const std::string floor =
      R"({"id": "floor", "fragments": [
          {"class": "lit", "loop": [[0,0,0],[4,0,0],[4,4,0],[0,4,0]],
           "holes": [[[1,1,0],[2,1,0],[2,2,0],[1,2,0]]]},
          {"class": "shadow", "loop": [[1,1,0],[2,1,0],[2,2,0],[1,2,0]]}]})";
  EXPECT_EQ(judged(built, floor + kOthers).verdict, Verdict::kSharesAgree);
  EXPECT_EQ(
      judged(built, floor + R"(, {"id": "quad", "lit": 0}, {"id": "bent", "lit": 1})").verdict,
      Verdict::kFailed);
}

// A panel over a table: all that is not lit may be called penumbra, or umbra, unless that is
// claimed per caster.
TEST(ToldShares, OfAreaLights) {
  const BuiltScene built = SceneBuilder()
                               .polygon("floor", {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}})
                               .polygon("top", {{1, 1, 1}, {3, 1, 1}, {3, 3, 1}, {1, 3, 1}})
                               .area("panel", {{1, 1, 2}, {1, 3, 2}, {3, 3, 2}, {3, 1, 2}})
                               .build();
  const auto verdict = [&](const std::string& floor, const std::string& terms = "") {
    return judged(built, R"({"id": "floor", )" + floor + R"(}, {"id": "top", "lit": 1})", {}, terms)
        .verdict;
  };
  const std::string per_caster = R"("umbra": "per-caster", )";
  EXPECT_EQ(verdict(R"("lit": 0, "penumbra": 0.75, "umbra": 0.25)"), Verdict::kSharesAgree);
  EXPECT_EQ(verdict(R"("lit": 0, "penumbra": 0.75, "umbra": 0.25)", per_caster),
            Verdict::kSharesAgree);
  EXPECT_EQ(verdict(R"("lit": 0, "penumbra": 1.00, "umbra": 0.00)"), Verdict::kSharesAgree);
  EXPECT_EQ(verdict(R"("lit": 0, "penumbra": 1.00, "umbra": 0.00)", per_caster), Verdict::kFailed);
  EXPECT_EQ(verdict(R"("lit": 0.25, "penumbra": 0.75)"), Verdict::kFailed);
  EXPECT_EQ(verdict(R"("penumbra": 0.50, "umbra": 0.25)"), Verdict::kFailed);
  EXPECT_EQ(verdict(R"("penumbra": 1.50, "umbra": -0.50)"), Verdict::kFailed);
}

}  // namespace
}  // namespace gnomon::oracle
