// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies of svbsp.h, instantiated one kernel a source.
#ifndef GNOMON_ALGORITHMS_SVBSP_SVBSP_INL_H
#define GNOMON_ALGORITHMS_SVBSP_SVBSP_INL_H

#include <algorithm>

#include "algorithms/partition/fragment_stays.h"
#include "algorithms/svbsp/svbsp.h"

namespace gnomon {

template <LightSpaceModel Space>
SvbspTree<Space>::SvbspTree(Space& space, bool merge_siblings, const Rules& rules)
    : space_(&space), merge_siblings_(merge_siblings), rules_(rules), nodes_(1) {}

template <LightSpaceModel Space>
void SvbspTree<Space>::plant(const PrefixTree& prefix) {
  if (prefix.nodes.empty()) return;
  const auto link = [](std::int32_t planned) {
    return planned == PrefixNode::kLeaf ? kOut : planned + 1;  // after the sentinel
  };
  for (const PrefixNode& planned : prefix.nodes) {
    nodes_.push_back(
        {space_->add_prefix_plane(planned.plane), link(planned.front), link(planned.back)});
  }
  nodes_[0].front = 1;
}

template <LightSpaceModel Space>
void SvbspTree<Space>::filter(const LoopView<Vertex>& loop, FilterActions actions,
                              SvbspOutput<Vertex>& output) {
  stack_.clear();
  work_.clear();
  const PlaneId support = loop.support;
  stack_.push_back({0, true, false, work_.append(loop), 0});
  while (!stack_.empty()) {
    Frame frame = stack_.back();
    stack_.pop_back();
    if (frame.leaving) {
      try_merge(frame, support, output);
      work_.truncate(frame.loop.first);
      continue;
    }
    // Down while the fragment is whole: only a split needs the stack.
    bool split = false;
    while (!split && child(frame) >= 0) {
      const auto node = static_cast<std::uint32_t>(child(frame));
      const PlaneRef plane = nodes_[node].plane;
      switch (record_.decide(*space_, plane, work_.view(frame.loop, support))) {
        case Placement::kOn:  // only where rounding flattens a whole fragment
        case Placement::kFront:
          frame.node = node;
          frame.front = true;
          break;
        case Placement::kBack:
          frame.node = node;
          frame.front = false;
          break;
        case Placement::kSpanning: {
          split = true;
          parent_.clear();
          const LoopRange copy = parent_.append(work_.view(frame.loop, support));
          frame.leaving = true;
          frame.first_output = static_cast<std::uint32_t>(output.fragments.size());
          stack_.push_back(frame);
          const SplitChildren children = make_children(*space_, plane, parent_.view(copy, support),
                                                       record_, crossings_, work_);
          // The front child was appended last and is taken first, so that the loops are a stack.
          if (is_kept(children.back, support)) {
            stack_.push_back({node, false, false, children.back, 0});
          } else {
            ++vanished_;
          }
          if (is_kept(children.front, support)) {
            stack_.push_back({node, true, false, children.front, 0});
          } else {
            ++vanished_;
          }
          break;
        }
      }
    }
    if (split) continue;
    const std::int32_t cell = child(frame);
    const LoopView<Vertex> fragment = work_.view(frame.loop, support);
    if (actions.classify) {
      output.fragments.push_back({output.loops.append(fragment),
                                  cell == kOut ? LightState::kLit : LightState::kShadow,
                                  cell == kOut ? Fragment::kNoCaster : caster_of(cell)});
    }
    if (cell == kOut && actions.insert) insert(frame, fragment, loop);
    work_.truncate(frame.loop.first);
  }
}

template <LightSpaceModel Space>
bool SvbspTree<Space>::is_kept(const LoopRange& child, PlaneId support) const {
  return child.count >= 3 && fragment_stays(*space_, work_.view(child, support), rules_);
}

template <LightSpaceModel Space>
void SvbspTree<Space>::insert(const Frame& frame, const LoopView<Vertex>& fragment,
                              const LoopView<Vertex>& original) {
  Frame at = frame;
  for (std::uint32_t i = 0; i < fragment.size(); ++i) {
    const PlaneRef edge = fragment.edges[i];
    // An edge that the original loop does not have was cut by an ancestor.
    if (space_->knows_identity() &&
        std::find(original.edges.begin(), original.edges.end(), edge) == original.edges.end()) {
      continue;
    }
    const PlaneRef plane =
        space_->shadow_plane(edge, fragment.vertices[i], fragment.vertices[fragment.next(i)]);
    const auto node = static_cast<std::int32_t>(nodes_.size());
    nodes_.push_back({plane, kOut, kOut});
    child(at) = node;
    at.node = static_cast<std::uint32_t>(node);
    at.front = true;
  }
  child(at) = in_cell(fragment.part);
}

template <LightSpaceModel Space>
void SvbspTree<Space>::try_merge(const Frame& frame, PlaneId support, SvbspOutput<Vertex>& output) {
  if (!merge_siblings_ || output.fragments.size() != frame.first_output + 2) return;
  ClassifiedLoop& first = output.fragments[frame.first_output];
  const ClassifiedLoop& second = output.fragments[frame.first_output + 1];
  if (first.state != second.state || first.caster != second.caster) return;
  // The two loops are the last in the output: the whole they were cut from takes their place.
  output.loops.truncate(first.loop.first);
  first.loop = output.loops.append(work_.view(frame.loop, support));
  output.fragments.pop_back();
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SVBSP_SVBSP_INL_H
