// SPDX-License-Identifier: GPL-3.0-or-later
// Each repair that the definitions name, each error, and that neither depends on where a loop
// starts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "builder.h"
#include "scene/base/random.h"

namespace gnomon::test {
namespace {

using Loop = std::vector<Triple>;

/// Prepares, and checks every promise and the area of every polygon that is planar.
PreparedScene sound(const Builder& builder, Scene& scene) {
  const auto prepared = builder.prepare();
  EXPECT_TRUE(prepared) << to_string(prepared.error());
  if (!prepared) return {};
  EXPECT_EQ(first_flaw(*prepared, scene), "");
  for (std::uint32_t p = 0; p < scene.polygons.size(); ++p) {
    EXPECT_EQ(part_area_sum(*prepared, p), input_area(*prepared, scene, p)) << p;
  }
  return *prepared;
}

PreparedScene sound(const Loop& loop, const std::vector<Loop>& holes = {}) {
  Builder b;
  b.polygon(loop, holes);
  return sound(b, b.scene());
}

Error error_of(const Loop& loop, const std::vector<Loop>& holes = {}) {
  Builder b;
  b.polygon(loop, holes);
  const auto prepared = b.prepare();
  EXPECT_FALSE(prepared);
  return prepared ? Error{} : prepared.error();
}

/// The parts as sets of scene positions, whatever the numbering of vertices and the start of loops.
std::set<std::set<Triple>> shapes(const PreparedScene& scene) {
  std::set<std::set<Triple>> result;
  for (const Part& part : scene.parts) {
    std::set<Triple> shape;
    for (const VertexId v : scene.loop(part)) shape.insert(scene.geometry.positions[v]);
    result.insert(shape);
  }
  return result;
}

const Loop kSquare{{0, 0, 0}, {12, 0, 0}, {12, 12, 0}, {0, 12, 0}};
const Loop kL{{0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {2, 2, 0}, {2, 4, 0}, {0, 4, 0}};

Loop rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0, 0}, {x1, y0, 0}, {x1, y1, 0}, {x0, y1, 0}};
}
Loop reversed(Loop loop) {
  std::reverse(loop.begin(), loop.end());
  return loop;
}

TEST(Cleaning, DropsRepeatedAndCollinear) {
  const auto p = sound(
      {{0, 0, 0}, {0, 0, 0}, {2, 0, 0}, {4, 0, 0}, {4, 4, 0}, {4, 4, 0}, {0, 4, 0}, {0, 2, 0}});
  ASSERT_EQ(p.parts.size(), 1u);
  EXPECT_EQ(p.parts[0].count, 4u);
  ASSERT_EQ(p.notes.size(), 2u);
  EXPECT_EQ(p.notes[0].repair, Repair::kRepeatedVertices);
  EXPECT_EQ(p.notes[1].repair, Repair::kCollinearVertices);
}

TEST(Cleaning, DropsSpikes) {
  const auto p = sound({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {4, 9, 0}, {4, 4, 0}, {0, 4, 0}});
  ASSERT_EQ(p.parts.size(), 1u);
  EXPECT_EQ(p.parts[0].count, 4u);
}

TEST(Cleaning, ZeroAreaIsDroppedAndListed) {
  Builder b;
  b.polygon({{0, 0, 0}, {1, 1, 1}, {3, 3, 3}}).polygon({{0, 0, 0}, {1, 0, 0}}).polygon({});
  b.polygon({{0, 0, 0}, {4, 0, 0}, {0, 0, 0}, {0, 4, 0}});
  b.polygon(kSquare);
  const auto p = sound(b, b.scene());
  EXPECT_EQ(p.parts.size(), 1u);
  EXPECT_EQ(p.first_part, (std::vector<std::uint32_t>{0, 0, 0, 0, 0, 1}));
  EXPECT_EQ(std::count_if(p.notes.begin(), p.notes.end(),
                          [](const auto& n) { return n.repair == Repair::kZeroArea; }),
            4);
}

TEST(NotConvex, LBecomesTwoParts) {
  const auto p = sound(kL);
  EXPECT_EQ(p.parts.size(), 2u);
  EXPECT_EQ(p.geometry.planes.size(), 1u);
  ASSERT_EQ(p.notes.size(), 1u);
  EXPECT_EQ(p.notes[0].repair, Repair::kNotConvex);
}

TEST(NotConvex, DoesNotDependOnTheStart) {
  Random random(5);
  Loop comb{{0, 0, 0}};
  for (int i = 0; i < 8; ++i) {
    comb.push_back({4.0 * i + 1, 0, 0});
    comb.push_back({4.0 * i + 1, static_cast<double>(random.between(2, 9)), 0});
    comb.push_back({4.0 * i + 3, static_cast<double>(random.between(2, 9)), 0});
    comb.push_back({4.0 * i + 3, 0, 0});
  }
  comb.push_back({34, 0, 0});
  comb.push_back({34, 20, 0});
  comb.push_back({0, 20, 0});
  Builder b;
  b.polygon(comb, {rectangle(5, 12, 9, 15), reversed(rectangle(15, 11, 22, 18))});
  const auto reference = shapes(sound(b, b.scene()));
  for (std::size_t turn = 1; turn < comb.size(); ++turn) {
    for (auto* loop : {&b.scene().polygons[0].loop, &b.scene().polygons[0].holes[0],
                       &b.scene().polygons[0].holes[1]}) {
      std::rotate(loop->begin(), loop->begin() + 1, loop->end());
    }
    std::swap(b.scene().polygons[0].holes[0], b.scene().polygons[0].holes[1]);
    std::reverse(b.scene().polygons[0].holes[0].begin(), b.scene().polygons[0].holes[0].end());
    EXPECT_EQ(shapes(sound(b, b.scene())), reference);
  }
}

TEST(NotConvex, EveryOrientationInSpace) {
  // The same L in planes of every main axis, from both sides, and oblique.
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool flip : {false, true}) {
      for (const double slope : {0.0, 3.0}) {
        Loop loop;
        for (const Triple& p : kL) {
          Triple q{};
          q[static_cast<std::size_t>(axis)] = 5 + (p[0] - 2 * p[1]) * slope / 8;
          q[static_cast<std::size_t>((axis + 1) % 3)] = p[0];
          q[static_cast<std::size_t>((axis + 2) % 3)] = p[1];
          loop.push_back(q);
        }
        EXPECT_EQ(sound(flip ? reversed(loop) : loop).parts.size(), 2u);
      }
    }
  }
}

TEST(NotConvex, ManyVertices) {
  for (const int n : {5, 33, 400}) {  // a star of 2 n corners on a dyadic circle
    Loop star;
    for (int i = 0; i < 2 * n; ++i) {
      const double angle = 3.14159265358979 * i / n, r = i % 2 == 0 ? 1024 : 512;
      star.push_back({std::round(r * std::cos(angle) * 64) / 64,
                      std::round(r * std::sin(angle) * 64) / 64, 7});
    }
    EXPECT_GE(sound(star).parts.size(), 2u) << n;
  }
}

TEST(NotConvex, LoopsMayTouchThemselves) {
  // Two lobes that meet in a vertex; a vertex on an edge; a keyhole.
  EXPECT_EQ(sound({{0, 0, 0}, {2, 2, 0}, {4, 0, 0}, {4, 4, 0}, {2, 2, 0}, {0, 4, 0}}).parts.size(),
            2u);
  EXPECT_EQ(sound({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 0, 0}, {0, 4, 0}}).parts.size(), 2u);
  Builder b;
  b.polygon(
      {{0, 0, 0}, {12, 0, 0}, {12, 12, 0}, {0, 12, 0}, {4, 4, 0}, {4, 8, 0}, {8, 8, 0}, {8, 4, 0}});
  b.scene().polygons[0].loop = {0, 1, 2, 3, 0, 4, 5, 6, 7, 4};
  EXPECT_EQ(sound(b, b.scene()).parts.size(), 4u);
}

TEST(Holes, OfBothOrientations) {
  for (const Loop& hole : {rectangle(4, 4, 8, 8), reversed(rectangle(4, 4, 8, 8))}) {
    const auto p = sound(kSquare, {hole});
    EXPECT_EQ(p.parts.size(), 4u);
    ASSERT_EQ(p.notes.size(), 1u);
    EXPECT_EQ(p.notes[0].repair, Repair::kHoles);
  }
}

TEST(Holes, WithHairs) {
  // The hole runs along the border, and partly back on it.
  const Loop hair{{12, 9, 0}, {12, 3, 0}, {9, 3, 0}, {12, 5, 0}, {12, 6, 0}, {9, 9, 0}};
  for (const Loop& hole : {hair, reversed(hair)})
    EXPECT_GE(sound(kSquare, {hole}).parts.size(), 2u);
  // As a loop, and inside.
  EXPECT_EQ(sound(hair).parts.size(), 2u);
  Loop inside = hair;
  for (Triple& point : inside) point[0] -= 2;
  EXPECT_GE(sound(kSquare, {inside}).parts.size(), 4u);
  // Two holes with one hair between them, and holes along the bridge of a keyhole.
  EXPECT_GE(sound(kSquare, {{{2, 2, 0}, {4, 2, 0}, {4, 5, 0}, {4, 4, 0}, {2, 4, 0}},
                            {{4, 4, 0}, {6, 4, 0}, {6, 8, 0}, {4, 8, 0}}})
                .parts.size(),
            3u);
  Builder b;
  b.polygon(
      {{0, 0, 0}, {12, 0, 0}, {12, 12, 0}, {0, 12, 0}, {4, 4, 0}, {4, 8, 0}, {8, 8, 0}, {8, 4, 0}},
      {{{0, 0, 0}, {4, 4, 0}, {4, 2, 0}}});
  b.scene().polygons[0].loop = {0, 1, 2, 3, 0, 4, 5, 6, 7, 4};
  EXPECT_GE(sound(b, b.scene()).parts.size(), 4u);
}

TEST(Holes, WithHairsThatGoAnywhere) {
  // Out of the loop and back, across another hole and back, along another hole's hair.
  const Loop plain{{2, 2, 0}, {4, 2, 0}, {4, 4, 0}, {2, 4, 0}};
  const auto with_hair_to = [&](std::initializer_list<Triple> way) {
    Loop hole = plain;
    hole.insert(hole.begin() + 2, {4, 3, 0});
    std::vector<Triple> there(way), back(way);
    std::reverse(back.begin(), back.end());
    back.erase(back.begin());
    back.push_back({4, 3, 0});
    hole.insert(hole.begin() + 3, back.begin(), back.end());
    hole.insert(hole.begin() + 3, there.begin(), there.end());
    // The back way has a vertex of its own, so that the hair is more than a spike.
    return hole;
  };
  const std::size_t parts = sound(kSquare, {plain}).parts.size();
  EXPECT_EQ(sound(kSquare, {with_hair_to({{14, 3, 0}})}).parts.size(), parts);
  EXPECT_EQ(sound(kSquare, {with_hair_to({{12, 3, 0}, {12, 8, 0}})}).parts.size(), parts);
  // There in one step and back in two: a hair only once the vertex between is put into both.
  const Loop uneven{{2, 2, 0}, {4, 2, 0}, {4, 3, 0}, {16, 3, 0},
                    {9, 3, 0}, {4, 3, 0}, {4, 4, 0}, {2, 4, 0}};
  const Loop other{{6, 1, 0}, {8, 1, 0}, {8, 6, 0}, {6, 6, 0}};
  EXPECT_EQ(sound(kSquare, {uneven, other}).parts.size(),
            sound(kSquare, {plain, other}).parts.size());
  // Two hairs that cross each other.
  const Loop hair_up{{6, 5, 0}, {8, 5, 0}, {8, 8, 0}, {7, 8, 0}, {7, 1, 0}, {7, 8, 0}, {6, 8, 0}};
  EXPECT_GE(sound(kSquare, {uneven, hair_up}).parts.size(), parts);
  // Of a loop, too.
  EXPECT_EQ(sound({{0, 0, 0}, {6, 0, 0}, {6, 9, 0}, {9, -3, 0}, {6, 9, 0}, {6, 12, 0}, {0, 12, 0}})
                .parts.size(),
            1u);
}

TEST(Loops, WithHairsThatCrossThem) {
  // Two holes cut by seams from one corner: the second seam runs outside the first hole, or across.
  const auto seams = [](const Triple& second_hole) {
    const auto at = [&](double x, double y) {
      return Triple{second_hole[0] + x, second_hole[1] + y, 0};
    };
    const Triple corner{0, 12, 0};
    return Loop{{0, 0, 0}, {12, 0, 0}, {12, 12, 0}, corner, {2, 2, 0}, {2, 5, 0},
                {5, 5, 0}, {5, 2, 0},  {2, 2, 0},   corner, at(0, 0),  at(0, 2),
                at(2, 2),  at(2, 0),   at(0, 0),    corner};
  };
  EXPECT_GE(sound(seams({8, 8, 0})).parts.size(), 4u);
  const Error across = error_of(seams({7, 1, 0}));
  EXPECT_NE(across.what.find("crosses itself: edges"), std::string::npos) << across.what;
}

TEST(Holes, OfALoopWithoutAreaAreCheckedFirst) {
  const Error outside =
      error_of({{0, 0, 0}, {4, 0, 0}, {8, 0, 0}}, {{{1, 1, 0}, {2, 1, 0}, {2, 2, 0}}});
  EXPECT_EQ(outside.where.pointer, "/polygons/0/holes/0");
  EXPECT_NE(outside.what.find("hole 0 leaves the loop"), std::string::npos) << outside.what;
  const auto dropped =
      sound({{0, 0, 0}, {4, 0, 0}, {8, 0, 0}}, {{{1, 0, 0}, {2, 0, 0}, {3, 0, 0}}});
  EXPECT_TRUE(dropped.parts.empty());
}

TEST(Errors, BowTiesOfNoSignedAreaNameTheEdges) {
  const auto what_of = [](const Loop& loop) { return error_of(loop).what; };
  EXPECT_NE(what_of({{0, 0, 0}, {4, 4, 0}, {4, 0, 0}, {0, 4, 0}})
                .find("crosses itself: edges 0-1 and 2-3"),
            std::string::npos);
  // In a plane along x, where the area vector cannot say in which direction to look.
  EXPECT_NE(what_of({{5, 0, 0}, {5, 4, 4}, {5, 4, 0}, {5, 0, 4}})
                .find("crosses itself: edges 0-1 and 2-3"),
            std::string::npos);
  // Two triangles that meet in a vertex, one each way round: no edges cross.
  EXPECT_NE(what_of({{2, 2, 0}, {0, 0, 0}, {4, 0, 0}, {2, 2, 0}, {1, 6, 0}, {3, 6, 0}})
                .find("crosses itself at vertex 0"),
            std::string::npos);
}

TEST(Holes, OfFewVerticesAreDropped) {
  for (const Loop& hole : {Loop{{3, 3, 0}, {5, 5, 0}}, Loop{{3, 3, 0}}, Loop{},
                           Loop{{3, 3, 0}, {5, 5, 0}, {4, 4, 0}}, Loop{{0, 0, 0}, {24, 0, 0}}}) {
    const auto p = sound(kSquare, {hole});
    EXPECT_EQ(p.parts.size(), 1u);
    ASSERT_EQ(p.notes.size(), 1u);
    EXPECT_EQ(p.notes[0].detail, "hole 0 has no area and is dropped");
  }
}

TEST(Holes, Many) {
  std::vector<Loop> holes;
  for (int i = 0; i < 36; ++i) {
    const double x = 2.0 * (i % 6) + 0.5, y = 2.0 * (i / 6) + 0.5;
    holes.push_back(i % 2 == 0 ? rectangle(x, y, x + 1, y + 1)
                               : Loop{{x, y, 0}, {x + 0.25, y + 1, 0}, {x + 1, y, 0}});
  }
  const auto p = sound(kSquare, holes);
  EXPECT_GE(p.parts.size(), 36u);
}

TEST(Holes, MayTouch) {
  EXPECT_GE(sound(kSquare, {{{0, 0, 0}, {4, 2, 0}, {2, 4, 0}}}).parts.size(), 2u);  // at a vertex
  EXPECT_GE(sound(kSquare, {{{6, 0, 0}, {8, 4, 0}, {4, 4, 0}}}).parts.size(), 2u);  // on an edge
  EXPECT_EQ(sound(kSquare, {rectangle(4, 0, 8, 12)}).parts.size(), 2u);             // cut in two
  EXPECT_EQ(sound(kSquare, {rectangle(0, 0, 12, 6)}).parts.size(), 1u);             // along edges
  EXPECT_GE(sound(kSquare, {rectangle(2, 2, 6, 6), rectangle(6, 6, 10, 10)}).parts.size(), 3u);
  EXPECT_GE(sound(kSquare, {rectangle(2, 2, 6, 6), rectangle(6, 4, 10, 10)}).parts.size(), 3u);
  // Four that enclose an island.
  EXPECT_GE(sound(kSquare, {rectangle(2, 2, 8, 4), rectangle(8, 2, 10, 8), rectangle(4, 8, 10, 10),
                            rectangle(2, 4, 4, 10)})
                .parts.size(),
            5u);
}

TEST(Holes, ThatFillTheLoopLeaveNothing) {
  const auto p = sound(kSquare, {kSquare});
  EXPECT_TRUE(p.parts.empty());
  ASSERT_EQ(p.notes.size(), 1u);
  EXPECT_EQ(p.notes[0].repair, Repair::kZeroArea);
}

TEST(Holes, WithoutAreaAreDropped) {
  const auto p = sound(kSquare, {{{2, 2, 0}, {4, 4, 0}, {6, 6, 0}}});
  EXPECT_EQ(p.parts.size(), 1u);
  ASSERT_EQ(p.notes.size(), 1u);
}

TEST(Errors, NameTheirPlace) {
  const Error bow = error_of({{0, 0, 0}, {4, 4, 0}, {4, 0, 0}, {1, 5, 0}});
  EXPECT_EQ(bow.code, ErrorCode::kGeometry);
  EXPECT_EQ(bow.where.pointer, "/polygons/0/loop");
  EXPECT_NE(bow.what.find("crosses itself: edges 0-1 and 2-3"), std::string::npos) << bow.what;
  EXPECT_EQ(error_of({{0, 0, 0}, {4, 4, 0}, {4, 0, 0}, {0, 4, 0}}).code,
            ErrorCode::kGeometry);  // area 0
  // Through a vertex, so that the two lobes run opposite ways; and twice round the same area.
  EXPECT_FALSE(
      error_of({{0, 0, 0}, {2, 2, 0}, {4, 5, 0}, {4, 0, 0}, {2, 2, 0}, {0, 4, 0}}).what.empty());
  EXPECT_FALSE(
      error_of({{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 0, 0}, {6, 1, 0}, {6, 5, 0}}).what.empty());
  const Error leaves = error_of(kSquare, {rectangle(2, 2, 4, 4), rectangle(8, 8, 14, 10)});
  EXPECT_EQ(leaves.where.pointer, "/polygons/0/holes/1");
  EXPECT_NE(leaves.what.find("crosses the loop"), std::string::npos);
  EXPECT_NE(error_of(kSquare, {rectangle(13, 2, 14, 4)}).what.find("leaves the loop"),
            std::string::npos);
  EXPECT_NE(error_of(kSquare, {rectangle(12, 2, 14, 4)}).what.find("leaves the loop"),
            std::string::npos);
  EXPECT_NE(error_of(kSquare, {rectangle(2, 2, 6, 6), rectangle(4, 4, 8, 8)})
                .what.find("crosses another hole"),
            std::string::npos);
  EXPECT_NE(
      error_of(kSquare, {rectangle(2, 2, 8, 8), rectangle(4, 4, 6, 6)}).what.find("overlaps hole"),
      std::string::npos);
  EXPECT_NE(
      error_of(kSquare, {rectangle(2, 2, 8, 8), rectangle(2, 2, 8, 8)}).what.find("overlaps hole"),
      std::string::npos);
  Builder b;
  b.polygon(kSquare);
  b.scene().polygons[0].loop[2] = 77;
  EXPECT_EQ(b.prepare().error().code, ErrorCode::kIndex);
}

// A file of 600 KB: comparing its edges pair by pair would take many minutes.
TEST(Errors, AHundredThousandTimesRoundATriangle) {
  Builder b;
  b.polygon({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}});
  auto& loop = b.scene().polygons[0].loop;
  for (VertexId i = 3; i < 300'000; ++i) loop.push_back(i % 3);
  const auto prepared = b.prepare();
  ASSERT_FALSE(prepared);
  EXPECT_EQ(prepared.error().code, ErrorCode::kGeometry);
  EXPECT_NE(prepared.error().what.find("runs along the edge 0-1 twice"), std::string::npos)
      << prepared.error().what;
}

TEST(NotPlanar, IsTriangulatedByTheRule) {
  Builder b;
  b.polygon({{0, 0, 0}, {4, 0, 0}, {4, 4, 1}, {0, 4, 0}});
  const auto reference = shapes(sound(b, b.scene()));
  EXPECT_EQ(reference, (std::set<std::set<Triple>>{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}},
                                                   {{4, 0, 0}, {4, 4, 1}, {0, 4, 0}}}));
  for (int turn = 0; turn < 4; ++turn) {
    auto& loop = b.scene().polygons[0].loop;
    std::rotate(loop.begin(), loop.begin() + 1, loop.end());
    EXPECT_EQ(shapes(sound(b, b.scene())), reference);
  }
  const auto p = b.prepare();
  ASSERT_EQ(p->notes.size(), 1u);
  EXPECT_EQ(p->notes[0].repair, Repair::kNotPlanar);
  EXPECT_EQ(p->notes[0].detail, "0.97 scene units off its plane; 2 parts");
}

TEST(NotPlanar, WithHoles) {
  Builder b;
  b.polygon({{0, 0, 0}, {12, 0, 1}, {12, 12, 0}, {0, 12, 0}},
            {{{4, 4, 0}, {8, 4, 2}, {8, 8, 0}, {4, 8, 0}}});
  const auto p = sound(b, b.scene());
  EXPECT_EQ(p.parts.size(), 8u);
  const Error error = error_of({{0, 0, 0}, {4, 4, 1}, {4, 0, 0}, {1, 5, 0}});
  EXPECT_NE(error.what.find("projection along z"), std::string::npos) << error.what;
}

TEST(AreaLights, AreCheckedAndNeverMoved) {
  Builder good;
  good.polygon(kSquare).area_light({{0, 0, 3}, {0, 1, 3}, {1, 1, 3}, {1, 0, 3}, {0.5, 0, 3}});
  const auto p = good.prepare();
  ASSERT_TRUE(p) << to_string(p.error());
  EXPECT_EQ(p->lights[0].area_loop.size(), 4u);
  ASSERT_EQ(p->light_notes.size(), 1u);
  Builder bent;
  bent.polygon(kSquare).area_light({{0, 0, 3}, {0, 1, 3}, {1, 1, 3}, {1, 0, 3.25}});
  const auto failed = bent.prepare();
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().where.pointer, "/lights/0/loop");
  EXPECT_NE(failed.error().what.find("vertex 3 is 0.25 scene units off"), std::string::npos)
      << failed.error().what;
  EXPECT_NE(failed.error().expected.find("setting z of vertex 3 to 3 "), std::string::npos)
      << failed.error().expected;
  for (const Loop& loop : {Loop{{0, 0, 3}, {1, 1, 3}, {2, 2, 3}},
                           Loop{{0, 0, 3}, {4, 0, 3}, {1, 1, 3}, {0, 4, 3}}, Loop{}}) {
    Builder bad;
    bad.polygon(kSquare).area_light(loop);
    EXPECT_FALSE(bad.prepare());
  }
}

TEST(Metamorphic, PowersOfTwoAndHugeGridsChangeNothing) {
  // The same polygons decided in 128 bits, 256 bits and GMP integers.
  Builder b;
  b.polygon(kL).polygon(kSquare, {rectangle(4, 0, 8, 6), rectangle(8, 6, 10, 10)});
  b.polygon({{0, 0, 9}, {4, 0, 9}, {4, 4, 8}, {0, 4, 9}});
  const PreparedScene reference = sound(b, b.scene());
  for (const double tiny : {0.0, std::ldexp(1.0, -50), std::ldexp(1.0, -300)}) {
    Scene scene = b.scene();
    Polygon p;
    p.id = "tiny";
    p.loop = {0, 1, static_cast<VertexId>(scene.vertices.size())};
    scene.vertices.push_back(position({0, tiny, 1}));
    scene.polygons.push_back(p);
    const auto prepared = prepare(scene);
    ASSERT_TRUE(prepared);
    EXPECT_EQ(first_flaw(*prepared, scene), "");
    ASSERT_EQ(prepared->parts.size(), reference.parts.size() + 1);
    EXPECT_TRUE(std::equal(reference.loop_vertices.begin(), reference.loop_vertices.end(),
                           prepared->loop_vertices.begin()));
  }
}

}  // namespace
}  // namespace gnomon::test
