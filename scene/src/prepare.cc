// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/scene/prepare.h"

#include <fmt/format.h>

#include <algorithm>

#include "exact_int.h"
#include "gnomon/scene/grid.h"
#include "index_table.h"
#include "polygon_parts.h"
#include "prepare_lights.h"

namespace gnomon {
namespace {

using scene_detail::IndexTable;

Error index_error(const Scene& scene, std::size_t polygon, const std::string& where,
                  VertexId index) {
  Error error;
  error.code = ErrorCode::kIndex;
  error.where.file = scene.file;
  error.where.pointer = fmt::format("/polygons/{}/{}", polygon, where);
  error.what =
      fmt::format("polygon '{}': vertex {} does not exist", scene.polygons[polygon].id, index);
  error.expected = fmt::format("an index below {}", scene.vertices.size());
  return error;
}

/// Marks the vertices that loops and holes name; finds the size of the largest polygon.
Expected<std::size_t> mark_used(const Scene& scene, std::vector<std::uint8_t>& used) {
  std::size_t largest = 3;
  for (std::size_t p = 0; p < scene.polygons.size(); ++p) {
    const Polygon& polygon = scene.polygons[p];
    largest = std::max(largest, polygon.loop.size());
    for (const VertexId v : polygon.loop) {
      if (v >= used.size()) return tl::unexpected(index_error(scene, p, "loop", v));
      used[v] = 1;
    }
    for (std::size_t h = 0; h < polygon.holes.size(); ++h) {
      largest = std::max(largest, polygon.holes[h].size());
      for (const VertexId v : polygon.holes[h]) {
        if (v >= used.size()) {
          return tl::unexpected(index_error(scene, p, fmt::format("holes/{}", h), v));
        }
        used[v] = 1;
      }
    }
  }
  return largest;
}

/// Gives equal positions one number, in order of first use, and keeps one of each on the grid.
void weld(const Scene& scene, const std::vector<std::uint32_t>& inputs, ExactGrid& grid,
          PreparedScene& out) {
  IndexTable table(inputs.size());
  std::uint32_t count = 0;
  out.geometry.positions.reserve(inputs.size());
  const auto weld_by = [&](auto& coordinates) {
    using Coordinate = typename std::decay_t<decltype(coordinates)>::value_type;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      std::uint64_t hash = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        hash = scene_detail::hash_into(hash, coordinates[3 * i + k]);
      }
      hash *= 0x9e3779b97f4a7c15u;
      const std::uint32_t found = table.find_or_enter(hash, count, [&](std::uint32_t other) {
        const std::size_t o = 3 * std::size_t{other};
        return coordinates[o] == coordinates[3 * i] &&
               coordinates[o + 1] == coordinates[3 * i + 1] &&
               coordinates[o + 2] == coordinates[3 * i + 2];
      });
      out.vertex_of_input[inputs[i]] = found == IndexTable::kNone ? count : found;
      if (found != IndexTable::kNone) continue;
      // Distinct positions are gathered at the front of the same array: `count` never overtakes i.
      if (count != i) {
        for (std::size_t k = 0; k < 3; ++k) {
          coordinates[3 * std::size_t{count} + k] = Coordinate(coordinates[3 * i + k]);
        }
      }
      const Position& position = scene.vertices[inputs[i]];
      out.geometry.positions.push_back(
          {position[0].nearest(), position[1].nearest(), position[2].nearest()});
      ++count;
    }
    coordinates.resize(3 * std::size_t{count});
  };
  if (grid.is_narrow) {
    weld_by(grid.narrow);
    out.geometry.grid = GridPositions::from_narrow(std::move(grid.narrow));
  } else {
    weld_by(grid.wide);
    out.geometry.grid = GridPositions::from(std::move(grid.wide));
  }
}

}  // namespace

Expected<PreparedScene> prepare(const Scene& scene) {
  std::vector<std::uint8_t> used(scene.vertices.size());
  const Expected<std::size_t> largest = mark_used(scene, used);
  if (!largest) return tl::unexpected(largest.error());

  std::vector<std::uint32_t> inputs;
  std::vector<const Position*> points;
  points.reserve(scene.vertices.size());
  for (std::uint32_t v = 0; v < used.size(); ++v) {
    if (!used[v]) continue;
    inputs.push_back(v);
    points.push_back(&scene.vertices[v]);
  }
  for (const Light& light : scene.lights) {
    if (light.type == LightType::kPoint) points.push_back(&light.position);
    if (light.type == LightType::kArea) {
      for (const Position& position : light.loop) points.push_back(&position);
    }
  }
  ExactGrid grid = make_grid(points);

  PreparedScene out;
  out.position_bits = grid.bits;
  out.geometry.step = grid.step;
  out.geometry.origin = grid.origin;
  if (auto error = scene_detail::prepare_lights(scene, grid, inputs.size(), out)) {
    return tl::unexpected(std::move(*error));
  }
  out.vertex_of_input.assign(scene.vertices.size(), PreparedScene::kUnused);
  weld(scene, inputs, grid, out);

  // The smallest integers that hold every determinant. Int256 takes coordinates of up to 128 bits.
  const unsigned bits = scene_detail::bits_needed(out.geometry.grid.bits(), *largest);
  auto error = bits <= 127   ? scene_detail::make_parts<scene_detail::Int128>(scene, out)
               : bits <= 255 ? scene_detail::make_parts<scene_detail::Int256>(scene, out)
                             : scene_detail::make_parts<mpz_class>(scene, out);
  if (error) return tl::unexpected(std::move(*error));
  return out;
}

}  // namespace gnomon
