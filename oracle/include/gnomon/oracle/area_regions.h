// SPDX-License-Identifier: GPL-3.0-or-later
// The oracle's first way for an area light A: on each side R of a part the exact penumbra and umbra
// of every caster, as convex polygons in the receiver's plane. No tree, no order, no splitting of
// one polygon by another.
//
// By the definitions (docs: semantics, "Classes for an area light"), word by word. A_R is the part
// of A in front of R's plane; the caster O is what of it is in front of R's plane and of A's; A_O
// is the part of A_R on the front of the caster's blocking side P_O. Then on R, in front of A's
// plane,
//   - the penumbra volume is P_O < 0 and f > 0 for every plane f through an edge of O and a vertex
//     of A_O, or an edge of A_O and a vertex of O, that has O on its positive and A_O on its other
//     side (both closed). All such planes are tried, one by one;
//   - the umbra volume is P_O <= 0 and g >= 0 for every plane g through an edge of O and a vertex
//     of A_R that is not in P_O, O on its positive side; it is empty if a vertex of A_R is behind
//     P_O, or in P_O and outside O.
// What of R is on or behind A's plane is umbra without a caster.
//
// Exactness: on the grid's integers; cut corners of casters and of the light are homogeneous
// integer points. Doubles only set aside pairs that an error bound proves disjoint, and planes that
// it proves to have all of R on their inner side.
#ifndef GNOMON_ORACLE_AREA_REGIONS_H
#define GNOMON_ORACLE_AREA_REGIONS_H

#include <cstdint>
#include <memory>
#include <vector>

#include "gnomon/kernel/sign.h"
#include "gnomon/oracle/point_regions.h"
#include "gnomon/scene/prepare.h"

namespace gnomon::oracle {

/// All that is not lit on one side of a part. Loops are counter-clockwise in the receiver's chart.
struct AreaShade {
  std::vector<ChartPoint> behind;     // on or behind the light's plane; empty if nothing is
  std::vector<ShadowPiece> penumbra;  // penumbra volumes, umbra volumes included; by caster
  std::vector<ShadowPiece> umbra;     // umbra volumes; by caster
};

class AreaRegions {
 public:
  /// Requires: an area light. Keeps a reference to the scene.
  AreaRegions(const PreparedScene& scene, const PreparedLight& light);
  ~AreaRegions();
  AreaRegions(AreaRegions&&) noexcept;

  /// The part receives with that side, some of the light is in front of it, and some of it in front
  /// of the light's plane.
  bool sees(std::uint32_t part, Side side) const;
  /// Requires: sees(part, side). Cost: all casters. Thread-safe.
  AreaShade shade_on(std::uint32_t part, Side side) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_AREA_REGIONS_H
