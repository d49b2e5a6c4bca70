// SPDX-License-Identifier: GPL-3.0-or-later
// The exact suite: on thousands of small scenes, most of them degenerate, the kernels plane,
// rational and epeck give the same fractions by both algorithms, which add up to exactly 1, are the
// oracle's, and come from fragments that the oracle calls identical and whose witnesses hold.
#include <gtest/gtest.h>

#include <string>

#include "exact_check.h"
#include "fuzz/generate/families.h"
#include "suite.h"

namespace gnomon::test {
namespace {

class ExactSuite : public testing::TestWithParam<Block> {};

TEST_P(ExactSuite, KernelsAndOracleAgree) { check_block(GetParam(), check_exact, 90); }

INSTANTIATE_TEST_SUITE_P(Families, ExactSuite, testing::ValuesIn(blocks_of(fuzz::families())),
                         [](const auto& info) { return info.param.name(); });

}  // namespace
}  // namespace gnomon::test
