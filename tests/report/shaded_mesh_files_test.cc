// SPDX-License-Identifier: GPL-3.0-or-later
// Shaded meshes as files: PLY read back by the project's reader, glTF taken apart byte by byte.
#include "report/meshes/shaded_mesh_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidjson/document.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "gnomon/algorithms/shadows.h"
#include "gnomon/scene/read.h"

namespace gnomon::report {
namespace {

constexpr const char* kTable = R"({"format": "gnomon-scene", "version": 1, "name": "table",
  "vertices": [[10,0,0],[14,0,0],[14,4,0],[10,4,0],[11,1,1],[12,1,1],[12,2,1],[11,2,1]],
  "polygons": [{"id": "floor", "loop": [0,1,2,3]},
               {"id": "top", "loop": [4,5,6,7], "two_sided": true}],
  "lights": [{"id": "panel", "type": "area", "loop": [[11,1,3],[11,2,3],[12,2,3],[12,1,3]]}]})";

struct Shaded {
  Scene scene;
  PreparedScene prepared;
  ShadingMesh mesh;
};

Shaded shaded() {
  auto read = parse_scene(kTable, "table.json");
  auto prepared = prepare(read->scene);
  ShadowOptions options;
  options.output.exact_points = true;
  const auto result = compute_shadows(*prepared, options);
  EXPECT_TRUE(result) << (result ? "" : to_string(result.error()));
  ShadingOptions shading;
  shading.lit_step = 1;
  shading.penumbra_step = mpq_class(1, 2);
  shading.ambient = 0.125;
  auto mesh = make_shading_mesh(
      *prepared, *result,
      [](const ShadeRequest& asked) {
        return PointShade{(asked.unobstructed ? 2 : 1) / (1 + asked.point[1].get_d()), 0};
      },
      shading);
  EXPECT_TRUE(mesh);
  return {std::move(read->scene), *std::move(prepared), *std::move(mesh)};
}

std::string text_of(const Shaded& one, MeshFileFormat format,
                    const ShadedMeshOptions& options = {}) {
  auto text = shaded_mesh_text(one.scene, one.prepared, one.mesh, format, options);
  EXPECT_TRUE(text);
  return *std::move(text);
}

std::size_t triangle_count(const ShadingMesh& mesh) {
  std::size_t count = 0;
  for (const MeshFace& face : mesh.faces) count += face.count - 2;
  return count;
}

TEST(ShadedMeshFiles, FormatsByExtension) {
  EXPECT_EQ(mesh_file_format("a/b.ply"), MeshFileFormat::kPly);
  EXPECT_EQ(mesh_file_format("b.GLTF"), MeshFileFormat::kGltf);
  EXPECT_EQ(mesh_file_format("b.glb"), MeshFileFormat::kGlb);
  const auto wrong = mesh_file_format("b.obj");
  ASSERT_FALSE(wrong);
  EXPECT_EQ(to_string(wrong.error()),
            "b.obj: no format of shaded meshes has this extension; expected .ply, .gltf or .glb");
}

TEST(ShadedMeshFiles, PlyReadsBack) {
  const Shaded one = shaded();
  const std::string text = text_of(one, MeshFileFormat::kPly);
  const auto read = parse_scene(text, "mesh.ply");
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_THAT(read->warnings, testing::IsEmpty());
  EXPECT_EQ(read->scene.vertices.size(), one.mesh.samples.size());
  EXPECT_EQ(read->scene.polygons.size(), triangle_count(one.mesh));
  // The same points, and as triangles the same area: 16 of the floor, 1 of either side of the top.
  std::set<std::array<double, 3>> points, expected(one.mesh.points.begin(), one.mesh.points.end());
  for (const Position& position : read->scene.vertices) {
    points.insert({position[0].nearest(), position[1].nearest(), position[2].nearest()});
  }
  EXPECT_EQ(points, expected);
  double area = 0;
  for (const Polygon& triangle : read->scene.polygons) {
    ASSERT_EQ(triangle.loop.size(), 3u);
    std::array<std::array<double, 2>, 3> p;
    for (std::size_t i = 0; i < 3; ++i) {
      const Position& position = read->scene.vertices[triangle.loop[i]];
      p[i] = {position[0].nearest(), position[1].nearest()};
    }
    area += std::fabs((p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) -
                      (p[1][1] - p[0][1]) * (p[2][0] - p[0][0])) /
            2;
  }
  EXPECT_NEAR(area, 18, 1e-9);
  EXPECT_TRUE(prepare(read->scene));
}

TEST(ShadedMeshFiles, PlainPlyHasFloatsAndNoNumbersOfFaces) {
  const Shaded one = shaded();
  ShadedMeshOptions options;
  options.plain_ply = true;
  const std::string text = text_of(one, MeshFileFormat::kPly, options);
  const std::string header = text.substr(0, text.find("end_header\n") + 11);
  EXPECT_THAT(header, testing::HasSubstr("property float x\nproperty float y\nproperty float z\n"));
  EXPECT_THAT(header, testing::EndsWith("property list uchar int vertex_indices\nend_header\n"));
  EXPECT_EQ(text.size(),
            header.size() + 19 * one.mesh.samples.size() + 13 * triangle_count(one.mesh));
  const auto read = parse_scene(text, "mesh.ply");
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_EQ(read->scene.vertices.size(), one.mesh.samples.size());
  EXPECT_EQ(read->scene.polygons.size(), triangle_count(one.mesh));
}

TEST(ShadedMeshFiles, ColoursOfPlyAreTheIllumination) {
  const Shaded one = shaded();
  ShadedMeshOptions options;
  options.exposure = 0.25;
  const std::string text = text_of(one, MeshFileFormat::kPly, options);
  std::size_t at = text.find("end_header\n") + 11;
  for (std::size_t s = 0; s < one.mesh.samples.size(); ++s, at += 31) {
    float quality = 0;
    std::memcpy(&quality, text.data() + at + 27, sizeof quality);
    const auto red = static_cast<unsigned char>(text[at + 24]);
    EXPECT_EQ(red, srgb_byte(0.25 * static_cast<double>(quality)));
    EXPECT_EQ(red, static_cast<unsigned char>(text[at + 25]));
    EXPECT_GE(quality, 0.125f);
  }
  // Faces: 3 indices, polygon, side, class.
  std::map<std::array<int, 3>, std::size_t> kinds;
  for (std::size_t t = 0; t < triangle_count(one.mesh); ++t, at += 19) {
    EXPECT_EQ(text[at], 3);
    ++kinds[{text[at + 13], text[at + 17], text[at + 18]}];
  }
  EXPECT_EQ(at, text.size());
  EXPECT_TRUE(kinds.contains({0, 0, 0}));
  EXPECT_TRUE(kinds.contains({0, 0, 1}));
  EXPECT_TRUE(kinds.contains({0, 0, 2}));
  EXPECT_TRUE(kinds.contains({1, 0, 0}));
  EXPECT_TRUE(kinds.contains({1, 1, 2}));
}

TEST(ShadedMeshFiles, SrgbBytes) {
  EXPECT_EQ(srgb_byte(-1), 0);
  EXPECT_EQ(srgb_byte(0), 0);
  EXPECT_EQ(srgb_byte(0.001), 3);
  EXPECT_EQ(srgb_byte(0.2140411), 127);
  EXPECT_EQ(srgb_byte(1), 255);
  EXPECT_EQ(srgb_byte(7), 255);
}

std::string decoded(const std::string& uri) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned group = 0, bits = 0;
  for (const char c : uri.substr(uri.find(',') + 1)) {
    if (c == '=') break;
    group = group << 6 | static_cast<unsigned>(digits.find(c));
    bits += 6;
    if (bits >= 8) bytes += static_cast<char>(group >> (bits -= 8) & 0xff);
  }
  return bytes;
}

/// Everything that glTF 2.0 asks of what we write.
void check_gltf(const std::string& json, const std::string& bytes, const Shaded& one) {
  rapidjson::Document document;
  document.Parse(json.c_str());
  ASSERT_FALSE(document.HasParseError()) << json.substr(0, 300);
  EXPECT_STREQ(document["asset"]["version"].GetString(), "2.0");
  EXPECT_STREQ(document["scenes"][0]["name"].GetString(), "table");
  EXPECT_EQ(document["scenes"][0]["nodes"][0].GetUint(), 0u);
  const auto& node = document["nodes"][0];
  EXPECT_EQ(node["mesh"].GetUint(), 0u);
  EXPECT_EQ(document["buffers"][0]["byteLength"].GetUint(), bytes.size());
  std::size_t end = 0;
  const auto& views = document["bufferViews"];
  const auto& accessors = document["accessors"];
  ASSERT_EQ(views.Size(), 3u);
  ASSERT_EQ(accessors.Size(), 3u);
  for (rapidjson::SizeType i = 0; i < 3; ++i) {
    EXPECT_EQ(views[i]["byteOffset"].GetUint(), end);
    EXPECT_EQ(end % 4, 0u);
    EXPECT_EQ(accessors[i]["bufferView"].GetUint(), i);
    const std::size_t size = std::string(accessors[i]["type"].GetString()) == "VEC3" ? 12 : 4;
    EXPECT_EQ(views[i]["byteLength"].GetUint(), size * accessors[i]["count"].GetUint());
    end += views[i]["byteLength"].GetUint();
  }
  EXPECT_EQ(end, bytes.size());
  const auto& primitive = document["meshes"][0]["primitives"][0];
  EXPECT_EQ(primitive["attributes"]["POSITION"].GetUint(), 0u);
  EXPECT_EQ(primitive["attributes"]["COLOR_0"].GetUint(), 1u);
  EXPECT_EQ(primitive["indices"].GetUint(), 2u);
  const std::size_t vertices = accessors[0]["count"].GetUint();
  EXPECT_EQ(vertices, one.mesh.samples.size());
  EXPECT_EQ(accessors[1]["count"].GetUint(), vertices);
  EXPECT_EQ(accessors[2]["count"].GetUint(), 3 * triangle_count(one.mesh));

  const auto float_at = [&](std::size_t i) {
    float value = 0;
    std::memcpy(&value, bytes.data() + 4 * i, 4);
    return value;
  };
  std::array<float, 3> low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};
  std::array<double, 3> moved{};
  for (rapidjson::SizeType k = 0; k < 3; ++k) moved[k] = node["translation"][k].GetDouble();
  std::set<std::array<double, 3>> points;
  for (std::size_t v = 0; v < vertices; ++v) {
    std::array<double, 3> p{};
    for (std::size_t k = 0; k < 3; ++k) {
      const float x = float_at(3 * v + k);
      low[k] = std::min(low[k], x);
      high[k] = std::max(high[k], x);
      p[k] = static_cast<double>(x);
      EXPECT_GE(float_at(3 * vertices + 3 * v + k), 0.0f);
      EXPECT_LE(float_at(3 * vertices + 3 * v + k), 1.0f);
    }
    // The turn of the node, and back to scene coordinates.
    points.insert({p[0] + moved[0], p[1] - moved[2], p[2] + moved[1]});
  }
  for (rapidjson::SizeType k = 0; k < 3; ++k) {
    EXPECT_EQ(static_cast<float>(accessors[0]["min"][k].GetDouble()), low[k]);
    EXPECT_EQ(static_cast<float>(accessors[0]["max"][k].GetDouble()), high[k]);
  }
  EXPECT_EQ(points.size(), one.mesh.points.size());
  for (const auto& point : one.mesh.points) {
    EXPECT_TRUE(std::ranges::any_of(points, [&](const auto& p) {
      return std::hypot(p[0] - point[0], p[1] - point[1], p[2] - point[2]) < 1e-6;
    }));
  }
  for (std::size_t i = 0; i < accessors[2]["count"].GetUint(); ++i) {
    EXPECT_LT(std::bit_cast<std::uint32_t>(float_at(6 * vertices + i)), vertices);
  }
}

TEST(ShadedMeshFiles, GltfHoldsTogether) {
  const Shaded one = shaded();
  const std::string text = text_of(one, MeshFileFormat::kGltf);
  rapidjson::Document document;
  document.Parse(text.c_str());
  ASSERT_FALSE(document.HasParseError());
  const std::string uri = document["buffers"][0]["uri"].GetString();
  EXPECT_THAT(uri, testing::StartsWith("data:application/octet-stream;base64,"));
  check_gltf(text, decoded(uri), one);
}

TEST(ShadedMeshFiles, GlbIsTheSame) {
  const Shaded one = shaded();
  const std::string text = text_of(one, MeshFileFormat::kGlb);
  const auto word = [&](std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, text.data() + at, 4);
    return value;
  };
  EXPECT_EQ(text.substr(0, 4), "glTF");
  EXPECT_EQ(word(4), 2u);
  EXPECT_EQ(word(8), text.size());
  EXPECT_EQ(word(12) % 4, 0u);
  EXPECT_EQ(text.substr(16, 4), "JSON");
  const std::string json = text.substr(20, word(12));
  const std::size_t chunk = 20 + word(12);
  EXPECT_EQ(word(chunk), text.size() - chunk - 8);
  EXPECT_EQ(text.substr(chunk + 4, 4), std::string("BIN\0", 4));
  check_gltf(json, text.substr(chunk + 8), one);
}

TEST(ShadedMeshFiles, TintsTellClassesApart) {
  const Shaded one = shaded();
  ShadedMeshOptions options;
  options.tint = true;
  const auto read = parse_scene(text_of(one, MeshFileFormat::kPly, options), "mesh.ply");
  ASSERT_TRUE(read);
  // Vertices where lit and penumbra faces meet are there twice.
  EXPECT_GT(read->scene.vertices.size(), one.mesh.samples.size());
  options.exposure = 1;
  const std::array<double, 3> lit = shade_colour(0.5, {0, Side::kFront, 1, 0, 0, 0}, options);
  const std::array<double, 3> umbra = shade_colour(0.0, {0, Side::kFront, 0, 0, 0, 0}, options);
  EXPECT_GT(lit[0], lit[2]);
  EXPECT_LT(umbra[0], umbra[2]);
  EXPECT_GT(umbra[2], 0.0);
}

TEST(ShadedMeshFiles, AMeshWithoutFacesIsValidToo) {
  Shaded one = shaded();
  one.mesh = {};
  const std::string text = text_of(one, MeshFileFormat::kGltf);
  rapidjson::Document document;
  document.Parse(text.c_str());
  ASSERT_FALSE(document.HasParseError()) << text;
  EXPECT_FALSE(document.HasMember("buffers"));
  EXPECT_TRUE(parse_scene(text_of(one, MeshFileFormat::kPly), "mesh.ply"));
}

}  // namespace
}  // namespace gnomon::report
