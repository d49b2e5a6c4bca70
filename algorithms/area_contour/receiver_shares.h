// SPDX-License-Identifier: LGPL-3.0-or-later
// The shares of one side of a receiver under an area light, from the outlines of the volumes that
// reach it: lit is what the union of penumbras leaves, umbra is the union of umbras, and penumbra
// is the rest. No piece is made.
//
// Which volumes miss the receiver or hold all of it is decided exactly, by the sides of its corners
// against planes of volumes. What the others cover is found in doubles with bounds
// (outline_union.h). Where these leave a class open, or much of a share, nothing is said, and the
// receiver is to be cut exactly (shadow_volumes/receiver_cutter.h).
//
// Guarantee: a class that is told is the definition's, and shares are certified. The doubles are
// those of kernel `plane`; on other kernels nothing is ever said.
#ifndef GNOMON_ALGORITHMS_AREA_CONTOUR_RECEIVER_SHARES_H
#define GNOMON_ALGORITHMS_AREA_CONTOUR_RECEIVER_SHARES_H

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/area_contour/lines_in_space.h"
#include "algorithms/area_contour/outline_union.h"
#include "algorithms/area_contour/placed_volumes.h"
#include "algorithms/area_contour/receiver_chart.h"
#include "algorithms/area_contour/share_classes.h"
#include "algorithms/area_contour/volume_search.h"
#include "algorithms/partition/import_export.h"
#include "algorithms/shadow_volumes/light_in_space.h"
#include "kernel/concept/kernel_concept.h"
#include "kernel/implicit/filter_bounds.h"

namespace gnomon::area_contour {

/// A space whose planes have doubles with proven bounds, and tell what they were made from.
template <class Space>
concept HasPlaneDoubles = requires(const Space& space, PlaneRef plane) {
  space.load(plane).n;
  space.source_of(plane);
};

template <class Space>
PlaneDoubles doubles_of(const Space& space, PlaneRef plane) {
  const auto loaded = space.load(plane);
  return {loaded.n, loaded.d, plane, nullptr};
}

/// The volumes of a light for the search. `jobs`: as LightVolumes::finish() has it.
template <VolumeSpaceModel Space>
LightVolumes light_volumes(const Space& space, const LightGeometry& geometry,
                           const CasterTree& tree, const LightInSpace<Space>& light,
                           unsigned jobs) {
  const PreparedScene& scene = light.scene();
  std::vector<Box> boxes;
  boxes.reserve(scene.parts.size());
  for (std::uint32_t part = 0; part < scene.parts.size(); ++part) boxes.push_back(tree.box(part));
  Box box;
  std::vector<Point3> corners;
  double bound = 0;
  for (const VertexId vertex : geometry.faces[light.number()].loop) {
    corners.push_back(grid_fraction(geometry.geometry.grid, vertex));
    box.add(corners.back());
    bound = static_cast<double>(space.input_vertex(vertex).bound);  // all have the same
  }
  LightVolumes result(std::move(boxes), box, std::move(corners), bound);
  const VolumeStore& store = light.volumes();
  for (std::uint32_t i = 0; i < store.size(); ++i) {
    const std::uint32_t part = store[i].caster;
    result.add(i, part, scene.parts[part].plane, store[i].penumbra_count, store[i].umbra_count);
  }
  result.finish(jobs, [&](std::uint32_t volume, bool umbra, std::vector<PlaneDoubles>& planes) {
    planes.clear();
    const ShadowVolume& own = store[volume];
    for (const PlaneRef plane : umbra ? store.umbra(own) : store.penumbra(own)) {
      planes.push_back(doubles_of(space, plane));
    }
  });
  return result;
}

/// Of one thread and one light.
template <VolumeSpaceModel Space>
class ReceiverShares {
 public:
  using Vertex = typename Space::Vertex;
  using Loop = LoopView<Vertex>;
  using Workspace = ReceiverWorkspace<Space>;

  /// The shares of a side that sees the light. None: they are open. `whole`: the part's own loop.
  std::optional<Shares> find(Workspace& workspace, const LightInSpace<Space>& light,
                             const LightVolumes& volumes, std::uint32_t part, Side side,
                             const Loop& whole);

 private:
  /// Fewer volumes are all asked.
  static constexpr std::size_t kLeastMasked = 8;
  enum class Relation : std::uint8_t { kOutside, kInside, kCrossing, kOpen };
  enum class Border : std::uint8_t { kOpen, kClosed };
  enum class Verdict : std::uint8_t { kGoesOn, kAllUmbra, kOpen };

  bool make_chart(const Space& space, const Loop& whole);
  std::optional<Shares> find_whole(Workspace& workspace, const LightInSpace<Space>& light,
                                   const LightVolumes& volumes, PlaneRef receiving);
  std::optional<Shares> find_cut(Workspace& workspace, const LightInSpace<Space>& light,
                                 const LightVolumes& volumes, PlaneRef receiving,
                                 const LightShape<Vertex>& cut);
  void set_cut_light(const Space& space, const LightInSpace<Space>& light, const Loop& loop);
  bool blocks(Workspace& workspace, PlaneRef receiving, const PreparedScene& scene,
              std::uint32_t caster);
  Verdict add_cut_volume(Workspace& workspace, const LightInSpace<Space>& light, PlaneRef receiving,
                         const LightShape<Vertex>& cut, const FoundVolume& found);
  std::optional<Shares> find_masked(Workspace& workspace, const LightInSpace<Space>& light,
                                    const LightVolumes& volumes, PlaneRef receiving);
  Verdict add_volume(Space& space, const VolumeStore& store, const VolumeToCut& cut,
                     bool penumbra = true);
  std::optional<Shares> shares();
  Relation relate(Space& space, std::span<const PlaneRef> planes, Border border);

  PlaneRef support_;
  std::vector<Corner<Vertex>> corners_;  // in the chart's order
  SearchedReceiver searched_;
  ReceiverChart chart_;
  VolumeSearch search_;
  CutLight cut_light_;
  bool all_penumbra_ = false;
  std::vector<OutlineLine> lines_;
  PlacedVolumes placed_;
  const ShadowBoxes* masked_ = nullptr;  // of what is being added, if masks are kept
  std::vector<Point3> caster_;
  OutlineUnion penumbras_, umbras_;
};

template <VolumeSpaceModel Space>
bool ReceiverShares<Space>::make_chart(const Space& space, const Loop& whole) {
  double bound = 0;
  searched_.corners.clear();
  for (const Vertex& vertex : whole.vertices) {
    searched_.corners.push_back(vertex.x);
    bound = std::max(bound, static_cast<double>(vertex.bound));
  }
  if (!chart_.make(space.load(support_).n, searched_.corners,
                   VolumeBounds::input(space.geometry().grid.bits()), bound)) {
    return false;
  }
  corners_.clear();
  for (std::uint32_t i = 0; i < whole.size(); ++i) {
    corners_.push_back(whole.corner(chart_.reversed && i > 0 ? whole.size() - i : i));
  }
  return true;
}

/// Leaves the lines that cross the receiver in lines_.
template <VolumeSpaceModel Space>
typename ReceiverShares<Space>::Relation ReceiverShares<Space>::relate(
    Space& space, std::span<const PlaneRef> planes, Border border) {
  lines_.clear();
  bool is_open = false;
  for (const PlaneRef plane : planes) {
    const auto loaded = space.load(plane);
    CornerMask before = 0, behind = 0;
    for (std::uint32_t k = 0; k < corners_.size(); ++k) {
      const Side side = space.side_of_plane(loaded, corners_[k]);
      before |= static_cast<CornerMask>(side == Side::kFront) << k;
      behind |= static_cast<CornerMask>(side == Side::kBack) << k;
    }
    if (before == 0) {
      if (behind == 0 && border == Border::kClosed) continue;
      return Relation::kOutside;
    }
    if (behind == 0 || is_open) continue;
    PlaneDoubles doubles{loaded.n, loaded.d, plane, nullptr};
    Point3 point;
    if (plane.index() >= space.edges().planes && !space.source_of(plane).is_explicit()) {
      point = space.input_vertex(space.source_of(plane).vertices[0]).x;
      doubles.point = &point;
    }
    is_open = !chart_.add_line(doubles, before, behind, lines_);
  }
  if (is_open) return Relation::kOpen;
  return lines_.empty() ? Relation::kInside : Relation::kCrossing;
}

template <VolumeSpaceModel Space>
typename ReceiverShares<Space>::Verdict ReceiverShares<Space>::add_volume(Space& space,
                                                                          const VolumeStore& store,
                                                                          const VolumeToCut& cut,
                                                                          bool penumbra) {
  const ShadowVolume& volume = store[cut.volume];
  if (!all_penumbra_ && penumbra) {
    const Relation relation = relate(space, store.penumbra(volume), Border::kOpen);
    if (relation == Relation::kOutside) return Verdict::kGoesOn;
    if (relation == Relation::kOpen) return Verdict::kOpen;
    all_penumbra_ = relation == Relation::kInside;
    if (!all_penumbra_) {
      penumbras_.add(lines_);
      if (masked_ != nullptr) placed_.penumbras.add(lines_, masked_->penumbra);
    }
  }
  if (!cut.umbra || volume.umbra_count == 0) return Verdict::kGoesOn;
  const Relation relation = relate(space, store.umbra(volume), Border::kClosed);
  if (relation == Relation::kOpen) return Verdict::kOpen;
  if (relation == Relation::kInside) return Verdict::kAllUmbra;
  if (relation == Relation::kCrossing) {
    umbras_.add(lines_);
    if (masked_ != nullptr) placed_.umbras.add(lines_, masked_->umbra);
  }
  return Verdict::kGoesOn;
}

template <VolumeSpaceModel Space>
std::optional<Shares> ReceiverShares<Space>::shares() {
  const auto share = [](OutlineUnion& outlines) -> std::optional<UnionShare> {
    if (outlines.size() == 0) return std::nullopt;
    return outlines.share();
  };
  return shares_of(all_penumbra_ ? std::nullopt : share(penumbras_), all_penumbra_, share(umbras_));
}

/// Whether a caster is partly in front of the receiver.
template <VolumeSpaceModel Space>
bool ReceiverShares<Space>::blocks(Workspace& workspace, PlaneRef receiving,
                                   const PreparedScene& scene, std::uint32_t caster) {
  const Loop loop = part_loop(workspace.space, scene, caster, workspace.caster);
  for (std::uint32_t i = 0; i < loop.size(); ++i) {
    if (workspace.space.side_of_plane(receiving, loop.corner(i)) == Side::kFront) return true;
  }
  return false;
}

/// Of a light that the receiver's plane does not cut.
template <VolumeSpaceModel Space>
std::optional<Shares> ReceiverShares<Space>::find_whole(Workspace& workspace,
                                                        const LightInSpace<Space>& light,
                                                        const LightVolumes& volumes,
                                                        PlaneRef receiving) {
  const VolumeSearch::Outcome outcome = search_.find(volumes, searched_);
  if (outcome == VolumeSearch::Outcome::kAllUmbra) return kAllUmbra;
  all_penumbra_ = outcome == VolumeSearch::Outcome::kAllPenumbra;
  if (search_.found().size() >= kLeastMasked) {
    return find_masked(workspace, light, volumes, receiving);
  }
  for (const FoundVolume& found : search_.found()) {
    if (!blocks(workspace, receiving, light.scene(), found.part)) continue;
    const Verdict verdict =
        add_volume(workspace.space, light.volumes(), {found.number, found.umbra});
    if (verdict == Verdict::kOpen) return std::nullopt;
    if (verdict == Verdict::kAllUmbra) return kAllUmbra;
  }
  return shares();
}

/// The same of many volumes, the largest outlines first, without those that lie where others are
/// known to cover.
template <VolumeSpaceModel Space>
std::optional<Shares> ReceiverShares<Space>::find_masked(Workspace& workspace,
                                                         const LightInSpace<Space>& light,
                                                         const LightVolumes& volumes,
                                                         PlaneRef receiving) {
  const Space& space = workspace.space;
  const PreparedScene& scene = light.scene();
  const auto plane = space.load(support_);
  const double sign = receiving.flipped() ? -1 : 1;
  placed_.begin(chart_, {sign * plane.n[0], sign * plane.n[1], sign * plane.n[2]}, sign * plane.d,
                volumes);
  for (const FoundVolume& found : search_.found()) {
    caster_.clear();
    for (const VertexId vertex : scene.loop(scene.parts[found.part])) {
      caster_.push_back(space.input_vertex(vertex).x);
    }
    placed_.place(found, caster_, all_penumbra_);
  }
  for (const PlacedVolume& volume : placed_.largest_first()) {
    const FoundVolume& found = volume.found;
    const bool umbra = found.umbra && !placed_.umbras.holds(volume.boxes.umbra);
    const bool penumbra = !all_penumbra_ && !placed_.penumbras.holds(volume.boxes.penumbra);
    if (!umbra && !penumbra) continue;
    if (volume.boxes.place != ShadowBoxes::Place::kInFront &&
        !blocks(workspace, receiving, scene, found.part)) {
      continue;
    }
    masked_ = &volume.boxes;
    const Verdict verdict =
        add_volume(workspace.space, light.volumes(), {found.number, umbra}, penumbra);
    if (verdict == Verdict::kOpen) return std::nullopt;
    if (verdict == Verdict::kAllUmbra || (umbra && placed_.umbras.is_full())) return kAllUmbra;
    all_penumbra_ = all_penumbra_ || placed_.penumbras.is_full();
  }
  return shares();
}

/// Of a light that it cuts: by the volumes of the part in front, which are made here.
template <VolumeSpaceModel Space>
std::optional<Shares> ReceiverShares<Space>::find_cut(Workspace& workspace,
                                                      const LightInSpace<Space>& light,
                                                      const LightVolumes& volumes,
                                                      PlaneRef receiving,
                                                      const LightShape<Vertex>& cut) {
  if (cut.loop.size() < 3) return shares();
  set_cut_light(workspace.space, light, cut.loop);
  if (search_.begin_cut(volumes, searched_, cut_light_) || search_.find_blocking()) {
    return kAllUmbra;
  }
  for (const bool blocking : {true, false}) {
    if (!blocking && search_.find_others(all_penumbra_)) return kAllUmbra;
    for (const FoundVolume& found : search_.found()) {
      const Verdict verdict = add_cut_volume(workspace, light, receiving, cut, found);
      if (verdict == Verdict::kOpen) return std::nullopt;
      if (verdict == Verdict::kAllUmbra) return kAllUmbra;
    }
  }
  return shares();
}

template <VolumeSpaceModel Space>
void ReceiverShares<Space>::set_cut_light(const Space& space, const LightInSpace<Space>& light,
                                          const Loop& loop) {
  cut_light_.box = light.box_of(space, loop);
  light.corners_of(space, loop, cut_light_.corners);
}

/// A volume that the whole light has on the receiver, made for the part of the light in front.
template <VolumeSpaceModel Space>
typename ReceiverShares<Space>::Verdict ReceiverShares<Space>::add_cut_volume(
    Workspace& workspace, const LightInSpace<Space>& light, PlaneRef receiving,
    const LightShape<Vertex>& cut, const FoundVolume& found) {
  if (all_penumbra_ && !found.umbra) return Verdict::kGoesOn;
  const PreparedScene& scene = light.scene();
  if (!blocks(workspace, receiving, scene, found.part)) return Verdict::kGoesOn;
  // The first plane of each volume is its caster's own, seen from behind.
  const VolumeStore& store = light.volumes();
  const PlaneRef side = -store.penumbra(store[found.number])[0];
  const Part& part = scene.parts[found.part];
  workspace.own.clear();
  workspace.builder.add(part_loop(workspace.space, scene, found.part, workspace.caster), side,
                        side.flipped() != part.flipped, cut, workspace.own,
                        all_penumbra_ ? VolumesWanted::kUmbra : VolumesWanted::kBoth);
  if (workspace.own.size() == 0) return Verdict::kGoesOn;
  return add_volume(workspace.space, workspace.own, {0, found.umbra});
}

template <VolumeSpaceModel Space>
std::optional<Shares> ReceiverShares<Space>::find(Workspace& workspace,
                                                  const LightInSpace<Space>& light,
                                                  const LightVolumes& volumes, std::uint32_t part,
                                                  Side side, const Loop& whole) {
  Space& space = workspace.space;
  if (whole.size() > kMostCorners) return std::nullopt;
  const PlaneRef receiving = plane_of_side(light.scene().parts[part], side);
  support_ = PlaneRef(receiving.index(), false);
  if (!make_chart(space, whole)) return std::nullopt;
  searched_.part = part;
  searched_.support = receiving.index();
  LinesInSpace<Space> exact(space, whole, corners_, chart_);
  penumbras_.begin(chart_, exact);
  umbras_.begin(chart_, exact);
  all_penumbra_ = false;
  masked_ = nullptr;
  // What is behind the light gets nothing, as if it were in every umbra.
  const PlaneRef behind = -light.plane();
  const Relation relation = relate(space, {&behind, 1}, Border::kClosed);
  if (relation == Relation::kOpen) return std::nullopt;
  if (relation == Relation::kCrossing) {
    penumbras_.add(lines_);
    umbras_.add(lines_);
  }
  if (const auto cut = light.cut_by(workspace, receiving)) {
    return find_cut(workspace, light, volumes, receiving, *cut);
  }
  return find_whole(workspace, light, volumes, receiving);
}

/// ReceiverShares where the space has what it needs, else nothing.
struct NoContour {};
template <class Space>
struct ContourChoice {
  using Type = NoContour;
};
template <HasPlaneDoubles Space>
struct ContourChoice<Space> {
  using Type = ReceiverShares<Space>;
};
template <class Space>
using ContourOf = typename ContourChoice<Space>::Type;

}  // namespace gnomon::area_contour

#endif  // GNOMON_ALGORITHMS_AREA_CONTOUR_RECEIVER_SHARES_H
