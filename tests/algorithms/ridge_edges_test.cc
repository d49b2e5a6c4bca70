// SPDX-License-Identifier: GPL-3.0-or-later
// ridge-edges against zbuffer and the oracle from seven eyes, what its rows get wrong and how that
// falls, what it refuses, and what its counters say.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

#include "exact_check.h"
#include "fuzz/check/seven_eyes.h"
#include "fuzz/generate/generator.h"
#include "fuzz/generate/scene_pen.h"
#include "gnomon/algorithms/method_options.h"
#include "gnomon/algorithms/pixels.h"
#include "gnomon/oracle/image.h"
#include "gnomon/scene/generate.h"
#include "picture_runs.h"
#include "report/pixels/pixel_claims_of.h"
#include "report/pixels/rows_of_table.h"

namespace gnomon::test {
namespace {

using testing::HasSubstr;

oracle::ImageReport judged(const PreparedView& view, const ExactCamera& camera,
                           const std::string& method, const Pixels& pixels) {
  oracle::ImageOptions exact;
  exact.moves_ties = true;
  exact.near_border =
      report::rows_of_table(view, parse_method(method, Domain::kImageSpace).value());
  auto report =
      oracle::judge_pixels(view, report::pixel_claims_of(pixels, view.scene, camera), exact);
  EXPECT_TRUE(report) << to_string(report.error());
  return *std::move(report);
}

/// A closed solid of `gnomon generate closed` over a slab, under its lamp and a sun.
Scene solid_over_slab(const std::string& kind) {
  const GeneratorInfo& info = *generator_by_name("closed");
  Scene scene = generate("closed", {{"kind", parameter_value(info, "kind", kind).value()}}).value();
  double low = 0;
  for (const Position& vertex : scene.vertices) low = std::min(low, vertex[2].nearest());
  fuzz::ScenePen pen;
  const auto below = static_cast<std::int64_t>(std::floor(low)) - 2;
  pen.box({-60, -60, below - 1}, {60, 60, below}).sun({1, 2, 6});
  const Scene slab = pen.take();
  const auto first = static_cast<VertexId>(scene.vertices.size());
  scene.vertices.insert(scene.vertices.end(), slab.vertices.begin(), slab.vertices.end());
  for (Polygon polygon : slab.polygons) {
    polygon.id = "slab" + polygon.id;
    for (VertexId& v : polygon.loop) v += first;
    scene.polygons.push_back(std::move(polygon));
  }
  scene.lights.push_back(slab.lights.front());
  return scene;
}

constexpr const char* kAnyPolygons = "ridge-edges:rows=exact,depth=facing,hemisphere=cube";

TEST(RidgeEdges, WithoutRowsHasTheSamplesOfTheOracleFromSevenEyes) {
  std::uint32_t pick = 0;
  std::uint64_t judged_samples = 0;
  for (const Scene& scene : scenes_of_all_generators()) {
    const PreparedScene prepared = prepare(scene).value();
    for (const fuzz::NamedEye& eye : fuzz::seven_eyes(prepared, 64, ++pick)) {
      const auto view = prepare_view(scene, eye.camera);
      ASSERT_TRUE(view) << to_string(view.error());
      const Pixels own = pixels_of(*view, options_of(kAnyPolygons));
      const oracle::ImageReport report = judged(*view, eye.camera, kAnyPolygons, own);
      EXPECT_EQ(report.wrong, 0u) << scene.name << ", " << eye.name;
      judged_samples += report.judged;
      if (HasFailure()) return;
    }
  }
  EXPECT_GT(judged_samples, 500'000u);
}

TEST(RidgeEdges, EveryExactKernelHasTheSamplesOfZbuffer) {
  std::uint32_t pick = 0;
  for (const Scene& scene : scenes_of_all_generators()) {
    const PreparedScene prepared = prepare(scene).value();
    for (const fuzz::NamedEye& eye : fuzz::seven_eyes(prepared, 20, ++pick)) {
      const PreparedView view = prepare_view(scene, eye.camera).value();
      const Pixels reference = pixels_of(view, options_of("zbuffer"));
      for (const KernelId kernel : kExactKernels) {
        for (const char* pairing : {"", ",pairing=signed"}) {
          const Pixels own =
              pixels_of(view, options_of(std::string(kAnyPolygons) + pairing, kernel));
          EXPECT_EQ(own.part, reference.part) << scene.name << ", " << eye.name;
          EXPECT_EQ(own.lit_by, reference.lit_by) << scene.name << ", " << eye.name;
        }
      }
      for (const KernelId kernel : {KernelId::kFloat, KernelId::kDouble, KernelId::kEpick}) {
        for (const char* rows : {"exact", "50"}) {
          const std::string method =
              "ridge-edges:depth=facing,hemisphere=cube,rows=" + std::string(rows);
          EXPECT_EQ(pixels_of(view, options_of(method, kernel)).part.size(), reference.part.size());
        }
      }
      if (HasFailure()) return;
    }
  }
}

/// Hidden faces tell the same distances as facing ones, on solids that touch and on outlines that
/// wind and have holes.
TEST(RidgeEdges, HiddenFacesAreAsGoodAsFacingOnes) {
  std::vector<Scene> solids;
  for (const char* kind : {"block-on-block", "holed", "hole-like", "coil2", "polycube"}) {
    solids.push_back(solid_over_slab(kind));
  }
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    solids.push_back(fuzz::Generator::parse("family-closed-boxes").value().make(seed).scene);
  }
  std::uint32_t pick = 0;
  for (const Scene& scene : solids) {
    const PreparedScene prepared = prepare(scene).value();
    for (const fuzz::NamedEye& eye : fuzz::seven_eyes(prepared, 24, ++pick)) {
      const PreparedView view = prepare_view(scene, eye.camera).value();
      const Pixels reference = pixels_of(view, options_of("zbuffer"));
      for (const char* pairing : {"", ",pairing=signed"}) {
        const std::string method = std::string("ridge-edges:rows=exact,hemisphere=cube") + pairing;
        EXPECT_EQ(pixels_of(view, options_of(method)).lit_by, reference.lit_by)
            << scene.name << ", " << eye.name;
      }
      if (HasFailure()) return;
    }
  }
}

/// A camera that looks down at a solid, and along which its lamp sees everything.
struct Look {
  Scene scene;
  ExactCamera camera;
  PreparedView view;
};
Look look_down(Scene scene, std::uint32_t size) {
  CameraView down;
  down.look_at = {0, 0, 0};
  down.eye = {25, -35, 70};
  down.field_of_view = 60;
  down.width = down.height = size;
  const Position eye{Number(down.eye[0]), Number(down.eye[1]), Number(down.eye[2])};
  const ExactCamera camera = make_camera(eye, down).value();
  PreparedView view = prepare_view(scene, camera).value();
  return {std::move(scene), camera, std::move(view)};
}

std::uint64_t differing(const Pixels& a, const Pixels& b) {
  std::uint64_t count = 0;
  for (std::size_t s = 0; s < a.lit_by.size(); ++s) count += a.lit_by[s] != b.lit_by[s];
  return count;
}

/// Discretisation is told apart, is all that is wrong, and falls like 1 / N.
TEST(RidgeEdges, WhatRowsGetWrongFallsWithTheirNumber) {
  for (const char* kind : {"block-on-block", "holed", "letter"}) {
    const Look look = look_down(solid_over_slab(kind), 300);
    const Pixels exact = pixels_of(look.view, options_of("ridge-edges:rows=exact,hemisphere=cube"));
    EXPECT_EQ(judged(look.view, look.camera, "ridge-edges:rows=exact", exact).wrong, 0u) << kind;
    // Least squares of log wrong over log N.
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (const std::uint32_t rows : {75u, 150u, 300u, 600u, 1200u}) {
      const std::string method = "ridge-edges:hemisphere=cube,rows=" + std::to_string(rows);
      const Pixels own = pixels_of(look.view, options_of(method));
      const oracle::ImageReport report = judged(look.view, look.camera, method, own);
      EXPECT_EQ(report.by_rows, report.wrong) << kind << ", " << rows;
      EXPECT_NE(report.verdict, oracle::Verdict::kFailed);
      EXPECT_EQ(own.part, exact.part);
      const auto wrong = static_cast<double>(differing(own, exact));
      EXPECT_GT(wrong, 0) << "nothing to measure";
      const double x = std::log(rows), y = std::log(std::max(wrong, 1.0));
      ++n, sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
    const double exponent = (n * sxy - sx * sy) / (n * sxx - sx * sx);
    EXPECT_NEAR(exponent, -1, 0.25) << kind;
    std::cout << kind << ": wrong like N^" << exponent << '\n';
  }
}

std::string refusal(const Scene& scene, const std::string& method) {
  const PreparedScene prepared = prepare(scene).value();
  const auto eyes = fuzz::seven_eyes(prepared, 8, 1);
  const PreparedView view = prepare_view(scene, eyes.back().camera).value();
  PixelOptions options = options_of(method);
  options.scene = &scene;
  const auto pixels = compute_pixels(view.scene, view.frame, options);
  if (pixels) return "taken";
  EXPECT_EQ(pixels.error().code, ErrorCode::kGeometry);
  return to_string(pixels.error());
}

TEST(RidgeEdges, RefusesWhatHiddenFacesCannotTell) {
  const std::string cube = "ridge-edges:hemisphere=cube";
  const auto pen = [] {
    fuzz::ScenePen own;
    own.two_sided(false);
    return own;
  };
  fuzz::ScenePen open = pen();
  open.polygon({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}).lamp({1, 1, 9});
  const Scene sheet = open.take();
  EXPECT_THAT(refusal(sheet, cube), HasSubstr("of polygon 0 has no partner"));
  EXPECT_EQ(refusal(sheet, cube + ",depth=facing"), "taken");

  fuzz::ScenePen through = pen();
  through.box({0, 0, 0}, {4, 4, 4}).box({1, 1, 3}, {3, 3, 6}).lamp({1, 1, 9});
  EXPECT_THAT(refusal(through.take(), cube), HasSubstr("goes through polygon"));

  fuzz::ScenePen nested = pen();
  nested.box({0, 0, 0}, {6, 6, 6}).box({2, 2, 2}, {4, 4, 4}).lamp({1, 1, 9});
  EXPECT_THAT(refusal(nested.take(), cube), HasSubstr("inside of the solid of polygon 0"));

  fuzz::ScenePen room = pen();
  room.box({0, 0, 0}, {9, 9, 9}, true).box({2, 2, 0}, {4, 4, 2}).lamp({5, 5, 8});
  EXPECT_EQ(refusal(room.take(), cube), "taken") << "its walls face inwards";

  // Two edges of a solid are those of a tetrahedron that looks inwards, which makes one object.
  fuzz::ScenePen turned = pen();
  turned.polygon({{0, 0, 0}, {0, 2, 1}, {0, 2, 0}}).polygon({{0, 2, 0}, {0, 2, 1}, {2, 1, 2}});
  turned.polygon({{0, 0, 0}, {0, 2, 0}, {2, 1, 2}, {1, 0, 0}});
  turned.polygon({{0, 0, 0}, {1, 0, 0}, {2, 1, 2}, {0, 2, 1}});
  turned.polygon({{0, 2, 1}, {0, 0, 0}, {1, 1, 1}}).polygon({{0, 2, 1}, {2, 1, 2}, {0, 0, 0}});
  turned.polygon({{1, 1, 1}, {0, 0, 0}, {2, 1, 2}}).polygon({{0, 2, 1}, {1, 1, 1}, {2, 1, 2}});
  EXPECT_THAT(refusal(turned.sun({0, 0, 1}).take(), cube), HasSubstr("turned inside out"));

  fuzz::ScenePen sunlit = pen();
  sunlit.box({0, 0, 0}, {9, 9, 9}, true).sun({0, 0, 1});
  EXPECT_THAT(refusal(sunlit.take(), cube), HasSubstr("the light is inside of the solid"));

  fuzz::ScenePen lamp_inside = pen();
  lamp_inside.box({0, 0, 0}, {6, 6, 6}).lamp({3, 3, 3});
  EXPECT_THAT(refusal(lamp_inside.take(), cube), HasSubstr("the light is inside of the solid"));
  fuzz::ScenePen lamp_on = pen();
  lamp_on.box({0, 0, 0}, {6, 6, 6}).lamp({3, 3, 6});
  EXPECT_THAT(refusal(lamp_on.take(), cube), HasSubstr("the light is on the solid"));

  // A panel of two sheets.
  fuzz::ScenePen panel = pen();
  panel.polygon({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}});
  panel.polygon({{0, 0, 0}, {0, 4, 0}, {4, 4, 0}, {4, 0, 0}});
  const Scene sheets = panel.lamp({1, 1, 9}).take();
  EXPECT_THAT(refusal(sheets, cube), HasSubstr("polygons 0 and 1 of one solid lie back to back"));
  EXPECT_EQ(refusal(sheets, cube + ",depth=facing"), "taken");

  fuzz::ScenePen two_sided = pen();
  two_sided.two_sided(true).box({0, 0, 0}, {4, 4, 4}).lamp({1, 1, 9});
  EXPECT_THAT(refusal(two_sided.take(), cube), HasSubstr("polygon 0 has two sides"));
  fuzz::ScenePen idle = pen();
  idle.box({0, 0, 0}, {4, 4, 4}).lamp({1, 1, 9});
  Scene partly = idle.take();
  partly.polygons[2].casts = false;
  EXPECT_THAT(refusal(partly, cube), HasSubstr("polygon 2 casts no shadow"));
}

TEST(RidgeEdges, RefusesALightInsideTheViewUnlessByPyramids) {
  fuzz::ScenePen pen;
  pen.two_sided(false).box({-6, -6, -1}, {6, 6, 0}).box({-1, -1, 2}, {1, 1, 3}).lamp({0, 0, 4});
  const Scene scene = pen.take();
  CameraView view;
  view.eye = {0, -20, 3};
  view.look_at = {0, 0, 3};
  view.field_of_view = 60;
  view.width = view.height = 24;
  const ExactCamera camera = make_camera({Number(0.0), Number(-20.0), Number(3.0)}, view).value();
  const PreparedView prepared = prepare_view(scene, camera).value();
  PixelOptions options = options_of("ridge-edges");
  options.scene = &scene;
  const auto refused = compute_pixels(prepared.scene, prepared.frame, options);
  ASSERT_FALSE(refused);
  EXPECT_THAT(to_string(refused.error()), HasSubstr("light inside the view: polygon 0 reaches "
                                                    "beside or behind it"));
  EXPECT_THAT(to_string(refused.error()), HasSubstr("hemisphere=cube"));
  EXPECT_EQ(pixels_of(prepared, options_of("ridge-edges:hemisphere=cube,rows=exact")).lit_by,
            pixels_of(prepared, options_of("zbuffer")).lit_by);
}

/// One table where the light sees everything ahead, and the same samples.
TEST(RidgeEdges, OneHemisphereIsEnoughWhereTheLightSeesEverything) {
  Scene scene = generate("cubes", {{"n", 40}}).value();
  const PreparedScene prepared = prepare(scene).value();
  std::uint32_t taken = 0;
  for (const fuzz::NamedEye& eye : fuzz::seven_eyes(prepared, 32, 1)) {
    const PreparedView view = prepare_view(scene, eye.camera).value();
    PixelOptions options = options_of("ridge-edges:rows=exact,depth=facing");
    const auto one = compute_pixels(view.scene, view.frame, options);
    if (!one) continue;
    ++taken;
    EXPECT_EQ(one->lit_by, pixels_of(view, options_of("zbuffer")).lit_by) << eye.name;
  }
  EXPECT_GT(taken, 0u);
}

/// Whatever is drawn is looked up, so that far polygons first are the worst case.
TEST(RidgeEdges, FarPolygonsFirstAreLookedUpInVain) {
  const Scene scene = generate("cubes", {{"n", 60}}).value();
  const PreparedScene prepared = prepare(scene).value();
  const PreparedView view =
      prepare_view(scene, fuzz::seven_eyes(prepared, 200, 1).back().camera).value();
  const auto run = [&](const std::string& order) {
    return pixels_of(view, options_of("ridge-edges:hemisphere=cube,order=" + order));
  };
  const Pixels far = run("far"), near = run("near"), file = run("file");
  EXPECT_EQ(far.lit_by, near.lit_by);
  EXPECT_EQ(far.lit_by, file.lit_by);
  EXPECT_GT(far.work[Counter::kLookUps], near.work[Counter::kLookUps]);
  EXPECT_GE(file.work[Counter::kLookUps], near.work[Counter::kLookUps]);
}

/// Section 4: what is looked up follows the picture, and the table what loops cross its rows;
/// neither grows as the scene does.
TEST(RidgeEdges, CostsGrowLessThanTheScene) {
  const auto work = [](int cubes) {
    const Scene scene = generate("cubes", {{"n", static_cast<double>(cubes)}}).value();
    const PreparedScene prepared = prepare(scene).value();
    const PreparedView view =
        prepare_view(scene, fuzz::seven_eyes(prepared, 200, 1).back().camera).value();
    return pixels_of(view, options_of("ridge-edges:hemisphere=cube,order=near")).work;
  };
  const auto few = work(30), many = work(480);
  const auto grows = [&](Counter counter) {
    return static_cast<double>(many[counter]) / static_cast<double>(few[counter]);
  };
  EXPECT_LT(grows(Counter::kLookUps), 8);
  EXPECT_LT(grows(Counter::kTableSpans), 16);
  std::printf("16 times the cubes: %.1f times the look-ups, %.1f times the spans\n",
              grows(Counter::kLookUps), grows(Counter::kTableSpans));
}

TEST(RidgeEdges, CountsDoNotDependOnThreads) {
  const Look look = look_down(solid_over_slab("holed"), 80);
  for (const char* method :
       {"ridge-edges:hemisphere=cube", "ridge-edges:hemisphere=cube,rows=exact"}) {
    PixelOptions options = options_of(method);
    const Pixels one = pixels_of(look.view, options);
    options.jobs = 3;
    const Pixels three = pixels_of(look.view, options);
    EXPECT_EQ(one.lit_by, three.lit_by);
    EXPECT_EQ(one.work, three.work);
    EXPECT_GT(one.work[Counter::kLookUps], 0u);
    EXPECT_GT(one.work[Counter::kRidgeLoops], 0u);
    EXPECT_GT(one.work[Counter::kTableSpans], 0u);
    EXPECT_GT(one.work[Counter::kTableStretches], 0u);
    EXPECT_GT(one.work[Counter::kTableBytes], 0u);
    EXPECT_GT(one.table_seconds, 0);
  }
}

/// Distances that are linear in the angle are wrong on a solid itself, and right on what is wholly
/// behind it.
TEST(RidgeEdges, LinearDistancesAreNearlyRight) {
  const Look look = look_down(solid_over_slab("holed"), 120);
  const Pixels plane = pixels_of(look.view, options_of("ridge-edges:hemisphere=cube"));
  const Pixels linear =
      pixels_of(look.view, options_of("ridge-edges:hemisphere=cube,interpolate=linear"));
  EXPECT_EQ(plane.part, linear.part);
  EXPECT_LT(20 * differing(plane, linear), plane.lit_by.size());
}

TEST(RidgeEdges, OptionsAreReadAndTold) {
  for (const std::string text :
       {"ridge-edges", "ridge-edges:rows=exact", "ridge-edges:rows=150,pairing=signed",
        "ridge-edges:depth=facing,interpolate=linear,hemisphere=cube,order=far"}) {
    const auto selection = parse_method(text, Domain::kImageSpace);
    ASSERT_TRUE(selection) << text;
    EXPECT_EQ(method_text(selection->id, selection->values), text);
  }
  for (const char* wrong : {"rows=0", "rows=32769", "rows=many", "pairing=order", "depth=far",
                            "interpolate=no", "hemisphere=two"}) {
    EXPECT_FALSE(parse_method("ridge-edges:" + std::string(wrong), Domain::kImageSpace)) << wrong;
  }
}

}  // namespace
}  // namespace gnomon::test
