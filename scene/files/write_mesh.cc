// SPDX-License-Identifier: LGPL-3.0-or-later
// The writers of OBJ, OFF and PLY: vertices and loops, in OBJ also ids that are those of groups.
#include <bit>
#include <limits>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "scene/files/writers.h"

namespace gnomon {

namespace {

Expected<void> append_vertices(std::string& text, const Scene& scene, const char* start) {
  for (std::size_t i = 0; i < scene.vertices.size(); ++i) {
    text += start;
    auto done = append_position(text, scene.vertices[i], scene.numbers, " ",
                                "/vertices/" + std::to_string(i));
    if (!done) return done;
    text += '\n';
  }
  return {};
}

/// "3 0 1 2" for every polygon, as OFF and PLY have it.
void append_counted_loops(std::string& text, const Scene& scene) {
  for (const Polygon& polygon : scene.polygons) {
    text += std::to_string(polygon.loop.size());
    for (const VertexId vertex : polygon.loop) text += " " + std::to_string(vertex);
    text += '\n';
  }
}

template <class Integer>
void append_little_endian(std::string& text, Integer value) {
  for (std::size_t i = 0; i < sizeof value; ++i) {
    text += static_cast<char>(static_cast<unsigned char>(value >> (8 * i)));
  }
}

/// A comment is one line, whatever the name holds.
std::string comment_text(const std::string& name) {
  std::string result;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    result += byte < 0x20 || byte == 0x7F || c == '\\' ? '?' : c;
  }
  return result;
}

std::size_t longest_loop(const Scene& scene) {
  std::size_t longest = 0;
  for (const Polygon& polygon : scene.polygons) longest = std::max(longest, polygon.loop.size());
  return longest;
}

bool has_short_loops(const Scene& scene) { return longest_loop(scene) <= 255; }

std::string ply_header(const Scene& scene, const char* encoding) {
  const bool has_signed_indices =
      scene.vertices.size() <= std::size_t{std::numeric_limits<std::int32_t>::max()};
  std::string text = std::string("ply\nformat ") + encoding + " 1.0\n";
  if (!scene.name.empty()) text += "comment " + comment_text(scene.name) + "\n";
  text += "element vertex " + std::to_string(scene.vertices.size()) +
          "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
          std::to_string(scene.polygons.size()) + "\nproperty list " +
          (has_short_loops(scene) ? "uchar" : "uint") + (has_signed_indices ? " int" : " uint") +
          " vertex_indices\nend_header\n";
  return text;
}

/// Is it one word of an OBJ file?
bool is_obj_name(std::string_view name) {
  return !name.empty() && name.find_first_of(" \t\r\v\f\n\\#") == std::string_view::npos;
}

}  // namespace

std::vector<std::string_view> obj_groups(const Scene& scene) {
  std::vector<std::string_view> groups;
  std::unordered_map<std::string_view, std::uint32_t> counts;
  for (std::size_t i = 0; i < scene.polygons.size(); ++i) {
    const std::string_view id = scene.polygons[i].id;
    const std::size_t slash = id.rfind('/');
    const std::string_view group = slash == std::string_view::npos ? "" : id.substr(0, slash);
    const std::string number =
        std::to_string(group.empty() ? static_cast<std::uint32_t>(i) : counts[group]++);
    const bool is_called_so = id == (group.empty() ? number : std::string(group) + "/" + number);
    if (!is_called_so || (!group.empty() && !is_obj_name(group))) return {};
    groups.push_back(group);
  }
  return groups;
}

Expected<std::string> write_obj(const Scene& scene) {
  std::string text;
  if (!scene.name.empty()) text += "# " + comment_text(scene.name) + "\n";
  if (auto done = append_vertices(text, scene, "v "); !done) {
    return tl::unexpected(std::move(done.error()));
  }
  const std::vector<std::string_view> groups = obj_groups(scene);
  std::string_view group;
  for (std::size_t i = 0; i < scene.polygons.size(); ++i) {
    const Polygon& polygon = scene.polygons[i];
    if (!groups.empty() && groups[i] != group) {
      group = groups[i];
      text += group.empty() ? "g\n" : "g " + std::string(group) + "\n";
    }
    text += 'f';
    for (const VertexId vertex : polygon.loop) {
      text += " " + std::to_string(std::uint64_t{vertex} + 1);
    }
    text += '\n';
  }
  return text;
}

Expected<std::string> write_off(const Scene& scene) {
  std::string text = "OFF\n";
  if (!scene.name.empty()) text += "# " + comment_text(scene.name) + "\n";
  text +=
      std::to_string(scene.vertices.size()) + " " + std::to_string(scene.polygons.size()) + " 0\n";
  if (auto done = append_vertices(text, scene, ""); !done) {
    return tl::unexpected(std::move(done.error()));
  }
  append_counted_loops(text, scene);
  return text;
}

Expected<std::string> write_ply_ascii(const Scene& scene) {
  std::string text = ply_header(scene, "ascii");
  if (auto done = append_vertices(text, scene, ""); !done) {
    return tl::unexpected(std::move(done.error()));
  }
  append_counted_loops(text, scene);
  return text;
}

Expected<std::string> write_ply_binary(const Scene& scene) {
  std::string text = ply_header(scene, "binary_little_endian");
  for (std::size_t i = 0; i < scene.vertices.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Number& number = scene.vertices[i][axis];
      if (!number.is_double()) {
        return fail(ErrorCode::kNumber, number.to_text() + " is not exactly a double",
                    "a text format: JSON, OBJ, OFF or ascii PLY",
                    ErrorPlace{scene.file, 0, 0,
                               "/vertices/" + std::to_string(i) + "/" + std::to_string(axis)});
      }
      append_little_endian(text, std::bit_cast<std::uint64_t>(number.nearest()));
    }
  }
  const bool has_short_counts = has_short_loops(scene);
  for (const Polygon& polygon : scene.polygons) {
    const auto count = static_cast<std::uint32_t>(polygon.loop.size());
    if (has_short_counts) {
      text += static_cast<char>(static_cast<unsigned char>(count));
    } else {
      append_little_endian(text, count);
    }
    for (const VertexId vertex : polygon.loop) append_little_endian(text, vertex);
  }
  return text;
}

}  // namespace gnomon
