// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the file `gnomon-pixels` (docs: formats): the camera as it is exactly, and each row as
// runs of samples that see the same polygon under the same lights.
#ifndef GNOMON_REPORT_PIXELS_PIXELS_JSON_H
#define GNOMON_REPORT_PIXELS_PIXELS_JSON_H

#include "gnomon/result/pixel_claims.h"
#include "report/text/text_sink.h"

namespace gnomon::report {

/// `claims.geometry` is written as it is. Errors: kNumber, for an eye that has no text under the
/// scene's numbers.
Expected<void> write_pixels_json(TextSink& sink, const Scene& scene, const PixelClaims& claims);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_PIXELS_PIXELS_JSON_H
