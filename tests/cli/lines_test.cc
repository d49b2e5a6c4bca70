// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon lines: drawings, files, the check against the oracle, and what it refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "run_gnomon.h"

namespace gnomon::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::size_t occurrences(const std::string& text, const std::string& of) {
  std::size_t count = 0;
  for (std::size_t at = text.find(of); at != std::string::npos; at = text.find(of, at + 1)) ++count;
  return count;
}

/// The lines drawn in the group whose opening tag has this in it.
std::size_t lines_of_group(const std::string& svg, const std::string& mark) {
  const std::size_t at = svg.find(mark);
  if (at == std::string::npos) return 0;
  return occurrences(svg.substr(at, svg.find("</g>", at) - at), "<path");
}

class LinesCommand : public testing::Test {
 protected:
  void SetUp() override {
    // A square above the middle of a floor; the lamp is above the square, a little to its side.
    write_text(scene_, R"({"format": "gnomon-scene", "version": 1, "name": "square over floor",
      "vertices": [[-8,-8,0],[8,-8,0],[8,8,0],[-8,8,0], [-2,-2,4],[2,-2,4],[2,2,4],[-2,2,4],
                   [-1,-6,1],[1,-6,1],[1,6,1],[-1,6,1]],
      "polygons": [{"id": "floor", "loop": [0,1,2,3]}, {"id": "high", "loop": [4,5,6,7]},
                   {"id": "low", "loop": [8,9,10,11]}],
      "lights": [{"id": "lamp", "type": "point", "position": [0,0,10]},
                 {"id": "panel", "type": "area", "loop": [[0,0,20],[0,1,20],[1,0,20]]}]})");
  }

  TestDirectory directory_;
  std::string scene_ = directory_.file("scene.json");
};

TEST_F(LinesCommand, WritesExactPartsWithTheirCounts) {
  const RunResult done = run_gnomon({"lines", scene_, "--eye", "0,0,8", "--light", "lamp"});
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_THAT(done.out, AllOf(HasSubstr("\"format\": \"gnomon-lines\""), HasSubstr("\"lamp\""),
                              HasSubstr("\"eye\": [\"0\", \"0\", \"8\"]")));
  // The long edge x = 1 of the low polygon: from 8 the square at 4 covers |y| < 7/2 at height 1,
  // from 10 it covers |y| < 3. The edge is 12 long.
  EXPECT_THAT(
      done.out,
      HasSubstr("\"polygons\": [\"low\"], \"hidden_by\": [[\"5/24\", 0], [\"19/24\", 1], "
                "[\"1\", 0]], \"shadowed_by\": [[[\"1/4\", 0], [\"3/4\", 1], [\"1\", 0]]]"));
}

TEST_F(LinesCommand, DrawsSolidDashedAndThin) {
  const std::string file = directory_.file("lines.svg");
  const RunResult done =
      run_gnomon({"lines", scene_, "--eye", "6,-20,16", "--light", "lamp", "-o", file});
  EXPECT_EQ(done.status, 0) << done.err;
  const std::string svg = read_text(file);
  EXPECT_EQ(lines_of_group(svg, "stroke-width=\"0.5\""), 0u);
  EXPECT_GE(lines_of_group(svg, "stroke-dasharray"), 2u) << "both long edges of the low polygon";
  EXPECT_GE(lines_of_group(svg, "stroke-width=\"1.4\""), 8u);
  const RunResult thin =
      run_gnomon({"lines", scene_, "--eye", "6,-20,16", "--light", "lamp", "--hidden", "-o", file});
  EXPECT_EQ(thin.status, 0) << thin.err;
  EXPECT_GE(lines_of_group(read_text(file), "stroke-width=\"0.5\""), 1u);
}

TEST_F(LinesCommand, ChecksItselfAgainstTheOracle) {
  const std::string city = directory_.file("city.json");
  ASSERT_EQ(run_gnomon({"generate", "city", "--param", "n=60", "-o", city}).status, 0);
  const RunResult done =
      run_gnomon({"lines", city, "--check", "--stats", "-o", directory_.file("city.svg")});
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_THAT(done.err, AllOf(HasSubstr("eye: "), HasSubstr("identical"), HasSubstr("handed on"),
                              Not(HasSubstr("wrong"))));
}

TEST_F(LinesCommand, SaysWhatItDoesNotTake) {
  const auto refused = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"lines", scene_});
    const RunResult done = run_gnomon(arguments);
    EXPECT_EQ(done.status, 2) << done.err;
    EXPECT_THAT(done.out, IsEmpty());
    return done.err;
  };
  EXPECT_THAT(refused({"--eye", "0,0"}), HasSubstr("--eye"));
  EXPECT_THAT(refused({"--eye", "0,0,8", "-o", "x.png"}), HasSubstr(".svg or .json"));
  EXPECT_THAT(refused({"--eye", "0,0,8", "--hidden"}), HasSubstr("-o FILE.svg"));
  EXPECT_THAT(refused({"--eye", "0,0,8", "--light", "panel"}), HasSubstr("has an area"));
  EXPECT_THAT(refused({"--eye", "0,0,8", "--light", "lamp", "--flap", "z:0:30"}),
              HasSubstr("region"));
  EXPECT_THAT(refused({"--eye", "0,0,8", "--light", "nobody"}), HasSubstr("no such light"));
  // Of a light that nobody asked for it is enough to say so.
  const RunResult warned = run_gnomon({"lines", scene_, "--eye", "0,0,8"});
  EXPECT_EQ(warned.status, 0);
  EXPECT_THAT(warned.err, HasSubstr("light panel has an area"));
}

TEST_F(LinesCommand, DrawsASceneOfWhichNothingFaces) {
  const RunResult done = run_gnomon({"lines", scene_, "--eye", "0,0,-8", "--light", "lamp"});
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("\"lines\": []"));
}

}  // namespace
}  // namespace gnomon::test
