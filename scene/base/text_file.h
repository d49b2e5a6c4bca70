// SPDX-License-Identifier: LGPL-3.0-or-later
// Files as bytes, and places in them: what every reader needs before it knows a format. Nothing
// here allocates more than a small multiple of what is there to be read.
#ifndef GNOMON_SCENE_BASE_TEXT_FILE_H
#define GNOMON_SCENE_BASE_TEXT_FILE_H

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "gnomon/kernel/error.h"

namespace gnomon {

/// How a file is called in messages: its path, or <stdin> for `-`.
std::string shown_name(const std::filesystem::path& path);

/// All bytes of a file; `-` is standard input. A text in UTF-16 that begins with a byte order mark
/// becomes the same in UTF-8. Any other file that holds a NUL byte in its first 64 KiB and is no
/// PLY, no glTF and no STL is not read to its end, since no text format goes on from there. Errors:
/// kFile (absent, unreadable, a directory), kLimit (an endless stream), kSyntax (broken UTF-16).
Expected<std::string> read_file(const std::filesystem::path& path);
/// The bytes as they are, to the end whatever the file holds.
Expected<std::string> read_all_bytes(const std::filesystem::path& path);

/// Has a file the size that binary STL has? That format has no other mark: 80 bytes of anything,
/// the number of its triangles in 4, and 50 for each of them.
bool is_size_of_binary_stl(std::string_view begin, std::size_t size);

/// Lines and columns of many bytes of one text, as place_in_text() has them. Cheap as long as
/// offsets grow: all together cost as much as the last.
class PlacesInText {
 public:
  explicit PlacesInText(std::string_view text) : text_(text) {}
  ErrorPlace at(std::string file, std::size_t offset, std::string pointer = {});

 private:
  std::string_view text_;
  std::uint64_t line_ = 0;  // 0: none yet
  std::size_t line_start_ = 0;
};

/// Line and column of a byte offset, both from 1; a column counts characters (UTF-8), and a byte
/// order mark is none. Cost: O(offset).
ErrorPlace place_in_text(std::string file, std::string_view text, std::size_t offset,
                         std::string pointer = {});

/// 'text' for a message: about 40 bytes of it, control characters and broken UTF-8 as \xHH.
std::string quoted_text(std::string_view text);

/// The length of the valid UTF-8 sequence that begins at byte `at`, 0 if there is none.
std::size_t utf8_length(std::string_view text, std::size_t at);

/// The length of a UTF-8 byte order mark at the start of the text: 3 or 0.
std::size_t byte_order_mark(std::string_view text);

/// An error if the text is empty, UTF-16 or UTF-32, or holds a NUL byte.
Expected<void> check_is_text(std::string_view text, const std::string& file);

/// check_is_text, and an error at the first byte that is not valid UTF-8.
Expected<void> check_is_utf8(std::string_view text, const std::string& file);

}  // namespace gnomon

#endif  // GNOMON_SCENE_BASE_TEXT_FILE_H
