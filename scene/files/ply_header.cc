// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/files/ply_header.h"

#include <algorithm>

#include "scene/base/text_file.h"
#include "scene/files/mesh_text.h"

namespace gnomon {

namespace {

struct TypeWord {
  std::string_view word;
  PlyType type;
};

constexpr TypeWord kTypes[] = {
    {"char", PlyType::kInt8},      {"int8", PlyType::kInt8},       {"uchar", PlyType::kUint8},
    {"uint8", PlyType::kUint8},    {"short", PlyType::kInt16},     {"int16", PlyType::kInt16},
    {"ushort", PlyType::kUint16},  {"uint16", PlyType::kUint16},   {"int", PlyType::kInt32},
    {"int32", PlyType::kInt32},    {"uint", PlyType::kUint32},     {"uint32", PlyType::kUint32},
    {"float", PlyType::kFloat32},  {"float32", PlyType::kFloat32}, {"double", PlyType::kFloat64},
    {"float64", PlyType::kFloat64}};

class HeaderReader {
 public:
  HeaderReader(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  Expected<PlyHeader> read() {
    if (!next_line() || words_.size() != 1 || words_[0].text != "ply") {
      return error(ErrorCode::kSyntax, "the file does not begin with 'ply'", "a PLY file", 0);
    }
    bool has_format = false;
    for (;;) {
      if (!next_line()) {
        return error(ErrorCode::kSyntax, "the header does not end", "end_header", text_.size());
      }
      if (words_.empty()) continue;
      const std::string_view keyword = words_[0].text;
      if (keyword == "comment" || keyword == "obj_info") continue;
      Expected<void> done;
      if (keyword == "format") {
        done = format();
        has_format = true;
      } else if (keyword == "element") {
        done = element();
      } else if (keyword == "property") {
        done = property();
      } else if (keyword == "end_header") {
        break;
      } else {
        done = error(ErrorCode::kSyntax, quoted_text(keyword) + " in the header",
                     "format, comment, element, property or end_header", words_[0].offset);
      }
      if (!done) return tl::unexpected(std::move(done.error()));
    }
    if (!has_format) {
      return error(ErrorCode::kFormat, "a header without format",
                   "a line such as 'format ascii 1.0'", words_[0].offset);
    }
    header_.size = at_;
    if (auto room = check_room(); !room) return tl::unexpected(std::move(room.error()));
    return std::move(header_);
  }

 private:
  tl::unexpected<Error> error(ErrorCode code, std::string what, std::string expected,
                              std::size_t offset) const {
    return fail(code, std::move(what), std::move(expected), place_in_text(file_, text_, offset));
  }

  /// Takes the next line apart. The header is text whatever follows it.
  bool next_line() {
    words_.clear();
    line_ = at_;
    const std::size_t end = text_.find('\n', at_);
    if (end == std::string_view::npos) return false;
    while (at_ < end) {
      at_ = std::min(text_.find_first_not_of(" \t\r", at_), end);
      const std::size_t last = std::min(text_.find_first_of(" \t\r\n", at_), end);
      if (last > at_) words_.push_back({text_.substr(at_, last - at_), at_});
      at_ = last;
    }
    at_ = end + 1;
    return true;
  }

  Expected<void> expect_words(std::size_t count, const char* form) const {
    if (words_.size() == count) return {};
    return error(ErrorCode::kSyntax, "a line of " + std::to_string(words_.size()) + " words", form,
                 line_);
  }

  Expected<void> format() {
    if (auto well_formed = expect_words(3, "format ascii 1.0"); !well_formed) return well_formed;
    const Token& kind = words_[1];
    if (kind.text == "ascii") {
      header_.encoding = PlyEncoding::kAscii;
    } else if (kind.text == "binary_little_endian") {
      header_.encoding = PlyEncoding::kLittleEndian;
    } else if (kind.text == "binary_big_endian") {
      header_.encoding = PlyEncoding::kBigEndian;
    } else {
      return error(ErrorCode::kFormat, "format " + quoted_text(kind.text),
                   "ascii, binary_little_endian or binary_big_endian", kind.offset);
    }
    if (words_[2].text != "1.0") {
      return error(ErrorCode::kFormat, "version " + quoted_text(words_[2].text), "version 1.0",
                   words_[2].offset);
    }
    return {};
  }

  Expected<void> element() {
    if (auto well_formed = expect_words(3, "element NAME COUNT"); !well_formed) return well_formed;
    const auto count = to_integer(words_[2].text);
    if (!count || *count < 0) {
      return error(ErrorCode::kSyntax, quoted_text(words_[2].text) + " is not a count",
                   "an integer that is not negative", words_[2].offset);
    }
    const std::string_view name = words_[1].text;
    // Others may be as many as they like.
    if ((name == "vertex" || name == "face") &&
        std::ranges::find(header_.elements, name, &PlyElement::name) != header_.elements.end()) {
      return error(ErrorCode::kFormat, "a second element " + quoted_text(name), "each element once",
                   words_[1].offset);
    }
    header_.elements.push_back({name, static_cast<std::uint64_t>(*count), words_[2].offset, {}});
    return {};
  }

  Expected<PlyType> type(const Token& word) const {
    for (const TypeWord& known : kTypes) {
      if (known.word == word.text) return known.type;
    }
    return error(ErrorCode::kFormat, "unknown type " + quoted_text(word.text),
                 "char, uchar, short, ushort, int, uint, float or double", word.offset);
  }

  Expected<void> property() {
    if (header_.elements.empty()) {
      return error(ErrorCode::kFormat, "a property of no element", "element NAME COUNT first",
                   line_);
    }
    PlyProperty result;
    const bool is_list = words_.size() > 1 && words_[1].text == "list";
    auto well_formed = is_list ? expect_words(5, "property list TYPE TYPE NAME")
                               : expect_words(3, "property TYPE NAME");
    if (!well_formed) return well_formed;
    if (is_list) {
      auto count = type(words_[2]);
      if (!count) return tl::unexpected(std::move(count.error()));
      if (!is_integer(*count)) {
        return error(ErrorCode::kFormat, "a list whose length is not an integer", "such as uchar",
                     words_[2].offset);
      }
      result.list_count = *count;
    }
    auto value = type(words_[is_list ? 3 : 1]);
    if (!value) return tl::unexpected(std::move(value.error()));
    result.type = *value;
    result.name = words_.back().text;
    header_.elements.back().properties.push_back(result);
    return {};
  }

  /// Each element takes some bytes at least; nothing is read or reserved for one that cannot be
  /// there.
  Expected<void> check_room() const {
    const bool is_text = header_.encoding == PlyEncoding::kAscii;
    std::uint64_t rest = text_.size() - header_.size + (is_text ? 1 : 0);
    for (const PlyElement& element : header_.elements) {
      std::uint64_t least = 0;
      for (const PlyProperty& property : element.properties) {
        least += is_text ? 2 : ply_size(property.list_count.value_or(property.type));
      }
      if (least == 0) continue;
      if (element.count > rest / least) {
        return error(
            ErrorCode::kFormat,
            std::to_string(element.count) + " elements " + quoted_text(element.name) + " announced",
            "at most " + std::to_string(rest / least) + ", for which the file has room",
            element.offset);
      }
      rest -= element.count * least;
    }
    return {};
  }

  std::string_view text_;
  const std::string& file_;
  PlyHeader header_;
  std::vector<Token> words_;
  std::size_t at_ = 0, line_ = 0;
};

}  // namespace

Expected<PlyHeader> read_ply_header(std::string_view text, const std::string& file) {
  return HeaderReader(text, file).read();
}

}  // namespace gnomon
