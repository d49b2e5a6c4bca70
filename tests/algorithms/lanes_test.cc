// SPDX-License-Identifier: GPL-3.0-or-later
// The inner loops of the contour method on every level of vector instructions that this machine
// has: each value, sign and pair is what plain code gives, to the last bit.
#include "algorithms/contour/lanes/lanes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/contour/lanes/simd_level.h"
#include "scene/base/random.h"

namespace gnomon {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class Lines : public testing::TestWithParam<SimdLevel> {};
class Sweep : public testing::TestWithParam<SimdLevel> {};

std::string level_name(const testing::TestParamInfo<SimdLevel>& info) {
  return std::string(name_of(info.param));
}
INSTANTIATE_TEST_SUITE_P(Levels, Lines, testing::ValuesIn(simd_levels()), level_name);
INSTANTIATE_TEST_SUITE_P(Levels, Sweep, testing::ValuesIn(simd_levels()), level_name);

/// Any double: of any size, or a small integer, or a special one.
double any_double(Random& random) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  switch (random.below(8)) {
    case 0:
      return static_cast<double>(random.below(7)) - 3;
    case 1:
      return std::bit_cast<double>(random.next());  // NaN too
    case 2:
      return random.below(2) == 0 ? kInfinity : -kInfinity;
    default:
      return std::ldexp(static_cast<double>(random.next() >> 11) - 0x1p52,
                        static_cast<int>(random.below(8)) - 55);
  }
}

double value_at(const double* line, std::size_t stride, const double* corners, std::size_t k) {
  const double* block = corners + kBlockDoubles * (k / 4) + k % 4;
  return (line[0] * block[0] + line[stride] * block[4]) + line[2 * stride] * block[8];
}

/// A bound that is often met exactly.
double any_bound(Random& random, double value) {
  switch (random.below(4)) {
    case 0:
      return std::fabs(value);
    case 1:
      return std::nextafter(std::fabs(value), random.below(2) == 0 ? 0 : 1e300);
    case 2:
      return 0;
    default:
      return std::fabs(any_double(random));
  }
}

std::uint64_t bits_of(double value) { return std::bit_cast<std::uint64_t>(value); }

TEST_P(Lines, SignsOfCornersAreThoseOfPlainCode) {
  const Lanes& tested = lanes(GetParam());
  Random random(1);
  std::vector<double> corners(kBlockDoubles * kMostBlocks);
  for (int round = 0; round < 5000; ++round) {
    std::array<double, 3> line{};
    for (double& value : line) value = any_double(random);
    for (double& value : corners) value = any_double(random);
    const auto blocks = static_cast<std::uint32_t>(random.below(kMostBlocks + 1));
    const double bound = any_bound(random, value_at(line.data(), 1, corners.data(), 0));
    CornerSigns expected = {0, 0};
    for (std::size_t k = 0; k < 4 * blocks; ++k) {
      const double value = value_at(line.data(), 1, corners.data(), k);
      if (value > bound) expected.positive |= std::uint64_t{1} << k;
      if (value < -bound) expected.negative |= std::uint64_t{1} << k;
    }
    const CornerSigns found = tested.corner_signs(line.data(), bound, corners.data(), blocks);
    ASSERT_EQ(found.positive, expected.positive) << round;
    ASSERT_EQ(found.negative, expected.negative) << round;
  }
}

TEST_P(Lines, BlocksOfLinesAreThoseOfPlainCode) {
  const Lanes& tested = lanes(GetParam());
  Random random(2);
  for (int round = 0; round < 20000; ++round) {
    std::array<double, kBlockDoubles> lines{}, corners{};
    std::array<double, 4> errors{}, bounds{};
    for (double& value : lines) value = any_double(random);
    for (double& value : corners) value = any_double(random);
    const double reach = std::ldexp(1 + round % 5, round % 40 - 20);
    for (std::size_t i = 0; i < 4; ++i) {
      errors[i] = any_bound(random, value_at(lines.data() + i, 4, corners.data(), i)) / reach;
      bounds[i] = errors[i] * reach;
    }
    std::array<double, 16> values{};
    const BlockSigns found =
        tested.block_values(lines.data(), errors.data(), reach, corners.data(), values.data());
    std::uint32_t positive = 0, negative = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t k = 0; k < 4; ++k) {
        const double value = value_at(lines.data() + i, 4, corners.data(), k);
        positive |= static_cast<std::uint32_t>(value > bounds[i]) << (4 * i + k);
        negative |= static_cast<std::uint32_t>(value < -bounds[i]) << (4 * i + k);
        if (std::isnan(value)) {
          ASSERT_TRUE(std::isnan(values[4 * i + k]));  // of no certain bits
        } else {
          ASSERT_EQ(bits_of(values[4 * i + k]), bits_of(value)) << round;
        }
      }
    }
    ASSERT_EQ(found.positive, positive) << round;
    ASSERT_EQ(found.negative, negative) << round;
    const BlockSigns alone = tested.block_signs(lines.data(), errors.data(), reach, corners.data());
    ASSERT_EQ(alone.positive, positive) << round;
    ASSERT_EQ(alone.negative, negative) << round;
  }
}

TEST_P(Lines, NoProductIsFusedWithASum) {
  // The product a x rounds to y, so that a x - y is 0 unless one of the two products is not
  // rounded.
  const double a = 1 + 0x1p-30, x = 1 + 0x1p-30, b = -1, y = 1 + 0x1p-29;
  ASSERT_EQ(a * x + b * y, 0);
  ASSERT_NE(std::fma(a, x, b * y), 0);
  // Lines (a, b, 0), (b, a, 0), (b, 0, a) and corners (x, y, 1), (y, x, 1), (y, 1, x).
  const std::array<double, kBlockDoubles> lines = {a, b, b, 0, b, a, 0, 0, 0, 0, a, 0};
  const std::array<double, kBlockDoubles> corners = {x, y, y, 0, y, x, 1, 0, 1, 1, x, 0};
  const std::array<double, 4> bounds = {0, 0, 0, 0};
  std::array<double, 16> values{};
  const BlockSigns signs =
      lanes(GetParam()).block_values(lines.data(), bounds.data(), 1, corners.data(), values.data());
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(values[5 * i], 0);
    EXPECT_EQ((signs.positive | signs.negative) >> 5 * i & 1, 0);
  }
}

// --- Sweeps ---

struct Boxes {
  std::vector<float> low_u, low_v, high_u, high_v;
  std::vector<std::uint32_t> traits;

  std::uint32_t size() const { return static_cast<std::uint32_t>(traits.size()); }
  /// Pads as lists must be.
  SweepList list(std::uint32_t base) {
    const std::uint32_t count = size();
    for (auto* values : {&low_u, &low_v, &high_u, &high_v}) {
      values->resize(count + 8, std::numeric_limits<float>::quiet_NaN());
    }
    traits.resize(count + 8);
    return {low_u.data(), low_v.data(), high_u.data(), high_v.data(), traits.data(), count, base};
  }
};

/// Boxes on a small lattice in the order of low u, some of them infinite.
Boxes random_boxes(Random& random, std::uint32_t count) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  std::vector<float> low_u(count);
  for (float& u : low_u) {
    u = random.below(20) == 0 ? -kInfinity : static_cast<float>(random.below(count / 2 + 1));
  }
  std::ranges::sort(low_u);
  Boxes boxes;
  for (const float u : low_u) {
    const auto v = static_cast<float>(random.below(8));
    boxes.low_u.push_back(u);
    boxes.low_v.push_back(v);
    boxes.high_u.push_back(random.below(20) == 0 ? kInfinity
                                                 : u + static_cast<float>(random.below(9)));
    boxes.high_v.push_back(v + static_cast<float>(random.below(3)));
    boxes.traits.push_back(static_cast<std::uint32_t>(random.below(8)));
  }
  return boxes;
}

bool overlap(const Boxes& a, std::uint32_t i, const Boxes& b, std::uint32_t k) {
  return a.low_u[i] <= b.high_u[k] && b.low_u[k] <= a.high_u[i] && a.low_v[i] <= b.high_v[k] &&
         b.low_v[k] <= a.high_v[i] && (a.traits[i] | b.traits[k]) == kAllTraits;
}

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// What a sweep finds if it is given as little room as it may be given.
Pairs swept(const Lanes& lanes, const SweepList& queries, const SweepList& targets,
            SweepOrder order, std::vector<std::uint32_t>& counts) {
  Pairs pairs;
  std::vector<std::uint32_t> first(targets.count + 8), second(targets.count + 8);
  SweepState state;
  state.queries = first.data();
  state.targets = second.data();
  state.capacity = first.size();
  counts.assign(queries.count, 0);
  for (bool done = false; !done;) {
    done = lanes.sweep(queries, targets, order, state, counts.data());
    for (std::uint64_t i = 0; i < state.found; ++i) pairs.emplace_back(first[i], second[i]);
    state.found = 0;
  }
  return pairs;
}

TEST_P(Sweep, FindsThePairsOfPlainCode) {
  const Lanes& tested = lanes(GetParam());
  Random random(3);
  for (int round = 0; round < 1000; ++round) {
    Boxes a = random_boxes(random, static_cast<std::uint32_t>(random.below(60)));
    Boxes b = random_boxes(random, static_cast<std::uint32_t>(random.below(60)));
    const SweepList list_a = a.list(100), list_b = b.list(1000);
    for (const SweepOrder order : {SweepOrder::kAfter, SweepOrder::kNotBelow, SweepOrder::kAbove}) {
      const bool same = order == SweepOrder::kAfter;
      const Boxes& other = same ? a : b;
      Pairs expected;
      std::vector<std::uint32_t> expected_counts(list_a.count), counts;
      for (std::uint32_t i = 0; i < list_a.count; ++i) {
        for (std::uint32_t k = same ? i + 1 : 0; k < (same ? list_a : list_b).count; ++k) {
          if (order == SweepOrder::kNotBelow && other.low_u[k] < a.low_u[i]) continue;
          if (order == SweepOrder::kAbove && other.low_u[k] <= a.low_u[i]) continue;
          if (!overlap(a, i, other, k)) continue;
          expected.emplace_back(100 + i, (same ? 100 : 1000) + k);
          ++expected_counts[i];
        }
      }
      ASSERT_EQ(swept(tested, list_a, same ? list_a : list_b, order, counts), expected) << round;
      ASSERT_EQ(counts, expected_counts);
    }
  }
}

// --- Levels ---

TEST(SimdLevels, AreKnownByTheirNames) {
  ASSERT_THAT(simd_levels(), Not(IsEmpty()));
  EXPECT_EQ(simd_levels().front(), SimdLevel::kBaseline);
  for (const SimdLevel level : simd_levels()) EXPECT_EQ(parse_simd_level(name_of(level)), level);
}

TEST(SimdLevels, OthersAreErrors) {
  for (const char* name : {"", "avx", "AVX2", "neon", "avx2 "}) {
    const auto level = parse_simd_level(name);
    ASSERT_FALSE(level) << name;
    EXPECT_EQ(level.error().code, ErrorCode::kUsage);
    EXPECT_THAT(to_string(level.error()), HasSubstr("GNOMON_SIMD"));
    EXPECT_THAT(to_string(level.error()), HasSubstr("avx2 or avx512"));
  }
  for (const SimdLevel level : {SimdLevel::kAvx2, SimdLevel::kAvx512}) {
    const bool here = std::ranges::count(simd_levels(), level) > 0;
    EXPECT_EQ(parse_simd_level(name_of(level)).has_value(), here);
  }
}

TEST(SimdLevels, ATestForcesOne) {
  const auto chosen = chosen_simd_level();
  for (const SimdLevel level : simd_levels()) {
    const ForcedSimdLevel forced(level);
    EXPECT_EQ(chosen_simd_level(), level);
  }
  EXPECT_EQ(chosen_simd_level().has_value(), chosen.has_value());
}

}  // namespace
}  // namespace gnomon
