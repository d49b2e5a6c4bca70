// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/sides/claims_of.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

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

/// Loops as a kernel has put them out.
struct OutputPoints {
  const std::vector<std::array<double, 3>>& nearest;
  const std::vector<std::array<mpq_class, 3>>& exact;

  /// False if a vertex is no finite number.
  bool copy(std::uint32_t first, std::uint32_t count, RationalLoop& loop) const {
    loop.reserve(count);
    for (std::uint32_t i = first; i < first + count; ++i) {
      if (!exact.empty()) {
        loop.push_back(exact[i]);
        continue;
      }
      const std::array<double, 3>& point = nearest[i];
      if (!std::ranges::all_of(point, [](double x) { return std::isfinite(x); })) return false;
      loop.push_back({mpq_class(point[0]), mpq_class(point[1]), mpq_class(point[2])});
    }
    return true;
  }
};

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
    const OutputPoints points{light.points, light.exact_points};
    if (!points.copy(fragment.first, fragment.count, own.loop)) continue;
    own.level = claimed.fragments.size();
    if (fragment.caster != Fragment::kNoCaster) {
      own.caster = scene.polygons[prepared.parts[fragment.caster].polygon].id;
    }
    if (fragment.casters != Fragment::kNoCaster) {
      own.casters = caster_ids(scene, prepared, light.caster_sets[fragment.casters]);
    }
    own.reason = name_of(fragment.reason);
    claimed.fragments.push_back(std::move(own));
  }
}

/// What one light's result claims of a side without fragments.
ClaimedShare share_of_side(const ClassifiedSide& side) {
  ClaimedShare share{side.lit.lower, side.lit.upper, {}};
  // Sums of several parts are rounded: what all of a side is, its parts say.
  const auto lit = [](const PartSide& part) {
    return gnomon::report::share_of(part, LightState::kLit);
  };
  const auto is_lit = [&](const PartSide& part) { return lit(part).lower == 1; };
  const auto is_dark = [&](const PartSide& part) { return lit(part).upper == 0; };
  if (std::ranges::all_of(side.parts, is_lit)) share.whole = LightState::kLit;
  if (std::ranges::all_of(side.parts, is_dark)) share.whole = LightState::kShadow;
  return share;
}

ClaimedLight claims_of_light(const Scene& scene, const PreparedScene& prepared,
                             const LightResult& light, bool exact,
                             const std::vector<ClassifiedSide>& sides) {
  ClaimedLight claimed;
  claimed.id = light_name(scene, prepared, light);
  if (light.piece != LightResult::kWhole) {
    claimed.piece_of = scene.lights[prepared.lights[light.light].light].id;
    claimed.piece_loop = light.piece_loop;
  }
  claimed.per_caster_umbra = prepared.lights[light.light].has_area();
  claimed.cover = light.cover;
  claimed.background = light.background;
  claimed.shares_alone =
      light.method != MethodId::kAutomatic && !method_info(light.method).makes_fragments;
  claimed.polygons.reserve(sides.size());  // a rational is copied where a vector grows
  for (const ClassifiedSide& side : sides) {
    ClaimedPolygon& polygon = claimed.polygons.emplace_back();
    polygon.id = scene.polygons[side.polygon].id;
    polygon.side = side.side;
    polygon.lit_fraction = side.exact_lit;
    polygon.shadow_fraction = side.exact_shadow;
    polygon.penumbra_fraction = side.exact_penumbra;
    polygon.umbra_fraction = side.exact_umbra;
    if (claimed.shares_alone) {
      polygon.share = share_of_side(side);
      continue;
    }
    std::uint32_t part = prepared.first_part[side.polygon];
    for (const PartSide& own : side.parts) {
      add_part(scene, prepared, light, own, part++, exact, polygon);
    }
  }
  return claimed;
}

std::vector<std::string> ids_of(const Claims& claims, std::uint64_t bits) {
  std::vector<std::string> ids;
  for (std::size_t i = 0; i < claims.lights.size(); ++i) {
    if (bits >> i & 1) ids.push_back(claims.lights[i].id);
  }
  return ids;
}

/// Entries that are grouped by polygon and side. `fill` sets what lights do to a fragment, and gets
/// the index of the group's first entry.
template <class Entry, class Fill>
std::optional<std::vector<SharedPolygon>> shared_polygons(const Scene& scene,
                                                          const PreparedScene& prepared,
                                                          const std::vector<Entry>& entries,
                                                          const OutputPoints& points, bool exact,
                                                          const Fill& fill) {
  if (entries.empty()) return std::nullopt;
  std::vector<SharedPolygon> polygons;
  std::size_t first = 0;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Entry& entry = entries[i];
    const std::string& id = scene.polygons[prepared.parts[entry.part].polygon].id;
    if (polygons.empty() || polygons.back().id != id || polygons.back().side != entry.side) {
      polygons.push_back({id, entry.side, true, {}});
      first = i;
    }
    SharedFragment fragment;
    fragment.exact = exact && !points.exact.empty();
    if (!points.copy(entry.first, entry.count, fragment.loop)) fragment.loop.clear();
    fill(fragment, entry, first);
    polygons.back().fragments.push_back(std::move(fragment));
  }
  return polygons;
}

/// What is told of several lights at once. Requires: claims of all lights of the result.
void add_shared(const Scene& scene, const PreparedScene& prepared, const ShadowResult& result,
                Claims& claims) {
  claims.combined = shared_polygons(
      scene, prepared, result.combined, {result.combined_points, result.combined_exact_points},
      result.exact, [&](SharedFragment& fragment, const CombinedFragment& entry, std::size_t) {
        fragment.lit_by = ids_of(claims, entry.lit_by);
        fragment.penumbra_of = ids_of(claims, entry.penumbra_of);
      });
  claims.overlay = shared_polygons(
      scene, prepared, result.overlay, {result.overlay_points, result.overlay_exact_points},
      result.exact, [&](SharedFragment& fragment, const PaintedPolygon& entry, std::size_t first) {
        fragment.level = entry.level;
        fragment.dark_for = ids_of(claims, entry.dark_for);
        if (entry.on != PaintedPolygon::kNoOwner) fragment.on = entry.on - first;
      });
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
  add_shared(scene, prepared, result, claims);
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
  add_shared(scene, prepared, result, claims);
  return claims;
}

}  // namespace gnomon::report
