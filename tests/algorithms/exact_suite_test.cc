// SPDX-License-Identifier: GPL-3.0-or-later
// The exact suite: on thousands of small scenes, most of them degenerate, the kernels plane,
// rational and epeck give the same fractions by both algorithms, which add up to exactly 1, are the
// oracle's, and come from fragments that the oracle calls identical and whose witnesses hold.
#include <gtest/gtest.h>

#include <string>

#include "exact_check.h"
#include "fuzz/generate/families.h"

namespace gnomon::test {
namespace {

using namespace fuzz;  // families and pens

struct Block {
  const Family* family;
  unsigned index;
};

std::vector<Block> blocks() {
  std::vector<Block> all;
  for (const Family& family : families()) {
    for (unsigned i = 0; i < family.blocks; ++i) all.push_back({&family, i});
  }
  return all;
}

class ExactSuite : public testing::TestWithParam<Block> {};

TEST_P(ExactSuite, KernelsAndOracleAgree) {
  const auto [family, index] = GetParam();
  unsigned checked = 0;
  for (unsigned i = 0; i < family->scenes; ++i) {
    const std::uint64_t seed = 1000 * index + i;
    std::string why;
    const auto scene = Case::make(family->make(seed), &why);
    if (!scene) continue;
    ++checked;
    const std::string wrong = check_exact(*scene);
    ASSERT_EQ(wrong, "") << family->name << " seed " << seed << "\n" << text_of(scene->scene());
  }
  EXPECT_GT(checked, family->scenes * 9 / 10);  // most scenes can be prepared
}

INSTANTIATE_TEST_SUITE_P(Families, ExactSuite, testing::ValuesIn(blocks()), [](const auto& info) {
  return info.param.family->name + std::to_string(info.param.index);
});

}  // namespace
}  // namespace gnomon::test
