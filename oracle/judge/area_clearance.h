// SPDX-License-Identifier: GPL-3.0-or-later
// How far one vertex must move for a claim about a point p of a receiver R under an area light to
// be right: a certified upper bound. Each move that is tried is made, in rational numbers, and what
// p then sees is decided anew (area_visibility.h), so that nothing has to be proven of the moves
// themselves.
//
// (a) A vertex of a caster O, in O's plane. Let x be where the line from p to a vertex of A_R meets
// that
//     plane. The nearest point of O's border to x lies on an edge, in the half nearer to one of its
//     ends; moving that end by a little more than twice the distance carries the edge across x. And
//     where a single vertex of O hides some of the light, it moves back to the border of what p
//     sees through O's plane.
// (b) A vertex of R along R's normal, so that p comes to the other side of O's plane: windows in a
// wall.
//     Tried where all of the light is in front of R, before and after, so that what R sees of it
//     stays.
#ifndef GNOMON_ORACLE_JUDGE_AREA_CLEARANCE_H
#define GNOMON_ORACLE_JUDGE_AREA_CLEARANCE_H

#include <optional>
#include <span>

#include "gnomon/oracle/area_visibility.h"
#include "gnomon/result/claims.h"
#include "gnomon/scene/prepare.h"

namespace gnomon::oracle {

struct AreaClaim {
  LightState state = LightState::kLit;  // kLit, kPenumbra or kUmbra
  /// Umbra is that of single casters; otherwise it may be claimed wherever no light arrives, and
  /// penumbra wherever it is not lit.
  bool per_caster = false;

  /// Whether it is right of a point that sees so much. Requires: fractions.
  bool is_right(const AreaPointVisibility& seen) const;
};

/// In scene units; none if no single move is known. `receivers`: coplanar parts of one polygon, one
/// of which has the point. Cost: all casters in doubles, a few moves exactly, with all casters
/// where R moves.
std::optional<double> area_clearance(const PreparedScene& scene, const PreparedLight& light,
                                     const AreaVisibility& visibility,
                                     std::span<const std::uint32_t> receivers, Side side,
                                     const RationalPoint& point, const AreaClaim& claim);

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_JUDGE_AREA_CLEARANCE_H
