// SPDX-License-Identifier: GPL-3.0-or-later
// Mistakes by hand: small scenes with numbers that can be checked in the head, on which the mutant
// fails in the way that is expected and the sound kernel does not; and no mistake that does
// nothing in silence.
#include "fuzz/mistakes/mistake.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "fuzz/check/check.h"
#include "fuzz/check/subject.h"
#include "fuzz/generate/scene_pen.h"
#include "fuzz/mistakes/compute.h"
#include "gnomon/scene/prepare.h"
#include "solve.h"

namespace gnomon::fuzz {
namespace {

using testing::HasSubstr;

/// The class of the first failure of the oracle's regions; empty if there is none.
std::string failure(const Scene& scene, const std::string& subject) {
  CheckOptions options;
  const auto parsed = parse_subject(subject);
  EXPECT_TRUE(parsed) << to_string(parsed.error());
  options.subjects = {*parsed};
  options.properties = {Property::kOracle, Property::kRefusal, Property::kBudget};
  const CaseReport report = check_scene(scene, options);
  return report.failures.empty() ? "" : report.failures.front().disagreement;
}

void expect_shown(const Scene& scene, const std::string& sound, const std::string& mistake,
                  const std::string& disagreement = "misclassified") {
  SCOPED_TRACE(sound + '~' + mistake);
  EXPECT_EQ(failure(scene, sound), "");
  EXPECT_EQ(failure(scene, sound + '~' + mistake), disagreement);
}

/// Two tiles of one plane that overlap in [1, 2] x [0, 2].
Scene tiles() {
  ScenePen pen;
  pen.polygon({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}});
  pen.polygon({{1, 0, 0}, {3, 0, 0}, {3, 2, 0}, {1, 2, 0}});
  return pen.lamp({1, 1, 4}).take();
}

TEST(Mistakes, CoplanarInSequence) {
  for (const char* sound : {"plane/svbsp", "rational/svbsp", "double/svbsp"}) {
    expect_shown(tiles(), sound, "coplanar-in-sequence");
  }
}

TEST(Mistakes, OnSwapped) {
  for (const char* sound : {"plane/svbsp", "plane", "rational", "double"}) {
    expect_shown(tiles(), sound, "on-swapped");
  }
  expect_shown(test::regression_scene("y_receiver_in_umbra_plane"), "plane", "on-swapped");
}

TEST(Mistakes, LightInPlaneFaces) {
  ScenePen pen;
  pen.polygon({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}});
  const Scene scene = pen.lamp({4, 1, 0}).take();
  for (const char* sound : {"rational/svbsp", "double/svbsp", "plane/receiver"}) {
    expect_shown(scene, sound, "light-in-plane-faces");
  }
}

TEST(Mistakes, StraddlingLightFaces) {
  for (const char* sound : {"plane", "rational", "plane/sectors/merged"}) {
    expect_shown(test::regression_scene("y_light_cut_by_receiver"), sound,
                 "straddling-light-faces");
  }
}

/// Two roofs in one place, a back over a corner, a ramp on a floor.
TEST(Mistakes, OfContours) {
  for (const char* sound : {"plane/contour", "rational/contour", "double/contour"}) {
    expect_shown(test::regression_scene("y_collinear_left_out"), sound, "collinear-left-out");
    expect_shown(test::regression_scene("y_caster_sets_differ"), sound, "caster-sets-differ");
    expect_shown(test::regression_scene("y_far_corner_decides"), sound, "far-corner-decides");
  }
}

TEST(Mistakes, OfShadowPolygons) {
  for (const char* sound :
       {"plane/shadow-polygons", "rational/shadow-polygons", "double/shadow-polygons"}) {
    for (const char* mistake : {"eye-always-lit", "eye-by-first-surface", "eye-counted-once",
                                "walls-keep-order", "one-perspective"}) {
      std::string name = std::string("y_") + mistake;
      std::ranges::replace(name, '-', '_');
      expect_shown(test::regression_scene(name), sound, mistake, "wrong light");
    }
  }
}

/// A tile of 1 over a floor of 100, whose thickness is then more than 1.
TEST(Mistakes, ThicknessTooLarge) {
  ScenePen pen;
  pen.polygon({{0, 0, 0}, {100, 0, 0}, {100, 100, 0}, {0, 100, 0}});
  pen.polygon({{50, 50, 8}, {51, 50, 8}, {51, 51, 8}, {50, 51, 8}});
  const Scene scene = pen.lamp({50, 50, 100}).take();
  for (const char* sound : {"double", "double/svbsp", "longdouble"}) {
    expect_shown(scene, sound, "thickness-too-large");
  }
}

/// A blade that casts a strip as thin as 1/100 of its length. The SVBSP tree loses fragments of the
/// blade, too, and with them their shadow.
TEST(Mistakes, SliversDropped) {
  ScenePen pen;
  pen.polygon({{0, 0, 0}, {100, 0, 0}, {100, 100, 0}, {0, 100, 0}});
  pen.polygon({{0, 50, 1}, {100, 50, 1}, {100, 51, 1}, {0, 51, 1}});
  const Scene scene = pen.sun({0, 0, 1}).take();
  expect_shown(scene, "plane/svbsp", "slivers-dropped");
  for (const char* sound : {"plane", "plane/receiver", "double"}) {
    expect_shown(scene, sound, "slivers-dropped", "uncovered");
  }
}

/// Of lights together: each light alone is right.
TEST(Mistakes, CombinedBitLost) {
  const Scene scene = test::regression_scene("y_combined_bit_lost");
  for (const char* sound : {"plane/svbsp:merge=convex", "rational/svbsp:merge=convex"}) {
    const std::string mutant = std::string(sound) + "~combined-bit-lost";
    EXPECT_EQ(failure(scene, sound), "");
    EXPECT_EQ(failure(scene, mutant), "") << "by lights one by one";
    CheckOptions options;
    options.properties = {Property::kTogether};
    options.subjects = {*parse_subject(sound)};
    EXPECT_TRUE(check_scene(scene, options).failures.empty());
    options.subjects = {*parse_subject(mutant)};
    const CaseReport report = check_scene(scene, options);
    ASSERT_EQ(report.failures.size(), 1u);
    EXPECT_EQ(report.failures[0].disagreement, "misclassified");
    EXPECT_EQ(report.failures[0].light, "sun");
    EXPECT_EQ(report.failures[0].polygon, "a");
  }
}

TEST(Mistakes, NoneDoesNothingInSilence) {
  const auto message = [](const char* name) {
    const auto subject = parse_subject(name);
    return subject ? std::string("accepted") : to_string(subject.error());
  };
  EXPECT_THAT(message("plane~coplanar-in-sequence"), HasSubstr("changes nothing"));
  EXPECT_THAT(message("plane~far-corner-decides"), HasSubstr("changes nothing"));
  EXPECT_THAT(message("plane~eye-always-lit"), HasSubstr("changes nothing"));
  EXPECT_THAT(message("plane/zbuffer~eye-always-lit"), HasSubstr("changes nothing"));
  EXPECT_THAT(message("plane/shadow-polygons~on-swapped"), HasSubstr("changes nothing"));
  EXPECT_THAT(message("plane/contour~coplanar-in-sequence"), HasSubstr("changes nothing"));
  EXPECT_THAT(message("plane/svbsp~planes-from-fragments"), HasSubstr("changes nothing"));
  EXPECT_THAT(message("plane~union-without-continued-planes"), HasSubstr("changes nothing"));
  EXPECT_THAT(message("double+thin~thickness-too-small"), HasSubstr("no thickness anyway"));
  EXPECT_THAT(message("plane~t-vertices-left-in"), HasSubstr("mistake of meshes"));
  EXPECT_THAT(message("plane/svbsp~combined-bit-lost"), HasSubstr("mistake of merging"));
  EXPECT_THAT(message("plane~combined-bit-lost"), HasSubstr("mistake of merging"));
  // The subject is one, but not of this scene's lights.
  ScenePen pen;
  pen.polygon({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}});
  const auto scene = prepare(pen.lamp({1, 1, 4}).take()).value();
  const auto subject = parse_subject("plane~straddling-light-faces");
  ASSERT_TRUE(subject);
  const auto result = compute_shadows(scene, shadow_options(*subject), subject->mistake);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kUsage);
}

/// Each changes something for some kernel, and kNone is accepted everywhere.
TEST(Mistakes, ApplySomewhere) {
  for (const MistakeInfo& info : mistakes()) {
    bool applies = info.mistake == Mistake::kTVerticesLeftIn;
    for (const KernelInfo& kernel : kernel_list()) {
      for (const Method& method : methods(Domain::kImageSpace)) {
        applies = applies || applies_to(info.mistake, kernel.id, method.id);
      }
      for (const Method& method : methods()) {
        if (!method.lights.point) continue;
        const MethodId algorithm = method.id;
        applies = applies || applies_to(info.mistake, kernel.id, algorithm);
        EXPECT_TRUE(applies_to(Mistake::kNone, kernel.id, algorithm));
      }
      for (const MethodId algorithm : {MethodId::kReceiver, MethodId::kMerged}) {
        applies = applies || applies_to_area(info.mistake, kernel.id, algorithm);
      }
      EXPECT_FALSE(applies_to_area(info.mistake, kernel.id, MethodId::kPieces));
    }
    EXPECT_TRUE(applies) << info.name;
  }
}

}  // namespace
}  // namespace gnomon::fuzz
