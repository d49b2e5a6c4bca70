// SPDX-License-Identifier: GPL-3.0-or-later
// The JSON reader: what it takes, and the place and words of everything it does not.
#include <gmock/gmock.h>

#include "scene_testing.h"

namespace gnomon {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

/// A small valid scene in which one thing is replaced.
std::string changed(const std::string& from, const std::string& to) {
  std::string text =
      R"({"format": "gnomon-scene", "version": 1, "name": "t",
 "vertices": [[0,0,0],[4,0,0],[4,4,0],[0,4,0]],
 "polygons": [{"id": "a", "loop": [0,1,2,3]},
  {"id": "b", "loop": [0,1,2]}],
 "lights": [{"id": "bulb", "type": "point", "position": [1,1,3]},
  {"id": "sun", "type": "directional", "to_light": [0,0,1]},
  {"id": "panel", "type": "area", "loop": [[0,0,3],[0,1,3],[1,1,3]]}]})";
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string error_after(const std::string& from, const std::string& to) {
  return error_of(changed(from, to), "s.json");
}

TEST(ReadJson, TakesEverythingASceneCanHave) {
  const Scene scene = scene_of(full_json(), "full.json");
  EXPECT_EQ(scene.name, "t\u00e4ble \"1\"");
  EXPECT_EQ(scene.numbers, NumberMeaning::kDecimal);
  EXPECT_TRUE(scene.two_sided);
  EXPECT_EQ(scene.extra, R"({"by": ["hand", 1e999, {"x": null}]})");
  ASSERT_EQ(scene.vertices.size(), 8u);
  EXPECT_EQ(scene.vertices[2][2].exact(), mpq_class(1, 10));
  EXPECT_EQ(scene.vertices[7][1].to_text(), "1e400");
  EXPECT_EQ(scene.vertices[7][2].exact(), mpq_class("123456789012345678901234567890"));
  ASSERT_EQ(scene.polygons.size(), 3u);
  EXPECT_EQ(scene.polygons[0].id, "floor");
  EXPECT_EQ(scene.polygons[0].loop, (std::vector<VertexId>{0, 1, 2, 3}));
  ASSERT_EQ(scene.polygons[0].holes.size(), 1u);
  EXPECT_EQ(scene.polygons[0].holes[0], (std::vector<VertexId>{4, 5, 6}));
  EXPECT_EQ(scene.polygons[0].two_sided, false);
  EXPECT_FALSE(scene.polygons[0].casts);
  EXPECT_EQ(scene.polygons[1].id, "1");
  EXPECT_EQ(scene.polygons[1].two_sided, std::nullopt);
  EXPECT_TRUE(scene.polygons[1].casts);
  EXPECT_TRUE(scene.is_two_sided(scene.polygons[1]));
  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_EQ(scene.lights[0].type, LightType::kPoint);
  EXPECT_EQ(scene.lights[1].type, LightType::kDirectional);
  EXPECT_EQ(scene.lights[1].id, "1");
  EXPECT_EQ(scene.lights[1].position[0].exact(), mpq_class(3, 10));
  EXPECT_EQ(scene.lights[2].loop.size(), 4u);
  EXPECT_EQ(scene.lights[2].intensity, Number(2.5));
  EXPECT_EQ(scene.lights[0].intensity, Number(1.0));
}

TEST(ReadJson, MeaningOfNumbers) {
  const std::string text = changed("[4,4,0]", "[4,4,0.1]");
  EXPECT_EQ(scene_of(text, "s.json").vertices[2][2], Number(0.1));
  // Also where "numbers" stands behind the numbers.
  std::string late = text;
  late.insert(late.size() - 1, R"(, "numbers": "decimal")");
  EXPECT_EQ(scene_of(late, "s.json").vertices[2][2].exact(), mpq_class(1, 10));
  ReadOptions options;
  options.numbers = NumberMeaning::kDouble;
  const Scene overridden = scene_of(late, "s.json", options);
  EXPECT_EQ(overridden.numbers, NumberMeaning::kDouble);
  EXPECT_EQ(overridden.vertices[2][2], Number(0.1));
}

TEST(ReadJson, DefaultsAndOrder) {
  const Scene scene = scene_of(
      R"({"polygons": [{"loop": [2,1,0]}], "vertices": [[0,0,0],[1,0,0],[0,1,0]], "version": 1,
          "format": "gnomon-scene"})",
      "dir/some.name.json");
  EXPECT_EQ(scene.name, "some.name");
  EXPECT_EQ(scene.numbers, NumberMeaning::kDouble);
  EXPECT_FALSE(scene.two_sided);
  EXPECT_EQ(scene.polygons[0].id, "0");
  EXPECT_EQ(scene.file, "dir/some.name.json");
}

TEST(ReadJson, ByteOrderMarkAndLineEnds) {
  EXPECT_EQ(error_of("\xEF\xBB\xBF" + changed("\"b\"", "\"b\""), "s.json"), "ok");
  EXPECT_EQ(error_of("\xEF\xBB\xBF{\r\n \"wrong\": 1}", "s.json"),
            "2:2: unknown key 'wrong' @/wrong");
}

TEST(ReadJson, WarnsOfUnderflow) {
  const auto result = parse_scene(changed("[4,4,0]", "[4,1e-320,1e-999]"), "s.json", {});
  ASSERT_TRUE(result);
  ASSERT_EQ(result->warnings.size(), 1u);
  EXPECT_EQ(result->warnings[0],
            "2 numbers are too small for full double precision; first at line 2, column 34");
}

TEST(ReadJson, Syntax) {
  EXPECT_EQ(error_after("[4,0,0],", "[4,0,0],,"), "2:31: ',' is not a JSON value @/vertices/2");
  EXPECT_EQ(error_after("[4,0,0]", "[4 0,0]"),
            "2:26: the array does not go on here @/vertices/1/1");
  EXPECT_EQ(error_after("\"version\": 1", "\"version\" 1"),
            "1:38: no colon after the key @/version");
  EXPECT_EQ(error_after("\"a\", \"loop\"", "\"a\" \"loop\""),
            "3:26: the object does not go on here @/polygons/0/id");
  EXPECT_EQ(error_after("\"t\"", "\"\\x\""), "1:51: a wrong escape in a string @/name");
  EXPECT_THAT(error_after("\"t\"", "\"\\ud800\""), HasSubstr("half of a surrogate pair"));
  EXPECT_THAT(error_after("\"t\"", "\"\\udc00\""), HasSubstr("half of a surrogate pair"));
  EXPECT_THAT(error_after("\"t\"", "\"a\nb\""), HasSubstr("control character in a string"));
  EXPECT_EQ(error_after("[4,4,0]", "[4,4.,0]"),
            "2:36: a number without digits after its point @/vertices/2/1");
  EXPECT_THAT(error_after("[4,4,0]", "[4,4e,0]"), HasSubstr("without digits in its exponent"));
  EXPECT_THAT(error_after("[4,4,0]", "[4,+4,0]"), HasSubstr("'+4' is not a JSON value"));
  EXPECT_THAT(error_after("[4,4,0]", "[4,04,0]"), HasSubstr("2:35: "));
  EXPECT_THAT(error_after("[4,4,0]", "[4,0x4,0]"), HasSubstr("2:35: "));
  EXPECT_EQ(error_of("{} {}", "s.json"), "1:1: the key 'format' is missing");
  EXPECT_THAT(error_of(changed("\"b\"", "\"b\"") + " x", "s.json"),
              HasSubstr("7:72: text after the end of the scene"));
  EXPECT_EQ(error_of("{ // no comments\n}", "s.json"), "1:3: this is not a key");
}

TEST(ReadJson, NumbersThatAreNotFinite) {
  for (const char* word : {"NaN", "nan", "Infinity", "-Infinity", "-inf", "-NaN"}) {
    const std::string text = changed("[4,4,0]", std::string("[4,") + word + ",0]");
    EXPECT_EQ(error_of(text, "s.json"),
              std::string("2:34: '") + word + "' is not finite @/vertices/2/1");
    EXPECT_EQ(code_of(text, "s.json"), ErrorCode::kNumber);
  }
}

TEST(ReadJson, NumbersBeyondTheParser) {
  EXPECT_EQ(error_after("[4,4,0]", "[4,1e400,0]"),
            "2:34: '1e400' is too large for a double @/vertices/2/1");
  const std::string long_integer = "1" + std::string(400, '0');
  EXPECT_EQ(code_of(changed("[4,4,0]", "[4," + long_integer + ",0]"), "s.json"),
            ErrorCode::kNumber);
  ReadOptions decimal;
  decimal.numbers = NumberMeaning::kDecimal;
  const Scene scene =
      scene_of(changed("[4,4,0]", "[" + long_integer + ",1e400,-7.5e+999]"), "s.json", decimal);
  ASSERT_EQ(scene.vertices.size(), 4u);
  EXPECT_EQ(scene.vertices[2][0].to_text(), "1e400");
  EXPECT_EQ(scene.vertices[2][1].to_text(), "1e400");
  EXPECT_EQ(scene.vertices[2][2].to_text(), "-7.5e999");
  EXPECT_EQ(error_of(changed("[4,4,0]", "[4,1e400,1e5000]"), "s.json", decimal),
            "2:40: '1e5000' has an exponent beyond +-4096 @/vertices/2/2");
  EXPECT_EQ(code_of(changed("[4,4,0]", "[4,4," + std::string(1001, '3') + "]"), "s.json", decimal),
            ErrorCode::kLimit);
  // A name that looks like one is none.
  EXPECT_EQ(scene_of(changed("\"t\"", "\"\\\"1e400\""), "s.json").name, "\"1e400");
}

TEST(ReadJson, TruncatedFiles) {
  const std::string text = full_json();
  const std::size_t end = text.find_last_of('}');
  for (std::size_t size = 0; size <= end; ++size) {
    const auto result = parse_scene(text.substr(0, size), "s.json", {});
    ASSERT_FALSE(result) << size;
    EXPECT_GT(result.error().where.line, 0u) << size;
    EXPECT_FALSE(result.error().what.empty());
  }
  EXPECT_THAT(error_of(text.substr(0, end), "s.json"), HasSubstr("the file ends too early"));
}

TEST(ReadJson, TopLevel) {
  EXPECT_EQ(error_of("", "s.json"), "1:1: the file is empty");
  EXPECT_EQ(error_of(" \n\t", "s.json"), "1:1: the file is empty");
  EXPECT_EQ(error_of("[]", "s.json"), "1:1: found an array");
  EXPECT_EQ(error_of("3", "s.json"), "1:1: found a number");
  EXPECT_EQ(error_of("\"x\"", "s.json"), "1:1: found a string");
  EXPECT_EQ(error_of(" null", "s.json"), "1:2: found null");
  EXPECT_EQ(error_of("{}", "s.json"), "1:1: the key 'format' is missing");
  EXPECT_EQ(error_after("gnomon-scene", "gnomon-result"), "1:12: format 'gnomon-result' @/format");
  EXPECT_EQ(error_after("\"version\": 1", "\"version\": 2"), "1:39: version 2 @/version");
  EXPECT_EQ(error_after("\"version\": 1", "\"version\": 0"), "1:39: version 0 @/version");
  EXPECT_EQ(error_after("\"version\": 1", "\"version\": \"1\""), "1:39: found a string @/version");
  EXPECT_EQ(error_after("\"version\": 1, ", ""), "1:1: the key 'version' is missing");
  EXPECT_EQ(error_after("\"vertices\"", "\"extra\""), "1:1: the key 'vertices' is missing");
  EXPECT_EQ(error_after("\"name\": \"t\"", "\"numbers\": \"float\""),
            "1:53: numbers 'float' @/numbers");
  EXPECT_EQ(error_after("\"name\": \"t\"", "\"two_sided\": 1"), "1:55: found a number @/two_sided");
}

TEST(ReadJson, KeysUnknownAndTwice) {
  EXPECT_EQ(error_after("\"name\"", "\"Name\""), "1:42: unknown key 'Name' @/Name");
  EXPECT_EQ(error_after("\"name\"", "\"a/b~c\""), "1:42: unknown key 'a/b~c' @/a~1b~0c");
  EXPECT_EQ(error_after("\"name\": \"t\"", "\"version\": 1"),
            "1:42: the key 'version' stands here twice @/version");
  EXPECT_EQ(error_after("\"id\": \"b\"", "\"colour\": 1"),
            "4:4: unknown key 'colour' @/polygons/1/colour");
  EXPECT_EQ(error_after("\"id\": \"b\"", "\"loop\": [0,1,2]"),
            "4:21: the key 'loop' stands here twice @/polygons/1/loop");
  EXPECT_EQ(error_after("\"id\": \"sun\"", "\"extra\": {\"id\": 1, \"id\": 2}"), "ok");
  EXPECT_EQ(error_after("\"id\": \"sun\"", "\"colour\": []"),
            "6:4: unknown key 'colour' @/lights/1/colour");
}

TEST(ReadJson, Vertices) {
  EXPECT_EQ(error_after("[4,0,0]", "[4,0]"), "2:27: only 2 of three coordinates @/vertices/1/2");
  EXPECT_EQ(error_after("[4,0,0]", "[]"), "2:24: only 0 of three coordinates @/vertices/1/0");
  EXPECT_EQ(error_after("[4,0,0]", "[4,0,0,1]"),
            "2:30: more than three coordinates @/vertices/1/3");
  EXPECT_EQ(error_after("[4,0,0]", "[4,\"0\",0]"), "2:26: found a string @/vertices/1/1");
  EXPECT_EQ(error_after("[4,0,0]", "[4,null,0]"), "2:26: found null @/vertices/1/1");
  EXPECT_EQ(error_after("[4,0,0]", "[4,[0],0]"), "2:26: found an array @/vertices/1/1");
  EXPECT_EQ(error_after("[4,0,0]", "{}"), "2:23: found an object @/vertices/1");
  EXPECT_EQ(error_after("[4,0,0]", "7"), "2:23: found a number @/vertices/1");
  EXPECT_EQ(error_after("[[0,0,0],[4,0,0],[4,4,0],[0,4,0]]", "{}"),
            "2:14: found an object @/vertices");
}

TEST(ReadJson, LoopsAndIndices) {
  EXPECT_EQ(error_after("[0,1,2,3]", "[0,1,2,4]"),
            "3:42: index 4 is not that of a vertex @/polygons/0/loop/3");
  EXPECT_EQ(error_after("[0,1,2,3]", "[0,1,-1]"),
            "3:40: index -1 is not that of a vertex @/polygons/0/loop/2");
  EXPECT_EQ(error_after("[0,1,2,3]", "[0,1,4294967296]"),
            "3:40: index 4294967296 is not that of a vertex @/polygons/0/loop/2");
  EXPECT_EQ(error_after("[0,1,2,3]", "[0,1,99999999999999999999999]"),
            "3:40: index 99999999999999999999999 is not that of a vertex @/polygons/0/loop/2");
  EXPECT_EQ(error_after("[0,1,2,3]", "[0,1,2.0]"),
            "3:40: '2.0' is not an integer @/polygons/0/loop/2");
  EXPECT_EQ(error_after("[0,1,2,3]", "[0,1,2e0]"),
            "3:40: '2e0' is not an integer @/polygons/0/loop/2");
  EXPECT_EQ(error_after("[0,1,2,3]", "[0,1]"), "3:35: a loop of 2 vertices @/polygons/0/loop");
  EXPECT_EQ(error_after("[0,1,2,3]", "[]"), "3:35: a loop of 0 vertices @/polygons/0/loop");
  EXPECT_EQ(error_after(", \"loop\": [0,1,2,3]", ""),
            "3:15: the key 'loop' is missing @/polygons/0");
  EXPECT_EQ(error_after("[0,1,2,3]", "[0,1,2,3], \"holes\": [[0,1,2],[0,1,9]]"),
            "3:69: index 9 is not that of a vertex @/polygons/0/holes/1/2");
  EXPECT_EQ(error_after("[0,1,2,3]", "[0,1,2,3], \"holes\": [[]]"), "ok");
  EXPECT_EQ(error_after("[0,1,2,3]", "[0,1,2,3], \"holes\": [0,1,2]"),
            "3:56: found a number @/polygons/0/holes/0");
  EXPECT_EQ(error_after("[0,1,2,3]", "[[0,1,2,3]]"), "3:36: found an array @/polygons/0/loop/0");
  EXPECT_EQ(error_after("[0,1,2,3]", "[0,1,2,3], \"casts\": null"),
            "3:55: found null @/polygons/0/casts");
  EXPECT_EQ(error_after("[[0,0,0],[4,0,0],[4,4,0],[0,4,0]]", "[]"),
            "3:36: index 0 is not that of a vertex @/polygons/0/loop/0");
}

TEST(ReadJson, Ids) {
  EXPECT_EQ(error_after("\"b\"", "\"a\""),
            "4:10: the id 'a' is that of /polygons/0 @/polygons/1/id");
  EXPECT_EQ(error_after("\"id\": \"b\", ", ""), "ok");
  // A default collides like any other.
  std::string text = changed("\"a\"", "\"1\"");
  text.erase(text.find("\"id\": \"b\", "), 11);
  EXPECT_EQ(error_of(text, "s.json"), "4:3: the id '1' is that of /polygons/0 @/polygons/1/id");
  EXPECT_EQ(error_after("\"b\"", "\"\""), "4:10: an empty id @/polygons/1/id");
  EXPECT_EQ(error_after("\"b\"", "\"b#\""),
            "4:10: the id 'b#' holds '#' or a control character @/polygons/1/id");
  EXPECT_EQ(error_after("\"b\"", "\"b\\u0007\""),
            "4:10: the id 'b\\x07' holds '#' or a control character @/polygons/1/id");
  EXPECT_EQ(error_after("\"b\"", "\"b\\u0000c\""),
            "4:10: the id 'b\\x00c' holds '#' or a control character @/polygons/1/id");
  EXPECT_EQ(error_after("\"b\"", "\"b\\u0085\""),
            "4:10: the id 'b\\xC2\\x85' holds '#' or a control character @/polygons/1/id");
  EXPECT_EQ(error_after("\"b\"", "7"), "4:10: found a number @/polygons/1/id");
  EXPECT_EQ(error_after("\"sun\"", "\"bulb\""),
            "6:10: the id 'bulb' is that of /lights/0 @/lights/1/id");
  // Polygons and lights have ids of their own.
  EXPECT_EQ(error_after("\"sun\"", "\"a\""), "ok");
}

TEST(ReadJson, Lights) {
  EXPECT_EQ(error_after("\"type\": \"point\", ", ""), "5:13: the key 'type' is missing @/lights/0");
  EXPECT_EQ(error_after("\"point\"", "\"spot\""), "5:36: light type 'spot' @/lights/0/type");
  EXPECT_EQ(error_after("\"point\"", "\"directional\""),
            "5:13: the key 'to_light' is missing @/lights/0");
  EXPECT_EQ(error_after("\"position\": [1,1,3]", "\"position\": [1,1,3], \"to_light\": [1,1,1]"),
            "5:78: the key 'to_light' does not belong to this type of light @/lights/0/to_light");
  EXPECT_EQ(error_after("[0,0,1]", "[0,-0,0.0]"),
            "6:52: the direction to the light is (0, 0, 0) @/lights/1/to_light");
  EXPECT_EQ(error_after("[[0,0,3],[0,1,3],[1,1,3]]", "[[0,0,3],[0,1,3]]"),
            "7:43: a loop of 2 points @/lights/2/loop");
  EXPECT_EQ(error_after("[[0,0,3],[0,1,3],[1,1,3]]", "[[0,0,3],[0,1,3],[1,1]]"),
            "7:64: only 2 of three coordinates @/lights/2/loop/2/2");
  EXPECT_EQ(error_after("[[0,0,3],[0,1,3],[1,1,3]]", "[0,1,2]"),
            "7:44: found a number @/lights/2/loop/0");
  EXPECT_EQ(error_after("[1,1,3]", "[1,1]"),
            "5:61: only 2 of three coordinates @/lights/0/position/2");
  EXPECT_EQ(error_after("[1,1,3]", "[1,1,1e999]"),
            "5:62: '1e999' is too large for a double @/lights/0/position/2");
  EXPECT_EQ(error_after("[1,1,3]", "[1,1,3], \"intensity\": \"1\""),
            "5:79: found a string @/lights/0/intensity");
  EXPECT_EQ(error_after("[1,1,3]", "[1,1,3], \"intensity\": -1"),
            "5:79: a negative intensity @/lights/0/intensity");
}

TEST(ReadJson, LightsOnly) {
  const std::string lights =
      R"({"format": "gnomon-scene", "version": 1, "lights": [{"type": "point", "position": [1,2,3]}]})";
  EXPECT_EQ(error_of(lights, "l.json"), "1:1: the key 'vertices' is missing");
  ReadOptions options;
  options.lights_only = true;
  EXPECT_EQ(scene_of(lights, "l.json", options).lights.size(), 1u);
  EXPECT_THAT(error_of(changed("\"b\"", "\"b\""), "l.json", options),
              HasSubstr("polygons in a file of lights @/polygons"));
  EXPECT_EQ(error_of(R"({"format": "gnomon-scene", "version": 1})", "l.json", options),
            "1:1: the key 'lights' is missing");
  EXPECT_EQ(code_of("v 0 0 0\n", "l.obj", options), ErrorCode::kFormat);
}

TEST(ReadJson, Encodings) {
  const std::string good = changed("\"b\"", "\"b\"");
  std::string bad = changed("\"t\"", "\"t\xE9\"");
  EXPECT_EQ(error_of(bad, "s.json"), "1:52: this byte is not valid UTF-8");
  // A column counts characters.
  EXPECT_EQ(error_of("{\"\u00e4\u00f6\u00fc\": 1}", "s.json"),
            "1:2: unknown key '\u00e4\u00f6\u00fc' @/\u00e4\u00f6\u00fc");
  EXPECT_EQ(error_of("{\"extra\": \"\u00e4\u00f6\u00fc\", x}", "s.json"),
            "1:18: this is not a key");
  std::string utf16_le = "\xFF\xFE", utf16_be, utf16_plain;
  for (const char c : good) {
    utf16_le += std::string({c, '\0'});
    utf16_be += std::string({'\0', c});
    utf16_plain += std::string({c, '\0'});
  }
  for (const std::string& text : {utf16_le, utf16_be, utf16_plain}) {
    EXPECT_THAT(error_of(text, "s.json"), StartsWith("1:1: the file is not UTF-8"));
  }
  bad = good;
  bad[150] = '\0';
  EXPECT_THAT(error_of(bad, "s.json"), HasSubstr("a NUL byte"));
  for (const char* sequence :
       {"\xC0\x80", "\xED\xA0\x80", "\xF5\x80\x80\x80", "\xE2\x82", "\x80"}) {
    EXPECT_EQ(code_of(changed("\"t\"", std::string("\"") + sequence + "\""), "s.json"),
              ErrorCode::kSyntax);
  }
}

TEST(ReadJson, DeepNesting) {
  const std::size_t deep = 200000;
  const std::string brackets(deep, '[');
  EXPECT_EQ(error_of(brackets, "s.json"), "1:1: found an array");
  EXPECT_EQ(error_of(R"({"vertices": )" + brackets, "s.json"),
            "1:16: found an array @/vertices/0/0");
  const std::string in_extra = R"({"extra": )" + brackets + std::string(deep, ']') + "}";
  EXPECT_EQ(error_of(in_extra, "s.json"), "1:1011: nested too deeply @/extra");
  EXPECT_EQ(code_of(in_extra, "s.json"), ErrorCode::kLimit);
  const std::string fair = R"({"extra": )" + std::string(1000, '[') + std::string(1000, ']') + ",";
  EXPECT_EQ(scene_of(changed("{\"format\"", fair + "\"format\""), "s.json").extra.size(), 2000u);
}

TEST(ReadJson, ExtraIsKeptAsItStands) {
  for (const char* extra : {"{}", "[ 1 , 2.50 ]", "\"a \\\" } \\u00e4\"", "null", "true", "false",
                            "1e-9999", "{\"a\":{\"b\":[[],{}]}, \"a\": 1E+400}"}) {
    const Scene scene = scene_of(
        changed("\"name\"", std::string("\"extra\" : ") + extra + " , \"name\""), "s.json");
    EXPECT_EQ(scene.extra, extra);
  }
}

}  // namespace
}  // namespace gnomon
