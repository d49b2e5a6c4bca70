// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/scene/exact_points.h"

#include <algorithm>
#include <cmath>

namespace gnomon::fuzz {

Vector exact(const Position& position) {
  return {position[0].exact(), position[1].exact(), position[2].exact()};
}
Vector operator+(const Vector& a, const Vector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Vector operator-(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vector operator*(const mpq_class& factor, const Vector& a) {
  return {factor * a[0], factor * a[1], factor * a[2]};
}

mpq_class power_of_two(int exponent) {
  mpz_class power;
  mpz_ui_pow_ui(power.get_mpz_t(), 2, static_cast<unsigned long>(std::abs(exponent)));
  return exponent >= 0 ? mpq_class(power) : mpq_class(mpz_class(1), power);
}

int exponent_of(const mpq_class& value) {
  return static_cast<int>(mpz_sizeinbase(value.get_num_mpz_t(), 2)) -
         static_cast<int>(mpz_sizeinbase(value.get_den_mpz_t(), 2));
}

std::optional<Number> number_of(const mpq_class& value, NumberMeaning meaning) {
  if (value == 0) return Number(0.0);
  mpz_class rest = value.get_den();
  const auto twos = static_cast<std::int32_t>(mpz_scan1(rest.get_mpz_t(), 0));
  rest >>= static_cast<unsigned long>(twos);
  if (meaning == NumberMeaning::kDouble) {
    if (rest != 1) return std::nullopt;
    const Number number = Number::from_dyadic(value.get_num(), -twos);
    if (!number.is_double()) return std::nullopt;
    return number;
  }
  std::int32_t fives = 0;
  const mpz_class five = 5;
  fives =
      static_cast<std::int32_t>(mpz_remove(rest.get_mpz_t(), rest.get_mpz_t(), five.get_mpz_t()));
  const std::int32_t digits = std::max(twos, fives);
  if (rest != 1 || digits > 300) return std::nullopt;
  mpz_class ten;
  mpz_ui_pow_ui(ten.get_mpz_t(), 10, static_cast<unsigned long>(digits));
  const mpz_class mantissa = value.get_num() * (ten / value.get_den());
  if (mpz_sizeinbase(mantissa.get_mpz_t(), 10) > 300) return std::nullopt;
  return Number::from_decimal(mantissa, -digits);
}

std::optional<Position> position_of(const Vector& point, NumberMeaning meaning) {
  Position position;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto number = number_of(point[k], meaning);
    if (!number) return std::nullopt;
    position[k] = *number;
  }
  return position;
}

std::optional<Position> rounded_position(const Vector& point, NumberMeaning meaning) {
  if (auto position = position_of(point, meaning)) return position;
  if (meaning == NumberMeaning::kDecimal) return std::nullopt;
  Position position;
  for (std::size_t k = 0; k < 3; ++k) {
    // Towards 0, and the same everywhere.
    const double value = point[k].get_d();
    if (!std::isfinite(value)) return std::nullopt;
    position[k] = Number(value);
  }
  return position;
}

std::vector<Vector> loop_of(const Scene& scene, const Polygon& polygon) {
  std::vector<Vector> loop;
  loop.reserve(polygon.loop.size());
  for (const VertexId v : polygon.loop) loop.push_back(exact(scene.vertices[v]));
  return loop;
}

std::vector<Vector> loop_of(const Light& area_light) {
  std::vector<Vector> loop;
  loop.reserve(area_light.loop.size());
  for (const Position& corner : area_light.loop) loop.push_back(exact(corner));
  return loop;
}

Vector area_vector(const std::vector<Vector>& loop) {
  Vector sum{};
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    sum = sum + cross(loop[i] - loop[0], loop[i + 1] - loop[0]);
  }
  return sum;
}

mpq_class Box::extent() const {
  const Vector sides = size();
  return std::max({sides[0], sides[1], sides[2]});
}

Box box_of(const std::vector<Vector>& points) {
  Box box{points[0], points[0]};
  for (const Vector& p : points) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (p[k] < box.low[k]) box.low[k] = p[k];
      if (p[k] > box.high[k]) box.high[k] = p[k];
    }
  }
  return box;
}

Box box_of(const Scene& scene) {
  std::vector<Vector> points;
  for (const Polygon& polygon : scene.polygons) {
    for (const VertexId v : polygon.loop) points.push_back(exact(scene.vertices[v]));
  }
  return box_of(points);
}

}  // namespace gnomon::fuzz
