// SPDX-License-Identifier: GPL-3.0-or-later
// shadows --shares: tables read back, held against the result file of the same run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidjson/document.h>

#include <charconv>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "run_gnomon.h"

namespace gnomon::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

rapidjson::Document parsed(const std::string& text) {
  rapidjson::Document document;
  document.Parse<rapidjson::kParseFullPrecisionFlag>(text.c_str());
  EXPECT_FALSE(document.HasParseError()) << text.substr(0, 200);
  return document;
}

void run(const std::vector<std::string>& arguments) {
  const RunResult done = run_gnomon(arguments);
  ASSERT_EQ(done.status, 0) << done.err;
}

/// Values by light, side and class.
using Key = std::pair<std::string, std::pair<std::string, std::string>>;
using Values = std::map<Key, double>;

std::vector<std::vector<std::string>> csv_rows(const std::string& text) {
  std::vector<std::vector<std::string>> rows{{""}};
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') {
      if (quoted && i + 1 < text.size() && text[i + 1] == '"')
        rows.back().back() += text[i++];
      else
        quoted = !quoted;
    } else if (!quoted && c == ',') {
      rows.back().emplace_back();
    } else if (!quoted && c == '\n') {
      rows.push_back({""});
    } else {
      rows.back().back() += c;
    }
  }
  rows.pop_back();  // after the last line break
  return rows;
}

double number(const std::string& text) {
  double value = -1;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  EXPECT_EQ(read.ptr, text.data() + text.size()) << text;
  return value;
}

Values read_csv(const std::string& file) {
  const auto rows = csv_rows(read_text(file));
  const bool classes = rows[0].size() > 1 && rows[0][1] == "class";
  const std::size_t names = classes ? 2 : 1;
  Values values;
  for (std::size_t r = 1; r < rows.size(); ++r) {
    EXPECT_EQ(rows[r].size(), rows[0].size());
    for (std::size_t c = names; c < rows[r].size(); ++c) {
      values[{rows[r][0], {rows[0][c], classes ? rows[r][1] : "lit"}}] = number(rows[r][c]);
    }
  }
  return values;
}

struct Npy {
  std::vector<std::size_t> shape;
  std::vector<double> numbers;
};

/// As numpy.lib.format describes it.
Npy read_npy(const std::string& file) {
  const std::string text = read_text(file);
  EXPECT_EQ(text.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  const std::size_t head = 10 + static_cast<unsigned char>(text[8]) +
                           256 * static_cast<std::size_t>(static_cast<unsigned char>(text[9]));
  EXPECT_EQ(head % 64, 0u);
  EXPECT_EQ(text[head - 1], '\n');
  const std::string words = text.substr(10, head - 10);
  EXPECT_THAT(words, HasSubstr("{'descr': '<f8', 'fortran_order': False, 'shape': ("));
  Npy array;
  std::size_t at = words.find('('), total = 1;
  while (words[at] != ')') {
    std::size_t size = 0;
    at = static_cast<std::size_t>(
        std::from_chars(words.data() + at + 1, words.data() + words.size(), size).ptr -
        words.data());
    array.shape.push_back(size);
    total *= size;
    if (words[at] == ',') ++at;  // and a space
  }
  EXPECT_EQ(text.size(), head + 8 * total);
  array.numbers.resize(total);
  std::memcpy(array.numbers.data(), text.data() + head, 8 * total);
  return array;
}

Values read_npy_by_name(const std::string& file) {
  const Npy array = read_npy(file);
  const rapidjson::Document names = parsed(read_text(file + ".json"));
  const auto &lights = names["lights"], &sides = names["sides"], &classes = names["classes"];
  EXPECT_EQ(array.shape.size(), classes.Size() == 1 ? 2u : 3u);
  EXPECT_EQ(array.shape[0], lights.Size());
  EXPECT_EQ(array.shape[1], sides.Size());
  Values values;
  std::size_t i = 0;
  for (const auto& light : lights.GetArray()) {
    for (const auto& side : sides.GetArray()) {
      for (const auto& one : classes.GetArray()) {
        values[{light.GetString(), {side.GetString(), one.GetString()}}] = array.numbers.at(i++);
      }
    }
  }
  return values;
}

/// Every fraction of the result is in the table, and all else in it is not lit.
void expect_same(const Values& table, const std::string& result_file) {
  const rapidjson::Document result = parsed(read_text(result_file));
  Values rest = table;
  for (const auto& light : result["lights"].GetArray()) {
    const bool area = light.HasMember("umbra");
    for (const auto& polygon : light["polygons"].GetArray()) {
      const std::string side =
          std::string(polygon["id"].GetString()) + (polygon["side"] == "back" ? "#back" : "");
      for (const char* name : {"lit", "penumbra", "umbra"}) {
        const Key key{light["id"].GetString(), {side, name}};
        const auto found = rest.find(key);
        if (found == rest.end()) {
          EXPECT_STRNE(name, "lit") << side;  // a table of lit shares alone
          continue;
        }
        const char* member = !area && std::string(name) == "umbra" ? "shadow" : name;
        const double expected =
            polygon.HasMember(member) ? polygon[member]["fraction"].GetDouble() : 0;
        EXPECT_EQ(found->second, expected) << key.first << ' ' << side << ' ' << name;
        rest.erase(found);
      }
    }
  }
  for (const auto& [key, value] : rest) {
    EXPECT_EQ(value, key.second.second == "umbra" ? 1 : 0) << key.first << key.second.first;
  }
}

void check_scene(const std::string& scene, const std::vector<std::string>& more = {}) {
  const TestDirectory directory;
  const std::string csv = directory.file("t.csv"), npy = directory.file("t.npy");
  const std::string result = directory.file("r.json");
  const auto with = [&](std::vector<std::string> arguments) {
    std::vector<std::string> all{"shadows", scene};
    all.insert(all.end(), more.begin(), more.end());
    all.insert(all.end(), arguments.begin(), arguments.end());
    return all;
  };
  run(with({"--shares", csv, "-o", result}));
  run(with({"--shares", npy}));
  EXPECT_EQ(directory.count(), 4u);  // no result beside the second
  const Values from_csv = read_csv(csv), from_npy = read_npy_by_name(npy);
  EXPECT_GT(from_csv.size(), 1u);
  EXPECT_EQ(from_csv, from_npy);
  expect_same(from_csv, result);
}

std::string example(const std::string& name) { return GNOMON_EXAMPLES "/" + name + ".json"; }

TEST(Shares, OfExamplesAreThoseOfTheResult) {
  check_scene(example("table-chair"));
  check_scene(example("courtyard"));
  check_scene(example("room"), {"--sun=1,2,8", "--point=1,1,2"});
  check_scene(example("room1992"));
  check_scene(example("lattice"), {"--kernel", "float"});
}

/// A notched floor, a square bent along its diagonal, a two-sided fin, and a line of no area.
constexpr const char* kScene = R"({"format": "gnomon-scene", "version": 1,
 "vertices": [[0,0,0],[4,0,0],[4,2,0],[2,2,0],[2,4,0],[0,4,0], [0,0,1],[2,0,1],[2,3,1],[0,4,1],
              [9,0,0],[10,0,0],[10,1,1],[9,1,0], [1,6,0],[2,6,0],[2,6,9],[1,6,9],
              [7,7,0],[8,7,0],[9,7,0]],
 "polygons": [{"id": "floor, \"notched\"", "loop": [0,1,2,3,4,5]},
              {"id": "roof", "loop": [6,7,8,9]}, {"id": "bent", "loop": [10,11,12,13]},
              {"id": "fin", "loop": [14,15,16,17], "two_sided": true},
              {"id": "line", "loop": [18,19,20]}],
 "lights": [{"id": "zenith", "type": "directional", "to_light": [0,0,1]},
            {"id": "low", "type": "directional", "to_light": [1,3,2]},
            {"id": "lamp", "type": "point", "position": [1.3,-2,4]}]})";

TEST(Shares, OfPolygonsOfSeveralPartsAndTwoSides) {
  const TestDirectory directory;
  const std::string scene = directory.file("s.json");
  write_text(scene, kScene);
  check_scene(scene);
  check_scene(scene, {"--light", "low", "--light", "zenith"});
  check_scene(scene, {"--area=0,5,6:0,7,6:3,7,6:3,5,6"});
  run({"shadows", scene, "--shares", directory.file("t.csv")});
  const auto rows = csv_rows(read_text(directory.file("t.csv")));
  EXPECT_THAT(rows[0],
              ElementsAre("light", "floor, \"notched\"", "roof", "bent", "fin", "fin#back"));
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[2][0], "low");
  run({"shadows", scene, "--shares", directory.file("t.npy")});
  const rapidjson::Document names = parsed(read_text(directory.file("t.npy.json")));
  EXPECT_STREQ(names["format"].GetString(), "gnomon-shares");
  EXPECT_STREQ(names["table"].GetString(), "t.npy");
  ASSERT_EQ(names["dropped"].Size(), 1u);
  EXPECT_STREQ(names["dropped"][0].GetString(), "line");
}

TEST(Shares, DoNotDependOnThreads) {
  const TestDirectory directory;
  run({"generate", "city", "--param", "n=400", "-o", directory.file("s.json")});
  std::vector<std::string> all;
  for (const char* jobs : {"1", "2", "5"}) {
    run({"shadows", directory.file("s.json"), "--sun=3,1,2", "-j", jobs, "--shares",
         directory.file("t.npy")});
    all.push_back(read_text(directory.file("t.npy")));
  }
  EXPECT_EQ(all[0], all[1]);
  EXPECT_EQ(all[0], all[2]);
}

TEST(Shares, WriteNothingElseButWithStatistics) {
  const TestDirectory directory;
  const RunResult done = run_gnomon(
      {"shadows", example("room"), "--sun=1,2,8", "--stats", "--shares", directory.file("t.csv")});
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_EQ(done.out, "");
  EXPECT_THAT(done.err, HasSubstr("light sun0: "));
  EXPECT_EQ(directory.count(), 1u);
}

TEST(Shares, AreRefusedWhereTheyMakeNoSense) {
  const TestDirectory directory;
  const auto refused = [&](std::vector<std::string> arguments, const std::string& words) {
    arguments.insert(arguments.begin(), {"shadows", example("room")});
    const RunResult done = run_gnomon(arguments);
    EXPECT_EQ(done.status, 2) << done.err;
    EXPECT_THAT(done.err, HasSubstr(words));
    EXPECT_EQ(done.out, "");
  };
  const std::string file = directory.file("t.csv");
  refused({"--shares", directory.file("t.txt")}, "its ending names no format; expected FILE.csv");
  refused({"--shares", "-"}, "its ending names no format");
  refused({"--shares", file, "--pieces"}, "--shares is of whole lights; expected no --pieces");
  refused({"--shares", file, "--fragments"}, "--fragments is of the result");
  refused({"--shares", file, "--exact-fractions"}, "expected -o FILE too");
  refused({"--shares", "/nowhere/t.csv"}, "/nowhere/t.csv");
  EXPECT_EQ(directory.count(), 0u);
}

/// A sun for each of so many times.
std::string suns(unsigned count) {
  std::string text = R"({"format": "gnomon-scene", "version": 1, "vertices": [], "polygons": [],
 "lights": [)";
  for (unsigned i = 0; i < count; ++i) {
    text += (i == 0 ? "" : ",\n") + std::string(R"({"id": "s)") + std::to_string(i) +
            R"(", "type": "directional", "to_light": [)" + std::to_string(i) + ",100,90]}";
  }
  return text + "]}";
}

TEST(Shares, KeepWhatWasDoneWhenInterrupted) {
  for (const std::string ending : {"csv", "npy"}) {
    const TestDirectory directory;
    run({"generate", "city", "--param", "n=300", "-o", directory.file("s.json")});
    write_text(directory.file("suns.json"), suns(100'000));
    const auto part_size = [&] {
      std::uintmax_t size = 0;
      for (const auto& entry : std::filesystem::directory_iterator(directory.path())) {
        std::error_code ignored;
        if (entry.path().extension() == ".part") size = entry.file_size(ignored);
      }
      return size;
    };
    RunOptions options;
    options.signal = SIGINT;
    options.signal_when = [&] { return part_size() > 200'000; };
    const std::string table = directory.file("t." + ending);
    const RunResult done = run_gnomon({"shadows", directory.file("s.json"), "--lights",
                                       directory.file("suns.json"), "--shares", table},
                                      options);
    EXPECT_EQ(done.status, 130) << done.err;
    EXPECT_THAT(done.err, HasSubstr("t." + ending + " has "));
    EXPECT_THAT(done.err, HasSubstr(" of 100"));
    const Values values = ending == "csv" ? read_csv(table) : read_npy_by_name(table);
    EXPECT_GT(values.size(), 1000u);
    EXPECT_TRUE(values.begin()->first.first.starts_with("s") ||
                values.begin()->first.first == "lamp");
  }
}

TEST(Shares, OfAFullDiskAreAnError) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP();
  const TestDirectory directory;
  std::filesystem::create_symlink("/dev/full", directory.file("t.csv"));
  const RunResult done =
      run_gnomon({"shadows", example("room"), "--shares", directory.file("t.csv")});
  EXPECT_EQ(done.status, 2);
  EXPECT_THAT(done.err, HasSubstr("No space left on device"));
}

}  // namespace
}  // namespace gnomon::test
