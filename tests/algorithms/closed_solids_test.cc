// SPDX-License-Identifier: GPL-3.0-or-later
// The closed solids of `gnomon generate closed` are what they are said to be: closed, of exact
// counts, without T-junctions, and with the outlines that Thakur, Cheng & Miura draw.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "exact_space.h"
#include "gnomon/algorithms/components.h"
#include "gnomon/algorithms/facing_chain.h"
#include "gnomon/scene/generate.h"

namespace gnomon {
namespace {

PreparedScene solid(const std::string& kind, std::int64_t n = 12, std::uint64_t seed = 1) {
  const GeneratorInfo& info = *generator_by_name("closed");
  const std::int64_t value = parameter_value(info, "kind", kind).value();
  return prepare(generate("closed", {{"kind", value}, {"n", n}}, seed).value()).value();
}

/// Vertices that lie inside an edge of a part, that is, not at its ends.
std::size_t vertices_within_edges(const PreparedScene& scene) {
  std::size_t count = 0;
  std::set<VertexId> vertices;
  for (const Part& part : scene.parts) {
    const auto loop = scene.loop(part);
    vertices.insert(loop.begin(), loop.end());
  }
  for (const EdgeEnds& edge : scene.geometry.edges) {
    const test::Rational3 a = test::grid_position(scene, edge.a),
                          b = test::grid_position(scene, edge.b);
    for (const VertexId v : vertices) {
      const test::Rational3 to_a = test::difference(a, test::grid_position(scene, v)),
                            to_b = test::difference(b, test::grid_position(scene, v));
      const test::Rational3 turn = test::cross_product(to_a, to_b);
      const bool on_line = turn[0] == 0 && turn[1] == 0 && turn[2] == 0;
      count += on_line && test::dot_product(to_a, to_b) < 0;
    }
  }
  return count;
}

const std::vector<std::string>& kinds() {
  const auto& parameters = generator_by_name("closed")->parameters;
  return std::ranges::find(parameters, "kind", &GeneratorParameter::name)->words;
}

TEST(ClosedSolids, AreClosedAndWithoutTJunctions) {
  ASSERT_EQ(kinds().size(), 8u);
  for (const std::string& kind : kinds()) {
    SCOPED_TRACE(kind);
    const PreparedScene scene = solid(kind);
    const std::vector<Component> components = find_components(scene);
    for (const Component& component : components) {
      EXPECT_TRUE(component.is_closed);
      EXPECT_FALSE(component.is_convex);
    }
    if (kind != "polycube") {
      EXPECT_EQ(components.size(), 1u);
    }
    EXPECT_EQ(vertices_within_edges(scene), 0u);
  }
}

TEST(ClosedSolids, PolycubesAreClosedWhateverTheSeed) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const PreparedScene scene = solid("polycube", static_cast<std::int64_t>(seed), seed);
    for (const Component& component : find_components(scene)) EXPECT_TRUE(component.is_closed);
    EXPECT_EQ(vertices_within_edges(scene), 0u);
  }
}

/// Loops of the contour under the solid's lamp, and how often each turns around the z axis, which
/// the lamp is near to.
struct Outline {
  std::size_t loops = 0;
  std::vector<int> turns;
};
Outline outline_of(const PreparedScene& scene) {
  const test::RationalLight lamp(scene.lights.front().point);
  std::vector<Side> facing;
  for (std::uint32_t i = 0; i < scene.parts.size(); ++i) {
    const int side = lamp.side_of(test::plane_of(test::grid_loop(scene, i)));
    facing.push_back(side > 0 ? Side::kFront : Side::kOn);
  }
  const FacingChain chain = facing_chain(scene, facing);
  Outline outline{chain.loops(), {}};
  // The axis is the middle of the solid: crossings of the half-plane y = 0, x > 0 from below count
  // 1, from above -1.
  std::array<mpq_class, 2> low, high;
  for (std::uint32_t v = 0; v < scene.geometry.positions.size(); ++v) {
    const test::Rational3 p = test::grid_position(scene, v);
    for (std::size_t k = 0; k < 2; ++k) {
      low[k] = v == 0 ? p[k] : std::min(low[k], p[k]);
      high[k] = v == 0 ? p[k] : std::max(high[k], p[k]);
    }
  }
  for (std::size_t i = 0; i < chain.loops(); ++i) {
    int turns = 0;
    for (const std::uint32_t index : chain.loop(i)) {
      const PlaneRef edge = chain.contour[index].edge;
      EdgeEnds ends = scene.geometry.edges[edge.index()];
      if (edge.flipped()) std::swap(ends.a, ends.b);
      const test::Rational3 from = test::grid_position(scene, ends.a),
                            to = test::grid_position(scene, ends.b);
      // A hair beside the middle, where no vertex is.
      const mpq_class x = (low[0] + high[0]) / 2, y = (low[1] + high[1]) / 2 + mpq_class(1, 1000);
      if ((from[1] < y) == (to[1] < y)) continue;
      const mpq_class at = from[0] + (to[0] - from[0]) * (y - from[1]) / (to[1] - from[1]);
      if (at > x) turns += from[1] < y ? 1 : -1;
    }
    outline.turns.push_back(turns);
  }
  std::ranges::sort(outline.turns);
  return outline;
}

TEST(ClosedSolids, HaveTheOutlinesOfThePaper) {
  using testing::ElementsAre;
  EXPECT_EQ(outline_of(solid("block-on-block")).loops, 2u);
  // Around the rim, and back around the hole.
  EXPECT_THAT(outline_of(solid("holed")).turns, ElementsAre(-1, 1));
  EXPECT_EQ(outline_of(solid("hole-like")).loops, 2u);
  // One loop, which winds around twice outside and twice back inside, as a whole not at all; so
  // the outline coils.
  for (const char* coil : {"coil2", "coil3"}) {
    SCOPED_TRACE(coil);
    const PreparedScene scene = solid(coil);
    const Outline outline = outline_of(scene);
    EXPECT_EQ(outline.loops, 1u);
    EXPECT_THAT(outline.turns, ElementsAre(0));
  }
}

}  // namespace
}  // namespace gnomon
