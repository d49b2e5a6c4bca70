// SPDX-License-Identifier: LGPL-3.0-or-later
// Families that grow: cities, quads, combs, stairs, boxes in boxes, tiles, fans.
#include <algorithm>
#include <array>

#include "scene/generate/scene_maker.h"

namespace gnomon::scene_detail {
namespace {

/// Smallest s with s * s >= n.
std::int64_t side_for(std::int64_t n) {
  std::int64_t s = 1;
  while (s * s < n) ++s;
  return s;
}

// Lots of 24 units in a square; on each a box whose walls stand on a 4-unit raster, so that walls
// of many houses share planes and shadows meet edges exactly.
void city(SceneMaker& maker, const Values& values, Random& random) {
  constexpr std::int64_t kLot = 24;
  const std::int64_t n = at(values, "n");
  const std::int64_t side = side_for(n);
  const std::int64_t width = side * kLot;
  maker.reserve(5 * n + 1, 8 * n + 4);
  maker.face("ground", {{0, 0, 0}, {width, 0, 0}, {width, width, 0}, {0, width, 0}});
  for (std::int64_t i = 0; i < n; ++i) {
    const Int3 lot{(i % side) * kLot, (i / side) * kLot, 0};
    const std::int64_t x0 = 4 * random.between(0, 1), y0 = 4 * random.between(0, 1);
    const std::int64_t x1 = kLot - 4 * random.between(1, 2), y1 = kLot - 4 * random.between(1, 2);
    const std::int64_t height =
        random.chance(1, 8) ? random.between(24, 72) : 3 * random.between(2, 8);
    maker.box("house" + std::to_string(i), lot + Int3{x0, y0, 0}, lot + Int3{x1, y1, height},
              SceneMaker::kNoBottom);
  }
  if (at(values, "shuffle") != 0) maker.shuffle_polygons(random);
  const Int3 inside{(side / 2) * kLot, (side / 2) * kLot, 5};
  const Int3 outside{-2 * kLot - 1, -3 * kLot - 2, 160 + width / 8};
  maker.lights(values, at(values, "inside") != 0 ? inside : outside, {-3, -5, 7}, width);
}

// Parallelograms at random places in a cube of 2^16 units, over a floor; their size shrinks as
// 1/sqrt(n).
void quads(SceneMaker& maker, const Values& values, Random& random) {
  constexpr std::int64_t kExtent = 1 << 16;
  const std::int64_t n = at(values, "n");
  const std::int64_t reach = std::max<std::int64_t>(4, kExtent / side_for(n));
  const Int3 lamp{kExtent / 2 + 1, kExtent / 2 + 3, 2 * kExtent + 5};
  const Int3 sun{3, 5, 40};
  maker.set_two_sided(at(values, "two_sided") != 0);
  const std::int64_t margin = 2 * kExtent;
  maker.reserve(n + 1, 4 * (n + 1));
  maker.face("floor", {{-margin, -margin, -reach},
                       {kExtent + margin, -margin, -reach},
                       {kExtent + margin, kExtent + margin, -reach},
                       {-margin, kExtent + margin, -reach}});
  const auto step = [&] {
    return Int3{random.between(-reach, reach), random.between(-reach, reach),
                random.between(-reach, reach)};
  };
  for (std::int64_t i = 0; i < n;) {
    const Int3 p{random.between(0, kExtent), random.between(0, kExtent),
                 random.between(reach, kExtent)};
    const Int3 u = step();
    Int3 v = step();
    if (is_zero(cross(u, v))) continue;
    // The front looks to the light, so that every quad is lit or shadowed on its merits.
    const Int3 to_light = at(values, "light") == 1 ? sun : lamp - p;
    std::vector<Int3> loop{p, p + u, p + u + v, p + v};
    if (dot(cross(u, v), to_light) < 0) std::reverse(loop.begin(), loop.end());
    maker.face("quad" + std::to_string(i), loop);
    ++i;
  }
  maker.lights(values, lamp, sun, kExtent);
}

// Thin upright teeth side by side between a lamp and a wall: stripes of light, all of them
// parallel.
void comb(SceneMaker& maker, const Values& values, Random&) {
  const std::int64_t n = at(values, "n");
  maker.set_two_sided(true);
  maker.face("floor", {{-8, -8, 0}, {4 * n + 8, -8, 0}, {4 * n + 8, 96, 0}, {-8, 96, 0}});
  maker.face("wall", {{-8, 96, 0}, {4 * n + 8, 96, 0}, {4 * n + 8, 96, 64}, {-8, 96, 64}});
  for (std::int64_t i = 0; i < n; ++i) {
    maker.face("tooth" + std::to_string(i),
               {{4 * i, 0, 0}, {4 * i + 2, 0, 0}, {4 * i + 2, 0, 32}, {4 * i, 0, 32}});
  }
  maker.lights(values, {2 * n + 1, -40, 48}, {1, -5, 6}, 4 * n);
}

// A flight of stairs: neighbours share edges, and each side panel meets two treads in T-junctions.
void stairs(SceneMaker& maker, const Values& values, Random&) {
  const std::int64_t n = at(values, "n");
  const std::int64_t width = 16;
  maker.face("floor",
             {{-8, -8, 0}, {4 * n + 40, -8, 0}, {4 * n + 40, width + 40, 0}, {-8, width + 40, 0}});
  for (std::int64_t i = 0; i < n; ++i) {
    const std::int64_t x0 = 4 * i, x1 = 4 * i + 4, z0 = 3 * i, z1 = 3 * i + 3;
    const std::string id = "step" + std::to_string(i);
    maker.face(id + ".riser", {{x0, width, z0}, {x0, 0, z0}, {x0, 0, z1}, {x0, width, z1}});
    maker.face(id + ".tread", {{x0, 0, z1}, {x1, 0, z1}, {x1, width, z1}, {x0, width, z1}});
    maker.face(id + ".left", {{x0, 0, 0}, {x1, 0, 0}, {x1, 0, z1}, {x0, 0, z1}});
    maker.face(id + ".right", {{x0, width, 0}, {x0, width, z1}, {x1, width, z1}, {x1, width, 0}});
  }
  const std::int64_t x = 4 * n, z = 3 * n;
  maker.face("back", {{x, 0, 0}, {x, width, 0}, {x, width, z}, {x, 0, z}});
  maker.lights(values, {-10, -12, 4 * n + 20}, {-2, -1, 4}, 4 * n);
}

// Boxes in boxes, each without a lid and with a slit, walls seen from both sides; the lamp in the
// middle.
void nested_boxes(SceneMaker& maker, const Values& values, Random&) {
  const std::int64_t n = at(values, "n");
  maker.set_two_sided(true);
  const std::int64_t reach = 4 * n + 16;
  maker.face("floor",
             {{-reach, -reach, 0}, {reach, -reach, 0}, {reach, reach, 0}, {-reach, reach, 0}});
  for (std::int64_t i = 0; i < n; ++i) {
    const std::int64_t r = 4 * i + 4, h = 4 * i + 8;
    const std::string id = "box" + std::to_string(i);
    maker.box(id, {-r, -r, 0}, {r, r, h},
              SceneMaker::kSides & ~static_cast<unsigned>(SceneMaker::kRight));
    // The right wall leaves a slit open between its halves, in line with the lamp.
    maker.face(id + ".right0", {{r, -r, 0}, {r, -1, 0}, {r, -1, h}, {r, -r, h}});
    maker.face(id + ".right1", {{r, 1, 0}, {r, r, 0}, {r, r, h}, {r, 1, h}});
  }
  maker.lights(values, {0, 0, 2}, {1, 2, 9}, 8 * n);
}

// Tiles in a few horizontal planes: abutting, overlapping, one on another, and exact duplicates.
void coplanar_tiles(SceneMaker& maker, const Values& values, Random& random) {
  const std::int64_t n = at(values, "n");
  const std::int64_t size = 2 * side_for(n) + 4;
  maker.reserve(n + 1, 4 * (n + 1));
  maker.face(
      "floor",
      {{-size, -size, 0}, {2 * size, -size, 0}, {2 * size, 2 * size, 0}, {-size, 2 * size, 0}});
  std::array<std::int64_t, 5> last{};
  for (std::int64_t i = 0; i < n; ++i) {
    std::array<std::int64_t, 5> tile{random.between(0, size), random.between(0, size),
                                     random.between(1, 4), random.between(1, 4),
                                     4 * random.between(0, at(values, "levels"))};
    if (i > 0 && random.chance(1, 8)) tile = last;  // a duplicate
    if (i > 0 && random.chance(1, 4))
      tile = {last[0] + last[2], last[1], tile[2], last[3], last[4]};  // abutting
    last = tile;
    const auto [x, y, w, d, z] = tile;
    maker.face("tile" + std::to_string(i),
               {{x, y, z}, {x + w, y, z}, {x + w, y + d, z}, {x, y + d, z}});
  }
  maker.lights(values, {size / 2, size / 2, 16 * at(values, "levels") + 16}, {1, 1, 2}, size);
}

// Many polygons at one line right under the lamp: in light space all of them meet in one edge
// (pages of a book), in one point, being edge-on (blades round the plumb line), or at one vertex
// (an umbrella).
void radial_fan(SceneMaker& maker, const Values& values, Random&) {
  const std::int64_t n = at(values, "n");
  maker.set_two_sided(true);
  const std::int64_t r = 4 * n + 16;
  maker.face("floor",
             {{-2 * r, -2 * r, -r}, {2 * r, -2 * r, -r}, {2 * r, 2 * r, -r}, {-2 * r, 2 * r, -r}});
  // Directions on the border of a square, 8 n of them evenly spaced; n are taken.
  const auto rim = [&](std::int64_t i) {
    const std::int64_t k = 8 * i, side = 2 * n, q = k / side, t = k % side - n;
    return q == 0   ? Int3{n, t, 0}
           : q == 1 ? Int3{-t, n, 0}
           : q == 2 ? Int3{-n, -t, 0}
                    : Int3{t, -n, 0};
  };
  for (std::int64_t i = 0; i < n; ++i) {
    const std::string id = "page" + std::to_string(i);
    const Int3 d = rim(i), e = rim((i + 1) % n);
    switch (at(values, "kind")) {
      case 0: {  // pages hinge on the x axis under the lamp
        const Int3 open{0, 4 * (2 * i - n + 1), -std::abs(2 * i - n + 1) - 4};
        maker.face(
            id,
            {{-r / 2, 0, 0}, {r / 2, 0, 0}, Int3{r / 2, 0, 0} + open, Int3{-r / 2, 0, 0} + open});
        break;
      }
      case 1:
        maker.face(id, {{0, 0, 0}, 2 * d, 2 * d + Int3{0, 0, 8}, {0, 0, 8}});
        break;
      default:
        maker.face(
            id,
            {{0, 0, 0}, 3 * d - Int3{0, 0, n + i % 3}, 3 * e - Int3{0, 0, n + (i + 1) % n % 3}});
        break;
    }
  }
  maker.lights(values, {0, 0, 2 * r}, {0, 0, 1}, r);
}

}  // namespace

std::vector<Generator> large_generators() {
  std::vector<Generator> result;
  result.push_back({{"city",
                     "n houses of 5 faces on a raster, and the ground: 5 n + 1 polygons",
                     {{"n", 600, 1, 2000000, "houses"},
                      {"shuffle", 1, 0, 1, "polygons in random order"},
                      {"inside", 0, 0, 1, "the lamp stands in a street instead of outside"},
                      kLightParameter},
                     "growth on much exact degeneracy; n = 24000 has 120,001 polygons"},
                    city});
  result.push_back(
      {{"quads",
        "n tilted parallelograms over a floor, all looking at the light: n + 1 polygons",
        {{"n", 1000, 1, 4000000, "parallelograms"},
         {"two_sided", 0, 0, 1, "both sides receive and cast"},
         kLightParameter},
        "growth on generic input"},
       quads});
  result.push_back({{"comb",
                     "n teeth between a lamp and a wall: n + 2 polygons",
                     {{"n", 32, 1, 100000, "teeth"}, kLightParameter},
                     "parallel shadow edges"},
                    comb});
  result.push_back({{"stairs",
                     "n steps of 4 polygons, the back and the floor: 4 n + 2 polygons",
                     {{"n", 16, 1, 100000, "steps"}, kLightParameter},
                     "shared edges and T-junctions"},
                    stairs});
  result.push_back({{"nested-boxes",
                     "n boxes in each other, 5 walls each, and a floor: 5 n + 1 polygons",
                     {{"n", 8, 1, 100000, "boxes"}, kLightParameter},
                     "a lamp inside; light only through slits in line"},
                    nested_boxes});
  result.push_back(
      {{"coplanar-tiles",
        "n tiles, overlapping, abutting and doubled, and a floor: n + 1 polygons",
        {{"n", 40, 1, 1000000, "tiles"},
         {"levels", 2, 0, 100, "planes above the floor's; tiles in the floor's plane too"},
         kLightParameter},
        "coplanar polygons do not shadow each other"},
       coplanar_tiles});
  result.push_back({{"radial-fan",
                     "n polygons that meet in one line under the lamp, and a floor: n + 1 polygons",
                     {{"n", 24, 4, 10000, "polygons of the fan"},
                      {"kind", 0, 0, 2, "0: pages of a book, 1: blades edge-on, 2: an umbrella"},
                      kLightParameter},
                     "many polygons at one projected edge or point"},
                    radial_fan});
  return result;
}

}  // namespace gnomon::scene_detail
