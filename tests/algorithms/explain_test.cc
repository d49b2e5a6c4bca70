// SPDX-License-Identifier: GPL-3.0-or-later
// Which decisions of rounded kernels differ from the exact ones, and that flipping one of them in
// the exact run does what the rounded kernel does by it: by every method that asks kernels, under
// point, directional and area lights.
#include "gnomon/algorithms/explain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "gnomon/scene/read.h"
#include "solve.h"

namespace gnomon::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// Methods that are chosen by name, explain, and take this kind of light.
std::vector<MethodId> explaining(bool area) {
  std::vector<MethodId> methods;
  for (const Method& method : gnomon::methods()) {
    const bool takes = area ? method.lights.area : method.lights.point;
    if (method.explains && method.chosen_by_name && takes) methods.push_back(method.id);
  }
  return methods;
}

class Explain : public testing::Test {
 protected:
  void load(const std::string& text) {
    auto read = parse_scene(text, "scene.json");
    ASSERT_TRUE(read) << to_string(read.error());
    case_ = Case::make(std::move(read->scene));
    ASSERT_TRUE(case_);
  }
  void load_regression(const std::string& name) {
    case_ = Case::make(regression_scene(name));
    ASSERT_TRUE(case_) << name;
  }
  ShadowOptions options(const std::string& policy, MethodId method) const {
    const bool has_area = std::ranges::any_of(case_->prepared().lights, &PreparedLight::has_area);
    ShadowOptions options = options_by_name(policy, has_area ? MethodId::kSectors : method);
    if (has_area) options.method.area = method;
    return options;
  }
  Explanation explained(const std::string& policy, MethodId method, std::uint32_t flips = 1000) {
    auto result = explain(case_->prepared(), options(policy, method), {.flips = flips});
    EXPECT_TRUE(result) << (result ? "" : to_string(result.error()));
    if (!result) return {};
    check(*result, policy + " by " + name_of(method));
    return std::move(*result);
  }

  /// What holds of every explanation.
  static void check(const Explanation& found, const std::string& name) {
    std::uint64_t asked = 0, grouped = 0;
    for (const std::uint64_t count : found.asked) asked += count;
    EXPECT_GT(asked, 0u) << name;
    EXPECT_LE(found.times(), asked) << name;
    for (const DecisionGroup& group : found.groups) grouped += group.decisions;
    EXPECT_EQ(grouped, found.decisions.size()) << name;
    double last = HUGE_VAL;
    for (const DifferingDecision& decision : found.decisions) {
      EXPECT_NE(decision.tested, decision.exact) << name;
      EXPECT_GE(decision.times, 1u) << name;
      // The size is computed from the scene's integers, apart from the decision.
      const bool measured = decision.predicate != Predicate::kThreePoints;
      if (measured) EXPECT_EQ(decision.ulps > 0, decision.exact != Side::kOn) << name;
      EXPECT_LE(decision.ulps, last) << name;
      last = decision.ulps;
    }
    EXPECT_EQ(found.first.has_value(), !found.decisions.empty()) << name;
    for (const FlippedDecision& flip : found.flipped) {
      EXPECT_EQ(flip.effect.changed > 0, flip.effect.most.has_value()) << name;
    }
  }
  static const FlippedDecision* most_effective(const Explanation& found) {
    const FlippedDecision* most = nullptr;
    for (const FlippedDecision& flip : found.flipped) {
      if (flip.effect.most && (most == nullptr || size(flip.effect) > size(most->effect))) {
        most = &flip;
      }
    }
    return most;
  }
  static double size(const RunEffect& effect) {
    const ChangedSide& side = *effect.most;
    return std::max(std::fabs(side.before.lit - side.after.lit),
                    std::fabs(side.before.umbra - side.after.umbra));
  }
  /// The share that kernel `plane` gives the side, which the watched run has to have, too.
  double exact_lit(const ChangedSide& side, MethodId method) const {
    const auto result = compute_shadows(case_->prepared(), options("plane", method));
    for (const LightResult& light : result->lights) {
      if (light.light != side.light) continue;
      for (const PartResult& part : light.parts) {
        if (part.part == side.part && part.side == side.side) return part.lit.middle();
      }
    }
    return NAN;
  }

  std::unique_ptr<Case> case_;
};

// n . s is 2^-52, one unit in the last place, and double finds 0.
constexpr const char* kSunNearPlane = R"({"format": "gnomon-scene", "version": 1,
  "vertices": [[0, 3, 15], [4, 9, 13], [0, 4, 14]],
  "polygons": [{"id": "a", "loop": [0, 1, 2], "two_sided": true}],
  "lights": [{"id": "sun", "type": "directional", "to_light": [0.3, -0.5, 0.8]}]})";

TEST_F(Explain, OneDecisionTurnsAPolygonAndItsFlipDoesTheSame) {
  load(kSunNearPlane);
  for (const MethodId method : explaining(false)) {
    SCOPED_TRACE(name_of(method));
    const Explanation found = explained("double", method);
    ASSERT_GE(found.decisions.size(), 1u);
    const FlippedDecision* flip = most_effective(found);
    ASSERT_NE(flip, nullptr);
    ASSERT_TRUE(found.kernel.most);
    EXPECT_TRUE(flip->effect.classes);
    EXPECT_EQ(flip->effect.most->before.lit, 1);
    EXPECT_EQ(flip->effect.most->after.lit, 0);
    EXPECT_EQ(found.kernel.most->after.lit, 0);
    EXPECT_EQ(exact_lit(*found.kernel.most, method), 1);
  }
}

}  // namespace
}  // namespace gnomon::test
