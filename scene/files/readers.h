// SPDX-License-Identifier: LGPL-3.0-or-later
// What the table of formats (formats.h) has of each: the test whether a file looks like one, and
// the reader. Each reader gets a whole file and its name for messages, from which those of formats
// that name other files find them. Readers of city models, building models, Radiance and glTF have
// rooms of their own.
#ifndef GNOMON_SCENE_FILES_READERS_H
#define GNOMON_SCENE_FILES_READERS_H

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/scene/read.h"
#include "scene/files/formats.h"

namespace gnomon {

class TextWindow;

Likeness looks_like_json(std::string_view text);
Likeness looks_like_obj(std::string_view text);
Likeness looks_like_off(std::string_view text);
Likeness looks_like_ply(std::string_view text);
Likeness looks_like_cityjson(std::string_view text);
Likeness looks_like_cityjson_sequence(std::string_view text);
Likeness looks_like_epjson(std::string_view text);
Likeness looks_like_idf(std::string_view text);
Likeness looks_like_hbjson(std::string_view text);
Likeness looks_like_gbxml(std::string_view text);
Likeness looks_like_radiance(std::string_view text);
Likeness looks_like_gltf(std::string_view text);
Likeness looks_like_glb(std::string_view text);
Likeness looks_like_stl(std::string_view text);

Expected<ReadResult> read_json(const std::string& text, const std::string& file,
                               const ReadOptions& options);
/// What read_json says, found by the parser alone.
Expected<ReadResult> parse_json(const std::string& text, const std::string& file,
                                const ReadOptions& options);
Expected<ReadResult> read_obj(const std::string& text, const std::string& file,
                              const ReadOptions& options);
Expected<ReadResult> read_off(const std::string& text, const std::string& file,
                              const ReadOptions& options);
Expected<ReadResult> read_ply(const std::string& text, const std::string& file,
                              const ReadOptions& options);
Expected<ReadResult> read_cityjson(const std::string& text, const std::string& file,
                                   const ReadOptions& options);
Expected<ReadResult> read_cityjson_sequence(const std::string& text, const std::string& file,
                                            const ReadOptions& options);
Expected<ReadResult> read_epjson(const std::string& text, const std::string& file,
                                 const ReadOptions& options);
Expected<ReadResult> read_idf(const std::string& text, const std::string& file,
                              const ReadOptions& options);
Expected<ReadResult> read_hbjson(const std::string& text, const std::string& file,
                                 const ReadOptions& options);
Expected<ReadResult> read_gbxml(const std::string& text, const std::string& file,
                                const ReadOptions& options);
Expected<ReadResult> read_radiance(const std::string& text, const std::string& file,
                                   const ReadOptions& options);
/// glTF as JSON or binary: the content tells.
Expected<ReadResult> read_gltf(const std::string& text, const std::string& file,
                               const ReadOptions& options);
Expected<ReadResult> read_stl(const std::string& text, const std::string& file,
                              const ReadOptions& options);

/// What read_cityjson_sequence() says of the same text, of which only a line at a time is in
/// memory. Requires: neither skip_bad nor polygon_offsets, for which the whole text is needed.
/// Errors: also kFile.
Expected<ReadResult> stream_cityjson_sequence(TextWindow& window, const std::string& file,
                                              const ReadOptions& options);

/// The text without its byte order mark and the blanks that it begins with.
std::string_view first_word_on(std::string_view text);

/// The name of a scene whose file gives none.
std::string name_from_file(const std::string& file);

/// Numbers that became 0 or lost digits on reading: one warning for all of them.
struct UnderflowCount {
  std::size_t count = 0;
  std::size_t first_offset = 0;

  void add(std::size_t offset) {
    if (count++ == 0) first_offset = offset;
  }
  void report(std::string_view text, std::vector<std::string>& warnings) const;
};

}  // namespace gnomon

#endif  // GNOMON_SCENE_FILES_READERS_H
