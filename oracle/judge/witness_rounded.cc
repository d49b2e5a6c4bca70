// SPDX-License-Identifier: GPL-3.0-or-later
// Sides with rounded loops: every claim in the frame of the plane, whose error is far below what
// rounding excuses (geometry/rounding.h). What a claim is wrong about is kept as convex pieces;
// those that are no rounding are weighed together once the whole side is known, by the tolerance of
// the comparison: shares of the polygon and widths.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <memory>
#include <ranges>

#include "oracle/judge/claimed_shape.h"
#include "oracle/judge/witness_checker.h"

namespace gnomon::oracle {

namespace {

void add_edges(std::vector<Border>& borders, const PlanarLoop& loop) {
  for (std::size_t i = 0; i < loop.size(); ++i) {
    borders.push_back({loop[i], loop[(i + 1) % loop.size()]});
  }
}

/// Some line has all of the loop outside but for what rounding excuses: what is inside is near the
/// loop's own border.
bool is_beyond(const std::vector<PlanarLine>& lines, const PlanarLoop& loop, long double radius) {
  return std::ranges::any_of(lines, [&](const PlanarLine& line) {
    return std::ranges::all_of(
        loop, [&](const PlanarPoint& p) { return is_rounding(line.at(p), radius); });
  });
}

/// All lines have all of the loop inside but for what rounding excuses.
bool is_within(const std::vector<PlanarLine>& lines, const PlanarLoop& loop, long double radius) {
  return std::ranges::all_of(lines, [&](const PlanarLine& line) {
    return std::ranges::all_of(
        loop, [&](const PlanarPoint& p) { return is_rounding(-line.at(p), radius); });
  });
}

PlanarLoop inside(PlanarLoop loop, const std::vector<PlanarLine>& lines) {
  for (const PlanarLine& line : lines) {
    if (loop.empty()) break;
    loop = cut(loop, line);
  }
  return loop;
}

/// How much the area of a loop changes at most if its vertices move by the radius: it sweeps the
/// radius times its length, which grows by twice the radius a vertex.
long double swept_area(const PlanarLoop& loop, long double radius) {
  const long double reach = rounding_reach(radius);
  return reach * (perimeter_of(loop) + 2 * reach * static_cast<long double>(loop.size()));
}

/// Of a shade, and then of what is left beside it.
void take(std::vector<PlanarLoop>& rest, std::vector<PlanarLoop>& taken, const Shade& shade) {
  for (const PlanarLoop& loop : rest) {
    PlanarLoop inner = inside(loop, shade.lines);
    if (inner.size() >= 3) taken.push_back(std::move(inner));
  }
  rest = without(std::move(rest), shade.lines);
}

}  // namespace

FlatPiece::FlatPiece(const ClaimedFragment* claimed, std::size_t number, PlanarLoop own)
    : fragment(claimed),
      index(number),
      loop(std::move(own)),
      lines(lines_of(loop)),
      box(box_of(loop)) {}

std::vector<Border> WitnessChecker::borders_of(const Family& family, const FlatPiece& piece) const {
  std::vector<Border> borders;
  if (!piece.fragment) {
    add_edges(borders, piece.loop);
    return borders;
  }
  const PlaneFrame& frame = family.shades.frame();
  const PlanarLoop loop = frame.loop_at(piece.fragment->loop);
  add_edges(borders, loop);
  add_edges(borders, hull_of(loop));
  for (const RationalLoop& hole : piece.fragment->holes) add_edges(borders, frame.loop_at(hole));
  return borders;
}

void WitnessChecker::add_error(const Family& family, const FlatPiece& piece, ErrorKind kind,
                               const Loops& error, const std::string& text,
                               std::vector<Border> more) {
  if (error.empty()) return;
  std::vector<Border> borders = borders_of(family, piece);
  borders.insert(borders.end(), more.begin(), more.end());
  Excess excess{kind, 0, false, text,
                piece.fragment ? std::optional<std::uint64_t>(piece.index) : std::nullopt};
  for (const PlanarLoop& loop : error) {
    if (loop.size() < 3) continue;
    if (is_rounding(loop, borders, family.radius)) {
      ++report_.rounded;
      continue;
    }
    excess.area += area_of(loop);
    excess.wide = excess.wide || is_wider(loop, width_);
  }
  if (excess.area > 0) excesses_.push_back(std::move(excess));
}

void WitnessChecker::settle(const ClaimedPolygon& polygon, long double area) {
  // What is not covered is misclassified as well.
  const auto weighed_as = [](ErrorKind kind) {
    return kind == ErrorKind::kUncovered ? ErrorKind::kMisclassified : kind;
  };
  std::map<ErrorKind, long double> areas;
  for (const Excess& excess : excesses_) areas[weighed_as(excess.kind)] += excess.area;
  for (const Excess& excess : excesses_) {
    const long double share = areas[weighed_as(excess.kind)] / area;
    if (!(share <= options_.tolerance) || excess.wide) {
      violation(polygon.id, excess.text, excess.fragment);
    }
  }
  excesses_.clear();
}

std::size_t WitnessChecker::nearest_of(const ClaimedFragment& fragment,
                                       const std::vector<std::unique_ptr<Family>>& families) const {
  std::size_t best = families.size();
  long double best_distance = 0;
  bool best_near = false, best_around = false;
  for (std::size_t f = 0; f < families.size(); ++f) {
    const Family& family = *families[f];
    const PlaneFrame& frame = family.shades.frame();
    long double distance = 0;
    PlanarPoint middle;
    for (const RationalPoint& point : fragment.loop) {
      distance = std::max(distance, std::fabs(frame.height(point)));
      const PlanarPoint at = frame.at(point);
      middle.x += at.x / static_cast<long double>(fragment.loop.size());
      middle.y += at.y / static_cast<long double>(fragment.loop.size());
    }
    const bool near = distance <= width_ || is_rounding(distance, family.radius);
    const bool around = std::ranges::any_of(family.shades.lines(), [&](const auto& lines) {
      return is_within(lines, {middle}, family.radius);
    });
    const bool better = best == families.size() || (near && !best_near) ||
                        (near == best_near && around && !best_around) ||
                        (near == best_near && around == best_around && distance < best_distance);
    if (!better) continue;
    best = f;
    best_distance = distance;
    best_near = near;
    best_around = around;
  }
  return best;
}

std::vector<FlatPiece> WitnessChecker::flat_pieces(const ClaimedPolygon& polygon, std::size_t index,
                                                   Family& family) {
  const ClaimedFragment& fragment = polygon.fragments[index];
  const PlaneFrame& frame = family.shades.frame();
  for (const RationalPoint& point : fragment.loop) {
    const long double height = std::fabs(frame.height(point));
    if (height <= width_ || is_rounding(height, family.radius)) continue;
    violation(polygon.id, "a fragment does not lie in the polygon's plane", index);
    return {};
  }
  std::vector<FlatPiece> pieces;
  const PlanarLoop loop = frame.loop_at(fragment.loop);
  if (fragment.holes.empty()) {
    PlanarLoop hull = hull_of(loop);
    // A loop that is convex but for rounding stands for its hull.
    const long double reach = 2 * family.radius;
    const auto near_border = [&](const PlanarPoint& point) {
      return std::ranges::any_of(lines_of(hull), [&](const PlanarLine& line) {
        return is_rounding(line.at(point), reach);
      });
    };
    const long double area = std::fabs(area_of(loop));
    const bool once = area_of(hull) - area <= 2 * reach * perimeter_of(hull);
    if (hull.size() < 3) {
      family.lost += swept_area(loop, family.radius);
      return pieces;
    }
    if (once && (loop.size() == hull.size() || std::ranges::all_of(loop, near_border))) {
      pieces.emplace_back(&fragment, index, std::move(hull));
      return pieces;
    }
  }
  for (const auto& corners : convex_pieces(prepared_, family.parts.front(), fragment)) {
    PlanarLoop piece;
    for (const HomogeneousPoint& corner : corners) piece.push_back(frame.at(corner));
    piece = hull_of(std::move(piece));
    if (piece.size() >= 3) pieces.emplace_back(&fragment, index, std::move(piece));
  }
  return pieces;
}

void WitnessChecker::check_rounded_side(const ClaimedPolygon& polygon, const Families& families,
                                        const std::set<PlaneId>& optional) {
  excesses_.clear();
  const std::uint32_t own = polygon_index_.at(polygon.id);
  const long double radius = rounding_radius(scene_, prepared_, own);
  std::vector<std::unique_ptr<Family>> all;
  std::vector<std::vector<FlatPiece>> pieces(families.size());
  std::vector<bool> may_miss;
  for (const auto& [plane, parts] : families) {
    all.push_back(std::unique_ptr<Family>(
        new Family{polygon, parts, {prepared_, *light_, parts, polygon.side}, radius}));
    may_miss.push_back(optional.contains(plane));
  }
  for (std::size_t i = 0; i < polygon.fragments.size(); ++i) {
    if (!can_be_judged(polygon, i)) continue;
    const std::size_t f = all.size() == 1 ? 0 : nearest_of(polygon.fragments[i], all);
    if (f == all.size()) {
      violation(polygon.id, "nothing of the polygon is classified on this side", i);
      continue;
    }
    std::ranges::move(flat_pieces(polygon, i, *all[f]), std::back_inserter(pieces[f]));
  }
  long double area = 0;
  for (std::size_t f = 0; f < all.size(); ++f) {
    if (may_miss[f] && pieces[f].empty()) continue;
    area += all[f]->shades.area();
    check_rounded_family(*all[f], pieces[f]);
  }
  settle(polygon, area);
}

namespace {

/// Pieces painted over each other, cut down to what is seen of each.
std::vector<FlatPiece> visible_of(std::vector<FlatPiece> pieces) {
  std::ranges::stable_sort(pieces, std::greater<>(),
                           [](const FlatPiece& piece) { return piece.fragment->level; });
  std::vector<FlatPiece> visible;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    std::vector<PlanarLoop> loops{pieces[i].loop};
    for (std::size_t j = 0; j < i && !loops.empty(); ++j) {
      if (pieces[j].fragment->level == pieces[i].fragment->level) break;
      if (pieces[j].box.meets(pieces[i].box)) loops = without(std::move(loops), pieces[j].lines);
    }
    for (PlanarLoop& loop : loops) {
      visible.emplace_back(pieces[i].fragment, pieces[i].index, std::move(loop));
    }
  }
  return visible;
}

/// What no piece holds of convex loops.
std::vector<PlanarLoop> left_of(const std::vector<PlanarLoop>& loops,
                                const std::vector<FlatPiece>& pieces, long double grown) {
  struct Left {
    PlanarLoop loop;
    PlanarBox box;
  };
  std::vector<Left> left;
  for (const PlanarLoop& loop : loops) left.push_back({loop, box_of(loop)});
  std::vector<PlanarLoop> near;
  for (const FlatPiece& piece : pieces) {
    if (left.empty()) break;
    const PlanarBox box = box_of(piece.loop, grown);
    near.clear();
    // What the piece cannot reach stays where it is.
    for (std::size_t i = 0; i < left.size();) {
      if (!box.meets(left[i].box)) {
        ++i;
        continue;
      }
      near.push_back(std::move(left[i].loop));
      left[i] = std::move(left.back());
      left.pop_back();
    }
    if (near.empty()) continue;
    std::vector<PlanarLine> lines = piece.lines;
    for (PlanarLine& line : lines) line = line.grown(grown);
    for (PlanarLoop& loop : without(std::move(near), lines)) {
      const PlanarBox own = box_of(loop);
      left.push_back({std::move(loop), own});
    }
  }
  std::vector<PlanarLoop> result;
  for (Left& own : left) result.push_back(std::move(own.loop));
  return result;
}

}  // namespace

void WitnessChecker::check_rounded_family(Family& family, std::vector<FlatPiece>& pieces) {
  const bool reached = light_->sees(family.parts.front(), family.polygon.side);
  if (terms_.block == Block::kOverlay && !reached) return;
  const bool tiled = tiles(family);
  std::ranges::sort(pieces, {}, [](const FlatPiece& piece) { return piece.box.low.x; });
  if (tiled) check_rounded_tiling(family, pieces);
  if (terms_.cover == Cover::kOverlay) {
    pieces = visible_of(std::move(pieces));
    std::ranges::sort(pieces, {}, [](const FlatPiece& piece) { return piece.box.low.x; });
  }
  if (tiled) check_rounded_overlaps(family, pieces);
  for (const FlatPiece& piece : pieces) check_rounded_piece(family, piece);
  long double rest_area = 0;
  if (const std::optional<ClassSet> allowed = left_out()) {
    for (PlanarLoop& loop : left_of(family.shades.loops(), pieces, 0)) {
      rest_area += area_of(loop);
      check_rounded_classes(family, FlatPiece(nullptr, 0, std::move(loop)), *allowed, pieces);
    }
  }
  check_rounded_fractions(family, pieces, rest_area);
}

void WitnessChecker::check_rounded_tiling(Family& family, const std::vector<FlatPiece>& pieces) {
  std::vector<Border> own_borders;
  for (const PlanarLoop& loop : family.shades.loops()) add_edges(own_borders, loop);
  for (const FlatPiece& piece : pieces) {
    const auto& parts = family.shades.lines();
    if (std::ranges::any_of(
            parts, [&](const auto& own) { return is_within(own, piece.loop, family.radius); })) {
      continue;
    }
    Loops outside{piece.loop};
    for (const auto& own : parts) outside = without(std::move(outside), own);
    add_error(family, piece, ErrorKind::kOutside, outside, "a fragment leaves the polygon",
              own_borders);
  }
  if (left_out()) return;
  // What is within rounding of a piece is near its border.
  const Loops uncovered = left_of(family.shades.loops(), pieces, rounding_reach(family.radius));
  for (const PlanarLoop& loop : uncovered) {
    const FlatPiece none(nullptr, 0, loop);
    Excess excess{ErrorKind::kUncovered, area_of(loop), is_wider(loop, width_),
                  "the fragments' areas do not add up to the polygon's", std::nullopt};
    if (!is_rounding(loop, own_borders, family.radius) && excess.area > 0) {
      excesses_.push_back(std::move(excess));
    }
  }
}

/// Pairs, swept along x. Of an overlay only those that say different things of one level.
void WitnessChecker::check_rounded_overlaps(Family& family, std::vector<FlatPiece>& pieces) {
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const FlatPiece& own = pieces[i];
    for (std::size_t j = i + 1; j < pieces.size() && pieces[j].box.low.x <= own.box.high.x; ++j) {
      const FlatPiece& other = pieces[j];
      if (own.fragment == other.fragment || !own.box.meets(other.box)) continue;
      if (terms_.cover == Cover::kOverlay && (own.fragment->level != other.fragment->level ||
                                              own.fragment->state == other.fragment->state)) {
        continue;
      }
      if (is_beyond(own.lines, other.loop, family.radius) ||
          is_beyond(other.lines, own.loop, family.radius)) {
        continue;
      }
      add_error(family, own, ErrorKind::kOverlapping, {inside(own.loop, other.lines)},
                fmt::format("the fragment overlaps fragment {}", other.index),
                borders_of(family, other));
    }
  }
}

void WitnessChecker::check_rounded_piece(Family& family, const FlatPiece& piece) {
  const auto classes = classes_without_witness(piece.fragment->state);
  if (classes) return check_rounded_classes(family, piece, *classes, {});
  light_->is_area() ? check_rounded_area_shade(family, piece) : check_rounded_shade(family, piece);
}

bool WitnessChecker::is_outside_but_for_rounding(const Family& family,
                                                 const ClaimedFragment& fragment) const {
  if (!(family.radius > 0) || !is_facing(family) ||
      shadow_reason_by_name(fragment.reason) != ShadowReason::kOutsideRegion) {
    return false;
  }
  const auto flat = [&](const RationalLoop& loop) {
    PlanarLoop result;
    for (const RationalPoint& point : loop) result.push_back(family.shades.frame().at(point));
    return result;
  };
  const long double inside = std::fabs(area_of(flat(light_->inside_region(fragment.loop))));
  return inside <= swept_area(flat(fragment.loop), family.radius);
}

void WitnessChecker::check_rounded_outside(Family& family, const FlatPiece& piece) {
  for (const FlatHalf& half : family.shades.outsides()) {
    PlanarLoop outside = cut(piece.loop, half);
    if (outside.empty()) continue;
    std::vector<Border> borders;
    add_edges(borders, outside);
    add_error(family, piece, ErrorKind::kMisclassified, {std::move(outside)},
              "a lit fragment is outside of the light's region", std::move(borders));
  }
}

void WitnessChecker::check_rounded_lit(Family& family, const FlatPiece& piece, Shades& shades,
                                       const char* text) {
  Loops rest{piece.loop};
  for (const Shade* shade : shades.near(piece.box)) {
    if (is_beyond(shade->lines, piece.loop, family.radius)) continue;
    Loops wrong;
    take(rest, wrong, *shade);
    std::vector<Border> borders;
    add_edges(borders, family.shades.region_of(*shade));
    add_error(family, piece, ErrorKind::kMisclassified, wrong,
              fmt::format("{} '{}'", text, id_of(shade->part)), std::move(borders));
  }
}

void WitnessChecker::check_hidden(Family& family, const FlatPiece& piece, Loops loops,
                                  std::span<const std::uint32_t> casters, Shades& shades,
                                  const std::function<std::string()>& text) {
  std::vector<Border> borders;
  for (const Shade* shade : shades.near(piece.box)) {
    if (std::ranges::find(casters, prepared_.parts[shade->part].polygon) == casters.end()) continue;
    if (is_within(shade->lines, piece.loop, family.radius)) return;
    loops = without(std::move(loops), shade->lines);
    add_edges(borders, family.shades.region_of(*shade));
  }
  if (loops.empty()) return;
  add_error(family, piece, ErrorKind::kMisclassified, loops, text(), std::move(borders));
}

void WitnessChecker::check_rounded_shade(Family& family, const FlatPiece& piece) {
  const ClaimedFragment& fragment = *piece.fragment;
  if (fragment.state == LightState::kLit) {
    if (is_facing(family)) {
      check_rounded_outside(family, piece);
      return check_rounded_lit(family, piece, family.shades.partly(),
                               "a lit fragment is shadowed by");
    }
    return add_error(family, piece, ErrorKind::kMisclassified, {piece.loop},
                     "a fragment is lit on a side that does not face the light");
  }
  if (!fragment.casters.empty()) {
    ++report_.witnesses;
    const std::vector<std::uint32_t> casters = named_casters(family.polygon, piece.index);
    if (casters.empty()) return;
    return check_hidden(family, piece, {piece.loop}, casters, family.shades.partly(), [] {
      return std::string("its casters do not shadow all of the fragment");
    });
  }
  const std::optional<std::uint32_t> caster = caster_to_check(family, fragment, piece.index);
  if (!caster) return;
  check_hidden(family, piece, {piece.loop}, std::span(&*caster, 1), family.shades.partly(), [&] {
    return fmt::format("'{}' does not shadow all of the fragment", fragment.caster);
  });
}

bool WitnessChecker::is_seen_roughly(Family& family, const FlatPiece& piece) {
  const bool lit = piece.fragment->state == LightState::kLit;
  const std::string name = name_of(piece.fragment->state);
  if (!light_->sees(family.parts.front(), family.polygon.side)) {
    add_error(family, piece, ErrorKind::kMisclassified, {piece.loop},
              fmt::format("a fragment is {} on a side that sees nothing of the light", name));
    return false;
  }
  PlanarLoop before = cut(piece.loop, family.shades.before_light());
  const FlatHalf& half = family.shades.before_light();
  if (half.kind == FlatHalf::Kind::kLine) {
    PlanarLoop behind = cut(piece.loop, half.line.opposite());
    std::vector<Border> border;
    add_edges(border, before);
    if (!behind.empty()) {
      add_error(family, piece, ErrorKind::kMisclassified, {std::move(behind)},
                fmt::format("a {} fragment reaches behind the light", name), std::move(border));
    }
  }
  if (!lit && !terms_.per_caster_umbra) return true;
  if (before.empty()) return true;
  const FlatPiece seen(piece.fragment, piece.index, std::move(before));
  check_rounded_lit(
      family, seen, lit ? family.shades.partly() : family.shades.wholly(),
      lit ? "a lit fragment is in the penumbra of" : "a penumbra fragment is in the umbra of");
  return true;
}

void WitnessChecker::check_rounded_area_shade(Family& family, const FlatPiece& piece) {
  const ClaimedFragment& fragment = *piece.fragment;
  const std::string& id = family.polygon.id;
  const bool all = fragment.state == LightState::kUmbra;
  if (!all && !is_seen_roughly(family, piece)) return;
  if (fragment.state == LightState::kLit) return;
  ++report_.witnesses;
  const bool sees = light_->sees(family.parts.front(), family.polygon.side);
  const FlatHalf& half = family.shades.before_light();
  const bool behind =
      !sees || half.kind == FlatHalf::Kind::kNone ||
      (half.kind == FlatHalf::Kind::kLine && is_beyond({half.line}, piece.loop, family.radius));
  if (!fragment.reason.empty()) {
    if (area_reason_holds(family, fragment, behind)) return;
    return violation(id, fmt::format("the reason '{}' does not hold", fragment.reason),
                     piece.index);
  }
  if (fragment.caster.empty()) {
    if (behind) return;
    return violation(
        id,
        fmt::format("{} {} fragment names no caster", all ? "an" : "a", name_of(fragment.state)),
        piece.index);
  }
  const std::optional<std::uint32_t> caster = named_caster(family.polygon, piece.index);
  if (!caster || !sees) return;
  PlanarLoop before = cut(piece.loop, half);
  if (before.empty()) return;
  check_hidden(family, piece, {std::move(before)}, std::span(&*caster, 1),
               all ? family.shades.wholly() : family.shades.partly(), [&] {
                 return fmt::format("'{}' does not hide {} of the light from all of the fragment",
                                    fragment.caster, all ? "all" : "part");
               });
}

std::array<WitnessChecker::Loops, 4> WitnessChecker::loops_of_classes(Family& family,
                                                                      const PlanarLoop& loop) {
  std::array<Loops, 4> classes;
  const auto of = [&](LightState state) -> Loops& {
    return classes[static_cast<std::size_t>(state)];
  };
  const bool area = light_->is_area();
  const bool reached = light_->sees(family.parts.front(), family.polygon.side);
  Loops rest{loop};
  if (!reached) {
    of(area ? LightState::kUmbra : LightState::kShadow) = std::move(rest);
    return classes;
  }
  const PlanarBox box = box_of(loop);
  if (area) {
    const FlatHalf& half = family.shades.before_light();
    if (half.kind == FlatHalf::Kind::kLine) {
      PlanarLoop behind = cut(loop, half.line.opposite());
      if (!behind.empty()) of(LightState::kUmbra).push_back(std::move(behind));
      rest = {cut(loop, half.line)};
      if (rest.front().empty()) rest.clear();
    } else if (half.kind == FlatHalf::Kind::kNone) {
      of(LightState::kUmbra) = std::exchange(rest, {});
    }
    for (const Shade* shade : family.shades.wholly().near(box)) {
      take(rest, of(LightState::kUmbra), *shade);
    }
  }
  for (const FlatHalf& half : family.shades.outsides()) {
    Loops inside;
    for (PlanarLoop& own : rest) {
      PlanarLoop outside = cut(own, half);
      if (!outside.empty()) of(LightState::kShadow).push_back(std::move(outside));
      if (half.kind == FlatHalf::Kind::kNone) inside.push_back(std::move(own));
      if (half.kind != FlatHalf::Kind::kLine) continue;
      PlanarLoop kept = cut(own, half.line.opposite());
      if (!kept.empty()) inside.push_back(std::move(kept));
    }
    rest = std::move(inside);
  }
  Loops& partly = of(area ? LightState::kPenumbra : LightState::kShadow);
  for (const Shade* shade : family.shades.partly().near(box)) take(rest, partly, *shade);
  of(LightState::kLit) = std::move(rest);
  return classes;
}

void WitnessChecker::check_rounded_classes(Family& family, const FlatPiece& piece,
                                           const ClassSet& allowed,
                                           const std::vector<FlatPiece>& pieces) {
  const std::array<Loops, 4> classes = loops_of_classes(family, piece.loop);
  for (std::size_t c = 0; c < classes.size(); ++c) {
    const auto state = static_cast<LightState>(c);
    if (classes[c].empty() || !is_wrong(state, allowed)) continue;
    const std::string what = piece.fragment
                                 ? fmt::format("a {} fragment", name_of(piece.fragment->state))
                                 : std::string("what no fragment covers");
    // Borders of the claim, and of all that is true nearby.
    std::vector<Border> borders;
    for (const FlatPiece& other : pieces) {
      if (other.box.meets(box_of(piece.loop, rounding_reach(family.radius)))) {
        add_edges(borders, other.loop);
      }
    }
    for (Shades* shades :
         {&family.shades.partly(), light_->is_area() ? &family.shades.wholly() : nullptr}) {
      if (!shades) continue;
      for (const Shade* shade : shades->near(piece.box))
        add_edges(borders, family.shades.region_of(*shade));
    }
    add_error(family, piece, ErrorKind::kMisclassified, classes[c],
              fmt::format("some of {} is {}", what, name_of(state)), std::move(borders));
  }
}

void WitnessChecker::check_rounded_fractions(const Family& family,
                                             const std::vector<FlatPiece>& pieces,
                                             long double rest) {
  const ClaimedPolygon& polygon = family.polygon;
  if (!has_all_parts(family)) return;
  std::array<long double, 4> areas{}, errors{};  // by LightState
  const auto index_of = [](LightState state) { return static_cast<std::size_t>(state); };
  long double all_errors = family.lost;
  for (const FlatPiece& piece : pieces) {
    areas[index_of(piece.fragment->state)] += area_of(piece.loop);
    const long double swept = swept_area(piece.loop, family.radius);
    errors[index_of(piece.fragment->state)] += swept;
    all_errors += swept;
  }
  if (terms_.background) {
    areas[index_of(*terms_.background)] = rest;
    errors[index_of(*terms_.background)] = all_errors;
  }
  const long double whole = family.shades.area();
  const auto claim = [&](const std::optional<mpq_class>& claimed, LightState shade) {
    if (!claimed || !is_told(shade)) return;
    const long double found = areas[index_of(shade)] / whole;
    const long double allowed =
        options_.tolerance + (errors[index_of(shade)] + family.lost) / whole + 0x1p-50L;
    if (std::fabs(nearest(*claimed) - found) <= allowed) return;
    violation(polygon.id,
              fmt::format("the {} fraction is claimed as {}, but the fragments say {:.17g}",
                          name_of(shade), claimed->get_str(), static_cast<double>(found)));
  };
  claim(polygon.lit_fraction, LightState::kLit);
  claim(polygon.shadow_fraction, LightState::kShadow);
  claim(polygon.penumbra_fraction, LightState::kPenumbra);
  claim(polygon.umbra_fraction, LightState::kUmbra);
}

}  // namespace gnomon::oracle
