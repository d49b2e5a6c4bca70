// SPDX-License-Identifier: GPL-3.0-or-later
// Covers by overlay: shadow polygons over a whole polygon, lit details on a dark one, and several
// lights as shadows painted on shadows. The judges find the exact answer in them, and how many
// there are is worked out by hand.
#include <gtest/gtest.h>

#include <bit>
#include <set>
#include <string>
#include <vector>

#include "gnomon/algorithms/method_options.h"
#include "gnomon/algorithms/shadows.h"
#include "gnomon/oracle/witness_check.h"
#include "gnomon/scene/generate.h"
#include "gnomon/scene/read.h"
#include "tests/support/solve.h"

namespace gnomon::test {
namespace {

/// A quad above a floor, and the first so many of four suns whose shadows on the floor all overlap
/// and none of which holds another.
Scene suns_over_quad(std::size_t suns) {
  const std::vector<std::string> directions = {"[0, 0, 1]", "[0.25, 0, 1]", "[0.125, 0.25, 1]",
                                               "[0, 0.125, 1]"};
  std::string lights;
  for (std::size_t i = 0; i < suns; ++i) {
    lights += (i == 0 ? "" : ", ") + std::string(R"({"id": "sun)") + std::to_string(i) +
              R"(", "type": "directional", "to_light": )" + directions[i] + "}";
  }
  return parse_scene(R"({"format": "gnomon-scene", "version": 1, "two_sided": true,
    "vertices": [[-8,-8,0], [8,-8,0], [8,8,0], [-8,8,0], [-1,-1,2], [1,-1,2], [1,1,2], [-1,1,2]],
    "polygons": [{"id": "floor", "loop": [0,1,2,3]}, {"id": "quad", "loop": [4,5,6,7]}],
    "lights": [)" + lights +
                         "]}",
                     "suns.json")
      .value()
      .scene;
}

ShadowOptions options_of(const std::string& method, KernelId kernel = KernelId::kPlane) {
  ShadowOptions options = options_for(kernel);
  const MethodSelection selection = parse_method(method).value();
  options.method.point = selection.id;
  options.method.options = selection.values;
  return options;
}

// Of k lights every set but the empty one is dark somewhere on the floor; a polygon with l lights
// was cut from one with the l - 1 lights before its last.
TEST(PaintedShadows, OneGeneratorAndSeveralLightsPaintEverySetOnce) {
  for (const std::string method : {"basic:cover=overlay", "tiling:tiles=4,cover=overlay"}) {
    for (std::size_t suns = 1; suns <= 4; ++suns) {
      SCOPED_TRACE(method + ", suns: " + std::to_string(suns));
      const auto scene = Case::make(suns_over_quad(suns));
      ShadowOptions options = options_of(method);
      options.output.combined = true;
      const ShadowResult result = compute_shadows(scene->prepared(), options).value();
      EXPECT_TRUE(result.combined.empty());
      ASSERT_EQ(result.overlay.size(), (std::size_t{1} << suns) - 1);
      std::set<std::uint64_t> sets;
      for (const PaintedPolygon& painted : result.overlay) {
        sets.insert(painted.dark_for);
        EXPECT_EQ(painted.part, 0u);
        EXPECT_EQ(painted.level, static_cast<std::uint32_t>(std::popcount(painted.dark_for)));
        std::uint64_t owner = 0;
        if (painted.level > 1) {
          ASSERT_LT(painted.on, result.overlay.size());
          owner = result.overlay[painted.on].dark_for;
        } else {
          EXPECT_EQ(painted.on, PaintedPolygon::kNoOwner);
        }
        EXPECT_EQ(painted.dark_for, owner | std::bit_floor(painted.dark_for));
      }
      EXPECT_EQ(sets.size(), result.overlay.size());
      EXPECT_EQ(judge(*scene, result).verdict, oracle::Verdict::kIdentical);
    }
  }
}

constexpr std::size_t kSmall = 12;  // polygons

/// Slow kernels are asked about small scenes.
bool is_asked(KernelId kernel, const Scene& scene) {
  return has_kernel(kernel) && (kernel == KernelId::kPlane || scene.polygons.size() <= kSmall);
}

/// Scenes with several point lights and suns, some of them degenerate.
std::vector<Scene> scenes_of_several_lights() {
  std::vector<Scene> scenes;
  for (const std::string name : {"solids", "slanted-through"}) {
    scenes.push_back(gnomon::generate(name, {}, 1).value());
  }
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    scenes.push_back(gnomon::generate("lattice", {{"light", 2}}, seed).value());
  }
  return scenes;
}

// At every point the highest painted loop has exactly the lights that do not reach it; a light that
// is taken out of one set is noticed.
TEST(PaintedShadows, AreTheExactAnswerOfEveryLight) {
  std::size_t painted = 0, changed = 0;
  for (const Scene& scene : scenes_of_several_lights()) {
    const auto made = Case::make(scene);
    ASSERT_TRUE(made);
    for (const std::string method :
         {"basic:cover=overlay", "tiling:tiles=4,cover=overlay", "basic:cover=overlay,prune=off"}) {
      for (const KernelId kernel : {KernelId::kPlane, KernelId::kRational, KernelId::kEpeck}) {
        if (!is_asked(kernel, scene)) continue;
        SCOPED_TRACE(scene.name + ", " + method + ", " + std::string(kernel_info(kernel).name));
        ShadowOptions options = options_of(method, kernel);
        options.output.combined = true;
        auto computed = compute_shadows(made->prepared(), options);
        ASSERT_TRUE(computed) << to_string(computed.error());
        ShadowResult result = std::move(*computed);
        const oracle::Report report = judge(*made, result);
        EXPECT_EQ(report.verdict, oracle::Verdict::kIdentical) << report.reason;
        const Claims claims = claims_of(*made, result);
        EXPECT_EQ(oracle::check_witnesses(scene, made->prepared(), claims).violations, 0u);
        painted += result.overlay.size();
        if (kernel != KernelId::kPlane || result.overlay.empty()) continue;
        // The last one has the highest level of its side: nothing hides it.
        result.overlay.back().dark_for &= result.overlay.back().dark_for - 1;
        if (result.overlay.back().dark_for == 0) continue;
        ++changed;
        EXPECT_EQ(judge(*made, result).verdict, oracle::Verdict::kFailed);
      }
    }
  }
  EXPECT_GT(painted, 100u);
  EXPECT_GT(changed, 0u);
}

// The sets of lights are the same whether shadows are painted over each other or cut apart.
TEST(PaintedShadows, PartitionsOfSeveralLightsAreExact) {
  for (const Scene& scene : scenes_of_several_lights()) {
    const auto made = Case::make(scene);
    for (const std::string method : {"svbsp", "basic", "tiling:tiles=4"}) {
      for (const KernelId kernel : {KernelId::kPlane, KernelId::kRational, KernelId::kEpeck}) {
        if (!is_asked(kernel, scene)) continue;
        SCOPED_TRACE(scene.name + ", " + method + ", " + std::string(kernel_info(kernel).name));
        ShadowOptions options = options_of(method, kernel);
        options.output.combined = true;
        const ShadowResult result = compute_shadows(made->prepared(), options).value();
        EXPECT_FALSE(result.combined.empty());
        EXPECT_EQ(judge(*made, result).verdict, oracle::Verdict::kIdentical);
      }
    }
  }
}

TEST(Overlays, OfOneLightAreTheExactAnswer) {
  for (const Scene& scene : scenes_of_several_lights()) {
    const auto made = Case::make(scene);
    for (const std::string method :
         {"basic:cover=overlay", "tiling:cover=overlay", "tiling:tiles=3,cover=overlay",
          "two-pass:cover=overlay", "two-pass:cells=off,cover=overlay"}) {
      for (const KernelId kernel : {KernelId::kPlane, KernelId::kRational, KernelId::kEpeck}) {
        if (!is_asked(kernel, scene)) continue;
        SCOPED_TRACE(scene.name + ", " + method + ", " + std::string(kernel_info(kernel).name));
        const ShadowResult result =
            compute_shadows(made->prepared(), options_of(method, kernel)).value();
        const oracle::Report report = judge(*made, result);
        EXPECT_EQ(report.verdict, oracle::Verdict::kIdentical) << report.reason;
        for (const LightResult& light : result.lights) {
          EXPECT_EQ(light.cover, Cover::kOverlay);
          EXPECT_EQ(light.background,
                    method.starts_with("two-pass") ? LightState::kShadow : LightState::kLit);
        }
      }
    }
  }
}

TEST(Overlays, AreNotOfAreaLights) {
  Scene scene = suns_over_quad(1);
  const Scene panel = gnomon::generate("panel-contacts", {}, 1).value();
  scene.lights.push_back(panel.lights.front());
  const auto made = Case::make(scene);
  ShadowOptions options = options_of("basic:cover=overlay");
  options.output.combined = true;
  const auto result = compute_shadows(made->prepared(), options);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kUsage);
}

TEST(MethodOptions, AreReadAndWritten) {
  for (const std::string text :
       {"basic", "basic:cover=overlay", "tiling:tiles=64,cover=overlay", "tiling:tiles=1,prune=off",
        "svbsp-full:order=file", "two-pass:cells=off", "sectors"}) {
    const auto selection = parse_method(text);
    ASSERT_TRUE(selection) << text;
    EXPECT_EQ(method_text(selection->id, selection->values), text);
  }
  EXPECT_EQ(parse_method("tiling:tiles=128,cover=partition")->values, MethodOptionValues{});
  const auto message = [](const std::string& text) {
    const auto selection = parse_method(text);
    return selection ? "" : to_string(selection.error());
  };
  EXPECT_EQ(message("tiles"), "tiles: no such algorithm; expected one of: " +
                                  method_names({.point = true, .area = true}));
  EXPECT_EQ(message("basic:tiles=4"),
            "basic:tiles=4: basic has no option 'tiles'; expected one of: cover, prune, roots");
  EXPECT_EQ(message("sectors:tiles=4"),
            "sectors:tiles=4: sectors has no option 'tiles'; expected one of: split");
  EXPECT_EQ(message("contour:tiles=4"),
            "contour:tiles=4: contour has no option 'tiles'; expected no options");
  for (const std::string value : {"0", "1025", "-1", "4x", "", "4294967297"}) {
    EXPECT_EQ(message("tiling:tiles=" + value),
              "tiling:tiles=" + value + ": '" + value + "' is no value of tiles; expected 1..1024");
  }
  EXPECT_EQ(message("tiling:"),
            "tiling:: an option is missing at its end; expected tiling:option=value,...");
  EXPECT_EQ(message("tiling:tiles=4,"),
            "tiling:tiles=4,: an option is missing at its end; expected tiling:option=value,...");
  EXPECT_EQ(message("basic:cover"),
            "basic:cover: '' is no value of cover; expected partition|overlay");
}

}  // namespace
}  // namespace gnomon::test
