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

#include "algorithms/area_contour/light_volumes.h"
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
  /// Few receivers have so many: what they took is given back.
  static constexpr std::size_t kMany = 2048;
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
  static bool blocks(Space& space, PlaneRef receiving, const LightInSpace<Space>& light,
                     std::uint32_t caster);
  Verdict add_cut_volume(Workspace& workspace, const LightInSpace<Space>& light, PlaneRef receiving,
                         const LightShape<Vertex>& cut, const FoundVolume& found);
  std::optional<Shares> find_masked(Workspace& workspace, const LightInSpace<Space>& light,
                                    const LightVolumes& volumes, PlaneRef receiving);
  Verdict add_volume(Space& space, const VolumeStore& store, const FoundVolume& found);
  /// Whether some area of the receiver is inside of a penumbra that was added, or of an umbra.
  bool has_inside(Workspace& workspace, const LightInSpace<Space>& light, bool umbra);
  std::optional<UnionShare> share_of(Workspace& workspace, const LightInSpace<Space>& light,
                                     bool umbra);
  std::optional<Shares> shares(Workspace& workspace, const LightInSpace<Space>& light);
  Relation relate(Space& space, std::span<const PlaneRef> planes, OpenPlanes open, Border border);

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
  CornerValues corner_values_;
  const Loop* whole_ = nullptr;
  bool is_partly_behind_ = false;  // the light; the rest of the receiver is not
  bool has_volumes_ = false;       // some volume has been added
  bool is_whole_ = false;          // the receiver's plane cuts no light; then, of its store:
  std::vector<std::uint32_t> added_penumbras_, added_umbras_;
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

/// Leaves the lines that cross the receiver in lines_. The receiver is in front of all planes that
/// are not `open`.
template <VolumeSpaceModel Space>
typename ReceiverShares<Space>::Relation ReceiverShares<Space>::relate(
    Space& space, std::span<const PlaneRef> planes, OpenPlanes open, Border border) {
  lines_.clear();
  bool is_open = false;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (!open.has(i)) continue;
    const PlaneRef plane = planes[i];
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

/// `found`: a volume of the store, and what of it is to be added.
template <VolumeSpaceModel Space>
typename ReceiverShares<Space>::Verdict ReceiverShares<Space>::add_volume(
    Space& space, const VolumeStore& store, const FoundVolume& found) {
  const ShadowVolume& volume = store[found.number];
  if (!all_penumbra_ && found.penumbra) {
    const Relation relation =
        relate(space, store.penumbra(volume), found.of_penumbra, Border::kOpen);
    if (relation == Relation::kOutside) return Verdict::kGoesOn;
    if (relation == Relation::kOpen) return Verdict::kOpen;
    has_volumes_ = true;
    all_penumbra_ = relation == Relation::kInside;
    if (!all_penumbra_) {
      penumbras_.add(lines_);
      if (is_whole_) added_penumbras_.push_back(found.number);
      if (masked_ != nullptr) placed_.penumbras.add(lines_, masked_->penumbra);
    }
  }
  if (!found.umbra || volume.umbra_count == 0) return Verdict::kGoesOn;
  const Relation relation = relate(space, store.umbra(volume), found.of_umbra, Border::kClosed);
  if (relation == Relation::kOpen) return Verdict::kOpen;
  if (relation == Relation::kInside) return Verdict::kAllUmbra;
  if (relation == Relation::kCrossing) {
    has_volumes_ = true;
    umbras_.add(lines_);
    if (is_whole_) added_umbras_.push_back(found.number);
    if (masked_ != nullptr) placed_.umbras.add(lines_, masked_->umbra);
  }
  return Verdict::kGoesOn;
}

template <VolumeSpaceModel Space>
bool ReceiverShares<Space>::has_inside(Workspace& workspace, const LightInSpace<Space>& light,
                                       bool umbra) {
  const VolumeStore& store = light.volumes();
  return std::ranges::any_of(umbra ? added_umbras_ : added_penumbras_, [&](std::uint32_t number) {
    const ShadowVolume& volume = store[number];
    return workspace.cutter.has_inside(*whole_,
                                       umbra ? store.umbra(volume) : store.penumbra(volume), umbra);
  });
}

/// None: no outline has any area. Where bounds do not tell whether one has, which is so of slivers
/// beside a caster that is nearly in the receiver's plane, it is asked exactly, if all outlines but
/// that of what is behind the light are those of the whole light's volumes.
template <VolumeSpaceModel Space>
std::optional<UnionShare> ReceiverShares<Space>::share_of(Workspace& workspace,
                                                          const LightInSpace<Space>& light,
                                                          bool umbra) {
  OutlineUnion& outlines = umbra ? umbras_ : penumbras_;
  if (outlines.size() == 0) return std::nullopt;
  UnionShare share = outlines.share();
  share.some = is_partly_behind_;
  if (!share.some && is_whole_ && may_be_nothing(share)) {
    share.some = has_inside(workspace, light, umbra);
    if (!share.some) return std::nullopt;
  }
  return share;
}

template <VolumeSpaceModel Space>
std::optional<Shares> ReceiverShares<Space>::shares(Workspace& workspace,
                                                    const LightInSpace<Space>& light) {
  const std::optional<UnionShare> umbra = share_of(workspace, light, true);
  if (is_partly_behind_ && !has_volumes_ && !all_penumbra_) {
    return umbra ? shares_of(*umbra) : std::nullopt;
  }
  return shares_of(all_penumbra_ ? std::nullopt : share_of(workspace, light, false), all_penumbra_,
                   umbra);
}

/// Whether a caster is partly in front of the receiver.
template <VolumeSpaceModel Space>
bool ReceiverShares<Space>::blocks(Space& space, PlaneRef receiving,
                                   const LightInSpace<Space>& light, std::uint32_t caster) {
  return std::ranges::any_of(light.vertices_of(caster), [&](VertexId id) {
    const Vertex vertex = space.input_vertex(id);
    return space.side_of_plane(receiving, lone_corner(vertex)) == Side::kFront;
  });
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
    if (!blocks(workspace.space, receiving, light, found.caster)) continue;
    const Verdict verdict = add_volume(workspace.space, light.volumes(), found);
    if (verdict == Verdict::kOpen) return std::nullopt;
    if (verdict == Verdict::kAllUmbra) return kAllUmbra;
  }
  return shares(workspace, light);
}

/// The same of many volumes, the largest outlines first, without those that lie where others are
/// known to cover.
template <VolumeSpaceModel Space>
std::optional<Shares> ReceiverShares<Space>::find_masked(Workspace& workspace,
                                                         const LightInSpace<Space>& light,
                                                         const LightVolumes& volumes,
                                                         PlaneRef receiving) {
  const Space& space = workspace.space;
  const auto plane = space.load(support_);
  const double sign = receiving.flipped() ? -1 : 1;
  placed_.begin(chart_, {sign * plane.n[0], sign * plane.n[1], sign * plane.n[2]}, sign * plane.d,
                volumes);
  for (const FoundVolume& found : search_.found()) {
    const std::span<const VertexId> vertices = light.vertices_of(found.caster);
    caster_.resize(vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      caster_[i] = space.input_vertex(vertices[i]).x;
    }
    placed_.place(found, caster_, all_penumbra_);
  }
  for (const std::uint32_t number : placed_.largest_first()) {
    const PlacedVolume& volume = placed_[number];
    FoundVolume found = volume.found;
    found.umbra = found.umbra && !placed_.umbras.holds(volume.boxes.umbra);
    found.penumbra =
        found.penumbra && !all_penumbra_ && !placed_.penumbras.holds(volume.boxes.penumbra);
    if (!found.umbra && !found.penumbra) continue;
    if (volume.boxes.place != ShadowBoxes::Place::kInFront &&
        !blocks(workspace.space, receiving, light, found.caster)) {
      continue;
    }
    masked_ = &volume.boxes;
    const Verdict verdict = add_volume(workspace.space, light.volumes(), found);
    if (verdict == Verdict::kOpen) return std::nullopt;
    if (verdict == Verdict::kAllUmbra || (found.umbra && placed_.umbras.is_full()))
      return kAllUmbra;
    all_penumbra_ = all_penumbra_ || placed_.penumbras.is_full();
  }
  return shares(workspace, light);
}

/// Of a light that it cuts: by the volumes of the part in front, which are made here.
template <VolumeSpaceModel Space>
std::optional<Shares> ReceiverShares<Space>::find_cut(Workspace& workspace,
                                                      const LightInSpace<Space>& light,
                                                      const LightVolumes& volumes,
                                                      PlaneRef receiving,
                                                      const LightShape<Vertex>& cut) {
  if (cut.loop.size() < 3) return shares(workspace, light);
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
  return shares(workspace, light);
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
  const bool penumbra = found.penumbra && !all_penumbra_;
  if (!penumbra && !found.umbra) return Verdict::kGoesOn;
  if (!blocks(workspace.space, receiving, light, found.caster)) return Verdict::kGoesOn;
  const PreparedScene& scene = light.scene();
  workspace.own.clear();
  if (light.is_solid(found.caster)) {
    workspace.shells.add(scene, light.shell(found.caster), found.caster, cut, workspace.own);
  } else {
    const Part& part = scene.parts[found.caster];
    const PlaneRef side = light.volumes()[found.number].side;
    workspace.builder.add(part_loop(workspace.space, scene, found.caster, workspace.caster), side,
                          side.flipped() != part.flipped, cut, workspace.own,
                          penumbra ? VolumesWanted::kBoth : VolumesWanted::kUmbra);
  }
  if (workspace.own.size() == 0) return Verdict::kGoesOn;
  return add_volume(workspace.space, workspace.own,
                    {0, found.caster, penumbra, found.umbra, {}, {}});
}

template <VolumeSpaceModel Space>
std::optional<Shares> ReceiverShares<Space>::find(Workspace& workspace,
                                                  const LightInSpace<Space>& light,
                                                  const LightVolumes& volumes, std::uint32_t part,
                                                  Side side, const Loop& whole) {
  Space& space = workspace.space;
  if (whole.size() > kMostCorners) return std::nullopt;
  if (search_.found().size() > kMany) {  // of the last receiver
    penumbras_ = {};
    umbras_ = {};
    placed_ = {};
  }
  const PlaneRef receiving = plane_of_side(light.scene().parts[part], side);
  support_ = PlaneRef(receiving.index(), false);
  if (!make_chart(space, whole)) return std::nullopt;
  searched_.part = part;
  searched_.support = receiving.index();
  const std::uint32_t shell = light.shell_of(part);
  searched_.behind = side == Side::kFront && shell != ShellCasters::kNone ? shell : part;
  LinesInSpace<Space> exact(space, whole, corners_, chart_, corner_values_);
  penumbras_.begin(chart_, exact);
  umbras_.begin(chart_, exact);
  all_penumbra_ = false;
  masked_ = nullptr;
  whole_ = &whole;
  has_volumes_ = false;
  added_penumbras_.clear();
  added_umbras_.clear();
  // What is behind the light gets nothing, as if it were in every umbra.
  const PlaneRef behind = -light.plane();
  const Relation relation = relate(space, {&behind, 1}, {}, Border::kClosed);
  if (relation == Relation::kOpen) return std::nullopt;
  is_partly_behind_ = relation == Relation::kCrossing;
  if (is_partly_behind_) {
    penumbras_.add(lines_);
    umbras_.add(lines_);
  }
  const auto cut = light.cut_by(workspace, receiving);
  is_whole_ = !cut;
  if (cut) {
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
