// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/generate/soups.h"

#include <algorithm>
#include <array>
#include <vector>

#include "fuzz/generate/random_shapes.h"
#include "fuzz/generate/scene_pen.h"

namespace gnomon::fuzz {
namespace {

enum class Sides : std::uint8_t { kOne, kTwo, kEither };

void choose_sides(ScenePen& pen, Sides sides, Random& random) {
  pen.two_sided(sides == Sides::kTwo || (sides == Sides::kEither && random.chance(3, 5)));
  pen.casts(!random.chance(1, 10));
}

/// A triangle or parallelogram at `at`, its edges within `size`; of positive area.
std::vector<Triple> patch(Random& random, const Triple& at, std::int64_t size, bool quads) {
  for (;;) {
    const Triple u = point_in(random, -size, size), v = point_in(random, -size, size);
    // Modulo 2^64: that a few pairs not on one line are drawn again does no harm.
    bool on_line = true;
    for (std::size_t k = 0; k < 3 && on_line; ++k) {
      const std::size_t l = (k + 1) % 3;
      on_line = static_cast<std::uint64_t>(u[k]) * static_cast<std::uint64_t>(v[l]) ==
                static_cast<std::uint64_t>(u[l]) * static_cast<std::uint64_t>(v[k]);
    }
    if (on_line) continue;
    if (quads && random.chance(1, 2)) return {at, at + u, at + u + v, at + v};
    return {at, at + u, at + v};
  }
}

void add_patches(ScenePen& pen, Soup soup, Sides sides, std::int64_t count, int bits,
                 Random& random) {
  const std::int64_t one = std::int64_t{1} << bits;
  std::array<Triple, 3> places;
  for (Triple& place : places) place = point_in(random, 0, one);
  const std::uint64_t place_count = 1 + random.below(places.size());
  const int smallest = std::min(bits - 2, 30);
  for (std::int64_t i = 0; i < count; ++i) {
    choose_sides(pen, sides, random);
    // With all 53 bits a fourth corner has no room.
    const bool quads = bits < 50;
    Triple at = point_in(random, 0, one);
    std::int64_t size = one / 2;
    if (soup == Soup::kClustered) {
      size = std::max<std::int64_t>(one >> random.between(3, 8), 2);
      at = places[random.below(place_count)] + point_in(random, -size, size);
    } else if (soup == Soup::kMixedSizes) {
      // One of the largest and one of the smallest are always there.
      size = one >> (i == 0 ? 1 : i == 1 ? smallest : random.between(1, smallest));
      if (i > 0 && random.chance(1, 2)) at = places[0] + point_in(random, -size, size);
    }
    if (!quads) {
      // Coordinates within [0, 2^53] have no sum to round.
      pen.polygon({point_in(random, 0, one), point_in(random, 0, one), point_in(random, 0, one)});
    } else {
      pen.polygon(patch(random, at, size, quads));
    }
  }
}

void add_lights(ScenePen& pen, bool area, std::int64_t one, Random& random) {
  if (area) {
    const bool outside = random.chance(1, 2);
    const std::int64_t low = outside ? -one / 2 : 0, high = outside ? one + one / 2 : one;
    pen.panel(patch(random, point_in(random, low, high), std::max<std::int64_t>(one / 3, 2), true));
    if (random.chance(1, 6)) pen.lamp(point_in(random, 0, one));
    return;
  }
  if (random.chance(2, 3)) {
    pen.lamp(random.chance(1, 2) ? point_in(random, 0, one) : point_in(random, -one, 2 * one));
  }
  if (pen.scene().lights.empty() || random.chance(1, 4)) {
    pen.sun(direction(random, random.chance(1, 2) ? 3 : one));
  }
}

}  // namespace

Scene make_soup(Soup soup, bool area, Random& random) {
  static constexpr std::int64_t kCounts[] = {2, 2, 3, 3, 4, 5};
  const std::int64_t count =
      random.chance(1, 40) ? random.between(6, 12) : kCounts[random.below(std::size(kCounts))];
  const auto sides = static_cast<Sides>(random.below(3));
  if (soup == Soup::kLattice) {
    ScenePen pen;
    const std::int64_t size = random.between(2, 5);
    add_lattice(pen, random, count, size);
    if (area) {
      pen.panel(random.chance(1, 2) ? shape(random, 0, size) : shape(random, -size, 2 * size));
    } else if (random.chance(2, 3)) {
      pen.lamp(random.chance(1, 2) ? point_in(random, 0, size) : point_in(random, -size, 2 * size));
    } else {
      pen.sun(direction(random, 2));
    }
    Scene scene = pen.take();
    if (sides != Sides::kEither) {
      for (Polygon& polygon : scene.polygons) polygon.two_sided = sides == Sides::kTwo;
    }
    return scene;
  }
  static constexpr int kBits[] = {6, 10, 20, 24, 40, 53};
  static constexpr int kBitsOfSizes[] = {24, 32, 40};
  const int bits = soup == Soup::kMixedSizes  ? kBitsOfSizes[random.below(3)]
                   : soup == Soup::kClustered ? kBits[random.below(5)]
                                              : kBits[random.below(6)];
  ScenePen pen(-bits);
  add_patches(pen, soup, sides, count, bits, random);
  // At 53 bits lights stay coarser: a corner of a panel is a sum of three.
  if (bits < 50) {
    add_lights(pen, area, std::int64_t{1} << bits, random);
    return pen.take();
  }
  ScenePen coarse(-40);
  add_lights(coarse, area, std::int64_t{1} << 40, random);
  Scene scene = pen.take();
  scene.lights = coarse.take().lights;
  return scene;
}

}  // namespace gnomon::fuzz
