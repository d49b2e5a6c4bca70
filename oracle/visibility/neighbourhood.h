// SPDX-License-Identifier: GPL-3.0-or-later
// What is next to a point whose way to the light touches casters along their edges, or starts on
// one: light, shadow or both. Only the last is a border; a point on the edge that two casters
// share is in shadow like all around it.
//
// Derivation. The shadow of a caster on R is an intersection of half-spaces (point_regions.h).
// Those that a point p is inside of hold all around it; those on whose border it lies cut the
// directions from p, in R's plane, to a sector. The rays that bound all sectors, and those of R's
// own parts, divide the directions; one direction of each division tells of all of it.
//
// Exactness: exact, in rational numbers.
#ifndef GNOMON_ORACLE_VISIBILITY_NEIGHBOURHOOD_H
#define GNOMON_ORACLE_VISIBILITY_NEIGHBOURHOOD_H

#include <cstdint>
#include <span>

#include "gnomon/oracle/visibility.h"
#include "gnomon/result/claims.h"
#include "gnomon/scene/prepare.h"

namespace gnomon::oracle {

/// kLit or kShadow (with a caster that shadows some of it) if that holds for all of R close to the
/// point; else kBoundary. `receivers`: coplanar parts that hold the point, which a side of theirs
/// that faces the light sees. `casters`: at least those that touch the way from the point to the
/// light. Requires: a point or directional light.
PointVisibility visibility_around(const PreparedScene& scene, const PreparedLight& light,
                                  std::span<const std::uint32_t> receivers,
                                  const RationalPoint& point,
                                  std::span<const std::uint32_t> casters);

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_VISIBILITY_NEIGHBOURHOOD_H
