// SPDX-License-Identifier: LGPL-3.0-or-later
// Named groups of polygons: groups and objects of an OBJ file, or whatever a scene says in
// `"extra": {"groups": {"roof": ["p1", "p2"]}}`, names with lists of polygon ids (an id such
// as "7" may stand there as the number 7). A polygon may be in several groups, or in none. Groups
// change no answer; results are summed by them.
#ifndef GNOMON_SCENE_GROUPS_H
#define GNOMON_SCENE_GROUPS_H

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gnomon/kernel/error.h"
#include "gnomon/scene/scene.h"

namespace gnomon {

struct PolygonGroup {
  std::string name;
  std::vector<std::uint32_t> polygons;  // indices into Scene::polygons, ascending, each once
};

/// The groups that the scene's `extra` names, in its order; none if it names none. Errors: kFormat
/// (`groups` is no object of lists of ids), kIndex (an id that no polygon has), kLimit, with the
/// scene's file and the JSON pointer.
Expected<std::vector<PolygonGroup>> polygon_groups(const Scene& scene);

/// Takes polygons that were left out of a scene out of its groups, too.
void remove_from_groups(Scene& scene, std::span<const std::string> ids);

/// Writes groups as the scene's `extra`. Requires: it has none yet.
void set_polygon_groups(Scene& scene, std::span<const PolygonGroup> groups);

}  // namespace gnomon

#endif  // GNOMON_SCENE_GROUPS_H
