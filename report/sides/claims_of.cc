// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/sides/claims_of.h"

#include <algorithm>
#include <cmath>

#include "report/sides/polygon_sides.h"

namespace gnomon::report {

namespace {

ClaimedFragment whole_part(const PreparedScene& prepared, std::uint32_t part, bool area_light,
                           ShadowReason reason) {
  ClaimedFragment fragment;
  fragment.state = area_light ? LightState::kUmbra : LightState::kShadow;
  fragment.reason = name_of(reason);
  const Geometry& geometry = prepared.geometry;
  for (VertexId vertex : prepared.loop(prepared.parts[part])) {
    RationalPoint point;
    for (int k = 0; k < 3; ++k) {
      point[k] = geometry.origin[k] + geometry.step * geometry.grid.at(vertex, k);
    }
    fragment.loop.push_back(std::move(point));
  }
  return fragment;
}

/// False if a vertex is no finite number.
bool copy_loop(const LightResult& light, const Fragment& fragment,
               std::vector<RationalPoint>& loop) {
  const bool exact = !light.exact_points.empty();
  loop.reserve(fragment.count);
  for (std::uint32_t i = fragment.first; i < fragment.first + fragment.count; ++i) {
    if (exact) {
      loop.push_back(light.exact_points[i]);
      continue;
    }
    const std::array<double, 3>& point = light.points[i];
    if (!std::ranges::all_of(point, [](double x) { return std::isfinite(x); })) return false;
    loop.push_back({mpq_class(point[0]), mpq_class(point[1]), mpq_class(point[2])});
  }
  return true;
}

/// What one light's result claims of one part.
void add_part(const Scene& scene, const PreparedScene& prepared, const LightResult& light,
              const PartSide& part, std::uint32_t index, bool exact, ClaimedPolygon& claimed) {
  if (part.reason != ShadowReason::kNone) {
    claimed.fragments.push_back(whole_part(prepared, index, part.area_light, part.reason));
    return;
  }
  for (std::uint32_t f = 0; f < part.result->fragment_count; ++f) {
    const Fragment& fragment = light.fragments[part.result->first_fragment + f];
    ClaimedFragment own;
    own.state = fragment.state;
    own.exact = exact && !light.exact_points.empty();
    if (!copy_loop(light, fragment, own.loop)) continue;
    if (fragment.caster != Fragment::kNoCaster) {
      own.caster = scene.polygons[prepared.parts[fragment.caster].polygon].id;
    }
    own.reason = name_of(fragment.reason);
    claimed.fragments.push_back(std::move(own));
  }
}

ClaimedLight claims_of_light(const Scene& scene, const PreparedScene& prepared,
                             const LightResult& light, bool exact,
                             const std::vector<ClassifiedSide>& sides) {
  ClaimedLight claimed;
  claimed.id = scene.lights[prepared.lights[light.light].light].id;
  claimed.per_caster_umbra = prepared.lights[light.light].has_area();
  claimed.cover = light.cover;
  claimed.background = light.background;
  for (const ClassifiedSide& side : sides) {
    ClaimedPolygon& polygon = claimed.polygons.emplace_back();
    polygon.id = scene.polygons[side.polygon].id;
    polygon.side = side.side;
    polygon.lit_fraction = side.exact_lit;
    polygon.shadow_fraction = side.exact_shadow;
    polygon.penumbra_fraction = side.exact_penumbra;
    polygon.umbra_fraction = side.exact_umbra;
    std::uint32_t part = prepared.first_part[side.polygon];
    for (const PartSide& own : side.parts) {
      add_part(scene, prepared, light, own, part++, exact, polygon);
    }
  }
  return claimed;
}

}  // namespace

Claims claims_of(const Scene& scene, const PreparedScene& prepared, const ShadowResult& result,
                 const SidesByLight& sides, std::string name) {
  Claims claims;
  claims.name = std::move(name);
  for (std::size_t i = 0; i < result.lights.size(); ++i) {
    claims.lights.push_back(
        claims_of_light(scene, prepared, result.lights[i], result.exact, sides[i]));
  }
  return claims;
}

Claims claims_of(const Scene& scene, const PreparedScene& prepared, const ShadowResult& result,
                 std::string name, bool claim_fractions) {
  Claims claims;
  claims.name = std::move(name);
  for (const LightResult& light : result.lights) {
    claims.lights.push_back(claims_of_light(scene, prepared, light, result.exact,
                                            classified_sides(prepared, light, claim_fractions)));
  }
  return claims;
}

}  // namespace gnomon::report
