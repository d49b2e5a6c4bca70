// SPDX-License-Identifier: LGPL-3.0-or-later
// Small families in which exact degeneracy is the rule: made for tests and campaigns of many seeds.
#include <algorithm>
#include <array>

#include "scene/generate/scene_maker.h"

namespace gnomon::scene_detail {
namespace {

Int3 lattice_point(Random& random, std::int64_t size) {
  return {random.between(0, size), random.between(0, size), random.between(0, size)};
}

Int3 direction(Random& random, std::int64_t size) {
  Int3 d;
  while (is_zero(d)) {
    d = {random.between(-size, size), random.between(-size, size), random.between(-size, size)};
  }
  return d;
}

std::vector<Int3> panel_on_lattice(Random& random, std::int64_t size) {
  for (;;) {
    const Int3 p = lattice_point(random, size), q = lattice_point(random, size),
               r = lattice_point(random, size);
    if (is_zero(cross(q - p, r - p))) continue;
    if (random.chance(1, 2)) return {p, q, q + r - p, r};
    return {p, q, r};
  }
}

void add_floor(SceneMaker& maker, std::int64_t reach, std::int64_t z) {
  maker.face("floor",
             {{-reach, -reach, z}, {reach, -reach, z}, {reach, reach, z}, {-reach, reach, z}});
}

// Triangles and parallelograms on a small lattice: planes, edges and vertices coincide all the
// time, polygons cross, the lamp lies in planes and on vertices.
void lattice(SceneMaker& maker, const Values& values, Random& random) {
  const std::int64_t n = at(values, "n"), size = at(values, "size");
  maker.set_two_sided(at(values, "two_sided") != 0);
  for (std::int64_t i = 0; i < n;) {
    const Int3 p = lattice_point(random, size), q = lattice_point(random, size),
               r = lattice_point(random, size);
    if (is_zero(cross(q - p, r - p))) continue;
    std::vector<Int3> loop{p, q, r};
    if (random.chance(1, 2)) loop = {p, q, q + r - p, r};
    maker.face("p" + std::to_string(i++), loop);
  }
  // Half of the lamps stand on the lattice, half at half-steps beyond it.
  const Int3 lamp = random.chance(1, 2)
                        ? lattice_point(random, size)
                        : Int3{random.between(-size, 2 * size), random.between(-size, 2 * size),
                               size + 1 + random.between(0, size)};
  const Int3 to_sun = direction(random, 2);
  if (at(values, "area") != 1) maker.lamp_and_sun(at(values, "light"), lamp, to_sun);
  if (at(values, "area") != 0) maker.panel(panel_on_lattice(random, size));
}

// Unit blocks of a few sizes on a lattice, which touch in faces, edges and vertices; none overlap.
void touching_boxes(SceneMaker& maker, const Values& values, Random& random) {
  const std::int64_t n = at(values, "n"), size = at(values, "size");
  const auto cells = static_cast<std::size_t>(size * size * size);
  std::vector<bool> full(cells);
  const auto cell = [&](Int3 p) {
    return static_cast<std::size_t>((p.z * size + p.y) * size + p.x);
  };
  add_floor(maker, 4 * size, 0);
  std::int64_t made = 0;
  for (std::int64_t attempt = 0; attempt < 20 * n && made < n; ++attempt) {
    const Int3 low{random.between(0, size - 1), random.between(0, size - 1),
                   random.between(0, size - 1)};
    const Int3 high = low + Int3{random.between(1, 2), random.between(1, 2), random.between(1, 2)};
    if (high.x > size || high.y > size || high.z > size) continue;
    bool free = true;
    for (int pass = 0; pass < 2 && free; ++pass) {
      for (std::int64_t x = low.x; x < high.x; ++x) {
        for (std::int64_t y = low.y; y < high.y; ++y) {
          for (std::int64_t z = low.z; z < high.z; ++z) {
            if (pass == 0)
              free = free && !full[cell({x, y, z})];
            else
              full[cell({x, y, z})] = true;
          }
        }
      }
    }
    if (free) maker.box("box" + std::to_string(made++), low, high);
  }
  const Int3 to_sun{random.between(-3, 3), random.between(-3, 3), random.between(1, 3)};
  const Int3 lamp{random.between(-size, 2 * size), random.between(-size, 2 * size),
                  size + random.between(1, size)};
  maker.lights(values, lamp, to_sun, 4 * size);
}

// Long thin parallelograms through each other: hard for any order from back to front.
void crossing_sticks(SceneMaker& maker, const Values& values, Random& random) {
  const std::int64_t n = at(values, "n"), size = at(values, "size");
  maker.set_two_sided(true);
  add_floor(maker, 3 * size, -size);
  for (std::int64_t i = 0; i < n;) {
    const Int3 middle = lattice_point(random, size);
    const Int3 along = direction(random, size), across = direction(random, 1);
    if (is_zero(cross(along, across))) continue;
    maker.face("stick" + std::to_string(i++),
               {middle - along, middle + along, middle + along + across, middle - along + across});
  }
  maker.lights(values, {size / 2, size / 2, 3 * size}, {1, -1, 4}, 4 * size);
}

// Every polygon has something to do with the lamp: it lies in the polygon's plane, in the line of
// an edge, at a vertex, inside the polygon; or two polygons have vertices on one ray.
void grazing(SceneMaker& maker, const Values& values, Random& random) {
  const std::int64_t n = at(values, "n"), size = at(values, "size");
  const Int3 lamp{0, 0, 2 * size};
  maker.set_two_sided(true);
  add_floor(maker, 4 * size, -size);
  Int3 last = direction(random, size);
  for (std::int64_t i = 0; i < n;) {
    const Int3 u = direction(random, size);
    Int3 v = direction(random, size);
    if (is_zero(cross(u, v))) continue;
    std::vector<Int3> loop;
    switch (random.below(6)) {
      case 0:
        loop = {lamp + u, lamp + 2 * u, lamp + 2 * u + v, lamp + u + v};
        break;  // line of an edge
      case 1:
        loop = {lamp + u + v, lamp + 2 * u + v, lamp + 2 * u + 2 * v};
        break;  // in the plane
      case 2:
        loop = {lamp, lamp + u, lamp + v};
        break;  // at a vertex
      case 3:
        loop = {lamp + u + v, lamp - u + v, lamp - u - v, lamp + u - v};
        break;  // inside
      case 4:
        loop = {lamp + 2 * last, lamp + 2 * last + u, lamp + 2 * last + v};
        break;  // on a ray
      default:
        loop = {lamp + u, lamp + v, lamp + u + v - 2 * (lamp - Int3{0, 0, size})};
        break;
    }
    if (is_zero(cross(loop[1] - loop[0], loop[2] - loop[0]))) continue;
    last = u;
    maker.face("p" + std::to_string(i++), loop);
  }
  maker.lights(values, lamp, last, 8 * size);
}

// Triangles a million times as long as wide, some with a common edge or tip.
void needles(SceneMaker& maker, const Values& values, Random& random) {
  const std::int64_t n = at(values, "n");
  const int shift = static_cast<int>(at(values, "thinness"));
  const std::int64_t length = std::int64_t{1} << shift;
  maker.set_fraction_bits(shift);
  maker.set_two_sided(true);
  add_floor(maker, 8 * length, 0);
  Int3 tip{0, 0, length}, foot{0, 0, 0};
  for (std::int64_t i = 0; i < n;) {
    if (random.chance(2, 3)) {
      tip = {length * random.between(-3, 3), length * random.between(-3, 3),
             length * random.between(1, 4)};
    }
    if (random.chance(2, 3)) {
      foot = {length * random.between(-3, 3), length * random.between(-3, 3),
              length * random.between(1, 4)};
    }
    const Int3 side = direction(random, 1);
    if (is_zero(cross(foot - tip, side))) continue;
    maker.face("needle" + std::to_string(i++), {tip, foot, foot + side});
  }
  maker.lights(values, {length, -length, 6 * length}, {1, 2, 5}, 8 * length);
}

// A slanted polygon reaches through the plane of another, with a third between its two pieces: an
// algorithm that inserts the whole polygon at its first piece loses the third one's shadow.
void slanted_through(SceneMaker& maker, const Values&, Random&) {
  maker.set_two_sided(true);
  maker.face("slanted", {{0, 0, 0}, {8, 0, 8}, {8, 8, 8}, {0, 8, 0}});
  maker.face("cutting", {{2, -4, 4}, {4, -4, 4}, {4, 12, 4}, {2, 12, 4}});
  maker.face("between", {{0, 2, 5}, {4, 2, 5}, {4, 6, 5}, {0, 6, 5}});
  maker.face("floor", {{-16, -16, -4}, {24, -16, -4}, {24, 24, -4}, {-16, 24, -4}});
  maker.sun({0, 0, 1});
  maker.lamp({4, 4, 64});
}

// n long quads that overlap in a ring, each above the next and below the last: no order without a
// cut.
void pinwheel(SceneMaker& maker, const Values& values, Random&) {
  const std::int64_t turns = at(values, "n");
  maker.set_two_sided(true);
  add_floor(maker, 64, -8);
  for (std::int64_t i = 0; i < turns; ++i) {
    const std::int64_t z = 12 * i;
    maker.face("a" + std::to_string(i),
               {{-12, -8, z}, {12, -8, z + 8}, {12, -4, z + 8}, {-12, -4, z}});
    maker.face("b" + std::to_string(i), {{8, -12, z}, {8, 12, z + 8}, {4, 12, z + 8}, {4, -12, z}});
    maker.face("c" + std::to_string(i), {{12, 8, z}, {-12, 8, z + 8}, {-12, 4, z + 8}, {12, 4, z}});
    maker.face("d" + std::to_string(i),
               {{-8, 12, z}, {-8, -12, z + 8}, {-4, -12, z + 8}, {-4, 12, z}});
  }
  maker.lights(values, {1, 2, 40 + 12 * turns}, {1, 2, 16}, 32);
}

// Panels that lie in a tilted wall's plane, or a hair's breadth before or behind it.
void near_coplanar(SceneMaker& maker, const Values& values, Random& random) {
  const std::int64_t n = at(values, "n");
  const int shift = static_cast<int>(at(values, "closeness"));
  const std::int64_t unit = std::int64_t{1} << shift;
  maker.set_fraction_bits(shift);
  const Int3 along{3 * unit, 4 * unit, 0}, up{-unit, unit, 5 * unit};
  const auto in_wall = [&](std::int64_t a, std::int64_t b) { return a * along + b * up; };
  maker.face("wall", {in_wall(0, 0), in_wall(16, 0), in_wall(16, 16), in_wall(0, 16)});
  for (std::int64_t i = 0; i < n; ++i) {
    const std::int64_t a = random.between(0, 14), b = random.between(0, 14);
    const Int3 hair{0, -random.between(-1, 1), 0};  // the smallest step of the grid, or none
    std::vector<Int3> loop{in_wall(a, b), in_wall(a + 2, b), in_wall(a + 2, b + 2),
                           in_wall(a, b + 2)};
    for (Int3& p : loop) p = p + hair;
    maker.face("panel" + std::to_string(i), loop);
  }
  // along x up, the front of the wall, points to -y.
  const std::int64_t side = -1;
  maker
      .face("fin", {in_wall(8, 0), in_wall(8, 16), in_wall(8, 16) + Int3{0, 8 * side * unit, 0},
                    in_wall(8, 0) + Int3{0, 8 * side * unit, 0}})
      .two_sided = true;
  maker.lights(values, in_wall(4, 20) + Int3{0, 24 * side * unit, 16 * unit}, {-2, 5 * side, 3},
               64 * unit);
}

}  // namespace

std::vector<Generator> hard_generators() {
  std::vector<Generator> result;
  const auto add = [&](std::string name, std::string summary,
                       std::vector<GeneratorParameter> parameters, std::string source,
                       void (*make)(SceneMaker&, const Values&, Random&)) {
    result.push_back(
        {{std::move(name), std::move(summary), std::move(parameters), std::move(source), true},
         make});
  };
  const auto count = [](std::int64_t value, const char* meaning) {
    return GeneratorParameter{"n", value, 1, 100000, meaning};
  };
  const auto size = [](std::int64_t value, const char* meaning) {
    return GeneratorParameter{"size", value, 1, 1000, meaning};
  };
  add("lattice",
      "n triangles and parallelograms on a small lattice, crossing and coinciding: n polygons",
      {count(8, "polygons"),
       size(3, "lattice points along an axis, less one"),
       {"two_sided", 1, 0, 1, "both sides receive and cast"},
       kLightParameter,
       kAreaParameter},
      "every kind of incidence", lattice);
  add("touching-boxes",
      "up to n boxes on a lattice that touch but never overlap, and a floor: at most 6 n + 1 "
      "polygons",
      {count(6, "boxes"), {"size", 4, 2, 200, "lattice cells along an axis"}, kLightParameter},
      "nothing leaks where polygons touch", touching_boxes);
  add("crossing-sticks",
      "n long thin parallelograms through each other, and a floor: n + 1 polygons",
      {count(8, "sticks"), size(8, "half of their length at most"), kLightParameter},
      "many splits, cyclic overlap", crossing_sticks);
  add("grazing",
      "n polygons edge-on to the lamp, touching it or aligned with it, and a floor: n + 1 polygons",
      {count(8, "polygons"), size(3, "length of their sides at most"), kLightParameter},
      "the light in planes, on edges, at vertices", grazing);
  add("needles", "n triangles as thin as the grid allows, and a floor: n + 1 polygons",
      {count(10, "triangles"),
       {"thinness", 20, 1, 40, "length over width, as a power of two"},
       kLightParameter},
      "ill-conditioned intersections", needles);
  add("slanted-through",
      "a polygon through another's plane with a third between its pieces: 4 polygons", {},
      "edges that the scene BSP makes must be shadow planes too", slanted_through);
  add("pinwheel", "n rings of 4 quads that overlap in a cycle, and a floor: 4 n + 1 polygons",
      {count(1, "rings"), kLightParameter}, "no order without a cut", pinwheel);
  add("near-coplanar", "n panels in a tilted wall or a hair off it, and a fin: n + 2 polygons",
      {count(8, "panels"), {"closeness", 30, 1, 44, "the hair is 2^-closeness"}, kLightParameter},
      "windows meant to lie in their wall", near_coplanar);
  return result;
}

}  // namespace gnomon::scene_detail
