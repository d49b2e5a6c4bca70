// SPDX-License-Identifier: GPL-3.0-or-later
// One harness for the suites of families: every family is a few blocks of scenes, every block a
// test, and one check must find nothing wrong with any of its scenes.
#ifndef GNOMON_TESTS_ALGORITHMS_SUITE_H
#define GNOMON_TESTS_ALGORITHMS_SUITE_H

#include <gtest/gtest.h>

#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

#include "fuzz/generate/families.h"
#include "solve.h"

namespace gnomon::test {

/// Scenes of one family: seeds 1000 * index and the next ones.
struct Block {
  const fuzz::Family* family;
  unsigned index;

  std::string name() const { return std::string(family->name) + std::to_string(index); }
  friend void PrintTo(const Block& block, std::ostream* out) { *out << block.name(); }
};

inline std::vector<Block> blocks_of(const std::vector<fuzz::Family>& families) {
  std::vector<Block> all;
  for (const fuzz::Family& family : families) {
    for (unsigned i = 0; i < family.blocks; ++i) all.push_back({&family, i});
  }
  return all;
}

/// Fails on the first scene that `check` has something to say of, and unless more than so many per
/// cent of the scenes can be prepared.
inline void check_block(const Block& block, std::string (*check)(const Case&),
                        unsigned least_percent) {
  const auto& [family, index] = block;
  unsigned checked = 0;
  for (unsigned i = 0; i < family->scenes; ++i) {
    const std::uint64_t seed = 1000 * index + i;
    const auto scene = Case::make(family->make(seed));
    if (!scene) continue;
    ++checked;
    ASSERT_EQ(check(*scene), "") << family->name << " seed " << seed << "\n"
                                 << text_of(scene->scene());
  }
  EXPECT_GT(checked, family->scenes * least_percent / 100);
}

}  // namespace gnomon::test

#endif  // GNOMON_TESTS_ALGORITHMS_SUITE_H
