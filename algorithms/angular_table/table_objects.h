// SPDX-License-Identifier: LGPL-3.0-or-later
// The objects of a scene as an angular table sees them: its components, and what of them casts.
#ifndef GNOMON_ALGORITHMS_ANGULAR_TABLE_TABLE_OBJECTS_H
#define GNOMON_ALGORITHMS_ANGULAR_TABLE_TABLE_OBJECTS_H

#include <cstdint>
#include <string>
#include <vector>

#include "gnomon/algorithms/components.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

struct TableObject {
  Component component;
  std::vector<VertexId> vertices;  // of its parts that cast, each once; none if none casts
};

std::vector<TableObject> table_objects(const PreparedScene& scene);

/// The polygon's name where the scene is known, else its number from 0.
std::string polygon_name(const Scene* names, const PreparedScene& scene, std::uint32_t part);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_ANGULAR_TABLE_TABLE_OBJECTS_H
