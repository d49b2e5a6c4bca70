// SPDX-License-Identifier: LGPL-3.0-or-later
// Fragments of one part and class that share a whole edge become one where the result is convex,
// whatever cut them apart (Chin & Feiner 1989, sec. 6; Slater 1992, figure 6; neighbour_merge.h).
//
// The witness of what came of two: a caster of either that shadows all of it, else a smallest set
// of theirs that does.
//
// Exactness: the kernel's decisions, of degree 6 as all sides of vertices. Where a rounded kernel
// finds no single caster, the two stay apart.
#ifndef GNOMON_ALGORITHMS_SVBSP_CONVEX_MERGE_H
#define GNOMON_ALGORITHMS_SVBSP_CONVEX_MERGE_H

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/lights/light_scene.h"
#include "algorithms/lights/neighbour_merge.h"
#include "algorithms/partition/classified_loop.h"
#include "algorithms/partition/cone_clip.h"
#include "algorithms/partition/depth.h"

namespace gnomon {

template <SectorSpaceModel Space>
class ConvexMerge {
 public:
  using Vertex = typename Space::Vertex;
  using Loop = LoopView<Vertex>;

  explicit ConvexMerge(LightScene<Space>& light) : light_(light), merge_(light.space) {}

  /// Merges what can be; returns how many fragments went into others.
  std::uint64_t run(ClassifiedLoops<Vertex>& output) {
    output_ = &output;
    std::vector<std::vector<std::uint32_t>> by_part(light_.scene.parts.size());
    for (std::uint32_t i = 0; i < output.fragments.size(); ++i) {
      by_part[output.fragments[i].loop.part].push_back(i);
    }
    std::vector<std::uint8_t> gone(output.fragments.size(), 0);
    std::uint64_t merged = 0;
    for (const std::vector<std::uint32_t>& fragments : by_part) {
      if (fragments.size() > 1) merged += merge_.run(*this, fragments, gone);
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < gone.size(); ++i) {
      if (gone[i] == 0) output.fragments[kept++] = output.fragments[i];
    }
    output.fragments.resize(kept);
    keep_used_sets(output);
    return merged;
  }
  /// What ClassifiedLoop::casters of the merged fragments are indices into.
  std::vector<std::vector<std::uint32_t>> take_caster_sets() { return std::move(sets_); }

  // What NeighbourMerge asks.
  Loop loop(std::uint32_t fragment) const {
    const LoopRange& range = output_->fragments[fragment].loop;
    return output_->loops.view(range, light_.plane_of(range.part));
  }
  EdgeName name(std::uint32_t fragment, std::uint32_t edge) const {
    const PlaneRef plane = loop(fragment).edges[edge];
    return plane.valid() ? EdgeName{plane.index(), plane.flipped()} : EdgeName{};
  }
  bool are_alike(std::uint32_t first, std::uint32_t second) const {
    const ClassifiedLoop &a = output_->fragments[first], &b = output_->fragments[second];
    return a.state == b.state && a.reason == b.reason;
  }
  bool take(std::uint32_t first, std::uint32_t second, const ConvexJoin<Space>& join) {
    const std::optional<Witness> witness =
        witness_of(output_->fragments[first], output_->fragments[second], join.joined());
    if (!witness) return false;
    ClassifiedLoop& result = output_->fragments[first];
    result.loop = output_->loops.append(join.joined());
    result.caster = witness->caster;
    result.casters = witness->casters;
    return true;
  }

 private:
  struct Witness {
    std::uint32_t caster = Fragment::kNoCaster, casters = Fragment::kNoCaster;
  };

  /// Leaves out the sets of fragments that went into others.
  void keep_used_sets(ClassifiedLoops<Vertex>& output) {
    std::vector<std::vector<std::uint32_t>> used;
    for (ClassifiedLoop& fragment : output.fragments) {
      if (fragment.casters == Fragment::kNoCaster) continue;
      used.push_back(std::move(sets_[fragment.casters]));
      fragment.casters = static_cast<std::uint32_t>(used.size() - 1);
    }
    sets_ = std::move(used);
  }

  std::vector<std::uint32_t> casters_of(const ClassifiedLoop& fragment) const {
    if (fragment.casters != Fragment::kNoCaster) return sets_[fragment.casters];
    return {fragment.caster};
  }

  /// Of both as one loop; none if a rounded kernel finds none.
  std::optional<Witness> witness_of(const ClassifiedLoop& a, const ClassifiedLoop& b,
                                    const Loop& joined) {
    if (a.state == LightState::kLit || a.reason != ShadowReason::kNone) return Witness{};
    if (a.caster == b.caster && a.casters == b.casters) return Witness{a.caster, a.casters};
    std::vector<std::uint32_t> all = casters_of(a);
    for (const std::uint32_t caster : casters_of(b)) {
      if (std::ranges::find(all, caster) == all.end()) all.push_back(caster);
    }
    for (const std::uint32_t caster : all) {
      if (hides(std::span(&caster, 1), joined)) return Witness{caster, Fragment::kNoCaster};
    }
    if (!Space::kExact) return std::nullopt;
    // Polygons are named, not parts: a polygon's parts go together.
    for (std::size_t i = 0; i < all.size();) {
      const std::uint32_t polygon = light_.part(all[i]).polygon;
      std::vector<std::uint32_t> others;
      std::ranges::copy_if(all, std::back_inserter(others), [&](std::uint32_t part) {
        return light_.part(part).polygon != polygon;
      });
      if (!others.empty() && hides(others, joined)) {
        all = std::move(others);
        i = 0;
      } else {
        ++i;
      }
    }
    sets_.push_back(std::move(all));
    return Witness{Fragment::kNoCaster, static_cast<std::uint32_t>(sets_.size() - 1)};
  }

  /// Whether these casters shadow all of a loop together.
  bool hides(std::span<const std::uint32_t> casters, const Loop& loop) {
    loops_.clear();
    const PlaneId own = loop.support;
    std::vector<LoopRange> open{loops_.append(loop)}, next;
    for (const std::uint32_t caster : casters) {
      next.clear();
      for (const LoopRange& piece : open) subtract(caster, piece, own, next);
      std::swap(open, next);
      if (open.empty()) return true;
    }
    return false;
  }
  /// Appends what of a piece the caster does not shadow.
  void subtract(std::uint32_t caster, const LoopRange& piece, PlaneId own,
                std::vector<LoopRange>& rest) {
    const PlaneId other = light_.plane_of(caster);
    const DepthSides sides =
        own == other ? DepthSides{}
                     : depth_sides(light_.space, light_.facing, other, loops_.view(piece, own));
    if (!sides.behind) return rest.push_back(piece);
    planes_.clear();
    caster_loop_.clear();
    const LoopRange whole =
        light_.with_edge_planes(light_.import_part(caster, caster_loop_), caster_loop_);
    for (std::uint32_t i = 0; i < whole.count; ++i) planes_.push_back(caster_loop_.edge(i));
    if (sides.nearer) planes_.push_back(-depth_cut(light_.space, light_.facing, own, other));
    switch (clip_.clip(light_.space, planes_, piece, own, loops_)) {
      case ConePlace::kInside:
        return;
      case ConePlace::kOutside:
        return rest.push_back(piece);
      case ConePlace::kCut:
        for (const LoopRange& outside : clip_.outside()) rest.push_back(outside);
    }
  }

  LightScene<Space>& light_;
  NeighbourMerge<Space> merge_;
  ClassifiedLoops<Vertex>* output_ = nullptr;
  std::vector<std::vector<std::uint32_t>> sets_;
  LoopStore<Vertex> loops_, caster_loop_;
  std::vector<PlaneRef> planes_;
  ConeClip<Space> clip_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SVBSP_CONVEX_MERGE_H
