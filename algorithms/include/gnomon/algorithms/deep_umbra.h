// SPDX-License-Identifier: LGPL-3.0-or-later
// The deep umbra of an area light: where nothing of the light is visible, whatever hides it. It
// contains the umbra (one caster alone hides all), and is what the 1992 paper's umbra misses:
// "points in the gap between planes v and y at the bottom of the volume" (Figure 4(f)). Its border
// is in general curved, so that areas are enclosed, by conservative subdivision; single points are
// decided exactly by LightVisibility::is_deep_umbra.
//
// Guarantee: every decision is exact, every bound certified; the width goes to 0 as cells are
// allowed to be more and smaller. Docs: illumination.md, "Deep umbra".
#ifndef GNOMON_ALGORITHMS_DEEP_UMBRA_H
#define GNOMON_ALGORITHMS_DEEP_UMBRA_H

#include <atomic>
#include <cstdint>
#include <vector>

#include "gnomon/algorithms/shadow_result.h"
#include "gnomon/kernel/error.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

struct DeepUmbraOptions {
  /// A side is done when what is undecided of it is at most this fraction of its area,
  double tolerance = 1e-2;
  /// or when so many cells of it have been looked at.
  std::uint64_t max_cells = 4096;
  const std::atomic<bool>* interrupted = nullptr;  // checked between cells
};

/// What is in the deep umbra of one side of a part that sees the light (or of its front, if none
/// does: all of it).
struct DeepUmbraBounds {
  std::uint32_t part = 0;
  Side side = Side::kFront;
  Interval fraction;        // of the part's area
  std::uint64_t cells = 0;  // looked at
};

/// In the order of `classified`.parts. Only penumbra fragments are subdivided: the rest is decided
/// by its class. `classified` must be of an exact kernel, of an area light of this scene, and keep
/// exact points. Sides are worked on by all threads of the caller's task arena (oneTBB); the answer
/// does not depend on their number. Errors: kUsage (not such a result), kInterrupted.
Expected<std::vector<DeepUmbraBounds>> deep_umbra_bounds(const PreparedScene& scene,
                                                         const LightResult& classified,
                                                         const DeepUmbraOptions& options);

/// Classifies first, on the kernel `plane`. `light`: an index into PreparedScene::lights. Errors:
/// those of compute_shadows, too.
Expected<std::vector<DeepUmbraBounds>> deep_umbra_bounds(const PreparedScene& scene,
                                                         std::uint32_t light,
                                                         const DeepUmbraOptions& options);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_DEEP_UMBRA_H
