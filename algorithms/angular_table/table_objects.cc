// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/angular_table/table_objects.h"

#include <algorithm>
#include <utility>

namespace gnomon {

std::vector<TableObject> table_objects(const PreparedScene& scene) {
  std::vector<TableObject> objects;
  for (Component& component : find_components(scene)) {
    TableObject object;
    for (const std::uint32_t p : component.parts) {
      if (!scene.parts[p].casts) continue;
      const auto loop = scene.loop(scene.parts[p]);
      object.vertices.insert(object.vertices.end(), loop.begin(), loop.end());
    }
    std::ranges::sort(object.vertices);
    const auto rest = std::unique(object.vertices.begin(), object.vertices.end());
    object.vertices.erase(rest, object.vertices.end());
    object.component = std::move(component);
    objects.push_back(std::move(object));
  }
  return objects;
}

std::string polygon_name(const Scene* names, const PreparedScene& scene, std::uint32_t part) {
  const std::uint32_t polygon = scene.parts[part].polygon;
  return names != nullptr ? names->polygons[polygon].id : std::to_string(polygon);
}

}  // namespace gnomon
