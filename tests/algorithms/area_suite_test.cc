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

/// On the floor, a corner of one penumbra stands out by 1e-14 over the edge of another one, which
/// ends 1e-7 from there at a line all but parallel to it.
TEST(AreaNeedles, CornerOnTheEdgeOfAnotherPenumbra) {
  const auto read = parse_scene(R"({"format": "gnomon-scene", "version": 1, "two_sided": true,
 "vertices": [[-8, -8, 0], [8, -8, 0], [8, 8, 0], [-8, 8, 0],
  [0, 0, 1], [1, 1, 2], [0.9999990463256836, 1, 2],
  [3, 3, 1], [-2, 3, 1], [-2.0000009536743164, 3.0000009536743164, 1],
  [2, -3, 2], [-1.9999990463256836, 3.0000009536743164, 1],
  [-3, 2, 4], [0, -1, 2], [-9.5367431640625e-7, -0.9999990463256836, 2.0000009536743164]],
 "polygons": [{"loop": [0, 1, 2, 3]}, {"loop": [4, 5, 6]}, {"loop": [7, 8, 9]},
  {"loop": [10, 8, 11]}, {"loop": [12, 13, 14]}],
 "lights": [{"id": "panel", "type": "area", "loop": [
  [0.6000003814697266, -1.3999996185302734, 6], [0.6000003814697266, -0.6000003814697266, 6],
  [1.3999996185302734, -0.6000003814697266, 6], [1.3999996185302734, -1.3999996185302734, 6]]}]})",
                                "needles.json");
  ASSERT_TRUE(read) << to_string(read.error());
  const auto scene = Case::make(read->scene);
  ASSERT_TRUE(scene);
  EXPECT_EQ(check_area_exact(*scene), "");
}

}  // namespace
}  // namespace gnomon::test
