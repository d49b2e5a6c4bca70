// SPDX-License-Identifier: LGPL-3.0-or-later
// Triangulates a weakly simple ring by clipping ears: rule 3 of polygon_cut.h.
//
// Why the test of an ear needs vertices only: no edge of the ring crosses the ear's two own edges,
// and where the ring visits the ear's tip again it has another angle there, so an edge that enters
// the open triangle ends in it or on its diagonal, or starts at an end of the diagonal and then
// must end in the closed triangle as well. So if no vertex but the corners' places lies in the
// closed triangle, nothing of the ring is inside.
#ifndef GNOMON_SCENE_PREPARE_EAR_CLIPPER_H
#define GNOMON_SCENE_PREPARE_EAR_CLIPPER_H

#include <array>
#include <set>
#include <utility>

#include "scene/prepare/chart.h"

namespace gnomon::scene_detail {

using Triangle = std::array<std::uint32_t, 3>;

/// Cost: O(n^2). For each candidate the first vertex that blocks it is remembered, and the search
/// goes on from there when that vertex has been clipped; a triangle only ever loses blockers.
template <class Int>
class EarClipper {
 public:
  EarClipper(const Chart<Int>& chart, const Ring& ring) : chart_(chart), nodes_(ring.size()) {
    const auto n = static_cast<std::uint32_t>(ring.size());
    for (std::uint32_t i = 0; i < n; ++i) {
      nodes_[i] = {ring[i], i == 0 ? n - 1 : i - 1, i + 1 == n ? 0 : i + 1, 0, 0, true, {}};
    }
    alive_ = n;
  }

  /// False if no ear is left before the ring is used up: then it was not weakly simple.
  bool run(std::vector<Triangle>& triangles) {
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) look(i);
    while (alive_ >= 3) {
      if (ears_.empty()) return false;
      const std::uint32_t tip = ears_.begin()->second;
      const std::uint32_t p = nodes_[tip].previous, n = nodes_[tip].next;
      triangles.push_back({nodes_[p].vertex, nodes_[tip].vertex, nodes_[n].vertex});
      remove(tip);
      renew(p);
      renew(n);
      resume_watchers();
    }
    return true;
  }

 private:
  struct Watcher {
    std::uint32_t node, version;
  };
  struct Node {
    std::uint32_t vertex, previous, next;
    std::uint32_t version;  // counts changes of its triangle
    std::uint32_t scanned;  // nodes before this do not block it
    bool alive;
    std::vector<Watcher> watchers;  // candidates that this node blocks
  };

  void remove(std::uint32_t i) {
    Node& node = nodes_[i];
    nodes_[node.previous].next = node.next;
    nodes_[node.next].previous = node.previous;
    node.alive = false;
    --alive_;
    ears_.erase({chart_.key(node.vertex), i});
    freed_.insert(freed_.end(), node.watchers.begin(), node.watchers.end());
    node.watchers.clear();
  }

  void renew(std::uint32_t i) {
    Node& node = nodes_[i];
    if (!node.alive) return;
    ears_.erase({chart_.key(node.vertex), i});
    ++node.version;
    node.scanned = 0;
    look(i);
  }

  void resume_watchers() {
    std::vector<Watcher> freed;
    freed.swap(freed_);
    for (const Watcher& watcher : freed) {
      const Node& node = nodes_[watcher.node];
      if (node.alive && node.version == watcher.version) look(watcher.node);
    }
  }

  /// Finds out whether node i is an ear, from where the last search stopped.
  void look(std::uint32_t i) {
    Node& node = nodes_[i];
    if (!node.alive) return;
    const std::uint32_t a = nodes_[node.previous].vertex, b = node.vertex,
                        c = nodes_[node.next].vertex;
    if (chart_.turn(a, b, c) != Sign::kPositive) return;
    const Int& left = std::min(std::min(chart_.x(a), chart_.x(b)), chart_.x(c));
    const Int& right = std::max(std::max(chart_.x(a), chart_.x(b)), chart_.x(c));
    for (std::uint32_t& k = node.scanned; k < nodes_.size(); ++k) {
      const Node& other = nodes_[k];
      if (!other.alive) continue;
      const std::uint32_t v = other.vertex;
      if (v == a || v == b || v == c || chart_.x(v) < left || chart_.x(v) > right) continue;
      if (chart_.turn(a, b, v) == Sign::kNegative || chart_.turn(b, c, v) == Sign::kNegative ||
          chart_.turn(c, a, v) == Sign::kNegative) {
        continue;
      }
      nodes_[k].watchers.push_back({i, node.version});
      return;
    }
    ears_.insert({chart_.key(b), i});
  }

  const Chart<Int>& chart_;
  std::vector<Node> nodes_;
  std::size_t alive_ = 0;
  std::set<std::pair<std::uint32_t, std::uint32_t>> ears_;  // (key, node)
  std::vector<Watcher> freed_;
};

}  // namespace gnomon::scene_detail

#endif  // GNOMON_SCENE_PREPARE_EAR_CLIPPER_H
