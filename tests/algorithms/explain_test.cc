// SPDX-License-Identifier: GPL-3.0-or-later
// Which decisions of rounded kernels differ from the exact ones, and that flipping one of them in
// the exact run does what the rounded kernel does by it: by every method that asks kernels, under
// point, directional and area lights.
#include "gnomon/algorithms/explain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
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
      EXPECT_EQ(decision.ulps > 0, measured && decision.exact != Side::kOn) << name;
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
  /// The share that kernel `plane` gives the side, which the watched run has to have, too; not a
  /// number where only the rounded kernel has this side.
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
    const Explanation found = explained("double@1e-12", method);
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

// The same normal and n . x = 2^-52: a corner of the light is all that the polygon sees of it, and
// a thickness takes it for a point of its plane.
constexpr const char* kPanelJustInFront = R"({"format": "gnomon-scene", "version": 1,
  "vertices": [[0, 0, 0], [4, 6, -2], [0, 1, -1]],
  "polygons": [{"id": "a", "loop": [0, 1, 2], "two_sided": false}],
  "lights": [{"id": "panel", "type": "area",
              "loop": [[0.3, -0.5, 0.8], [2, -0.5, 0.8], [0.3, -2, 0.8]]}]})";

TEST_F(Explain, OneDecisionHidesAnAreaLightAndItsFlipDoesTheSame) {
  load(kPanelJustInFront);
  for (const MethodId method : explaining(true)) {
    SCOPED_TRACE(name_of(method));
    const Explanation found = explained("double@1e-12", method);
    const FlippedDecision* flip = most_effective(found);
    ASSERT_NE(flip, nullptr);
    ASSERT_TRUE(found.kernel.most);
    EXPECT_EQ(found.decisions[flip->decision].predicate, Predicate::kSupport);
    EXPECT_EQ(flip->effect.most->before.lit, found.kernel.most->before.lit);
    EXPECT_EQ(flip->effect.most->after.lit, found.kernel.most->after.lit);
    EXPECT_EQ(flip->effect.most->after.umbra, found.kernel.most->after.umbra);
    EXPECT_EQ(flip->effect.most->after.umbra, 1);
  }
}

std::string slab_under(const std::string& light) {
  return R"({"format": "gnomon-scene", "version": 1, "vertices": [[-2, -2, 0], [2, -2, 0],
    [2, 2, 0], [-2, 2, 0], [-0.5, -0.5, 9.094947017729282e-13], [0.5, -0.5, 9.094947017729282e-13],
    [0.5, 0.5, 9.094947017729282e-13], [-0.5, 0.5, 9.094947017729282e-13]],
    "polygons": [{"id": "floor", "loop": [0, 1, 2, 3]},
                 {"id": "slab", "loop": [4, 5, 6, 7], "two_sided": true}],
    "lights": [)" +
         light + "]}";
}

// A thickness finds a slab in the plane of the floor by all of its corners: no corner alone does
// it.
TEST_F(Explain, WhatSeveralDecisionsDoNoneDoesAlone) {
  const std::string lamp = R"({"id": "lamp", "type": "point", "position": [1, 0.5, 3]})";
  const std::string panel = R"({"id": "panel", "type": "area",
      "loop": [[-1, 1, 3], [1, 1, 3], [1, -1, 3], [-1, -1, 3]]})";
  for (const bool area : {false, true}) {
    load(slab_under(area ? panel : lamp));
    for (const MethodId method : explaining(area)) {
      SCOPED_TRACE(name_of(method));
      const Explanation found = explained("double@1e-12", method);
      EXPECT_TRUE(found.kernel.classes);
      ASSERT_TRUE(found.kernel.most);
      EXPECT_NEAR(found.kernel.most->before.lit, 0.9375, 1e-12);
      EXPECT_NEAR(found.kernel.most->after.lit, 1, 1e-12);
      EXPECT_GE(found.decisions.size(), 4u);
      // Computed without any error: a thickness is to blame.
      EXPECT_GT(found.decisions.front().ulps, 1e15);
      EXPECT_EQ(found.decisions.front().tested, Side::kOn);
      // A method that asks no further once a corner is in front comes to the other corners only in
      // the rounded run.
      if (!method_info(method).lights.area) {
        ASSERT_TRUE(found.together.most);
        EXPECT_EQ(found.together.changed, found.kernel.changed);
        EXPECT_EQ(found.together.most->part, found.kernel.most->part);
        EXPECT_NEAR(found.together.most->after.lit, 1, 1e-12);
      }
      for (const FlippedDecision& flip : found.flipped) {
        EXPECT_FALSE(flip.effect.most && flip.effect.most->after.lit > 0.99);
      }
    }
  }
}

// Scenes on which rounded kernels fail, by every method and policy: whatever they decide, the exact
// run is the exact answer, every flipped run ends or is stopped, and sizes agree with decisions.
TEST_F(Explain, HoldsOnScenesThatGoWrong) {
  for (const std::string name :
       {"i_plane_recomputed", "i_crack_in_needle", "i_light_in_plane", "i_light_in_plane_far",
        "i_sun_in_plane", "i_crossing", "i_decimals", "i_needles", "i_thickness_too_large",
        "i_light_shares_features"}) {
    load_regression(name);
    const bool area = std::ranges::any_of(case_->prepared().lights, &PreparedLight::has_area);
    for (const MethodId method : explaining(area)) {
      for (const std::string policy :
           {"float@0", "double@0", "double@1e-12", "double+identity@0", "longdouble@0", "epick"}) {
        SCOPED_TRACE(name + " by " + name_of(method) + " on " + policy);
        const Explanation found = explained(policy, method, 20);
        if (!found.kernel.most) continue;
        const double lit = exact_lit(*found.kernel.most, method);
        // Doubles measure needles 1e-9 wide.
        EXPECT_FALSE(std::fabs(found.kernel.most->before.lit - lit) > 1e-6);
      }
    }
  }
}

TEST_F(Explain, SaysTheFirstDecisionInWords) {
  load(kSunNearPlane);
  const auto found = explain(case_->prepared(), options("double@1e-12", MethodId::kSvbsp),
                             {.flips = 0, .only_first = true});
  ASSERT_TRUE(found && found->first);
  EXPECT_EQ(to_sentence(*found->first, case_->prepared(), "double", {"sun"}),
            "Decision 1 (light sun): the light is asked against support plane 0. double says on "
            "it, exact says in front.");
  EXPECT_TRUE(found->flipped.empty());
}

TEST_F(Explain, RefusesWhatCannotBeExplained) {
  load(kSunNearPlane);
  const auto by_contour = explain(case_->prepared(), options("double", MethodId::kContour), {});
  ASSERT_FALSE(by_contour);
  EXPECT_EQ(by_contour.error().code, ErrorCode::kUsage);
  EXPECT_THAT(to_string(by_contour.error()), HasSubstr("contour"));
  const auto exact = explain(case_->prepared(), options("plane", MethodId::kSectors), {});
  ASSERT_FALSE(exact);
  EXPECT_THAT(to_string(exact.error()), AllOf(HasSubstr("plane"), HasSubstr("exact")));
}

TEST_F(Explain, IsInterrupted) {
  load(kSunNearPlane);
  const std::atomic<bool> interrupted{true};
  ShadowOptions stopped = options("double@1e-12", MethodId::kSvbsp);
  stopped.control.interrupted = &interrupted;
  const auto found = explain(case_->prepared(), stopped, {.flips = 5});
  EXPECT_TRUE(found || found.error().code == ErrorCode::kInterrupted);
}

}  // namespace
}  // namespace gnomon::test
