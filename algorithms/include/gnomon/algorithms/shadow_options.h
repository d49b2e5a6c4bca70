// SPDX-License-Identifier: LGPL-3.0-or-later
// What a caller can ask of a run of shadows: kernel and method, output, limits, tuning.
#ifndef GNOMON_ALGORITHMS_SHADOW_OPTIONS_H
#define GNOMON_ALGORITHMS_SHADOW_OPTIONS_H

#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

#include "gnomon/algorithms/method.h"
#include "gnomon/kernel/kernel_list.h"

namespace gnomon {

struct ShadowOptions {
  KernelId kernel = KernelId::kPlane;
  MethodId algorithm = MethodId::kAutomatic;      // for point and directional lights
  MethodId area_algorithm = MethodId::kReceiver;  // for area lights
  unsigned jobs = 0;  // threads of the sectors algorithm; 0: all. The answer does not depend on it
  bool identity = false;                 // for rounded kernels; `plane` always knows
  double thickness = kDefaultThickness;  // relative to the scene's diagonal; rounded kernels only
  std::vector<std::uint32_t> lights;     // indices into PreparedScene::lights; empty: all
  bool keep_points = false;              // fragments with nearest doubles
  bool keep_exact_points = false;        // fragments with exact rationals
  bool exact_fractions = false;          // sum exact rational fractions per part (exact kernels)
  bool merge = true;                     // merge sibling fragments, collapse parts that agree
  bool prefix = true;                    // balanced prefix of light space
  // Sectors: cells of at most leaf_size polygons are not split, those of at most task_size are one
  // thread's (0: by the size of the scene). The areas do not depend on them.
  std::uint32_t leaf_size = 16, task_size = 0;
  bool combined = false;  // also the set of lights that reach each fragment; at most 64 lights
  std::uint64_t max_fragments =
      20'000'000;                        // pieces of the scene BSP, and fragments a light: kLimit
  bool count_stages = false;             // fill ShadowResult::stages (kernel plane)
  std::uint64_t seed = 1;                // of the root choice of the scene BSP
  std::function<void(double)> progress;  // fraction of the work done, 0..1; may be empty
  const std::atomic<bool>* interrupted = nullptr;  // checked between polygons
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SHADOW_OPTIONS_H
