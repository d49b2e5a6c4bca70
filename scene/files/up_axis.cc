// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/files/up_axis.h"

#include <utility>

#include "scene/model/decimal_arithmetic.h"

namespace gnomon {

namespace {

Number negated(const Number& number) {
  if (number.is_decimal()) return negated_decimal(number);
  if (number.is_double()) return Number(-number.nearest());
  return Number::from_dyadic(-number.mantissa(), number.exponent());
}

void turn(Position& position) {
  std::swap(position[1], position[2]);
  position[1] = negated(position[1]);
}

}  // namespace

void turn_y_up(Scene& scene) {
  for (Position& vertex : scene.vertices) turn(vertex);
  for (Light& light : scene.lights) {
    turn(light.position);
    for (Position& corner : light.loop) turn(corner);
    for (RegionPlane& plane : light.region) {
      for (Position& point : plane) turn(point);
    }
  }
}

}  // namespace gnomon
