// SPDX-License-Identifier: LGPL-3.0-or-later
// What several lights together have left of one side of a part: neighbours that the same lights
// reach become one where they are convex together, whichever light cut them apart (Chin & Feiner
// 1989, sec. 6).
#ifndef GNOMON_ALGORITHMS_LIGHTS_MERGE_TOGETHER_H
#define GNOMON_ALGORITHMS_LIGHTS_MERGE_TOGETHER_H

#include <bit>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/lights/carried_loops.h"
#include "algorithms/lights/neighbour_merge.h"
#include "algorithms/partition/rules.h"

namespace gnomon {

template <LightSpaceModel Space>
class MergeTogether {
 public:
  using Vertex = typename Space::Vertex;
  using Loop = LoopView<Vertex>;

  /// All loops are in the space of one light.
  MergeTogether(Space& space, const Rules& rules) : merge_(space), rules_(rules) {}

  /// Adds a fragment: the lights that reach it, and who made edge i of its loop.
  template <class OriginOf>
  void add(const Loop& loop, std::uint64_t lit_by, const OriginOf& origin_of) {
    support_ = loop.support;
    Fragment& fragment = fragments_.emplace_back();
    fragment.loop = loops_.append(loop);
    fragment.lit_by = lit_by;
    for (std::uint32_t i = 0; i < loop.size(); ++i) {
      fragment.names.push_back(name_of(origin_of(i)));
    }
  }

  /// Merges what can be; returns how many fragments went into others.
  std::uint64_t run() {
    gone_.assign(fragments_.size(), 0);
    std::vector<std::uint32_t> numbers(fragments_.size());
    std::iota(numbers.begin(), numbers.end(), 0u);
    return merge_.run(*this, numbers, gone_);
  }
  /// Calls put(Loop, lit_by) for what there is now.
  template <class Put>
  void for_each(const Put& put) const {
    for (std::uint32_t i = 0; i < fragments_.size(); ++i) {
      if (gone_[i] == 0) put(loop(i), fragments_[i].lit_by);
    }
  }

  // What NeighbourMerge asks.
  Loop loop(std::uint32_t fragment) const {
    return loops_.view(fragments_[fragment].loop, support_);
  }
  EdgeName name(std::uint32_t fragment, std::uint32_t edge) const {
    return fragments_[fragment].names[edge];
  }
  bool are_alike(std::uint32_t first, std::uint32_t second) const {
    const std::uint64_t a = fragments_[first].lit_by, b = fragments_[second].lit_by;
    if (a == b) return true;
    // Else one light that tells them apart is forgotten where another one does not.
    return !rules_.merged_fragments_agree_on_every_light && std::has_single_bit(a ^ b) &&
           (a & b) != 0;
  }
  bool take(std::uint32_t first, std::uint32_t second, const ConvexJoin<Space>& join) {
    Fragment& into = fragments_[first];
    std::vector<EdgeName> names;
    for (const auto& from : join.edges_from()) {
      names.push_back(fragments_[from.of_second ? second : first].names[from.edge]);
    }
    into.loop = loops_.append(join.joined());
    into.names = std::move(names);
    into.lit_by &= fragments_[second].lit_by;
    return true;
  }

 private:
  struct Fragment {
    LoopRange loop;
    std::uint64_t lit_by = 0;
    std::vector<EdgeName> names;
  };
  static EdgeName name_of(const EdgeOrigin& origin) {
    if (!origin.plane.valid()) return {};
    return {std::uint64_t{origin.light} << 32 | origin.plane.index(), origin.plane.flipped()};
  }

  NeighbourMerge<Space> merge_;
  const Rules& rules_;
  LoopStore<Vertex> loops_;
  PlaneId support_ = 0;
  std::vector<Fragment> fragments_;
  std::vector<std::uint8_t> gone_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_LIGHTS_MERGE_TOGETHER_H
