// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnomon/oracle/witness_check.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <deque>
#include <ranges>

#include "gnomon/oracle/verdict.h"
#include "gnomon/result/claimed_pieces.h"
#include "gnomon/result/shared_claims.h"
#include "oracle/geometry/group_overlay.h"
#include "oracle/judge/share_check.h"
#include "oracle/judge/witness_checker.h"

namespace gnomon::oracle {

using space::area_along;

namespace {

bool all_loops_exact(const Claims& claims) {
  bool some = false, all = true;
  const auto look_at = [&](const ClaimedShape& shape) {
    some = true;
    all = all && shape.exact;
  };
  for (const ClaimedLight& light : claims.lights) {
    for (const ClaimedPolygon& polygon : light.polygons) {
      std::ranges::for_each(polygon.fragments, look_at);
    }
  }
  for (const auto* shared : {&claims.combined, &claims.overlay}) {
    if (!*shared) continue;
    for (const SharedPolygon& polygon : **shared) std::ranges::for_each(polygon.fragments, look_at);
  }
  return some && all;
}

}  // namespace

WitnessChecker::WitnessChecker(const Scene& scene, const PreparedScene& prepared,
                               const Claims& candidate, const WitnessOptions& options)
    : scene_(scene),
      prepared_(prepared),
      candidate_(candidate),
      options_(options),
      diagonal_(scene_diagonal(prepared)),
      width_(options.width.value_or(1e-9 * diagonal_)),
      exact_(options.strict || all_loops_exact(candidate)) {
  for (std::uint32_t i = 0; i < scene.polygons.size(); ++i) {
    polygon_index_.emplace(scene.polygons[i].id, i);
  }
}

void WitnessChecker::violation(const std::string& polygon, std::string text,
                               std::optional<std::uint64_t> fragment) {
  ++report_.violations;
  if (report_.findings.size() < options_.most) {
    report_.findings.push_back({light_id_, polygon, std::move(text), fragment, terms_.block});
  }
}

bool WitnessChecker::is_interrupted() const {
  return options_.interrupted && options_.interrupted->load(std::memory_order_relaxed);
}

bool WitnessChecker::stopped() {
  report_.interrupted = report_.interrupted || is_interrupted();
  return report_.interrupted;
}

bool WitnessChecker::is_told(LightState state) const {
  return !terms_.listed || std::ranges::find(*terms_.listed, state) != terms_.listed->end();
}

std::optional<WitnessChecker::ClassSet> WitnessChecker::left_out() const {
  ClassSet classes{};
  if (terms_.listed) {
    for (const LightState state :
         {LightState::kLit, LightState::kShadow, LightState::kPenumbra, LightState::kUmbra}) {
      const bool known =
          state == LightState::kLit || (state != LightState::kShadow) == light_->is_area();
      classes[static_cast<std::size_t>(state)] = known && !is_told(state);
    }
    return classes;
  }
  if (!terms_.background) return std::nullopt;
  classes[static_cast<std::size_t>(*terms_.background)] = true;
  return classes;
}

std::optional<WitnessChecker::ClassSet> WitnessChecker::classes_without_witness(
    LightState state) const {
  if (!is_told(state)) return left_out();
  if (terms_.block == Block::kLights) return std::nullopt;
  ClassSet own{};
  own[static_cast<std::size_t>(state)] = true;
  return own;
}

/// Umbra may be called penumbra where it is not claimed per caster.
bool WitnessChecker::is_wrong(LightState state, const ClassSet& allowed) const {
  if (allowed[static_cast<std::size_t>(state)]) return false;
  return !(state == LightState::kUmbra && !terms_.per_caster_umbra &&
           allowed[static_cast<std::size_t>(LightState::kPenumbra)]);
}

bool WitnessChecker::tiles(const Family& family) {
  // Shared fragments tile a side for all lights or for none.
  if (terms_.block == Block::kLights) return true;
  const std::uint32_t part = family.parts.front();
  return light_->sees(part, family.polygon.side) &&
         tiled_.emplace(part, family.polygon.side).second;
}

bool WitnessChecker::is_facing(std::uint32_t part, Side side) const {
  const LightStanding& own = light_->standing(part);
  return own.receives && (own.facing > 0) == (side == Side::kFront);
}

bool WitnessChecker::shadow_reason_holds(std::uint32_t part, Side side,
                                         const ClaimedFragment& fragment) const {
  const int facing = light_->standing(part).facing;
  const auto reason = shadow_reason_by_name(fragment.reason);
  return (reason == ShadowReason::kFacesAway && !is_facing(part, side) && facing != 0) ||
         (reason == ShadowReason::kLightInPlane && facing == 0) ||
         (reason == ShadowReason::kOutsideRegion && is_facing(part, side) &&
          !(area_along(light_->solid(part).normal, light_->inside_region(fragment.loop)) > 0));
}

bool WitnessChecker::area_reason_holds(const Family& family, const ClaimedFragment& fragment,
                                       bool behind) {
  if (fragment.state != LightState::kUmbra) return false;
  const std::uint32_t part = family.parts.front();
  switch (shadow_reason_by_name(fragment.reason).value_or(ShadowReason::kNone)) {
    case ShadowReason::kBehindLight:
      return behind;
    case ShadowReason::kFacesAway:
      return light_->area().faces_away(part, family.polygon.side);
    case ShadowReason::kLightInPlane:
      return light_->area().light_in_plane(part);
    case ShadowReason::kOutsideRegion:  // point and directional lights alone have one
    case ShadowReason::kNone:
      break;
  }
  return false;
}

std::optional<std::uint32_t> WitnessChecker::caster_to_check(const Family& family,
                                                             const ClaimedFragment& fragment,
                                                             std::size_t index) {
  ++report_.witnesses;
  const std::string& id = family.polygon.id;
  if (!fragment.reason.empty()) {
    if (!shadow_reason_holds(family.parts.front(), family.polygon.side, fragment) &&
        !is_outside_but_for_rounding(family, fragment)) {
      violation(id, fmt::format("the reason '{}' does not hold", fragment.reason), index);
    }
    return std::nullopt;
  }
  if (fragment.caster.empty()) {
    if (is_facing(family)) violation(id, "a shadow fragment names no caster", index);
    return std::nullopt;
  }
  return named_caster(family.polygon, index);
}

std::optional<std::uint32_t> WitnessChecker::named_caster(const ClaimedPolygon& polygon,
                                                          std::size_t index) {
  const std::string& name = polygon.fragments[index].caster;
  const auto caster = polygon_index_.find(name);
  if (caster != polygon_index_.end()) return caster->second;
  violation(polygon.id, fmt::format("no caster '{}' in the scene", name), index);
  return std::nullopt;
}

std::vector<std::uint32_t> WitnessChecker::named_casters(const ClaimedPolygon& polygon,
                                                         std::size_t index) {
  std::vector<std::uint32_t> casters;
  for (const std::string& name : polygon.fragments[index].casters) {
    const auto caster = polygon_index_.find(name);
    if (caster == polygon_index_.end()) {
      violation(polygon.id, fmt::format("no caster '{}' in the scene", name), index);
      return {};
    }
    casters.push_back(caster->second);
  }
  return casters;
}

bool WitnessChecker::has_all_parts(const Family& family) const {
  const std::uint32_t index = prepared_.parts[family.parts.front()].polygon;
  return family.parts.size() == prepared_.first_part[index + 1] - prepared_.first_part[index];
}

/// A polygon is listed once for each side that some part of it sees the light from, or with its
/// front.
std::vector<Side> WitnessChecker::listed_sides(std::uint32_t polygon) const {
  std::vector<Side> sides;
  for (const Side side : {Side::kFront, Side::kBack}) {
    for (std::uint32_t part = prepared_.first_part[polygon];
         part < prepared_.first_part[polygon + 1]; ++part) {
      if (!light_->sees(part, side)) continue;
      sides.push_back(side);
      break;
    }
  }
  if (sides.empty()) sides.push_back(Side::kFront);
  return sides;
}

/// All of the polygon's parts by plane. Planes that see the light from the other side alone may be
/// listed here, as dark; what sees nothing belongs to the first side listed.
WitnessChecker::Families WitnessChecker::families_on(std::uint32_t polygon, Side side,
                                                     std::set<PlaneId>& optional) const {
  Families families;
  for (std::uint32_t part = prepared_.first_part[polygon]; part < prepared_.first_part[polygon + 1];
       ++part) {
    families[prepared_.parts[part].plane].push_back(part);
  }
  const Side first = listed_sides(polygon).front();
  for (const auto& [plane, parts] : families) {
    const auto seen_from = [&, &family = parts](Side from) {
      return std::any_of(family.begin(), family.end(),
                         [&](std::uint32_t part) { return light_->sees(part, from); });
    };
    const bool dark = !seen_from(Side::kFront) && !seen_from(Side::kBack);
    if (!seen_from(side) && !(dark && side == first)) optional.insert(plane);
  }
  return families;
}

bool WitnessChecker::can_be_judged(const ClaimedPolygon& polygon, std::size_t index) {
  const ClaimedFragment& fragment = polygon.fragments[index];
  ++report_.fragments;
  if (fragment.exact) ++report_.exact_fragments;
  const bool area = light_->is_area();
  if (fragment.state != LightState::kLit && (fragment.state == LightState::kShadow) == area) {
    violation(polygon.id,
              area ? "a class that an area light does not have"
                   : "a class that a point light does not have",
              index);
    return false;
  }
  if (fragment.loop.size() < 3) {
    violation(polygon.id, "a fragment has fewer than three vertices", index);
    return false;
  }
  for (const RationalLoop& hole : fragment.holes) {
    if (hole.size() >= 3) continue;
    violation(polygon.id, "a hole of a fragment has fewer than three vertices", index);
    return false;
  }
  return true;
}

bool WitnessChecker::is_exact(const ClaimedPolygon& polygon) const {
  return exact_ || (!polygon.fragments.empty() &&
                    std::ranges::all_of(polygon.fragments,
                                        [](const ClaimedFragment& own) { return own.exact; }));
}

void WitnessChecker::check_polygon(const ClaimedPolygon& polygon) {
  ++report_.polygons;
  const auto known = polygon_index_.find(polygon.id);
  if (known == polygon_index_.end()) {
    return violation(polygon.id, "no such polygon in the scene");
  }
  if (terms_.shares_alone) return check_share(polygon, known->second);
  std::set<PlaneId> optional;
  const Families families = families_on(known->second, polygon.side, optional);
  is_exact(polygon) ? check_exact_side(polygon, families, optional)
                    : check_rounded_side(polygon, families, optional);
}

void WitnessChecker::check_share(const ClaimedPolygon& polygon, std::uint32_t index) {
  std::map<PlaneId, std::vector<std::uint32_t>> families;
  for (std::uint32_t part = prepared_.first_part[index]; part < prepared_.first_part[index + 1];
       ++part) {
    families[prepared_.parts[part].plane].push_back(part);
  }
  std::vector<std::vector<std::uint32_t>> groups;
  for (const auto& [plane, parts] : families) groups.push_back(parts);
  const std::vector<Enclosure> weights = areas_in_ratio(prepared_, groups);
  ShareSum lit, shadow;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const std::vector<std::uint32_t>& parts = groups[g];
    std::array<mpq_class, 2> areas;  // lit, dark
    for (const std::uint32_t part : parts) {
      const Solid& solid = light_->solid(part);
      const Piece piece(part, solid.loop, solid.normal);
      const mpq_class lit_area =
          light_->areas_of_classes(piece, polygon.side)[static_cast<std::size_t>(LightState::kLit)];
      // Areas of parts compare along one normal.
      const mpq_class share = lit_area / piece.area;
      const mpq_class whole = area_along(light_->solid(parts.front()).normal, solid.loop);
      areas[0] += share * whole;
      areas[1] += (1 - share) * whole;
    }
    const mpq_class sum = areas[0] + areas[1];
    const Enclosure whole = weights[g];
    const auto add = [&](ShareSum& total, const mpq_class& area) {
      const mpq_class share = area / sum;
      total.add({enclose(share), enclose(share) * whole, share, area == 0}, whole);
    };
    add(lit, areas[0]);
    add(shadow, areas[1]);
  }
  ++report_.witnesses;
  const ShareError error = share_error(polygon, lit.result(), shadow.result());
  if (error.wrong.zero) return;
  if (!polygon.lit_fraction && error.wrong.fraction.upper <= options_.tolerance) return;
  violation(polygon.id, error.text);
}

/// Of an overlay, and where there is a background, what is not listed is background.
void WitnessChecker::check_missing(const std::set<std::string>& polygons,
                                   const std::set<std::pair<std::string, Side>>& sides) {
  for (std::uint32_t p = 0; p < scene_.polygons.size(); ++p) {
    if (prepared_.first_part[p] == prepared_.first_part[p + 1]) continue;
    const std::string& id = scene_.polygons[p].id;
    if (terms_.block == Block::kLights && !terms_.background && !polygons.contains(id)) {
      violation(id, "the polygon is missing");
      continue;
    }
    for (const Side side : listed_sides(p)) {
      if (sides.contains({id, side})) continue;
      const auto part = prepared_.first_part[p];
      const bool reached =
          std::ranges::any_of(std::views::iota(part, prepared_.first_part[p + 1]),
                              [&](std::uint32_t own) { return light_->sees(own, side); });
      if (terms_.background) {
        ClaimedPolygon nothing;
        nothing.id = id;
        nothing.side = side;
        check_polygon(nothing);
      } else if (reached || (terms_.block == Block::kLights && light_->is_area())) {
        violation(id, fmt::format("its {} is missing", name_of(side)));
      }
    }
  }
}

void WitnessChecker::check_light(const ClaimedLight& light) {
  const PreparedLight* own = nullptr;
  for (const PreparedLight& prepared : prepared_.lights) {
    if (scene_.lights[prepared.light].id == light.id) own = &prepared;
  }
  if (!own) return violation({}, "no such light in the scene");
  light_.emplace(prepared_, *own, diagonal_);
  std::set<std::string> polygons;
  std::set<std::pair<std::string, Side>> sides;
  std::deque<ClaimedPolygon> turned;
  std::vector<const ClaimedPolygon*> judged;
  for (const ClaimedPolygon& polygon : light.polygons) {
    polygons.insert(polygon.id);
    judged.push_back(&polygon);
    // A foreign file that names no side means the only one.
    const auto known = polygon_index_.find(polygon.id);
    if (!polygon.side_given && known != polygon_index_.end()) {
      const std::vector<Side> listed_on = listed_sides(known->second);
      if (listed_on.size() == 1 && listed_on[0] != polygon.side) {
        judged.back() = &turned.emplace_back(polygon);
        turned.back().side = listed_on[0];
      }
    }
  }
  check_polygons(judged, sides);
  if (stopped()) return;
  if (!options_.subset || terms_.background) check_missing(polygons, sides);
}

/// What holds is proved side by side; what is not proved is then looked at in its order.
void WitnessChecker::check_polygons(const std::vector<const ClaimedPolygon*>& polygons,
                                    std::set<std::pair<std::string, Side>>& sides) {
  std::vector<char> proved(polygons.size());
  tbb::parallel_for(std::size_t{0}, polygons.size(), [&](std::size_t i) {
    if (is_interrupted() || !options_.by_integers || !is_exact(*polygons[i])) return;
    proved[i] = is_proved(*polygons[i]) ? 1 : 0;
    if (proved[i] != 0) tell_progress();
  });
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    if (stopped()) return;
    const ClaimedPolygon& judged = *polygons[i];
    if (!sides.emplace(judged.id, judged.side).second) {
      violation(judged.id, fmt::format("its {} is listed twice", name_of(judged.side)));
    }
    if (proved[i] != 0) {
      count_proved(judged);
    } else {
      check_polygon(judged);
      tell_progress();
    }
  }
}

void WitnessChecker::tell_progress() {
  if (!options_.progress) return;
  options_.progress(static_cast<double>(++polygons_done_) / static_cast<double>(polygons_));
}

void WitnessChecker::check_claims(const Claims& claims, Block block) {
  light_id_.clear();
  terms_ = {};
  terms_.block = block;
  for (const std::string& problem : claims.problems) violation({}, problem);
  std::set<std::string> listed;
  for (const ClaimedLight& light : claims.lights) {
    if (stopped()) return;
    light_id_ = light.id;
    terms_ = light;
    listed.insert(light.id);
    check_light(light);
  }
  if (block != Block::kLights || options_.subset) return;
  terms_ = {};
  for (const PreparedLight& light : prepared_.lights) {
    const std::string& id = scene_.lights[light.light].id;
    if (listed.contains(id)) continue;
    light_id_ = id;
    violation({}, "the light is missing");
  }
}

WitnessReport WitnessChecker::run(const std::vector<std::string>& problems) {
  for (const std::string& problem : problems) violation({}, problem);
  const std::vector<Claims> shared = shared_claims(candidate_, scene_);
  const auto count = [&](const Claims& claims) {
    for (const ClaimedLight& light : claims.lights) polygons_ += light.polygons.size();
  };
  count(candidate_);
  for (const Claims& block : shared) count(block);
  if (!candidate_.lights.empty() || shared.empty()) check_claims(candidate_, Block::kLights);
  for (const Claims& block : shared) {
    tiled_.clear();
    check_claims(block, block.lights.empty() ? Block::kCombined : block.lights.front().block);
  }
  return std::move(report_);
}

WitnessReport check_witnesses(const Scene& scene, const PreparedScene& prepared,
                              const Claims& candidate, const WitnessOptions& options) {
  if (!has_pieces(candidate)) return WitnessChecker(scene, prepared, candidate, options).run();
  const auto pieces = scene_of_pieces(scene, prepared, candidate);
  if (pieces) {
    return WitnessChecker(pieces->scene, pieces->prepared, candidate, options).run(pieces->gaps);
  }
  WitnessReport report;
  report.violations = 1;
  report.findings.push_back({{}, {}, pieces.error().what, {}, Block::kLights});
  return report;
}

}  // namespace gnomon::oracle
