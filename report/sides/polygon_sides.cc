// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/sides/polygon_sides.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "report/sides/part_area.h"

namespace gnomon::report {

namespace {

using oracle::Enclosure;

/// The entries of one part: one for each side that sees an area light, else one.
std::span<const PartResult> results_of(const LightResult& light, std::uint32_t part) {
  if (light.area_fractions.empty()) return {&light.parts[part], 1};
  const auto first = std::ranges::lower_bound(light.parts, part, {}, &PartResult::part);
  const auto last = std::ranges::upper_bound(light.parts, part, {}, &PartResult::part);
  return {first, last};
}

PartSide part_side(const LightResult& light, bool area_light, std::uint32_t part, Side side) {
  PartSide one;
  one.area_light = area_light;
  const std::span<const PartResult> results = results_of(light, part);
  one.result = &results.front();
  for (const PartResult& result : results) {
    if (result.reason == ShadowReason::kNone && result.side == side) one.result = &result;
  }
  if (one.result->reason != ShadowReason::kNone) {
    one.reason = one.result->reason;
    // That is the front's. If no light is in front, and not all of it is in the plane, some is
    // behind; a back that does not see it then lies behind the light.
    if (area_light && side != one.result->side && one.reason == ShadowReason::kFacesAway) {
      one.reason = ShadowReason::kBehindLight;
    }
  } else if (one.result->side != side) {
    // Of an area light too: a part that the other side sees it from is partly in front of it.
    one.reason = ShadowReason::kFacesAway;
  }
  if (one.reason != ShadowReason::kNone) {
    (area_light ? one.umbra : one.shadow) = {1, 1};
    return one;
  }
  const auto index = static_cast<std::size_t>(one.result - light.parts.data());
  if (!light.exact_fractions.empty()) one.exact = &light.exact_fractions[index];
  one.lit = one.result->lit;
  if (!area_light) {
    one.shadow = one.result->shadow;
    return one;
  }
  one.penumbra = light.area_fractions[index].penumbra;
  one.umbra = light.area_fractions[index].umbra;
  return one;
}

Interval Shares::*share_member(LightState state) {
  switch (state) {
    case LightState::kLit:
      return &Shares::lit;
    case LightState::kShadow:
      return &Shares::shadow;
    case LightState::kPenumbra:
      return &Shares::penumbra;
    case LightState::kUmbra:
      return &Shares::umbra;
  }
  return &Shares::lit;
}

std::optional<mpq_class> ClassifiedSide::*exact_member(LightState state) {
  switch (state) {
    case LightState::kLit:
      return &ClassifiedSide::exact_lit;
    case LightState::kShadow:
      return &ClassifiedSide::exact_shadow;
    case LightState::kPenumbra:
      return &ClassifiedSide::exact_penumbra;
    case LightState::kUmbra:
      return &ClassifiedSide::exact_umbra;
  }
  return &ClassifiedSide::exact_lit;
}

/// Where all parts are of one class, the polygon is, exactly.
void set_exact_if_of_one_class(ClassifiedSide& side) {
  const auto states = light_states(side.area_light);
  const auto is_all = [&](LightState state) {
    return std::ranges::all_of(side.parts,
                               [&](const PartSide& part) { return exact_share(part, state) == 1; });
  };
  const auto whole = std::ranges::find_if(states, is_all);
  if (whole == states.end()) return;
  for (const LightState state : states) side.*exact_member(state) = state == *whole ? 1 : 0;
}

/// The shares of a polygon of several parts.
void sum_parts(const PreparedScene& scene, const PartWeights& weights, bool exact,
               ClassifiedSide& side) {
  std::vector<Interval> shares(side.parts.size());
  std::vector<mpq_class> exactly;
  if (exact && side.coplanar) exactly = exact_weights(scene, side.polygon);
  if (exact && !side.coplanar) set_exact_if_of_one_class(side);
  for (const LightState state : light_states(side.area_light)) {
    std::ranges::transform(side.parts, shares.begin(),
                           [&](const PartSide& part) { return share_of(part, state); });
    side.*share_member(state) = weights.sum(side.polygon, shares);
    if (exactly.empty()) continue;
    mpq_class sum = 0;
    for (std::size_t i = 0; i < exactly.size(); ++i) {
      sum += exactly[i] * exact_share(side.parts[i], state);
    }
    side.*exact_member(state) = std::move(sum);
  }
}

}  // namespace

std::span<const LightState> light_states(bool area_light) {
  static constexpr std::array kPoint{LightState::kLit, LightState::kShadow};
  static constexpr std::array kArea{LightState::kLit, LightState::kPenumbra, LightState::kUmbra};
  return area_light ? std::span<const LightState>(kArea) : std::span<const LightState>(kPoint);
}

const Interval& share_of(const Shares& shares, LightState state) {
  return shares.*share_member(state);
}

const std::optional<mpq_class>& exact_share_of(const ClassifiedSide& side, LightState state) {
  return side.*exact_member(state);
}

mpq_class exact_share(const PartSide& part, LightState state) {
  if (part.reason != ShadowReason::kNone) return share_of(part, state).lower == 1 ? 1 : 0;
  switch (state) {
    case LightState::kLit:
      return part.exact->lit;
    case LightState::kShadow:
      return part.exact->shadow;
    case LightState::kPenumbra:
      return part.exact->penumbra;
    case LightState::kUmbra:
      return part.exact->umbra;
  }
  return 0;
}

mpq_class precise_share(const PreparedScene& scene, const ClassifiedSide& side, LightState state) {
  const std::uint32_t first = scene.first_part[side.polygon];
  mpq_class sum = 0, total = 0;
  for (std::uint32_t i = 0; i < side.parts.size(); ++i) {
    const mpq_class area = precise_area(scene, scene.parts[first + i]);
    sum += area * exact_share(side.parts[i], state);
    total += area;
  }
  return sum / total;
}

Shares side_shares(const PreparedScene& scene, const LightResult& light, std::uint32_t polygon,
                   Side side, const PartWeights& weights) {
  const std::uint32_t first = scene.first_part[polygon], last = scene.first_part[polygon + 1];
  const bool area_light = scene.lights[light.light].has_area();
  if (last - first == 1) return part_side(light, area_light, first, side);
  std::vector<PartSide> parts;
  for (std::uint32_t part = first; part < last; ++part) {
    parts.push_back(part_side(light, area_light, part, side));
  }
  if (std::ranges::none_of(parts, &PartSide::sees)) return parts.front();
  Shares shares;
  std::vector<Interval> own(parts.size());
  for (const LightState state : light_states(area_light)) {
    std::ranges::transform(parts, own.begin(),
                           [&](const PartSide& part) { return share_of(part, state); });
    shares.*share_member(state) = weights.sum(polygon, own);
  }
  return shares;
}

std::vector<ClassifiedSide> polygon_sides(const PreparedScene& scene, const LightResult& light,
                                          std::uint32_t polygon, bool exact) {
  const bool several = scene.first_part[polygon + 1] - scene.first_part[polygon] > 1;
  return polygon_sides(scene, light, polygon, exact,
                       several ? PartWeights(scene, polygon) : PartWeights());
}

std::vector<ClassifiedSide> polygon_sides(const PreparedScene& scene, const LightResult& light,
                                          std::uint32_t polygon, bool exact,
                                          const PartWeights& weights) {
  const std::uint32_t first = scene.first_part[polygon], last = scene.first_part[polygon + 1];
  const bool area_light = scene.lights[light.light].has_area();
  std::vector<ClassifiedSide> sides;
  if (first == last) return sides;
  for (const Side side : {Side::kFront, Side::kBack}) {
    const auto sees = [&](const PartResult& result) {
      return result.reason == ShadowReason::kNone && result.side == side;
    };
    for (std::uint32_t part = first; part < last; ++part) {
      if (!std::ranges::any_of(results_of(light, part), sees)) continue;
      sides.emplace_back().side = side;
      break;
    }
  }
  if (sides.empty()) sides.emplace_back();

  const bool coplanar = is_coplanar(scene, polygon);
  for (ClassifiedSide& side : sides) {
    side.polygon = polygon;
    side.area_light = area_light;
    side.coplanar = coplanar;
    for (std::uint32_t part = first; part < last; ++part) {
      side.parts.push_back(part_side(light, area_light, part, side.side));
    }
    side.reason = side.parts.front().reason;
    for (const PartSide& part : side.parts) {
      if (part.reason != side.reason) side.reason = ShadowReason::kNone;
    }
    if (side.parts.size() == 1 || side.reason != ShadowReason::kNone) {
      const PartSide& part = side.parts.front();
      for (const LightState state : light_states(area_light)) {
        side.*share_member(state) = share_of(part, state);
        if (exact) side.*exact_member(state) = exact_share(part, state);
      }
    } else {
      sum_parts(scene, weights, exact, side);
    }
  }
  return sides;
}

std::vector<ClassifiedSide> classified_sides(const PreparedScene& scene, const LightResult& light,
                                             bool exact) {
  const PartWeights weights(scene);
  std::vector<ClassifiedSide> sides;
  for (std::uint32_t polygon = 0; polygon + 1 < scene.first_part.size(); ++polygon) {
    std::ranges::move(polygon_sides(scene, light, polygon, exact, weights),
                      std::back_inserter(sides));
  }
  return sides;
}

SidesByLight classified_sides(const PreparedScene& scene, const ShadowResult& result, bool exact) {
  SidesByLight sides;
  for (const LightResult& light : result.lights) {
    sides.push_back(classified_sides(scene, light, exact));
  }
  return sides;
}

Interval deep_umbra_share(const PreparedScene& scene, const LightResult& light,
                          const ClassifiedSide& side, std::span<const DeepUmbraBounds> bounds) {
  const std::uint32_t first = scene.first_part[side.polygon];
  Enclosure total{0, 0}, deep{0, 0};
  for (std::uint32_t i = 0; i < side.parts.size(); ++i) {
    const PartSide& part = side.parts[i];
    Interval fraction{1, 1};  // of what sees nothing of the light
    if (part.reason == ShadowReason::kNone) {
      fraction = bounds[static_cast<std::size_t>(part.result - light.parts.data())].fraction;
    }
    if (side.parts.size() == 1) return fraction;
    const Enclosure area = to_enclosure(comparable_area(scene, scene.parts[first + i]));
    total = total + area;
    deep = deep + area * to_enclosure(fraction);
  }
  if (total.lower <= 0) return {0, 1};
  const Interval share = to_interval(deep / total);
  return {std::max(share.lower, 0.0), std::min(share.upper, 1.0)};
}

std::vector<std::string> caster_ids(const Scene& scene, const PreparedScene& prepared,
                                    std::span<const std::uint32_t> parts) {
  std::vector<std::string> ids;
  for (const std::uint32_t part : parts) {
    const std::string& id = scene.polygons[prepared.parts[part].polygon].id;
    if (std::ranges::find(ids, id) == ids.end()) ids.push_back(id);
  }
  return ids;
}

std::string light_name(const Scene& scene, const PreparedScene& prepared,
                       const LightResult& light) {
  const std::string& id = scene.lights[prepared.lights[light.light].light].id;
  return light.piece == LightResult::kWhole ? id : id + "/" + std::to_string(light.piece);
}

FacingShare facing_share(const PreparedScene& scene, const LightResult& light) {
  FacingShare share;
  for (std::size_t polygon = 0; polygon + 1 < scene.first_part.size(); ++polygon) {
    const std::uint32_t first = scene.first_part[polygon], last = scene.first_part[polygon + 1];
    if (first == last) continue;
    bool faces = false, in_plane = true;
    for (std::uint32_t part = first; part < last; ++part) {
      for (const PartResult& result : results_of(light, part)) {
        faces = faces || result.reason == ShadowReason::kNone;
        in_plane = in_plane && result.reason == ShadowReason::kLightInPlane;
      }
    }
    ++(faces ? share.facing : in_plane ? share.in_plane : share.away);
  }
  return share;
}

}  // namespace gnomon::report
