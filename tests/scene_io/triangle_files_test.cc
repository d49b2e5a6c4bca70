// SPDX-License-Identifier: GPL-3.0-or-later
// glTF and STL: exact numbers, where nodes stand, ways to draw triangles, buffers, and where each
// kind of bad file goes wrong.
#include <gmock/gmock.h>

#include <bit>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "gnomon/scene/digest.h"
#include "scene_testing.h"
#include "shown_scene.h"

namespace gnomon {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

template <class Value>
void append(std::string& bytes, Value value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);  // tests run where low bytes come first
  bytes.append(raw, sizeof value);
}

std::string floats(const std::vector<float>& values) {
  std::string bytes;
  for (const float value : values) append(bytes, value);
  return bytes;
}

// --------------------------------------------------------------------------------------------- STL

std::string binary_stl(const std::vector<float>& corners, const std::string& head = "made up") {
  std::string bytes = head + std::string(80 - head.size(), ' ');
  append(bytes, static_cast<std::uint32_t>(corners.size() / 9));
  for (std::size_t i = 0; i < corners.size(); i += 9) {
    bytes += floats({0, 0, 1});
    bytes += floats({corners.begin() + static_cast<std::ptrdiff_t>(i),
                     corners.begin() + static_cast<std::ptrdiff_t>(i + 9)});
    append(bytes, std::uint16_t{0});
  }
  return bytes;
}

TEST(Stl, BinaryFloatsAreExactAndVerticesAreOne) {
  const std::vector<float> corners = {0,    0, 0,     0.1F, 0, 0, 0, 1, 0,
                                      0.1F, 0, -0.0F, 1,    1, 0, 0, 1, 0};
  const Scene scene = scene_of(binary_stl(corners), "a.stl");
  EXPECT_EQ(scene.numbers, NumberMeaning::kDouble);
  EXPECT_EQ(scene.vertices.size(), 4u);
  EXPECT_THAT(ids_of(scene), ElementsAre("0", "1"));
  EXPECT_EQ(scene.vertices[1][0], Number(static_cast<double>(0.1F)));
  // Some writers begin the header of a binary file with the word of the other kind.
  expect_same_geometry(scene_of(binary_stl(corners, "solid x"), "a.stl"), scene);
  // The name need not tell.
  expect_same_geometry(scene_of(binary_stl(corners), "a"), scene);
}

TEST(Stl, BinaryFilesAreReadToTheirEnd) {
  std::vector<float> corners;
  for (int i = 0; i < 3000; ++i) {
    const auto x = static_cast<float>(i);
    corners.insert(corners.end(), {x, 0, 0, x + 1, 0, 0, x, 1, 0});
  }
  const std::string path = ::testing::TempDir() + "large.stl";
  std::ofstream(path, std::ios::binary) << binary_stl(corners);
  const auto result = read_scene(path);
  ASSERT_TRUE(result) << to_string(result.error());
  EXPECT_EQ(result->scene.polygons.size(), 3000u);
}

const std::string kFacet =
    "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 0.1 0 0\n  vertex 0 1e-1 0\n "
    "endloop\n"
    "endfacet\n";

TEST(Stl, AsciiIsText) {
  const ReadResult result = read_text(
      "solid one two\n" + kFacet + kFacet + "endsolid one two\nsolid b\n" + kFacet + "endsolid\n",
      "a.stl");
  EXPECT_THAT(result.warnings, IsEmpty());
  EXPECT_EQ(result.scene.polygons.size(), 3u);
  EXPECT_EQ(result.scene.vertices.size(), 3u);
  EXPECT_EQ(loop_of(result.scene, "2"), "(0, 0, 0) (0.1, 0, 0) (0, 0.1, 0)");
  EXPECT_THAT(read_text("solid\nendsolid\n", "a.stl").warnings,
              ElementsAre("the scene has no polygons"));
}

/// As some programs write them; others mix both.
TEST(Stl, WordsInCapitals) {
  std::string capitals = "solid one\n" + kFacet + "endsolid one\n";
  for (char& c : capitals) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  const std::string mixed =
      "solid one\nfacet NORMAL 0 0 1\nOuter Loop\nvertex 0 0 0\nVERTEX 0.1 0 0\n"
      "vertex 0 0.1 0\nENDLOOP\nEndFacet\nENDSOLID\n";
  for (const std::string& text : {capitals, mixed}) {
    for (const char* name : {"a.stl", "a"}) {
      const ReadResult result = read_text(text, name);
      EXPECT_THAT(result.warnings, IsEmpty());
      EXPECT_EQ(loop_of(result.scene, "0"), "(0, 0, 0) (0.1, 0, 0) (0, 0.1, 0)");
    }
  }
  EXPECT_EQ(error_of("SOLID a\nFACETS\n", "a.stl"), "2:1: found 'FACETS'");
}

TEST(Stl, ErrorsNameTheirPlace) {
  const auto error = [](const std::string& text) { return error_of(text, "a.stl"); };
  EXPECT_EQ(error("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 x\n"),
            "4:12: 'x' is not a number");
  EXPECT_EQ(error("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0\nendloop\n"),
            "5:1: 'endloop' is not a number");
  EXPECT_EQ(error("solid a\n" + kFacet + "edge\n"), "9:1: found 'edge'");
  EXPECT_EQ(error("solid a\nfacet normal 0 0 1\n"), "3:1: the file ends inside a facet");
  EXPECT_EQ(error(""), "1:1: the file is empty");
  std::string cut = binary_stl({0, 0, 0, 1, 0, 0, 0, 1, 0});
  cut.pop_back();
  EXPECT_THAT(error(cut), HasSubstr("a binary STL of 133 bytes"));
  std::string nan = binary_stl({0, 0, 0, 1, 0, 0, 0, 1, 0});
  nan.replace(96, 4, floats({std::bit_cast<float>(0x7fc00000U)}));
  EXPECT_EQ(error(nan), "0:0: a coordinate is no finite number (byte 96)");
  ReadOptions options;
  options.skip_bad = true;
  EXPECT_EQ(read_text(nan, "a.stl", options).left_out.size(), 1u);
}

// -------------------------------------------------------------------------------------------- glTF

std::string base64(const std::string& bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned three = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const unsigned byte = i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0;
      three = three << 8 | byte;
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += k > bytes.size() - i ? '=' : kDigits[three >> (18 - 6 * k) & 63];
    }
  }
  return text;
}

/// Two triangles of a unit square, of which `node` says where it stands.
std::string gltf(const std::string& node, const std::string& primitive = "", int mode = 4,
                 const std::string& uri = "",
                 const std::vector<float>& corners = {0, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 1}) {
  std::string bytes = floats(corners);
  std::vector<std::uint16_t> indices = {0, 1, 2, 0, 2, 3};
  if (mode == 5) indices = {0, 1, 3, 2};
  if (mode == 6) indices = {0, 1, 2, 3};
  for (const std::uint16_t index : indices) append(bytes, index);
  const std::string buffer =
      uri == "none" ? ""
      : uri.empty() ? R"(, "uri": "data:application/octet-stream;base64,)" + base64(bytes) + "\""
                    : R"(, "uri": ")" + uri + "\"";
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
 "nodes": [{"name": "slab", "mesh": 0)" +
         (node.empty() ? "" : ", " + node) + R"(}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "mode": )" +
         std::to_string(mode) + primitive + R"(}]}],
 "materials": [{"name": "glass", "doubleSided": true}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
               {"bufferView": 1, "componentType": 5123, "count": )" +
         std::to_string(indices.size()) + R"(, "type": "SCALAR"}],
 "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": )" +
         std::to_string(2 * indices.size()) + R"(}],
 "buffers": [{"byteLength": )" +
         std::to_string(bytes.size()) + buffer + "}]}";
}

TEST(Gltf, IsTurnedUpAndNamedByItsNodes) {
  const ReadResult result = read_text(gltf(""), "a.gltf");
  EXPECT_THAT(result.warnings, IsEmpty());
  const Scene& scene = result.scene;
  EXPECT_EQ(scene.numbers, NumberMeaning::kDouble);
  EXPECT_THAT(ids_of(scene), ElementsAre("slab/0", "slab/1"));
  EXPECT_EQ(loop_of(scene, "slab/0"), "(0, 0, 0) (1, 0, 0) (1, -1, 0)");
  EXPECT_FALSE(scene.is_two_sided(scene.polygons[0]));
  ReadOptions as_it_stands;
  as_it_stands.up = UpAxis::kZ;
  EXPECT_EQ(loop_of(scene_of(gltf(""), "a.gltf", as_it_stands), "slab/0"),
            "(0, 0, 0) (1, 0, 0) (1, 0, 1)");
  const Scene glass = scene_of(gltf("", R"(, "material": 0)"), "a.gltf");
  EXPECT_TRUE(glass.is_two_sided(glass.polygons[0]));
  EXPECT_THAT(glass.extra, HasSubstr(R"("glass":["slab/0","slab/1"])"));
}

TEST(Gltf, StripsAndFansDrawTheSame) {
  EXPECT_EQ(loop_of(scene_of(gltf("", "", 6), "a.gltf"), "slab/0"),
            "(1, 0, 0) (1, -1, 0) (0, 0, 0)");
  const Scene strip = scene_of(gltf("", "", 5), "a.gltf");
  EXPECT_EQ(loop_of(strip, "slab/0"), "(0, 0, 0) (1, 0, 0) (0, -1, 0)");
  EXPECT_EQ(loop_of(strip, "slab/1"), "(1, 0, 0) (1, -1, 0) (0, -1, 0)");
  EXPECT_THAT(read_text(gltf("", "", 1), "a.gltf").warnings,
              ElementsAre(HasSubstr("1 primitive of points or lines"), HasSubstr("no polygons")));
}

std::string first_loop(const std::string& node) {
  ReadOptions as_it_stands;
  as_it_stands.up = UpAxis::kZ;
  const Scene scene = scene_of(gltf(node), "a.gltf", as_it_stands);
  return scene.polygons.empty() ? "" : shown(scene, scene.polygons[0].loop);
}

TEST(Gltf, NodesStandExactly) {
  EXPECT_EQ(first_loop(R"("translation": [1, 2.5, 3], "scale": [2, 1, 4])"),
            "(1, 2.5, 3) (3, 2.5, 3) (3, 2.5, 7)");
  EXPECT_EQ(first_loop(R"("matrix": [0,1,0,0, -1,0,0,0, 0,0,1,0, 5,6,7,1])"),
            "(5, 6, 7) (5, 7, 7) (5, 7, 8)");
  // A quarter turn about x is exact, whatever its quaternion was rounded to.
  EXPECT_EQ(first_loop(R"("rotation": [0.70710677, 0, 0, 0.70710677])"),
            "(0, 0, 0) (1, 0, 0) (1, -1, 0)");
  // Mirrored: the front stays the front.
  EXPECT_EQ(first_loop(R"("scale": [-1, 1, 1])"), "(0, 0, 0) (-1, 0, 1) (-1, 0, 0)");
}

TEST(Gltf, WhatDoublesDoNotHoldIsDecimal) {
  // 0.1 as a float, times itself and on: 24 bits more a level.
  const ReadResult result =
      read_text(gltf(R"("scale": [0.1, 1, 1], "translation": [1048576.5, 0, 0])", "", 4, "",
                     {0, 0, 0, 0.1F, 0, 0, 1, 0, 1, 0, 0, 1}),
                "a.gltf");
  EXPECT_EQ(result.scene.numbers, NumberMeaning::kDecimal);
  EXPECT_THAT(result.warnings.back(), HasSubstr("the numbers are decimals"));
  const mpq_class tenth(static_cast<double>(0.1F));
  EXPECT_EQ(result.scene.vertices[1][0].exact(), mpq_class(tenth * tenth + mpq_class(1048576.5)));
}

TEST(Gltf, QuaternionsAreToldOf) {
  const ReadResult result =
      read_text(gltf(R"("rotation": [0, 0, 0.38268343, 0.92387953])"), "a.gltf");
  EXPECT_THAT(result.warnings[0], HasSubstr("1 node is turned by quaternions of rounded numbers"));
  EXPECT_NEAR(result.scene.vertices[1][0].nearest(), 0.70710678, 1e-7);
}

TEST(Gltf, ParentsAreOutside) {
  std::string text = gltf(R"("translation": [1, 0, 0], "children": [1])");
  const std::string nodes = "\"children\": [1]}";
  text.insert(text.find(nodes) + nodes.size(),
              R"(, {"name": "second", "mesh": 0, "scale": [2, 2, 2]})");
  ReadOptions as_it_stands;
  as_it_stands.up = UpAxis::kZ;
  const Scene scene = scene_of(text, "a.gltf", as_it_stands);
  EXPECT_THAT(ids_of(scene), ElementsAre("slab/0", "slab/1", "second/0", "second/1"));
  EXPECT_EQ(loop_of(scene, "second/0"), "(1, 0, 0) (3, 0, 0) (3, 0, 2)");
  std::string cycle = gltf(R"("children": [0])");
  EXPECT_THAT(error_of(cycle, "a.gltf"), HasSubstr("a node of two parents"));
}

std::string chunk(const std::string& type, std::string content) {
  while (content.size() % 4 != 0) content += type == "JSON" ? ' ' : '\0';
  std::string bytes;
  append(bytes, static_cast<std::uint32_t>(content.size()));
  return bytes + type + content;
}
std::string glb(const std::string& json, const std::string& binary) {
  std::string body = chunk("JSON", json) + chunk(std::string("BIN\0", 4), binary);
  std::string bytes = "glTF";
  append(bytes, std::uint32_t{2});
  append(bytes, static_cast<std::uint32_t>(body.size() + 12));
  return bytes + body;
}
std::string buffer_of_square() {
  std::string bytes = floats({0, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 1});
  for (const std::uint16_t index : {0, 1, 2, 0, 2, 3}) append(bytes, index);
  return bytes;
}

TEST(Gltf, BinaryFilesAndFilesBeside) {
  const Scene wanted = scene_of(gltf(""), "a.gltf");
  const std::string binary = glb(gltf("", "", 4, "none"), buffer_of_square());
  expect_same_geometry(scene_of(binary, "a.glb"), wanted);
  const auto folder = std::filesystem::path(::testing::TempDir()) / "gnomon_gltf";
  std::filesystem::create_directories(folder / "data");
  std::ofstream(folder / "a.glb", std::ios::binary) << binary;
  std::ofstream(folder / "data" / "a b.bin", std::ios::binary) << buffer_of_square();
  std::ofstream(folder / "a.gltf") << gltf("", "", 4, "data/a%20b.bin");
  std::ofstream(folder / "out.gltf") << gltf("", "", 4, "../a.bin");
  std::ofstream(folder / "none.gltf") << gltf("", "", 4, "none.bin");
  for (const char* name : {"a.glb", "a.gltf"}) {
    const auto result = read_scene(folder / name);
    ASSERT_TRUE(result) << to_string(result.error());
    expect_same_geometry(result->scene, wanted);
  }
  EXPECT_THAT(read_scene(folder / "out.gltf").error().what, HasSubstr("outside of"));
  EXPECT_THAT(read_scene(folder / "none.gltf").error().what, HasSubstr("there is no file"));
  EXPECT_EQ(read_scene(folder / "none.gltf").error().where.pointer, "/buffers/0/uri");
  std::filesystem::remove_all(folder);
}

TEST(Gltf, ErrorsNameTheirPlace) {
  const std::string good = gltf("");
  const auto with = [&](const std::string& a, const std::string& b) {
    std::string text = good;
    const std::size_t at = text.find(a);
    EXPECT_NE(at, std::string::npos) << a;
    return text.replace(at, a.size(), b);
  };
  const auto error = [](const std::string& text) { return error_of(text, "a.gltf"); };
  EXPECT_THAT(error(with("\"2.0\"", "\"1.0\"")),
              HasSubstr("glTF of another version @/asset/version"));
  EXPECT_THAT(error(with("\"nodes\": [0]", "\"nodes\": [7]")),
              HasSubstr("there is no element 7 of nodes @/scenes/0/nodes/0"));
  EXPECT_THAT(
      error(with("\"count\": 4", "\"count\": 5")),
      HasSubstr("an accessor of 5 elements beyond the end of its bufferView @/accessors/0"));
  EXPECT_THAT(error(with("\"byteLength\": 48", "\"byteLength\": 480")),
              HasSubstr("a bufferView beyond the end of its buffer @/bufferViews/0"));
  EXPECT_THAT(error(with("base64,", "base64,!")), HasSubstr("no data in base64 @/buffers/0/uri"));
  EXPECT_THAT(error(with("5126", "5123")), HasSubstr("positions of component type 5123"));
  EXPECT_THAT(error(with("\"SCALAR\"", "\"VEC2\"")), HasSubstr("@/accessors/1/type"));
  EXPECT_THAT(
      error(with("\"scene\": 0", "\"extensionsRequired\": [\"KHR_draco_mesh_compression\"]")),
      HasSubstr("not read here @/extensionsRequired/0"));
  EXPECT_THAT(error(with("\"POSITION\"", "\"NORMAL\"")),
              HasSubstr("the key 'POSITION' is missing"));
  EXPECT_THAT(error(gltf(R"("matrix": [1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,2])")),
              HasSubstr("a matrix that is not affine @/nodes/0/matrix"));
  EXPECT_THAT(error(gltf(R"("rotation": [0, 0, 0, 7])")), HasSubstr("far from the length 1"));
  EXPECT_THAT(error(gltf("", "", 9)), HasSubstr("primitives of mode 9"));
  const auto binary_error = [](std::string bytes) { return error_of(bytes, "a.glb"); };
  const std::string binary = glb(gltf("", "", 4, "none"), buffer_of_square());
  EXPECT_THAT(binary_error(binary.substr(0, 15)),
              HasSubstr("the file ends in its header (byte 15)"));
  EXPECT_THAT(binary_error(binary + "x"), HasSubstr("(byte 8)"));
  std::string third = binary;
  third[4] = 3;
  EXPECT_THAT(binary_error(third), HasSubstr("binary glTF of version 3 (byte 4)"));
  ReadOptions options;
  options.skip_bad = true;
  std::vector<float> nan = {0, 0, 0, std::bit_cast<float>(0x7fc00000U), 0, 0, 1, 0, 1, 0, 0, 1};
  const ReadResult result = read_text(gltf("", "", 4, "", nan), "a.gltf", options);
  EXPECT_THAT(ids_of(result.scene), ElementsAre("slab/1"));
  EXPECT_EQ(result.left_out.size(), 1u);
}

}  // namespace
}  // namespace gnomon
