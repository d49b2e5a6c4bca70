// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/generate/area_families.h"

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <optional>

#include "fuzz/generate/random_shapes.h"

namespace gnomon::fuzz {
namespace {

bool are_collinear(const std::array<Position, 3>& p) {
  std::array<std::array<mpq_class, 3>, 2> edge;
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t k = 0; k < 3; ++k) edge[i][k] = p[i + 1][k].exact() - p[0][k].exact();
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
    if (edge[0][u] * edge[1][v] != edge[0][v] * edge[1][u]) return false;
  }
  return true;
}

/// A triangle whose corners are vertices and lamps of the scene: exactly planar at any magnitude,
/// and in special places with respect to everything.
std::optional<Light> triangle_panel(const Scene& scene, Random& random) {
  std::vector<Position> pool = scene.vertices;
  for (const Light& light : scene.lights) {
    if (!light.is_point()) continue;
    // As likely as a vertex of a polygon.
    for (int i = 0; i < 3; ++i) pool.push_back(light.position);
  }
  for (int i = 0; i < 20; ++i) {
    std::array<Position, 3> corners;
    for (Position& corner : corners) corner = pool[random.below(pool.size())];
    if (are_collinear(corners)) continue;
    Light light;
    light.id = "panel";
    light.type = LightType::kArea;
    light.loop.assign(corners.begin(), corners.end());
    return light;
  }
  return std::nullopt;
}

/// A scene of another family under a triangle, sometimes with a lamp besides.
Scene under_triangle(const std::string& family, std::uint64_t seed) {
  Random random(seed);
  Scene scene = family_by_name(family).make(random.next());
  const std::optional<Light> panel = triangle_panel(scene, random);
  if (!panel || !random.chance(1, 6)) scene.lights.clear();
  if (panel) scene.lights.push_back(*panel);
  return scene;
}

Scene generic(std::uint64_t seed) { return under_triangle("Generic", seed); }
Scene almost_planar(std::uint64_t seed) { return under_triangle("AlmostPlanar", seed); }
Scene crossing(std::uint64_t seed) { return under_triangle("Crossing", seed); }
Scene tiles(std::uint64_t seed) { return under_triangle("CoplanarTiles", seed); }
Scene grazing(std::uint64_t seed) { return under_triangle("Grazing", seed); }
Scene needles(std::uint64_t seed) { return under_triangle("Needles", seed); }
Scene powers_of_two(std::uint64_t seed) { return under_triangle("PowersOfTwo", seed); }
Scene mixed_magnitudes(std::uint64_t seed) { return under_triangle("MixedMagnitudes", seed); }
Scene decimals(std::uint64_t seed) { return under_triangle("Decimals", seed); }
Scene repaired(std::uint64_t seed) { return under_triangle("Repaired", seed); }

/// Light and polygons on one lattice: cut by each other's planes, in them, behind them.
Scene lattice(std::uint64_t seed) {
  Random random(seed);
  ScenePen pen;
  const std::int64_t size = random.between(2, 5);
  add_lattice(pen, random, random.between(2, 6), size);
  pen.panel(random.chance(1, 2) ? shape(random, 0, size) : shape(random, -size, 2 * size));
  if (random.chance(1, 4)) pen.panel(shape(random, 0, size));
  return pen.take();
}

/// A panel over small shapes over a floor, as lights mostly are: no plane cuts the light, or few
/// do.
Scene overhead(std::uint64_t seed) {
  Random random(seed);
  ScenePen pen;
  pen.two_sided(random.chance(1, 2));
  pen.polygon({{-12, -12, -1}, {12, -12, -1}, {12, 12, -1}, {-12, 12, -1}});
  const std::int64_t count = random.between(1, 5);
  for (std::int64_t i = 0; i < count; ++i) {
    choose_flags(pen, random);
    std::vector<Triple> loop = shape(random, 0, 4);
    if (random.chance(1, 2)) {  // flat, on one of few heights
      const std::int64_t z = random.between(0, 4);
      for (Triple& p : loop) p[2] = z;
      if (is_zero(cross(loop[1] - loop[0], loop[2] - loop[0]))) continue;
    }
    pen.polygon(loop);
  }
  const std::int64_t x = random.between(-2, 4), y = random.between(-2, 4), w = random.between(1, 4),
                     h = random.between(1, 4), z = random.between(4, 9);
  std::vector<Triple> loop{{x, y, z}, {x, y + h, z}, {x + w, y + h, z}, {x + w, y, z}};
  if (random.chance(1, 3)) {
    for (Triple& p : loop) p[2] += p[0];
  }
  if (random.chance(1, 3)) loop.pop_back();
  pen.panel(loop);
  if (random.chance(1, 4)) pen.lamp({random.between(0, 4), random.between(0, 4), 7});
  return pen.take();
}

/// The light shares a vertex, an edge or its plane with casters, or touches them.
Scene shared_features(std::uint64_t seed) {
  Random random(seed);
  ScenePen pen;
  const std::vector<Triple> panel = shape(random, 0, 4);
  pen.two_sided(true).polygon({{-9, -9, -3}, {13, -9, -3}, {13, 13, -3}, {-9, 13, -3}});
  const std::int64_t count = random.between(1, 4);
  for (std::int64_t i = 0; i < count; ++i) {
    choose_flags(pen, random);
    const std::size_t k = random.below(panel.size());
    const Triple a = panel[k], b = panel[(k + 1) % panel.size()], c = panel[(k + 2) % panel.size()];
    const Triple p = point_in(random, -2, 6), q = point_in(random, -2, 6);
    std::vector<Triple> loop;
    switch (random.below(6)) {
      case 0:
        loop = {a, p, q};
        break;
      case 1:
        loop = {a, b, p};
        break;
      case 2:  // in the light's plane
        loop = {a, b + (b - a), c + (c - b)};
        break;
      case 3:  // an edge along the light's, longer
        loop = {a - (b - a), b + (b - a), p};
        break;
      case 4:  // the light itself
        loop = panel;
        break;
      default:  // a vertex inside of an edge of the light, or of the light
        loop = {a + b, 2 * p, 2 * q};
        for (Triple& v : loop) {
          if (v[0] % 2 == 0 && v[1] % 2 == 0 && v[2] % 2 == 0) {
            v = {v[0] / 2, v[1] / 2, v[2] / 2};
          }
        }
    }
    if (is_zero(cross(loop[1] - loop[0], loop[2] - loop[0]))) continue;
    if (random.chance(1, 2)) std::reverse(loop.begin(), loop.end());
    pen.polygon(loop);
  }
  pen.panel(panel);
  return pen.take();
}

/// Boxes that stand on a floor and on each other, under a ceiling panel, in a room or not.
Scene boxes(std::uint64_t seed) {
  Random random(seed);
  ScenePen pen;
  if (random.chance(1, 2)) {
    pen.box({-6, -6, 0}, {10, 10, 8}, true);
  } else {
    pen.polygon({{-6, -6, 0}, {10, -6, 0}, {10, 10, 0}, {-6, 10, 0}});
  }
  const Triple low = {random.between(0, 2), random.between(0, 2), 0};
  const Triple high =
      low + Triple{random.between(1, 2), random.between(1, 2), random.between(1, 3)};
  pen.box(low, high);
  if (random.chance(1, 2)) {
    pen.box({low[0], low[1], high[2]},
            {low[0] + random.between(1, 3), low[1] + random.between(1, 2), high[2] + 1});
  } else {
    pen.box({high[0], high[1], 0}, {high[0] + 1, high[1] + 2, random.between(1, 3)});
  }
  const std::int64_t x = random.between(-4, 4), y = random.between(-4, 4),
                     z = random.chance(1, 2) ? 8 : random.between(1, 7);
  pen.panel({{x, y, z}, {x, y + 2, z}, {x + random.between(1, 3), y + 2, z}, {x + 1, y, z}});
  return pen.take();
}

}  // namespace

const std::vector<Family>& area_families() {
  static const std::vector<Family> all = {
      {"Generic", generic, 2, 25},
      {"AlmostPlanar", almost_planar, 1, 25},
      {"Lattice", lattice, 4, 60},
      {"Overhead", overhead, 3, 60},
      {"SharedFeatures", shared_features, 4, 60},
      {"Boxes", boxes, 2, 30},
      {"Crossing", crossing, 2, 20},
      {"CoplanarTiles", tiles, 2, 50},
      {"Grazing", grazing, 2, 50},
      {"Needles", needles, 2, 30},
      {"PowersOfTwo", powers_of_two, 2, 30},
      {"MixedMagnitudes", mixed_magnitudes, 2, 25},
      {"Decimals", decimals, 2, 50},
      {"Repaired", repaired, 2, 40},
  };
  return all;
}

}  // namespace gnomon::fuzz
