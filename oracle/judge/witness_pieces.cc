// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/judge/witness_pieces.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <utility>

#include "gnomon/oracle/enclosure.h"
#include "oracle/geometry/group_overlay.h"

namespace gnomon::oracle {

using space::area_along;
using space::cross;
using space::dot;
using space::HalfSpace;
using space::minus;

bool Solid::lies_in(const HalfSpace& half) const {
  return std::ranges::all_of(loop,
                             [&](const RationalPoint& vertex) { return half.value(vertex) == 0; });
}

bool Solid::holds(const Solid& other) const {
  return std::ranges::all_of(other.loop, [&](const RationalPoint& vertex) {
    return dot(normal, minus(vertex, loop[0])) == 0;
  });
}

RationalPoint in_scene(const Geometry& geometry, const HomogeneousPoint& point) {
  RationalPoint result;
  for (int k = 0; k < 3; ++k) {
    mpq_class coordinate(point.xyz[k], point.w);
    if (point.w != 1) coordinate.canonicalize();
    result[k] = geometry.origin[k] + geometry.step * coordinate;
  }
  return result;
}

LightStanding standing_of(const PreparedScene& scene, const PreparedLight& light,
                          std::uint32_t part) {
  const ExactPlane plane = support_of(scene, part);
  const Part& own = scene.parts[part];
  LightStanding standing;
  standing.facing = light.point.directional ? sgn(dot(plane.normal, light.point.grid))
                                            : sgn(value_at(plane, light.point.grid));
  standing.receives = standing.facing > 0 || (standing.facing < 0 && own.two_sided);
  standing.casts = standing.receives && (own.casts || light.is_eye);
  return standing;
}

std::vector<ExactPlane> shadow_planes_of(const PreparedScene& scene, const PreparedLight& light,
                                         std::uint32_t part, int facing) {
  const std::vector<Integers3> loop = grid_loop(scene, part);
  ExactPlane behind = support_of(scene, part);
  if (facing > 0) behind = opposite(std::move(behind));
  std::vector<ExactPlane> planes{std::move(behind)};
  const Integers3& source = light.point.grid;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Integers3 &a = loop[i], &b = loop[(i + 1) % loop.size()];
    ExactPlane inward;
    inward.normal = light.point.directional ? cross(source, minus(b, a))
                                            : cross(minus(a, source), minus(b, source));
    inward.offset = dot(inward.normal, a);
    // Inside is where the loop's other vertices are.
    if (value_at(inward, loop[(i + 2) % loop.size()]) < 0) inward = opposite(std::move(inward));
    planes.push_back(std::move(inward));
  }
  return planes;
}

Solid solid_of(const PreparedScene& scene, std::uint32_t part) {
  Solid solid;
  for (const Integers3& vertex : grid_loop(scene, part)) {
    solid.loop.push_back(in_scene(scene.geometry, HomogeneousPoint{vertex, 1}));
  }
  const std::size_t size = solid.loop.size();
  solid.normal = cross(minus(solid.loop[1], solid.loop[0]), minus(solid.loop[2], solid.loop[0]));
  for (std::size_t i = 0; i < size; ++i) {
    const RationalPoint &a = solid.loop[i], &b = solid.loop[(i + 1) % size];
    solid.walls.emplace_back(cross(solid.normal, minus(b, a)), a);
  }
  return solid;
}

Piece::Piece(const ClaimedFragment* claimed, std::size_t number, std::uint32_t of_part,
             space::Loop own, const RationalPoint& normal)
    : fragment(claimed), index(number), part(of_part), loop(std::move(own)) {
  measure(normal);
}

Piece::Piece(const Piece& whole, space::Loop own, const RationalPoint& normal)
    : fragment(whole.fragment), index(whole.index), part(whole.part), loop(std::move(own)) {
  measure(normal);
}

Piece::Piece(std::uint32_t of_part, space::Loop own, const RationalPoint& normal)
    : part(of_part), loop(std::move(own)) {
  measure(normal);
}

void Piece::measure(const RationalPoint& normal) {
  area = space::PlaneView(normal).area(loop);
  if (area < 0) {
    std::reverse(loop.begin(), loop.end());
    area = -area;
  }
  for (const RationalPoint& point : loop) {
    corners.push_back({point[0].get_d(), point[1].get_d(), point[2].get_d()});
  }
  low = high = corners[0];
  for (const std::array<double, 3>& corner : corners) {
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], round_down(corner[k]));
      high[k] = std::max(high[k], round_up(corner[k]));
    }
  }
}

void Piece::lay(const PlaneFrame& frame) {
  flat = frame.loop_at(loop);
  // A loop may turn the other way than the frame's plane.
  flat_turned_ = area_of(flat) < 0;
  if (flat_turned_) std::ranges::reverse(flat);
  flat_box = box_of(flat);
}

double Piece::reach() const {
  double most = 0;
  for (int k = 0; k < 3; ++k) most = std::max({most, std::fabs(low[k]), std::fabs(high[k])});
  return most;
}

bool Piece::overlaps_box_of(const Piece& other) const {
  for (int k = 0; k < 3; ++k) {
    if (high[k] < other.low[k] || other.high[k] < low[k]) return false;
  }
  return true;
}

namespace {

/// Never turns right, and goes up and comes down once each: edges' directions go around once.
bool turns_left_once(const space::Loop& loop, const space::PlaneView& view) {
  int changes = 0;
  bool first_up = false, up = false;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const RationalPoint &a = loop[i], &b = loop[(i + 1) % loop.size()];
    if (a == b || view.turn(a, b, loop[(i + 2) % loop.size()]) < 0) return false;
    const bool next_up = a < b;
    changes += i > 0 && next_up != up;
    if (i == 0) first_up = next_up;
    up = next_up;
  }
  changes += up != first_up;
  return changes == 2;
}

}  // namespace

bool Piece::is_convex(const RationalPoint& normal) const {
  const space::PlaneView view(normal);
  if (turns_left_once(loop, view)) return true;
  for (std::size_t v = 0; v < loop.size(); ++v) {
    for (const RationalPoint& point : loop) {
      if (view.turn(loop[v], loop[(v + 1) % loop.size()], point) < 0) return false;
    }
  }
  return true;
}

bool Piece::is_apart(const std::vector<HalfSpace>& bounds, double margin) const {
  const auto largest = [](const std::array<double, 3>& p) {
    return std::max({std::fabs(p[0]), std::fabs(p[1]), std::fabs(p[2])});
  };
  // Corner and base were rounded, which far from the origin is more than any margin: three terms of
  // at most half a unit each, for both, and the rounding of the sum.
  constexpr double kRounding = 0x1p-49;
  return std::ranges::any_of(bounds, [&](const HalfSpace& half) {
    return std::ranges::all_of(corners, [&](const std::array<double, 3>& corner) {
      const double error_bound = kRounding * (largest(corner) + largest(half.near_base));
      return half.near_value(corner) < -margin - error_bound;
    });
  });
}

const std::vector<HalfSpace>& Piece::walls_of(const RationalPoint& normal) {
  if (!walls_.empty()) return walls_;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const RationalPoint &a = loop[i], &b = loop[(i + 1) % loop.size()];
    RationalPoint inward = cross(normal, minus(b, a));
    if (dot(inward, inward) != 0) walls_.emplace_back(std::move(inward), a);
  }
  return walls_;
}

int turn_in_frame(const PlanarPoint& from, const PlanarPoint& to, const PlanarPoint& at,
                  long double error) {
  const long double ux = to.x - from.x, uy = to.y - from.y, vx = at.x - from.x, vy = at.y - from.y;
  const long double turn = ux * vy - uy * vx;
  // Coordinates are off by e = kPlanarError M at most and their differences by 2 e, so that the two
  // products are by 2 e (|ux| + |uy| + |vx| + |vy|) + 8 e^2 together. What sums and products round
  // off is less than 2^-62 of |u| |v|, where |u| is at most 4 sqrt(2) M: a second such term is
  // more.
  const long double error_bound =
      4 * error * (std::fabs(ux) + std::fabs(uy) + std::fabs(vx) + std::fabs(vy) + 4 * error);
  if (turn > error_bound) return 1;
  if (turn < -error_bound) return -1;
  return 0;
}

int PieceSides::side(const Piece& a, std::size_t edge, const Piece& b, std::size_t v) const {
  const std::size_t next = edge + 1 < a.loop.size() ? edge + 1 : 0;
  const long double error = kPlanarError * std::max({reach_, static_cast<long double>(a.reach()),
                                                     static_cast<long double>(b.reach())});
  const int turn = turn_in_frame(a.flat_at(edge), a.flat_at(next), b.flat_at(v), error);
  if (turn != 0) return turn;
  const RationalPoint& point = b.loop[v];
  if (point == a.loop[edge] || point == a.loop[next]) return 0;
  return view_.turn(a.loop[edge], a.loop[next], point);
}

bool PieceSides::are_apart(const Piece& a, const Piece& b) const {
  for (std::size_t edge = 0; edge < a.loop.size(); ++edge) {
    bool beyond = true;
    for (std::size_t v = 0; v < b.loop.size() && beyond; ++v) beyond = side(a, edge, b, v) <= 0;
    if (beyond && a.loop[edge] != a.loop[(edge + 1) % a.loop.size()]) return true;
  }
  return false;
}

bool PieceSides::holds(const Piece& a, const Piece& b) const {
  for (std::size_t edge = 0; edge < a.loop.size(); ++edge) {
    for (std::size_t v = 0; v < b.loop.size(); ++v) {
      if (side(a, edge, b, v) < 0) return false;
    }
  }
  return true;
}

namespace {

std::vector<Piece> pieces_of(const Piece& whole, std::vector<space::Loop> loops,
                             const RationalPoint& normal) {
  std::vector<Piece> pieces;
  for (space::Loop& loop : loops) pieces.emplace_back(whole, std::move(loop), normal);
  return pieces;
}

}  // namespace

std::vector<Piece> cut_to_visible(std::vector<Piece> pieces, const RationalPoint& normal) {
  std::ranges::stable_sort(pieces, std::greater<>(),
                           [](const Piece& piece) { return piece.fragment->level; });
  std::vector<Piece> visible;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    std::vector<space::Loop> loops{pieces[i].loop};
    for (std::size_t j = 0; j < i && !loops.empty(); ++j) {
      if (pieces[j].fragment->level == pieces[i].fragment->level) break;
      if (pieces[j].area == 0 || !pieces[j].overlaps_box_of(pieces[i])) continue;
      loops = without(std::move(loops), pieces[j].walls_of(normal));
    }
    std::ranges::move(pieces_of(pieces[i], std::move(loops), normal), std::back_inserter(visible));
  }
  return visible;
}

std::vector<Piece> left_over(std::uint32_t part, const space::Loop& loop,
                             const RationalPoint& normal, std::vector<Piece>& pieces) {
  const Piece whole(part, loop, normal);
  std::vector<space::Loop> loops{whole.loop};
  for (std::size_t i = 0; i < pieces.size() && !loops.empty(); ++i) {
    if (pieces[i].area == 0 || !pieces[i].overlaps_box_of(whole)) continue;
    loops = without(std::move(loops), pieces[i].walls_of(normal));
  }
  std::vector<Piece> left;
  for (space::Loop& own : loops) left.emplace_back(part, std::move(own), normal);
  return left;
}

}  // namespace gnomon::oracle
