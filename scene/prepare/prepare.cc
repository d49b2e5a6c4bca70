// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/scene/prepare.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <optional>
#include <span>

#include "gnomon/scene/grid.h"
#include "gnomon/scene/prepare_control.h"
#include "scene/base/exact_int.h"
#include "scene/base/large_pages.h"
#include "scene/base/parallel.h"
#include "scene/base/prefetch.h"
#include "scene/geometry/numbering.h"
#include "scene/prepare/polygon_parts.h"
#include "scene/prepare/prepare_lights.h"
#include "scene/prepare/prepare_regions.h"

namespace gnomon {
namespace {

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

/// Corners of polygons, those of their holes and two more a hole, for its bridge, included.
struct Corners {
  std::size_t most = 3;  // of one
  std::size_t all = 0;

  void add(const Corners& other) {
    most = std::max(most, other.most);
    all += other.all;
  }
};

/// What a run of polygons says about vertices.
struct VertexUse {
  Corners corners;
  std::optional<Error> error;  // the first
};

VertexUse mark_used_by(const Scene& scene, std::size_t begin, std::size_t end,
                       std::vector<std::uint8_t>& used) {
  constexpr std::size_t kAhead = 8;
  VertexUse result;
  std::size_t p = begin;
  const auto mark = [&](const std::vector<VertexId>& ring, auto where) {
    for (const VertexId v : ring) {
      if (v >= used.size()) {
        result.error = index_error(scene, p, where(), v);
        return false;
      }
      // Other runs set the same marks.
      const std::atomic_ref<std::uint8_t> mark_of_vertex(used[v]);
      if (mark_of_vertex.load(std::memory_order_relaxed) == 0) {
        mark_of_vertex.store(1, std::memory_order_relaxed);
      }
    }
    return true;
  };
  for (; p < end; ++p) {
    if (p + kAhead < end) scene_detail::prefetch(scene.polygons[p + kAhead].loop.data());
    const Polygon& polygon = scene.polygons[p];
    const std::size_t corners = scene_detail::corners_of(polygon);
    if (!mark(polygon.loop, [] { return std::string("loop"); })) return result;
    for (std::size_t h = 0; h < polygon.holes.size(); ++h) {
      if (!mark(polygon.holes[h], [&] { return fmt::format("holes/{}", h); })) return result;
    }
    result.corners.add({corners, corners});
  }
  return result;
}

/// Marks the vertices that loops and holes name, and counts corners.
Expected<Corners> mark_used(const Scene& scene, std::vector<std::uint8_t>& used) {
  Corners corners;
  for (VertexUse& piece :
       scene_detail::map_pieces(scene.polygons.size(), scene_detail::kPieceOfPolygons,
                                [&](std::size_t begin, std::size_t end) {
                                  return mark_used_by(scene, begin, end, used);
                                })) {
    if (piece.error) return tl::unexpected(std::move(*piece.error));
    corners.add(piece.corners);
  }
  return corners;
}

/// Gives equal positions one number, in order of first use, and keeps one of each. The grid starts
/// with the points `inputs`, which are vertices of the scene.
void weld(const Scene& scene, std::span<const Position* const> inputs, ExactGrid& grid,
          PreparedScene& out) {
  const auto weld_by = [&](auto& coordinates) {
    using Coordinates = std::decay_t<decltype(coordinates)>;
    const auto hash = [&](std::size_t i) {
      std::uint64_t result = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        result = scene_detail::hash_into(result, coordinates[3 * i + k]);
      }
      return result;
    };
    const auto equal = [&](std::size_t i, std::size_t j) {
      return coordinates[3 * i] == coordinates[3 * j] &&
             coordinates[3 * i + 1] == coordinates[3 * j + 1] &&
             coordinates[3 * i + 2] == coordinates[3 * j + 2];
    };
    const scene_detail::Numbering vertices(inputs.size(), hash, equal);
    scene_detail::for_each_index(inputs.size(), [&](std::size_t i) {
      out.vertex_of_input[static_cast<std::size_t>(inputs[i] - scene.vertices.data())] =
          vertices[i];
    });
    if (vertices.count() == inputs.size()) {
      coordinates.resize(3 * inputs.size());
    } else {
      Coordinates distinct(3 * std::size_t{vertices.count()});
      vertices.for_each_first([&](std::size_t i, std::size_t vertex) {
        for (std::size_t k = 0; k < 3; ++k) {
          distinct[3 * vertex + k] = std::move(coordinates[3 * i + k]);
        }
      });
      coordinates = std::move(distinct);
    }
    scene_detail::resize_in_large_pages(out.geometry.positions, vertices.count());
    vertices.for_each_first([&](std::size_t i, std::size_t vertex) {
      const Position& position = *inputs[i];
      out.geometry.positions[vertex] = {position[0].nearest(), position[1].nearest(),
                                        position[2].nearest()};
    });
  };
  if (grid.is_narrow) {
    weld_by(grid.narrow);
    out.geometry.grid = GridPositions::from_narrow(std::move(grid.narrow));
  } else {
    weld_by(grid.wide);
    out.geometry.grid = GridPositions::from(std::move(grid.wide));
  }
}

/// Calls f with an integer type that holds every determinant of the scene. Int256 takes coordinates
/// of up to 128 bits.
template <class F>
auto with_integers(const PreparedScene& out, std::size_t most_corners, const F& f) {
  const unsigned bits = scene_detail::bits_needed(out.geometry.grid.bits(), most_corners);
  if (bits <= 64) return f(std::int64_t{});
  if (bits <= 128) return f(scene_detail::Int128{});
  if (bits <= 256) return f(scene_detail::Int256{});
  return f(mpz_class{});
}

/// The grid starts at the lower corner of all points. A lamp far beyond the vertices, which are the
/// first `inputs` points, would give their coordinates as many bits as its own: then it starts at
/// the corner of the vertices, and lamps may be below it. Requires: lights are prepared, and none
/// has an area or a region.
void start_at_vertices(std::size_t inputs, ExactGrid& grid, PreparedScene& out) {
  constexpr unsigned kFarBits = 12;  // as LightIntegers::kFarBits of kernel `plane`
  std::array<mpz_class, 3> low, high;
  const auto find_box = [&](const auto& coordinates) {
    for (std::size_t k = 0; k < 3; ++k) {
      auto least = coordinates[k], most = coordinates[k];
      for (std::size_t i = k; i < 3 * inputs; i += 3) {
        if (coordinates[i] < least) least = coordinates[i];
        if (most < coordinates[i]) most = coordinates[i];
      }
      low[k] = least;
      high[k] = most;
    }
  };
  if (grid.is_narrow) {
    find_box(grid.narrow);
  } else {
    find_box(grid.wide);
  }
  unsigned bits = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const mpz_class size = high[k] - low[k];
    if (size != 0)
      bits = std::max(bits, static_cast<unsigned>(mpz_sizeinbase(size.get_mpz_t(), 2)));
  }
  if (bits + kFarBits > grid.bits) return;
  std::vector<mpz_class> wide;
  std::vector<std::int64_t> narrow;
  const bool is_narrow = bits <= GridPositions::kNarrowBits;
  for (std::size_t i = 0; i < 3 * inputs; ++i) {
    mpz_class moved = grid.at(i / 3, static_cast<int>(i % 3)) - low[i % 3];
    if (is_narrow) {
      narrow.push_back(moved.get_si());
    } else {
      wide.push_back(std::move(moved));
    }
  }
  grid.is_narrow = is_narrow;
  grid.narrow = std::move(narrow);
  grid.wide = std::move(wide);
  grid.bits = bits;
  for (std::size_t k = 0; k < 3; ++k) {
    out.geometry.origin[k] += out.geometry.step * low[k];
    for (PreparedLight& light : out.lights) {
      if (!light.is_directional()) light.point.grid[k] -= low[k];
    }
  }
}

/// Positions on their grid, and the lights if they are wanted.
/// `region_points`: gets those of all regions of lights, on the grid.
Expected<Corners> prepare_positions(const Scene& scene, bool with_lights, PreparedScene& out,
                                    std::vector<scene_detail::GridPoint>& region_points) {
  std::vector<const Position*> points;
  std::vector<std::uint8_t> used(scene.vertices.size());
  const Expected<Corners> corners = mark_used(scene, used);
  if (!corners) return corners;
  std::size_t most = scene.vertices.size();
  for (const Light& light : scene.lights) {
    most += (light.is_point() ? 1 : light.loop.size()) + 3 * light.region.size();
  }
  scene_detail::reserve_in_large_pages(points, most);
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (used[v] != 0) points.push_back(&scene.vertices[v]);
  }
  used = {};
  const std::size_t inputs = points.size();
  for (const Light& light : scene.lights) {
    if (!with_lights) break;
    if (light.is_point()) points.push_back(&light.position);
    if (light.has_area()) {
      for (const Position& position : light.loop) points.push_back(&position);
    }
  }
  const std::size_t regions = points.size();
  for (const Light& light : scene.lights) {
    if (!with_lights) break;
    for (const RegionPlane& plane : light.region) {
      for (const Position& position : plane) points.push_back(&position);
    }
  }
  ExactGrid grid = make_grid(points);
  out.position_bits = grid.bits;
  out.geometry.step = grid.step;
  out.geometry.origin = grid.origin;
  if (with_lights) {
    if (auto error = scene_detail::prepare_lights(scene, grid, inputs, out)) {
      return tl::unexpected(std::move(*error));
    }
    // Points of regions may lie anywhere, and are on the grid of all points.
    const auto needs_all = [](const Light& light) {
      return light.has_area() || !light.region.empty();
    };
    if (inputs > 0 && std::ranges::none_of(scene.lights, needs_all)) {
      start_at_vertices(inputs, grid, out);
    }
  }
  region_points = scene_detail::grid_points(grid, regions);
  scene_detail::reserve_in_large_pages(out.vertex_of_input, scene.vertices.size());
  out.vertex_of_input.assign(scene.vertices.size(), PreparedScene::kUnused);
  weld(scene, std::span(points).first(inputs), grid, out);
  return corners;
}

}  // namespace

Expected<PreparedScene> prepare(const Scene& scene) { return prepare(scene, PrepareControl{}); }

Expected<PreparedScene> prepare(const Scene& scene, const PrepareControl& control) {
  PreparedScene out;
  std::vector<scene_detail::GridPoint> region_points;
  const Expected<Corners> corners = prepare_positions(scene, true, out, region_points);
  if (!corners) return tl::unexpected(corners.error());
  scene_detail::SceneWatch watch(control, corners->all);
  auto error = with_integers(out, corners->most, [&]<class Int>(const Int&) {
    return scene_detail::make_parts<Int>(scene, watch, out);
  });
  if (!error) error = scene_detail::prepare_regions(scene, region_points, out);
  if (error) return tl::unexpected(std::move(*error));
  return out;
}

Expected<std::vector<PolygonProblem>> unusable_polygons(const Scene& scene) {
  PreparedScene out;
  std::vector<scene_detail::GridPoint> no_region;
  const Expected<Corners> corners = prepare_positions(scene, false, out, no_region);
  if (!corners) return tl::unexpected(corners.error());
  const PrepareControl control;
  scene_detail::SceneWatch watch(control, corners->all);
  return with_integers(out, corners->most, [&]<class Int>(const Int&) {
    return scene_detail::find_problems<Int>(scene, watch, out);
  });
}

}  // namespace gnomon
