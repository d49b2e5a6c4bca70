// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/intent/components.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/base/exact_int.h"
#include "scene/geometry/joined_sets.h"
#include "scene/geometry/numbering.h"

namespace gnomon::scene_detail {

namespace {

Vector area_of_ring(const PreparedScene& prepared, const LocalPoints& points,
                    const std::vector<VertexId>& ring) {
  std::vector<VertexId> loop;
  for (const VertexId vertex : ring) loop.push_back(prepared.vertex_of_input[vertex]);
  return loop.size() < 3 ? Vector{} : points.area_vector(loop);
}

std::vector<HalfEdge> half_edges_of(const Scene& scene, const PreparedScene& prepared,
                                    const LocalPoints& points) {
  std::vector<HalfEdge> result;
  std::vector<EdgeEnds> ends;
  const auto add = [&](std::uint32_t polygon, const std::vector<VertexId>& ring, bool reversed) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const VertexId a = prepared.vertex_of_input[ring[i]],
                     b = prepared.vertex_of_input[ring[i + 1 == ring.size() ? 0 : i + 1]];
      if (a == b) continue;
      ends.push_back({std::min(a, b), std::max(a, b)});
      result.push_back({0, polygon, (a > b) != reversed});
    }
  };
  for (std::uint32_t p = 0; p < scene.polygons.size(); ++p) {
    if (prepared.first_part[p] == prepared.first_part[p + 1]) continue;
    const Polygon& polygon = scene.polygons[p];
    add(p, polygon.loop, false);
    if (polygon.holes.empty()) continue;
    const Vector area = area_of_ring(prepared, points, polygon.loop);
    for (const auto& hole : polygon.holes) {
      // Against the loop, whichever way the file has it.
      add(p, hole, dot_of(area_of_ring(prepared, points, hole), area) > 0);
    }
  }
  const Numbering edges(
      ends.size(), [&](std::size_t i) { return mix(mix(0, ends[i].a), ends[i].b); },
      [&](std::size_t i, std::size_t j) { return ends[i] == ends[j]; });
  for (std::size_t i = 0; i < result.size(); ++i) result[i].edge = edges[i];
  return result;
}

/// How often polygons run along an edge, each way.
struct EdgeUse {
  std::uint32_t forwards = 0, backwards = 0;
};

enum class Closure : std::uint8_t { kClosed, kClosedButMixed, kOpen };

/// Six times the signed volume below the parts of a polygon, seen from a point.
long double volume_under(const PreparedScene& prepared, const LocalPoints& points,
                         std::uint32_t polygon, const Vector& origin) {
  long double sum = 0;
  for (std::uint32_t p = prepared.first_part[polygon]; p < prepared.first_part[polygon + 1]; ++p) {
    const auto loop = prepared.loop(prepared.parts[p]);
    sum += dot_of(points[loop[0]] - origin, points.area_vector(loop));
  }
  return sum;
}

bool lies_in_one_plane(const PreparedScene& prepared, const ClosedComponent& component) {
  const PlaneId plane = prepared.parts[prepared.first_part[component.polygons[0]]].plane;
  return std::ranges::all_of(component.polygons, [&](std::uint32_t polygon) {
    for (std::uint32_t p = prepared.first_part[polygon]; p < prepared.first_part[polygon + 1];
         ++p) {
      if (prepared.parts[p].plane != plane) return false;
    }
    return true;
  });
}

ComponentOrientation orientation_of(const PreparedScene& prepared, const LocalPoints& points,
                                    const ClosedComponent& component) {
  const Part& first = prepared.parts[prepared.first_part[component.polygons[0]]];
  const Vector origin = points[prepared.loop(first)[0]];
  long double volume = 0, size = 0;
  for (const std::uint32_t polygon : component.polygons) {
    const long double under = volume_under(prepared, points, polygon, origin);
    volume += under;
    size += std::abs(under);
  }
  constexpr long double kRounding = 1e-15L;  // of some thousand terms
  if (std::abs(volume) <= kRounding * size) return ComponentOrientation::kFlat;
  return volume > 0 ? ComponentOrientation::kOutwards : ComponentOrientation::kInwards;
}

}  // namespace

Components find_components(const Scene& scene, const PreparedScene& prepared,
                           const LocalPoints& points) {
  Components result;
  result.half_edges = half_edges_of(scene, prepared, points);
  const std::size_t polygons = scene.polygons.size();
  std::uint32_t edges = 0;
  for (const HalfEdge& half : result.half_edges) edges = std::max(edges, half.edge + 1);
  constexpr std::uint32_t kNone = 0xffffffffu;
  std::vector<EdgeUse> uses(edges);
  std::vector<std::uint32_t> owner(edges, kNone);
  JoinedSets sets(polygons);
  for (const HalfEdge& half : result.half_edges) {
    ++(half.flipped ? uses[half.edge].backwards : uses[half.edge].forwards);
    std::uint32_t& other = owner[half.edge];
    if (other != kNone) sets.join(other, half.polygon);
    other = half.polygon;
  }
  result.first_polygon.resize(polygons);
  std::vector<Closure> closure(polygons, Closure::kOpen);
  for (std::uint32_t p = 0; p < polygons; ++p) {
    result.first_polygon[p] = sets.first(p);
    if (prepared.first_part[p] != prepared.first_part[p + 1]) closure[p] = Closure::kClosed;
  }
  for (std::uint32_t edge = 0; edge < edges; ++edge) {
    const EdgeUse& use = uses[edge];
    Closure& state = closure[sets.first(owner[edge])];
    if (use.forwards == use.backwards) continue;
    state = (use.forwards + use.backwards) % 2 != 0 ? Closure::kOpen
                                                    : std::max(state, Closure::kClosedButMixed);
  }
  std::vector<std::uint32_t> place(polygons, kNone);
  for (std::uint32_t p = 0; p < polygons; ++p) {
    const std::uint32_t first = result.first_polygon[p];
    if (closure[first] == Closure::kOpen) continue;
    if (place[first] == kNone) {
      place[first] = static_cast<std::uint32_t>(result.closed.size());
      result.closed.emplace_back();
    }
    ClosedComponent& component = result.closed[place[first]];
    component.polygons.push_back(p);
    component.two_sided = component.two_sided || scene.is_two_sided(scene.polygons[p]);
  }
  for (ClosedComponent& component : result.closed) {
    const bool is_mixed =
        closure[result.first_polygon[component.polygons[0]]] == Closure::kClosedButMixed;
    component.orientation = lies_in_one_plane(prepared, component) ? ComponentOrientation::kFlat
                            : is_mixed                             ? ComponentOrientation::kMixed
                                       : orientation_of(prepared, points, component);
  }
  return result;
}

bool is_inside(const PreparedScene& prepared, const LocalPoints& points,
               const ClosedComponent& component, const Vector& point) {
  // The solid angle of all parts: 4 pi or 0 (van Oosterom & Strackee 1983).
  long double sum = 0;
  for (const std::uint32_t polygon : component.polygons) {
    for (std::uint32_t p = prepared.first_part[polygon]; p < prepared.first_part[polygon + 1];
         ++p) {
      const auto loop = prepared.loop(prepared.parts[p]);
      const Vector a = points[loop[0]] - point;
      for (std::size_t i = 2; i < loop.size(); ++i) {
        const Vector b = points[loop[i - 1]] - point, c = points[loop[i]] - point;
        const long double la = length_of(a), lb = length_of(b), lc = length_of(c);
        const long double across = dot_of(a, cross_of(b, c));
        const long double along =
            la * lb * lc + dot_of(a, b) * lc + dot_of(b, c) * la + dot_of(c, a) * lb;
        sum += 2 * std::atan2(across, along);
      }
    }
  }
  return std::abs(sum) > 2 * std::numbers::pi_v<long double>;
}

}  // namespace gnomon::scene_detail
