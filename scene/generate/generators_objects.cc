// SPDX-License-Identifier: LGPL-3.0-or-later
// Objects made of convex sub-objects, as Crow (1977) wants scenes to be for his second class.
#include <algorithm>
#include <array>
#include <vector>

#include "scene/base/random.h"
#include "scene/generate/scene_maker.h"
#include "scene/generate/scene_shapes.h"

namespace gnomon::scene_detail {
namespace {

/// A convex solid in the cube [low, low + 8]: a box that fills it, so that neighbours share whole
/// faces, or something smaller.
void solid(SceneMaker& maker, const std::string& id, Int3 low, Random& random) {
  constexpr std::int64_t kCell = 8;
  const Int3 foot = low + Int3{kCell / 2, kCell / 2, 0};
  switch (random.between(0, 4)) {
    case 0:
      return hexagonal_prism(maker, id, foot, 3, kCell);
    case 1:
      return octahedron(maker, id, foot + Int3{0, 0, kCell / 2}, random.between(2, 4));
    case 2:
      return tetrahedron(
          maker, id,
          {low, low + Int3{kCell, 0, 0}, low + Int3{0, kCell, 0},
           low + Int3{random.between(1, kCell - 1), random.between(1, kCell - 1), kCell}});
    default:
      return maker.box(id, low, low + Int3{kCell, kCell, kCell});
  }
}

// Groups of solids in a cube of 2 x 2 x 2 cells each, on a raster of lots; no two solids overlap,
// groups do not touch, and no vertex is inside an edge.
void sub_objects(SceneMaker& maker, const Values& values, Random& random) {
  constexpr std::int64_t kCell = 8, kCells = 8, kLot = 24;
  const std::int64_t n = at(values, "n"), in_group = at(values, "group");
  const std::int64_t groups = (n + in_group - 1) / in_group;
  std::int64_t side = 1;
  while (side * side < groups) ++side;
  const std::int64_t width = side * kLot;
  maker.reserve(8 * n + 1, 12 * n + 4);
  floor_at(maker, {-kLot, -kLot, 0}, {width + kLot, width + kLot, 0});
  std::int64_t made = 0;
  for (std::int64_t group = 0; group < groups; ++group) {
    const Int3 lot{(group % side) * kLot + random.between(0, kLot - 2 * kCell - 1),
                   (group / side) * kLot + random.between(0, kLot - 2 * kCell - 1),
                   random.between(1, 12)};
    std::array<std::int64_t, kCells> cells{0, 1, 2, 3, 4, 5, 6, 7};
    random.shuffle(std::span<std::int64_t>(cells));
    for (std::int64_t i = 0; i < in_group && made < n; ++i, ++made) {
      const std::int64_t cell = cells[static_cast<std::size_t>(i)];
      solid(maker, "group" + std::to_string(group) + "." + std::to_string(i),
            lot + kCell * Int3{cell % 2, cell / 2 % 2, cell / 4}, random);
    }
  }
  maker.lights(values, {-2 * kLot - 1, -3 * kLot - 2, 120 + width / 3}, {-3, -5, 7}, width);
}

}  // namespace

std::vector<Generator> object_generators() {
  std::vector<Generator> result;
  result.push_back(
      {{"sub-objects",
        "n convex solids in groups, and a floor: 4 n + 1 to 8 n + 1 polygons",
        {{"n", 100, 1, 500000, "solids"}, {"group", 6, 1, 8, "solids in a group"}, kLightParameter},
        "Crow 1977, class two: objects of linearly separable convex sub-objects"},
       sub_objects});
  return result;
}

}  // namespace gnomon::scene_detail
