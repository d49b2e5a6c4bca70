// SPDX-License-Identifier: LGPL-3.0-or-later
// The region that a point or directional light shines in (Warn's cones and flaps; Chin & Feiner
// 1989, sec. 8): which parts are inside of its planes, which outside, which need not be looked at
// at all; and receivers clipped to it, before anything is asked of shadows. Casters are never
// clipped: one outside of the region may shadow what is inside.
//
// A plane of a region counts as inside: a floor that lies in one is lit.
//
// Exactness: the kernel's. Sides are decided as those of support planes, cuts made as those of two
// supports, so that there is no predicate for regions.
#ifndef GNOMON_ALGORITHMS_PARTITION_LIGHT_REGION_H
#define GNOMON_ALGORITHMS_PARTITION_LIGHT_REGION_H

#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/partition/import_export.h"
#include "algorithms/partition/loop_store.h"
#include "algorithms/partition/split.h"
#include "gnomon/scene/prepare.h"
#include "kernel/concept/kernel_concept.h"

namespace gnomon {

/// Where a part is: it may also be partly inside.
enum class RegionPlace : std::uint8_t { kInside, kCut, kOutside };

/// Whether parts that can do nothing in the region stay among those that face the light.
enum class RegionCull : std::uint8_t { kKeep, kDrop };

inline Sign turned(Sign sign, PlaneRef plane) { return plane.flipped() ? -sign : sign; }
inline Side turned(Side side, PlaneRef plane) { return plane.flipped() ? opposite(side) : side; }

class LightRegion {
 public:
  LightRegion() = default;
  /// With RegionCull::kDrop a part leaves `facing.parts` (and still faces) if it is outside of a
  /// plane whose inside, or which itself, the light is in: its shadow is outside of it, too. A
  /// point of a shadow is L + k (v - L), k >= 1, where the plane's value is (1 - k) f(L) + k f(v)
  /// <= 0.
  template <LightSpaceModel Space>
  LightRegion(const PreparedScene& scene, std::uint32_t light, Space& space,
              const typename Space::SceneSpace& scene_space, FacingParts& facing, RegionCull cull)
      : planes_(scene.lights[light].region) {
    if (planes_.empty()) return;
    places_.assign(scene.parts.size(), RegionPlace::kInside);
    dropped_.assign(scene.parts.size(), 0);
    for (const std::uint32_t part : facing.parts) {
      for (const PlaneRef plane : planes_) {
        const RegionPlace own = place_of(scene, part, plane, space, scene_space);
        if (own > places_[part]) places_[part] = own;
        if (own == RegionPlace::kOutside && cull == RegionCull::kDrop &&
            turned(facing.plane_signs[plane.index()], plane) != Sign::kNegative) {
          dropped_[part] = 1;
        }
      }
    }
    std::erase_if(facing.parts, [&](std::uint32_t part) { return dropped_[part] != 0; });
    facing.edges = 0;
    for (const std::uint32_t part : facing.parts) facing.edges += scene.parts[part].count;
  }

  bool is_everywhere() const { return planes_.empty(); }
  std::span<const PlaneRef> planes() const { return planes_; }
  RegionPlace place(std::uint32_t part) const {
    return planes_.empty() ? RegionPlace::kInside : places_[part];
  }
  bool is_dropped(std::uint32_t part) const { return !planes_.empty() && dropped_[part] != 0; }

 private:
  template <LightSpaceModel Space>
  static RegionPlace place_of(const PreparedScene& scene, std::uint32_t index, PlaneRef plane,
                              Space& space, const typename Space::SceneSpace& scene_space) {
    const Part& part = scene.parts[index];
    if (part.plane == plane.index()) return RegionPlace::kInside;
    bool inside = false, outside = false;
    for (const VertexId vertex : scene.loop(part)) {
      const auto imported = space.import_vertex(scene_space.input_vertex(vertex));
      const Side side =
          turned(space.side_of_support(
                     plane.index(),
                     Corner<typename Space::Vertex>{PlaneRef(), imported, PlaneRef(), part.plane}),
                 plane);
      inside |= side == Side::kFront;
      outside |= side == Side::kBack;
    }
    if (!outside) return RegionPlace::kInside;
    return inside ? RegionPlace::kCut : RegionPlace::kOutside;
  }

  std::vector<PlaneRef> planes_;       // inside in front
  std::vector<RegionPlace> places_;    // by part
  std::vector<std::uint8_t> dropped_;  // by part
};

/// Clips loops of light space to a region.
template <LightSpaceModel Space>
class RegionClip {
 public:
  using Loop = LoopView<typename Space::Vertex>;

  /// Calls outside(loop) for each piece of a loop that is outside, then inside(loop) for the rest
  /// if there is one. The pieces are valid during the call. Planes that cut stay in the space.
  template <class Outside, class Inside>
  void clip(Space& space, const LightRegion& region, const Loop& loop, const Outside& outside,
            const Inside& inside) {
    if (region.place(loop.part) == RegionPlace::kInside) return inside(loop);
    if (region.place(loop.part) == RegionPlace::kOutside) return outside(loop);
    pieces_.clear();
    LoopRange rest = pieces_.append(loop);
    for (const PlaneRef plane : region.planes()) {
      const Loop view = pieces_.view(rest, loop.support);
      switch (placement(space, plane, view)) {
        case Placement::kFront:
        case Placement::kOn:
          continue;
        case Placement::kBack:
          return outside(view);
        case Placement::kSpanning:
          break;
      }
      const PlaneRef front = space.cut_of_supports(loop.support, plane.index());
      const PlaneRef cut = plane.flipped() ? -front : front;
      const Placement placed = record_.decide(space, cut, view);
      if (placed == Placement::kBack) return outside(view);
      if (placed != Placement::kSpanning) continue;  // rounded kernels
      pieces_.reserve_more(2 * std::size_t{view.size()} + 4);
      const SplitChildren children =
          make_children(space, cut, pieces_.view(rest, loop.support), record_, crossings_, pieces_);
      if (children.back.count >= 3) outside(pieces_.view(children.back, loop.support));
      if (children.front.count < 3) return;
      rest = children.front;
    }
    inside(pieces_.view(rest, loop.support));
  }

 private:
  static Placement placement(Space& space, PlaneRef plane, const Loop& loop) {
    bool front = false, back = false;
    for (std::uint32_t i = 0; i < loop.size(); ++i) {
      const Side side = turned(space.side_of_support(plane.index(), loop.corner(i)), plane);
      front |= side == Side::kFront;
      back |= side == Side::kBack;
    }
    if (front && back) return Placement::kSpanning;
    return front ? Placement::kFront : back ? Placement::kBack : Placement::kOn;
  }

  LoopStore<typename Space::Vertex> pieces_;
  SplitRecord record_;
  std::vector<typename Space::Vertex> crossings_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PARTITION_LIGHT_REGION_H
