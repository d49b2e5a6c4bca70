// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes in plain JSON are read without the parser: the same scene to the last bit, and never where
// the parser has something to say.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "gnomon/scene/digest.h"
#include "gnomon/scene/write.h"
#include "mutated.h"
#include "scene/base/text_window.h"
#include "scene/files/plain_json_scene.h"
#include "scene/files/readers.h"
#include "scene_testing.h"
#include "tests/support/test_directory.h"

namespace gnomon {
namespace {

namespace fs = std::filesystem;

std::optional<ReadResult> plain(const std::string& text, const ReadOptions& options = {}) {
  TextWindow window(text);
  return read_plain_json(window, "s.json", options);
}

/// The numbers are also held in the same way.
void expect_same_numbers(const Number& a, const Number& b) {
  EXPECT_EQ(a.is_decimal(), b.is_decimal());
  EXPECT_EQ(a.exponent(), b.exponent());
  EXPECT_EQ(a.has_small_mantissa(), b.has_small_mantissa());
  EXPECT_EQ(a.mantissa(), b.mantissa());
}

void expect_same_result(const ReadResult& a, const ReadResult& b) {
  expect_same_scene(a.scene, b.scene);
  EXPECT_EQ(a.scene.file, b.scene.file);
  EXPECT_EQ(a.warnings, b.warnings);
  for (std::size_t i = 0; i < a.scene.vertices.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      expect_same_numbers(a.scene.vertices[i][k], b.scene.vertices[i][k]);
    }
  }
}

/// Plain or not, the text says what the parser says. True if it was plain.
bool expect_as_parsed(const std::string& text, const ReadOptions& options = {}) {
  const auto parsed = parse_json(text, "s.json", options);
  const auto found = plain(text, options);
  if (found) {
    EXPECT_TRUE(parsed) << to_string(parsed.error());
    if (parsed) expect_same_result(*found, *parsed);
  }
  const auto read = read_json(text, "s.json", options);
  EXPECT_EQ(read.has_value(), parsed.has_value());
  if (!read && !parsed) {
    EXPECT_EQ(to_string(read.error()), to_string(parsed.error()));
  }
  return found.has_value();
}

/// A plain scene with all that one may hold, one thing of which is replaced.
std::string changed(const std::string& from = "", const std::string& to = "") {
  std::string text = R"({"format": "gnomon-scene", "version": 1, "name": "täble", "two_sided": true,
 "extra": {"a": [1, -2.5e3, "x", null, true, {}, [], {"b": {"c": []}}]},
 "vertices": [[0,0,0],[4,0,0],[4,4,0],[0,4,0], [ 1.5 , -2.25e-1 ,3E+2 ]],
 "polygons": [{"id": "a", "loop": [0,1,2,3], "holes": [[1, 2, 3]], "extra": 7, "casts": false},
  {"id": "b", "loop": [0,1,2], "two_sided": false}, {"loop": [2,1,0], "holes": []}],
 "lights": [{"id": "bulb", "type": "point", "position": [1,1,3], "intensity": 2.5},
  {"to_light": [0,0,1], "type": "directional", "extra": "north"},
  {"id": "panel", "type": "area", "loop": [[0,0,3],[0,1,3],[1,1,3]]}]}
)";
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(PlainJson, TakesWhatProgramsWrite) {
  EXPECT_TRUE(expect_as_parsed(changed()));
  EXPECT_TRUE(expect_as_parsed("\xEF\xBB\xBF\r\n\t " + changed() + " \r\n\t"));
  const std::pair<const char*, const char*> cases[] = {
      {"[0,1,2,3]", "[\n0\t,\r1 ,2 , 3 ]"},
      {"[0,1,2,3]", "[4,3,2,1]"},
      {"\"name\": \"täble\"", "\"name\": \"\""},
      {"\"name\": \"täble\", ", ""},
      {"{\"a\": [1, -2.5e3, \"x\", null, true, {}, [], {\"b\": {\"c\": []}}]}", "1e999"},
      {"\"extra\": {\"a\": [1, -2.5e3,", "\"extra\": {\"a\": {}, \"a\": [0.5,"},
      {"\"id\": \"a\"", "\"id\": \"\xF0\x9F\x8F\xA0 \x7E\""},
      {"\"id\": \"b\", ", ""},
      {"\"two_sided\": true", "\"numbers\": \"decimal\""},
      {"\"two_sided\": true", "\"numbers\": \"double\""}};
  for (const auto& [from, to] : cases) EXPECT_TRUE(expect_as_parsed(changed(from, to))) << to;
  // Lists in another order, empty lists.
  EXPECT_TRUE(expect_as_parsed(
      R"({"polygons":[{"loop":[0,1,2]}],"vertices":[[0,0,0],[1,0,0],[0,1,0]],"version":1,"format":"gnomon-scene"})"));
  EXPECT_TRUE(expect_as_parsed(
      R"({"polygons":[ ],"lights":[],"vertices":[],"version":1,"format":"gnomon-scene"})"));
  for (const auto meaning : {NumberMeaning::kDouble, NumberMeaning::kDecimal}) {
    ReadOptions options;
    options.numbers = meaning;
    EXPECT_TRUE(expect_as_parsed(changed(), options));
    EXPECT_TRUE(
        expect_as_parsed(changed("\"two_sided\": true", "\"numbers\": \"decimal\""), options));
  }
}

TEST(PlainJson, LeavesEverythingElseToTheParser) {
  const std::pair<const char*, const char*> cases[] = {
      // Right, but not plain.
      {"täble", "t\\u00e4ble"},
      {"\"name\"", "\"n\\u0061me\""},
      {"[0,4,0]", "[0,4,1e-310]"},
      {"\"id\": \"b\"", "\"id\": \"b\\/\""},
      // Wrong.
      {"\"version\": 1", "\"version\": 1.0"},
      {"\"version\": 1", "\"version\": 01"},
      {"\"version\": 1", "\"version\" 1"},
      {"\"version\": 1,", ""},
      {"gnomon-scene", "gnomon-scenes"},
      {"\"name\"", "\"nam\""},
      {"\"name\": \"täble\"", "\"name\": \"t\xC3\""},
      {"\"name\": \"täble\"", "\"name\": \"\xED\xA0\x80\""},
      {"\"name\": \"täble\"", "\"name\": \"\n\""},
      {"\"two_sided\": true", "\"two_sided\": null"},
      {"\"two_sided\": true", "\"two_sided\": true, \"two_sided\": true"},
      {"\"two_sided\": true", "\"numbers\": \"float\""},
      {"[4,0,0]", "[4,0]"},
      {"[4,0,0]", "[4,0,0,0]"},
      {"[4,0,0]", "[4,0,0],"},
      {"[4,0,0]", "[04,0,0]"},
      {"[4,0,0]", "[4,-00,0]"},
      {"[4,0,0]", "[4,0,0.]"},
      {"[4,0,0]", "[4,.5,0]"},
      {"[4,0,0]", "[4,+1,0]"},
      {"[4,0,0]", "[4,1e,0]"},
      {"[4,0,0]", "[4,1e+,0]"},
      {"[4,0,0]", "[4,1e400,0]"},
      {"[4,0,0]", "[4,-,0]"},
      {"[4,0,0]", "[4,NaN,0]"},
      {"[4,0,0]", "[4,\"0\",0]"},
      {"[0,1,2,3]", "[0,1]"},
      {"[0,1,2,3]", "[]"},
      {"[0,1,2,3]", "[0,1,5]"},
      {"[0,1,2,3]", "[0,1,-0]"},
      {"[0,1,2,3]", "[0,1,02]"},
      {"[0,1,2,3]", "[0,1,2.0]"},
      {"[0,1,2,3]", "[0,1,2e0]"},
      {"[0,1,2,3]", "[0,1,4294967296]"},
      {"[0,1,2,3]", "[0,1,18446744073709551616]"},
      {"[0,1,2,3]", "[0,1,2,]"},
      {"[[1, 2, 3]]", "[[1, 2]]"},
      {"[[1, 2, 3]]", "[1, 2, 3]"},
      {"\"id\": \"a\"", "\"id\": \"\""},
      {"\"id\": \"a\"", "\"id\": \"a#\""},
      {"\"id\": \"a\"", "\"id\": \"a\x7F\""},
      {"\"id\": \"a\"", "\"id\": \"a\xC2\x85\""},
      {"\"id\": \"a\"", "\"id\": \"b\""},
      {"\"id\": \"a\"", "\"id\": \"2\""},
      {"\"id\": \"a\", \"loop\": [0,1,2,3],", ""},
      {"\"position\"", "\"to_light\""},
      {"\"type\": \"point\", ", ""},
      {"\"type\": \"point\"", "\"type\": \"spot\""},
      {"\"intensity\": 2.5", "\"intensity\": -2.5"},
      {"\"intensity\": 2.5", "\"to_light\": [0,0,1]"},
      {"\"to_light\": [0,0,1]", "\"to_light\": [0,0,-0]"},
      {"[[0,0,3],[0,1,3],[1,1,3]]", "[[0,0,3],[0,1,3]]"},
      {"\"id\": \"panel\"", "\"id\": \"bulb\""},
      {"{\"c\": []}", "{\"c\": [}"},
      {"{\"c\": []}", "{\"c\": [tru]}"},
      {"{\"c\": []}", "{\"c\" []}"},
      {"{\"c\": []}", "{\"c\": [1,]}"},
      {"{\"c\": []}", "{1: [1,]}"}};
  for (const auto& [from, to] : cases) EXPECT_FALSE(expect_as_parsed(changed(from, to))) << to;
  EXPECT_FALSE(expect_as_parsed(changed() + "x"));
  EXPECT_FALSE(expect_as_parsed(changed() + std::string(1, '\0')));
  EXPECT_FALSE(expect_as_parsed(""));
  EXPECT_FALSE(expect_as_parsed("[]"));
  EXPECT_FALSE(
      expect_as_parsed(changed("{\"c\": []}", std::string(100, '[') + std::string(100, ']'))));
  ReadOptions lights;
  lights.lights_only = true;
  EXPECT_FALSE(expect_as_parsed(changed(), lights));
  EXPECT_FALSE(expect_as_parsed(full_json()));
}

/// Numbers of `texts` as the coordinates of a scene, by both meanings.
void expect_numbers_as_parsed(const std::vector<std::string>& texts) {
  std::string vertices;
  for (const std::string& text : texts) {
    vertices += (vertices.empty() ? "[" : ",[") + text + "," + text + " ,-" + text + "]";
  }
  for (const auto meaning : {NumberMeaning::kDouble, NumberMeaning::kDecimal}) {
    ReadOptions options;
    options.numbers = meaning;
    EXPECT_TRUE(expect_as_parsed(
        R"({"format":"gnomon-scene","version":1,"polygons":[],"vertices":[)" + vertices + "]}",
        options));
  }
}

TEST(PlainJson, NumbersAtTheEdges) {
  expect_numbers_as_parsed(
      {"0", "0.0", "0e0", "0e99", "0E-5", "0.000000000000000000000000", "1", "10", "100e-2", "1e2",
       // 2^53 and its neighbours, also with zeros and a point.
       "9007199254740991", "9007199254740992", "9007199254740993", "9007199254740994",
       "9007199254740993.0", "900719925474099.3e1", "9007199254740993e-3", "9007199254740992e22",
       // 15 to 20 digits.
       "123456789012345", "1234567890123456", "12345678901234567", "123456789012345678",
       "1234567890123456789", "12345678901234567890", "999999999999999999", "9999999999999999999",
       "0.123456789012345678", "1.23456789012345678", "0.1234567890123456789",
       "9223372036854775807", "9223372036854775808", "18446744073709551615", "18446744073709551616",
       "100000000000000000000", "1000000000000000001",
       // The last power of ten that is a double, and one more.
       "1e22", "1e23", "7e-22", "7e-23", "9007199254740991e-22", "9007199254740991e-23",
       // Halfway between doubles, and beside.
       "0.500000000000000055511151231257827021181583404541015625",
       "0.500000000000000055511151231257827021181583404541015624",
       "0.500000000000000055511151231257827021181583404541015626",
       "1.00000000000000011102230246251565404236316680908203125", "9007199254740992.5",
       // The ends of the normal doubles.
       "1.7976931348623157e308", "179769313486231570e291", "2.2250738585072014e-308",
       "22250738585072014e-324", "0.1", "0.2", "0.3", "3.141592653589793", "28.38000000001"});
}

TEST(PlainJson, NumbersBeyondTheDoublesAsDecimals) {
  ReadOptions decimals;
  decimals.numbers = NumberMeaning::kDecimal;
  for (const char* number : {"1e400", "1e-400", "4.9e-324", "1e999", "1e1000", "1e4096", "1e-4096",
                             "1e0999", "123456789012345678e-999", "1E+0000000000000000002"}) {
    EXPECT_TRUE(expect_as_parsed(changed("[4,0,0]", std::string("[4,0,") + number + "]"), decimals))
        << number;
  }
  for (const char* number : {"1e4097", "1e-4097", "1e99999999999999999999"}) {
    EXPECT_FALSE(
        expect_as_parsed(changed("[4,0,0]", std::string("[4,0,") + number + "]"), decimals))
        << number;
  }
  // Underflow is a warning with a place.
  for (const char* number : {"4.9e-324", "2.2250738585072011e-308", "1e-400"}) {
    EXPECT_FALSE(expect_as_parsed(changed("[4,0,0]", std::string("[4,0,") + number + "]")))
        << number;
  }
}

TEST(PlainJson, RandomNumbers) {
  std::mt19937_64 random(53);
  std::vector<std::string> texts;
  const auto digits = [&](std::size_t count) {
    std::string text;
    while (text.size() < count)
      text += static_cast<char>('0' + (random() % 3 == 0 ? 0 : random() % 10));
    return text;
  };
  for (int i = 0; i < 4000; ++i) {
    std::string text =
        random() % 2 == 0 ? "0" : std::to_string(random() % 9 + 1) + digits(random() % 20);
    if (random() % 3 != 0) text += "." + digits(1 + random() % 20);
    if (random() % 3 == 0) text += "e" + std::to_string(static_cast<int>(random() % 60) - 30);
    texts.push_back(std::move(text));
  }
  for (int i = 0; i < 4000; ++i) {
    const double value =
        std::ldexp(static_cast<double>(random() >> 11), static_cast<int>(random() % 80) - 90);
    char buffer[64];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
    texts.emplace_back(buffer, end);
  }
  expect_numbers_as_parsed(texts);
}

TEST(PlainJson, BrokenFilesEndAsByTheParser) {
  std::mt19937_64 random(1992);
  int taken = 0;
  const std::string texts[] = {changed(), full_json()};
  for (int i = 0; i < 20000; ++i) {
    const std::string text = mutated(texts[i % 8 == 0 ? 1 : 0], random);
    taken += expect_as_parsed(text) ? 1 : 0;
    ASSERT_FALSE(HasFailure()) << text;
  }
  EXPECT_GT(taken, 200);
}

class PlainJsonFile : public ::testing::Test {
 protected:
  fs::path put(const std::string& text) const {
    const fs::path file = directory_.path() / "s.json";
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }
  /// Read through the window, and found to be as parsed.
  void expect_read(const std::string& text) const {
    const fs::path file = put(text);
    auto window = TextWindow::of_file(file);
    ASSERT_TRUE(window);
    const auto found = read_plain_json(*window, file.string(), {});
    const auto parsed = parse_json(text, file.string(), {});
    ASSERT_TRUE(parsed) << to_string(parsed.error());
    ASSERT_TRUE(found);
    expect_same_result(*found, *parsed);
  }

 private:
  test::TestDirectory directory_;
};

/// A scene of some 600 kB, which is more than a window.
std::string large_text(std::size_t blanks) {
  std::string text = R"({"format": "gnomon-scene", "version": 1, )" + std::string(blanks, ' ') +
                     R"("name": "large", "vertices": [)";
  for (int i = 0; i < 12000; ++i) {
    text += (i == 0 ? "\n[" : ",\n[") + std::to_string(i % 100) + ", " + std::to_string(i / 100) +
            ".5, 0]";
  }
  text += "],\n\"polygons\": [";
  for (int i = 0; i < 11000; ++i) {
    const std::string name = "a rather long name of polygon " + std::to_string(i);
    text += std::string(i == 0 ? "" : ",") + "\n{\"id\": \"" + name + "\", \"loop\": [" +
            std::to_string(i) + ", " + std::to_string(i + 1) + ", " + std::to_string(i + 100) +
            "], \"two_sided\": false}";
  }
  return text + "],\n \"lights\": [{\"type\": \"point\", \"position\": [1, 2, 3]}]\n}\n";
}

TEST_F(PlainJsonFile, AWindowThatEndsAnywhere) {
  for (std::size_t blanks = 0; blanks < 70; ++blanks) expect_read(large_text(blanks));
}

TEST_F(PlainJsonFile, APolygonLargerThanTheWindow) {
  std::string text = large_text(0);
  std::string loop = "0";
  for (int i = 1; i < 200000; ++i) loop += ", " + std::to_string(i % 12000);
  text.replace(text.find("[0, 1, 100]"), 11, "[" + loop + "]");
  expect_read(text);
}

TEST_F(PlainJsonFile, EveryShortening) {
  const std::string text = changed();
  for (std::size_t size = 0; size < text.size(); ++size) {
    const std::string part = text.substr(0, size);
    auto window = TextWindow::of_file(put(part));
    ASSERT_TRUE(window);
    EXPECT_EQ(read_plain_json(*window, "s.json", {}).has_value(), plain(part).has_value()) << size;
    EXPECT_EQ(plain(part).has_value(), parse_json(part, "s.json", {}).has_value()) << size;
  }
}

TEST_F(PlainJsonFile, ErrorsOfLargeFilesHaveTheirPlaces) {
  std::string text = large_text(0);
  const std::size_t at = text.rfind("10999");
  text.replace(at, 5, "99999");
  const auto read = read_scene(put(text));
  ASSERT_FALSE(read);
  EXPECT_THAT(to_string(read.error()), ::testing::HasSubstr("index 99999 is not that of a vertex"));
  EXPECT_EQ(read.error().where.pointer, "/polygons/10999/loop/0");
  EXPECT_GT(read.error().where.line, 23000u);
}

TEST_F(PlainJsonFile, OnlyRegularFilesAreOpened) {
  test::TestDirectory directory;
  EXPECT_FALSE(TextWindow::of_file(directory.path()));
  EXPECT_FALSE(TextWindow::of_file(directory.path() / "absent.json"));
  const fs::path pipe = directory.path() / "pipe.json";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_FALSE(TextWindow::of_file(pipe));
}

}  // namespace
}  // namespace gnomon
