// SPDX-License-Identifier: GPL-3.0-or-later
// The oracle's first way: the exact shadow of every caster on every receiver, as convex polygons in
// the receiver's plane. No tree, no order, no splitting of one polygon by another.
//
// Derivation. Let the caster O be oriented so that the light is strictly in front of its plane P_O.
// The open segment from a point p to the light meets P_O iff p is strictly behind it (P_O is
// positive at the light, so it changes sign once), and the meeting point lies in O iff the line
// from the light through p does: iff p is on the inner side of the plane through the light and each
// edge of O. These planes bound one convex cone (a prism for a directional light) on O's side of
// the light, and a p in it and behind P_O has its meeting point before the light. So the shadow of
// O on R is
//     R  n  { P_O < 0 }  n  { edge planes of O > 0 },
// an intersection of half-spaces: nothing is projected, nothing is at infinity, and O is not cut.
// If O crosses R's plane, the part of O behind that plane takes itself out through P_O < 0. If O is
// coplanar with R, P_O is 0 on all of R and the intersection is empty, as the definition asks.
//
// Exactness: on the grid's integers; vertices are meets of two lines of input planes. Doubles only
// cull pairs that an error bound proves disjoint, found by a raster of what overlaps from the
// light.
#ifndef GNOMON_ORACLE_POINT_REGIONS_H
#define GNOMON_ORACLE_POINT_REGIONS_H

#include <cstdint>
#include <memory>
#include <vector>

#include "gnomon/kernel/geometry.h"
#include "gnomon/kernel/sign.h"
#include "gnomon/scene/prepare.h"

namespace gnomon::oracle {

struct ChartPoint;
struct ExactPlane;

/// One caster's shadow on one receiver: a convex polygon, counter-clockwise in the receiver's
/// chart; or what one plane of the light's region leaves outside, which no light reaches either.
struct ShadowPiece {
  static constexpr std::uint32_t kOutsideRegion = 0xffffffffu;
  std::uint32_t caster = 0;  // part, or kOutsideRegion
  std::vector<ChartPoint> loop;
};

class PointRegions {
 public:
  /// Requires: a point or directional light. Keeps references to its arguments.
  PointRegions(const PreparedScene& scene, const PreparedLight& light);
  ~PointRegions();
  PointRegions(PointRegions&&) noexcept;

  /// The part's side that faces the light, if it receives with that side: kFront or kBack; kOn if
  /// the light is in its plane or it only shows its back.
  Side lit_side(std::uint32_t part) const;
  bool light_in_plane(std::uint32_t part) const;
  /// True if the part casts: it has a side that faces the light and is a caster.
  bool casts(std::uint32_t part) const;
  /// Parts that may shadow some of a part, in order: all that do, and few that do not. Thread-safe.
  std::vector<std::uint32_t> casters_near(std::uint32_t receiver) const;
  /// What is strictly in front of all of them is in the shadow of a caster; its own plane first.
  /// Requires: casts(caster).
  std::vector<ExactPlane> shadow_planes(std::uint32_t caster) const;
  /// What is strictly in front of one of them is outside of the light's region.
  std::vector<ExactPlane> outsides() const;
  /// All shadows on a part, in order of casters, then what is outside of the region. Requires:
  /// lit_side(part) != kOn. Thread-safe.
  std::vector<ShadowPiece> shadows_on(std::uint32_t receiver) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_POINT_REGIONS_H
