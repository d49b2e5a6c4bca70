// SPDX-License-Identifier: LGPL-3.0-or-later
// Body of build_scene_bsp, instantiated one kernel a source.
#ifndef GNOMON_ALGORITHMS_SCENE_BSP_SCENE_BSP_INL_H
#define GNOMON_ALGORITHMS_SCENE_BSP_SCENE_BSP_INL_H

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/scene_bsp/scene_bsp.h"

namespace gnomon {

/// Builds one tree; see build_scene_bsp().
template <SceneSpaceModel Space>
class SceneBspBuilder {
 public:
  using Vertex = typename Space::Vertex;
  struct Options {
    std::uint64_t seed;
    bool identity;
    const std::atomic<bool>* interrupted;
    std::uint64_t max_pieces;
    Rules rules;
    Roots roots;
  };

  SceneBspBuilder(Space& space, const PreparedScene& scene, std::span<const std::uint32_t> parts,
                  const Options& options)
      : space_(space),
        options_(options),
        part_count_(parts.size()),
        chooser_(scene.geometry, options.seed) {
    const SceneEdges names = space.edges();
    std::vector<std::uint32_t> outer_first;
    if (options.roots == Roots::kOutside) {
      outer_first = outside_first(scene, parts);
      parts = outer_first;
    }
    for (const std::uint32_t index : parts) {
      const Part& part = scene.parts[index];
      const LoopRange range{tree_.loops.size(), part.count, index};
      const auto loop = scene.loop(part);
      const auto edges = scene.edges(part);
      for (std::uint32_t i = 0; i < part.count; ++i) {
        tree_.loops.push(space.input_vertex(loop[i]),
                         names.of_edge(edges[i].index(), edges[i].flipped()));
      }
      work_.push_back(add_piece(range, part.plane));
    }
  }

  SceneBsp<Vertex> build() {
    if (!work_.empty()) {
      tasks_.push_back({static_cast<std::uint32_t>(work_.size()), BspNode::kEmpty, true, 1});
    }
    while (!tasks_.empty() && !gives_up()) {
      const Task task = tasks_.back();
      tasks_.pop_back();
      const std::size_t begin = work_.size() - task.count;
      const std::span<const std::uint32_t> here(work_.data() + begin, task.count);
      const std::uint32_t root = root_of(here);
      const PlaneId plane = plane_of_root(root);
      sort_pieces(here, root, plane);
      work_.resize(begin);
      add_node(task, plane);
    }
    return std::move(tree_);
  }

 private:
  struct Task {
    std::uint32_t count;  // of the last entries of work_
    std::int32_t parent;  // node, or kEmpty for the root
    bool is_front;
    std::uint32_t depth;
  };

  /// Pieces are kept in the order in which they, or what they are of, were fed.
  std::uint32_t root_of(std::span<const std::uint32_t> here) {
    return options_.roots == Roots::kChosen ? here[chooser_.choose(here, boxes_, planes_)]
                                            : here.front();
  }

  std::uint32_t add_piece(const LoopRange& range, PlaneId plane) {
    const std::array<double, 3> first = space_.approximate(tree_.loops.vertex(range.first));
    Box box{first, first};
    for (std::uint32_t i = 1; i < range.count; ++i) {
      box.add(space_.approximate(tree_.loops.vertex(range.first + i)));
    }
    tree_.pieces.push_back(range);
    boxes_.push_back(box);
    planes_.push_back(plane);
    return static_cast<std::uint32_t>(tree_.pieces.size() - 1);
  }

  bool gives_up() {
    tree_.interrupted =
        options_.interrupted != nullptr && options_.interrupted->load(std::memory_order_relaxed);
    tree_.too_many = !tree_.interrupted && tree_.pieces.size() > options_.max_pieces;
    return tree_.interrupted || tree_.too_many;
  }

  PlaneId plane_of_root(std::uint32_t root) {
    const PlaneId plane = planes_[root];
    if constexpr (requires(LoopView<Vertex> loop) { space_.add_plane_of(loop); }) {
      // Of a fragment, not of a whole part.
      const LoopView<Vertex> loop = tree_.loops.view(tree_.pieces[root], plane);
      if (root >= part_count_) return space_.add_plane_of(loop);
    }
    return plane;
  }

  /// Sorts the pieces of a task into front_, back_ and on_, by the plane of its root.
  void sort_pieces(std::span<const std::uint32_t> here, std::uint32_t root, PlaneId plane) {
    front_.clear();
    back_.clear();
    on_.clear();
    std::vector<std::uint32_t>& coplanar = options_.rules.on_goes_to_its_own_side ? on_ : back_;
    for (const std::uint32_t piece : here) {
      if (piece == root || (options_.identity && planes_[piece] == plane)) {
        (piece == root ? on_ : coplanar).push_back(piece);
        continue;
      }
      const LoopView<Vertex> loop = tree_.loops.view(tree_.pieces[piece], planes_[piece]);
      switch (record_.decide(space_, PlaneRef(plane), loop)) {
        case Placement::kFront:
          front_.push_back(piece);
          break;
        case Placement::kBack:
          back_.push_back(piece);
          break;
        case Placement::kOn:
          coplanar.push_back(piece);
          break;
        case Placement::kSpanning:
          split(loop, PlaneRef(plane), planes_[piece]);
          break;
      }
    }
  }

  void split(const LoopView<Vertex>& loop, PlaneRef plane, PlaneId support) {
    ++tree_.splits;
    parent_loop_.clear();
    const LoopRange copy = parent_loop_.append(loop);
    const SplitChildren children = make_children(space_, plane, parent_loop_.view(copy, support),
                                                 record_, crossings_, tree_.loops);
    for (const bool is_front : {true, false}) {
      const LoopRange& child = is_front ? children.front : children.back;
      if (child.count >= 3) {
        (is_front ? front_ : back_).push_back(add_piece(child, support));
      } else {
        ++tree_.vanished;
      }
    }
  }

  void add_node(const Task& task, PlaneId plane) {
    const auto node = static_cast<std::int32_t>(tree_.nodes.size());
    tree_.depth = std::max(tree_.depth, task.depth);
    tree_.nodes.push_back({plane, BspNode::kEmpty, BspNode::kEmpty,
                           static_cast<std::uint32_t>(tree_.node_pieces.size()),
                           static_cast<std::uint32_t>(on_.size())});
    tree_.node_pieces.insert(tree_.node_pieces.end(), on_.begin(), on_.end());
    if (task.parent != BspNode::kEmpty) {
      BspNode& parent = tree_.nodes[static_cast<std::size_t>(task.parent)];
      (task.is_front ? parent.front : parent.back) = node;
    }
    for (const bool is_front : {true, false}) {
      const std::vector<std::uint32_t>& list = is_front ? front_ : back_;
      if (list.empty()) continue;
      work_.insert(work_.end(), list.begin(), list.end());
      tasks_.push_back({static_cast<std::uint32_t>(list.size()), node, is_front, task.depth + 1});
    }
  }

  Space& space_;
  Options options_;
  std::size_t part_count_;  // the first so many pieces are whole parts
  RootChooser chooser_;
  SceneBsp<Vertex> tree_;
  std::vector<Task> tasks_;
  std::vector<Box> boxes_;           // by piece
  std::vector<PlaneId> planes_;      // by piece: its support plane
  std::vector<std::uint32_t> work_;  // pieces of all open tasks, the top task's last
  // Workspace, kept to save allocations.
  std::vector<std::uint32_t> front_, back_, on_;
  SplitRecord record_;
  LoopStore<Vertex> parent_loop_;  // the loop being split: children are appended to tree_.loops
  std::vector<Vertex> crossings_;
};

template <SceneSpaceModel Space>
SceneBsp<typename Space::Vertex> build_scene_bsp(Space& space, const PreparedScene& scene,
                                                 std::span<const std::uint32_t> parts,
                                                 std::uint64_t seed, bool identity,
                                                 const std::atomic<bool>* interrupted,
                                                 std::uint64_t max_pieces, const Rules& rules,
                                                 Roots roots) {
  return SceneBspBuilder<Space>(space, scene, parts,
                                {seed, identity, interrupted, max_pieces, rules, roots})
      .build();
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SCENE_BSP_SCENE_BSP_INL_H
