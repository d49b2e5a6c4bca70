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

namespace gnomon::test {
namespace {

using namespace fuzz;  // families and pens

struct Block {
  const Family* family;
  unsigned index;
};

std::vector<Block> blocks() {
  std::vector<Block> all;
  for (const Family& family : area_families()) {
    for (unsigned i = 0; i < family.blocks; ++i) all.push_back({&family, i});
  }
  return all;
}

class AreaSuite : public testing::TestWithParam<Block> {};

TEST_P(AreaSuite, KernelsAlgorithmsAndOracleAgree) {
  const auto [family, index] = GetParam();
  unsigned checked = 0;
  for (unsigned i = 0; i < family->scenes; ++i) {
    const std::uint64_t seed = 1000 * index + i;
    std::string why;
    const auto scene = Case::make(family->make(seed), &why);
    if (!scene) continue;
    ++checked;
    ASSERT_EQ(check_area_exact(*scene), "") << family->name << " seed " << seed << "\n"
                                            << text_of(scene->scene());
  }
  EXPECT_GT(checked, family->scenes * 8 / 10);  // most scenes can be prepared
}

INSTANTIATE_TEST_SUITE_P(Families, AreaSuite, testing::ValuesIn(blocks()), [](const auto& info) {
  return info.param.family->name + std::to_string(info.param.index);
});

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
