// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/angular_table/ridge_pairs.h"

#include <algorithm>
#include <cstddef>

namespace gnomon {

namespace {

/// The pairs of one loop. Its crossings, in the order of the loop, are a circle of chains that go
/// up to a peak and down to a local minimum.
class PeakWalk {
 public:
  explicit PeakWalk(std::vector<RidgeCrossing> circle) : circle_(std::move(circle)) {
    find_peaks();
  }

  std::vector<RidgePair> run() {
    for (std::size_t g = 0; g < groups_.size(); ++g) to_walk_.push_back(g);
    while (!to_walk_.empty()) {
      const std::size_t group = to_walk_.back();
      to_walk_.pop_back();
      walk_down(groups_[group]);
      merge_at_minima(group);
    }
    return std::move(pairs_);
  }

 private:
  /// What hangs together at and above a height: at first a peak, with one branch to each side.
  struct Group {
    std::size_t left = 0, right = 0;                   // crossings that the branches are on
    std::uint32_t height = 0;                          // rows from here on are done
    bool left_is_down = false, right_is_down = false;  // at its local minimum
    std::size_t before = 0, after = 0;                 // neighbours around the loop
  };

  std::size_t next(std::size_t i) const { return i + 1 == circle_.size() ? 0 : i + 1; }
  std::size_t previous(std::size_t i) const { return i == 0 ? circle_.size() - 1 : i - 1; }
  bool goes_up(std::size_t i) const { return circle_[i].sense < 0; }

  void find_peaks() {
    for (std::size_t i = 0; i < circle_.size(); ++i) {
      if (goes_up(i) && !goes_up(next(i))) groups_.push_back({i, next(i), circle_[i].high});
    }
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      groups_[g].before = g == 0 ? groups_.size() - 1 : g - 1;
      groups_[g].after = g + 1 == groups_.size() ? 0 : g + 1;
    }
  }

  /// Both branches, until one of them is at its local minimum.
  void walk_down(Group& group) {
    while (!group.left_is_down && !group.right_is_down) {
      const RidgeCrossing &left = circle_[group.left], &right = circle_[group.right];
      const std::uint32_t low = std::max(left.low, right.low);
      if (low < group.height) pairs_.push_back({right.edge, left.edge, low, group.height});
      group.height = low;
      if (left.low == low) {
        const std::size_t below = previous(group.left);
        group.left_is_down = !goes_up(below);
        if (!group.left_is_down) group.left = below;
      }
      if (right.low == low) {
        const std::size_t below = next(group.right);
        group.right_is_down = goes_up(below);
        if (!group.right_is_down) group.right = below;
      }
    }
  }

  /// A group that waits at a local minimum becomes one with the neighbour that waits there, too.
  void merge_at_minima(std::size_t group) {
    while (groups_[group].before != group) {
      Group& own = groups_[group];
      if (own.right_is_down && groups_[own.after].left_is_down) {
        take_in_next(group);
      } else if (own.left_is_down && groups_[own.before].right_is_down) {
        group = own.before;
        take_in_next(group);
      } else {
        break;
      }
      const Group& merged = groups_[group];
      if (!merged.left_is_down && !merged.right_is_down) {
        to_walk_.push_back(group);
        break;
      }
    }
  }
  void take_in_next(std::size_t group) {
    Group& own = groups_[group];
    const Group& other = groups_[own.after];
    own.right = other.right;
    own.right_is_down = other.right_is_down;
    own.height = std::min(own.height, other.height);
    own.after = other.after;
    groups_[own.after].before = group;
  }

  std::vector<RidgeCrossing> circle_;
  std::vector<Group> groups_;
  std::vector<std::size_t> to_walk_;
  std::vector<RidgePair> pairs_;
};

}  // namespace

std::vector<RidgeCrossing> crossings_of(const TableMesh& mesh, const TableRows& rows,
                                        const EdgeLoop& loop) {
  std::vector<RidgeCrossing> crossings;
  for (const DirectedEdge edge : loop) {
    const std::uint32_t from = rows.rank(mesh.from(edge)), to = rows.rank(mesh.to(edge));
    if (from == to) continue;
    crossings.push_back({edge.edge, from > to ? 1 : -1, std::min(from, to), std::max(from, to)});
  }
  return crossings;
}

std::vector<RidgePair> pairs_by_peaks(const TableMesh& mesh, const TableRows& rows,
                                      const EdgeLoop& loop) {
  return PeakWalk(crossings_of(mesh, rows, loop)).run();
}

}  // namespace gnomon
