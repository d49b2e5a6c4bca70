// SPDX-License-Identifier: GPL-3.0-or-later
// Our own samples as claims, so that they are written and judged like anybody's.
#ifndef GNOMON_REPORT_PIXELS_PIXEL_CLAIMS_OF_H
#define GNOMON_REPORT_PIXELS_PIXEL_CLAIMS_OF_H

#include "gnomon/algorithms/pixels.h"
#include "gnomon/result/pixel_claims.h"

namespace gnomon::report {

/// `camera`: the one that the pixels were made with.
PixelClaims pixel_claims_of(const Pixels& pixels, const PreparedScene& prepared,
                            const ExactCamera& camera);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_PIXELS_PIXEL_CLAIMS_OF_H
