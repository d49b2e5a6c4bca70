// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/visibility/area_sight.h"

#include <algorithm>
#include <utility>

#include "oracle/geometry/chart.h"
#include "oracle/geometry/group_overlay.h"
#include "oracle/visibility/point_sight.h"

namespace gnomon::oracle {

namespace {

BoundedVector negated(BoundedVector vector) {
  for (Bounded& component : vector) component.value = -component.value;
  return vector;
}

SpaceBox box_of(const std::vector<BoundedVector>& loop) {
  SpaceBox box{};
  for (std::size_t k = 0; k < 3; ++k) {
    box.low[k] = loop[0][k].value - 2 * loop[0][k].error;
    box.high[k] = loop[0][k].value + 2 * loop[0][k].error;
    for (const BoundedVector& point : loop) {
      box.low[k] = std::min(box.low[k], point[k].value - 2 * point[k].error);
      box.high[k] = std::max(box.high[k], point[k].value + 2 * point[k].error);
    }
  }
  return box;
}

}  // namespace

AreaSight::AreaSight(const PreparedScene& scene, const PreparedLight& light)
    : scene_(scene), exact_(scene, light) {
  for (const Integers3& vertex : light.area_loop) light_.push_back(bounded(vertex));
  light_normal_ = bounded(area_vector(light.area_loop));
  std::vector<SpaceBox> boxes;
  for (std::uint32_t i = 0; i < scene.parts.size(); ++i) {
    SeenPart& part = parts_.emplace_back();
    for (const Integers3& vertex : grid_loop(scene, i)) part.loop.push_back(bounded(vertex));
    part.normal = bounded(support_of(scene, i).normal);
    if (!scene.parts[i].casts) continue;
    casters_.push_back(i);
    boxes.push_back(box_of(part.loop));
  }
  tree_ = SpaceTree(std::move(boxes));
}

bool AreaSight::is_behind(const std::vector<BoundedVector>& loop, const BoundedVector& normal,
                          const BoundedVector& point) {
  return std::ranges::all_of(loop, [&](const BoundedVector& vertex) {
    return dot(normal, minus(vertex, point)).certain_sign() == Sign::kNegative;
  });
}

std::vector<std::uint32_t> AreaSight::casters_before(std::uint32_t part, Side side,
                                                     const BoundedVector& point) const {
  // Planes that have the light, the point and all between them in front or on them.
  std::vector<BoundedVector> normals{side == Side::kFront ? parts_[part].normal
                                                          : negated(parts_[part].normal)};
  const Sign above = dot(light_normal_, minus(point, light_[0])).certain_sign();
  if (above == Sign::kPositive) {
    for (std::size_t i = 0; i < light_.size(); ++i) {
      // The light is counter-clockwise as seen from the point.
      normals.push_back(
          cross(minus(light_[(i + 1) % light_.size()], point), minus(light_[i], point)));
    }
  }
  std::vector<BoundedVector> corners = light_;
  corners.push_back(point);
  std::vector<std::uint32_t> found;
  tree_.meeting(box_of(corners), [&](std::uint32_t index) {
    const std::uint32_t caster = casters_[index];
    if (caster == part || scene_.parts[caster].plane == scene_.parts[part].plane) return;
    const SeenPart& own = parts_[caster];
    // One side casts what comes from in front of it.
    if (!scene_.parts[caster].two_sided &&
        dot(own.normal, minus(point, own.loop[0])).certain_sign() == Sign::kPositive) {
      return;
    }
    const bool apart = std::ranges::any_of(
        normals, [&](const BoundedVector& normal) { return is_behind(own.loop, normal, point); });
    // Nor does what is behind the light hide any of it.
    if (!apart && !is_behind(own.loop, light_normal_, light_[0])) found.push_back(caster);
  });
  std::ranges::sort(found);
  return found;
}

AreaPointVisibility AreaSight::at(std::uint32_t part, Side side, const RationalPoint& point) const {
  const auto casters = casters_before(part, side, on_grid(scene_.geometry, point));
  return exact_.at(part, side, point, true, casters);
}

}  // namespace gnomon::oracle
