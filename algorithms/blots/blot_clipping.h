// SPDX-License-Identifier: LGPL-3.0-or-later
// Shadows by blots (Crow 1977, second class): convex sub-objects front to back, each cut by the
// outlines of those before it, what of it is lit adding its own outline.
//
// Which sub-object comes first is asked of the sub-objects themselves: one may hide another if it
// is nearer somewhere in their overlap. Where such pairs make a ring, or two sub-objects go through
// each other, there is no order: these are taken apart into polygons, which are cut by the blots
// there are, and what is left clips itself (two_pass/list_clipping.h).
//
// Blots need no depth: nothing that is cut by a blot is nearer than the blot's object, except where
// it lies in a plane of that object. It is then nowhere behind it, since a convex solid is behind
// the planes of its faces, and the blot does not count. For the same reason nothing is lost where
// an outline is cut by the blots before it: what lies in a plane of a nearer object is not hidden
// by one behind that. But a blot that a later outline holds may be dropped only when no polygon
// that lies in a plane of the later object is still to come.
//
// Guarantee on exact kernels: the pieces put out tile the polygons and have the class of the
// definition; the witness is a part, or a solid whose faces hide the light together. On rounded
// kernels pieces may contradict each other. Explicit stacks.
#ifndef GNOMON_ALGORITHMS_BLOTS_BLOT_CLIPPING_H
#define GNOMON_ALGORITHMS_BLOTS_BLOT_CLIPPING_H

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "algorithms/blots/blot_list.h"
#include "algorithms/blots/bundle_clip.h"
#include "algorithms/blots/convex_solids.h"
#include "algorithms/blots/object_order.h"
#include "algorithms/two_pass/list_clipping.h"
#include "gnomon/algorithms/method_options.h"

namespace gnomon {

template <SectorSpaceModel Space>
class BlotClipping {
 public:
  using Vertex = typename Space::Vertex;

  /// What polygons are clipped in.
  struct Setting {
    typename ListClipping<Space>::Setting lists;
    const SolidsOfLight& solids;
    Outlines outlines = Outlines::kPartial;
  };

  /// Appends what becomes of the polygons of a cell to `output`; ClippedPiece::caster is a part, or
  /// the number of parts and a solid. The cell has
  ///  - bounds_all(edge): whether all polygons are inside that plane;
  ///  - box_of(loop): a box of it;
  ///  - stopped(): whether to give up;
  ///  - gives_up(n): the same with so many pieces of one sub-object, which a rounded kernel may go
  ///    on making.
  template <class Cell>
  void run(const Setting& setting, std::span<const ListPiece> polygons, const Cell& cell,
           std::vector<ClippedPiece>& output) {
    setting_ = &setting;
    output_ = &output;
    const auto stopped = [&] { return cell.stopped(); };
    first_made_ = kNoPlane;
    order_.make(setting.lists, polygons, setting.solids, bounds_all(cell), stopped);
    blots_.clear(order_.size());
    WorkCounts& counts = setting.lists.counts;
    for (std::size_t i = 0; i < order_.groups() && !stopped(); ++i) {
      const std::span<const std::uint32_t> group = order_.take_group(i);
      if (group.size() == 1) {
        add_sub_object(group.front(), cell);
      } else {
        ++counts[Counter::kCycles];
        add_cycle(group, cell, stopped);
      }
    }
    counts[Counter::kClips] += clip_.cuts() - std::exchange(cuts_before_, clip_.cuts());
  }
  std::uint64_t take_vanished() { return clip_.take_vanished() + lists_.take_vanished(); }

 private:
  static constexpr std::uint32_t kNoPlane = std::numeric_limits<std::uint32_t>::max();

  /// Whether all polygons of the cell are inside a plane. Planes made where polygons of the cell
  /// cross bound only what they have cut.
  template <class Cell>
  auto bounds_all(const Cell& cell) const {
    return [this, &cell](PlaneRef edge) {
      return edge.index() < first_made_ && cell.bounds_all(edge);
    };
  }
  PlaneId plane_of(const ListPiece& face) const {
    return setting_->lists.scene.parts[face.loop.part].plane;
  }
  bool has_face_in(std::uint32_t object, PlaneId plane) const {
    return std::ranges::any_of(order_.faces_of(object),
                               [&](const ListPiece& face) { return plane_of(face) == plane; });
  }
  /// A blot does not count against what lies in a plane of its object.
  bool counts_against(BlotId blot, const ListPiece& face) const {
    return !setting_->lists.rules.on_goes_to_its_own_side ||
           !has_face_in(blots_[blot].object, plane_of(face));
  }
  LoopView<Vertex> view(const ListPiece& face) const {
    return setting_->lists.loops.view(face.loop, plane_of(face));
  }
  void put_out(std::span<const ListPiece> faces, std::uint32_t caster) {
    for (const ListPiece& face : faces) output_->push_back({face.loop, face.item, caster});
  }

  /// The blots that may hide some of an object, front to back: near_.
  void find_near(std::uint32_t object) {
    near_.clear();
    const ChartBox& box = order_.object(object).box;
    for (const std::uint32_t hider : order_.hiders_of(object)) {
      blots_.for_each_of(hider, [&](BlotId blot) {
        if (blots_[blot].box.overlaps(box)) near_.push_back(blot);
      });
    }
    std::ranges::sort(near_);
  }

  template <class Cell>
  void add_sub_object(std::uint32_t object, const Cell& cell) {
    find_near(object);
    const std::span<const ListPiece> faces = order_.faces_of(object);
    const bool is_exempt = std::ranges::any_of(near_, [&](BlotId blot) {
      return std::ranges::any_of(
          faces, [&](const ListPiece& face) { return !counts_against(blot, face); });
    });
    if (!is_exempt || faces.size() == 1) {
      add_faces(object, faces, cell);
    } else {  // one by one, since different blots count against them
      for (std::size_t i = 0; i < faces.size(); ++i) add_faces(object, faces.subspan(i, 1), cell);
    }
  }

  /// A sub-object, or one of its faces: what of it is lit adds blots.
  template <class Cell>
  void add_faces(std::uint32_t object, std::span<const ListPiece> faces, const Cell& cell) {
    const auto& lists = setting_->lists;
    WorkCounts& counts = lists.counts;
    const SubObject& own = order_.object(object);
    store_.clear();
    store_.faces.assign(faces.begin(), faces.end());
    const Bundle whole{0,    static_cast<std::uint32_t>(faces.size()),  0, 0,
                       true, faces.size() == 1 ? faces[0].box : own.box};
    const BlotId cover = find_cover(faces, whole.box);
    if (cover != Blot::kNone) {
      put_out(faces, blots_[cover].caster);
      ++counts[Counter::kBoxShortcuts];
      return;
    }
    find_planes(object, whole, cell);
    if (own.casts) {
      find_absorbable(object, whole.box);
    } else {
      absorbable_.clear();
    }
    if (near_.empty() && absorbable_.empty()) ++counts[Counter::kBoxShortcuts];
    lit_.assign(1, whole);
    bool cut = false;
    for (const BlotId blot : near_) {
      if (is_absorbable(blot) || !counts_against(blot, faces[0])) continue;
      cut |= cut_by(blot, cell);
      if (lit_.empty() || cell.gives_up(lit_.size())) break;
    }
    if (own.casts && !lit_.empty()) add_blots(object, faces, whole, cut, cell);
    faces_.clear();
    for (const Bundle& bundle : lit_) {
      const std::span<const ListPiece> lit = store_.faces_of(bundle);
      faces_.insert(faces_.end(), lit.begin(), lit.end());
    }
    if (absorbable_.empty()) return put_out(faces_, ClippedPiece::kLit);
    for (const ListPiece& face : faces_) {
      subtract(face, absorbable_, cell,
               [&](const ListPiece& rest) { put_out(std::span(&rest, 1), ClippedPiece::kLit); });
    }
  }

  /// A blot that holds all of the faces; none if there is none.
  BlotId find_cover(std::span<const ListPiece> faces, const ChartBox& box) {
    for (const BlotId blot : near_) {
      if (!holds(blots_[blot].box, box) || !counts_against(blot, faces[0])) continue;
      if (std::ranges::all_of(faces, [&](const ListPiece& face) {
            return clip_.is_inside(setting_->lists.space, blots_.planes(blot), view(face));
          })) {
        return blot;
      }
    }
    return Blot::kNone;
  }

  /// The planes of a bundle's outline: planes_.
  template <class Cell>
  void find_planes(std::uint32_t object, const Bundle& bundle, const Cell& cell) {
    planes_.clear();
    const LoopStore<Vertex>& loops = setting_->lists.loops;
    const auto bounds = bounds_all(cell);
    const bool is_whole_loop = bundle.face_count == 1;
    const std::span<const ListPiece> faces = store_.faces_of(bundle);
    const auto for_each_edge = [&](const auto& visit) {
      for (const ListPiece& face : faces) {
        for (std::uint32_t k = 0; k < face.loop.count; ++k) visit(loops.edge(face.loop.first + k));
      }
    };
    for_each_edge([&](PlaneRef edge) {
      if (bounds(edge)) return;
      if (is_whole_loop ||
          setting_->solids.solids[order_.object(object).solid].is_in_outline(edge)) {
        planes_.push_back(edge);
      }
    });
    for (const PlaneRef cut : store_.cuts_of(bundle)) {
      if (is_whole_loop || !touches(cut, faces)) continue;
      if (std::ranges::find(planes_, cut) == planes_.end()) planes_.push_back(cut);
    }
  }
  /// Whether a plane that all of the faces are inside of has a corner of them on it.
  bool touches(PlaneRef plane, std::span<const ListPiece> faces) {
    Space& space = setting_->lists.space;
    for (const ListPiece& face : faces) {
      const LoopView<Vertex> loop = view(face);
      for (std::uint32_t i = 0; i < loop.size(); ++i) {
        if (space.side_of_plane(plane, loop.corner(i)) != Side::kFront) return true;
      }
    }
    return false;
  }

  /// The blots within the outline in planes_, if these may be absorbed: absorbable_.
  void find_absorbable(std::uint32_t object, const ChartBox& box) {
    absorbable_.clear();
    const auto& lists = setting_->lists;
    const auto is_to_come = [&](const ListPiece& face) {
      return order_.is_to_come(plane_of(face));
    };
    if (lists.rules.blots_absorbed_after_their_planes_received &&
        std::ranges::any_of(order_.faces_of(object), is_to_come)) {
      return;
    }
    for (const BlotId blot : near_) {
      if (holds(box, blots_[blot].box) && is_within(blot)) absorbable_.push_back(blot);
    }
  }
  bool is_absorbable(BlotId blot) const { return std::ranges::binary_search(absorbable_, blot); }
  /// Whether a blot is inside the outline in planes_.
  bool is_within(BlotId blot) {
    const auto& lists = setting_->lists;
    return std::ranges::all_of(blots_.loops(blot), [&](const LoopRange& loop) {
      return clip_.is_inside(lists.space, planes_,
                             lists.loops.view(loop, lists.scene.parts[loop.part].plane));
    });
  }

  /// Cuts the bundles in lit_ by a blot; what is inside is put out. False if nothing is.
  template <class Cell>
  bool cut_by(BlotId blot, const Cell& cell) {
    const auto& lists = setting_->lists;
    const Blot& by = blots_[blot];
    still_lit_.clear();
    bool any = false;
    for (Bundle& bundle : lit_) {
      locate(bundle, cell);
      if (!bundle.box.overlaps(by.box) || clip_.clip(
                                              lists.space, blots_.planes(blot), bundle,
                                              [&](const ListPiece& face) { return plane_of(face); },
                                              lists.loops, store_) == ConePlace::kOutside) {
        still_lit_.push_back(bundle);
        continue;
      }
      any = true;
      ++lists.counts[Counter::kBlotCuts];
      still_lit_.insert(still_lit_.end(), clip_.outside().begin(), clip_.outside().end());
      put_out(store_.faces_of(clip_.inside()), by.caster);
    }
    lit_.swap(still_lit_);
    return any;
  }
  template <class Cell>
  void locate(Bundle& bundle, const Cell& cell) const {
    if (bundle.located) return;
    const std::span<const ListPiece> faces = store_.faces_of(bundle);
    bundle.box = cell.box_of(view(faces[0]));
    for (const ListPiece& face : faces.subspan(1)) {
      bundle.box = joined(bundle.box, cell.box_of(view(face)));
    }
    bundle.located = true;
  }

  /// The outlines of what is in lit_, or the whole one; absorbs the blots that they hold.
  template <class Cell>
  void add_blots(std::uint32_t object, std::span<const ListPiece> faces, const Bundle& whole,
                 bool cut, const Cell& cell) {
    if (!cut || setting_->outlines == Outlines::kWhole) {
      add_blot(object, faces, whole.box);  // planes_ are of the whole outline
      return;
    }
    for (Bundle& bundle : lit_) {
      find_planes(object, bundle, cell);
      locate(bundle, cell);
      add_blot(object, store_.faces_of(bundle), bundle.box);
    }
  }
  /// With the outline in planes_.
  void add_blot(std::uint32_t object, std::span<const ListPiece> faces, const ChartBox& box) {
    WorkCounts& counts = setting_->lists.counts;
    for (const BlotId blot : absorbable_) {
      if (!blots_[blot].alive || !is_within(blot)) continue;
      blots_[blot].alive = false;
      ++counts[Counter::kAbsorbed];
    }
    Blot blot;
    blot.object = object;
    blot.caster = faces.size() == 1
                      ? faces[0].loop.part
                      : static_cast<std::uint32_t>(setting_->lists.scene.parts.size()) +
                            order_.object(object).solid;
    blot.box = box;
    ranges_.clear();
    for (const ListPiece& face : faces) ranges_.push_back(face.loop);
    blots_.add(blot, planes_, ranges_);
    ++counts[Counter::kBlots];
  }

  /// Puts out a face cut by blots one after another; calls rest(loop) for what is in none.
  template <class Cell, class Rest>
  void subtract(const ListPiece& face, std::span<const BlotId> blots, const Cell& cell,
                const Rest& rest) {
    store_.clear();
    store_.faces.assign(1, face);
    lit_.assign(1, {0, 1, 0, 0, true, face.box});
    for (const BlotId blot : blots) {
      if (!counts_against(blot, face)) continue;
      cut_by(blot, cell);
      if (lit_.empty() || cell.gives_up(lit_.size())) break;
    }
    for (const Bundle& bundle : lit_) rest(store_.faces_of(bundle)[0]);
  }

  /// Sub-objects that hide each other: their polygons, cut by the blots there are, clip each other,
  /// and it is what is lit of them that adds blots, not their outlines.
  template <class Cell, class Stopped>
  void add_cycle(std::span<const std::uint32_t> group, const Cell& cell, const Stopped& stopped) {
    const auto& lists = setting_->lists;
    list_.clear();
    owners_.clear();
    for (const std::uint32_t object : group) {
      find_near(object);
      for (const ListPiece& face : order_.faces_of(object)) {
        owners_[face.item] = object;
        subtract(face, near_, cell, [&](const ListPiece& rest) { list_.push_back(rest); });
      }
    }
    const std::size_t before = output_->size();
    const auto bounds = bounds_all(cell);
    lists_.run(lists, list_, bounds, stopped, *output_);
    first_made_ = std::min(first_made_, lists_.first_cut());
    absorbable_.clear();
    for (std::size_t i = before; i < output_->size(); ++i) {
      const ClippedPiece& piece = (*output_)[i];
      const ListPiece face{piece.loop, piece.item, {}, 0};
      if (piece.caster != ClippedPiece::kLit || !lists.casts(face)) continue;
      planes_.clear();
      for (std::uint32_t k = 0; k < face.loop.count; ++k) {
        const auto at = face.loop.first + k;
        const PlaneRef edge = lists.loops.edge(at);
        if (edge.index() >= lists_.first_cut()) {  // where two polygons cross
          planes_.push_back(lists.space.shadow_plane(
              edge, lists.loops.vertex(at),
              lists.loops.vertex(k + 1 == face.loop.count ? face.loop.first : at + 1)));
        } else if (!bounds(edge)) {
          planes_.push_back(edge);
        }
      }
      add_blot(owners_[piece.item], std::span(&face, 1), cell.box_of(view(face)));
    }
  }

  const Setting* setting_ = nullptr;  // of this run
  std::vector<ClippedPiece>* output_ = nullptr;
  ObjectOrder<Space> order_;
  BlotList blots_;
  std::uint32_t first_made_ = kNoPlane;  // planes made in this run are numbered from here
  std::uint64_t cuts_before_ = 0;
  // Workspace, kept to save allocations.
  BundleClip<Space> clip_;
  BundleStore store_;
  ListClipping<Space> lists_;
  std::vector<Bundle> lit_, still_lit_;
  std::vector<ListPiece> faces_, list_;
  std::vector<PlaneRef> planes_;
  std::vector<LoopRange> ranges_;
  std::vector<BlotId> near_, absorbable_;
  std::unordered_map<std::uint32_t, std::uint32_t> owners_;  // of items in a cycle
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_BLOTS_BLOT_CLIPPING_H
