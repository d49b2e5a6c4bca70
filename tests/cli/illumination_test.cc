// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon illumination: truths, verdicts, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "run_gnomon.h"

namespace gnomon::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// From the middle of the floor, the shade at half the height hides half of the panel.
constexpr const char* kRoom = R"({ "format": "gnomon-scene", "version": 1, "name": "room",
  "vertices": [[0,0,0],[4,0,0],[4,4,0],[0,4,0],[1,1,2],[2,1,2],[2,3,2],[1,3,2],
               [0,0,0.5],[4,0,0.5],[4,4,1]],
  "polygons": [{"id": "floor", "loop": [0,1,2,3]}, {"id": "shade", "loop": [4,5,6,7]},
               {"id": "dropped", "loop": [0,1,0]}],
  "lights": [{"id": "panel", "type": "area", "loop": [[0,0,4],[0,4,4],[4,4,4],[4,0,4]]},
             {"id": "lamp", "type": "point", "position": [1,1,9]}] })";

class IlluminationCommand : public testing::Test {
 protected:
  void SetUp() override { write_text(scene_, kRoom); }
  RunResult run(std::vector<std::string> options) const {
    options.insert(options.begin(), {"illumination", scene_});
    return run_gnomon(options);
  }

  TestDirectory directory_;
  const std::string scene_ = directory_.file("room.json");
};

TEST_F(IlluminationCommand, TellsWhatAPointSeesAndWhichKernelsFindIt) {
  const RunResult found =
      run({"--on", "floor", "--at", "2,2,0", "--json", directory_.file("seen.json")});
  EXPECT_EQ(found.status, 0) << found.out << found.err;
  EXPECT_THAT(found.out, AllOf(HasSubstr("1 point on the front of floor: 0 see all of the light, "
                                         "1 a part, 0 nothing"),
                               HasSubstr("part"), HasSubstr("1/2"), HasSubstr("exact shares"),
                               HasSubstr("within tolerance"), Not(HasSubstr("differs"))));
  EXPECT_THAT(read_text(directory_.file("seen.json")),
              AllOf(HasSubstr(R"("format": "gnomon-received-light")"),
                    HasSubstr(R"("visible": "1/2")"), HasSubstr(R"("kernel": "plane")")));
}

TEST_F(IlluminationCommand, SamplesAreTheSameForASeed) {
  const std::vector<std::string> asked{"--on",     "floor", "--samples", "20",
                                       "--kernel", "plane", "--json",    "-"};
  const RunResult first = run(asked);
  EXPECT_EQ(first.status, 0) << first.err;
  EXPECT_EQ(run(asked).out, first.out);
  std::vector<std::string> other = asked;
  other.insert(other.end(), {"--seed", "2"});
  EXPECT_NE(run(other).out, first.out);
}

TEST_F(IlluminationCommand, AKernelThatIsOffFails) {
  const RunResult found = run({"--on", "floor", "--at", "2,1.9,0", "--kernel", "float"});
  EXPECT_EQ(found.status, 1) << found.out;
  EXPECT_THAT(found.out, AllOf(HasSubstr("failed"), HasSubstr("worst at 2,1.9,0"),
                               HasSubstr("--from=2,1.9,0"), HasSubstr("--area-light")));
  EXPECT_EQ(
      run({"--on", "floor", "--at", "2,1.9,0", "--kernel", "float", "--tolerance", "1e-3"}).status,
      0);
}

TEST_F(IlluminationCommand, SaysWhatIsWrong) {
  const auto error_of = [&](const std::vector<std::string>& options) {
    const RunResult found = run(options);
    EXPECT_EQ(found.status, 2) << found.out << found.err;
    return found.err;
  };
  EXPECT_THAT(error_of({"--on", "ceiling"}), HasSubstr("there is no polygon 'ceiling'"));
  EXPECT_THAT(error_of({"--on", "floor:back"}), HasSubstr("polygon 'floor' has one side"));
  EXPECT_THAT(error_of({"--on", "dropped"}), HasSubstr("'dropped' has no area"));
  EXPECT_THAT(error_of({"--on", "floor", "--at", "2,2"}), HasSubstr("--at"));
  EXPECT_THAT(error_of({"--on", "floor", "--at", "2,2,1"}),
              HasSubstr("the point is 1 off the plane of polygon 'floor'"));
  EXPECT_THAT(error_of({"--on", "floor", "--light", "lamp"}), HasSubstr("0 area lights"));
  EXPECT_THAT(error_of({"--on", "floor", "--area=0,0,3:0,1,3:1,0,3"}), HasSubstr("2 area lights"));
  EXPECT_THAT(error_of({"--on", "floor", "--algorithm", "contour"}), HasSubstr("contour"));
  EXPECT_THAT(error_of({"--on", "floor", "--algorithm", "basic:cover=overlay"}),
              HasSubstr("paints shadows over lit"));
  EXPECT_THAT(error_of({}), HasSubstr("--on"));
}

}  // namespace
}  // namespace gnomon::test
