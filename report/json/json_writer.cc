// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/json/json_writer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "report/text/number_text.h"
#include "scene/base/text_file.h"

namespace gnomon::report {

namespace {

constexpr std::size_t kBufferSize = std::size_t{1} << 16;

/// Characters that stand for themselves in a string.
constexpr std::array<bool, 256> kPlain = [] {
  std::array<bool, 256> plain{};
  for (std::size_t c = 0x20; c < 0x7f; ++c) plain[c] = c != '"' && c != '\\';
  return plain;
}();
bool is_plain(char c) { return kPlain[static_cast<unsigned char>(c)]; }

}  // namespace

JsonWriter::JsonWriter(TextSink& sink) : sink_(sink), buffer_(kBufferSize) {}

JsonWriter::~JsonWriter() { flush(); }

void JsonWriter::key(std::string_view name) {
  element();
  append_string(name);
  append(": ");
  after_key_ = true;
}

void JsonWriter::value(std::string_view text) {
  element();
  append_string(text);
}

void JsonWriter::value(double number) {
  if (!std::isfinite(number)) {
    null();
    return;
  }
  element();
  char* const text = room(kLongestShortest);
  used_ += static_cast<std::size_t>(write_shortest(text, number) - text);
}

void JsonWriter::value(bool truth) {
  element();
  append(truth ? "true" : "false");
}

void JsonWriter::null() {
  element();
  append("null");
}

void JsonWriter::finish() {
  append('\n');
  flush();
}

void JsonWriter::begin(char bracket, JsonLayout layout) {
  element();
  append(bracket);
  // What stands in a line cannot hold lines.
  const bool in_line = !levels_.empty() && levels_.back().layout == JsonLayout::kInline;
  levels_.push_back({in_line ? JsonLayout::kInline : layout});
}

void JsonWriter::end(char bracket) {
  const Level level = levels_.back();
  levels_.pop_back();
  if (level.layout == JsonLayout::kLines && !level.empty) new_line();
  append(bracket);
}

void JsonWriter::element() {
  if (after_key_) {
    after_key_ = false;
    return;
  }
  if (levels_.empty()) return;
  Level& level = levels_.back();
  if (!level.empty) append(level.layout == JsonLayout::kInline ? ", " : ",");
  level.empty = false;
  if (level.layout == JsonLayout::kLines) new_line();
}

void JsonWriter::append_string(std::string_view text) {
  if (!std::ranges::all_of(text, is_plain)) {
    append_escaped(text);
    return;
  }
  char* const at = room(text.size() + 2);
  *at = '"';
  std::ranges::copy(text, at + 1);
  at[text.size() + 1] = '"';
  used_ += text.size() + 2;
}

void JsonWriter::append_escaped(std::string_view text) {
  static constexpr char kHex[] = "0123456789abcdef";
  append('"');
  while (!text.empty()) {
    const char c = text.front();
    std::size_t length = 1;
    if (is_plain(c)) {
      append(c);
    } else if (c == '"' || c == '\\') {
      append('\\');
      append(c);
    } else if (c == '\n') {
      append("\\n");
    } else if (c == '\t') {
      append("\\t");
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      append("\\u00");
      append(kHex[static_cast<unsigned char>(c) >> 4]);
      append(kHex[static_cast<unsigned char>(c) & 15]);
    } else if ((length = utf8_length(text, 0)) != 0) {
      append(text.substr(0, length));
    } else {
      append("\xef\xbf\xbd");
      length = 1;
    }
    text.remove_prefix(length);
  }
  append('"');
}

void JsonWriter::new_line() {
  char* const at = room(levels_.size() + 1);
  *at = '\n';
  std::fill_n(at + 1, levels_.size(), ' ');
  used_ += levels_.size() + 1;
}

void JsonWriter::make_room(std::size_t size) {
  flush();
  if (size > buffer_.size()) buffer_.resize(size);
}

void JsonWriter::append(std::string_view text) {
  std::ranges::copy(text, room(text.size()));
  used_ += text.size();
}

void JsonWriter::flush() {
  sink_.write({buffer_.data(), used_});
  used_ = 0;
}

}  // namespace gnomon::report
