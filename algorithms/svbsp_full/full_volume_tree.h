// SPDX-License-Identifier: LGPL-3.0-or-later
// A BSP tree of complete shadow volumes (Chin & Feiner 1989, sec. 4 and 8): volumes with their
// support planes, so that polygons may be inserted in any order and the scene needs no BSP tree.
//
// A node is an edge's shadow plane (front: inside) or a caster's support plane (front: towards the
// light; what is behind it is IN). At an OUT cell a caster hangs a chain: first the edges of the
// input polygon that the fragment still has, last its support plane. Below the edges all directions
// are in the caster's cone, so that nothing in front of its plane there can have a volume that goes
// on behind it, except where all is IN already. With the support plane above, a volume would stop
// at the planes in its way (1992, figure 6).
//
// A loop that a support plane cuts gets an edge that is no node, ever: nodes have the degrees of
// input edges and planes. What lies in a support plane is in front of it: a polygon does not shadow
// itself or its own plane.
//
// Guarantee on exact kernels: when every caster has been inserted, every fragment of every facing
// polygon has the class of the definition, and a witness. Explicit stacks.
#ifndef GNOMON_ALGORITHMS_SVBSP_FULL_FULL_VOLUME_TREE_H
#define GNOMON_ALGORITHMS_SVBSP_FULL_FULL_VOLUME_TREE_H

#include <algorithm>
#include <cstdint>
#include <vector>

#include "algorithms/lights/light_scene.h"
#include "algorithms/partition/classified_loop.h"
#include "algorithms/partition/depth.h"
#include "algorithms/partition/fragment_stays.h"
#include "algorithms/partition/plane_tree_filter.h"
#include "algorithms/svbsp/in_out_tree.h"

namespace gnomon {

template <SectorSpaceModel Space>
class FullVolumeTree {
 public:
  using Vertex = typename Space::Vertex;
  using Loop = LoopView<Vertex>;

  explicit FullVolumeTree(LightScene<Space>& light)
      : light_(light), nodes_(1), filter_(light.options.output.merge) {}

  /// Puts the balanced prefix at the top. Requires: nothing inserted yet.
  void plant(const PrefixTree& prefix) { plant_prefix(light_.space, prefix, nodes_); }
  /// Pass 1: adds the volume of a whole polygon that casts. Its edges are shadow planes.
  void insert(const Loop& caster) { filter(caster, Pass::kInsert, unused_); }
  /// Pass 2: puts out the fragments of a polygon.
  void classify(const Loop& loop, ClassifiedLoops<Vertex>& output) {
    filter(loop, Pass::kClassify, output);
  }

  std::uint64_t node_count() const { return nodes_.size() - 1; }
  /// Nodes on the longest way from the root to a cell. O(nodes).
  std::uint64_t depth() const { return depth_of(std::span<const Node>(nodes_)); }
  /// Children with fewer than three vertices that were dropped (rounded kernels).
  std::uint64_t vanished() const { return filter_.vanished(); }

 private:
  static constexpr std::uint32_t kNoSupport = 0xffffffffu;
  enum class Pass : std::uint8_t { kInsert, kClassify };
  struct Node {
    PlaneRef plane;                     // of an edge
    std::uint32_t caster = kNoSupport;  // else: the support plane of this part
    std::int32_t front = kOutCell, back = kOutCell;
  };
  struct Cells;

  std::int32_t& child(TreePlace at) {
    return at.front ? nodes_[at.node].front : nodes_[at.node].back;
  }
  void filter(const Loop& loop, Pass pass, ClassifiedLoops<Vertex>& output) {
    filter_.filter(light_.space, Cells{*this, loop, pass, output}, loop, output);
  }
  /// Hangs a node at a place and returns the place of one of its children.
  TreePlace hang(TreePlace at, const Node& node, bool front) {
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back(node);
    child(at) = static_cast<std::int32_t>(index);
    return {index, front};
  }
  void hang_volume(TreePlace at, const Loop& fragment, const Loop& original) {
    const auto hang_support = [&] { at = hang(at, {{}, fragment.part}, false); };
    if (!light_.rules.edges_above_supports) hang_support();
    for (const PlaneRef edge : fragment.edges) {
      // An edge that the original loop does not have was cut by a node above.
      if (std::find(original.edges.begin(), original.edges.end(), edge) == original.edges.end()) {
        continue;
      }
      at = hang(at, {edge, kNoSupport}, true);
    }
    if (light_.rules.edges_above_supports) hang_support();
    child(at) = in_cell(fragment.part);
  }

  LightScene<Space>& light_;
  std::vector<Node> nodes_;  // 0 is a sentinel whose front child is the root
  PlaneTreeFilter<Space> filter_;
  ClassifiedLoops<Vertex> unused_;
};

/// What PlaneTreeFilter asks of the tree while it filters one polygon.
template <SectorSpaceModel Space>
struct FullVolumeTree<Space>::Cells {
  FullVolumeTree& tree;
  const Loop& original;
  Pass pass;
  ClassifiedLoops<Vertex>& output;

  std::int32_t node_at(TreePlace at) const { return tree.child(at); }
  PlaneRef plane(std::uint32_t index, const Loop& loop) const {
    const Node& node = tree.nodes_[index];
    if (node.caster == kNoSupport) return node.plane;
    LightScene<Space>& light = tree.light_;
    return depth_cut(light.space, light.facing, loop.support, light.plane_of(node.caster));
  }
  Placement placement(SplitRecord& record, std::uint32_t index, const Loop& loop) const {
    const Node& node = tree.nodes_[index];
    Space& space = tree.light_.space;
    if (node.caster == kNoSupport) return record.decide(space, node.plane, loop);
    const PlaneId support = tree.light_.plane_of(node.caster);
    if (support == loop.support) {
      return tree.light_.rules.on_goes_to_its_own_side ? Placement::kFront : Placement::kBack;
    }
    const DepthSides sides = depth_sides(space, tree.light_.facing, support, loop);
    if (!sides.behind) return Placement::kFront;
    if (!sides.nearer) return Placement::kBack;
    return record.decide(space, plane(index, loop), loop);
  }
  bool is_kept(const Loop& loop) const {
    return fragment_stays(tree.light_.space, loop, tree.light_.rules);
  }
  void at_cell(TreePlace at, const Loop& fragment) const {
    const std::int32_t cell = tree.child(at);
    if (pass == Pass::kInsert) {
      if (cell == kOutCell) tree.hang_volume(at, fragment, original);
    } else if (cell == kOutCell) {
      output.add_lit(fragment);
    } else {
      output.add_shadow(fragment, index_of_cell(cell));
    }
  }
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SVBSP_FULL_FULL_VOLUME_TREE_H
