// SPDX-License-Identifier: LGPL-3.0-or-later
// Families that preparation has to work on: non-convex loops, holes, loops that are not planar.
#include <algorithm>

#include "scene/generate/scene_maker.h"

namespace gnomon::scene_detail {
namespace {

// A wall with n holes in rows, some of them touching each other or the wall's border, of either
// orientation, before a floor; the wall is tilted so that its plane is no axis plane.
void holed_wall(SceneMaker& maker, const Values& values, Random& random) {
  const std::int64_t n = at(values, "n");
  std::int64_t columns = 1;
  while (columns * columns < n) ++columns;
  const std::int64_t rows = (n + columns - 1) / columns;
  const auto place = [&](std::int64_t a, std::int64_t b) { return Int3{4 * a, b - a, 3 * b}; };
  const std::int64_t w = 4 * columns, h = 4 * rows;
  std::vector<std::vector<VertexId>> holes;
  for (std::int64_t i = 0; i < n; ++i) {
    const std::int64_t a = 4 * (i % columns), b = 4 * (i / columns);
    const std::int64_t a0 = a + random.between(0, 1), b0 = b + random.between(0, 1);
    const std::int64_t a1 = a + random.between(2, 4), b1 = b + random.between(2, 4);
    std::vector<Int3> hole{place(a0, b0), place(a1, b0), place(a1, b1), place(a0, b1)};
    if (random.chance(1, 3)) hole.erase(hole.begin() + 2);  // a triangle
    if (random.chance(1, 2)) std::reverse(hole.begin(), hole.end());
    // The hole's vertices enter the scene through a polygon of their own: the pane that fills it.
    Polygon& pane = maker.face("pane" + std::to_string(i), hole);
    holes.push_back(pane.loop);
    pane.casts = false;
  }
  maker.face("wall", {place(0, 0), place(w, 0), place(w, h), place(0, h)}).holes = std::move(holes);
  maker.face("floor", {{-8, -8, -w - 8},
                       {4 * w + 8, -8, -w - 8},
                       {4 * w + 8, 40 + h, -w - 8},
                       {-8, 40 + h, -w - 8}});
  maker.set_two_sided(true);
  maker.lamp({2 * w + 1, -30, 3 * h + 40});
}

// A spiral corridor as one polygon: 4 n + 4 vertices, of which about half are reflex.
void spiral(SceneMaker& maker, const Values& values, Random&) {
  const std::int64_t n = at(values, "n");
  std::vector<Int3> outer, inner;
  // The centre line's corners go round outward; the corridor is 2 wide, and so are the gaps.
  for (std::int64_t k = 0; k <= 2 * n; ++k) {
    const std::int64_t r = 4 * (k / 4) + 4;
    const int quarter = static_cast<int>(k % 4);
    const std::int64_t sx = quarter == 0 || quarter == 3 ? 1 : -1, sy = quarter < 2 ? 1 : -1;
    const std::int64_t grow = quarter == 3 ? 4 : 0;
    outer.push_back({sx * (r + 1) + (sx > 0 ? grow : 0), sy * (r + 1), 0});
    inner.push_back({sx * (r - 1) + (sx > 0 ? grow : 0), sy * (r - 1), 0});
  }
  std::vector<Int3> loop = outer;
  loop.insert(loop.end(), inner.rbegin(), inner.rend());
  for (Int3& p : loop) p.z = 3 * p.x - 2 * p.y;  // an oblique plane
  maker.face("spiral", loop).two_sided = true;
  const std::int64_t reach = 8 * n + 16, z = -6 * reach;
  maker.face("floor", {{-4 * reach, -4 * reach, z},
                       {4 * reach, -4 * reach, z},
                       {4 * reach, 4 * reach, z},
                       {-4 * reach, 4 * reach, z}});
  maker.lamp({1, 2, 12 * reach});
}

// A height field of quads, none of them planar.
void terrain(SceneMaker& maker, const Values& values, Random& random) {
  const std::int64_t n = at(values, "n");
  std::vector<std::int64_t> height(static_cast<std::size_t>((n + 1) * (n + 1)));
  for (std::int64_t& h : height) h = random.between(0, 12);
  const auto point = [&](std::int64_t i, std::int64_t j) {
    return Int3{8 * i, 8 * j, height[static_cast<std::size_t>(j * (n + 1) + i)]};
  };
  for (std::int64_t j = 0; j < n; ++j) {
    for (std::int64_t i = 0; i < n; ++i) {
      maker.face("q" + std::to_string(i) + "_" + std::to_string(j),
                 {point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)});
    }
  }
  maker.lights(values, {-20, -30, 40 + 4 * n}, {-3, -2, 2}, 8 * n);
}

}  // namespace

std::vector<Generator> repair_generators() {
  std::vector<Generator> result;
  result.push_back(
      {{"holed-wall",
        "a tilted wall with n holes and the panes that fill them, and a floor: n + 2 polygons",
        {{"n", 6, 1, 400, "holes"}},
        "holes of both orientations that touch each other and the border",
        true},
       holed_wall});
  result.push_back({{"spiral",
                     "a spiral corridor as one polygon over a floor: 2 polygons",
                     {{"n", 8, 1, 2000, "half turns"}},
                     "long non-convex loops",
                     true},
                    spiral});
  result.push_back({{"terrain",
                     "a height field of n x n quads, few of them planar: n^2 polygons",
                     {{"n", 5, 1, 1000, "quads along a side"}, kLightParameter},
                     "non-planar input",
                     true},
                    terrain});
  return result;
}

}  // namespace gnomon::scene_detail
