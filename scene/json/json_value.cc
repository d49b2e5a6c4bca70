// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/json/json_value.h"

#include <rapidjson/error/en.h>

#include "scene/base/text_file.h"

namespace gnomon {

Expected<rapidjson::Document> parse_json(std::string_view text, const std::string& file) {
  rapidjson::Document document;
  document.Parse<rapidjson::kParseIterativeFlag | rapidjson::kParseFullPrecisionFlag>(text.data(),
                                                                                      text.size());
  if (!document.HasParseError()) return document;
  return fail(ErrorCode::kSyntax, rapidjson::GetParseError_En(document.GetParseError()), {},
              place_in_text(file, text, document.GetErrorOffset()));
}

Expected<rapidjson::Document> parse_json_object(std::string_view text, const std::string& file) {
  auto document = parse_json(text, file);
  if (!document || document->IsObject()) return document;
  return fail(ErrorCode::kFormat, "not an object", "an object", {file, 0, 0, {}});
}

const JsonValue* find_member(const JsonValue& object, std::string_view key) {
  const JsonValue name(rapidjson::StringRef(key.data(), key.size()));
  const auto place = object.FindMember(name);
  return place == object.MemberEnd() ? nullptr : &place->value;
}

std::optional<std::string> text_of(const JsonValue* value) {
  if (value == nullptr || !value->IsString()) return std::nullopt;
  return std::string(value->GetString(), value->GetStringLength());
}

}  // namespace gnomon
