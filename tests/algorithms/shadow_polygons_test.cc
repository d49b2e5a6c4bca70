// SPDX-License-Identifier: GPL-3.0-or-later
// Walls counted along rays: the counts against the casters between a point and the light, found by
// rationals without a wall; all samples, those on borders too, against zbuffer; every option that
// may not change an answer; and where counts of graphics hardware go wrong.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "algorithms/run/compute_pixels.h"
#include "algorithms/shadow_polygons/shadow_walls.h"
#include "exact_space.h"
#include "fuzz/check/seven_eyes.h"
#include "fuzz/generate/generator.h"
#include "fuzz/generate/scene_pen.h"
#include "gnomon/algorithms/pixels.h"
#include "gnomon/scene/camera.h"
#include "gnomon/scene/generate.h"

namespace gnomon {
namespace {

using fuzz::ScenePen;
using test::Rational3;

constexpr std::array kExactKernels = {KernelId::kPlane, KernelId::kRational, KernelId::kEpeck};

PixelOptions options_of(const std::string& method, KernelId kernel = KernelId::kPlane) {
  const MethodSelection selection = parse_method(method, Domain::kImageSpace).value();
  PixelOptions options;
  options.kernel.id = kernel;
  options.method = selection.id;
  options.options = selection.values;
  options.caster_counts = true;
  options.jobs = 1;
  return options;
}

Pixels pixels_of(const PreparedView& view, const std::string& method,
                 KernelId kernel = KernelId::kPlane) {
  return compute_pixels(view.scene, view.frame, options_of(method, kernel)).value();
}

std::string difference(const Pixels& a, const Pixels& b) {
  for (std::size_t i = 0; i < a.part.size(); ++i) {
    const std::string place =
        " at (" + std::to_string(i % a.width) + ", " + std::to_string(i / a.width) + ")";
    if (a.part[i] != b.part[i]) return "another part" + place;
    if (a.lit_by[i] != b.lit_by[i]) return "another light" + place;
  }
  return {};
}

/// Parts and casters at a sample by the definition. Nothing is told of samples on borders.
class ByDefinition {
 public:
  ByDefinition(const PreparedView& view, const LightPoint& light)
      : scene_(view.scene), frame_(view.frame), light_(light) {
    for (std::uint32_t p = 0; p < scene_.parts.size(); ++p) {
      loops_.push_back(test::grid_loop(scene_, p));
      planes_.push_back(test::plane_of(loops_.back()));
    }
    for (std::size_t k = 0; k < 3; ++k) eye_[k] = frame_.eye.grid[k];
  }

  /// Null where a border is met; else casters before what is seen, -1 where the side that is seen
  /// does not face the light, -2 where nothing is.
  std::optional<int> casters(ImageSample sample) const {
    const ImageFrame::Direction d = frame_.direction(sample);
    const Rational3 along{mpq_class(d[0]), mpq_class(d[1]), mpq_class(d[2])};
    mpq_class nearest;
    std::optional<std::uint32_t> seen;
    for (std::uint32_t p = 0; p < planes_.size(); ++p) {
      const mpq_class at_eye = planes_[p].value(eye_);
      if (at_eye == 0) continue;
      if (at_eye < 0 && !scene_.parts[p].two_sided) continue;
      const mpq_class slope = test::dot_product(planes_[p].normal, along);
      if (sgn(slope) * sgn(at_eye) >= 0) continue;
      const mpq_class t = -at_eye / slope;
      const int inside = inside_of(p, at(along, t));
      if (inside == 0) return std::nullopt;
      if (inside < 0) continue;
      if (seen && t == nearest) {
        if (scene_.parts[p].plane != scene_.parts[*seen].plane) return std::nullopt;
        continue;
      }
      if (!seen || t < nearest) {
        nearest = t;
        seen = p;
      }
    }
    if (!seen) return -2;
    return before(*seen, at(along, nearest));
  }

 private:
  Rational3 at(const Rational3& along, const mpq_class& t) const {
    Rational3 point;
    for (std::size_t k = 0; k < 3; ++k) point[k] = eye_[k] + t * along[k];
    return point;
  }
  int inside_of(std::uint32_t part, const Rational3& point) const {
    int inside = 1;
    const test::RationalLoop& loop = loops_[part];
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Rational3 inward = test::cross_product(
          planes_[part].normal, test::difference(loop[(k + 1) % loop.size()], loop[k]));
      inside = std::min(inside, sgn(test::dot_product(inward, test::difference(point, loop[k]))));
    }
    return inside;
  }
  std::optional<int> before(std::uint32_t seen, const Rational3& x) const {
    const test::RationalLight light(light_);
    const int eye_side = sgn(planes_[seen].value(eye_));
    if (light.side_of(planes_[seen]) != eye_side) return -1;
    int count = 0;
    for (std::uint32_t p = 0; p < planes_.size(); ++p) {
      const int side = light.side_of(planes_[p]);
      if (!scene_.parts[p].casts || side == 0 || (side < 0 && !scene_.parts[p].two_sided) ||
          scene_.parts[p].plane == scene_.parts[seen].plane) {
        continue;
      }
      int inside = -side * sgn(planes_[p].value(x));
      const test::RationalLoop& loop = loops_[p];
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const Rational3& from = loop[k];
        // Counter-clockwise seen from the light, the inside is behind this product.
        const auto wall = test::RationalPlane::through(
            test::cross_product(test::difference(loop[(k + 1) % loop.size()], from),
                                light.from(from)),
            from);
        inside = std::min(inside, -side * sgn(wall.value(x)));
      }
      if (inside == 0) return std::nullopt;
      count += inside > 0 ? 1 : 0;
    }
    return count;
  }

  const PreparedScene& scene_;
  const ImageFrame& frame_;
  const LightPoint& light_;
  std::vector<test::RationalLoop> loops_;
  std::vector<test::RationalPlane> planes_;
  Rational3 eye_;
};

/// The first sample, off borders, whose count is not the definition's.
std::string wrong_count(const PreparedView& view, const Pixels& pixels, std::size_t* judged) {
  const std::size_t samples = pixels.part.size();
  for (std::size_t l = 0; l < pixels.lights.size(); ++l) {
    const ByDefinition definition(view, view.scene.lights[pixels.lights[l]].point);
    for (std::uint32_t j = 0; j < pixels.height; ++j) {
      for (std::uint32_t i = 0; i < pixels.width; ++i) {
        const std::optional<int> casters = definition.casters({i, j});
        if (!casters) continue;
        ++*judged;
        const std::size_t at = pixels.index({i, j});
        const bool is_lit = (pixels.lit_by[at] >> l & 1) != 0;
        if (is_lit == (*casters == 0) &&
            pixels.casters[l * samples + at] == std::max(*casters, 0)) {
          continue;
        }
        return "light " + std::to_string(l) + ", sample (" + std::to_string(i) + ", " +
               std::to_string(j) + "): " + std::to_string(pixels.casters[l * samples + at]) +
               " casters, not " + std::to_string(*casters);
      }
    }
  }
  return {};
}

/// Of every family and some soups a few scenes with point and directional lights.
std::vector<Scene> scenes(std::uint64_t seeds) {
  std::vector<Scene> result;
  for (const std::string& name : fuzz::generator_names()) {
    if (name.starts_with("area")) continue;
    const fuzz::Generator generator = fuzz::Generator::parse(name).value();
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      Scene scene = generator.make(seed).scene;
      std::erase_if(scene.lights, [](const Light& light) { return light.has_area(); });
      if (!scene.lights.empty()) result.push_back(std::move(scene));
    }
  }
  return result;
}

template <class Use>
void for_each_view(const Scene& scene, std::uint32_t size, std::uint32_t pick, const Use& use) {
  const PreparedScene prepared = prepare(scene).value();
  for (const fuzz::NamedEye& eye : fuzz::seven_eyes(prepared, size, pick)) {
    const auto view = prepare_view(scene, eye.camera);
    ASSERT_TRUE(view) << view.error().what;
    use(*view, eye.name);
  }
}

TEST(ShadowPolygons, CountsTheCastersBetweenPointAndLight) {
  std::size_t judged = 0;
  std::uint32_t pick = 0;
  for (const Scene& scene : scenes(1)) {
    for_each_view(scene, 14, ++pick, [&](const PreparedView& view, const std::string& eye) {
      EXPECT_EQ(wrong_count(view, pixels_of(view, "shadow-polygons"), &judged), "")
          << scene.name << ", " << eye;
    });
  }
  EXPECT_GT(judged, 30'000u);
}

TEST(ShadowPolygons, HasTheSamplesOfZbufferFromSevenEyesOnEveryFamily) {
  std::uint32_t pick = 1;
  for (const Scene& scene : scenes(1)) {
    for_each_view(scene, 64, ++pick, [&](const PreparedView& view, const std::string& eye) {
      const Pixels reference = pixels_of(view, "zbuffer");
      for (const KernelId kernel : kExactKernels) {
        EXPECT_EQ(difference(reference, pixels_of(view, "shadow-polygons", kernel)), "")
            << scene.name << ", " << eye << ", " << kernel_info(kernel).name;
      }
      for (const KernelId kernel : {KernelId::kFloat, KernelId::kDouble, KernelId::kEpick}) {
        EXPECT_EQ(pixels_of(view, "shadow-polygons", kernel).part.size(), reference.part.size());
      }
    });
  }
}

TEST(ShadowPolygons, OptionsChangeNoCount) {
  std::uint32_t pick = 2;
  for (const Scene& scene : scenes(1)) {
    for_each_view(scene, 24, ++pick, [&](const PreparedView& view, const std::string& eye) {
      const Pixels reference = pixels_of(view, "shadow-polygons");
      for (const char* options : {":volumes=polygons", ":count=z-fail", ":neighbours=on",
                                  ":order=file", ":count=z-fail,volumes=polygons"}) {
        const Pixels other = pixels_of(view, std::string("shadow-polygons") + options);
        EXPECT_EQ(difference(reference, other), "") << scene.name << ", " << eye << options;
        EXPECT_EQ(reference.casters, other.casters) << scene.name << ", " << eye << options;
      }
    });
  }
}

TEST(ShadowPolygons, OptionsAreReadAndTold) {
  for (const std::string text :
       {"shadow-polygons", "shadow-polygons:volumes=polygons,count=z-pass,near=0.25",
        "shadow-polygons:count=z-fail,far=40", "shadow-polygons:neighbours=on,order=far"}) {
    const auto selection = parse_method(text, Domain::kImageSpace);
    ASSERT_TRUE(selection) << text;
    EXPECT_EQ(method_text(selection->id, selection->values), text);
  }
  for (const char* text :
       {"count=both", "near=-1", "near=nan", "far=1e16", "far=x", "volumes=on"}) {
    EXPECT_FALSE(parse_method("shadow-polygons:" + std::string(text), Domain::kImageSpace)) << text;
  }
}

// --- By hand ---

PreparedView view_of(const Scene& scene, const std::array<double, 3>& eye,
                     const std::array<double, 3>& look_at, std::uint32_t size = 48) {
  CameraView view;
  view.eye = eye;
  view.look_at = look_at;
  view.field_of_view = 75;
  view.width = view.height = size;
  const auto camera = make_camera({Number(eye[0]), Number(eye[1]), Number(eye[2])}, view);
  return prepare_view(scene, camera.value()).value();
}

/// Two boards over each other, a wall and the ground, under a lamp.
Scene awnings() {
  return ScenePen()
      .two_sided(true)
      .polygon({{0, 0, 0}, {12, 0, 0}, {12, 10, 0}, {0, 10, 0}})
      .polygon({{3, 3, 4}, {7, 3, 4}, {7, 7, 4}, {3, 7, 4}})
      .polygon({{6, 6, 3}, {9, 6, 3}, {9, 9, 3}, {6, 9, 3}})
      .polygon({{10, 2, 0}, {10, 8, 0}, {10, 8, 3}, {10, 2, 3}})
      .lamp({5, 5, 10})
      .take();
}

std::size_t wrong_samples(const PreparedView& view, const std::string& options,
                          const Rules& rules = {}) {
  const Pixels reference = pixels_of(view, "zbuffer");
  const Pixels pixels =
      compute_pixels_with(view.scene, view.frame, options_of("shadow-polygons" + options), rules)
          .value();
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < pixels.part.size(); ++i) {
    wrong += pixels.lit_by[i] != reference.lit_by[i] ? 1 : 0;
  }
  return wrong;
}

TEST(ShadowPolygons, ZPassIsWrongIfTheEyeIsInShadowAndZFailIsNot) {
  const PreparedView view = view_of(awnings(), {5, 5, 1}, {10, 5, 1});
  EXPECT_EQ(wrong_samples(view, ""), 0u);
  EXPECT_GT(wrong_samples(view, ":count=z-pass"), 100u);
  EXPECT_EQ(wrong_samples(view, ":count=z-fail"), 0u);
}

TEST(ShadowPolygons, ZPassIsWrongIfTheNearPlaneIsInShadow) {
  const PreparedView view = view_of(awnings(), {1, 5, 1.5}, {10, 5, 1});
  EXPECT_EQ(wrong_samples(view, ":count=z-pass"), 0u);
  EXPECT_EQ(wrong_samples(view, ":count=z-pass,near=0.25"), 0u);
  EXPECT_GT(wrong_samples(view, ":count=z-pass,near=2"), 100u);
}

TEST(ShadowPolygons, ZFailIsWrongIfTheFarPlaneIsInShadow) {
  const PreparedView view = view_of(awnings(), {-4, 5, 3}, {10, 5, 0.5});
  EXPECT_EQ(wrong_samples(view, ":count=z-fail"), 0u);
  EXPECT_EQ(wrong_samples(view, ":count=z-fail,far=1000"), 0u);
  EXPECT_GT(wrong_samples(view, ":count=z-fail,far=12"), 50u);
}

TEST(ShadowPolygons, EveryRuleMatters) {
  // Under both boards, on the wall of one, and where walls cross.
  const PreparedView in_two = view_of(awnings(), {6.5, 6.5, 1}, {10, 3, 1});
  const PreparedView on_wall = view_of(awnings(), {5, 8, 1}, {10, 5, 0.5});
  Rules rules;
  rules.eye_may_be_in_shadow = false;
  EXPECT_GT(wrong_samples(in_two, "", rules), 0u);
  rules = {};
  rules.eye_in_several_volumes_counts_all = false;
  EXPECT_GT(wrong_samples(in_two, "", rules), 0u);
  rules = {};
  rules.eye_on_planes_counts_by_sample = false;
  EXPECT_GT(wrong_samples(on_wall, "", rules), 0u);
  EXPECT_EQ(wrong_samples(on_wall, ""), 0u);
  rules = {};
  rules.light_looks_all_around = false;
  // The lamp looks at the middle of the scene, aside; one end of the board is behind it.
  const Scene aside = ScenePen()
                          .two_sided(true)
                          .polygon({{-9, -9, 0}, {30, -9, 0}, {30, 9, 0}, {-9, 9, 0}})
                          .polygon({{-2, -1, 3}, {2, -1, 3}, {2, 1, 3}, {-2, 1, 3}})
                          .polygon({{25, -1, 0}, {25, 1, 0}, {25, 1, 2}, {25, -1, 2}})
                          .lamp({0, 0, 5})
                          .take();
  EXPECT_GT(wrong_samples(view_of(aside, {-8, -7, 6}, {0, 0, 0}), "", rules), 0u);
}

TEST(ShadowPolygons, WallsOfOneLightMeet) {
  // The wall of x = 1 and that of y = 0 have (9/5, 0, 1) in common.
  const Scene scene = ScenePen()
                          .two_sided(true)
                          .polygon({{-1, -1, 5}, {1, -1, 5}, {1, 1, 5}, {-1, 1, 5}})
                          .polygon({{0, 0, 4}, {2, 0, 4}, {2, 2, 4}, {0, 2, 4}})
                          .polygon({{-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}})
                          .lamp({0, 0, 10})
                          .take();
  std::uint64_t misses = 0;
  for (const std::array<double, 3>& eye :
       {std::array{6.0, -5.0, 2.0}, {6.0, 5.0, 3.0}, {-5.0, 3.0, 1.0}, {-4.0, -7.0, 2.5}}) {
    const PreparedView view = view_of(scene, eye, {1, 0, 0}, 96);
    EXPECT_EQ(wrong_samples(view, ":neighbours=on"), 0u);
    const Pixels pixels = pixels_of(view, "shadow-polygons:neighbours=on");
    misses += pixels.work[Counter::kNeighbourMisses];
    Rules rules;
    rules.order_of_walls_is_verified = false;
    const Pixels trusted =
        compute_pixels_with(view.scene, view.frame, options_of("shadow-polygons"), rules).value();
    EXPECT_EQ(trusted.casters != pixels.casters, pixels.work[Counter::kNeighbourMisses] > 0);
  }
  EXPECT_GT(misses, 0u);
}

TEST(ShadowPolygons, EyeAtTheLampSeesNoWall) {
  const PreparedView view = view_of(awnings(), {5, 5, 10}, {5, 5, 0});
  const Pixels pixels = pixels_of(view, "shadow-polygons");
  EXPECT_EQ(pixels.work[Counter::kWalls], 0u);
  EXPECT_EQ(wrong_samples(view, ""), 0u);
}

TEST(ShadowPolygons, CountsWallsAndTheirSamples) {
  const Scene box = ScenePen().box({0, 0, 1}, {2, 2, 3}).sun({1, 2, 3}).take();
  const PreparedView view = view_of(box, {-6, -5, 4}, {1, 1, 1});
  const Pixels chain = pixels_of(view, "shadow-polygons");
  const Pixels polygons = pixels_of(view, "shadow-polygons:volumes=polygons");
  EXPECT_EQ(chain.work[Counter::kWalls], 6u);
  EXPECT_EQ(polygons.work[Counter::kWalls], 12u);
  EXPECT_LE(chain.work[Counter::kActiveWalls], 6u);
  EXPECT_LT(chain.work[Counter::kWallSamples], polygons.work[Counter::kWallSamples]);
  EXPECT_EQ(chain.work[Counter::kNeighbourTests], 0u);
  // The same on any number of threads.
  PixelOptions options = options_of("shadow-polygons:neighbours=on");
  const Pixels one = compute_pixels(view.scene, view.frame, options).value();
  options.jobs = 3;
  const Pixels three = compute_pixels(view.scene, view.frame, options).value();
  EXPECT_EQ(one.work, three.work);
  EXPECT_EQ(difference(one, three), "");
}

TEST(ShadowWalls, HaveMultiplicityOnTwoSidedMeshes) {
  const PreparedScene scene =
      prepare(ScenePen().two_sided(true).box({0, 0, 0}, {1, 1, 1}).sun({1, 2, 3}).take()).value();
  std::vector<Side> facing;
  const test::RationalLight sun(scene.lights[0].point);
  for (std::uint32_t p = 0; p < scene.parts.size(); ++p) {
    facing.push_back(static_cast<Side>(sun.side_of(test::plane_of(test::grid_loop(scene, p)))));
  }
  const auto walls = shadow_walls(scene, facing, VolumesOf::kChain);
  EXPECT_EQ(walls.size(), 6u);
  EXPECT_TRUE(std::ranges::all_of(walls, [](const auto& w) { return w.multiplicity == 2; }));
  EXPECT_EQ(shadow_walls(scene, facing, VolumesOf::kPolygons).size(), 24u);
}

}  // namespace
}  // namespace gnomon
