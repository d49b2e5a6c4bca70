// SPDX-License-Identifier: GPL-3.0-or-later
// Convex shells that cast their penumbras under area lights as wholes: the same classes and shares
// as face by face, where solids touch, go through each other, lack faces, and where lights lie in
// their planes, touch them, reach into them and are cut by them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "area_check.h"
#include "exact_check.h"
#include "fuzz/generate/scene_pen.h"
#include "gnomon/algorithms/components.h"
#include "scene/base/random.h"

namespace gnomon::test {
namespace {

using fuzz::ScenePen;
using fuzz::Triple;
using Solid = std::vector<std::vector<Triple>>;

/// Faces of convex solids of the unit cube, times two, that look outwards.
const std::vector<Solid>& shapes() {
  static const std::vector<Solid> kShapes = {
      // A box, a tetrahedron, a pyramid, a wedge, an octahedron, a house.
      {{{0, 0, 0}, {0, 2, 0}, {2, 2, 0}, {2, 0, 0}},
       {{0, 0, 2}, {2, 0, 2}, {2, 2, 2}, {0, 2, 2}},
       {{0, 0, 0}, {2, 0, 0}, {2, 0, 2}, {0, 0, 2}},
       {{2, 0, 0}, {2, 2, 0}, {2, 2, 2}, {2, 0, 2}},
       {{2, 2, 0}, {0, 2, 0}, {0, 2, 2}, {2, 2, 2}},
       {{0, 2, 0}, {0, 0, 0}, {0, 0, 2}, {0, 2, 2}}},
      {{{0, 0, 0}, {0, 2, 0}, {2, 0, 0}},
       {{0, 0, 0}, {2, 0, 0}, {0, 0, 2}},
       {{2, 0, 0}, {0, 2, 0}, {0, 0, 2}},
       {{0, 2, 0}, {0, 0, 0}, {0, 0, 2}}},
      {{{0, 0, 0}, {0, 2, 0}, {2, 2, 0}, {2, 0, 0}},
       {{0, 0, 0}, {2, 0, 0}, {1, 1, 2}},
       {{2, 0, 0}, {2, 2, 0}, {1, 1, 2}},
       {{2, 2, 0}, {0, 2, 0}, {1, 1, 2}},
       {{0, 2, 0}, {0, 0, 0}, {1, 1, 2}}},
      {{{0, 0, 0}, {0, 2, 0}, {2, 2, 0}, {2, 0, 0}},
       {{0, 0, 0}, {2, 0, 0}, {2, 0, 2}},
       {{2, 2, 0}, {0, 2, 0}, {2, 2, 2}},
       {{2, 0, 0}, {2, 2, 0}, {2, 2, 2}, {2, 0, 2}},
       {{0, 2, 0}, {0, 0, 0}, {2, 0, 2}, {2, 2, 2}}},
      {{{2, 1, 1}, {1, 2, 1}, {1, 1, 2}},
       {{1, 2, 1}, {0, 1, 1}, {1, 1, 2}},
       {{0, 1, 1}, {1, 0, 1}, {1, 1, 2}},
       {{1, 0, 1}, {2, 1, 1}, {1, 1, 2}},
       {{1, 2, 1}, {2, 1, 1}, {1, 1, 0}},
       {{0, 1, 1}, {1, 2, 1}, {1, 1, 0}},
       {{1, 0, 1}, {0, 1, 1}, {1, 1, 0}},
       {{2, 1, 1}, {1, 0, 1}, {1, 1, 0}}},
      {{{0, 0, 0}, {0, 2, 0}, {2, 2, 0}, {2, 0, 0}},
       {{0, 0, 0}, {2, 0, 0}, {2, 0, 1}, {1, 0, 2}, {0, 0, 1}},
       {{2, 2, 0}, {0, 2, 0}, {0, 2, 1}, {1, 2, 2}, {2, 2, 1}},
       {{2, 0, 0}, {2, 2, 0}, {2, 2, 1}, {2, 0, 1}},
       {{0, 2, 0}, {0, 0, 0}, {0, 0, 1}, {0, 2, 1}},
       {{2, 0, 1}, {2, 2, 1}, {1, 2, 2}, {1, 0, 2}},
       {{0, 2, 1}, {0, 0, 1}, {1, 0, 2}, {1, 2, 2}}}};
  return kShapes;
}

Triple sum(const Triple& a, const Triple& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

/// Adds a solid that an integer matrix has moved, sheared and turned, without some of its faces.
void add_solid(ScenePen& pen, Random& random) {
  const Solid& solid = shapes()[random.between(0, std::ssize(shapes()) - 1)];
  std::array<Triple, 3> axes{};
  std::int64_t determinant = 0;
  while (determinant <= 0) {
    const bool plain = random.between(0, 1) == 0;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        axes[i][k] = plain ? (i == k ? random.between(1, 2) : 0) : random.between(-1, 2);
      }
    }
    const auto [a, b, c] = axes;
    determinant = a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
                  a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  const Triple at = {random.between(0, 6), random.between(0, 6), random.between(0, 5)};
  const auto moved = [&](const Triple& p) {
    Triple result = at;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) result[k] += p[i] * axes[i][k];
    }
    return result;
  };
  const std::int64_t missing = random.between(0, 3) == 0 ? 2 : random.between(0, 1);
  std::vector<std::size_t> left_out;
  for (std::int64_t i = 0; i < missing; ++i) {
    left_out.push_back(static_cast<std::size_t>(random.between(0, std::ssize(solid) - 1)));
  }
  for (std::size_t face = 0; face < solid.size(); ++face) {
    if (std::ranges::find(left_out, face) != left_out.end()) continue;
    std::vector<Triple> loop;
    for (const Triple& corner : solid[face]) loop.push_back(moved(corner));
    pen.polygon(loop);
  }
}

/// Lights on the lattice of the solids: above and beside them, between them, touching them.
void add_panel(ScenePen& pen, Random& random) {
  const bool above = random.between(0, 2) != 0;
  Triple along{}, across{};
  bool is_line = true;
  while (is_line) {
    for (std::size_t k = 0; k < 3; ++k) {
      along[k] = random.between(-4, 4);
      across[k] = random.between(-4, 4);
    }
    if (random.between(0, 1) == 0) along[2] = across[2] = 0;
    is_line = along[0] * across[1] == along[1] * across[0] &&
              along[1] * across[2] == along[2] * across[1] &&
              along[0] * across[2] == along[2] * across[0];
  }
  const Triple at = {random.between(-2, 8), random.between(-2, 8),
                     above ? random.between(6, 12) : random.between(-1, 6)};
  std::vector<Triple> loop = {at, sum(at, along), sum(sum(at, along), across)};
  if (random.between(0, 1) == 0) loop.push_back(sum(at, across));
  // Most lights above look down.
  const std::int64_t up = along[0] * across[1] - along[1] * across[0];
  if (above && up > 0) std::ranges::reverse(loop);
  pen.panel(loop);
}

Scene solids(std::uint64_t seed, int count) {
  Random random(seed);
  ScenePen pen;
  pen.two_sided(seed % 5 == 0);
  for (int i = 0; i < count; ++i) {
    pen.casts(random.between(0, 9) != 0);
    add_solid(pen, random);
  }
  pen.casts(true);
  pen.polygon({{-6, -6, 0}, {14, -6, 0}, {14, 14, 0}, {-6, 14, 0}});
  pen.two_sided(true);
  pen.polygon({{random.between(0, 6), -6, 0},
               {random.between(0, 6), 14, 0},
               {random.between(0, 6), 14, 9}});
  add_panel(pen, random);
  return pen.take();
}

ShadowOptions by_contour() {
  ShadowOptions options = options_for(KernelId::kPlane);
  options.method.area = MethodId::kContour;
  options.output.exact_fractions = options.output.exact_points = options.output.points = false;
  return options;
}

TEST(ShellCasters, SameSharesAsFaceByFace) {
  std::uint64_t shells = 0, missing = 0, open = 0, sides = 0;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    const auto own = Case::make(solids(seed, 5));
    ASSERT_TRUE(own);
    ASSERT_EQ(check_area_contour(*own), "") << "seed " << seed << '\n' << text_of(own->scene());
    const auto result = compute_shadows(own->prepared(), by_contour());
    ASSERT_TRUE(result);
    shells += result->lights[0].work[Counter::kSolids];
    open += result->lights[0].work[Counter::kOpenPolygons];
    sides += result->lights[0].facing_parts;
    for (const ConvexShell& shell : find_convex_shells(own->prepared(), 100)) {
      missing += shell.missing.size();
    }
  }
  // What is tested is there, and few sides are left to be cut.
  EXPECT_GT(shells, 600u);
  EXPECT_GT(missing, 300u);
  EXPECT_LT(open * 5, sides);
}

TEST(ShellCasters, ExactKernelsAndTheOracleAgree) {
  for (std::uint64_t seed = 1000; seed < 1024; ++seed) {
    const auto own = Case::make(solids(seed, 3));
    ASSERT_TRUE(own);
    ASSERT_EQ(check_area_exact(*own), "") << "seed " << seed << '\n' << text_of(own->scene());
  }
}

TEST(ShellCasters, PenumbraOfABoxUnderASmallLight) {
  ScenePen pen;
  pen.box({0, 0, 0}, {2, 2, 2}).polygon({{-20, -20, 0}, {20, -20, 0}, {20, 20, 0}, {-20, 20, 0}});
  pen.panel({{5, 6, 9}, {5, 7, 9}, {6, 7, 9}, {6, 6, 9}});
  const auto own = Case::make(pen.take());
  const auto result = compute_shadows(own->prepared(), by_contour());
  ASSERT_TRUE(result);
  const WorkCounts& counts = result->lights[0].work;
  EXPECT_EQ(counts[Counter::kSolids], 1u);
  // The box; umbras of three faces; the floor, which has no umbra behind it but one of its own.
  EXPECT_EQ(counts[Counter::kVolumes], 1u + 3u + 1u);
  // Three faces and six contour edges, since the light's edges have the directions of the box's;
  // the umbras; the floor itself, its four edges, and its umbra.
  EXPECT_EQ(counts[Counter::kVolumePlanes], (3u + 6u) + 3u * 5u + (1u + 4u + 5u));
  EXPECT_EQ(counts[Counter::kOpenPolygons], 0u);
  ASSERT_EQ(check_area_exact(*own), "");
}

TEST(ShellCasters, ALightInsideSeesTheFacesFromBehind) {
  ScenePen pen;
  pen.two_sided(true).box({0, 0, 0}, {8, 8, 8});
  pen.two_sided(false).box({3, 3, 1}, {5, 5, 2});
  pen.panel({{3, 3, 6}, {3, 5, 6}, {5, 5, 6}, {5, 3, 6}});
  const auto own = Case::make(pen.take());
  ASSERT_EQ(check_area_exact(*own), "");
  const auto result = compute_shadows(own->prepared(), by_contour());
  ASSERT_TRUE(result);
  EXPECT_EQ(result->lights[0].work[Counter::kSolids], 1u);
}

}  // namespace
}  // namespace gnomon::test
