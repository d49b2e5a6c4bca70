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

#include <gmpxx.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/shading_mesh/edges.h"
#include "algorithms/shading_mesh/points.h"
#include "gnomon/kernel/error.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

/// Where the lines of a grid are, along any axis.
class GridLines {
 public:
  /// Numbers of lines stay below this, so that places are 64-bit integers and rounded lines stay
  /// in order.
  static constexpr double kMostLines = 0x1p40;

  GridLines() = default;  // none
  /// `rounded`: at the doubles nearest to the multiples of the step. Requires: step > 0.
  GridLines(mpq_class step, bool rounded);

  bool empty() const { return sgn(step_) == 0; }
  double step() const { return step_.get_d(); }
  mpq_class at(std::int64_t line) const;
  /// 2k if the coordinate is that of line k, 2k + 1 if it is between the lines k and k + 1.
  /// Requires: fewer than kMostLines lines away from 0.
  std::int64_t place(const PointTable& points, std::uint32_t point, int axis) const;

 private:
  double rounded_at(std::int64_t line) const;

  mpq_class step_;
  double nearest_step_ = 0;
  // Terms of a fraction that are doubles: quotients of doubles are rounded to the nearest.
  bool is_short_ = false;
  bool rounded_ = false;
};

/// A support plane as n . x = d in scene units, and the two axes of its chart.
struct MeshPlane {
  std::array<mpz_class, 3> n;
  mpq_class d;
  std::array<int, 2> axes{};

  int dropped() const { return 3 - axes[0] - axes[1]; }
};
MeshPlane mesh_plane(const PreparedScene& scene, PlaneId plane);

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
