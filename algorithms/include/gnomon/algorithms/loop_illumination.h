// SPDX-License-Identifier: LGPL-3.0-or-later
// What a point receives of a visible piece of an area light, in plain doubles: the 1992 paper's
// contour integral of fragments that any kernel has found, as a program without bounds computes it.
//
// Exactness: none; about 12 u a term, u = 2^-53, of terms that cancel where a light is small or
// grazing. Illuminator (gnomon/algorithms/illumination.h) computes the same with a proven bound.
// Reference: Chin & Feiner 1992, "Diffuse illumination equation". Docs: illumination.md.
#ifndef GNOMON_ALGORITHMS_LOOP_ILLUMINATION_H
#define GNOMON_ALGORITHMS_LOOP_ILLUMINATION_H

#include <array>
#include <span>

namespace gnomon {

/// 1/2 sum alpha cos(beta) over the edges of a convex loop, counter-clockwise seen from the front
/// of the light, for a light of intensity 1; pi under a whole sky. `point` receives, on a side of
/// unit normal `normal`; loop and point in the same units. Requires: the loop is in front of the
/// point's plane. 0 for loops of fewer than three vertices.
double loop_illumination(std::span<const std::array<double, 3>> loop,
                         const std::array<double, 3>& point, const std::array<double, 3>& normal);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_LOOP_ILLUMINATION_H
