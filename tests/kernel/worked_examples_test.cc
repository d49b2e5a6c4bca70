// SPDX-License-Identifier: GPL-3.0-or-later
// Worked examples of every predicate of kernel `plane`: input that one can check by hand, the side,
// and which stages of the ladder answered (staged_sign.h). Each scene is scaled by a power of two,
// so that the same decision falls to 64-bit integers, to wider ones, or to GMP.
#include <gtest/gtest.h>

#include <limits>
#include <ostream>
#include <string>
#include <vector>

#include "kernel/implicit/implicit_light_space.h"
#include "kernel/implicit/implicit_volume_space.h"
#include "triangle_soup.h"

namespace gnomon::test {
namespace {

/// A side, and the stages that were asked: "filter", "identity", "64", "2x 128, 256", ...
struct Answer {
  Side side;
  std::string stages;
  friend bool operator==(const Answer&, const Answer&) = default;
};
void PrintTo(const Answer& answer, std::ostream* out) {
  *out << (answer.side == Side::kFront  ? "front"
           : answer.side == Side::kBack ? "back"
                                        : "on")
       << " by " << answer.stages;
}

std::string stages_between(const StageCounts& before, const StageCounts& after) {
  std::string text;
  const auto add = [&](const std::string& name, std::uint64_t count) {
    if (count == 0) return;
    if (!text.empty()) text += ", ";
    text += (count > 1 ? std::to_string(count) + "x " : "") + name;
  };
  add("filter", after.filter - before.filter);
  add("identity", after.identity - before.identity);
  for (std::size_t i = 0; i < 6; ++i) {
    add(std::string(width_name(static_cast<IntegerWidth>(i))),
        after.by_width()[i] - before.by_width()[i]);
  }
  return text;
}

template <class Space, class Ask>
Answer answer(Space& space, const Ask& ask) {
  const StageCounts before = space.stage_counts();
  const Side side = ask();
  return {side, stages_between(before, space.stage_counts())};
}

using Triangle = std::array<Integers, 3>;

TriangleSoup scaled(std::vector<Triangle> triangles, unsigned exponent) {
  for (Triangle& triangle : triangles) {
    for (Integers& corner : triangle) {
      for (mpz_class& x : corner) x <<= exponent;
    }
  }
  return TriangleSoup(triangles, 0);
}

/// The name of an edge in scene space and in volume space.
template <class Space>
PlaneRef edge_name(const TriangleSoup& soup, const Space& space, std::uint32_t triangle,
                   std::uint32_t i) {
  const PlaneRef edge = soup.edge(triangle, i % 3);
  return space.edges().of_edge(edge.index(), edge.flipped());
}

/// Vertex i of a triangle that is not cut.
template <class Space>
Corner<typename Space::Vertex> corner_of(const TriangleSoup& soup, const Space& space,
                                         std::uint32_t triangle, std::uint32_t i,
                                         const typename Space::Vertex& vertex) {
  return {edge_name(soup, space, triangle, i + 2), vertex, edge_name(soup, space, triangle, i),
          triangle};
}

/// Grids of 4 bits; of 24 and 64 bits; of 404 bits, where all is left to GMP.
constexpr unsigned kSmall = 0, kLarge = 20, kBeyond64 = 60, kHuge = 400;

// --- Space. ---

// Numbers of triangles, and so of their support planes.
constexpr PlaneId kFloor = 0, kWall2 = 1, kSlope = 2, kShelf = 3, kWall3 = 4, kSide = 5, kPost = 6;

/// A floor, walls at x = 2, x = 3 and y = 2, a shelf at z = 4, and a slope 4 x + 4 y - 3 z = 8 that
/// stands on the floor in (1, 1, 0), meets the wall x = 2 with its first edge in (2, 3, 4), and the
/// walls x = 3 and y = 2 in (3, 2, 4): both points are on the shelf's plane. A post shares a vertex
/// with the floor.
TriangleSoup shelf_room(unsigned exponent) {
  return scaled({{{{0, 0, 0}, {8, 0, 0}, {0, 8, 0}}},
                 {{{2, 0, 0}, {2, 8, 0}, {2, 0, 8}}},
                 {{{1, 1, 0}, {3, 5, 8}, {7, 1, 8}}},
                 {{{0, 0, 4}, {8, 0, 4}, {0, 8, 4}}},
                 {{{3, 0, 0}, {3, 8, 0}, {3, 0, 8}}},
                 {{{0, 2, 0}, {0, 2, 8}, {8, 2, 0}}},
                 {{{8, 0, 0}, {8, 1, 0}, {8, 0, 8}}}},
                exponent);
}

/// Sides that the three kinds of corners of the slope have, on any of the two spaces.
template <class Space>
struct SlopeCorners {
  const TriangleSoup& soup;
  Space& space;
  typename Space::Vertex foot{}, top{}, on_edge{}, inside{};

  SlopeCorners(const TriangleSoup& triangles, Space& the_space)
      : soup(triangles), space(the_space) {
    foot = space.input_vertex(soup.loop(kSlope)[0]);
    top = space.input_vertex(soup.loop(kSlope)[1]);
    on_edge = space.crossing(PlaneRef(kWall2), edge_name(soup, space, kSlope, 0), true, at_foot(),
                             at_top());
  }
  Corner<typename Space::Vertex> at_foot() const { return corner_of(soup, space, kSlope, 0, foot); }
  Corner<typename Space::Vertex> at_top() const { return corner_of(soup, space, kSlope, 1, top); }
  /// (2, 3, 4): the first edge, and the wall x = 2.
  Corner<typename Space::Vertex> at_wall() const {
    return {edge_name(soup, space, kSlope, 0), on_edge, PlaneRef(kWall2), kSlope};
  }
  /// (3, 2, 4): the slope and two walls. Its doubles say nothing.
  Corner<typename Space::Vertex> at_walls() const {
    return {PlaneRef(kWall3), inside, PlaneRef(kSide), kSlope};
  }
  Answer side(PlaneId plane, const Corner<typename Space::Vertex>& corner) const {
    return answer(space, [&] { return space.side_of_plane(PlaneRef(plane), corner); });
  }
};

struct SceneExample {
  TriangleSoup soup;
  ImplicitSceneSpace<CountStats> space;
  SlopeCorners<ImplicitSceneSpace<CountStats>> at;

  explicit SceneExample(unsigned exponent)
      : soup(shelf_room(exponent)), space(soup.geometry(), {}), at(soup, space) {
    at.inside.error = std::numeric_limits<double>::infinity();
  }
};

struct VolumeExample {
  TriangleSoup soup;
  ImplicitSceneSpace<CountStats> scene;
  ImplicitVolumeSpace<CountStats> space;
  SlopeCorners<ImplicitVolumeSpace<CountStats>> at;

  explicit VolumeExample(unsigned exponent)
      : soup(shelf_room(exponent)), scene(soup.geometry(), {}), space(scene, {}), at(soup, space) {
    at.inside.bound = std::numeric_limits<float>::infinity();
  }
};

TEST(SceneSideOfPlane, IsKnownByIdentity) {
  const SceneExample example(kSmall);
  const auto& at = example.at;
  // (1) The wall that cut the edge.
  EXPECT_EQ(at.side(kWall2, at.at_wall()), (Answer{Side::kOn, "identity"}));
  // (2) The slope's own plane, in every corner.
  EXPECT_EQ(at.side(kSlope, at.at_wall()), (Answer{Side::kOn, "identity"}));
  EXPECT_EQ(at.side(kSlope, at.at_walls()), (Answer{Side::kOn, "identity"}));
  // (3) One of the three vertices that a plane was made from, in another loop.
  const auto shared = example.space.input_vertex(example.soup.loop(kPost)[0]);
  EXPECT_EQ(at.side(kFloor, corner_of(example.soup, example.space, kPost, 0, shared)),
            (Answer{Side::kOn, "identity"}));
}

TEST(SceneSideOfPlane, IsFiltered) {
  const SceneExample example(kSmall);
  const auto& at = example.at;
  EXPECT_EQ(at.side(kFloor, at.at_top()), (Answer{Side::kFront, "filter"}));   // z = 8
  EXPECT_EQ(at.side(kShelf, at.at_foot()), (Answer{Side::kBack, "filter"}));   // z = 0
  EXPECT_EQ(at.side(kFloor, at.at_wall()), (Answer{Side::kFront, "filter"}));  // z = 4
}

TEST(SceneSideOfPlane, IsExactForInputVertices) {
  // The slope stands on the floor: degree 3, 3 b + 2 bits.
  for (const auto& [exponent, bits] : {std::pair{kSmall, "64"}, std::pair{kLarge, "128"},
                                       std::pair{kBeyond64, "256"}, std::pair{kHuge, "GMP"}}) {
    const SceneExample example(exponent);
    EXPECT_EQ(example.at.side(kFloor, example.at.at_foot()), (Answer{Side::kOn, bits}));
  }
}

TEST(SceneSideOfPlane, IsExactForPointsOfEdges) {
  // (2, 3, 4) is on the shelf's plane: degree 6, 6 b + 4 bits.
  for (const auto& [exponent, bits] : {std::pair{kSmall, "64"}, std::pair{kLarge, "256"},
                                       std::pair{kBeyond64, "512"}, std::pair{kHuge, "GMP"}}) {
    const SceneExample example(exponent);
    EXPECT_EQ(example.at.side(kShelf, example.at.at_wall()), (Answer{Side::kOn, bits}));
  }
}

TEST(SceneSideOfPlane, IsExactForPointsOfThreePlanes) {
  // (3, 2, 4) is on the shelf's plane, in front of the floor and of x = 2: degree 9, 9 b + 6 bits.
  for (const auto& [exponent, bits] : {std::pair{kSmall, "64"}, std::pair{kLarge, "256"},
                                       std::pair{kBeyond64, "1024"}, std::pair{kHuge, "GMP"}}) {
    const SceneExample example(exponent);
    const auto& at = example.at;
    EXPECT_EQ(at.side(kShelf, at.at_walls()), (Answer{Side::kOn, bits}));
    EXPECT_EQ(at.side(kFloor, at.at_walls()), (Answer{Side::kFront, bits}));
    EXPECT_EQ(at.side(kWall2, at.at_walls()), (Answer{Side::kFront, bits}));
  }
}

// --- Volumes. ---

TEST(VolumeSideOfPlane, IsKnownByIdentity) {
  VolumeExample example(kSmall);
  auto& [soup, scene, space, at] = example;
  // (1) and (2).
  EXPECT_EQ(at.side(kWall2, at.at_wall()), (Answer{Side::kOn, "identity"}));
  EXPECT_EQ(at.side(kSlope, at.at_walls()), (Answer{Side::kOn, "identity"}));
  // (3) A plane of a volume, through the slope's first edge and a corner of the floor.
  const auto far = space.input_vertex(soup.loop(kFloor)[1]);
  const PlaneRef plane =
      space.add_plane(at.at_foot(), at.at_top(), corner_of(soup, space, kFloor, 1, far));
  EXPECT_EQ(at.side(plane.index(), at.at_top()), (Answer{Side::kOn, "identity"}));
  // (4) It contains the whole edge, and so the point where the wall cuts it; and the line in which
  // a second plane through that edge meets the slope.
  EXPECT_EQ(at.side(plane.index(), at.at_wall()), (Answer{Side::kOn, "identity"}));
  const auto other = space.input_vertex(soup.loop(kFloor)[2]);
  const PlaneRef second =
      space.add_plane(at.at_foot(), at.at_top(), corner_of(soup, space, kFloor, 2, other));
  EXPECT_EQ(at.side(plane.index(), {second, at.inside, PlaneRef(kWall2), kSlope}),
            (Answer{Side::kOn, "identity"}));
  // (4) The same three vertices define the same plane, whatever its number.
  const auto origin = space.input_vertex(soup.loop(kFloor)[0]);
  const PlaneRef floor = space.add_plane(corner_of(soup, space, kFloor, 2, other),
                                         corner_of(soup, space, kFloor, 0, origin),
                                         corner_of(soup, space, kFloor, 1, far));
  EXPECT_EQ(at.side(kFloor, {floor, at.inside, PlaneRef(kWall2), kSlope}),
            (Answer{Side::kOn, "identity"}));
}

TEST(VolumeSideOfPlane, IsFiltered) {
  const VolumeExample example(kSmall);
  const auto& at = example.at;
  EXPECT_EQ(at.side(kFloor, at.at_top()), (Answer{Side::kFront, "filter"}));
  EXPECT_EQ(at.side(kShelf, at.at_foot()), (Answer{Side::kBack, "filter"}));
  EXPECT_EQ(at.side(kFloor, at.at_wall()), (Answer{Side::kFront, "filter"}));
}

TEST(VolumeSideOfPlane, IsExactForInputVertices) {
  for (const auto& [exponent, bits] : {std::pair{kSmall, "64"}, std::pair{kLarge, "128"},
                                       std::pair{kBeyond64, "256"}, std::pair{kHuge, "GMP"}}) {
    const VolumeExample example(exponent);
    EXPECT_EQ(example.at.side(kFloor, example.at.at_foot()), (Answer{Side::kOn, bits}));
  }
}

TEST(VolumeSideOfPlane, IsExactForPointsOfEdges) {
  for (const auto& [exponent, bits] : {std::pair{kSmall, "64"}, std::pair{kLarge, "256"},
                                       std::pair{kBeyond64, "512"}, std::pair{kHuge, "GMP"}}) {
    const VolumeExample example(exponent);
    EXPECT_EQ(example.at.side(kShelf, example.at.at_wall()), (Answer{Side::kOn, bits}));
  }
}

TEST(VolumeSideOfPlane, IsExactForPointsOfThreePlanes) {
  for (const auto& [exponent, bits] : {std::pair{kSmall, "64"}, std::pair{kLarge, "256"},
                                       std::pair{kBeyond64, "1024"}, std::pair{kHuge, "GMP"}}) {
    const VolumeExample example(exponent);
    const auto& at = example.at;
    EXPECT_EQ(at.side(kShelf, at.at_walls()), (Answer{Side::kOn, bits}));
    EXPECT_EQ(at.side(kFloor, at.at_walls()), (Answer{Side::kFront, bits}));
    EXPECT_EQ(at.side(kWall2, at.at_walls()), (Answer{Side::kFront, bits}));
  }
}

TEST(VolumeSideOfPlane, IsExactForPlanesOfIntegers) {
  VolumeExample example(kSmall);
  auto& [soup, scene, space, at] = example;
  // z = 4 is a quarter of the grid's extent, 16; the shelf is there, and the foot below. The value
  // of that plane has 58 bits: z is multiplied by 2^50, so that any double would be exact.
  const PlaneRef quarter = space.add_axis_plane(2, 0.25);
  const auto shelf = space.input_vertex(soup.loop(kShelf)[0]);
  EXPECT_EQ(at.side(quarter.index(), corner_of(soup, space, kShelf, 0, shelf)),
            (Answer{Side::kOn, "64"}));
  EXPECT_EQ(at.side(quarter.index(), at.at_foot()), (Answer{Side::kBack, "filter"}));
  // Through the slope's first edge, upwards: the wall's point is above it, on the plane, and known
  // to be on that edge only where the plane is known by its vertices.
  LightPoint up;
  up.directional = true;
  up.grid = {0, 0, 1};
  const PlaneRef upright = space.add_plane(at.at_foot(), at.at_top(), up);
  EXPECT_EQ(at.side(upright.index(), at.at_wall()), (Answer{Side::kOn, "64"}));
}

// --- Light. ---

constexpr std::uint32_t kLow = 0, kHigh = 1, kGround = 2, kTouching = 3, kTilted = 4, kSharing = 5;

/// A lamp at (0, 0, 8), and triangles seen from it. In the plane z = 4 the first edge of `low` is
/// on the line x + y = 2, the last edge of `high` (at z = 6) projects on x = y, and the first edge
/// of `ground` (at z = 0) on x = 1: all three pass through (1, 1, 4). `touching` has a vertex on
/// the first shadow plane, in (1, 3, 0), and one on the plane z = 4. `tilted`, z = 2 x + y + 1,
/// contains (1, 1, 4). `sharing` has the first vertex of `low`.
struct LightExample {
  TriangleSoup soup;
  ImplicitSceneSpace<CountStats> scene;
  ImplicitLightSpace<CountStats> space;
  using Vertex = ImplicitLightSpace<CountStats>::Vertex;

  static LightPoint lamp(unsigned exponent) {
    LightPoint light;
    light.grid = {0, 0, mpz_class(8) << exponent};
    return light;
  }
  explicit LightExample(unsigned exponent, const LightPoint& light)
      : soup(scaled({{{{2, 0, 4}, {0, 2, 4}, {0, 0, 4}}},
                     {{{0, 0, 6}, {1, 0, 6}, {1, 1, 6}}},
                     {{{2, 0, 0}, {2, 4, 0}, {0, 2, 0}}},
                     {{{1, 3, 0}, {9, 3, 4}, {9, 9, 0}}},
                     {{{0, 0, 1}, {3, 0, 7}, {0, 4, 5}}},
                     {{{2, 0, 4}, {9, 0, 1}, {9, 5, 1}}}},
                    exponent)),
        scene(soup.geometry(), {}),
        space(scene, light, {}) {}
  explicit LightExample(unsigned exponent) : LightExample(exponent, lamp(exponent)) {}

  Vertex vertex(std::uint32_t triangle, std::uint32_t i) {
    return space.import_vertex(scene.input_vertex(soup.loop(triangle)[i]));
  }
  /// The shadow plane of an edge. All triangles face the lamp.
  PlaneRef edge(std::uint32_t triangle, std::uint32_t i) {
    return space.import_edge(edge_name(soup, scene, triangle, i), triangle, false, {}, {});
  }
  Corner<Vertex> corner(std::uint32_t triangle, std::uint32_t i, const Vertex& vertex) {
    return {edge(triangle, (i + 2) % 3), vertex, edge(triangle, i), triangle};
  }
  Answer side(PlaneRef plane, const Corner<Vertex>& corner) {
    return answer(space, [&] { return space.side_of_plane(plane, corner); });
  }
  Answer depth(PlaneId plane, const Corner<Vertex>& corner) {
    return answer(space, [&] { return space.side_of_support(plane, corner); });
  }
};

LightExample::Vertex unknown_vertex() {
  LightExample::Vertex vertex;
  vertex.bound = std::numeric_limits<float>::infinity();
  return vertex;
}

TEST(LightSide, IsExact) {
  LightExample example(kSmall);
  EXPECT_EQ(example.space.light_side(kLow), Sign::kPositive);
  EXPECT_EQ(example.space.light_side(kTilted), Sign::kPositive);  // 8 > 2 * 0 + 0 + 1
  LightPoint light;
  light.grid = {0, 0, 2};
  EXPECT_EQ(LightExample(kSmall, light).space.light_side(kLow), Sign::kNegative);
  EXPECT_EQ(LightExample(kSmall, light).space.light_side(kGround), Sign::kPositive);
  light.grid = {9, 9, 4};
  EXPECT_EQ(LightExample(kSmall, light).space.light_side(kLow), Sign::kZero);
  light.directional = true;
  light.grid = {1, 0, 0};
  EXPECT_EQ(LightExample(kSmall, light).space.light_side(kLow), Sign::kZero);
  EXPECT_EQ(LightExample(kSmall, light).space.light_side(kTilted), Sign::kNegative);
  light.grid = {0, 0, -1};
  EXPECT_EQ(LightExample(kHuge, light).space.light_side(kLow), Sign::kNegative);
}

TEST(LightSideOfPlane, IsKnownByIdentity) {
  LightExample example(kSmall);
  // (1) Where two planes meet, both are.
  const auto made = unknown_vertex();
  const PlaneRef first = example.edge(kLow, 0), second = example.edge(kHigh, 2);
  EXPECT_EQ(example.side(first, {first, made, second, kLow}), (Answer{Side::kOn, "identity"}));
  EXPECT_EQ(example.side(-second, {first, made, second, kLow}), (Answer{Side::kOn, "identity"}));
  // (3) An end of the edge, whatever loop asks.
  const auto end = example.vertex(kSharing, 0);
  EXPECT_EQ(example.side(first, example.corner(kSharing, 0, end)), (Answer{Side::kOn, "identity"}));
}

TEST(LightSideOfPlane, IsFiltered) {
  LightExample example(kSmall);
  // The interior is in front: a corner of `low` of the edge opposite to it.
  const auto opposite_corner = example.vertex(kLow, 2);
  EXPECT_EQ(example.side(example.edge(kLow, 0), example.corner(kLow, 2, opposite_corner)),
            (Answer{Side::kFront, "filter"}));
  const auto outside = example.vertex(kTouching, 2);
  EXPECT_EQ(example.side(example.edge(kLow, 0), example.corner(kTouching, 2, outside)),
            (Answer{Side::kBack, "filter"}));
  // The crossing (1, 1, 4) has x > 0, where the edge from (0, 2, 4) to (0, 0, 4) has its front.
  LightExample::Vertex made;
  const PlaneRef before = example.edge(kLow, 0), after = example.edge(kHigh, 2);
  example.space.finish_vertex(made, before, after);
  EXPECT_EQ(example.side(example.edge(kLow, 1), {before, made, after, kLow}),
            (Answer{Side::kFront, "filter"}));
}

TEST(LightSideOfPlane, IsExactForInputVertices) {
  // x + y + z / 2 = 4 is the first edge's plane, and (1, 3, 0) on it: degree 3, 3 b + 2 bits.
  for (const auto& [exponent, bits] :
       {std::pair{kSmall, "64"}, std::pair{kLarge, "128"}, std::pair{kBeyond64, "GMP"}}) {
    LightExample example(exponent);
    const auto touching = example.vertex(kTouching, 0);
    EXPECT_EQ(example.side(example.edge(kLow, 0), example.corner(kTouching, 0, touching)),
              (Answer{Side::kOn, bits}));
  }
}

TEST(LightSideOfPlane, IsExactForPrefixPlanes) {
  // q_x + q_y = 0 through the axis of the lamp holds what is below it: n + b + 3 bits.
  for (const auto& [exponent, bits] :
       {std::pair{kSmall, "64"}, std::pair{kBeyond64, "GMP"}, std::pair{kHuge, "GMP"}}) {
    LightExample example(exponent);
    const PlaneRef prefix = example.space.add_prefix_plane({{1, 1, 0}});
    const auto below = example.vertex(kLow, 2);
    EXPECT_EQ(example.side(prefix, example.corner(kLow, 2, below)), (Answer{Side::kOn, bits}));
  }
}

TEST(LightSideOfPlane, IsExactForCrossings) {
  // Three shadow planes through one ray: degree 6, 6 b + 3 bits.
  for (const auto& [exponent, bits] :
       {std::pair{kSmall, "64"}, std::pair{kLarge, "256"}, std::pair{kBeyond64, "GMP"}}) {
    LightExample example(exponent);
    const auto made = unknown_vertex();
    const Corner<LightExample::Vertex> corner{example.edge(kLow, 0), made, example.edge(kHigh, 2),
                                              kLow};
    EXPECT_EQ(example.side(example.edge(kGround, 0), corner), (Answer{Side::kOn, bits}));
    EXPECT_EQ(example.side(example.edge(kLow, 1), corner), (Answer{Side::kFront, bits}));
    EXPECT_EQ(example.side(-example.edge(kLow, 1), corner), (Answer{Side::kBack, bits}));
  }
}

TEST(LightSideOfSupport, IsKnownByIdentity) {
  LightExample example(kSmall);
  // (2) Its own plane.
  const auto own = example.vertex(kLow, 0);
  EXPECT_EQ(example.depth(kLow, example.corner(kLow, 0, own)), (Answer{Side::kOn, "identity"}));
  // (3) A vertex that the plane was made from, in another loop.
  const auto shared = example.vertex(kSharing, 0);
  EXPECT_EQ(example.depth(kLow, example.corner(kSharing, 0, shared)),
            (Answer{Side::kOn, "identity"}));
  // (5) On the cut of the two planes.
  const auto made = unknown_vertex();
  const PlaneRef cut = example.space.cut_of_supports(kTilted, kLow);
  EXPECT_EQ(example.depth(kLow, {cut, made, example.edge(kHigh, 2), kTilted}),
            (Answer{Side::kOn, "identity"}));
}

TEST(LightSideOfSupport, IsFiltered) {
  LightExample example(kSmall);
  const auto ground = example.vertex(kGround, 0);
  EXPECT_EQ(example.depth(kLow, example.corner(kGround, 0, ground)),
            (Answer{Side::kBack, "filter"}));  // z = 0 < 4
  const auto high = example.vertex(kHigh, 2);
  EXPECT_EQ(example.depth(kLow, example.corner(kHigh, 2, high)),
            (Answer{Side::kFront, "filter"}));  // z = 6
}

TEST(LightSideOfSupport, IsExactForInputVertices) {
  // (9, 3, 4) is on the plane of `low`: degree 3, 3 b + 2 bits. The answer is remembered.
  for (const auto& [exponent, bits] : {std::pair{kSmall, "64"}, std::pair{kLarge, "128"},
                                       std::pair{kBeyond64, "256"}, std::pair{kHuge, "GMP"}}) {
    LightExample example(exponent);
    const auto touching = example.vertex(kTouching, 1);
    const auto corner = example.corner(kTouching, 1, touching);
    EXPECT_EQ(example.depth(kLow, corner), (Answer{Side::kOn, bits}));
    EXPECT_EQ(example.depth(kLow, corner), (Answer{Side::kOn, "identity"}));
  }
}

TEST(LightSideOfSupport, IsExactForCrossings) {
  // The ray through (1, 1, 4) meets the plane of `tilted` there: degree 9, 9 b + 5 bits. Before, it
  // is asked of each edge whether it is one of `tilted`: degree 3.
  for (const auto& [exponent, stages] :
       {std::pair{kSmall, "3x 64"}, std::pair{kLarge, "2x 128, 256"},
        std::pair{kBeyond64, "2x 256, GMP"}}) {
    LightExample example(exponent);
    const auto made = unknown_vertex();
    const Corner<LightExample::Vertex> corner{example.edge(kLow, 0), made, example.edge(kHigh, 2),
                                              kTilted};
    EXPECT_EQ(example.depth(kLow, corner), (Answer{Side::kOn, stages}));
  }
}

TEST(LightSideOfSupport, FollowsTheEndsOfAnEdge) {
  LightExample example(kSmall);
  // Both ends of the first edge of `high`, z = 6, are in front of z = 4, and so is all between
  // them: that the edge is its own is known (twice), two integers of degree 3 answer, and two more
  // tell that the vertex is between its ends.
  const auto made = unknown_vertex();
  EXPECT_EQ(example.depth(kLow, {example.edge(kHigh, 0), made, example.edge(kGround, 0), kHigh}),
            (Answer{Side::kFront, "2x identity, 4x 64"}));
}

}  // namespace
}  // namespace gnomon::test
