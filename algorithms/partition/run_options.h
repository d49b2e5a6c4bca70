// SPDX-License-Identifier: LGPL-3.0-or-later
// What the algorithms of one light are told, whichever they are: the output that is wanted, how
// work is shared out, limits, interruption. The public options (ShadowOptions) choose kernels and
// methods besides; run_options_of() takes these from them (run_task.h).
#ifndef GNOMON_ALGORITHMS_PARTITION_RUN_OPTIONS_H
#define GNOMON_ALGORITHMS_PARTITION_RUN_OPTIONS_H

#include <atomic>

#include "gnomon/algorithms/shadow_options.h"

namespace gnomon {

struct RunOptions {
  ShadowOutput output;
  ShadowLimits limits;
  ShadowTuning tuning;
  bool prefix = true;                              // balanced prefix of light space
  const std::atomic<bool>* interrupted = nullptr;  // checked between polygons

  bool keeps_any_points() const { return output.points || output.exact_points; }
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PARTITION_RUN_OPTIONS_H
