// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/json/json_text.h"

#include <algorithm>

#include "scene/base/text_file.h"

namespace gnomon {

namespace {

/// Does a number of this text lie beyond what RapidJSON takes? Generous: nothing is lost if not.
bool is_long(std::string_view number) {
  constexpr std::size_t kManyCharacters = 300;
  constexpr std::size_t kManyExponentDigits = 3;
  if (number.size() >= kManyCharacters) return true;
  const std::size_t exponent = number.find_first_of("eE");
  return exponent != std::string_view::npos && number.size() - exponent - 1 >= kManyExponentDigits;
}

/// Is it a number of JSON's grammar? Others are left for the parser to complain about.
bool is_json_number(std::string_view text) {
  std::size_t at = 0;
  const auto digits = [&] {
    const std::size_t first = at;
    while (at < text.size() && text[at] >= '0' && text[at] <= '9') ++at;
    return at - first;
  };
  if (at < text.size() && text[at] == '-') ++at;
  const std::size_t first = at;
  const std::size_t count = digits();
  if (count == 0 || (count > 1 && text[first] == '0')) return false;
  if (at < text.size() && text[at] == '.') {
    ++at;
    if (digits() == 0) return false;
  }
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    ++at;
    if (at < text.size() && (text[at] == '+' || text[at] == '-')) ++at;
    if (digits() == 0) return false;
  }
  return at == text.size();
}

/// Follows the parser down the path of one JSON pointer.
class Locator : public rapidjson::BaseReaderHandler<rapidjson::UTF8<>, Locator> {
 public:
  Locator(const rapidjson::StringStream& stream, std::string_view pointer) : stream_(stream) {
    while (!pointer.empty()) {
      pointer.remove_prefix(1);  // the slash
      const std::size_t end = std::min(pointer.find('/'), pointer.size());
      path_.emplace_back(pointer.substr(0, end));
      pointer.remove_prefix(end);
    }
  }
  std::size_t offset() const { return offset_; }

  bool Null() { return value(stream_.Tell() - 4); }
  bool Bool(bool is_true) { return value(stream_.Tell() - (is_true ? 4 : 5)); }
  bool RawNumber(const char*, rapidjson::SizeType, bool) { return value(stream_.Tell()); }
  bool String(const char*, rapidjson::SizeType, bool) { return value(stream_.Tell()); }
  bool StartObject() { return open(); }
  bool StartArray() { return open(); }
  bool EndObject(rapidjson::SizeType) { return close(); }
  bool EndArray(rapidjson::SizeType) { return close(); }
  bool Key(const char* text, rapidjson::SizeType length, bool) {
    if (on_path()) {
      key_matches_ = escaped_token({text, length}) == path_[depth_ - 1];
      in_object_ = true;
    }
    return true;
  }

 private:
  /// Is the innermost open container one on the path?
  bool on_path() const { return depth_ > 0 && depth_ == matched_ && depth_ <= path_.size(); }

  /// False stops the parser: found.
  bool value(std::size_t offset) { return !(begins(offset) && matched_ > path_.size()); }

  bool open() {
    const bool matches = begins(stream_.Tell());
    if (matches && matched_ > path_.size()) return false;
    ++depth_;
    if (matches) {
      index_ = 0;
      in_object_ = false;
      key_matches_ = false;
    }
    return true;
  }

  bool close() {
    // Leaving a container on the path: the rest of the path is not there.
    if (depth_ == matched_) return false;
    --depth_;
    return true;
  }

  /// A value begins: is it on the path? `matched_` counts the values on the path so far, root
  /// included.
  bool begins(std::size_t offset) {
    if (depth_ == 0) {
      matched_ = 1;
      offset_ = offset;
      return true;
    }
    if (!on_path()) return false;
    const bool matches = in_object_ ? key_matches_ : std::to_string(index_++) == path_[depth_ - 1];
    if (!matches) return false;
    ++matched_;
    offset_ = offset;
    return true;
  }

  const rapidjson::StringStream& stream_;
  std::vector<std::string> path_;
  std::size_t depth_ = 0;    // open containers
  std::size_t matched_ = 0;  // of them on the path, counted from the root
  std::size_t index_ = 0;    // in the innermost array on the path
  bool in_object_ = false;
  bool key_matches_ = false;
  std::size_t offset_ = 0;
};

struct Words {
  const char* what;
  const char* expected;
};

Words words_for(rapidjson::ParseErrorCode code) {
  switch (code) {
    case rapidjson::kParseErrorDocumentEmpty:
      return {"the file is empty", "a scene"};
    case rapidjson::kParseErrorDocumentRootNotSingular:
      return {"text after the end of the scene", "the end of the file"};
    case rapidjson::kParseErrorObjectMissName:
      return {"this is not a key", "a key in double quotes"};
    case rapidjson::kParseErrorObjectMissColon:
      return {"no colon after the key", "':'"};
    case rapidjson::kParseErrorObjectMissCommaOrCurlyBracket:
      return {"the object does not go on here", "',' or '}'"};
    case rapidjson::kParseErrorArrayMissCommaOrSquareBracket:
      return {"the array does not go on here", "',' or ']'"};
    case rapidjson::kParseErrorStringUnicodeEscapeInvalidHex:
      return {"a wrong \\u escape in a string", "four hexadecimal digits"};
    case rapidjson::kParseErrorStringUnicodeSurrogateInvalid:
      return {"half of a surrogate pair in a string", "both halves"};
    case rapidjson::kParseErrorStringEscapeInvalid:
      return {"a wrong escape in a string", "one of \\\" \\\\ \\/ \\b \\f \\n \\r \\t \\uXXXX"};
    case rapidjson::kParseErrorStringMissQuotationMark:
      return {"the string does not end", "a closing double quote"};
    case rapidjson::kParseErrorStringInvalidEncoding:
      return {"a control character in a string", "an escape such as \\n"};
    case rapidjson::kParseErrorNumberMissFraction:
      return {"a number without digits after its point", "a digit"};
    case rapidjson::kParseErrorNumberMissExponent:
      return {"a number without digits in its exponent", "a digit"};
    default:
      return {"this is not JSON", "a JSON value"};
  }
}

}  // namespace

void LongNumbers::hide_in(std::string& text) {
  std::size_t at = 0;
  while (at < text.size()) {
    if (text[at] == '"') {
      for (++at; at < text.size() && text[at] != '"'; ++at) {
        if (text[at] == '\\') ++at;
      }
      ++at;
    } else if (text[at] == '-' || (text[at] >= '0' && text[at] <= '9')) {
      const std::size_t first = at;
      while (at < text.size() && is_number_character(text[at])) ++at;
      const std::string_view number(text.data() + first, at - first);
      if (!is_long(number) || !is_json_number(number)) continue;
      hidden_.push_back({first, std::string(number)});
      std::fill(text.begin() + static_cast<std::ptrdiff_t>(first),
                text.begin() + static_cast<std::ptrdiff_t>(at), ' ');
      text[first] = '0';
    } else {
      ++at;
    }
  }
}

std::string_view LongNumbers::at(std::size_t offset, std::string_view parsed) const {
  if (hidden_.empty()) return parsed;
  const auto found = std::lower_bound(
      hidden_.begin(), hidden_.end(), offset,
      [](const Hidden& hidden, std::size_t wanted) { return hidden.offset < wanted; });
  return found != hidden_.end() && found->offset == offset ? std::string_view(found->number)
                                                           : parsed;
}

std::string LongNumbers::original(std::string_view text, std::size_t begin, std::size_t end) const {
  std::string result(text.substr(begin, end - begin));
  for (const Hidden& hidden : hidden_) {
    if (hidden.offset < begin || hidden.offset >= end) continue;
    result.replace(hidden.offset - begin, hidden.number.size(), hidden.number);
  }
  return result;
}

std::size_t locate_pointer(const std::string& text, std::string_view pointer) {
  const std::size_t start = byte_order_mark(text);
  rapidjson::StringStream stream(text.c_str() + start);
  Locator locator(stream, pointer);
  rapidjson::Reader reader;
  reader.Parse<kJsonFlags>(stream, locator);
  return start + locator.offset();
}

std::string escaped_token(std::string_view key) {
  std::string result;
  for (const char c : key) {
    if (c == '~') {
      result += "~0";
    } else if (c == '/') {
      result += "~1";
    } else {
      result += c;
    }
  }
  return result;
}

Error json_syntax_error(rapidjson::ParseErrorCode code, std::string_view text, std::size_t offset,
                        const std::string& file, std::string pointer) {
  const bool is_control_character = code == rapidjson::kParseErrorStringEscapeInvalid &&
                                    offset < text.size() &&
                                    static_cast<unsigned char>(text[offset]) < 0x20;
  const Words words =
      words_for(is_control_character ? rapidjson::kParseErrorStringInvalidEncoding : code);
  std::string what = words.what;
  std::string expected = words.expected;
  ErrorCode cause = ErrorCode::kSyntax;
  const std::size_t rest = std::min(text.find_first_not_of(" \t\r\n", offset), text.size());
  if (rest == text.size() && !is_control_character && code != rapidjson::kParseErrorDocumentEmpty) {
    what = "the file ends too early";
    offset = text.size();
  } else if (code == rapidjson::kParseErrorValueInvalid) {
    offset = rest;
    // The parser may complain inside a word, such as behind a minus sign.
    constexpr std::string_view kEndOfWord = " \t\r\n,:[]{}\"";
    while (offset > 0 && kEndOfWord.find(text[offset - 1]) == std::string_view::npos) --offset;
    std::size_t end = offset + 1;
    while (end < text.size() && kEndOfWord.find(text[end]) == std::string_view::npos) {
      ++end;
    }
    const std::string_view word = text.substr(offset, end - offset);
    std::string lower;
    for (const char c : word.substr(0, 4)) {
      if (c != '-' && c != '+') lower += static_cast<char>(c | 0x20);
    }
    what = quoted_text(word) + " is not a JSON value";
    if (lower.starts_with("nan") || lower.starts_with("inf")) {
      cause = ErrorCode::kNumber;
      what = quoted_text(word) + " is not finite";
      expected = "a finite number";
    }
  }
  return Error{cause, place_in_text(file, text, offset, std::move(pointer)), std::move(what),
               std::move(expected)};
}

}  // namespace gnomon
