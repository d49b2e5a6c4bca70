// SPDX-License-Identifier: GPL-3.0-or-later
// Points put out as doubles are the nearest to the exact ones, however they were found.
#include <gtest/gtest.h>

#include "fuzz/generate/families.h"
#include "gnomon/algorithms/shadows.h"
#include "kernel/signs/nearest_double.h"

namespace gnomon::test {
namespace {

using namespace fuzz;  // families and pens

/// `compared` counts points.
void expect_nearest(const Scene& scene, const std::string& what, std::size_t& compared) {
  const Expected<PreparedScene> prepared = prepare(scene);
  if (!prepared || prepared->lights.empty()) return;
  ShadowOptions options;
  options.output.points = true;
  for (std::uint32_t i = 0; i < prepared->lights.size(); ++i) {
    if (!prepared->lights[i].has_area()) options.lights.push_back(i);
  }
  if (options.lights.empty()) return;
  const auto fast = compute_shadows(*prepared, options);
  options.output.exact_points = true;
  const auto exact = compute_shadows(*prepared, options);
  ASSERT_TRUE(fast && exact) << what;
  for (std::size_t light = 0; light < fast->lights.size(); ++light) {
    const LightResult& own = fast->lights[light];
    const LightResult& truth = exact->lights[light];
    ASSERT_EQ(own.points.size(), truth.exact_points.size()) << what;
    compared += own.points.size();
    for (std::size_t i = 0; i < own.points.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(own.points[i][k], nearest_double(truth.exact_points[i][k]))
            << what << ", light " << light << ", point " << i << ", axis " << k;
      }
    }
    if (testing::Test::HasFailure()) return;
  }
}

TEST(NearestPoints, OfEveryFamilyAtEveryMagnitude) {
  std::size_t compared = 0;
  for (const Family& family : families()) {
    for (std::uint64_t seed = 1; seed <= 16; ++seed) {
      const Scene scene = family.make(seed);
      expect_nearest(scene, family.name + " " + std::to_string(seed), compared);
      expect_nearest(scaled(scene, seed % 2 == 0 ? 60 : -300), family.name + ", scaled", compared);
      if (HasFailure()) return;
    }
  }
  EXPECT_GT(compared, 50000u);
}

}  // namespace
}  // namespace gnomon::test
