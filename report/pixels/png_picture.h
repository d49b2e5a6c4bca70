// SPDX-License-Identifier: GPL-3.0-or-later
// Samples as a PNG picture: a pixel a sample, the warmer the more of the lights reach it, shaded a
// little by how the polygon is turned, so that edges show in shadow, too.
#ifndef GNOMON_REPORT_PIXELS_PNG_PICTURE_H
#define GNOMON_REPORT_PIXELS_PNG_PICTURE_H

#include <string>

#include "gnomon/result/pixel_claims.h"
#include "gnomon/scene/prepare.h"

namespace gnomon::report {

/// The bytes of the file. `prepared`: the claims' scene. Errors: kLimit (libpng could not).
Expected<std::string> png_picture(const PreparedScene& prepared, const PixelClaims& claims);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_PIXELS_PNG_PICTURE_H
