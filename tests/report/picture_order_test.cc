// SPDX-License-Identifier: GPL-3.0-or-later
// What hides what in a picture, as `render` paints it: for each polygon a picture in which it alone
// is lit, so that the colour on top at a pixel tells whether that polygon is seen there. Held
// against the polygon that the pixel's ray meets first, found in rationals from the whole polygons.
// Pixels so near a border of what is painted that a seam may cover them are left out and counted.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "exact_space.h"
#include "fuzz/generate/families.h"
#include "fuzz/generate/soups.h"
#include "gnomon/algorithms/painters_order.h"
#include "gnomon/scene/generate.h"
#include "gnomon/scene/read.h"
#include "report/pictures/picture.h"
#include "report/pictures/view.h"
#include "report/text/text_sink.h"
#include "scene/base/random.h"

namespace gnomon::test {
namespace {

using report::PixelPoint;
using report::operator*;
using report::operator+;
using report::operator-;

struct PaintedPath {
  bool warm = false;  // lit, redder than blue; shadow and background are bluer
  std::vector<PixelPoint> loop;
};

/// The filled loops of a picture, in the order of painting.
std::vector<PaintedPath> painted_paths(const std::string& svg) {
  static const std::regex kPath("<path d=\"M([^Z\"]*)Z\" fill=\"#([0-9a-f]{6})\"");
  std::vector<PaintedPath> paths;
  for (std::sregex_iterator match(svg.begin(), svg.end(), kPath), end; match != end; ++match) {
    PaintedPath& path = paths.emplace_back();
    const std::string colour = (*match)[2], points = (*match)[1];
    path.warm =
        std::stoi(colour.substr(0, 2), nullptr, 16) > std::stoi(colour.substr(4, 2), nullptr, 16);
    const char* at = points.c_str();
    while (*at != '\0') {
      char* next = nullptr;
      const double x = std::strtod(at, &next);
      const double y = std::strtod(next, &next);
      path.loop.push_back({x, y});
      at = *next == 'L' ? next + 1 : next;
    }
  }
  return paths;
}

bool is_inside(const std::vector<PixelPoint>& loop, const PixelPoint& pixel) {
  bool left = false, right = false;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const PixelPoint& a = loop[i];
    const PixelPoint& b = loop[(i + 1) % loop.size()];
    const double turn = (b[0] - a[0]) * (pixel[1] - a[1]) - (b[1] - a[1]) * (pixel[0] - a[0]);
    left = left || turn > 0;
    right = right || turn < 0;
  }
  return left != right;
}

double distance_to_border(const std::vector<PixelPoint>& loop, const PixelPoint& pixel) {
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const PixelPoint& a = loop[i];
    const PixelPoint& b = loop[(i + 1) % loop.size()];
    const double dx = b[0] - a[0], dy = b[1] - a[1], square = dx * dx + dy * dy;
    const double t =
        square > 0
            ? std::clamp(((pixel[0] - a[0]) * dx + (pixel[1] - a[1]) * dy) / square, 0.0, 1.0)
            : 0.0;
    least = std::min(least, std::hypot(pixel[0] - a[0] - t * dx, pixel[1] - a[1] - t * dy));
  }
  return least;
}

struct PixelSample {
  PixelPoint pixel;
  std::optional<std::uint32_t> polygon;  // the first that its ray meets
};

struct Counts {
  std::uint64_t judged = 0, on_border = 0, wrong = 0, seen = 0;
};

class PicturesOfOne {
 public:
  PicturesOfOne(const Scene& scene, const PreparedScene& prepared, const report::Camera& camera,
                bool turned_round)
      : scene_(scene), prepared_(prepared), pieces_(back_to_front(prepared, camera.eye)) {
    if (turned_round) std::reverse(pieces_.begin(), pieces_.end());
    options_.camera = camera;
    options_.width = kWidth;
    options_.height = kHeight;
    options_.backs = true;
    options_.legend = false;
  }

  std::vector<PaintedPath> of(std::uint32_t polygon) const {
    ClaimedLight light;
    light.background = LightState::kShadow;
    for (const Side side : {Side::kFront, Side::kBack}) {
      ClaimedPolygon claimed;
      claimed.id = scene_.polygons[polygon].id;
      claimed.side = side;
      for (std::uint32_t part = prepared_.first_part[polygon];
           part < prepared_.first_part[polygon + 1]; ++part) {
        ClaimedFragment& fragment = claimed.fragments.emplace_back();
        for (const VertexId vertex : prepared_.loop(prepared_.parts[part])) {
          const auto& at = prepared_.geometry.positions[vertex];
          fragment.loop.push_back({mpq_class(at[0]), mpq_class(at[1]), mpq_class(at[2])});
        }
      }
      light.polygons.push_back(std::move(claimed));
    }
    report::Panel panel;
    panel.shown = &light;
    report::StringSink sink;
    paint_scene(scene_, prepared_, pieces_, {panel}, options_).write(sink);
    return painted_paths(sink.text());
  }

  static constexpr double kWidth = 320, kHeight = 240;

 private:
  const Scene& scene_;
  const PreparedScene& prepared_;
  std::vector<OrderedPiece> pieces_;
  report::PictureOptions options_;
};

/// Samples of pixels and what their rays meet, those that meet a border left out.
std::vector<PixelSample> make_samples(const PreparedScene& prepared, const report::Camera& camera,
                                      Random& random, Counts& counts) {
  constexpr double kTangent = 0.5;  // of half the field of view
  const auto [low, high] = report::bounding_box(prepared);
  const report::View view(camera, 0, 0, PicturesOfOne::kWidth, PicturesOfOne::kHeight,
                          report::length(high - low), prepared.geometry.positions);
  Rational3 eye;
  for (std::size_t k = 0; k < 3; ++k) {
    eye[k] = (mpq_class(camera.eye[k]) - prepared.geometry.origin[k]) / prepared.geometry.step;
  }
  std::vector<PixelSample> samples;
  for (int i = 0; i < 250; ++i) {
    const auto share = [&] { return static_cast<double>(random.between(-995, 995)) / 1000; };
    const double x = kTangent * share(),
                 y = kTangent * PicturesOfOne::kHeight / PicturesOfOne::kWidth * share();
    const report::Vector seen{x, y, 1};
    Rational3 direction;
    const report::Vector target = view.scene_point(seen);
    for (std::size_t k = 0; k < 3; ++k) {
      direction[k] = mpq_class(target[k]) - mpq_class(camera.eye[k]);
    }
    const FirstMet met = first_met(prepared, eye, direction);
    if (met.on_border) {
      ++counts.on_border;
      continue;
    }
    PixelSample sample{view.pixel(seen), std::nullopt};
    if (met.part) sample.polygon = prepared.parts[*met.part].polygon;
    samples.push_back(sample);
  }
  return samples;
}

void judge(const Scene& scene, std::uint64_t seed, bool turned_round, Counts& counts) {
  const auto prepared = prepare(scene);
  if (!prepared || prepared->lights.empty() || prepared->parts.empty()) return;
  Random random(seed + 5);
  const auto [low, high] = report::bounding_box(*prepared);
  const double size = report::length(high - low);
  report::Camera camera;
  camera.look_at = 0.5 * (low + high);
  camera.field_of_view = 2 * std::atan(0.5) * 180 / std::numbers::pi;
  const auto step = [&] { return static_cast<double>(random.between(-100, 100)) / 100; };
  // From outside, and from where polygons are beside and behind the eye.
  for (const double away : {1.1, 0.3}) {
    report::Vector to_eye{step(), step(), step() + 0.003};
    camera.eye = camera.look_at + (away * size) * report::unit(to_eye);
    const std::vector<PixelSample> samples = make_samples(*prepared, camera, random, counts);
    const PicturesOfOne pictures(scene, *prepared, camera, turned_round);
    for (std::uint32_t polygon = 0; polygon < scene.polygons.size(); ++polygon) {
      const std::vector<PaintedPath> paths = pictures.of(polygon);
      for (const PixelSample& sample : samples) {
        constexpr double kSeam = 1;  // half a seam or outline, and the rounding of pixels
        const bool on_border = std::ranges::any_of(paths, [&](const PaintedPath& path) {
          return distance_to_border(path.loop, sample.pixel) < kSeam;
        });
        if (on_border) {
          ++counts.on_border;
          continue;
        }
        bool warm = false;
        for (const PaintedPath& path : paths) {
          if (is_inside(path.loop, sample.pixel)) warm = path.warm;
        }
        ++counts.judged;
        if (warm) ++counts.seen;
        if (warm != (sample.polygon == polygon)) ++counts.wrong;
      }
    }
  }
}

void expect_right(const std::vector<Scene>& scenes) {
  Counts right, wrong;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    judge(scenes[i], i, false, right);
    judge(scenes[i], i, true, wrong);
  }
  EXPECT_EQ(right.wrong, 0u);
  EXPECT_GT(right.seen, 100u);
  EXPECT_LT(right.on_border, right.judged);
  // The pixels could have told: the order turned round shows other polygons.
  EXPECT_GT(wrong.wrong, right.seen / 20);
  for (const auto& [name, count] :
       {std::pair("judged", right.judged), std::pair("on_border", right.on_border),
        std::pair("seen", right.seen), std::pair("wrong_if_turned_round", wrong.wrong)}) {
    testing::Test::RecordProperty(name, std::to_string(count));
  }
}

std::vector<Scene> of_family(const std::string& name, std::uint64_t scenes) {
  std::vector<Scene> all;
  for (std::uint64_t seed = 0; seed < scenes; ++seed) {
    all.push_back(fuzz::family_by_name(name).make(seed));
  }
  return all;
}

TEST(PictureOrder, Pinwheels) {
  expect_right(
      {generate("pinwheel", {{"n", 1}}).value(), generate("pinwheel", {{"n", 2}}).value()});
}
TEST(PictureOrder, CrossingSticks) { expect_right(of_family("CrossingSticks", 4)); }
TEST(PictureOrder, CrossingPolygons) { expect_right(of_family("Crossing", 6)); }
TEST(PictureOrder, Lattices) { expect_right(of_family("Lattice", 12)); }
TEST(PictureOrder, Soups) {
  std::vector<Scene> scenes;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    Random random(seed);
    scenes.push_back(fuzz::make_soup(fuzz::Soup::kUniform, false, random));
  }
  expect_right(scenes);
}

// Two loops over the same half add up to the whole area of the polygon: the other half is lit.
TEST(Pictures, PaintedShadowsThatOverlapLeaveTheBackground) {
  const Scene scene = parse_scene(R"({"format": "gnomon-scene", "version": 1,
    "vertices": [[0,0,0], [2,0,0], [2,2,0], [0,2,0]],
    "polygons": [{"id": "floor", "loop": [0,1,2,3]}],
    "lights": [{"id": "sun", "type": "directional", "to_light": [0, 0, 1]}]})",
                                  "floor.json")
                          .value()
                          .scene;
  const PreparedScene prepared = prepare(scene).value();
  ClaimedLight light;
  light.id = "sun";
  light.cover = Cover::kOverlay;
  light.background = LightState::kLit;
  ClaimedPolygon& floor = light.polygons.emplace_back();
  floor.id = "floor";
  for (int i = 0; i < 2; ++i) {
    ClaimedFragment& half = floor.fragments.emplace_back();
    half.state = LightState::kShadow;
    half.loop = {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0}};
  }
  report::PictureOptions options;
  options.camera.eye = {1, 1, 5};
  options.camera.look_at = {1, 1, 0};
  options.camera.up = {0, 1, 0};
  options.legend = false;
  report::Panel panel;
  panel.light = 0;
  panel.shown = &light;
  report::StringSink sink;
  report::paint_scene(scene, prepared, back_to_front(prepared, options.camera.eye), {panel},
                      options)
      .write(sink);
  const std::vector<PaintedPath> paths = painted_paths(sink.text());
  EXPECT_EQ(std::ranges::count_if(paths, &PaintedPath::warm), 1);
  EXPECT_EQ(std::ranges::count_if(paths, [](const PaintedPath& path) { return !path.warm; }), 2);
}

}  // namespace
}  // namespace gnomon::test
