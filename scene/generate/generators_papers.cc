// SPDX-License-Identifier: LGPL-3.0-or-later
// Scenes of the same kind and polygon counts as those of Chin & Feiner 1989, which were never
// published as files. Light positions are ours.
#include <algorithm>
#include <array>

#include "scene/generate/scene_maker.h"
#include "scene/generate/scene_shapes.h"

namespace gnomon::scene_detail {
namespace {

// Ground, cube, hexagonal prism, octahedron and tetrahedron: 1 + 6 + 8 + 8 + 4 = 27 polygons.
void solids(SceneMaker& maker, const Values& values, Random&) {
  floor_at(maker, {0, 0, 0}, {64, 64, 0});
  maker.box("cube", {8, 8, 0}, {20, 20, 12});
  hexagonal_prism(maker, "prism", {46, 18, 0}, 8, 16);
  octahedron(maker, "octahedron", {18, 46, 10}, 10);
  tetrahedron(maker, "tetrahedron", {{{38, 40, 0}, {58, 44, 0}, {42, 58, 0}, {46, 47, 18}}});

  for (const Int3& place : {Int3{-10, -14, 60}, Int3{80, 10, 50}, Int3{30, 33, 90}}) {
    if (at(values, "area") != 1) maker.lamp(place);
    if (at(values, "area") != 0) maker.panel_above(values, place, 64);
  }
}

/// 4^(level - 1) tetrahedra of 4 faces: Haines's recursive tetrahedron, inscribed in a cube so that
/// all coordinates stay integers. Every corner of `v` is `reach` away from the middle in each axis.
void recursive_tetrahedron(SceneMaker& maker, Int3 middle, std::int64_t reach, std::int64_t level) {
  const std::array<Int3, 4> corners{{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}};
  struct Task {
    Int3 middle;
    std::int64_t reach, level;
  };
  std::vector<Task> tasks{{middle, reach, level}};
  std::size_t count = 0;
  while (!tasks.empty()) {
    const Task task = tasks.back();
    tasks.pop_back();
    if (task.level == 1) {
      std::array<Int3, 4> v;
      for (std::size_t k = 0; k < 4; ++k) v[k] = task.middle + task.reach * corners[k];
      tetrahedron(maker, "t" + std::to_string(count++), v);
      continue;
    }
    const std::int64_t half = task.reach / 2;
    for (std::size_t k = 4; k-- > 0;) {
      tasks.push_back({task.middle + half * corners[k], half, task.level - 1});
    }
  }
}

// 4^level triangles over a ground of one or two polygons.
void tetra(SceneMaker& maker, const Values& values, Random&) {
  const std::int64_t level = at(values, "level");
  const std::int64_t reach = std::int64_t{1} << (level + 3);
  const std::int64_t z = -reach - reach / 4;
  if (at(values, "ground") == 2) {
    maker.face("ground0", {{-4 * reach, -4 * reach, z},
                           {0, -4 * reach, z},
                           {0, 4 * reach, z},
                           {-4 * reach, 4 * reach, z}});
    maker.face("ground1", {{0, -4 * reach, z},
                           {4 * reach, -4 * reach, z},
                           {4 * reach, 4 * reach, z},
                           {0, 4 * reach, z}});
  } else {
    floor_at(maker, {-4 * reach, -4 * reach, z}, {4 * reach, 4 * reach, z});
  }
  recursive_tetrahedron(maker, {0, 0, 0}, reach, level);
  maker.lamp({reach + 1, -2 * reach - 3, 5 * reach + 7});
}

// Floor, recursive tetrahedron of 64 triangles, 15 steps of 4 polygons with a back: 126 polygons.
void tetra_staircase(SceneMaker& maker, const Values&, Random&) {
  floor_at(maker, {-40, -24, 0}, {88, 72, 0});
  recursive_tetrahedron(maker, {-16, 12, 16}, 16, 3);
  for (std::int64_t i = 0; i < 15; ++i) {
    const std::int64_t x0 = 8 + 4 * i, x1 = x0 + 4, z0 = 3 * i, z1 = z0 + 3;
    const std::string id = "step" + std::to_string(i);
    maker.face(id + ".riser", {{x0, 40, z0}, {x0, 8, z0}, {x0, 8, z1}, {x0, 40, z1}});
    maker.face(id + ".tread", {{x0, 8, z1}, {x1, 8, z1}, {x1, 40, z1}, {x0, 40, z1}});
    maker.face(id + ".left", {{x0, 8, 0}, {x1, 8, 0}, {x1, 8, z1}, {x0, 8, z1}});
    maker.face(id + ".right", {{x0, 40, 0}, {x0, 40, z1}, {x1, 40, z1}, {x1, 40, 0}});
  }
  maker.face("back", {{68, 8, 0}, {68, 40, 0}, {68, 40, 45}, {68, 8, 45}});
  maker.lamp({-70, -60, 120});
}

// Floor, two walls, table (22), chair (28), two boxes on the table (12): 65 quadrilaterals.
void table_chair(SceneMaker& maker, const Values&, Random&) {
  floor_at(maker, {0, 0, 0}, {96, 80, 0});
  maker.face("wall.back", {{0, 80, 0}, {96, 80, 0}, {96, 80, 64}, {0, 80, 64}});
  maker.face("wall.left", {{0, 0, 0}, {0, 80, 0}, {0, 80, 64}, {0, 0, 64}});
  table(maker, "table", {28, 36, 0}, 44, 28, 26);
  chair(maker, "chair", {44, 14, 0});
  maker.box("book", {34, 42, 26}, {44, 49, 28});
  maker.box("vase", {58, 50, 26}, {62, 54, 36});
  maker.lamp({90, -30, 70});
  maker.lamp({20, 10, 90});
}

// A closed room (6), a table (22), two chairs (56), cabinet, box and shelf (18), a pillar (4): 106.
void room(SceneMaker& maker, const Values& values, Random&) {
  room_shell(maker, {128, 112, 72});
  table(maker, "table", {40, 44, 0}, 44, 28, 26);
  chair(maker, "chair0", {54, 22, 0});
  chair(maker, "chair1", {96, 84, 0});
  maker.box("cabinet", {0, 76, 0}, {20, 112, 48});
  maker.box("parcel", {64, 54, 26}, {74, 62, 32});
  maker.box("shelf", {44, 104, 48}, {92, 112, 51});
  maker.box("pillar", {112, 24, 0}, {120, 32, 72}, SceneMaker::kSides);
  for (const Int3& place : {Int3{60, 60, 66}, Int3{16, 20, 60}}) {
    if (at(values, "area") != 1) maker.lamp(place);
    if (at(values, "area") != 0) maker.panel_above(values, place, 128);
  }
}

}  // namespace

std::vector<Generator> paper_generators() {
  std::vector<Generator> result;
  const std::string chin = "Chin & Feiner 1989, Table 1";
  result.push_back({{"solids",
                     "ground, cube, prism, octahedron and tetrahedron: 27 polygons, 3 lamps",
                     {kAreaParameter, kAreaSizeParameter},
                     chin},
                    solids});
  result.push_back(
      {{"tetra-staircase", "recursive tetrahedron and staircase: 126 polygons, 1 lamp", {}, chin},
       tetra_staircase});
  result.push_back(
      {{"table-chair", "table and chair before two walls: 65 polygons, 2 lamps", {}, chin},
       table_chair});
  result.push_back({{"room",
                     "a furnished closed room: 106 polygons, 2 lamps inside",
                     {kAreaParameter, kAreaSizeParameter},
                     chin},
                    room});
  result.push_back(
      {{"tetra",
        "recursive tetrahedron of 4^level triangles and its ground: 4^level + ground polygons",
        {{"level", 4, 1, 12, "levels of recursion"},
         {"ground", 2, 1, 2, "polygons of the ground: 2 as in Chin & Feiner, 1 as in Slater"}},
        chin + " (258 and 1026 polygons); Slater 1992 (65, 257, 1025)"},
       tetra});
  return result;
}

}  // namespace gnomon::scene_detail
