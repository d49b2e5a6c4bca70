// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of illuminated scenes: what is painted, and with which shades.
#include "report/pictures/shaded_picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <set>
#include <string>

#include "gnomon/algorithms/shadows.h"
#include "gnomon/scene/read.h"
#include "report/text/text_sink.h"

namespace gnomon::report {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kSheet = R"({"format": "gnomon-scene", "version": 1, "name": "sheet",
  "vertices": [[0,0,0],[4,0,0],[4,4,0],[0,4,0]],
  "polygons": [{"id": "floor", "loop": [0,1,2,3]}],
  "lights": [{"id": "bulb", "type": "point", "position": [2,2,3]}]})";

/// The sheet seen from above or below, its shade a function of x and y.
template <class ShadeOf>
std::string picture(const ShadeOf& shade_of, ShadedPictureOptions options = {}, double height = 8) {
  const auto read = parse_scene(kSheet, "sheet.json");
  const auto prepared = prepare(read->scene);
  ShadowOptions shadows;
  shadows.output.exact_points = true;
  const auto result = compute_shadows(*prepared, shadows);
  const auto mesh = make_shading_mesh(
      *prepared, *result,
      [&](const ShadeRequest& asked) {
        return PointShade{shade_of(asked.point[0].get_d(), asked.point[1].get_d()), 0};
      },
      {});
  options.picture.camera.eye = {2, 2, height};
  options.picture.camera.look_at = {2, 2, 0};
  options.picture.camera.up = {0, 1, 0};
  options.picture.width = options.picture.height = 400;
  StringSink sink;
  paint_shaded_scene(read->scene, *prepared, back_to_front(*prepared, options.picture.camera.eye),
                     *mesh, options)
      .write(sink);
  return sink.text();
}

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t found = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    ++found;
  }
  return found;
}

TEST(ShadedPicture, AnEvenShadeIsFlat) {
  const std::string svg = picture([](double, double) { return 0.5; });
  EXPECT_EQ(count(svg, "linearGradient"), 0u);
  EXPECT_EQ(count(svg, "<path"), 2u);  // the ground and the one face
  EXPECT_THAT(svg, HasSubstr("fill=\"#ffffff\""));
  EXPECT_THAT(svg, HasSubstr("light: bulb; 1 faces; white is 0.5"));
}

TEST(ShadedPicture, AnUnevenShadeIsAGradientOfTheScreensColours) {
  // White on the right, and what sRGB shows as 0 on the left: linear on the screen would be wrong
  // for the illumination, and is what hardware does.
  const std::string svg = picture([](double x, double) { return x / 4; });
  EXPECT_EQ(count(svg, "<linearGradient"), 1u);
  EXPECT_THAT(svg, HasSubstr("<stop stop-color=\"#000000\"/>"));
  EXPECT_THAT(svg, HasSubstr("<stop offset=\"1\" stop-color=\"#ffffff\"/>"));
  std::smatch match;
  ASSERT_TRUE(
      std::regex_search(svg, match,
                        std::regex("x1=\"([-0-9.e]+)\" y1=\"([-0-9.e]+)\" x2=\"([-0-9.e]+)\" "
                                   "y2=\"([-0-9.e]+)\"")));
  EXPECT_LT(std::stod(match[1]), std::stod(match[3])) << "x runs to the right";
  EXPECT_NEAR(std::stod(match[2]), std::stod(match[4]), 1e-3);
  // The ends are the sheet's borders: 4 of 8 units away.
  EXPECT_NEAR(std::stod(match[1]) + std::stod(match[3]), 400, 0.01);
  EXPECT_THAT(svg, HasSubstr("url(#g0)"));
}

TEST(ShadedPicture, WhatIsNotLinearIsPaintedInTriangles) {
  const std::string svg = picture([](double x, double) { return x < 1 ? 1.0 : 0.0; });
  EXPECT_EQ(count(svg, "<linearGradient"), 1u) << "linear between four corners";
  const std::string triangles = picture([](double x, double y) { return x * y; });
  EXPECT_EQ(count(triangles, "<path"), 3u);
}

TEST(ShadedPicture, ExposureTintsAndBorders) {
  ShadedPictureOptions options;
  options.shade.exposure = 1;
  EXPECT_THAT(picture([](double, double) { return 0.2140411; }, options),
              HasSubstr("fill=\"#7f7f7f\""));
  EXPECT_THAT(picture([](double, double) { return 7.0; }, options), HasSubstr("fill=\"#ffffff\""));
  options.picture.fragments = true;
  const std::string bordered = picture([](double, double) { return 7.0; }, options);
  EXPECT_THAT(bordered, Not(HasSubstr("fill=\"#ffffff\" stroke=\"#ffffff\"/>\n</g>")));
  options.shade.tint = true;
  EXPECT_THAT(picture([](double, double) { return 7.0; }, options),
              Not(HasSubstr("polygon fill=\"#fff")));
  options.picture.legend = false;
  EXPECT_THAT(picture([](double, double) { return 7.0; }, options), Not(HasSubstr("light:")));
}

TEST(ShadedPicture, BacksOfOneSidedPolygonsAreNotPainted) {
  EXPECT_EQ(count(picture([](double, double) { return 1.0; }, {}, -8), "<path"), 0u);
  ShadedPictureOptions options;
  options.picture.backs = true;
  EXPECT_EQ(count(picture([](double, double) { return 1.0; }, options, -8), "<path"), 2u);
}

}  // namespace
}  // namespace gnomon::report
