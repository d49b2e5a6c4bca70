// SPDX-License-Identifier: LGPL-3.0-or-later
// From faces and nodes to the mesh that is handed out: vertices and samples are numbered in the
// order of the corners that have them, and counted.
#ifndef GNOMON_ALGORITHMS_SHADING_MESH_SAMPLES_H
#define GNOMON_ALGORITHMS_SHADING_MESH_SAMPLES_H

#include "algorithms/shading_mesh/edges.h"
#include "algorithms/shading_mesh/nodes.h"
#include "algorithms/shading_mesh/points.h"
#include "gnomon/algorithms/shading_mesh.h"

namespace gnomon {

/// Fills in the mesh's points, faces, corners, samples, values and the counts of its lights.
/// Requires: every node is illuminated. The exact points of vertices are moved out of `points`.
void number_corners(const FaceLoops& loops, PointTable& points, NodeTable& nodes,
                    ShadingMesh& mesh);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SHADING_MESH_SAMPLES_H
