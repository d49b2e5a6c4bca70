// SPDX-License-Identifier: LGPL-3.0-or-later
// The fingerprint of a scene's geometry, by which a result names what it was computed for.
//
// The fingerprint is the SHA-256 of this text, whose lines end in LF:
//   gnomon-geometry 1
//   v X Y Z            for each vertex
//   p FLAGS I J K ...  for each polygon, with its loop
//   h I J K ...        for each hole, after the line of its polygon
// FLAGS holds c if the polygon casts and t if it is two-sided (by itself or as the scene says), in
// this order, or is - if neither holds. A coordinate is 0, or M:A:B for M * 2^A * 5^B, where M is
// an integer without factors 2 and 5 (hexadecimal, lower case, with a minus sign if negative), and
// A and B are decimal. So equal values give equal lines, whether they were written as doubles or as
// decimals. Names, ids, lights and "extra" are left out.
#ifndef GNOMON_SCENE_DIGEST_H
#define GNOMON_SCENE_DIGEST_H

#include <string>

#include "gnomon/scene/scene.h"

namespace gnomon {

/// "sha256:" and 64 hexadecimal digits.
std::string geometry_digest(const Scene& scene);

}  // namespace gnomon

#endif  // GNOMON_SCENE_DIGEST_H
