// SPDX-License-Identifier: GPL-3.0-or-later
// Writes JSON in one stable layout, so that people can read, search and compare it line by line: an
// object or array of layout kLines has one element a line, one of layout kInline is on one line.
//
// Guarantees: doubles read back to the same value, in every locale; NaN and infinity become null;
// the output is valid UTF-8 whatever the strings hold (a broken byte becomes U+FFFD).
#ifndef GNOMON_REPORT_JSON_JSON_WRITER_H
#define GNOMON_REPORT_JSON_JSON_WRITER_H

#include <charconv>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "report/text/text_sink.h"

namespace gnomon::report {

enum class JsonLayout : std::uint8_t { kLines, kInline };

class JsonWriter {
 public:
  explicit JsonWriter(TextSink& sink);
  JsonWriter(const JsonWriter&) = delete;
  JsonWriter& operator=(const JsonWriter&) = delete;
  /// Writes what is still buffered.
  ~JsonWriter();

  void begin_object(JsonLayout layout = JsonLayout::kLines) { begin('{', layout); }
  void end_object() { end('}'); }
  void begin_array(JsonLayout layout = JsonLayout::kLines) { begin('[', layout); }
  void end_array() { end(']'); }

  void key(std::string_view name);
  void value(std::string_view text);
  void value(const char* text) { value(std::string_view(text)); }
  void value(double number);
  void value(bool truth);
  template <std::integral Integer>
  requires(!std::same_as<Integer, bool>) void value(Integer number) {
    element();
    constexpr std::size_t kDigits = 24;
    char* const text = room(kDigits);
    used_ += static_cast<std::size_t>(std::to_chars(text, text + kDigits, number).ptr - text);
  }
  void null();

  template <class Value>
  void member(std::string_view name, const Value& content) {
    key(name);
    value(content);
  }

  /// Ends the document with a line break.
  void finish();

 private:
  struct Level {
    JsonLayout layout;
    bool empty = true;
  };

  void begin(char bracket, JsonLayout layout);
  void end(char bracket);
  void element();
  void append_string(std::string_view text);
  void append_escaped(std::string_view text);
  void new_line();
  /// Where the next `size` characters can be put; whoever puts them adds to used_.
  char* room(std::size_t size) {
    if (buffer_.size() - used_ < size) make_room(size);
    return buffer_.data() + used_;
  }
  void make_room(std::size_t size);
  void append(std::string_view text);
  void append(char c) {
    *room(1) = c;
    ++used_;
  }
  void flush();

  TextSink& sink_;
  std::vector<char> buffer_;
  std::size_t used_ = 0;  // of the buffer
  std::vector<Level> levels_;
  bool after_key_ = false;
};

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_JSON_JSON_WRITER_H
