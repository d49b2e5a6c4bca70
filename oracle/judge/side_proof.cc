// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/judge/side_proof.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gnomon/oracle/enclosure.h"
#include "oracle/geometry/group_overlay.h"
#include "oracle/judge/edge_chains.h"

namespace gnomon::oracle {

SideProof::SideProof(const PreparedScene& scene, LightVolumes& light, Side side,
                     std::vector<const ClaimedFragment*> fragments,
                     std::span<const std::uint32_t> parts)
    : scene_(scene),
      light_(light),
      side_(side),
      fragments_(std::move(fragments)),
      parts_(parts.begin(), parts.end()),
      flat_loops_(fragments_.size()) {
  const auto numbers_of = [&](const RationalLoop& loop) {
    Numbers numbers;
    for (const RationalPoint& point : loop) numbers.push_back(numbers_.number_of(point));
    return numbers;
  };
  part_points_.reserve(parts_.size());
  for (const std::uint32_t part : parts_) {
    RationalLoop& points = part_points_.emplace_back();
    for (Integers3& vertex : grid_loop(scene, part)) {
      points.push_back(in_scene(scene.geometry, HomogeneousPoint{std::move(vertex), 1}));
    }
    part_loops_.push_back(numbers_of(points));
  }
  part_vertices_ = numbers_.size();
  for (const ClaimedFragment* fragment : fragments_) loops_.push_back(numbers_of(fragment->loop));
  vertices_.resize(numbers_.size());
}

FamilyShades& SideProof::shades() {
  if (!shades_) shades_.emplace(scene_, light_, parts_, side_);
  return *shades_;
}

const Integers4& SideProof::exact(std::uint32_t vertex) {
  std::optional<Integers4>& own = vertices_[vertex].exact;
  if (!own) own = scene_point(numbers_[vertex]);
  return *own;
}

const PlanarPoint& SideProof::flat(std::uint32_t vertex) {
  std::optional<PlanarPoint>& own = vertices_[vertex].flat;
  if (!own) own = shades().frame().at(numbers_[vertex]);
  return *own;
}

const PlanarLoop& SideProof::flat_loop(std::size_t fragment) {
  PlanarLoop& loop = flat_loops_[fragment];
  if (loop.empty()) {
    for (const std::uint32_t vertex : loops_[fragment]) loop.push_back(flat(vertex));
  }
  return loop;
}

long double SideProof::error() {
  if (error_ > 0) return error_;
  double reach = 0;
  for (std::uint32_t v = 0; v < numbers_.size(); ++v) {
    for (const mpq_class& coordinate : numbers_[v]) {
      reach = std::max(reach, std::fabs(coordinate.get_d()));
    }
  }
  error_ = kPlanarError * static_cast<long double>(round_up(reach));
  return error_;
}

int SideProof::turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  if (const int sign = turn_in_frame(flat(a), flat(b), flat(c), error())) return sign;
  return exact_turn(a, b, c);
}

int SideProof::exact_turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  if (!turn_) turn_.emplace(support().normal);
  return (*turn_)(exact(a), exact(b), exact(c));
}

const ExactPlane& SideProof::support() {
  if (!support_) support_ = support_of(scene_, parts_.front());
  return *support_;
}

bool SideProof::lies_in_plane(const Numbers& loop) {
  for (const std::uint32_t vertex : loop) {
    if (vertex < part_vertices_ || vertices_[vertex].in_plane) continue;
    if (!plane_) plane_ = scene_plane(scene_.geometry, support());
    if (sign_of_product(*plane_, exact(vertex)) != 0) return false;
    vertices_[vertex].in_plane = true;
  }
  return true;
}

namespace {

/// How often edges change from going up to going down or back, around a loop.
int changes_of(const std::vector<bool>& up) {
  int changes = 0;
  for (std::size_t i = 0; i < up.size(); ++i) changes += up[i] != up[i > 0 ? i - 1 : up.size() - 1];
  return changes;
}

}  // namespace

bool SideProof::goes_around_once(const Numbers& loop) {
  // How far a vertex is along a direction that few edges are at right angles to.
  constexpr long double kX = 0.92387953L, kY = 0.38268343L;
  std::vector<bool> up(loop.size());
  bool is_known = true;
  for (std::size_t i = 0; i < loop.size() && is_known; ++i) {
    const PlanarPoint &a = flat(loop[i]), &b = flat(loop[i + 1 < loop.size() ? i + 1 : 0]);
    const long double rise = kX * (b.x - a.x) + kY * (b.y - a.y);
    // Differences are off by two errors each, times kX + kY < 1.4; and less for what is rounded.
    is_known = std::fabs(rise) > 4 * error();
    up[i] = rise > 0;
  }
  // Else by their order in space, which is that along a direction too.
  for (std::size_t i = 0; i < loop.size() && !is_known; ++i) {
    up[i] = numbers_[loop[i]] < numbers_[loop[i + 1 < loop.size() ? i + 1 : 0]];
  }
  return changes_of(up) == 2;
}

bool SideProof::is_convex(Numbers& loop) {
  int way = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const std::uint32_t a = loop[i], b = loop[(i + 1) % loop.size()];
    if (a == b) return false;
    const int own = turn(a, b, loop[(i + 2) % loop.size()]);
    if (own == 0) continue;
    if (way == 0) way = own;
    if (own != way) return false;
  }
  if (way == 0 || !goes_around_once(loop)) return false;
  if (way < 0) std::ranges::reverse(loop);
  return true;
}

bool SideProof::is_a_part(Numbers& loop) const {
  for (const Numbers& part : part_loops_) {
    if (part.size() != loop.size()) continue;
    const auto start = std::ranges::find(loop, part[0]);
    if (start == loop.end()) continue;
    Numbers turned(start, loop.end());
    turned.insert(turned.end(), loop.begin(), start);
    if (turned != part) std::reverse(turned.begin() + 1, turned.end());
    if (turned != part) continue;
    loop = std::move(turned);
    return true;
  }
  return false;
}

bool SideProof::tiles() {
  // Parts are convex, and may turn either way.
  for (Numbers& part : part_loops_) {
    if (parts_.size() > 1 && exact_turn(part[0], part[1], part[2]) < 0) std::ranges::reverse(part);
  }
  for (Numbers& loop : loops_) {
    if (!is_a_part(loop) && !(lies_in_plane(loop) && is_convex(loop))) return false;
  }
  EdgeChains chains;
  for (const Numbers& loop : loops_) chains.add(loop, 1);
  for (const Numbers& part : part_loops_) chains.add(part, -1);
  if (chains.cancel()) return true;
  VertexFrame frame;
  frame.place = [&](std::uint32_t v) -> const PlanarPoint& { return flat(v); };
  frame.error = error();
  frame.turn = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    return exact_turn(a, b, c);
  };
  frame.before = [&](std::uint32_t a, std::uint32_t b) { return numbers_[a] < numbers_[b]; };
  return chains.cancel_led_through(frame);
}

bool SideProof::is_on_side(std::size_t fragment, const Shade& shade, std::size_t line, int side) {
  const PlanarLoop& loop = flat_loop(fragment);
  const long double error = shades().error();
  const PlanarLine& border = shade.lines[line];
  const auto value = [&](const PlanarPoint& p) {
    return static_cast<long double>(side) * border.at(p);
  };
  if (std::ranges::any_of(loop, [&](const PlanarPoint& p) { return !(value(p) >= -error); })) {
    return false;
  }
  for (std::size_t i = 0; i < loop.size(); ++i) {
    if (value(loop[i]) > error) continue;
    const Integers4& plane = light_.scene_planes(shade.part)[shade.bounds[line]];
    if (side * sign_of_product(plane, exact(loops_[fragment][i])) < 0) return false;
  }
  return true;
}

bool SideProof::is_inside_region(std::size_t fragment) {
  return std::ranges::all_of(light_.outside_grid_planes(), [&](const ExactPlane& outside) {
    const Integers4 plane = scene_plane(scene_.geometry, outside);
    return std::ranges::all_of(loops_[fragment], [&](std::uint32_t vertex) {
      return sign_of_product(plane, exact(vertex)) <= 0;
    });
  });
}

bool SideProof::is_lit(std::size_t fragment) {
  if (!is_inside_region(fragment)) return false;
  const PlanarLoop& loop = flat_loop(fragment);
  for (const Shade* shade : shades().partly().near(box_of(loop))) {
    bool apart = shade->is_apart(loop, shades().error());
    for (std::size_t i = 0; i < shade->lines.size() && !apart; ++i) {
      apart = is_on_side(fragment, *shade, i, -1);
    }
    apart = apart || has_edge_between(fragment, *shade);
    if (!apart && light_.shadowed_by(piece_of(fragment), shade->part) > 0) return false;
  }
  return true;
}

bool SideProof::has_edge_between(std::size_t fragment, const Shade& shade) {
  const Numbers& loop = loops_[fragment];
  const PlanarLoop& flat = flat_loop(fragment);
  // Where the shade is, roughly: only which edges to ask about.
  const PlanarLoop region = shades().region_of(shade);
  const long double doubt = 1024 * shades().error();
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const std::size_t next = i + 1 < loop.size() ? i + 1 : 0;
    const PlanarLine inside = line_through(flat[i], flat[next]);
    if (std::ranges::any_of(region, [&](const PlanarPoint& p) { return inside.at(p) > doubt; })) {
      continue;
    }
    const Integers4 plane = plane_through(exact(loop[i]), exact(loop[next]), light_.scene_source());
    int own = 0;
    for (std::size_t v = 0; v < loop.size() && own == 0; ++v) {
      if (v != i && v != next) own = sign_of_product(plane, exact(loop[v]));
    }
    if (own == 0) continue;
    if (std::ranges::all_of(light_.scene_loop(shade.part), [&](const Integers4& vertex) {
          return own * sign_of_product(plane, vertex) <= 0;
        })) {
      return true;
    }
  }
  return false;
}

Piece SideProof::piece_of(std::size_t fragment) const {
  const std::uint32_t part = parts_.front();
  return {fragments_[fragment], fragment, part, fragments_[fragment]->loop,
          light_.solid(part).normal};
}

bool SideProof::is_shadowed_by(std::size_t fragment, std::uint32_t caster) {
  for (const Shade* shade : shades().partly().near(box_of(flat_loop(fragment)))) {
    if (scene_.parts[shade->part].polygon != caster) continue;
    bool around = true;
    for (std::size_t i = 0; i < shade->lines.size() && around; ++i) {
      around = is_on_side(fragment, *shade, i, 1);
    }
    if (around) return true;
  }
  const Piece piece = piece_of(fragment);
  return !(space::area_along(light_.solid(piece.part).normal, light_.not_shadowed(piece, caster)) >
           0);
}

namespace {

/// By halves: summands of about one size, which is where a sum of fractions is quickest.
mpq_class sum_of(std::span<const mpq_class> terms) {
  if (terms.empty()) return 0;
  if (terms.size() == 1) return terms[0];
  const std::size_t half = terms.size() / 2;
  return sum_of(terms.first(half)) + sum_of(terms.subspan(half));
}

}  // namespace

mpq_class SideProof::doubled_area(const std::vector<const Numbers*>& loops) {
  if (!turn_) turn_.emplace(support().normal);
  std::vector<mpq_class> areas;
  std::vector<const Integers4*> points;
  for (const Numbers* loop : loops) {
    points.clear();
    for (const std::uint32_t vertex : *loop) points.push_back(&exact(vertex));
    areas.push_back(turn_->doubled_area(points));
  }
  return sum_of(areas);
}

bool SideProof::has_shares_of(const ClaimedPolygon& polygon) {
  std::vector<const Numbers*> lit, shadow, whole;
  for (std::size_t f = 0; f < loops_.size(); ++f) {
    (fragments_[f]->state == LightState::kLit ? lit : shadow).push_back(&loops_[f]);
  }
  // They tile the polygon: one class has what the other has not.
  const bool by_lit = lit.size() < shadow.size();
  const std::optional<mpq_class>& claimed = by_lit ? polygon.lit_fraction : polygon.shadow_fraction;
  const std::optional<mpq_class>& other = by_lit ? polygon.shadow_fraction : polygon.lit_fraction;
  if (!claimed && !other) return true;
  const std::vector<const Numbers*>& fewer = by_lit ? lit : shadow;
  mpq_class share = claimed ? *claimed : mpq_class(1 - *other);
  if (claimed && other && *claimed + *other != 1) return false;
  if (fewer.empty()) return share == 0;
  for (const Numbers& part : part_loops_) whole.push_back(&part);
  return share * doubled_area(whole) == doubled_area(fewer);
}

}  // namespace gnomon::oracle
