// SPDX-License-Identifier: LGPL-3.0-or-later
// Sub-objects front to back: pairs of them, one of which may hide some of the other, found in a
// hierarchy of their boxes (Crow 1977, second class, after Clark), and the order that they leave.
#ifndef GNOMON_ALGORITHMS_BLOTS_OBJECT_ORDER_H
#define GNOMON_ALGORITHMS_BLOTS_OBJECT_ORDER_H

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "algorithms/blots/hiding_order.h"
#include "algorithms/blots/sub_objects.h"
#include "algorithms/partition/box_tree.h"
#include "algorithms/partition/cone_clip.h"
#include "algorithms/partition/depth.h"
#include "algorithms/two_pass/list_clipping.h"

namespace gnomon {

/// Which of two sub-objects may hide some of the other: in the overlap of a face of each, which is
/// nearer somewhere. One that does not cast has its place in the order, too: it must not be cut by
/// the outline of what is behind some of it. Pairs of two that do not cast are left out.
///
/// Exactness: the kernel's.
template <SectorSpaceModel Space>
class HidingPairs {
 public:
  using Setting = typename ListClipping<Space>::Setting;

  /// `bounds_all(edge)`: whether all faces are inside that plane; `stopped()`: whether to give up.
  template <class BoundsAll, class Stopped>
  std::vector<HidingPair> find(const Setting& setting, const SubObjects& objects,
                               const BoundsAll& bounds_all, const Stopped& stopped) {
    std::vector<HidingPair> pairs;
    const auto count = static_cast<std::uint32_t>(objects.all.size());
    std::vector<Box> boxes(count);
    std::vector<std::uint32_t> members(count);
    std::iota(members.begin(), members.end(), 0u);
    for (std::uint32_t i = 0; i < count; ++i) boxes[i] = finite_box(objects.all[i].box);
    const BoxTree tree(std::move(boxes), std::move(members));
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < count && !stopped(); ++i) {
      const SubObject& own = objects.all[i];
      const Box& box = tree.box(i);
      found.clear();
      tree.find([&](const BoxTree::Node& node, std::uint32_t) { return overlaps(node.box, box); },
                [&](std::uint32_t other) {
                  return other > i && objects.all[other].box.overlaps(own.box) &&
                         (own.casts || objects.all[other].casts);
                },
                found);
      std::ranges::sort(found);
      for (const std::uint32_t other : found) {
        const DepthSides sides = compare(setting, objects, own, objects.all[other], bounds_all);
        if (sides.behind) pairs.push_back({i, other});
        if (sides.nearer) pairs.push_back({other, i});
      }
    }
    setting.counts[Counter::kHidingPairs] += pairs.size();
    return pairs;
  }

 private:
  static Box finite_box(const ChartBox& box) {
    const auto finite = [](float x) {
      constexpr double kMost = std::numeric_limits<float>::max();
      return std::clamp(static_cast<double>(x), -kMost, kMost);
    };
    return {{finite(box.low[0]), finite(box.low[1]), 0},
            {finite(box.high[0]), finite(box.high[1]), 0}};
  }
  static bool overlaps(const Box& a, const Box& b) {
    return a.low[0] <= b.high[0] && b.low[0] <= a.high[0] && a.low[1] <= b.high[1] &&
           b.low[1] <= a.high[1];
  }

  /// Whether some of `second` is nearer than `first`, and some behind it.
  template <class BoundsAll>
  DepthSides compare(const Setting& setting, const SubObjects& objects, const SubObject& first,
                     const SubObject& second, const BoundsAll& bounds_all) {
    DepthSides sides;
    const auto plane_of = [&](const ListPiece& face) {
      return setting.scene.parts[face.loop.part].plane;
    };
    for (const ListPiece& a : objects.faces_of(first)) {
      planes_.clear();
      for (std::uint32_t k = 0; k < a.loop.count; ++k) {
        const PlaneRef edge = setting.loops.edge(a.loop.first + k);
        if (!bounds_all(edge)) planes_.push_back(edge);
      }
      for (const ListPiece& b : objects.faces_of(second)) {
        if (!a.box.overlaps(b.box)) continue;
        const bool coplanar = plane_of(a) == plane_of(b);
        if (coplanar && setting.rules.on_goes_to_its_own_side) continue;
        const std::uint32_t mark = setting.loops.size();
        const ConePlace place =
            clip_.clip(setting.space, planes_, b.loop, plane_of(b), setting.loops);
        if (place != ConePlace::kOutside && clip_.inside().count >= 3) {
          if (coplanar) {
            sides.behind = true;
          } else {
            const DepthSides own = depth_sides(setting.space, setting.facing, plane_of(a),
                                               setting.loops.view(clip_.inside(), plane_of(b)));
            sides.nearer |= own.nearer;
            sides.behind |= own.behind;
          }
        }
        setting.loops.truncate(mark);
        if (sides.nearer && sides.behind) return sides;
      }
    }
    return sides;
  }

  ConeClip<Space> clip_;
  std::vector<PlaneRef> planes_;
};

/// The sub-objects of a cell in groups, front to back; those of one group hide each other.
template <SectorSpaceModel Space>
class ObjectOrder {
 public:
  using Setting = typename HidingPairs<Space>::Setting;

  template <class BoundsAll, class Stopped>
  void make(const Setting& setting, std::span<const ListPiece> polygons,
            const SolidsOfLight& solids, const BoundsAll& bounds_all, const Stopped& stopped) {
    scene_ = &setting.scene;
    objects_.gather(polygons, solids, [&](const ListPiece& face) { return setting.casts(face); });
    const auto count = static_cast<std::uint32_t>(objects_.all.size());
    setting.counts[Counter::kSubObjects] += count;
    setting.counts[Counter::kSolids] +=
        static_cast<std::uint64_t>(std::ranges::count_if(objects_.all, [](const SubObject& object) {
          return object.solid != SolidsOfLight::kNone;
        }));
    const std::vector<HidingPair> pairs = pairs_.find(setting, objects_, bounds_all, stopped);
    order_ = hiding_order(count, pairs);
    find_hiders(count, pairs);
    still_to_come_.clear();
    for (const ListPiece& face : objects_.faces) ++still_to_come_[plane_of(face)];
  }

  std::size_t size() const { return objects_.all.size(); }
  const SubObject& object(std::uint32_t index) const { return objects_.all[index]; }
  std::span<const ListPiece> faces_of(std::uint32_t index) const {
    return objects_.faces_of(objects_.all[index]);
  }
  std::size_t groups() const { return order_.groups(); }
  /// The members of a group. Requires: groups are taken one after another.
  std::span<const std::uint32_t> take_group(std::size_t i) {
    for (const std::uint32_t index : order_.group(i)) {
      for (const ListPiece& face : faces_of(index)) --still_to_come_[plane_of(face)];
    }
    return order_.group(i);
  }
  /// Whether a face in this plane is in a group that has not been taken.
  bool is_to_come(PlaneId plane) const {
    const auto found = still_to_come_.find(plane);
    return found != still_to_come_.end() && found->second > 0;
  }
  /// Those that may hide some of an object.
  std::span<const std::uint32_t> hiders_of(std::uint32_t index) const {
    return {hiders_.data() + first_hider_[index], first_hider_[index + 1] - first_hider_[index]};
  }

 private:
  PlaneId plane_of(const ListPiece& face) const { return scene_->parts[face.loop.part].plane; }
  void find_hiders(std::uint32_t count, std::span<const HidingPair> pairs) {
    first_hider_.assign(count + 1, 0);
    for (const HidingPair& pair : pairs) ++first_hider_[pair.farther + 1];
    for (std::uint32_t i = 1; i <= count; ++i) first_hider_[i] += first_hider_[i - 1];
    std::vector<std::uint32_t> next(first_hider_.begin(), first_hider_.end() - 1);
    hiders_.resize(pairs.size());
    for (const HidingPair& pair : pairs) hiders_[next[pair.farther]++] = pair.nearer;
  }

  const PreparedScene* scene_ = nullptr;
  SubObjects objects_;
  HidingPairs<Space> pairs_;
  HidingOrder order_;
  std::vector<std::uint32_t> first_hider_, hiders_;           // by object
  std::unordered_map<PlaneId, std::uint32_t> still_to_come_;  // so many faces in a plane
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_BLOTS_OBJECT_ORDER_H
