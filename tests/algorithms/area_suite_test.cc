// SPDX-License-Identifier: GPL-3.0-or-later
// The exact suite under area lights: on small scenes, most of them degenerate, the kernels plane,
// rational and epeck give the same fractions of lit, penumbra and umbra by all algorithms, and the
// oracle calls their fragments identical and their claims true.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "area_check.h"
#include "fuzz/generate/area_families.h"
#include "gnomon/scene/read.h"
#include "suite.h"

namespace gnomon::test {
namespace {

class AreaSuite : public testing::TestWithParam<Block> {};

TEST_P(AreaSuite, KernelsAlgorithmsAndOracleAgree) {
  check_block(GetParam(), check_area_exact, 80);
}

INSTANTIATE_TEST_SUITE_P(Families, AreaSuite, testing::ValuesIn(blocks_of(fuzz::area_families())),
                         [](const auto& info) { return info.param.name(); });

/// Scenes of shared/: skipped where they are absent.
class SharedAreaScene : public testing::TestWithParam<const char*> {};

TEST_P(SharedAreaScene, KernelsAlgorithmsAndOracleAgree) {
  const std::string directory = GNOMON_SHARED_SCENES;
  if (directory.empty()) GTEST_SKIP() << "no shared scenes";
  const auto read = read_scene(directory + "/json/" + GetParam() + ".json");
  ASSERT_TRUE(read) << to_string(read.error());
  const auto scene = Case::make(read->scene);
  ASSERT_TRUE(scene);
  EXPECT_EQ(check_area_exact(*scene), "");
}

INSTANTIATE_TEST_SUITE_P(Scenes, SharedAreaScene,
                         testing::Values("radiance-cornell", "radiance-desk"),
                         [](const auto& info) {
                           std::string name = info.param;
                           name[name.find('-')] = '_';
                           return name;
                         });

}  // namespace
}  // namespace gnomon::test
