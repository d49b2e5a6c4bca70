// SPDX-License-Identifier: GPL-3.0-or-later
// What moves are made of: places on polygons of the scene, free points about it, and new polygons
// and lights.
//
// Random numbers are drawn in separate statements or within braces: the order of arguments and of
// operands is the compiler's, and a seed must mean the same scene with all of them.
#ifndef GNOMON_FUZZ_MOVES_MOVE_TOOLS_H
#define GNOMON_FUZZ_MOVES_MOVE_TOOLS_H

#include <array>
#include <optional>
#include <vector>

#include "fuzz/moves/moves.h"
#include "fuzz/scene/exact_points.h"

namespace gnomon::fuzz {

/// A corner of a polygon with its two edges.
struct Corner {
  std::vector<Vector> loop;  // of the polygon, from this corner on
  Vector a, u, v;            // corner, to the next, to the one before

  const Vector& next() const { return loop[1]; }
  Vector at(const mpq_class& s, const mpq_class& t) const { return a + s * u + t * v; }
};
/// A corner of a random polygon, or of `loop`, whose edges are not on one line if one has such.
Corner random_corner(const Scene& scene, Random& random);
Corner random_corner(std::vector<Vector> loop, Random& random);

/// n / 2^bits for n in [low, high].
mpq_class dyadic(Random& random, std::int64_t low, std::int64_t high, int bits);
/// A dyadic point of a triangle of the polygon: in the interior, if the polygon is convex.
Vector inner_point(const Corner& corner, Random& random);
/// A point of the corner's plane, in or about the polygon, on no particular line.
Vector plane_point(const Corner& corner, Random& random);
/// A point between the corner and the next.
Vector edge_point(const Corner& corner, Random& random);
/// A triangle or parallelogram in the corner's plane, anywhere about the polygon.
std::vector<Vector> patch_in_plane(const Corner& corner, Random& random);

/// A point of a coarse lattice in and about the scene.
Vector free_point(const Scene& scene, Random& random);
/// A vector of the scene's size, or some times smaller; not zero, of few bits.
Vector free_vector(const Scene& scene, Random& random);
/// 2^-shift of that, shift in [low, high].
Vector hair(const Scene& scene, Random& random, int low, int high);
/// `count` corners, the first ones given: free points, or a parallelogram where two are given or
/// one of them only.
std::vector<Vector> completed(const Scene& scene, Random& random, std::vector<Vector> first);

/// The next double, up or down, in one coordinate (mostly one that is not 0).
Position nudged(const Position& position, Random& random);

/// Added with flags like those of the rest, turned round sometimes. False if it has no area or the
/// scene's numbers cannot hold it.
bool add_polygon(Scene& scene, Random& random, const std::vector<Vector>& loop,
                 bool may_turn = true);
bool add_polygon_at(Scene& scene, Random& random, const std::vector<Position>& loop,
                    bool may_turn = true);
/// The same with coordinates rounded to doubles. Requires: three corners.
bool add_rounded_triangle(Scene& scene, Random& random, const std::vector<Vector>& loop);

/// Replaces a light of the kind, or is a second one.
bool set_light(Scene& scene, Random& random, LightType type, const std::optional<Position>& at);
bool set_panel(Scene& scene, Random& random, const std::vector<Vector>& loop);
bool set_rounded_panel(Scene& scene, Random& random, const std::vector<Vector>& triangle);

std::vector<Move> polygon_moves();
std::vector<Move> light_moves();
std::vector<Move> area_moves();
std::vector<Move> near_moves();  // of polygons, to be applied late
std::vector<Move> whole_moves();

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_MOVES_MOVE_TOOLS_H
