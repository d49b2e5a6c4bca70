// SPDX-License-Identifier: LGPL-3.0-or-later
// The OFF reader (ascii): OFF with the prefixes ST, C and N, whose further values of a vertex are
// passed over like the colours of a face. Values may be separated by any white space. What is a
// colour only the ends of lines tell, so that a file is read in the first layout that it fits.
#include "scene/base/text_file.h"
#include "scene/files/mesh_text.h"
#include "scene/files/readers.h"

namespace gnomon {

namespace {

enum class Layout : std::uint8_t {
  kLines,    // a vertex or a face a line, as nearly every writer has it
  kWrapped,  // each begins a line, and may go on over others
  kFree,     // any white space; no colours
};

class OffReader {
 public:
  OffReader(std::string_view text, const std::string& file, const ReadOptions& options,
            Layout layout)
      : text_(text),
        layout_(layout),
        mesh_(text, file, options),
        tokens_(text, byte_order_mark(text), Tokens::Continuation::kNone) {}

  Expected<ReadResult> read() {
    if (auto done = header(); !done) return tl::unexpected(std::move(done.error()));
    for (std::int64_t i = 0; i < vertices_; ++i) {
      if (auto done = vertex(i); !done) return tl::unexpected(std::move(done.error()));
    }
    for (std::int64_t i = 0; i < faces_; ++i) {
      if (auto done = face(i); !done) return tl::unexpected(std::move(done.error()));
    }
    if (layout_ != Layout::kFree) tokens_.next_line();  // behind the colour of the last face
    if (const auto token = tokens_.anywhere()) {
      return mesh_.error(ErrorCode::kFormat, quoted_text(token->text) + " after the last face",
                         "the end of the file: the counts in line 1 or 2 say so", token->offset);
    }
    return mesh_.finish();
  }

 private:
  Expected<void> header() {
    const auto word = tokens_.anywhere();
    const std::string_view keyword = word ? word->text : std::string_view();
    if (!keyword.ends_with("OFF") || keyword.size() > 8 ||
        keyword.find_first_not_of("STCN4n") < keyword.size() - 3) {
      return mesh_.error(ErrorCode::kSyntax, quoted_text(keyword) + " at the start", "OFF",
                         word ? word->offset : text_.size());
    }
    if (keyword.find_first_of("4n") != std::string_view::npos) {
      return mesh_.error(ErrorCode::kFormat, quoted_text(keyword) + ": not three dimensions",
                         "OFF with three coordinates", word->offset);
    }
    has_more_values_ = keyword.size() > 3;
    auto vertices = count("vertices");
    if (vertices && is_binary_) {
      return mesh_.error(ErrorCode::kFormat, "binary OFF", "OFF as text", word->offset);
    }
    if (!vertices) return tl::unexpected(std::move(vertices.error()));
    auto faces = count("faces");
    if (!faces) return tl::unexpected(std::move(faces.error()));
    vertices_ = *vertices;
    faces_ = *faces;
    mesh_.expect_vertices(static_cast<std::uint64_t>(vertices_));
    // "0 0 0" and "3 0 0 0", each with an end of line: a file that is shorter is not complete.
    constexpr std::size_t kLeastVertexBytes = 6, kLeastFaceBytes = 8;
    const std::size_t rest = text_.size() + 1 - tokens_.offset();
    const auto room_for = [&](std::int64_t wanted, std::size_t bytes) {
      return static_cast<std::uint64_t>(wanted) <= rest / bytes;
    };
    if (!room_for(vertices_, kLeastVertexBytes)) {
      return too_many("vertices", vertices_, rest / kLeastVertexBytes, vertices_offset_);
    }
    if (!room_for(faces_, kLeastFaceBytes)) {
      return too_many("faces", faces_, rest / kLeastFaceBytes, faces_offset_);
    }
    if (layout_ == Layout::kFree && has_more_values_) {
      return mesh_.error(ErrorCode::kFormat, "vertices with further values, not a line each",
                         "a vertex a line", word->offset);
    }
    // The number of edges is optional where a line ends, and says nothing.
    const auto edges = layout_ == Layout::kFree ? tokens_.anywhere() : tokens_.in_line();
    if (edges && !to_integer(edges->text)) {
      return mesh_.error(ErrorCode::kSyntax, quoted_text(edges->text) + " is not a number of edges",
                         "an integer", edges->offset);
    }
    return {};
  }

  tl::unexpected<Error> too_many(const char* what, std::int64_t announced, std::size_t room,
                                 std::size_t offset) const {
    return mesh_.error(ErrorCode::kFormat, std::to_string(announced) + " " + what + " announced",
                       "at most " + std::to_string(room) + ", for which the file has room", offset);
  }

  Expected<std::int64_t> count(const char* what) {
    const auto token = tokens_.anywhere();
    if (!token) return ends_early(std::string("no number of ") + what);
    if (token->text == "BINARY") is_binary_ = true;
    (what[0] == 'v' ? vertices_offset_ : faces_offset_) = token->offset;
    if (is_binary_) return 0;
    const auto value = to_integer(token->text);
    if (!value || *value < 0) {
      return mesh_.error(ErrorCode::kSyntax,
                         quoted_text(token->text) + " is not a number of " + what,
                         "an integer that is not negative", token->offset);
    }
    return *value;
  }

  tl::unexpected<Error> ends_early(std::string what) const {
    return mesh_.error(ErrorCode::kSyntax, "the file ends too early: " + std::move(what),
                       "all vertices and faces that the header announces", text_.size());
  }

  Expected<void> vertex(std::int64_t index) {
    auto token = first_of_next();
    if (!token) return ends_early("vertex " + std::to_string(index) + " is missing");
    Position position;
    std::optional<Error> bad;
    const std::size_t line = token->offset;
    for (std::size_t axis = 0; axis < position.size(); ++axis) {
      if (!token) {
        return mesh_.error(ErrorCode::kFormat,
                           "vertex " + std::to_string(index) + " has " + std::to_string(axis) +
                               (axis == 1 ? " number" : " numbers"),
                           "three coordinates", line);
      }
      auto value = mesh_.number(*token);
      if (!value && !mesh_.skips_bad()) return tl::unexpected(std::move(value.error()));
      if (value) {
        position[axis] = *std::move(value);
      } else {
        bad = std::move(value.error());
      }
      if (axis + 1 < position.size()) token = next();
    }
    if (layout_ != Layout::kFree) token = tokens_.in_line();
    if (layout_ != Layout::kFree && token && !has_more_values_) {
      return mesh_.error(ErrorCode::kFormat,
                         quoted_text(token->text) + " after the coordinates of a vertex",
                         "the end of the line", token->offset);
    }
    if (bad) {
      mesh_.add_bad_vertex(*bad);
    } else {
      mesh_.add_vertex(std::move(position));
    }
    return {};
  }

  Expected<void> face(std::int64_t index) {
    auto token = first_of_next();
    if (!token) return ends_early("face " + std::to_string(index) + " is missing");
    const std::size_t line = token->offset;
    const auto count = to_integer(token->text);
    if (!count || *count < 0) {
      return mesh_.error(ErrorCode::kSyntax,
                         quoted_text(token->text) + " is not a number of vertices", "an integer",
                         token->offset);
    }
    for (std::int64_t k = 0; k < *count; ++k) {
      token = next();
      if (!token) {
        return mesh_.error(
            ErrorCode::kFormat,
            "a face with " + std::to_string(k) + " of " + std::to_string(*count) + " vertices",
            "all its indices on one line", line);
      }
      const auto value = to_integer(token->text);
      if (!value) {
        return mesh_.error(ErrorCode::kSyntax, quoted_text(token->text) + " is not an index",
                           "an integer", token->offset);
      }
      if (auto added = mesh_.add_index(*value, token->offset); !added) return added;
    }
    return mesh_.end_face(line);  // what follows on the line is a colour
  }

  std::optional<Token> first_of_next() {
    if (layout_ != Layout::kFree) tokens_.next_line();
    return tokens_.anywhere();
  }
  std::optional<Token> next() {
    return layout_ == Layout::kLines ? tokens_.in_line() : tokens_.anywhere();
  }

  std::string_view text_;
  Layout layout_;
  MeshBuilder mesh_;
  Tokens tokens_;
  std::int64_t vertices_ = 0, faces_ = 0;
  std::size_t vertices_offset_ = 0, faces_offset_ = 0;
  bool has_more_values_ = false;
  bool is_binary_ = false;
};

}  // namespace

/// Is the first word OFF, with any of its prefixes?
Likeness looks_like_off(std::string_view text) {
  text = first_word_on(text);
  const std::string_view word = text.substr(0, text.find_first_of(" \t\r\n#"));
  const bool is_keyword = word.size() >= 3 && word.size() <= 8 && word.ends_with("OFF") &&
                          word.find_first_not_of("STCN4n") >= word.size() - 3;
  return is_keyword ? Likeness::kCertain : Likeness::kNone;
}

Expected<ReadResult> read_off(const std::string& text, const std::string& file,
                              const ReadOptions& options) {
  if (auto readable = check_is_text(text, file); !readable) {
    return tl::unexpected(std::move(readable.error()));
  }
  auto by_lines = OffReader(text, file, options, Layout::kLines).read();
  if (by_lines) return by_lines;
  auto wrapped = OffReader(text, file, options, Layout::kWrapped).read();
  if (wrapped) return wrapped;
  if (auto free = OffReader(text, file, options, Layout::kFree).read()) return free;
  // A file that only goes on over lines is good but for the index or number that was found there.
  const ErrorCode code = wrapped.error().code;
  return code == ErrorCode::kIndex || code == ErrorCode::kNumber ? wrapped : by_lines;
}

}  // namespace gnomon
