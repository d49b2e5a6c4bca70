// SPDX-License-Identifier: GPL-3.0-or-later
// The merged trees of 1992 against the receiver algorithm, which shares neither tree nor polyhedra
// with them: the same exact fractions of all classes on small scenes, most of them degenerate, and
// the same exact area for every set of lights where several are classified together; the scenes of
// the paper's figures 4 and 6; limits, interruption, threads; and pieces of lights.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "algorithms/run/compute.h"
#include "fuzz/generate/scene_pen.h"
#include "fuzz/mistakes/compute.h"
#include "gnomon/algorithms/shadows.h"
#include "gnomon/scene/prepare.h"
#include "scene/base/random.h"
#include "solve.h"

namespace gnomon::test {
namespace {

using namespace fuzz;  // families and pens

Scene with_lamp(ScenePen& pen, const std::vector<Triple>& loop) {
  Light light;
  light.id = "panel";
  light.type = LightType::kArea;
  for (const Triple& vertex : loop) light.loop.push_back(pen.position(vertex));
  Scene scene = pen.take();
  scene.lights.push_back(std::move(light));
  return scene;
}

/// Triangles and parallelograms of a small grid.
std::vector<Triple> random_loop(Random& random, std::int64_t size) {
  const auto point = [&]() -> Triple {
    return {random.between(0, size), random.between(0, size), random.between(0, size)};
  };
  for (;;) {
    const Triple a = point(), b = point(), c = point();
    if (is_zero(cross(b - a, c - a))) continue;
    if (random.chance(1, 3)) return {a, b, c};
    return {a, b, b + (c - a), c};
  }
}

/// Anything: casters and receivers cut the light, share its vertices, edges, plane.
Scene soup(std::uint64_t seed) {
  Random random(seed);
  const std::int64_t size = seed % 3 == 0 ? 3 : seed % 3 == 1 ? 6 : 500;
  ScenePen pen;
  for (int i = 0; i < 7; ++i) {
    pen.two_sided(random.chance(1, 3)).casts(!random.chance(1, 12));
    pen.polygon(random_loop(random, size));
  }
  return with_lamp(pen, random_loop(random, size));
}

/// A ceiling light over axis-parallel boxes on a floor: much that touches.
Scene boxes(std::uint64_t seed) {
  Random random(seed);
  ScenePen pen;
  pen.polygon({{0, 0, 0}, {12, 0, 0}, {12, 12, 0}, {0, 12, 0}});
  pen.two_sided(random.chance(1, 2));
  pen.polygon({{0, 12, 0}, {12, 12, 0}, {12, 12, 12}, {0, 12, 12}});
  pen.two_sided(false);
  for (int i = 0; i < 2; ++i) {
    const std::int64_t x = random.between(0, 8), y = random.between(0, 8), z = random.between(0, 5);
    pen.box({x, y, z},
            {x + random.between(1, 3), y + random.between(1, 3), z + random.between(1, 3)});
  }
  const std::int64_t x = random.between(0, 8), y = random.between(0, 8), z = random.between(5, 12);
  const std::int64_t w = random.between(1, 4), d = random.between(1, 4);
  return with_lamp(pen, {{x, y, z}, {x, y + d, z}, {x + w, y + d, z}, {x + w, y, z}});
}

/// Walls that stand on the floor that the light stands on: planes of volumes in the floor.
Scene standing(std::uint64_t seed) {
  Random random(seed);
  ScenePen pen;
  pen.two_sided(random.chance(1, 2));
  pen.polygon({{0, 0, 0}, {12, 0, 0}, {12, 12, 0}, {0, 12, 0}});
  for (int i = 0; i < 3; ++i) {
    const std::int64_t x = random.between(2, 8), y = random.between(0, 6), h = random.between(1, 8),
                       w = random.between(1, 6), shift = random.between(-1, 2);
    pen.two_sided(random.chance(1, 2));
    pen.polygon({{x, y, 0}, {x, y, h}, {x + shift, y + w, h}, {x + shift, y + w, 0}});
  }
  pen.polygon({{11, 0, 0}, {11, 0, 9}, {11, 12, 9}, {11, 12, 0}});
  const std::int64_t y = random.between(1, 6), w = random.between(1, 3), h = random.between(1, 4);
  return with_lamp(pen, {{1, y, 0}, {1, y + w, 0}, {1, y + w, h}, {1, y, h}});
}

/// 1992, fig. 6: the penumbra of the second polygon, which goes in last, crosses the leftmost plane
/// of the penumbra of the first, and comes out of it again beside it.
Scene figure_6() {
  ScenePen pen;
  pen.polygon({{-40, -40, 0}, {40, -40, 0}, {40, 40, 0}, {-40, 40, 0}});
  pen.polygon({{1, 3, 14}, {1, -3, 14}, {4, -3, 14}, {4, 3, 14}});
  pen.polygon({{-6, -8, 12}, {-2, -8, 12}, {-2, 8, 12}, {-6, 8, 12}});
  return with_lamp(pen, {{-4, -4, 20}, {-4, 4, 20}, {4, 4, 20}, {4, -4, 20}});
}

ShadowOptions options_of(MethodId algorithm, KernelId kernel) {
  ShadowOptions options;
  options.kernel.id = kernel;
  options.method.area = algorithm;
  options.output.exact_fractions = true;
  options.tuning.jobs = 1;
  return options;
}

std::string text_of(const LightResult& light) {
  std::string text;
  for (std::size_t i = 0; i < light.parts.size(); ++i) {
    const PartResult& part = light.parts[i];
    const ExactFractions& exact = light.exact_fractions[i];
    text += std::to_string(part.part) + (part.side == Side::kFront ? " front " : " back ") +
            std::to_string(static_cast<int>(part.reason)) + " " + exact.lit.get_str() + " " +
            exact.penumbra.get_str() + " " + exact.umbra.get_str() + "\n";
  }
  return text;
}

std::string text_of(const PreparedScene& scene, const ShadowOptions& options,
                    Mistake mistake = Mistake::kNone) {
  const auto result = compute_shadows(scene, options, mistake);
  if (!result) return result.error().what;
  EXPECT_EQ(result->lights.size(), 1u);
  EXPECT_EQ(result->lights[0].dropped_slivers, 0u);
  const LightResult& light = result->lights[0];
  for (const ExactFractions& part : light.exact_fractions) {
    EXPECT_EQ(mpq_class(part.lit + part.penumbra + part.umbra), 1);
  }
  return text_of(light);
}

void compare(Scene (*make)(std::uint64_t), unsigned scenes) {
  for (std::uint64_t seed = 0; seed < scenes; ++seed) {
    const Scene scene = make(seed);
    const auto prepared = prepare(scene);
    if (!prepared) continue;
    const std::string expected =
        text_of(*prepared, options_of(MethodId::kReceiver, KernelId::kPlane));
    ShadowOptions options = options_of(MethodId::kMerged, KernelId::kPlane);
    EXPECT_EQ(text_of(*prepared, options), expected) << "seed " << seed;
    options.method.prefix = false;
    options.output.merge = false;
    EXPECT_EQ(text_of(*prepared, options), expected) << "without a prefix, seed " << seed;
    if (seed % 10 != 0) continue;
    options = options_of(MethodId::kMerged, KernelId::kRational);
    EXPECT_EQ(text_of(*prepared, options), expected) << "rational, seed " << seed;
  }
}

TEST(Merged, EqualsReceiverOnSoups) { compare(soup, 300); }
TEST(Merged, EqualsReceiverOnBoxes) { compare(boxes, 200); }
TEST(Merged, EqualsReceiverOnStandingWalls) { compare(standing, 200); }

TEST(Merged, Figure6) {
  const auto scene = prepare(figure_6()).value();
  const std::string expected = text_of(scene, options_of(MethodId::kReceiver, KernelId::kPlane));
  const ShadowOptions options = options_of(MethodId::kMerged, KernelId::kPlane);
  EXPECT_EQ(text_of(scene, options), expected);
  EXPECT_NE(text_of(scene, options, Mistake::kUnionWithoutContinuedPlanes), expected);
}

/// What the wrong union leaves out is lit where penumbra is true: an error, and the oracle sees it.
TEST(Merged, TheOracleCatchesTheWrongUnion) {
  std::string why;
  const auto scene = Case::make(figure_6(), &why);
  ASSERT_TRUE(scene) << why;
  ShadowOptions options = options_of(MethodId::kMerged, KernelId::kPlane);
  options.output.exact_points = true;
  const auto right = compute_shadows(scene->prepared(), options).value();
  EXPECT_EQ(judge(*scene, right).verdict, oracle::Verdict::kIdentical);
  const auto wrong =
      compute_shadows(scene->prepared(), options, Mistake::kUnionWithoutContinuedPlanes).value();
  const oracle::Report report = judge(*scene, wrong, false);
  EXPECT_EQ(report.verdict, oracle::Verdict::kFailed);
  ASSERT_TRUE(report.worst.has_value());
  EXPECT_EQ(report.worst->found, LightState::kLit);
  EXPECT_EQ(report.worst->truth, LightState::kPenumbra);
}

/// 1992, fig. 4(f): between the umbras of two polygons that together hide the light is penumbra.
TEST(Merged, Figure4f) {
  ScenePen pen;
  pen.polygon({{-40, -40, 0}, {40, -40, 0}, {40, 40, 0}, {-40, 40, 0}});
  pen.polygon({{-8, -20, 12}, {0, -20, 12}, {0, 20, 12}, {-8, 20, 12}});
  pen.polygon({{0, -20, 10}, {8, -20, 10}, {8, 20, 10}, {0, 20, 10}});
  const Scene scene = with_lamp(pen, {{-4, -4, 20}, {-4, 4, 20}, {4, 4, 20}, {4, -4, 20}});
  const auto prepared = prepare(scene).value();
  const std::string expected = text_of(prepared, options_of(MethodId::kReceiver, KernelId::kPlane));
  const ShadowOptions options = options_of(MethodId::kMerged, KernelId::kPlane);
  EXPECT_EQ(text_of(prepared, options), expected);
  ShadowOptions with_points = options;
  with_points.output.points = true;
  const LightResult light = compute_shadows(prepared, with_points)->lights[0];
  // The point (1, 0, 0) sees no light, since the two hide it together; neither does it alone.
  bool found = false;
  for (std::uint32_t f = 0; f < light.parts[0].fragment_count; ++f) {
    const Fragment& fragment = light.fragments[light.parts[0].first_fragment + f];
    bool inside = true;
    for (std::uint32_t i = 0; i < fragment.count; ++i) {
      const auto& a = light.points[fragment.first + i];
      const auto& b = light.points[fragment.first + (i + 1) % fragment.count];
      inside = inside && (b[0] - a[0]) * (0 - a[1]) - (b[1] - a[1]) * (1 - a[0]) >= 0;
    }
    if (!inside) continue;
    found = true;
    EXPECT_EQ(fragment.state, LightState::kPenumbra);
  }
  EXPECT_TRUE(found);
}

/// A far lamp is outside of the box that volumes are cut out of.
TEST(Merged, FarLampSeesTheBoxFromOutside) {
  const auto scene = Case::make(regression_scene("y_far_lamp_below_a_floor"));
  for (const KernelId kernel : {KernelId::kPlane, KernelId::kRational, KernelId::kEpeck}) {
    ShadowOptions options = options_of(MethodId::kMerged, kernel);
    options.method.point = MethodId::kMerged;
    options.output.exact_points = true;
    const auto result = compute_shadows(scene->prepared(), options).value();
    EXPECT_EQ(judge(*scene, result).verdict, oracle::Verdict::kIdentical)
        << kernel_info(kernel).name;
  }
}

TEST(Merged, StopsAtLimits) {
  const auto scene = prepare(boxes(3)).value();
  ShadowOptions options = options_of(MethodId::kMerged, KernelId::kPlane);
  options.limits.fragments = 1;
  EXPECT_EQ(compute_shadows(scene, options).error().code, ErrorCode::kLimit);
  options.method.area = MethodId::kPieces;
  EXPECT_EQ(compute_shadows(scene, options).error().code, ErrorCode::kLimit);
  options.limits.fragments = 1000000;
  options.output.combined = true;
  EXPECT_EQ(compute_shadows(scene, options).error().code, ErrorCode::kUsage);
  options.output.combined = false;
  const std::atomic<bool> interrupted = true;
  options.control.interrupted = &interrupted;
  EXPECT_EQ(compute_shadows(scene, options).error().code, ErrorCode::kInterrupted);
}

TEST(Merged, AnswersAlikeOnAnyNumberOfThreads) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const auto scene = prepare(soup(seed)).value();
    ShadowOptions options = options_of(MethodId::kMerged, KernelId::kPlane);
    const std::string expected = text_of(scene, options);
    options.tuning.jobs = 2;
    double last = 0;
    options.control.progress = [&](double done) {
      EXPECT_GE(done, last);
      EXPECT_LE(done, 1);
      last = done;
    };
    EXPECT_EQ(text_of(scene, options), expected);
  }
}

TEST(Merged, EpeckAgrees) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const auto scene = prepare(seed % 2 == 0 ? soup(seed) : standing(seed));
    if (!scene) continue;
    EXPECT_EQ(text_of(*scene, options_of(MethodId::kMerged, KernelId::kEpeck)),
              text_of(*scene, options_of(MethodId::kMerged, KernelId::kPlane)))
        << seed;
  }
}

/// Whatever rounding makes of polyhedra is a finding, never fatal.
TEST(Merged, RoundedKernelsComeToAnEnd) {
  std::uint64_t findings = 0, results = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const auto scene = prepare(seed % 3 == 0   ? soup(seed)
                               : seed % 3 == 1 ? boxes(seed)
                                               : standing(seed));
    if (!scene) continue;
    for (const KernelId kernel :
         {KernelId::kFloat, KernelId::kDouble, KernelId::kLongDouble, KernelId::kEpick}) {
      for (const bool identity : {false, true}) {
        ShadowOptions options = options_of(MethodId::kMerged, kernel);
        options.output.exact_fractions = false;
        options.kernel.identity = identity;
        options.kernel.thickness = seed % 2 == 0 ? 0 : kDefaultThickness;
        options.limits.fragments = 100000;
        const auto result = compute_shadows(*scene, options);
        if (!result) {
          EXPECT_EQ(result.error().code, ErrorCode::kLimit);
          continue;
        }
        ++results;
        findings += result->lights[0].dropped_slivers;
      }
    }
  }
  EXPECT_GT(results, 400u);
  RecordProperty("findings", std::to_string(findings));
}

// --- Several lights together ---

/// Four times the square of the area of a planar loop.
mpq_class squared_area(const std::vector<std::array<mpq_class, 3>>& loop,
                       std::array<mpq_class, 3>& normal) {
  normal = {0, 0, 0};
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const auto& a = loop[i];
    const auto& b = loop[(i + 1) % loop.size()];
    for (std::size_t k = 0; k < 3; ++k) {
      normal[k] += a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
    }
  }
  return normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
}

/// The scene under two area lights, a lamp and a sun.
Scene with_more_lights(Scene scene, std::uint64_t seed) {
  Random random(seed ^ 0xbeef);
  ScenePen pen;
  const std::int64_t size = seed % 2 == 0 ? 6 : 14;
  const auto add = [&](LightType type) -> Light& {
    Light& light = scene.lights.emplace_back();
    light.id = "light" + std::to_string(scene.lights.size());
    light.type = type;
    return light;
  };
  for (const Triple& vertex : random_loop(random, size)) {
    if (scene.lights.size() == 1) add(LightType::kArea);
    scene.lights.back().loop.push_back(pen.position(vertex));
  }
  add(LightType::kPoint).position =
      pen.position({random.between(0, size), random.between(0, size), random.between(0, size)});
  add(LightType::kDirectional).position =
      pen.position({random.between(-2, 2), random.between(-2, 2), random.between(1, 3)});
  return scene;
}

using Area = std::array<mpq_class, 3>;
/// Twice the area vector of what each set of lights reaches, of each side of each part.
using AreasOfSets = std::map<std::tuple<std::uint32_t, Side, std::uint64_t, std::uint64_t>, Area>;

AreasOfSets areas_of_sets(const ShadowResult& result) {
  AreasOfSets areas;
  for (const CombinedFragment& fragment : result.combined) {
    const auto* points = result.combined_exact_points.data() + fragment.first;
    Area own;
    squared_area({points, points + fragment.count}, own);
    Area& sum = areas[{fragment.part, fragment.side, fragment.lit_by, fragment.penumbra_of}];
    for (std::size_t k = 0; k < 3; ++k) sum[k] += own[k];
  }
  return areas;
}

std::string text_of(const AreasOfSets& areas) {
  std::string text;
  for (const auto& [key, area] : areas) {
    const auto& [part, side, lit_by, penumbra_of] = key;
    text += std::to_string(part) + (side == Side::kFront ? " front" : " back") + " lit by " +
            std::to_string(lit_by) + " penumbra of " + std::to_string(penumbra_of);
    for (const mpq_class& component : area) text += " " + component.get_str();
    text += "\n";
  }
  return text;
}

ShadowOptions together(MethodId algorithm, KernelId kernel) {
  ShadowOptions options = options_of(algorithm, kernel);
  options.output.combined = true;
  options.output.exact_points = true;
  return options;
}

void compare_together(Scene (*make)(std::uint64_t), unsigned scenes, unsigned least_mixed) {
  unsigned mixed = 0;
  for (std::uint64_t seed = 0; seed < scenes; ++seed) {
    const auto prepared = prepare(with_more_lights(make(seed), seed));
    if (!prepared) continue;
    const auto expected =
        compute_shadows(*prepared, together(MethodId::kReceiver, KernelId::kPlane)).value();
    const AreasOfSets areas = areas_of_sets(expected);
    for (const auto& entry : areas) {
      const auto [lit_by, penumbra_of] =
          std::pair(std::get<2>(entry.first), std::get<3>(entry.first));
      if ((lit_by & 3) != 0 && (penumbra_of & 3) != 0) ++mixed;
    }
    for (const KernelId kernel : {KernelId::kPlane, KernelId::kRational, KernelId::kEpeck}) {
      if (kernel != KernelId::kPlane && seed % 10 != 0) continue;
      ShadowOptions options = together(MethodId::kMerged, kernel);
      for (const bool plain : {false, true}) {
        options.method.prefix = options.output.merge = !plain;
        const auto merged = compute_shadows(*prepared, options).value();
        EXPECT_EQ(text_of(areas_of_sets(merged)), text_of(areas))
            << kernel_info(kernel).name << (plain ? ", no prefix, no merging" : "") << ", seed "
            << seed;
      }
    }
  }
  // Fragments that one area light reaches while another is partly hidden.
  EXPECT_GT(mixed, least_mixed);
}

TEST(MergedTogether, EqualsReceiverOnSoups) { compare_together(soup, 60, 60); }
TEST(MergedTogether, EqualsReceiverOnBoxes) { compare_together(boxes, 40, 60); }
TEST(MergedTogether, EqualsReceiverOnStandingWalls) { compare_together(standing, 40, 60); }

/// The rule that this breaks is the trees' alone: its mistake shows only where fragments come from
/// them.
TEST(MergedTogether, ComesFromTheTrees) {
  Scene scene = figure_6();
  scene.lights.push_back(scene.lights[0]);
  scene.lights[1].id = "second";
  for (Position& position : scene.lights[1].loop) position[2] = Number(21.0);
  const auto prepared = prepare(scene).value();
  Rules wrong;
  wrong.volumes_continue_behind_others = false;
  const ShadowOptions merged = together(MethodId::kMerged, KernelId::kPlane);
  const ShadowOptions receiver = together(MethodId::kReceiver, KernelId::kPlane);
  const std::string expected =
      text_of(areas_of_sets(compute_with(prepared, receiver, Rules{}).value()));
  EXPECT_EQ(text_of(areas_of_sets(compute_with(prepared, merged, Rules{}).value())), expected);
  EXPECT_NE(text_of(areas_of_sets(compute_with(prepared, merged, wrong).value())), expected);
  EXPECT_EQ(text_of(areas_of_sets(compute_with(prepared, receiver, wrong).value())), expected);
}

TEST(MergedTogether, DoesNotDependOnThreadsAndStopsAtLimits) {
  const auto scene = prepare(with_more_lights(boxes(3), 3)).value();
  ShadowOptions options = together(MethodId::kMerged, KernelId::kPlane);
  const auto one = compute_shadows(scene, options).value();
  options.tuning.jobs = 2;
  double last = 0;
  options.control.progress = [&](double done) {
    EXPECT_GE(done, last);
    EXPECT_LE(done, 1);
    last = done;
  };
  const auto two = compute_shadows(scene, options).value();
  EXPECT_EQ(one.combined_exact_points, two.combined_exact_points);
  EXPECT_EQ(text_of(areas_of_sets(one)), text_of(areas_of_sets(two)));
  options.control.progress = {};
  options.limits.fragments = 1;
  EXPECT_EQ(compute_shadows(scene, options).error().code, ErrorCode::kLimit);
  const std::atomic<bool> interrupted = true;
  options.limits.fragments = 1000000;
  options.control.interrupted = &interrupted;
  EXPECT_EQ(compute_shadows(scene, options).error().code, ErrorCode::kInterrupted);
}

/// A part of a polygon that is all behind the light is told beside parts that the light sees.
TEST(MergedTogether, TellsPartsBehindALight) {
  const auto scene = Case::make(regression_scene("y_part_behind_the_panel"));
  for (const KernelId kernel : {KernelId::kPlane, KernelId::kRational, KernelId::kEpeck}) {
    for (const MethodId method : {MethodId::kReceiver, MethodId::kMerged}) {
      const auto result = compute_shadows(scene->prepared(), together(method, kernel)).value();
      EXPECT_EQ(judge(*scene, result).verdict, oracle::Verdict::kIdentical)
          << kernel_info(kernel).name;
    }
  }
}

/// Rounded kernels come to an end, with fragments for every side that the receivers' way has.
TEST(MergedTogether, RoundedKernelsComeToAnEnd) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto scene = prepare(with_more_lights(seed % 2 == 0 ? soup(seed) : boxes(seed), seed));
    if (!scene) continue;
    for (const KernelId kernel :
         {KernelId::kFloat, KernelId::kDouble, KernelId::kLongDouble, KernelId::kEpick}) {
      ShadowOptions options = together(MethodId::kMerged, kernel);
      options.output.exact_fractions = false;
      options.limits.fragments = 100000;
      const auto result = compute_shadows(*scene, options);
      if (!result) {
        EXPECT_EQ(result.error().code, ErrorCode::kLimit);
        continue;
      }
      EXPECT_EQ(result->combined.empty(),
                compute_shadows(*scene, together(MethodId::kReceiver, KernelId::kPlane))
                    ->combined.empty());
    }
  }
}

// --- Pieces: the light cut first, as in 1992 ---

TEST(Pieces, OfALightThatNothingCutsIsTheLight) {
  const auto scene = prepare(figure_6()).value();
  ShadowOptions options = options_of(MethodId::kPieces, KernelId::kPlane);
  const auto result = compute_shadows(scene, options).value();
  ASSERT_EQ(result.lights.size(), 1u);
  EXPECT_EQ(result.lights[0].piece, 0u);
  EXPECT_EQ(text_of(result.lights[0]),
            text_of(scene, options_of(MethodId::kReceiver, KernelId::kPlane)));
}

/// Every piece as a light of its own, for the receiver algorithm.
TEST(Pieces, AreLights) {
  unsigned pieces = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Scene scene = boxes(seed);
    const auto prepared = prepare(scene);
    if (!prepared) continue;
    ShadowOptions options = options_of(MethodId::kPieces, KernelId::kPlane);
    options.output.exact_points = true;
    const auto result = compute_shadows(*prepared, options).value();
    EXPECT_EQ(result.algorithm, "pieces");
    for (std::uint32_t i = 0; i < result.lights.size(); ++i) {
      ++pieces;
      const LightResult& light = result.lights[i];
      EXPECT_EQ(light.piece, i);
      Scene alone = scene;
      alone.lights[0].loop.clear();
      for (const auto& point : light.piece_loop) {
        Position position;
        for (std::size_t k = 0; k < 3; ++k) {
          ASSERT_EQ(point[k].get_den(), 1);  // planes of boxes cut at whole numbers
          position[k] = Number(point[k].get_d());
        }
        alone.lights[0].loop.push_back(position);
      }
      const auto prepared_alone = prepare(alone).value();
      EXPECT_EQ(text_of(light),
                text_of(prepared_alone, options_of(MethodId::kReceiver, KernelId::kPlane)))
          << "seed " << seed << " piece " << i;
    }
  }
  EXPECT_GT(pieces, 100u);
}

TEST(Pieces, TileTheLightAndRationalAgrees) {
  unsigned pieces = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Scene scene = soup(seed);
    const auto prepared = prepare(scene);
    if (!prepared) continue;
    ShadowOptions options = options_of(MethodId::kPieces, KernelId::kPlane);
    options.output.exact_points = true;
    const auto result = compute_shadows(*prepared, options).value();
    std::vector<std::array<mpq_class, 3>> whole;
    for (const Position& p : scene.lights[0].loop) {
      whole.push_back({p[0].exact(), p[1].exact(), p[2].exact()});
    }
    std::array<mpq_class, 3> total, sum{0, 0, 0}, normal;
    squared_area(whole, total);
    for (const LightResult& light : result.lights) {
      EXPECT_GT(squared_area(light.piece_loop, normal), 0);
      for (std::size_t k = 0; k < 3; ++k) sum[k] += normal[k];
    }
    EXPECT_EQ(sum, total);
    pieces += static_cast<unsigned>(result.lights.size());
    if (seed % 8 != 0) continue;
    options.kernel.id = KernelId::kRational;
    const auto rational = compute_shadows(*prepared, options).value();
    ASSERT_EQ(rational.lights.size(), result.lights.size());
    for (std::size_t i = 0; i < result.lights.size(); ++i) {
      EXPECT_EQ(text_of(rational.lights[i]), text_of(result.lights[i])) << seed;
    }
  }
  EXPECT_GT(pieces, 200u);
}

}  // namespace
}  // namespace gnomon::test
