// SPDX-License-Identifier: LGPL-3.0-or-later
// What a program says of the samples of a picture: a camera, and at each sample the polygon that is
// seen and the lights that reach it (docs: formats, "Pixels: gnomon-pixels"). Of our own methods
// and of foreign programs alike.
#ifndef GNOMON_RESULT_PIXEL_CLAIMS_H
#define GNOMON_RESULT_PIXEL_CLAIMS_H

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/kernel/error.h"
#include "gnomon/scene/camera.h"
#include "gnomon/scene/scene.h"

namespace gnomon {

struct PixelClaims {
  static constexpr std::uint32_t kNothing = 0xffffffffu;
  static constexpr std::size_t kMostLights = 64;

  std::string name;                    // of the file or of the candidate, for messages
  std::string geometry;                // digest of the scene it was made from; empty: not told
  std::string kernel, algorithm;       // empty: not told
  ExactCamera camera;                  // its size is that of the picture
  std::vector<std::uint32_t> lights;   // indices into Scene::lights; bit b of a sample is lights[b]
  std::vector<std::uint32_t> polygon;  // a sample each, rows from the top: index into
                                       // Scene::polygons, or kNothing
  std::vector<std::uint64_t> lit_by;   // a sample each: the lights that reach it
};

/// Needs `camera` with `eye`, `right`, `up` and `forward`, `width`, `height`, `lights`, `polygons`
/// and `rows`; `format` and `version` are checked if they are there, other keys are ignored.
/// Errors: kFile, kSyntax (with line and column), kFormat, kNumber, kLimit (with the JSON pointer).
Expected<PixelClaims> read_pixel_claims(const std::string& path, const Scene& scene);
/// The same from text; `file` is for messages.
Expected<PixelClaims> parse_pixel_claims(std::string_view text, const std::string& file,
                                         const Scene& scene);

}  // namespace gnomon

#endif  // GNOMON_RESULT_PIXEL_CLAIMS_H
