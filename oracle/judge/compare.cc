// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnomon/oracle/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>
#include <ranges>

#include "oracle/answer/deep_umbra.h"
#include "oracle/answer/truth_overlay.h"
#include "oracle/geometry/group_overlay.h"
#include "oracle/geometry/region_width.h"
#include "oracle/judge/area_clearance.h"
#include "oracle/judge/cells.h"
#include "oracle/judge/claimed_groups.h"
#include "oracle/judge/clearance.h"
#include "oracle/judge/rounding_cells.h"
#include "oracle/judge/share_check.h"
#include "oracle/judge/told_share_check.h"

namespace gnomon::oracle {

namespace {

/// Faces joined across edges between two faces that `joined` both accepts. Returns a region a face.
template <class Joined>
std::vector<std::uint32_t> connect(const Overlay& overlay, const Joined& joined) {
  std::vector<std::uint32_t> parent(overlay.faces().size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto find = [&](std::uint32_t f) {
    while (parent[f] != f) f = parent[f] = parent[parent[f]];
    return f;
  };
  for (std::uint32_t h = 0; h < overlay.halfedges().size(); h += 2) {
    const std::uint32_t a = overlay.halfedges()[h].face;
    const std::uint32_t b = overlay.halfedges()[Overlay::twin(h)].face;
    if (a != b && joined(a, b)) parent[find(a)] = find(b);
  }
  for (std::uint32_t f = 0; f < parent.size(); ++f) parent[f] = find(f);
  return parent;
}

/// Regions that claim class c where it is false and touch no region where it is true; and true
/// regions of class c in which it was found nowhere.
void count_leaks(const Overlay& overlay, const std::vector<Cell>& cells, LightState shade,
                 const Rules& rules, PolygonComparison& result) {
  const auto claims = [&](std::uint32_t f) { return cells[f].claims(shade); };
  const auto is_true = [&](std::uint32_t f) { return cells[f].inside && cells[f].truth == shade; };
  const auto claims_wrongly = [&](std::uint32_t f) {
    return cells[f].inside && claims(f) && !cells[f].accepts(shade, rules);
  };
  const std::vector<std::uint32_t> wrong = connect(overlay, [&](std::uint32_t a, std::uint32_t b) {
    return claims_wrongly(a) && claims_wrongly(b);
  });
  const std::vector<std::uint32_t> right =
      connect(overlay, [&](std::uint32_t a, std::uint32_t b) { return is_true(a) && is_true(b); });
  std::vector<bool> touches(cells.size(), false), found(cells.size(), false);
  for (std::uint32_t h = 0; h < overlay.halfedges().size(); ++h) {
    const std::uint32_t here = overlay.halfedges()[h].face;
    const std::uint32_t there = overlay.halfedges()[Overlay::twin(h)].face;
    if (claims_wrongly(here) && is_true(there)) touches[wrong[here]] = true;
  }
  for (std::uint32_t f = 1; f < cells.size(); ++f) {
    // Where another class is as good, it counts as found.
    if (is_true(f) && (claims(f) || !cells[f].misclassified)) found[right[f]] = true;
  }
  for (std::uint32_t f = 1; f < cells.size(); ++f) {
    if (claims_wrongly(f) && wrong[f] == f && !touches[f]) ++result.invented;
    if (is_true(f) && right[f] == f && !found[f]) ++result.lost;
  }
}

struct ProjectedFragment {
  const ClaimedFragment* fragment = nullptr;
  NormalisedLoop loop;
};

class GroupComparison {
 public:
  GroupComparison(const ExactAnswer& answer, std::uint32_t light, const AnswerEntry& entry,
                  const ReceiverGroup& group, const ClaimedTerms& terms,
                  const ComparisonOptions& options, PolygonComparison& result)
      : answer_(answer),
        light_(light),
        entry_(entry),
        group_(group),
        terms_(terms),
        rules_(rules_of(terms, answer.is_area(light), group)),
        options_(options),
        result_(result),
        overlay_(answer.prepared(), group.parts, truth_of(answer, light, group)) {}

  void add(const ClaimedFragment& fragment);
  void compare();

  struct Shares {
    AreaShare lit, shadow, penumbra, umbra, missing_umbra, misclassified, uncovered, overlapping,
        outside, ill_conditioned, rounding;
    AreaShare judged_misclassified, judged_uncovered, judged_overlapping, judged_outside;
  };
  const Shares& shares() const { return shares_; }

 private:
  Layer layer_of(LightState shade) const { return gnomon::oracle::layer_of(shade, rules_.area); }
  std::vector<Cell> read_cells() const;
  void add_deep_umbra();
  /// What excuses a cell's error.
  struct Excuses {
    std::vector<bool> ill_conditioned, rounding;
  };
  void examine_regions(const std::vector<Cell>& cells, Excuses& excuses);
  /// Keeps the widest, those that count before those that are excused.
  void keep(ErrorRegion region, const std::vector<std::uint32_t>& faces);
  /// Among those that are kept.
  std::size_t place_of(const ErrorRegion& region) const;
  double width_by_area(const std::vector<std::uint32_t>& faces,
                       const std::vector<std::uint32_t>& boundary) const;
  long double width_at_most(RoundingCells& places,
                            const std::vector<std::uint32_t>& boundary) const;
  double known_width(bool excused) const;
  /// `rounding`: all of it is. `known`: the width need not be told more closely, scene units. No
  /// more than the width is told of what will not be kept.
  ErrorRegion examine(const std::vector<std::uint32_t>& faces,
                      const std::vector<std::uint32_t>& boundary, const std::vector<Cell>& cells,
                      bool rounding, double known, long double most);
  void describe(Witness& witness, const Cell& cell, const ChartPoint& point) const;
  std::optional<double> clearance_of_area(const Witness& witness) const;
  std::string describe_shadow(Witness& witness, const std::string& claimed,
                              const ChartPoint& point) const;
  std::string describe_area(Witness& witness, const std::string& claimed,
                            const ChartPoint& point) const;
  const std::string& id_of(std::uint32_t part) const {
    return answer_.scene().polygons[answer_.prepared().parts[part].polygon].id;
  }
  /// A caster as seen from this polygon, which a part of it in another plane may shadow.
  std::string named(const std::string& caster) const {
    return caster == result_.polygon ? "another part of it" : "'" + caster + "'";
  }

  const ExactAnswer& answer_;
  std::uint32_t light_;
  const AnswerEntry& entry_;
  const ReceiverGroup& group_;
  const ClaimedTerms& terms_;
  Rules rules_;
  const ComparisonOptions& options_;
  PolygonComparison& result_;
  const PlaneFrame& frame() {
    if (!frame_) {
      frame_.emplace(answer_.prepared().geometry,
                     grid_loop(answer_.prepared(), group_.parts.front()));
    }
    return *frame_;
  }

  GroupOverlay overlay_;
  std::optional<PlaneFrame> frame_;  // made when first asked for
  std::vector<ProjectedFragment> fragments_;
  RoundingCells::Edges claimed_edges_;
  Shares shares_;
};

void GroupComparison::add(const ClaimedFragment& fragment) {
  const Geometry& geometry = answer_.prepared().geometry;
  const Chart& chart = overlay_.chart();
  // Of distances from the plane, that neither the grid's units nor the normal's go beyond doubles.
  const Integers3& normal = chart.support().normal;
  mpz_class size = 1;
  for (const mpz_class& component : normal) size = std::max<mpz_class>(size, abs(component));
  const mpq_class unit = geometry.step / size;
  Enclosure most, judged;
  const auto projected_loop = [&](const RationalLoop& points) {
    std::vector<ChartPoint> loop;
    for (const RationalPoint& point : points) {
      const HomogeneousPoint place = to_grid(geometry, point);
      const mpz_class value = value_at(chart.support(), place);
      if (value != 0) {
        const Enclosure own = enclose_ratio(value * unit.get_num(), place.w * unit.get_den());
        most = greater_of(most, own);
        const bool excused = result_.rounding_radius > 0 &&
                             is_rounding(std::fabs(frame().height(point)), result_.rounding_radius);
        if (!excused) judged = greater_of(judged, own);
      }
      loop.push_back(chart.project(place));
    }
    return loop;
  };
  std::vector<ChartPoint> loop = projected_loop(fragment.loop);
  std::vector<std::vector<ChartPoint>> holes;
  for (const RationalLoop& hole : fragment.holes) holes.push_back(projected_loop(hole));
  if (!most.is_zero()) {
    const Enclosure length = enclose_square_root(mpq_class(dot(normal, normal)) / (size * size));
    const auto in_scene = [&](Enclosure distance) {
      return distance.is_zero() ? distance : distance / length;
    };
    result_.off_plane = greater_of(result_.off_plane, in_scene(most));
    result_.judged_off_plane = greater_of(result_.judged_off_plane, in_scene(judged));
  }
  const auto keep_edges = [&](const std::vector<ChartPoint>& points) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      claimed_edges_.emplace_back(points[i], points[(i + 1) % points.size()]);
    }
  };
  keep_edges(loop);
  for (const std::vector<ChartPoint>& hole : holes) keep_edges(hole);
  ProjectedFragment projected{&fragment, normalise(std::move(loop), holes)};
  if (projected.loop.crosses_itself) ++result_.self_crossing;
  const auto mark = terms_.cover == Cover::kOverlay ? static_cast<std::uint32_t>(fragments_.size())
                                                    : Overlay::kNone;
  const Layer layer = layer_of(fragment.state);
  const std::vector<ChartPoint>& convex = projected.loop.loop;
  for (std::size_t i = 0; i < convex.size(); ++i) {
    overlay_.overlay().add_edge(convex[i], convex[(i + 1) % convex.size()], layer, 1, mark);
  }
  for (const auto& [a, b] : projected.loop.edges) overlay_.overlay().add_edge(a, b, layer, 1, mark);
  fragments_.push_back(std::move(projected));
}

void GroupComparison::compare() {
  if (rules_.area && !rules_.per_caster && group_.faces) add_deep_umbra();
  overlay_.build();
  const Overlay& overlay = overlay_.overlay();
  if (!overlay.consistent()) {
    result_.inconsistent = true;
    return;
  }
  const std::vector<Cell> cells = read_cells();
  result_.t_vertices += overlay.t_vertices();
  Excuses excuses{std::vector<bool>(cells.size(), false), std::vector<bool>(cells.size(), false)};
  if (std::any_of(cells.begin(), cells.end(), [](const Cell& cell) { return cell.errs(); })) {
    examine_regions(cells, excuses);
  }
  if (!group_.optional) {
    for (const LightState shade : kClasses) count_leaks(overlay, cells, shade, rules_, result_);
  }
  const auto share = [&](const auto& choice) {
    std::vector<bool> chosen(cells.size());
    for (std::size_t f = 1; f < cells.size(); ++f) chosen[f] = choice(cells[f], f);
    return overlay_.share(chosen, options_.exact_limit);
  };
  const auto truth = [&](LightState shade) {
    return share([=](const Cell& cell, std::size_t) { return cell.inside && cell.truth == shade; });
  };
  shares_.lit = truth(LightState::kLit);
  shares_.shadow = truth(LightState::kShadow);
  shares_.penumbra = truth(LightState::kPenumbra);
  shares_.umbra = truth(LightState::kUmbra);
  shares_.missing_umbra = share([](const Cell& cell, std::size_t) { return cell.missing_umbra; });
  const auto is_excused = [&](std::size_t f) {
    return excuses.ill_conditioned[f] || excuses.rounding[f];
  };
  const bool some_excused =
      std::ranges::any_of(std::views::iota(std::size_t{0}, cells.size()), is_excused);
  const auto both = [&](bool Cell::*member, AreaShare& all, AreaShare& judged) {
    all = share([&](const Cell& cell, std::size_t) { return cell.*member; });
    judged = all;
    if (!some_excused) return;
    judged = share([&](const Cell& cell, std::size_t f) { return cell.*member && !is_excused(f); });
  };
  both(&Cell::misclassified, shares_.misclassified, shares_.judged_misclassified);
  both(&Cell::uncovered, shares_.uncovered, shares_.judged_uncovered);
  both(&Cell::overlapping, shares_.overlapping, shares_.judged_overlapping);
  both(&Cell::outside, shares_.outside, shares_.judged_outside);
  shares_.ill_conditioned =
      share([&](const Cell&, std::size_t f) { return bool{excuses.ill_conditioned[f]}; });
  shares_.rounding = share([&](const Cell&, std::size_t f) { return bool{excuses.rounding[f]}; });
}

std::vector<Cell> GroupComparison::read_cells() const {
  const Overlay& overlay = overlay_.overlay();
  std::vector<Cell> cells(overlay.faces().size());
  if (terms_.cover == Cover::kPartition) {
    for (std::size_t f = 1; f < cells.size(); ++f) {
      const Winding& winding = overlay.faces()[f].winding;
      cells[f] = read_cell(winding, claimed_by(winding), rules_);
    }
    return cells;
  }
  overlay.for_each_marked_face([&](std::uint32_t face, const Overlay::MarkWindings& marks) {
    Claimed on_top;
    std::uint64_t level = 0;
    for (const auto& [mark, winding] : marks) {
      const ClaimedFragment& fragment = *fragments_[mark].fragment;
      if (on_top.loops == 0 || fragment.level > level) {
        level = fragment.level;
        on_top.states = {};
      }
      ++on_top.loops;
      if (fragment.level == level) on_top.add(class_of(layer_of(fragment.state)));
    }
    cells[face] = read_cell(overlay.faces()[face].winding, on_top, rules_);
  });
  return cells;
}

void GroupComparison::add_deep_umbra() {
  DeepUmbra deep(answer_, light_, group_, overlay_.chart());
  for (const ProjectedFragment& fragment : fragments_) {
    if (fragment.fragment->state != LightState::kUmbra) continue;
    if (fragment.loop.convex) {
      deep.certify(fragment.loop.loop);
      continue;
    }
    std::vector<ChartPoint> corners;
    for (const auto& [a, b] : fragment.loop.edges) corners.push_back(a);
    deep.certify_box_of(corners);
  }
  if (rules_.may_be_left_out(LightState::kUmbra)) deep.certify_whole();
  for (const std::vector<ChartPoint>& loop : deep.certified()) {
    overlay_.overlay().add_loop(loop, kDeep);
  }
}

void GroupComparison::examine_regions(const std::vector<Cell>& cells, Excuses& excuses) {
  const Overlay& overlay = overlay_.overlay();
  const std::vector<std::uint32_t> region_of =
      connect(overlay,
              [&](std::uint32_t a, std::uint32_t b) { return cells[a].errs() && cells[b].errs(); });
  std::vector<std::vector<std::uint32_t>> faces(cells.size()), boundaries(cells.size());
  for (std::uint32_t f = 1; f < cells.size(); ++f) {
    if (cells[f].errs()) faces[region_of[f]].push_back(f);
  }
  for (std::uint32_t h = 0; h < overlay.halfedges().size(); ++h) {
    const std::uint32_t here = overlay.halfedges()[h].face;
    const std::uint32_t there = overlay.halfedges()[Overlay::twin(h)].face;
    if (cells[here].errs() && region_of[here] != region_of[there]) {
      boundaries[region_of[here]].push_back(h);
    }
  }
  RoundingCells rounding(frame(), overlay_.chart(), overlay, claimed_edges_,
                         result_.rounding_radius);
  // The widest first, as far as that is seen at a glance: others are then known to be narrower.
  std::vector<std::pair<long double, std::uint32_t>> order;
  for (std::uint32_t r = 0; r < faces.size(); ++r) {
    if (!faces[r].empty()) order.emplace_back(width_at_most(rounding, boundaries[r]), r);
  }
  // What is as wide but for rounding stays in the order of the regions.
  std::ranges::stable_sort(order, std::greater<>(),
                           [](const auto& own) { return static_cast<float>(own.first); });
  for (const auto& [most, r] : order) {
    ++result_.regions;
    bool all_rounding = true;
    for (const std::uint32_t face : faces[r]) {
      excuses.rounding[face] = rounding.contains(face);
      all_rounding = all_rounding && excuses.rounding[face];
    }
    if (all_rounding && !options_.measure_rounding) {
      ++result_.rounding_regions;
      continue;
    }
    const double known = known_width(all_rounding);
    if (known > 0 && most <= known) {
      if (all_rounding) ++result_.rounding_regions;
      continue;
    }
    ErrorRegion region = examine(faces[r], boundaries[r], cells, all_rounding, known, most);
    result_.width = greater_of(result_.width, region.witness.width);
    if (region.ill_conditioned) {
      ++result_.ill_conditioned_regions;
      for (std::uint32_t face : faces[r]) {
        excuses.ill_conditioned[face] = true;
        excuses.rounding[face] = false;
      }
      region.rounding = false;
    } else if (all_rounding) {
      ++result_.rounding_regions;
    } else {
      result_.judged_width = greater_of(result_.judged_width, region.witness.width);
    }
    keep(std::move(region), faces[r]);
  }
  // The widest alone is described: who decides is looked for among all casters.
  if (result_.worst.empty() || !result_.worst.front().witness.text.empty()) return;
  Witness& widest = result_.worst.front().witness;
  const ChartPoint point =
      overlay_.chart().project(to_grid(answer_.prepared().geometry, widest.point));
  Cell cell;
  cell.inside = widest.truth.has_value();
  cell.truth = widest.truth.value_or(LightState::kLit);
  describe(widest, cell, point);
}

/// Of the region between halfedges, scene units, seen at a glance: no disc in it is wider than a
/// strip that holds it.
long double GroupComparison::width_at_most(RoundingCells& places,
                                           const std::vector<std::uint32_t>& boundary) const {
  PlanarLoop points;
  long double greatest = 0;
  for (const std::uint32_t halfedge : boundary) {
    const PlanarPoint& point =
        points.emplace_back(places.at_vertex(overlay_.overlay().halfedges()[halfedge].origin));
    greatest = std::max({greatest, std::fabs(point.x), std::fabs(point.y)});
  }
  const long double width = strip_width_of(points) + 8 * kPlanarError * greatest;
  return std::isfinite(width) ? width : std::numeric_limits<long double>::infinity();
}

/// Of a region of so many edges that its trapezoids may be too many to look at: what its area
/// allows, scene units.
double GroupComparison::width_by_area(const std::vector<std::uint32_t>& faces,
                                      const std::vector<std::uint32_t>& boundary) const {
  constexpr std::size_t kFewEdges = 200;
  if (boundary.size() < kFewEdges) return std::numeric_limits<double>::infinity();
  std::vector<bool> chosen(overlay_.overlay().faces().size(), false);
  for (const std::uint32_t face : faces) chosen[face] = true;
  const double share = overlay_.share(chosen, 0).fraction.upper;
  // 1 is also what is told where fixed point tells nothing.
  if (!(share < 1)) return std::numeric_limits<double>::infinity();
  const PreparedScene& prepared = answer_.prepared();
  const long double width = width_of_area(share, group_area_on_grid(prepared, group_.parts).upper);
  return round_up(static_cast<double>(width * nearest(prepared.geometry.step)));
}

/// What a region has to be wider than to matter: neither a greatest width nor the regions that are
/// kept change with one that is not.
double GroupComparison::known_width(bool excused) const {
  if (options_.clearance > 0 || result_.worst.size() < options_.most_regions) return 0;
  if (result_.worst.empty()) return excused ? result_.width.upper : result_.judged_width.upper;
  const ErrorRegion& last = result_.worst.back();
  if (last.excused() != excused) return excused ? result_.width.upper : 0;
  return last.witness.width.upper;
}

std::size_t GroupComparison::place_of(const ErrorRegion& region) const {
  const auto worse = [](const ErrorRegion& a, const ErrorRegion& b) {
    if (a.excused() != b.excused()) return b.excused();
    return a.witness.width.middle() > b.witness.width.middle();
  };
  return static_cast<std::size_t>(std::ranges::upper_bound(result_.worst, region, worse) -
                                  result_.worst.begin());
}

void GroupComparison::keep(ErrorRegion region, const std::vector<std::uint32_t>& faces) {
  const std::size_t place = place_of(region);
  if (place >= options_.most_regions) return;
  std::vector<bool> chosen(overlay_.overlay().faces().size(), false);
  for (const std::uint32_t face : faces) chosen[face] = true;
  region.area = overlay_.share(chosen, options_.exact_limit);
  result_.worst.insert(result_.worst.begin() + static_cast<std::ptrdiff_t>(place),
                       std::move(region));
  if (result_.worst.size() > options_.most_regions) result_.worst.pop_back();
}

ErrorRegion GroupComparison::examine(const std::vector<std::uint32_t>& faces,
                                     const std::vector<std::uint32_t>& boundary,
                                     const std::vector<Cell>& cells, bool rounding, double known,
                                     long double most) {
  const Overlay& overlay = overlay_.overlay();
  const Geometry& geometry = answer_.prepared().geometry;
  const ChartMetric metric(overlay_.chart());
  ErrorRegion region;
  const double strip = round_up(static_cast<double>(most));
  const RegionShape shape =
      measure_region(overlay, metric, boundary,
                     {.step = nearest(geometry.step),
                      .resolution = std::max(options_.width_resolution, known),
                      .most = std::min(strip, width_by_area(faces, boundary))});
  Witness& witness = region.witness;
  witness.width = not_negative(shape.width);
  region.rounding = rounding;
  if (!(options_.clearance > 0) && place_of(region) >= options_.most_regions) return region;
  // The point belongs to one of the faces: say what is wrong right there. A region of several faces
  // is represented by the face that errs worst.
  std::uint32_t worst = faces.front();
  for (std::uint32_t face : faces) {
    if (kind_of(cells[face]) > kind_of(cells[worst])) worst = face;
  }
  ChartPoint inner = shape.interior;
  if (faces.size() > 1) {
    std::vector<std::uint32_t> own;
    overlay.for_each_halfedge(worst, [&](std::uint32_t h) {
      if (overlay.halfedges()[Overlay::twin(h)].face != worst) own.push_back(h);
    });
    // How wide it is does not matter.
    const WidthQuestion none{.resolution = std::numeric_limits<double>::infinity()};
    inner = measure_region(overlay, metric, own, none).interior;
  }
  const Cell& cell = cells[worst];
  witness.kind = kind_of(cell);
  if (cell.inside) witness.truth = cell.truth;
  witness.found = wrong_class(cell, rules_);
  witness.point = overlay_.chart().lift_to_scene(geometry, inner);
  for (int k = 0; k < 3; ++k) witness.nearest[k] = enclose(witness.point[k]).middle();
  witness.light = answer_.scene().lights[answer_.prepared().lights[light_].light].id;
  witness.polygon = result_.polygon;
  witness.side = entry_.side;
  witness.block = terms_.block;
  if (options_.clearance > 0 && group_.faces && witness.kind == ErrorKind::kMisclassified) {
    witness.clearance = rules_.area ? clearance_of_area(witness)
                                    : decide(answer_.prepared(), answer_.prepared().lights[light_],
                                             group_.parts.front(), witness.point)
                                          .clearance;
    region.ill_conditioned = witness.clearance && *witness.clearance < options_.clearance;
  }
  return region;
}

std::optional<double> GroupComparison::clearance_of_area(const Witness& witness) const {
  if (!witness.found) return std::nullopt;
  return area_clearance(answer_.prepared(), answer_.prepared().lights[light_],
                        answer_.area_visibility(light_), group_.parts, group_.side, witness.point,
                        {.state = *witness.found, .per_caster = rules_.per_caster});
}

/// Names the caster that decides, and what follows the true class in a sentence.
std::string GroupComparison::describe_shadow(Witness& witness, const std::string& claimed,
                                             const ChartPoint& point) const {
  if (!group_.faces) {
    return group_.light_in_plane ? " (the light is in its plane)" : " (it faces away)";
  }
  const PreparedScene& prepared = answer_.prepared();
  bool outside = false;
  for (std::uint32_t part : group_.parts) {
    for (const ShadowPiece& piece : answer_.shadows(light_, part)) {
      if (!witness.caster.empty() || !contains(piece.loop, point)) continue;
      if (piece.caster == ShadowPiece::kOutsideRegion) {
        outside = true;
      } else {
        witness.caster = id_of(piece.caster);
      }
    }
  }
  if (outside && witness.caster.empty()) return " (outside of the light's region)";
  const Decision decision =
      decide(prepared, prepared.lights[light_], group_.parts.front(), witness.point);
  if (!witness.clearance) witness.clearance = decision.clearance;
  if (witness.caster.empty()) {
    witness.caster = !claimed.empty()  ? claimed
                     : decision.caster ? id_of(*decision.caster)
                                       : std::string();
    // What is lit is not so by a part of its own polygon.
    if (witness.truth == LightState::kLit && witness.caster == result_.polygon) {
      witness.caster.clear();
    }
  }
  return witness.truth == LightState::kShadow ? " behind " + named(witness.caster) : std::string();
}

std::string GroupComparison::describe_area(Witness& witness, const std::string& claimed,
                                           const ChartPoint& point) const {
  if (!group_.faces) return " (it sees nothing of the light)";
  if (!witness.clearance && witness.kind == ErrorKind::kMisclassified) {
    witness.clearance = clearance_of_area(witness);
  }
  bool penumbra = false;
  for (std::uint32_t part : group_.parts) {
    const AreaShade& shade = answer_.area_shade(light_, part, group_.side);
    if (!shade.behind.empty() && contains(shade.behind, point)) return " (behind the light)";
    for (const ShadowPiece& piece : shade.umbra) {
      if (!contains(piece.loop, point)) continue;
      witness.caster = id_of(piece.caster);
      return " behind " + named(witness.caster);
    }
    for (const ShadowPiece& piece : shade.penumbra) {
      if (penumbra || !contains(piece.loop, point)) continue;
      penumbra = true;
      witness.caster = id_of(piece.caster);
    }
  }
  if (!penumbra) {
    witness.caster = claimed;
    return {};
  }
  std::string text = " of " + named(witness.caster);
  if (witness.found == LightState::kUmbra && !rules_.per_caster) {
    const AreaPointVisibility seen =
        answer_.area_visibility(light_).at(group_.parts.front(), group_.side, witness.point);
    text += seen.deep() ? "; that no light arrives nearby could not be certified"
                        : fmt::format("; {:.3g} of the light is seen", seen.visible.get_d());
  }
  return text;
}

void GroupComparison::describe(Witness& witness, const Cell& cell, const ChartPoint& point) const {
  std::string claimed;
  for (const ProjectedFragment& fragment : fragments_) {
    if (fragment.loop.convex && contains(fragment.loop.loop, point)) {
      claimed = fragment.fragment->caster;
      if (!claimed.empty()) break;
    }
  }
  std::string truth = "outside the polygon";
  if (cell.inside) {
    truth = std::string("truly ") + name_of(cell.truth);
    truth += rules_.area ? describe_area(witness, claimed, point)
                         : describe_shadow(witness, claimed, point);
  }
  std::string found = "nothing found";
  if (witness.kind == ErrorKind::kOverlapping) {
    found = "covered more than once";
  } else if (witness.found) {
    found = std::string("found ") + name_of(*witness.found);
    if (!claimed.empty() && *witness.found != LightState::kLit) {
      found += " (caster " + named(claimed) + ")";
    }
  }
  witness.text = found + ", " + truth;
}

}  // namespace

const char* name_of(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::kNone:
      return "none";
    case ErrorKind::kOverlapping:
      return "overlapping";
    case ErrorKind::kOutside:
      return "outside";
    case ErrorKind::kUncovered:
      return "uncovered";
    case ErrorKind::kMisclassified:
      return "misclassified";
  }
  return "";
}

PolygonComparison compare_entry(const ExactAnswer& answer, std::uint32_t light,
                                const AnswerEntry& entry, const ClaimedPolygon* candidate,
                                const ClaimedTerms& terms, const ComparisonOptions& options) {
  if (candidate && !candidate->told.empty()) {
    return compare_told_shares(answer, light, entry, *candidate, terms, options);
  }
  if (terms.shares_alone && candidate) return compare_shares(answer, light, entry, *candidate);
  PolygonComparison result;
  result.polygon = answer.scene().polygons[entry.polygon].id;
  result.side = entry.side;
  std::vector<std::vector<const ClaimedFragment*>> fragments(entry.groups.size());
  std::vector<Chart> charts;
  for (const ReceiverGroup& group : entry.groups) {
    charts.emplace_back(support_of(answer.prepared(), group.parts.front()));
  }
  const auto is_exact = [](const ClaimedFragment& fragment) { return fragment.exact; };
  if (!candidate || candidate->fragments.empty() ||
      !std::ranges::all_of(candidate->fragments, is_exact)) {
    result.rounding_radius =
        static_cast<double>(rounding_radius(answer.scene(), answer.prepared(), entry.polygon));
  }
  if (candidate) {
    result.fragments = candidate->fragments.size();
    for (const ClaimedFragment& fragment : candidate->fragments) {
      const std::size_t group = group_for(answer, entry, charts, fragment, result.rounding_radius);
      fragments[group].push_back(&fragment);
    }
  }
  using Shares = GroupComparison::Shares;
  constexpr std::pair<AreaShare Shares::*, AreaShare PolygonComparison::*> kShares[] = {
      {&Shares::lit, &PolygonComparison::lit},
      {&Shares::shadow, &PolygonComparison::shadow},
      {&Shares::penumbra, &PolygonComparison::penumbra},
      {&Shares::umbra, &PolygonComparison::umbra},
      {&Shares::missing_umbra, &PolygonComparison::missing_umbra},
      {&Shares::misclassified, &PolygonComparison::misclassified},
      {&Shares::uncovered, &PolygonComparison::uncovered},
      {&Shares::overlapping, &PolygonComparison::overlapping},
      {&Shares::outside, &PolygonComparison::outside},
      {&Shares::ill_conditioned, &PolygonComparison::ill_conditioned},
      {&Shares::rounding, &PolygonComparison::rounding},
      {&Shares::judged_misclassified, &PolygonComparison::judged_misclassified},
      {&Shares::judged_uncovered, &PolygonComparison::judged_uncovered},
      {&Shares::judged_overlapping, &PolygonComparison::judged_overlapping},
      {&Shares::judged_outside, &PolygonComparison::judged_outside}};
  std::vector<std::vector<std::uint32_t>> parts;
  for (const ReceiverGroup& group : entry.groups) parts.push_back(group.parts);
  const std::vector<Enclosure> weights = areas_in_ratio(answer.prepared(), parts);
  std::array<ShareSum, std::size(kShares)> sums;
  for (std::size_t g = 0; g < entry.groups.size(); ++g) {
    const ReceiverGroup& group = entry.groups[g];
    if (group.optional && (fragments[g].empty() || terms.block == Block::kOverlay)) continue;
    GroupComparison comparison(answer, light, entry, group, terms, options, result);
    for (const ClaimedFragment* fragment : fragments[g]) comparison.add(*fragment);
    comparison.compare();
    for (std::size_t i = 0; i < sums.size(); ++i) {
      sums[i].add(comparison.shares().*kShares[i].first, weights[g]);
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i) result.*kShares[i].second = sums[i].result();
  return result;
}

}  // namespace gnomon::oracle
