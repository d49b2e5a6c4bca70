// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/generate/families.h"

#include <algorithm>
#include <stdexcept>

#include "fuzz/generate/object_scenes.h"
#include "fuzz/generate/random_shapes.h"
#include "fuzz/generate/scene_pen.h"
#include "fuzz/generate/small_lattice.h"
#include "scene/base/random.h"

namespace gnomon::fuzz {
namespace {

void lattice_lights(ScenePen& pen, Random& random, std::int64_t size) {
  if (random.chance(2, 3)) {
    pen.lamp(random.chance(1, 2) ? point_in(random, 0, size) : point_in(random, -size, 2 * size));
  }
  if (pen.scene().lights.empty() || random.chance(1, 3)) pen.sun(direction(random, 2));
}

Scene generic(std::uint64_t seed) {
  Random random(seed);
  ScenePen pen(-53);
  const std::int64_t one = std::int64_t{1} << 53;
  const std::int64_t count = random.between(2, 6);
  for (std::int64_t i = 0; i < count; ++i) {
    choose_flags(pen, random);
    pen.polygon({point_in(random, 0, one), point_in(random, 0, one), point_in(random, 0, one)});
  }
  pen.lamp(random.chance(1, 2) ? point_in(random, 0, one) : point_in(random, -2 * one, 2 * one));
  pen.sun(point_in(random, -one, one));
  return pen.take();
}

/// Quads of doubles, planar only by intention: each becomes two triangles that are almost coplanar.
Scene almost_planar(std::uint64_t seed) {
  Random random(seed);
  ScenePen pen(-40);
  const std::int64_t one = std::int64_t{1} << 40;
  const std::int64_t count = random.between(1, 3);
  for (std::int64_t i = 0; i < count; ++i) {
    choose_flags(pen, random);
    const Triple p = point_in(random, 0, one), q = point_in(random, 0, one),
                 r = point_in(random, 0, one);
    pen.polygon({p, q, q + r - p + point_in(random, -1, 1), r});
  }
  pen.lamp(point_in(random, -one, 2 * one));
  pen.sun(direction(random, 3));
  return pen.take();
}

Scene lattice(std::uint64_t seed) {
  Random random(seed);
  ScenePen pen;
  const std::int64_t size = random.between(2, 5);
  add_lattice(pen, random, random.between(2, 7), size);
  lattice_lights(pen, random, size);
  return pen.take();
}

/// Everything crosses everything: fragments with two and three edges made by the scene BSP.
Scene crossing(std::uint64_t seed) {
  Random random(seed);
  ScenePen pen;
  const std::int64_t count = random.between(4, 7);
  pen.two_sided(true);
  for (std::int64_t i = 0; i < count; ++i) {
    const Triple u = direction(random, 4), v = direction(random, 4);
    if (is_zero(cross(u, v))) continue;
    const Triple m = point_in(random, -2, 2);
    pen.casts(!random.chance(1, 8));
    pen.polygon({m + u + v, m - u + v, m - u - v, m + u - v});
  }
  if (pen.scene().polygons.empty()) pen.polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  pen.lamp(point_in(random, -6, 6));
  pen.sun(direction(random, 3));
  return pen.take();
}

Scene crossing_sticks(std::uint64_t seed) {
  Random random(seed);
  ScenePen pen;
  pen.two_sided(true).polygon({{-20, -20, -8}, {20, -20, -8}, {20, 20, -8}, {-20, 20, -8}});
  const std::int64_t count = random.between(2, 5);
  for (std::int64_t i = 0; i < count; ++i) {
    const Triple along = direction(random, 9), across = direction(random, 1);
    if (is_zero(cross(along, across))) continue;
    const Triple m = point_in(random, -2, 2);
    pen.polygon({m - along, m + along, m + along + across, m - along + across});
  }
  pen.lamp({random.between(-3, 3), random.between(-3, 3), 20});
  pen.sun({random.between(-2, 2), random.between(-2, 2), random.between(1, 3)});
  return pen.take();
}

/// Overlapping, touching and T-joined rectangles in two or three parallel planes.
Scene coplanar_tiles(std::uint64_t seed) {
  Random random(seed);
  ScenePen pen;
  const std::int64_t count = random.between(3, 8);
  const bool slanted = random.chance(1, 2);
  for (std::int64_t i = 0; i < count; ++i) {
    choose_flags(pen, random);
    const std::int64_t x = random.between(0, 4), y = random.between(0, 4), z = random.between(0, 2),
                       w = random.between(1, 3), h = random.between(1, 3);
    std::vector<Triple> loop = {
        {x, y, 2 * z}, {x + w, y, 2 * z}, {x + w, y + h, 2 * z}, {x, y + h, 2 * z}};
    if (random.chance(1, 3)) loop.pop_back();
    if (slanted) {
      for (Triple& p : loop) p[2] += p[0] - 2 * p[1];
    }
    pen.polygon(loop);
  }
  pen.lamp({random.between(-2, 8), random.between(-2, 8), random.between(3, 9)});
  if (random.chance(1, 2)) pen.sun({random.between(-2, 2), random.between(-2, 2), 1});
  return pen.take();
}

Scene touching_boxes(std::uint64_t seed) {
  Random random(seed);
  ScenePen pen;
  pen.polygon({{-6, -6, 0}, {10, -6, 0}, {10, 10, 0}, {-6, 10, 0}});
  const Triple low = {random.between(0, 2), random.between(0, 2), 0};
  const Triple high =
      low + Triple{random.between(1, 2), random.between(1, 2), random.between(1, 3)};
  pen.box(low, high);
  switch (random.below(3)) {
    case 0:  // on top
      pen.box({low[0], low[1], high[2]},
              {low[0] + random.between(1, 3), low[1] + random.between(1, 2), high[2] + 1});
      break;
    case 1:  // beside, on the floor
      pen.box({high[0], low[1] + random.between(-1, 1), 0},
              {high[0] + 1, high[1] + random.between(2, 3), random.between(1, 3)});
      break;
    default:  // at an edge only
      pen.box({high[0], high[1], 0}, {high[0] + 1, high[1] + 2, random.between(1, 3)});
  }
  if (random.chance(3, 4)) {
    pen.lamp({random.between(-5, 8), random.between(-5, 8), random.between(1, 6)});
  } else {
    pen.sun({random.between(-2, 2), random.between(-2, 2), random.between(1, 2)});
  }
  return pen.take();
}

/// A room, a box in it, a lamp between, in the inner one, or outside of everything.
Scene nested_boxes(std::uint64_t seed) {
  Random random(seed);
  ScenePen pen;
  pen.two_sided(random.chance(1, 3));
  pen.box({0, 0, 0}, {8, 8, 8}, random.chance(2, 3));
  pen.two_sided(random.chance(1, 3));
  const Triple low = point_in(random, 0, 4);
  const Triple high = low + point_in(random, 1, 4);
  pen.box(low, high, random.chance(1, 3));
  pen.lamp(random.chance(3, 4) ? point_in(random, 0, 8) : point_in(random, -4, 12));
  return pen.take();
}

/// The lamp stands in a special place with respect to the polygons.
Scene grazing(std::uint64_t seed) {
  Random random(seed);
  const int shift = 40;
  ScenePen pen(-shift);
  const std::int64_t one = std::int64_t{1} << shift;
  const auto big = [&](const Triple& t) { return one * t; };
  std::vector<std::vector<Triple>> loops;
  const std::int64_t count = random.between(2, 6);
  for (std::int64_t i = 0; i < count; ++i) {
    choose_flags(pen, random);
    loops.push_back(shape(random, 0, 4));
    std::vector<Triple> wide;
    for (const Triple& p : loops.back()) wide.push_back(big(p));
    pen.polygon(wide);
  }
  const std::vector<Triple>& first = loops[0];
  const Triple u = first[1] - first[0], v = first[2] - first[0], n = cross(u, v);
  switch (random.below(10)) {
    case 0:
      pen.lamp(big(first[0] + random.between(-2, 3) * u + random.between(-2, 3) * v));
      break;
    case 1:
      pen.lamp(big(first[random.below(first.size())]));
      break;
    case 2:
      pen.lamp(big(first[0] + random.between(-2, 3) * u));
      break;
    case 3:  // within a hair of a vertex, before or behind the plane
      pen.lamp(big(first[0]) + (random.chance(1, 2) ? 1 : -1) * n);
      break;
    case 4:  // a hair off an edge's line, in the plane
      pen.lamp(big(first[0] + 2 * u) + v);
      break;
    case 5:  // far away
      pen.lamp_at({Number(1e12 * static_cast<double>(random.between(-2, 2))),
                   Number(1e12 * static_cast<double>(random.between(-2, 2))), Number(1e12)});
      break;
    case 6:
      pen.sun({0, 0, random.chance(1, 2) ? 1 : -1});
      break;
    case 7:
      pen.sun(u);
      break;  // along an edge
    case 8:
      pen.sun(big(n) + Triple{1, 0, 0});
      break;  // a hair off the normal
    default: {
      Triple d = direction(random, 3);
      d[random.below(3)] = 0;
      pen.sun(is_zero(d) ? Triple{1, 0, 0} : d);
    }
  }
  if (random.chance(1, 4)) {  // a closed box around the lamp
    pen.two_sided(false).casts(true);
    pen.box(big({-20, -20, -20}), big({30, 30, 30}), random.chance(1, 2));
  }
  return pen.take();
}

Scene needles(std::uint64_t seed) {
  Random random(seed);
  ScenePen pen(-30);
  const std::int64_t one = std::int64_t{1} << 30;
  pen.two_sided(true).polygon({{-8 * one, -8 * one, 0},
                               {8 * one, -8 * one, 0},
                               {8 * one, 8 * one, 0},
                               {-8 * one, 8 * one, 0}});
  const std::int64_t count = random.between(2, 5);
  Triple tip = one * point_in(random, -2, 2), foot = one * point_in(random, -2, 2);
  for (std::int64_t i = 0; i < count; ++i) {
    if (random.chance(1, 2)) tip = one * point_in(random, -2, 2);
    if (random.chance(2, 3)) foot = one * point_in(random, -2, 2);
    const Triple hair = direction(random, 3);
    if (is_zero(cross(foot - tip, hair))) continue;
    if (random.chance(1, 2)) {
      pen.polygon({tip, foot, foot + hair});
    } else {
      pen.polygon({tip, foot, foot + hair, tip + hair});
    }
  }
  pen.lamp(one * point_in(random, -3, 3) + direction(random, 1));
  pen.sun(one * direction(random, 2) + direction(random, 1));
  return pen.take();
}

/// A degenerate or generic scene at one of many scales, up to the ends of the doubles.
Scene powers_of_two(std::uint64_t seed) {
  Random random(seed);
  static constexpr int kExponents[] = {-900, -500, -100, 100, 500, 900};
  const int exponent = kExponents[seed % 6];
  switch (random.below(4)) {
    case 0:
      return scaled(lattice(random.next()), exponent);
    case 1:
      return scaled(crossing(random.next()), exponent);
    case 2:
      return scaled(grazing(random.next()), exponent);
    default:
      return scaled(generic(random.next()), exponent);
  }
}

/// Coordinates from 1e-300 to 1e300 and 0 in one scene.
Scene mixed_magnitudes(std::uint64_t seed) {
  Random random(seed);
  ScenePen pen;
  const int reach = std::array{40, 300, 990}[random.below(3)];
  const auto number = [&]() -> Number {
    if (random.chance(1, 4)) return Number(0.0);
    const auto exponent = static_cast<std::int32_t>(random.between(-reach, reach));
    const std::int64_t mantissa =
        random.chance(1, 2) ? random.between(-8, 8) : random.between(-(1 << 20), 1 << 20);
    return Number::from_dyadic(mpz_class(static_cast<long>(mantissa)), exponent);
  };
  std::vector<Position> pool;
  for (int i = 0; i < 6; ++i) pool.push_back({number(), number(), number()});
  const std::int64_t count = random.between(2, 4);
  for (std::int64_t i = 0; i < count; ++i) {
    choose_flags(pen, random);
    std::vector<Position> loop;
    for (int k = 0; k < 3; ++k) {
      loop.push_back(random.chance(1, 2) ? pool[random.below(pool.size())]
                                         : Position{number(), number(), number()});
    }
    pen.polygon_at(loop);
  }
  if (random.chance(1, 4)) {  // an axis-parallel quad, exactly planar at any magnitude
    const Number a = number(), b = number(), z = number();
    pen.polygon_at(
        {{Number(0.0), Number(0.0), z}, {a, Number(0.0), z}, {a, b, z}, {Number(0.0), b, z}});
  }
  pen.lamp_at({number(), number(), number()});
  pen.sun_at({number(), number(), Number(1.0)});
  return pen.take();
}

/// Planar as decimals, hardly ever as doubles: lattice shapes turned by a 3-4-5 angle, in
/// millimetres.
Scene decimals(std::uint64_t seed) {
  Random random(seed);
  ScenePen pen = ScenePen::decimal(-3);
  const auto turned = [](const Triple& p) {
    return Triple{600 * p[0] - 800 * p[1], 800 * p[0] + 600 * p[1], 1100 * p[2]};
  };
  const std::int64_t count = random.between(2, 6);
  for (std::int64_t i = 0; i < count; ++i) {
    choose_flags(pen, random);
    std::vector<Triple> loop = shape(random, 0, 4);
    for (Triple& p : loop) p = turned(p);
    pen.polygon(loop);
  }
  if (random.chance(1, 2)) pen.lamp(turned(point_in(random, -2, 6)));
  pen.sun(random.chance(1, 2) ? point_in(random, 1, 999) : turned(direction(random, 2)));
  return pen.take();
}

/// Parts of non-convex polygons and polygons with holes, over and under triangles.
Scene repaired(std::uint64_t seed) {
  Random random(seed);
  ScenePen pen;
  choose_flags(pen, random);
  // An L, or a star-shaped pentagon with a notch.
  const std::int64_t z = random.between(0, 3);
  if (random.chance(1, 2)) {
    pen.polygon({{0, 0, z}, {6, 0, z}, {6, 2, z}, {2, 2, z}, {2, 6, z}, {0, 6, z}});
  } else {
    pen.polygon({{0, 0, 0}, {6, 0, 6}, {3, 2, 3}, {6, 6, 6}, {0, 6, 0}});
  }
  add_lattice(pen, random, random.between(1, 4), 6);
  lattice_lights(pen, random, 6);
  return pen.take();
}

}  // namespace

const std::vector<Family>& families() {
  static const std::vector<Family> all = {
      {"Generic", generic, 2, 50},
      {"AlmostPlanar", almost_planar, 2, 80},
      {"Lattice", lattice, 4, 300},
      {"Crossing", crossing, 4, 50},
      {"CrossingSticks", crossing_sticks, 2, 80},
      {"CoplanarTiles", coplanar_tiles, 2, 300},
      {"TouchingBoxes", touching_boxes, 2, 200},
      {"NestedBoxes", nested_boxes, 2, 200},
      {"Grazing", grazing, 4, 200},
      {"Needles", needles, 2, 100},
      {"PowersOfTwo", powers_of_two, 3, 60},
      {"MixedMagnitudes", mixed_magnitudes, 3, 50},
      {"Decimals", decimals, 2, 200},
      {"Repaired", repaired, 2, 200},
      {"SmallLattice", small_lattice, 2, 200, false},
      {"ClosedBoxes", closed_boxes, 1, 100, false},
      {"Frames", frames, 1, 100, false},
  };
  return all;
}

const Family& family_by_name(const std::string& name) {
  for (const Family& family : families()) {
    if (family.name == name) return family;
  }
  throw std::runtime_error("no family " + name);
}

Scene scaled(const Scene& scene, int exponent) {
  Scene result = scene;
  const auto scale = [&](Position& position) {
    for (Number& number : position) {
      if (number.is_zero()) continue;
      number = Number::from_dyadic(number.mantissa(), number.exponent() + exponent);
    }
  };
  for (Position& vertex : result.vertices) scale(vertex);
  for (Light& light : result.lights) {
    scale(light.position);
    for (Position& corner : light.loop) scale(corner);
  }
  return result;
}

}  // namespace gnomon::fuzz
