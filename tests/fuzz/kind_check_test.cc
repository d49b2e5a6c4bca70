// SPDX-License-Identifier: GPL-3.0-or-later
// What KindChecker says of scenes made by hand: one that holds a kind, and one that nearly does.
// And moves by it: a scene that does not hold a kind does after its move.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "fuzz/generate/scene_pen.h"
#include "fuzz/generate/soups.h"
#include "fuzz/kinds/kind_predicates.h"
#include "fuzz/moves/moves.h"
#include "gnomon/scene/generate.h"
#include "gnomon/scene/prepare.h"

namespace gnomon::fuzz {

// Names in messages.
static void PrintTo(Kind kind, std::ostream* out) { *out << kinds()[id_of(kind)].name; }

namespace {

using Loop = std::vector<Triple>;

constexpr std::int64_t kOne = std::int64_t{1} << 40;
const Loop kSquare = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};

/// Coordinates are multiples of 2^-40.
Loop wide(Loop loop) {
  for (Triple& p : loop) p = kOne * p;
  return loop;
}

struct Example {
  Kind kind;
  std::function<void(ScenePen&)> holds, nearly;
};

std::function<void(ScenePen&)> polygon(const Loop& loop) {
  return [loop](ScenePen& pen) { pen.polygon(kSquare).polygon(loop); };
}
std::function<void(ScenePen&)> panel(const Loop& loop) {
  return [loop](ScenePen& pen) { pen.polygon(kSquare).panel(loop); };
}
std::function<void(ScenePen&)> lamp(const Triple& at) {
  return [at](ScenePen& pen) { pen.polygon(kSquare).lamp(at); };
}
std::function<void(ScenePen&)> sun(const Triple& to) {
  return [to](ScenePen& pen) { pen.polygon(kSquare).sun(to); };
}
/// Under a lamp 8 above the square's first corner.
std::function<void(ScenePen&)> under_lamp(const Loop& loop) {
  return [loop](ScenePen& pen) { pen.polygon(kSquare).polygon(loop).lamp({0, 0, 8}); };
}
std::function<void(ScenePen&)> fine(const Loop& polygon, const Triple& at) {
  return [=](ScenePen& pen) {
    pen = ScenePen(-40);
    pen.polygon(wide(polygon)).lamp(at);
  };
}
std::function<void(ScenePen&)> fine_panel(const Loop& loop) {
  return [=](ScenePen& pen) {
    pen = ScenePen(-40);
    pen.polygon(wide(kSquare)).panel(loop);
  };
}
std::function<void(ScenePen&)> at_scale(ScenePen scaled) {
  return [=](ScenePen& pen) {
    pen = scaled;
    pen.polygon(kSquare);
  };
}
std::function<void(ScenePen&)> moved(std::int64_t by) {
  return [=](ScenePen& pen) {
    Loop loop = kSquare;
    for (Triple& p : loop) p[1] += by;
    pen.polygon(loop);
  };
}
/// A triangle at the square's first corner, one coordinate of which is `value`.
std::function<void(ScenePen&)> with_number(double value) {
  return [=](ScenePen& pen) {
    pen.polygon(kSquare).polygon_at({{Number(value), Number(4.0), Number(0.0)},
                                     pen.position({7, 8, 1}),
                                     pen.position({9, 8, 3})});
  };
}
std::function<void(ScenePen&)> two_sided(bool first, bool second) {
  return [=](ScenePen& pen) {
    pen.two_sided(first).polygon(kSquare).two_sided(second).polygon(kSquare);
  };
}

std::vector<Example> examples() {
  const std::int64_t far = std::int64_t{1} << 30;
  return {
      {Kind::kSoupMixedSizes, polygon({{0, 0, 1}, {1 << 20, 0, 1}, {0, 1 << 20, 1}}),
       polygon({{0, 0, 1}, {1 << 10, 0, 1}, {0, 1 << 10, 1}})},
      {Kind::kOneSided, two_sided(false, false), two_sided(true, false)},
      {Kind::kTwoSided, two_sided(true, true), two_sided(true, false)},
      {Kind::kNonConvex, polygon({{0, 0, 1}, {4, 0, 1}, {1, 1, 1}, {0, 4, 1}}),
       polygon({{0, 0, 1}, {4, 0, 1}, {3, 3, 1}, {0, 4, 1}})},
      {Kind::kAlmostPlanar, polygon({{0, 0, 1}, {4, 0, 1}, {4, 4, 2}, {0, 4, 1}}),
       polygon({{0, 0, 1}, {4, 0, 1}, {4, 4, 2}, {0, 4, 2}})},
      {Kind::kSliver, polygon({{0, 0, 2}, {100000000, 0, 2}, {50000000, 1, 2}}),
       polygon({{0, 0, 2}, {100000000, 0, 2}, {0, 1, 2}})},
      {Kind::kNeedle, polygon({{0, 0, 2}, {100000000, 0, 2}, {0, 1, 2}}),
       polygon({{0, 0, 2}, {100000000, 0, 2}, {50000000, 1, 2}})},
      {Kind::kCoplanar, polygon({{6, 0, 0}, {8, 0, 0}, {6, 2, 0}}),
       polygon({{6, 0, 0}, {8, 0, 0}, {6, 2, 1}})},
      {Kind::kOverlap, polygon({{3, 3, 0}, {6, 3, 0}, {3, 6, 0}}),
       polygon({{4, 0, 0}, {8, 0, 0}, {4, 4, 0}})},
      {Kind::kDuplicate, polygon({{4, 4, 0}, {0, 4, 0}, {0, 0, 0}, {4, 0, 0}}),
       polygon({{4, 4, 0}, {0, 3, 0}, {0, 0, 0}, {4, 0, 0}})},
      {Kind::kBackToBack, polygon({{1, 1, 0}, {1, 2, 0}, {2, 1, 0}}),
       polygon({{1, 1, 0}, {2, 1, 0}, {1, 2, 0}})},
      {Kind::kSharedEdge, polygon({{4, 0, 0}, {0, 0, 0}, {0, 0, 4}}),
       polygon({{4, 0, 0}, {1, 0, 0}, {0, 0, 4}})},
      {Kind::kSharedVertex, polygon({{4, 4, 0}, {8, 8, 1}, {8, 8, 4}}),
       polygon({{4, 4, 1}, {8, 8, 1}, {8, 8, 4}})},
      {Kind::kTJunction, polygon({{2, 0, 0}, {2, -4, 1}, {3, -4, 1}}),
       polygon({{4, 0, 0}, {2, -4, 1}, {3, -4, 1}})},
      {Kind::kEdgeOverlap, polygon({{2, 0, 0}, {6, 0, 0}, {2, -2, 2}}),
       polygon({{4, 0, 0}, {0, 0, 0}, {2, -2, 2}})},
      {Kind::kVertexInFace, polygon({{1, 1, 0}, {1, 1, 4}, {2, 1, 4}}),
       polygon({{0, 1, 0}, {1, 1, 4}, {2, 1, 4}})},
      {Kind::kEdgeInFace, polygon({{1, 1, 0}, {2, 1, 0}, {1, 1, 3}}),
       polygon({{0, 1, 0}, {2, 1, 0}, {1, 1, 3}})},
      {Kind::kCrossing, polygon({{1, 1, -1}, {1, 1, 1}, {9, 9, 1}}),
       polygon({{1, 1, 0}, {1, 1, 1}, {9, 9, 1}})},
      {Kind::kNestedBoxes,
       [](ScenePen& pen) {
         pen.box({0, 0, 0}, {8, 8, 8}).box({1, 2, 3}, {4, 4, 4});
       },
       [](ScenePen& pen) {
         pen.box({0, 0, 0}, {8, 8, 8}).box({0, 2, 3}, {4, 4, 4});
       }},
      {Kind::kNextafter, with_number(std::nextafter(4.0, 5.0)), with_number(4.0)},
      {Kind::kNearParallel, polygon({{0, 0, 0}, {far, 0, 0}, {0, far, 1}}),
       polygon({{0, 0, 0}, {1024, 0, 0}, {0, 1024, 1}})},
      {Kind::kLightInPlane, lamp({9, 9, 0}), lamp({9, 9, 1})},
      {Kind::kLightOnFace, lamp({1, 1, 0}), lamp({0, 1, 0})},
      {Kind::kLightOnEdge, lamp({2, 0, 0}), lamp({6, 0, 0})},
      {Kind::kLightOnEdgeLine, lamp({6, 0, 0}), lamp({2, 0, 0})},
      {Kind::kLightAtVertex, lamp({4, 0, 0}), lamp({4, 0, 1})},
      {Kind::kLightFar, lamp({0, 0, far}), lamp({0, 0, 1000})},
      {Kind::kLightNear, fine(kSquare, {2 * kOne, 2 * kOne, 1}),
       fine(kSquare, {2 * kOne, 2 * kOne, 0})},
      {Kind::kGrazingLight, fine(kSquare, {8 * kOne, kOne, 1}),
       fine(kSquare, {8 * kOne, kOne, kOne >> 20})},
      {Kind::kSunInPlane, sun({1, 2, 0}), sun({1, 2, 1})},
      {Kind::kSunAlongEdge, sun({-3, 0, 0}), sun({3, 1, 0})},
      {Kind::kGrazingSun, sun({far, 0, 1}), sun({far, 0, 0})},
      {Kind::kShadowEdges, under_lamp({{1, 0, 4}, {3, 0, 2}, {2, 3, 5}}),
       under_lamp({{1, 0, 4}, {3, 1, 2}, {2, 3, 5}})},
      {Kind::kShadowVertexOnEdge, under_lamp({{1, 0, 4}, {5, 6, 5}, {6, 5, 4}}),
       under_lamp({{1, 1, 5}, {5, 6, 5}, {6, 5, 4}})},
      {Kind::kShadowVertices, under_lamp({{2, 0, 4}, {5, 6, 5}, {6, 5, 4}}),
       under_lamp({{2, 1, 4}, {5, 6, 5}, {6, 5, 4}})},
      {Kind::kAreaVertex, panel({{4, 4, 0}, {4, 4, 4}, {6, 4, 4}}),
       panel({{4, 4, 1}, {4, 4, 4}, {6, 4, 4}})},
      {Kind::kAreaEdge, panel({{0, 0, 0}, {4, 0, 0}, {0, 0, 4}}),
       panel({{0, 0, 0}, {3, 0, 0}, {0, 0, 4}})},
      {Kind::kAreaEdgeOverlap, panel({{0, 0, 0}, {3, 0, 0}, {0, 0, 4}}),
       panel({{0, 0, 0}, {4, 0, 0}, {0, 0, 4}})},
      {Kind::kAreaInPlane, panel({{6, 0, 0}, {8, 0, 0}, {6, 2, 0}}),
       panel({{6, 0, 0}, {8, 0, 0}, {6, 2, 1}})},
      {Kind::kAreaOnCaster, panel({{3, 3, 0}, {6, 3, 0}, {3, 6, 0}}),
       panel({{4, 0, 0}, {8, 0, 0}, {4, 4, 0}})},
      {Kind::kAreaInside, panel({{1, 1, 0}, {2, 1, 0}, {1, 2, 0}}),
       panel({{0, 1, 0}, {2, 1, 0}, {1, 2, 0}})},
      {Kind::kAreaVertexInFace, panel({{1, 1, 0}, {1, 1, 4}, {2, 1, 4}}),
       panel({{0, 1, 0}, {1, 1, 4}, {2, 1, 4}})},
      {Kind::kAreaTouched, panel({{0, 8, -4}, {8, 0, -4}, {4, 4, 8}}),
       panel({{1, 8, -4}, {9, 0, -4}, {5, 4, 8}})},
      {Kind::kAreaStraddled, panel({{9, 9, -1}, {9, 9, 1}, {10, 9, 1}}),
       panel({{9, 9, 0}, {9, 9, 1}, {10, 9, 1}})},
      {Kind::kAreaCut, panel({{1, 1, -1}, {1, 1, 1}, {9, 9, 1}}),
       panel({{9, 9, -1}, {9, 9, 1}, {10, 9, 1}})},
      {Kind::kAreaVertexInPlane, panel({{9, 9, 0}, {9, 9, 1}, {10, 9, 1}}),
       panel({{9, 9, 0}, {10, 9, 0}, {9, 10, 0}})},
      {Kind::kAreaEdgeInPlane, panel({{9, 9, 0}, {10, 9, 0}, {10, 9, 1}}),
       panel({{9, 9, 0}, {9, 9, 1}, {10, 9, 1}})},
      {Kind::kAreaParallelEdge, panel({{0, 0, 5}, {3, 0, 5}, {1, 1, 6}}),
       panel({{0, 0, 5}, {3, 1, 5}, {1, 2, 6}})},
      {Kind::kAreaGrazing, fine_panel({{8 * kOne, kOne, 1}, {8 * kOne, 0, kOne}, {0, 0, kOne}}),
       fine_panel({{8 * kOne, kOne, 0}, {8 * kOne, 0, kOne}, {0, 0, kOne}})},
      {Kind::kAreaSliver, fine_panel({{0, 0, kOne}, {8 * kOne, 0, kOne}, {kOne, 1, kOne}}),
       fine_panel({{0, 0, kOne}, {8 * kOne, 0, kOne}, {kOne, kOne, kOne}})},
      {Kind::kAreaSmall, fine_panel({{0, 0, kOne}, {9, 0, kOne}, {0, 9, kOne}}),
       fine_panel({{0, 0, kOne}, {kOne, 0, kOne}, {0, 9, kOne}})},
      {Kind::kAreaHuge, panel({{0, 0, 1}, {far, 0, 1}, {0, far, 1}}),
       panel({{0, 0, 1}, {40, 0, 1}, {0, 40, 1}})},
      {Kind::kMixedMagnitudes, with_number(0x1p-90), with_number(0x1p-30)},
      {Kind::kScaledUp, at_scale(ScenePen(400)), at_scale(ScenePen(200))},
      {Kind::kScaledDown, at_scale(ScenePen(-400)), at_scale(ScenePen(-200))},
      {Kind::kLargeOffset, moved(far), moved(1000)},
      {Kind::kDecimals, at_scale(ScenePen::decimal(-1)), at_scale(ScenePen::decimal(0))},
  };
}

TEST(KindChecker, TellsAKindFromWhatIsNearlyOne) {
  std::set<Kind> shown = {Kind::kSoupUniform,  Kind::kSoupClustered, Kind::kSoupLattice,
                          Kind::kScene,        Kind::kFile,          Kind::kHoles,
                          Kind::kCyclicOverlap};
  for (const Example& example : examples()) {
    ScenePen yes, no;
    example.holds(yes);
    example.nearly(no);
    EXPECT_TRUE(KindChecker(yes.scene()).holds(example.kind))
        << testing::PrintToString(example.kind);
    EXPECT_FALSE(KindChecker(no.scene()).holds(example.kind))
        << "nearly " << testing::PrintToString(example.kind);
    shown.insert(example.kind);
  }
  EXPECT_EQ(shown.size(), id_of(Kind::kFirstFamily)) << "kinds without an example";
}

TEST(KindChecker, SeesHolesAndCycles) {
  Scene holed = *generate("holed-wall");
  EXPECT_TRUE(KindChecker(holed).holds(Kind::kHoles));
  for (Polygon& polygon : holed.polygons) polygon.holes.clear();
  EXPECT_FALSE(KindChecker(holed).holds(Kind::kHoles));

  Scene wheel = *generate("pinwheel");
  EXPECT_TRUE(KindChecker(wheel).holds(Kind::kCyclicOverlap));
  wheel.polygons.pop_back();
  wheel.polygons.erase(wheel.polygons.begin());
  EXPECT_FALSE(KindChecker(wheel).holds(Kind::kCyclicOverlap));
}

class Moves : public testing::TestWithParam<std::size_t> {};

TEST_P(Moves, DoWhatTheirNameSays) {
  const Move& move = moves()[GetParam()];
  int before = 0, done = 0, after = 0, prepared = 0;
  constexpr int kSeeds = 120;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    Random random(seed);
    const auto soup = static_cast<Soup>(seed % 3);
    Scene scene = make_soup(soup, move.group == MoveGroup::kArea, random);
    before += KindChecker(scene).holds(move.kind) ? 1 : 0;
    if (!move.apply(scene, random)) continue;
    ++done;
    after += KindChecker(scene).holds(move.kind) ? 1 : 0;
    prepared += prepare(scene).has_value() ? 1 : 0;
  }
  // What the soups hold anyway says little of the move.
  const bool common = move.kind == Kind::kAreaStraddled || move.kind == Kind::kAreaParallelEdge ||
                      move.kind == Kind::kCrossing;
  EXPECT_LT(before, common ? kSeeds * 3 / 4 : kSeeds / 3);
  EXPECT_GT(done, kSeeds / 2);
  EXPECT_GT(after, done * 2 / 3);
  EXPECT_GT(after, before + kSeeds / 8);
  EXPECT_EQ(prepared, done);
}

INSTANTIATE_TEST_SUITE_P(KindChecker, Moves, testing::Range<std::size_t>(0, moves().size()),
                         [](const auto& test) {
                           std::string name(moves()[test.param].name());
                           for (char& c : name) c = c == '-' ? '_' : c;
                           return name;
                         });

}  // namespace
}  // namespace gnomon::fuzz
