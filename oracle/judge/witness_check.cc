// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnomon/oracle/witness_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <ranges>
#include <set>

#include "gnomon/oracle/compare.h"
#include "gnomon/oracle/verdict.h"
#include "gnomon/result/claimed_pieces.h"
#include "gnomon/result/shared_claims.h"
#include "oracle/geometry/group_overlay.h"
#include "oracle/geometry/space_loop.h"
#include "oracle/judge/light_volumes.h"
#include "oracle/judge/share_check.h"
#include "oracle/judge/witness_pieces.h"

namespace gnomon::oracle {

namespace {

using space::area_along;
using space::cross;
using space::cut;
using space::dot;
using space::HalfSpace;
using space::Loop;
using space::minus;

class WitnessChecker {
 public:
  WitnessChecker(const Scene& scene, const PreparedScene& prepared, const Claims& candidate,
                 const WitnessOptions& options)
      : scene_(scene),
        prepared_(prepared),
        candidate_(candidate),
        options_(options),
        tolerance_(options.tolerance) {
    diagonal_ = scene_diagonal(prepared);
    width_ = mpq_class(options.width.value_or(1e-9 * diagonal_));
    for (std::uint32_t i = 0; i < scene.polygons.size(); ++i) {
      polygon_index_.emplace(scene.polygons[i].id, i);
    }
  }

  /// `problems`: that are known of the candidate.
  WitnessReport run(const std::vector<std::string>& problems = {});

 private:
  void violation(const std::string& polygon, std::string text,
                 std::optional<std::uint64_t> fragment = {}) {
    ++report_.violations;
    if (report_.findings.size() < options_.most) {
      report_.findings.push_back({light_id_, polygon, std::move(text), fragment, terms_.block});
    }
  }
  /// Parts whose plane a result lists on this side, by family; and others it may list there.
  std::map<PlaneId, std::vector<std::uint32_t>> families_on(std::uint32_t polygon, Side side,
                                                            std::set<PlaneId>& optional) const;
  std::vector<Side> listed_sides(std::uint32_t polygon) const;
  void check_polygon(const ClaimedPolygon& polygon);
  /// Of a polygon without fragments.
  void check_share(const ClaimedPolygon& polygon, std::uint32_t index);
  using Families = std::map<PlaneId, std::vector<std::uint32_t>>;
  /// The family whose plane a fragment is nearest to.
  struct Nearest {
    const std::vector<std::uint32_t>* parts = nullptr;  // none if there are no families
    PlaneId plane = 0;
    mpq_class distance;   // squared
    bool around = false;  // a part of it is around the fragment's middle
  };
  Nearest nearest_family(const ClaimedFragment& fragment, const Families& families) const;
  Nearest distance_to(const ClaimedFragment& fragment, PlaneId plane,
                      const std::vector<std::uint32_t>& parts) const;
  mpq_class allowed_distance(const ClaimedFragment& fragment) const {
    return fragment.exact ? mpq_class(0) : mpq_class(width_ * width_);
  }
  /// A fragment in convex pieces; none, with the violation told, if it cannot be judged.
  std::vector<Piece> pieces_of(const ClaimedPolygon& polygon, std::size_t index,
                               const Nearest& family);
  void check_family(const ClaimedPolygon& polygon, const std::vector<std::uint32_t>& parts,
                    std::vector<Piece>& pieces);
  void check_shade(const ClaimedPolygon& polygon, const Piece& piece, const mpq_class& slack);
  void check_lit(const ClaimedPolygon& polygon, const Piece& piece, const mpq_class& slack);
  /// `rest`: the area that no piece covers.
  void check_fractions(const ClaimedPolygon& polygon, const std::vector<Piece>& pieces,
                       const mpq_class& rest, const std::vector<std::uint32_t>& parts);
  void check_area_shade(const ClaimedPolygon& polygon, const Piece& piece, const mpq_class& slack);
  /// False, with the violation told, if a fragment that is not umbra sees less than it claims.
  bool is_seen(const ClaimedPolygon& polygon, const Piece& piece, const mpq_class& slack);
  bool area_reason_holds(const ClaimedPolygon& polygon, const Piece& piece, bool behind);
  /// The caster that a fragment names; none, with the violation told, if the scene has none such.
  std::optional<std::uint32_t> named_caster(const ClaimedPolygon& polygon, const Piece& piece);
  using ClassSet = std::array<bool, 4>;  // by LightState
  /// The classes that what no fragment covers may have; nothing if fragments must cover everything.
  std::optional<ClassSet> left_out() const;
  bool is_told(LightState state) const {
    return !terms_.listed || std::ranges::find(*terms_.listed, state) != terms_.listed->end();
  }
  /// Of a piece without a witness: that every point of it has one of the classes.
  void check_classes(const ClaimedPolygon& polygon, const Piece& piece, const ClassSet& allowed,
                     const mpq_class& slack);
  void check_piece(const ClaimedPolygon& polygon, const Piece& piece, const mpq_class& slack);
  void check_tiling(const ClaimedPolygon& polygon, const std::vector<std::uint32_t>& parts,
                    std::vector<Piece>& pieces, const mpq_class& slack);
  void check_overlaps(const ClaimedPolygon& polygon, const RationalPoint& normal,
                      std::vector<Piece>& pieces, const mpq_class& slack);
  /// Lights, polygons and sides that are not there.
  void check_claims(const Claims& claims, Block block);
  void check_light(const ClaimedLight& light);
  void check_missing(const std::set<std::string>& polygons,
                     const std::set<std::pair<std::string, Side>>& sides);
  bool stopped() {
    report_.interrupted =
        report_.interrupted ||
        (options_.interrupted && options_.interrupted->load(std::memory_order_relaxed));
    return report_.interrupted;
  }
  const std::string& id_of(std::uint32_t part) const {
    return scene_.polygons[prepared_.parts[part].polygon].id;
  }
  const Scene& scene_;
  const PreparedScene& prepared_;
  const Claims& candidate_;
  const WitnessOptions& options_;
  mpq_class tolerance_, width_;
  double diagonal_ = 0;
  std::map<std::string, std::uint32_t> polygon_index_;
  std::string light_id_;
  std::optional<LightVolumes> light_;
  ClaimedTerms terms_;  // of the light
  // First part and side of the families whose tiling by shared fragments is judged: once each.
  std::set<std::pair<std::uint32_t, Side>> tiled_;
  std::size_t polygons_ = 0, polygons_done_ = 0;  // for the progress
  WitnessReport report_;
};

bool WitnessChecker::is_seen(const ClaimedPolygon& polygon, const Piece& piece,
                             const mpq_class& slack) {
  const RationalPoint& normal = light_->solid(piece.part).normal;
  const bool lit = piece.fragment->state == LightState::kLit;
  const std::string name = name_of(piece.fragment->state);
  const auto told = [&](std::string text) {
    violation(polygon.id, std::move(text), piece.index);
    return false;
  };
  if (!light_->sees(piece.part, polygon.side)) {
    return told(fmt::format("a fragment is {} on a side that sees nothing of the light", name));
  }
  if (area_along(normal, cut(piece.loop, light_->area().behind_light())) > slack) {
    return told(fmt::format("a {} fragment reaches behind the light", name));
  }
  for (std::size_t b = 0; b < light_->area().size() && (lit || terms_.per_caster_umbra); ++b) {
    if (light_->area().part_of(b) == piece.part) continue;
    if (light_->is_apart(piece, light_->area().largest_penumbra(b).bounds)) continue;
    const AreaSolids::Volume& volume = lit ? light_->area().penumbra(b, piece.part, polygon.side)
                                           : light_->area().umbra(b, piece.part, polygon.side);
    if (!(area_along(normal, light_->inside(piece, volume, !lit)) > slack)) continue;
    const std::string& caster = id_of(light_->area().part_of(b));
    return told(lit ? fmt::format("a lit fragment is in the penumbra of '{}'", caster)
                    : fmt::format("a penumbra fragment is in the umbra of '{}'", caster));
  }
  return true;
}

bool WitnessChecker::area_reason_holds(const ClaimedPolygon& polygon, const Piece& piece,
                                       bool behind) {
  if (piece.fragment->state != LightState::kUmbra) return false;
  switch (shadow_reason_by_name(piece.fragment->reason).value_or(ShadowReason::kNone)) {
    case ShadowReason::kBehindLight:
      return behind;
    case ShadowReason::kFacesAway:
      return light_->area().faces_away(piece.part, polygon.side);
    case ShadowReason::kLightInPlane:
      return light_->area().light_in_plane(piece.part);
    case ShadowReason::kNone:
      break;
  }
  return false;
}

std::optional<std::uint32_t> WitnessChecker::named_caster(const ClaimedPolygon& polygon,
                                                          const Piece& piece) {
  const auto caster = polygon_index_.find(piece.fragment->caster);
  if (caster != polygon_index_.end()) return caster->second;
  violation(polygon.id, fmt::format("no caster '{}' in the scene", piece.fragment->caster),
            piece.index);
  return std::nullopt;
}

void WitnessChecker::check_area_shade(const ClaimedPolygon& polygon, const Piece& piece,
                                      const mpq_class& slack) {
  const ClaimedFragment& fragment = *piece.fragment;
  const bool all = fragment.state == LightState::kUmbra;
  if (!all && !is_seen(polygon, piece, slack)) return;
  if (fragment.state == LightState::kLit) return;
  ++report_.witnesses;
  const bool sees = light_->sees(piece.part, polygon.side);
  const mpq_class behind =
      area_along(light_->solid(piece.part).normal, cut(piece.loop, light_->area().behind_light()));
  const mpq_class before = sees ? mpq_class(piece.area - behind) : mpq_class(0);
  if (!fragment.reason.empty()) {
    if (area_reason_holds(polygon, piece, before <= slack)) return;
    return violation(polygon.id, fmt::format("the reason '{}' does not hold", fragment.reason),
                     piece.index);
  }
  if (fragment.caster.empty()) {
    if (before > slack) {
      violation(
          polygon.id,
          fmt::format("{} {} fragment names no caster", all ? "an" : "a", name_of(fragment.state)),
          piece.index);
    }
    return;
  }
  const std::optional<std::uint32_t> caster = named_caster(polygon, piece);
  if (caster && sees &&
      area_along(light_->solid(piece.part).normal,
                 light_->not_hidden(piece, light_->before_light(piece), *caster, polygon.side,
                                    all)) > slack) {
    violation(polygon.id,
              fmt::format("'{}' does not hide {} of the light from all of the fragment",
                          fragment.caster, all ? "all" : "part"),
              piece.index);
  }
}

void WitnessChecker::check_lit(const ClaimedPolygon& polygon, const Piece& piece,
                               const mpq_class& slack) {
  for (std::uint32_t part = 0; part < light_->solids().size(); ++part) {
    if (!light_->solid(part).casts || light_->is_apart(piece, light_->solid(part).shadow)) continue;
    if (light_->shadowed_by(piece, part) > slack) {
      return violation(polygon.id, fmt::format("a lit fragment is shadowed by '{}'", id_of(part)),
                       piece.index);
    }
  }
}

void WitnessChecker::check_shade(const ClaimedPolygon& polygon, const Piece& piece,
                                 const mpq_class& slack) {
  const ClaimedFragment& fragment = *piece.fragment;
  const Solid& own = light_->solid(piece.part);
  const bool faces = own.receives && (own.facing > 0) == (polygon.side == Side::kFront);
  if (fragment.state == LightState::kLit) {
    if (faces) return check_lit(polygon, piece, slack);
    return violation(polygon.id, "a fragment is lit on a side that does not face the light",
                     piece.index);
  }
  ++report_.witnesses;
  if (!fragment.reason.empty()) {
    const auto reason = shadow_reason_by_name(fragment.reason);
    const bool holds = (reason == ShadowReason::kFacesAway && !faces && own.facing != 0) ||
                       (reason == ShadowReason::kLightInPlane && own.facing == 0);
    if (!holds) {
      violation(polygon.id, fmt::format("the reason '{}' does not hold", fragment.reason),
                piece.index);
    }
    return;
  }
  if (fragment.caster.empty()) {
    if (faces) violation(polygon.id, "a shadow fragment names no caster", piece.index);
    return;
  }
  const std::optional<std::uint32_t> caster = named_caster(polygon, piece);
  if (caster && area_along(own.normal, light_->not_shadowed(piece, *caster)) > slack) {
    violation(polygon.id, fmt::format("'{}' does not shadow all of the fragment", fragment.caster),
              piece.index);
  }
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

void WitnessChecker::check_classes(const ClaimedPolygon& polygon, const Piece& piece,
                                   const ClassSet& allowed, const mpq_class& slack) {
  const std::array<mpq_class, 4> areas = light_->areas_of_classes(piece, polygon.side);
  // Umbra may be called penumbra where it is not claimed per caster.
  const bool umbra_is_penumbra =
      !terms_.per_caster_umbra && allowed[static_cast<std::size_t>(LightState::kPenumbra)];
  for (std::size_t c = 0; c < areas.size(); ++c) {
    const auto state = static_cast<LightState>(c);
    if (allowed[c] || (state == LightState::kUmbra && umbra_is_penumbra)) continue;
    if (!(areas[c] > slack)) continue;
    const std::string what = piece.fragment
                                 ? fmt::format("a {} fragment", name_of(piece.fragment->state))
                                 : std::string("what no fragment covers");
    violation(polygon.id, fmt::format("some of {} is {}", what, name_of(state)),
              piece.fragment ? std::optional<std::uint64_t>(piece.index) : std::nullopt);
    return;
  }
}

void WitnessChecker::check_piece(const ClaimedPolygon& polygon, const Piece& piece,
                                 const mpq_class& slack) {
  const LightState state = piece.fragment->state;
  if (!is_told(state)) return check_classes(polygon, piece, *left_out(), slack);
  if (terms_.block != Block::kLights) {
    ClassSet own{};
    own[static_cast<std::size_t>(state)] = true;
    return check_classes(polygon, piece, own, slack);
  }
  light_->is_area() ? check_area_shade(polygon, piece, slack) : check_shade(polygon, piece, slack);
}

/// Pairs, swept along x. Of an overlay only those that say different things of one level.
void WitnessChecker::check_overlaps(const ClaimedPolygon& polygon, const RationalPoint& normal,
                                    std::vector<Piece>& pieces, const mpq_class& slack) {
  std::ranges::sort(pieces, {}, [](const Piece& piece) { return piece.low[0]; });
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const ClaimedFragment& own = *pieces[i].fragment;
    for (std::size_t j = i + 1; j < pieces.size() && pieces[j].low[0] <= pieces[i].high[0]; ++j) {
      const ClaimedFragment& other = *pieces[j].fragment;
      if (&own == &other || !pieces[i].overlaps_box_of(pieces[j])) continue;
      if (terms_.cover == Cover::kOverlay &&
          (own.level != other.level || own.state == other.state)) {
        continue;
      }
      Loop rest = pieces[i].loop;
      for (const HalfSpace& wall : pieces[j].walls_of(normal)) {
        rest = cut(rest, wall);
        if (rest.empty()) break;
      }
      if (rest.empty() ||
          !(area_along(normal, rest) > (own.exact && other.exact ? mpq_class(0) : slack))) {
        continue;
      }
      violation(polygon.id, fmt::format("the fragment overlaps fragment {}", pieces[j].index),
                pieces[i].index);
    }
  }
}

/// `slack`: of rounded loops.
void WitnessChecker::check_tiling(const ClaimedPolygon& polygon,
                                  const std::vector<std::uint32_t>& parts,
                                  std::vector<Piece>& pieces, const mpq_class& slack) {
  const RationalPoint& normal = light_->solid(parts.front()).normal;
  mpq_class whole, sum;
  bool exact = true;
  for (std::uint32_t part : parts) whole += area_along(normal, light_->solid(part).loop);
  for (Piece& piece : pieces) {
    exact = exact && piece.fragment->exact;
    sum += piece.area;
    mpq_class inside;
    for (std::uint32_t part : parts) {
      Loop rest = piece.loop;
      for (const HalfSpace& wall : light_->solid(part).walls) {
        if (!rest.empty()) rest = cut(rest, wall);
      }
      if (!rest.empty()) inside += area_along(normal, rest);
    }
    if (abs(mpq_class(piece.area - inside)) > (piece.fragment->exact ? mpq_class(0) : slack)) {
      violation(polygon.id, "a fragment leaves the polygon", piece.index);
    }
  }
  if (!left_out() && abs(mpq_class(whole - sum)) > (exact ? mpq_class(0) : slack)) {
    violation(polygon.id, "the fragments' areas do not add up to the polygon's");
  }
}

void WitnessChecker::check_family(const ClaimedPolygon& polygon,
                                  const std::vector<std::uint32_t>& parts,
                                  std::vector<Piece>& pieces) {
  const bool reached = light_->sees(parts.front(), polygon.side);
  if (terms_.block == Block::kOverlay && !reached) return;
  const RationalPoint& normal = light_->solid(parts.front()).normal;
  mpq_class whole;
  for (std::uint32_t part : parts) whole += area_along(normal, light_->solid(part).loop);
  const mpq_class slack = tolerance_ * whole;
  // Shared fragments tile a side for all lights or for none.
  const bool tiles = terms_.block == Block::kLights ||
                     (reached && tiled_.emplace(parts.front(), polygon.side).second);
  if (tiles) check_tiling(polygon, parts, pieces, slack);
  // Loops of one level may overlap under one of a higher level.
  if (terms_.cover == Cover::kOverlay) pieces = cut_to_visible(std::move(pieces), normal);
  if (tiles) check_overlaps(polygon, normal, pieces, slack);
  bool exact = true;
  for (const Piece& piece : pieces) {
    exact = exact && piece.fragment->exact;
    check_piece(polygon, piece, piece.fragment->exact ? mpq_class(0) : slack);
  }
  mpq_class rest_area;
  if (const std::optional<ClassSet> allowed = left_out()) {
    for (const Piece& rest : left_over(parts, light_->solids(), pieces)) {
      rest_area += rest.area;
      check_classes(polygon, rest, *allowed, exact ? mpq_class(0) : slack);
    }
  }
  check_fractions(polygon, pieces, rest_area, parts);
}

void WitnessChecker::check_fractions(const ClaimedPolygon& polygon,
                                     const std::vector<Piece>& pieces, const mpq_class& rest,
                                     const std::vector<std::uint32_t>& parts) {
  if (!polygon.lit_fraction && !polygon.shadow_fraction && !polygon.penumbra_fraction &&
      !polygon.umbra_fraction) {
    return;
  }
  const std::uint32_t index = prepared_.parts[parts.front()].polygon;
  if (parts.size() != prepared_.first_part[index + 1] - prepared_.first_part[index]) return;
  std::array<mpq_class, 4> areas;  // by LightState
  if (terms_.background) areas[static_cast<std::size_t>(*terms_.background)] = rest;
  bool exact = true;
  for (const Piece& piece : pieces) {
    areas[static_cast<std::size_t>(piece.fragment->state)] += piece.area;
    exact = exact && piece.fragment->exact;
  }
  mpq_class whole;
  for (std::uint32_t part : parts) {
    whole += area_along(light_->solid(parts.front()).normal, light_->solid(part).loop);
  }
  const mpq_class slack = exact ? mpq_class(0) : tolerance_;
  const auto claim = [&](const std::optional<mpq_class>& claimed, LightState shade) {
    const mpq_class& area = areas[static_cast<std::size_t>(shade)];
    const char* name = name_of(shade);
    if (claimed && is_told(shade) && abs(mpq_class(*claimed - area / whole)) > slack) {
      violation(polygon.id,
                fmt::format("the {} fraction is claimed as {}, but the fragments say {}", name,
                            claimed->get_str(), mpq_class(area / whole).get_str()));
    }
  };
  claim(polygon.lit_fraction, LightState::kLit);
  claim(polygon.shadow_fraction, LightState::kShadow);
  claim(polygon.penumbra_fraction, LightState::kPenumbra);
  claim(polygon.umbra_fraction, LightState::kUmbra);
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
std::map<PlaneId, std::vector<std::uint32_t>> WitnessChecker::families_on(
    std::uint32_t polygon, Side side, std::set<PlaneId>& optional) const {
  std::map<PlaneId, std::vector<std::uint32_t>> families;
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

WitnessChecker::Nearest WitnessChecker::distance_to(const ClaimedFragment& fragment, PlaneId plane,
                                                    const std::vector<std::uint32_t>& parts) const {
  const Solid& solid = light_->solid(parts.front());
  Nearest own{&parts, plane, 0, false};
  RationalPoint centre;
  for (const RationalPoint& point : fragment.loop) {
    const mpq_class height = dot(solid.normal, minus(point, solid.loop[0]));
    own.distance = std::max(own.distance, mpq_class(height * height));
    for (int k = 0; k < 3; ++k) centre[k] += point[k] / mpq_class(fragment.loop.size());
  }
  own.distance /= dot(solid.normal, solid.normal);
  own.around = std::ranges::any_of(parts, [&](std::uint32_t part) {
    return std::ranges::all_of(light_->solid(part).walls,
                               [&](const HalfSpace& wall) { return wall.value(centre) >= 0; });
  });
  return own;
}

/// By squared distances; among planes that are near enough, one with a part around the fragment's
/// middle.
WitnessChecker::Nearest WitnessChecker::nearest_family(const ClaimedFragment& fragment,
                                                       const Families& families) const {
  const mpq_class allowed = allowed_distance(fragment);
  Nearest best;
  for (const auto& [plane, parts] : families) {
    Nearest own = distance_to(fragment, plane, parts);
    const bool near = own.distance <= allowed, best_near = best.parts && best.distance <= allowed;
    const bool better =
        !best.parts || (near && !best_near) || (near == best_near && own.around && !best.around) ||
        (near == best_near && own.around == best.around && own.distance < best.distance);
    if (better) best = std::move(own);
  }
  return best;
}

std::vector<Piece> WitnessChecker::pieces_of(const ClaimedPolygon& polygon, std::size_t index,
                                             const Nearest& family) {
  const ClaimedFragment& fragment = polygon.fragments[index];
  const auto told = [&](const char* text) {
    violation(polygon.id, text, index);
    return std::vector<Piece>();
  };
  if (!family.parts) return told("nothing of the polygon is classified on this side");
  if (family.distance > allowed_distance(fragment)) {
    return told("a fragment does not lie in the polygon's plane");
  }
  const std::uint32_t part = family.parts->front();
  const Solid& solid = light_->solid(part);
  const bool in_plane = family.distance == 0;
  Piece piece(fragment, index, part, solid, in_plane);
  if (fragment.exact && !piece.is_convex(solid.normal)) return told("a fragment is not convex");
  if (fragment.holes.empty()) return {std::move(piece)};
  for (const RationalLoop& hole : fragment.holes) {
    ClaimedFragment shape;
    shape.loop = hole;
    if (hole.size() < 3) return told("a hole of a fragment has fewer than three vertices");
    if (fragment.exact && !Piece(shape, index, part, solid, in_plane).is_convex(solid.normal)) {
      return told("a hole of a fragment is not convex");
    }
  }
  return without_holes(piece, solid, in_plane);
}

void WitnessChecker::check_polygon(const ClaimedPolygon& polygon) {
  ++report_.polygons;
  const auto known = polygon_index_.find(polygon.id);
  if (known == polygon_index_.end()) {
    return violation(polygon.id, "no such polygon in the scene");
  }
  if (terms_.shares_alone) return check_share(polygon, known->second);
  // Parts of this side, by family of coplanar ones.
  std::set<PlaneId> optional;
  const Families families = families_on(known->second, polygon.side, optional);
  std::map<PlaneId, std::vector<Piece>> pieces;
  for (std::size_t i = 0; i < polygon.fragments.size(); ++i) {
    const ClaimedFragment& fragment = polygon.fragments[i];
    ++report_.fragments;
    if (fragment.exact) ++report_.exact_fragments;
    const bool area = light_->is_area();
    if (fragment.state != LightState::kLit && (fragment.state == LightState::kShadow) == area) {
      violation(polygon.id,
                area ? "a class that an area light does not have"
                     : "a class that a point light does not have",
                i);
      continue;
    }
    if (fragment.loop.size() < 3) {
      violation(polygon.id, "a fragment has fewer than three vertices", i);
      continue;
    }
    const Nearest family = nearest_family(fragment, families);
    std::ranges::move(pieces_of(polygon, i, family), std::back_inserter(pieces[family.plane]));
  }
  for (const auto& [plane, parts] : families) {
    if (optional.contains(plane) && pieces[plane].empty()) continue;
    check_family(polygon, parts, pieces[plane]);
  }
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
  for (const ClaimedPolygon& polygon : light.polygons) {
    if (stopped()) return;
    polygons.insert(polygon.id);
    // A foreign file that names no side means the only one.
    std::optional<ClaimedPolygon> turned;
    const auto known = polygon_index_.find(polygon.id);
    if (!polygon.side_given && known != polygon_index_.end()) {
      const std::vector<Side> listed_on = listed_sides(known->second);
      if (listed_on.size() == 1 && listed_on[0] != polygon.side) {
        turned = polygon;
        turned->side = listed_on[0];
      }
    }
    const ClaimedPolygon& judged = turned ? *turned : polygon;
    if (!sides.emplace(judged.id, judged.side).second) {
      violation(judged.id, fmt::format("its {} is listed twice", name_of(judged.side)));
    }
    check_polygon(judged);
    if (options_.progress) {
      options_.progress(static_cast<double>(++polygons_done_) / static_cast<double>(polygons_));
    }
  }
  if (!options_.subset || terms_.background) check_missing(polygons, sides);
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

}  // namespace

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
