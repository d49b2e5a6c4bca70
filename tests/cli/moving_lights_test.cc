// SPDX-License-Identifier: GPL-3.0-or-later
// shadows --move: a file a step, byte for byte that of a run with the light there; all steps in one
// file; and what cannot be moved.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidjson/document.h>

#include <string>
#include <vector>

#include "run_gnomon.h"

namespace gnomon::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class MovingLights : public testing::Test {
 protected:
  void SetUp() override {
    write_text(scene_, R"({"format": "gnomon-scene", "version": 1, "two_sided": true,
      "vertices": [[-8,-8,0], [8,-8,0], [8,8,0], [-8,8,0], [-1,-1,2], [1,-1,2], [1,1,2], [-1,1,2],
                   [-8,-8,9], [8,-8,9]],
      "polygons": [{"id": "floor", "loop": [0,1,2,3]}, {"id": "quad", "loop": [4,5,6,7]},
                   {"id": "wall", "loop": [0,1,9,8]}]})");
  }
  /// shadows --combined under three lights, the second of them there.
  std::vector<std::string> arguments(const std::string& second) const {
    return {"shadows",       scene_,    "--combined", "--fragments",
            "--point=0,0,6", "--point", second,       "--point",
            "-3,2,5",        "--jobs",  "1"};
  }
  RunResult run(std::vector<std::string> options) const {
    std::vector<std::string> all = arguments("2,1,7");
    all.insert(all.end(), options.begin(), options.end());
    return run_gnomon(all);
  }
  void expect_refused(const std::vector<std::string>& options,
                      const std::vector<std::string>& words) const {
    const RunResult done = run(options);
    EXPECT_EQ(done.status, 2) << done.err;
    EXPECT_EQ(done.out, "");
    for (const std::string& word : words) EXPECT_THAT(done.err, HasSubstr(word));
  }

  TestDirectory directory_;
  std::string scene_ = directory_.file("scene.json");
};

TEST_F(MovingLights, WriteAFileForEachStep) {
  const RunResult done = run({"--move", "point1=4,1,7:3,-2,8", "-o", directory_.file("s-%d.json")});
  ASSERT_EQ(done.status, 0) << done.err;
  EXPECT_EQ(done.out + done.err, "");
  const std::vector<std::string> places{"2,1,7", "4,1,7", "3,-2,8"};
  for (std::size_t step = 0; step < places.size(); ++step) {
    const RunResult fresh = run_gnomon(arguments(places[step]));
    ASSERT_EQ(fresh.status, 0) << fresh.err;
    EXPECT_EQ(read_text(directory_.file("s-" + std::to_string(step) + ".json")), fresh.out);
  }
}

TEST_F(MovingLights, WriteAllStepsIntoOneFile) {
  const RunResult done = run({"--move=point2=-3,2,6", "--move=point0=1,1,6:1,2,6", "--stats"});
  ASSERT_EQ(done.status, 0) << done.err;
  EXPECT_THAT(done.err, AllOf(HasSubstr("step 0: 3 of 3 trees built"),
                              HasSubstr("step 1: 2 of 3 trees built"),
                              HasSubstr("step 2: 1 of 3 trees built")));
  rapidjson::Document document;
  document.Parse(done.out.c_str());
  ASSERT_FALSE(document.HasParseError());
  EXPECT_STREQ(document["format"].GetString(), "gnomon-steps");
  ASSERT_EQ(document["steps"].Size(), 3u);
  EXPECT_EQ(document["steps"][0]["moved"].Size(), 0u);
  // The one that has no further place stays at its last.
  ASSERT_EQ(document["steps"][2]["moved"].Size(), 2u);
  EXPECT_STREQ(document["steps"][2]["moved"][0]["id"].GetString(), "point0");
  EXPECT_EQ(document["steps"][2]["moved"][0]["position"][1].GetDouble(), 2);
  EXPECT_EQ(document["steps"][2]["moved"][1]["position"][2].GetDouble(), 6);
  for (const auto& step : document["steps"].GetArray()) {
    EXPECT_STREQ(step["result"]["format"].GetString(), "gnomon-result");
    EXPECT_EQ(step["result"]["lights"].Size(), 3u);
    EXPECT_STREQ(step["result"]["lights"][1]["id"].GetString(), "point1");
  }
}

TEST_F(MovingLights, SayWhatCannotBeMoved) {
  expect_refused({"--move", "lamp=1,2,3"},
                 {"--move lamp: no such light", "point0, point1, point2"});
  expect_refused({"--move", "point0"}, {"there is no '='", "LIGHT=x,y,z"});
  expect_refused({"--move", "point0=1,2"}, {"--move point0: ", "is not a point", "x,y,z"});
  expect_refused({"--move", "point0=1,2,3:"}, {"--move point0: ", "is not a point"});
  expect_refused({"--move", "point0=1,2,up"}, {"--move point0: "});
  expect_refused({"--move", "point0=1,2,3", "--move", "point0=1,2,4"}, {"it is moved twice"});
  expect_refused({"--move", "point0=1,2,3", "--light", "point1"}, {"it is not asked for"});
  expect_refused({"--move", "point0=1,2,3", "--algorithm", "basic"}, {"--move needs svbsp"});
  expect_refused({"--move", "point0=1,2,3", "--shares", directory_.file("s.csv")}, {"--shares"});
  expect_refused({"--sun=0,0,1", "--move", "sun0=0,0,0"}, {"--move sun0: ", "(0, 0, 0)"});
  expect_refused({"--area=0,0,9:1,0,9:0,1,9", "--move", "area0=0,0,8"}, {"it is an area light"});
  expect_refused({"--area=0,0,9:1,0,9:0,1,9", "--move", "point0=0,0,8"},
                 {"light area0", "area light", "--light"});
  expect_refused({"--algorithm", "svbsp:grow=fragments"}, {"grow=fragments on kernel plane"});
  EXPECT_EQ(run({"--algorithm", "svbsp:grow=fragments", "--kernel", "rational"}).status, 0);
  const RunResult alone =
      run_gnomon({"shadows", scene_, "--point=0,0,6", "--move", "point0=1,2,3"});
  EXPECT_NE(alone.status, 0);
  EXPECT_THAT(alone.err, HasSubstr("--combined"));
}

}  // namespace
}  // namespace gnomon::test
