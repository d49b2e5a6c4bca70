// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/shading_mesh/fragment_faces.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace gnomon {
namespace {

struct Given {
  MeshFace face;
  std::span<const std::array<mpq_class, 3>> loop;  // empty: the part's own
};

bool is_of_all_lights(const ShadowResult& result) {
  return result.lights.size() > 1 || !result.combined.empty();
}

void add_combined(const ShadowResult& result, std::vector<Given>& given) {
  for (const CombinedFragment& fragment : result.combined) {
    given.push_back({{fragment.part, fragment.side, fragment.lit_by, fragment.penumbra_of, 0, 0},
                     {result.combined_exact_points.data() + fragment.first, fragment.count}});
  }
}

void add_fragments(const LightResult& light, std::vector<Given>& given) {
  for (const PartResult& part : light.parts) {
    if (part.reason != ShadowReason::kNone) continue;
    for (std::uint32_t i = 0; i < part.fragment_count; ++i) {
      const Fragment& fragment = light.fragments[part.first_fragment + i];
      given.push_back({{part.part, part.side, fragment.state == LightState::kLit ? 1u : 0u,
                        fragment.state == LightState::kPenumbra ? 1u : 0u, 0, 0},
                       {light.exact_points.data() + fragment.first, fragment.count}});
    }
  }
}

/// Adds the sides that no light shines on.
void add_dark_sides(const PreparedScene& scene, std::vector<Given>& given) {
  std::vector<std::uint8_t> seen(2 * scene.parts.size(), 0);
  for (const Given& one : given) {
    seen[2 * one.face.part + (one.face.side == Side::kBack ? 1 : 0)] = 1;
  }
  for (std::uint32_t part = 0; part < scene.parts.size(); ++part) {
    if (seen[2 * part] == 0) given.push_back({{part, Side::kFront, 0, 0, 0, 0}, {}});
    if (scene.parts[part].two_sided && seen[2 * part + 1] == 0) {
      given.push_back({{part, Side::kBack, 0, 0, 0, 0}, {}});
    }
  }
}

std::vector<Given> given_faces(const PreparedScene& scene, const ShadowResult& result) {
  std::vector<Given> given;
  if (is_of_all_lights(result)) {
    add_combined(result, given);
  } else {
    add_fragments(result.lights[0], given);
  }
  add_dark_sides(scene, given);
  std::stable_sort(given.begin(), given.end(), [](const Given& a, const Given& b) {
    if (a.face.part != b.face.part) return a.face.part < b.face.part;
    return a.face.side != b.face.side && a.face.side == Side::kFront;
  });
  return given;
}

std::vector<ExactPoint> exact_loop(const PreparedScene& scene, const Given& given) {
  std::vector<ExactPoint> loop;
  if (!given.loop.empty()) {
    for (const auto& point : given.loop) loop.push_back(exact_point(point));
    return loop;
  }
  const Geometry& geometry = scene.geometry;
  for (const VertexId vertex : scene.loop(scene.parts[given.face.part])) {
    std::array<mpq_class, 3> point;
    for (int k = 0; k < 3; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      point[axis] = geometry.origin[axis] + geometry.step * geometry.grid.at(vertex, k);
    }
    loop.push_back(exact_point(point));
  }
  if (given.face.side == Side::kBack) std::reverse(loop.begin(), loop.end());
  return loop;
}

}  // namespace

Expected<void> check_result(const ShadowResult& result) {
  if (!result.exact) {
    return fail(ErrorCode::kUsage, "kernel " + result.kernel + " rounds: its fragments do not fit",
                "the result of an exact kernel");
  }
  if (result.lights.empty() || result.lights.size() > 64) {
    return fail(ErrorCode::kUsage, std::to_string(result.lights.size()) + " lights to shade by",
                "1 to 64");
  }
  const bool has_points = is_of_all_lights(result) ? !result.combined_exact_points.empty()
                                                   : result.lights[0].fragments.empty() ||
                                                         !result.lights[0].exact_points.empty();
  if (!has_points) {
    return fail(ErrorCode::kUsage,
                "the result has no exact points of fragments that are shared "
                "by all lights",
                "ShadowOptions::keep_exact_points, and combined for several lights");
  }
  return {};
}

FaceLoops fragment_faces(const PreparedScene& scene, const ShadowResult& result,
                         PointTable& points) {
  const std::vector<Given> given = given_faces(scene, result);
  std::vector<std::vector<NewPoint>> made(given.size());
  tbb::parallel_for(std::size_t{0}, given.size(), [&](std::size_t i) {
    for (ExactPoint& point : exact_loop(scene, given[i])) {
      made[i].push_back(new_point(std::move(point)));
    }
  });
  FaceLoops loops;
  std::vector<std::uint32_t> loop;
  for (std::size_t i = 0; i < given.size(); ++i) {
    loop.clear();
    for (NewPoint& point : made[i]) loop.push_back(points.insert(std::move(point)));
    loops.add(given[i].face, loop);
  }
  return loops;
}

}  // namespace gnomon
