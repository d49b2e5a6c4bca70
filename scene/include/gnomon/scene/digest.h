// SPDX-License-Identifier: LGPL-3.0-or-later
// The fingerprint of a scene's geometry, by which a result names what it was computed for.
//
// It is the SHA-256 of this text, lines ending in LF:
//   gnomon-geometry 1
//   v X Y Z            for each vertex
//   p FLAGS I J K ...  for each polygon: its loop; FLAGS is - or of c (casts), t (two-sided,
//   whether
//                      its own or the scene's), in this order
//   h I J K ...        for each hole of the polygon before
// A coordinate is 0 or M:A:B for M * 2^A * 5^B, with M an integer (hexadecimal, lower case, minus
// sign) without factors 2 and 5, and A, B in decimal. So equal values give equal lines, whether
// they were written as doubles or as decimals. Names, ids, lights and "extra" are not part of it.
#ifndef GNOMON_SCENE_DIGEST_H
#define GNOMON_SCENE_DIGEST_H

#include <string>

#include "gnomon/scene/scene.h"

namespace gnomon {

/// "sha256:" and 64 hexadecimal digits.
std::string geometry_digest(const Scene& scene);

}  // namespace gnomon

#endif  // GNOMON_SCENE_DIGEST_H
