// SPDX-License-Identifier: LGPL-3.0-or-later
// Reads the fields of a result file one by one. Every error names the file and the place, and says
// what was expected.
//
// Exactness: numbers stay text until someone asks for them, and are read as the scene means them.
#ifndef GNOMON_RESULT_JSON_FIELDS_H
#define GNOMON_RESULT_JSON_FIELDS_H

#include <rapidjson/document.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/kernel/error.h"
#include "gnomon/result/claims.h"
#include "gnomon/scene/scene.h"

namespace gnomon {

using Json = rapidjson::Value;

/// [+-]digits[/digits] with a positive denominator.
std::optional<mpq_class> parse_rational(std::string_view text);

class JsonFields {
 public:
  JsonFields(std::string file, NumberMeaning numbers) : file_(std::move(file)), numbers_(numbers) {}

  /// The text of a file. Errors: kFile.
  static Expected<std::string> read_file(const std::string& path);
  /// Errors: kSyntax, with line and column.
  Expected<void> parse(std::string_view text, rapidjson::Document& document) const;

  tl::unexpected<Error> wrong(ErrorCode code, const std::string& pointer, std::string what,
                              std::string expected = {}) const;
  /// Null where the key is absent and not required.
  Expected<const Json*> member(const Json& object, const char* key, bool required,
                               const std::string& pointer) const;
  Expected<const Json*> list(const Json& object, const char* key, bool required,
                             const std::string& pointer) const;
  Expected<std::string> text(const Json& value, const std::string& pointer) const;
  Expected<std::string> text_member(const Json& object, const char* key,
                                    const std::string& pointer) const;
  /// Empty where the key is absent or null.
  Expected<std::string> optional_text(const Json& object, const char* key,
                                      const std::string& pointer) const;
  Expected<std::vector<std::string>> texts(const Json& object, const char* key, bool required,
                                           const std::string& pointer) const;
  /// A whole number of at least `least` and below 2^53; none where the key is absent and not
  /// required.
  Expected<std::optional<std::int64_t>> whole_number(const Json& object, const char* key,
                                                     std::int64_t least, bool required,
                                                     const std::string& pointer) const;
  Expected<LightState> state(const Json& value, const std::string& pointer) const;
  Expected<std::optional<LightState>> optional_state(const Json& object, const char* key,
                                                     const std::string& pointer) const;
  /// Points of three coordinates; `exact`: also rationals as text.
  Expected<RationalLoop> loop(const Json& array, bool exact, const std::string& pointer) const;
  /// "exact_loop" if it is there, else "loop"; and the holes to it.
  Expected<ClaimedShape> shape(const Json& object, const std::string& pointer) const;
  /// An exact fraction that an entry such as "lit" claims; none if it claims a rounded one.
  std::optional<mpq_class> fraction(const Json& polygon, const char* state) const;
  /// What a value is, for messages: "null", "an array", "the text \"x\"", "an object with \"x\"".
  static std::string form_of(const Json& value);
  /// Its text as written if it is a number, or a string; the other is empty.
  static std::string_view number_text(const Json& value);
  static std::string_view string_text(const Json& value);

 private:
  tl::unexpected<Error> wrong_place(std::string_view text, std::size_t offset,
                                    std::string what) const;
  /// Its errors name the file alone, and no place in it.
  Expected<mpq_class> coordinate(const Json& value, bool exact) const;

  std::string file_;
  NumberMeaning numbers_;
};

}  // namespace gnomon

#endif  // GNOMON_RESULT_JSON_FIELDS_H
