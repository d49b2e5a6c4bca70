// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes written down in a line, and exact measures of what preparation made of them.
#ifndef GNOMON_TESTS_SCENE_PREPARE_BUILDER_H
#define GNOMON_TESTS_SCENE_PREPARE_BUILDER_H

#include <gmpxx.h>

#include <algorithm>
#include <initializer_list>
#include <set>
#include <string>
#include <vector>

#include "gnomon/scene/prepare.h"

namespace gnomon::test {

using Triple = std::array<double, 3>;

inline Position position(const Triple& p) { return {Number(p[0]), Number(p[1]), Number(p[2])}; }

/// A decimal number from thousandths.
inline Number milli(long thousandths) { return Number::from_decimal(thousandths, -3); }

class Builder {
 public:
  /// Adds a polygon with vertices of its own.
  Builder& polygon(const std::vector<Triple>& loop,
                   const std::vector<std::vector<Triple>>& holes = {}) {
    Polygon polygon;
    polygon.id = std::to_string(scene_.polygons.size());
    polygon.loop = add(loop);
    for (const auto& hole : holes) polygon.holes.push_back(add(hole));
    scene_.polygons.push_back(std::move(polygon));
    return *this;
  }
  Builder& point_light(const Triple& p) { return light(LightType::kPoint, p); }
  Builder& sun(const Triple& p) { return light(LightType::kDirectional, p); }
  Builder& area_light(const std::vector<Triple>& loop) {
    light(LightType::kArea, {});
    for (const Triple& p : loop) scene_.lights.back().loop.push_back(position(p));
    return *this;
  }
  Scene& scene() { return scene_; }
  Expected<PreparedScene> prepare() const { return gnomon::prepare(scene_); }

 private:
  std::vector<VertexId> add(const std::vector<Triple>& loop) {
    std::vector<VertexId> indices;
    for (const Triple& p : loop) {
      indices.push_back(static_cast<VertexId>(scene_.vertices.size()));
      scene_.vertices.push_back(position(p));
    }
    return indices;
  }
  Builder& light(LightType type, const Triple& p) {
    Light light;
    light.id = "light" + std::to_string(scene_.lights.size());
    light.type = type;
    light.position = position(p);
    scene_.lights.push_back(std::move(light));
    return *this;
  }

  Scene scene_;
};

using Exact3 = std::array<mpz_class, 3>;

inline Exact3 grid_point(const PreparedScene& scene, VertexId v) {
  return {scene.geometry.grid.at(v, 0), scene.geometry.grid.at(v, 1), scene.geometry.grid.at(v, 2)};
}

/// (b - a) x (c - a) on the grid, the slow and plain way.
inline Exact3 plain_cross(const Exact3& a, const Exact3& b, const Exact3& c) {
  const Exact3 u{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  const Exact3 v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

/// Twice the area vector of a loop of geometry vertices, on the grid.
template <class Loop>
Exact3 plain_area(const PreparedScene& scene, const Loop& loop) {
  Exact3 sum{0, 0, 0};
  for (std::size_t i = 2; i < loop.size(); ++i) {
    const Exact3 part = plain_cross(grid_point(scene, loop[0]), grid_point(scene, loop[i - 1]),
                                    grid_point(scene, loop[i]));
    for (std::size_t k = 0; k < 3; ++k) sum[k] += part[k];
  }
  return sum;
}

inline Exact3 part_area_sum(const PreparedScene& scene, std::uint32_t polygon) {
  Exact3 sum{0, 0, 0};
  for (std::uint32_t p = scene.first_part[polygon]; p < scene.first_part[polygon + 1]; ++p) {
    const Exact3 part = plain_area(scene, scene.loop(scene.parts[p]));
    for (std::size_t k = 0; k < 3; ++k) sum[k] += part[k];
  }
  return sum;
}

/// The loop's area vector minus or plus its holes', so that holes count against the loop.
inline Exact3 input_area(const PreparedScene& prepared, const Scene& scene, std::uint32_t polygon) {
  const auto welded = [&](const std::vector<VertexId>& loop) {
    std::vector<VertexId> result;
    for (const VertexId v : loop) result.push_back(prepared.vertex_of_input[v]);
    return result;
  };
  const Polygon& p = scene.polygons[polygon];
  Exact3 sum = plain_area(prepared, welded(p.loop));
  for (const auto& hole : p.holes) {
    const Exact3 part = plain_area(prepared, welded(hole));
    const mpz_class same = part[0] * sum[0] + part[1] * sum[1] + part[2] * sum[2];
    for (std::size_t k = 0; k < 3; ++k) sum[k] += same > 0 ? -part[k] : part[k];
  }
  return sum;
}

/// What is wrong with a prepared scene, in words; empty if nothing is. Checks every promise of the
/// headers by plain GMP arithmetic: parts strictly convex, planar, oriented as their plane says;
/// planes, edges and positions distinct; everything on the grid where the scene's numbers are.
inline std::string first_flaw(const PreparedScene& prepared, const Scene& scene) {
  const Geometry& g = prepared.geometry;
  for (std::size_t v = 0; v < scene.vertices.size(); ++v) {
    const std::uint32_t w = prepared.vertex_of_input[v];
    if (w == PreparedScene::kUnused) continue;
    for (int k = 0; k < 3; ++k) {
      const auto a = static_cast<std::size_t>(k);
      if (g.origin[a] + g.step * mpq_class(g.grid.at(w, k)) != scene.vertices[v][a].exact()) {
        return "vertex " + std::to_string(v) + " is not where the scene says";
      }
      if (g.positions[w][a] != scene.vertices[v][a].nearest()) return "a nearest double differs";
    }
  }
  std::set<std::array<std::string, 3>> places;
  for (VertexId v = 0; v < g.grid.size(); ++v) {
    const Exact3 p = grid_point(prepared, v);
    if (!places.insert({p[0].get_str(), p[1].get_str(), p[2].get_str()}).second)
      return "two equal positions";
  }
  std::set<std::pair<VertexId, VertexId>> edges;
  for (const EdgeEnds& e : g.edges) {
    if (e.a >= e.b || !edges.insert({e.a, e.b}).second) return "edges are not distinct";
  }
  std::set<std::string> planes;
  for (const SupportTriple& t : g.planes) {
    Exact3 n = plain_cross(grid_point(prepared, t.a), grid_point(prepared, t.b),
                           grid_point(prepared, t.c));
    mpz_class common = gcd(gcd(n[0], n[1]), n[2]);
    if (common == 0) return "a support triple is collinear";
    if (n[0] < 0 || (n[0] == 0 && (n[1] < 0 || (n[1] == 0 && n[2] < 0)))) common = -common;
    const Exact3 a = grid_point(prepared, t.a);
    std::string name;
    for (std::size_t k = 0; k < 3; ++k) {
      n[k] /= common;
      name += n[k].get_str() + " ";
    }
    name += mpz_class(n[0] * a[0] + n[1] * a[1] + n[2] * a[2]).get_str();
    if (!planes.insert(name).second) return "two planes are one";
  }
  if (prepared.first_part.size() != scene.polygons.size() + 1) return "first_part has a wrong size";
  for (std::size_t i = 0; i < prepared.parts.size(); ++i) {
    const Part& part = prepared.parts[i];
    const auto loop = prepared.loop(part);
    const auto refs = prepared.edges(part);
    const std::string name = "part " + std::to_string(i);
    if (loop.size() < 3) return name + " has fewer than 3 vertices";
    if (prepared.first_part[part.polygon] > i || prepared.first_part[part.polygon + 1] <= i) {
      return name + " is listed under another polygon";
    }
    const SupportTriple& t = g.planes[part.plane];
    const Exact3 origin = grid_point(prepared, t.a);
    Exact3 n = plain_cross(origin, grid_point(prepared, t.b), grid_point(prepared, t.c));
    if (part.flipped) n = {-n[0], -n[1], -n[2]};
    const std::size_t size = loop.size();
    for (std::size_t j = 0; j < size; ++j) {
      const Exact3 p = grid_point(prepared, loop[j]);
      if (n[0] * (p[0] - origin[0]) + n[1] * (p[1] - origin[1]) + n[2] * (p[2] - origin[2]) != 0) {
        return name + " is not in its plane";
      }
      const VertexId a = loop[j], b = loop[(j + 1) % size];
      const EdgeEnds& e = g.edges[refs[j].index()];
      if ((refs[j].flipped() ? e.b : e.a) != a || (refs[j].flipped() ? e.a : e.b) != b) {
        return name + " has a wrong edge";
      }
      // Strictly convex: every other vertex is strictly on the inner side of every edge.
      for (std::size_t k = 0; k < size; ++k) {
        if (k == j || k == (j + 1) % size) continue;
        const Exact3 c = plain_cross(p, grid_point(prepared, b), grid_point(prepared, loop[k]));
        if (c[0] * n[0] + c[1] * n[1] + c[2] * n[2] <= 0) return name + " is not strictly convex";
      }
    }
  }
  return {};
}

}  // namespace gnomon::test

#endif  // GNOMON_TESTS_SCENE_PREPARE_BUILDER_H
