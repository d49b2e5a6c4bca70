// SPDX-License-Identifier: GPL-3.0-or-later
// Files of samples: what is read whatever programs put around it, and what is wrong with the rest.
#include "comparison/samples/sample_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "gnomon/scene/prepare.h"
#include "gnomon/scene/read.h"
#include "tests/support/test_directory.h"

namespace gnomon::comparison {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kScene = R"({ "format": "gnomon-scene", "version": 1, "numbers": "decimal",
  "vertices": [[0,0,0],[4,0,0],[4,4,0],[0,4,0],[8,0,0]],
  "polygons": [{"id": "Floor", "loop": [0,1,2,3]}, {"id": "Wall, south", "loop": [0,1,2], "two_sided": true},
               {"id": "flat", "loop": [0,1,4]}],
  "lights": [{"id": "sun", "type": "directional", "to_light": [0,0,1]},
             {"id": "lamp", "type": "point", "position": [1,1,3]}] })";

class SampleFileTest : public testing::Test {
 protected:
  void SetUp() override {
    const std::string path = directory_.file("scene.json");
    std::ofstream(path) << kScene;
    auto scene = read_scene(path);
    ASSERT_TRUE(scene) << to_string(scene.error());
    scene_ = std::move(scene->scene);
    auto prepared = prepare(scene_);
    ASSERT_TRUE(prepared) << to_string(prepared.error());
    prepared_ = *std::move(prepared);
  }
  Expected<std::vector<SampleRow>> read(const std::string& text) {
    std::ofstream(file_, std::ios::binary) << text;
    auto file = SampleFile::open(file_, scene_, prepared_);
    if (!file) return tl::unexpected(file.error());
    std::vector<SampleRow> rows;
    for (;;) {
      SampleRow row;
      auto more = file->next(row);
      if (!more) return tl::unexpected(more.error());
      if (!*more) return rows;
      rows.push_back(std::move(row));
    }
  }
  /// "LINE:COLUMN: what; expected ..." of a file that cannot be read.
  std::string error_of(const std::string& text) {
    const auto rows = read(text);
    if (rows) return "no error";
    const std::string all = to_string(rows.error());
    EXPECT_TRUE(all.starts_with(file_ + ":")) << all;
    return all.substr(std::min(all.size(), file_.size() + 1));
  }

  test::TestDirectory directory_;
  const std::string file_ = directory_.file("samples.csv");
  Scene scene_;
  PreparedScene prepared_;
};

TEST_F(SampleFileTest, IsReadWithWhateverProgramsPutAroundIt) {
  const auto rows = read(
      "\xEF\xBB\xBF# made by \"someone's program\r\n\r\nLight, x,y,z , normal,Visible,polygon,\r\n"
      "sun,0.1,1e-1,-2.50,up,1,\"Wall, south#back\"\r\n   # a \"comment\n\n"
      " \"lamp\" ,.5,+3,0,,0.25,,,\r\nlamp,0,0,0,,nan,Floor#front");
  ASSERT_TRUE(rows) << to_string(rows.error());
  ASSERT_EQ(rows->size(), 3u);
  const SampleRow& first = (*rows)[0];
  EXPECT_EQ(first.line, 4u);
  EXPECT_EQ(first.sample.light, 0u);
  // Decimals, since the scene's numbers are.
  EXPECT_THAT(first.sample.point,
              ElementsAre(mpq_class(1, 10), mpq_class(1, 10), mpq_class(-5, 2)));
  EXPECT_EQ(first.sample.visible, mpq_class(1));
  EXPECT_EQ(first.sample.polygon, 1u);
  EXPECT_EQ(first.sample.side, Side::kBack);
  const SampleRow& second = (*rows)[1];
  EXPECT_EQ(second.line, 7u);
  EXPECT_EQ(second.sample.light, 1u);
  EXPECT_EQ(second.sample.visible, mpq_class(1, 4));
  EXPECT_EQ(second.visible.decimals, 2);
  EXPECT_FALSE(second.sample.polygon);
  EXPECT_FALSE((*rows)[2].sample.visible);
  EXPECT_EQ((*rows)[2].sample.side, Side::kFront);
}

TEST_F(SampleFileTest, ColumnsStandInAnyOrderAndOthersArePassedOver) {
  std::ofstream(file_) << "visible,weight,z,y,x,light\n0,7,3,2,1,sun\n";
  auto file = SampleFile::open(file_, scene_, prepared_);
  ASSERT_TRUE(file) << to_string(file.error());
  EXPECT_THAT(file->passed_over(), ElementsAre("weight"));
  for (int time = 0; time < 2; ++time) {
    SampleRow row;
    const auto more = file->next(row);
    ASSERT_TRUE(more && *more);
    EXPECT_THAT(row.sample.point, ElementsAre(1, 2, 3));
    EXPECT_TRUE(file->next(row) && !*file->next(row));
    ASSERT_TRUE(file->rewind());
  }
}

TEST_F(SampleFileTest, ErrorsNamePlaceAndWhatWasExpected) {
  const std::string head = "light,x,y,z,visible,polygon\n";
  EXPECT_THAT(error_of(""), HasSubstr("an empty file; expected a first line light,x,y,z,visible"));
  EXPECT_THAT(error_of(" \r\n# nothing\n"), HasSubstr("an empty file"));
  EXPECT_THAT(error_of("light,x,y,visible\n"),
              testing::StartsWith("1:18: no column 'z' in the first line; expected light,x,y,z"));
  EXPECT_THAT(error_of("light,x,y,z,X,visible\n"), testing::StartsWith("1:13: 'X' stands twice"));
  EXPECT_THAT(error_of(head + "moon,0,0,0,1,Floor\n"),
              testing::StartsWith("2:1: 'moon' is no light of the scene; expected the id of one, "
                                  "such as 'sun', 'lamp'"));
  EXPECT_THAT(
      error_of(head + "sun,0,0,0,1,Flor\n"),
      testing::StartsWith("2:13: 'Flor' is no polygon of the scene; expected the id of one, "
                          "such as 'Floor', 'Wall, south'"));
  EXPECT_THAT(
      error_of(head + "sun,0,0,0,1,Floor#back\n"),
      testing::StartsWith("2:13: 'Floor#back': the polygon has one side; expected 'Floor'"));
  EXPECT_THAT(error_of(head + "sun,0,0,0,1,Floor#up\n"), HasSubstr("'Floor#up' is no polygon"));
  EXPECT_THAT(error_of(head + "sun,0,0,0,1,flat\n"), HasSubstr("'flat' has no area"));
  EXPECT_THAT(error_of(head + "sun,0,zero,0,1,Floor\n"), testing::StartsWith("2:7: 'zero' "));
  EXPECT_THAT(error_of(head + "sun,0,nan,0,1,Floor\n"), testing::StartsWith("2:7: 'nan' "));
  EXPECT_THAT(error_of(head + "sun,0,,0,1,Floor\n"), testing::StartsWith("2:7: an empty field"));
  EXPECT_THAT(error_of(head + "sun,0,0,0,yes,Floor\n"),
              testing::StartsWith("2:11: 'yes' is no number; expected 0, 1, or the share"));
  EXPECT_THAT(error_of(head + "sun,0,0,0,,Floor\n"), testing::StartsWith("2:11: an empty field"));
  EXPECT_THAT(error_of(head + "\n\nsun,0,0,0\n"),
              testing::StartsWith("4:10: 4 fields in a row; expected 6, as in the first line"));
  EXPECT_THAT(error_of(head + "sun,0,0,0,1,Floor,7\n"), testing::StartsWith("2:19: 7 fields"));
  EXPECT_THAT(error_of(head + "sun,0,0,0,1,\"Floor\n"), HasSubstr("quote"));
  EXPECT_THAT(error_of(std::string("light\0x", 7)), HasSubstr("NUL"));
}

TEST_F(SampleFileTest, IsKnownByItsFirstLine) {
  const auto is_known = [&](const std::string& text) {
    std::ofstream(file_, std::ios::binary) << text;
    return is_sample_file(file_);
  };
  EXPECT_TRUE(is_known("# c\nlight,x,y,z,visible\n"));
  EXPECT_TRUE(is_known("\"Light\", x, y, visible\n"));  // and z is missed with its place
  EXPECT_FALSE(is_known("Surface Name,Floor\n"));
  EXPECT_FALSE(is_known("light,Floor\n"));
  EXPECT_FALSE(is_known("{\"lights\": []}"));
  EXPECT_FALSE(is_known(""));
  EXPECT_FALSE(is_sample_file("-"));
  EXPECT_FALSE(is_sample_file(directory_.file("absent.csv")));
}

}  // namespace
}  // namespace gnomon::comparison
