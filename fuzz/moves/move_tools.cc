// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/moves/move_tools.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace gnomon::fuzz {
namespace {

std::optional<std::vector<Position>> positions_of_loop(const std::vector<Vector>& loop,
                                                       NumberMeaning meaning, bool rounded) {
  std::vector<Position> positions;
  for (const Vector& point : loop) {
    auto position = rounded ? rounded_position(point, meaning) : position_of(point, meaning);
    if (!position) return std::nullopt;
    positions.push_back(std::move(*position));
  }
  return positions;
}

bool has_area(const std::vector<Position>& loop) {
  std::vector<Vector> points;
  for (const Position& position : loop) points.push_back(exact(position));
  return !is_zero(area_vector(points));
}

std::string free_id(const Scene& scene, bool light) {
  std::size_t number = light ? scene.lights.size() : scene.polygons.size();
  for (;; ++number) {
    std::string id = (light ? "light" : "") + std::to_string(number);
    const auto same = [&](const auto& item) { return item.id == id; };
    if (light ? std::ranges::none_of(scene.lights, same)
              : std::ranges::none_of(scene.polygons, same)) {
      return id;
    }
  }
}

/// A power of the numbers' base near an eighth of the scene's size: where free points lie.
mpq_class lattice_step(const Scene& scene, const Box& box) {
  const int exponent = exponent_of(box.extent());
  if (scene.numbers == NumberMeaning::kDouble) return power_of_two(exponent - 3);
  // 10^(0.3 (exponent - 3)), whole.
  const int digits = (exponent - 3) * 3 / 10;
  mpz_class power;
  mpz_ui_pow_ui(power.get_mpz_t(), 10, static_cast<unsigned long>(std::abs(digits)));
  return digits >= 0 ? mpq_class(power) : mpq_class(mpz_class(1), power);
}

/// The nearest multiple of `step` below.
mpq_class floored(const mpq_class& value, const mpq_class& step) {
  const mpq_class ratio = value / step;
  mpz_class whole;
  mpz_fdiv_q(whole.get_mpz_t(), ratio.get_num_mpz_t(), ratio.get_den_mpz_t());
  return whole * step;
}

}  // namespace

Corner random_corner(std::vector<Vector> loop, Random& random) {
  const auto turn = static_cast<std::ptrdiff_t>(random.below(loop.size()));
  std::rotate(loop.begin(), loop.begin() + turn, loop.end());
  for (std::size_t i = 0; i < loop.size(); ++i) {
    if (!is_zero(cross(loop[1] - loop[0], loop.back() - loop[0]))) break;
    std::rotate(loop.begin(), loop.begin() + 1, loop.end());
  }
  Corner corner;
  corner.a = loop[0];
  corner.u = loop[1] - loop[0];
  corner.v = loop.back() - loop[0];
  corner.loop = std::move(loop);
  return corner;
}

Corner random_corner(const Scene& scene, Random& random) {
  const Polygon& polygon = scene.polygons[random.below(scene.polygons.size())];
  return random_corner(loop_of(scene, polygon), random);
}

mpq_class dyadic(Random& random, std::int64_t low, std::int64_t high, int bits) {
  mpq_class value(static_cast<long>(random.between(low, high)));
  return value * power_of_two(-bits);
}

Vector inner_point(const Corner& corner, Random& random) {
  const std::size_t n = corner.loop.size();
  const std::size_t i = n == 3 ? 1 : 1 + random.below(n - 2);
  const Vector &b = corner.loop[i], &c = corner.loop[i + 1];
  static constexpr std::array<std::array<int, 2>, 6> kWeights = {
      {{1, 1}, {2, 1}, {1, 2}, {3, 2}, {2, 3}, {1, 5}}};
  const auto& weight = kWeights[random.below(6)];
  const int bits = weight[0] + weight[1] < 4 ? 2 : 3;
  return corner.a + mpq_class(weight[0]) * power_of_two(-bits) * (b - corner.a) +
         mpq_class(weight[1]) * power_of_two(-bits) * (c - corner.a);
}

Vector plane_point(const Corner& corner, Random& random) {
  const int bits = static_cast<int>(random.below(2));
  const mpq_class s = dyadic(random, -2, 4, bits), t = dyadic(random, -2, 4, bits);
  return corner.at(s, t);
}

Vector edge_point(const Corner& corner, Random& random) {
  return random.chance(1, 2) ? corner.at(dyadic(random, 1, 1, 1), 0)
                             : corner.at(dyadic(random, 1, 7, 3), 0);
}

std::vector<Vector> patch_in_plane(const Corner& corner, Random& random) {
  for (;;) {
    const std::int64_t s = random.between(-2, 2), t = random.between(-2, 2),
                       p = random.between(-2, 2), q = random.between(-2, 2);
    if (s * q == t * p) continue;
    const Vector at = plane_point(corner, random);
    const Vector u =
        mpq_class(static_cast<long>(s)) * corner.u + mpq_class(static_cast<long>(t)) * corner.v;
    const Vector v =
        mpq_class(static_cast<long>(p)) * corner.u + mpq_class(static_cast<long>(q)) * corner.v;
    if (random.chance(1, 2)) return {at, at + u, at + v};
    return {at, at + u, at + u + v, at + v};
  }
}

Vector free_point(const Scene& scene, Random& random) {
  const Box box = box_of(scene);
  mpq_class step = lattice_step(scene, box);
  std::int64_t cells = 16;  // the box has 8 to 16
  if (random.chance(1, 4)) {
    step *= power_of_two(-14);
    cells <<= 14;
  }
  Vector point;
  for (std::size_t k = 0; k < 3; ++k) {
    const mpq_class around = (box.low[k] + box.high[k]) / 2;
    point[k] =
        floored(around, step) +
        mpq_class(static_cast<long>(random.between(-(cells * 3) / 4, (cells * 3) / 4))) * step;
  }
  return point;
}

Vector free_vector(const Scene& scene, Random& random) {
  const mpq_class step = lattice_step(scene, box_of(scene));
  for (;;) {
    const Vector vector = {step * dyadic(random, -6, 6, 0), step * dyadic(random, -6, 6, 0),
                           step * dyadic(random, -6, 6, 0)};
    if (!is_zero(vector)) return vector;
  }
}

Vector hair(const Scene& scene, Random& random, int low, int high) {
  const int shift = static_cast<int>(random.between(low, high));
  return power_of_two(-shift) * free_vector(scene, random);
}

std::vector<Vector> completed(const Scene& scene, Random& random, std::vector<Vector> first) {
  if (random.chance(1, 3)) {
    const Vector w = free_vector(scene, random);
    if (first.size() == 2) return {first[0], first[1], first[1] + w, first[0] + w};
    if (first.size() == 1) {
      const Vector x = free_vector(scene, random);
      return {first[0], first[0] + w, first[0] + w + x, first[0] + x};
    }
  }
  while (first.size() < 3) first.push_back(free_point(scene, random));
  return first;
}

Position nudged(const Position& position, Random& random) {
  Position result = position;
  std::size_t k = random.below(3);
  if (!random.chance(1, 16)) {
    for (int i = 0; i < 3 && result[k].is_zero(); ++i) k = (k + 1) % 3;
  }
  const double far = random.chance(1, 2) ? std::numeric_limits<double>::max()
                                         : -std::numeric_limits<double>::max();
  result[k] = Number(std::nextafter(result[k].nearest(), far));
  return result;
}

bool add_polygon_at(Scene& scene, Random& random, const std::vector<Position>& loop,
                    bool may_turn) {
  if (loop.size() < 3 || !has_area(loop)) return false;
  Polygon polygon;
  polygon.id = free_id(scene, false);
  for (const Position& position : loop) {
    polygon.loop.push_back(static_cast<VertexId>(scene.vertices.size()));
    scene.vertices.push_back(position);
  }
  if (may_turn && random.chance(1, 3)) std::ranges::reverse(polygon.loop);
  const Polygon& like = scene.polygons[random.below(scene.polygons.size())];
  polygon.two_sided = scene.is_two_sided(like);
  polygon.casts = !random.chance(1, 12);
  scene.polygons.push_back(std::move(polygon));
  return true;
}

bool add_polygon(Scene& scene, Random& random, const std::vector<Vector>& loop, bool may_turn) {
  const auto positions = positions_of_loop(loop, scene.numbers, false);
  return positions && add_polygon_at(scene, random, *positions, may_turn);
}

bool add_rounded_triangle(Scene& scene, Random& random, const std::vector<Vector>& loop) {
  const auto positions = positions_of_loop(loop, scene.numbers, true);
  return positions && add_polygon_at(scene, random, *positions);
}

namespace {

void put_light(Scene& scene, Random& random, Light light) {
  const bool area = light.has_area();
  std::vector<std::size_t> alike;
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    if (scene.lights[i].has_area() == area) alike.push_back(i);
  }
  // A second light of a kind now and then; area lights are dear, and drive other lights out.
  if (!alike.empty() && (alike.size() > 1 || !random.chance(1, area ? 6 : 3))) {
    Light& old = scene.lights[alike[random.below(alike.size())]];
    light.id = old.id;
    old = std::move(light);
    return;
  }
  if (area && alike.empty() && !random.chance(1, 6)) scene.lights.clear();
  light.id = free_id(scene, true);
  scene.lights.push_back(std::move(light));
}

bool set_panel_at(Scene& scene, Random& random, std::vector<Position> loop) {
  if (!has_area(loop)) return false;
  if (random.chance(1, 2)) std::ranges::reverse(loop);
  Light light;
  light.type = LightType::kArea;
  light.loop = std::move(loop);
  put_light(scene, random, std::move(light));
  return true;
}

}  // namespace

bool set_light(Scene& scene, Random& random, LightType type, const std::optional<Position>& at) {
  if (!at) return false;
  if (type == LightType::kDirectional && is_zero(exact(*at))) return false;
  Light light;
  light.type = type;
  light.position = *at;
  put_light(scene, random, std::move(light));
  return true;
}

bool set_panel(Scene& scene, Random& random, const std::vector<Vector>& loop) {
  auto positions = positions_of_loop(loop, scene.numbers, false);
  return positions && set_panel_at(scene, random, std::move(*positions));
}

bool set_rounded_panel(Scene& scene, Random& random, const std::vector<Vector>& triangle) {
  auto positions = positions_of_loop(triangle, scene.numbers, true);
  return positions && set_panel_at(scene, random, std::move(*positions));
}

}  // namespace gnomon::fuzz
