// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

#include "scene_testing.h"

namespace gnomon {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string kHeader =
    "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 3\nproperty float x\n"
    "property float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\n"
    "end_header\n";
const std::string kAscii = kHeader + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

/// kAscii with one thing replaced.
std::string changed(const std::string& from, const std::string& to) {
  std::string text = kAscii;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string error_after(const std::string& from, const std::string& to) {
  return error_of(changed(from, to), "m.ply");
}

template <class Value>
void put(std::string& text, Value value, bool big_endian) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  if (big_endian != (std::endian::native == std::endian::big)) {
    std::reverse(bytes.begin(), bytes.end());
  }
  text += bytes;
}

struct BinaryMesh {
  bool big_endian = false;
  float odd = 0.1f;
  std::int32_t last_index = 2;
  std::uint8_t length = 3;
  const char* vertices = "3";

  std::string text() const {
    std::string text =
        std::string("ply\nformat binary_") + (big_endian ? "big" : "little") +
        "_endian 1.0\nelement camera 2\nproperty double f\nproperty list uchar short v\n"
        "element vertex " +
        vertices +
        "\nproperty uchar red\nproperty float x\nproperty double y\nproperty short z\n"
        "element face 1\nproperty list uint8 int32 vertex_index\nproperty uint flags\n"
        "end_header\n";
    for (int i = 0; i < 2; ++i) {
      put(text, 1.5, big_endian);
      put(text, static_cast<std::uint8_t>(i), big_endian);
      for (int k = 0; k < i; ++k) put(text, std::int16_t{7}, big_endian);
    }
    for (int i = 0; i < 3; ++i) {
      put(text, std::uint8_t{255}, big_endian);
      put(text, i == 1 ? odd : 0.f, big_endian);
      put(text, i == 2 ? 1e300 : 0.0, big_endian);
      put(text, static_cast<std::int16_t>(-i), big_endian);
    }
    put(text, length, big_endian);
    put(text, std::int32_t{0}, big_endian);
    put(text, std::int32_t{1}, big_endian);
    put(text, last_index, big_endian);
    put(text, std::uint32_t{9}, big_endian);
    return text;
  }
};

TEST(ReadPly, Ascii) {
  const Scene scene = scene_of(kAscii, "m.ply");
  ASSERT_EQ(scene.vertices.size(), 3u);
  EXPECT_EQ(scene.vertices[1][0], Number(1.0));
  EXPECT_THAT(scene.polygons[0].loop, ElementsAre(0, 1, 2));
  std::string windows;
  for (const char c : kAscii) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  expect_same_scene(scene_of(windows, "m.ply"), scene);
}

TEST(ReadPly, TextIsReadByItsMeaningWhateverTheType) {
  const std::string text = changed("1 0 0", "0.1 0 0");
  EXPECT_EQ(scene_of(text, "m.ply").vertices[1][0], Number(0.1));
  ReadOptions decimal;
  decimal.numbers = NumberMeaning::kDecimal;
  EXPECT_EQ(scene_of(text, "m.ply", decimal).vertices[1][0].exact(), mpq_class(1, 10));
}

TEST(ReadPly, BinaryOfBothOrders) {
  for (const bool big_endian : {false, true}) {
    for (const auto meaning : {NumberMeaning::kDouble, NumberMeaning::kDecimal}) {
      ReadOptions options;
      options.numbers = meaning;
      const Scene scene = scene_of(BinaryMesh{.big_endian = big_endian}.text(), "m.ply", options);
      ASSERT_EQ(scene.vertices.size(), 3u);
      // Exactly the float, whatever the meaning.
      EXPECT_EQ(scene.vertices[1][0].exact(), mpq_class(double{0.1f}));
      EXPECT_EQ(scene.vertices[2][1], Number(1e300));
      EXPECT_EQ(scene.vertices[2][2], Number(-2.0));
      EXPECT_THAT(scene.polygons[0].loop, ElementsAre(0, 1, 2));
    }
  }
}

TEST(ReadPly, FacesMayComeFirst) {
  const std::string text =
      "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_index\nelement vertex "
      "3\n"
      "property int z\nproperty int y\nproperty int x\nproperty float quality\nend_header\n"
      "3 2 1 0\n1 2 3 nan\n4 5 6 0\n7 8 9 0\n";
  const Scene scene = scene_of(text, "m.ply");
  EXPECT_EQ(scene.vertices[0][0], Number(3.0));
  EXPECT_EQ(scene.vertices[0][2], Number(1.0));
  EXPECT_THAT(scene.polygons[0].loop, ElementsAre(2, 1, 0));
}

TEST(ReadPly, Header) {
  EXPECT_EQ(error_of("", "m.ply"), "1:1: the file is empty");
  EXPECT_EQ(error_of("solid\n", "m.ply"), "1:1: the file does not begin with 'ply'");
  EXPECT_EQ(error_of("ply", "m.ply"), "1:1: the file does not begin with 'ply'");
  EXPECT_EQ(error_of("ply\nformat ascii 1.0\n", "m.ply"), "3:1: the header does not end");
  EXPECT_EQ(error_after("format ascii 1.0\n", ""), "9:1: a header without format");
  EXPECT_EQ(error_after("ascii", "text"), "2:8: format 'text'");
  EXPECT_EQ(error_after("ascii 1.0", "ascii 2.0"), "2:14: version '2.0'");
  EXPECT_EQ(error_after("ascii 1.0", "ascii"), "2:1: a line of 2 words");
  EXPECT_EQ(error_after("comment", "remark"), "3:1: 'remark' in the header");
  EXPECT_EQ(error_after("vertex 3", "vertex three"), "4:16: 'three' is not a count");
  EXPECT_EQ(error_after("vertex 3", "vertex -3"), "4:16: '-3' is not a count");
  EXPECT_EQ(error_after("vertex 3", "vertex"), "4:1: a line of 2 words");
  EXPECT_EQ(error_after("float x", "real x"), "5:10: unknown type 'real'");
  EXPECT_EQ(error_after("list uchar", "list float"), "9:15: a list whose length is not an integer");
  EXPECT_EQ(error_after("uchar int", "uchar float"),
            "8:14: 'vertex_indices' is no list of integers");
  EXPECT_EQ(error_after("list uchar int", "int"), "8:14: 'vertex_indices' is no list of integers");
  EXPECT_EQ(error_after("vertex_indices", "corners"), "8:14: a face without indices");
  EXPECT_EQ(error_after("float y", "float v"), "4:16: a vertex without y");
  EXPECT_EQ(error_after("float y", "float x"), "4:16: a second property 'x'");
  EXPECT_EQ(error_after("element face 1", "element vertex 1"), "8:9: a second element 'vertex'");
  EXPECT_EQ(error_after("element vertex 3\n", ""), "4:1: a property of no element");
  EXPECT_EQ(error_after("property float x", "property float"), "5:1: a line of 2 words");
}

TEST(ReadPly, CountsBeyondTheFile) {
  EXPECT_EQ(error_after("vertex 3", "vertex 99999999999"),
            "4:16: 99999999999 elements 'vertex' announced");
  EXPECT_EQ(error_after("face 1", "face 9223372036854775807"),
            "8:14: 9223372036854775807 elements 'face' announced");
  EXPECT_THAT(error_after("vertex 3", "vertex 99999999999999999999"), HasSubstr("is not a count"));
  EXPECT_EQ(error_of(BinaryMesh{.vertices = "4000000000"}.text(), "m.ply"),
            "6:16: 4000000000 elements 'vertex' announced");
  EXPECT_EQ(error_after("vertex 3", "vertex 4"),
            "15:1: the file ends too early: face 0 is not complete");
}

TEST(ReadPly, MalformedText) {
  EXPECT_EQ(error_after("1 0 0", "1 x 0"), "12:3: 'x' is not a number");
  EXPECT_EQ(error_after("1 0 0", "1 inf 0"), "12:3: 'inf' is not finite");
  EXPECT_EQ(error_after("3 0 1 2", "3 0 1 3"), "14:7: index 3 is not that of a vertex");
  EXPECT_EQ(error_after("3 0 1 2", "3 0 1 -1"), "14:7: index -1 is not that of a vertex");
  EXPECT_EQ(error_after("3 0 1 2", "3 0 1 1.0"), "14:7: '1.0' is not an integer");
  EXPECT_EQ(error_after("3 0 1 2", "2 0 1"), "14:1: a face of 2 vertices");
  EXPECT_EQ(error_after("3 0 1 2", "-3 0 1 2"), "14:1: a list of -3 values");
  EXPECT_EQ(error_after("3 0 1 2\n", "9 0 1 2"),
            "14:8: the file ends too early: face 0 is not complete");
  EXPECT_EQ(error_of(kAscii + "7", "m.ply"), "15:1: '7' after the last element");
  EXPECT_EQ(error_of(kAscii + std::string("\0", 1), "m.ply"), "15:1: a NUL byte");
}

TEST(ReadPly, MalformedBinary) {
  const std::string good = BinaryMesh{}.text();
  const std::size_t header = good.find("end_header\n") + 11;
  for (std::size_t size = header; size < good.size(); ++size) {
    const auto result = parse_scene(good.substr(0, size), "m.ply", {});
    ASSERT_FALSE(result) << size;
  }
  EXPECT_THAT(error_of(good.substr(0, good.size() - 16), "m.ply"), HasSubstr("announced"));
  EXPECT_THAT(error_of(good.substr(0, good.size() - 1), "m.ply"),
              HasSubstr("0:0: the file ends too early: face 0 is not complete (byte "));
  EXPECT_THAT(error_of(BinaryMesh{.length = 200}.text(), "m.ply"), HasSubstr("0:0: "));
  EXPECT_THAT(error_of(BinaryMesh{.last_index = 3}.text(), "m.ply"),
              HasSubstr("0:0: index 3 is not that of a vertex (byte "));
  EXPECT_THAT(error_of(BinaryMesh{.last_index = -1}.text(), "m.ply"),
              HasSubstr("index -1 is not that of a vertex (byte "));
  EXPECT_THAT(error_of(BinaryMesh{.odd = std::numeric_limits<float>::quiet_NaN()}.text(), "m.ply"),
              HasSubstr("0:0: a coordinate of vertex 1 is not finite (byte "));
  EXPECT_EQ(code_of(BinaryMesh{.odd = std::numeric_limits<float>::infinity()}.text(), "m.ply"),
            ErrorCode::kNumber);
  const auto longer = parse_scene(good + "xyz", "m.ply", {});
  ASSERT_TRUE(longer);
  EXPECT_THAT(longer->warnings, ElementsAre("3 bytes after the last element ignored"));
}

TEST(ReadPly, ElementsWithoutPropertiesTakeNoTime) {
  std::string text = kAscii;
  text.replace(text.find("element vertex"), 0, "element nothing 9000000000000000000\n");
  EXPECT_EQ(scene_of(text, "m.ply").polygons.size(), 1u);
}

TEST(ReadPly, NamesOfTheFileAreQuotedInMessages) {
  const std::string text =
      "ply\nformat ascii 1.0\nelement e\x1b[2J 2\nproperty list uchar int a\nend_header\n0\n2 7\n";
  EXPECT_EQ(error_of(text, "m.ply"),
            "8:1: the file ends too early: element 'e\\x1B[2J' 1 is not complete");
}

// Comparing each with all before it took a minute.
TEST(ReadPly, ManyElements) {
  std::string text = "ply\nformat ascii 1.0\n";
  for (int i = 0; i < 200'000; ++i) text += "element a 0\n";
  text += kHeader.substr(kHeader.find("element"));
  EXPECT_EQ(scene_of(text + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "m.ply").polygons.size(), 1u);
}

}  // namespace
}  // namespace gnomon
