// SPDX-License-Identifier: GPL-3.0-or-later
// Closed solids made of the cells of a lattice, as they are or sheared, and what loops of their
// ridge edges are judged by: the shadow on a floor, as an exact kernel finds it.
#ifndef GNOMON_TESTS_ALGORITHMS_SOLID_CELLS_H
#define GNOMON_TESTS_ALGORITHMS_SOLID_CELLS_H

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "exact_check.h"
#include "gnomon/algorithms/ridge_loops.h"
#include "scene/base/random.h"

namespace gnomon::test {

using Cell = std::array<int, 3>;
using Whole = std::array<std::int64_t, 3>;
using Map = std::function<Whole(const Whole&)>;

inline Position at(const Whole& p) {
  return {Number(static_cast<double>(p[0])), Number(static_cast<double>(p[1])),
          Number(static_cast<double>(p[2]))};
}

/// The surface of a set of cells of a lattice, a square for each face between a cell of the set and
/// one outside, all looking outwards; moved by `map`, which keeps faces planar and orientation.
class Cells {
 public:
  void add(const Cell& cell) { cells_[cell] = true; }
  void add_box(const Cell& from, const Cell& to) {
    for (int x = from[0]; x < to[0]; ++x) {
      for (int y = from[1]; y < to[1]; ++y) {
        for (int z = from[2]; z < to[2]; ++z) add({x, y, z});
      }
    }
  }
  void remove(const Cell& cell) { cells_.erase(cell); }
  bool has(const Cell& cell) const { return cells_.contains(cell); }
  const std::map<Cell, bool>& all() const { return cells_; }

  Scene surface(const Map& map) const {
    Scene scene;
    std::map<Whole, VertexId> vertices;
    const auto vertex = [&](const Whole& corner) {
      const auto [place, is_new] =
          vertices.try_emplace(corner, static_cast<VertexId>(scene.vertices.size()));
      if (is_new) scene.vertices.push_back(at(map(corner)));
      return place->second;
    };
    for (const auto& [cell, present] : cells_) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const int side : {0, 1}) {
          Cell beyond = cell;
          beyond[axis] += side == 1 ? 1 : -1;
          if (has(beyond)) continue;
          const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
          Polygon polygon;
          polygon.id = std::to_string(scene.polygons.size());
          for (const auto& [du, dv] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
            Whole corner{cell[0], cell[1], cell[2]};
            corner[axis] += side;
            corner[u] += du;
            corner[v] += dv;
            polygon.loop.push_back(vertex(corner));
          }
          if (side == 0) std::ranges::reverse(polygon.loop);
          scene.polygons.push_back(std::move(polygon));
        }
      }
    }
    return scene;
  }

 private:
  std::map<Cell, bool> cells_;
};

inline Whole same(const Whole& p) { return p; }

inline Light sun(const Whole& to_light) {
  Light light;
  light.id = "light";
  light.type = LightType::kDirectional;
  light.position = at(to_light);
  return light;
}

inline Light lamp(const Whole& place) {
  Light light;
  light.id = "light";
  light.position = at(place);
  return light;
}

/// Twice the signed area of directions where their third coordinate is 1. Requires: it is positive.
inline mpq_class doubled_area(const std::vector<std::array<mpz_class, 3>>& rays) {
  mpq_class sum = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto &a = rays[i], &b = rays[i + 1 == rays.size() ? 0 : i + 1];
    mpq_class term(a[0] * b[1] - a[1] * b[0], a[2] * b[2]);
    term.canonicalize();
    sum += term;
  }
  return sum;
}

inline mpq_class doubled_area(const RidgeLoops& loops, const RidgeLoop& loop) {
  std::vector<std::array<mpz_class, 3>> rays;
  for (const LoopStep& step : loop.steps) rays.push_back(loops.rays[step.ray]);
  return doubled_area(rays);
}

/// Cells that hang together, some in a row, some around holes.
inline Cells random_cells(Random& random) {
  Cells cells;
  Cell at{0, 0, 0};
  const auto count = random.between(2, 24);
  for (std::int64_t i = 0; i < count; ++i) {
    cells.add(at);
    const auto axis = static_cast<std::size_t>(random.below(3));
    at[axis] = std::clamp(at[axis] + (random.chance(1, 2) ? 1 : -1), -2, 2);
  }
  return cells;
}

/// An affine map with integer entries and a positive determinant: the identity times 8, sheared.
inline Map random_map(Random& random, bool generic) {
  std::array<std::int64_t, 9> m{8, 0, 0, 0, 8, 0, 0, 0, 8};
  if (generic) {
    for (std::int64_t& entry : m) entry += random.between(-2, 2);
  }
  return [m](const Whole& p) {
    Whole q{};
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 3; ++c) q[r] += m[3 * r + c] * p[c];
    }
    return q;
  };
}

/// Steep, so that the shadow stays near and the chart is that of a floor.
inline Light steep_light(Random& random) {
  if (random.chance(1, 2)) {
    return sun({random.between(-6, 6), random.between(-6, 6), random.between(7, 12)});
  }
  return lamp({random.between(-40, 40), random.between(-40, 40), random.between(60, 90)});
}

/// Twice the area of all directions that a scene's solids hide from its light, a steep one, where
/// their third coordinate is 1: from the shadow on a floor far enough below.
inline mpq_class shadow_of(Scene scene) {
  constexpr double kHalf = 1 << 16, kBelow = -64;
  const auto first = static_cast<VertexId>(scene.vertices.size());
  for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
    scene.vertices.push_back({Number(x * kHalf), Number(y * kHalf), Number(kBelow)});
  }
  Polygon floor;
  floor.id = "floor";
  floor.loop = {first, first + 1, first + 2, first + 3};
  const auto solid = Case::make(scene);
  scene.polygons.push_back(floor);
  const auto floored = Case::make(scene);
  const mpq_class lit = lit_fraction_of(*floored, options_for(KernelId::kPlane), "light", "floor");
  const mpq_class shadow = (1 - lit) * mpq_class(4 * kHalf * kHalf);
  // From the floor to the chart: a sun's is across z, times its height, in steps of the grid; a
  // lamp's directions are cut at height 1.
  const LightPoint& light = solid->prepared().lights[0].point;
  const mpq_class scale = light.directional
                              ? mpq_class(solid->prepared().geometry.step / light.grid[2])
                              : mpq_class(scene.lights[0].position[2].nearest() - kBelow);
  return 2 * shadow / (scale * scale);
}

}  // namespace gnomon::test

#endif  // GNOMON_TESTS_ALGORITHMS_SOLID_CELLS_H
