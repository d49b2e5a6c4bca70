// SPDX-License-Identifier: LGPL-3.0-or-later
// Vectors of decimals: exact sums and products, lengths and unit vectors as exact as decimals can
// have them. Requires of all: decimal coordinates.
#ifndef GNOMON_SCENE_MODEL_DECIMAL_VECTOR_H
#define GNOMON_SCENE_MODEL_DECIMAL_VECTOR_H

#include <vector>

#include "gnomon/scene/scene.h"

namespace gnomon::decimals {

Position sum(const Position& a, const Position& b);
Position difference(const Position& a, const Position& b);
Position scaled(const Position& a, const Number& factor);
Number dot(const Position& a, const Position& b);
Position cross(const Position& a, const Position& b);
bool is_zero(const Position& a);
/// Twice the area vector of a loop, as Newell has it.
Position area_vector(const std::vector<Position>& loop);

/// A number, or a vector, and whether it had to be rounded: to about 15 significant digits.
struct Length {
  Number value;
  bool is_rounded = false;
};
Length length_of(const Position& a);

/// a / |a|. If it is rounded, it still has exactly the direction of a; its length is off.
struct UnitVector {
  Position vector;
  bool is_rounded = false;
};
/// Requires: a is not 0.
UnitVector unit_vector(const Position& a);

/// The cosine and the sine of an angle in degrees: exact for multiples of 90, else of 12 digits
/// behind the point.
struct Angle {
  Number cosine, sine;
  bool is_rounded = false;
  double error = 0;    // degrees by which the direction of (cosine, sine) is off
  double stretch = 0;  // cosine^2 + sine^2 is (1 + stretch)^2
};
Angle angle_of(const Number& degrees);

}  // namespace gnomon::decimals

#endif  // GNOMON_SCENE_MODEL_DECIMAL_VECTOR_H
