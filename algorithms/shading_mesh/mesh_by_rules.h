// SPDX-License-Identifier: LGPL-3.0-or-later
// The shading mesh under any rules; the public function has those of the definition.
#ifndef GNOMON_ALGORITHMS_SHADING_MESH_MESH_BY_RULES_H
#define GNOMON_ALGORITHMS_SHADING_MESH_MESH_BY_RULES_H

#include "algorithms/partition/rules.h"
#include "gnomon/algorithms/shading_mesh.h"

namespace gnomon {

/// As make_shading_mesh().
Expected<ShadingMesh> make_shading_mesh_by(const PreparedScene& scene, const ShadowResult& result,
                                           const ShadeFunction& shade,
                                           const ShadingOptions& options, const Rules& rules);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SHADING_MESH_MESH_BY_RULES_H
