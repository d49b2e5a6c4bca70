// SPDX-License-Identifier: GPL-3.0-or-later
// Results with a mistake in them.
#ifndef GNOMON_FUZZ_MISTAKES_COMPUTE_H
#define GNOMON_FUZZ_MISTAKES_COMPUTE_H

#include "fuzz/mistakes/mistake.h"
#include "gnomon/algorithms/pixels.h"
#include "gnomon/algorithms/shading_mesh.h"
#include "gnomon/algorithms/shadows.h"

namespace gnomon::fuzz {

/// As compute_shadows() of the product, which kNone calls. Errors: kUsage besides (a mistake that
/// changes nothing for any of the lights, or of lights together).
Expected<ShadowResult> compute_shadows(const PreparedScene& scene, const ShadowOptions& options,
                                       Mistake mistake);

/// As compute_pixels() of the product. Errors: kUsage besides (a mistake that changes nothing).
Expected<Pixels> compute_pixels(const PreparedScene& scene, const ImageFrame& frame,
                                const PixelOptions& options, Mistake mistake);

/// As make_shading_mesh() of the product.
Expected<ShadingMesh> make_shading_mesh(const PreparedScene& scene, const ShadowResult& result,
                                        const ShadeFunction& shade, const ShadingOptions& options,
                                        Mistake mistake);

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_MISTAKES_COMPUTE_H
