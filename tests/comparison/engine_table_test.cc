// SPDX-License-Identifier: GPL-3.0-or-later
// Tables that engines wrote: how they are read, whose surfaces their columns are, and how many
// digits a value is held to.
#include "comparison/engine_tables/engine_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numeric>
#include <string>

#include "comparison/engine_tables/table_columns.h"
#include "comparison/engine_tables/table_judge.h"
#include "comparison/engine_tables/true_share.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/read.h"
#include "tests/support/test_directory.h"

namespace gnomon::comparison {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class EngineTableTest : public testing::Test {
 protected:
  Expected<EngineTable> read(const std::string& text, int year = 2025) {
    std::ofstream(file_, std::ios::binary) << text;
    TableReading reading;
    reading.year = std::chrono::year(year);
    reading.choose = [](const EngineTable& head) -> Expected<std::vector<std::uint32_t>> {
      std::vector<std::uint32_t> all(head.names.size());
      std::iota(all.begin(), all.end(), 0u);
      return all;
    };
    return read_engine_table(file_, reading);
  }
  /// "LINE:COLUMN: what; expected ..." of a table that cannot be read.
  std::string error_of(const std::string& text) {
    const auto table = read(text);
    if (table) return "no error";
    const std::string all = to_string(table.error());
    EXPECT_TRUE(all.starts_with(file_ + ":")) << all;
    return all.substr(std::min(all.size(), file_.size() + 1));
  }

  test::TestDirectory directory_;
  const std::string file_ = directory_.file("table.csv");
};

TEST_F(EngineTableTest, IsReadWithWhateverProgramsPutAroundIt) {
  const auto table = read(
      "\xEF\xBB\xBFSurface Name, \"Wall, south\" ,\"5\"\" pipe\",Roof,\r\n"
      " 01/01 01:00, 0.5,1.00 ,0,\r\n\r\n01/01  24:00:00,nan,-INF,1e-05,\r\n\r\n \r\n");
  ASSERT_TRUE(table) << to_string(table.error());
  EXPECT_EQ(table->form, TableForm::kEnergyPlus);
  EXPECT_THAT(table->names, ElementsAre("Wall, south", "5\" pipe", "Roof"));
  ASSERT_EQ(table->rows.size(), 2u);
  EXPECT_EQ(suns::end_of_step_text(table->rows[0].time), "01/01 01:00");
  EXPECT_EQ(suns::end_of_step_text(table->rows[1].time), "01/01 24:00");
  EXPECT_EQ(table->step, std::chrono::hours(23));
  EXPECT_EQ(table->value(0, 0).value, 0.5);
  EXPECT_EQ(table->value(0, 1).decimals, 2);
  EXPECT_EQ(table->value(0, 1).digits, 3);
  EXPECT_TRUE(std::isnan(table->value(1, 0).value));
  EXPECT_TRUE(std::isinf(table->value(1, 1).value));
  EXPECT_EQ(table->value(1, 2).value, 1e-5);
  EXPECT_EQ(table->value(1, 2).decimals, 5);
}

TEST_F(EngineTableTest, OfGnomonYearHasItsSuns) {
  const auto table = read(
      "time,sun_x,sun_y,sun_z,a,a#back\n"
      "2026-03-20T06:30:00+05:30,0.100000,-0.200000,0.974679,0.3333333333333333,0\n"
      "2026-03-20T07:00:00+05:30,1,0,-0.000001,0,0\n");
  ASSERT_TRUE(table) << to_string(table.error());
  EXPECT_EQ(table->form, TableForm::kSuns);
  EXPECT_THAT(table->names, ElementsAre("a", "a#back"));
  EXPECT_EQ(table->zone, suns::Minutes(330));
  EXPECT_EQ(table->step, suns::Minutes(30));
  EXPECT_THAT(table->rows[0].direction, ElementsAre(100000, -200000, 974679));
  EXPECT_THAT(table->rows[1].direction, ElementsAre(1000000, 0, -1));
  EXPECT_EQ(table->value(0, 0).digits, 16);
}

TEST_F(EngineTableTest, OfOneRowHasTheLongestStepThatEndsThere) {
  EXPECT_EQ(read("Surface Name,a\n01/01 24:00,0\n")->step, std::chrono::hours(1));
  EXPECT_EQ(read("Surface Name,a\n01/01 10:45,0\n")->step, suns::Minutes(15));
}

TEST_F(EngineTableTest, ErrorsNameThePlaceAndWhatWasExpected) {
  const std::string head = "Surface Name,wall,roof\n";
  EXPECT_THAT(error_of(""), HasSubstr("empty"));
  EXPECT_THAT(error_of("\n \n"), HasSubstr("an empty table"));
  EXPECT_THAT(error_of("light,a\nsun,0\n"),
              HasSubstr("1:1: 'light' begins no table that is known; expected 'Surface Name"));
  EXPECT_THAT(error_of("Surface Name\n"), HasSubstr("1:13: a table without surfaces"));
  EXPECT_THAT(error_of("Surface Name,a,,b\n"), HasSubstr("1:16: a column without a name"));
  EXPECT_THAT(error_of("Surface Name,a,b,a\n"), HasSubstr("1:18: 'a' stands twice"));
  EXPECT_THAT(error_of(head), HasSubstr("a table without rows"));
  EXPECT_THAT(error_of(head + "01/01 01:00,0\n"),
              HasSubstr("2:14: 2 fields in a row; expected 3, as in the first line"));
  EXPECT_THAT(error_of(head + "01/01 01:00,0,1,1\n"), HasSubstr("2:17: 4 fields in a row"));
  EXPECT_THAT(error_of(head + "01/01 01:00,0,1\n01/01 02:00,0,\n"),
              HasSubstr("3:15: an empty field; expected the lit share of 'roof'"));
  EXPECT_THAT(error_of(head + "01/01 01:00,0,0.5x\n"), HasSubstr("2:15: '0.5x' is no number"));
  EXPECT_THAT(error_of(head + "01/01 01:00,0,1e999\n"), HasSubstr("is no number"));
  for (const char* time : {"noon", "01/01", "01/01 25:00", "01/01 24:01", "01/01 01:60",
                           "01/01 01:00:30", "01-01 01:00", "01/01 01:00 x"}) {
    EXPECT_THAT(error_of(head + time + ",0,1\n"),
                HasSubstr("2:1: '" + std::string(time) + "' is no time; expected MM/DD HH:MM"));
  }
  EXPECT_THAT(error_of(head + "02/30 01:00,0,1\n"), HasSubstr("is no day of the year 2025"));
  EXPECT_THAT(error_of(head + "02/29 01:00,0,1\n"), HasSubstr("expected --year of a leap year"));
  EXPECT_TRUE(read(head + "02/29 01:00,0,1\n", 2024));
  for (const char* second : {"01/01 02:00", "01/01 01:00"}) {
    EXPECT_THAT(error_of(head + "01/01 02:00,0,1\n" + second + ",0,1\n"),
                HasSubstr("3:1: '" + std::string(second) + "' is not after the row before"));
  }
  EXPECT_THAT(error_of(head + "01/01 01:00,\"0,1\n"),
              HasSubstr("2:13: a quote that is not closed"));
  EXPECT_THAT(error_of(head + "01/01 01:00,\"0\"1,1\n"), HasSubstr("2:16: text after a closing"));
  EXPECT_THAT(error_of("Surface Name,5\" pipe\"\n"), HasSubstr("1:15: a quote within a field"));
  const std::string suns = "time,sun_x,sun_y,sun_z,a\n", time = "2026-01-01T01:00:00+00:00,";
  EXPECT_THAT(error_of(suns + "01/01 01:00,0,0,1,0\n"), HasSubstr("2:1: '01/01 01:00' is no time"));
  EXPECT_THAT(error_of(suns + "2026-01-01T01:00:00,0,0,1,0\n"), HasSubstr("has no zone"));
  EXPECT_THAT(error_of(suns + time + "0,0,0.1234567,0\n"),
              HasSubstr("'0.1234567' is no component of a direction"));
  EXPECT_THAT(error_of(suns + time + "0,0,0,0\n"), HasSubstr("a sun without a direction"));
  EXPECT_THAT(error_of(suns + time + "0,0,1,0\n2026-01-01T02:00:00+01:00,0,0,1,0\n"),
              HasSubstr("3:1: '2026-01-01T02:00:00+01:00' is of another time zone"));
}

TEST_F(EngineTableTest, IsKnownByItsBeginning) {
  const auto is_table = [&](const std::string& name, const std::string& text) {
    const std::string file = directory_.file(name);
    std::ofstream(file, std::ios::binary) << text;
    return is_engine_table(file);
  };
  EXPECT_TRUE(is_table("a.txt", "\xEF\xBB\xBF\"Surface Name\",a\n"));
  EXPECT_TRUE(is_table("b.txt", "time,sun_x,sun_y,sun_z,a\n"));
  EXPECT_TRUE(is_table("c.csv", "light,a\n"));
  EXPECT_FALSE(is_table("d.json", "{\"lights\": []}"));
  EXPECT_FALSE(is_engine_table(directory_.file("absent.json")));
}

TEST(WrittenNumberTest, KeepsItsValueAndItsDigits) {
  WrittenNumbers numbers;
  const std::vector<std::string> texts = {"0",          "1",
                                          "1.00000000", "0.47",
                                          ".5",         "5.",
                                          "0.12345678", "0.123456789012345",
                                          "-0.25",      "+0.5",
                                          "2.5E-3",     "134217727",
                                          "134217728",  "0.000000000000001"};
  for (const std::string& text : texts) {
    const auto number = parse_written(text);
    ASSERT_TRUE(number) << text;
    numbers.add(*number);
    EXPECT_EQ(number->value, std::stod(text)) << text;
  }
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const auto number = parse_written(texts[i]);
    EXPECT_EQ(numbers[i].value, number->value) << texts[i];
    EXPECT_EQ(numbers[i].decimals, number->decimals) << texts[i];
    EXPECT_EQ(numbers[i].digits, number->digits) << texts[i];
  }
  EXPECT_EQ(text_of(*parse_written("0.50")), "0.50");
  EXPECT_EQ(parse_written("2.5E-3")->decimals, 4);
  for (const char* text : {"", "-", ".", "1.2.3", "0x1", "1e", "1 2", "nanny", "1e99999"}) {
    EXPECT_FALSE(parse_written(text)) << text;
  }
}

TEST(WrittenNumberTest, ZerosAtTheEndMayHaveBeenLeftOut) {
  const auto rounding = [](const std::vector<std::string>& others, const std::string& text) {
    WrittenNumbers numbers;
    for (const std::string& other : others) numbers.add(*parse_written(other));
    numbers.add(*parse_written(text));
    return numbers.digits().rounding_of(*parse_written(text));
  };
  EXPECT_DOUBLE_EQ(rounding({}, "0.47"), 0.005);
  EXPECT_DOUBLE_EQ(rounding({"0.47"}, "0.5"), 0.005);
  EXPECT_DOUBLE_EQ(rounding({"0.47"}, "0"), 0.005);
  EXPECT_DOUBLE_EQ(rounding({"1.00"}, "0.47"), 0.005);
  // Four digits: 0.012340 has six decimals, 0.1234 four.
  EXPECT_DOUBLE_EQ(rounding({"0.01234"}, "0.1234"), 0.00005);
  EXPECT_DOUBLE_EQ(rounding({"0.01234"}, "0.123"), 0.00005);
  EXPECT_DOUBLE_EQ(rounding({"0.12345678", "1.0E-012"}, "0.5"), 0.5e-8);
}

TEST(TableColumnsTest, AreMatchedByName) {
  Scene scene;
  for (const char* id : {"Wall", "roof", "ROOF", "Shade", "a%23b", "Extra"}) {
    scene.polygons.emplace_back().id = id;
  }
  scene.polygons[3].two_sided = true;
  scene.polygons[0].holes = scene.polygons[1].holes = {{0, 1, 2}};
  const std::vector<std::string> names = {"WALL",  "Roof",      "ROOF",       "shade",    "a#b",
                                          "Attic", "Mir-Shade", "wall#gross", "Wall#back"};
  const TableColumns columns = match_columns(names, scene);
  std::vector<std::string> matched, untold;
  for (const TableColumn& column : columns.matched) {
    matched.push_back(names[column.column] + "=" + side_name(scene, column));
  }
  for (const TableSide& side : columns.untold) untold.push_back(side_name(scene, side));
  EXPECT_THAT(matched, ElementsAre("WALL=Wall", "Roof=roof", "ROOF=ROOF", "shade=Shade",
                                   "a#b=a%23b", "Mir-Shade=Shade#back", "wall#gross=Wall#gross"));
  EXPECT_THAT(columns.unknown, ElementsAre(5u, 8u));
  EXPECT_THAT(untold, ElementsAre("Extra"));
  // Two columns that differ by case alone, and one side.
  EXPECT_THAT(match_columns({"wall", "WALL"}, scene).matched, IsEmpty());
}

TEST_F(EngineTableTest, IsJudgedByDigitsNightAndRange) {
  const auto table = read(
      "Surface Name,a,b\n01/01 10:00,0.33,0.50\n01/01 11:00,0.34,nan\n"
      "01/01 12:00,1.01,0.00\n01/01 13:00,0.10,0.01\n");
  ASSERT_TRUE(table);
  TableJudge judge(*table, {1, TableJudge::kNoShare}, std::nullopt);
  const std::vector<double> third{9, 1.0 / 3}, all{9, 1}, none{9, 0};
  judge.add(0, third, true);
  judge.add(1, third, true);
  judge.add(2, all, true);
  judge.add(3, none, false);
  EXPECT_EQ(judge.values(), 4u);
  EXPECT_EQ(judge.wrong().value, 1u);
  EXPECT_EQ(judge.wrong().range, 1u);
  EXPECT_EQ(judge.wrong().night, 1u);
  ASSERT_EQ(judge.worst().size(), 3u);
  EXPECT_EQ(judge.worst()[0].row, 3u);
  EXPECT_EQ(judge.worst()[1].kind, WrongKind::kRange);
  EXPECT_NEAR(judge.sums()[0].found, 1.78, 1e-12);
  EXPECT_NEAR(judge.sums()[0].truth, 5.0 / 3, 1e-12);
  TableJudge lenient(*table, {0, 0}, 0.1);
  lenient.add(1, {{1.0 / 3}}, true);
  EXPECT_EQ(lenient.wrong().value, 0u);
  EXPECT_EQ(lenient.wrong().range, 1u);  // no number
}

TEST_F(EngineTableTest, TheOracleTellsWhatShades) {
  const std::string file = directory_.file("scene.json");
  std::ofstream(file) << R"({ "format": "gnomon-scene", "version": 1,
    "vertices": [[0,0,0],[4,0,0],[4,4,0],[0,4,0],[1,1,1],[3,1,1],[3,3,1],[1,3,1],
                 [3,1,2],[4,1,2],[4,3,2],[3,3,2]],
    "polygons": [{"id": "floor", "loop": [0,1,2,3]}, {"id": "small", "loop": [8,9,10,11]},
                 {"id": "large", "loop": [4,5,6,7]}],
    "lights": [{"id": "sun", "type": "directional", "to_light": [0,0,1]}] })";
  const auto read = read_scene(file);
  ASSERT_TRUE(read);
  const auto prepared = prepare(read->scene);
  ASSERT_TRUE(prepared);
  const oracle::ExactAnswer answer(read->scene, *prepared);
  const TrueShare floor = true_share(answer, 0, 0, Side::kFront);
  EXPECT_TRUE(floor.faces);
  EXPECT_EQ(floor.exact, mpq_class(5, 8));
  ASSERT_EQ(floor.casters.size(), 2u);
  EXPECT_EQ(floor.casters[0].polygon, "large");
  EXPECT_DOUBLE_EQ(floor.casters[0].share, 0.25);
  EXPECT_DOUBLE_EQ(floor.casters[1].share, 0.125);
  EXPECT_THAT(true_share(answer, 0, 1, Side::kFront).casters, IsEmpty());
  const TrueShare back = true_share(answer, 0, 0, Side::kBack);
  EXPECT_FALSE(back.faces);
  EXPECT_EQ(back.exact, mpq_class(0));
}

}  // namespace
}  // namespace gnomon::comparison
