// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/visibility/neighbourhood.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "gnomon/oracle/point_regions.h"
#include "oracle/geometry/chart.h"
#include "oracle/geometry/group_overlay.h"
#include "oracle/visibility/outside_planes.h"

namespace gnomon::oracle {

namespace {

/// A direction in the receiver's plane, by two vectors that span it; or a half-plane of directions,
/// by its inner normal.
struct Direction {
  mpz_class x, y;
};

mpz_class dot(const Direction& a, const Direction& b) { return a.x * b.x + a.y * b.y; }
mpz_class cross(const Direction& a, const Direction& b) { return a.x * b.y - a.y * b.x; }
Direction turned_left(const Direction& a) { return {mpz_class(-a.y), a.x}; }
Direction opposite(const Direction& a) { return {mpz_class(-a.x), mpz_class(-a.y)}; }

/// Of the upper half first, each half counter-clockwise.
bool is_before(const Direction& a, const Direction& b) {
  const auto half = [](const Direction& d) { return d.y > 0 || (d.y == 0 && d.x > 0) ? 0 : 1; };
  if (half(a) != half(b)) return half(a) < half(b);
  return cross(a, b) > 0;
}

/// Directions on the inner side of all half-planes.
struct Sector {
  std::vector<Direction> halves;
  std::uint32_t part = 0;
  bool holds(const Direction& direction) const {
    return std::ranges::all_of(halves,
                               [&](const Direction& half) { return dot(half, direction) > 0; });
  }
};

class Neighbourhood {
 public:
  Neighbourhood(const PreparedScene& scene, const PreparedLight& light, std::uint32_t receiver,
                const RationalPoint& point)
      : scene_(scene), light_(light), point_(to_grid(scene.geometry, point)) {
    const std::vector<Integers3> loop = grid_loop(scene, receiver);
    first_ = minus(loop[1], loop[0]);
    second_ = oracle::cross(support_of(scene, receiver).normal, first_);
  }

  /// Where the points of a part are.
  std::optional<Sector> sector_of_part(std::uint32_t part) const {
    const std::vector<Integers3> loop = grid_loop(scene_, part);
    const Integers3 normal = support_of(scene_, part).normal;
    std::vector<ExactPlane> planes;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      planes.push_back(
          through(loop[i], oracle::cross(normal, minus(loop[(i + 1) % loop.size()], loop[i]))));
    }
    return sector_within(part, planes);
  }

  /// Where the shadow of a caster is; nothing if it is nowhere near.
  std::optional<Sector> sector_of_shadow(std::uint32_t caster) const {
    if (!scene_.parts[caster].casts && !light_.is_eye) return std::nullopt;
    const std::vector<Integers3> loop = grid_loop(scene_, caster);
    ExactPlane support = support_of(scene_, caster);
    const Integers3& at = light_.point.grid;
    const int facing =
        sgn(light_.point.directional ? oracle::dot(support.normal, at) : value_at(support, at));
    if (facing == 0 || (facing < 0 && !scene_.parts[caster].two_sided)) return std::nullopt;
    std::vector<ExactPlane> planes{facing > 0 ? opposite_of(support) : support};
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Integers3 &a = loop[i], &b = loop[(i + 1) % loop.size()];
      ExactPlane edge =
          through(a, light_.point.directional ? oracle::cross(at, minus(b, a))
                                              : oracle::cross(minus(a, at), minus(b, at)));
      const auto inner = std::ranges::find_if(
          loop, [&](const Integers3& vertex) { return value_at(edge, vertex) != 0; });
      planes.push_back(value_at(edge, *inner) < 0 ? opposite_of(edge) : edge);
    }
    return sector_within(caster, planes);
  }

  /// Where it is outside of the light's region, by the plane whose outside is in front.
  std::optional<Sector> sector_outside(const ExactPlane& outside) const {
    return sector_within(ShadowPiece::kOutsideRegion, {outside});
  }

 private:
  static ExactPlane through(const Integers3& point, Integers3 normal) {
    ExactPlane plane{std::move(normal), 0};
    plane.offset = oracle::dot(plane.normal, point);
    return plane;
  }
  static ExactPlane opposite_of(const ExactPlane& plane) { return oracle::opposite(plane); }

  std::optional<Sector> sector_within(std::uint32_t part,
                                      const std::vector<ExactPlane>& planes) const {
    Sector sector{{}, part};
    for (const ExactPlane& plane : planes) {
      const int side = sgn(value_at(plane, point_));
      if (side < 0) return std::nullopt;
      if (side > 0) continue;
      Direction half{oracle::dot(plane.normal, first_), oracle::dot(plane.normal, second_)};
      if (half.x == 0 && half.y == 0) return std::nullopt;  // it holds all of the receiver's plane
      sector.halves.push_back(std::move(half));
    }
    return sector;
  }

  const PreparedScene& scene_;
  const PreparedLight& light_;
  HomogeneousPoint point_;
  Integers3 first_, second_;  // span the receiver's plane
};

/// One direction inside of each division that the borders of sectors make.
std::vector<Direction> divisions_of(const std::vector<Sector>& sectors) {
  std::vector<Direction> rays;
  for (const Sector& sector : sectors) {
    for (const Direction& half : sector.halves) {
      rays.push_back(turned_left(half));
      rays.push_back(opposite(rays.back()));
    }
  }
  if (rays.empty()) return {{1, 0}};
  std::ranges::sort(rays, is_before);
  const auto same = std::ranges::unique(rays, [](const Direction& a, const Direction& b) {
    return !is_before(a, b) && !is_before(b, a);
  });
  rays.erase(same.begin(), same.end());
  std::vector<Direction> middles;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Direction &a = rays[i], &b = rays[(i + 1) % rays.size()];
    // Every ray's opposite is one, so that no division has more than a half turn.
    middles.push_back(cross(a, b) == 0 ? turned_left(a)
                                       : Direction{mpz_class(a.x + b.x), mpz_class(a.y + b.y)});
  }
  return middles;
}

}  // namespace

PointVisibility visibility_around(const PreparedScene& scene, const PreparedLight& light,
                                  std::span<const std::uint32_t> receivers,
                                  const RationalPoint& point,
                                  std::span<const std::uint32_t> casters) {
  const Neighbourhood around(scene, light, receivers.front(), point);
  std::vector<Sector> sectors;
  for (const std::uint32_t part : receivers) {
    if (auto sector = around.sector_of_part(part)) sectors.push_back(*std::move(sector));
  }
  const std::size_t own = sectors.size();
  for (const std::uint32_t caster : casters) {
    if (std::ranges::find(receivers, caster) != receivers.end()) continue;
    if (auto sector = around.sector_of_shadow(caster)) sectors.push_back(*std::move(sector));
  }
  for (const ExactPlane& outside : outside_planes(scene.geometry, light)) {
    if (auto sector = around.sector_outside(outside)) sectors.push_back(*std::move(sector));
  }
  const std::span shadows = std::span(sectors).subspan(own);
  bool lit = false, dark = false;
  std::optional<std::uint32_t> caster;
  for (const Direction& direction : divisions_of(sectors)) {
    const auto holds = [&](const Sector& sector) { return sector.holds(direction); };
    if (std::none_of(sectors.begin(), sectors.begin() + static_cast<std::ptrdiff_t>(own), holds)) {
      continue;
    }
    const auto shadow = std::ranges::find_if(shadows, holds);
    if (shadow == shadows.end()) {
      lit = true;
    } else {
      dark = true;
      if (shadow->part != ShadowPiece::kOutsideRegion) caster = shadow->part;
    }
  }
  if (lit && dark) return {Visibility::kBoundary, caster};
  if (dark) return {Visibility::kShadow, caster};
  return {lit ? Visibility::kLit : Visibility::kBoundary, std::nullopt};
}

}  // namespace gnomon::oracle
