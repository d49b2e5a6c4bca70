// SPDX-License-Identifier: GPL-3.0-or-later
// What the checker of exact claims (witness_check.h) cuts and cuts with: parts as convex solids of
// half-spaces, and claimed fragments in the plane of their part. All of it is rational, in
// scene units; doubles only put aside what is clearly apart.
#ifndef GNOMON_ORACLE_JUDGE_WITNESS_PIECES_H
#define GNOMON_ORACLE_JUDGE_WITNESS_PIECES_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "gnomon/result/claims.h"
#include "gnomon/scene/prepare.h"
#include "oracle/geometry/chart.h"
#include "oracle/geometry/plane_frame.h"
#include "oracle/geometry/space_loop.h"

namespace gnomon::oracle {

/// Which side of a part a point or directional light is on, and what that makes of the part.
struct LightStanding {
  int facing = 0;  // 1 front, -1 back, 0 the light is in its plane
  bool receives = false, casts = false;
};
LightStanding standing_of(const PreparedScene& scene, const PreparedLight& light,
                          std::uint32_t part);

/// What bounds the shadow of a part on the grid: behind it, and inside its edges seen from the
/// light. Requires: a point or directional light that it faces.
std::vector<ExactPlane> shadow_planes_of(const PreparedScene& scene, const PreparedLight& light,
                                         std::uint32_t part, int facing);

/// A part as receiver and caster.
struct Solid {
  space::Loop loop;
  RationalPoint normal;
  std::vector<space::HalfSpace> walls;  // in its plane: inside of the part

  /// All of the part lies in the plane of the half-space.
  bool lies_in(const space::HalfSpace& half) const;
  /// All of the other part lies in this one's plane: neither shadows the other.
  bool holds(const Solid& other) const;
};
Solid solid_of(const PreparedScene& scene, std::uint32_t part);

/// A claimed fragment in the plane of a part, or a convex piece of it; or of what none covers.
struct Piece {
  const ClaimedFragment* fragment = nullptr;   // null: what none covers
  std::size_t index = 0;                       // of the fragment in its polygon
  std::uint32_t part;                          // a part whose plane it lies in
  space::Loop loop;                            // oriented like that part
  mpq_class area;                              // along the part's normal
  std::vector<std::array<double, 3>> corners;  // the loop in doubles
  std::array<double, 3> low{}, high{};

  // The loop in the frame of the plane, once it is laid there.
  PlanarLoop flat;
  PlanarBox flat_box;

  /// Requires: a loop in the plane of the part, whose normal is given.
  Piece(const ClaimedFragment* claimed, std::size_t number, std::uint32_t of_part, space::Loop own,
        const RationalPoint& normal);
  /// Part of a piece. Requires: a convex loop inside of it, with its orientation.
  Piece(const Piece& whole, space::Loop own, const RationalPoint& normal);
  /// What no fragment covers.
  Piece(std::uint32_t of_part, space::Loop own, const RationalPoint& normal);

  void lay(const PlaneFrame& frame);
  /// The vertex of the loop that a vertex of `flat` is of.
  const RationalPoint& vertex_at(std::size_t flat_index) const {
    return loop[flat_turned_ ? loop.size() - 1 - flat_index : flat_index];
  }
  /// Where a vertex of the loop is in the frame.
  const PlanarPoint& flat_at(std::size_t vertex) const {
    return flat[flat_turned_ ? loop.size() - 1 - vertex : vertex];
  }
  /// Greatest distance of a coordinate from 0, or a little more.
  double reach() const;
  bool overlaps_box_of(const Piece& other) const;
  bool is_convex(const RationalPoint& normal) const;
  /// By doubles: clearly outside of one of the half-spaces, and so of what they bound.
  bool is_apart(const std::vector<space::HalfSpace>& bounds, double margin) const;
  /// In the plane with that normal, inside of the piece; none for an edge without length. Made when
  /// first asked for.
  const std::vector<space::HalfSpace>& walls_of(const RationalPoint& normal);

 private:
  void measure(const RationalPoint& normal);

  std::vector<space::HalfSpace> walls_;
  bool flat_turned_ = false;
};

/// Which way three points of a frame turn: 1 left, -1 right, 0 if the frame cannot tell. `error`:
/// of each coordinate, kPlanarError times the greatest distance of a point's coordinate from 0.
int turn_in_frame(const PlanarPoint& from, const PlanarPoint& to, const PlanarPoint& at,
                  long double error);

/// On which sides of their edges convex pieces of one plane lie to each other. Exact: doubts of the
/// frame are settled in rational numbers.
class PieceSides {
 public:
  /// `reach`: greatest distance from 0 of a coordinate of what the frame is of.
  PieceSides(const RationalPoint& normal, long double reach) : view_(normal), reach_(reach) {}

  /// Some edge of a has all of b outside or on it: what they have in common has no area. Requires:
  /// both laid in the same frame.
  bool are_apart(const Piece& a, const Piece& b) const;
  /// No vertex of b is outside of an edge of a. Requires: as above.
  bool holds(const Piece& a, const Piece& b) const;

 private:
  /// Of the edge that starts at vertex `edge` of a, where vertex v of b is: 1 inside, 0 on its
  /// line.
  int side(const Piece& a, std::size_t edge, const Piece& b, std::size_t v) const;

  space::PlaneView view_;
  long double reach_;
};

/// In scene units.
RationalPoint in_scene(const Geometry& geometry, const HomogeneousPoint& point);

/// Pieces painted over each other, cut down to what is seen of each: a piece of a higher level
/// hides what it holds of lower ones.
std::vector<Piece> cut_to_visible(std::vector<Piece> pieces, const RationalPoint& normal);
/// What no piece holds of a part. Areas are along the normal, which may be that of a coplanar part.
std::vector<Piece> left_over(std::uint32_t part, const space::Loop& loop,
                             const RationalPoint& normal, std::vector<Piece>& pieces);

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_JUDGE_WITNESS_PIECES_H
