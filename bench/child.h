// SPDX-License-Identifier: GPL-3.0-or-later
// One run in a process of its own, so that its peak memory is its own and its heap is fresh: the
// program starts itself again with the hidden part `child`.
#ifndef GNOMON_BENCH_CHILD_H
#define GNOMON_BENCH_CHILD_H

#include <cstdint>
#include <string>

#include "gnomon/algorithms/shadows.h"
#include "scenes.h"

namespace gnomon::bench {

struct ChildReport {
  std::uint64_t polygons = 0, facing = 0, fragments = 0, nodes = 0;
  double prepare_wall = 0, prepare_cpu = 0;                   // seconds
  double shadow_wall = 0, shadow_cpu = 0, scene_bsp_cpu = 0;  // seconds
  double lit_lower = 0, lit_upper = 0;                        // sum of the certified bounds
  std::uint64_t peak_bytes = 0;                               // resident, of the whole process
  std::uint64_t shadow_bytes = 0;                             // what the shadows added to it

  double wall() const { return prepare_wall + shadow_wall; }
  double cpu() const { return prepare_cpu + shadow_cpu; }
};

/// Generates (not timed), prepares and classifies, kernel plane, on `jobs` threads (0: all). Ends
/// the program with a message if the child fails.
ChildReport run_in_child(const SceneRecipe& recipe, MethodId algorithm, unsigned jobs,
                         MethodId area_algorithm = MethodId::kReceiver);

/// What the child does. Arguments: those after the word `child`. Returns the exit status.
int child_main(int argc, char** argv);

}  // namespace gnomon::bench

#endif  // GNOMON_BENCH_CHILD_H
