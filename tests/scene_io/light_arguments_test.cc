// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnomon/scene/light_arguments.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

Expected<Light> light(LightType type, const char* text) {
  return parse_light_argument(type, text, NumberMeaning::kDecimal, "x");
}

TEST(LightArguments, OneOfEach) {
  const auto lights =
      lights_from_arguments({{"1,2,3", " -1.5 , 2e0,+.1"}, {"0,0,1"}, {"0,0,3:0,1,3:1,1,3:1,0,3"}},
                            NumberMeaning::kDecimal);
  ASSERT_TRUE(lights);
  ASSERT_EQ(lights->size(), 4u);
  EXPECT_EQ((*lights)[0].id, "point0");
  EXPECT_EQ((*lights)[1].id, "point1");
  EXPECT_EQ((*lights)[1].position[2].exact(), mpq_class(1, 10));
  EXPECT_EQ((*lights)[2].id, "sun0");
  EXPECT_EQ((*lights)[2].type, LightType::kDirectional);
  EXPECT_EQ((*lights)[3].id, "area0");
  EXPECT_EQ((*lights)[3].loop.size(), 4u);
  EXPECT_EQ((*lights)[3].intensity, Number(1.0));
}

TEST(LightArguments, Malformed) {
  EXPECT_EQ(to_string(light(LightType::kPoint, "1,2").error()),
            "--point: '1,2' is not a point; expected x,y,z");
  EXPECT_EQ(light(LightType::kPoint, "1,2,3,4").error().code, ErrorCode::kUsage);
  EXPECT_EQ(light(LightType::kPoint, "").error().code, ErrorCode::kUsage);
  EXPECT_EQ(light(LightType::kPoint, "1,,3").error().what, "--point: '' is not a number");
  EXPECT_EQ(light(LightType::kPoint, "1,nan,3").error().what, "--point: 'nan' is not finite");
  EXPECT_EQ(light(LightType::kPoint, "1,2,1e9999").error().code, ErrorCode::kLimit);
  EXPECT_EQ(light(LightType::kDirectional, "0,-0,0e5").error().code, ErrorCode::kGeometry);
  EXPECT_EQ(light(LightType::kArea, "0,0,0:1,1,1").error().code, ErrorCode::kUsage);
  EXPECT_EQ(light(LightType::kArea, "0,0,0:1,1,1:").error().code, ErrorCode::kUsage);
}

TEST(LightArguments, IdsMustNotCollide) {
  Scene scene;
  ASSERT_TRUE(add_lights(scene, *lights_from_arguments({{"1,2,3"}, {}, {}}, scene.numbers)));
  const auto again = add_lights(scene, *lights_from_arguments({{"4,5,6"}, {}, {}}, scene.numbers));
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().code, ErrorCode::kId);
}

}  // namespace
}  // namespace gnomon
