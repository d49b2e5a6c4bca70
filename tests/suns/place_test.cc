// SPDX-License-Identifier: GPL-3.0-or-later
#include "suns/place/place.h"

#include <gtest/gtest.h>

#include "scene/base/output_file.h"
#include "suns/place/epw.h"
#include "suns/place/scene_place.h"
#include "tests/support/test_directory.h"

namespace gnomon::suns {
namespace {

TEST(Place, AsTyped) {
  const Place place = parse_place("33.45,-111.98", "--at").value();
  EXPECT_DOUBLE_EQ(place.latitude, 33.45);
  EXPECT_DOUBLE_EQ(place.longitude, -111.98);
  for (const char* wrong : {"", "33", "33,", "33,x", "33;4", "91,0", "0,181", "nan,0", "33,4,5"}) {
    EXPECT_FALSE(parse_place(wrong, "--at")) << wrong;
  }
}

class Epw : public testing::Test {
 protected:
  Expected<Place> read(const std::string& text) {
    const std::string file = directory_.file("w.epw");
    EXPECT_TRUE(write_file(file, text));
    return read_epw_place(file);
  }
  std::string error_of(const std::string& text) {
    const auto place = read(text);
    EXPECT_FALSE(place) << text;
    return place ? "" : to_string(place.error());
  }
  test::TestDirectory directory_;
};

TEST_F(Epw, TellsItsPlace) {
  const Place place =
      read("LOCATION,Some Town,ST,XXX,made up,123456,-33.45, 151.2,10.5,12.0\r\nDESIGN,0\r\n")
          .value();
  EXPECT_EQ(place.name, "Some Town");
  EXPECT_DOUBLE_EQ(place.latitude, -33.45);
  EXPECT_DOUBLE_EQ(place.longitude, 151.2);
  EXPECT_EQ(place.zone, std::chrono::minutes(630));
  EXPECT_DOUBLE_EQ(place.elevation, 12);
}

TEST_F(Epw, ErrorsNameThePlace) {
  EXPECT_NE(error_of("hello\n").find(":1:1: 'hello' begins no weather file"), std::string::npos);
  EXPECT_NE(error_of("LOCATION,a,b\n").find(":1:13: the line LOCATION has 3 fields"),
            std::string::npos);
  EXPECT_NE(error_of("LOCATION,a,b,c,d,e,x,2,3,4\n").find(":1:20: 'x' is no latitude"),
            std::string::npos);
  EXPECT_NE(error_of("LOCATION,a,b,c,d,e,1,2,5.501,4\n").find("is no time zone"),
            std::string::npos);
  EXPECT_NE(error_of("LOCATION,a,b,c,d,e,99,2,3,4\n").find("no latitude"), std::string::npos);
  EXPECT_NE(error_of(""), "");
  EXPECT_EQ(read_epw_place(directory_.file("none.epw")).error().code, ErrorCode::kFile);
}

TEST(ScenePlace, FromTheExtraOfAnEnergyModel) {
  Scene scene;
  EXPECT_FALSE(place_of_scene(scene).place);
  scene.extra = R"({"energyplus": {"coordinates": "relative", "north_axis": 30, "turned": false,
    "location": {"name": "X", "latitude": 1.5, "longitude": -2, "time_zone": 5.5, "elevation": 3}}})";
  const ScenePlace found = place_of_scene(scene);
  ASSERT_TRUE(found.place);
  EXPECT_DOUBLE_EQ(found.north, 30);
  EXPECT_EQ(found.place->zone, std::chrono::minutes(330));
  EXPECT_DOUBLE_EQ(found.place->latitude, 1.5);
  scene.extra = R"({"energyplus": {"coordinates": "relative", "north_axis": 30, "turned": true}})";
  EXPECT_DOUBLE_EQ(place_of_scene(scene).north, 0);
  scene.extra = R"({"energyplus": {"coordinates": "world", "north_axis": 30, "turned": false}})";
  EXPECT_DOUBLE_EQ(place_of_scene(scene).north, 0);
  scene.extra = R"({"energyplus": {"location": {"latitude": 123}}})";
  EXPECT_FALSE(place_of_scene(scene).place);
  scene.extra = R"({"energyplus": 7})";
  EXPECT_FALSE(place_of_scene(scene).place);
}

}  // namespace
}  // namespace gnomon::suns
