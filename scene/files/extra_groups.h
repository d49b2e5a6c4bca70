// SPDX-License-Identifier: LGPL-3.0-or-later
// What readers of formats put into a scene's "extra": polygons in groups by what they belong to and
// by kind, and what else the file says, under the format's name.
#ifndef GNOMON_SCENE_FILES_EXTRA_GROUPS_H
#define GNOMON_SCENE_FILES_EXTRA_GROUPS_H

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "gnomon/scene/groups.h"

namespace gnomon {

/// Groups in the order of their first members.
class GroupList {
 public:
  void add(const std::string& name, std::uint32_t polygon);
  const std::vector<PolygonGroup>& list() const { return list_; }

 private:
  std::vector<PolygonGroup> list_;
  std::unordered_map<std::string, std::size_t> index_;
};

/// The names by which kinds stand among groups: a kind that is called like an owner has " surfaces"
/// behind its name.
std::vector<std::string> kind_names(std::span<const PolygonGroup> owners,
                                    std::span<const PolygonGroup> kinds);

/// A key and its value as JSON text.
using ExtraFact = std::pair<std::string, std::string>;

/// {"groups": {owner or kind: ids}, FORMAT: {the facts in their order}} as JSON text.
std::string extra_with_groups(const Scene& scene, std::span<const PolygonGroup> owners,
                              std::span<const PolygonGroup> kinds, std::string_view format,
                              std::span<const ExtraFact> facts);

/// As JSON. Requires: UTF-8.
std::string json_string(std::string_view text);
std::string json_array(std::span<const std::string> texts);
std::string json_object(std::span<const ExtraFact> members);

}  // namespace gnomon

#endif  // GNOMON_SCENE_FILES_EXTRA_GROUPS_H
