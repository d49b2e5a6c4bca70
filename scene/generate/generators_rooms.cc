// SPDX-License-Identifier: LGPL-3.0-or-later
// Slater's rooms (1992, section 7), which were never published as files: "a room containing a desk
// with a computer on top, and a bookcase", and up to two further desks and two further bookcases.
// A desk of 36 polygons and a bookcase of 54 are what the printed numbers of polygons leave: 138,
// and 138 with every sum of up to two 36s and up to two 54s, one of them twice. Coordinates and
// lamps are ours.
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "scene/generate/scene_maker.h"
#include "scene/generate/scene_shapes.h"

namespace gnomon::scene_detail {
namespace {

/// Where a lamp or an area light is, and which of them the parameter `lights` asks for.
void lights_at(SceneMaker& maker, const Values& values, const std::array<Int3, 2>& places,
               std::int64_t width) {
  const std::int64_t which = at(values, "lights"), area = at(values, "area");
  const std::size_t first = which == 3 ? 1 : 0, last = which == 1 ? 0 : 1;
  for (std::size_t i = first; i <= last && area != 1; ++i) maker.lamp(places[i]);
  for (std::size_t i = first; i <= last && area != 0; ++i) {
    maker.panel_above(values, places[i], width);
  }
}

constexpr Int3 kHigh{200, 160, 96};                    // the room is [0, kHigh]
constexpr std::int64_t kDoorLow = 60, kDoorHigh = 92;  // the doorway, along y
constexpr std::int64_t kDoorTop = 76, kOutside = -6;   // its height; the wall's outer side
constexpr std::array<Int3, 2> kLamps{{{101, 79, 90}, {-60, 67, 53}}};

/// Floor, ceiling, three walls, both sides of the wall with the doorway, what is within the
/// doorway, the ground before it, and an open door: 22 polygons.
void room_with_doorway(SceneMaker& maker) {
  maker.box("room", {0, 0, 0}, kHigh, SceneMaker::kAll & ~SceneMaker::kLeft, true);
  struct Stretch {
    const char* id;
    std::int64_t y0, y1, z0;
  };
  const std::array<Stretch, 3> wall{{{"before", 0, kDoorLow, 0},
                                     {"after", kDoorHigh, kHigh.y, 0},
                                     {"above", kDoorLow, kDoorHigh, kDoorTop}}};
  for (const auto& [id, y0, y1, z0] : wall) {
    maker.box(std::string("wall.") + id, {kOutside, y0, z0}, {0, y1, kHigh.z},
              SceneMaker::kLeft | SceneMaker::kRight);
  }
  maker.box("doorway", {kOutside, kDoorLow, 0}, {0, kDoorHigh, kDoorTop},
            SceneMaker::kFront | SceneMaker::kBack | SceneMaker::kTop | SceneMaker::kBottom, true);
  maker.face("ground",
             {{-120, 0, 0}, {kOutside, 0, 0}, {kOutside, kHigh.y, 0}, {-120, kHigh.y, 0}});
  maker.box("door", {1, kDoorLow - 4, 1}, {33, kDoorLow - 1, kDoorTop - 1});
}

/// A top, four legs and a panel between two of them, along x or along y: 36 polygons.
void desk(SceneMaker& maker, const std::string& id, Int3 o, bool along_y) {
  const auto put = [&](const char* name, Int3 low, Int3 high) {
    const auto turned = [&](Int3 p) { return along_y ? Int3{p.y, p.x, p.z} : p; };
    maker.box(id + "." + name, o + turned(low), o + turned(high));
  };
  constexpr std::int64_t kWidth = 48, kDepth = 26, kHeight = 30, kLeg = 3;
  put("top", {0, 0, kHeight - 2}, {kWidth, kDepth, kHeight});
  constexpr std::array<const char*, 4> kLegs = {"leg0", "leg1", "leg2", "leg3"};
  for (std::size_t k = 0; k < kLegs.size(); ++k) {
    const Int3 foot{(k & 1) != 0 ? kWidth - kLeg - 1 : 1, (k & 2) != 0 ? kDepth - kLeg - 1 : 1, 0};
    put(kLegs[k], foot, foot + Int3{kLeg, kLeg, kHeight - 2});
  }
  put("panel", {kLeg + 1, kDepth - kLeg, 10}, {kWidth - kLeg - 1, kDepth - kLeg + 1, kHeight - 2});
}

/// A back, two sides, a bottom, a top and four shelves, along x or along y: 54 polygons.
void bookcase(SceneMaker& maker, const std::string& id, Int3 o, bool along_y) {
  const auto put = [&](const std::string& name, Int3 low, Int3 high) {
    const auto turned = [&](Int3 p) { return along_y ? Int3{p.y, p.x, p.z} : p; };
    maker.box(id + "." + name, o + turned(low), o + turned(high));
  };
  constexpr std::int64_t kWidth = 44, kDepth = 12, kHeight = 74, kBoard = 2, kRows = 5;
  put("back", {0, 0, 0}, {kWidth, 1, kHeight});
  put("side0", {0, 1, 0}, {kBoard, kDepth, kHeight});
  put("side1", {kWidth - kBoard, 1, 0}, {kWidth, kDepth, kHeight});
  for (std::int64_t row = 0; row <= kRows; ++row) {
    const std::int64_t z = row * (kHeight - kBoard) / kRows;
    put("board" + std::to_string(row), {kBoard, 1, z}, {kWidth - kBoard, kDepth, z + kBoard});
  }
}

/// A case, a monitor with a screen, a keyboard and a mouse: 25 polygons.
void computer(SceneMaker& maker, Int3 o) {
  maker.box("computer.case", o, o + Int3{16, 14, 4});
  maker.box("computer.monitor", o + Int3{2, 1, 4}, o + Int3{14, 12, 15});
  maker.face("computer.screen",
             {o + Int3{3, 0, 5}, o + Int3{13, 0, 5}, o + Int3{13, 0, 14}, o + Int3{3, 0, 14}});
  maker.box("computer.keyboard", o + Int3{0, -8, 0}, o + Int3{14, -2, 1});
  maker.box("computer.mouse", o + Int3{18, -6, 0}, o + Int3{20, -3, 1});
}

/// Further desks, and which of the two further bookcases are there, in the order of Table 1.
struct Furniture {
  int desks;
  bool left, front;
};
constexpr std::array<Furniture, 10> kRooms{{{0, false, false},
                                            {1, false, false},
                                            {0, true, false},
                                            {2, false, false},
                                            {1, true, false},
                                            {2, true, false},
                                            {0, true, true},
                                            {2, false, true},
                                            {1, true, true},
                                            {2, true, true}}};

/// 22 of the room, a picture, a desk of 36, a computer of 25, a bookcase of 54: 138, and more.
void room_of_table_1(SceneMaker& maker, const Furniture& furniture) {
  room_with_doorway(maker);
  maker.face("picture", {{199, 54, 40}, {199, 30, 40}, {199, 30, 64}, {199, 54, 64}});
  desk(maker, "desk", {76, 92, 0}, false);
  computer(maker, {88, 102, 30});
  bookcase(maker, "bookcase", {128, 2, 0}, false);
  if (furniture.desks > 0) desk(maker, "desk2", {141, 121, 0}, false);
  if (furniture.desks > 1) desk(maker, "desk3", {167, 58, 0}, true);
  if (furniture.left) bookcase(maker, "bookcase2", {2, 107, 0}, true);
  if (furniture.front) bookcase(maker, "bookcase3", {58, 3, 0}, false);
}

/// A closed room filled with tables, chairs and blocks until it has exactly n polygons.
void room_of_n(SceneMaker& maker, const Values& values, Random& random) {
  const std::int64_t n = at(values, "n");
  constexpr std::int64_t kCell = 64, kColumns = 4;
  std::int64_t left = n - 6;
  std::vector<int> kinds;  // polygons of each piece of furniture
  while (left >= 6) {
    const int kind = left >= 28 && random.chance(2, 5)   ? 28
                     : left >= 22 && random.chance(1, 2) ? 22
                                                         : 6;
    kinds.push_back(kind);
    left -= kind;
  }
  const auto rows = (static_cast<std::int64_t>(kinds.size()) + kColumns - 1) / kColumns;
  const Int3 high{kColumns * kCell, std::max<std::int64_t>(rows, 1) * kCell, 80};
  room_shell(maker, high);
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    const auto cell = static_cast<std::int64_t>(i);
    const Int3 o{(cell % kColumns) * kCell + random.between(2, 14),
                 (cell / kColumns) * kCell + random.between(2, 20), 0};
    const std::string number = std::to_string(i);
    if (kinds[i] == 28) chair(maker, "chair" + number, o);
    if (kinds[i] == 22)
      table(maker, "table" + number, o, random.between(20, 44), random.between(16, 36),
            random.between(16, 28));
    if (kinds[i] == 6)
      maker.box("block" + number, o,
                o + Int3{random.between(4, 40), random.between(4, 36), random.between(4, 40)});
  }
  for (std::int64_t i = 0; i < left; ++i) {  // pictures hang in the plane of the left wall
    const std::int64_t y = 8 + 10 * i;
    maker.face("picture" + std::to_string(i),
               {{0, y, 40}, {0, y + 6, 40}, {0, y + 6, 52}, {0, y, 52}});
  }
  lights_at(maker, values,
            {{{high.x / 2 + 1, high.y / 2 - 3, 76}, {high.x / 4 + 1, high.y / 4 + 2, 70}}}, high.x);
}

void slater_room(SceneMaker& maker, const Values& values, Random& random) {
  const std::int64_t room = at(values, "room");
  if (room == 0) return room_of_n(maker, values, random);
  room_of_table_1(maker, kRooms[static_cast<std::size_t>(room - 1)]);
  lights_at(maker, values, kLamps, kHigh.x);
}

}  // namespace

std::vector<Generator> room_generators() {
  return {
      {{"slater-room",
        "a furnished room: a closed one with tables, chairs and blocks of exactly n polygons, or "
        "one of the ten of Slater's Table 1 with desks, bookcases and a doorway",
        {{"n", 138, 12, 100000, "polygons of the closed room"},
         {"lights", 1, 1, 3,
          "1: a lamp at the ceiling, 2: and a second one, 3: the second one alone; in the rooms "
          "of Table 1 that is outside, before the doorway"},
         {"room", 0, 0, 10,
          "0: the closed room of n polygons; else the room of this row of Table 1, of 138, 174, "
          "192, 210, 228, 264, 246, 264, 282 or 318 polygons"},
         kAreaParameter,
         kAreaSizeParameter},
        "Slater 1992, section 7"},
       slater_room}};
}

}  // namespace gnomon::scene_detail
