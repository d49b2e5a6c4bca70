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

struct Solid {  // a part as receiver and caster
  Loop loop;
  ExactPoint normal;
  std::vector<HalfSpace> walls;   // in its plane: inside of the part
  std::vector<HalfSpace> shadow;  // behind it and inside its edges, seen from the light
  int facing = 0;                 // 1 front, -1 back, 0 the light is in its plane
  bool receives = false, casts = false;
};

class WitnessChecker {
 public:
  WitnessChecker(const Scene& scene, const PreparedScene& prepared, const Candidate& candidate,
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
  struct Piece {
    const CandidateFragment* fragment = nullptr;
    std::size_t index = 0;
    std::uint32_t part = 0;          // a part of the family whose plane it lies in
    Loop loop;                       // oriented like that part
    mpq_class area;                  // along the part's normal
    std::vector<HalfSpace> walls{};  // of its edges, made when first asked for: walls_of()
    std::array<double, 3> low{}, high{};
  };

  void violation(const std::string& polygon, std::string text,
                 std::optional<std::uint64_t> fragment = {}) {
    ++report_.violations;
    if (report_.findings.size() < options_.most) {
      report_.findings.push_back({light_id_, polygon, std::move(text), fragment});
    }
  }
  void read_parts(const PreparedLight& light);
  /// Parts whose plane a result lists on this side, by family; and others it may list there.
  std::map<PlaneId, std::vector<std::uint32_t>> families_on(std::uint32_t polygon, PolygonSide side,
                                                            std::set<PlaneId>& optional) const;
  bool sees(std::uint32_t part, PolygonSide side) const;
  std::vector<PolygonSide> listed_sides(std::uint32_t polygon) const;
  void check_polygon(const CandidatePolygon& polygon);
  void check_family(const CandidatePolygon& polygon, const std::vector<std::uint32_t>& parts,
                    std::vector<Piece>& pieces);
  /// In the plane with that normal, inside of the piece; none for an edge without length.
  static const std::vector<HalfSpace>& walls_of(Piece& piece, const ExactPoint& normal);
  void check_shade(const CandidatePolygon& polygon, const Piece& piece, const mpq_class& slack);
  void check_fractions(const CandidatePolygon& polygon, const std::vector<Piece>& pieces,
                       const std::vector<std::uint32_t>& parts);
  void check_area_shade(const CandidatePolygon& polygon, const Piece& piece,
                        const mpq_class& slack);
  /// What of a piece is in a volume and in front of the light; `closed`: also if the receiver lies
  /// in one of its planes.
  Loop inside(const Piece& piece, const AreaSolids::Volume& volume, bool closed) const;
  /// Without area if parts of a caster hold all of a piece that is in front of the light.
  mpq_class not_hidden_by(const Piece& piece, std::uint32_t caster, PolygonSide side, bool all);
  bool are_coplanar(std::uint32_t a, std::uint32_t b) const;
  mpq_class shadowed_by(const Piece& piece, std::uint32_t part) const;

  const Scene& scene_;
  const PreparedScene& prepared_;
  const Candidate& candidate_;
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

void WitnessChecker::read_parts(const PreparedLight& light) {
  const Geometry& geometry = prepared_.geometry;
  const auto in_scene = [&](const std::array<mpz_class, 3>& grid) {
    ExactPoint point;
    for (int k = 0; k < 3; ++k) point[k] = geometry.origin[k] + geometry.step * grid[k];
    return point;
  };
  const bool directional = light.point.directional, area = light.type == LightType::kArea;
  ExactPoint source;
  if (area) {
    // No single point: AreaSolids knows what it is to each part.
  } else if (directional) {
    for (int k = 0; k < 3; ++k) source[k] = light.point.grid[k];
  } else {
    source = in_scene(light.point.grid);
  }
  area_.reset();
  solids_.clear();
  for (const Part& part : prepared_.parts) {
    Solid solid;
    for (VertexId vertex : prepared_.loop(part)) {
      solid.loop.push_back(in_scene(
          {geometry.grid.at(vertex, 0), geometry.grid.at(vertex, 1), geometry.grid.at(vertex, 2)}));
    }
    const std::size_t size = solid.loop.size();
    solid.normal = cross(minus(solid.loop[1], solid.loop[0]), minus(solid.loop[2], solid.loop[0]));
    const mpq_class height = area          ? mpq_class(0)
                             : directional ? dot(solid.normal, source)
                                           : dot(solid.normal, minus(source, solid.loop[0]));
    solid.facing = sgn(height);
    solid.receives = solid.facing > 0 || (solid.facing < 0 && part.two_sided);
    solid.casts = solid.receives && part.casts;
    for (std::size_t i = 0; i < size; ++i) {
      const ExactPoint &a = solid.loop[i], &b = solid.loop[(i + 1) % size];
      solid.walls.emplace_back(cross(solid.normal, minus(b, a)), a);
    }
    if (solid.casts) {
      ExactPoint behind = solid.normal;
      if (solid.facing > 0) {
        for (mpq_class& component : behind) component = -component;
      }
      solid.shadow.emplace_back(behind, solid.loop[0]);
      for (std::size_t i = 0; i < size; ++i) {
        const ExactPoint &a = solid.loop[i], &b = solid.loop[(i + 1) % size];
        ExactPoint inward =
            directional ? cross(source, minus(b, a)) : cross(minus(a, source), minus(b, source));
        // Inside is where the loop's other vertices are.
        if (dot(inward, minus(solid.loop[(i + 2) % size], a)) < 0) {
          for (mpq_class& component : inward) component = -component;
        }
        solid.shadow.emplace_back(std::move(inward), a);
      }
    }
    solids_.push_back(std::move(solid));
  }
  if (!area) return;
  std::vector<const Loop*> loops;
  for (const Solid& solid : solids_) loops.push_back(&solid.loop);
  area_.emplace(prepared_, light, loops);
}

Loop WitnessChecker::inside(const Piece& piece, const AreaSolids::Volume& volume,
                            bool closed) const {
  Loop rest = cut(piece.loop, area_->before_light());
  for (std::size_t i = 0; i < volume.bounds.size() && !rest.empty(); ++i) {
    const HalfSpace& half = volume.bounds[i];
    const Loop& own = solids_[piece.part].loop;
    const bool contained =
        closed && i > 0 && std::all_of(own.begin(), own.end(), [&](const ExactPoint& vertex) {
          return half.value(vertex) == 0;
        });
    if (!contained) rest = cut(rest, half);
  }
  return volume.empty ? Loop{} : rest;
}

mpq_class WitnessChecker::not_hidden_by(const Piece& piece, std::uint32_t caster, PolygonSide side,
                                        bool all) {
  const Loop& own = solids_[piece.part].loop;
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
        const bool contained =
            all && i > 0 && std::all_of(own.begin(), own.end(), [&](const ExactPoint& vertex) {
              return half.value(vertex) == 0;
            });
        if (contained) continue;
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

void WitnessChecker::check_area_shade(const CandidatePolygon& polygon, const Piece& piece,
                                      const mpq_class& slack) {
  const CandidateFragment& fragment = *piece.fragment;
  const ExactPoint& normal = solids_[piece.part].normal;
  const bool sees = area_->sees(piece.part, polygon.side);
  const mpq_class behind = area_along(normal, cut(piece.loop, area_->behind_light()));
  const mpq_class before = sees ? mpq_class(piece.area - behind) : mpq_class(0);
  const std::string name = name_of(fragment.shade);
  const auto id_of = [&](std::size_t blocker) {
    return scene_.polygons[prepared_.parts[area_->part_of(blocker)].polygon].id;
  };
  const bool lit = fragment.shade == ShadeClass::kLit;
  if (fragment.shade != ShadeClass::kUmbra) {
    if (!sees) {
      return violation(
          polygon.id,
          fmt::format("a fragment is {} on a side that sees nothing of the light", name),
          piece.index);
    }
    if (behind > slack) {
      return violation(polygon.id, fmt::format("a {} fragment reaches behind the light", name),
                       piece.index);
    }
    std::vector<std::array<double, 3>> corners;
    for (const ExactPoint& point : piece.loop) {
      corners.push_back({point[0].get_d(), point[1].get_d(), point[2].get_d()});
    }
    for (std::size_t b = 0; b < area_->size() && (lit || per_caster_umbra_); ++b) {
      if (area_->part_of(b) == piece.part) continue;
      // Doubles put aside casters that are clearly apart.
      const std::vector<HalfSpace>& bounds = area_->largest_penumbra(b).bounds;
      const bool apart = std::any_of(bounds.begin(), bounds.end(), [&](const HalfSpace& half) {
        return std::all_of(corners.begin(), corners.end(), [&](const auto& corner) {
          return half.near_value(corner) < -1e-6 * diagonal_;
        });
      });
      if (apart) continue;
      const AreaSolids::Volume& volume = lit ? area_->penumbra(b, piece.part, polygon.side)
                                             : area_->umbra(b, piece.part, polygon.side);
      if (!(area_along(normal, inside(piece, volume, !lit)) > slack)) continue;
      return violation(polygon.id,
                       lit ? fmt::format("a lit fragment is in the penumbra of '{}'", id_of(b))
                           : fmt::format("a penumbra fragment is in the umbra of '{}'", id_of(b)),
                       piece.index);
    }
    if (lit) return;
  }
  ++report_.witnesses;
  if (!fragment.reason.empty()) {
    const bool holds =
        fragment.shade == ShadeClass::kUmbra &&
        ((fragment.reason == "behind-light" && before <= slack) ||
         (fragment.reason == "faces-away" && area_->faces_away(piece.part, polygon.side)) ||
         (fragment.reason == "light-in-plane" && area_->light_in_plane(piece.part)));
    if (!holds) {
      violation(polygon.id, fmt::format("the reason '{}' does not hold", fragment.reason),
                piece.index);
    }
    return;
  }
  const bool all = fragment.shade == ShadeClass::kUmbra;
  if (fragment.caster.empty()) {
    if (before > slack) {
      violation(polygon.id, fmt::format("{} {} fragment names no caster", all ? "an" : "a", name),
                piece.index);
    }
    return;
  }
  const auto caster = polygon_index_.find(fragment.caster);
  if (caster == polygon_index_.end()) {
    return violation(polygon.id, fmt::format("no caster '{}' in the scene", fragment.caster),
                     piece.index);
  }
  if (sees && not_hidden_by(piece, caster->second, polygon.side, all) > slack) {
    violation(polygon.id,
              fmt::format("'{}' does not hide {} of the light from all of the fragment",
                          fragment.caster, all ? "all" : "part"),
              piece.index);
  }
}

/// Then neither shadows the other, and what rounding puts behind the other is not there.
bool WitnessChecker::are_coplanar(std::uint32_t a, std::uint32_t b) const {
  const Solid& one = solids_[a];
  return std::ranges::all_of(solids_[b].loop, [&](const ExactPoint& vertex) {
    return dot(one.normal, minus(vertex, one.loop[0])) == 0;
  });
}

const std::vector<HalfSpace>& WitnessChecker::walls_of(Piece& piece, const ExactPoint& normal) {
  if (!piece.walls.empty()) return piece.walls;
  for (std::size_t i = 0; i < piece.loop.size(); ++i) {
    const ExactPoint &a = piece.loop[i], &b = piece.loop[(i + 1) % piece.loop.size()];
    ExactPoint inward = cross(normal, minus(b, a));
    if (dot(inward, inward) != 0) piece.walls.emplace_back(std::move(inward), a);
  }
  return piece.walls;
}

mpq_class WitnessChecker::shadowed_by(const Piece& piece, std::uint32_t part) const {
  const Solid& caster = solids_[part];
  if (!caster.casts || part == piece.part || are_coplanar(part, piece.part)) return 0;
  Loop rest = piece.loop;
  for (const HalfSpace& half : caster.shadow) {
    rest = cut(rest, half);
    if (rest.empty()) return 0;
  }
  return area_along(solids_[piece.part].normal, rest);
}

void WitnessChecker::check_shade(const CandidatePolygon& polygon, const Piece& piece,
                                 const mpq_class& slack) {
  const CandidateFragment& fragment = *piece.fragment;
  const Solid& own = solids_[piece.part];
  const bool faces = own.receives && (own.facing > 0) == (polygon.side == PolygonSide::kFront);
  if (fragment.shade == ShadeClass::kLit) {
    if (!faces) {
      return violation(polygon.id, "a fragment is lit on a side that does not face the light",
                       piece.index);
    }
    std::vector<std::array<double, 3>> corners;
    for (const ExactPoint& point : piece.loop) {
      corners.push_back({point[0].get_d(), point[1].get_d(), point[2].get_d()});
    }
    for (std::uint32_t part = 0; part < solids_.size(); ++part) {
      // Doubles put aside casters that are clearly apart.
      const bool apart = std::any_of(
          solids_[part].shadow.begin(), solids_[part].shadow.end(), [&](const HalfSpace& half) {
            return std::all_of(corners.begin(), corners.end(), [&](const auto& corner) {
              return half.near_value(corner) < -1e-6 * diagonal_;
            });
          });
      if (!solids_[part].casts || apart) continue;
      if (shadowed_by(piece, part) > slack) {
        return violation(polygon.id,
                         fmt::format("a lit fragment is shadowed by '{}'",
                                     scene_.polygons[prepared_.parts[part].polygon].id),
                         piece.index);
      }
    }
    return;
  }
  ++report_.witnesses;
  if (!fragment.reason.empty()) {
    const bool holds = (fragment.reason == "faces-away" && !faces && own.facing != 0) ||
                       (fragment.reason == "light-in-plane" && own.facing == 0);
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
  const auto caster = polygon_index_.find(fragment.caster);
  if (caster == polygon_index_.end()) {
    return violation(polygon.id, fmt::format("no caster '{}' in the scene", fragment.caster),
                     piece.index);
  }
  // The parts of one caster: their shadows may overlap where it is not planar, so the piece is cut
  // down to what no part so far has taken.
  std::vector<Loop> rest{piece.loop};
  for (std::uint32_t part = prepared_.first_part[caster->second];
       part < prepared_.first_part[caster->second + 1]; ++part) {
    if (!solids_[part].casts || part == piece.part || are_coplanar(part, piece.part)) continue;
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
  for (const Loop& loop : rest) open += area_along(own.normal, loop);
  if (open > slack) {
    violation(polygon.id, fmt::format("'{}' does not shadow all of the fragment", fragment.caster),
              piece.index);
  }
}

void WitnessChecker::check_family(const CandidatePolygon& polygon,
                                  const std::vector<std::uint32_t>& parts,
                                  std::vector<Piece>& pieces) {
  const ExactPoint& normal = solids_[parts.front()].normal;
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
      for (const HalfSpace& wall : walls_of(pieces[j], normal)) {
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

void WitnessChecker::check_fractions(const CandidatePolygon& polygon,
                                     const std::vector<Piece>& pieces,
                                     const std::vector<std::uint32_t>& parts) {
  if (!polygon.lit_fraction && !polygon.shadow_fraction && !polygon.penumbra_fraction &&
      !polygon.umbra_fraction) {
    return;
  }
  const std::uint32_t index = prepared_.parts[parts.front()].polygon;
  if (parts.size() != prepared_.first_part[index + 1] - prepared_.first_part[index]) return;
  std::array<mpq_class, 4> areas;  // by ShadeClass
  bool exact = true;
  for (const Piece& piece : pieces) {
    areas[static_cast<std::size_t>(piece.fragment->shade)] += piece.area;
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
  const auto claim = [&](const std::optional<mpq_class>& claimed, ShadeClass shade) {
    const mpq_class& area = areas[static_cast<std::size_t>(shade)];
    const char* name = name_of(shade);
    if (claimed && abs(mpq_class(*claimed - area / whole)) > slack) {
      violation(polygon.id,
                fmt::format("the {} fraction is claimed as {}, but the fragments say {}", name,
                            claimed->get_str(), mpq_class(area / whole).get_str()));
    }
  };
  claim(polygon.lit_fraction, ShadeClass::kLit);
  claim(polygon.shadow_fraction, ShadeClass::kShadow);
  claim(polygon.penumbra_fraction, ShadeClass::kPenumbra);
  claim(polygon.umbra_fraction, ShadeClass::kUmbra);
}

bool WitnessChecker::sees(std::uint32_t part, PolygonSide side) const {
  if (area_) return area_->sees(part, side);
  const Solid& solid = solids_[part];
  return solid.receives && (side == PolygonSide::kFront ? solid.facing > 0 : solid.facing < 0);
}

/// A polygon is listed once for each side that some part of it sees the light from, or with its
/// front.
std::vector<PolygonSide> WitnessChecker::listed_sides(std::uint32_t polygon) const {
  std::vector<PolygonSide> sides;
  for (const PolygonSide side : {PolygonSide::kFront, PolygonSide::kBack}) {
    for (std::uint32_t part = prepared_.first_part[polygon];
         part < prepared_.first_part[polygon + 1]; ++part) {
      if (!sees(part, side)) continue;
      sides.push_back(side);
      break;
    }
  }
  if (sides.empty()) sides.push_back(PolygonSide::kFront);
  return sides;
}

/// All of the polygon's parts by plane. Planes that see the light from the other side alone may be
/// listed here, as dark; what sees nothing belongs to the first side listed.
std::map<PlaneId, std::vector<std::uint32_t>> WitnessChecker::families_on(
    std::uint32_t polygon, PolygonSide side, std::set<PlaneId>& optional) const {
  std::map<PlaneId, std::vector<std::uint32_t>> families;
  for (std::uint32_t part = prepared_.first_part[polygon]; part < prepared_.first_part[polygon + 1];
       ++part) {
    families[prepared_.parts[part].plane].push_back(part);
  }
  const PolygonSide first = listed_sides(polygon).front();
  for (const auto& [plane, parts] : families) {
    const auto seen_from = [&, &family = parts](PolygonSide from) {
      return std::any_of(family.begin(), family.end(),
                         [&](std::uint32_t part) { return sees(part, from); });
    };
    const bool dark = !seen_from(PolygonSide::kFront) && !seen_from(PolygonSide::kBack);
    if (!seen_from(side) && !(dark && side == first)) optional.insert(plane);
  }
  return families;
}

void WitnessChecker::check_polygon(const CandidatePolygon& polygon) {
  ++report_.polygons;
  const auto known = polygon_index_.find(polygon.id);
  if (known == polygon_index_.end()) {
    return violation(polygon.id, "no such polygon in the scene");
  }
  // Parts of this side, by family of coplanar ones.
  std::set<PlaneId> optional;
  const std::map<PlaneId, std::vector<std::uint32_t>> families =
      families_on(known->second, polygon.side, optional);
  std::map<PlaneId, std::vector<Piece>> pieces;
  for (std::size_t i = 0; i < polygon.fragments.size(); ++i) {
    const CandidateFragment& fragment = polygon.fragments[i];
    ++report_.fragments;
    if (fragment.exact) ++report_.exact_fragments;
    if (fragment.shade != ShadeClass::kLit && (fragment.shade == ShadeClass::kShadow) == !!area_) {
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
    // The family whose plane is nearest, by squared distances; among planes as near as each other
    // the one with a part around the fragment's first vertex.
    const std::vector<std::uint32_t>* best = nullptr;
    PlaneId best_plane = 0;
    mpq_class best_distance;
    bool best_around = false;
    for (const auto& [plane, parts] : families) {
      const Solid& solid = solids_[parts.front()];
      mpq_class most;
      ExactPoint centre;
      for (const ExactPoint& point : fragment.loop) {
        const mpq_class height = dot(solid.normal, minus(point, solid.loop[0]));
        most = std::max(most, mpq_class(height * height));
        for (int k = 0; k < 3; ++k) centre[k] += point[k] / mpq_class(fragment.loop.size());
      }
      most /= dot(solid.normal, solid.normal);
      bool around = false;
      for (std::uint32_t part : parts) {
        around = around || std::all_of(solids_[part].walls.begin(), solids_[part].walls.end(),
                                       [&](const HalfSpace& w) { return w.value(centre) >= 0; });
      }
      const mpq_class allowed = fragment.exact ? mpq_class(0) : mpq_class(width_ * width_);
      const bool near = most <= allowed, best_near = best && best_distance <= allowed;
      const bool better = !best || (near && !best_near) ||
                          (near == best_near && around && !best_around) ||
                          (near == best_near && around == best_around && most < best_distance);
      if (!better) continue;
      best = &parts;
      best_plane = plane;
      best_distance = most;
      best_around = around;
    }
    if (!best) {
      violation(polygon.id, "nothing of the polygon is classified on this side", i);
      continue;
    }
    if (best_distance > (fragment.exact ? mpq_class(0) : mpq_class(width_ * width_))) {
      violation(polygon.id, "a fragment does not lie in the polygon's plane", i);
      continue;
    }
    Piece piece{&fragment, i, best->front(), fragment.loop, {}, {}, {}, {}};
    const ExactPoint& normal = solids_[piece.part].normal;
    // Rounded vertices are off the plane by a hair, which must not put them behind a caster that
    // lies in it: what is judged is the fragment on its polygon.
    if (best_distance != 0) {
      const mpq_class square = dot(normal, normal);
      for (ExactPoint& point : piece.loop) {
        const mpq_class height = dot(normal, minus(point, solids_[piece.part].loop[0])) / square;
        for (int k = 0; k < 3; ++k) point[k] -= height * normal[k];
      }
    }
    piece.area = area_along(normal, piece.loop);
    if (piece.area < 0) {
      std::reverse(piece.loop.begin(), piece.loop.end());
      piece.area = -piece.area;
    }
    bool convex = true;
    const std::size_t size = piece.loop.size();
    for (std::size_t v = 0; v < size && fragment.exact; ++v) {
      const ExactPoint &a = piece.loop[v], &b = piece.loop[(v + 1) % size];
      const ExactPoint inward = cross(normal, minus(b, a));
      for (const ExactPoint& point : piece.loop) {
        convex = convex && dot(inward, minus(point, a)) >= 0;
      }
    }
    if (!convex) {
      violation(polygon.id, "a fragment is not convex", i);
      continue;
    }
    for (int k = 0; k < 3; ++k) {
      piece.low[k] = piece.high[k] = piece.loop[0][k].get_d();
      for (const ExactPoint& point : piece.loop) {
        piece.low[k] = std::min(piece.low[k], round_down(point[k].get_d()));
        piece.high[k] = std::max(piece.high[k], round_up(point[k].get_d()));
      }
    }
    pieces[best_plane].push_back(std::move(piece));
  }
  for (const auto& [plane, parts] : families) {
    if (optional.contains(plane) && pieces[plane].empty()) continue;
    check_family(polygon, parts, pieces[plane]);
  }
}

WitnessReport WitnessChecker::run() {
  std::size_t all = 0, done = 0;
  for (const CandidateLight& light : candidate_.lights) all += light.polygons.size();
  std::set<std::string> listed;
  for (const CandidateLight& light : candidate_.lights) {
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
    read_parts(*own);
    per_caster_umbra_ = light.per_caster_umbra;
    std::set<std::string> polygons;
    std::set<std::pair<std::string, PolygonSide>> sides;
    for (const CandidatePolygon& polygon : light.polygons) {
      if (options_.interrupted && options_.interrupted->load(std::memory_order_relaxed)) {
        report_.interrupted = true;
        return std::move(report_);
      }
      polygons.insert(polygon.id);
      // A foreign file that names no side means the only one.
      std::optional<CandidatePolygon> turned;
      const auto known = polygon_index_.find(polygon.id);
      if (area_ && !polygon.side_given && known != polygon_index_.end()) {
        const std::vector<PolygonSide> listed_on = listed_sides(known->second);
        if (listed_on.size() == 1 && listed_on[0] != polygon.side) {
          turned = polygon;
          turned->side = listed_on[0];
        }
      }
      const CandidatePolygon& judged = turned ? *turned : polygon;
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
      for (const PolygonSide side : listed_sides(p)) {
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
                              const Candidate& candidate, const WitnessOptions& options) {
  return WitnessChecker(scene, prepared, candidate, options).run();
}

}  // namespace gnomon::oracle
