// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/judge/light_volumes.h"

#include <utility>

#include "oracle/geometry/group_overlay.h"
#include "oracle/visibility/outside_planes.h"

namespace gnomon::oracle {

using space::area_along;
using space::cut;
using space::HalfSpace;
using space::Loop;
using space::without;

LightVolumes::LightVolumes(const PreparedScene& scene, const PreparedLight& light, double diagonal)
    : scene_(scene),
      own_(light),
      diagonal_(diagonal),
      solids_(scene.parts.size()),
      shadow_planes_(scene.parts.size()),
      scene_planes_(scene.parts.size()),
      scene_loops_(scene.parts.size()),
      shadows_(scene.parts.size()) {
  const auto count = static_cast<std::uint32_t>(scene.parts.size());
  if (light.has_area()) {
    std::vector<const Loop*> loops;
    for (std::uint32_t part = 0; part < count; ++part) loops.push_back(&solid(part).loop);
    area_.emplace(scene, light, loops);
    return;
  }
  std::vector<std::uint32_t> casters;
  for (std::uint32_t part = 0; part < count; ++part) {
    standings_.push_back(standing_of(scene, light, part));
    if (standings_.back().casts) casters.push_back(part);
  }
  index_.emplace(scene, light, casters);
  outside_planes_ = outside_planes(scene.geometry, light);
  for (std::size_t i = 0; i < outside_planes_.size(); ++i) {
    const Integers3& normal = outside_planes_[i].normal;
    const VertexId on_plane = scene.geometry.planes[light.region[i].index()].a;
    const Integers3 base{scene.geometry.grid.at(on_plane, 0), scene.geometry.grid.at(on_plane, 1),
                         scene.geometry.grid.at(on_plane, 2)};
    outsides_.emplace_back(RationalPoint{normal[0], normal[1], normal[2]},
                           in_scene(scene.geometry, HomogeneousPoint{base, 1}));
  }
  const Integers3& source = light.point.grid;
  source_ = light.point.directional
                ? Integers4(std::array<mpz_class, 4>{source[0], source[1], source[2], 0})
                : scene_point(in_scene(scene.geometry, HomogeneousPoint{source, 1}));
  source_->make_large();
}

const Solid& LightVolumes::solid(std::uint32_t part) const {
  return solids_[part].get([&] { return solid_of(scene_, part); });
}

const std::vector<HalfSpace>& LightVolumes::shadow(std::uint32_t part) const {
  return shadows_[part].get([&] {
    std::vector<HalfSpace> bounds;
    const std::vector<ExactPlane>& planes = shadow_planes(part);
    const Loop& loop = solid(part).loop;
    for (std::size_t i = 0; i < planes.size(); ++i) {
      const Integers3& normal = planes[i].normal;
      bounds.emplace_back(RationalPoint{normal[0], normal[1], normal[2]}, loop[i == 0 ? 0 : i - 1]);
    }
    return bounds;
  });
}

ExactPlane grid_plane(const Geometry& geometry, const HalfSpace& half) {
  ExactPlane plane;
  mpz_class common = 1;
  for (const mpq_class& component : half.normal) common = lcm(common, component.get_den());
  for (int k = 0; k < 3; ++k) {
    plane.normal[k] = half.normal[k].get_num() * (common / half.normal[k].get_den());
  }
  const mpz_class factor = gcd(gcd(plane.normal[0], plane.normal[1]), plane.normal[2]);
  if (factor > 1) {
    for (mpz_class& component : plane.normal) component /= factor;
  }
  const HomogeneousPoint base = to_grid(geometry, half.base);
  plane.offset = oracle::dot(plane.normal, base.xyz);
  for (mpz_class& component : plane.normal) component *= base.w;
  return plane;
}

namespace {

std::vector<ExactPlane> grid_planes(const Geometry& geometry,
                                    const std::vector<HalfSpace>& bounds) {
  std::vector<ExactPlane> planes;
  for (const HalfSpace& half : bounds) planes.push_back(grid_plane(geometry, half));
  return planes;
}

}  // namespace

const std::vector<ExactPlane>& LightVolumes::shadow_planes(std::uint32_t part) const {
  return shadow_planes_[part].get(
      [&] { return shadow_planes_of(scene_, own_, part, standings_[part].facing); });
}

const std::vector<Integers4>& LightVolumes::scene_planes(std::uint32_t part) const {
  return scene_planes_[part].get([&] {
    std::vector<Integers4> planes;
    for (const ExactPlane& plane : shadow_planes(part)) {
      planes.push_back(scene_plane(scene_.geometry, plane));
      planes.back().make_large();
    }
    return planes;
  });
}

const std::vector<Integers4>& LightVolumes::scene_loop(std::uint32_t part) const {
  return scene_loops_[part].get([&] {
    std::vector<Integers4> loop;
    for (Integers3& vertex : grid_loop(scene_, part)) {
      loop.push_back(
          scene_point(in_scene(scene_.geometry, HomogeneousPoint{std::move(vertex), 1})));
      loop.back().make_large();
    }
    return loop;
  });
}

const std::vector<ExactPlane>& LightVolumes::planes_of(const AreaSolids::Volume& volume) {
  const auto [place, inserted] = volume_planes_.try_emplace(&volume);
  if (inserted) place->second = grid_planes(scene_.geometry, volume.bounds);
  return place->second;
}

bool LightVolumes::sees(std::uint32_t part, Side side) const {
  if (area_) return area_->sees(part, side);
  const LightStanding& own = standings_[part];
  return own.receives && (side == Side::kFront ? own.facing > 0 : own.facing < 0);
}

std::vector<Loop> LightVolumes::not_shadowed(const Piece& piece,
                                             std::optional<std::uint32_t> caster) const {
  std::vector<Loop> rest{piece.loop};
  for (std::size_t i = 0; i < outsides_.size() && !caster && !rest.empty(); ++i) {
    rest = without(std::move(rest), std::span(&outsides_[i], 1));
  }
  const std::uint32_t first = caster ? scene_.first_part[*caster] : 0;
  const auto last =
      caster ? scene_.first_part[*caster + 1] : static_cast<std::uint32_t>(scene_.parts.size());
  return without_shadows(piece, std::move(rest), first, last);
}

std::vector<Loop> LightVolumes::not_shadowed_by(const Piece& piece,
                                                std::span<const std::uint32_t> casters) const {
  std::vector<Loop> rest{piece.loop};
  for (const std::uint32_t caster : casters) {
    rest = without_shadows(piece, std::move(rest), scene_.first_part[caster],
                           scene_.first_part[caster + 1]);
  }
  return rest;
}

/// Of parts [first, last).
std::vector<Loop> LightVolumes::without_shadows(const Piece& piece, std::vector<Loop> rest,
                                                std::uint32_t first, std::uint32_t last) const {
  for (std::uint32_t part = first; part < last && !rest.empty(); ++part) {
    // A part in the receiver's plane shadows nothing of it, and its shadow cuts nothing off.
    if (!standings_[part].casts || part == piece.part || solid(part).holds(solid(piece.part))) {
      continue;
    }
    if (is_apart(piece, shadow(part))) continue;
    rest = without(std::move(rest), shadow(part));
  }
  return rest;
}

Loop LightVolumes::inside_region(Loop loop) const {
  for (const HalfSpace& outside : outsides_) {
    const RationalPoint& n = outside.normal;
    loop = cut(loop, HalfSpace({-n[0], -n[1], -n[2]}, outside.base));
    if (loop.empty()) break;
  }
  return loop;
}

mpq_class LightVolumes::shadowed_by(const Piece& piece, std::uint32_t part) const {
  if (!standings_[part].casts || part == piece.part) return 0;
  Loop rest = piece.loop;
  for (const HalfSpace& half : shadow(part)) {
    rest = cut(rest, half);
    if (rest.empty()) return 0;
  }
  return area_along(solid(piece.part).normal, rest);
}

std::vector<Loop> LightVolumes::before_light(const Piece& piece) const {
  std::vector<Loop> loops;
  if (Loop front = cut(piece.loop, area_->before_light()); !front.empty()) {
    loops.push_back(std::move(front));
  }
  return loops;
}

std::vector<Loop> LightVolumes::not_hidden(const Piece& piece, std::vector<Loop> loops,
                                           std::optional<std::uint32_t> caster, Side side,
                                           bool all) {
  for (std::size_t b = 0; b < area_->size() && !loops.empty(); ++b) {
    const std::uint32_t part = area_->part_of(b);
    if ((caster && scene_.parts[part].polygon != *caster) || part == piece.part) continue;
    if (is_apart(piece, area_->largest_penumbra(b).bounds)) continue;
    const AreaSolids::Volume& volume =
        all ? area_->umbra(b, piece.part, side) : area_->penumbra(b, piece.part, side);
    if (volume.empty) continue;
    std::vector<HalfSpace> bounds;
    for (std::size_t i = 0; i < volume.bounds.size(); ++i) {
      const HalfSpace& half = volume.bounds[i];
      // Umbra volumes are closed: what lies in one of their planes is inside of it.
      if (!(all && i > 0 && solid(piece.part).lies_in(half))) bounds.push_back(half);
    }
    loops = without(std::move(loops), bounds);
  }
  return loops;
}

Loop LightVolumes::inside(const Piece& piece, const AreaSolids::Volume& volume, bool closed) const {
  Loop rest = cut(piece.loop, area_->before_light());
  for (std::size_t i = 0; i < volume.bounds.size() && !rest.empty(); ++i) {
    const HalfSpace& half = volume.bounds[i];
    if (!(closed && i > 0 && solid(piece.part).lies_in(half))) rest = cut(rest, half);
  }
  return volume.empty ? Loop{} : rest;
}

std::array<mpq_class, 4> LightVolumes::areas_of_classes(const Piece& piece, Side side) {
  std::array<mpq_class, 4> areas;
  const auto area_of = [&](LightState state) -> mpq_class& {
    return areas[static_cast<std::size_t>(state)];
  };
  const RationalPoint& normal = solid(piece.part).normal;
  const bool reached = sees(piece.part, side);
  if (!area_) {
    if (reached) area_of(LightState::kLit) = area_along(normal, not_shadowed(piece, std::nullopt));
    area_of(LightState::kShadow) = piece.area - area_of(LightState::kLit);
    return areas;
  }
  std::vector<Loop> rest;
  if (reached) rest = not_hidden(piece, before_light(piece), std::nullopt, side, true);
  const mpq_class partly = area_along(normal, rest);
  area_of(LightState::kUmbra) = piece.area - partly;
  rest = not_hidden(piece, std::move(rest), std::nullopt, side, false);
  area_of(LightState::kLit) = area_along(normal, rest);
  area_of(LightState::kPenumbra) = partly - area_of(LightState::kLit);
  return areas;
}

}  // namespace gnomon::oracle
