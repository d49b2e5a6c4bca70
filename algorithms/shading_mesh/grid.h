// SPDX-License-Identifier: LGPL-3.0-or-later
// Regular gridding of the faces of a shading mesh. Lines of a grid are where a coordinate of scene
// space is a multiple of the step: the same for all polygons, so that the grids of neighbours meet.
// First every edge gets the vertices of all grids of the faces that it belongs to, then each face
// is cut through them, by one axis into strips, by the other into cells.
//
// Exactness: where a vertex lies between the lines is found exactly, once; the cutting is then a
// matter of whole numbers. Made points are exact.
#ifndef GNOMON_ALGORITHMS_SHADING_MESH_GRID_H
#define GNOMON_ALGORITHMS_SHADING_MESH_GRID_H

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/shading_mesh/edges.h"
#include "algorithms/shading_mesh/grid_lines.h"
#include "algorithms/shading_mesh/points.h"
#include "gnomon/kernel/error.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

inline constexpr std::uint8_t kNoGrid = 0xff;

struct GridRequest {
  std::span<const GridLines> grids;       // at most kMostGrids
  std::span<const std::uint8_t> grid_of;  // per face, an index into `grids` or kNoGrid
  std::uint64_t max_faces = 0;
  const std::atomic<bool>* interrupted = nullptr;

  static constexpr std::size_t kMostGrids = 2;
};

struct GridCut {
  FaceLoops loops;                     // in the order of the faces that they come from
  std::vector<std::uint32_t> origins;  // per face: which face that is
};

/// Cuts faces by their grids. Requires: no T-vertices; there are none afterwards. Errors: kLimit,
/// kInterrupted.
Expected<GridCut> cut_by_grids(const PreparedScene& scene, const FaceLoops& loops,
                               const GridRequest& request, PointTable& points);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SHADING_MESH_GRID_H
