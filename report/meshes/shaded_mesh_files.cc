// SPDX-License-Identifier: GPL-3.0-or-later
// glTF is written by hand. The libraries that Debian has for it (tinygltf, assimp) are built to
// read every file there is, and write by copying the mesh into a model of theirs; tinygltf brings
// nlohmann-json and stb along. What we write is one buffer with three views, whose JSON is below.
#include "report/meshes/shaded_mesh_files.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "report/json/json_writer.h"
#include "report/meshes/glb.h"
#include "report/text/little_endian.h"
#include "report/text/text_sink.h"
#include "scene/base/ascii_case.h"

namespace gnomon::report {

namespace {

using Colour = std::array<double, 3>;

void append(std::string& text, double value) {
  append_little_endian(text, std::bit_cast<std::uint64_t>(value));
}
void append(std::string& text, float value) {
  append_little_endian(text, std::bit_cast<std::uint32_t>(value));
}

std::uint8_t class_number(const MeshFace& face) {
  if (face.penumbra_of != 0) return 1;
  return face.lit_by != 0 ? 0 : 2;
}

/// Output vertices are samples, or, with tints, samples as seen by one class.
struct Vertex {
  std::uint32_t point = 0;
  double shade = 0;
  Colour colour{};
};
struct Triangle {
  std::array<std::uint32_t, 3> vertices{};
  std::uint32_t face = 0;
};
struct Triangles {
  std::vector<Vertex> vertices;
  std::vector<Triangle> triangles;
};

Triangles triangles_of(const ShadingMesh& mesh, ShadedMeshOptions options) {
  if (!(options.exposure > 0)) options.exposure = automatic_exposure(mesh);
  Triangles result;
  std::unordered_map<std::uint64_t, std::uint32_t> numbers;
  std::vector<std::uint32_t> loop;
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const MeshFace& face = mesh.faces[f];
    loop.clear();
    for (const MeshCorner& corner : mesh.loop(face)) {
      const std::uint64_t key =
          std::uint64_t{corner.sample} * 3 + (options.tint ? class_number(face) : 0);
      const auto [at, is_new] =
          numbers.emplace(key, static_cast<std::uint32_t>(result.vertices.size()));
      if (is_new) {
        const double shade = mesh.shade(corner.sample);
        result.vertices.push_back({corner.vertex, shade, shade_colour(shade, face, options)});
      }
      loop.push_back(at->second);
    }
    for (const auto& [a, b, c] : triangulate(mesh, face)) {
      result.triangles.push_back({{loop[a], loop[b], loop[c]}, f});
    }
  }
  return result;
}

std::string ply_text(const PreparedScene& prepared, const ShadingMesh& mesh,
                     const ShadedMeshOptions& options) {
  const Triangles triangles = triangles_of(mesh, options);
  std::string text =
      "ply\nformat binary_little_endian 1.0\ncomment shaded by gnomon\nelement vertex " +
      std::to_string(triangles.vertices.size()) + "\n";
  for (const char* axis : {"x", "y", "z"}) {
    text += (options.plain_ply ? "property float " : "property double ") + std::string(axis) + "\n";
  }
  text +=
      "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty float quality\n"
      "element face " +
      std::to_string(triangles.triangles.size()) +
      (options.plain_ply ? "\nproperty list uchar int vertex_indices\nend_header\n"
                         : "\nproperty list uchar uint vertex_indices\nproperty uint polygon\n"
                           "property uchar back\nproperty uchar class\nend_header\n");
  text.reserve(text.size() + 31 * triangles.vertices.size() + 19 * triangles.triangles.size());
  for (const Vertex& vertex : triangles.vertices) {
    for (const double x : mesh.points[vertex.point]) {
      if (options.plain_ply) {
        append(text, static_cast<float>(x));
      } else {
        append(text, x);
      }
    }
    for (const double c : vertex.colour) text += static_cast<char>(srgb_byte(c));
    append(text, static_cast<float>(vertex.shade));
  }
  for (const Triangle& triangle : triangles.triangles) {
    const MeshFace& face = mesh.faces[triangle.face];
    text += char{3};
    for (const std::uint32_t vertex : triangle.vertices) append_little_endian(text, vertex);
    if (options.plain_ply) continue;
    append_little_endian(text, prepared.parts[face.part].polygon);
    text += face.side == Side::kBack ? char{1} : char{0};
    text += static_cast<char>(class_number(face));
  }
  return text;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= count ? kDigits[group >> (18 - 6 * k) & 63] : '=';
    }
  }
  return text;
}

/// The frame in which single-precision positions are written.
struct Frame {
  std::array<double, 3> centre{};
  double scale = 1;  // scene units per unit of the file
};

Frame frame_of(const ShadingMesh& mesh) {
  Frame frame;
  double extent = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const auto& point : mesh.points) {
      low = std::min(low, point[k]);
      high = std::max(high, point[k]);
    }
    if (mesh.points.empty()) low = high = 0;
    frame.centre[k] = low + (high - low) / 2;
    extent = std::max(extent, high - low);
  }
  // Where single precision would overflow or be denormal, the file has another unit.
  if (extent > 0 && !(extent > 1e-15 && extent < 1e15)) {
    frame.scale = std::ldexp(1.0, std::clamp(std::ilogb(extent), -1000, 1000));
  }
  return frame;
}

/// The one buffer: positions, colours, indices; each a multiple of four bytes long.
struct GltfBuffer {
  std::string bytes;
  std::size_t vertices = 0, indices = 0;
  std::array<float, 3> low{}, high{};
  Frame frame;
};

GltfBuffer gltf_buffer(const ShadingMesh& mesh, const ShadedMeshOptions& options) {
  const Triangles triangles = triangles_of(mesh, options);
  GltfBuffer buffer;
  buffer.frame = frame_of(mesh);
  buffer.vertices = triangles.vertices.size();
  buffer.indices = 3 * triangles.triangles.size();
  buffer.bytes.reserve(24 * buffer.vertices + 4 * buffer.indices);
  buffer.low.fill(std::numeric_limits<float>::infinity());
  buffer.high.fill(-std::numeric_limits<float>::infinity());
  for (const Vertex& vertex : triangles.vertices) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto x = static_cast<float>((mesh.points[vertex.point][k] - buffer.frame.centre[k]) /
                                        buffer.frame.scale);
      buffer.low[k] = std::min(buffer.low[k], x);
      buffer.high[k] = std::max(buffer.high[k], x);
      append(buffer.bytes, x);
    }
  }
  for (const Vertex& vertex : triangles.vertices) {
    for (const double c : vertex.colour) append(buffer.bytes, static_cast<float>(c));
  }
  for (const Triangle& triangle : triangles.triangles) {
    for (const std::uint32_t vertex : triangle.vertices) {
      append_little_endian(buffer.bytes, vertex);
    }
  }
  return buffer;
}

void buffer_view(JsonWriter& json, std::size_t offset, std::size_t length, int target) {
  json.begin_object(JsonLayout::kInline);
  json.member("buffer", 0);
  json.member("byteOffset", offset);
  json.member("byteLength", length);
  json.member("target", target);
  json.end_object();
}

/// `uri`: of the buffer; empty: the binary chunk of a .glb.
std::string gltf_json(const Scene& scene, const GltfBuffer& buffer, const std::string& uri) {
  constexpr int kFloat = 5126, kUnsignedInt = 5125, kArrayBuffer = 34962, kElementBuffer = 34963;
  const bool is_empty = buffer.indices == 0;  // glTF forbids what has no elements
  StringSink sink;
  {
    JsonWriter json(sink);
    json.begin_object();
    begin_gltf(json, scene.name, !is_empty);
    if (!is_empty) {
      const std::size_t vertex_bytes = 12 * buffer.vertices;
      json.key("nodes");
      json.begin_array();
      json.begin_object(JsonLayout::kInline);
      json.member("mesh", 0);
      write_turn_to_y_up(json, buffer.frame.centre);
      if (buffer.frame.scale != 1) {
        inline_array(json, "scale",
                     std::array{buffer.frame.scale, buffer.frame.scale, buffer.frame.scale});
      }
      json.end_object();
      json.end_array();
      json.key("meshes");
      json.begin_array();
      json.begin_object(JsonLayout::kInline);
      json.key("primitives");
      json.begin_array(JsonLayout::kInline);
      json.begin_object(JsonLayout::kInline);
      json.key("attributes");
      json.begin_object(JsonLayout::kInline);
      json.member("POSITION", 0);
      json.member("COLOR_0", 1);
      json.end_object();
      json.member("indices", 2);
      json.member("material", 0);
      json.member("mode", 4);
      json.end_object();
      json.end_array();
      json.end_object();
      json.end_array();
      json.key("materials");
      json.begin_array();
      write_unlit_material(json, "shaded", {1, 1, 1});
      json.end_array();
      json.key("accessors");
      json.begin_array();
      json.begin_object(JsonLayout::kInline);
      json.member("bufferView", 0);
      json.member("componentType", kFloat);
      json.member("count", buffer.vertices);
      json.member("type", "VEC3");
      inline_array(json, "min", std::array<double, 3>{buffer.low[0], buffer.low[1], buffer.low[2]});
      inline_array(json, "max",
                   std::array<double, 3>{buffer.high[0], buffer.high[1], buffer.high[2]});
      json.end_object();
      json.begin_object(JsonLayout::kInline);
      json.member("bufferView", 1);
      json.member("componentType", kFloat);
      json.member("count", buffer.vertices);
      json.member("type", "VEC3");
      json.end_object();
      json.begin_object(JsonLayout::kInline);
      json.member("bufferView", 2);
      json.member("componentType", kUnsignedInt);
      json.member("count", buffer.indices);
      json.member("type", "SCALAR");
      json.end_object();
      json.end_array();
      json.key("bufferViews");
      json.begin_array();
      buffer_view(json, 0, vertex_bytes, kArrayBuffer);
      buffer_view(json, vertex_bytes, vertex_bytes, kArrayBuffer);
      buffer_view(json, 2 * vertex_bytes, 4 * buffer.indices, kElementBuffer);
      json.end_array();
      json.key("buffers");
      json.begin_array();
      json.begin_object(JsonLayout::kInline);
      json.member("byteLength", buffer.bytes.size());
      if (!uri.empty()) json.member("uri", uri);
      json.end_object();
      json.end_array();
    }
    json.end_object();
    json.finish();
  }
  return sink.text();
}

}  // namespace

Expected<MeshFileFormat> mesh_file_format(const std::filesystem::path& path) {
  const std::string extension = lower_case(path.extension().string());
  if (extension == ".ply") return MeshFileFormat::kPly;
  if (extension == ".gltf") return MeshFileFormat::kGltf;
  if (extension == ".glb") return MeshFileFormat::kGlb;
  ErrorPlace where;
  where.file = path.string();
  return fail(ErrorCode::kUsage, "no format of shaded meshes has this extension",
              ".ply, .gltf or .glb", where);
}

double automatic_exposure(const ShadingMesh& mesh) {
  double largest = 0;
  for (std::uint32_t s = 0; s < mesh.samples.size(); ++s)
    largest = std::max(largest, mesh.shade(s));
  return largest > 0 && std::isfinite(1 / largest) ? 1 / largest : 1;
}

std::array<double, 3> shade_colour(double illumination, const MeshFace& face,
                                   const ShadedMeshOptions& options) {
  const double grey = std::clamp(illumination * options.exposure, 0.0, 1.0);
  if (!options.tint) return {grey, grey, grey};
  // A floor keeps umbra, which has no light, a colour to be told by.
  constexpr std::array<Colour, 3> kTints = {Colour{1.0, 0.82, 0.45}, Colour{0.65, 0.65, 0.72},
                                            Colour{0.2, 0.3, 0.8}};
  const Colour& tint = kTints[class_number(face)];
  const double shade = 0.15 + 0.85 * grey;
  return {tint[0] * shade, tint[1] * shade, tint[2] * shade};
}

std::uint8_t srgb_byte(double linear) {
  const double c = std::clamp(linear, 0.0, 1.0);
  const double encoded = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255 * encoded));
}

Expected<std::string> shaded_mesh_text(const Scene& scene, const PreparedScene& prepared,
                                       const ShadingMesh& mesh, MeshFileFormat format,
                                       const ShadedMeshOptions& options) {
  if (format == MeshFileFormat::kPly) return ply_text(prepared, mesh, options);
  const GltfBuffer buffer = gltf_buffer(mesh, options);
  if (buffer.bytes.size() > std::size_t{0xf0000000u}) {
    return fail(ErrorCode::kLimit, "the mesh is too large for glTF: more than 4 GB",
                "a larger grid step, or PLY");
  }
  if (format == MeshFileFormat::kGlb) return glb_file(gltf_json(scene, buffer, {}), buffer.bytes);
  return gltf_json(scene, buffer, "data:application/octet-stream;base64," + base64(buffer.bytes));
}

}  // namespace gnomon::report
