// SPDX-License-Identifier: GPL-3.0-or-later
// What casters shadow of one plane, in its frame: the half-planes whose intersection each shadow is
// (point_regions.h), from the same exact planes, each number rounded once. Nothing is overlaid.
//
// Exactness: a line's value at a point of the receiver is off by at most kLineError times the
// greatest coordinate of receiver and claims: its trace by 2^-60 of twice the distance between two
// points of the receiver, 2 sqrt(3) M, and the point itself by kPlanarError M.
#ifndef GNOMON_ORACLE_JUDGE_BORDER_SHADES_H
#define GNOMON_ORACLE_JUDGE_BORDER_SHADES_H

#include <cstdint>
#include <vector>

#include "gnomon/oracle/exact_answer.h"
#include "oracle/geometry/planar_loop.h"
#include "oracle/geometry/plane_frame.h"

namespace gnomon::oracle {

inline constexpr long double kLineError = 4 * kPlanarError;

struct BorderShade {
  std::uint32_t caster = 0;       // part
  std::vector<PlanarLine> lines;  // what is inside of all of them is in its shadow
  PlanarLoop region;              // holds what is inside, around the receiver
  PlanarBox box;                  // of the region
};

/// All shadows on coplanar parts of one polygon. `around`: holds them. `error`: of a line's value.
/// Requires: a point or directional light that the parts face.
std::vector<BorderShade> border_shades(const ExactAnswer& answer, std::uint32_t light,
                                       const ReceiverGroup& group, const PlaneFrame& frame,
                                       const PlanarBox& around, long double error);

/// For each box those of the shades that it may meet, in order of the shades.
std::vector<std::vector<std::uint32_t>> shades_near(const std::vector<PlanarBox>& boxes,
                                                    const std::vector<BorderShade>& shades);

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_JUDGE_BORDER_SHADES_H
