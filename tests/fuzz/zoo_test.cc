// SPDX-License-Identifier: GPL-3.0-or-later
// The bug zoo: on each scene of tests/regressions/zoo and area-zoo the sound subject passes and the
// mutant fails as the table says; every mistake has a row; and hunts find what they are for.
#include "fuzz/zoo/zoo.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "fuzz/check/subject.h"
#include "fuzz/shrink/shrink.h"
#include "gnomon/oracle/mesh_check.h"
#include "solve.h"

namespace gnomon::fuzz {
namespace {

using testing::HasSubstr;

class Zoo : public testing::TestWithParam<ZooEntry> {
 protected:
  Scene fixture() const {
    std::string name(GetParam().name);
    std::ranges::replace(name, '-', '_');
    try {
      return test::regression_scene("y_" + name);
    } catch (const std::runtime_error&) {
      return test::regression_scene("i_" + name);
    }
  }
};

TEST_P(Zoo, TheOracleCatchesTheMutantAlone) {
  const ZooEntry& entry = GetParam();
  const auto verdict = judge_mutant(entry, fixture());
  ASSERT_TRUE(verdict) << to_string(verdict.error());
  EXPECT_FALSE(verdict->sound_fails);
  EXPECT_TRUE(verdict->shows());
  EXPECT_EQ(verdict->disagreement, entry.disagreement) << verdict->text;
  EXPECT_NE(verdict->text, "");
  if (entry.mistake == Mistake::kTVerticesLeftIn) {
    EXPECT_TRUE(verdict->mutant.mesh);
    EXPECT_GT(verdict->jump, 0.1);
  } else if (method_info(parse_subject(entry.sound)->algorithm).domain == Domain::kImageSpace) {
    EXPECT_TRUE(verdict->mutant.samples);
  } else {
    EXPECT_TRUE(verdict->mutant.regions);
    EXPECT_TRUE(verdict->mutant.claims) << "the second way does not notice";
  }
}

TEST_P(Zoo, HasAPicture) {
  const auto picture = zoo_picture(GetParam(), fixture());
  ASSERT_TRUE(picture) << to_string(picture.error());
  EXPECT_THAT(*picture, HasSubstr(std::string(name_of(GetParam().mistake))));
}

TEST_P(Zoo, HuntsFindItAgain) {
  // Subjects that differ in the last bits alone need the oracle on every scene. A volume that dies
  // after it closed a tile, and is needed there, is rare.
  const bool slow = GetParam().generator == "soup-lattice";
  const bool rare = GetParam().mistake == Mistake::kClosedTileKeepsDead;
  const auto row = hunt(GetParam(), 1, rare ? 1500 : slow ? 600 : 200);
  ASSERT_TRUE(row) << to_string(row.error());
  EXPECT_TRUE(row->found) << row->scenes;
  EXPECT_TRUE(row->verdict.shows());
  EXPECT_EQ(judge_mutant(GetParam(), row->scene)->text, row->verdict.text);
}

INSTANTIATE_TEST_SUITE_P(Table, Zoo, testing::ValuesIn(zoo().begin(), zoo().end()),
                         [](const auto& info) {
                           std::string name(info.param.name);
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

TEST(ZooTable, HasEveryMistake) {
  std::set<Mistake> seen;
  for (const ZooEntry& entry : zoo()) {
    seen.insert(entry.mistake);
    EXPECT_TRUE(parse_subject(entry.sound)) << entry.name;
    EXPECT_EQ(zoo_entry(entry.name)->mistake, entry.mistake);
    if (entry.mistake == Mistake::kTVerticesLeftIn) continue;
    EXPECT_TRUE(parse_subject(entry.mutant())) << entry.mutant();
  }
  EXPECT_EQ(seen.size(), mistakes().size());
  EXPECT_EQ(zoo_entry("unicorn"), nullptr);
}

TEST(ZooTable, IsPrinted) {
  const auto tally = hunt_often(*zoo_entry("coplanar-in-sequence"), 3, 200);
  ASSERT_TRUE(tally);
  EXPECT_EQ(tally->found, 3u);
  EXPECT_EQ(tally->regions, 3u);
  EXPECT_LE(tally->median, tally->most);
  EXPECT_THAT(zoo_table({&*tally, 1}), HasSubstr("plane/svbsp~coplanar-in-sequence"));
}

TEST(ZooTable, NothingIsShownWhereNothingIsWrong) {
  // One polygon cannot be classified in a wrong order.
  const Scene scene = test::regression_scene("y_light_in_plane_faces");
  const auto verdict = judge_mutant(*zoo_entry("coplanar-in-sequence"), scene);
  ASSERT_TRUE(verdict);
  EXPECT_FALSE(verdict->shows());
  EXPECT_FALSE(zoo_picture(*zoo_entry("coplanar-in-sequence"), scene));
}

// --- The oracle on meshes, by hand ---

using oracle::MeshFaceClaim;

MeshFaceClaim face(std::vector<RationalPoint> loop, std::vector<double> shades) {
  MeshFaceClaim claim;
  claim.polygon = "a";
  claim.loop = std::move(loop);
  claim.shades = std::move(shades);
  return claim;
}

/// A square below, two above it that meet in the middle of its upper edge.
std::vector<MeshFaceClaim> three_faces(bool with_vertex) {
  std::vector<MeshFaceClaim> faces;
  if (with_vertex) {
    faces.push_back(face({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {0, 1, 0}}, {0, 0, 4, 3, 2}));
  } else {
    faces.push_back(face({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}}, {0, 0, 4, 2}));
  }
  faces.push_back(face({{0, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}}, {2, 3.5, 0, 0}));
  faces.push_back(face({{1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}}, {3.5, 4, 0, 0}));
  return faces;
}

TEST(MeshCheck, FindsTheTVertexAndItsJump) {
  const oracle::MeshReport report = oracle::check_mesh(three_faces(false));
  EXPECT_EQ(report.faces, 3u);
  EXPECT_EQ(report.edges, 12u);
  ASSERT_EQ(report.t_vertices, 1u);
  EXPECT_EQ(report.worst[0].face, 0u);
  EXPECT_EQ(report.worst[0].edge, 2u);
  EXPECT_EQ(report.worst[0].point, (RationalPoint{1, 1, 0}));
  EXPECT_DOUBLE_EQ(report.largest_jump, 0.5);  // 3.5 against the middle of 4 and 2
}

TEST(MeshCheck, ACornerBetweenCollinearEdgesIsEnough) {
  EXPECT_EQ(oracle::check_mesh(three_faces(true)).t_vertices, 0u);
}

TEST(MeshCheck, DarkFacesAndOtherPolygonsDoNotJump) {
  std::vector<MeshFaceClaim> faces = three_faces(false);
  faces[0].dark = true;
  EXPECT_EQ(oracle::check_mesh(faces).t_vertices, 1u);
  EXPECT_EQ(oracle::check_mesh(faces).largest_jump, 0);
  faces[0].dark = false;
  faces[0].polygon = "b";
  EXPECT_EQ(oracle::check_mesh(faces).t_vertices, 1u);
  EXPECT_EQ(oracle::check_mesh(faces).largest_jump, 0);
}

TEST(MeshCheck, AVertexTouchingAnEdgeAcrossItsLineIsNone) {
  std::vector<MeshFaceClaim> faces;
  faces.push_back(face({{0, 0, 0}, {2, 0, 0}, {2, -1, 0}}, {}));
  faces.push_back(face({{1, 0, 0}, {2, 2, 0}, {0, 2, 0}}, {}));
  EXPECT_EQ(oracle::check_mesh(faces).t_vertices, 0u);
}

}  // namespace
}  // namespace gnomon::fuzz
