// SPDX-License-Identifier: LGPL-3.0-or-later
// Area by number of casters: how many polygons lie between each point of a polygon and a point or
// directional light. Shades that let some light through need it: behind n of them that each pass a
// share t, t^n is left.
//
// A caster counts once for each of its convex parts that meets the open segment to the light: a
// planar polygon once, however it was cut into parts; a bent one as often as the segment passes
// through it. What casts is as for shadows: of a solid whose faces look outwards only those that
// face the light, of `two_sided` polygons both sides, none in the receiver's own plane. Casters
// that lie in one plane count each for itself. Area of count 0 is what is lit.
//
// Exactness: on exact kernels exact; shares of a part add up to exactly 1. By sectors (docs:
// algorithms, "Counting casters").
#ifndef GNOMON_ALGORITHMS_CASTER_COUNTS_H
#define GNOMON_ALGORITHMS_CASTER_COUNTS_H

#include <gmpxx.h>

#include <cstdint>
#include <vector>

#include "gnomon/algorithms/shadow_options.h"
#include "gnomon/algorithms/shadow_result.h"
#include "gnomon/kernel/error.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

/// How much of a part's side lies behind so many casters, as seen from the light.
struct CasterCount {
  std::uint32_t part = 0;
  std::uint32_t count = 0;
  Interval share;   // of the part's area; for rounded kernels lower == upper
  mpq_class exact;  // where exact fractions were asked for; else 0
};

struct CasterCounts {
  std::uint32_t light = 0;          // index into PreparedScene::lights
  std::vector<CasterCount> shares;  // of the parts that face it, ascending by part and count
};

/// Reads kernel, lights, exact_fractions, limits (fragments: pieces of one light), jobs and control
/// of the options. Errors: kUsage (an area light; what compute_shadows() says), kLimit,
/// kInterrupted.
Expected<std::vector<CasterCounts>> count_casters(const PreparedScene& scene,
                                                  const ShadowOptions& options);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CASTER_COUNTS_H
