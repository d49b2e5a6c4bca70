// SPDX-License-Identifier: GPL-3.0-or-later
// Where an error comes from: what is special about the polygon that has it, the caster that decides
// there and the light. Part of what tells failures apart, so that shrinking does not make another
// failure of one (a skylight all but in its roof became a needle a million units long).
//
// A cause is one word: the first of these that holds of the polygon and the caster. If no caster
// decides, the first five are looked for with any: contacts are everywhere, and need not matter.
//   light-in-plane  the light lies in the plane of one of them
//   near-coplanar   each lies within 1e-6 of their extent of the other's plane, not in it
//   grazing         the light is within 1e-6 radians of the plane of one of them
//   sliver          one of them has less than 1e-6 of the area of a square of its diameter
//   far             they are a million diameters away from the origin
//   shared-edge, shared-vertex
//   touching        a vertex of one lies exactly in the plane of the other, on it
//   crossing        each has vertices on both sides of the other's plane
//   general         nothing of all that
#ifndef GNOMON_FUZZ_CHECK_CAUSE_H
#define GNOMON_FUZZ_CHECK_CAUSE_H

#include <string>
#include <string_view>

#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"

namespace gnomon::fuzz {

/// By ids; `caster` may be empty. Empty if the polygon has no parts. Exact but for lengths, which
/// are rounded. Under an area light nothing is said of the light. Cost: linear in the scene where
/// there is no caster.
std::string cause_of(const Scene& scene, const PreparedScene& prepared, std::string_view light,
                     std::string_view polygon, std::string_view caster);

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_CHECK_CAUSE_H
