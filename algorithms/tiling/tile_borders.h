// SPDX-License-Identifier: LGPL-3.0-or-later
// Where the tiles are (Slater 1992, sec. 5). Around a point light: on the six faces of an axis
// cube, each of n rows and n columns; face k is the cone of directions whose component w has sign s
// and is the largest. A directional light has one face, the bounding rectangle of all facing
// vertices in its chart.
//
// Exactness: every border between tiles is a plane through the light with integer coefficients, the
// same on every kernel. All facing polygons are inside the faces' outer borders, exactly.
#ifndef GNOMON_ALGORITHMS_TILING_TILE_BORDERS_H
#define GNOMON_ALGORITHMS_TILING_TILE_BORDERS_H

#include <array>
#include <cstdint>
#include <span>

#include "gnomon/scene/prepare.h"
#include "kernel/concept/light_space.h"

namespace gnomon {

class TileBorders {
 public:
  /// `parts`: those that face the light.
  TileBorders(const PreparedScene& scene, const LightPoint& light,
              std::span<const std::uint32_t> parts, std::uint32_t tiles);

  std::uint32_t tiles() const { return tiles_; }
  std::uint32_t faces() const { return directional_ ? 1 : 6; }
  bool directional() const { return directional_; }
  LightChart chart(std::uint32_t face) const;
  /// The border `index` of a face, 0 to tiles(), along axis 0 (u) or 1 (v); its front is where the
  /// coordinate is larger.
  PrefixPlane border(std::uint32_t face, int axis, std::uint32_t index) const;
  /// Its coordinate in the chart, rounded; to find the tile of a point before a border is asked.
  double coordinate(int axis, std::uint32_t index) const;

 private:
  /// A directional light's borders are at (low + index * width) * 2^-kBits.
  struct Axis {
    std::int64_t low = 0, width = 1;
  };
  static constexpr int kBits = 36;

  std::uint32_t tiles_;
  bool directional_;
  int sign_ = 1;  // of a directional light's largest component
  unsigned grid_bits_;
  std::array<Axis, 2> axes_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_TILING_TILE_BORDERS_H
