// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/json/json_writer.h"

#include <cmath>

#include "report/text/number_text.h"

namespace gnomon::report {

namespace {

constexpr std::size_t kBufferSize = std::size_t{1} << 16;

/// The length of the valid UTF-8 sequence at the start of the text, 0 if there is none.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return 1;
  const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
  }
  const bool overlong = (lead == 0xe0 && byte(1) < 0xa0) || (lead == 0xf0 && byte(1) < 0x90);
  const bool surrogate = lead == 0xed && byte(1) > 0x9f;
  const bool beyond = lead == 0xf4 && byte(1) > 0x8f;
  return overlong || surrogate || beyond ? 0 : length;
}

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
  buffer_ += shortest(number);
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
  const auto is_plain = [](char c) { return c >= 0x20 && c < 0x7f && c != '"' && c != '\\'; };
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
    } else if ((length = utf8_length(text)) != 0) {
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
