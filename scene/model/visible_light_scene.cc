// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/scene/visible_light_scene.h"

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "scene/base/vectors.h"

namespace gnomon {

namespace {

std::string ids_of_area_lights(const Scene& scene) {
  std::string ids;
  for (const Light& light : scene.lights) {
    if (light.has_area()) ids += (ids.empty() ? "" : ", ") + light.id;
  }
  return ids.empty() ? "a scene with an area light" : ids;
}

Expected<const Light*> chosen_light(const Scene& scene, std::string_view id) {
  const Light* chosen = nullptr;
  for (const Light& light : scene.lights) {
    if (id.empty() ? !light.has_area() : light.id != id) continue;
    if (chosen != nullptr) {
      return fail(ErrorCode::kId, "the scene has several area lights",
                  "one of: " + ids_of_area_lights(scene));
    }
    chosen = &light;
  }
  if (chosen == nullptr) {
    return fail(ErrorCode::kId,
                id.empty() ? "the scene has no area light" : "no light '" + std::string(id) + "'",
                ids_of_area_lights(scene));
  }
  if (!chosen->has_area()) {
    return fail(ErrorCode::kUsage, "light '" + std::string(id) + "' is no area light",
                ids_of_area_lights(scene));
  }
  return chosen;
}

using Vector = std::array<mpq_class, 3>;

/// The plane of a polygon by three of its vertices, counter-clockwise seen from the side.
Expected<RegionPlane> plane_of(const Scene& scene, const Polygon& polygon, Side side) {
  const auto from_first = [&](std::size_t i) {
    const Position &point = scene.vertices[polygon.loop[i]],
                   &first = scene.vertices[polygon.loop[0]];
    Vector difference;
    for (std::size_t k = 0; k < 3; ++k) difference[k] = point[k].exact() - first[k].exact();
    return difference;
  };
  const std::size_t size = polygon.loop.size();
  Vector area{0, 0, 0};
  for (std::size_t i = 1; i + 1 < size; ++i) {
    const Vector own = cross(from_first(i), from_first(i + 1));
    for (std::size_t k = 0; k < 3; ++k) area[k] += own[k];
  }
  for (std::size_t i = 1; i < size; ++i) {
    if (dot(area, from_first(i)) != 0) {
      return fail(ErrorCode::kGeometry, "polygon '" + polygon.id + "' is not planar",
                  "a receiver in one plane");
    }
  }
  for (std::size_t i = 1; i + 1 < size; ++i) {
    if (dot(area, cross(from_first(i), from_first(i + 1))) <= 0) continue;
    const auto& at = scene.vertices;
    RegionPlane plane{at[polygon.loop[0]], at[polygon.loop[i]], at[polygon.loop[i + 1]]};
    if (side == Side::kBack) std::swap(plane[1], plane[2]);
    return plane;
  }
  return fail(ErrorCode::kGeometry, "polygon '" + polygon.id + "' has no area",
              "a receiver with a plane");
}

void turn_round(std::vector<VertexId>& loop) { std::ranges::reverse(loop); }

}  // namespace

Expected<Scene> visible_light_scene(const Scene& scene, const LightSight& sight) {
  const Expected<const Light*> chosen = chosen_light(scene, sight.light);
  if (!chosen) return tl::unexpected(chosen.error());
  Scene seen;
  seen.name = scene.name;
  seen.numbers = scene.numbers;
  seen.two_sided = scene.two_sided;
  seen.vertices = scene.vertices;

  Polygon receiver;
  receiver.id = (*chosen)->id;
  const auto is_taken = [&](const Polygon& polygon) { return polygon.id == receiver.id; };
  while (std::ranges::any_of(scene.polygons, is_taken)) receiver.id += "-light";
  receiver.two_sided = false;
  receiver.casts = false;
  for (const Position& corner : (*chosen)->loop) {
    receiver.loop.push_back(static_cast<VertexId>(seen.vertices.size()));
    seen.vertices.push_back(corner);
  }
  seen.polygons.push_back(std::move(receiver));
  for (const Polygon& polygon : scene.polygons) {
    if (!polygon.casts) continue;
    Polygon& turned = seen.polygons.emplace_back(polygon);
    turn_round(turned.loop);
    std::ranges::for_each(turned.holes, turn_round);
  }

  Light eye;
  eye.id = "eye";
  eye.position = sight.point;
  if (!sight.receiver.empty()) {
    const auto on = std::ranges::find(scene.polygons, sight.receiver, &Polygon::id);
    if (on == scene.polygons.end()) {
      return fail(ErrorCode::kId, "no polygon '" + sight.receiver + "'", "the id of a polygon");
    }
    auto plane = plane_of(scene, *on, sight.side);
    if (!plane) return tl::unexpected(std::move(plane.error()));
    eye.region.push_back(*std::move(plane));
  }
  seen.lights.push_back(std::move(eye));
  return seen;
}

}  // namespace gnomon
