// SPDX-License-Identifier: LGPL-3.0-or-later
// What the readers of OBJ, OFF and PLY have in common: tokens with their places, and a scene that
// grows by vertices and faces. No line is copied, no count in a file is believed.
#ifndef GNOMON_SCENE_FILES_MESH_TEXT_H
#define GNOMON_SCENE_FILES_MESH_TEXT_H

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/scene/read.h"
#include "gnomon/scene/unusable.h"
#include "scene/base/text_file.h"
#include "scene/files/readers.h"

namespace gnomon {

struct Token {
  std::string_view text;
  std::size_t offset = 0;  // in the file
};

/// Words between blanks, line by line; `#` begins a comment.
class Tokens {
 public:
  enum class Continuation : std::uint8_t { kNone, kBackslash };

  Tokens(std::string_view text, std::size_t start, Continuation continuation)
      : text_(text), at_(start), continuation_(continuation) {}

  /// The next word of this line; nothing at its end.
  std::optional<Token> in_line();
  /// Goes to the next line; false at the end of the file.
  bool next_line();
  /// The next word on this or a later line.
  std::optional<Token> anywhere();
  std::size_t offset() const { return at_; }

 private:
  std::string_view text_;
  std::size_t at_;
  Continuation continuation_;
};

/// Any integer of a mesh file; nothing if the text is none or does not fit.
std::optional<std::int64_t> to_integer(std::string_view text);

class MeshBuilder {
 public:
  MeshBuilder(std::string_view text, const std::string& file, const ReadOptions& options);

  /// An error at a byte of the file: line and column, or in binary data the byte's number.
  tl::unexpected<Error> error(ErrorCode code, std::string what, std::string expected,
                              std::size_t offset) const;
  /// From here on the file has no lines.
  void binary_data_begin() { is_binary_ = true; }

  Expected<Number> number(const Token& token);
  void add_vertex(Position position) { scene_.vertices.push_back(std::move(position)); }
  /// Are polygons that cannot be used left out? Then the next two stand for an error.
  bool skips_bad() const { return skip_bad_; }
  /// Adds a vertex that no polygon can use.
  void add_bad_vertex(const Error& why);
  /// The face under construction cannot be used.
  void spoil_face(Error why);
  std::size_t vertex_count() const { return scene_.vertices.size(); }
  std::size_t face_count() const { return scene_.polygons.size(); }
  const std::string& face_id() const { return scene_.polygons.back().id; }

  /// How many vertices there will be: a greater index is an error at once. Faces may come first.
  void expect_vertices(std::uint64_t count) { expected_vertices_ = count; }
  /// One index of the face under construction, counted from 0.
  Expected<void> add_index(std::int64_t index, std::size_t offset);
  Expected<void> end_face(std::size_t offset);
  /// The last face, which is called by its number otherwise.
  void call_face(std::string id) { scene_.polygons.back().id = std::move(id); }

  void warn(std::string warning) { warnings_.push_back(std::move(warning)); }
  /// Messages count indices from this number: 1 in OBJ.
  void count_indices_from(std::int64_t first) { first_index_ = first; }

  Expected<ReadResult> finish();

 private:
  void find_bad_indices();
  tl::unexpected<Error> index_error(std::int64_t index, std::uint64_t count,
                                    std::size_t offset) const;

  std::string_view text_;
  const std::string& file_;
  mutable PlacesInText places_;
  Scene scene_;
  std::vector<std::string> warnings_;
  UnderflowCount underflow_;
  bool is_binary_ = false;
  bool skip_bad_, wants_offsets_;
  std::vector<VertexId> indices_;
  std::optional<Error> face_error_;  // of the face under construction
  std::vector<PolygonProblem> problems_;
  std::map<VertexId, std::string> bad_vertices_;  // and why
  std::vector<std::uint64_t> offsets_;            // of faces
  std::int64_t first_index_ = 0;
  std::uint64_t expected_vertices_ = 0;
  std::int64_t greatest_index_ = -1;
  std::size_t greatest_offset_ = 0;
};

}  // namespace gnomon

#endif  // GNOMON_SCENE_FILES_MESH_TEXT_H
