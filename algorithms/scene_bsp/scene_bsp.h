// SPDX-License-Identifier: LGPL-3.0-or-later
// The scene BSP (Fuchs, Kedem & Naylor 1980): a tree of support planes that gives an exact
// front-to-back order of all polygons from any light in O(n), and back-to-front from any eye.
//
// Each inner node holds one support plane and every piece that lies in it, so that coplanar
// polygons are always together. Pieces of one part are convex and at most one a node. Reference:
// Chin & Feiner 1989, sec. 3. The root of each subtree is chosen among a few sampled candidates by
// splits and balance, on bounding boxes in doubles, or is the first that was fed to it: a heuristic
// that cannot affect correctness.
// Explicit stack; memory is the pieces (append only), about 40 bytes a vertex and piece.
#ifndef GNOMON_ALGORITHMS_SCENE_BSP_SCENE_BSP_H
#define GNOMON_ALGORITHMS_SCENE_BSP_SCENE_BSP_H

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "algorithms/partition/box.h"
#include "algorithms/partition/loop_store.h"
#include "algorithms/partition/rules.h"
#include "algorithms/partition/split.h"
#include "gnomon/algorithms/method_options.h"
#include "gnomon/scene/prepare.h"
#include "kernel/concept/kernel_concept.h"

namespace gnomon {

struct BspNode {
  static constexpr std::int32_t kEmpty = -1;
  PlaneId plane = 0;
  std::int32_t front = kEmpty, back = kEmpty;
  std::uint32_t first = 0, count = 0;  // into SceneBsp::node_pieces
};

template <class Vertex>
struct SceneBsp {
  std::vector<BspNode> nodes;              // nodes[0] is the root; none if the scene is empty
  std::vector<std::uint32_t> node_pieces;  // indices into pieces
  std::vector<LoopRange> pieces;           // also those that were split further
  LoopStore<Vertex> loops;
  std::uint32_t depth = 0;
  std::uint64_t splits = 0;
  std::uint64_t vanished = 0;  // children with fewer than three vertices (rounded kernels)
  bool interrupted = false;
  bool too_many = false;  // more than max_pieces: given up
};

/// RootChooser works on planes and boxes in doubles, in scene units, the same for every kernel.
class RootChooser {
 public:
  RootChooser(const Geometry& geometry, std::uint64_t seed);
  /// Returns the index, in `candidates`, of the piece whose plane should split them.
  std::size_t choose(std::span<const std::uint32_t> candidates, std::span<const Box> boxes,
                     std::span<const PlaneId> planes);

 private:
  std::uint64_t random();
  std::vector<std::array<double, 4>> planes_;
  std::uint64_t state_;
};

/// The parts as Slater 1992, sec. 6, says that he fed them to the tree: "polygons furthest from the
/// centre of the scene" first, so that furniture does not split the walls of its room. How far out
/// a part is, is told by its corner that is farthest from the middle of the box of the whole scene,
/// in doubles, the same for every kernel; ties keep their order.
std::vector<std::uint32_t> outside_first(const PreparedScene& scene,
                                         std::span<const std::uint32_t> parts);

/// Builds the tree of the given parts. `identity` tells whether pieces of the same support plane go
/// to the node unasked; without it (what most programs do) only the root's own piece does.
/// A space may have add_plane_of(loop), a support plane of its own for a fragment that becomes the
/// root of a subtree; without it the root's plane is that of its part. Only where
/// roots are chosen does `seed` change anything.
template <SceneSpaceModel Space>
SceneBsp<typename Space::Vertex> build_scene_bsp(
    Space& space, const PreparedScene& scene, std::span<const std::uint32_t> parts,
    std::uint64_t seed, bool identity, const std::atomic<bool>* interrupted = nullptr,
    std::uint64_t max_pieces = 100'000'000, const Rules& rules = {}, Roots roots = Roots::kChosen);

/// Returns the nodes front to back as seen from a viewpoint; `side_of_node`: the viewpoint's side
/// of a plane. O(nodes), explicit stack.
std::vector<std::uint32_t> front_to_back(std::span<const BspNode> nodes,
                                         const std::function<Sign(PlaneId)>& side_of_node);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SCENE_BSP_SCENE_BSP_H
