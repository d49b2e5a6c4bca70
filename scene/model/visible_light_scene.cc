// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/scene/visible_light_scene.h"

#include <algorithm>
#include <string>
#include <utility>

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

void turn_round(std::vector<VertexId>& loop) { std::ranges::reverse(loop); }

}  // namespace

Expected<Scene> visible_light_scene(const Scene& scene, std::string_view light,
                                    const Position& point) {
  const Expected<const Light*> chosen = chosen_light(scene, light);
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
  eye.position = point;
  seen.lights.push_back(std::move(eye));
  return seen;
}

}  // namespace gnomon
