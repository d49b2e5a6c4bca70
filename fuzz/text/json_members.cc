// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/text/json_members.h"

#include <fmt/format.h>
#include <rapidjson/error/en.h>

#include <limits>
#include <utility>

#include "scene/base/text_file.h"

namespace gnomon::fuzz {

namespace {

std::string text_of(const rapidjson::Value& json) {
  return {json.GetString(), json.GetStringLength()};
}

const rapidjson::Value& empty_object() {
  static const rapidjson::Value empty(rapidjson::kObjectType);
  return empty;
}

}  // namespace

Expected<rapidjson::Document> parse_json_object(std::string_view text, const std::string& file) {
  rapidjson::Document document;
  document.Parse<rapidjson::kParseIterativeFlag | rapidjson::kParseFullPrecisionFlag>(text.data(),
                                                                                      text.size());
  if (document.HasParseError()) {
    return fail(ErrorCode::kSyntax, rapidjson::GetParseError_En(document.GetParseError()), {},
                place_in_text(file, text, document.GetErrorOffset()));
  }
  if (!document.IsObject()) {
    return fail(ErrorCode::kFormat, "not an object", "an object", {file, 0, 0, {}});
  }
  return document;
}

const rapidjson::Value* JsonMembers::find(const char* key) {
  const auto place = object_.FindMember(key);
  if (place != object_.MemberEnd()) return &place->value;
  reject(key);
  return nullptr;
}

void JsonMembers::reject(const char* key) {
  if (error_) return;
  error_ = Error{ErrorCode::kFormat,
                 {file_, 0, 0, pointer_ + "/" + key},
                 fmt::format("\"{}\" is missing, or not what it should be", key),
                 std::string(expected_)};
}

void JsonMembers::read(const char* key, std::string& value) {
  const rapidjson::Value* json = find(key);
  if (json == nullptr) return;
  if (!json->IsString()) return reject(key);
  value = text_of(*json);
}

void JsonMembers::read(const char* key, bool& value) {
  const rapidjson::Value* json = find(key);
  if (json == nullptr) return;
  if (!json->IsBool()) return reject(key);
  value = json->GetBool();
}

void JsonMembers::read(const char* key, double& value) {
  const rapidjson::Value* json = find(key);
  if (json == nullptr) return;
  if (!json->IsNumber()) return reject(key);
  value = json->GetDouble();
}

void JsonMembers::read(const char* key, std::optional<double>& value) {
  const rapidjson::Value* json = find(key);
  if (json == nullptr || json->IsNull()) return;
  if (!json->IsNumber()) return reject(key);
  value = json->GetDouble();
}

void JsonMembers::read(const char* key, std::uint64_t& value) {
  const rapidjson::Value* json = find(key);
  if (json == nullptr) return;
  if (!json->IsUint64()) return reject(key);
  value = json->GetUint64();
}

void JsonMembers::read(const char* key, std::uint32_t& value) {
  const rapidjson::Value* json = find(key);
  if (json == nullptr) return;
  if (!json->IsUint()) return reject(key);
  value = json->GetUint();
}

void JsonMembers::read(const char* key, std::vector<std::string>& value) {
  const rapidjson::Value* json = find(key);
  if (json == nullptr) return;
  if (!json->IsArray()) return reject(key);
  for (const rapidjson::Value& element : json->GetArray()) {
    if (!element.IsString()) return reject(key);
    value.push_back(text_of(element));
  }
}

void JsonMembers::read(const char* key, std::vector<std::uint16_t>& value) {
  const rapidjson::Value* json = find(key);
  if (json == nullptr) return;
  if (!json->IsArray()) return reject(key);
  for (const rapidjson::Value& element : json->GetArray()) {
    if (!element.IsUint() || element.GetUint() > std::numeric_limits<std::uint16_t>::max()) {
      return reject(key);
    }
    value.push_back(static_cast<std::uint16_t>(element.GetUint()));
  }
}

JsonMembers JsonMembers::object(const char* key) {
  const rapidjson::Value* json = find(key);
  if (json != nullptr && !json->IsObject()) {
    reject(key);
    json = nullptr;
  }
  return {json == nullptr ? empty_object() : *json, file_, pointer_ + "/" + key, expected_};
}

std::vector<JsonMembers> JsonMembers::objects(const char* key) {
  std::vector<JsonMembers> all;
  const rapidjson::Value* json = find(key);
  if (json == nullptr) return all;
  if (!json->IsArray()) {
    reject(key);
    return all;
  }
  for (rapidjson::SizeType i = 0; i < json->Size(); ++i) {
    if (!(*json)[i].IsObject()) {
      reject(key);
      return all;
    }
    all.emplace_back((*json)[i], file_, fmt::format("{}/{}/{}", pointer_, key, i), expected_);
  }
  return all;
}

}  // namespace gnomon::fuzz
