// SPDX-License-Identifier: GPL-3.0-or-later
// Repairs are exact: what was all but in one plane is exactly in one plane, and nothing else moved.
#include <gmock/gmock.h>

#include "builder.h"
#include "gnomon/scene/intent.h"
#include "gnomon/scene/repair.h"

namespace gnomon::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

using Loop = std::vector<Triple>;

Loop square(double x, double y, double size, double height) {
  return {
      {x, y, height}, {x + size, y, height}, {x + size, y + size, height}, {x, y + size, height}};
}

SnapReport snapped(Scene& scene, const mpq_class& distance) {
  const auto report = snap_scene(scene, distance);
  EXPECT_TRUE(report) << to_string(report.error());
  return report ? *report : SnapReport();
}

/// How many planes there are.
std::size_t planes(const Scene& scene) {
  const auto prepared = prepare(scene);
  EXPECT_TRUE(prepared) << to_string(prepared.error());
  return prepared ? prepared->geometry.planes.size() : 0;
}

TEST(Snap, AWindowGoesToItsWall) {
  Builder b;
  b.polygon(square(0, 0, 10, 0)).polygon(square(2, 2, 3, -0x1p-20));
  const SnapReport report = snapped(b.scene(), mpq_class(1, 1000));
  EXPECT_EQ(planes(b.scene()), 1u);
  EXPECT_EQ(report.planes, 1u);
  EXPECT_EQ(report.largest_movement, 0x1p-20);
  EXPECT_FALSE(report.became_decimal);
  EXPECT_EQ(report.moved_vertices, 4u);
  EXPECT_EQ(b.scene().vertices[0][2], Number(0.0));
  EXPECT_EQ(snapped(b.scene(), mpq_class(1, 1000)).moved_vertices, 0u);
}

TEST(Snap, IntoATiltedWallOfOddNumbers) {
  Builder b;
  b.polygon({{0.1, 0.3, 0}, {7.7, 3.1, 0}, {7.7, 3.1, 8.5}, {0.1, 0.3, 8.5}});
  // At thirds of it, as near as doubles come.
  const auto at = [](double s, double z) { return Triple{0.1 + s * 7.6, 0.3 + s * 2.8, z}; };
  b.polygon({at(1 / 3.0, 2), at(2 / 3.0, 2), at(2 / 3.0, 5), at(1 / 3.0, 5)});
  ASSERT_EQ(planes(b.scene()), 2u);
  const Scene before = b.scene();
  const SnapReport report = snapped(b.scene(), mpq_class(1, 1000000));
  EXPECT_EQ(planes(b.scene()), 1u);
  EXPECT_LT(report.largest_movement, 1e-11);
  EXPECT_EQ(report.pairs_left, 0u);
  for (std::size_t v = 0; v < 4; ++v) EXPECT_EQ(b.scene().vertices[v], before.vertices[v]);
}

TEST(Snap, BentPolygonsBecomePlanar) {
  Builder b;
  b.polygon({{-8, -4, 3}, {0, -4, 3}, {0, 9, 3.0000000000000009}, {-8, 9, 3}});
  ASSERT_EQ(planes(b.scene()), 2u);
  EXPECT_EQ(snapped(b.scene(), mpq_class(1, 1000000)).bent_left, 0u);
  EXPECT_EQ(planes(b.scene()), 1u);
}

TEST(Snap, VerticesBecomeOne) {
  Builder b;
  b.polygon(square(0, 0, 1, 0)).polygon(square(1 + 0x1p-30, 0, 1, 0));
  const SnapReport report = snapped(b.scene(), mpq_class(1, 1000000));
  EXPECT_EQ(report.merged_vertices, 2u);
  const auto prepared = prepare(b.scene());
  EXPECT_EQ(prepared->geometry.positions.size(), 6u);
  EXPECT_EQ(report.largest_movement, 0x1p-30);
}

TEST(Snap, KeepsThePlanesOfNeighbours) {
  // A window a hair before its wall, with a reveal at its side that is at a right angle to both.
  Builder b;
  const double hair = 0x1p-24;
  b.polygon(square(0, 0, 10, 0));
  b.polygon(square(2, 2, 3, hair));
  b.polygon({{2, 2, hair}, {2, 5, hair}, {2, 5, 1}, {2, 2, 1}});
  snapped(b.scene(), mpq_class(1, 1000));
  EXPECT_EQ(planes(b.scene()), 2u);
  EXPECT_EQ(b.scene().vertices[8][0], Number(2.0));
}

TEST(Snap, ComesToAnEnd) {
  // Triangles between two planes, each near both and free to turn.
  Builder b;
  b.polygon(square(0, 0, 10, 0)).polygon(square(0, 0, 9, 0x1p-10));
  b.polygon({{1, 1, 0x1p-11}, {4, 1, 0x1p-11}, {1, 4, 0x1p-11}});
  b.polygon({{4, 1, 0x1p-11}, {4, 4, 0x1p-12}, {1, 4, 0x1p-11}});
  const SnapReport report = snapped(b.scene(), mpq_class(1, 1000));
  EXPECT_TRUE(report.settled);
  EXPECT_LT(report.rounds, 5u);
  EXPECT_EQ(planes(b.scene()), 1u);
}

TEST(Snap, NothingFolds) {
  // A strip narrower than the distance stays as it is.
  Builder b;
  b.polygon(square(0, 0, 10, 0));
  b.polygon({{0, 0, 5}, {10, 0, 5}, {10, 0.0005, 5}, {0, 0.0005, 5}});
  const Scene before = b.scene();
  const SnapReport report = snapped(b.scene(), mpq_class(1, 1000));
  EXPECT_THAT(report.folding, ElementsAre("1"));
  EXPECT_EQ(b.scene().vertices, before.vertices);
}

TEST(Parents, WindowsBecomeHoles) {
  Builder b;
  b.polygon(square(0, 0, 10, 0)).polygon(square(2, 2, 3, 0)).polygon(square(3, 3, 1, 0));
  b.polygon(square(8, 8, 4, 0));                            // reaches out
  b.polygon({{6, 1, 0}, {6, 2, 0}, {7, 2, 0}, {7, 1, 0}});  // looks the other way
  b.polygon(square(4, 4, 2, 0));                            // overlaps a window
  const auto report = make_holes_of_windows(b.scene());
  ASSERT_TRUE(report);
  EXPECT_THAT(report->windows, ElementsAre("2", "5"));
  EXPECT_THAT(report->walls, ElementsAre("1", "0"));
  EXPECT_THAT(report->left, ElementsAre("1"));
  EXPECT_THAT(b.scene().polygons[0].holes, SizeIs(1));
  EXPECT_TRUE(prepare(b.scene()));
}

TEST(Orient, ClosedComponents) {
  Builder b;
  b.polygon({{0, 0, 0}, {0, 4, 0}, {4, 0, 0}});
  Scene& scene = b.scene();
  scene.vertices.push_back(position({0, 0, 4}));
  for (const std::vector<VertexId>& loop : {std::vector<VertexId>{0, 2, 3}, {0, 3, 1}, {2, 1, 3}}) {
    Polygon face;
    face.id = std::to_string(scene.polygons.size());
    face.loop = loop;
    scene.polygons.push_back(face);
  }
  const Scene outwards = scene;
  std::swap(scene.polygons[2].loop[1], scene.polygons[2].loop[2]);  // one face only
  auto report = orient_closed(scene);
  ASSERT_TRUE(report);
  EXPECT_THAT(report->reversed, ElementsAre("2"));
  EXPECT_EQ(report->left, 0u);
  for (std::size_t p = 0; p < 4; ++p) EXPECT_EQ(scene.polygons[p].loop, outwards.polygons[p].loop);
  b.point_light({0.5, 0.5, 0.5});
  report = orient_closed(scene);
  EXPECT_THAT(report->reversed, SizeIs(4));
  EXPECT_EQ(report->inwards, 1u);
  EXPECT_THAT(orient_closed(scene)->reversed, IsEmpty());
}

TEST(NoteChange, KeepsWhatIsThere) {
  Scene scene;
  note_change(scene, R"({"by": 1})");
  EXPECT_EQ(scene.extra, R"({"changes": [{"by": 1}]})");
  note_change(scene, R"({"by": 2})");
  EXPECT_EQ(scene.extra, R"({"changes": [{"by": 1}, {"by": 2}]})");
  scene.extra = R"({"a": 1})";
  note_change(scene, R"({"by": 1})");
  EXPECT_EQ(scene.extra, R"({"a": 1, "changes": [{"by": 1}]})");
  scene.extra = "{ }";
  note_change(scene, R"({"by": 1})");
  EXPECT_EQ(scene.extra, R"({ "changes": [{"by": 1}]})");
  scene.extra = "7";
  note_change(scene, R"({"by": 1})");
  EXPECT_EQ(scene.extra, R"({"before": 7, "changes": [{"by": 1}]})");
}

}  // namespace
}  // namespace gnomon::test
