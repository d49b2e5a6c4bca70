// SPDX-License-Identifier: GPL-3.0-or-later
// Tables of shares by surface and time, as engines write them, judged by gnomon certify.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "run_gnomon.h"

namespace gnomon::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// A floor under a shade with two sides, and a wall that faces south.
constexpr const char* kYard = R"({ "format": "gnomon-scene", "version": 1, "name": "yard",
  "numbers": "decimal",
  "vertices": [[0,0,0],[4,0,0],[4,4,0],[0,4,0],[1,1,1],[3,1,1],[3,3,1],[1,3,1],[0,4,3],[4,4,3]],
  "polygons": [{"id": "Floor", "loop": [0,1,2,3]}, {"id": "Wall", "loop": [3,2,9,8]},
               {"id": "Shade", "loop": [4,5,6,7], "two_sided": true}] })";

using Table = std::vector<std::vector<std::string>>;

Table read_table(const std::string& file) {
  Table table;
  std::istringstream lines(read_text(file));
  for (std::string line; std::getline(lines, line);) {
    auto& row = table.emplace_back();
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) row.push_back(field);
  }
  return table;
}

class EngineTables : public testing::Test {
 protected:
  void SetUp() override {
    write_text(scene_, kYard);
    std::vector<std::string> command = {"year", scene_,  "--from",          "06-21",
                                        "--to", "06-22", "--eplus-shading", shading_,
                                        "-o",   own_};
    command.insert(command.end(), place_.begin(), place_.end());
    ASSERT_EQ(run_gnomon(command).status, 0);
  }

  RunResult certify(const std::string& file, const std::vector<std::string>& options) const {
    std::vector<std::string> command = {"certify", scene_, "--candidate", file};
    command.insert(command.end(), options.begin(), options.end());
    return run_gnomon(command);
  }
  RunResult certify(const Table& table, std::vector<std::string> options = {}) const {
    const std::string file = directory_.file("changed.csv");
    std::string text;
    for (const auto& row : table) {
      for (std::size_t i = 0; i < row.size(); ++i) text += (i == 0 ? "" : ",") + row[i];
      text += '\n';
    }
    write_text(file, text);
    options.insert(options.begin(), place_.begin(), place_.end());
    return certify(file, options);
  }

  TestDirectory directory_;
  const std::string scene_ = directory_.file("yard.json");
  const std::string shading_ = directory_.file("eplusshading.csv");
  const std::string own_ = directory_.file("own.csv");
  const std::vector<std::string> place_ = {"--at=40,-105", "--tz", "-7", "--sun-model",
                                           "energyplus"};
};

TEST_F(EngineTables, OfOurOwnAgree) {
  const RunResult shading = certify(shading_, place_);
  EXPECT_EQ(shading.status, 0) << shading.out << shading.err;
  EXPECT_THAT(shading.out,
              AllOf(HasSubstr("shares agree"), HasSubstr("48 rows of 60 minutes"),
                    HasSubstr("3 of 3 columns judged"), HasSubstr("at the middle of each step"),
                    HasSubstr("1 side of the scene that the table does not tell: Shade#back"),
                    HasSubstr("of up to 8 decimals")));
  const RunResult own = certify(own_, std::vector<std::string>{"--tolerance", "0"});
  EXPECT_EQ(own.status, 0) << own.out << own.err;
  EXPECT_THAT(own.out, AllOf(HasSubstr("shares agree"), HasSubstr("suns: those of the table"),
                             HasSubstr("4 of 4 columns judged"), Not(HasSubstr("does not tell"))));
  // Half hours end with their suns, unless that is said otherwise.
  const std::string halves = directory_.file("halves.csv");
  std::vector<std::string> command = {"year", scene_,     "--to", "01-01",           "--step",
                                      "30",   "--sun-at", "end",  "--eplus-shading", halves};
  command.insert(command.end(), place_.begin(), place_.end());
  ASSERT_EQ(run_gnomon(command).status, 0);
  EXPECT_EQ(certify(halves, place_).status, 0);
  std::vector<std::string> middle = place_;
  middle.insert(middle.end(), {"--sun-at", "middle"});
  EXPECT_EQ(certify(halves, middle).status, 1);
}

TEST_F(EngineTables, OneWrongDigitIsFoundAndNamed) {
  Table table = read_table(shading_);
  ASSERT_EQ(table[0][1], "Floor");
  std::string& value = table[10][1];  // nine to ten
  ASSERT_EQ(value.size(), 10u);
  value[5] = value[5] == '9' ? '0' : static_cast<char>(value[5] + 1);
  const RunResult run = certify(table, {"--json", directory_.file("verdict.json")});
  EXPECT_EQ(run.status, 1) << run.out << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("failed"), HasSubstr("worst: Floor, 06/21 10:00, sun ("),
                             HasSubstr("found " + value + ", true 0."),
                             HasSubstr("shaded by Shade (0."), HasSubstr("Floor differs most")));
  EXPECT_THAT(read_text(directory_.file("verdict.json")),
              AllOf(HasSubstr(R"("verdict": "failed")"), HasSubstr(R"("polygon": "Floor")"),
                    HasSubstr(R"("share_tolerance": "digits")"),
                    HasSubstr(R"({"all": 1, "value": 1, "night": 0, "range": 0})"),
                    HasSubstr(R"("time": "06/21 10:00")"),
                    HasSubstr(R"("sun_time": "2025-06-21T09:30:00-07:00")"),
                    HasSubstr(R"({"polygon": "Shade", "share": 0.)")));
  EXPECT_EQ(certify(table, {"--tolerance", "0.01"}).status, 0);
}

TEST_F(EngineTables, OfAnotherSunFailWithAHint) {
  const RunResult run = certify(shading_, {"--at=40,-105", "--tz", "-7"});
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.out, HasSubstr("hint: EnergyPlus has a sun of its own, --sun-model energyplus"));
  std::vector<std::string> averaged = place_;
  averaged.insert(averaged.end(), {"--average-days", "20"});
  const RunResult other = certify(shading_, averaged);
  EXPECT_EQ(other.status, 1);
  EXPECT_THAT(other.out, testing::Not(HasSubstr("hint:")));
}

TEST_F(EngineTables, AreHeldToTheDigitsTheyHave) {
  Table table = read_table(shading_);
  for (std::size_t row = 1; row < table.size(); ++row) {
    for (std::size_t i = 1; i < table[row].size(); ++i) {
      table[row][i] = std::to_string(std::stod(table[row][i])).substr(0, 8);
      std::ostringstream two;
      two.precision(2);
      two << std::fixed << std::stod(table[row][i]);
      table[row][i] = two.str();
    }
  }
  const RunResult run = certify(table);
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("of up to 2 decimals"));
  EXPECT_EQ(certify(table, {"--tolerance", "1e-6"}).status, 1);
}

TEST_F(EngineTables, NightsRangesAndNumbersThatAreNoneAreToldApart) {
  Table table = read_table(shading_);
  table[1][1] = "0.25000000";
  table[12][2] = "1.25000000";
  table[13][3] = "nan";
  table[19][2] = "0.12500000";  // the wall in the evening
  const RunResult run = certify(table, {"--json", directory_.file("verdict.json")});
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.out, AllOf(HasSubstr("Floor, 06/21 01:00, night: found 0.25000000, true 0; the "
                                       "sun is down"),
                             HasSubstr("worst: Shade, 06/21 13:00"),
                             HasSubstr("no share is outside 0 to 1")));
  EXPECT_THAT(read_text(directory_.file("verdict.json")),
              HasSubstr(R"("wrong": {"all": 4, "value": 1, "night": 1, "range": 2})"));
}

TEST_F(EngineTables, ColumnsAreMatchedByName) {
  Table table = read_table(shading_);
  table[0] = {"surface name", "FLOOR", "Attic", "Mir-Shade"};
  for (std::size_t row = 1; row < table.size(); ++row) table[row][3] = "0.00000000";
  const RunResult run = certify(table);
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  EXPECT_THAT(run.out,
              AllOf(HasSubstr("2 of 3 columns judged"),
                    HasSubstr("1 column of the table that name no surface of the scene: Attic"),
                    HasSubstr("2 sides of the scene that the table does not tell: Wall, Shade")));
  table[0] = {"Surface Name", "a", "b", "c"};
  const RunResult none = certify(table);
  EXPECT_EQ(none.status, 2);
  EXPECT_THAT(none.err, HasSubstr("none of its 3 columns, such as 'a', names a surface of the "
                                  "scene; expected names such as 'Floor'"));
}

TEST_F(EngineTables, MayTellWallsWithTheirWindows) {
  const std::string scene = directory_.file("wall.json"), file = directory_.file("gross.csv");
  write_text(scene, R"({ "format": "gnomon-scene", "version": 1, "numbers": "decimal",
    "vertices": [[0,4,0],[4,4,0],[4,4,3],[0,4,3],[1,4,1],[2,4,1],[2,4,2],[1,4,2],[0,3,0],[0,3,3]],
    "polygons": [{"id": "Wall", "loop": [0,1,2,3], "holes": [[4,7,6,5]]},
                 {"id": "Window", "loop": [4,5,6,7]},
                 {"id": "Fin", "loop": [0,8,9,3], "two_sided": true}] })");
  std::vector<std::string> command = {"year",  scene,     "--from", "12-21", "--to",
                                      "12-21", "--gross", "-o",     file};
  command.insert(command.end(), place_.begin(), place_.end());
  ASSERT_EQ(run_gnomon(command).status, 0);
  const RunResult run = run_gnomon({"certify", scene, "--candidate", file});
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("5 of 5 columns judged"));
  Table table = read_table(file);
  ASSERT_EQ(table[0].back(), "Wall#gross");
  table[10].back() = "0.123";
  std::string text;
  for (const auto& row : table) {
    for (const std::string& field : row) text += field + ',';
    text += '\n';
  }
  write_text(file, text);
  const RunResult wrong = run_gnomon({"certify", scene, "--candidate", file});
  EXPECT_EQ(wrong.status, 1) << wrong.out << wrong.err;
  EXPECT_THAT(wrong.out, HasSubstr("worst: Wall#gross, 2025-12-21T09:30:00-07:00, sun ("));
}

TEST_F(EngineTables, NeedSunsAndTakeNoOptionsOfResults) {
  const auto refused = [&](const std::string& file, const std::vector<std::string>& options,
                           const std::string& what) {
    const RunResult run = certify(file, options);
    EXPECT_EQ(run.status, 2) << run.out;
    EXPECT_THAT(run.err, HasSubstr(what));
  };
  refused(shading_, {}, "no place is known");
  refused(shading_, {"--at=40,-105"}, "--at without a time zone");
  refused(shading_, {"--at=40,-105", "--tz", "-7", "--width", "1"},
          "--width does not go with a candidate that is a table");
  refused(own_, {"--at=40,-105", "--tz", "-7"}, "own.csv has its own suns");
  const std::string result = directory_.file("result.json");
  write_text(result, "{}");
  refused(result, {"--tz", "-7"}, "--tz is of tables alone; expected --candidate FILE.csv");
  refused(shading_, {"--candidate", result}, "tables and results are not judged together");
  Table table = read_table(shading_);
  table[3][2] = "x";
  const RunResult bad = certify(table);
  EXPECT_EQ(bad.status, 2);
  EXPECT_THAT(bad.err, HasSubstr("changed.csv:4:24: 'x' is no number; expected the lit share of "
                                 "'Wall'"));
}

TEST_F(EngineTables, MayCoverAnyRowsOfAYear) {
  Table table = read_table(shading_);
  table.erase(table.begin() + 20, table.begin() + 30);
  const RunResult run = certify(table);
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("38 rows of 60 minutes"));
  table[5][0] = "06/21 05:20";
  const RunResult odd = certify(table);
  EXPECT_EQ(odd.status, 2);
  EXPECT_THAT(odd.err, HasSubstr("minutes"));
}

}  // namespace
}  // namespace gnomon::test
