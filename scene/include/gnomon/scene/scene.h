// SPDX-License-Identifier: LGPL-3.0-or-later
// A scene as its file says, before anything is checked or changed beyond syntax: vertices, polygons
// with holes, lights. Readers fill it, writers print it, generators make it, prepare.h takes it
// apart.
#ifndef GNOMON_SCENE_SCENE_H
#define GNOMON_SCENE_SCENE_H

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gnomon/kernel/geometry.h"
#include "gnomon/scene/number.h"

namespace gnomon {

using Position = std::array<Number, 3>;

struct Polygon {
  std::string id;
  std::vector<VertexId> loop;
  std::vector<std::vector<VertexId>> holes;
  std::optional<bool> two_sided;  // overrides the scene's
  bool casts = true;
};

enum class LightType : std::uint8_t { kPoint, kDirectional, kArea };

/// A plane that bounds where a light shines: three points, counter-clockwise seen from inside.
using RegionPlane = std::array<Position, 3>;

struct Light {
  std::string id;
  LightType type = LightType::kPoint;
  Position position;           // point: position; directional: to_light
  std::vector<Position> loop;  // area
  Number intensity{1.0};
  /// Point and directional lights: it shines inside all of these planes, the planes themselves
  /// included. None: everywhere.
  std::vector<RegionPlane> region;
  /// A point light that stands for an eye: what it reaches is seen. Every polygon hides from an
  /// eye, also one that casts no shadow. No file has one.
  bool is_eye = false;

  bool is_point() const { return type == LightType::kPoint; }
  bool is_directional() const { return type == LightType::kDirectional; }
  bool has_area() const { return type == LightType::kArea; }
};

struct Scene {
  std::string name;
  NumberMeaning numbers = NumberMeaning::kDouble;
  bool two_sided = false;
  std::vector<Position> vertices;
  std::vector<Polygon> polygons;
  std::vector<Light> lights;
  std::string extra;  // the top-level "extra" object as JSON text, empty if none
  std::string file;   // where it was read from, for messages; not part of the scene

  bool is_two_sided(const Polygon& polygon) const { return polygon.two_sided.value_or(two_sided); }
};

}  // namespace gnomon

#endif  // GNOMON_SCENE_SCENE_H
