// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/scene/groups.h"

#include <rapidjson/stringbuffer.h>
#include <rapidjson/writer.h>

#include <algorithm>
#include <string_view>
#include <unordered_map>

#include "scene/json/json_text.h"
#include "scene/json/json_value.h"

namespace gnomon {

namespace {

constexpr std::string_view kGroups = "groups";

std::string_view view(const JsonValue& text) { return {text.GetString(), text.GetStringLength()}; }

tl::unexpected<Error> error_at(const Scene& scene, ErrorCode code, std::string what,
                               std::string expected, const std::string& pointer) {
  return fail(code, std::move(what), std::move(expected),
              ErrorPlace{scene.file, 0, 0, "/extra/groups" + pointer});
}

/// The polygons of one list of ids.
Expected<std::vector<std::uint32_t>> members_of(
    const Scene& scene, const JsonValue& list, const std::string& pointer,
    const std::unordered_map<std::string_view, std::uint32_t>& polygons) {
  std::vector<std::uint32_t> members;
  for (rapidjson::SizeType i = 0; i < list.Size(); ++i) {
    const std::string place = pointer + "/" + std::to_string(i);
    if (!list[i].IsString()) {
      return error_at(scene, ErrorCode::kFormat, "a member of a group is no text",
                      "the id of a polygon", place);
    }
    const auto found = polygons.find(view(list[i]));
    if (found == polygons.end()) {
      return error_at(scene, ErrorCode::kIndex,
                      "there is no polygon \"" + std::string(view(list[i])) + "\"",
                      "the id of a polygon", place);
    }
    members.push_back(found->second);
  }
  std::ranges::sort(members);
  members.erase(std::unique(members.begin(), members.end()), members.end());
  return members;
}

}  // namespace

Expected<std::vector<PolygonGroup>> polygon_groups(const Scene& scene) {
  std::vector<PolygonGroup> groups;
  if (scene.extra.find("\"groups\"") == std::string::npos) return groups;
  rapidjson::Document extra;
  extra.Parse<kJsonFlags>(scene.extra.data(), scene.extra.size());
  if (extra.HasParseError()) {
    return error_at(scene, ErrorCode::kLimit, "\"extra\" has a number beyond the parser",
                    "groups beside numbers of at most 300 digits", "");
  }
  if (!extra.IsObject()) return groups;
  const JsonValue* named = find_member(extra, kGroups);
  if (named == nullptr) return groups;
  if (!named->IsObject()) {
    return error_at(scene, ErrorCode::kFormat, "\"groups\" is no object",
                    "names with lists of polygon ids", "");
  }
  std::unordered_map<std::string_view, std::uint32_t> polygons;
  for (std::uint32_t i = 0; i < scene.polygons.size(); ++i)
    polygons.emplace(scene.polygons[i].id, i);
  for (const auto& member : named->GetObject()) {
    const std::string pointer = "/" + escaped_token(view(member.name));
    if (!member.value.IsArray()) {
      return error_at(scene, ErrorCode::kFormat, "a group is no list", "a list of polygon ids",
                      pointer);
    }
    auto members = members_of(scene, member.value, pointer, polygons);
    if (!members) return tl::unexpected(std::move(members.error()));
    groups.push_back({std::string(view(member.name)), std::move(*members)});
  }
  return groups;
}

void remove_from_groups(Scene& scene, std::span<const std::string> ids) {
  if (scene.extra.find("\"groups\"") == std::string::npos) return;
  rapidjson::Document extra;
  extra.Parse<rapidjson::kParseFullPrecisionFlag>(scene.extra.data(), scene.extra.size());
  if (extra.HasParseError() || !extra.IsObject()) return;
  const auto named = extra.FindMember(kGroups.data());
  if (named == extra.MemberEnd() || !named->value.IsObject()) return;
  for (auto& member : named->value.GetObject()) {
    if (!member.value.IsArray()) continue;
    for (auto* id = member.value.Begin(); id != member.value.End();) {
      const bool gone = id->IsString() && std::ranges::find(ids, view(*id)) != ids.end();
      id = gone ? member.value.Erase(id) : id + 1;
    }
  }
  rapidjson::StringBuffer buffer;
  rapidjson::Writer<rapidjson::StringBuffer> writer(buffer);
  extra.Accept(writer);
  scene.extra.assign(buffer.GetString(), buffer.GetSize());
}

void set_polygon_groups(Scene& scene, std::span<const PolygonGroup> groups) {
  rapidjson::StringBuffer buffer;
  rapidjson::Writer<rapidjson::StringBuffer> writer(buffer);
  const auto write = [&](const std::string& text) {
    writer.String(text.data(), static_cast<rapidjson::SizeType>(text.size()));
  };
  writer.StartObject();
  write(std::string(kGroups));
  writer.StartObject();
  for (const PolygonGroup& group : groups) {
    write(group.name);
    writer.StartArray();
    for (const std::uint32_t polygon : group.polygons) write(scene.polygons[polygon].id);
    writer.EndArray();
  }
  writer.EndObject();
  writer.EndObject();
  scene.extra.assign(buffer.GetString(), buffer.GetSize());
}

}  // namespace gnomon
