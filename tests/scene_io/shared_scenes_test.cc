// SPDX-License-Identifier: GPL-3.0-or-later
// Real files, where they are at hand: all good ones read and survive every format, all bad ones end
// in one error at the right place.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <vector>

#include "gnomon/scene/digest.h"
#include "gnomon/scene/write.h"
#include "scene_testing.h"

namespace gnomon {
namespace {

namespace fs = std::filesystem;

class SharedScenes : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!fs::is_directory(fs::path(GNOMON_SHARED_SCENES) / "mesh")) {
      GTEST_SKIP() << "no shared scenes here";
    }
  }
  static std::vector<fs::path> files() {
    std::vector<fs::path> result;
    for (const char* directory : {"cityjson", "idf", "json", "mesh"}) {
      for (const auto& entry : fs::directory_iterator(fs::path(GNOMON_SHARED_SCENES) / directory)) {
        result.push_back(entry.path());
      }
    }
    std::sort(result.begin(), result.end());
    return result;
  }
};

/// Where the malformed ones go wrong.
const std::map<std::string, std::string> kBad = {
    {"bad_face.obj", "15:1: a face of 1 vertex"},
    {"bad_huge_counts.off", "2:1: 353535235358 vertices announced"},
    {"bad_malformed.obj", "23:5: index 12 is not that of a vertex"},
    {"bad_nan.obj", "12:3: 'nan' is not finite"},
    {"number_formats.obj", "11:14: '3.1+e2' is not a number"},
};

TEST_F(SharedScenes, MalformedOnesEndInOneError) {
  for (const fs::path& file : files()) {
    const auto bad = kBad.find(file.filename().string());
    const auto result = read_scene(file);
    ASSERT_EQ(result.has_value(), bad == kBad.end()) << file;
    if (result) continue;
    const Error& error = result.error();
    EXPECT_EQ(std::to_string(error.where.line) + ":" + std::to_string(error.where.column) + ": " +
                  error.what,
              bad->second);
  }
}

TEST_F(SharedScenes, OthersSurviveEveryFormat) {
  for (const fs::path& file : files()) {
    for (const auto meaning : {NumberMeaning::kDouble, NumberMeaning::kDecimal}) {
      ReadOptions options;
      options.numbers = meaning;
      const auto result = read_scene(file, options);
      if (!result) continue;
      EXPECT_GT(result->scene.polygons.size(), 0u) << file;
      const std::string digest = geometry_digest(result->scene);
      const auto json = scene_to_text(result->scene, SceneFormat::kJson);
      ASSERT_TRUE(json) << file;
      const Scene back = scene_of(json->text, "back.json");
      expect_same_scene(back, result->scene);
      EXPECT_EQ(geometry_digest(back), digest);
      for (const auto format : {SceneFormat::kObj, SceneFormat::kOff, SceneFormat::kPlyAscii,
                                SceneFormat::kPlyBinary}) {
        const auto text = scene_to_text(result->scene, format);
        if (!text) {
          EXPECT_EQ(format, SceneFormat::kPlyBinary) << file;
          EXPECT_EQ(text.error().code, ErrorCode::kNumber);
          continue;
        }
        ReadOptions again = options;
        again.format = format;
        expect_same_geometry(scene_of(text->text, "back", again), result->scene);
      }
    }
  }
}

TEST_F(SharedScenes, CityModelsAndEnergyModelsAreReadAsTheyAre) {
  const auto scene = [](const char* name) {
    auto result = read_scene(fs::path(GNOMON_SHARED_SCENES) / name);
    EXPECT_TRUE(result) << name;
    return result ? std::move(result->scene) : Scene();
  };
  const auto holes = [](const Scene& scene) {
    std::size_t count = 0;
    for (const Polygon& polygon : scene.polygons) count += polygon.holes.size();
    return count;
  };
  EXPECT_EQ(scene("cityjson/cube.city.json").polygons.size(), 6u);
  EXPECT_EQ(scene("cityjson/potatoes.city.json").polygons.size(), 6u);
  EXPECT_EQ(scene("cityjson/japanese.city.json").polygons.size(), 198u);
  EXPECT_EQ(holes(scene("cityjson/texture4.city.json")), 41u);
  // The scene that was made of it by hand is moved by whole metres.
  const Scene city = scene("cityjson/denhaag.city.json"), by_hand = scene("json/city-denhaag.json");
  ASSERT_EQ(city.vertices.size(), by_hand.vertices.size());
  const mpq_class translate(457782);
  for (std::size_t i = 0; i < city.vertices.size(); ++i) {
    EXPECT_EQ(city.vertices[i][1].exact(), by_hand.vertices[i][1].exact() + translate);
  }
  // Windows are holes here, and the order of polygons is that of the file.
  const Scene house = scene("idf/ashrae140-case630.idf");
  const Scene same_house = scene("json/ashrae140-case630.json");
  ASSERT_EQ(house.polygons.size(), same_house.polygons.size());
  for (std::size_t i = 0; i < house.polygons.size(); ++i) {
    const Polygon &a = house.polygons[i], &b = same_house.polygons[i];
    EXPECT_EQ(a.id, b.id);
    ASSERT_EQ(a.loop.size(), b.loop.size());
    // Loops of windows begin at the lower left corner.
    EXPECT_TRUE(std::is_permutation(a.loop.begin(), a.loop.end(), b.loop.begin(),
                                    [&](VertexId one, VertexId other) {
                                      return house.vertices[one] == same_house.vertices[other];
                                    }))
        << a.id;
  }
  EXPECT_EQ(holes(house), 2u);
  EXPECT_EQ(holes(scene("idf/single-family.idf")), 10u);
}

}  // namespace
}  // namespace gnomon
