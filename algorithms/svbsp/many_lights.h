// SPDX-License-Identifier: LGPL-3.0-or-later
// Several lights in a pipeline (Chin & Feiner 1989, sec. 5): the fragments that one light's SVBSP
// tree leaves are filtered through the next, front to back from that light, so that each fragment
// at the end carries the set of lights that reach all of it.
//
// The trees themselves grow from the scene's own polygons, never from fragments of earlier lights
// (the "more coherent fragments" of sec. 6): planes stay of bounded degree, and a light's tree does
// not depend on the order of the lights. Between lights a fragment is stored without any light's
// space: each edge by who made it (the scene, or the tree of light j), from which every space
// derives its plane.
#ifndef GNOMON_ALGORITHMS_SVBSP_MANY_LIGHTS_H
#define GNOMON_ALGORITHMS_SVBSP_MANY_LIGHTS_H

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "algorithms/scene_bsp/scene_bsp.h"
#include "algorithms/svbsp/svbsp.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

/// EdgeOrigin says who made an edge: the scene (an input edge or support plane) or a light's tree.
struct EdgeOrigin {
  static constexpr std::uint32_t kScene = 0xffffffffu;
  std::uint32_t light = kScene;  // index of the run
  PlaneRef plane;                // in scene space or in that light's space
  friend bool operator==(const EdgeOrigin&, const EdgeOrigin&) = default;
};

template <LightSpaceModel Space>
class Pipeline {
 public:
  using Vertex = typename Space::Vertex;
  using SceneVertex = typename Space::SceneSpace::Vertex;

  /// A fragment in counter-clockwise order of its part's loop (seen from the front).
  struct Item {
    std::vector<Vertex> vertices;
    std::vector<EdgeOrigin> edges;
    std::uint64_t lit_by = 0;  // bit i: run i
  };

  Pipeline(const PreparedScene& scene, const typename Space::SceneSpace& scene_space,
           const SceneBsp<SceneVertex>& bsp)
      : scene_(scene),
        scene_space_(scene_space),
        bsp_(bsp),
        front_(bsp.pieces.size()),
        back_(bsp.pieces.size()),
        last_run_{std::vector<std::uint32_t>(bsp.pieces.size()),
                  std::vector<std::uint32_t>(bsp.pieces.size())} {}

  void add_space(Space& space) { spaces_.push_back(&space); }

  /// Filters the fragments of a piece through the tree of the current run. Requires: nothing that
  /// is behind the piece has been inserted into the tree. `run`: the index of the tree's space.
  void filter(std::uint32_t piece, Side side, std::uint32_t run, SvbspTree<Space>& tree) {
    std::vector<Item>& items = side == Side::kFront ? front_[piece] : back_[piece];
    const LoopRange& range = bsp_.pieces[piece];
    const Part& part = scene_.parts[range.part];
    if (items.empty()) items.push_back(whole(range, part));
    std::vector<Item> next;
    for (const Item& item : items) {
      import(item, part, side == Side::kBack, run);
      output_.loops.clear();
      output_.fragments.clear();
      tree.filter(loop_.view({0, loop_.size(), range.part}, part.plane),
                  {.classify = true, .insert = false}, output_);
      for (const ClassifiedLoop& fragment : output_.fragments) {
        next.push_back(
            item_of(output_.loops.view(fragment.loop, part.plane), item, side == Side::kBack, run));
        next.back().lit_by = item.lit_by;
        if (fragment.state == LightState::kLit) next.back().lit_by |= std::uint64_t{1} << run;
      }
    }
    items = std::move(next);
    last_run_[side == Side::kFront ? 0 : 1][piece] = run;
  }

  /// Calls visit(part, side, lit_by, space, loop) for every fragment; the loop is in the space of
  /// the last light that the side faces.
  template <class Visit>
  void for_each(const Visit& visit) {
    for (std::uint32_t piece = 0; piece < bsp_.pieces.size(); ++piece) {
      const std::uint32_t index = bsp_.pieces[piece].part;
      const Part& part = scene_.parts[index];
      for (const Side side : {Side::kFront, Side::kBack}) {
        const std::vector<Item>& items = side == Side::kFront ? front_[piece] : back_[piece];
        if (items.empty()) continue;
        const std::uint32_t run = last_run_[side == Side::kFront ? 0 : 1][piece];
        for (const Item& item : items) {
          import(item, part, side == Side::kBack, run);
          visit(index, side, item.lit_by, *spaces_[run],
                loop_.view({0, loop_.size(), index}, part.plane));
        }
      }
    }
  }

 private:
  Item whole(const LoopRange& range, const Part& part) const {
    Item item;
    const LoopView<SceneVertex> loop = bsp_.loops.view(range, part.plane);
    for (std::uint32_t i = 0; i < loop.size(); ++i) {
      item.vertices.push_back(spaces_.front()->import_vertex(loop.vertices[i]));
      item.edges.push_back({EdgeOrigin::kScene, loop.edges[i]});
    }
    return item;
  }

  /// Puts an item into loop_, counter-clockwise as seen from the light of `run`.
  void import(const Item& item, const Part& part, bool reversed, std::uint32_t run) {
    Space& space = *spaces_[run];
    const auto n = static_cast<std::uint32_t>(item.vertices.size());
    loop_.clear();
    order_.clear();
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t from = reversed ? n - 1 - i : i;
      Vertex vertex = item.vertices[from];
      if (vertex.source != kMadeVertex) {
        vertex = space.import_vertex(scene_space_.input_vertex(vertex.source));
      }
      loop_.push(std::move(vertex), PlaneRef());
      order_.push_back(reversed ? (from == 0 ? n - 1 : from - 1) : i);
    }
    for (std::uint32_t i = 0; i < n; ++i) {
      const EdgeOrigin& origin = item.edges[order_[i]];
      if (origin.light == EdgeOrigin::kScene) {
        loop_.edge(i) = space.import_edge(origin.plane, part.plane, reversed, loop_.vertex(i),
                                          loop_.vertex(i + 1 == n ? 0 : i + 1));
      } else if (origin.light == run) {
        loop_.edge(i) = origin.plane;
      } else {
        loop_.edge(i) = space.import_cut(*spaces_[origin.light], origin.plane, part.plane);
      }
    }
    for (std::uint32_t i = 0; i < n; ++i) {
      if (loop_.vertex(i).source == kMadeVertex) {
        space.finish_vertex(loop_.vertex(i), loop_.edge(i == 0 ? n - 1 : i - 1), loop_.edge(i));
      }
    }
  }

  /// Takes a loop back from light space; edges that the item `from` has keep their origin.
  Item item_of(const LoopView<Vertex>& loop, const Item& from, bool reversed, std::uint32_t run) {
    const std::uint32_t n = loop.size();
    Item item;
    item.vertices.resize(n);
    item.edges.resize(n);
    for (std::uint32_t i = 0; i < n; ++i) {
      EdgeOrigin origin{run, loop.edges[i]};
      for (std::uint32_t k = 0; k < loop_.size(); ++k) {
        if (loop.edges[i].valid() && loop_.edge(k) == loop.edges[i]) {
          origin = from.edges[order_[k]];
          break;
        }
      }
      const std::uint32_t vertex = reversed ? n - 1 - i : i;
      const std::uint32_t edge = reversed ? (vertex == 0 ? n - 1 : vertex - 1) : i;
      item.vertices[vertex] = loop.vertices[i];
      item.edges[edge] = origin;
    }
    return item;
  }

  const PreparedScene& scene_;
  const typename Space::SceneSpace& scene_space_;
  const SceneBsp<SceneVertex>& bsp_;
  std::vector<Space*> spaces_;
  std::vector<std::vector<Item>> front_, back_;  // per piece; empty: not filtered yet
  std::array<std::vector<std::uint32_t>, 2> last_run_;
  LoopStore<Vertex> loop_;
  std::vector<std::uint32_t> order_;  // loop_ edge -> item edge
  ClassifiedLoops<Vertex> output_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SVBSP_MANY_LIGHTS_H
