// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon render --combined and --walls: several lights in one picture, and shadow polygons over it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "run_gnomon.h"

namespace gnomon::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class RenderLights : public testing::Test {
 protected:
  void SetUp() override {
    scene_ = directory_.file("solids.json");
    ASSERT_EQ(run_gnomon({"generate", "solids", "-o", scene_}).status, 0);
  }
  RunResult render(std::vector<std::string> options) const {
    options.insert(options.begin(), {"render", scene_});
    return run_gnomon(options);
  }

  TestDirectory directory_;
  std::string scene_;
};

TEST_F(RenderLights, PaintsByTheNumberOfLights) {
  const RunResult all = render({"--combined"});
  EXPECT_EQ(all.status, 0) << all.err;
  EXPECT_THAT(all.out, AllOf(HasSubstr("lit by all 3"), HasSubstr("by 2"), HasSubstr("by none")));
  const RunResult two = render({"--combined", "--light", "lamp", "--light", "lamp3"});
  EXPECT_THAT(two.out, AllOf(HasSubstr("lit by all 2"), Not(HasSubstr("by 2<"))));
  const RunResult painted = render({"--combined", "--algorithm", "tiling:cover=overlay"});
  EXPECT_EQ(painted.status, 0) << painted.err;
  EXPECT_THAT(painted.out, HasSubstr("lit by all 3"));
}

TEST_F(RenderLights, ShowsWhatAFileTellsOfLightsTogether) {
  const std::string apart = directory_.file("apart.json"), together = directory_.file("both.json");
  ASSERT_EQ(run_gnomon({"shadows", scene_, "--fragments", "-o", apart}).status, 0);
  ASSERT_EQ(run_gnomon({"shadows", scene_, "--combined", "--fragments", "-o", together}).status, 0);
  EXPECT_EQ(render({together, "--combined"}).status, 0);
  const RunResult refused = render({apart, "--combined"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("apart.json"), HasSubstr("lights together")));
}

TEST_F(RenderLights, PaintsShadowPolygons) {
  const RunResult plain = render({}), walls = render({"--walls"});
  EXPECT_EQ(walls.status, 0) << walls.err;
  EXPECT_THAT(walls.out, HasSubstr("shadow polygons"));
  EXPECT_THAT(plain.out, Not(HasSubstr("shadow polygons")));
  EXPECT_GT(walls.out.size(), plain.out.size());
}

TEST_F(RenderLights, RefusesWhatDoesNotGoTogether) {
  for (const auto& [options, word] :
       {std::pair(std::vector<std::string>{"--combined", "--walls"}, "--walls"),
        std::pair(std::vector<std::string>{"--combined", "--illuminate"}, "--illuminate"),
        std::pair(std::vector<std::string>{"--combined", "--algorithm", "all"}, "--algorithm"),
        std::pair(std::vector<std::string>{"--combined", "--algorithm", "sectors"}, "sectors"),
        std::pair(std::vector<std::string>{"--walls", "--illuminate"}, "--illuminate")}) {
    const RunResult refused = render(options);
    EXPECT_EQ(refused.status, 2) << word;
    EXPECT_THAT(refused.err, HasSubstr(word));
  }
}

}  // namespace
}  // namespace gnomon::test
