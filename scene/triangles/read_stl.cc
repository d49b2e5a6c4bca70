// SPDX-License-Identifier: LGPL-3.0-or-later
// The reader of STL, ascii and binary: triangles with no names, whose vertices are one where their
// coordinates are. Some programs write the words of ascii files in capitals. Normals and attributes
// are not used: the order of the vertices tells the front.
#include <array>
#include <cmath>
#include <cstdint>

#include "scene/base/ascii_case.h"
#include "scene/base/text_file.h"
#include "scene/files/mesh_text.h"
#include "scene/files/readers.h"
#include "scene/files/scene_builder.h"
#include "scene/triangles/binary_floats.h"

namespace gnomon {

namespace {

constexpr std::size_t kHeader = 84, kTriangle = 50, kNormal = 12, kCorner = 12;

/// Triangles of either kind of file become polygons called by their numbers.
class StlReader {
 public:
  StlReader(const std::string& text, const std::string& file, const ReadOptions& options)
      : text_(text), file_(file), builder_(file, options, NumberMeaning::kDouble) {}

  Expected<ReadResult> read_binary();
  Expected<ReadResult> read_ascii();

 private:
  Expected<void> facet(Tokens& tokens, const Token& first);
  Expected<void> word(Tokens& tokens, std::string_view wanted);
  Expected<Position> corner(Tokens& tokens);
  /// A triangle that begins at that byte, or an error there if it has none.
  Expected<void> add(const Expected<std::array<Position, 3>>& corners, std::size_t offset);
  tl::unexpected<Error> error(ErrorCode code, std::string what, std::string expected,
                              std::size_t offset) const {
    return fail(code, std::move(what), std::move(expected), place_in_text(file_, text_, offset));
  }
  tl::unexpected<Error> binary_error(ErrorCode code, std::string what, std::string expected,
                                     std::size_t offset) const {
    return fail(code, std::move(what) + " (byte " + std::to_string(offset) + ")",
                std::move(expected), ErrorPlace{file_, 0, 0, {}});
  }

  const std::string& text_;
  const std::string& file_;
  SceneBuilder builder_;
};

Expected<void> StlReader::add(const Expected<std::array<Position, 3>>& corners,
                              std::size_t offset) {
  const std::string id = std::to_string(builder_.polygon_count());
  Expected<std::vector<VertexId>> loop;
  if (corners) {
    loop = builder_.vertices({(*corners)[0], (*corners)[1], (*corners)[2]});
    if (!loop) loop.error().where = place_in_text(file_, text_, offset);
  } else {
    loop = tl::unexpected(corners.error());
  }
  if (!loop) {
    if (!builder_.skips_bad()) return tl::unexpected(std::move(loop.error()));
    builder_.add_bad(id, offset, std::move(loop.error()));
    return {};
  }
  builder_.add_renamed(id, offset).loop = *std::move(loop);
  return {};
}

Expected<ReadResult> StlReader::read_binary() {
  const std::size_t count = (text_.size() - kHeader) / kTriangle;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t start = kHeader + kTriangle * i;
    Expected<std::array<Position, 3>> corners = std::array<Position, 3>{};
    for (std::size_t c = 0; c < 3 && corners; ++c) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t at = start + kNormal + kCorner * c + 4 * axis;
        const float value = little_endian_float(text_, at);
        if (!std::isfinite(value)) {
          corners = binary_error(ErrorCode::kNumber, "a coordinate is no finite number",
                                 "finite numbers", at);
          break;
        }
        (*corners)[c][axis] = Number(static_cast<double>(value));
      }
    }
    if (auto done = add(corners, start); !done) return tl::unexpected(std::move(done.error()));
  }
  auto result = builder_.finish();
  result.polygon_offsets.clear();  // bytes of binary data are no lines
  return result;
}

Expected<void> StlReader::word(Tokens& tokens, std::string_view wanted) {
  const auto token = tokens.anywhere();
  if (token && same_word(token->text, wanted)) return {};
  return error(ErrorCode::kSyntax,
               token ? "found " + quoted_text(token->text) : "the file ends inside a facet",
               "'" + std::string(wanted) + "'", token ? token->offset : text_.size());
}

Expected<Position> StlReader::corner(Tokens& tokens) {
  Position result;
  for (Number& coordinate : result) {
    const auto token = tokens.anywhere();
    if (!token) {
      return error(ErrorCode::kSyntax, "the file ends inside a facet", "a number", text_.size());
    }
    auto number = Number::parse(token->text, builder_.scene().numbers);
    if (!number) {
      return error(number.error().code, number.error().what, number.error().expected,
                   token->offset);
    }
    coordinate = *std::move(number);
  }
  return result;
}

/// Behind "facet": "normal x y z outer loop vertex x y z ... endloop endfacet".
Expected<void> StlReader::facet(Tokens& tokens, const Token& first) {
  if (auto done = word(tokens, "normal"); !done) return done;
  // A normal of a triangle without area may be "nan nan nan".
  for (int axis = 0; axis < 3; ++axis) (void)tokens.anywhere();
  for (const char* wanted : {"outer", "loop"}) {
    if (auto done = word(tokens, wanted); !done) return done;
  }
  Expected<std::array<Position, 3>> corners = std::array<Position, 3>{};
  for (std::size_t c = 0; c < 3; ++c) {
    if (auto done = word(tokens, "vertex"); !done) return done;
    auto position = corner(tokens);
    if (position) {
      if (corners) (*corners)[c] = *std::move(position);
      continue;
    }
    if (position.error().code == ErrorCode::kSyntax || !builder_.skips_bad()) {
      return tl::unexpected(std::move(position.error()));
    }
    corners = tl::unexpected(std::move(position.error()));
    // The rest of the corner.
    while (const auto token = tokens.in_line()) {
    }
  }
  for (const char* wanted : {"endloop", "endfacet"}) {
    if (auto done = word(tokens, wanted); !done) return done;
  }
  return add(corners, first.offset);
}

Expected<ReadResult> StlReader::read_ascii() {
  if (auto readable = check_is_text(text_, file_); !readable) {
    return tl::unexpected(std::move(readable.error()));
  }
  Tokens tokens(text_, byte_order_mark(text_), Tokens::Continuation::kNone);
  std::size_t solids = 0;
  while (const auto token = tokens.anywhere()) {
    const bool begins = same_word(token->text, "solid");
    if (begins || same_word(token->text, "endsolid")) {
      solids += begins ? 1 : 0;
      while (tokens.in_line()) {  // its name
      }
    } else if (same_word(token->text, "facet") && solids != 0) {
      if (auto done = facet(tokens, *token); !done) return tl::unexpected(std::move(done.error()));
    } else {
      return error(ErrorCode::kSyntax, "found " + quoted_text(token->text),
                   solids == 0 ? "'solid', or a binary STL of 84 bytes and 50 a triangle"
                               : "'facet' or 'endsolid'",
                   token->offset);
    }
  }
  if (solids == 0) return error(ErrorCode::kSyntax, "the file is empty", "'solid'", 0);
  return builder_.finish();
}

/// Does the text begin with a solid that has a facet or ends at once?
bool is_ascii(std::string_view text) {
  constexpr std::size_t kFarEnough = 4096;
  const std::string start = lower_case(first_word_on(text).substr(0, kFarEnough));
  return start.starts_with("solid") && start.find('\0') == std::string::npos &&
         (start.find("facet") != std::string::npos || start.find("endsolid") != std::string::npos);
}

}  // namespace

Likeness looks_like_stl(std::string_view text) {
  if (is_ascii(text)) return Likeness::kCertain;
  // 84 bytes of text may look like a header.
  return is_size_of_binary_stl(text, text.size()) && text.find('\0') != std::string_view::npos
             ? Likeness::kPossible
             : Likeness::kNone;
}

Expected<ReadResult> read_stl(const std::string& text, const std::string& file,
                              const ReadOptions& options) {
  StlReader reader(text, file, options);
  // Binary files may begin with "solid", too.
  if (is_size_of_binary_stl(text, text.size()) && !is_ascii(text)) return reader.read_binary();
  if (text.find('\0') != std::string::npos && text.size() >= kHeader) {
    return fail(ErrorCode::kSyntax,
                "a binary STL of " + std::to_string(text.size()) +
                    " bytes, which is not what its number of triangles asks for (byte 80)",
                "84 bytes and 50 for each triangle", ErrorPlace{file, 0, 0, {}});
  }
  return reader.read_ascii();
}

}  // namespace gnomon
