// SPDX-License-Identifier: GPL-3.0-or-later
// The deep umbra: a strip in the manner of the 1992 paper's Figure 4(f), whole cells against points
// of them, bounds against samples, and convergence.
#include "gnomon/algorithms/deep_umbra.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <vector>

#include "algorithms/illumination/umbra_cell.h"
#include "gnomon/algorithms/shadows.h"
#include "gnomon/algorithms/visible_light.h"
#include "light_soup.h"
#include "scene/base/random.h"

namespace gnomon {
namespace {

using namespace test;

/// Polygon 1 hides the light from x <= -1 of the floor, polygon 3 from x >= 3/2, and both together
/// from all of -1 <= x <= 0; in between more and more of it is seen between them.
PreparedScene strip() {
  LightSceneBuilder builder;
  builder.polygon({{-4, -1, 0}, {4, -1, 0}, {4, 1, 0}, {-4, 1, 0}});
  builder.polygon({{-4, -64, 5}, {0, -64, 5}, {0, 64, 5}, {-4, 64, 5}});
  builder.polygon({{0, -64, 6}, {4, -64, 6}, {4, 64, 6}, {0, 64, 6}});
  builder.area({{-1, -1, 10}, {-1, 1, 10}, {1, 1, 10}, {1, -1, 10}});
  return builder.build();
}

TEST(DeepUmbra, OfTwoCastersTogetherAsInFigure4f) {
  const PreparedScene scene = strip();
  ShadowOptions options;
  options.output.exact_fractions = true;
  const auto shadows = compute_shadows(scene, options);
  ASSERT_TRUE(shadows);
  // By class the strip is penumbra.
  EXPECT_EQ(shadows->lights[0].exact_fractions[0].umbra, mpq_class(5.5 / 8));
  EXPECT_EQ(shadows->lights[0].exact_fractions[0].penumbra, mpq_class(2.5 / 8));

  const LightVisibility visibility(scene, 0);
  for (const double x : {-4.0, -1.0, -0.5, -0x1p-60, 0.0, 1.5, 2.0}) {
    EXPECT_TRUE(visibility.is_deep_umbra(0, Side::kFront, exactly({x, 0.25, 0}))) << x;
  }
  for (const double x : {0x1p-60, 0.5, 1.0, 1.5 - 0x1p-50}) {
    EXPECT_FALSE(visibility.is_deep_umbra(0, Side::kFront, exactly({x, 0.25, 0}))) << x;
  }

  double width = 1;
  for (const double tolerance : {1e-1, 1e-2, 3e-3}) {
    DeepUmbraOptions deep;
    deep.tolerance = tolerance;
    deep.max_cells = 100000;
    const auto bounds = deep_umbra_bounds(scene, 0, deep);
    ASSERT_TRUE(bounds);
    const DeepUmbraBounds& floor = (*bounds)[0];
    EXPECT_EQ(floor.part, 0u);
    EXPECT_LE(floor.fraction.lower, 6.5 / 8);
    EXPECT_GE(floor.fraction.upper, 6.5 / 8);
    EXPECT_LE(floor.fraction.upper - floor.fraction.lower, tolerance * (1 + 1e-9));
    EXPECT_LE(floor.fraction.upper - floor.fraction.lower, width);
    width = floor.fraction.upper - floor.fraction.lower;
    std::printf("strip, tolerance %g: [%.6f, %.6f], %llu cells\n", tolerance, floor.fraction.lower,
                floor.fraction.upper, static_cast<unsigned long long>(floor.cells));
  }
  EXPECT_GT((*deep_umbra_bounds(scene, 0, {}))[0].fraction.lower, 5.5 / 8 + 0.1);
}

TEST(DeepUmbra, UnderABoxWhoseFacesHideTheLightTogether) {
  // Faces that share edges and corners: every ray passes some of them, and which one changes within
  // every cell, however small.
  LightSceneBuilder builder;
  builder.polygon({{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}});
  builder.polygon({{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}});  // outward: up
  builder.polygon({{-1, -1, 0}, {1, -1, 0}, {1, -1, 1}, {-1, -1, 1}});
  builder.polygon({{1, -1, 0}, {1, 1, 0}, {1, 1, 1}, {1, -1, 1}});
  builder.polygon({{1, 1, 0}, {-1, 1, 0}, {-1, 1, 1}, {1, 1, 1}});
  builder.polygon({{-1, 1, 0}, {-1, -1, 0}, {-1, -1, 1}, {-1, 1, 1}});
  builder.area({{-3, -3, 2}, {-3, 3, 2}, {3, 3, 2}, {3, -3, 2}});
  const PreparedScene scene = builder.build();
  DeepUmbraOptions options;
  options.max_cells = 20000;
  const auto bounds = deep_umbra_bounds(scene, 0, options);
  ASSERT_TRUE(bounds);
  const DeepUmbraBounds& floor = (*bounds)[0];
  EXPECT_LE(floor.fraction.lower, 0.25);
  EXPECT_GE(floor.fraction.upper, 0.25);
  EXPECT_LE(floor.fraction.upper - floor.fraction.lower, 1.001e-2);
  std::printf("box: [%.5f, %.5f], %llu cells\n", floor.fraction.lower, floor.fraction.upper,
              static_cast<unsigned long long>(floor.cells));
}

/// A cube of six panels as seen by a light above it, some of them in halves or quarters whose
/// corners lie inside the edges of their neighbours.
void add_cube_with_t_junctions(LightSceneBuilder& builder, bool with_floor) {
  if (with_floor) builder.polygon({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}});
  // The top in two halves, then the sides: the second in an upper and a lower half, the third in a
  // half and two quarters.
  builder.polygon({{-1, -1, 2}, {1, -1, 2}, {1, 0.25, 2}, {-1, 0.25, 2}});
  builder.polygon({{-1, 0.25, 2}, {1, 0.25, 2}, {1, 1, 2}, {-1, 1, 2}});
  builder.polygon({{-1, -1, 0}, {1, -1, 0}, {1, -1, 2}, {-1, -1, 2}});
  builder.polygon({{1, -1, 0}, {1, 1, 0}, {1, 1, 0.75}, {1, -1, 0.75}});
  builder.polygon({{1, -1, 0.75}, {1, 1, 0.75}, {1, 1, 2}, {1, -1, 2}});
  builder.polygon({{1, 1, 0}, {0.125, 1, 0}, {0.125, 1, 2}, {1, 1, 2}});
  builder.polygon({{0.125, 1, 0}, {-1, 1, 0}, {-1, 1, 1.5}, {0.125, 1, 1.5}});
  builder.polygon({{0.125, 1, 1.5}, {-1, 1, 1.5}, {-1, 1, 2}, {0.125, 1, 2}});
  builder.polygon({{-1, 1, 0}, {-1, -1, 0}, {-1, -1, 2}, {-1, 1, 2}});
}

TEST(DeepUmbra, OfACubeWhosePanelsMeetInTJunctions) {
  for (const bool with_floor : {true, false}) {
    LightSceneBuilder builder;
    // The floor of the cube itself is dark all over; of the ground below it, what the cube stands
    // on is, since the light is larger than the cube.
    if (!with_floor) builder.polygon({{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}});
    add_cube_with_t_junctions(builder, with_floor);
    builder.area({{-5, -5, 3}, {-5, 5, 3}, {5, 5, 3}, {5, -5, 3}});
    const PreparedScene scene = builder.build();
    DeepUmbraOptions options;
    options.tolerance = 1e-3;
    options.max_cells = 2000;
    const auto bounds = deep_umbra_bounds(scene, 0, options);
    ASSERT_TRUE(bounds);
    const DeepUmbraBounds& floor = (*bounds)[0];
    const double truth = with_floor ? 1 : 0.25;
    EXPECT_LE(floor.fraction.lower, truth);
    EXPECT_GE(floor.fraction.upper, truth);
    EXPECT_LE(floor.fraction.upper - floor.fraction.lower, 1.001e-3);
    std::printf("cube with T-junctions: [%.6f, %.6f], %llu cells\n", floor.fraction.lower,
                floor.fraction.upper, static_cast<unsigned long long>(floor.cells));
  }
}

TEST(DeepUmbra, CellsAreWhatTheirPointsAre) {
  Random random(21);
  std::size_t deep = 0, seen = 0, undecided = 0;
  for (int round = 0; round < 450; ++round) {
    const PreparedScene scene = round % 3 == 0 ? soup(random, 8 + round % 12, 2 + round % 4)
                                : round % 3 == 1
                                    ? solids(random, 3 + round % 6, 3 + round % 3)
                                    : divided_boxes(random, 1 + round % 4, 2 + round % 3);
    const BruteView brute(scene);
    const LightView view(scene, 0);
    const EdgeLines lines(scene.geometry);
    const LightVisibility visibility(scene, 0);
    SignCounts counts;
    for (std::uint32_t part = 0; part < scene.parts.size(); ++part) {
      const Side side =
          scene.parts[part].two_sided && random.chance(1, 2) ? Side::kBack : Side::kFront;
      const UmbraCells cells(view, lines, scene.parts[part], side);
      // Down to some random small cell of the part's first triangle.
      UmbraCell cell;
      cell.weight = 1;
      const auto loop = scene.loop(scene.parts[part]);
      for (std::uint32_t i = 0; i < 3; ++i) cell.points[i] = view.grid_point(loop[i]);
      std::vector<CasterSide> casters = cells.casters_of(cell);
      for (int depth = 0; depth < 12; ++depth) {
        std::vector<ExactPoint3> corners;
        bool in_front = true;
        for (const ExactVector& point : cell.points) {
          const Apex apex = Apex::from(scene.geometry, point, cell.weight);
          in_front = in_front && view.side_of_light(apex, counts) != Sign::kNegative;
          ExactPoint3& corner = corners.emplace_back();
          for (std::size_t k = 0; k < 3; ++k) {
            mpq_class c(point[k], cell.weight);
            c.canonicalize();
            corner[k] = scene.geometry.origin[k] + scene.geometry.step * c;
          }
        }
        const CellAnswer answer = in_front ? cells.decide(cell, casters) : CellAnswer::kUndecided;
        if (answer == CellAnswer::kUndecided) {
          ++undecided;
          cell = cell.halves(scene.geometry)[random.below(2)];
          continue;
        }
        for (int sample = 0; sample < 8; ++sample) {
          // Inside the cell: on its border touching casters count otherwise.
          ExactPoint3 p;
          mpq_class total;
          for (const ExactPoint3& corner : corners) {
            const mpq_class weight(static_cast<long>(1 + random.below(1000)));
            for (std::size_t k = 0; k < 3; ++k) p[k] += weight * corner[k];
            total += weight;
          }
          for (mpq_class& c : p) c /= total;
          EXPECT_EQ(visibility.is_deep_umbra(part, side, p), answer == CellAnswer::kDeep)
              << "round " << round << ", part " << part << ", depth " << depth;
        }
        ++(answer == CellAnswer::kDeep ? deep : seen);
        break;
      }
    }
    if (HasFailure()) return;
  }
  std::printf("cells: %zu deep, %zu seen, %zu undecided\n", deep, seen, undecided);
  EXPECT_GT(deep, 200u);
  EXPECT_GT(seen, 400u);
}

TEST(DeepUmbra, BoundsHoldSamplesAndConverge) {
  Random random(22);
  double widths[2] = {0, 0};
  std::uint64_t looked[2] = {0, 0};
  std::size_t sides = 0, more_than_umbra = 0;
  const auto start = std::chrono::steady_clock::now();
  for (int round = 0; round < 6; ++round) {
    const PreparedScene scene = soup(random, 14, 4);
    const BruteView brute(scene);
    const LightVisibility visibility(scene, 0);
    ShadowOptions shadows;
    shadows.output.exact_points = true;
    const auto classified = compute_shadows(scene, shadows);
    ASSERT_TRUE(classified);
    std::vector<DeepUmbraBounds> bounds[2];
    for (int i = 0; i < 2; ++i) {
      DeepUmbraOptions options;
      options.tolerance = i == 0 ? 3e-2 : 3e-3;
      options.max_cells = 3000;
      auto found = deep_umbra_bounds(scene, classified->lights[0], options);
      ASSERT_TRUE(found);
      bounds[i] = *std::move(found);
    }
    for (std::size_t i = 0; i < bounds[0].size(); ++i) {
      const PartResult& part = classified->lights[0].parts[i];
      const Interval fraction = bounds[1][i].fraction;
      EXPECT_GE(fraction.lower, bounds[0][i].fraction.lower - 1e-12);
      EXPECT_LE(fraction.upper, bounds[0][i].fraction.upper + 1e-12);
      if (part.reason != ShadowReason::kNone) {
        EXPECT_EQ(fraction.lower, 1);
        continue;
      }
      ++sides;
      const AreaFractions& classes = classified->lights[0].area_fractions[i];
      EXPECT_GE(fraction.lower, classes.umbra.lower - 1e-12);
      EXPECT_LE(fraction.upper, 1 - part.lit.lower + 1e-12);
      more_than_umbra += fraction.lower > classes.umbra.upper + 1e-3;
      for (int k = 0; k < 2; ++k) {
        widths[k] += bounds[k][i].fraction.upper - bounds[k][i].fraction.lower;
        looked[k] += bounds[k][i].cells;
      }
      // Uniform in the part's triangles (all of them are halves of parallelograms, or triangles).
      const std::vector<ExactPoint3>& loop = brute.faces[part.part].loop;
      const int samples = 300;
      int dark = 0;
      for (int s = 0; s < samples; ++s) {
        std::int64_t u = random.between(1, 9999), v = random.between(1, 9999);
        if (loop.size() == 3 && u + v >= 10000) {
          u = 10000 - u;
          v = 10000 - v;
        }
        ExactPoint3 p;
        for (std::size_t k = 0; k < 3; ++k) {
          p[k] = loop[0][k] + mpq_class(static_cast<long>(u), 10000) * (loop[1][k] - loop[0][k]) +
                 mpq_class(static_cast<long>(v), 10000) * (loop.back()[k] - loop[0][k]);
        }
        dark += visibility.is_deep_umbra(part.part, part.side, p);
      }
      const double share = dark / static_cast<double>(samples);
      EXPECT_GE(share, fraction.lower - 0.15);
      EXPECT_LE(share, fraction.upper + 0.15);
    }
  }
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::printf(
      "soups: %zu sides, %zu with more than their umbra; mean width %.4f (%llu cells), %.5f (%llu "
      "cells); %.2f s\n",
      sides, more_than_umbra, widths[0] / static_cast<double>(sides),
      static_cast<unsigned long long>(looked[0]), widths[1] / static_cast<double>(sides),
      static_cast<unsigned long long>(looked[1]), seconds);
  EXPECT_GT(sides, 40u);
  EXPECT_GT(more_than_umbra, 3u);
  EXPECT_LT(widths[1], widths[0]);
  EXPECT_LT(widths[1] / static_cast<double>(sides), 6e-3);
}

TEST(DeepUmbra, BadInputIsAnError) {
  const PreparedScene scene = strip();
  const auto shadows = compute_shadows(scene, {});  // no exact points
  ASSERT_TRUE(shadows);
  const auto bounds = deep_umbra_bounds(scene, shadows->lights[0], {});
  ASSERT_FALSE(bounds);
  EXPECT_EQ(bounds.error().code, ErrorCode::kUsage);
}

}  // namespace
}  // namespace gnomon
