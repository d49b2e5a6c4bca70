// SPDX-License-Identifier: LGPL-3.0-or-later
// Which neighbours among the fragments of one part become one (ConvexJoin): greedily, in the order
// of fragments and their edges.
#ifndef GNOMON_ALGORITHMS_LIGHTS_NEIGHBOUR_MERGE_H
#define GNOMON_ALGORITHMS_LIGHTS_NEIGHBOUR_MERGE_H

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "algorithms/lights/convex_join.h"

namespace gnomon {

/// An edge by what made it: the neighbour across it has it with the same maker, the other way
/// round.
struct EdgeName {
  static constexpr std::uint64_t kUnknown = ~std::uint64_t{0};  // it has no neighbour
  std::uint64_t maker = kUnknown;
  bool flipped = false;
  bool is_opposite_of(const EdgeName& other) const {
    return maker == other.maker && flipped != other.flipped;
  }
};

template <LightSpaceModel Space>
class NeighbourMerge {
 public:
  explicit NeighbourMerge(Space& space) : join_(space) {}

  /// Merges what can be of those fragments; returns how many went into others, whose places in
  /// `gone` become 1. `Fragments` has
  ///   loop(f): a loop of the space, valid until a fragment is merged;
  ///   name(f, edge): its EdgeName;
  ///   are_alike(f, g): whether the two may become one;
  ///   take(f, g, join): puts join.joined() in the place of f; false if it must not.
  template <class Fragments>
  std::uint64_t run(Fragments& all, std::span<const std::uint32_t> fragments,
                    std::vector<std::uint8_t>& gone) {
    edges_.clear();
    for (const std::uint32_t fragment : fragments) enter(all, fragment);
    std::uint64_t merged = 0;
    for (const std::uint32_t fragment : fragments) {
      while (gone[fragment] == 0) {
        const std::optional<std::uint32_t> other = merge_one(all, fragment, gone);
        if (!other) break;
        gone[*other] = 1;
        ++merged;
        enter(all, fragment);  // old entries are seen to be stale
      }
    }
    return merged;
  }

 private:
  struct EdgeOf {
    std::uint32_t fragment = 0, edge = 0;
  };

  template <class Fragments>
  void enter(const Fragments& all, std::uint32_t fragment) {
    const std::uint32_t count = all.loop(fragment).size();
    for (std::uint32_t i = 0; i < count; ++i) {
      const EdgeName name = all.name(fragment, i);
      if (name.maker != EdgeName::kUnknown) edges_.emplace(name.maker, EdgeOf{fragment, i});
    }
  }

  /// The fragment that went into this one.
  template <class Fragments>
  std::optional<std::uint32_t> merge_one(Fragments& all, std::uint32_t fragment,
                                         const std::vector<std::uint8_t>& gone) {
    const std::uint32_t count = all.loop(fragment).size();
    for (std::uint32_t i = 0; i < count; ++i) {
      const EdgeName name = all.name(fragment, i);
      if (name.maker == EdgeName::kUnknown) continue;
      const auto [begin, end] = edges_.equal_range(name.maker);
      candidates_.clear();
      for (auto entry = begin; entry != end; ++entry) candidates_.push_back(entry->second);
      std::ranges::sort(candidates_, {}, [](const EdgeOf& candidate) {
        return std::pair(candidate.fragment, candidate.edge);
      });
      for (const EdgeOf& candidate : candidates_) {
        if (candidate.fragment == fragment || gone[candidate.fragment] != 0) continue;
        const auto a = all.loop(fragment), b = all.loop(candidate.fragment);
        if (candidate.edge >= b.size() ||
            !all.name(candidate.fragment, candidate.edge).is_opposite_of(name) ||
            !all.are_alike(fragment, candidate.fragment)) {
          continue;
        }
        if (join_.join(a, i, b, candidate.edge) && all.take(fragment, candidate.fragment, join_)) {
          return candidate.fragment;
        }
      }
    }
    return std::nullopt;
  }

  ConvexJoin<Space> join_;
  std::unordered_multimap<std::uint64_t, EdgeOf> edges_;  // by maker
  std::vector<EdgeOf> candidates_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_LIGHTS_NEIGHBOUR_MERGE_H
