// SPDX-License-Identifier: GPL-3.0-or-later
// What a computation took: time by phase, memory, and which stage answered the decisions.
#ifndef GNOMON_CLI_COMMON_STATISTICS_H
#define GNOMON_CLI_COMMON_STATISTICS_H

#include <string>

#include "cli/common/scene_options.h"
#include "cli/common/stopwatch.h"
#include "gnomon/algorithms/shadow_result.h"

namespace gnomon::cli {

struct PhaseTimes {
  Seconds shadows;  // the scene BSP included
  Seconds output;
};

/// For people; some lines. Peak memory is that of the process so far.
std::string statistics_text(const LoadedScene& loaded, const ShadowResult& result,
                            const PhaseTimes& times);
/// Of that the times and the memory alone; `scene_bsp_seconds`: within `shadows`, 0 if there is
/// none.
std::string times_text(const LoadedScene& loaded, const PhaseTimes& times,
                       double scene_bsp_seconds = 0);

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMON_STATISTICS_H
