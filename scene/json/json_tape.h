// SPDX-License-Identifier: LGPL-3.0-or-later
// JSON as the list of its values with their places: a tree that keeps numbers as their texts, for
// readers of formats whose keys come in any order. 12 bytes a value beside the text, no recursion
// at any depth. json_value.h is for small texts whose numbers may be doubles.
#ifndef GNOMON_SCENE_JSON_JSON_TAPE_H
#define GNOMON_SCENE_JSON_JSON_TAPE_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/kernel/error.h"

namespace gnomon {

enum class JsonKind : std::uint8_t { kNull, kFalse, kTrue, kNumber, kString, kArray, kObject };

class JsonTape;

/// One value of a tape, which must outlive it.
class JsonNode {
 public:
  JsonNode(const JsonTape& tape, std::uint32_t index) : tape_(&tape), index_(index) {}

  JsonKind kind() const;
  bool is_object() const { return kind() == JsonKind::kObject; }
  bool is_array() const { return kind() == JsonKind::kArray; }
  bool is_string() const { return kind() == JsonKind::kString; }
  bool is_number() const { return kind() == JsonKind::kNumber; }
  bool is_null() const { return kind() == JsonKind::kNull; }

  /// The byte of the text at which it begins.
  std::size_t offset() const;
  /// A number as it is written. Requires: a number.
  std::string_view number() const;
  /// A string without its escapes; half of a surrogate pair becomes U+FFFD. Requires: a string.
  std::string string() const;
  /// Is it a string of just these characters?
  bool is_text(std::string_view wanted) const;
  /// How many elements or members it has. Cost: their number.
  std::size_t size() const;
  /// The value of the first member of that name. Requires: an object.
  std::optional<JsonNode> find(std::string_view key) const;
  /// The second of two members of one name, which no object should have. Requires: an object.
  std::optional<JsonNode> repeated_key() const;
  /// "an array", "a number", ...: for messages.
  const char* shown_kind() const;

  // What lies in an array, or the keys of an object (next() of a key is its value):
  //   for (JsonNode at = node.begin(); at != node.end(); at = at.next())
  JsonNode begin() const { return {*tape_, index_ + 1}; }
  JsonNode end() const { return next(); }
  JsonNode next() const;
  bool operator==(const JsonNode& other) const { return index_ == other.index_; }

  const JsonTape& tape() const { return *tape_; }
  std::uint32_t index() const { return index_; }

 private:
  const JsonTape* tape_;
  std::uint32_t index_;
};

class JsonTape {
 public:
  /// `text` must outlive the tape and be valid UTF-8; `file` and `first_line`, the number of its
  /// first line, are for messages. Errors: kSyntax and kNumber with line and column, kLimit.
  static Expected<JsonTape> parse(const std::string& text, const std::string& file,
                                  std::uint64_t first_line = 1);

  JsonNode root() const { return {*this, 0}; }
  std::string_view text() const { return text_; }

  /// An error at a value: line, column and JSON pointer.
  tl::unexpected<Error> error(const JsonNode& node, ErrorCode code, std::string what,
                              std::string expected) const;
  /// "found a number" at a value, and what was expected there.
  tl::unexpected<Error> wrong_kind(const JsonNode& node, std::string expected) const;
  /// "the key 'x' is missing" at an object.
  tl::unexpected<Error> missing(const JsonNode& object, std::string_view key,
                                std::string expected) const;

 private:
  friend class JsonNode;
  friend class TapeWriter;
  JsonTape(std::string_view text, std::string file, std::uint64_t first_line)
      : text_(text), file_(std::move(file)), first_line_(first_line) {}
  std::string pointer(const JsonNode& node) const;

  static constexpr unsigned kKindBits = 3;
  std::string_view text_;
  std::string file_;
  std::uint64_t first_line_;
  std::vector<std::uint64_t> places_;  // offset << kKindBits | kind
  std::vector<std::uint32_t> next_;    // the value behind this one and all that it holds
};

inline JsonKind JsonNode::kind() const {
  return static_cast<JsonKind>(tape_->places_[index_] & ((1u << JsonTape::kKindBits) - 1));
}
inline std::size_t JsonNode::offset() const {
  return static_cast<std::size_t>(tape_->places_[index_] >> JsonTape::kKindBits);
}
inline JsonNode JsonNode::next() const { return {*tape_, tape_->next_[index_]}; }

}  // namespace gnomon

#endif  // GNOMON_SCENE_JSON_JSON_TAPE_H
