// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of several lights together: how many shades there are, whether fragments tile a polygon
// or shadows are painted on shadows.
#include "report/pictures/combined_picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <string>

#include "gnomon/algorithms/shadows.h"
#include "gnomon/scene/read.h"
#include "report/sides/claims_of.h"
#include "report/text/text_sink.h"

namespace gnomon::report {
namespace {

using testing::HasSubstr;
using testing::Not;

// On the floor two shadows overlap, beside each other at y from 1 to 2: one from x = 1 to 2, one
// from x = 0.5 to 1.5. The floor's border is far from them.
constexpr const char* kTwoSuns = R"({"format": "gnomon-scene", "version": 1, "name": "two suns",
  "vertices": [[-9,-9,0],[9,-9,0],[9,9,0],[-9,9,0],[1,1,1],[2,1,1],[2,2,1],[1,2,1]],
  "polygons": [{"id": "floor", "loop": [0,1,2,3]}, {"id": "quad", "loop": [4,5,6,7]}],
  "lights": [{"id": "high", "type": "directional", "to_light": [0,0,1]},
             {"id": "low", "type": "directional", "to_light": [1,0,2]}]})";

std::string picture(Cover cover, std::vector<std::uint32_t> lights = {0, 1}) {
  const auto read = parse_scene(kTwoSuns, "suns.json");
  const auto prepared = prepare(read->scene);
  ShadowOptions shadows;
  shadows.method.point = MethodId::kBasic;
  shadows.method.options.cover = cover;
  shadows.lights = lights;
  shadows.output.combined = shadows.output.points = true;
  const auto result = compute_shadows(*prepared, shadows);
  const Claims claims = claims_of(read->scene, *prepared, *result, "exact", false);
  PictureOptions options;
  options.camera.eye = {0, 0, 30};
  options.camera.look_at = {0, 0, 0};
  options.camera.up = {0, 1, 0};
  StringSink sink;
  paint_combined_scene(read->scene, *prepared, back_to_front(*prepared, options.camera.eye), claims,
                       lights, options)
      .write(sink);
  return sink.text();
}

/// How often paths are filled with each colour.
std::map<std::string, int> fills(const std::string& svg) {
  std::map<std::string, int> counts;
  const std::regex path("<path[^>]*fill=\"(#[0-9a-f]+)\"");
  for (std::sregex_iterator it(svg.begin(), svg.end(), path), end; it != end; ++it) {
    ++counts[(*it)[1]];
  }
  return counts;
}

TEST(CombinedPicture, HasAShadeForEachNumberOfLights) {
  const std::string svg = picture(Cover::kPartition);
  for (const char* entry : {"lit by all 2", "by 1", "by none"}) EXPECT_THAT(svg, HasSubstr(entry));
  // Of the floor by all, by one and by none; of the quad by all.
  EXPECT_GE(fills(svg).size(), 3u);
  EXPECT_LE(fills(svg).size(), 4u + 1u);
}

TEST(CombinedPicture, PaintsShadowsOnShadows) {
  const std::string svg = picture(Cover::kOverlay);
  // The floor, two shadows of level 1, one of level 2, and the quad.
  int paths = 0;
  for (const auto& [fill, count] : fills(svg)) paths += count;
  EXPECT_EQ(paths, 5);
  // The shades are those of the partition.
  for (const auto& [fill, count] : fills(svg)) {
    EXPECT_EQ(fills(picture(Cover::kPartition)).count(fill), 1u) << fill;
  }
}

TEST(CombinedPicture, OneLightIsAllOrNone) {
  const std::string svg = picture(Cover::kPartition, {1});
  EXPECT_THAT(svg, HasSubstr("lit by all 1"));
  EXPECT_THAT(svg, Not(HasSubstr("by 1<")));
  EXPECT_THAT(svg, HasSubstr("by none"));
}

}  // namespace
}  // namespace gnomon::report
