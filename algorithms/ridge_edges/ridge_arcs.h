// SPDX-License-Identifier: LGPL-3.0-or-later
// The ridge edges of one component as arcs between directions, and the stretches of them between
// the rays where they meet or cross.
#ifndef GNOMON_ALGORITHMS_RIDGE_EDGES_RIDGE_ARCS_H
#define GNOMON_ALGORITHMS_RIDGE_EDGES_RIDGE_ARCS_H

#include <atomic>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "algorithms/ridge_edges/light_directions.h"
#include "gnomon/algorithms/ridge_loops.h"
#include "gnomon/kernel/sign.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

/// A ridge edge as the light sees it. It is less than half a turn: a facing polygon has it.
struct RidgeArc {
  VertexId from = 0, to = 0;
  std::uint32_t from_ray = 0, to_ray = 0;
  FilteredVector normal;  // of the plane through light and edge; positive on its left
};

/// A stretch of a ridge edge that nothing crosses or ends on.
struct Stretch {
  std::uint32_t from_ray = 0, to_ray = 0;
  std::uint32_t edge = 0;
  /// Of stretches that run along one another, so many are nearer to the facing side.
  std::uint32_t inner = 0;
};

/// Rays, each once, by their primitive directions.
class RayTable {
 public:
  std::uint32_t of(const DirectionVector& direction);
  const std::vector<FilteredVector>& rays() const { return rays_; }

 private:
  std::map<DirectionVector, std::uint32_t> places_;
  std::vector<FilteredVector> rays_;
};

/// The ridge edges of the component's parts, `facing` by part of the scene. Those that face run as
/// often one way as the other along every other edge.
std::vector<RidgeEdge> ridge_edges_of(const PreparedScene& scene,
                                      std::span<const std::uint32_t> parts,
                                      std::span<const Side> facing);

class RidgeArcs {
 public:
  RidgeArcs(const PreparedScene& scene, std::span<const FilteredVector> directions,
            std::span<const RidgeEdge> edges);

  /// Finds all that cut them: PIPs, ends of others on them, and stretches that several share.
  /// Adds to `loops` its crossings and counts. False if `interrupted`, which may be null, is true.
  bool cut(const PreparedScene& scene, RidgeLoops& loops, const std::atomic<bool>* interrupted);
  /// All stretches, less those that run both ways along one another, which are counted.
  std::vector<Stretch> stretches(std::uint64_t& cancelled) const;

  /// Whether two edges that come to one ray are there in one point of space, not one behind the
  /// other.
  bool meet_in_space(const PreparedScene& scene, std::uint32_t first, std::uint32_t second,
                     std::uint32_t ray) const;

  const std::vector<RidgeArc>& arcs() const { return arcs_; }
  const std::vector<FilteredVector>& rays() const { return table_.rays(); }

 private:
  void cut_pair(const PreparedScene& scene, std::uint32_t first, std::uint32_t second,
                RidgeLoops& loops);
  void cut_by_end(std::uint32_t arc, VertexId vertex, std::uint32_t ray, Sign of_end);

  std::span<const FilteredVector> directions_;
  std::vector<RidgeArc> arcs_;
  std::vector<std::vector<std::uint32_t>> cuts_;  // rays inside of each arc, in no order
  RayTable table_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_RIDGE_EDGES_RIDGE_ARCS_H
