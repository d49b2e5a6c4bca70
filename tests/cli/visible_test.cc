// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon visible, and what goes with it: certify --eye, verify --eye, render --visible; and regions
// of lights from the command line and from files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "run_gnomon.h"

namespace gnomon::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class VisibleCommand : public testing::Test {
 protected:
  void SetUp() override {
    scene_ = directory_.file("pinwheel.json");
    ASSERT_EQ(run_gnomon({"generate", "pinwheel", "-o", scene_}).status, 0);
  }

  TestDirectory directory_;
  std::string scene_;
};

TEST_F(VisibleCommand, WritesWhatCertifyAndVerifyFindRight) {
  const std::string file = directory_.file("v.json");
  const RunResult done = run_gnomon({"visible", scene_, "--eye", "31,-27,44", "--exact-loops",
                                     "--exact-fractions", "--stats", "-o", file});
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_THAT(read_text(file), AllOf(HasSubstr("\"eye\""), HasSubstr("\"shadow\"")));
  const RunResult verified = run_gnomon({"verify", scene_, file, "--eye", "31,-27,44"});
  EXPECT_EQ(verified.status, 0) << verified.out << verified.err;
  EXPECT_THAT(verified.out, HasSubstr("every claim holds"));
  // Seen from elsewhere, it is another scene.
  EXPECT_EQ(run_gnomon({"verify", scene_, file, "--eye", "31,27,44"}).status, 1);
  EXPECT_EQ(run_gnomon({"verify", scene_, file}).status, 1);
}

TEST_F(VisibleCommand, CertifyJudgesWhatIsSeen) {
  const RunResult judged = run_gnomon({"certify", scene_, "--eye", "31,-27,44", "--algorithm",
                                       "all", "--kernel", "plane", "--kernel", "double"});
  EXPECT_EQ(judged.status, 0) << judged.out << judged.err;
  EXPECT_THAT(judged.out, AllOf(HasSubstr("plane/two-pass"), HasSubstr("identical"),
                                Not(HasSubstr("samples"))));
  const RunResult together = run_gnomon({"certify", scene_, "--eye", "31,-27,44", "--combined",
                                         "--algorithm", "svbsp", "--kernel", "plane"});
  EXPECT_EQ(together.status, 0) << together.out << together.err;
  // A raster asks for samples.
  const RunResult samples =
      run_gnomon({"certify", scene_, "--eye", "31,-27,44", "--rows", "16", "--kernel", "plane"});
  EXPECT_THAT(samples.out, HasSubstr("x 16 samples"));
}

TEST_F(VisibleCommand, WhatCastsNoShadowHides) {
  const std::string scene = directory_.file("screen.json");
  write_text(scene, R"({"format": "gnomon-scene", "version": 1,
    "vertices": [[0,0,0],[4,0,0],[4,4,0],[0,4,0],[1,1,1],[2,1,1],[2,2,1],[1,2,1]],
    "polygons": [{"id": "floor", "loop": [0,1,2,3]},
                 {"id": "glass", "loop": [4,5,6,7], "casts": false}],
    "lights": [{"id": "lamp", "type": "point", "position": [1.5,1.5,5]}]})");
  const RunResult seen = run_gnomon({"visible", scene, "--eye", "1.5,1.5,5", "--combined",
                                     "--exact-fractions", "--algorithm", "svbsp"});
  EXPECT_EQ(seen.status, 0) << seen.err;
  // 1 - (5/4)^2 / 16 of the floor is seen, and all of it is lit.
  EXPECT_THAT(seen.out, AllOf(HasSubstr("\"231/256\""), HasSubstr("\"1\"")));
}

TEST_F(VisibleCommand, RendersInAnyOrder) {
  const RunResult painted =
      run_gnomon({"render", scene_, "--eye", "31,-27,44", "--visible", "--no-legend"});
  EXPECT_EQ(painted.status, 0) << painted.err;
  EXPECT_THAT(painted.out, HasSubstr("<svg"));
  EXPECT_THAT(run_gnomon({"render", scene_, "--visible"}).err, HasSubstr("--eye x,y,z"));
  EXPECT_EQ(run_gnomon({"render", scene_, "--eye", "31,-27,44", "--visible", "--backs"}).status, 2);
}

TEST_F(VisibleCommand, ErrorsSayWhatIsExpected) {
  EXPECT_EQ(run_gnomon({"visible", scene_}).status, 2);
  EXPECT_THAT(run_gnomon({"visible", scene_, "--eye", "1,2"}).err, HasSubstr("--eye"));
  EXPECT_EQ(run_gnomon({"visible", scene_, "--eye", "1,2,3", "--algorithm", "zbuffer"}).status, 2);
  EXPECT_EQ(run_gnomon({"visible", scene_, "--eye", "1,2,3", "--kernel", "double", "--exact-loops"})
                .status,
            2);
}

TEST_F(VisibleCommand, RegionsAreReadWrittenAndJudged) {
  const std::string scene = directory_.file("region.json");
  write_text(scene, R"({"format": "gnomon-scene", "version": 1,
    "vertices": [[0,0,0],[4,0,0],[4,4,0],[0,4,0],[1,1,1],[2,1,1],[2,2,1],[1,2,1]],
    "polygons": [{"id": "floor", "loop": [0,1,2,3]}, {"id": "quad", "loop": [4,5,6,7]}],
    "lights": [{"id": "lamp", "type": "point", "position": [2,2,4],
                "region": [[[2,0,0],[2,0,1],[2,1,0]]]}]})");
  const std::string copy = directory_.file("copy.json"), result = directory_.file("r.json");
  ASSERT_EQ(run_gnomon({"convert", scene, copy}).status, 0);
  EXPECT_THAT(read_text(copy), HasSubstr("\"region\": [[[2, 0, 0], [2, 0, 1], [2, 1, 0]]]"));
  const RunResult done = run_gnomon(
      {"shadows", copy, "--exact-fractions", "--exact-loops", "--flap", "z:0:3", "-o", result});
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_THAT(read_text(result), AllOf(HasSubstr("\"7/18\""), HasSubstr("outside-region")));
  const RunResult verified = run_gnomon({"verify", copy, result, "--flap", "z:0:3"});
  EXPECT_EQ(verified.status, 0) << verified.out;
  // Without the region, what is outside of it is lit.
  write_text(scene, R"({"format": "gnomon-scene", "version": 1,
    "vertices": [[0,0,0],[4,0,0],[4,4,0],[0,4,0],[1,1,1],[2,1,1],[2,2,1],[1,2,1]],
    "polygons": [{"id": "floor", "loop": [0,1,2,3]}, {"id": "quad", "loop": [4,5,6,7]}],
    "lights": [{"id": "lamp", "type": "point", "position": [2,2,4]}]})");
  EXPECT_EQ(run_gnomon({"verify", scene, result}).status, 1);
  const RunResult judged = run_gnomon(
      {"certify", copy, "--algorithm", "all", "--kernel", "plane", "--kernel", "double"});
  EXPECT_EQ(judged.status, 0) << judged.out << judged.err;
  EXPECT_THAT(run_gnomon({"shadows", copy, "--algorithm", "contour"}).err, HasSubstr("sectors"));
  const RunResult picture =
      run_gnomon({"certify", copy, "--eye", "9,-7,6", "--rows", "24", "--columns", "24",
                  "--algorithm", "all", "--kernel", "plane"});
  EXPECT_EQ(picture.status, 0) << picture.out << picture.err;
}

TEST_F(VisibleCommand, RegionsThatAreNoneAreErrors) {
  const auto refused = [&](const std::string& region, const std::string& light) {
    const std::string scene = directory_.file("wrong.json");
    write_text(scene, R"({"format": "gnomon-scene", "version": 1,
      "vertices": [[0,0,0],[4,0,0],[4,4,0]], "polygons": [{"loop": [0,1,2]}],
      "lights": [{)" + light +
                          R"(, "region": )" + region + "}]}");
    const RunResult result = run_gnomon({"shadows", scene});
    EXPECT_EQ(result.status, 2);
    return result.err;
  };
  const std::string lamp = R"("type": "point", "position": [2,2,4])";
  EXPECT_THAT(refused("[[[0,0,0],[1,0,0]]]", lamp),
              AllOf(HasSubstr("/lights/0/region/0"), HasSubstr("three points")));
  EXPECT_THAT(refused("[[[0,0,0],[1,0,0],[0,1,0],[1,1,1]]]", lamp), HasSubstr("more than three"));
  EXPECT_THAT(refused("[[[0,0,0],[1,0],[0,1,0]]]", lamp), HasSubstr("/lights/0/region/0/1"));
  EXPECT_THAT(refused("[1]", lamp), HasSubstr("/lights/0/region/0"));
  EXPECT_THAT(refused("[[[0,0,0],[1,1,1],[2,2,2]]]", lamp), HasSubstr("on one line"));
  EXPECT_THAT(refused("[]", R"("type": "area", "loop": [[0,0,4],[0,1,4],[1,0,4]])"),
              HasSubstr("point or directional light"));
}

}  // namespace
}  // namespace gnomon::test
