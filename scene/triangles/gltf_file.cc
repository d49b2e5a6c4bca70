// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/triangles/gltf_file.h"

#include <openssl/evp.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <tuple>

#include "scene/base/text_file.h"
#include "scene/files/beside.h"
#include "scene/triangles/binary_floats.h"

namespace gnomon {

namespace {

constexpr std::uint32_t kByte = 5121, kShort = 5123, kInt = 5125, kFloat = 5126;

std::size_t component_size(std::uint32_t type) {
  return type == kByte ? 1 : type == kShort ? 2 : type == kInt || type == kFloat ? 4 : 0;
}

/// %20 and the like.
std::string percent_decoded(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned value = 0;
    if (text[i] == '%' && i + 2 < text.size() &&
        std::from_chars(text.data() + i + 1, text.data() + i + 3, value, 16).ptr ==
            text.data() + i + 3) {
      result += static_cast<char>(value);
      i += 2;
    } else {
      result += text[i];
    }
  }
  return result;
}

/// Nothing if it is no base64.
std::optional<std::string> base64_decoded(std::string_view text) {
  constexpr std::size_t kMost = std::numeric_limits<int>::max();
  if (text.size() % 4 != 0 || text.size() > kMost) return std::nullopt;
  std::string result(text.size() / 4 * 3, '\0');
  const int size = EVP_DecodeBlock(reinterpret_cast<unsigned char*>(result.data()),
                                   reinterpret_cast<const unsigned char*>(text.data()),
                                   static_cast<int>(text.size()));
  if (size < 0) return std::nullopt;
  // Padding counts as zeros.
  const std::size_t padding = text.ends_with("==") ? 2 : text.ends_with("=") ? 1 : 0;
  result.resize(static_cast<std::size_t>(size) - std::min<std::size_t>(padding, size));
  return result;
}

tl::unexpected<Error> chunk_error(const std::string& file, const std::string& what,
                                  std::size_t byte, std::string expected) {
  return fail(ErrorCode::kSyntax, what + " (byte " + std::to_string(byte) + ")",
              std::move(expected), ErrorPlace{file, 0, 0, {}});
}

}  // namespace

Expected<GltfChunks> gltf_chunks(const std::string& text, const std::string& file) {
  constexpr std::size_t kHeader = 12, kChunkHeader = 8;
  constexpr std::uint64_t kJson = 0x4E4F534A, kBinary = 0x004E4942;
  if (!text.starts_with("glTF")) return GltfChunks{text, {}};
  if (text.size() < kHeader + kChunkHeader) {
    return chunk_error(file, "the file ends in its header", text.size(), "20 bytes");
  }
  if (const auto version = little_endian(text, 4, 4); version != 2) {
    return chunk_error(file, "binary glTF of version " + std::to_string(version), 4, "version 2");
  }
  if (const auto length = little_endian(text, 8, 4); length != text.size()) {
    return chunk_error(file, "the header tells " + std::to_string(length) + " bytes", 8,
                       "the file's " + std::to_string(text.size()) + " bytes");
  }
  GltfChunks chunks;
  bool has_json = false, has_binary = false;
  for (std::size_t at = kHeader; at < text.size();) {
    if (text.size() - at < kChunkHeader) {
      return chunk_error(file, "the file ends in the header of a chunk", at, "8 bytes");
    }
    const std::uint64_t length = little_endian(text, at, 4), type = little_endian(text, at + 4, 4);
    at += kChunkHeader;
    if (length > text.size() - at) {
      return chunk_error(file, "a chunk of " + std::to_string(length) + " bytes", at,
                         "at most the " + std::to_string(text.size() - at) + " that are left");
    }
    if (!has_json && type != kJson) {
      return chunk_error(file, "the first chunk is no JSON", at - 4, "'JSON'");
    }
    if (!has_json) {
      chunks.json = text.substr(at, length);
      has_json = true;
    } else if (type == kBinary && !has_binary) {
      chunks.binary = std::string_view(text).substr(at, length);
      has_binary = true;
    }
    at += length;
  }
  return chunks;
}

Expected<std::size_t> GltfFile::index(const JsonNode& number) const {
  if (!number.is_number()) return tape_.wrong_kind(number, "an integer from 0 on");
  const std::string_view text = number.number();
  std::uint32_t value = 0;
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failed != std::errc{} || end != text.data() + text.size()) {
    return tape_.error(number, ErrorCode::kFormat, quoted_text(text) + " is no index",
                       "an integer from 0 to 4294967295");
  }
  return value;
}

Expected<std::optional<std::size_t>> GltfFile::count(const JsonNode& object,
                                                     std::string_view key) const {
  const auto found = object.find(key);
  if (!found) return std::optional<std::size_t>();
  auto value = index(*found);
  if (!value) return tl::unexpected(std::move(value.error()));
  return std::optional(*value);
}

Expected<JsonNode> GltfFile::element(const JsonNode& number, std::string_view list) const {
  const auto wanted = index(number);
  if (!wanted) return tl::unexpected(wanted.error());
  const auto found = lists_.find(list);
  const std::size_t count = found == lists_.end() ? 0 : found->second.size();
  if (*wanted < count) {
    const JsonNode node = found->second[*wanted];
    if (!node.is_object()) return tape_.wrong_kind(node, "an object");
    return node;
  }
  return tape_.error(number, ErrorCode::kIndex,
                     "there is no element " + std::to_string(*wanted) + " of " + std::string(list),
                     count == 0 ? std::string(list) : "0 to " + std::to_string(count - 1));
}

Expected<std::string> GltfFile::load(const JsonNode& uri) const {
  if (!uri.is_string()) return tape_.wrong_kind(uri, "a text");
  const std::string text = uri.string();
  if (text.starts_with("data:")) {
    constexpr std::string_view kMark = ";base64,";
    const std::size_t mark = text.find(kMark);
    auto bytes = mark == std::string::npos
                     ? std::nullopt
                     : base64_decoded(std::string_view(text).substr(mark + kMark.size()));
    if (!bytes) {
      return tape_.error(uri, ErrorCode::kSyntax, "this is no data in base64",
                         "data:...;base64,...");
    }
    return *std::move(bytes);
  }
  auto path = path_beside(file_, percent_decoded(text));
  if (!path) return tape_.error(uri, ErrorCode::kFile, path.error().what, path.error().expected);
  auto bytes = read_all_bytes(*path);
  if (!bytes)
    return tape_.error(uri, bytes.error().code, bytes.error().what, "a file that can be read");
  return *std::move(bytes);
}

Expected<void> GltfFile::open() {
  for (const char* name : {"accessors", "bufferViews", "nodes", "meshes", "materials", "scenes"}) {
    const auto found = tape_.root().find(name);
    if (!found) continue;
    if (!found->is_array()) return tape_.wrong_kind(*found, "an array");
    std::vector<JsonNode>& elements = lists_[name];
    for (JsonNode at = found->begin(); at != found->end(); at = at.next()) elements.push_back(at);
  }
  const auto list = tape_.root().find("buffers");
  if (!list) return {};
  if (!list->is_array()) return tape_.wrong_kind(*list, "an array of buffers");
  loaded_.reserve(list->size());  // buffers are views of them
  for (JsonNode node = list->begin(); node != list->end(); node = node.next()) {
    if (!node.is_object()) return tape_.wrong_kind(node, "a buffer: an object");
    const auto length = count(node, "byteLength");
    if (!length) return tl::unexpected(length.error());
    if (!*length) return tape_.missing(node, "byteLength", "a number of bytes");
    std::string_view bytes;
    if (const auto uri = node.find("uri")) {
      auto loaded = load(*uri);
      if (!loaded) return tl::unexpected(std::move(loaded.error()));
      bytes = loaded_.emplace_back(*std::move(loaded));
    } else if (buffers_.empty()) {
      bytes = binary_;
    }
    if (bytes.size() < **length) {
      return tape_.error(node, ErrorCode::kFormat,
                         "a buffer of " + std::to_string(**length) + " bytes, of which " +
                             std::to_string(bytes.size()) + " are there",
                         "all of them");
    }
    buffers_.push_back(bytes.substr(0, **length));
  }
  return {};
}

Expected<GltfAccessor> GltfFile::accessor(const JsonNode& number, std::string_view type,
                                          std::size_t components) const {
  const auto node = element(number, "accessors");
  if (!node) return tl::unexpected(node.error());
  if (node->find("sparse")) {
    return tape_.error(*node, ErrorCode::kFormat, "a sparse accessor, which is not read here",
                       "an accessor of a bufferView alone");
  }
  const auto shape = node->find("type");
  if (!shape || !shape->is_text(type)) {
    return tape_.error(shape.value_or(*node), ErrorCode::kFormat, "an accessor of another type",
                       "\"" + std::string(type) + "\"");
  }
  std::size_t values[3] = {0, 0, 0};
  std::size_t at = 0;
  for (const char* key : {"componentType", "count", "byteOffset"}) {
    const auto value = count(*node, key);
    if (!value) return tl::unexpected(value.error());
    if (!*value && at < 2) return tape_.missing(*node, key, "a number");
    values[at++] = value->value_or(0);
  }
  GltfAccessor result;
  result.component_type = static_cast<std::uint32_t>(values[0]);
  result.count = values[1];
  const std::size_t size = component_size(result.component_type) * components;
  const auto view_number = node->find("bufferView");
  if (!view_number) return tape_.missing(*node, "bufferView", "the index of a bufferView");
  const auto view = element(*view_number, "bufferViews");
  if (!view) return tl::unexpected(view.error());
  const auto buffer_number = view->find("buffer");
  if (!buffer_number) return tape_.missing(*view, "buffer", "the index of a buffer");
  const auto buffer = index(*buffer_number);
  if (!buffer) return tl::unexpected(buffer.error());
  if (*buffer >= buffers_.size()) {
    return tape_.error(*buffer_number, ErrorCode::kIndex,
                       "there is no buffer " + std::to_string(*buffer), "the index of a buffer");
  }
  std::size_t numbers[3] = {0, 0, 0};
  at = 0;
  for (const char* key : {"byteLength", "byteOffset", "byteStride"}) {
    const auto value = count(*view, key);
    if (!value) return tl::unexpected(value.error());
    if (!*value && at < 1) return tape_.missing(*view, key, "a number");
    numbers[at++] = value->value_or(0);
  }
  const auto [length, offset, stride] = std::tuple(numbers[0], numbers[1], numbers[2]);
  if (offset + length > buffers_[*buffer].size()) {
    return tape_.error(*view, ErrorCode::kIndex, "a bufferView beyond the end of its buffer",
                       "at most " + std::to_string(buffers_[*buffer].size()) + " bytes");
  }
  result.stride = stride == 0 ? size : stride;
  if (result.stride < size) {
    return tape_.error(*view, ErrorCode::kFormat, "a byteStride below the size of an element",
                       std::to_string(size) + " or more");
  }
  // 32-bit numbers, whose products fit into 64 bits.
  const std::size_t end =
      result.count == 0 ? 0 : values[2] + result.stride * (result.count - 1) + size;
  if (end > length) {
    return tape_.error(*node, ErrorCode::kIndex,
                       "an accessor of " + std::to_string(result.count) +
                           " elements beyond the end of its bufferView",
                       "at most " + std::to_string(length) + " bytes");
  }
  result.bytes = buffers_[*buffer].substr(offset, length);
  result.bytes.remove_prefix(std::min(values[2], result.bytes.size()));
  return result;
}

Expected<GltfAccessor> GltfFile::positions(const JsonNode& number) const {
  auto result = accessor(number, "VEC3", 3);
  if (result && result->component_type != kFloat) {
    return tape_.error(number, ErrorCode::kFormat,
                       "positions of component type " + std::to_string(result->component_type),
                       "5126, floats");
  }
  return result;
}

Expected<GltfAccessor> GltfFile::indices(const JsonNode& number) const {
  auto result = accessor(number, "SCALAR", 1);
  if (result && (result->component_type == kFloat || component_size(result->component_type) == 0)) {
    return tape_.error(number, ErrorCode::kFormat,
                       "indices of component type " + std::to_string(result->component_type),
                       "5121, 5123 or 5125");
  }
  return result;
}

}  // namespace gnomon
