// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/visibility/point_sight.h"

#include <optional>
#include <utility>

#include "oracle/geometry/chart.h"
#include "oracle/geometry/group_overlay.h"
#include "oracle/visibility/neighbourhood.h"

namespace gnomon::oracle {

namespace {

Side facing_of(const PreparedScene& scene, const PreparedLight& light, std::uint32_t part) {
  const ExactPlane plane = support_of(scene, part);
  return side_of(sign_of(mpz_class(light.point.directional ? dot(plane.normal, light.point.grid)
                                                           : value_at(plane, light.point.grid))));
}

std::vector<std::uint32_t> casters_of(const PreparedScene& scene, const PreparedLight& light) {
  std::vector<std::uint32_t> casters;
  for (std::uint32_t i = 0; i < scene.parts.size(); ++i) {
    if (!scene.parts[i].casts && !light.is_eye) continue;
    const Side facing = facing_of(scene, light, i);
    if (facing == Side::kFront || (facing == Side::kBack && scene.parts[i].two_sided)) {
      casters.push_back(i);
    }
  }
  return casters;
}

}  // namespace

BoundedVector on_grid(const Geometry& geometry, const RationalPoint& point) {
  BoundedVector result;
  for (std::size_t k = 0; k < 3; ++k) {
    result[k] = bounded(mpq_class((point[k] - geometry.origin[k]) / geometry.step));
  }
  return result;
}

PointSight::PointSight(const PreparedScene& scene, const PreparedLight& light)
    : PointSight(
          scene, light,
          [&] {
            auto parts = std::make_shared<SeenParts>();
            for (std::uint32_t i = 0; i < scene.parts.size(); ++i) {
              SeenPart& part = parts->emplace_back();
              for (const Integers3& vertex : grid_loop(scene, i)) {
                part.loop.push_back(bounded(vertex));
              }
              part.normal = bounded(support_of(scene, i).normal);
            }
            return parts;
          }(),
          VisibilityTest(scene, light)) {}

PointSight::PointSight(const PointSight& other, const PreparedLight& light)
    : PointSight(other.scene_, light, other.parts_, VisibilityTest(other.exact_, light)) {}

PointSight::PointSight(const PreparedScene& scene, const PreparedLight& light,
                       std::shared_ptr<const SeenParts> parts, VisibilityTest exact)
    : scene_(scene),
      light_(light),
      parts_(std::move(parts)),
      place_(bounded(light.point.grid)),
      index_(scene, light, casters_of(scene, light)),
      exact_(std::move(exact)) {
  for (std::uint32_t i = 0; i < scene.parts.size(); ++i) {
    State& state = states_.emplace_back();
    state.facing = facing_of(scene, light, i);
    state.receives =
        state.facing == Side::kFront || (state.facing == Side::kBack && scene.parts[i].two_sided);
    state.casts = state.receives && (scene.parts[i].casts || light.is_eye);
  }
}

std::vector<std::uint32_t> PointSight::casters_before(const RationalPoint& point) const {
  return index_.before({point[0].get_d(), point[1].get_d(), point[2].get_d()});
}

// The way from p to the light passes the caster if p is behind it, seen from the light, and the
// pyramid from p over each edge has the light on the inner side.
Sign PointSight::hides(std::uint32_t caster, const BoundedVector& point,
                       const BoundedVector& way) const {
  const SeenPart& part = seen(caster);
  const Sign facing = states_[caster].facing == Side::kFront ? Sign::kPositive : Sign::kNegative;
  const Sign behind = -facing * dot(part.normal, minus(point, part.loop[0])).certain_sign();
  if (behind == Sign::kNegative) return Sign::kNegative;
  bool certain = behind == Sign::kPositive;
  BoundedVector from = minus(part.loop.back(), point);
  for (const BoundedVector& vertex : part.loop) {
    const BoundedVector to = minus(vertex, point);
    const Sign inside = facing * dot(cross(from, to), way).certain_sign();
    if (inside == Sign::kNegative) return Sign::kNegative;
    certain = certain && inside == Sign::kPositive;
    from = to;
  }
  return certain ? Sign::kPositive : Sign::kZero;
}

PointVisibility PointSight::at(std::span<const std::uint32_t> parts,
                               const RationalPoint& point) const {
  const std::uint32_t own = parts.front();
  if (!states_[own].receives) return {Visibility::kShadow, std::nullopt};
  const PointVisibility in_region =
      light_.region.empty() ? PointVisibility{} : exact_.at(own, point, {});
  if (in_region.visibility == Visibility::kShadow) return in_region;
  const BoundedVector place = on_grid(scene_.geometry, point);
  const BoundedVector way = light_.point.directional ? place_ : minus(place_, place);
  std::vector<std::uint32_t> uncertain;
  for (const std::uint32_t caster : casters_before(point)) {
    // Coplanar ones cast nothing here.
    if (scene_.parts[caster].plane == scene_.parts[own].plane) continue;
    switch (hides(caster, place, way)) {
      case Sign::kPositive:
        return {Visibility::kShadow, caster};
      case Sign::kZero:
        uncertain.push_back(caster);
        break;
      case Sign::kNegative:
        break;
    }
  }
  if (uncertain.empty() && in_region.visibility == Visibility::kLit) return {};
  const PointVisibility seen = exact_.at(own, point, uncertain);
  if (seen.visibility != Visibility::kBoundary) return seen;
  PointVisibility around = visibility_around(scene_, light_, parts, point, uncertain);
  if (!around.caster) around.caster = seen.caster;
  return around;
}

}  // namespace gnomon::oracle
