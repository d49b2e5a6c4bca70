// SPDX-License-Identifier: LGPL-3.0-or-later
// Closed solids like those of Thakur, Cheng & Miura, which were never published as files, of as
// many polygons where the paper says how many: outlines that are several loops, loops that coil,
// holes. No vertex lies inside another polygon's edge. And their cubes, in one hemisphere of the
// lamp.
#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "scene/generate/closed_surface.h"
#include "scene/generate/scene_maker.h"

namespace gnomon::scene_detail {
namespace {

using Loop = ClosedSurface::Loop;

/// 16 directions around the z axis, 64 long to the nearest whole numbers.
const Loop& circle() {
  static const Loop kCircle = [] {
    Loop quarter{{64, 0, 0}, {59, 24, 0}, {45, 45, 0}, {24, 59, 0}}, loop;
    for (int turn = 0; turn < 4; ++turn) {
      for (Int3& p : quarter) {
        loop.push_back(p);
        p = {-p.y, p.x, 0};
      }
    }
    return loop;
  }();
  return kCircle;
}

/// A small block on a large one: two disjoint outlines.
ClosedSurface block_on_block() {
  const Loop large{{0, 0, 0}, {32, 0, 0}, {32, 32, 0}, {0, 32, 0}};
  const Loop small{{8, 8, 0}, {24, 8, 0}, {24, 24, 0}, {8, 24, 0}};
  const Loop foot = ring_of(large, 1, 0), edge = ring_of(large, 1, 12);
  const Loop waist = ring_of(small, 1, 12), top = ring_of(small, 1, 28);
  ClosedSurface surface;
  surface.join(foot, edge);
  surface.join(edge, waist);
  surface.join(waist, top);
  surface.add(top);
  surface.add(reversed(foot));
  surface.cut_until(26);
  return surface;
}

const Loop kOctagon{{5, 2, 0},   {2, 5, 0},   {-2, 5, 0}, {-5, 2, 0},
                    {-5, -2, 0}, {-2, -5, 0}, {2, -5, 0}, {5, -2, 0}};

/// An octagonal ring, through which light passes.
ClosedSurface holed() {
  const Loop foot = ring_of(kOctagon, 6, 0), top = ring_of(kOctagon, 6, 20);
  const Loop inner_top = ring_of(kOctagon, 3, 20), inner_foot = ring_of(kOctagon, 3, 0);
  ClosedSurface surface;
  surface.join(foot, top);
  surface.join(top, inner_top);
  surface.join(inner_top, inner_foot);
  surface.join(inner_foot, foot);
  surface.cut_until(38);
  return surface;
}

/// The same with a floor in its hole: an outline there that no light passes through.
ClosedSurface hole_like() {
  const Loop foot = ring_of(kOctagon, 6, 0), top = ring_of(kOctagon, 6, 20);
  const Loop rim = ring_of(kOctagon, 3, 20), pit = ring_of(kOctagon, 3, 4);
  ClosedSurface surface;
  surface.join(foot, top);
  surface.join(top, rim);
  surface.join(rim, pit);
  surface.add(pit);
  surface.add(reversed(foot));
  return surface;
}

/// A tube of square section that climbs around the z axis: seen along it, the outline winds as
/// often as the tube.
ClosedSurface coil(std::size_t turns) {
  constexpr std::int64_t kClimb = 6, kHeight = 40;
  struct Section {
    Int3 inner_foot, outer_foot, outer_top, inner_top;
  };
  const auto section = [](std::size_t step) {
    const Int3 d = circle()[step % circle().size()];
    const Int3 foot{0, 0, static_cast<std::int64_t>(step) * kClimb},
        top = foot + Int3{0, 0, kHeight};
    return Section{foot + d, foot + 2 * d, top + 2 * d, top + d};
  };
  ClosedSurface surface;
  const std::size_t steps = turns * circle().size();
  for (std::size_t step = 0; step < steps; ++step) {
    const Section a = section(step), b = section(step + 1);
    surface.add({a.outer_foot, b.outer_foot, b.outer_top, a.outer_top});
    surface.add({b.inner_foot, a.inner_foot, a.inner_top, b.inner_top});
    // The others are twisted.
    surface.add({a.inner_top, a.outer_top, b.outer_top});
    surface.add({a.inner_top, b.outer_top, b.inner_top});
    surface.add({a.inner_foot, b.inner_foot, b.outer_foot});
    surface.add({a.inner_foot, b.outer_foot, a.outer_foot});
  }
  const Section first = section(0), last = section(steps);
  surface.add({first.inner_foot, first.outer_foot, first.outer_top, first.inner_top});
  surface.add({last.inner_top, last.outer_top, last.outer_foot, last.inner_foot});
  return surface;
}

ClosedSurface coil_of_three_turns() {
  ClosedSurface surface = coil(3);
  surface.cut_until(330);
  return surface;
}

/// A letter of cubes, two deep.
ClosedSurface letter() {
  constexpr std::array<std::string_view, 9> kRows = {"#######", "#######", "##.....",
                                                     "##.....", "##..###", "##..###",
                                                     "##...##", "#######", "#######"};
  std::vector<Int3> cubes;
  for (std::size_t row = 0; row < kRows.size(); ++row) {
    for (std::size_t column = 0; column < kRows[row].size(); ++column) {
      if (kRows[row][column] != '#') continue;
      const auto x = static_cast<std::int64_t>(column), z = static_cast<std::int64_t>(row);
      for (const std::int64_t y : {0, 1}) cubes.push_back({x, y, 8 - z});
    }
  }
  ClosedSurface surface = surface_of_cubes(cubes, 8);
  surface.cut_until(330);
  return surface;
}

ClosedSurface torus() {
  // Its section in multiples of the circle's radius, counter-clockwise where x points outwards.
  constexpr std::array<std::array<std::int64_t, 2>, 8> kSection{
      {{7, -1}, {7, 1}, {6, 2}, {4, 2}, {3, 1}, {3, -1}, {4, -2}, {6, -2}}};
  ClosedSurface surface;
  for (std::size_t i = 0; i < kSection.size(); ++i) {
    const auto& [from, low] = kSection[i];
    const auto& [to, high] = kSection[(i + 1) % kSection.size()];
    surface.join(ring_of(circle(), from, 64 * low), ring_of(circle(), to, 64 * high));
  }
  return surface;
}

/// n cubes, each beside one that was there before.
ClosedSurface polycube(std::int64_t n, Random& random) {
  std::vector<Int3> cubes{{0, 0, 0}};
  while (cubes.size() < static_cast<std::size_t>(n)) {
    Int3 next =
        cubes[static_cast<std::size_t>(random.below(static_cast<std::uint64_t>(cubes.size())))];
    const std::int64_t step = random.chance(1, 2) ? 1 : -1;
    switch (random.below(3)) {
      case 0:
        next.x += step;
        break;
      case 1:
        next.y += step;
        break;
      default:
        next.z += step;
    }
    if (std::ranges::find(cubes, next) == cubes.end()) cubes.push_back(next);
  }
  return surface_of_cubes(cubes, 16);
}

enum Kind : std::int64_t {
  kBlockOnBlock,
  kHoled,
  kHoleLike,
  kCoil2,
  kCoil3,
  kLetter,
  kTorus,
  kPolycube
};
const std::vector<std::string>& kind_words() {
  static const std::vector<std::string> kWords = {
      "block-on-block", "holed", "hole-like", "coil2", "coil3", "letter", "torus", "polycube"};
  return kWords;
}

struct SolidAndLamp {
  ClosedSurface surface;
  Int3 lamp;
  std::int64_t width;
};

SolidAndLamp solid_of(std::int64_t kind, const Values& values, Random& random) {
  switch (kind) {
    case kHoled:
      return {holed(), {4, -6, 130}, 60};
    case kHoleLike:
      return {hole_like(), {24, -31, 90}, 60};
    case kCoil2:
      return {coil(2), {5, -7, 1400}, 256};
    case kCoil3:
      return {coil_of_three_turns(), {5, -7, 2200}, 256};
    case kLetter:
      return {letter(), {19, -120, 143}, 56};
    case kTorus:
      return {torus(), {210, -330, 1700}, 900};
    case kPolycube:
      return {polycube(at(values, "n"), random), {37, -59, 400}, 64};
    default:
      return {block_on_block(), {13, -21, 110}, 32};
  }
}

void closed(SceneMaker& maker, const Values& values, Random& random) {
  const std::int64_t kind = at(values, "kind");
  const SolidAndLamp solid = solid_of(kind, values, random);
  solid.surface.write(maker, kind_words()[static_cast<std::size_t>(kind)]);
  maker.lights(values, solid.lamp, {1, -2, 5}, solid.width);
}

// Cubes in the cells of a lattice under a lamp, those that are farthest from it first.
void cubes(SceneMaker& maker, const Values& values, Random& random) {
  constexpr std::int64_t kCell = 32;
  const std::int64_t n = at(values, "n");
  std::int64_t side = 1;
  while (side * side * side < n) ++side;
  const std::int64_t reach = side * kCell;
  const Int3 lamp{reach / 2 + 1, reach / 2 - 3, 2 * reach + 5};
  struct Cube {
    Int3 low;
    std::int64_t size, distance;
  };
  std::vector<Cube> all;
  for (std::int64_t i = 0; i < n; ++i) {
    const std::int64_t size = random.between(6, 20);
    const Int3 cell{i % side, i / side % side, i / side / side};
    const auto place = [&] { return random.between(1, kCell - 1 - size); };
    const std::int64_t x = place(), y = place(), z = place();
    const Int3 low = kCell * cell + Int3{x, y, z};
    const Int3 way = 2 * low + Int3{size, size, size} - 2 * lamp;
    all.push_back({low, size, dot(way, way)});
  }
  const bool near_first = at(values, "near_first") != 0;
  std::ranges::stable_sort(all, [&](const Cube& a, const Cube& b) {
    return near_first ? a.distance < b.distance : b.distance < a.distance;
  });
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Int3 size{all[i].size, all[i].size, all[i].size};
    maker.box("cube" + std::to_string(i), all[i].low, all[i].low + size);
  }
  maker.lamp(lamp);
}

}  // namespace

std::vector<Generator> solid_generators() {
  const std::string source = "Thakur, Cheng & Miura, section 4";
  std::vector<Generator> result;
  result.push_back(
      {{"closed",
        "one closed solid: a block on a block (26 polygons), with a hole (38) or a pit (26), a "
        "coil "
        "of two turns (194) or three (330), a letter (330), a torus (128), or n cubes joined",
        {{"n", 12, 1, 2000, "cubes of the polycube"},
         {"kind", kBlockOnBlock, kBlockOnBlock, kPolycube, "which solid", kind_words()},
         kLightParameter},
        source},
       closed});
  result.push_back({{"cubes",
                     "cubes apart in one hemisphere of a lamp, far to near: 6 n polygons",
                     {{"n", 100, 1, 200000, "cubes"}, {"near_first", 0, 0, 1, "1: near to far"}},
                     source},
                    cubes});
  return result;
}

}  // namespace gnomon::scene_detail
