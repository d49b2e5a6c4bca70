// SPDX-License-Identifier: LGPL-3.0-or-later
// The PLY reader: x, y, z of `vertex` and the index list of `face`, from text or from binary data
// of either byte order. Everything else is stepped over. A text number is read by the meaning of
// the scene's numbers, whatever its declared type; a binary float or double is exactly what it is.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "scene/base/text_file.h"
#include "scene/files/mesh_text.h"
#include "scene/files/ply_header.h"
#include "scene/files/readers.h"

namespace gnomon {

namespace {

constexpr std::size_t kNoProperty = static_cast<std::size_t>(-1);

class PlyReader {
 public:
  PlyReader(std::string_view text, const std::string& file, const ReadOptions& options,
            PlyHeader header)
      : text_(text),
        file_(file),
        header_(std::move(header)),
        mesh_(text, file, options),
        tokens_(text, header_.size, Tokens::Continuation::kNone),
        at_(header_.size) {
    if (!is_text()) mesh_.binary_data_begin();
  }

  Expected<ReadResult> read() {
    for (const PlyElement& element : header_.elements) {
      if (element.name == "vertex") mesh_.expect_vertices(element.count);
    }
    for (const PlyElement& element : header_.elements) {
      auto done = element.name == "vertex" ? vertices(element)
                  : element.name == "face" ? faces(element)
                                           : others(element);
      if (!done) return tl::unexpected(std::move(done.error()));
    }
    if (is_text()) {
      if (const auto token = tokens_.anywhere()) {
        return mesh_.error(ErrorCode::kFormat, quoted_text(token->text) + " after the last element",
                           "the end of the file: the header's counts say so", token->offset);
      }
    } else if (at_ < text_.size()) {
      mesh_.warn(std::to_string(text_.size() - at_) + " bytes after the last element ignored");
    }
    return mesh_.finish();
  }

 private:
  bool is_text() const { return header_.encoding == PlyEncoding::kAscii; }

  tl::unexpected<Error> ends_early() const {
    return mesh_.error(ErrorCode::kSyntax,
                       "the file ends too early: " + element_name_ + " " +
                           std::to_string(element_index_) + " is not complete",
                       "all elements that the header announces", text_.size());
  }

  Expected<void> header_error(const PlyElement& element, std::string what,
                              std::string expected) const {
    return fail(ErrorCode::kFormat, std::move(what), std::move(expected),
                place_in_text(file_, text_, element.offset));
  }

  // ---- values

  /// The next binary value as its bits, lowest first. Requires: it is there.
  std::uint64_t bits(PlyType type) {
    const std::size_t size = ply_size(type);
    std::uint64_t result = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t from = header_.encoding == PlyEncoding::kLittleEndian ? size - 1 - i : i;
      result = result << 8 | static_cast<unsigned char>(text_[at_ + from]);
    }
    at_ += size;
    return result;
  }

  bool has_bytes(std::size_t count) const { return text_.size() - at_ >= count; }

  static std::int64_t integer_from(std::uint64_t bits, PlyType type) {
    switch (type) {
      case PlyType::kInt8:
        return static_cast<std::int8_t>(bits);
      case PlyType::kInt16:
        return static_cast<std::int16_t>(bits);
      case PlyType::kInt32:
        return static_cast<std::int32_t>(bits);
      default:
        return static_cast<std::int64_t>(bits);
    }
  }

  Expected<Number> number(PlyType type) {
    if (is_text()) {
      const auto token = tokens_.anywhere();
      if (!token) return ends_early();
      return mesh_.number(*token);
    }
    if (!has_bytes(ply_size(type))) return ends_early();
    const std::size_t offset = at_;
    const std::uint64_t value_bits = bits(type);
    double value = 0;
    if (type == PlyType::kFloat64) {
      value = std::bit_cast<double>(value_bits);
    } else if (type == PlyType::kFloat32) {
      value = std::bit_cast<float>(static_cast<std::uint32_t>(value_bits));
    } else {
      value = static_cast<double>(integer_from(value_bits, type));
    }
    if (!std::isfinite(value)) {
      return mesh_.error(
          ErrorCode::kNumber,
          "a coordinate of vertex " + std::to_string(element_index_) + " is not finite",
          "a finite number", offset);
    }
    return Number(value);
  }

  /// The next integer; `offset_` is where it stands.
  Expected<std::int64_t> integer(PlyType type) {
    if (is_text()) {
      const auto token = tokens_.anywhere();
      if (!token) return ends_early();
      offset_ = token->offset;
      if (const auto value = to_integer(token->text)) return *value;
      return mesh_.error(ErrorCode::kSyntax, quoted_text(token->text) + " is not an integer",
                         "an index or a count", token->offset);
    }
    if (!has_bytes(ply_size(type))) return ends_early();
    offset_ = at_;
    return integer_from(bits(type), type);
  }

  Expected<std::int64_t> list_length(const PlyProperty& property) {
    auto length = integer(*property.list_count);
    if (length && *length < 0) {
      return mesh_.error(ErrorCode::kFormat, "a list of " + std::to_string(*length) + " values",
                         "a length that is not negative", offset_);
    }
    return length;
  }

  Expected<void> step_over(const PlyProperty& property) {
    std::int64_t count = 1;
    if (property.list_count) {
      auto length = list_length(property);
      if (!length) return tl::unexpected(std::move(length.error()));
      count = *length;
    }
    if (is_text()) {
      for (; count > 0; --count) {
        if (!tokens_.anywhere()) return ends_early();
      }
      return {};
    }
    const std::size_t room = (text_.size() - at_) / ply_size(property.type);
    if (static_cast<std::uint64_t>(count) > room) return ends_early();
    at_ += static_cast<std::size_t>(count) * ply_size(property.type);
    return {};
  }

  // ---- elements

  Expected<void> vertices(const PlyElement& element) {
    std::array<std::size_t, 3> axes{kNoProperty, kNoProperty, kNoProperty};
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      if (property.name.size() != 1 || property.list_count) continue;
      const char letter = property.name[0];
      if (letter < 'x' || letter > 'z') continue;
      std::size_t& axis = axes[static_cast<std::size_t>(letter - 'x')];
      if (axis != kNoProperty) {
        return header_error(element, "a second property " + quoted_text(property.name),
                            "each coordinate once");
      }
      axis = i;
    }
    for (std::size_t axis = 0; axis < axes.size(); ++axis) {
      if (axes[axis] == kNoProperty) {
        return header_error(element,
                            std::string("a vertex without ") + static_cast<char>('x' + axis),
                            "properties x, y and z");
      }
    }
    element_name_ = "vertex";
    for (element_index_ = 0; element_index_ < element.count; ++element_index_) {
      Position position;
      std::optional<Error> bad;
      for (std::size_t i = 0; i < element.properties.size(); ++i) {
        const auto axis =
            static_cast<std::size_t>(std::find(axes.begin(), axes.end(), i) - axes.begin());
        if (axis == axes.size()) {
          if (auto done = step_over(element.properties[i]); !done) return done;
          continue;
        }
        auto value = number(element.properties[i].type);
        if (value) {
          position[axis] = *std::move(value);
        } else if (mesh_.skips_bad() && value.error().code == ErrorCode::kNumber) {
          bad = std::move(value.error());
        } else {
          return tl::unexpected(std::move(value.error()));
        }
      }
      if (bad) {
        mesh_.add_bad_vertex(*bad);
      } else {
        mesh_.add_vertex(std::move(position));
      }
    }
    return {};
  }

  Expected<void> faces(const PlyElement& element) {
    std::size_t loop = kNoProperty;
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      if (property.name != "vertex_indices" && property.name != "vertex_index") continue;
      if (loop != kNoProperty) {
        return header_error(element, "two lists of indices", "vertex_indices once");
      }
      if (!property.list_count || !is_integer(property.type)) {
        return header_error(element, quoted_text(property.name) + " is no list of integers",
                            "property list uchar int vertex_indices");
      }
      loop = i;
    }
    if (loop == kNoProperty) {
      return header_error(element, "a face without indices",
                          "property list uchar int vertex_indices");
    }
    element_name_ = "face";
    for (element_index_ = 0; element_index_ < element.count; ++element_index_) {
      for (std::size_t i = 0; i < element.properties.size(); ++i) {
        auto done = i == loop ? face(element.properties[i]) : step_over(element.properties[i]);
        if (!done) return done;
      }
    }
    return {};
  }

  Expected<void> face(const PlyProperty& property) {
    auto length = list_length(property);
    if (!length) return tl::unexpected(std::move(length.error()));
    const std::size_t place = offset_;
    for (std::int64_t k = 0; k < *length; ++k) {
      auto index = integer(property.type);
      if (!index) return tl::unexpected(std::move(index.error()));
      if (auto added = mesh_.add_index(*index, offset_); !added) return added;
    }
    return mesh_.end_face(place);
  }

  Expected<void> others(const PlyElement& element) {
    element_name_ = "element " + quoted_text(element.name);
    if (element.properties.empty()) return {};
    if (element.name == "tristrips" && element.count > 0) {
      mesh_.warn("triangle strips (tristrips) ignored");
    }
    for (element_index_ = 0; element_index_ < element.count; ++element_index_) {
      for (const PlyProperty& property : element.properties) {
        if (auto done = step_over(property); !done) return done;
      }
    }
    return {};
  }

  std::string_view text_;
  const std::string& file_;
  PlyHeader header_;
  MeshBuilder mesh_;
  Tokens tokens_;   // of a text file
  std::size_t at_;  // in a binary file
  std::size_t offset_ = 0;
  std::string element_name_;  // for messages
  std::uint64_t element_index_ = 0;
};

}  // namespace

Likeness looks_like_ply(std::string_view text) {
  return text.starts_with("ply\n") || text.starts_with("ply\r") ? Likeness::kCertain
                                                                : Likeness::kNone;
}

Expected<ReadResult> read_ply(const std::string& text, const std::string& file,
                              const ReadOptions& options) {
  if (text.empty()) return tl::unexpected(check_is_text(text, file).error());
  auto header = read_ply_header(text, file);
  if (!header) return tl::unexpected(std::move(header.error()));
  if (header->encoding == PlyEncoding::kAscii) {
    if (auto readable = check_is_text(text, file); !readable) {
      return tl::unexpected(std::move(readable.error()));
    }
  }
  return PlyReader(text, file, options, *std::move(header)).read();
}

}  // namespace gnomon
