// SPDX-License-Identifier: GPL-3.0-or-later
// Exact answers written as doubles: what rounding does to them is no error of theirs, for either
// judge, and what is an error says which number is too large.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "run_gnomon.h"

namespace gnomon::test {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string scene_file(const std::string& name) { return GNOMON_ROUNDING "/" + name + ".json"; }

class Rounding : public testing::Test {
 protected:
  /// The scene's exact answer in nearest doubles.
  std::string written(const std::string& scene, const std::vector<std::string>& more = {}) {
    const std::string file = (directory_.path() / "result.json").string();
    std::vector<std::string> command = {"shadows",     scene, "--exact-fractions",
                                        "--fragments", "-o",  file};
    command.insert(command.end(), more.begin(), more.end());
    const RunResult done = run_gnomon(command);
    EXPECT_EQ(done.status, 0) << done.err;
    return file;
  }

  TestDirectory directory_;
};

// A fragment rounds to a point, one to a sliver on a narrow part, and all of them by more than the
// width that is tolerated.
TEST_F(Rounding, TheExactAnswerInDoublesPassesBothJudges) {
  for (const std::string name :
       {"verify-point-fragment", "verify-sliver-part", "thin-strip-georeferenced"}) {
    SCOPED_TRACE(name);
    const std::string scene = scene_file(name);
    const std::string result = written(scene);
    const RunResult verified = run_gnomon({"verify", scene, result});
    EXPECT_EQ(verified.status, 0) << verified.out;
    EXPECT_THAT(verified.out, HasSubstr("every claim"));
    const RunResult certified = run_gnomon({"certify", scene, "--candidate", result});
    EXPECT_EQ(certified.status, 0) << certified.out;
    EXPECT_THAT(certified.out, HasSubstr("Within tolerance"));
  }
}

TEST_F(Rounding, StrictSaysThatItIsRounding) {
  const std::string scene = scene_file("thin-strip-georeferenced");
  const std::string result = written(scene);
  const RunResult certified = run_gnomon({"certify", scene, "--candidate", result, "--strict"});
  EXPECT_EQ(certified.status, 1);
  EXPECT_THAT(certified.out, HasSubstr("doubles' own rounding at this distance from the origin"));
  EXPECT_EQ(run_gnomon({"verify", scene, result, "--strict"}).status, 1);
}

// A lit share of 442/1225 by fragments that are off by far more than rounding.
TEST_F(Rounding, ErrorBeyondItIsFoundByBoth) {
  const std::string scene = scene_file("thin-strip-georeferenced");
  const std::string result = written(scene);
  std::string text = read_text(result);
  const std::string from = "5000006.857142857", to = "5000006.857142867";
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at)) {
    text.replace(at, from.size(), to);
  }
  write_text(result, text);
  const RunResult certified = run_gnomon({"certify", scene, "--candidate", result});
  EXPECT_EQ(certified.status, 1) << certified.out;
  EXPECT_THAT(certified.out, HasSubstr("too much: light sun, polygon strip (front)"));
  const RunResult verified = run_gnomon({"verify", scene, result});
  EXPECT_EQ(verified.status, 1) << verified.out;
}

// What fails is the share of a small polygon: the row's own numbers are far below the tolerance.
TEST_F(Rounding, ARowNamesTheNumberThatFailed) {
  const std::string scene = scene_file("certify-small-in-big");
  const RunResult done = run_gnomon({"certify", scene, "--kernel", "float"});
  EXPECT_EQ(done.status, 1);
  EXPECT_THAT(done.out, HasSubstr("too much: light sun, polygon strip (front): "));
  EXPECT_THAT(done.out, HasSubstr("more than 1e-09"));
  const RunResult rounded = run_gnomon({"certify", scene, "--kernel", "double"});
  EXPECT_EQ(rounded.status, 0) << rounded.out;
}

// Two squares that meet in a vertex, as one loop that goes through it twice.
TEST_F(Rounding, ALoopThatTouchesItselfHasOneVerdict) {
  const std::string scene = (directory_.path() / "scene.json").string();
  write_text(scene, R"({"format": "gnomon-scene", "version": 1,
    "vertices": [[0,0,0],[2,0,0],[2,2,0],[0,2,0],[0,0,1],[1,0,1],[1,1,1],[0,1,1],
                 [2,1,1],[2,2,1],[1,2,1]],
    "polygons": [{"id": "floor", "loop": [0,1,2,3]}, {"id": "a", "loop": [4,5,6,7]},
                 {"id": "b", "loop": [6,8,9,10]}],
    "lights": [{"id": "sun", "type": "directional", "to_light": [0,0,1]}]})");
  const std::string result = (directory_.path() / "result.json").string();
  const auto candidate = [&](const std::string& pinched) {
    write_text(result, R"({"lights": [{"id": "sun", "background": "shadow", "polygons": [
      {"id": "floor", "fragments": [{"class": "lit", "loop": )" +
                           pinched + R"(}]},
      {"id": "a", "fragments": [{"class": "lit", "loop": [[0,0,1],[1,0,1],[1,1,1],[0,1,1]]}]},
      {"id": "b", "fragments": [{"class": "lit", "loop": [[1,1,1],[2,1,1],[2,2,1],[1,2,1]]}]}]}]})");
    return std::pair{run_gnomon({"certify", scene, "--candidate", result}).status,
                     run_gnomon({"verify", scene, result, "--subset"}).status};
  };
  EXPECT_EQ(candidate("[[1,0,0],[2,0,0],[2,1,0],[1,1,0],[1,2,0],[0,2,0],[0,1,0],[1,1,0]]"),
            std::pair(0, 0));
  // The other two squares, which are not lit.
  EXPECT_EQ(candidate("[[0,0,0],[1,0,0],[1,1,0],[2,1,0],[2,2,0],[1,2,0],[1,1,0],[0,1,0]]"),
            std::pair(1, 1));
}

TEST_F(Rounding, FloatDoesNotCountUnlessItIsAskedFor) {
  const std::string scene = GNOMON_EXAMPLES "/courtyard.json";
  const RunResult usual = run_gnomon({"certify", scene});
  EXPECT_EQ(usual.status, 0) << usual.out;
  EXPECT_THAT(usual.out, HasSubstr("Failed, and not counted"));
  EXPECT_EQ(run_gnomon({"certify", scene, "--kernel", "float"}).status, 1);
  const RunResult all = run_gnomon({"certify", scene, "--kernel", "all"});
  EXPECT_EQ(all.status, 1);
  EXPECT_THAT(all.out, HasSubstr("rational"));
  EXPECT_THAT(all.out, Not(HasSubstr("not counted")));
}

}  // namespace
}  // namespace gnomon::test
