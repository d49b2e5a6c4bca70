// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/json/json_members.h"

#include <fmt/format.h>

#include <limits>
#include <utility>

namespace gnomon {

namespace {

const JsonValue& empty_object() {
  static const JsonValue empty(rapidjson::kObjectType);
  return empty;
}

}  // namespace

const JsonValue* JsonMembers::find(const char* key) {
  const JsonValue* json = find_member(object_, key);
  if (json == nullptr) reject(key);
  return json;
}

void JsonMembers::reject(const char* key) {
  if (error_) return;
  Error& error = error_.emplace();
  error.code = ErrorCode::kFormat;
  error.where.file = file_;
  error.where.pointer = pointer_ + "/" + key;
  error.what = fmt::format("\"{}\" is missing, or not what it should be", key);
  error.expected = expected_;
}

void JsonMembers::read(const char* key, std::string& value) {
  auto text = text_of(find(key));
  if (!text) return reject(key);
  value = *std::move(text);
}

void JsonMembers::read_if_there(const char* key, std::string& value) {
  if (find_member(object_, key) != nullptr) read(key, value);
}

void JsonMembers::read_if_there(const char* key, std::optional<double>& value) {
  if (find_member(object_, key) != nullptr) read(key, value);
}

void JsonMembers::read(const char* key, bool& value) {
  const JsonValue* json = find(key);
  if (json == nullptr) return;
  if (!json->IsBool()) return reject(key);
  value = json->GetBool();
}

void JsonMembers::read(const char* key, double& value) {
  const JsonValue* json = find(key);
  if (json == nullptr) return;
  if (!json->IsNumber()) return reject(key);
  value = json->GetDouble();
}

void JsonMembers::read(const char* key, std::optional<double>& value) {
  const JsonValue* json = find(key);
  if (json == nullptr || json->IsNull()) return;
  if (!json->IsNumber()) return reject(key);
  value = json->GetDouble();
}

void JsonMembers::read(const char* key, std::uint64_t& value) {
  const JsonValue* json = find(key);
  if (json == nullptr) return;
  if (!json->IsUint64()) return reject(key);
  value = json->GetUint64();
}

void JsonMembers::read(const char* key, std::uint32_t& value) {
  const JsonValue* json = find(key);
  if (json == nullptr) return;
  if (!json->IsUint()) return reject(key);
  value = json->GetUint();
}

void JsonMembers::read(const char* key, std::vector<std::string>& value) {
  const JsonValue* json = find(key);
  if (json == nullptr) return;
  if (!json->IsArray()) return reject(key);
  for (const JsonValue& element : json->GetArray()) {
    auto text = text_of(&element);
    if (!text) return reject(key);
    value.push_back(*std::move(text));
  }
}

void JsonMembers::read(const char* key, std::vector<std::uint16_t>& value) {
  const JsonValue* json = find(key);
  if (json == nullptr) return;
  if (!json->IsArray()) return reject(key);
  for (const JsonValue& element : json->GetArray()) {
    if (!element.IsUint() || element.GetUint() > std::numeric_limits<std::uint16_t>::max()) {
      return reject(key);
    }
    value.push_back(static_cast<std::uint16_t>(element.GetUint()));
  }
}

JsonMembers JsonMembers::object(const char* key) {
  const JsonValue* json = find(key);
  if (json != nullptr && !json->IsObject()) {
    reject(key);
    json = nullptr;
  }
  return {json == nullptr ? empty_object() : *json, file_, pointer_ + "/" + key, expected_};
}

JsonMembers JsonMembers::object_if_there(const char* key) {
  if (find_member(object_, key) != nullptr) return object(key);
  return {empty_object(), file_, pointer_ + "/" + key, expected_};
}

std::vector<JsonMembers> JsonMembers::objects(const char* key) {
  std::vector<JsonMembers> all;
  const JsonValue* json = find(key);
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

}  // namespace gnomon
