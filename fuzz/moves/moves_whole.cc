// SPDX-License-Identifier: GPL-3.0-or-later
// Moves that change every coordinate, or the range of them.
#include <algorithm>
#include <array>
#include <optional>

#include "fuzz/moves/move_tools.h"
#include "fuzz/scene/scene_coordinates.h"

namespace gnomon::fuzz {
namespace {

bool mixed_magnitudes(Scene& scene, Random& random) {
  if (scene.numbers == NumberMeaning::kDecimal) return false;
  const int exponent =
      static_cast<int>(random.chance(1, 2) ? random.between(70, 120) : random.between(120, 600));
  const mpq_class times = power_of_two(random.chance(1, 2) ? exponent : -exponent);
  Vector point = free_point(scene, random);
  for (mpq_class& c : point) {
    if (random.chance(2, 3)) c *= times;
  }
  const Corner corner = random_corner(scene, random);
  return add_polygon(scene, random, {point, corner.a, corner.next()}) ||
         add_polygon(scene, random, {point, corner.a, free_point(scene, random)});
}

/// Loops that rounding bent become triangles. False if one lost its area.
bool straighten(Scene& scene) {
  const auto is_flat = [](const std::vector<Vector>& loop) {
    const Vector normal = area_vector(loop);
    return std::ranges::all_of(loop,
                               [&](const Vector& p) { return dot(normal, p - loop[0]) == 0; });
  };
  for (Polygon& polygon : scene.polygons) {
    if (!is_flat(loop_of(scene, polygon))) {
      polygon.loop.resize(3);
      polygon.holes.clear();
    }
    if (is_zero(area_vector(loop_of(scene, polygon)))) return false;
  }
  for (Light& light : scene.lights) {
    if (!light.has_area()) continue;
    if (!is_flat(loop_of(light))) light.loop.resize(3);
    if (is_zero(area_vector(loop_of(light)))) return false;
  }
  return true;
}

bool large_offset(Scene& scene, Random& random) {
  Vector offset;
  if (random.chance(1, 2)) {
    static constexpr double kSizes[] = {1e6, 1e9, 1e12, 1e15};
    const mpq_class size(kSizes[random.below(4)]);
    for (mpq_class& c : offset) c = size * dyadic(random, -9, 9, 0);
  } else {
    const mpq_class size = power_of_two(exponent_of(box_of(scene).extent()) +
                                        static_cast<int>(random.between(20, 42)));
    for (mpq_class& c : offset) c = size * dyadic(random, -7, 7, 0);
  }
  for (Position* position : positions_of(scene)) {
    const auto moved = rounded_position(exact(*position) + offset, scene.numbers);
    if (!moved) return false;
    *position = *moved;
  }
  return straighten(scene);
}

/// Turned by a 3-4-5 angle and written in tenths, hundredths or thousandths: what was exactly
/// degenerate still is, and nothing is a double any more.
bool decimals(Scene& scene, Random& random) {
  if (scene.numbers == NumberMeaning::kDecimal) return false;
  scene.numbers = NumberMeaning::kDecimal;
  static constexpr int kDenominators[] = {10, 100, 1000, 5};
  const int tenths = static_cast<int>(random.between(1, 9));
  mpq_class unit(tenths, kDenominators[random.below(4)]);
  unit.canonicalize();
  const std::size_t x = random.below(3), y = (x + 1) % 3;
  const bool turn = random.chance(1, 2);
  for (Position* position : points_of(scene)) {
    Vector p = exact(*position);
    if (turn) {
      const mpq_class c(3, 5), s(4, 5);
      const mpq_class turned = c * p[x] - s * p[y];
      p[y] = s * p[x] + c * p[y];
      p[x] = turned;
    }
    for (mpq_class& value : p) value *= unit;
    const auto made = position_of(p, scene.numbers);
    if (!made) return false;
    *position = *made;
  }
  return true;
}

bool scaled_by(Scene& scene, Random& random, bool up) {
  if (scene.numbers == NumberMeaning::kDecimal) return false;
  static constexpr int kExponents[] = {320, 450, 600, 900};
  const int exponent = kExponents[random.below(4)] * (up ? 1 : -1);
  const auto scale = [&](Position& position) {
    return std::ranges::all_of(position, [&](Number& number) {
      if (number.is_zero()) return true;
      number = Number::from_dyadic(number.mantissa(), number.exponent() + exponent);
      return number.is_double();
    });
  };
  const auto all = [&](const std::vector<Position*>& positions) {
    return std::ranges::all_of(positions, [&](Position* p) { return scale(*p); });
  };
  if (!all(positions_of(scene))) return false;
  return random.chance(1, 2) || all(directions_of(scene));
}

bool scaled_up(Scene& scene, Random& random) { return scaled_by(scene, random, true); }
bool scaled_down(Scene& scene, Random& random) { return scaled_by(scene, random, false); }

}  // namespace

std::vector<Move> whole_moves() {
  constexpr MoveGroup kGroup = MoveGroup::kWhole;
  return {
      {Kind::kMixedMagnitudes, kGroup, mixed_magnitudes},
      {Kind::kLargeOffset, kGroup, large_offset},
      {Kind::kDecimals, kGroup, decimals},
      {Kind::kScaledUp, kGroup, scaled_up},
      {Kind::kScaledDown, kGroup, scaled_down},
  };
}

}  // namespace gnomon::fuzz
