// SPDX-License-Identifier: GPL-3.0-or-later
// Helpers of the tests of reading and writing: an error as one line, scenes compared value by
// value.
#ifndef GNOMON_TESTS_SCENE_IO_SCENE_TESTING_H
#define GNOMON_TESTS_SCENE_IO_SCENE_TESTING_H

#include <gtest/gtest.h>

#include <string>

#include "gnomon/scene/read.h"

namespace gnomon {

/// The error of a file with this text, "LINE:COLUMN: what", and " @pointer" if it has one; "ok" if
/// there is none.
inline std::string error_of(const std::string& text, const std::string& file,
                            const ReadOptions& options = {}) {
  const auto result = parse_scene(text, file, options);
  if (result) return "ok";
  const Error& error = result.error();
  EXPECT_EQ(error.where.file, file);
  std::string line = std::to_string(error.where.line) + ":" + std::to_string(error.where.column) +
                     ": " + error.what;
  if (!error.where.pointer.empty()) line += " @" + error.where.pointer;
  return line;
}

inline ErrorCode code_of(const std::string& text, const std::string& file,
                         const ReadOptions& options = {}) {
  const auto result = parse_scene(text, file, options);
  EXPECT_FALSE(result) << "no error in " << text.substr(0, 200);
  return result ? ErrorCode::kInterrupted : result.error().code;
}

inline Scene scene_of(const std::string& text, const std::string& file,
                      const ReadOptions& options = {}) {
  auto result = parse_scene(text, file, options);
  EXPECT_TRUE(result) << to_string(result.error());
  return result ? std::move(result->scene) : Scene();
}

/// A binary PLY's index or coordinate says no more than its byte; two scenes are the same if a
/// program that uses them cannot tell them apart.
inline void expect_same_geometry(const Scene& a, const Scene& b) {
  EXPECT_EQ(a.vertices, b.vertices);
  ASSERT_EQ(a.polygons.size(), b.polygons.size());
  for (std::size_t i = 0; i < a.polygons.size(); ++i) {
    EXPECT_EQ(a.polygons[i].loop, b.polygons[i].loop) << i;
  }
}

inline void expect_same_scene(const Scene& a, const Scene& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.numbers, b.numbers);
  EXPECT_EQ(a.two_sided, b.two_sided);
  EXPECT_EQ(a.extra, b.extra);
  expect_same_geometry(a, b);
  for (std::size_t i = 0; i < a.polygons.size(); ++i) {
    EXPECT_EQ(a.polygons[i].id, b.polygons[i].id);
    EXPECT_EQ(a.polygons[i].holes, b.polygons[i].holes);
    EXPECT_EQ(a.polygons[i].two_sided, b.polygons[i].two_sided);
    EXPECT_EQ(a.polygons[i].casts, b.polygons[i].casts);
  }
  ASSERT_EQ(a.lights.size(), b.lights.size());
  for (std::size_t i = 0; i < a.lights.size(); ++i) {
    EXPECT_EQ(a.lights[i].id, b.lights[i].id);
    EXPECT_EQ(a.lights[i].type, b.lights[i].type);
    EXPECT_EQ(a.lights[i].position, b.lights[i].position);
    EXPECT_EQ(a.lights[i].loop, b.lights[i].loop);
    EXPECT_EQ(a.lights[i].intensity, b.lights[i].intensity);
  }
}

/// A scene that has everything a scene can have.
inline std::string full_json() {
  return R"({"format": "gnomon-scene", "version": 1, "name": "t\u00e4ble \"1\"", "numbers": "decimal",
 "two_sided": true, "extra": {"by": ["hand", 1e999, {"x": null}]},
 "vertices": [[0,0,0],[4,0,0],[4,4,0.1],[0,4,0],[1,1,0],[2,1,0],[2,2,0],[-1.5e-3,1e400,123456789012345678901234567890]],
 "polygons": [
  {"id": "floor", "loop": [0,1,2,3], "holes": [[4,5,6]], "two_sided": false, "casts": false, "extra": 7},
  {"loop": [3,2,1], "extra": {"extra": []}},
  {"two_sided": true, "loop": [4,5,7], "holes": []}
 ],
 "lights": [
  {"id": "bulb", "type": "point", "position": [1,1,3]},
  {"to_light": [0.3,0.2,1], "type": "directional", "extra": "north"},
  {"id": "panel", "type": "area", "loop": [[1,1,3],[1,2,3],[2,2,3],[2,1,3]], "intensity": 2.5}
 ]
}
)";
}

}  // namespace gnomon

#endif  // GNOMON_TESTS_SCENE_IO_SCENE_TESTING_H
