// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/judge/family_shades.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "oracle/geometry/group_overlay.h"

namespace gnomon::oracle {

PlanarLoop cut(const PlanarLoop& loop, const FlatHalf& half) {
  switch (half.kind) {
    case FlatHalf::Kind::kAll:
      return loop;
    case FlatHalf::Kind::kNone:
      return {};
    case FlatHalf::Kind::kLine:
      break;
  }
  return cut(loop, half.line);
}

bool Shade::is_apart(const PlanarLoop& loop, long double error) const {
  return std::ranges::any_of(lines, [&](const PlanarLine& line) {
    return std::ranges::all_of(loop, [&](const PlanarPoint& p) { return line.at(p) < -error; });
  });
}

void Shades::add(Shade shade) { shades_.push_back(std::move(shade)); }

std::vector<const Shade*> Shades::near(const PlanarBox& box) {
  if (order_.size() != shades_.size()) {
    order_.resize(shades_.size());
    std::iota(order_.begin(), order_.end(), 0u);
    std::ranges::sort(order_, {}, [&](std::uint32_t s) { return shades_[s].box.low.x; });
    reach_.clear();
    for (const std::uint32_t s : order_) {
      reach_.push_back(
          std::max(reach_.empty() ? shades_[s].box.high.x : reach_.back(), shades_[s].box.high.x));
    }
  }
  auto at = static_cast<std::size_t>(
      std::ranges::upper_bound(order_, box.high.x, {},
                               [&](std::uint32_t s) { return shades_[s].box.low.x; }) -
      order_.begin());
  std::vector<std::uint32_t> found;
  while (at-- > 0 && reach_[at] >= box.low.x) {
    if (shades_[order_[at]].box.meets(box)) found.push_back(order_[at]);
  }
  std::ranges::sort(found);
  std::vector<const Shade*> near;
  for (const std::uint32_t s : found) near.push_back(&shades_[s]);
  return near;
}

FamilyShades::FamilyShades(const PreparedScene& scene, LightVolumes& light,
                           std::span<const std::uint32_t> parts, Side side)
    : scene_(scene),
      light_(light),
      parts_(parts.begin(), parts.end()),
      side_(side),
      frame_(scene.geometry, grid_loop(scene, parts.front())) {
  PlanarLoop all;
  for (const std::uint32_t part : parts_) {
    PlanarLoop loop;
    for (const Integers3& vertex : grid_loop(scene, part)) {
      loop.push_back(frame_.at(HomogeneousPoint{vertex, 1}));
    }
    for (const VertexId vertex : scene.loop(scene.parts[part])) {
      for (const double coordinate : scene.geometry.positions[vertex]) {
        greatest_ = std::max(greatest_, std::fabs(static_cast<long double>(coordinate)));
      }
    }
    if (area_of(loop) < 0) std::ranges::reverse(loop);
    area_ += area_of(loop);
    all.insert(all.end(), loop.begin(), loop.end());
    lines_.push_back(lines_of(loop));
    loops_.push_back(std::move(loop));
  }
  // A line is off by less than its distance from the family's points; those that matter meet it.
  error_ = 4 * kPlanarError * greatest_;
  const PlanarBox box = box_of(all);
  const long double margin = (box.high.x - box.low.x) + (box.high.y - box.low.y) + 1024 * error_;
  surroundings_ = {{box.low.x - margin, box.low.y - margin},
                   {box.high.x + margin, box.low.y - margin},
                   {box.high.x + margin, box.high.y + margin},
                   {box.low.x - margin, box.high.y + margin}};
}

/// `closed`: what lies in the plane is inside.
FlatHalf FamilyShades::half_of(const ExactPlane& plane, bool closed) const {
  if (const std::optional<PlanarLine> line = frame_.trace(plane)) {
    return {FlatHalf::Kind::kLine, *line};
  }
  const Integers3 point = grid_loop(scene_, parts_.front())[0];
  const int side = sgn(value_at(plane, point));
  const bool inside = side > 0 || (side == 0 && closed);
  return {inside ? FlatHalf::Kind::kAll : FlatHalf::Kind::kNone, {}};
}

void FamilyShades::add_shade(Shades& shades, std::uint32_t part,
                             const std::vector<ExactPlane>& planes, bool closed) {
  Shade shade;
  shade.part = part;
  PlanarLoop outer = surroundings_;
  const long double margin = 1024 * error_;
  for (std::size_t i = 0; i < planes.size() && !outer.empty(); ++i) {
    // Umbra volumes are closed: what lies in one of their planes is inside of it; not in the
    // caster's own.
    const FlatHalf half = half_of(planes[i], closed && i > 0);
    if (half.kind == FlatHalf::Kind::kNone) return;
    if (half.kind == FlatHalf::Kind::kAll) continue;
    shade.lines.push_back(half.line);
    shade.bounds.push_back(i);
    outer = oracle::cut(outer, half.line.grown(margin));
  }
  if (outer.empty()) return;
  shade.box = box_of(outer);
  shades.add(std::move(shade));
}

PlanarLoop FamilyShades::region_of(const Shade& shade) const {
  PlanarLoop region = surroundings_;
  for (const PlanarLine& line : shade.lines) {
    if (!region.empty()) region = oracle::cut(region, line);
  }
  return region;
}

namespace {

/// By doubles: all corners are outside of one of the half-spaces, by more than the rounding of
/// corner, base and sum.
bool are_apart(const std::vector<std::array<double, 3>>& corners,
               const std::vector<space::HalfSpace>& bounds) {
  const auto largest = [](const std::array<double, 3>& p) {
    return std::max({std::fabs(p[0]), std::fabs(p[1]), std::fabs(p[2])});
  };
  constexpr double kRounding = 0x1p-49;
  return std::ranges::any_of(bounds, [&](const space::HalfSpace& half) {
    return std::ranges::all_of(corners, [&](const std::array<double, 3>& corner) {
      return half.near_value(corner) < -kRounding * (largest(corner) + largest(half.near_base));
    });
  });
}

}  // namespace

void FamilyShades::add_volumes(Shades& shades, bool all) {
  const std::uint32_t receiver = parts_.front();
  std::vector<std::array<double, 3>> corners;
  for (const std::uint32_t part : parts_) {
    for (const VertexId vertex : scene_.loop(scene_.parts[part])) {
      corners.push_back(scene_.geometry.positions[vertex]);
    }
  }
  for (std::size_t b = 0; b < light_.area().size(); ++b) {
    if (light_.area().part_of(b) == receiver) continue;
    if (are_apart(corners, light_.area().largest_penumbra(b).bounds)) continue;
    const AreaSolids::Volume& volume =
        all ? light_.area().umbra(b, receiver, side_) : light_.area().penumbra(b, receiver, side_);
    if (volume.empty) continue;
    add_shade(shades, light_.area().part_of(b), light_.planes_of(volume), all);
  }
}

Shades& FamilyShades::partly() {
  if (partly_) return *partly_;
  partly_.emplace();
  if (light_.is_area()) {
    if (light_.sees(parts_.front(), side_)) add_volumes(*partly_, false);
    return *partly_;
  }
  std::vector<std::uint32_t> casters;
  for (const std::uint32_t part : parts_) {
    const std::vector<std::uint32_t> own = light_.overlapping(part);
    casters.insert(casters.end(), own.begin(), own.end());
  }
  std::ranges::sort(casters);
  casters.erase(std::unique(casters.begin(), casters.end()), casters.end());
  for (const std::uint32_t caster : casters) {
    if (caster != parts_.front()) add_shade(*partly_, caster, light_.shadow_planes(caster), false);
  }
  return *partly_;
}

Shades& FamilyShades::wholly() {
  if (wholly_) return *wholly_;
  wholly_.emplace();
  if (light_.sees(parts_.front(), side_)) add_volumes(*wholly_, true);
  return *wholly_;
}

const std::vector<FlatHalf>& FamilyShades::outsides() {
  if (outsides_) return *outsides_;
  outsides_.emplace();
  for (const ExactPlane& plane : light_.outside_grid_planes()) {
    outsides_->push_back(half_of(plane, false));
  }
  return *outsides_;
}

const FlatHalf& FamilyShades::before_light() {
  if (!before_light_) {
    before_light_ = half_of(grid_plane(scene_.geometry, light_.area().before_light()), false);
  }
  return *before_light_;
}

}  // namespace gnomon::oracle
