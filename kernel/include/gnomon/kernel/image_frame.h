// SPDX-License-Identifier: LGPL-3.0-or-later
// The samples of a picture, exactly: an eye on the scene's grid, three integer vectors for right,
// up and forward, and a raster. Sample (i, j), column and row, row 0 on top, looks along
//
//   d = w h F + h (2 i + 1 - w) R + w (h - 1 - 2 j) U,
//
// an integer vector. R reaches from the middle of the picture to its right side, U to its top, at
// the distance F. The three need not be orthogonal.
//
// A sample that meets a border is moved infinitesimally along R, and if that does not decide, along
// U, so that every sample is of exactly one of two neighbours. The definition of all this is
// docs/image-space.md.
#ifndef GNOMON_KERNEL_IMAGE_FRAME_H
#define GNOMON_KERNEL_IMAGE_FRAME_H

#include <array>
#include <bit>
#include <cstdint>

#include "gnomon/kernel/geometry.h"

namespace gnomon {

/// A column and a row of a picture.
struct ImageSample {
  std::uint32_t i = 0, j = 0;
  friend bool operator==(ImageSample, ImageSample) = default;
};

/// What happens to a plane's own sign when a sample that is in another plane is moved: nothing, by
/// definition. kPlaneTurns is the mistake of moving the sample in the whole formula, and is there
/// for tests (docs/bug-zoo.md, tie-turns-plane).
enum class TieRule : std::uint8_t { kPlaneStays, kPlaneTurns };

struct ImageFrame {
  using Direction = std::array<std::int64_t, 3>;

  /// Of a component of R, U or F: at most 2^15 - 1, which is 16 bits with its sign.
  static constexpr std::int32_t kLargestComponent = 0x7fff;
  /// Of width times height.
  static constexpr std::uint64_t kMostSamples = std::uint64_t{1} << 28;

  LightPoint eye;  // not directional: a position on the scene's grid
  std::array<std::int32_t, 3> right{}, up{}, forward{};
  std::uint32_t width = 0, height = 0;
  TieRule ties = TieRule::kPlaneStays;

  /// Of a sample, or of any point (i, j) of the raster.
  Direction direction(ImageSample sample) const {
    const auto w = static_cast<std::int64_t>(width), h = static_cast<std::int64_t>(height);
    const std::int64_t along = 2 * std::int64_t{sample.i} + 1 - w;
    const std::int64_t upwards = h - 1 - 2 * std::int64_t{sample.j};
    Direction d;
    for (std::size_t k = 0; k < 3; ++k) {
      d[k] = w * h * forward[k] + h * along * right[k] + w * upwards * up[k];
    }
    return d;
  }
  /// Signed bits of a direction's component: three terms below 2^15 w h.
  unsigned direction_bits() const {
    return 16 + static_cast<unsigned>(std::bit_width(std::uint64_t{width} * height)) + 2;
  }
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_IMAGE_FRAME_H
