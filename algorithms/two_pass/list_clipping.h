// SPDX-License-Identifier: LGPL-3.0-or-later
// Polygons clipped by each other as seen from the light (Atherton, Weiler & Greenberg 1978, the
// shadow pass; class two of Crow 1977): of a list, one polygon that casts cuts all others at its
// outline. What is behind it inside the outline is in shadow; what is nearer there makes a list of
// its own with it; the rest is the next list.
//
// It ends: a polygon that is handed down as the next to clip is wholly in front of the one before,
// inside that one's outline, so that the two never meet again. No order by depth is needed for the
// answer: cycles and polygons that cross each other are cut like all others. All pieces are convex,
// so that the paper's clipping by outlines with holes is not needed.
//
// Guarantee on exact kernels: the pieces put out tile the polygons and have the class and a witness
// of the definition. On rounded kernels lists may contradict each other; a list that was handed
// down more often than it has polygons is put out as it is, and so is all that is left after far
// more work than an exact kernel has. Explicit stack.
#ifndef GNOMON_ALGORITHMS_TWO_PASS_LIST_CLIPPING_H
#define GNOMON_ALGORITHMS_TWO_PASS_LIST_CLIPPING_H

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/partition/chart_box.h"
#include "algorithms/partition/cone_clip.h"
#include "algorithms/partition/depth.h"
#include "algorithms/partition/import_export.h"
#include "gnomon/algorithms/work_counts.h"

namespace gnomon {

/// A polygon of a list, or a piece of one.
struct ListPiece {
  LoopRange loop;
  std::uint32_t item = 0;  // the caller's name of the polygon
  ChartBox box;            // of the polygon
  float nearest = 0;       // how near its nearest vertex is: a heuristic, larger is nearer
};

/// What became of a piece.
struct ClippedPiece {
  static constexpr std::uint32_t kLit = Fragment::kNoCaster;
  LoopRange loop;
  std::uint32_t item = 0;
  std::uint32_t caster = kLit;  // that shadows it
};

template <SectorSpaceModel Space>
class ListClipping {
 public:
  using Vertex = typename Space::Vertex;

  /// What a list is clipped in.
  struct Setting {
    Space& space;
    const PreparedScene& scene;
    const FacingParts& facing;
    LoopStore<Vertex>& loops;  // of the pieces; new ones are appended
    const Rules& rules;
    WorkCounts& counts;
    bool all_cast = false;  // parts that cast no shadow, too

    bool casts(const ListPiece& piece) const {
      return all_cast || scene.parts[piece.loop.part].casts;
    }
  };

  /// Appends what becomes of `list` to `output`. `bounds_all(edge)`: whether all pieces are inside
  /// that plane; `stopped()`: whether to give up.
  template <class BoundsAll, class Stopped>
  void run(const Setting& setting, std::span<const ListPiece> list, const BoundsAll& bounds_all,
           const Stopped& stopped, std::vector<ClippedPiece>& output) {
    pool_.assign(list.begin(), list.end());
    stack_.clear();
    first_cut_ = kNone;
    if (!pool_.empty()) stack_.push_back({});
    // On an exact kernel every piece is cut by those alone that it meets. A rounded one may go on
    // making slivers that contradict each other: after so much work it puts out what is left.
    const std::uint64_t size = list.size();
    std::uint64_t work_left = Space::kExact ? std::numeric_limits<std::uint64_t>::max()
                                            : kLeastWork + kWorkAPair * size * size;
    while (!stack_.empty() && !stopped()) {
      const List here = stack_.back();
      stack_.pop_back();
      WorkCounts& counts = setting.counts;
      ++counts[Counter::kLists];
      counts.at_least(Counter::kLongestList, pool_.size() - here.begin);
      const std::uint32_t clip =
          here.clip == kNone ? nearest_caster(setting, here.begin) : here.clip;
      if (clip == kNone) {
        put_out_lit(std::span(pool_).subspan(here.begin), output);
        pool_.resize(here.begin);
        continue;
      }
      if constexpr (!Space::kExact) {
        const std::uint64_t work = work_of(here.begin, clip);
        if (work > work_left) {
          put_out_lit(pool_, output);
          return;
        }
        work_left -= work;
      }
      sort_by(setting, here.begin, clip, bounds_all, output);
      const ListPiece by = pool_[clip];
      pool_.resize(here.begin);
      if (!outside_.empty()) {
        stack_.push_back({here.begin, kNone, 0, 0});
        pool_.insert(pool_.end(), outside_.begin(), outside_.end());
      }
      hand_down(setting, here, by, output);
      counts.at_least(Counter::kDeepestStack, stack_.size());
    }
  }
  std::uint64_t take_vanished() { return clip_.take_vanished() + std::exchange(vanished_, 0); }
  /// Edges of the last run's pieces whose planes have this number or a larger one may be cuts of
  /// support planes, which end a piece and are no planes through the light.
  std::uint32_t first_cut() const { return first_cut_; }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  /// In corners that are asked about an edge: at the least, and for each pair of polygons.
  static constexpr std::uint64_t kLeastWork = 1 << 15, kWorkAPair = 256;
  struct List {
    std::uint32_t begin = 0;     // in pool_; the list on top of the stack ends where the pool ends
    std::uint32_t clip = kNone;  // in pool_: the piece that clips, if it was handed down
    std::uint32_t handed = 0;    // how often a list was handed down to this one
    std::uint32_t most = 0;      // how often at most, if the kernel does not contradict itself
  };

  std::uint64_t work_of(std::uint32_t begin, std::uint32_t clip) const {
    std::uint64_t corners = 0;
    for (auto i = begin; i < pool_.size(); ++i) corners += pool_[i].loop.count;
    return corners * pool_[clip].loop.count;
  }
  std::uint32_t nearest_caster(const Setting& setting, std::uint32_t begin) const {
    std::uint32_t best = kNone;
    for (auto i = begin; i < pool_.size(); ++i) {
      if (!setting.casts(pool_[i])) continue;
      if (best == kNone || pool_[i].nearest > pool_[best].nearest) best = i;
    }
    return best;
  }
  static void put_out_lit(std::span<const ListPiece> pieces, std::vector<ClippedPiece>& output) {
    for (const ListPiece& piece : pieces) {
      output.push_back({piece.loop, piece.item, ClippedPiece::kLit});
    }
  }

  /// Sorts the pieces of a list into outside_ and, inside the outline of piece `clip`, near_ and
  /// coplanar_; what is behind it is put out.
  template <class BoundsAll>
  void sort_by(const Setting& setting, std::uint32_t begin, std::uint32_t clip,
               const BoundsAll& bounds_all, std::vector<ClippedPiece>& output) {
    outside_.clear();
    near_.clear();
    coplanar_.clear();
    const ListPiece& by = pool_[clip];
    planes_.clear();
    for (std::uint32_t i = 0; i < by.loop.count; ++i) {
      const PlaneRef edge = setting.loops.edge(by.loop.first + i);
      if (edge.index() >= first_cut_) {
        // Where a support plane cut a piece, only that piece ends. Others are cut in the plane
        // through the light.
        planes_.push_back(setting.space.shadow_plane(
            edge, setting.loops.vertex(by.loop.first + i),
            setting.loops.vertex(by.loop.first + (i + 1 == by.loop.count ? 0 : i + 1))));
      } else if (!bounds_all(edge)) {
        planes_.push_back(edge);
      }
    }
    const std::uint64_t cuts = clip_.cuts();
    for (auto i = begin; i < pool_.size(); ++i) {
      if (i == clip) continue;
      ListPiece piece = pool_[i];
      if (!piece.box.overlaps(by.box) ||
          clip_.clip(setting.space, planes_, piece.loop, plane_of(setting, piece), setting.loops) ==
              ConePlace::kOutside) {
        outside_.push_back(piece);
        continue;
      }
      const LoopRange inside = clip_.inside();
      if (inside.first != piece.loop.first) {
        for (const LoopRange& rest : clip_.outside()) {
          outside_.push_back(piece);
          outside_.back().loop = rest;
        }
      }
      if (inside.count < 3) continue;
      piece.loop = inside;
      sort_by_depth(setting, piece, by, output);
    }
    setting.counts[Counter::kClips] += clip_.cuts() - cuts;
  }

  /// A piece inside the outline of `by`: what of it is nearer, behind, or of the same plane.
  void sort_by_depth(const Setting& setting, ListPiece piece, const ListPiece& by,
                     std::vector<ClippedPiece>& output) {
    const PlaneId own = plane_of(setting, piece), other = plane_of(setting, by);
    const auto put_behind = [&](const LoopRange& loop) {
      output.push_back({loop, piece.item, by.loop.part});
    };
    if (own == other) {
      if (setting.rules.on_goes_to_its_own_side) {
        coplanar_.push_back(piece);
      } else {
        put_behind(piece.loop);
      }
      return;
    }
    const DepthSides sides =
        depth_sides(setting.space, setting.facing, other, setting.loops.view(piece.loop, own));
    if (!sides.nearer && !sides.behind) {
      coplanar_.push_back(piece);
    } else if (!sides.nearer) {
      put_behind(piece.loop);
    } else if (!sides.behind) {
      near_.push_back(piece);
    } else {
      const PlaneRef front = depth_cut(setting.space, setting.facing, own, other);
      first_cut_ = std::min(first_cut_, front.index());
      const Placement placement =
          record_.decide(setting.space, front, setting.loops.view(piece.loop, own));
      if (placement != Placement::kSpanning) {  // a rounded kernel that contradicts itself
        if (placement == Placement::kBack) {
          put_behind(piece.loop);
        } else {
          near_.push_back(piece);
        }
        return;
      }
      ++setting.counts[Counter::kClips];
      setting.loops.reserve_more(2 * std::size_t{piece.loop.count} + 4);
      const SplitChildren children =
          make_children(setting.space, front, setting.loops.view(piece.loop, own), record_,
                        crossings_, setting.loops);
      vanished_ += (children.front.count < 3 ? 1u : 0u) + (children.back.count < 3 ? 1u : 0u);
      if (children.back.count >= 3) put_behind(children.back);
      if (children.front.count < 3) return;
      piece.loop = children.front;
      near_.push_back(piece);
    }
  }

  /// Inside the outline of `by` nothing behind it is left: what is nearer clips it, if anything
  /// there casts.
  void hand_down(const Setting& setting, const List& here, const ListPiece& by,
                 std::vector<ClippedPiece>& output) {
    std::uint32_t clip = kNone;
    for (std::uint32_t i = 0; i < near_.size(); ++i) {
      if (!setting.casts(near_[i])) continue;
      if (clip == kNone || near_[i].nearest > near_[clip].nearest) clip = i;
    }
    const auto size = static_cast<std::uint32_t>(near_.size() + coplanar_.size() + 1);
    const std::uint32_t most = here.handed == 0 ? size : here.most;
    const bool contradicts = here.handed > most;
    near_.insert(near_.end(), coplanar_.begin(), coplanar_.end());
    near_.push_back(by);
    if (clip == kNone || contradicts) {
      put_out_lit(near_, output);
      return;
    }
    const auto begin = static_cast<std::uint32_t>(pool_.size());
    stack_.push_back({begin, begin + clip, here.handed + 1, most});
    pool_.insert(pool_.end(), near_.begin(), near_.end());
  }

  static PlaneId plane_of(const Setting& setting, const ListPiece& piece) {
    return setting.scene.parts[piece.loop.part].plane;
  }

  std::vector<ListPiece> pool_;  // of the lists on the stack, one after another
  std::vector<List> stack_;
  std::uint32_t first_cut_ =
      kNone;  // the planes that cut supports of this run are numbered from here
  std::uint64_t vanished_ = 0;
  // Workspace, kept to save allocations.
  std::vector<ListPiece> outside_, near_, coplanar_;
  std::vector<PlaneRef> planes_;
  ConeClip<Space> clip_;
  SplitRecord record_;
  std::vector<Vertex> crossings_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_TWO_PASS_LIST_CLIPPING_H
