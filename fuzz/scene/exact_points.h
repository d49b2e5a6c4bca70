// SPDX-License-Identifier: GPL-3.0-or-later
// Points as exact rationals, and back to numbers of a scene: the arithmetic of moves, none of which
// may round unless it means to.
#ifndef GNOMON_FUZZ_SCENE_EXACT_POINTS_H
#define GNOMON_FUZZ_SCENE_EXACT_POINTS_H

#include <gmpxx.h>

#include <array>
#include <optional>
#include <vector>

#include "gnomon/scene/scene.h"
#include "scene/base/random.h"
#include "scene/base/vectors.h"

namespace gnomon::fuzz {

using Vector = std::array<mpq_class, 3>;

Vector exact(const Position& position);
Vector operator+(const Vector& a, const Vector& b);
Vector operator-(const Vector& a, const Vector& b);
Vector operator*(const mpq_class& factor, const Vector& a);

/// 2^exponent
mpq_class power_of_two(int exponent);
/// The exponent of the greatest power of two that is not above |value|, or that less 1. Requires:
/// value != 0.
int exponent_of(const mpq_class& value);

/// Nothing if a scene's numbers cannot be it: no double, or no decimal of at most 300 digits.
std::optional<Number> number_of(const mpq_class& value, NumberMeaning meaning);
std::optional<Position> position_of(const Vector& point, NumberMeaning meaning);
/// The nearest double where there is one to be had; decimals as they are.
std::optional<Position> rounded_position(const Vector& point, NumberMeaning meaning);

std::vector<Vector> loop_of(const Scene& scene, const Polygon& polygon);
std::vector<Vector> loop_of(const Light& area_light);
/// The area vector: zero if the loop has no area.
Vector area_vector(const std::vector<Vector>& loop);

struct Box {
  Vector low, high;
  Vector size() const { return high - low; }
  /// The longest side.
  mpq_class extent() const;
};
/// The box of all polygons.
Box box_of(const Scene& scene);
Box box_of(const std::vector<Vector>& points);

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_SCENE_EXACT_POINTS_H
