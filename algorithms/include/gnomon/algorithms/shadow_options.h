// SPDX-License-Identifier: LGPL-3.0-or-later
// What a caller can ask of a run of shadows: kernel and method, output, limits, tuning.
#ifndef GNOMON_ALGORITHMS_SHADOW_OPTIONS_H
#define GNOMON_ALGORITHMS_SHADOW_OPTIONS_H

#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

#include "gnomon/algorithms/method.h"
#include "gnomon/algorithms/method_options.h"
#include "gnomon/algorithms/shadow_result.h"
#include "gnomon/kernel/kernel_list.h"
#include "gnomon/kernel/kernel_options.h"

namespace gnomon {

/// The kernel that decides, and what a rounded one is told besides.
struct KernelPolicy {
  KernelId id = KernelId::kPlane;
  bool identity = false;                 // for rounded kernels; `plane` always knows
  double thickness = kDefaultThickness;  // relative to the scene's diagonal; rounded kernels only

  KernelOptions options() const { return {identity, thickness}; }
};

/// The methods, and what changes their work but not the areas that they find.
struct MethodChoice {
  MethodId point = MethodId::kAutomatic;  // for point and directional lights
  MethodId area = MethodId::kAutomatic;   // for area lights
  bool prefix = true;                     // balanced prefix of light space
  std::uint64_t seed = 1;                 // of the root choice of the scene BSP
  MethodOptionValues options;             // each method reads its own
};

/// What the result holds besides classes and nearest fractions.
struct ShadowOutput {
  bool points = false;           // of fragments, nearest doubles
  bool exact_points = false;     // of fragments, exact rationals
  bool exact_fractions = false;  // exact rational sums for each part (exact kernels)
  bool merge = true;             // merge sibling fragments, collapse parts that agree
  bool combined = false;         // the set of lights that reach each fragment; at most 64 lights
  bool stage_counts = false;     // ShadowResult::stages (kernel plane)
};

/// What ends a run with kLimit.
struct ShadowLimits {
  std::uint64_t fragments = 20'000'000;  // pieces of the scene BSP, and fragments of one light
};

/// How the work is shared out; no answer depends on it.
struct ShadowTuning {
  unsigned jobs = 0;  // threads; 0: as many as processors
  // Sectors: cells of at most leaf_size polygons are not split, those of at most task_size are one
  // thread's (0: by the size of the scene).
  std::uint32_t leaf_size = 16, task_size = 0;
};

/// How a caller watches a run, takes what is done, and stops it.
struct RunControl {
  std::function<void(double)> progress;            // fraction of the work done, 0..1; may be empty
  const std::atomic<bool>* interrupted = nullptr;  // checked between polygons
  /// Takes the result of each light as soon as it is there, in the order of lights, one call at a
  /// time, on any thread of the run; ShadowResult::lights then stays empty. False stops the run
  /// (kInterrupted). May be empty: all results are kept.
  std::function<bool(LightResult&&)> light_done;
  /// Is shown the result of each step (ShadowOptions::steps), the first included, as soon as it is
  /// there. False stops the run (kInterrupted).
  std::function<bool(const ShadowResult&)> step_done;
};

struct ShadowOptions {
  KernelPolicy kernel;
  MethodChoice method;
  std::vector<std::uint32_t> lights;  // indices into PreparedScene::lights; empty: all
  /// Lights that move: the lights of each further step, as many as `lights` and each in the place
  /// of the one that it has moved from. All positions of a light are lights of the scene. Needs
  /// `output.combined`, point and directional lights, and svbsp. Each step has the result of a run
  /// of its lights alone; what has not changed since the step before is not done again. The result
  /// that is returned has no lights.
  std::vector<std::vector<std::uint32_t>> steps;
  ShadowOutput output;
  ShadowLimits limits;
  ShadowTuning tuning;
  RunControl control;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SHADOW_OPTIONS_H
