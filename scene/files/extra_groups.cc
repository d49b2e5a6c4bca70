// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/files/extra_groups.h"

#include <rapidjson/stringbuffer.h>
#include <rapidjson/writer.h>

#include <unordered_set>

namespace gnomon {

void GroupList::add(const std::string& name, std::uint32_t polygon) {
  const auto [place, is_new] = index_.try_emplace(name, list_.size());
  if (is_new) list_.push_back({name, {}});
  list_[place->second].polygons.push_back(polygon);
}

std::vector<std::string> kind_names(std::span<const PolygonGroup> owners,
                                    std::span<const PolygonGroup> kinds) {
  std::unordered_set<std::string_view> taken;
  for (const PolygonGroup& owner : owners) taken.insert(owner.name);
  std::vector<std::string> names;
  for (const PolygonGroup& kind : kinds) {
    std::string name = kind.name;
    while (taken.contains(name)) name += " surfaces";
    names.push_back(std::move(name));
  }
  return names;
}

std::string extra_with_groups(const Scene& scene, std::span<const PolygonGroup> owners,
                              std::span<const PolygonGroup> kinds, std::string_view format,
                              std::span<const ExtraFact> facts) {
  std::vector<ExtraFact> groups;
  const auto add = [&](const std::string& name, const PolygonGroup& group) {
    std::vector<std::string> ids;
    for (const std::uint32_t polygon : group.polygons) ids.push_back(scene.polygons[polygon].id);
    groups.emplace_back(name, json_array(ids));
  };
  for (const PolygonGroup& owner : owners) add(owner.name, owner);
  const std::vector<std::string> names = kind_names(owners, kinds);
  for (std::size_t i = 0; i < kinds.size(); ++i) add(names[i], kinds[i]);
  return json_object(std::vector<ExtraFact>{{"groups", json_object(groups)},
                                            {std::string(format), json_object(facts)}});
}

std::string json_string(std::string_view text) {
  rapidjson::StringBuffer buffer;
  rapidjson::Writer<rapidjson::StringBuffer> writer(buffer);
  writer.String(text.data(), static_cast<rapidjson::SizeType>(text.size()));
  return {buffer.GetString(), buffer.GetSize()};
}

std::string json_array(std::span<const std::string> texts) {
  std::string array = "[";
  for (const std::string& text : texts) {
    if (array.size() > 1) array += ',';
    array += json_string(text);
  }
  return array + "]";
}

std::string json_object(std::span<const ExtraFact> members) {
  std::string object = "{";
  for (const auto& [key, value] : members) {
    if (object.size() > 1) object += ',';
    object += json_string(key) + ":" + value;
  }
  return object + "}";
}

}  // namespace gnomon
