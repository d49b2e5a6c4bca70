// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/energyplus/wall_frame.h"

#include <utility>

#include "scene/model/decimal_arithmetic.h"

namespace gnomon::energy {

namespace {

/// A horizontal vector to the right in a surface, seen from outside: one of its edges, if one has
/// that direction, since an edge has fewer digits than a normal.
Position horizontal_direction(const std::vector<Position>& loop, const Position& normal) {
  const Position right = {negated_decimal(normal[1]), normal[0], Number()};
  for (std::size_t i = 0; i < loop.size(); ++i) {
    Position edge = difference(loop[(i + 1) % loop.size()], loop[i]);
    if (is_zero(edge) || !edge[2].is_zero() || !is_zero(cross(edge, right))) continue;
    if (dot(edge, right).sign() < 0) edge = difference(Position{}, edge);
    return edge;
  }
  return right;
}

}  // namespace

std::size_t lower_left(FirstCorner first, std::size_t vertices) {
  switch (first) {
    case FirstCorner::kUpperLeft:
      return 1;
    case FirstCorner::kLowerLeft:
      return 0;
    case FirstCorner::kLowerRight:
      return vertices - 1;
    case FirstCorner::kUpperRight:
      return 2;
  }
  return 0;
}

std::optional<WallFrame> wall_frame(const std::vector<Position>& loop, FirstCorner first) {
  const Position normal = area_vector(loop);
  if (normal[0].is_zero() && normal[1].is_zero()) return std::nullopt;
  const Position right = horizontal_direction(loop, normal);
  UnitVector along = unit_vector(right);
  WallFrame frame;
  frame.corner = loop[lower_left(first, loop.size())];
  frame.out_in_plan = {along.vector[1], negated_decimal(along.vector[0]), Number()};
  frame.is_rounded = along.is_rounded;
  if (normal[2].is_zero()) {
    frame.up = {Number(), Number(), Number::from_short_decimal(1, 0)};
    frame.out = frame.out_in_plan;
  } else {
    UnitVector up = unit_vector(cross(normal, right));
    UnitVector out = unit_vector(normal);
    frame.is_rounded = frame.is_rounded || up.is_rounded || out.is_rounded;
    frame.up = std::move(up.vector);
    frame.out = std::move(out.vector);
  }
  frame.along = std::move(along.vector);
  return frame;
}

WallFrame wall_frame(const Number& azimuth, const Number& tilt, Position corner) {
  const Angle facing = angle_of(azimuth);
  const Angle leaning = angle_of(tilt);
  WallFrame frame;
  frame.corner = std::move(corner);
  frame.along = {negated_decimal(facing.cosine), facing.sine, Number()};
  frame.out_in_plan = {facing.sine, facing.cosine, Number()};
  frame.up = scaled(frame.out_in_plan, negated_decimal(leaning.cosine));
  frame.up[2] = leaning.sine;
  frame.out = scaled(frame.out_in_plan, leaning.sine);
  frame.out[2] = leaning.cosine;
  frame.is_rounded = facing.is_rounded || leaning.is_rounded;
  return frame;
}

std::vector<Position> rectangle(const WallFrame& frame, const Number& right, const Number& above,
                                const Number& length, const Number& height) {
  const Position corner =
      sum(frame.corner, sum(scaled(frame.along, right), scaled(frame.up, above)));
  const Position to_right = scaled(frame.along, length), to_top = scaled(frame.up, height);
  return {corner, sum(corner, to_right), sum(sum(corner, to_right), to_top), sum(corner, to_top)};
}

}  // namespace gnomon::energy
