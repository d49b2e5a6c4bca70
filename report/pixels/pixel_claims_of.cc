// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/pixels/pixel_claims_of.h"

namespace gnomon::report {

PixelClaims pixel_claims_of(const Pixels& pixels, const PreparedScene& prepared,
                            const ExactCamera& camera) {
  PixelClaims claims;
  claims.name = pixels.kernel + '/' + pixels.algorithm;
  claims.kernel = pixels.kernel;
  claims.algorithm = pixels.algorithm;
  claims.camera = camera;
  for (const std::uint32_t light : pixels.lights) {
    claims.lights.push_back(prepared.lights[light].light);
  }
  claims.polygon.reserve(pixels.part.size());
  for (const std::uint32_t part : pixels.part) {
    claims.polygon.push_back(part == Pixels::kNoPart ? PixelClaims::kNothing
                                                     : prepared.parts[part].polygon);
  }
  claims.lit_by = pixels.lit_by;
  return claims;
}

}  // namespace gnomon::report
