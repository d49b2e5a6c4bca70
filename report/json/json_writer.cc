// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/json/json_writer.h"

#include <array>
#include <cmath>

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

JsonWriter::~JsonWriter() { sink_.write(buffer_); }

void JsonWriter::key(std::string_view name) {
  element();
  append_string(name);
  buffer_ += ": ";
  after_key_ = true;
}

void JsonWriter::value(std::string_view text) {
  element();
  append_string(text);
  flush_if_full();
}

void JsonWriter::value(double number) {
  if (!std::isfinite(number)) {
    null();
    return;
  }
  element();
  append_shortest(buffer_, number);
  flush_if_full();
}

void JsonWriter::value(bool truth) {
  element();
  buffer_ += truth ? "true" : "false";
}

void JsonWriter::null() {
  element();
  buffer_ += "null";
}

void JsonWriter::finish() {
  buffer_ += '\n';
  sink_.write(buffer_);
  buffer_.clear();
}

void JsonWriter::begin(char bracket, JsonLayout layout) {
  element();
  buffer_ += bracket;
  // What stands in a line cannot hold lines.
  const bool in_line = !levels_.empty() && levels_.back().layout == JsonLayout::kInline;
  levels_.push_back({in_line ? JsonLayout::kInline : layout});
}

void JsonWriter::end(char bracket) {
  const Level level = levels_.back();
  levels_.pop_back();
  if (level.layout == JsonLayout::kLines && !level.empty) new_line();
  buffer_ += bracket;
  flush_if_full();
}

void JsonWriter::element() {
  if (after_key_) {
    after_key_ = false;
    return;
  }
  if (levels_.empty()) return;
  Level& level = levels_.back();
  if (!level.empty) buffer_ += level.layout == JsonLayout::kInline ? ", " : ",";
  level.empty = false;
  if (level.layout == JsonLayout::kLines) new_line();
}

void JsonWriter::append_string(std::string_view text) {
  static constexpr char kHex[] = "0123456789abcdef";
  buffer_ += '"';
  while (!text.empty()) {
    std::size_t length = 0;
    while (length < text.size() && is_plain(text[length])) ++length;
    buffer_ += text.substr(0, length);
    text.remove_prefix(length);
    if (text.empty()) break;
    const char c = text.front();
    length = 1;
    if (c == '"' || c == '\\') {
      buffer_ += '\\';
      buffer_ += c;
    } else if (c == '\n') {
      buffer_ += "\\n";
    } else if (c == '\t') {
      buffer_ += "\\t";
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      buffer_ += "\\u00";
      buffer_ += kHex[static_cast<unsigned char>(c) >> 4];
      buffer_ += kHex[static_cast<unsigned char>(c) & 15];
    } else if ((length = utf8_length(text, 0)) != 0) {
      buffer_ += text.substr(0, length);
    } else {
      buffer_ += "\xef\xbf\xbd";
      length = 1;
    }
    text.remove_prefix(length);
  }
  buffer_ += '"';
}

void JsonWriter::new_line() {
  buffer_ += '\n';
  buffer_.append(levels_.size(), ' ');
}

void JsonWriter::flush_if_full() {
  if (buffer_.size() < kBufferSize) return;
  sink_.write(buffer_);
  buffer_.clear();
}

}  // namespace gnomon::report
