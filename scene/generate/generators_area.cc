// SPDX-License-Identifier: LGPL-3.0-or-later
// Families for area lights: solids that grow in number, and polygons that touch the light, lie in
// its plane or cut it.
#include <algorithm>
#include <array>

#include "scene/generate/scene_maker.h"
#include "scene/generate/scene_shapes.h"

namespace gnomon::scene_detail {
namespace {

Int3 direction(Random& random, std::int64_t size) {
  Int3 d;
  while (is_zero(d)) {
    d = {random.between(-size, size), random.between(-size, size), random.between(-size, size)};
  }
  return d;
}

// Cubes, hexagonal prisms, octahedra and tetrahedra by turns, on a raster of 24 units.
void solids_field(SceneMaker& maker, const Values& values, Random& random) {
  constexpr std::int64_t kLot = 24;
  const std::int64_t n = at(values, "n");
  std::int64_t side = 1;
  while (side * side < n) ++side;
  const std::int64_t width = side * kLot;
  floor_at(maker, {0, 0, 0}, {width, width, 0});
  for (std::int64_t i = 0; i < n; ++i) {
    const Int3 o{(i % side) * kLot, (i / side) * kLot, 0};
    const std::string id = std::to_string(i);
    const Int3 middle =
        o + Int3{random.between(11, 13), random.between(11, 13), random.between(0, 6)};
    switch (i % 4) {
      case 0:
        maker.box("cube" + id, o + Int3{random.between(2, 8), random.between(2, 8), 0},
                  o + Int3{random.between(14, 22), random.between(14, 22), random.between(6, 18)});
        break;
      case 1:
        hexagonal_prism(maker, "prism" + id, middle, 8, random.between(6, 18));
        break;
      case 2:
        octahedron(maker, "octahedron" + id, middle + Int3{0, 0, 10}, 8);
        break;
      default:
        tetrahedron(maker, "tetrahedron" + id,
                    {{o + Int3{2, random.between(2, 8), 0}, o + Int3{22, random.between(4, 12), 0},
                      o + Int3{random.between(4, 20), 22, 0}, middle + Int3{0, 0, 12}}});
        break;
    }
  }
  maker.lights(values, {width / 2, width / 2, 64 + width / 4}, {-3, -5, 7}, width);
}

// The light is a parallelogram or a triangle, and every polygon has something to do with it.
void panel_contacts(SceneMaker& maker, const Values& values, Random& random) {
  const std::int64_t n = at(values, "n"), size = at(values, "size");
  maker.set_two_sided(at(values, "two_sided") != 0);
  const std::int64_t reach = 8 * size;
  maker.face("floor", {{-reach, -reach, -4 * size},
                       {reach, -reach, -4 * size},
                       {reach, reach, -4 * size},
                       {-reach, reach, -4 * size}});
  // Edges of even length: the middle of the light is on the lattice.
  const Int3 a{0, 0, 0};
  Int3 u, v;
  do {
    u = 2 * direction(random, size);
    v = 2 * direction(random, size);
  } while (is_zero(cross(u, v)));
  if (cross(u, v).z > 0) std::swap(u, v);  // most lights look down
  const Int3 normal = cross(u, v);
  const bool triangle = random.chance(1, 3);
  std::vector<Int3> light{a, a + u, a + u + v, a + v};
  if (triangle) light.erase(light.begin() + 2);
  const Int3 twice_middle = u + v;
  for (std::int64_t i = 0; i < n;) {
    const std::size_t k = random.below(light.size());
    const Int3 p = light[k], q = light[(k + 1) % light.size()];
    const Int3 s = direction(random, size), t = direction(random, size);
    std::vector<Int3> loop;
    switch (random.below(9)) {
      case 0:  // at a vertex of the light
        loop = {p, p + s, p + t};
        break;
      case 1:  // at an edge
        loop = {p, q, q + s, p + s};
        break;
      case 2:  // its plane holds an edge's line, beyond the edge
        loop = {q + (q - p), q + 2 * (q - p), q + 2 * (q - p) + s, q + (q - p) + s};
        break;
      case 3:  // in the light's plane
        loop = {a + 2 * u, a + 3 * u, a + 3 * u + v, a + 2 * u + v};
        if (random.chance(1, 2)) loop = {a, a + u, a + u + v};
        break;
      case 4: {  // through the middle of the light
        const Int3 middle{twice_middle.x / 2, twice_middle.y / 2, twice_middle.z / 2};
        loop = {middle - s - t, middle + s - t, middle + s + t, middle - s + t};
        break;
      }
      case 5: {  // its plane cuts the light, and it lies apart
        const Int3 middle{twice_middle.x / 2, twice_middle.y / 2, twice_middle.z / 2};
        loop = {middle + 3 * s, middle + 4 * s, middle + 4 * s + t, middle + 3 * s + t};
        break;
      }
      case 6: {  // across the light's plane, beside the light
        const Int3 beside = a + 3 * u;
        loop = {beside - s, beside + s, beside + s + t, beside - s + t};
        break;
      }
      case 7:  // a translated copy of the light
        loop = light;
        for (Int3& corner : loop) corner = corner + 2 * s;
        break;
      default:  // in front of it
        loop = {p + normal, p + normal + s, p + normal + t};
        if (dot(normal, normal) > 64 * size * size) {
          loop = {p - Int3{0, 0, 2 * size}, q - Int3{0, 0, 2 * size}, q - Int3{0, 0, 2 * size} + s};
        }
        break;
    }
    if (is_zero(cross(loop[1] - loop[0], loop[2] - loop[0]))) continue;
    if (random.chance(1, 2)) std::reverse(loop.begin(), loop.end());
    maker.face("p" + std::to_string(i++), loop);
  }
  maker.panel(light);
  if (at(values, "area") == 2) maker.lamp_and_sun(at(values, "light"), a + u, direction(random, 2));
}

}  // namespace

std::vector<Generator> area_generators() {
  std::vector<Generator> result;
  result.push_back({{"solids-field",
                     "n solids by turns on a raster, and a floor: 6, 8, 8 or 4 polygons a solid, "
                     "26 for four, and 1",
                     {{"n", 16, 1, 100000, "solids"}, kLightParameter},
                     "growth on small convex bodies; area=1 for an area light"},
                    solids_field});
  result.push_back({{"panel-contacts",
                     "n polygons that touch an area light, lie in its plane, cut it or its plane, "
                     "and a floor: n + 1 polygons",
                     {{"n", 8, 1, 100000, "polygons"},
                      {"size", 2, 1, 100, "length of their sides at most"},
                      {"two_sided", 1, 0, 1, "both sides receive and cast"},
                      {"area", 1, 1, 2, "2: point lights besides the area light"},
                      kLightParameter},
                     "the area light at vertices, edges and in planes; receivers partly behind it",
                     true},
                    panel_contacts});
  return result;
}

}  // namespace gnomon::scene_detail
