// SPDX-License-Identifier: LGPL-3.0-or-later
// JSON as a tree (RapidJSON), for small texts: parsing, and looking up what may be absent.
// json_members.h reads what must be there, and json_text.h serves readers of large files.
#ifndef GNOMON_SCENE_JSON_JSON_VALUE_H
#define GNOMON_SCENE_JSON_JSON_VALUE_H

#include <rapidjson/document.h>

#include <optional>
#include <string>
#include <string_view>

#include "gnomon/kernel/error.h"

namespace gnomon {

using JsonValue = rapidjson::Value;

/// Doubles are the nearest to their text. Errors: kSyntax with line and column. `file` may be
/// empty.
Expected<rapidjson::Document> parse_json(std::string_view text, const std::string& file);
/// Errors: also kFormat, if the text is JSON but no object.
Expected<rapidjson::Document> parse_json_object(std::string_view text, const std::string& file);

/// Null if there is no such member. Requires: an object.
const JsonValue* find_member(const JsonValue& object, std::string_view key);

/// Nothing if the value is null or no text.
std::optional<std::string> text_of(const JsonValue* value);

}  // namespace gnomon

#endif  // GNOMON_SCENE_JSON_JSON_VALUE_H
