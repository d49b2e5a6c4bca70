// SPDX-License-Identifier: LGPL-3.0-or-later
// Balls around parts, for what can be set aside before anything is asked of a kernel: rows of a
// picture that a part does not reach, and pairs of parts that are apart as seen from a light.
//
// Guarantee: never too few. Every ball holds its part, exactly; distances are compared with a
// margin far above what doubles lose: 2^-40 of every length that takes part, and 2^-46 of the
// coordinates, which are nearest doubles (off by 2^-53 of themselves).
#ifndef GNOMON_ALGORITHMS_PIXELS_PART_BALLS_H
#define GNOMON_ALGORITHMS_PIXELS_PART_BALLS_H

#include <array>
#include <cstdint>
#include <vector>

#include "algorithms/partition/box.h"
#include "gnomon/kernel/image_frame.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

class PartBalls {
 public:
  PartBalls(const PreparedScene& scene, const ImageFrame& frame);

  /// Does no ray of the row meet the part?
  bool misses_row(std::uint32_t part, std::uint32_t row) const;
  /// Does no ray to the light meet both parts?
  bool are_apart(const LightPoint& light, std::uint32_t a, std::uint32_t b) const;
  /// A box of the part's outline as the light sees it: of a lamp on the sphere of directions around
  /// it, of a sun across its rays, flat in the third coordinate. No ray meets two parts whose boxes
  /// are apart.
  Box outline(const LightPoint& light, std::uint32_t part) const;

 private:
  using Vector = std::array<double, 3>;
  struct Ball3 {
    Vector centre{};
    double radius = 0;
  };

  Vector eye_;
  double margin_ = 0;  // of coordinates
  std::vector<Ball3> balls_;
  std::vector<Vector> row_normals_;  // of length 1, of the planes of rows through the eye
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PIXELS_PART_BALLS_H
