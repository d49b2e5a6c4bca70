// SPDX-License-Identifier: LGPL-3.0-or-later
// The one entry point: classify a prepared scene on a kernel chosen at run time.
#ifndef GNOMON_ALGORITHMS_SHADOWS_H
#define GNOMON_ALGORITHMS_SHADOWS_H

#include <atomic>
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "gnomon/algorithms/mutation.h"
#include "gnomon/algorithms/shadow_result.h"
#include "gnomon/kernel/error.h"
#include "gnomon/kernel/kernel_list.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

/// Two ways to the same answer (docs/algorithms.md).
enum class Algorithm : std::uint8_t {
  kAutomatic,  // sectors, or svbsp where only that can do it (`combined`)
  kSvbsp,      // scene BSP, front-to-back order, SVBSP tree
  kSectors,    // no order: a k-d tree of light space, subtraction of casters in its leaves
  kReceiver,   // per receiver, as area lights are: the pipeline of mixed lights, a third opinion
};

/// Ways to the penumbra and umbra of area lights.
enum class AreaAlgorithm : std::uint8_t {
  kReceiver,  // per receiver: shadow volumes of casters pair by pair, cut out of the receiver
  kMerged,    // 1992: a penumbra tree and an umbra tree of all casters, merged by true set union
  kPieces,    // 1992 to the letter: the light cut by polygon planes, classes for each piece
};

struct ShadowOptions {
  KernelId kernel = KernelId::kPlane;
  Algorithm algorithm = Algorithm::kAutomatic;  // for point and directional lights
  AreaAlgorithm area_algorithm = AreaAlgorithm::kReceiver;
  unsigned jobs = 0;  // threads of the sectors algorithm; 0: all. The answer does not depend on it
  bool identity = false;                 // for rounded kernels; `plane` always knows
  double thickness = kDefaultThickness;  // relative to the scene's diagonal; rounded kernels only
  std::vector<std::uint32_t> lights;     // indices into PreparedScene::lights; empty: all
  bool keep_points = false;              // fragments with nearest doubles
  bool keep_exact_points = false;        // fragments with exact rationals
  bool exact_fractions = false;          // sum exact rational fractions per part (exact kernels)
  bool merge = true;                     // merge sibling fragments, collapse parts that agree
  bool prefix = true;                    // balanced prefix of light space
  Mutation mutation = Mutation::kNone;   // wrong on purpose; for tests of what would notice
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

/// Whether a mistake is one that this algorithm can make on this kernel, for point and directional
/// lights, and for area lights. Of kNone it is true.
bool applies_to(Mutation mutation, KernelId kernel, Algorithm algorithm);
bool applies_to(Mutation mutation, KernelId kernel, AreaAlgorithm algorithm);

/// False for kernels that were left out of the build (GNOMON_CGAL_KERNELS).
bool has_kernel(KernelId kernel);

/// Classifies every part for every light asked for. Errors: kUsage (no such light, a thickness
/// outside [0, 1), a mutation that changes nothing for any of the lights, a kernel that was not
/// built), kInterrupted, kLimit (max_fragments; more than 64 lights with `combined`).
Expected<ShadowResult> compute_shadows(const PreparedScene& scene, const ShadowOptions& options);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SHADOWS_H
