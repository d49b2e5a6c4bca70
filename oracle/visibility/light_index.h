// SPDX-License-Identifier: GPL-3.0-or-later
// Which parts may hide a point or directional light from a part, or from a point: those that
// overlap it as seen from the light, found by a raster of boxes. Directions are drawn on the faces
// of a cube around a point light, or on one plane across a directional one.
//
// Exactness: none, and never too few: every box holds what it is the box of, with a bound of the
// rounding added, and what cannot be bounded is everywhere.
#ifndef GNOMON_ORACLE_VISIBILITY_LIGHT_INDEX_H
#define GNOMON_ORACLE_VISIBILITY_LIGHT_INDEX_H

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "gnomon/scene/prepare.h"

namespace gnomon::oracle {

class LightIndex {
 public:
  /// `casters`: parts to be found. Requires: a point or directional light.
  LightIndex(const PreparedScene& scene, const PreparedLight& light,
             const std::vector<std::uint32_t>& casters);

  /// Casters that may hide the light from some point of the part, in order; each once.
  std::vector<std::uint32_t> overlapping(std::uint32_t part) const;
  /// The same of one point, scene units, each of whose coordinates is off by no more than a unit in
  /// the last place. It may lie anywhere.
  std::vector<std::uint32_t> before(const std::array<double, 3>& point) const;

 private:
  struct Box {
    double low[2], high[2];
  };
  struct FaceBox {
    int face = 0;
    Box box;
  };
  struct Face {
    Box bounds{};
    std::size_t columns = 1, rows = 1;
    std::vector<std::vector<std::uint32_t>> cells;     // indices into boxes
    std::vector<std::uint32_t> large;                  // of too many cells
    std::vector<std::pair<Box, std::uint32_t>> boxes;  // with their part
  };
  struct Cells {
    std::size_t first[2], last[2];
    std::size_t count() const { return (last[0] - first[0] + 1) * (last[1] - first[1] + 1); }
  };

  std::vector<FaceBox> boxes_of(std::uint32_t part) const;
  std::vector<FaceBox> boxes_of(std::span<const std::array<double, 3>> corners, double error) const;
  std::vector<std::uint32_t> meeting(const std::vector<FaceBox>& boxes) const;
  static Cells cells_of(const Face& face, const Box& box);
  void arrange(Face& face) const;

  const PreparedScene& scene_;
  bool directional_;
  std::array<double, 3> light_{};  // position, or direction with a component of 1 or -1
  int axis_ = 2;                   // of that component
  double error_ = 0;               // of a difference of coordinates
  std::vector<Face> faces_;
  std::vector<std::uint32_t> everywhere_;  // all casters, if there are no faces
};

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_VISIBILITY_LIGHT_INDEX_H
