// SPDX-License-Identifier: LGPL-3.0-or-later
// What is looked at, the sky or a polygon, as convex pieces with homogeneous vertices, from which
// the cones of casters are taken away. A vertex (x, w) is the point x / w, or with w = 0 the
// direction x, so that the sky is a polygon like any other: its pieces lie at infinity.
//
// Everything is in doubles of a scene of extent 1, and conservative by margins: what is left is
// grown or shrunk by more than coordinates and cuts are off.
#ifndef GNOMON_ALGORITHMS_FORM_FACTORS_TARGET_PIECES_H
#define GNOMON_ALGORITHMS_FORM_FACTORS_TARGET_PIECES_H

#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/form_factors/vectors.h"

namespace gnomon {

struct TargetPoint {
  Vector x{};
  double w = 0;
};
using TargetPiece = std::vector<TargetPoint>;  // convex

/// Values below it are not told from 0, in a scene of extent 1.
inline constexpr double kMargin = 1e-12;

/// A half-space: normal . x - offset w > 0. The normal has length 1, the value at any point of the
/// scene or direction is off by at most the margin.
struct HalfSpace {
  Vector normal{};
  double offset = 0;
  double margin = kMargin;
  double at(const TargetPoint& point) const { return dot(normal, point.x) - offset * point.w; }
};

/// The piece in front of the half-space moved by `shift` (in its direction); empty if nothing is.
TargetPiece front_of(const TargetPiece& piece, const HalfSpace& half_space, double shift);

/// How what is left stands to the truth: certainly not less, certainly not more, or as near as
/// doubles come.
enum class Leaves : std::uint8_t { kMore, kLess, kNearest };

/// Takes an intersection of half-spaces away from all pieces.
void take_away(std::vector<TargetPiece>& pieces, std::span<const HalfSpace> cone, Leaves leaves);

/// Whether some of the pieces may reach into the cone.
bool may_reach(std::span<const TargetPiece> pieces, std::span<const HalfSpace> cone);

/// 1 / pi of the integral of the cosine to `normal` over what a point sees of the piece: its form
/// factor to it (Lambert's formula). Requires: all of the piece in front.
double point_factor(const TargetPiece& piece, const Vector& point, const Vector& normal);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_FORM_FACTORS_TARGET_PIECES_H
