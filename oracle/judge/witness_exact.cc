// SPDX-License-Identifier: GPL-3.0-or-later
// Sides whose loops are exact: every claim in rational numbers, and nothing may be off by anything.
// What is farther apart than the error of the plane's frame is decided there.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <ranges>

#include "oracle/judge/claimed_shape.h"
#include "oracle/judge/witness_checker.h"

namespace gnomon::oracle {

using space::area_along;
using space::cut;
using space::dot;
using space::HalfSpace;
using space::Loop;
using space::minus;

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

/// By squared distances; among planes that hold the fragment, one with a part around its middle.
WitnessChecker::Nearest WitnessChecker::nearest_family(const ClaimedFragment& fragment,
                                                       const Families& families) const {
  if (families.size() == 1) {
    const auto& [plane, parts] = *families.begin();
    const Solid& solid = light_->solid(parts.front());
    Nearest only{&parts, plane, 0, true};
    for (const RationalPoint& point : fragment.loop) {
      if (dot(solid.normal, minus(point, solid.loop[0])) != 0) only.distance = 1;
    }
    return only;
  }
  Nearest best;
  for (const auto& [plane, parts] : families) {
    Nearest own = distance_to(fragment, plane, parts);
    const bool on = own.distance == 0, best_on = best.parts && best.distance == 0;
    const bool better =
        !best.parts || (on && !best_on) || (on == best_on && own.around && !best.around) ||
        (on == best_on && own.around == best.around && own.distance < best.distance);
    if (better) best = std::move(own);
  }
  return best;
}

std::vector<Piece> WitnessChecker::exact_pieces(const ClaimedPolygon& polygon, std::size_t index,
                                                const Nearest& family) {
  const ClaimedFragment& fragment = polygon.fragments[index];
  const auto told = [&](const char* text) {
    violation(polygon.id, text, index);
    return std::vector<Piece>();
  };
  if (!family.parts) return told("nothing of the polygon is classified on this side");
  if (family.distance != 0) return told("a fragment does not lie in the polygon's plane");
  const std::uint32_t part = family.parts->front();
  const RationalPoint& normal = light_->solid(part).normal;
  std::vector<Piece> pieces;
  if (fragment.holes.empty()) {
    pieces.emplace_back(&fragment, index, part, fragment.loop, normal);
    if (pieces.back().is_convex(normal)) return pieces;
    pieces.clear();
  }
  for (const std::vector<HomogeneousPoint>& corners : convex_pieces(prepared_, part, fragment)) {
    Loop loop;
    for (const HomogeneousPoint& corner : corners) {
      loop.push_back(in_scene(prepared_.geometry, corner));
    }
    pieces.emplace_back(&fragment, index, part, std::move(loop), normal);
  }
  return pieces;
}

void WitnessChecker::check_exact_side(const ClaimedPolygon& polygon, const Families& families,
                                      const std::set<PlaneId>& optional) {
  std::map<PlaneId, std::vector<Piece>> pieces;
  for (std::size_t i = 0; i < polygon.fragments.size(); ++i) {
    if (!can_be_judged(polygon, i)) continue;
    const Nearest family = nearest_family(polygon.fragments[i], families);
    std::ranges::move(exact_pieces(polygon, i, family), std::back_inserter(pieces[family.plane]));
  }
  for (const auto& [plane, parts] : families) {
    if (optional.contains(plane) && pieces[plane].empty()) continue;
    Family family{polygon, parts, {prepared_, *light_, parts, polygon.side}, 0};
    check_exact_family(family, pieces[plane]);
  }
}

void WitnessChecker::check_exact_family(Family& family, std::vector<Piece>& pieces) {
  const bool reached = light_->sees(family.parts.front(), family.polygon.side);
  if (terms_.block == Block::kOverlay && !reached) return;
  const RationalPoint& normal = light_->solid(family.parts.front()).normal;
  const auto lay = [&] {
    for (Piece& piece : pieces) piece.lay(family.shades.frame());
  };
  lay();
  const bool tiled = tiles(family);
  if (tiled) check_exact_tiling(family, pieces);
  // Loops of one level may overlap under one of a higher level.
  if (terms_.cover == Cover::kOverlay) {
    pieces = cut_to_visible(std::move(pieces), normal);
    lay();
  }
  if (tiled) check_exact_overlaps(family, pieces);
  for (const Piece& piece : pieces) check_exact_piece(family, piece);
  mpq_class rest_area;
  if (const std::optional<ClassSet> allowed = left_out()) {
    for (const std::uint32_t part : family.parts) {
      const Loop& loop = light_->solid(part).loop;
      for (Piece& rest : left_over(family.parts.front(), loop, normal, pieces)) {
        rest_area += rest.area;
        check_exact_classes(family, rest, *allowed);
      }
    }
  }
  check_exact_fractions(family, pieces, rest_area);
}

void WitnessChecker::check_exact_tiling(Family& family, std::vector<Piece>& pieces) {
  const RationalPoint& normal = light_->solid(family.parts.front()).normal;
  const PieceSides sides(normal, family.shades.greatest());
  mpq_class whole, sum;
  std::vector<Piece> parts;
  for (const std::uint32_t part : family.parts) {
    parts.emplace_back(part, light_->solid(part).loop, normal);
    parts.back().lay(family.shades.frame());
    whole += area_along(normal, light_->solid(part).loop);
  }
  for (Piece& piece : pieces) {
    sum += piece.area;
    if (std::ranges::any_of(parts, [&](const Piece& part) { return sides.holds(part, piece); })) {
      continue;
    }
    mpq_class inside;
    for (const std::uint32_t part : family.parts) {
      Loop rest = piece.loop;
      for (const HalfSpace& wall : light_->solid(part).walls) {
        if (!rest.empty()) rest = cut(rest, wall);
      }
      if (!rest.empty()) inside += area_along(normal, rest);
    }
    if (piece.area != inside) {
      violation(family.polygon.id, "a fragment leaves the polygon", piece.index);
    }
  }
  if (!left_out() && whole != sum) {
    violation(family.polygon.id, "the fragments' areas do not add up to the polygon's");
  }
}

bool WitnessChecker::is_outside(const Piece& piece, const PlanarLine& line, const HalfSpace& wall,
                                const Family& family) const {
  const long double error = family.shades.error();
  if (std::ranges::any_of(piece.flat,
                          [&](const PlanarPoint& p) { return !(line.at(p) <= error); })) {
    return false;
  }
  for (std::size_t i = 0; i < piece.flat.size(); ++i) {
    if (!(line.at(piece.flat[i]) < -error) && wall.value(piece.vertex_at(i)) > 0) return false;
  }
  return true;
}

bool WitnessChecker::is_inside(const Piece& piece, const PlanarLine& line, const HalfSpace& wall,
                               const Family& family) const {
  const long double error = family.shades.error();
  if (std::ranges::any_of(piece.flat,
                          [&](const PlanarPoint& p) { return !(line.at(p) >= -error); })) {
    return false;
  }
  for (std::size_t i = 0; i < piece.flat.size(); ++i) {
    if (!(line.at(piece.flat[i]) > error) && wall.value(piece.vertex_at(i)) < 0) return false;
  }
  return true;
}

bool WitnessChecker::overlap(Piece& a, Piece& b, const Family& family) const {
  const RationalPoint& normal = light_->solid(family.parts.front()).normal;
  const PieceSides sides(normal, family.shades.greatest());
  if (sides.are_apart(a, b) || sides.are_apart(b, a)) return false;
  Loop rest = a.loop;
  for (const HalfSpace& wall : b.walls_of(normal)) {
    rest = cut(rest, wall);
    if (rest.empty()) return false;
  }
  return area_along(normal, rest) > 0;
}

/// Pairs, swept along x. Of an overlay only those that say different things of one level.
void WitnessChecker::check_exact_overlaps(Family& family, std::vector<Piece>& pieces) {
  std::ranges::sort(pieces, {}, [](const Piece& piece) { return piece.flat_box.low.x; });
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const ClaimedFragment& own = *pieces[i].fragment;
    for (std::size_t j = i + 1;
         j < pieces.size() && pieces[j].flat_box.low.x <= pieces[i].flat_box.high.x; ++j) {
      const ClaimedFragment& other = *pieces[j].fragment;
      if (&own == &other || !pieces[i].flat_box.meets(pieces[j].flat_box)) continue;
      if (terms_.cover == Cover::kOverlay &&
          (own.level != other.level || own.state == other.state)) {
        continue;
      }
      if (!overlap(pieces[i], pieces[j], family)) continue;
      violation(family.polygon.id,
                fmt::format("the fragment overlaps fragment {}", pieces[j].index), pieces[i].index);
    }
  }
}

void WitnessChecker::check_exact_piece(Family& family, const Piece& piece) {
  const auto classes = classes_without_witness(piece.fragment->state);
  if (classes) return check_exact_classes(family, piece, *classes);
  light_->is_area() ? check_exact_area_shade(family, piece) : check_exact_shade(family, piece);
}

void WitnessChecker::check_exact_lit(Family& family, const Piece& piece) {
  for (const HalfSpace& outside : light_->outsides()) {
    if (area_along(light_->solid(piece.part).normal, cut(piece.loop, outside)) > 0) {
      return violation(family.polygon.id, "a lit fragment is outside of the light's region",
                       piece.index);
    }
  }
  for (const Shade* shade : family.shades.partly().near(piece.flat_box)) {
    const std::vector<HalfSpace>& bounds = light_->shadow(shade->part);
    bool apart = shade->is_apart(piece.flat, family.shades.error());
    for (std::size_t i = 0; i < shade->lines.size() && !apart; ++i) {
      apart = is_outside(piece, shade->lines[i], bounds[shade->bounds[i]], family);
    }
    if (apart) continue;
    if (light_->shadowed_by(piece, shade->part) > 0) {
      return violation(family.polygon.id,
                       fmt::format("a lit fragment is shadowed by '{}'", id_of(shade->part)),
                       piece.index);
    }
  }
}

void WitnessChecker::check_exact_shade(Family& family, const Piece& piece) {
  const ClaimedFragment& fragment = *piece.fragment;
  const std::string& id = family.polygon.id;
  const bool faces = is_facing(family);
  if (fragment.state == LightState::kLit) {
    if (faces) return check_exact_lit(family, piece);
    return violation(id, "a fragment is lit on a side that does not face the light", piece.index);
  }
  if (!fragment.casters.empty()) return check_exact_casters(family, piece);
  const std::optional<std::uint32_t> caster = caster_to_check(family, fragment, piece.index);
  if (!caster) return;
  if (faces) {
    for (const Shade* shade : family.shades.partly().near(piece.flat_box)) {
      if (prepared_.parts[shade->part].polygon != *caster) continue;
      const std::vector<HalfSpace>& bounds = light_->shadow(shade->part);
      bool around = true;
      for (std::size_t i = 0; i < shade->lines.size() && around; ++i) {
        around = is_inside(piece, shade->lines[i], bounds[shade->bounds[i]], family);
      }
      if (around) return;
    }
  }
  if (area_along(light_->solid(piece.part).normal, light_->not_shadowed(piece, *caster)) > 0) {
    violation(id, fmt::format("'{}' does not shadow all of the fragment", fragment.caster),
              piece.index);
  }
}

/// Together they shadow all of it, and none of them is needless.
void WitnessChecker::check_exact_casters(Family& family, const Piece& piece) {
  ++report_.witnesses;
  const std::string& id = family.polygon.id;
  const std::vector<std::uint32_t> casters = named_casters(family.polygon, piece.index);
  if (casters.empty()) return;
  const RationalPoint& normal = light_->solid(piece.part).normal;
  if (area_along(normal, light_->not_shadowed_by(piece, casters)) > 0) {
    return violation(id, "its casters do not shadow all of the fragment", piece.index);
  }
  for (std::size_t i = 0; i < casters.size(); ++i) {
    std::vector<std::uint32_t> others = casters;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    if (area_along(normal, light_->not_shadowed_by(piece, others)) > 0) continue;
    return violation(id,
                     fmt::format("its casters shadow all of the fragment without '{}'",
                                 piece.fragment->casters[i]),
                     piece.index);
  }
}

bool WitnessChecker::is_seen_exactly(Family& family, const Piece& piece) {
  const RationalPoint& normal = light_->solid(piece.part).normal;
  const Side side = family.polygon.side;
  const bool lit = piece.fragment->state == LightState::kLit;
  const std::string name = name_of(piece.fragment->state);
  const auto told = [&](std::string text) {
    violation(family.polygon.id, std::move(text), piece.index);
    return false;
  };
  if (!light_->sees(piece.part, side)) {
    return told(fmt::format("a fragment is {} on a side that sees nothing of the light", name));
  }
  if (area_along(normal, cut(piece.loop, light_->area().behind_light())) > 0) {
    return told(fmt::format("a {} fragment reaches behind the light", name));
  }
  for (std::size_t b = 0; b < light_->area().size() && (lit || terms_.per_caster_umbra); ++b) {
    if (light_->area().part_of(b) == piece.part) continue;
    if (light_->is_apart(piece, light_->area().largest_penumbra(b).bounds)) continue;
    const AreaSolids::Volume& volume = lit ? light_->area().penumbra(b, piece.part, side)
                                           : light_->area().umbra(b, piece.part, side);
    if (!(area_along(normal, light_->inside(piece, volume, !lit)) > 0)) continue;
    const std::string& caster = id_of(light_->area().part_of(b));
    return told(lit ? fmt::format("a lit fragment is in the penumbra of '{}'", caster)
                    : fmt::format("a penumbra fragment is in the umbra of '{}'", caster));
  }
  return true;
}

void WitnessChecker::check_exact_area_shade(Family& family, const Piece& piece) {
  const ClaimedFragment& fragment = *piece.fragment;
  const std::string& id = family.polygon.id;
  const bool all = fragment.state == LightState::kUmbra;
  if (!all && !is_seen_exactly(family, piece)) return;
  if (fragment.state == LightState::kLit) return;
  ++report_.witnesses;
  const RationalPoint& normal = light_->solid(piece.part).normal;
  const bool sees = light_->sees(piece.part, family.polygon.side);
  const mpq_class behind = area_along(normal, cut(piece.loop, light_->area().behind_light()));
  const bool before = sees && piece.area > behind;
  if (!fragment.reason.empty()) {
    if (area_reason_holds(family, fragment, !before)) return;
    return violation(id, fmt::format("the reason '{}' does not hold", fragment.reason),
                     piece.index);
  }
  if (fragment.caster.empty()) {
    if (before) {
      violation(
          id,
          fmt::format("{} {} fragment names no caster", all ? "an" : "a", name_of(fragment.state)),
          piece.index);
    }
    return;
  }
  const std::optional<std::uint32_t> caster = named_caster(family.polygon, piece.index);
  if (caster && sees &&
      area_along(normal, light_->not_hidden(piece, light_->before_light(piece), *caster,
                                            family.polygon.side, all)) > 0) {
    violation(id,
              fmt::format("'{}' does not hide {} of the light from all of the fragment",
                          fragment.caster, all ? "all" : "part"),
              piece.index);
  }
}

void WitnessChecker::check_exact_classes(Family& family, const Piece& piece,
                                         const ClassSet& allowed) {
  const std::array<mpq_class, 4> areas = light_->areas_of_classes(piece, family.polygon.side);
  for (std::size_t c = 0; c < areas.size(); ++c) {
    const auto state = static_cast<LightState>(c);
    if (!(areas[c] > 0) || !is_wrong(state, allowed)) continue;
    const std::string what = piece.fragment
                                 ? fmt::format("a {} fragment", name_of(piece.fragment->state))
                                 : std::string("what no fragment covers");
    violation(family.polygon.id, fmt::format("some of {} is {}", what, name_of(state)),
              piece.fragment ? std::optional<std::uint64_t>(piece.index) : std::nullopt);
    return;
  }
}

void WitnessChecker::check_exact_fractions(const Family& family, const std::vector<Piece>& pieces,
                                           const mpq_class& rest) {
  const ClaimedPolygon& polygon = family.polygon;
  if (!has_all_parts(family)) return;
  std::array<mpq_class, 4> areas;  // by LightState
  if (terms_.background) areas[static_cast<std::size_t>(*terms_.background)] = rest;
  for (const Piece& piece : pieces) {
    areas[static_cast<std::size_t>(piece.fragment->state)] += piece.area;
  }
  mpq_class whole;
  for (const std::uint32_t part : family.parts) {
    whole += area_along(light_->solid(family.parts.front()).normal, light_->solid(part).loop);
  }
  const auto claim = [&](const std::optional<mpq_class>& claimed, LightState shade) {
    if (!claimed || !is_told(shade)) return;
    const mpq_class found = areas[static_cast<std::size_t>(shade)] / whole;
    if (*claimed == found) return;
    violation(polygon.id, fmt::format("the {} fraction is claimed as {}, but the fragments say {}",
                                      name_of(shade), claimed->get_str(), found.get_str()));
  };
  claim(polygon.lit_fraction, LightState::kLit);
  claim(polygon.shadow_fraction, LightState::kShadow);
  claim(polygon.penumbra_fraction, LightState::kPenumbra);
  claim(polygon.umbra_fraction, LightState::kUmbra);
}

}  // namespace gnomon::oracle
