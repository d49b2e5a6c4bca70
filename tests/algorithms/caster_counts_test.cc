// SPDX-License-Identifier: GPL-3.0-or-later
// Areas by number of casters: by hand, against the oracle's overlay on thousands of degenerate
// scenes, and against what compute_shadows() calls lit.
#include "gnomon/algorithms/caster_counts.h"

#include <gtest/gtest.h>

#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "exact_check.h"
#include "fuzz/generate/families.h"
#include "gnomon/algorithms/shadows.h"
#include "gnomon/oracle/caster_counts.h"
#include "gnomon/oracle/point_regions.h"
#include "gnomon/scene/generate.h"
#include "light_soup.h"
#include "suite.h"

namespace gnomon::test {
namespace {

/// Shares by part and count.
using Shares = std::map<std::pair<std::uint32_t, std::uint32_t>, mpq_class>;

Shares counted(const PreparedScene& scene, const ShadowOptions& options, std::uint32_t light = 0) {
  const auto counts = count_casters(scene, options);
  if (!counts) throw std::runtime_error(to_string(counts.error()));
  Shares shares;
  for (const CasterCount& one : counts->at(light).shares) {
    EXPECT_GE(one.share.upper, one.exact.get_d() * (1 - 1e-15));
    EXPECT_LE(one.share.lower, one.exact.get_d() * (1 + 1e-15));
    shares[{one.part, one.count}] = one.exact;
  }
  return shares;
}

std::map<std::uint32_t, mpq_class> of_part(const Shares& shares, std::uint32_t part) {
  std::map<std::uint32_t, mpq_class> own;
  for (const auto& [key, share] : shares) {
    if (key.first == part) own[key.second] = share;
  }
  return own;
}

PreparedScene ground_under(const std::vector<std::vector<Triple>>& shades, const Triple& sun,
                           bool two_sided = true) {
  LightSceneBuilder builder;
  builder.polygon({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}});
  for (const auto& shade : shades) builder.polygon(shade, two_sided);
  builder.light(LightType::kDirectional, sun);
  return builder.build();
}

std::vector<Triple> level(double x0, double y0, double x1, double y1, double z) {
  return {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};
}

class ByHand : public testing::TestWithParam<KernelId> {
 protected:
  std::map<std::uint32_t, mpq_class> ground(const PreparedScene& scene) const {
    return of_part(counted(scene, options_for(GetParam())), 0);
  }
};

using Expected4 = std::map<std::uint32_t, mpq_class>;
mpq_class q(int p, int d) { return {p, d}; }

TEST_P(ByHand, TwoShadesThatOverlap) {
  EXPECT_EQ(ground(ground_under({level(0, 0, 2, 4, 1), level(1, 0, 3, 4, 2)}, {0, 0, 1})),
            (Expected4{{0, q(1, 4)}, {1, q(1, 2)}, {2, q(1, 4)}}));
}

TEST_P(ByHand, CoplanarCastersCountEach) {
  // Twice the same pane, and one beside it that shares an edge.
  EXPECT_EQ(ground(ground_under({level(0, 0, 2, 4, 1), level(0, 0, 2, 4, 1), level(2, 0, 4, 4, 1)},
                                {0, 0, 1})),
            (Expected4{{1, q(1, 2)}, {2, q(1, 2)}}));
}

TEST_P(ByHand, CastersThatCross) {
  // Two slanted panes that cross over x = 2, as seen from above both cover [1, 3] x [0, 4].
  const std::vector<Triple> up{{1, 0, 1}, {3, 0, 3}, {3, 4, 3}, {1, 4, 1}};
  const std::vector<Triple> down{{1, 0, 3}, {3, 0, 1}, {3, 4, 1}, {1, 4, 3}};
  const auto shares = counted(ground_under({up, down}, {0, 0, 1}), options_for(GetParam()));
  EXPECT_EQ(of_part(shares, 0), (Expected4{{0, q(1, 2)}, {2, q(1, 2)}}));
  EXPECT_EQ(of_part(shares, 1), (Expected4{{0, q(1, 2)}, {1, q(1, 2)}}));
  EXPECT_EQ(of_part(shares, 2), (Expected4{{0, q(1, 2)}, {1, q(1, 2)}}));
}

TEST_P(ByHand, OneSidedSolidCountsOnce) {
  // A box of outward faces on the ground: its top alone looks to the sun overhead.
  LightSceneBuilder builder;
  builder.polygon({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}});
  builder.polygon(level(1, 1, 3, 3, 2));                          // top
  builder.polygon({{1, 1, 1}, {1, 3, 1}, {3, 3, 1}, {3, 1, 1}});  // bottom, looks down
  builder.light(LightType::kDirectional, {0, 0, 1});
  EXPECT_EQ(ground(builder.build()), (Expected4{{0, q(3, 4)}, {1, q(1, 4)}}));
}

TEST_P(ByHand, PointLight) {
  // From (2, 2, 4) a pane of side 1 at height 2 throws a shadow of side 2, one of side 1 at height
  // 3 one of side 4; the second is half as far from the lamp and covers the first.
  LightSceneBuilder builder;
  builder.polygon({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}});
  builder.polygon(level(1.5, 1.5, 2.5, 2.5, 2));
  builder.polygon(level(1.5, 1.5, 2.5, 2.5, 3));
  builder.light(LightType::kPoint, {2, 2, 4});
  const auto shares = counted(builder.build(), options_for(GetParam()));
  EXPECT_EQ(of_part(shares, 0), (Expected4{{1, q(3, 4)}, {2, q(1, 4)}}));
  EXPECT_EQ(of_part(shares, 1), (Expected4{{1, 1}}));
  EXPECT_EQ(of_part(shares, 2), (Expected4{{0, 1}}));
}

INSTANTIATE_TEST_SUITE_P(Kernels, ByHand, testing::ValuesIn(kExactKernels), [](const auto& info) {
  return std::string(kernel_info(info.param).name);
});

/// What the counts of one run have wrong, or nothing.
std::string difference(const Case& scene, const ShadowOptions& options) {
  const PreparedScene& prepared = scene.prepared();
  const auto counts = count_casters(prepared, options);
  if (!counts) return to_string(counts.error());
  for (const CasterCounts& light : *counts) {
    const oracle::PointRegions regions(prepared, prepared.lights[light.light]);
    std::map<std::uint32_t, std::map<std::uint32_t, mpq_class>> found;
    for (const CasterCount& one : light.shares) found[one.part][one.count] = one.exact;
    for (std::uint32_t part = 0; part < prepared.parts.size(); ++part) {
      if (found[part] == oracle::caster_counts(prepared, regions, part)) continue;
      return "light " + std::to_string(light.light) + ", part " + std::to_string(part);
    }
  }
  return {};
}

std::string check_counts(const Case& scene) {
  ShadowOptions options = options_for(KernelId::kPlane);
  for (std::uint32_t light = 0; light < scene.prepared().lights.size(); ++light) {
    if (!scene.is_area(light)) options.lights.push_back(light);
  }
  if (options.lights.empty()) return {};
  for (const KernelId kernel : kExactKernels) {
    options.kernel.id = kernel;
    // Cells of light space make a tree of the few polygons on one of them.
    const std::string wrong =
        difference(scene, kernel == KernelId::kPlane ? with_small_cells(options) : options);
    if (!wrong.empty()) return std::string(kernel_info(kernel).name) + ": " + wrong;
  }
  return {};
}

class CountSuite : public testing::TestWithParam<Block> {};

TEST_P(CountSuite, OracleAgrees) { check_block(GetParam(), check_counts, 20); }

INSTANTIATE_TEST_SUITE_P(Families, CountSuite, testing::ValuesIn(blocks_of(fuzz::families())),
                         [](const auto& info) { return info.param.name(); });

PreparedScene generated(const std::string& name, std::int64_t count) {
  const Expected<Scene> scene = generate(name, {{"n", count}}, 1);
  if (!scene) throw std::runtime_error(to_string(scene.error()));
  Expected<PreparedScene> result = prepare(*scene);
  if (!result) throw std::runtime_error(to_string(result.error()));
  return std::move(*result);
}

TEST(CasterCounts, NoneIsLitAndThreadsDoNotMatter) {
  const PreparedScene scene = generated("quads", 300);
  ShadowOptions options = options_for(KernelId::kPlane);
  options.output.exact_points = false;
  options.method.point = MethodId::kSectors;
  options.tuning.task_size = 64;
  options.tuning.jobs = 1;
  const auto classes = compute_shadows(scene, options);
  ASSERT_TRUE(classes);
  const Shares one = counted(scene, options);
  options.tuning.jobs = 3;
  EXPECT_EQ(one, counted(scene, options));
  for (const PartResult& part : classes->lights[0].parts) {
    if (part.reason != ShadowReason::kNone) continue;
    const auto none = one.find({part.part, 0});
    EXPECT_EQ(none == one.end() ? mpq_class(0) : none->second,
              classes->lights[0].exact_fractions[part.part].lit);
  }
  mpq_class sum = 0;
  for (const auto& [count, share] : of_part(one, 0)) sum += share;
  EXPECT_EQ(sum, 1);
}

TEST(CasterCounts, RoundedKernelsComeClose) {
  const PreparedScene scene =
      ground_under({level(0, 0, 2, 4, 1), level(1, 0, 3, 4, 2)}, {0.125, 0.25, 1});
  ShadowOptions options = options_for(KernelId::kPlane);
  const Shares exact = counted(scene, options);
  for (const KernelId kernel : {KernelId::kFloat, KernelId::kDouble, KernelId::kEpick}) {
    const auto found = count_casters(scene, options_for(kernel));
    ASSERT_TRUE(found);
    for (const CasterCount& one : found->at(0).shares) {
      EXPECT_NEAR(one.share.middle(), (exact.at({one.part, one.count}).get_d()), 1e-5);
    }
  }
}

TEST(CasterCounts, AreaLightsAreRefused) {
  LightSceneBuilder builder;
  builder.polygon(level(0, 0, 1, 1, 0));
  builder.area({{0, 0, 2}, {0, 1, 2}, {1, 1, 2}, {1, 0, 2}});
  const auto counts = count_casters(builder.build(), ShadowOptions{});
  ASSERT_FALSE(counts);
  EXPECT_EQ(counts.error().code, ErrorCode::kUsage);
}

}  // namespace
}  // namespace gnomon::test
