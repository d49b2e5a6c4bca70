// SPDX-License-Identifier: GPL-3.0-or-later
// What several algorithms are built on: the hierarchy of boxes finds what a search without one
// finds, the k-d planner separates boxes at short values, and the walk down a tree of planes takes
// every point of a loop to its cell, whole where it can.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/partition/box_tree.h"
#include "algorithms/partition/kd_tree.h"
#include "algorithms/partition/plane_tree_filter.h"
#include "scene/base/random.h"

namespace gnomon {
namespace {

std::vector<Box> random_boxes(Random& random, std::size_t n, std::uint64_t positions) {
  std::vector<Box> boxes(n);
  for (Box& box : boxes) {
    for (std::size_t k = 0; k < 3; ++k) {
      box.low[k] = std::ldexp(static_cast<double>(random.below(positions)), -10);
      box.high[k] = box.low[k] + std::ldexp(static_cast<double>(random.below(50)), -11);
    }
  }
  return boxes;
}

// --- BoxTree ---

bool overlap(const Box& a, const Box& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (a.low[k] > b.high[k] || b.low[k] > a.high[k]) return false;
  }
  return true;
}

/// Halves are sorted by different threads only where there are thousands of members.
TEST(BoxTree, IsTheSameForEveryNumberOfThreads) {
  Random random(2);
  const auto whole = [](const BoxTree& tree) {
    const std::span<const std::uint32_t> members = tree.members(tree.nodes()[0]);
    return std::vector<std::uint32_t>(members.begin(), members.end());
  };
  const auto same = [](const BoxTree::Node& a, const BoxTree::Node& b) {
    return a.begin == b.begin && a.end == b.end && a.right == b.right && a.box.low == b.box.low &&
           a.box.high == b.box.high;
  };
  for (const std::uint32_t n : {2048u, 2049u, 4097u, 10007u, 20000u}) {
    // Few positions: many middles are equal.
    const std::vector<Box> boxes = random_boxes(random, n, n == 20000 ? 8 : 1000);
    std::vector<std::uint32_t> members(n);
    std::iota(members.begin(), members.end(), 0u);
    const BoxTree one(boxes, members, 1);
    for (int round = 0; round < 3; ++round) {
      const BoxTree many(boxes, members, 0);
      EXPECT_EQ(whole(one), whole(many)) << n;
      EXPECT_TRUE(std::ranges::equal(one.nodes(), many.nodes(), same)) << n;
    }
    // Each node has its place: a left child follows, and leaves hold all members once.
    std::uint32_t held = 0;
    for (std::uint32_t i = 0; i < one.nodes().size(); ++i) {
      const BoxTree::Node& node = one.nodes()[i];
      if (node.right == 0) {
        EXPECT_EQ(node.begin, held);
        held = node.end;
        continue;
      }
      EXPECT_EQ(one.nodes()[i + 1].begin, node.begin);
      EXPECT_EQ(one.nodes()[i + 1].end, one.nodes()[node.right].begin);
      EXPECT_EQ(one.nodes()[node.right].end, node.end);
    }
    EXPECT_EQ(held, n);
  }
}

TEST(BoxTree, FindsWhatASearchOfAllMembersFinds) {
  Random random(1);
  for (const std::size_t n : {0u, 1u, 4u, 5u, 9u, 300u}) {
    // Few positions: many middles are equal.
    const std::vector<Box> boxes = random_boxes(random, n, n == 300 ? 8 : 1000);
    std::vector<std::uint32_t> members;
    for (std::uint32_t i = 0; i < n; ++i) {
      if (random.below(5) != 0) members.push_back(i);
    }
    const BoxTree tree(boxes, members);
    for (const Box& asked : random_boxes(random, 50, 1000)) {
      std::vector<std::uint32_t> found, expected;
      tree.find([&](const BoxTree::Node& node, std::uint32_t) { return overlap(node.box, asked); },
                [&](std::uint32_t i) { return overlap(tree.box(i), asked); }, found);
      for (const std::uint32_t i : members) {
        if (overlap(boxes[i], asked)) expected.push_back(i);
      }
      std::sort(found.begin(), found.end());
      EXPECT_EQ(found, expected);
    }
  }
}

TEST(BoxTree, NodesComeBeforeTheirChildrenAndHaveTheirMembers) {
  Random random(2);
  const std::vector<Box> boxes = random_boxes(random, 200, 1000);
  std::vector<std::uint32_t> all(boxes.size());
  std::iota(all.begin(), all.end(), 0u);
  const BoxTree tree(boxes, all);
  const auto nodes = tree.nodes();
  ASSERT_FALSE(nodes.empty());
  EXPECT_EQ(tree.members(nodes[0]).size(), boxes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (const std::uint32_t member : tree.members(nodes[i])) {
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_LE(nodes[i].box.low[k], boxes[member].low[k]);
        EXPECT_GE(nodes[i].box.high[k], boxes[member].high[k]);
      }
    }
    if (nodes[i].right == 0) continue;
    ASSERT_GT(nodes[i].right, i + 1);
    EXPECT_EQ(nodes[i + 1].begin, nodes[i].begin);
    EXPECT_EQ(nodes[i + 1].end, nodes[nodes[i].right].begin);
    EXPECT_EQ(nodes[nodes[i].right].end, nodes[i].end);
  }
}

// --- k-d trees ---

TEST(KdTree, SeparatesAtShortValues) {
  Random random(3);
  for (const bool touching : {false, true}) {
    const std::vector<Box> boxes = random_boxes(random, 500, 1000);
    const KdRules rules{
        .axes = 2, .least = 0.25, .most = 1, .touching_counts = touching, .leaf_size = 8};
    std::int32_t count = 0;
    grow_kd_tree(boxes, rules, 7, true,
                 [&](const KdSplit& split, std::int32_t parent, bool is_front) {
                   EXPECT_EQ(parent == 7, count == 0);
                   EXPECT_TRUE(count > 0 || is_front);
                   EXPECT_LT(split.axis, 2);
                   EXPECT_GT(split.value, 0.25);
                   EXPECT_LT(split.value, 1);
                   const double scaled = std::ldexp(split.value, KdSplit::kBits);
                   EXPECT_EQ(scaled, std::nearbyint(scaled));
                   return 100 + count++;
                 });
    EXPECT_GT(count, 20);
  }
}

TEST(KdTree, LeavesBoxesTogetherThatNoPlaneSeparates) {
  const std::vector<Box> boxes(100, Box{{0, 0, 0}, {1, 1, 1}});
  grow_kd_tree(boxes, KdRules{}, -1, false, [](const KdSplit&, std::int32_t, bool) {
    ADD_FAILURE() << "a split that separates nothing";
    return 0;
  });
}

// --- The walk down a tree of planes ---

/// Points (x, y) and the planes x = value or y = value.
struct FlatSpace {
  using Vertex = std::array<double, 2>;
  struct Plane {
    std::size_t axis;
    double value;
  };
  static constexpr bool kExact = true;
  std::vector<Plane> planes;

  double value(PlaneRef plane, const Vertex& vertex) const {
    const Plane& own = planes[plane.index()];
    return (vertex[own.axis] - own.value) * (plane.flipped() ? -1 : 1);
  }
  Side side_of_plane(PlaneRef plane, const Corner<Vertex>& corner) {
    const double at = value(plane, corner.vertex);
    return at > 0 ? Side::kFront : at < 0 ? Side::kBack : Side::kOn;
  }
  Vertex crossing(PlaneRef plane, PlaneRef, bool, const Corner<Vertex>& a,
                  const Corner<Vertex>& b) const {
    const double at_a = value(plane, a.vertex), at_b = value(plane, b.vertex);
    const double t = at_a / (at_a - at_b);
    return {a.vertex[0] + t * (b.vertex[0] - a.vertex[0]),
            a.vertex[1] + t * (b.vertex[1] - a.vertex[1])};
  }
  StageCounts stage_counts() const { return {}; }
};

struct FlatLoop {
  LoopRange loop;
  int cell = 0;
  bool is_like(const FlatLoop& other) const { return cell == other.cell; }
};

/// x = 2; in front of it y = 2. Cells -1 and -2 in front, `behind` in the back.
struct FlatTree {
  FilteredLoops<FlatSpace::Vertex, FlatLoop>& output;
  FlatSpace& space;
  int behind;

  std::int32_t node_at(TreePlace at) const {
    if (at.node == 0) return 1;
    if (at.node == 1) return at.front ? 2 : behind;
    return at.front ? -1 : -2;
  }
  PlaneRef plane(std::uint32_t node, const LoopView<FlatSpace::Vertex>&) const {
    return PlaneRef(node - 1);
  }
  Placement placement(SplitRecord& record, std::uint32_t node,
                      const LoopView<FlatSpace::Vertex>& loop) const {
    return record.decide(space, plane(node, loop), loop);
  }
  bool is_kept(const LoopView<FlatSpace::Vertex>&) const { return true; }
  void at_cell(TreePlace at, const LoopView<FlatSpace::Vertex>& loop) const {
    output.fragments.push_back({output.loops.append(loop), node_at(at)});
  }
};

/// Filters the square between two points; returns the cells of its fragments and their areas.
std::vector<std::pair<int, double>> filter_square(double low, double high, bool merge, int behind) {
  FlatSpace space{{{0, 2}, {1, 2}}};
  const std::vector<FlatSpace::Vertex> vertices{{low, low}, {high, low}, {high, high}, {low, high}};
  const std::vector<PlaneRef> edges{PlaneRef(10), PlaneRef(11), PlaneRef(12), PlaneRef(13)};
  FilteredLoops<FlatSpace::Vertex, FlatLoop> output;
  PlaneTreeFilter<FlatSpace> filter(merge);
  filter.filter(space, FlatTree{output, space, behind}, {vertices, edges, 0, 0}, output);
  EXPECT_EQ(filter.vanished(), 0u);
  std::vector<std::pair<int, double>> result;
  for (const FlatLoop& fragment : output.fragments) {
    const auto loop = output.loops.view(fragment.loop, 0);
    double twice = 0;
    for (std::uint32_t i = 0; i < loop.size(); ++i) {
      const auto &a = loop.vertices[i], &b = loop.vertices[loop.next(i)];
      twice += a[0] * b[1] - a[1] * b[0];
    }
    result.emplace_back(fragment.cell, twice / 2);
  }
  return result;
}

using Cells = std::vector<std::pair<int, double>>;

TEST(PlaneTreeFilter, TakesFragmentsToTheirCells) {
  EXPECT_EQ(filter_square(3, 4, true, -3), (Cells{{-1, 1}}));
  EXPECT_EQ(filter_square(0, 1, true, -3), (Cells{{-3, 1}}));
  // Front first.
  EXPECT_EQ(filter_square(1, 3, true, -3), (Cells{{-1, 1}, {-2, 1}, {-3, 2}}));
}

TEST(PlaneTreeFilter, MergesFragmentsThatAreAllOfTheirParent) {
  EXPECT_EQ(filter_square(1, 3, true, -2), (Cells{{-1, 1}, {-2, 1}, {-2, 2}}));  // not its parent
  // Without merging the two fragments stay; with it the square comes out as it went in. A square
  // below y = 2 is not split by that plane.
  EXPECT_EQ(filter_square(1, 2, true, -2), (Cells{{-2, 1}}));
  FlatSpace space{{{0, 1}, {1, 2}}};
  const std::vector<FlatSpace::Vertex> vertices{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  const std::vector<PlaneRef> edges{PlaneRef(10), PlaneRef(11), PlaneRef(12), PlaneRef(13)};
  for (const bool merge : {false, true}) {
    FilteredLoops<FlatSpace::Vertex, FlatLoop> output;
    PlaneTreeFilter<FlatSpace> filter(merge);
    filter.filter(space, FlatTree{output, space, -2}, {vertices, edges, 0, 0}, output);
    ASSERT_EQ(output.fragments.size(), merge ? 1u : 2u);
    if (merge) {
      const auto loop = output.loops.view(output.fragments[0].loop, 0);
      EXPECT_TRUE(
          std::equal(loop.vertices.begin(), loop.vertices.end(), vertices.begin(), vertices.end()));
      EXPECT_TRUE(std::equal(loop.edges.begin(), loop.edges.end(), edges.begin(), edges.end()));
    }
  }
}

}  // namespace
}  // namespace gnomon
