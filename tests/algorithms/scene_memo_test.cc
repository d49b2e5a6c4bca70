// SPDX-License-Identifier: GPL-3.0-or-later
// What contour keeps of a scene from light to light: a memo gives what it was told and nothing
// else, and a vertex that is known to be on an edge's line is on it.
#include "algorithms/contour/scene_memo.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>

#include "algorithms/contour/input_sides.h"
#include "scene/base/random.h"

namespace gnomon::test {
namespace {

/// More keys than places, so that they drive each other out.
TEST(SceneMemo, GivesWhatItWasTold) {
  SceneMemo memo(1);
  Random random(3);
  std::uint32_t found = 0, asked = 0;
  for (int round = 0; round < 100000; ++round) {
    const auto one = static_cast<std::uint32_t>(random.next() % 40);
    const auto other = static_cast<std::uint32_t>(random.next() % 40);
    const unsigned expected = (one * 7 + other * 5) % 4;
    ++asked;
    ASSERT_EQ(memo.value(one, other,
                         [&] {
                           ++found;
                           return expected;
                         }),
              expected);
  }
  EXPECT_LT(found, asked);
  EXPECT_GT(found, 1600u);  // 0 is not kept
}

TEST(SceneMemo, KeepsNoNumberThatIsTooLarge) {
  SceneMemo memo(1);
  constexpr std::uint32_t kLarge = 0x80000000u;
  EXPECT_EQ(memo.value(0, 5, [] { return 1u; }), 1u);
  for (const auto& [one, other] : {std::pair{kLarge, 5u}, std::pair{0u, kLarge | 5u}}) {
    EXPECT_EQ(memo.value(one, other, [] { return 2u; }), 2u);
    EXPECT_EQ(memo.value(one, other, [] { return 3u; }), 3u);
  }
  EXPECT_EQ(memo.value(0, 5, [] { return 2u; }), 1u);
}

TEST(SceneMemo, KnowsWhatIsOnALine) {
  constexpr std::int64_t kMost = 0x7fffffffffffffff;
  Geometry geometry;
  geometry.grid =
      GridPositions::from_narrow({0,     0,     0,      //
                                  2,     4,     6,      //
                                  1,     2,     3,      //
                                  1,     2,     4,      //
                                  kMost, kMost, kMost,  //
                                  kMost, kMost, kMost - 1, kMost / 7, kMost / 7, kMost / 7});
  EXPECT_TRUE(is_on_line(geometry, {0, 1}, 2));
  EXPECT_TRUE(is_on_line(geometry, {2, 0}, 1));
  EXPECT_FALSE(is_on_line(geometry, {0, 1}, 3));
  EXPECT_FALSE(is_on_line(geometry, {0, 4}, 5));
  EXPECT_FALSE(is_on_line(geometry, {4, 5}, 0));
  EXPECT_TRUE(is_on_line(geometry, {4, 0}, 6));
}

}  // namespace
}  // namespace gnomon::test
