// SPDX-License-Identifier: GPL-3.0-or-later
// What is left of an edge when stretches are taken away whose ends are known to some bound: for any
// true ends within the bounds, what is left truly is within the bounds of what is found.
#include "algorithms/contour/stretches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "scene/base/random.h"

namespace gnomon::test {
namespace {

using Certified = ContourNumbers<double, Trust::kCertified>;
using P = Place<Certified>;

double unit(Random& random) { return static_cast<double>(random.next() >> 11) * 0x1p-53; }

/// A place that is off by at most its bound from where it truly is.
P any_place(Random& random, double truth) {
  static constexpr double kBounds[] = {0, 1e-12, 1e-3, 0.05, 0.6};
  P place;
  place.error = kBounds[random.next() % 5];
  place.t = std::clamp(truth + place.error * (2 * unit(random) - 1), 0.0, 1.0);
  return place;
}

/// `low_name`, `high_name`: what stretches have in common where they have an end in common.
struct Truth {
  double low, high;
  std::uint32_t low_name = 0, high_name = 0;
};

double uncovered_length(double low, double high, std::vector<Truth> covers) {
  std::ranges::sort(covers, {}, &Truth::low);
  double at = low, length = 0;
  for (const Truth& cover : covers) {
    if (cover.low > at) length += std::max(0.0, std::min(cover.low, high) - at);
    at = std::max(at, cover.high);
  }
  return length + std::max(0.0, high - at);
}

TEST(Stretches, WhatIsLeftIsWithinItsBounds) {
  Random random(1);
  std::vector<Stretch<Certified>> covers;
  std::vector<Segment<Certified>> left;
  int sure = 0;
  for (int round = 0; round < 200000; ++round) {
    std::vector<Truth> truths;
    covers.clear();
    for (std::uint64_t n = 1 + random.next() % 4; n > 0; --n) {
      Truth truth{unit(random), unit(random)};
      // Ends that several have in common.
      if (!truths.empty() && random.next() % 3 == 0) truth.low = truths.back().high;
      if (!truths.empty() && random.next() % 4 == 0) truth.high = truths.back().high;
      if (truth.high < truth.low) std::swap(truth.low, truth.high);
      truths.push_back(truth);
      covers.push_back({any_place(random, truth.low), any_place(random, truth.high)});
    }
    const Segment<Certified> whole{P::from(), P::to(), true};
    uncovered<Certified>({&whole, 1}, covers, left);
    double found = 0, bound = 1e-15;
    bool certainly = false;
    for (const Segment<Certified>& segment : left) {
      found += segment.high.t - segment.low.t;
      bound += segment.high.error + segment.low.error;
      certainly = certainly || segment.sure;
    }
    const double truth = uncovered_length(0, 1, truths);
    ASSERT_LE(std::fabs(found - truth), bound) << "round " << round;
    if (certainly) {
      ASSERT_GT(truth, 0) << "round " << round;
      ++sure;
    }
  }
  EXPECT_GT(sure, 50000);
}

// A place that has a name that is not blurred is where that name is, which is asked again with more
// digits: so the lengths between true places are what is left, exactly.
TEST(Stretches, NamesThatAreNotBlurredTellTheTruth) {
  Random random(3);
  std::vector<Stretch<Certified>> covers;
  std::vector<Segment<Certified>> left;
  int told = 0, blurred = 0;
  for (int round = 0; round < 200000; ++round) {
    std::vector<double> places;
    const auto end = [&](std::uint32_t& name) {
      name = static_cast<std::uint32_t>(random.next() % 3 == 0 ? random.next() % (places.size() + 1)
                                                               : places.size());
      if (name == places.size()) places.push_back(unit(random));
      return places[name];
    };
    std::vector<Truth> truths;
    covers.clear();
    for (std::uint64_t n = 1 + random.next() % 4; n > 0; --n) {
      Truth truth{};
      truth.low = end(truth.low_name);
      truth.high = end(truth.high_name);
      if (truth.high == truth.low) continue;
      if (truth.high < truth.low) {
        std::swap(truth.low, truth.high);
        std::swap(truth.low_name, truth.high_name);
      }
      truths.push_back(truth);
      P low = any_place(random, truth.low), high = any_place(random, truth.high);
      low.name = PlaceName::line(truth.low_name);
      high.name = PlaceName::line(truth.high_name);
      if (shorten(low, high)) covers.push_back({low, high});
    }
    const Segment<Certified> whole{P::from(), P::to(), true};
    uncovered<Certified>({&whole, 1}, covers, left);
    double length = 0;
    bool all_told = true;
    const auto truth_of = [&](const P& place) {
      all_told = all_told && place.name.kind() != PlaceName::Kind::kNone;
      blurred += place.name.is_blurred() ? 1 : 0;
      if (place.name.kind() == PlaceName::Kind::kLine) return places[place.name.index()];
      return place.t;
    };
    for (const Segment<Certified>& segment : left) {
      const double low = truth_of(segment.low), high = truth_of(segment.high);
      length += std::max(0.0, high - low);
    }
    if (!all_told) continue;
    ++told;
    ASSERT_NEAR(length, uncovered_length(0, 1, truths), 1e-15) << "round " << round;
  }
  EXPECT_GT(told, 20000);
  EXPECT_GT(blurred, 5000);
}

TEST(Stretches, TheLaterOfTwoPlacesIsWithinItsBound) {
  Random random(2);
  for (int round = 0; round < 100000; ++round) {
    const double a = unit(random), b = random.next() % 4 == 0 ? a : unit(random);
    const P p = any_place(random, a), q = any_place(random, b);
    const P later = later_of(p, q), earlier = earlier_of(p, q);
    ASSERT_LE(std::fabs(later.t - std::max(a, b)), later.error + 1e-15) << "round " << round;
    ASSERT_LE(std::fabs(earlier.t - std::min(a, b)), earlier.error + 1e-15) << "round " << round;
  }
}

}  // namespace
}  // namespace gnomon::test
