// SPDX-License-Identifier: GPL-3.0-or-later
// What each caster hides of an area light, for the checker of claims: volumes made from whole
// casters. A point p in front of both planes has, on its segments to the light, only points in
// front of them, so that cutting a caster by the receiver's and the light's plane changes nothing
// for it; area_regions.h does cut, and shares nothing with this.
//
// Exactness: exact, in rational numbers of scene units.
#ifndef GNOMON_ORACLE_VISIBILITY_AREA_SOLIDS_H
#define GNOMON_ORACLE_VISIBILITY_AREA_SOLIDS_H

#include <array>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "gnomon/result/claims.h"
#include "gnomon/scene/prepare.h"
#include "oracle/geometry/space_loop.h"

namespace gnomon::oracle {

class AreaSolids {
 public:
  /// An intersection of half-spaces. Valid in front of the light's plane.
  struct Volume {
    bool empty = true;
    std::vector<space::HalfSpace> bounds;  // the first is behind the caster
  };

  /// `loops`: of the parts, in scene units. Keeps a reference to the scene.
  AreaSolids(const PreparedScene& scene, const PreparedLight& light,
             const std::vector<const space::Loop*>& loops);

  /// The side receives, has some of the light in front of it, and some of it in front of the light.
  bool sees(std::uint32_t part, Side side) const;
  /// All of the light is in the part's plane.
  bool light_in_plane(std::uint32_t part) const;
  /// None of the light is in front of that side, nor all of it in its plane.
  bool faces_away(std::uint32_t part, Side side) const;
  const space::HalfSpace& before_light() const { return before_light_; }
  const space::HalfSpace& behind_light() const { return behind_light_; }

  /// Sides of parts that block some of the light.
  std::size_t size() const { return blockers_.size(); }
  std::uint32_t part_of(std::size_t blocker) const { return blockers_[blocker].part; }
  /// Holds the penumbra on every receiver.
  const Volume& largest_penumbra(std::size_t blocker) const { return blockers_[blocker].penumbra; }
  const Volume& penumbra(std::size_t blocker, std::uint32_t receiver, Side side);
  const Volume& umbra(std::size_t blocker, std::uint32_t receiver, Side side);

 private:
  struct Blocker {
    std::uint32_t part = 0;
    RationalPoint normal;  // towards the light that is blocked
    Volume penumbra, umbra;
  };

  space::HalfSpace front_of(std::uint32_t part, Side side) const;
  Volume penumbra_of(const Blocker& blocker, const space::Loop& light) const;
  Volume umbra_of(const Blocker& blocker, const space::Loop& light) const;
  /// A_R; null if it is all of the light. Requires: sees(receiver, side).
  const space::Loop* cut_light(std::uint32_t receiver, Side side);

  const PreparedScene& scene_;
  std::vector<const space::Loop*> loops_;
  std::vector<RationalPoint> normals_;
  space::Loop light_;
  space::HalfSpace before_light_, behind_light_;
  std::vector<Blocker> blockers_;
  // Of receivers whose plane cuts the light, as they are asked for.
  std::map<std::pair<std::uint32_t, Side>, space::Loop> cut_lights_;
  std::map<std::tuple<std::size_t, std::uint32_t, Side>, Volume> cut_penumbras_, cut_umbras_;
};

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_VISIBILITY_AREA_SOLIDS_H
