// SPDX-License-Identifier: GPL-3.0-or-later
// Checks what preparation made of a scene, for a wrong part would fool everything after it:
// positions are the scene's, parts are planar, strictly convex and oriented, families really
// coplanar and distinct, and the parts of a polygon tile its loop without its holes. Own exact
// geometry throughout.
#ifndef GNOMON_ORACLE_PREPARED_CHECK_H
#define GNOMON_ORACLE_PREPARED_CHECK_H

#include <cstdint>
#include <string>
#include <vector>

#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"

namespace gnomon::oracle {

struct PreparedFinding {
  std::string polygon;  // id, empty if it concerns the whole scene
  std::string text;     // one sentence
};

/// Empty if all is well. At most `most` findings. Cost: linear for polygons that are one part.
std::vector<PreparedFinding> check_prepared(const Scene& scene, const PreparedScene& prepared,
                                            std::size_t most = 100);

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_PREPARED_CHECK_H
