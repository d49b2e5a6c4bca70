// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/visibility/area_solids.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace gnomon::oracle {

using space::cross;
using space::dot;
using space::HalfSpace;
using space::Loop;
using space::minus;
using space::negated;

namespace {

RationalPoint normal_of(const Loop& loop) {
  return cross(minus(loop[1], loop[0]), minus(loop[2], loop[0]));
}

bool any_at(const HalfSpace& half, const Loop& loop, int sign) {
  return std::any_of(loop.begin(), loop.end(),
                     [&](const RationalPoint& point) { return sgn(half.value(point)) == sign; });
}

Loop in_scene(const Geometry& geometry, const std::vector<std::array<mpz_class, 3>>& grid) {
  Loop loop;
  for (const auto& vertex : grid) {
    RationalPoint point;
    for (int k = 0; k < 3; ++k) point[k] = geometry.origin[k] + geometry.step * vertex[k];
    loop.push_back(std::move(point));
  }
  return loop;
}

HalfSpace light_side(const Loop& light, bool front) {
  const RationalPoint normal = normal_of(light);
  return {front ? normal : negated(normal), light[0]};
}

/// The half-space of the plane through an edge and a point that has all of `caster` in it and none
/// of `light` inside; nothing if the three are collinear or there is none.
std::optional<HalfSpace> separating(const RationalPoint& a, const RationalPoint& b,
                                    const RationalPoint& c, const Loop& caster, const Loop& light) {
  HalfSpace half(cross(minus(b, a), minus(c, a)), a);
  const bool inside = any_at(half, caster, 1), outside = any_at(half, caster, -1);
  if (inside == outside) return std::nullopt;
  if (outside) half = HalfSpace(negated(half.normal), a);
  if (any_at(half, light, 1)) return std::nullopt;
  return half;
}

}  // namespace

AreaSolids::AreaSolids(const PreparedScene& scene, const PreparedLight& light,
                       const std::vector<const Loop*>& loops)
    : scene_(scene),
      loops_(loops),
      light_(in_scene(scene.geometry, light.area_loop)),
      before_light_(light_side(light_, true)),
      behind_light_(light_side(light_, false)) {
  for (const Loop* loop : loops_) normals_.push_back(normal_of(*loop));
  for (std::uint32_t part = 0; part < loops_.size(); ++part) {
    if (!scene.parts[part].casts) continue;
    for (const Side side : {Side::kFront, Side::kBack}) {
      if (side == Side::kBack && !scene.parts[part].two_sided) continue;
      const HalfSpace front = front_of(part, side);
      if (!any_at(front, light_, 1)) continue;
      Blocker blocker{part, front.normal, {}, {}};
      blocker.penumbra = penumbra_of(blocker, light_);
      blocker.umbra = umbra_of(blocker, light_);
      blockers_.push_back(std::move(blocker));
    }
  }
}

HalfSpace AreaSolids::front_of(std::uint32_t part, Side side) const {
  return {side == Side::kFront ? normals_[part] : negated(normals_[part]), loops_[part]->front()};
}

bool AreaSolids::sees(std::uint32_t part, Side side) const {
  const Part& own = scene_.parts[part];
  if (side == Side::kBack && !own.two_sided) return false;
  if (!any_at(front_of(part, side), light_, 1)) return false;
  // A fragment may lie on any of the coplanar parts of its polygon.
  for (std::uint32_t other = scene_.first_part[own.polygon];
       other < scene_.first_part[own.polygon + 1]; ++other) {
    if (scene_.parts[other].plane == own.plane && any_at(before_light_, *loops_[other], 1)) {
      return true;
    }
  }
  return false;
}

bool AreaSolids::light_in_plane(std::uint32_t part) const {
  const HalfSpace front = front_of(part, Side::kFront);
  return !any_at(front, light_, 1) && !any_at(front, light_, -1);
}

bool AreaSolids::faces_away(std::uint32_t part, Side side) const {
  return !any_at(front_of(part, side), light_, 1) && !light_in_plane(part);
}

AreaSolids::Volume AreaSolids::penumbra_of(const Blocker& blocker, const Loop& light) const {
  const Loop& caster = *loops_[blocker.part];
  Volume volume;
  const Loop blocked = cut(light, HalfSpace(blocker.normal, caster[0]));
  if (blocked.empty()) return volume;
  volume.empty = false;
  volume.bounds.emplace_back(negated(blocker.normal), caster[0]);
  const auto add = [&](const Loop& edges, const Loop& corners) {
    for (std::size_t i = 0; i < edges.size(); ++i) {
      for (const RationalPoint& corner : corners) {
        std::optional<HalfSpace> half =
            separating(edges[i], edges[(i + 1) % edges.size()], corner, caster, blocked);
        if (half) volume.bounds.push_back(std::move(*half));
      }
    }
  };
  add(caster, blocked);
  add(blocked, caster);
  return volume;
}

AreaSolids::Volume AreaSolids::umbra_of(const Blocker& blocker, const Loop& light) const {
  const Loop& caster = *loops_[blocker.part];
  Volume volume;
  const HalfSpace front(blocker.normal, caster[0]);
  std::vector<int> heights;
  for (const RationalPoint& corner : light) {
    heights.push_back(sgn(front.value(corner)));
    if (heights.back() < 0) return volume;
  }
  volume.bounds.emplace_back(negated(blocker.normal), caster[0]);
  for (std::size_t v = 0; v < light.size(); ++v) {
    const RationalPoint& corner = light[v];
    const int height = heights[v];
    for (std::size_t i = 0; i < caster.size(); ++i) {
      const RationalPoint &a = caster[i], &b = caster[(i + 1) % caster.size()];
      HalfSpace half(cross(minus(b, a), height == 0 ? blocker.normal : minus(corner, a)), a);
      if (any_at(half, caster, -1)) half = HalfSpace(negated(half.normal), a);
      if (height > 0) {
        volume.bounds.push_back(std::move(half));
      } else if (half.value(corner) < 0) {
        return volume;  // in the caster's plane and beside it
      }
    }
  }
  volume.empty = false;
  return volume;
}

const Loop* AreaSolids::cut_light(std::uint32_t receiver, Side side) {
  const auto [place, inserted] = cut_lights_.try_emplace({receiver, side});
  if (inserted) {
    const HalfSpace front = front_of(receiver, side);
    if (any_at(front, light_, -1)) place->second = cut(light_, front);
  }
  return place->second.empty() ? nullptr : &place->second;
}

const AreaSolids::Volume& AreaSolids::penumbra(std::size_t index, std::uint32_t receiver,
                                               Side side) {
  const Loop* light = cut_light(receiver, side);
  if (!light) return blockers_[index].penumbra;
  const auto [place, inserted] = cut_penumbras_.try_emplace({index, receiver, side});
  if (inserted) place->second = penumbra_of(blockers_[index], *light);
  return place->second;
}

const AreaSolids::Volume& AreaSolids::umbra(std::size_t index, std::uint32_t receiver, Side side) {
  const Loop* light = cut_light(receiver, side);
  if (!light) return blockers_[index].umbra;
  const auto [place, inserted] = cut_umbras_.try_emplace({index, receiver, side});
  if (inserted) place->second = umbra_of(blockers_[index], *light);
  return place->second;
}

}  // namespace gnomon::oracle
