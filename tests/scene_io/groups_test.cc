// SPDX-License-Identifier: GPL-3.0-or-later
// Groups of polygons: from OBJ files and from "extra", back and forth, and what is refused.
#include "gnomon/scene/groups.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "gnomon/scene/read.h"

namespace gnomon {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Scene read(const std::string& text, const std::string& file) {
  auto result = parse_scene(text, file);
  EXPECT_TRUE(result) << to_string(result.error());
  return result ? std::move(result->scene) : Scene{};
}

std::string scene_with(const std::string& extra) {
  return R"({"format": "gnomon-scene", "version": 1, "extra": )" + extra +
         R"(, "vertices": [[0,0,0],[1,0,0],[0,1,0]],
             "polygons": [{"id": "a", "loop": [0,1,2]}, {"loop": [0,1,2]}]})";
}

std::vector<std::string> names(const std::vector<PolygonGroup>& groups) {
  std::vector<std::string> all;
  for (const PolygonGroup& group : groups) all.push_back(group.name);
  return all;
}

TEST(Groups, OfAnObjFile) {
  const Scene scene = read(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
      "f 1 2 3\n"           // in none
      "o house\nf 1 2 3\n"  // in house
      "g wall south\nf 1 2 3\n"
      "g\nf 1 2 3\n"  // back to the default group
      "o shed\ng shed\nf 1 2 3\n"
      "g empty\n",
      "scene.obj");
  const auto groups = polygon_groups(scene);
  ASSERT_TRUE(groups);
  EXPECT_THAT(names(*groups), ElementsAre("house", "wall", "south", "default", "shed"));
  EXPECT_THAT((*groups)[0].polygons, ElementsAre(1, 2, 3));
  EXPECT_THAT((*groups)[1].polygons, ElementsAre(2));
  EXPECT_THAT((*groups)[3].polygons, ElementsAre(3));
  EXPECT_THAT((*groups)[4].polygons, ElementsAre(4));
}

TEST(Groups, AnObjFileWithoutNamesHasNoExtra) {
  const Scene scene = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "scene.obj");
  EXPECT_EQ(scene.extra, "");
  EXPECT_THAT(*polygon_groups(scene), IsEmpty());
}

TEST(Groups, NamesThatAreNoTextOfJson) {
  const Scene scene =
      read("v 0 0 0\nv 1 0 0\nv 0 1 0\ng \"a\\\nf 1 2 3\ng caf\xe9\nf 1 2 3\n", "scene.obj");
  const auto groups = polygon_groups(scene);
  ASSERT_TRUE(groups) << to_string(groups.error());
  ASSERT_FALSE(groups->empty());
  // Bytes that are no UTF-8 do not get into JSON.
  EXPECT_EQ(scene.extra.find('\xe9'), std::string::npos);
}

TEST(Groups, OfExtra) {
  const Scene scene =
      read(scene_with(R"({"z": 1e400, "groups": {"all": ["a", 1, "a"], "none": []}})"), "s.json");
  const auto found = polygon_groups(scene);
  if (found) {  // the number beyond doubles may be refused, but not passed over in silence
    EXPECT_THAT(names(*found), ElementsAre("all", "none"));
  } else {
    EXPECT_EQ(found.error().code, ErrorCode::kLimit);
  }
  const auto groups = polygon_groups(
      read(scene_with(R"({"groups": {"all": ["a", 1, "a"], "none": []}})"), "s.json"));
  ASSERT_TRUE(groups);
  EXPECT_THAT(names(*groups), ElementsAre("all", "none"));
  EXPECT_THAT((*groups)[0].polygons, ElementsAre(0, 1));
  EXPECT_THAT(*polygon_groups(read(scene_with(R"(["groups"])"), "s.json")), IsEmpty());
  EXPECT_THAT(*polygon_groups(read(scene_with(R"({"x": {"groups": 1}})"), "s.json")), IsEmpty());
}

TEST(Groups, WhatIsRefused) {
  for (const auto& [extra, place] :
       {std::pair(R"({"groups": []})", "/extra/groups"),
        std::pair(R"({"groups": {"w": "a"}})", "/extra/groups/w"),
        std::pair(R"({"groups": {"w": [true]}})", "/extra/groups/w/0"),
        std::pair(R"({"groups": {"w": ["a", "b"]}})", "/extra/groups/w/1")}) {
    const auto groups = polygon_groups(read(scene_with(extra), "s.json"));
    ASSERT_FALSE(groups) << extra;
    EXPECT_THAT(to_string(groups.error()), HasSubstr(place));
    EXPECT_THAT(to_string(groups.error()), HasSubstr("s.json"));
  }
}

}  // namespace
}  // namespace gnomon
