// SPDX-License-Identifier: GPL-3.0-or-later
// Every method of the table under every value of its options: exact kernels equal the oracle on the
// families of the exact suite, and rounded ones put out something that can be read. A method joins
// by its row in the table.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "exact_check.h"
#include "fuzz/generate/families.h"
#include "gnomon/scene/generate.h"
#include "method_variants.h"

namespace gnomon::test {
namespace {

using fuzz::Family;

TEST(MethodVariants, AreThoseOfTheTable) {
  std::vector<std::string> names;
  for (const MethodSelection& variant : method_variants()) names.push_back(text_of(variant));
  EXPECT_THAT(names, testing::IsSupersetOf({"sectors",
                                            "contour",
                                            "svbsp",
                                            "receiver",
                                            "basic",
                                            "basic:cover=overlay",
                                            "basic:prune=off",
                                            "tiling",
                                            "svbsp:light-order=facing",
                                            "svbsp:grow=fragments",
                                            "merged",
                                            "tiling:tiles=1",
                                            "tiling:tiles=4",
                                            "tiling:prune=off",
                                            "svbsp-full",
                                            "svbsp-full:order=file",
                                            "two-pass",
                                            "two-pass:cells=off",
                                            "blots",
                                            "blots:sectors=off",
                                            "blots:outlines=whole",
                                            "blots:cover=overlay"}));
}

class MethodSuite : public testing::TestWithParam<Family> {
 protected:
  /// Calls check(scene, seed) for the first scenes of the family that can be prepared.
  template <class Check>
  void for_each_scene(std::uint64_t first_seed, unsigned count, const Check& check) {
    unsigned checked = 0;
    for (std::uint64_t seed = first_seed; seed < first_seed + count; ++seed) {
      const auto scene = Case::make(GetParam().make(seed));
      if (!scene) continue;
      ++checked;
      SCOPED_TRACE("seed " + std::to_string(seed) + "\n" + text_of(scene->scene()));
      check(*scene);
      if (HasFatalFailure()) return;
    }
    EXPECT_GE(checked, count / 2);
  }
};

/// Fails if fragments name what is not there. (Areas of rounded loops may overflow, and be none.)
void expect_readable(const ShadowResult& result) {
  for (const LightResult& light : result.lights) {
    for (const PartResult& part : light.parts) {
      ASSERT_LE(part.first_fragment + std::size_t{part.fragment_count}, light.fragments.size());
    }
    for (const Fragment& fragment : light.fragments) {
      ASSERT_GE(fragment.count, 3u);
      ASSERT_LE(fragment.first + std::size_t{fragment.count}, light.exact_points.size());
      ASSERT_TRUE(fragment.caster == Fragment::kNoCaster || fragment.caster < light.parts.size());
    }
  }
}

TEST_P(MethodSuite, KernelsAndOracleAgree) {
  // So many variants on so many kernels take long: a few scenes here, and the rest by campaigns
  // (docs/fuzzing.md, `gnomon fuzz --kernel plane/METHOD`).
  const bool slow = GetParam().name == "MixedMagnitudes";  // thousands of digits
  const unsigned scenes = slow ? 2 : std::max(3u, GetParam().blocks * GetParam().scenes / 120);
  for_each_scene(60000, scenes, [](const Case& scene) { ASSERT_EQ(check_methods(scene), ""); });
}

TEST_P(MethodSuite, RoundedKernelsPutOutSomething) {
  std::vector<std::string> kernels;
  for (const KernelInfo& kernel : kernel_list()) {
    if (kernel.exact) continue;
    for (const char* policy : {"", "+identity@0"}) {
      kernels.push_back(std::string(kernel.name) + policy);
    }
  }
  for_each_scene(70000, 3, [&](const Case& scene) {
    for (const std::string& kernel : kernels) {
      for (const MethodSelection& method : method_variants()) {
        ShadowOptions options = with_method(options_by_name(kernel, method.id), method);
        options.tuning.jobs = 1;
        options.limits.fragments = 100'000;
        for (std::uint32_t light = 0; light < scene.prepared().lights.size(); ++light) {
          if (!scene.is_area(light)) options.lights.push_back(light);
        }
        SCOPED_TRACE(kernel + " by " + text_of(method));
        const auto result = compute_shadows(scene.prepared(), options);
        if (!result) {  // a limit is an answer
          EXPECT_EQ(result.error().code, ErrorCode::kLimit) << to_string(result.error());
          continue;
        }
        expect_readable(*result);
        if (HasFatalFailure()) return;
      }
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Families, MethodSuite, testing::ValuesIn(fuzz::families()),
                         [](const auto& info) { return info.param.name; });

// --- Threads ---

TEST(MethodThreads, ResultsAndCountersDoNotDependOnThem) {
  for (const char* generator : {"lattice", "table-chair", "touching-boxes"}) {
    const Expected<Scene> made = generate(generator, {}, 3);
    ASSERT_TRUE(made) << to_string(made.error());
    const auto scene = Case::make(*made);
    ASSERT_TRUE(scene);
    for (const MethodSelection& method : method_variants()) {
      SCOPED_TRACE(std::string(generator) + " by " + text_of(method));
      ShadowOptions options = with_method(options_for(KernelId::kPlane), method);
      options.tuning.leaf_size = 4;
      options.tuning.task_size = 8;
      options.tuning.jobs = 1;
      const auto first = compute_shadows(scene->prepared(), options);
      ASSERT_TRUE(first);
      for (const unsigned jobs : {2u, 5u}) {
        options.tuning.jobs = jobs;
        const auto again = compute_shadows(scene->prepared(), options);
        ASSERT_TRUE(again);
        for (std::size_t l = 0; l < first->lights.size(); ++l) {
          const LightResult &one = first->lights[l], &two = again->lights[l];
          EXPECT_EQ(one.work, two.work) << jobs;
          EXPECT_EQ(one.tree_nodes, two.tree_nodes) << jobs;
          EXPECT_EQ(one.exact_points, two.exact_points) << jobs;
          ASSERT_EQ(one.fragments.size(), two.fragments.size()) << jobs;
          for (std::size_t i = 0; i < one.fragments.size(); ++i) {
            ASSERT_TRUE(one.fragments[i].state == two.fragments[i].state &&
                        one.fragments[i].caster == two.fragments[i].caster &&
                        one.fragments[i].first == two.fragments[i].first)
                << jobs << " fragment " << i;
          }
          for (std::size_t i = 0; i < one.parts.size(); ++i) {
            EXPECT_EQ(one.exact_fractions[i].lit, two.exact_fractions[i].lit)
                << jobs << " part " << i;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace gnomon::test
