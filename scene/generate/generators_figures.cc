// SPDX-License-Identifier: LGPL-3.0-or-later
// Single figures of the papers that say in few polygons what a method has to do. What the paper
// draws as lines in a plane stands upright here, or lies under a sun.
#include <array>
#include <utility>

#include "scene/generate/scene_maker.h"

namespace gnomon::scene_detail {
namespace {

void sheet(SceneMaker& maker, const char* id, std::array<std::int64_t, 2> low,
           std::array<std::int64_t, 2> high, std::int64_t z) {
  maker.face(
      id, {{low[0], low[1], z}, {high[0], low[1], z}, {high[0], high[1], z}, {low[0], high[1], z}});
}

// p1 before p2 before p3: p1 cuts the volume of p2 in three, and on p3 all of it is one shadow, AD.
void slater_figure_6(SceneMaker& maker, const Values&, Random&) {
  sheet(maker, "p1", {1, 0}, {2, 3}, 2);
  sheet(maker, "p2", {0, 0}, {3, 3}, 1);
  sheet(maker, "p3", {-1, -1}, {4, 4}, 0);
  maker.sun({0, 0, 1});
}

// Walls on the lines ab, cd and ef of the figure, which face a lamp in its plane: ab and cd are
// lit, of ef the part eg is behind ab and gf is lit.
void svbsp_figure_2(SceneMaker& maker, const Values&, Random&) {
  const auto wall = [&](const char* id, Int3 from, Int3 to, std::int64_t half) {
    const Int3 up{0, 0, half};
    maker.face(id, {to - up, from - up, from + up, to + up});
  };
  wall("ab", {-8, -8, 0}, {-2, -8, 0}, 4);
  wall("cd", {6, -10, 0}, {10, -9, 0}, 4);
  wall("ef", {-8, -16, 0}, {4, -14, 0}, 3);
  maker.lamp({0, 0, 0});
}

}  // namespace

std::vector<Generator> figure_generators() {
  std::vector<Generator> result;
  result.push_back(
      {{"slater-figure-6",
        "three sheets, of which the first splits the second: 3 polygons, one shadow on "
        "the last if fragments are merged, three if not",
        {},
        "Slater 1992, Figure 6"},
       slater_figure_6});
  result.push_back({{"svbsp-figure-2",
                     "three walls, of which the first hides a part of the last: 3 polygons",
                     {},
                     "Chin & Feiner 1989, Figure 2"},
                    svbsp_figure_2});
  return result;
}

}  // namespace gnomon::scene_detail
