// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon loops: what it prints and writes, and what it refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "run_gnomon.h"

namespace gnomon::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A tetrahedron, and a triangle beside it that is no solid.
constexpr const char* kSolid = R"({ "format": "gnomon-scene", "version": 1, "name": "solid",
  "vertices": [[0,0,0],[4,0,0],[0,4,0],[1,1,4],[9,0,0],[10,0,0],[9,1,0]],
  "polygons": [{"id": "base", "loop": [0,2,1]}, {"id": "south", "loop": [0,1,3]},
               {"id": "slope", "loop": [1,2,3]}, {"id": "west", "loop": [2,0,3]})";
constexpr const char* kSheet = R"(, {"id": "sheet", "loop": [4,5,6]})";
constexpr const char* kLights = R"(],
  "lights": [{"id": "sun", "type": "directional", "to_light": [0,0,1]},
             {"id": "lamp", "type": "point", "position": [5,5,9]},
             {"id": "panel", "type": "area", "loop": [[0,0,9],[0,1,9],[1,1,9]]}] })";

class LoopsCommand : public testing::Test {
 protected:
  void SetUp() override {
    write_text(solid_, std::string(kSolid) + kLights);
    write_text(open_, std::string(kSolid) + kSheet + kLights);
  }
  TestDirectory directory_;
  const std::string solid_ = directory_.file("solid.json"), open_ = directory_.file("open.json");
};

TEST_F(LoopsCommand, PrintsARowForEachComponent) {
  const RunResult run = run_gnomon({"loops", solid_, "--light", "sun"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("light sun of solid"), HasSubstr("base"),
                             HasSubstr("crossings were looked for in")));
}

TEST_F(LoopsCommand, WritesJsonAndAPicture) {
  const std::string json = directory_.file("loops.json"), svg = directory_.file("loops.svg");
  EXPECT_EQ(run_gnomon({"loops", solid_, "--light", "lamp", "-o", json}).status, 0);
  EXPECT_THAT(read_text(json),
              AllOf(HasSubstr(R"("format": "gnomon-loops")"), HasSubstr(R"("kind": "external")"),
                    HasSubstr(R"("kind": "VRE")"), HasSubstr(R"("depth": 1)")));
  for (const char* light : {"sun", "lamp"}) {
    EXPECT_EQ(run_gnomon({"loops", solid_, "--light", light, "-o", svg}).status, 0);
    EXPECT_THAT(read_text(svg), AllOf(HasSubstr("<svg"), HasSubstr("external")));
  }
  EXPECT_EQ(run_gnomon({"loops", solid_, "--light", "lamp", "-o", "-"}).out, read_text(json));
}

TEST_F(LoopsCommand, SaysWhatIsWrong) {
  const auto error_of = [&](std::vector<std::string> options) {
    options.insert(options.begin(), "loops");
    const RunResult run = run_gnomon(options);
    EXPECT_EQ(run.status, 2) << run.out << run.err;
    return run.err;
  };
  EXPECT_THAT(error_of({solid_}), HasSubstr("3 lights"));
  EXPECT_THAT(error_of({solid_, "--light", "panel"}), HasSubstr("light 'panel' has an area"));
  EXPECT_THAT(error_of({open_, "--light", "sun"}),
              AllOf(HasSubstr("of polygon sheet has no partner"), HasSubstr("--open")));
  EXPECT_THAT(error_of({solid_, "--light", "sun", "-o", "loops.txt"}), HasSubstr("loops.txt"));
  EXPECT_EQ(run_gnomon({"loops", open_, "--light", "sun", "--open"}).status, 0);
}

}  // namespace
}  // namespace gnomon::test
