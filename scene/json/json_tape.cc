// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/json/json_tape.h"

#include <rapidjson/reader.h>

#include <limits>
#include <unordered_set>
#include <utility>

#include "scene/base/text_file.h"
#include "scene/json/json_text.h"

namespace gnomon {

/// Takes the parser's events down. Containers that are open are the stack.
class TapeWriter : public rapidjson::BaseReaderHandler<rapidjson::UTF8<>, TapeWriter> {
 public:
  TapeWriter(JsonTape& tape, const rapidjson::StringStream& stream, std::size_t start)
      : tape_(tape), stream_(stream), start_(start) {}

  bool is_full() const { return full_; }

  bool Null() { return add(JsonKind::kNull, position() - 4); }
  bool Bool(bool value) {
    return add(value ? JsonKind::kTrue : JsonKind::kFalse, position() - (value ? 4 : 5));
  }
  bool RawNumber(const char*, rapidjson::SizeType, bool) {
    return add(JsonKind::kNumber, position());
  }
  bool String(const char*, rapidjson::SizeType, bool) { return add(JsonKind::kString, position()); }
  bool Key(const char*, rapidjson::SizeType, bool) { return add(JsonKind::kString, position()); }
  bool StartObject() { return open(JsonKind::kObject); }
  bool StartArray() { return open(JsonKind::kArray); }
  bool EndObject(rapidjson::SizeType) { return close(); }
  bool EndArray(rapidjson::SizeType) { return close(); }

 private:
  // Inside a string or number the parser works on a copy of the stream: this is where such a value
  // begins; for true, false and null it is where they end, for a bracket its own place.
  std::size_t position() const { return start_ + stream_.Tell(); }

  bool add(JsonKind kind, std::size_t offset) {
    // The place behind the last value is an index, too.
    if (tape_.places_.size() + 1 == std::numeric_limits<std::uint32_t>::max()) {
      full_ = true;
      return false;
    }
    tape_.places_.push_back(std::uint64_t{offset} << JsonTape::kKindBits |
                            static_cast<std::uint64_t>(kind));
    tape_.next_.push_back(static_cast<std::uint32_t>(tape_.places_.size()));
    return true;
  }
  bool open(JsonKind kind) {
    if (!add(kind, position())) return false;
    open_.push_back(static_cast<std::uint32_t>(tape_.places_.size() - 1));
    return true;
  }
  bool close() {
    tape_.next_[open_.back()] = static_cast<std::uint32_t>(tape_.places_.size());
    open_.pop_back();
    return true;
  }

  JsonTape& tape_;
  const rapidjson::StringStream& stream_;
  const std::size_t start_;
  std::vector<std::uint32_t> open_;
  bool full_ = false;
};

namespace {

unsigned hexadecimal(std::string_view digits) {
  unsigned value = 0;
  for (const char c : digits) {
    value = value * 16 + static_cast<unsigned>(c <= '9' ? c - '0' : (c | 0x20) - 'a' + 10);
  }
  return value;
}

void append_utf8(std::string& text, unsigned code) {
  const auto byte = [&](unsigned value) { text += static_cast<char>(value); };
  if (code < 0x80) {
    byte(code);
  } else if (code < 0x800) {
    byte(0xC0u | (code >> 6));
    byte(0x80u | (code & 0x3Fu));
  } else if (code < 0x10000) {
    byte(0xE0u | (code >> 12));
    byte(0x80u | ((code >> 6) & 0x3Fu));
    byte(0x80u | (code & 0x3Fu));
  } else {
    byte(0xF0u | (code >> 18));
    byte(0x80u | ((code >> 12) & 0x3Fu));
    byte(0x80u | ((code >> 6) & 0x3Fu));
    byte(0x80u | (code & 0x3Fu));
  }
}

/// The character of an escape whose u is at `at`, which goes to its last digit.
unsigned escaped_character(std::string_view text, std::size_t& at) {
  constexpr unsigned kReplacement = 0xFFFD;
  unsigned code = hexadecimal(text.substr(at + 1, 4));
  at += 4;
  if (code < 0xD800 || code > 0xDFFF) return code;
  if (code > 0xDBFF || text.substr(at + 1, 2) != "\\u") return kReplacement;
  const unsigned low = hexadecimal(text.substr(at + 3, 4));
  if (low < 0xDC00 || low > 0xDFFF) return kReplacement;
  at += 6;
  return 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00);
}

std::string unescaped(std::string_view text) {
  constexpr std::string_view kShort = "bfnrt", kMeant = "\b\f\n\r\t";
  std::string result;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] != '\\') {
      result += text[at];
      continue;
    }
    const char c = text[++at];
    const std::size_t known = kShort.find(c);
    if (c == 'u') {
      append_utf8(result, escaped_character(text, at));
    } else {
      result += known == std::string_view::npos ? c : kMeant[known];
    }
  }
  return result;
}

/// What lies between the quotes of the string that begins at `offset`.
std::string_view raw_string(std::string_view text, std::size_t offset) {
  std::size_t at = offset + 1;
  while (text[at] != '"') at += text[at] == '\\' ? 2 : 1;
  return text.substr(offset + 1, at - offset - 1);
}

}  // namespace

std::string_view JsonNode::number() const {
  const std::string_view text = tape_->text_;
  const std::size_t first = offset();
  std::size_t at = first;
  while (at < text.size() && is_number_character(text[at])) ++at;
  return text.substr(first, at - first);
}

std::string JsonNode::string() const {
  const std::string_view raw = raw_string(tape_->text_, offset());
  return raw.find('\\') == std::string_view::npos ? std::string(raw) : unescaped(raw);
}

bool JsonNode::is_text(std::string_view wanted) const {
  if (!is_string()) return false;
  const std::string_view raw = raw_string(tape_->text_, offset());
  return raw == wanted || (raw.find('\\') != std::string_view::npos && unescaped(raw) == wanted);
}

std::size_t JsonNode::size() const {
  std::size_t count = 0;
  for (JsonNode at = begin(); at != end(); at = at.next()) ++count;
  return is_object() ? count / 2 : count;
}

std::optional<JsonNode> JsonNode::find(std::string_view key) const {
  for (JsonNode at = begin(); at != end(); at = at.next().next()) {
    if (at.is_text(key)) return at.next();
  }
  return std::nullopt;
}

std::optional<JsonNode> JsonNode::repeated_key() const {
  std::unordered_set<std::string> keys;
  for (JsonNode at = begin(); at != end(); at = at.next().next()) {
    if (!keys.insert(at.string()).second) return at;
  }
  return std::nullopt;
}

const char* JsonNode::shown_kind() const {
  switch (kind()) {
    case JsonKind::kNull:
      return "null";
    case JsonKind::kFalse:
      return "false";
    case JsonKind::kTrue:
      return "true";
    case JsonKind::kNumber:
      return "a number";
    case JsonKind::kString:
      return "a string";
    case JsonKind::kArray:
      return "an array";
    case JsonKind::kObject:
      return "an object";
  }
  return "";
}

Expected<JsonTape> JsonTape::parse(const std::string& text, const std::string& file,
                                   std::uint64_t first_line) {
  const std::size_t start = byte_order_mark(text);
  const auto at_line = [&](Error error) {
    if (error.where.line != 0) error.where.line += first_line - 1;
    return error;
  };
  LongNumbers long_numbers;
  std::string without_long_numbers;
  const std::string* parsed_text = &text;
  for (;;) {
    JsonTape tape(text, file, first_line);
    rapidjson::StringStream stream(parsed_text->c_str() + start);
    TapeWriter writer(tape, stream, start);
    rapidjson::Reader reader;
    const rapidjson::ParseResult parsed = reader.Parse<kJsonFlags>(stream, writer);
    if (!parsed.IsError()) return tape;
    if (writer.is_full()) {
      return fail(ErrorCode::kLimit, "too many values", "at most 4294967294",
                  ErrorPlace{file, 0, 0, {}});
    }
    if (parsed.Code() == rapidjson::kParseErrorNumberTooBig && long_numbers.empty()) {
      without_long_numbers = text;
      parsed_text = &without_long_numbers;
      long_numbers.hide_in(without_long_numbers);
      if (!long_numbers.empty()) continue;
    }
    return tl::unexpected(
        at_line(json_syntax_error(parsed.Code(), text, start + parsed.Offset(), file, {})));
  }
}

std::string JsonTape::pointer(const JsonNode& node) const {
  std::string pointer;
  JsonNode around = root();
  while (around.index() != node.index()) {
    const bool is_object = around.is_object();
    std::size_t count = 0;
    JsonNode at = around.begin();
    JsonNode key = at;
    if (is_object) at = at.next();
    // A key has the place of its value.
    while (at.next().index() <= node.index()) {
      key = at.next();
      at = is_object ? key.next() : key;
      ++count;
    }
    pointer += "/" + (is_object ? escaped_token(key.string()) : std::to_string(count));
    if (at.index() > node.index()) break;
    around = at;
  }
  return pointer;
}

tl::unexpected<Error> JsonTape::error(const JsonNode& node, ErrorCode code, std::string what,
                                      std::string expected) const {
  ErrorPlace place = place_in_text(file_, text_, node.offset(), pointer(node));
  place.line += first_line_ - 1;
  return fail(code, std::move(what), std::move(expected), std::move(place));
}

tl::unexpected<Error> JsonTape::wrong_kind(const JsonNode& node, std::string expected) const {
  return error(node, ErrorCode::kFormat, std::string("found ") + node.shown_kind(),
               std::move(expected));
}

tl::unexpected<Error> JsonTape::missing(const JsonNode& object, std::string_view key,
                                        std::string expected) const {
  return error(object, ErrorCode::kFormat, "the key '" + std::string(key) + "' is missing",
               std::move(expected));
}

}  // namespace gnomon
