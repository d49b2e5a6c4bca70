// SPDX-License-Identifier: GPL-3.0-or-later
// Moves that put an area light where it is special to a polygon.
#include <array>

#include "fuzz/moves/move_tools.h"

namespace gnomon::fuzz {
namespace {

/// A light whose first corners are given.
bool panel(Scene& scene, Random& random, std::vector<Vector> first) {
  return set_panel(scene, random, completed(scene, random, std::move(first)));
}

bool area_vertex(Scene& scene, Random& random) {
  return panel(scene, random, {random_corner(scene, random).a});
}

bool area_edge(Scene& scene, Random& random) {
  const Corner corner = random_corner(scene, random);
  return panel(scene, random, {corner.a, corner.next()});
}

bool area_edge_overlap(Scene& scene, Random& random) {
  const Corner corner = random_corner(scene, random);
  static constexpr std::array<std::array<int, 2>, 5> kHalves = {
      {{0, 1}, {1, 2}, {0, 4}, {-2, 1}, {-1, 3}}};
  const auto& halves = kHalves[random.below(5)];
  return panel(scene, random,
               {corner.at(mpq_class(halves[0]) / 2, 0), corner.at(mpq_class(halves[1]) / 2, 0)});
}

bool area_in_plane(Scene& scene, Random& random) {
  return set_panel(scene, random, patch_in_plane(random_corner(scene, random), random));
}

bool area_on_caster(Scene& scene, Random& random) {
  const Corner corner = random_corner(scene, random);
  if (random.chance(1, 3)) return set_panel(scene, random, corner.loop);
  std::vector<Vector> loop = patch_in_plane(corner, random);
  const Vector shift = inner_point(corner, random) - loop[0];
  for (Vector& p : loop) p = p + shift;
  return set_panel(scene, random, loop);
}

bool area_inside(Scene& scene, Random& random) {
  const Corner corner = random_corner(scene, random);
  const mpq_class half(1, 2), quarter(1, 4);
  const std::vector<Vector> small = {corner.at(half, quarter), corner.at(quarter, quarter),
                                     corner.at(quarter, half)};
  if (random.chance(2, 3)) return set_panel(scene, random, small);
  // The other way round: the light takes the polygon's place, and a small one is put into it.
  return add_polygon(scene, random, small) && set_panel(scene, random, corner.loop);
}

bool area_vertex_in_face(Scene& scene, Random& random) {
  return panel(scene, random, {inner_point(random_corner(scene, random), random)});
}

bool area_touched(Scene& scene, Random& random) {
  const Corner corner = random_corner(scene, random);
  const Vector u = free_vector(scene, random), v = free_vector(scene, random);
  if (random.chance(1, 2)) {
    return set_panel(scene, random, {corner.a + u, corner.a + v, corner.a - u - v});
  }
  return set_panel(scene, random,
                   {corner.a - u - v, corner.a + u - v, corner.a + u + v, corner.a - u + v});
}

bool area_straddled(Scene& scene, Random& random) {
  const Corner corner = random_corner(scene, random);
  const Vector at = plane_point(corner, random), w = free_vector(scene, random);
  return panel(scene, random, {at + w, at - w});
}

bool area_cut(Scene& scene, Random& random) {
  const Corner corner = random_corner(scene, random);
  const Vector at = inner_point(corner, random), w = free_vector(scene, random);
  return panel(scene, random, {at + w, at - w});
}

bool area_vertex_in_plane(Scene& scene, Random& random) {
  return panel(scene, random, {plane_point(random_corner(scene, random), random)});
}

bool area_edge_in_plane(Scene& scene, Random& random) {
  const Corner corner = random_corner(scene, random);
  const Vector p = plane_point(corner, random), q = plane_point(corner, random);
  return panel(scene, random, {p, q});
}

bool area_parallel_edge(Scene& scene, Random& random) {
  const Corner corner = random_corner(scene, random);
  static constexpr int kHalves[] = {-4, -2, -1, 1, 2, 4};
  const Vector at = free_point(scene, random);
  return panel(scene, random, {at, at + mpq_class(kHalves[random.below(6)]) / 2 * corner.u});
}

bool area_grazing(Scene& scene, Random& random) {
  const Corner corner = random_corner(scene, random);
  const auto near = [&]() -> Vector {
    const Vector at = plane_point(corner, random);
    return at + hair(scene, random, 31, 50);
  };
  const Vector p = near();
  const Vector q = random.chance(1, 2) ? near() : free_point(scene, random);
  const Vector r = random.chance(1, 4) ? near() : free_point(scene, random);
  return set_rounded_panel(scene, random, {p, q, r});
}

bool area_sliver(Scene& scene, Random& random) {
  const Vector a = free_point(scene, random), b = free_point(scene, random);
  const Vector off = hair(scene, random, 22, 48);
  if (random.chance(1, 2) && set_panel(scene, random, {a, b, b + off, a + off})) return true;
  return set_rounded_panel(scene, random, {a, b, a + dyadic(random, 1, 7, 3) * (b - a) + off});
}

bool area_small(Scene& scene, Random& random) {
  const Vector at =
      random.chance(1, 3) ? random_corner(scene, random).a : free_point(scene, random);
  const int shift = static_cast<int>(random.between(24, 44));
  const Vector u = power_of_two(-shift) * free_vector(scene, random),
               v = power_of_two(-shift) * free_vector(scene, random);
  if (random.chance(1, 2) && set_panel(scene, random, {at, at + u, at + u + v, at + v})) {
    return true;
  }
  return set_rounded_panel(scene, random, {at, at + u, at + v});
}

bool area_huge(Scene& scene, Random& random) {
  const Vector at = free_point(scene, random);
  const mpq_class times = power_of_two(static_cast<int>(random.between(14, 40)));
  const Vector u = times * free_vector(scene, random), v = times * free_vector(scene, random);
  if (random.chance(1, 2) &&
      set_panel(scene, random, {at - u - v, at + u - v, at + u + v, at - u + v})) {
    return true;
  }
  return set_rounded_panel(scene, random, {at + u, at + v, at - u - v});
}

}  // namespace

std::vector<Move> area_moves() {
  constexpr MoveGroup kGroup = MoveGroup::kArea;
  return {
      {Kind::kAreaVertex, kGroup, area_vertex},
      {Kind::kAreaEdge, kGroup, area_edge},
      {Kind::kAreaEdgeOverlap, kGroup, area_edge_overlap},
      {Kind::kAreaInPlane, kGroup, area_in_plane},
      {Kind::kAreaOnCaster, kGroup, area_on_caster},
      {Kind::kAreaInside, kGroup, area_inside},
      {Kind::kAreaVertexInFace, kGroup, area_vertex_in_face},
      {Kind::kAreaTouched, kGroup, area_touched},
      {Kind::kAreaStraddled, kGroup, area_straddled},
      {Kind::kAreaCut, kGroup, area_cut},
      {Kind::kAreaVertexInPlane, kGroup, area_vertex_in_plane},
      {Kind::kAreaEdgeInPlane, kGroup, area_edge_in_plane},
      {Kind::kAreaParallelEdge, kGroup, area_parallel_edge},
      {Kind::kAreaGrazing, kGroup, area_grazing},
      {Kind::kAreaSliver, kGroup, area_sliver},
      {Kind::kAreaSmall, kGroup, area_small},
      {Kind::kAreaHuge, kGroup, area_huge},
  };
}

}  // namespace gnomon::fuzz
