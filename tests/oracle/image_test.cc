// SPDX-License-Identifier: GPL-3.0-or-later
// The oracle of pictures: a picture by hand, and truth found again ray by ray in rationals.
#include "gnomon/oracle/image.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "gnomon/oracle/visibility.h"
#include "scene/base/random.h"

namespace gnomon::oracle {
namespace {

Position at(int x, int y, int z) { return {Number(x), Number(y), Number(z)}; }

class PictureOf {
 public:
  PictureOf& polygon(const std::string& id, const std::vector<std::array<int, 3>>& loop,
                     bool two_sided = false) {
    Polygon polygon;
    polygon.id = id;
    polygon.two_sided = two_sided;
    for (const auto& x : loop) {
      polygon.loop.push_back(static_cast<VertexId>(scene_.vertices.size()));
      scene_.vertices.push_back(at(x[0], x[1], x[2]));
    }
    scene_.polygons.push_back(polygon);
    return *this;
  }
  PictureOf& light(LightType type, int x, int y, int z) {
    Light light;
    light.id = "light" + std::to_string(scene_.lights.size());
    light.type = type;
    light.position = at(x, y, z);
    scene_.lights.push_back(light);
    return *this;
  }
  const Scene& scene() const { return scene_; }
  PreparedView view(const ExactCamera& camera) const {
    auto view = prepare_view(scene_, camera);
    EXPECT_TRUE(view) << to_string(view.error());
    return *std::move(view);
  }

 private:
  Scene scene_;
};

/// Looks down from (0, 0, 8) on [-4, 4]^2 at z = 0.
ExactCamera from_above(std::uint32_t size) {
  return {at(0, 0, 8), {1, 0, 0}, {0, 1, 0}, {0, 0, -2}, size, size};
}

PixelClaims nothing_seen(const ExactCamera& camera, std::size_t lights) {
  PixelClaims claims;
  claims.camera = camera;
  for (std::uint32_t l = 0; l < lights; ++l) claims.lights.push_back(l);
  const std::size_t samples = std::size_t{camera.width} * camera.height;
  claims.polygon.assign(samples, PixelClaims::kNothing);
  claims.lit_by.assign(samples, 0);
  return claims;
}

ImageReport judge(const PreparedView& view, const PixelClaims& claims, ImageOptions options = {}) {
  auto report = judge_pixels(view, claims, options);
  EXPECT_TRUE(report) << to_string(report.error());
  return *std::move(report);
}

// A floor, a panel over its left half under a sun from straight above: the floor is not seen there.
// Eight columns: four see the panel, four the floor, all lit.
TEST(Image, APictureByHand) {
  PictureOf picture;
  picture.polygon("floor", {{-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}})
      .polygon("panel", {{-3, -3, 2}, {0, -3, 2}, {0, 3, 2}, {-3, 3, 2}})
      .light(LightType::kDirectional, 0, 0, 1);
  const ExactCamera camera = from_above(8);
  const PreparedView view = picture.view(camera);
  PixelClaims claims = nothing_seen(camera, 1);
  for (std::size_t s = 0; s < claims.polygon.size(); ++s) {
    claims.polygon[s] = s % 8 < 4 ? 1 : 0;
    claims.lit_by[s] = 1;
  }
  const ImageReport right = judge(view, claims);
  EXPECT_EQ(right.verdict, Verdict::kIdentical) << right.reason;
  // The panel's borders, at the slope 1/2 of samples at 3/8 and 5/8, meet none of them.
  EXPECT_EQ(right.judged, 64u);
  EXPECT_EQ(right.boundary, 0u);

  claims.lit_by[13] = 0;  // of the floor, beside the panel
  claims.polygon[10] = 0;
  const ImageReport wrong = judge(view, claims);
  EXPECT_EQ(wrong.verdict, Verdict::kFailed);
  EXPECT_EQ(wrong.wrong, 2u);
  EXPECT_EQ(wrong.wrong_polygon, 1u);
  EXPECT_EQ(wrong.wrong_of_light[0], 1u);
  ASSERT_TRUE(wrong.worst);
  ImageOptions generous;
  generous.clearance = 100;
  EXPECT_EQ(judge(view, claims, generous).verdict, Verdict::kWithinTolerance);
}

// With an odd number of columns one of them looks along the panel's edge: it is counted apart, and
// judged if it is moved, to the right, where the floor is.
TEST(Image, SamplesOnEdgesAreBoundaries) {
  PictureOf picture;
  picture.polygon("floor", {{-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}})
      .polygon("panel", {{-3, -3, 2}, {0, -3, 2}, {0, 3, 2}, {-3, 3, 2}});
  const ExactCamera camera = from_above(7);
  const PreparedView view = picture.view(camera);
  PixelClaims claims = nothing_seen(camera, 0);
  for (std::size_t s = 0; s < claims.polygon.size(); ++s) claims.polygon[s] = s % 7 < 3 ? 1 : 0;
  const ImageReport report = judge(view, claims);
  EXPECT_EQ(report.wrong, 0u);
  EXPECT_EQ(report.boundary, 7u);
  EXPECT_EQ(report.verdict, Verdict::kFailed);  // one in seven cannot be judged
  ImageOptions moving;
  moving.moves_ties = true;
  EXPECT_EQ(judge(view, claims, moving).moved, 7u);
  EXPECT_EQ(judge(view, claims, moving).wrong, 0u);
  for (std::size_t s = 3; s < claims.polygon.size(); s += 7) claims.polygon[s] = 1;
  EXPECT_EQ(judge(view, claims).wrong, 0u);
  EXPECT_EQ(judge(view, claims, moving).wrong, 7u);
}

TEST(Image, EveryNthSampleAboveTheLimit) {
  PictureOf picture;
  picture.polygon("floor", {{-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}});
  const ExactCamera camera = from_above(8);
  PixelClaims claims = nothing_seen(camera, 0);
  claims.polygon.assign(64, 0);
  ImageOptions options;
  options.most_pairs = 20;
  const ImageReport report = judge(picture.view(camera), claims, options);
  EXPECT_EQ(report.step, 4u);
  EXPECT_EQ(report.looked_at(), 16u);
}

// What the oracle holds to be true, found again without its doubles, boxes and lists: every part
// against every ray in rationals, then VisibilityTest among all casters.
TEST(Image, AgreesWithRationalsAtEverySample) {
  Random random(3);
  std::uint64_t judged = 0, boundary = 0;
  for (int round = 0; round < 40; ++round) {
    PictureOf picture;
    const auto small = [&] {
      return std::array<int, 3>{static_cast<int>(random.between(-3, 3)),
                                static_cast<int>(random.between(-3, 3)),
                                static_cast<int>(random.between(-3, 3))};
    };
    for (int p = 0; p < 7; ++p) {
      picture.polygon(std::to_string(p), {small(), small(), small()}, random.chance(1, 2));
    }
    picture.light(LightType::kPoint, 2, 1, 6).light(LightType::kDirectional, 1, -1, 2);
    const ExactCamera camera{at(1, 0, 7), {9, 0, 0}, {0, 9, 0}, {0, 0, -8}, 9, 9};
    const auto prepared = prepare_view(picture.scene(), camera);
    if (!prepared || prepared->scene.parts.empty()) continue;
    const PreparedScene& scene = prepared->scene;
    const Geometry& geometry = scene.geometry;
    const auto grid = [&](VertexId v) {
      RationalPoint x;
      for (std::size_t k = 0; k < 3; ++k) x[k] = geometry.grid.at(v, static_cast<int>(k));
      return x;
    };
    const auto minus = [](const RationalPoint& a, const RationalPoint& b) {
      return RationalPoint{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    };
    const auto cross = [](const RationalPoint& a, const RationalPoint& b) {
      return RationalPoint{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                           a[0] * b[1] - a[1] * b[0]};
    };
    const auto dot = [](const RationalPoint& a, const RationalPoint& b) {
      return mpq_class(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
    };
    RationalPoint eye;
    for (std::size_t k = 0; k < 3; ++k) eye[k] = prepared->frame.eye.grid[k];
    std::vector<VisibilityTest> tests;
    for (const PreparedLight& light : scene.lights) tests.emplace_back(scene, light);
    PixelClaims claims = nothing_seen(camera, 2);
    for (std::uint32_t s = 0; s < 81; ++s) {
      const ImageFrame::Direction direction = prepared->frame.direction({s % 9, s / 9});
      RationalPoint d;
      for (std::size_t k = 0; k < 3; ++k) d[k] = static_cast<long>(direction[k]);
      mpq_class nearest = -1;
      for (std::uint32_t p = 0; p < scene.parts.size(); ++p) {
        const auto loop = scene.loop(scene.parts[p]);
        const RationalPoint n =
            cross(minus(grid(loop[1]), grid(loop[0])), minus(grid(loop[2]), grid(loop[0])));
        const mpq_class at_eye = dot(n, minus(eye, grid(loop[0]))), slope = dot(n, d);
        if (at_eye == 0 || slope == 0 || (at_eye < 0 && !scene.parts[p].two_sided)) continue;
        const mpq_class t = -at_eye / slope;
        if (t <= 0 || (nearest > 0 && t >= nearest)) continue;
        RationalPoint x;
        for (std::size_t k = 0; k < 3; ++k) x[k] = eye[k] + t * d[k];
        bool inside = true;
        for (std::size_t k = 0; k < loop.size(); ++k) {
          const RationalPoint a = grid(loop[k]), b = grid(loop[(k + 1) % loop.size()]);
          inside = inside && dot(cross(n, minus(b, a)), minus(x, a)) >= 0;
        }
        if (!inside) continue;
        nearest = t;
        claims.polygon[s] = scene.parts[p].polygon;
        claims.lit_by[s] = 0;
        RationalPoint point;
        for (std::size_t k = 0; k < 3; ++k) point[k] = geometry.origin[k] + geometry.step * x[k];
        for (std::size_t l = 0; l < 2; ++l) {
          const LightPoint& light = scene.lights[l].point;
          RationalPoint to;
          for (std::size_t k = 0; k < 3; ++k) to[k] = light.grid[k];
          const mpq_class side = light.directional ? dot(n, to) : dot(n, minus(to, grid(loop[0])));
          if (sgn(side) == sgn(at_eye) && tests[l].at(p, point).visibility == Visibility::kLit) {
            claims.lit_by[s] |= std::uint64_t{1} << l;
          }
        }
      }
    }
    const ImageReport report = judge(*prepared, claims);
    EXPECT_EQ(report.wrong, 0u) << "round " << round;
    judged += report.judged;
    boundary += report.boundary;
  }
  EXPECT_GT(judged, 1000u);
  EXPECT_GT(boundary, 20u);
}

}  // namespace
}  // namespace gnomon::oracle
