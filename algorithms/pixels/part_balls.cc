// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/pixels/part_balls.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon {
namespace {

using Vector = std::array<double, 3>;

constexpr double kRelative = 0x1p-40, kOfCoordinates = 0x1p-46;

Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double length(const Vector& v) { return std::hypot(v[0], v[1], v[2]); }
Vector divided(const Vector& v, double by) { return {v[0] / by, v[1] / by, v[2] / by}; }
double largest(const Vector& v) {
  return std::max({std::fabs(v[0]), std::fabs(v[1]), std::fabs(v[2])});
}

}  // namespace

PartBalls::PartBalls(const PreparedScene& scene, const ImageFrame& frame)
    : eye_(frame.eye.nearest) {
  double coordinates = largest(eye_);
  for (const PreparedLight& light : scene.lights) {
    if (light.is_point()) coordinates = std::max(coordinates, largest(light.point.nearest));
  }
  for (const Vector& x : scene.geometry.positions) coordinates = std::max(coordinates, largest(x));
  margin_ = kOfCoordinates * coordinates;
  balls_.reserve(scene.parts.size());
  for (const Part& part : scene.parts) {
    Ball3 ball;
    for (const VertexId v : scene.loop(part)) {
      for (std::size_t k = 0; k < 3; ++k) {
        ball.centre[k] += scene.geometry.positions[v][k] / part.count;
      }
    }
    for (const VertexId v : scene.loop(part)) {
      ball.radius = std::max(ball.radius, length(minus(scene.geometry.positions[v], ball.centre)));
    }
    ball.radius = ball.radius * (1 + kRelative) + margin_;
    balls_.push_back(ball);
  }
  row_normals_.reserve(frame.height);
  const Vector right{static_cast<double>(frame.right[0]), static_cast<double>(frame.right[1]),
                     static_cast<double>(frame.right[2])};
  for (std::uint32_t row = 0; row < frame.height; ++row) {
    const ImageFrame::Direction d = frame.direction({0, row});
    const Vector along{static_cast<double>(d[0]), static_cast<double>(d[1]),
                       static_cast<double>(d[2])};
    const Vector normal{along[1] * right[2] - along[2] * right[1],
                        along[2] * right[0] - along[0] * right[2],
                        along[0] * right[1] - along[1] * right[0]};
    row_normals_.push_back(divided(normal, length(normal)));
  }
}

bool PartBalls::misses_row(std::uint32_t part, std::uint32_t row) const {
  const Ball3& ball = balls_[part];
  const Vector from_eye = minus(ball.centre, eye_);
  // No number compares as false: then the row is looked at.
  return std::fabs(dot(row_normals_[row], from_eye)) >
         ball.radius + kRelative * (ball.radius + largest(from_eye)) + 4 * margin_;
}

// Seen from a point, a ball of radius r at a distance q fills directions within asin(r / q), at
// most 1.2 r / q below 0.7, and the chord between two directions is at most the angle between them.
bool PartBalls::are_apart(const LightPoint& light, std::uint32_t a, std::uint32_t b) const {
  const Ball3 &first = balls_[a], &second = balls_[b];
  const double slack = 4 * margin_;
  if (light.directional) {
    const Vector way = minus(first.centre, second.centre);
    const Vector direction = divided(light.nearest, length(light.nearest));
    const double along = dot(way, direction);
    const Vector across{way[0] - along * direction[0], way[1] - along * direction[1],
                        way[2] - along * direction[2]};
    return length(across) >
           (first.radius + second.radius) * (1 + kRelative) + kRelative * largest(way) + slack;
  }
  const Vector to_first = minus(first.centre, light.nearest);
  const Vector to_second = minus(second.centre, light.nearest);
  const double far_first = length(to_first), far_second = length(to_second);
  const double sine_first = (first.radius + slack) / far_first;
  const double sine_second = (second.radius + slack) / far_second;
  if (!(sine_first < 0.7 && sine_second < 0.7)) return false;
  const Vector chord = minus(divided(to_first, far_first), divided(to_second, far_second));
  return length(chord) > 1.2 * (sine_first + sine_second) + kRelative;
}

namespace {

/// Two directions of length 1 across a third one.
std::array<Vector, 2> across(const Vector& direction) {
  const Vector aside = std::fabs(direction[0]) < 0.6 ? Vector{1, 0, 0} : Vector{0, 1, 0};
  const auto cross = [](const Vector& a, const Vector& b) -> Vector {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  Vector first = cross(direction, aside);
  first = divided(first, length(first));
  return {first, cross(direction, first)};
}

}  // namespace

Box PartBalls::outline(const LightPoint& light, std::uint32_t part) const {
  const Ball3& ball = balls_[part];
  const double slack = 4 * margin_;
  Vector middle{};
  double reach = 2;  // all directions
  if (light.directional) {
    const auto [u, v] = across(divided(light.nearest, length(light.nearest)));
    middle = {dot(u, ball.centre), dot(v, ball.centre), 0};
    reach = ball.radius * (1 + kRelative) + kRelative * largest(ball.centre) + slack;
  } else {
    const Vector to_ball = minus(ball.centre, light.nearest);
    const double far = length(to_ball), sine = (ball.radius + slack) / far;
    if (sine < 0.7) {
      middle = divided(to_ball, far);
      reach = 1.2 * sine + kRelative;
    }
  }
  // No number means everything.
  if (!std::isfinite(reach) || !std::isfinite(middle[0] + middle[1] + middle[2])) {
    constexpr double kMost = std::numeric_limits<double>::max();
    return {{-kMost, -kMost, -kMost}, {kMost, kMost, kMost}};
  }
  Box box;
  for (std::size_t k = 0; k < 3; ++k) {
    box.low[k] = middle[k] - reach;
    box.high[k] = middle[k] + reach;
  }
  return box;
}

}  // namespace gnomon
