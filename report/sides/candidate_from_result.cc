// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/sides/candidate_from_result.h"

#include <algorithm>
#include <cmath>

#include "report/sides/polygon_sides.h"

namespace gnomon::report {

namespace {

oracle::ShadeClass shade_of(LightState state) {
  switch (state) {
    case LightState::kLit:
      return oracle::ShadeClass::kLit;
    case LightState::kShadow:
      return oracle::ShadeClass::kShadow;
    case LightState::kPenumbra:
      return oracle::ShadeClass::kPenumbra;
    case LightState::kUmbra:
      return oracle::ShadeClass::kUmbra;
  }
  return oracle::ShadeClass::kShadow;
}

oracle::CandidateFragment whole_part(const PreparedScene& prepared, std::uint32_t part,
                                     bool area_light, ShadowReason reason) {
  oracle::CandidateFragment fragment;
  fragment.shade = area_light ? oracle::ShadeClass::kUmbra : oracle::ShadeClass::kShadow;
  fragment.reason = reason_name(reason);
  const Geometry& geometry = prepared.geometry;
  for (VertexId vertex : prepared.loop(prepared.parts[part])) {
    oracle::ExactPoint point;
    for (int k = 0; k < 3; ++k) {
      point[k] = geometry.origin[k] + geometry.step * geometry.grid.at(vertex, k);
    }
    fragment.loop.push_back(std::move(point));
  }
  return fragment;
}

/// False if a vertex is no finite number.
bool copy_loop(const LightResult& light, const Fragment& fragment,
               std::vector<oracle::ExactPoint>& loop) {
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

}  // namespace

oracle::Candidate candidate_from_result(const Scene& scene, const PreparedScene& prepared,
                                        const ShadowResult& result, std::string name,
                                        bool claim_fractions) {
  oracle::Candidate candidate;
  candidate.name = std::move(name);
  for (const LightResult& light : result.lights) {
    oracle::CandidateLight& judged = candidate.lights.emplace_back();
    judged.id = scene.lights[prepared.lights[light.light].light].id;
    judged.per_caster_umbra = prepared.lights[light.light].type == LightType::kArea;
    for (std::uint32_t polygon = 0; polygon + 1 < prepared.first_part.size(); ++polygon) {
      for (const ClassifiedSide& side : polygon_sides(prepared, light, polygon, claim_fractions)) {
        oracle::CandidatePolygon& entry = judged.polygons.emplace_back();
        entry.id = scene.polygons[polygon].id;
        entry.side =
            side.side == Side::kBack ? oracle::PolygonSide::kBack : oracle::PolygonSide::kFront;
        entry.lit_fraction = side.exact_lit;
        entry.shadow_fraction = side.exact_shadow;
        entry.penumbra_fraction = side.exact_penumbra;
        entry.umbra_fraction = side.exact_umbra;
        const std::uint32_t first = prepared.first_part[polygon];
        for (std::uint32_t i = 0; i < side.parts.size(); ++i) {
          const PartSide& part = side.parts[i];
          if (part.reason != ShadowReason::kNone) {
            entry.fragments.push_back(
                whole_part(prepared, first + i, side.area_light, part.reason));
            continue;
          }
          for (std::uint32_t f = 0; f < part.result->fragment_count; ++f) {
            const Fragment& fragment = light.fragments[part.result->first_fragment + f];
            oracle::CandidateFragment judged_fragment;
            judged_fragment.shade = shade_of(fragment.state);
            judged_fragment.exact = result.exact && !light.exact_points.empty();
            if (!copy_loop(light, fragment, judged_fragment.loop)) continue;
            if (fragment.caster != Fragment::kNoCaster) {
              judged_fragment.caster = scene.polygons[prepared.parts[fragment.caster].polygon].id;
            }
            judged_fragment.reason = reason_name(fragment.reason);
            entry.fragments.push_back(std::move(judged_fragment));
          }
        }
      }
    }
  }
  return candidate;
}

}  // namespace gnomon::report
