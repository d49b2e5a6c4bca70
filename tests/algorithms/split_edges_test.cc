// SPDX-License-Identifier: GPL-3.0-or-later
// Edges that the scene BSP makes: in svbsp they have to bound shadow volumes (Chin & Feiner 1989,
// sec. 6, says that they need not count), and a tree with a node for every edge is as right as one
// without needless ones.
#include <gtest/gtest.h>

#include "algorithms/run/compute.h"
#include "exact_check.h"
#include "fuzz/generate/families.h"

namespace gnomon::test {
namespace {

ShadowOptions by_svbsp(EdgesInTree edges = EdgesInTree::kOwn) {
  ShadowOptions options = options_for(KernelId::kPlane);
  options.method.point = MethodId::kSvbsp;
  options.method.options.edges = edges;
  return options;
}

TEST(SplitEdges, LeftOutTheyAreMissed) {
  // Two triangles go through each other, and one of them is cut.
  const auto scene = Case::make(regression_scene("y_bsp_edges_left_out"));
  ASSERT_TRUE(scene);
  const auto right = compute_shadows(scene->prepared(), by_svbsp());
  ASSERT_TRUE(right);
  EXPECT_EQ(right->lights[0].exact_fractions[1].lit, mpq_class(191, 210));
  Rules rules;
  rules.edges_of_splits_bound_volumes = false;
  const auto wrong = compute_with(scene->prepared(), by_svbsp(), rules);
  ASSERT_TRUE(wrong);
  EXPECT_EQ(wrong->lights[0].exact_fractions[1].lit, mpq_class(1, 6));
}

TEST(SplitEdges, NodesOfAllEdgesAreMoreAndChangeNothing) {
  std::uint64_t own = 0, all = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const auto scene = Case::make(fuzz::families()[0].make(seed));
    if (!scene) continue;
    const auto few = compute_shadows(scene->prepared(), by_svbsp());
    const auto many = compute_shadows(scene->prepared(), by_svbsp(EdgesInTree::kAll));
    ASSERT_TRUE(few && many);
    for (std::size_t l = 0; l < few->lights.size(); ++l) {
      const LightResult &one = few->lights[l], &other = many->lights[l];
      for (std::size_t i = 0; i < one.exact_fractions.size(); ++i) {
        ASSERT_EQ(one.exact_fractions[i].lit, other.exact_fractions[i].lit) << seed;
      }
      own += one.work[Counter::kNodes];
      all += other.work[Counter::kNodes];
      // Both count the same way: a chain is no longer than the tree is deep.
      ASSERT_LE(one.work[Counter::kLongestChain], one.work[Counter::kDepth]);
      ASSERT_LE(one.work[Counter::kMeanFilterDepth], 1'000'000 * one.work[Counter::kDepth]);
    }
  }
  EXPECT_LT(own, all);
}

}  // namespace
}  // namespace gnomon::test
