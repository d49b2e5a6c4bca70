// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/scene/validate.h"

#include <bit>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scene/base/text_file.h"

namespace gnomon {

namespace {

constexpr std::size_t kFewestLoopVertices = 3;

tl::unexpected<Error> offence(const Scene& scene, ErrorCode code, std::string what,
                              std::string expected, std::string pointer) {
  return fail(code, std::move(what), std::move(expected),
              ErrorPlace{scene.file, 0, 0, std::move(pointer)});
}

/// The first element whose id an earlier one has, and that earlier one. An open hash table of
/// indices: the ids stay where they are, and a million of them cost 8 to 16 MB.
template <class Element>
std::optional<std::pair<std::size_t, std::size_t>> first_collision(
    const std::vector<Element>& elements) {
  const std::size_t slots = std::bit_ceil(2 * elements.size() + 1);
  std::vector<std::uint32_t> table(slots, 0);  // index + 1, 0 is empty
  for (std::size_t i = 0; i < elements.size(); ++i) {
    std::size_t slot = std::hash<std::string_view>{}(elements[i].id) & (slots - 1);
    while (table[slot] != 0) {
      const std::size_t other = table[slot] - 1;
      if (elements[other].id == elements[i].id) return std::pair(i, other);
      slot = (slot + 1) & (slots - 1);
    }
    table[slot] = static_cast<std::uint32_t>(i + 1);
  }
  return std::nullopt;
}

template <class Element>
Expected<void> check_ids(const Scene& scene, const std::vector<Element>& elements,
                         const std::string& list) {
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (is_valid_id(elements[i].id)) continue;
    const std::string pointer = list + "/" + std::to_string(i) + "/id";
    if (elements[i].id.empty()) {
      return offence(scene, ErrorCode::kId, "an empty id", "at least one character", pointer);
    }
    return offence(scene, ErrorCode::kId,
                   "the id " + quoted_text(elements[i].id) + " holds '#' or a control character",
                   "an id without them", pointer);
  }
  if (const auto collision = first_collision(elements)) {
    const auto [index, other] = *collision;
    return offence(scene, ErrorCode::kId,
                   "the id " + quoted_text(elements[index].id) + " is that of " + list + "/" +
                       std::to_string(other),
                   "ids that differ (a missing id is the index)",
                   list + "/" + std::to_string(index) + "/id");
  }
  return {};
}

Expected<void> check_indices(const Scene& scene, const std::vector<VertexId>& loop,
                             const std::function<std::string()>& pointer) {
  for (std::size_t k = 0; k < loop.size(); ++k) {
    if (loop[k] < scene.vertices.size()) continue;
    const std::string bound = scene.vertices.empty()
                                  ? "a scene with vertices"
                                  : "0 to " + std::to_string(scene.vertices.size() - 1);
    return offence(scene, ErrorCode::kIndex,
                   "index " + std::to_string(loop[k]) + " is not that of a vertex", bound,
                   pointer() + "/" + std::to_string(k));
  }
  return {};
}

}  // namespace

bool is_valid_id(std::string_view id) {
  for (std::size_t at = 0; at < id.size(); ++at) {
    const auto byte = static_cast<unsigned char>(id[at]);
    if (byte < 0x20 || byte == 0x7F || byte == '#') return false;
    // U+0080 to U+009F, the other control characters.
    if (byte == 0xC2 && at + 1 < id.size() && static_cast<unsigned char>(id[at + 1]) < 0xA0) {
      return false;
    }
  }
  return !id.empty();
}

Expected<void> validate_lights(const Scene& scene) {
  if (auto ids = check_ids(scene, scene.lights, "/lights"); !ids) return ids;
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const Light& light = scene.lights[i];
    const std::string pointer = "/lights/" + std::to_string(i);
    const Position& to_light = light.position;
    if (light.is_directional() && to_light[0].is_zero() && to_light[1].is_zero() &&
        to_light[2].is_zero()) {
      return offence(scene, ErrorCode::kGeometry, "the direction to the light is (0, 0, 0)",
                     "a vector that is not 0", pointer + "/to_light");
    }
    if (light.has_area() && light.loop.size() < kFewestLoopVertices) {
      return offence(scene, ErrorCode::kFormat,
                     "a loop of " + std::to_string(light.loop.size()) + " points",
                     "at least 3 points", pointer + "/loop");
    }
    if (light.intensity.sign() < 0) {
      return offence(scene, ErrorCode::kFormat, "a negative intensity", "0 or more",
                     pointer + "/intensity");
    }
  }
  return {};
}

Expected<void> validate_scene(const Scene& scene) {
  if (auto ids = check_ids(scene, scene.polygons, "/polygons"); !ids) return ids;
  for (std::size_t i = 0; i < scene.polygons.size(); ++i) {
    const Polygon& polygon = scene.polygons[i];
    const auto pointer = [&] { return "/polygons/" + std::to_string(i) + "/loop"; };
    if (polygon.loop.size() < kFewestLoopVertices) {
      return offence(scene, ErrorCode::kFormat,
                     "a loop of " + std::to_string(polygon.loop.size()) + " vertices",
                     "at least 3 vertices", pointer());
    }
    auto loop = check_indices(scene, polygon.loop, pointer);
    if (!loop) return loop;
    // A hole of two vertices or none has no area, and preparation drops it.
    for (std::size_t h = 0; h < polygon.holes.size(); ++h) {
      auto hole = check_indices(scene, polygon.holes[h], [&] {
        return "/polygons/" + std::to_string(i) + "/holes/" + std::to_string(h);
      });
      if (!hole) return hole;
    }
  }
  return validate_lights(scene);
}

}  // namespace gnomon
