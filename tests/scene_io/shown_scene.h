// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes in words, for tests of readers.
#ifndef GNOMON_TESTS_SCENE_IO_SHOWN_SCENE_H
#define GNOMON_TESTS_SCENE_IO_SHOWN_SCENE_H

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "gnomon/scene/read.h"

namespace gnomon {

inline ReadResult read_text(const std::string& text, const std::string& file,
                            const ReadOptions& options = {}) {
  auto result = parse_scene(text, file, options);
  EXPECT_TRUE(result) << to_string(result.error());
  return result ? *std::move(result) : ReadResult();
}

inline std::string shown(const Position& at) {
  return "(" + at[0].to_text() + ", " + at[1].to_text() + ", " + at[2].to_text() + ")";
}

/// "(1, 0, 2.5) ..." for the vertices of a loop.
inline std::string shown(const Scene& scene, const std::vector<VertexId>& loop) {
  std::string all;
  for (const VertexId vertex : loop) {
    all += (all.empty() ? "" : " ") + shown(scene.vertices[vertex]);
  }
  return all;
}

inline std::string loop_of(const Scene& scene, const std::string& id) {
  for (const Polygon& polygon : scene.polygons) {
    if (polygon.id == id) return shown(scene, polygon.loop);
  }
  return "there is no " + id;
}

inline std::vector<std::string> ids_of(const Scene& scene) {
  std::vector<std::string> ids;
  for (const Polygon& polygon : scene.polygons) ids.push_back(polygon.id);
  return ids;
}

}  // namespace gnomon

#endif  // GNOMON_TESTS_SCENE_IO_SHOWN_SCENE_H
