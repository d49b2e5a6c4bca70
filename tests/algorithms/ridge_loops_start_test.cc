// SPDX-License-Identifier: GPL-3.0-or-later
// The mistake start-inside of Thakur, Cheng & Miura, section 2: the external loop starts at any
// visible ridge edge. It is made on purpose, hunted on random solids, and shrunk cell by cell.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <vector>

#include "solid_cells.h"

namespace gnomon {
namespace {

using test::Case;
using test::Cell;
using test::Cells;

std::vector<RidgeLoops> loops_of(const Scene& scene) {
  const auto solid = Case::make(scene);
  auto loops = ridge_loops(solid->scene(), solid->prepared(), 0);
  EXPECT_TRUE(loops);
  return loops ? *std::move(loops) : std::vector<RidgeLoops>();
}

/// What is external where the loop of the first visible ridge edge is taken for it.
void start_inside(RidgeLoops& loops) {
  const auto first = std::ranges::find(loops.edges, RidgeKind::kVisible, &RidgeEdge::kind);
  const auto edge = static_cast<std::uint32_t>(first - loops.edges.begin());
  const auto has_edge = [&](const RidgeLoop& loop) {
    return std::ranges::find(loop.steps, edge, &LoopStep::edge) != loop.steps.end();
  };
  const auto start = std::ranges::find_if(loops.loops, has_edge);
  if (start == loops.loops.end()) return;
  for (RidgeLoop& loop : loops.loops) {
    if (loop.kind == LoopKind::kExternal) loop.kind = LoopKind::kInternal;
  }
  start->kind = LoopKind::kExternal;
}

/// Twice the area of the shadow that external and hole loops bound.
mpq_class shadow_by_loops(const std::vector<RidgeLoops>& components) {
  mpq_class sum = 0;
  for (const RidgeLoops& loops : components) {
    for (const RidgeLoop& loop : loops.loops) {
      if (loop.kind != LoopKind::kInternal) sum += test::doubled_area(loops, loop);
    }
  }
  return sum;
}

/// Whether the mistake shows on a solid in one piece.
bool is_wrong(const Cells& cells, const test::Map& map, const Light& light) {
  Scene scene = cells.surface(map);
  scene.lights = {light};
  std::vector<RidgeLoops> loops = loops_of(scene);
  if (loops.size() != 1) return false;
  const mpq_class truth = test::shadow_of(scene);
  EXPECT_EQ(shadow_by_loops(loops), truth);
  start_inside(loops[0]);
  return shadow_by_loops(loops) != truth;
}

Cells shrunk(Cells cells, const test::Map& map, const Light& light) {
  for (bool smaller = true; smaller;) {
    smaller = false;
    const auto before = cells.all();
    for (const auto& [cell, present] : before) {
      Cells fewer = cells;
      fewer.remove(cell);
      if (fewer.all().empty() || !is_wrong(fewer, map, light)) continue;
      cells = fewer;
      smaller = true;
    }
  }
  return cells;
}

TEST(RidgeLoopsStart, StartInsideIsFoundByEveryHuntAndShrinks) {
  std::vector<std::size_t> tries, sizes;
  for (std::uint64_t hunt = 1; hunt <= 20; ++hunt) {
    Random random(1000 * hunt);
    std::optional<std::size_t> found;
    for (std::size_t scene = 1; scene <= 200 && !found; ++scene) {
      const Cells cells = test::random_cells(random);
      const test::Map map = test::random_map(random, random.chance(1, 2));
      const Light light = test::steep_light(random);
      if (!is_wrong(cells, map, light)) continue;
      found = scene;
      sizes.push_back(shrunk(cells, map, light).all().size());
    }
    ASSERT_TRUE(found) << "hunt " << hunt;
    tries.push_back(*found);
  }
  std::ranges::sort(tries);
  std::ranges::sort(sizes);
  std::printf("found after %zu scenes (median), %zu (most); shrunk to %zu ... %zu cells\n",
              tries[tries.size() / 2], tries.back(), sizes.front(), sizes.back());
  EXPECT_LE(sizes.front(), 4u);
}

TEST(RidgeLoopsStart, StartInsideShowsOnThreeCells) {
  // The smallest that a hunt was shrunk to: the loop of its first visible ridge edge is the shadow
  // of one cell on another.
  Cells cells;
  for (const Cell& cell : {Cell{0, -2, 0}, {0, -1, -1}, {0, -1, 0}}) cells.add(cell);
  const auto sheared = [](const test::Whole& p) {
    return test::Whole{6 * p[0] + p[1] + 2 * p[2], -p[0] + 7 * p[1] - p[2], 2 * p[1] + 9 * p[2]};
  };
  EXPECT_TRUE(is_wrong(cells, sheared, test::sun({-3, -1, 8})));
}

}  // namespace
}  // namespace gnomon
