// SPDX-License-Identifier: GPL-3.0-or-later
// What a failure comes from: one scene for each cause, and which of two causes is named.
#include "fuzz/check/cause.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "gnomon/scene/prepare.h"
#include "gnomon/scene/read.h"

namespace gnomon::fuzz {
namespace {

/// The cause where polygon a has an error that b decides, under light "sun".
std::string cause(const std::string& a, const std::string& b, const std::string& sun = "[1,2,3]",
                  const std::string& caster = "b") {
  const auto loop = [](int first, int count) {
    std::string text = std::to_string(first);
    for (int i = 1; i < count; ++i) text += "," + std::to_string(first + i);
    return text;
  };
  const auto corners = [](const std::string& points) {
    return static_cast<int>(std::ranges::count(points, '['));
  };
  const int first = corners(a), second = corners(b);
  const auto read = parse_scene(
      R"({"format": "gnomon-scene", "version": 1, "vertices": [)" + a + "," + b +
          R"(], "polygons": [{"id": "a", "loop": [)" + loop(0, first) +
          R"(]}, {"id": "b", "loop": [)" + loop(first, second) +
          R"(]}], "lights": [{"id": "sun", "type": "directional", "to_light": )" + sun + "}]}",
      "scene.json");
  if (!read) throw std::runtime_error(to_string(read.error()));
  const auto prepared = prepare(read->scene);
  if (!prepared) throw std::runtime_error(to_string(prepared.error()));
  return cause_of(read->scene, *prepared, "sun", "a", caster);
}

const std::string kFloor = "[0,0,0],[4,0,0],[4,4,0],[0,4,0]";

TEST(Cause, OneSceneForEach) {
  EXPECT_EQ(cause(kFloor, "[1,1,0],[3,1,0],[2,2,2]", "[1,0,0]"), "light-in-plane");
  EXPECT_EQ(cause(kFloor, "[1,1,1e-9],[3,1,1e-9],[2,2,1e-9]"), "near-coplanar");
  EXPECT_EQ(cause(kFloor, "[1,1,1],[3,1,1],[2,2,2]", "[1,0,1e-9]"), "grazing");
  EXPECT_EQ(cause(kFloor, "[1,1,1],[3,1,1],[2,1.0000001,1]"), "sliver");
  EXPECT_EQ(cause("[100000000,0,0],[100000004,0,0],[100000004,4,0],[100000000,4,0]",
                  "[100000001,1,1],[100000003,1,1],[100000002,2,1]"),
            "far");
  EXPECT_EQ(cause(kFloor, "[0,0,0],[4,0,0],[2,0,2]"), "shared-edge");
  EXPECT_EQ(cause(kFloor, "[0,0,0],[1,1,1],[-1,1,2]"), "shared-vertex");
  EXPECT_EQ(cause(kFloor, "[1,1,0],[3,1,2],[2,2,3]"), "touching");
  EXPECT_EQ(cause(kFloor, "[1,1,-1],[3,1,1],[2,2,2]"), "crossing");
  EXPECT_EQ(cause(kFloor, "[1,1,1],[3,1,2],[2,2,2]"), "general");
}

TEST(Cause, OneThatLiesElsewhereInThePlaneIsNotNear) {
  EXPECT_EQ(cause(kFloor, "[11,1,1e-9],[13,1,1e-9],[12,2,1e-9]"), "general");
}

TEST(Cause, TheFirstOfTwoIsNamed) {
  EXPECT_EQ(cause("[100000000,0,0],[100000004,0,0],[100000004,4,0],[100000000,4,0]",
                  "[100000001,1,1e-8],[100000003,1,1e-8],[100000002,2,1e-8]"),
            "near-coplanar");
}

TEST(Cause, WithoutACasterContactsDoNotCount) {
  EXPECT_EQ(cause(kFloor, "[0,0,0],[4,0,0],[2,0,2]", "[1,2,3]", ""), "general");
  EXPECT_EQ(cause(kFloor, "[1,1,1e-9],[3,1,1e-9],[2,2,1e-9]", "[1,2,3]", ""), "near-coplanar");
}

}  // namespace
}  // namespace gnomon::fuzz
