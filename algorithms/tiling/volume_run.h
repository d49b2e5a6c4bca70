// SPDX-License-Identifier: LGPL-3.0-or-later
// The methods basic and tiling from a prepared scene to a result.
#ifndef GNOMON_ALGORITHMS_TILING_VOLUME_RUN_H
#define GNOMON_ALGORITHMS_TILING_VOLUME_RUN_H

#include "algorithms/basic/all_volumes.h"
#include "algorithms/basic/group_run.h"
#include "algorithms/tiling/by_volumes.h"
#include "algorithms/tiling/tile_volumes.h"
#include "kernel/concept/kernel_model.h"

namespace gnomon {

template <class Kernel>
Expected<ShadowResult> ByVolumes<Kernel>::run(const RunTask& task) {
  return with_light_space<Kernel>(task.options.output.stage_counts, [&]<class Space>() {
    const MethodChoice& method = task.options.method;
    return method.point == MethodId::kTiling
               ? compute_by_groups<Space, TileVolumes<Space>>(task, method.options.tiles)
               : compute_by_groups<Space, AllVolumes<Space>>(task);
  });
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_TILING_VOLUME_RUN_H
