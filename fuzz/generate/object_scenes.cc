// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/generate/object_scenes.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "fuzz/generate/random_shapes.h"
#include "fuzz/generate/scene_pen.h"
#include "scene/base/random.h"

namespace gnomon::fuzz {
namespace {

struct LatticeBox {
  Triple low, high;
};

/// Do the insides meet?
bool overlap(const LatticeBox& a, const LatticeBox& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (a.high[k] <= b.low[k] || b.high[k] <= a.low[k]) return false;
  }
  return true;
}

constexpr std::int64_t kLast = 3;  // boxes are in [0, kLast]^3, and the slab is below

LatticeBox box_in(Random& random) {
  LatticeBox box;
  for (std::size_t k = 0; k < 3; ++k) {
    // A slab holds every second box up.
    box.low[k] = k == 2 && random.chance(1, 2) ? 0 : random.between(0, kLast - 1);
    box.high[k] = random.between(box.low[k] + 1, kLast);
  }
  return box;
}

}  // namespace

Scene closed_boxes(std::uint64_t seed) {
  Random random(seed);
  std::vector<LatticeBox> boxes;
  if (random.chance(3, 4)) boxes.push_back({{-2, -2, -1}, {kLast + 2, kLast + 2, 0}});
  const std::size_t count = 2 + random.below(3);
  for (int attempt = 0; attempt < 40 && boxes.size() < count; ++attempt) {
    const LatticeBox box = box_in(random);
    if (std::ranges::none_of(boxes, [&](const auto& other) { return overlap(box, other); })) {
      boxes.push_back(box);
    }
  }
  ScenePen pen;
  pen.two_sided(false).casts(true);
  // A step of the lattice is two units, so that lamps may stand half-way.
  for (const LatticeBox& box : boxes) pen.box(2 * box.low, 2 * box.high);
  const std::uint64_t lights = random.below(3);
  if (lights != 0) {
    pen.lamp({random.between(-3, 9), random.between(-3, 9), random.between(2 * kLast + 1, 12)});
  }
  if (lights != 1) pen.sun({random.between(-2, 2), random.between(-2, 2), random.between(1, 3)});
  return pen.take();
}

namespace {

/// The corners of a square around a point, counter-clockwise from above.
constexpr std::array<Triple, 4> kCorners = {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}};

void add_frame(ScenePen& pen, Random& random, const Triple& middle) {
  const std::int64_t inner = random.between(1, 2), outer = inner + random.between(1, 2);
  const std::int64_t tilt_x = random.between(-1, 1), tilt_y = random.between(-1, 1);
  const auto corner = [&](std::size_t i, std::int64_t size) {
    const Triple flat = size * kCorners[i % 4];
    return middle + flat + Triple{0, 0, tilt_x * flat[0] + tilt_y * flat[1]};
  };
  for (std::size_t i = 0; i < 4; ++i) {
    pen.polygon({corner(i, outer), corner(i + 1, outer), corner(i + 1, inner), corner(i, inner)});
  }
}

void add_ramp(ScenePen& pen, Random& random, const Triple& middle) {
  const std::int64_t inner = 1, outer = 1 + random.between(1, 3);
  const std::size_t turns = 3 + random.below(5);  // quarters
  const auto corner = [&](std::size_t i, std::int64_t size) {
    return middle + size * kCorners[i % 4] + Triple{0, 0, static_cast<std::int64_t>(i)};
  };
  for (std::size_t i = 0; i < turns; ++i) {
    pen.polygon({corner(i, inner), corner(i, outer), corner(i + 1, outer)});
    pen.polygon({corner(i, inner), corner(i + 1, outer), corner(i + 1, inner)});
  }
}

}  // namespace

Scene frames(std::uint64_t seed) {
  Random random(seed);
  ScenePen pen;
  pen.two_sided(random.chance(1, 2)).casts(true);
  pen.polygon({{-9, -9, -4}, {9, -9, -4}, {9, 9, -4}, {-9, 9, -4}});
  const std::size_t count = 1 + random.below(2);
  for (std::size_t i = 0; i < count; ++i) {
    const Triple middle{random.between(-3, 3), random.between(-3, 3), random.between(1, 4)};
    if (random.chance(2, 3)) {
      add_frame(pen, random, middle);
    } else {
      add_ramp(pen, random, middle);
    }
  }
  const std::uint64_t lights = random.below(3);
  if (lights != 0) pen.lamp({random.between(-6, 6), random.between(-6, 6), random.between(12, 18)});
  if (lights != 1) pen.sun({random.between(-2, 2), random.between(-2, 2), random.between(2, 4)});
  return pen.take();
}

}  // namespace gnomon::fuzz
