// SPDX-License-Identifier: GPL-3.0-or-later
// The table of methods and the list of kernels: what they name is there, under one name each.
#include "algorithms/run/methods.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "gnomon/algorithms/method.h"
#include "gnomon/kernel/kernel_list.h"

namespace gnomon {
namespace {

TEST(Methods, EachRunsOnEachKernel) {
  for (const Method& method : methods()) {
    for (const KernelInfo& kernel : kernel_list()) {
      EXPECT_NE(method_function(method.id, kernel.id), nullptr)
          << method.name << ' ' << kernel.name;
    }
  }
}

TEST(Methods, ThoseOfImageSpaceAreRunByThemselves) {
  for (const Method& method : methods(Domain::kImageSpace)) {
    EXPECT_EQ(method.domain, Domain::kImageSpace);
    EXPECT_EQ(&method_info(method.id), &method);
    EXPECT_TRUE(method.needs.camera) << method.name;
    EXPECT_FALSE(method_by_name(method.name)) << method.name;
    EXPECT_TRUE(method_by_name(method.name, Domain::kImageSpace)) << method.name;
    EXPECT_EQ(method_function(method.id, KernelId::kPlane), nullptr) << method.name;
    for (const KernelInfo& kernel : kernel_list()) {
      EXPECT_NE(pixel_function(method.id, kernel.id), nullptr) << method.name << ' ' << kernel.name;
    }
  }
  EXPECT_EQ(pixel_function(MethodId::kSectors, KernelId::kPlane), nullptr);
}

TEST(Methods, HaveOneNameEach) {
  std::set<std::string_view> names;
  for (const Method& method : methods()) {
    EXPECT_TRUE(names.insert(method.name).second) << method.name;
    EXPECT_EQ(&method_info(method.id), &method);
    EXPECT_EQ(method_by_name(method.name).has_value(), method.chosen_by_name) << method.name;
    EXPECT_FALSE(method.summary.empty() || method.source.empty()) << method.name;
    EXPECT_TRUE(method.lights.point || method.lights.area) << method.name;
  }
  EXPECT_FALSE(method_by_name("auto"));
  EXPECT_FALSE(method_by_name(""));
}

TEST(Methods, AreNamedByTheLightsThatTheyTake) {
  EXPECT_EQ(method_names({.point = true}),
            "sectors, contour, svbsp, receiver, merged, basic, tiling, svbsp-full, two-pass, "
            "blots");
  EXPECT_EQ(method_names({.area = true}), "contour, receiver, merged");
  EXPECT_EQ(method_names({.point = true, .area = true}),
            "sectors, contour, svbsp, receiver, merged, basic, tiling, svbsp-full, two-pass, "
            "blots");
  EXPECT_EQ(method_names({}), "");
}

// Every kind of light is taken by a method that several lights can be combined with.
TEST(Methods, EveryLightCanBeCombined) {
  const auto combines = [](bool LightKinds::*kind) {
    return std::ranges::any_of(methods(), [&](const Method& method) {
      return method.lights.*kind && method.combines_lights;
    });
  };
  EXPECT_TRUE(combines(&LightKinds::point));
  EXPECT_TRUE(combines(&LightKinds::area));
}

}  // namespace
}  // namespace gnomon
