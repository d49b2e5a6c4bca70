// SPDX-License-Identifier: LGPL-3.0-or-later
// What reading a scene's JSON needs beside the parser: places of JSON pointers, numbers that are
// beyond the parser, and words for its errors.
#ifndef GNOMON_SCENE_JSON_JSON_TEXT_H
#define GNOMON_SCENE_JSON_JSON_TEXT_H

#include <rapidjson/reader.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/kernel/error.h"

namespace gnomon {

/// The only way of parsing here: no recursion, numbers as their texts.
inline constexpr unsigned kJsonFlags =
    rapidjson::kParseIterativeFlag | rapidjson::kParseNumbersAsStringsFlag;

/// May a number of JSON hold it?
inline bool is_number_character(char c) {
  return (c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.' || c == 'e' || c == 'E';
}

/// RapidJSON checks magnitudes against double even when it passes numbers on as texts, and refuses
/// 1e400 or an integer of 310 digits, which are good decimals. This overwrites such numbers by a 0
/// and spaces, so that offsets stay, and keeps their texts.
class LongNumbers {
 public:
  /// Requires: the text parses up to some long number.
  void hide_in(std::string& text);
  bool empty() const { return hidden_.empty(); }
  /// The number that stands at `offset` if it was hidden, else `parsed`.
  std::string_view at(std::size_t offset, std::string_view parsed) const;
  /// text[begin, end) as it was.
  std::string original(std::string_view text, std::size_t begin, std::size_t end) const;

 private:
  struct Hidden {
    std::size_t offset;
    std::string number;
  };
  std::vector<Hidden> hidden_;  // sorted by offset
};

/// The offset of the value at a JSON pointer, or of the innermost value around it that exists.
/// Requires: the text is valid JSON.
std::size_t locate_pointer(const std::string& text, std::string_view pointer);

/// A JSON pointer's token for a key.
std::string escaped_token(std::string_view key);

/// The parser's error in our words.
Error json_syntax_error(rapidjson::ParseErrorCode code, std::string_view text, std::size_t offset,
                        const std::string& file, std::string pointer);

}  // namespace gnomon

#endif  // GNOMON_SCENE_JSON_JSON_TEXT_H
