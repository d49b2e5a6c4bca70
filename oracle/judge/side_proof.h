// SPDX-License-Identifier: GPL-3.0-or-later
// Proves that exact claims about one polygon side hold, in the cheapest way that is a proof:
// vertices that are equal are one, edges of fragments cancel (edge_chains.h), and what is not
// decided by the frame of the plane is decided by signs of integers (scene_point.h). What it does
// not prove may be right all the same; the checker in rational numbers then decides, and says what
// is wrong.
//
// Exactness: exact. Whatever is said to hold does hold.
#ifndef GNOMON_ORACLE_JUDGE_SIDE_PROOF_H
#define GNOMON_ORACLE_JUDGE_SIDE_PROOF_H

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "gnomon/result/claims.h"
#include "gnomon/scene/prepare.h"
#include "oracle/geometry/scene_point.h"
#include "oracle/judge/family_shades.h"
#include "oracle/judge/light_volumes.h"
#include "oracle/judge/witness_pieces.h"

namespace gnomon::oracle {

class SideProof {
 public:
  /// `parts`: all that the polygon has in one plane. `fragments`: all that are claimed there. Keeps
  /// references. Requires: a point or directional light, fragments of at least three vertices and
  /// without holes.
  SideProof(const PreparedScene& scene, LightVolumes& light, Side side,
            std::vector<const ClaimedFragment*> fragments, std::span<const std::uint32_t> parts);

  const std::vector<const ClaimedFragment*>& fragments() const { return fragments_; }

  /// The fragments are convex, lie in the parts' plane, and tile the parts. What follows requires
  /// that.
  bool tiles();
  /// The fragment is inside of the light's region.
  bool is_inside_region(std::size_t fragment);
  /// That, and no part shadows any of it. Requires: the side faces the light.
  bool is_lit(std::size_t fragment);
  /// The parts of the caster shadow all of the fragment. Requires: as above.
  bool is_shadowed_by(std::size_t fragment, std::uint32_t caster);
  /// The exact shares of lit and shadow that are claimed of the parts are those of the fragments.
  bool has_shares_of(const ClaimedPolygon& polygon);

 private:
  struct Vertex {
    std::optional<Integers4> exact;
    std::optional<PlanarPoint> flat;
    bool in_plane = false;  // was found to be; those of parts are anyway
  };
  using Numbers = std::vector<std::uint32_t>;

  FamilyShades& shades();
  const ExactPlane& support();
  const Integers4& exact(std::uint32_t vertex);
  const PlanarPoint& flat(std::uint32_t vertex);
  const PlanarLoop& flat_loop(std::size_t fragment);
  /// Of a coordinate in the frame, whatever fragments are like.
  long double error();
  int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  int exact_turn(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  bool lies_in_plane(const Numbers& loop);
  /// Counter-clockwise from now on.
  bool is_convex(Numbers& loop);
  /// Requires: a loop that turns to one side only.
  bool goes_around_once(const Numbers& loop);
  /// The same vertices in the same order as a part, from any of them, one way or the other.
  bool is_a_part(Numbers& loop) const;
  /// `side`: 1 inside of a line of the shade, or on it; -1 outside, or on it.
  bool is_on_side(std::size_t fragment, const Shade& shade, std::size_t line, int side);
  /// A plane through an edge of the fragment and the light has the fragment on one side of it and
  /// the part on the other.
  bool has_edge_between(std::size_t fragment, const Shade& shade);
  Piece piece_of(std::size_t fragment) const;
  mpq_class doubled_area(const std::vector<const Numbers*>& loops);

  const PreparedScene& scene_;
  LightVolumes& light_;
  Side side_;
  std::vector<const ClaimedFragment*> fragments_;
  std::vector<std::uint32_t> parts_;
  std::vector<RationalLoop> part_points_;
  PointNumbers numbers_;
  std::size_t part_vertices_ = 0;            // numbers below are vertices of parts
  std::vector<Vertex> vertices_;             // by number
  std::vector<Numbers> part_loops_, loops_;  // counter-clockwise once tiles() was asked
  std::vector<PlanarLoop> flat_loops_;       // of fragments, empty until asked for
  std::optional<ExactPlane> support_;
  std::optional<Integers4> plane_;  // the same for points in scene units
  std::optional<PlaneTurn> turn_;
  std::optional<FamilyShades> shades_;
  long double error_ = 0;  // once it was asked for
};

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_JUDGE_SIDE_PROOF_H
