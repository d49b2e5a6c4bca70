// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/scene/scene_steps.h"

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "fuzz/scene/scene_coordinates.h"

namespace gnomon::fuzz {

namespace {

constexpr std::size_t kFewestCorners = 3;

template <class Change>
void for_each_loop(Scene& scene, const Change& change) {
  for (Polygon& polygon : scene.polygons) {
    change(polygon.loop);
    for (auto& hole : polygon.holes) change(hole);
  }
}

void drop_repeated_corners(std::vector<VertexId>& loop) {
  std::vector<VertexId> kept;
  for (const VertexId vertex : loop) {
    if (kept.empty() || kept.back() != vertex) kept.push_back(vertex);
  }
  while (kept.size() > 1 && kept.front() == kept.back()) kept.pop_back();
  if (kept.size() >= kFewestCorners) loop = std::move(kept);
}

/// False if a number is none as a double.
bool to_doubles(Scene& scene) {
  scene.numbers = NumberMeaning::kDouble;
  for (Position* position : points_of(scene)) {
    for (Number& number : *position) {
      const double value = number.nearest();
      if (!std::isfinite(value)) return false;
      number = Number(value);
    }
  }
  return true;
}

std::string polygon_name(std::size_t index) {
  constexpr std::size_t kLetters = 26;
  std::string name;
  for (std::size_t rest = index + 1; rest > 0; rest = (rest - 1) / kLetters) {
    name.insert(name.begin(), static_cast<char>('a' + (rest - 1) % kLetters));
  }
  return name;
}

std::string light_name(LightType type) {
  switch (type) {
    case LightType::kPoint:
      return "lamp";
    case LightType::kDirectional:
      return "sun";
    case LightType::kArea:
      return "panel";
  }
  return {};
}

}  // namespace

Scene without_unused_vertices(Scene scene) {
  constexpr VertexId kUnused = std::numeric_limits<VertexId>::max();
  std::vector<VertexId> place(scene.vertices.size(), kUnused);
  for_each_loop(scene, [&](const std::vector<VertexId>& loop) {
    for (const VertexId vertex : loop) place[vertex] = 0;
  });
  std::vector<Position> kept;
  for (std::size_t i = 0; i < place.size(); ++i) {
    if (place[i] == kUnused) continue;
    place[i] = static_cast<VertexId>(kept.size());
    kept.push_back(std::move(scene.vertices[i]));
  }
  scene.vertices = std::move(kept);
  for_each_loop(scene, [&](std::vector<VertexId>& loop) {
    for (VertexId& vertex : loop) vertex = place[vertex];
  });
  return scene;
}

Scene tidied(const Scene& scene) {
  Scene result = scene;
  std::map<std::array<mpq_class, 3>, VertexId> first;
  std::vector<VertexId> same(result.vertices.size());
  for (std::size_t i = 0; i < result.vertices.size(); ++i) {
    const Position& at = result.vertices[i];
    same[i] =
        first.try_emplace({at[0].exact(), at[1].exact(), at[2].exact()}, static_cast<VertexId>(i))
            .first->second;
  }
  for_each_loop(result, [&](std::vector<VertexId>& loop) {
    for (VertexId& vertex : loop) vertex = same[vertex];
    drop_repeated_corners(loop);
  });
  return without_unused_vertices(std::move(result));
}

Scene with_joined_vertices(Scene scene, VertexId from, VertexId to) {
  for_each_loop(scene, [&](std::vector<VertexId>& loop) {
    for (VertexId& vertex : loop) {
      if (vertex == from) vertex = to;
    }
    drop_repeated_corners(loop);
  });
  return scene;
}

std::uint64_t flags_of(const Scene& scene) {
  std::uint64_t count = (scene.two_sided ? 1 : 0) + (scene.extra.empty() ? 0 : 1) +
                        (scene.numbers == NumberMeaning::kDecimal ? 1 : 0);
  for (const Polygon& polygon : scene.polygons) {
    count += (polygon.two_sided ? 1 : 0) + (polygon.casts ? 0 : 1);
  }
  for (const Light& light : scene.lights) count += light.intensity == Number(1.0) ? 0 : 1;
  return count;
}

Scene with_default_flags(Scene scene) {
  Scene result = std::move(scene);
  for (std::size_t i = 0; i < flag_steps(result); ++i)
    result = with_flag_step(std::move(result), i);
  return result;
}

std::size_t flag_steps(const Scene& scene) {
  constexpr std::size_t kOfScene = 3, kOfPolygon = 2;
  return kOfScene + kOfPolygon * scene.polygons.size() + scene.lights.size();
}

Scene with_flag_step(Scene scene, std::size_t step) {
  if (step == 0) {
    scene.extra.clear();
    return scene;
  }
  if (step == 1) {
    scene.two_sided = false;
    return scene;
  }
  if (step == 2) {
    Scene doubles = scene;
    return scene.numbers == NumberMeaning::kDecimal && to_doubles(doubles) ? doubles : scene;
  }
  step -= 3;
  if (step < scene.polygons.size()) {
    scene.polygons[step].two_sided.reset();
    return scene;
  }
  step -= scene.polygons.size();
  if (step < scene.polygons.size()) {
    scene.polygons[step].casts = true;
    return scene;
  }
  step -= scene.polygons.size();
  scene.lights[step].intensity = Number(1.0);
  return scene;
}

Scene with_short_names(Scene scene) {
  for (std::size_t i = 0; i < scene.polygons.size(); ++i) scene.polygons[i].id = polygon_name(i);
  std::map<LightType, std::size_t> count, next;
  for (const Light& light : scene.lights) ++count[light.type];
  for (Light& light : scene.lights) {
    light.id = light_name(light.type);
    if (count[light.type] > 1) light.id += std::to_string(++next[light.type]);
  }
  return scene;
}

std::uint64_t long_names_of(const Scene& scene) {
  const Scene short_names = with_short_names(scene);
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < scene.polygons.size(); ++i) {
    if (scene.polygons[i].id != short_names.polygons[i].id) ++count;
  }
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    if (scene.lights[i].id != short_names.lights[i].id) ++count;
  }
  return count;
}

}  // namespace gnomon::fuzz
