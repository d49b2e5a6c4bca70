// SPDX-License-Identifier: GPL-3.0-or-later
// How far one vertex must move for the class at a point p of a receiver R to change: a certified
// upper bound, from two families of moves.
//
// (a) A vertex of the caster O, in O's plane. Let x be where the line from p to the light meets
// that plane,
//     between the two. The nearest point of O's border to x lies on an edge, in the half nearer to
//     one of its ends; moving that end by at most twice the distance carries the edge across x.
// (b) A vertex of R, along R's normal. In any triangulation of R, p has in its triangle a corner of
//     weight at least 1/3: moving it by 3 s moves R's point at p by at least s. If the point p' so
//     moved is shadowed differently (tested exactly), 3 s is a bound. Windows meant to lie in a
//     wall.
// A lit point changes with any one caster; one in shadow by (a) only if a single caster covers it.
#ifndef GNOMON_ORACLE_JUDGE_CLEARANCE_H
#define GNOMON_ORACLE_JUDGE_CLEARANCE_H

#include <optional>

#include "gnomon/result/claims.h"
#include "gnomon/scene/prepare.h"

namespace gnomon::oracle {

struct Decision {
  std::optional<std::uint32_t> caster;  // part: covers p if shadowed, else the nearest to doing so
  std::optional<double> clearance;      // scene units
};

/// `receiver`: a part in whose plane `point` lies. Requires: a point or directional light that the
/// part faces. Cost: all casters in doubles, a few exactly.
Decision decide(const PreparedScene& scene, const PreparedLight& light, std::uint32_t receiver,
                const RationalPoint& point);

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_JUDGE_CLEARANCE_H
