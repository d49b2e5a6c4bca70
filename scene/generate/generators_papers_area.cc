// SPDX-License-Identifier: LGPL-3.0-or-later
// Scenes of the same kind and polygon counts as those of Chin & Feiner 1992, whose colour plates
// and figures were never published as files. Coordinates and lights are ours.
#include <algorithm>
#include <array>

#include "scene/generate/scene_maker.h"
#include "scene/generate/scene_shapes.h"

namespace gnomon::scene_detail {
namespace {

/// An area light, and the thin lamp that it is the lower side of: a polygon in the light's own
/// plane and one that looks the other way.
void fixture(SceneMaker& maker, const std::string& id, std::vector<Int3> loop) {
  maker.panel(loop);
  maker.face(id + ".face", loop);
  std::reverse(loop.begin(), loop.end());
  maker.face(id + ".back", loop);
}

// Two objects in the air, one a little above the other and over its edge, a floor and one triangle
// light: 1 + 6 + 7 = 14 polygons. On the floor the umbrae of the two are parted by a strip that no
// light reaches either, and that no polygon alone keeps dark.
void plates1(SceneMaker& maker, const Values&, Random&) {
  floor_at(maker, {0, 0, 0}, {72, 64, 0});
  maker.box("block", {14, 20, 20}, {33, 44, 26});
  upright_prism(maker, "slab",
                {{31, 18, 30}, {52, 18, 30}, {52, 36, 30}, {46, 44, 30}, {31, 44, 30}}, 6);
  maker.panel({{28, 26, 72}, {33, 40, 72}, {41, 29, 72}});
}

/// A pen of 15 posts, 4 rails and a mat, one post left out on the side of its gate: 81 polygons.
void playpen(SceneMaker& maker, Int3 o) {
  const std::array<std::array<std::int64_t, 2>, 15> posts{{{0, 0},
                                                           {10, 0},
                                                           {20, 0},
                                                           {30, 0},
                                                           {0, 11},
                                                           {0, 23},
                                                           {0, 35},
                                                           {30, 11},
                                                           {30, 23},
                                                           {30, 35},
                                                           {0, 46},
                                                           {7, 46},
                                                           {15, 46},
                                                           {23, 46},
                                                           {30, 46}}};
  for (std::size_t i = 0; i < posts.size(); ++i) {
    const Int3 foot = o + Int3{posts[i][0], posts[i][1], 0};
    maker.box("pen.post" + std::to_string(i), foot, foot + Int3{2, 2, 20}, SceneMaker::kSides);
  }
  constexpr unsigned kLong = SceneMaker::kAll;
  constexpr unsigned kBetween =
      kLong & ~static_cast<unsigned>(SceneMaker::kLeft | SceneMaker::kRight);
  struct Rail {
    Int3 low, high;
    unsigned faces;
  };
  const std::array<Rail, 4> rails{{{{0, 0, 20}, {2, 48, 22}, kLong},
                                   {{30, 0, 20}, {32, 48, 22}, kLong},
                                   {{2, 0, 20}, {30, 2, 22}, kBetween},
                                   {{2, 46, 20}, {30, 48, 22}, kBetween}}};
  for (std::size_t i = 0; i < rails.size(); ++i) {
    maker.box("pen.rail" + std::to_string(i), o + rails[i].low, o + rails[i].high, rails[i].faces);
  }
  maker.face("pen.mat",
             {o + Int3{2, 2, 1}, o + Int3{30, 2, 1}, o + Int3{30, 46, 1}, o + Int3{2, 46, 1}});
}

// A closed room (6) with a table (22), a chair (28), a cabinet and a chest (10): 66 polygons; 81 of
// the playpen, and 2 for every light.
void room1992(SceneMaker& maker, const Values& values, Random&) {
  room_shell(maker, {132, 112, 72});
  table(maker, "table", {36, 52, 0}, 44, 28, 26);
  chair(maker, "chair", {50, 30, 0});
  maker.box("cabinet", {0, 76, 0}, {20, 112, 48}, SceneMaker::kNoBottom);
  maker.box("chest", {96, 8, 0}, {118, 22, 14}, SceneMaker::kNoBottom);
  if (at(values, "playpen") != 0) playpen(maker, {92, 50, 0});
  fixture(maker, "fixture", {{54, 40, 68}, {54, 58, 68}, {80, 58, 68}, {80, 40, 68}});
  if (at(values, "lights") == 2) {
    fixture(maker, "fixture2", {{10, 14, 64}, {8, 34, 64}, {26, 36, 64}, {28, 12, 64}});
  }
}

// Figure 4: in a cut along x a line of light and three polygons of which the third is cut by the
// penumbra and by the umbra of the first. On the floor a gap between the umbrae of the first and
// the third is dark by both of them together. Along y polygons reach beyond every ray to the floor,
// so that fractions are those of the cut: the floor is 19/224 lit, 107/224 umbra.
void figure_4f(SceneMaker& maker, const Values&, Random&) {
  const auto strip = [&](const char* id, std::int64_t low, std::int64_t high, std::int64_t reach,
                         std::int64_t z) {
    maker.face(id, {{low, -reach, z}, {high, -reach, z}, {high, reach, z}, {low, reach, z}});
  };
  strip("floor", -64, 64, 32, 0);
  strip("1", -20, 0, 64, 32);
  strip("2", 20, 26, 64, 32);
  strip("3", -10, 16, 64, 20);
  maker.panel({{-8, -8, 48}, {-8, 8, 48}, {8, 8, 48}, {8, -8, 48}});
}

// Figures 5 to 7: a triangle light and two quadrilaterals. The second lies outside the penumbra of
// the first; its own penumbra reaches through one of the first's planes and out of it at another.
// A union that does not continue planes leaves a gap there.
void figure_6(SceneMaker& maker, const Values&, Random&) {
  floor_at(maker, {-48, -48, 0}, {64, 64, 0});
  maker.face("first", {{0, 0, 40}, {16, 0, 40}, {16, 12, 40}, {0, 12, 40}});
  maker.face("second", {{-18, 6, 28}, {-7, 6, 28}, {-7, 26, 28}, {-18, 26, 28}});
  maker.panel({{-8, -6, 64}, {0, 10, 64}, {8, -6, 64}});
}

}  // namespace

std::vector<Generator> area_paper_generators() {
  std::vector<Generator> result;
  const std::string chin = "Chin & Feiner 1992, ";
  result.push_back({{"plates1",
                     "two objects in the air over a floor, a triangle light: 14 polygons",
                     {},
                     chin + "colour plates 1 and 2"},
                    plates1});
  result.push_back({{"room1992",
                     "a furnished room with a playpen: 147 polygons, and 2 for every light; "
                     "without the playpen 66",
                     {{"lights", 1, 1, 2, "quadrilateral lights"},
                      {"playpen", 1, 0, 1, "the playpen of 81 polygons"}},
                     chin + "colour plates 3 to 6 (149, 70 and 151 polygons)"},
                    room1992});
  result.push_back({{"figure-4f",
                     "three polygons over a floor that two of them keep dark together: 4 polygons",
                     {},
                     chin + "Figure 4(f)",
                     true},
                    figure_4f});
  result.push_back({{"figure-6",
                     "two polygons whose penumbrae overlap, over a floor: 3 polygons",
                     {},
                     chin + "Figures 5 to 7",
                     true},
                    figure_6});
  return result;
}

}  // namespace gnomon::scene_detail
