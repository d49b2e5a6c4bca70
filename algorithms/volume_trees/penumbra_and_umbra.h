// SPDX-License-Identifier: LGPL-3.0-or-later
// One light by the merged algorithm (Chin & Feiner 1992): receivers are filtered down the tree of
// all casters' penumbras, and what is in a penumbra down the tree of all umbras. A point or
// directional light has no penumbra: one tree is the set union of its shadow volumes (Thibault &
// Naylor 1987), and what it holds is in shadow.
//
// Receivers go down finished trees, or trees that still grow, where whoever calls cut() knows that
// all casters that hide light from the receiver have been cast (interleaved_order.h).
//
// Volumes must not depend on the receiver. They do not where the receiver's plane has no vertex of
// the light behind it: then A_R = A, so that A_O = A n {P_O > 0} is a matter of the caster's side
// alone, whether its plane cuts the light or not, and the umbra, which asks for all of A_R, of A.
// A caster whose plane cuts the light thus goes in with the volume of the part of the light in
// front of it (both of them if it is two-sided) and without an umbra. That a caster reaches behind
// the receiver's or the light's plane does not matter either (shadow_volume.h), nor that a receiver
// reaches behind the light's: that piece is cut off. Receivers whose plane does cut the light are
// for the receiver algorithm, so that both give the same classes.
//
// A receiver that lies in a face of a volume is outside it: the receiver's front is in front of the
// caster's plane if they are coplanar and face the same way; if they face opposite ways, the light
// would have to be on both sides. Classes are those of the definition (docs: semantics), since a
// point in front of the light is in the penumbra or umbra of a caster iff it is in its volume, and
// the trees are the unions of the volumes.
#ifndef GNOMON_ALGORITHMS_VOLUME_TREES_PENUMBRA_AND_UMBRA_H
#define GNOMON_ALGORITHMS_VOLUME_TREES_PENUMBRA_AND_UMBRA_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/partition/rules.h"
#include "algorithms/partition/run_options.h"
#include "algorithms/shadow_volumes/light_in_space.h"
#include "algorithms/volume_trees/balanced_prefix.h"
#include "algorithms/volume_trees/bounding_box.h"
#include "algorithms/volume_trees/cast_in_cells.h"
#include "algorithms/volume_trees/end_caps.h"
#include "algorithms/volume_trees/volume_tree.h"

namespace gnomon {

template <VolumeSpaceModel Space>
class PenumbraAndUmbra {
 public:
  using Vertex = typename Space::Vertex;
  using Loop = LoopView<Vertex>;

  /// The trees' planes are added to `space`, which must be forked afterwards.
  PenumbraAndUmbra(Space& space, const LightInSpace<Space>& light, const PreparedScene& scene,
                   const CasterTree& boxes, const RunOptions& options, bool caps,
                   const Rules& rules)
      : space_(&space),
        light_(&light),
        scene_(&scene),
        boxes_(&boxes),
        options_(&options),
        has_caps_(caps),
        rules_(rules),
        penumbra_(rules),
        umbra_(rules),
        grower_(space) {}

  using Outcome = CastOutcome;
  /// The trees may have so many nodes for each fragment that the limits allow.
  static constexpr std::uint64_t kMostNodesAFragment = 8;
  /// Leaves of the prefix. Measured on cities and quads of 3,001 to 30,001 polygons, small and
  /// large lights: no other value is faster than this by more than a half; 8 or no prefix cost up
  /// to 3 times as much.
  static constexpr std::uint32_t kReceiversALeaf = 64;

  /// The light's casting volumes by the distance of their casters from it: the volumes of near
  /// casters hold those of far ones, which then go into few cells. In the other order the trees
  /// explode.
  std::vector<std::uint32_t> near_first() const;
  /// Readies the trees for those receivers (parts), which must include all that cut() will be asked
  /// for. Adds the last planes to the space.
  void begin(std::span<const std::uint32_t> receivers);
  /// Adds one of the light's volumes to the trees. False if they have too many nodes.
  bool cast(std::uint32_t volume);
  /// Casts those volumes in this order, as CastInCells does. Requires: begin(), and none was cast.
  template <class Step, class Stopped>
  Outcome cast_all(std::span<const std::uint32_t> volumes, unsigned jobs, const Step& step,
                   const Stopped& stopped);

  /// Whether a side that sees the light can be filtered: its plane does not cut the light.
  bool takes(Space& space, SplitRecord& record, PlaneRef receiving) const {
    if (!light_->has_area()) return true;
    const auto placement = record.decide(space, receiving, light_->shape().loop);
    return placement == Placement::kFront ||
           (placement == Placement::kSpanning && !rules_.straddling_light_is_cut);
  }

  /// Does what LightInSpace::cut does, for the whole loop of a side that takes() accepts.
  template <class Emit>
  bool cut(Space& space, SplitRecord& record, VolumeTreeWorkspace<Space>& workspace,
           const Loop& whole, PlaneRef receiving, const Emit& emit) const;

  std::uint64_t node_count() const { return penumbra_.node_count() + umbra_.node_count(); }
  /// Of the deeper tree. O(nodes).
  std::uint64_t depth() const { return std::max(penumbra_.depth(), umbra_.depth()); }
  std::uint64_t findings() const { return findings_ + grower_.splitter.findings(); }
  /// Decisions that forks of the space have made for the trees, and the space has not counted.
  const StageCounts& stage_counts() const { return stages_; }

 private:
  void plan_caps(std::span<const std::uint32_t> receivers);
  std::uint64_t most_nodes() const {
    const std::uint64_t fragments = options_->limits.fragments;
    return fragments > ~std::uint64_t{0} / kMostNodesAFragment ? ~std::uint64_t{0}
                                                               : kMostNodesAFragment * fragments;
  }
  /// Cuts the penumbra or the umbra of a volume out of the box, up to its end. None: there is
  /// none.
  std::optional<VolumeInTree> cut_out(Space& space, PolyhedronSplitter<Space>& splitter,
                                      std::uint32_t index, bool is_umbra,
                                      Polyhedron<Vertex>& volume) const;
  /// Some point in front of a side: of an area light, or of the scene's box, which a far lamp is
  /// outside of. None if the box has none.
  std::optional<Corner<Vertex>> before(Space& space, PlaneRef receiving) const;
  template <class Emit>
  bool filter(VolumeTreeWorkspace<Space>& workspace, const Loop& loop,
              const ReceivingSide<Vertex>& receiving, const Emit& emit) const;

  Space* space_;
  const LightInSpace<Space>* light_;
  const PreparedScene* scene_;
  const CasterTree* boxes_;
  const RunOptions* options_;
  bool has_caps_;
  Rules rules_;
  Polyhedron<Vertex> box_;       // that volumes are cut out of
  std::vector<VolumeEnd> ends_;  // by volume; empty: there are no caps
  VolumeTree<Space> penumbra_, umbra_;
  TreeGrower<Space> grower_;
  Polyhedron<Vertex> volume_;
  std::uint64_t findings_ = 0;  // of cast_all()
  StageCounts stages_;
};

template <VolumeSpaceModel Space>
std::vector<std::uint32_t> PenumbraAndUmbra<Space>::near_first() const {
  const LightShape<Vertex> light = light_->shape();
  std::array<double, 3> centre{};
  // Far away in the direction of the light, in units of the box.
  constexpr double kFar = 1e3;
  if (light.direction != nullptr) {
    const std::array<double, 3>& direction = light.direction->nearest;
    const double length = std::hypot(direction[0], direction[1], direction[2]);
    for (std::size_t k = 0; k < 3; ++k) centre[k] = kFar * direction[k] / length;
  }
  for (std::uint32_t i = 0; i < light.loop.size(); ++i) {
    const std::array<Ball, 3> corner = space_->position(light.loop.corner(i));
    for (std::size_t k = 0; k < 3; ++k) centre[k] += corner[k].middle / light.loop.size();
  }
  std::vector<std::pair<double, std::uint32_t>> keys;
  for (const std::uint32_t i : light_->casting_volumes()) {
    const Box box = light_->caster_box(i);
    double square = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double step = (box.low[k] + box.high[k]) / 2 - centre[k];
      square += step * step;
    }
    keys.emplace_back(square, i);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> order;
  order.reserve(keys.size());
  for (const auto& key : keys) order.push_back(key.second);
  return order;
}

template <VolumeSpaceModel Space>
void PenumbraAndUmbra<Space>::begin(std::span<const std::uint32_t> receivers) {
  // Volumes that end at others do so only where no plane but the volumes' cuts them.
  if (options_->prefix && rules_.volumes_continue_behind_others) {
    std::vector<Box> receiver_boxes;
    receiver_boxes.reserve(receivers.size());
    for (const std::uint32_t part : receivers) receiver_boxes.push_back(boxes_->box(part));
    const SpacePrefix prefix = plan_space_prefix(receiver_boxes, kReceiversALeaf);
    penumbra_.plant(*space_, prefix);
    umbra_.plant(*space_, prefix);
  }
  // Volumes are cut out of the scene's box, or the part of it that is in front of an area light.
  box_ = make_box(*space_, {0, 0, 0}, {1, 1, 1});
  if (light_->has_area()) grower_.splitter.clip(*space_, light_->plane(), false, box_);
  if (has_caps_) plan_caps(receivers);
}

/// The penumbra holds the umbra, so that both end where it does.
template <VolumeSpaceModel Space>
void PenumbraAndUmbra<Space>::plan_caps(std::span<const std::uint32_t> receivers) {
  EndCaps caps(scene_->parts.size(), receivers,
               [&](std::uint32_t part) { return boxes_->box(part); });
  const VolumeStore& store = light_->volumes();
  ends_.resize(store.size());
  for (const std::uint32_t i : light_->casting_volumes()) {
    const auto whole = light_->has_area() ? store.penumbra(store[i]) : store.umbra(store[i]);
    cut_volume(*space_, box_, whole, grower_.splitter, volume_);
    ends_[i] = caps.end_of(*space_, volume_, store[i].caster);
  }
}

template <VolumeSpaceModel Space>
std::optional<VolumeInTree> PenumbraAndUmbra<Space>::cut_out(Space& space,
                                                             PolyhedronSplitter<Space>& splitter,
                                                             std::uint32_t index, bool is_umbra,
                                                             Polyhedron<Vertex>& volume) const {
  const VolumeStore& store = light_->volumes();
  const ShadowVolume& own = store[index];
  const auto planes = is_umbra ? store.umbra(own) : store.penumbra(own);
  if (planes.empty() || (!ends_.empty() && ends_[index].reaches_nothing)) return std::nullopt;
  cut_volume(space, box_, planes, splitter, volume);
  if (!ends_.empty()) {
    for (const PlaneRef cap : ends_[index].caps) splitter.clip(space, cap, true, volume);
  }
  return VolumeInTree{planes.front().index(), own.caster};
}

template <VolumeSpaceModel Space>
bool PenumbraAndUmbra<Space>::cast(std::uint32_t index) {
  for (const bool is_umbra : {false, true}) {
    const auto own = cut_out(*space_, grower_.splitter, index, is_umbra, volume_);
    if (!own) continue;
    VolumeTree<Space>& tree = is_umbra ? umbra_ : penumbra_;
    if (!tree.insert(grower_, volume_, own->base, own->caster, most_nodes())) return false;
  }
  return true;
}

template <VolumeSpaceModel Space>
template <class Step, class Stopped>
CastOutcome PenumbraAndUmbra<Space>::cast_all(std::span<const std::uint32_t> volumes, unsigned jobs,
                                              const Step& step, const Stopped& stopped) {
  CastInCells<Space> cells(*space_, penumbra_, umbra_, rules_, most_nodes());
  const CastOutcome outcome = cells.cast(
      volumes, jobs,
      [&](Space& space, PolyhedronSplitter<Space>& splitter, std::uint32_t volume, bool is_umbra,
          Polyhedron<Vertex>& out) { return cut_out(space, splitter, volume, is_umbra, out); },
      step, stopped);
  findings_ += cells.findings();
  stages_ += cells.stage_counts();
  return outcome;
}

template <VolumeSpaceModel Space>
template <class Emit>
bool PenumbraAndUmbra<Space>::filter(VolumeTreeWorkspace<Space>& workspace, const Loop& loop,
                                     const ReceivingSide<Vertex>& receiving,
                                     const Emit& emit) const {
  if (!light_->has_area()) {
    workspace.umbra.clear();
    workspace.filter.filter(umbra_, loop, receiving, workspace.umbra);
    return std::ranges::all_of(workspace.umbra.fragments, [&](const CellLoop& cell) {
      const bool lit = cell.caster == Fragment::kNoCaster;
      const PieceClass state{lit ? LightState::kLit : LightState::kShadow, cell.caster,
                             ShadowReason::kNone};
      return emit(state, workspace.umbra.loops.view(cell.loop, loop.support));
    });
  }
  workspace.penumbra.clear();
  workspace.filter.filter(penumbra_, loop, receiving, workspace.penumbra);
  for (const CellLoop& cell : workspace.penumbra.fragments) {
    const Loop piece = workspace.penumbra.loops.view(cell.loop, loop.support);
    if (cell.caster == Fragment::kNoCaster) {
      if (!emit(PieceClass{LightState::kLit}, piece)) return false;
      continue;
    }
    workspace.umbra.clear();
    workspace.filter.filter(umbra_, piece, receiving, workspace.umbra);
    for (const CellLoop& inner : workspace.umbra.fragments) {
      const bool umbra = inner.caster != Fragment::kNoCaster;
      const PieceClass state{umbra ? LightState::kUmbra : LightState::kPenumbra,
                             umbra ? inner.caster : cell.caster, ShadowReason::kNone};
      if (!emit(state, workspace.umbra.loops.view(inner.loop, loop.support))) return false;
    }
  }
  return true;
}

template <VolumeSpaceModel Space>
std::optional<Corner<typename Space::Vertex>> PenumbraAndUmbra<Space>::before(
    Space& space, PlaneRef receiving) const {
  const LightShape<Vertex> light = light_->shape();
  for (std::uint32_t i = 0; light.has_area() && i < light.loop.size(); ++i) {
    const Corner<Vertex> corner = light.loop.corner(i);
    // Rounding may find none of them in front.
    if (space.side_of_plane(receiving, corner) == Side::kFront || i + 1 == light.loop.size()) {
      return corner;
    }
  }
  for (const PolyhedronFace& face : box_.faces) {
    for (std::uint32_t i = 0; i < face.count; ++i) {
      const Corner<Vertex> corner = box_.corner(face, i);
      if (space.side_of_plane(receiving, corner) == Side::kFront) return corner;
    }
  }
  return std::nullopt;
}

template <VolumeSpaceModel Space>
template <class Emit>
bool PenumbraAndUmbra<Space>::cut(Space& space, SplitRecord& record,
                                  VolumeTreeWorkspace<Space>& workspace, const Loop& whole,
                                  PlaneRef receiving, const Emit& emit) const {
  constexpr PieceClass kBehind{LightState::kUmbra, Fragment::kNoCaster, ShadowReason::kBehindLight};
  const LightShape<Vertex> light = light_->shape();
  const std::optional<Corner<Vertex>> corner = before(space, receiving);
  // On the border of the box, facing outwards: volumes end there, and nothing is in front of it.
  if (!corner) return emit(PieceClass{LightState::kLit}, whole);
  const ReceivingSide<Vertex> side{receiving, &*corner};
  if (!light.has_area()) return filter(workspace, whole, side, emit);
  switch (record.decide(space, light.plane, whole)) {
    case Placement::kBack:
    case Placement::kOn:
      return emit(kBehind, whole);
    case Placement::kFront:
      return filter(workspace, whole, side, emit);
    case Placement::kSpanning:
      break;
  }
  workspace.front.clear();
  std::vector<Vertex> crossings;
  const SplitChildren children =
      make_children(space, light.plane, whole, record, crossings, workspace.front);
  if (children.back.count >= 3 &&
      !emit(kBehind, workspace.front.view(children.back, whole.support))) {
    return false;
  }
  return children.front.count < 3 ||
         filter(workspace, workspace.front.view(children.front, whole.support), side, emit);
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_VOLUME_TREES_PENUMBRA_AND_UMBRA_H
