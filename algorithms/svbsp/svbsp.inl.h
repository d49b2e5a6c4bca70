// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies of svbsp.h, instantiated one kernel a source.
#ifndef GNOMON_ALGORITHMS_SVBSP_SVBSP_INL_H
#define GNOMON_ALGORITHMS_SVBSP_SVBSP_INL_H

#include <algorithm>

#include "algorithms/partition/fragment_stays.h"
#include "algorithms/svbsp/svbsp.h"

namespace gnomon {

template <LightSpaceModel Space>
SvbspTree<Space>::SvbspTree(Space& space, const TreeChoice& choice, const Rules& rules)
    : space_(&space), choice_(choice), rules_(rules), nodes_(1), filter_(choice.merge_siblings) {}

template <LightSpaceModel Space>
std::uint64_t SvbspTree<Space>::mean_filter_depth() const {
  constexpr std::uint64_t kMillion = 1'000'000;
  const std::vector<std::uint32_t> depths = depths_of(std::span<const Node>(nodes_));
  std::uint64_t visits = 0, sum = 0;
  for (std::size_t i = 0; i < visits_.size(); ++i) {
    visits += visits_[i];
    sum += visits_[i] * depths[i];
  }
  return visits == 0 ? 0 : sum * kMillion / visits;
}

template <LightSpaceModel Space>
struct SvbspTree<Space>::Cells {
  SvbspTree& tree;
  const LoopView<Vertex>& original;  // the polygon
  FilterActions actions;
  std::uint32_t before;  // what was made at this group or later is not there
  ClassifiedLoops<Vertex>& output;

  std::int32_t node_at(TreePlace at) const {
    const std::int32_t link = tree.child(at);
    return link >= 0 && tree.nodes_[static_cast<std::size_t>(link)].group >= before ? kOutCell
                                                                                    : link;
  }
  PlaneRef plane(std::uint32_t node, const LoopView<Vertex>&) const {
    return tree.nodes_[node].plane;
  }
  Placement placement(SplitRecord& record, std::uint32_t node, const LoopView<Vertex>& loop) const {
    return record.decide(*tree.space_, tree.nodes_[node].plane, loop);
  }
  bool is_kept(const LoopView<Vertex>& loop) const {
    return fragment_stays(*tree.space_, loop, tree.rules_);
  }
  void at_cell(TreePlace at, const LoopView<Vertex>& fragment) const {
    if (tree.visits_.size() <= at.node) tree.visits_.resize(tree.nodes_.size(), 0);
    ++tree.visits_[at.node];
    const std::int32_t link = node_at(at);
    const InCell* cell = link == kOutCell ? nullptr : &tree.cells_[index_of_cell(link)];
    if (cell != nullptr && cell->group >= before) cell = nullptr;
    if (actions.classify) {
      if (cell == nullptr) {
        output.add_lit(fragment);
      } else {
        output.add_shadow(fragment, cell->caster);
      }
    }
    if (cell == nullptr && actions.insert) tree.insert(at, fragment, original);
  }
};

template <LightSpaceModel Space>
void SvbspTree<Space>::filter(const LoopView<Vertex>& loop, FilterActions actions,
                              ClassifiedLoops<Vertex>& output) {
  filter_.filter(*space_, Cells{*this, loop, actions, kAnyGroup, output}, loop, output);
}

template <LightSpaceModel Space>
void SvbspTree<Space>::classify(const LoopView<Vertex>& loop, std::uint32_t group,
                                ClassifiedLoops<Vertex>& output) {
  const std::uint32_t before = rules_.later_volumes_do_not_count ? group : kAnyGroup;
  filter_.filter(*space_, Cells{*this, loop, {.classify = true, .insert = false}, before, output},
                 loop, output);
}

template <LightSpaceModel Space>
void SvbspTree<Space>::insert(TreePlace at, const LoopView<Vertex>& fragment,
                              const LoopView<Vertex>& original) {
  for (std::uint32_t i = 0; i < fragment.size(); ++i) {
    const PlaneRef edge = fragment.edges[i];
    if (!rules_.edges_of_splits_bound_volumes && edge.index() >= choice_.scene_edges) continue;
    // An edge that the original loop does not have was cut by an ancestor.
    if (choice_.edges == EdgesInTree::kOwn && space_->knows_identity() &&
        std::find(original.edges.begin(), original.edges.end(), edge) == original.edges.end()) {
      continue;
    }
    const PlaneRef plane =
        space_->shadow_plane(edge, fragment.vertices[i], fragment.vertices[fragment.next(i)]);
    const auto node = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({plane, kOutCell, kOutCell, group_});
    child(at) = static_cast<std::int32_t>(node);
    at = {node, true};
  }
  child(at) = in_cell(static_cast<std::uint32_t>(cells_.size()));
  cells_.push_back({fragment.part, group_});
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SVBSP_SVBSP_INL_H
