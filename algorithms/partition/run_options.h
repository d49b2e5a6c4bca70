// SPDX-License-Identifier: LGPL-3.0-or-later
// What the algorithms of one light are told, whichever they are: the output that is wanted, how
// work is shared out, limits, interruption. The public options (ShadowOptions) choose kernels and
// methods besides; run_options_of() takes these from them (run_task.h).
#ifndef GNOMON_ALGORITHMS_PARTITION_RUN_OPTIONS_H
#define GNOMON_ALGORITHMS_PARTITION_RUN_OPTIONS_H

#include <atomic>
#include <cstdint>

namespace gnomon {

struct RunOptions {
  // The output.
  bool keep_points = false;        // fragments with nearest doubles
  bool keep_exact_points = false;  // fragments with exact rationals
  bool exact_fractions = false;    // sum exact rational fractions per part
  bool merge = true;               // merge sibling fragments, collapse parts that agree
  // How the work is done; the areas do not depend on it.
  bool prefix = true;                           // balanced prefix of light space
  std::uint32_t leaf_size = 16, task_size = 0;  // of the sectors; 0: by the size of the scene
  unsigned jobs = 0;                            // threads; 0: all
  // When to stop.
  std::uint64_t max_fragments = 20'000'000;        // of one light
  const std::atomic<bool>* interrupted = nullptr;  // checked between polygons

  bool keeps_any_points() const { return keep_points || keep_exact_points; }
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PARTITION_RUN_OPTIONS_H
