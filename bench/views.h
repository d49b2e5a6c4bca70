// SPDX-License-Identifier: GPL-3.0-or-later
// Where pictures of the benchmarks are seen from.
#ifndef GNOMON_BENCH_VIEWS_H
#define GNOMON_BENCH_VIEWS_H

#include <cstdint>

#include "gnomon/kernel/error.h"
#include "gnomon/scene/camera.h"
#include "gnomon/scene/scene.h"

namespace gnomon::bench {

/// From a corner above the scene, all of it in view, in `size` x `size` samples; few digits, so
/// that the grid stays small. Errors: those of prepare(), make_camera() and prepare_view().
Expected<PreparedView> view_from_a_corner(const Scene& scene, std::uint32_t size,
                                          ExactCamera& camera);

}  // namespace gnomon::bench

#endif  // GNOMON_BENCH_VIEWS_H
