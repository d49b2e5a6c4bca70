// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnomon/oracle/witness_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "gnomon/oracle/compare.h"
#include "gnomon/oracle/verdict.h"
#include "oracle/geometry/space_loop.h"
#include "oracle/judge/witness_pieces.h"
#include "oracle/visibility/area_solids.h"

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

  WitnessReport run();

 private:
  void violation(const std::string& polygon, std::string text,
                 std::optional<std::uint64_t> fragment = {}) {
    ++report_.violations;
    if (report_.findings.size() < options_.most) {
      report_.findings.push_back({light_id_, polygon, std::move(text), fragment});
    }
  }
  /// Parts whose plane a result lists on this side, by family; and others it may list there.
  std::map<PlaneId, std::vector<std::uint32_t>> families_on(std::uint32_t polygon, Side side,
                                                            std::set<PlaneId>& optional) const;
  bool sees(std::uint32_t part, Side side) const;
  std::vector<Side> listed_sides(std::uint32_t polygon) const;
  void check_polygon(const ClaimedPolygon& polygon);
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
  /// A fragment that can be judged; else the violation has been told.
  std::optional<Piece> piece_of(const ClaimedPolygon& polygon, std::size_t index,
                                const Nearest& family);
  void check_family(const ClaimedPolygon& polygon, const std::vector<std::uint32_t>& parts,
                    std::vector<Piece>& pieces);
  void check_shade(const ClaimedPolygon& polygon, const Piece& piece, const mpq_class& slack);
  void check_lit(const ClaimedPolygon& polygon, const Piece& piece, const mpq_class& slack);
  /// Without area if parts of a caster shadow all of a piece.
  mpq_class not_shadowed_by(const Piece& piece, std::uint32_t caster) const;
  void check_fractions(const ClaimedPolygon& polygon, const std::vector<Piece>& pieces,
                       const std::vector<std::uint32_t>& parts);
  void check_area_shade(const ClaimedPolygon& polygon, const Piece& piece, const mpq_class& slack);
  /// False, with the violation told, if a fragment that is not umbra sees less than it claims.
  bool is_seen(const ClaimedPolygon& polygon, const Piece& piece, const mpq_class& slack);
  bool area_reason_holds(const ClaimedPolygon& polygon, const Piece& piece, bool behind) const;
  /// The caster that a fragment names; none, with the violation told, if the scene has none such.
  std::optional<std::uint32_t> named_caster(const ClaimedPolygon& polygon, const Piece& piece);
  bool is_apart(const Piece& piece, const std::vector<HalfSpace>& bounds) const {
    return piece.is_apart(bounds, 1e-6 * diagonal_);
  }
  const std::string& id_of(std::uint32_t part) const {
    return scene_.polygons[prepared_.parts[part].polygon].id;
  }
  /// What of a piece is in a volume and in front of the light; `closed`: also if the receiver lies
  /// in one of its planes.
  Loop inside(const Piece& piece, const AreaSolids::Volume& volume, bool closed) const;
  /// Without area if parts of a caster hold all of a piece that is in front of the light.
  mpq_class not_hidden_by(const Piece& piece, std::uint32_t caster, Side side, bool all);
  mpq_class shadowed_by(const Piece& piece, std::uint32_t part) const;

  const Scene& scene_;
  const PreparedScene& prepared_;
  const Claims& candidate_;
  const WitnessOptions& options_;
  mpq_class tolerance_, width_;
  double diagonal_ = 0;
  std::map<std::string, std::uint32_t> polygon_index_;
  std::string light_id_;
  std::vector<Solid> solids_;
  std::optional<AreaSolids> area_;  // of an area light
  bool per_caster_umbra_ = false;
  WitnessReport report_;
};

Loop WitnessChecker::inside(const Piece& piece, const AreaSolids::Volume& volume,
                            bool closed) const {
  Loop rest = cut(piece.loop, area_->before_light());
  for (std::size_t i = 0; i < volume.bounds.size() && !rest.empty(); ++i) {
    const HalfSpace& half = volume.bounds[i];
    if (!(closed && i > 0 && solids_[piece.part].lies_in(half))) rest = cut(rest, half);
  }
  return volume.empty ? Loop{} : rest;
}

mpq_class WitnessChecker::not_hidden_by(const Piece& piece, std::uint32_t caster, Side side,
                                        bool all) {
  std::vector<Loop> rest;
  if (Loop front = cut(piece.loop, area_->before_light()); !front.empty()) {
    rest.push_back(std::move(front));
  }
  for (std::size_t b = 0; b < area_->size(); ++b) {
    const std::uint32_t part = area_->part_of(b);
    if (prepared_.parts[part].polygon != caster || part == piece.part) continue;
    const AreaSolids::Volume& volume =
        all ? area_->umbra(b, piece.part, side) : area_->penumbra(b, piece.part, side);
    if (volume.empty) continue;
    std::vector<Loop> left;
    for (Loop& loop : rest) {
      for (std::size_t i = 0; i < volume.bounds.size() && !loop.empty(); ++i) {
        const HalfSpace& half = volume.bounds[i];
        if (all && i > 0 && solids_[piece.part].lies_in(half)) continue;
        const HalfSpace beyond(space::negated(half.normal), half.base);
        Loop inner = cut(loop, half);
        Loop outer = inner.empty() ? loop : cut(loop, beyond);
        if (!outer.empty()) left.push_back(std::move(outer));
        loop = std::move(inner);
      }
    }
    rest = std::move(left);
  }
  mpq_class open;
  for (const Loop& loop : rest) open += area_along(solids_[piece.part].normal, loop);
  return open;
}

bool WitnessChecker::is_seen(const ClaimedPolygon& polygon, const Piece& piece,
                             const mpq_class& slack) {
  const RationalPoint& normal = solids_[piece.part].normal;
  const bool lit = piece.fragment->state == LightState::kLit;
  const std::string name = name_of(piece.fragment->state);
  const auto told = [&](std::string text) {
    violation(polygon.id, std::move(text), piece.index);
    return false;
  };
  if (!area_->sees(piece.part, polygon.side)) {
    return told(fmt::format("a fragment is {} on a side that sees nothing of the light", name));
  }
  if (area_along(normal, cut(piece.loop, area_->behind_light())) > slack) {
    return told(fmt::format("a {} fragment reaches behind the light", name));
  }
  for (std::size_t b = 0; b < area_->size() && (lit || per_caster_umbra_); ++b) {
    if (area_->part_of(b) == piece.part) continue;
    if (is_apart(piece, area_->largest_penumbra(b).bounds)) continue;
    const AreaSolids::Volume& volume = lit ? area_->penumbra(b, piece.part, polygon.side)
                                           : area_->umbra(b, piece.part, polygon.side);
    if (!(area_along(normal, inside(piece, volume, !lit)) > slack)) continue;
    const std::string& caster = id_of(area_->part_of(b));
    return told(lit ? fmt::format("a lit fragment is in the penumbra of '{}'", caster)
                    : fmt::format("a penumbra fragment is in the umbra of '{}'", caster));
  }
  return true;
}

bool WitnessChecker::area_reason_holds(const ClaimedPolygon& polygon, const Piece& piece,
                                       bool behind) const {
  if (piece.fragment->state != LightState::kUmbra) return false;
  switch (shadow_reason_by_name(piece.fragment->reason).value_or(ShadowReason::kNone)) {
    case ShadowReason::kBehindLight:
      return behind;
    case ShadowReason::kFacesAway:
      return area_->faces_away(piece.part, polygon.side);
    case ShadowReason::kLightInPlane:
      return area_->light_in_plane(piece.part);
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
  const bool sees = area_->sees(piece.part, polygon.side);
  const mpq_class behind =
      area_along(solids_[piece.part].normal, cut(piece.loop, area_->behind_light()));
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
  if (caster && sees && not_hidden_by(piece, *caster, polygon.side, all) > slack) {
    violation(polygon.id,
              fmt::format("'{}' does not hide {} of the light from all of the fragment",
                          fragment.caster, all ? "all" : "part"),
              piece.index);
  }
}

mpq_class WitnessChecker::shadowed_by(const Piece& piece, std::uint32_t part) const {
  const Solid& caster = solids_[part];
  if (!caster.casts || part == piece.part) return 0;
  Loop rest = piece.loop;
  for (const HalfSpace& half : caster.shadow) {
    rest = cut(rest, half);
    if (rest.empty()) return 0;
  }
  return area_along(solids_[piece.part].normal, rest);
}

void WitnessChecker::check_lit(const ClaimedPolygon& polygon, const Piece& piece,
                               const mpq_class& slack) {
  for (std::uint32_t part = 0; part < solids_.size(); ++part) {
    if (!solids_[part].casts || is_apart(piece, solids_[part].shadow)) continue;
    if (shadowed_by(piece, part) > slack) {
      return violation(polygon.id, fmt::format("a lit fragment is shadowed by '{}'", id_of(part)),
                       piece.index);
    }
  }
}

/// The parts of one caster: their shadows may overlap where it is not planar, so the piece is cut
/// down to what no part so far has taken.
mpq_class WitnessChecker::not_shadowed_by(const Piece& piece, std::uint32_t caster) const {
  std::vector<Loop> rest{piece.loop};
  for (std::uint32_t part = prepared_.first_part[caster]; part < prepared_.first_part[caster + 1];
       ++part) {
    // A part in the receiver's plane shadows nothing of it, and its shadow cuts nothing off.
    if (!solids_[part].casts || part == piece.part || solids_[part].holds(solids_[piece.part])) {
      continue;
    }
    std::vector<Loop> left;
    for (Loop& loop : rest) {
      for (const HalfSpace& half : solids_[part].shadow) {
        HalfSpace beyond = half;
        for (mpq_class& component : beyond.normal) component = -component;
        Loop outside = cut(loop, beyond);
        if (!outside.empty()) left.push_back(std::move(outside));
        loop = cut(loop, half);
        if (loop.empty()) break;
      }
    }
    rest = std::move(left);
  }
  mpq_class open;
  for (const Loop& loop : rest) open += area_along(solids_[piece.part].normal, loop);
  return open;
}

void WitnessChecker::check_shade(const ClaimedPolygon& polygon, const Piece& piece,
                                 const mpq_class& slack) {
  const ClaimedFragment& fragment = *piece.fragment;
  const Solid& own = solids_[piece.part];
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
  if (caster && not_shadowed_by(piece, *caster) > slack) {
    violation(polygon.id, fmt::format("'{}' does not shadow all of the fragment", fragment.caster),
              piece.index);
  }
}

void WitnessChecker::check_family(const ClaimedPolygon& polygon,
                                  const std::vector<std::uint32_t>& parts,
                                  std::vector<Piece>& pieces) {
  const RationalPoint& normal = solids_[parts.front()].normal;
  mpq_class whole, sum;
  bool exact = true;
  for (std::uint32_t part : parts) whole += area_along(normal, solids_[part].loop);
  const auto slack_of = [&](bool is_exact) {
    return is_exact ? mpq_class(0) : mpq_class(tolerance_ * whole);
  };
  for (Piece& piece : pieces) {
    exact = exact && piece.fragment->exact;
    sum += piece.area;
    mpq_class inside;
    for (std::uint32_t part : parts) {
      Loop rest = piece.loop;
      for (const HalfSpace& wall : solids_[part].walls) {
        if (!rest.empty()) rest = cut(rest, wall);
      }
      if (!rest.empty()) inside += area_along(normal, rest);
    }
    if (abs(mpq_class(piece.area - inside)) > slack_of(piece.fragment->exact)) {
      violation(polygon.id, "a fragment leaves the polygon", piece.index);
    }
  }
  if (abs(mpq_class(whole - sum)) > slack_of(exact)) {
    violation(polygon.id, "the fragments' areas do not add up to the polygon's");
  }
  // Pairs, swept along x.
  std::sort(pieces.begin(), pieces.end(),
            [](const Piece& a, const Piece& b) { return a.low[0] < b.low[0]; });
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    for (std::size_t j = i + 1; j < pieces.size() && pieces[j].low[0] <= pieces[i].high[0]; ++j) {
      bool apart = false;
      for (int k = 1; k < 3; ++k) {
        apart =
            apart || pieces[i].high[k] < pieces[j].low[k] || pieces[j].high[k] < pieces[i].low[k];
      }
      if (apart) continue;
      Loop rest = pieces[i].loop;
      for (const HalfSpace& wall : pieces[j].walls_of(normal)) {
        rest = cut(rest, wall);
        if (rest.empty()) break;
      }
      const bool both = pieces[i].fragment->exact && pieces[j].fragment->exact;
      if (!rest.empty() && area_along(normal, rest) > slack_of(both)) {
        violation(polygon.id, fmt::format("the fragment overlaps fragment {}", pieces[j].index),
                  pieces[i].index);
      }
    }
  }
  for (const Piece& piece : pieces) {
    const mpq_class slack = slack_of(piece.fragment->exact);
    if (area_) {
      check_area_shade(polygon, piece, slack);
    } else {
      check_shade(polygon, piece, slack);
    }
  }
  check_fractions(polygon, pieces, parts);
}

void WitnessChecker::check_fractions(const ClaimedPolygon& polygon,
                                     const std::vector<Piece>& pieces,
                                     const std::vector<std::uint32_t>& parts) {
  if (!polygon.lit_fraction && !polygon.shadow_fraction && !polygon.penumbra_fraction &&
      !polygon.umbra_fraction) {
    return;
  }
  const std::uint32_t index = prepared_.parts[parts.front()].polygon;
  if (parts.size() != prepared_.first_part[index + 1] - prepared_.first_part[index]) return;
  std::array<mpq_class, 4> areas;  // by LightState
  bool exact = true;
  for (const Piece& piece : pieces) {
    areas[static_cast<std::size_t>(piece.fragment->state)] += piece.area;
    exact = exact && piece.fragment->exact;
  }
  const mpq_class whole = [&] {
    mpq_class sum;
    for (std::uint32_t part : parts) {
      sum += area_along(solids_[parts.front()].normal, solids_[part].loop);
    }
    return sum;
  }();
  const mpq_class slack = exact ? mpq_class(0) : tolerance_;
  const auto claim = [&](const std::optional<mpq_class>& claimed, LightState shade) {
    const mpq_class& area = areas[static_cast<std::size_t>(shade)];
    const char* name = name_of(shade);
    if (claimed && abs(mpq_class(*claimed - area / whole)) > slack) {
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

bool WitnessChecker::sees(std::uint32_t part, Side side) const {
  if (area_) return area_->sees(part, side);
  const Solid& solid = solids_[part];
  return solid.receives && (side == Side::kFront ? solid.facing > 0 : solid.facing < 0);
}

/// A polygon is listed once for each side that some part of it sees the light from, or with its
/// front.
std::vector<Side> WitnessChecker::listed_sides(std::uint32_t polygon) const {
  std::vector<Side> sides;
  for (const Side side : {Side::kFront, Side::kBack}) {
    for (std::uint32_t part = prepared_.first_part[polygon];
         part < prepared_.first_part[polygon + 1]; ++part) {
      if (!sees(part, side)) continue;
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
                         [&](std::uint32_t part) { return sees(part, from); });
    };
    const bool dark = !seen_from(Side::kFront) && !seen_from(Side::kBack);
    if (!seen_from(side) && !(dark && side == first)) optional.insert(plane);
  }
  return families;
}

WitnessChecker::Nearest WitnessChecker::distance_to(const ClaimedFragment& fragment, PlaneId plane,
                                                    const std::vector<std::uint32_t>& parts) const {
  const Solid& solid = solids_[parts.front()];
  Nearest own{&parts, plane, 0, false};
  RationalPoint centre;
  for (const RationalPoint& point : fragment.loop) {
    const mpq_class height = dot(solid.normal, minus(point, solid.loop[0]));
    own.distance = std::max(own.distance, mpq_class(height * height));
    for (int k = 0; k < 3; ++k) centre[k] += point[k] / mpq_class(fragment.loop.size());
  }
  own.distance /= dot(solid.normal, solid.normal);
  own.around = std::ranges::any_of(parts, [&](std::uint32_t part) {
    return std::ranges::all_of(solids_[part].walls,
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

std::optional<Piece> WitnessChecker::piece_of(const ClaimedPolygon& polygon, std::size_t index,
                                              const Nearest& family) {
  const ClaimedFragment& fragment = polygon.fragments[index];
  const auto told = [&](const char* text) {
    violation(polygon.id, text, index);
    return std::nullopt;
  };
  if (!family.parts) return told("nothing of the polygon is classified on this side");
  if (family.distance > allowed_distance(fragment)) {
    return told("a fragment does not lie in the polygon's plane");
  }
  const std::uint32_t part = family.parts->front();
  Piece piece(fragment, index, part, solids_[part], family.distance == 0);
  if (fragment.exact && !piece.is_convex(solids_[part].normal)) {
    return told("a fragment is not convex");
  }
  return piece;
}

void WitnessChecker::check_polygon(const ClaimedPolygon& polygon) {
  ++report_.polygons;
  const auto known = polygon_index_.find(polygon.id);
  if (known == polygon_index_.end()) {
    return violation(polygon.id, "no such polygon in the scene");
  }
  // Parts of this side, by family of coplanar ones.
  std::set<PlaneId> optional;
  const Families families = families_on(known->second, polygon.side, optional);
  std::map<PlaneId, std::vector<Piece>> pieces;
  for (std::size_t i = 0; i < polygon.fragments.size(); ++i) {
    const ClaimedFragment& fragment = polygon.fragments[i];
    ++report_.fragments;
    if (fragment.exact) ++report_.exact_fragments;
    if (fragment.state != LightState::kLit && (fragment.state == LightState::kShadow) == !!area_) {
      violation(polygon.id,
                area_ ? "a class that an area light does not have"
                      : "a class that a point light does not have",
                i);
      continue;
    }
    if (fragment.loop.size() < 3) {
      violation(polygon.id, "a fragment has fewer than three vertices", i);
      continue;
    }
    const Nearest family = nearest_family(fragment, families);
    std::optional<Piece> piece = piece_of(polygon, i, family);
    if (piece) pieces[family.plane].push_back(std::move(*piece));
  }
  for (const auto& [plane, parts] : families) {
    if (optional.contains(plane) && pieces[plane].empty()) continue;
    check_family(polygon, parts, pieces[plane]);
  }
}

WitnessReport WitnessChecker::run() {
  std::size_t all = 0, done = 0;
  for (const ClaimedLight& light : candidate_.lights) all += light.polygons.size();
  std::set<std::string> listed;
  for (const ClaimedLight& light : candidate_.lights) {
    light_id_ = light.id;
    listed.insert(light.id);
    const PreparedLight* own = nullptr;
    for (const PreparedLight& prepared : prepared_.lights) {
      if (scene_.lights[prepared.light].id == light.id) own = &prepared;
    }
    if (!own) {
      violation({}, "no such light in the scene");
      continue;
    }
    solids_ = solids_of(prepared_, *own);
    area_.reset();
    if (own->has_area()) {
      std::vector<const Loop*> loops;
      for (const Solid& solid : solids_) loops.push_back(&solid.loop);
      area_.emplace(prepared_, *own, loops);
    }
    per_caster_umbra_ = light.per_caster_umbra;
    std::set<std::string> polygons;
    std::set<std::pair<std::string, Side>> sides;
    for (const ClaimedPolygon& polygon : light.polygons) {
      if (options_.interrupted && options_.interrupted->load(std::memory_order_relaxed)) {
        report_.interrupted = true;
        return std::move(report_);
      }
      polygons.insert(polygon.id);
      // A foreign file that names no side means the only one.
      std::optional<ClaimedPolygon> turned;
      const auto known = polygon_index_.find(polygon.id);
      if (area_ && !polygon.side_given && known != polygon_index_.end()) {
        const std::vector<Side> listed_on = listed_sides(known->second);
        if (listed_on.size() == 1 && listed_on[0] != polygon.side) {
          turned = polygon;
          turned->side = listed_on[0];
        }
      }
      const ClaimedPolygon& judged = turned ? *turned : polygon;
      if (area_ && !sides.emplace(judged.id, judged.side).second) {
        violation(judged.id, fmt::format("its {} is listed twice", name_of(judged.side)));
      }
      check_polygon(judged);
      if (options_.progress) {
        options_.progress(static_cast<double>(++done) / static_cast<double>(all));
      }
    }
    for (std::uint32_t p = 0; p < scene_.polygons.size() && !options_.subset; ++p) {
      const bool has_parts = prepared_.first_part[p] != prepared_.first_part[p + 1];
      if (has_parts && !polygons.contains(scene_.polygons[p].id)) {
        violation(scene_.polygons[p].id, "the polygon is missing");
        continue;
      }
      if (!has_parts || !area_) continue;
      for (const Side side : listed_sides(p)) {
        if (sides.contains({scene_.polygons[p].id, side})) continue;
        violation(scene_.polygons[p].id, fmt::format("its {} is missing", name_of(side)));
      }
    }
  }
  for (const PreparedLight& light : prepared_.lights) {
    const std::string& id = scene_.lights[light.light].id;
    if (options_.subset || listed.contains(id)) continue;
    light_id_ = id;
    violation({}, "the light is missing");
  }
  return std::move(report_);
}

}  // namespace

WitnessReport check_witnesses(const Scene& scene, const PreparedScene& prepared,
                              const Claims& candidate, const WitnessOptions& options) {
  return WitnessChecker(scene, prepared, candidate, options).run();
}

}  // namespace gnomon::oracle
