// SPDX-License-Identifier: LGPL-3.0-or-later
// compute_pixels() with rules other than those of the definition, for who judges results.
#ifndef GNOMON_ALGORITHMS_RUN_COMPUTE_PIXELS_H
#define GNOMON_ALGORITHMS_RUN_COMPUTE_PIXELS_H

#include "algorithms/partition/rules.h"
#include "gnomon/algorithms/pixels.h"

namespace gnomon {

Expected<Pixels> compute_pixels_with(const PreparedScene& scene, const ImageFrame& frame,
                                     const PixelOptions& options, const Rules& rules);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_RUN_COMPUTE_PIXELS_H
