// SPDX-License-Identifier: LGPL-3.0-or-later
// Body of build_scene_bsp, instantiated one kernel a source.
#ifndef GNOMON_ALGORITHMS_SCENE_BSP_SCENE_BSP_INL_H
#define GNOMON_ALGORITHMS_SCENE_BSP_SCENE_BSP_INL_H

#include <algorithm>

#include "algorithms/scene_bsp/scene_bsp.h"

namespace gnomon {

/// What the tree needs only while it is built.
struct BspBuilderState {
  std::vector<ApproximateBox> boxes;  // per piece
  std::vector<PlaneId> planes;        // per piece: its support plane
  std::vector<std::uint32_t> work;    // pieces of all open tasks, the top task's last
  std::vector<std::uint32_t> front, back, on;
};

template <SceneSpaceModel Space>
SceneBsp<typename Space::Vertex> build_scene_bsp(Space& space, const PreparedScene& scene,
                                                 std::span<const std::uint32_t> parts,
                                                 std::uint64_t seed, bool identity,
                                                 const std::atomic<bool>* interrupted,
                                                 std::uint64_t max_pieces, const Rules& rules) {
  using Vertex = typename Space::Vertex;
  SceneBsp<Vertex> tree;
  BspBuilderState state;
  const SceneEdges names = space.edges();

  const auto add_piece = [&](const LoopRange& range, PlaneId plane) {
    ApproximateBox box;
    for (std::uint32_t i = 0; i < range.count; ++i) {
      const std::array<double, 3> p = space.approximate(tree.loops.vertex(range.first + i));
      for (int k = 0; k < 3; ++k) {
        box.low[k] = i == 0 ? p[k] : std::min(box.low[k], p[k]);
        box.high[k] = i == 0 ? p[k] : std::max(box.high[k], p[k]);
      }
    }
    tree.pieces.push_back(range);
    state.boxes.push_back(box);
    state.planes.push_back(plane);
    return static_cast<std::uint32_t>(tree.pieces.size() - 1);
  };

  for (const std::uint32_t index : parts) {
    const Part& part = scene.parts[index];
    const LoopRange range{tree.loops.size(), part.count, index};
    const auto loop = scene.loop(part);
    const auto edges = scene.edges(part);
    for (std::uint32_t i = 0; i < part.count; ++i) {
      tree.loops.push(space.input_vertex(loop[i]),
                      names.of_edge(edges[i].index(), edges[i].flipped()));
    }
    state.work.push_back(add_piece(range, part.plane));
  }

  struct Task {
    std::uint32_t count;  // of the last entries of `work`
    std::int32_t parent;  // node, or kEmpty for the root
    bool is_front;
    std::uint32_t depth;
  };
  std::vector<Task> tasks;
  if (!state.work.empty()) {
    tasks.push_back({static_cast<std::uint32_t>(state.work.size()), BspNode::kEmpty, true, 1});
  }
  RootChooser chooser(scene.geometry, seed);
  SplitRecord record;
  LoopStore<Vertex> parent_loop;  // the loop being split: children are appended to tree.loops
  std::vector<Vertex> crossings;
  while (!tasks.empty()) {
    if (interrupted != nullptr && interrupted->load(std::memory_order_relaxed)) {
      tree.interrupted = true;
      break;
    }
    if (tree.pieces.size() > max_pieces) {
      tree.too_many = true;
      break;
    }
    const Task task = tasks.back();
    tasks.pop_back();
    const std::size_t begin = state.work.size() - task.count;
    const std::span<const std::uint32_t> here(state.work.data() + begin, task.count);
    const std::uint32_t root = here[chooser.choose(here, state.boxes, state.planes)];
    PlaneId plane = state.planes[root];
    if constexpr (requires(LoopView<Vertex> loop) { space.add_plane_of(loop); }) {
      // Of a fragment, not of a whole part.
      const LoopView<Vertex> loop = tree.loops.view(tree.pieces[root], plane);
      if (root >= parts.size()) plane = space.add_plane_of(loop);
    }

    state.front.clear();
    state.back.clear();
    state.on.clear();
    std::vector<std::uint32_t>& coplanar = rules.on_goes_to_its_own_side ? state.on : state.back;
    for (const std::uint32_t piece : here) {
      if (piece == root || (identity && state.planes[piece] == plane)) {
        (piece == root ? state.on : coplanar).push_back(piece);
        continue;
      }
      const LoopRange range = tree.pieces[piece];
      const LoopView<Vertex> loop = tree.loops.view(range, state.planes[piece]);
      switch (record.decide(space, PlaneRef(plane), loop)) {
        case Placement::kFront:
          state.front.push_back(piece);
          break;
        case Placement::kBack:
          state.back.push_back(piece);
          break;
        case Placement::kOn:
          coplanar.push_back(piece);
          break;
        case Placement::kSpanning: {
          ++tree.splits;
          parent_loop.clear();
          const LoopRange copy = parent_loop.append(loop);
          const SplitChildren children =
              make_children(space, PlaneRef(plane), parent_loop.view(copy, state.planes[piece]),
                            record, crossings, tree.loops);
          if (children.front.count >= 3) {
            state.front.push_back(add_piece(children.front, state.planes[piece]));
          } else {
            ++tree.vanished;
          }
          if (children.back.count >= 3) {
            state.back.push_back(add_piece(children.back, state.planes[piece]));
          } else {
            ++tree.vanished;
          }
          break;
        }
      }
    }

    const std::int32_t node = static_cast<std::int32_t>(tree.nodes.size());
    tree.depth = std::max(tree.depth, task.depth);
    tree.nodes.push_back({plane, BspNode::kEmpty, BspNode::kEmpty,
                          static_cast<std::uint32_t>(tree.node_pieces.size()),
                          static_cast<std::uint32_t>(state.on.size())});
    tree.node_pieces.insert(tree.node_pieces.end(), state.on.begin(), state.on.end());
    if (task.parent != BspNode::kEmpty) {
      BspNode& parent = tree.nodes[static_cast<std::size_t>(task.parent)];
      (task.is_front ? parent.front : parent.back) = node;
    }
    state.work.resize(begin);
    for (const bool is_front : {true, false}) {
      const std::vector<std::uint32_t>& list = is_front ? state.front : state.back;
      if (list.empty()) continue;
      state.work.insert(state.work.end(), list.begin(), list.end());
      tasks.push_back({static_cast<std::uint32_t>(list.size()), node, is_front, task.depth + 1});
    }
  }
  return tree;
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SCENE_BSP_SCENE_BSP_INL_H
