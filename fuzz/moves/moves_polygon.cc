// SPDX-License-Identifier: GPL-3.0-or-later
// Moves that add a polygon which has something in common with another, or a shape of its own.
#include <algorithm>
#include <array>

#include "fuzz/moves/move_tools.h"

namespace gnomon::fuzz {
namespace {

using Points = std::vector<Vector>;

bool coplanar(Scene& scene, Random& random) {
  return add_polygon(scene, random, patch_in_plane(random_corner(scene, random), random));
}

bool overlap(Scene& scene, Random& random) {
  const Corner corner = random_corner(scene, random);
  // A corner in the interior is enough.
  Points loop = patch_in_plane(corner, random);
  const Vector shift = inner_point(corner, random) - loop[0];
  for (Vector& p : loop) p = p + shift;
  return add_polygon(scene, random, loop);
}

bool duplicate(Scene& scene, Random& random) {
  return add_polygon(scene, random, random_corner(scene, random).loop);
}

bool back_to_back(Scene& scene, Random& random) {
  Points loop = random_corner(scene, random).loop;
  if (random.chance(1, 3)) loop.resize(3);
  std::ranges::reverse(loop);
  return add_polygon(scene, random, loop, false);
}

bool shared_edge(Scene& scene, Random& random) {
  const Corner corner = random_corner(scene, random);
  return add_polygon(scene, random, completed(scene, random, {corner.next(), corner.a}));
}

bool shared_vertex(Scene& scene, Random& random) {
  const Corner corner = random_corner(scene, random);
  return add_polygon(scene, random, completed(scene, random, {corner.a}));
}

bool t_junction(Scene& scene, Random& random) {
  const Corner corner = random_corner(scene, random);
  const Vector at = edge_point(corner, random);
  if (random.chance(1, 3)) {  // in the plane, on the other side of the edge or not
    return add_polygon(scene, random,
                       {at, plane_point(corner, random), plane_point(corner, random)});
  }
  return add_polygon(scene, random, completed(scene, random, {at}));
}

bool edge_overlap(Scene& scene, Random& random) {
  const Corner corner = random_corner(scene, random);
  static constexpr std::array<std::array<int, 2>, 6> kHalves = {
      {{0, 1}, {1, 2}, {0, 4}, {-2, 1}, {1, 3}, {-1, 3}}};
  const auto& halves = kHalves[random.below(6)];
  const mpq_class half(1, 2);
  return add_polygon(
      scene, random,
      completed(scene, random, {corner.at(halves[0] * half, 0), corner.at(halves[1] * half, 0)}));
}

bool vertex_in_face(Scene& scene, Random& random) {
  const Corner corner = random_corner(scene, random);
  return add_polygon(scene, random, completed(scene, random, {inner_point(corner, random)}));
}

bool edge_in_face(Scene& scene, Random& random) {
  const Corner corner = random_corner(scene, random);
  const Vector p = inner_point(corner, random), q = inner_point(corner, random);
  return add_polygon(scene, random, completed(scene, random, {p, q}));
}

bool crossing(Scene& scene, Random& random) {
  const Corner corner = random_corner(scene, random);
  const Vector p = inner_point(corner, random), w = free_vector(scene, random);
  const mpq_class k = random.chance(1, 2) ? mpq_class(1) : mpq_class(1, 2);
  return add_polygon(scene, random, completed(scene, random, {p + w, p - k * w}));
}

bool sliver(Scene& scene, Random& random) {
  const Corner corner = random_corner(scene, random);
  const Vector a = random.chance(1, 2) ? corner.a : free_point(scene, random);
  const Vector b = random.chance(1, 2) ? corner.next() : free_point(scene, random);
  const mpq_class share = dyadic(random, 2, 6, 3);
  const Vector c = a + share * (b - a) + hair(scene, random, 20, 50);
  return add_rounded_triangle(scene, random, {a, b, c});
}

bool needle(Scene& scene, Random& random) {
  const Corner corner = random_corner(scene, random);
  const Vector tip = random.chance(1, 2) ? corner.a : free_point(scene, random);
  const Vector foot =
      random.chance(1, 2) ? random_corner(scene, random).a : free_point(scene, random);
  const Vector width = hair(scene, random, 20, 48);
  if (random.chance(1, 3) && add_polygon(scene, random, {tip, foot, foot + width, tip + width})) {
    return true;
  }
  return add_rounded_triangle(scene, random, {tip, foot, foot + width});
}

bool non_convex(Scene& scene, Random& random) {
  const Corner corner = random_corner(scene, random);
  const bool in_plane = random.chance(1, 3);
  const Vector a = in_plane ? corner.a : free_point(scene, random);
  const Vector u = in_plane ? corner.u : free_vector(scene, random);
  const Vector v = in_plane ? corner.v : free_vector(scene, random);
  const auto at = [&](int s, int t) { return a + mpq_class(s) / 2 * u + mpq_class(t) / 2 * v; };
  if (random.chance(1, 2)) {  // an L
    return add_polygon(scene, random, {at(0, 0), at(4, 0), at(4, 1), at(1, 1), at(1, 4), at(0, 4)});
  }
  return add_polygon(scene, random, {at(0, 0), at(4, 0), at(1, 1), at(0, 4)});
}

bool holes(Scene& scene, Random& random) {
  const Vector a = free_point(scene, random), u = free_vector(scene, random),
               v = free_vector(scene, random);
  const auto at = [&](int s, int t) { return a + mpq_class(s) / 2 * u + mpq_class(t) / 2 * v; };
  if (!add_polygon(scene, random, {at(0, 0), at(4, 0), at(4, 4), at(0, 4)})) return false;
  std::vector<VertexId> hole;
  const Points loop = random.chance(1, 2) ? Points{at(1, 1), at(2, 1), at(1, 2)}
                                          : Points{at(1, 1), at(2, 1), at(2, 3), at(1, 3)};
  for (const Vector& p : loop) {
    const auto position = position_of(p, scene.numbers);
    if (!position) return false;
    hole.push_back(static_cast<VertexId>(scene.vertices.size()));
    scene.vertices.push_back(*position);
  }
  scene.polygons.back().holes.push_back(std::move(hole));
  return true;
}

bool nested_boxes(Scene& scene, Random& random) {
  const Vector low = free_point(scene, random), step = free_vector(scene, random);
  const auto box = [&](int from, int to, bool inward) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
      for (const int at : {from, to}) {
        const auto corner = [&](int at_u, int at_v) {
          Vector p = low;
          p[k] += at * abs(step[k]), p[u] += at_u * abs(step[u]), p[v] += at_v * abs(step[v]);
          return p;
        };
        Points loop = {corner(from, from), corner(to, from), corner(to, to), corner(from, to)};
        if ((at == to) == inward) std::ranges::reverse(loop);
        if (!add_polygon(scene, random, loop, false)) return false;
      }
    }
    return true;
  };
  const bool inward = random.chance(2, 3);
  const int from = static_cast<int>(random.between(1, 2));
  return box(0, 4, inward) && box(from, 3, random.chance(1, 3));
}

/// A triangle's corner, or two, moved by one unit in the last place.
bool nextafter(Scene& scene, Random& random) {
  if (scene.numbers == NumberMeaning::kDecimal) return false;
  const Corner corner = random_corner(scene, random);
  std::vector<Position> loop;
  const auto add = [&](const Vector& p) {
    const auto position = position_of(p, scene.numbers);
    if (position) loop.push_back(*position);
    return position.has_value();
  };
  const std::uint64_t which = random.below(3);
  if (!add(corner.a)) return false;
  if (!add(which == 2 ? free_point(scene, random) : corner.next())) return false;
  if (!add(which == 0 ? corner.loop[2] : free_point(scene, random))) return false;
  // The whole polygon again, a neighbour at an edge, or at a vertex; or the light at a vertex.
  if (random.chance(1, 6)) {
    return std::ranges::none_of(scene.lights, [](const Light& l) { return l.has_area(); }) &&
           set_light(scene, random, LightType::kPoint, nudged(loop[0], random));
  }
  loop[0] = nudged(loop[0], random);
  if (random.chance(1, 4)) loop[0] = nudged(loop[0], random);
  return add_polygon_at(scene, random, loop);
}

bool near_parallel(Scene& scene, Random& random) {
  if (scene.numbers == NumberMeaning::kDecimal) return false;
  const Corner corner = random_corner(scene, random);
  Points points = {corner.a, corner.next(), corner.loop[2]};
  if (random.chance(1, 2)) {  // beside or above, not on it
    const Vector shift = free_vector(scene, random);
    for (Vector& p : points) p = p + shift;
  }
  std::vector<Position> loop;
  for (const Vector& p : points) {
    const auto position = rounded_position(p, scene.numbers);
    if (!position) return false;
    loop.push_back(*position);
  }
  for (int i = static_cast<int>(random.between(1, 3)); i > 0; --i) {
    const std::size_t k = random.below(3);
    loop[k] = nudged(loop[k], random);
  }
  return add_polygon_at(scene, random, loop);
}

bool almost_planar(Scene& scene, Random& random) {
  if (scene.numbers == NumberMeaning::kDecimal) return false;
  const Vector a = free_point(scene, random), u = free_vector(scene, random),
               v = free_vector(scene, random);
  if (is_zero(cross(u, v))) return false;
  std::vector<Position> loop;
  for (const Vector& p : {a, a + u, a + u + v, a + v}) {
    const auto position = rounded_position(p, scene.numbers);
    if (!position) return false;
    loop.push_back(*position);
  }
  const std::size_t k = random.below(4);
  loop[k] = nudged(loop[k], random);
  return add_polygon_at(scene, random, loop);
}

}  // namespace

std::vector<Move> polygon_moves() {
  constexpr MoveGroup kGroup = MoveGroup::kPolygon;
  return {
      {Kind::kNonConvex, kGroup, non_convex},
      {Kind::kHoles, kGroup, holes},
      {Kind::kNestedBoxes, kGroup, nested_boxes, true},
      {Kind::kCoplanar, kGroup, coplanar},
      {Kind::kOverlap, kGroup, overlap},
      {Kind::kDuplicate, kGroup, duplicate},
      {Kind::kBackToBack, kGroup, back_to_back},
      {Kind::kSharedEdge, kGroup, shared_edge},
      {Kind::kSharedVertex, kGroup, shared_vertex},
      {Kind::kTJunction, kGroup, t_junction},
      {Kind::kEdgeOverlap, kGroup, edge_overlap},
      {Kind::kVertexInFace, kGroup, vertex_in_face},
      {Kind::kEdgeInFace, kGroup, edge_in_face},
      {Kind::kCrossing, kGroup, crossing},
      {Kind::kSliver, kGroup, sliver},
      {Kind::kNeedle, kGroup, needle},
  };
}

std::vector<Move> near_moves() {
  constexpr MoveGroup kGroup = MoveGroup::kPolygon;
  return {
      {Kind::kAlmostPlanar, kGroup, almost_planar},
      {Kind::kNextafter, kGroup, nextafter},
      {Kind::kNearParallel, kGroup, near_parallel},
  };
}

}  // namespace gnomon::fuzz
