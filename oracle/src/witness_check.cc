// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnomon/oracle/witness_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "gnomon/oracle/compare.h"
#include "gnomon/oracle/verdict.h"

namespace gnomon::oracle {

namespace {

using Loop = std::vector<ExactPoint>;

ExactPoint minus(const ExactPoint& a, const ExactPoint& b) {
  return {mpq_class(a[0] - b[0]), mpq_class(a[1] - b[1]), mpq_class(a[2] - b[2])};
}
mpq_class dot(const ExactPoint& a, const ExactPoint& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
ExactPoint cross(const ExactPoint& a, const ExactPoint& b) {
  return {mpq_class(a[1] * b[2] - a[2] * b[1]), mpq_class(a[2] * b[0] - a[0] * b[2]),
          mpq_class(a[0] * b[1] - a[1] * b[0])};
}

/// normal . (x - base) >= 0.
struct HalfSpace {
  ExactPoint normal, base;
  std::array<double, 3> near_normal{}, near_base{};  // normal of length about 1

  HalfSpace(ExactPoint n, const ExactPoint& b) : normal(std::move(n)), base(b) {
    // Scaled first: a normal is a product of lengths, and may leave the range of doubles.
    mpq_class most = 0;
    for (const mpq_class& c : normal) {
      if (cmp(abs(c), most) > 0) most = abs(c);
    }
    for (int k = 0; k < 3 && most != 0; ++k) near_normal[k] = mpq_class(normal[k] / most).get_d();
    for (int k = 0; k < 3; ++k) near_base[k] = base[k].get_d();
  }
  mpq_class value(const ExactPoint& point) const { return dot(normal, minus(point, base)); }
  double near_value(const std::array<double, 3>& p) const {
    double sum = 0;
    for (int k = 0; k < 3; ++k) sum += near_normal[k] * (p[k] - near_base[k]);
    return sum;
  }
};

/// What is left of a convex loop in a half-space; empty without area there.
Loop cut(const Loop& loop, const HalfSpace& half) {
  Loop result;
  std::vector<mpq_class> values;
  bool inside = false, outside = false;
  for (const ExactPoint& point : loop) {
    values.push_back(half.value(point));
    inside = inside || values.back() > 0;
    outside = outside || values.back() < 0;
  }
  if (!inside) return {};
  if (!outside) return loop;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const std::size_t j = (i + 1) % loop.size();
    if (values[i] >= 0) result.push_back(loop[i]);
    if (sgn(values[i]) * sgn(values[j]) < 0) {
      const mpq_class t = values[i] / (values[i] - values[j]);
      ExactPoint crossing;
      for (int k = 0; k < 3; ++k) crossing[k] = loop[i][k] + t * (loop[j][k] - loop[i][k]);
      result.push_back(std::move(crossing));
    }
  }
  return result;
}

/// Area along a normal: half of normal . area vector. Signed by the loop's orientation.
mpq_class area_along(const ExactPoint& normal, const Loop& loop) {
  ExactPoint sum;
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    const ExactPoint term = cross(minus(loop[i], loop[0]), minus(loop[i + 1], loop[0]));
    for (int k = 0; k < 3; ++k) sum[k] += term[k];
  }
  return dot(normal, sum) / 2;
}

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
    std::uint32_t part = 0;  // a part of the family whose plane it lies in
    Loop loop;               // oriented like that part
    mpq_class area;          // along the part's normal
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
  void check_polygon(const CandidatePolygon& polygon);
  void check_family(const CandidatePolygon& polygon, const std::vector<std::uint32_t>& parts,
                    std::vector<Piece>& pieces);
  void check_shade(const CandidatePolygon& polygon, const Piece& piece, const mpq_class& slack);
  void check_fractions(const CandidatePolygon& polygon, const std::vector<Piece>& pieces,
                       const std::vector<std::uint32_t>& parts);
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
  WitnessReport report_;
};

void WitnessChecker::read_parts(const PreparedLight& light) {
  const Geometry& geometry = prepared_.geometry;
  const auto in_scene = [&](const std::array<mpz_class, 3>& grid) {
    ExactPoint point;
    for (int k = 0; k < 3; ++k) point[k] = geometry.origin[k] + geometry.step * grid[k];
    return point;
  };
  const bool directional = light.point.directional;
  ExactPoint source;
  if (directional) {
    for (int k = 0; k < 3; ++k) source[k] = light.point.grid[k];
  } else {
    source = in_scene(light.point.grid);
  }
  solids_.clear();
  for (const Part& part : prepared_.parts) {
    Solid solid;
    for (VertexId vertex : prepared_.loop(part)) {
      solid.loop.push_back(in_scene(
          {geometry.grid.at(vertex, 0), geometry.grid.at(vertex, 1), geometry.grid.at(vertex, 2)}));
    }
    const std::size_t size = solid.loop.size();
    solid.normal = cross(minus(solid.loop[1], solid.loop[0]), minus(solid.loop[2], solid.loop[0]));
    const mpq_class height =
        directional ? dot(solid.normal, source) : dot(solid.normal, minus(source, solid.loop[0]));
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
    if (!solids_[part].casts || part == piece.part) continue;
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
      const Loop& other = pieces[j].loop;
      Loop rest = pieces[i].loop;
      for (std::size_t e = 0; e < other.size() && !rest.empty(); ++e) {
        const ExactPoint &a = other[e], &b = other[(e + 1) % other.size()];
        const ExactPoint inward = cross(normal, minus(b, a));
        if (dot(inward, inward) == 0) continue;
        rest = cut(rest, HalfSpace(inward, a));
      }
      const bool both = pieces[i].fragment->exact && pieces[j].fragment->exact;
      if (!rest.empty() && area_along(normal, rest) > slack_of(both)) {
        violation(polygon.id, fmt::format("the fragment overlaps fragment {}", pieces[j].index),
                  pieces[i].index);
      }
    }
  }
  for (const Piece& piece : pieces) check_shade(polygon, piece, slack_of(piece.fragment->exact));
  check_fractions(polygon, pieces, parts);
}

void WitnessChecker::check_fractions(const CandidatePolygon& polygon,
                                     const std::vector<Piece>& pieces,
                                     const std::vector<std::uint32_t>& parts) {
  if (!polygon.lit_fraction && !polygon.shadow_fraction) return;
  const std::uint32_t index = prepared_.parts[parts.front()].polygon;
  if (parts.size() != prepared_.first_part[index + 1] - prepared_.first_part[index]) return;
  mpq_class lit, shadow;
  bool exact = true;
  for (const Piece& piece : pieces) {
    (piece.fragment->shade == ShadeClass::kLit ? lit : shadow) += piece.area;
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
  const auto claim = [&](const std::optional<mpq_class>& claimed, const mpq_class& area,
                         const char* name) {
    if (claimed && abs(mpq_class(*claimed - area / whole)) > slack) {
      violation(polygon.id,
                fmt::format("the {} fraction is claimed as {}, but the fragments say {}", name,
                            claimed->get_str(), mpq_class(area / whole).get_str()));
    }
  };
  claim(polygon.lit_fraction, lit, "lit");
  claim(polygon.shadow_fraction, shadow, "shadow");
}

void WitnessChecker::check_polygon(const CandidatePolygon& polygon) {
  ++report_.polygons;
  const auto known = polygon_index_.find(polygon.id);
  if (known == polygon_index_.end()) {
    return violation(polygon.id, "no such polygon in the scene");
  }
  // Parts of this side, by family of coplanar ones.
  std::map<PlaneId, std::vector<std::uint32_t>> families;
  for (std::uint32_t part = prepared_.first_part[known->second];
       part < prepared_.first_part[known->second + 1]; ++part) {
    const Solid& solid = solids_[part];
    const PolygonSide side =
        solid.receives && solid.facing < 0 ? PolygonSide::kBack : PolygonSide::kFront;
    if (side == polygon.side) families[prepared_.parts[part].plane].push_back(part);
  }
  std::map<PlaneId, std::vector<Piece>> pieces;
  for (std::size_t i = 0; i < polygon.fragments.size(); ++i) {
    const CandidateFragment& fragment = polygon.fragments[i];
    ++report_.fragments;
    if (fragment.exact) ++report_.exact_fragments;
    if (fragment.shade != ShadeClass::kLit && fragment.shade != ShadeClass::kShadow) {
      violation(polygon.id, "a class that a point light does not have", i);
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
    Piece piece{&fragment, i, best->front(), fragment.loop, {}, {}, {}};
    const ExactPoint& normal = solids_[piece.part].normal;
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
  for (const auto& [plane, parts] : families) check_family(polygon, parts, pieces[plane]);
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
    if (own->type == LightType::kArea) continue;
    read_parts(*own);
    std::set<std::string> polygons;
    for (const CandidatePolygon& polygon : light.polygons) {
      if (options_.interrupted && options_.interrupted->load(std::memory_order_relaxed)) {
        report_.interrupted = true;
        return std::move(report_);
      }
      polygons.insert(polygon.id);
      check_polygon(polygon);
      if (options_.progress) {
        options_.progress(static_cast<double>(++done) / static_cast<double>(all));
      }
    }
    for (std::uint32_t p = 0; p < scene_.polygons.size() && !options_.subset; ++p) {
      const bool has_parts = prepared_.first_part[p] != prepared_.first_part[p + 1];
      if (has_parts && !polygons.contains(scene_.polygons[p].id)) {
        violation(scene_.polygons[p].id, "the polygon is missing");
      }
    }
  }
  for (const PreparedLight& light : prepared_.lights) {
    const std::string& id = scene_.lights[light.light].id;
    if (light.type == LightType::kArea || options_.subset || listed.contains(id)) continue;
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
