// SPDX-License-Identifier: LGPL-3.0-or-later
// The order in which a light's trees grow while receivers are filtered down them (Chin & Feiner
// 1992, "Algorithm"): the nodes of a scene BSP, front to back from the centroid of the light. At
// its turn a node's pieces, which are coplanar, receive; then the polygons that have their first
// piece there cast, each with its whole volume.
//
// That order is right for all of the light only where no plane of the tree cuts the light: what is
// beyond a plane then hides nothing from what is before it, or in it. (In 1992 the light has been
// cut by all of them.) Behind a plane that cuts the light there is a part of it, from which what is
// behind hides something of what is before. So the pieces on the side that is visited first wait:
// they receive when all of the subtree below that plane has cast, of the topmost such plane if
// there are several.
//
// Guarantee on exact kernels: when a piece receives, every polygon that hides some of the light
// from it has cast. Volumes are exact sets, so that one which has been cast too early does no harm:
// classes are those of finished trees. Explicit stacks.
#ifndef GNOMON_ALGORITHMS_VOLUME_TREES_INTERLEAVED_ORDER_H
#define GNOMON_ALGORITHMS_VOLUME_TREES_INTERLEAVED_ORDER_H

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/partition/import_export.h"
#include "algorithms/partition/loop_store.h"
#include "algorithms/partition/rules.h"
#include "algorithms/partition/split.h"
#include "algorithms/scene_bsp/scene_bsp.h"
#include "algorithms/shadow_volumes/light_in_space.h"
#include "kernel/concept/kernel_concept.h"

namespace gnomon {

template <VolumeSpaceModel Space>
class InterleavedOrder {
 public:
  using Vertex = typename Space::Vertex;
  using Loop = LoopView<Vertex>;

  /// `nodes`: of a scene BSP of all parts. Adds no planes to the space.
  InterleavedOrder(Space& space, const LightInSpace<Space>& light, const PreparedScene& scene,
                   std::span<const BspNode> nodes, const Rules& rules)
      : space_(space), light_(light), scene_(scene), nodes_(nodes), builder_(space, rules) {
    order_nodes();
    cut_parts();
    order_casts();
  }

  /// Calls receive(Loop) for each piece of each part, cast(volume) for each casting volume of the
  /// light, all in order. False once either is.
  template <class Receive, class Cast>
  bool visit(const Receive& receive, const Cast& cast) const {
    std::size_t piece = 0, volume = 0;
    for (std::uint32_t turn = 0; turn < turns(); ++turn) {
      for (const bool after : {false, true}) {
        while (piece < pieces_.size() && pieces_[piece].when == When{turn, after}) {
          const Piece& own = pieces_[piece++];
          if (!receive(loops_.view(own.loop, scene_.parts[own.loop.part].plane))) return false;
        }
        if (after) continue;
        while (volume < casts_.size() && casts_[volume].turn == turn) {
          if (!cast(casts_[volume++].volume)) return false;
        }
      }
    }
    return true;
  }
  /// The volumes in the order in which they are cast.
  std::vector<std::uint32_t> volumes() const {
    std::vector<std::uint32_t> volumes;
    volumes.reserve(casts_.size());
    for (const Cast& cast : casts_) volumes.push_back(cast.volume);
    return volumes;
  }

  std::uint64_t piece_count() const { return pieces_.size(); }
  /// Pieces that received later than at their own turn.
  std::uint64_t waiting() const { return waiting_; }
  /// Pieces with fewer than three vertices that were dropped (rounded kernels).
  std::uint64_t vanished() const { return vanished_; }

 private:
  static constexpr std::uint32_t kNever = 0xffffffffu;
  /// A turn, before what casts at it or after.
  using When = std::pair<std::uint32_t, bool>;
  struct Piece {
    LoopRange loop;
    When when;
  };
  struct Cast {
    std::uint32_t turn, volume;
  };
  /// The light as a plane sees it.
  struct LightSides {
    Sign centroid = Sign::kZero;
    bool is_cut = false;
  };

  /// One turn a node, and one for what rounding keeps from coming to its node.
  std::uint32_t turns() const { return static_cast<std::uint32_t>(nodes_.size()) + 1; }

  LightSides sides_of(PlaneId plane);
  LightSides ask_sides(PlaneId plane);
  Sign side_of_centroid(PlaneId plane) const;
  void order_nodes();
  void cut_parts();
  void cut_part(std::uint32_t part);
  void split(const BspNode& node, const LoopRange& loop, PlaneId support);
  void add_piece(const LoopRange& loop, PlaneId support, std::int32_t node);
  void order_casts();

  Space& space_;
  const LightInSpace<Space>& light_;
  const PreparedScene& scene_;
  std::span<const BspNode> nodes_;
  VolumeBuilder<Space> builder_;
  std::vector<std::optional<LightSides>> sides_;  // by plane, as far as asked
  std::vector<std::uint32_t> turn_of_;            // by node
  std::vector<std::uint32_t> wait_of_;     // by node: the turn that its pieces wait for, or kNever
  std::vector<std::uint32_t> first_turn_;  // by part
  std::vector<Piece> pieces_;
  LoopStore<Vertex> loops_;
  std::vector<Cast> casts_;
  std::uint64_t waiting_ = 0, vanished_ = 0;
  // Workspace of cut_part().
  struct Task {
    LoopRange loop;  // in work_
    std::int32_t node;
  };
  std::vector<Task> tasks_;
  LoopStore<Vertex> work_, parent_, whole_;
  SplitRecord record_;
  std::vector<Vertex> crossings_;
};

template <VolumeSpaceModel Space>
typename InterleavedOrder<Space>::LightSides InterleavedOrder<Space>::sides_of(PlaneId plane) {
  std::optional<LightSides>& known = sides_[plane];
  if (!known) known = ask_sides(plane);
  return *known;
}

template <VolumeSpaceModel Space>
typename InterleavedOrder<Space>::LightSides InterleavedOrder<Space>::ask_sides(PlaneId plane) {
  const LightShape<Vertex> light = light_.shape();
  if (light.has_area()) {
    switch (record_.decide(space_, PlaneRef(plane), light.loop)) {
      case Placement::kFront:
        return {Sign::kPositive, false};
      case Placement::kBack:
        return {Sign::kNegative, false};
      case Placement::kOn:
        return {};
      case Placement::kSpanning:
        return {side_of_centroid(plane), true};
    }
  }
  if (builder_.is_in_front(PlaneRef(plane), light)) return {Sign::kPositive, false};
  return {builder_.is_in_front(-PlaneRef(plane), light) ? Sign::kNegative : Sign::kZero, false};
}

/// In doubles: where a plane cuts the light, either side may be visited first.
template <VolumeSpaceModel Space>
Sign InterleavedOrder<Space>::side_of_centroid(PlaneId plane) const {
  const Geometry& geometry = space_.geometry();
  const SupportTriple& triple = geometry.planes[plane];
  const std::array<double, 3>& a = geometry.positions[triple.a];
  std::array<double, 3> u{}, v{}, to_centroid{};
  const Loop light = light_.shape().loop;
  for (std::uint32_t i = 0; i < light.size(); ++i) {
    const std::array<double, 3> corner = space_.nearest_position(light.corner(i));
    for (std::size_t k = 0; k < 3; ++k) to_centroid[k] += (corner[k] - a[k]) / light.size();
  }
  for (std::size_t k = 0; k < 3; ++k) {
    u[k] = geometry.positions[triple.b][k] - a[k];
    v[k] = geometry.positions[triple.c][k] - a[k];
  }
  double value = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    value += (u[i] * v[j] - u[j] * v[i]) * to_centroid[k];
  }
  return value < 0 ? Sign::kNegative : Sign::kPositive;
}

template <VolumeSpaceModel Space>
void InterleavedOrder<Space>::order_nodes() {
  sides_.resize(space_.geometry().planes.size());
  const std::vector<std::uint32_t> order =
      front_to_back(nodes_, [&](PlaneId plane) { return sides_of(plane).centroid; });
  turn_of_.assign(nodes_.size(), 0);
  for (std::uint32_t turn = 0; turn < order.size(); ++turn) turn_of_[order[turn]] = turn;
  // Nodes come after their parents, so that one pass goes up and one down.
  std::vector<std::uint32_t> last = turn_of_;  // turn of each subtree
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    for (const std::int32_t child : {nodes_[i].front, nodes_[i].back}) {
      if (child == BspNode::kEmpty) continue;
      last[i] = std::max(last[i], last[static_cast<std::size_t>(child)]);
    }
  }
  wait_of_.assign(nodes_.size(), kNever);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const BspNode& node = nodes_[i];
    const LightSides light = sides_of(node.plane);
    const std::int32_t near = light.centroid != Sign::kNegative ? node.front : node.back;
    for (const std::int32_t child : {node.front, node.back}) {
      if (child == BspNode::kEmpty) continue;
      // What a node waits for comes after all that is below the node.
      std::uint32_t& wait = wait_of_[static_cast<std::size_t>(child)];
      wait = wait_of_[i];
      if (wait == kNever && child == near && light.is_cut) wait = last[i];
    }
  }
}

template <VolumeSpaceModel Space>
void InterleavedOrder<Space>::cut_parts() {
  first_turn_.assign(scene_.parts.size(), kNever);
  for (std::uint32_t part = 0; part < scene_.parts.size(); ++part) cut_part(part);
  std::ranges::stable_sort(pieces_, {}, &Piece::when);
}

/// The pieces that the scene BSP has of a part, once more in the space of the volumes.
template <VolumeSpaceModel Space>
void InterleavedOrder<Space>::cut_part(std::uint32_t part) {
  const PlaneId support = scene_.parts[part].plane;
  work_.clear();
  tasks_.assign(1, {work_.append(part_loop(space_, scene_, part, whole_)),
                    nodes_.empty() ? BspNode::kEmpty : 0});
  while (!tasks_.empty()) {
    Task task = tasks_.back();
    tasks_.pop_back();
    bool is_split = false;
    while (!is_split && task.node != BspNode::kEmpty) {
      const BspNode& node = nodes_[static_cast<std::size_t>(task.node)];
      if (node.plane == support) break;
      const Placement placement =
          record_.decide(space_, PlaneRef(node.plane), work_.view(task.loop, support));
      if (placement == Placement::kOn) break;  // where rounding flattens it
      is_split = placement == Placement::kSpanning;
      if (is_split) {
        split(node, task.loop, support);
      } else {
        task.node = placement == Placement::kFront ? node.front : node.back;
      }
    }
    if (is_split) continue;
    add_piece(task.loop, support, task.node);
    work_.truncate(task.loop.first);
  }
}

/// Puts the children in the place of the loop, which is the last in work_.
template <VolumeSpaceModel Space>
void InterleavedOrder<Space>::split(const BspNode& node, const LoopRange& loop, PlaneId support) {
  parent_.clear();
  const LoopRange copy = parent_.append(work_.view(loop, support));
  work_.truncate(loop.first);
  const SplitChildren children = make_children(
      space_, PlaneRef(node.plane), parent_.view(copy, support), record_, crossings_, work_);
  // The front child was appended last and is taken first, so that the loops are a stack.
  for (const bool front : {false, true}) {
    const LoopRange& child = front ? children.front : children.back;
    if (child.count >= 3) {
      tasks_.push_back({child, front ? node.front : node.back});
    } else {
      ++vanished_;
    }
  }
}

template <VolumeSpaceModel Space>
void InterleavedOrder<Space>::add_piece(const LoopRange& loop, PlaneId support, std::int32_t node) {
  const bool lost = node == BspNode::kEmpty;
  const auto at = static_cast<std::size_t>(lost ? 0 : node);
  const std::uint32_t turn = lost ? turns() - 1 : turn_of_[at];
  const bool waits = !lost && wait_of_[at] != kNever;
  pieces_.push_back({loops_.append(work_.view(loop, support)),
                     waits ? When{wait_of_[at], true} : When{turn, false}});
  waiting_ += waits ? 1 : 0;
  first_turn_[loop.part] = std::min(first_turn_[loop.part], turn);
}

template <VolumeSpaceModel Space>
void InterleavedOrder<Space>::order_casts() {
  std::vector<bool> is_there(light_.volumes().size(), false);
  std::vector<std::uint32_t> parts(scene_.parts.size());
  std::iota(parts.begin(), parts.end(), 0u);
  std::ranges::stable_sort(parts, {}, [&](std::uint32_t part) { return first_turn_[part]; });
  for (const std::uint32_t part : parts) {
    const auto [begin, end] = light_.casting_volumes_of(part);
    for (std::uint32_t volume = begin; volume < end; ++volume) {
      // A solid casts with the first of its faces.
      if (is_there[volume]) continue;
      is_there[volume] = true;
      casts_.push_back({std::min(first_turn_[part], turns() - 1), volume});
    }
  }
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_VOLUME_TREES_INTERLEAVED_ORDER_H
