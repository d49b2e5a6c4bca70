// SPDX-License-Identifier: LGPL-3.0-or-later
// The shadow volumes of one side of a caster under one light, as half-spaces: for an area light the
// penumbra volume and the umbra volume (Chin & Feiner 1992, "Constructing Penumbra and Umbra
// Volumes"; Nishita & Nakamae 1985), for a point or directional light the one shadow volume.
//
// Let O be the caster, its blocking side in front of P_O, and A_O the part of the light in front of
// both the receiver and P_O. The points (1 + t) o - t a, with o in O, a in A_O and t >= 0, are
// those that O hides some of A_O from. They are a convex set, since for each t they are a sum of
// two convex ones, and a convex combination of points of two t is a point of the combined t. Its
// half-spaces are therefore those that hold O and have A_O on their other side: the back of P_O,
// and each plane that touches both, through an edge of the one and a vertex of the other. A point
// in front of the receiver's and of the light's plane has its o there as well, so the caster need
// not be clipped to them, and all planes go through input vertices (and vertices of the light, made
// only where a polygon's plane cuts it).
//
// All planes through an edge of O and a point in front of P_O have the points in front of P_O in a
// half-turn around that edge, so that one of them is the extreme: it alone counts, in the penumbra
// the one that leaves all of A_O on the other side from O, in the umbra the one that leaves all of
// it on O's side.
//
// Exactness: that of the space's decisions. Degree: planes 2, or as the light's cut vertices have
// it.
#ifndef GNOMON_ALGORITHMS_SHADOW_VOLUMES_SHADOW_VOLUME_H
#define GNOMON_ALGORITHMS_SHADOW_VOLUMES_SHADOW_VOLUME_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/partition/loop_store.h"
#include "algorithms/partition/rules.h"
#include "algorithms/partition/split.h"
#include "algorithms/shadow_volumes/light_geometry.h"
#include "algorithms/shadow_volumes/touching_planes.h"
#include "kernel/concept/kernel_concept.h"
#include "kernel/concept/plane_takeover.h"

namespace gnomon {

/// Half-spaces are in front of their planes. All lists begin with the caster's own plane, turned so
/// that what is behind the blocking side is in front of it.
struct ShadowVolume {
  std::uint32_t caster = 0;          // part
  PlaneRef side;                     // its blocking side's; none: of a solid
  std::uint32_t first = 0;           // into VolumeStore::planes: penumbra, then umbra
  std::uint32_t penumbra_count = 0;  // 0: the light is a point, all of the shadow is "umbra"; or
                                     // the umbra alone was wanted
  std::uint32_t umbra_count = 0;     // 0: no umbra
};

class VolumeStore {
 public:
  std::span<const ShadowVolume> volumes() const { return volumes_; }
  const ShadowVolume& operator[](std::size_t i) const { return volumes_[i]; }
  std::span<const PlaneRef> penumbra(const ShadowVolume& volume) const {
    return {planes_.data() + volume.first, volume.penumbra_count};
  }
  std::span<const PlaneRef> umbra(const ShadowVolume& volume) const {
    return {planes_.data() + volume.first + volume.penumbra_count, volume.umbra_count};
  }
  void add(std::uint32_t caster, PlaneRef side, std::span<const PlaneRef> penumbra,
           std::span<const PlaneRef> umbra) {
    volumes_.push_back({caster, side, static_cast<std::uint32_t>(planes_.size()),
                        static_cast<std::uint32_t>(penumbra.size()),
                        static_cast<std::uint32_t>(umbra.size())});
    planes_.insert(planes_.end(), penumbra.begin(), penumbra.end());
    planes_.insert(planes_.end(), umbra.begin(), umbra.end());
  }
  void reserve_more(std::size_t volumes, std::size_t planes) {
    volumes_.reserve(volumes_.size() + volumes);
    planes_.reserve(planes_.size() + planes);
  }
  /// Adds the volumes of another store, whose planes have other numbers here.
  void append(const VolumeStore& other, const PlaneShift& shift) {
    const auto first = static_cast<std::uint32_t>(planes_.size());
    for (ShadowVolume volume : other.volumes_) {
      volume.first += first;  // its side is a support plane, whose number stays
      volumes_.push_back(volume);
    }
    for (const PlaneRef plane : other.planes_) planes_.push_back(shift(plane));
  }
  void clear() {
    volumes_.clear();
    planes_.clear();
  }
  std::size_t size() const { return volumes_.size(); }
  std::size_t plane_count() const { return planes_.size(); }

 private:
  std::vector<ShadowVolume> volumes_;
  std::vector<PlaneRef> planes_;
};

/// A light as the volumes see it: a loop of one vertex (point), of none (directional), or the part
/// of an area light that is in front of a receiver.
template <class Vertex>
struct LightShape {
  LoopView<Vertex> loop;
  const LightPoint* direction = nullptr;  // of a directional light
  PlaneRef plane;                         // of an area light, which emits to its front
  bool has_area() const { return plane.valid(); }
};

enum class VolumesWanted : std::uint8_t { kBoth, kUmbra };

template <VolumeSpaceModel Space>
class VolumeBuilder {
 public:
  using Vertex = typename Space::Vertex;
  using Loop = LoopView<Vertex>;

  explicit VolumeBuilder(Space& space, const Rules& rules = {}) : space_(&space), rules_(rules) {}

  /// Adds the volume of one side of a caster, in front of `side`, if it casts anything. `reversed`:
  /// the loop is clockwise seen from that side. `wanted`: of an area light, perhaps the umbra
  /// alone.
  void add(const Loop& caster, PlaneRef side, bool reversed, const LightShape<Vertex>& light,
           VolumeStore& store, VolumesWanted wanted = VolumesWanted::kBoth) {
    penumbra_.assign(1, -side);
    umbra_.assign(1, -side);
    if (light.has_area()) {
      if (!make_area(caster, side, reversed, light, wanted)) return;
      if (wanted == VolumesWanted::kUmbra) penumbra_.clear();
    } else {
      if (!make_point(caster, side, reversed, light)) return;
      penumbra_.clear();
    }
    store.add(caster.part, side, penumbra_, umbra_);
  }

  /// A face of a solid that the light is in front of, with its front.
  struct Face {
    Loop loop;
    PlaneRef side;
  };
  /// Adds the volume of a convex solid under a point or directional light: `faces`, all that the
  /// light is in front of. Their edges have names (PlaneRef::index() of scene space). `caster`: as
  /// ShadowVolume has it.
  void add_solid(std::span<const Face> faces, std::uint32_t caster, const LightShape<Vertex>& light,
                 VolumeStore& store) {
    umbra_.clear();
    for (const Face& face : faces) umbra_.push_back(-face.side);
    for (const Face& face : faces) {
      for (std::uint32_t i = 0; i < face.loop.size(); ++i) {
        const auto shares = [&](const Face& other) {
          return &other != &face && std::ranges::any_of(other.loop.edges, [&](PlaneRef edge) {
            return edge.same_plane(face.loop.edges[i]);
          });
        };
        if (std::ranges::any_of(faces, shares)) continue;  // no contour
        const CornerOf a = to(face.loop, false, i), b = from(face.loop, false, i);
        const PlaneRef plane = light.direction != nullptr
                                   ? space_->add_plane(a, b, *light.direction)
                                   : space_->add_plane(a, b, light.loop.corner(0));
        if (plane.valid()) umbra_.push_back(plane);
      }
    }
    store.add(caster, {}, {}, umbra_);
  }

  /// On which side of a support plane is the light: in front, all of it or some (area lights).
  bool is_in_front(PlaneRef plane, const LightShape<Vertex>& light) {
    if (!rules_.light_in_plane_does_not_reach && holds(plane, light)) return true;
    if (light.direction != nullptr) return direction_side(plane, *light.direction) == Side::kFront;
    for (std::uint32_t i = 0; i < light.loop.size(); ++i) {
      if (space_->side_of_plane(plane, light.loop.corner(i)) == Side::kFront) return true;
    }
    return false;
  }
  /// Whether a support plane holds all of the light.
  bool holds(PlaneRef plane, const LightShape<Vertex>& light) {
    if (light.direction != nullptr) return direction_side(plane, *light.direction) == Side::kOn;
    for (std::uint32_t i = 0; i < light.loop.size(); ++i) {
      if (space_->side_of_plane(plane, light.loop.corner(i)) != Side::kOn) return false;
    }
    return true;
  }

 private:
  using CornerOf = Corner<Vertex>;

  CornerOf from(const Loop& caster, bool reversed, std::uint32_t i) const {
    return caster.corner(reversed ? caster.next(i) : i);
  }
  CornerOf to(const Loop& caster, bool reversed, std::uint32_t i) const {
    return caster.corner(reversed ? i : caster.next(i));
  }

  /// With c the third vertex that defines the plane, a and b the others, the plane through a, b and
  /// the light has c on its front iff the light is behind: det(b - a, d, c - a) = -n . d.
  Side direction_side(PlaneRef plane, const LightPoint& direction) {
    const SupportTriple& triple = space_->geometry().planes[plane.index()];
    const Vertex a = space_->input_vertex(triple.a), b = space_->input_vertex(triple.b),
                 c = space_->input_vertex(triple.c);
    const std::uint32_t mark = space_->plane_mark();
    const PlaneRef through = space_->add_plane(lone_corner(a), lone_corner(b), direction);
    Side side = Side::kOn;
    if (through.valid()) {
      side = opposite(space_->side_of_plane(through, lone_corner(c)));
    } else {
      const PlaneRef other = space_->add_plane(lone_corner(b), lone_corner(c), direction);
      if (other.valid()) side = opposite(space_->side_of_plane(other, lone_corner(a)));
    }
    space_->release_planes(mark);
    return plane.flipped() ? opposite(side) : side;
  }

  bool make_point(const Loop& caster, PlaneRef side, bool reversed,
                  const LightShape<Vertex>& light) {
    if (!is_in_front(side, light)) return false;
    for (std::uint32_t i = 0; i < caster.size(); ++i) {
      const CornerOf a = to(caster, reversed, i), b = from(caster, reversed, i);
      const PlaneRef plane = light.direction != nullptr
                                 ? space_->add_plane(a, b, *light.direction)
                                 : space_->add_plane(a, b, light.loop.corner(0));
      if (plane.valid()) umbra_.push_back(plane);
    }
    return true;
  }

  bool make_area(const Loop& caster, PlaneRef side, bool reversed, const LightShape<Vertex>& light,
                 VolumesWanted wanted) {
    if (caster_sides_.decide(*space_, light.plane, caster) == Placement::kBack ||
        all_on_or_behind(caster)) {
      return false;
    }
    const Loop& whole = light.loop;
    const Placement placement = light_sides_.decide(*space_, side, whole);
    if (placement == Placement::kBack || placement == Placement::kOn) return false;
    whole_sides_.resize(whole.size());
    for (std::uint32_t i = 0; i < whole.size(); ++i) whole_sides_[i] = light_sides_.side(i);
    Loop front = whole;
    front_sides_ = whole_sides_;
    const bool straddles = placement == Placement::kSpanning;
    if (straddles && !rules_.straddling_light_is_cut) {
      whole_sides_.assign(whole.size(), Side::kFront);
      front_sides_ = whole_sides_;
    } else if (straddles) {
      cut_.clear();
      const SplitChildren children =
          make_children(*space_, side, whole, light_sides_, crossings_, cut_);
      if (children.front.count < 3) return false;
      front = cut_.view(children.front, whole.support);
      light_sides_.decide(*space_, side, front);
      front_sides_.resize(front.size());
      for (std::uint32_t i = 0; i < front.size(); ++i) front_sides_[i] = light_sides_.side(i);
    }
    if ((straddles && rules_.straddling_light_is_cut) || !make_umbra(caster, reversed, whole)) {
      umbra_.clear();
    }
    if (wanted == VolumesWanted::kBoth) make_penumbra(caster, reversed, front);
    return true;
  }

  /// Of a light that is in front of the caster's plane, with whole_sides_. False if there is none.
  bool make_umbra(const Loop& caster, bool reversed, const Loop& light) {
    const std::uint32_t mark = space_->plane_mark();
    for (std::uint32_t i = 0; i < caster.size(); ++i) {
      const CornerOf a = to(caster, reversed, i), b = from(caster, reversed, i);
      const PlaneRef inner = extreme_plane(*space_, a, b, light, Side::kBack, [&](std::uint32_t k) {
        return whole_sides_[k] == Side::kFront;
      });
      // A vertex of the light in the caster's plane must be in the caster itself.
      if (!inner.valid() || any_on_plane(*space_, light, whole_sides_, inner, Side::kBack)) {
        space_->release_planes(mark);
        return false;
      }
      umbra_.push_back(inner);
    }
    return true;
  }

  /// Of the part of the light in front of the caster's plane, with front_sides_.
  void make_penumbra(const Loop& caster, bool reversed, const Loop& light) {
    for (std::uint32_t i = 0; i < caster.size(); ++i) {
      const CornerOf a = to(caster, reversed, i), b = from(caster, reversed, i);
      const PlaneRef outer =
          extreme_plane(*space_, a, b, light, Side::kFront,
                        [&](std::uint32_t k) { return front_sides_[k] == Side::kFront; });
      if (outer.valid() && !any_on_plane(*space_, light, front_sides_, outer, Side::kFront)) {
        penumbra_.push_back(outer);
      }
    }
    bool in_front = true;
    for (std::uint32_t k = 0; k < caster.size(); ++k) {
      in_front = in_front && caster_sides_.side(k) == Side::kFront;
    }
    // Planes that hold an edge of the caster are there already, and its own is none.
    add_light_edges(*space_, caster, light, in_front, penumbra_);
  }

  bool all_on_or_behind(const Loop& caster) const {
    for (std::uint32_t i = 0; i < caster.size(); ++i) {
      if (caster_sides_.side(i) == Side::kFront) return false;
    }
    return true;
  }
  Space* space_;
  Rules rules_;
  std::vector<PlaneRef> penumbra_, umbra_;
  SplitRecord caster_sides_, light_sides_;
  std::vector<Side> whole_sides_, front_sides_;
  std::vector<Vertex> crossings_;
  LoopStore<Vertex> cut_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SHADOW_VOLUMES_SHADOW_VOLUME_H
