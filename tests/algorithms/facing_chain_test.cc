// SPDX-License-Identifier: GPL-3.0-or-later
// The facing chain against its definition, on soups, families and meshes, open, closed and with
// edges shared by many; its loops; and shapes whose contour is known.
#include "gnomon/algorithms/facing_chain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "exact_space.h"
#include "fuzz/generate/generator.h"
#include "fuzz/generate/scene_pen.h"
#include "gnomon/algorithms/facing_sides.h"
#include "gnomon/scene/generate.h"

namespace gnomon {
namespace {

using fuzz::ScenePen;
using testing::ElementsAre;

/// By the definition, from the sign of each part's own plane.
std::vector<Side> facing_of(const PreparedScene& scene, const LightPoint& light) {
  const test::RationalLight at(light);
  std::vector<Side> sides;
  for (std::uint32_t i = 0; i < scene.parts.size(); ++i) {
    const int side = at.side_of(test::plane_of(test::grid_loop(scene, i)));
    sides.push_back(side > 0                               ? Side::kFront
                    : side < 0 && scene.parts[i].two_sided ? Side::kBack
                                                           : Side::kOn);
  }
  return sides;
}

using Ends = std::pair<VertexId, VertexId>;

/// How many more facing parts run from the first vertex to the second than back.
std::map<Ends, int> contour_by_definition(const PreparedScene& scene,
                                          const std::vector<Side>& facing) {
  std::map<Ends, int> runs;
  for (std::uint32_t i = 0; i < scene.parts.size(); ++i) {
    if (facing[i] == Side::kOn || !scene.parts[i].casts) continue;
    const auto loop = scene.loop(scene.parts[i]);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      Ends ends{loop[k], loop[(k + 1) % loop.size()]};
      if (facing[i] == Side::kBack) std::swap(ends.first, ends.second);
      ++runs[ends];
    }
  }
  std::map<Ends, int> contour;
  for (const auto& [ends, count] : runs) {
    const auto back = runs.find({ends.second, ends.first});
    const int sum = count - (back == runs.end() ? 0 : back->second);
    if (sum > 0) contour[ends] = sum;
  }
  return contour;
}

Ends ends_of(const PreparedScene& scene, PlaneRef edge) {
  const EdgeEnds ends = scene.geometry.edges[edge.index()];
  return edge.flipped() ? Ends{ends.b, ends.a} : Ends{ends.a, ends.b};
}

std::string problem_of(const PreparedScene& scene, const LightPoint& light) {
  const std::vector<Side> facing = facing_of(scene, light);
  EXPECT_EQ(facing_sides(scene, light), facing);
  const FacingChain chain = facing_chain(scene, facing);
  std::map<Ends, int> contour;
  std::map<VertexId, int> in_less_out;
  for (const ContourEdge& edge : chain.contour) {
    const Ends ends = ends_of(scene, edge.edge);
    contour[ends] += static_cast<int>(edge.multiplicity);
    in_less_out[ends.first] -= static_cast<int>(edge.multiplicity);
    in_less_out[ends.second] += static_cast<int>(edge.multiplicity);
  }
  if (contour != contour_by_definition(scene, facing)) return "not the contour of the definition";
  for (const auto& [vertex, sum] : in_less_out) {
    if (sum != 0) return "as many edges must end as start in vertex " + std::to_string(vertex);
  }
  std::vector<std::uint32_t> used(chain.contour.size(), 0);
  for (std::size_t i = 0; i < chain.loops(); ++i) {
    const auto loop = chain.loop(i);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      ++used[loop[k]];
      const Ends own = ends_of(scene, chain.contour[loop[k]].edge);
      const Ends next = ends_of(scene, chain.contour[loop[(k + 1) % loop.size()]].edge);
      if (own.second != next.first) return "loop " + std::to_string(i) + " is torn";
    }
  }
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i] != chain.contour[i].multiplicity) return "an edge is in too many or too few loops";
  }
  return {};
}

FacingChain chain_of(const Scene& scene) {
  const PreparedScene prepared = prepare(scene).value();
  const LightPoint& light = prepared.lights.at(0).point;
  EXPECT_EQ(problem_of(prepared, light), "");
  return facing_chain(prepared, facing_of(prepared, light));
}

std::vector<std::uint32_t> multiplicities(const FacingChain& chain) {
  std::vector<std::uint32_t> result;
  for (const ContourEdge& edge : chain.contour) result.push_back(edge.multiplicity);
  return result;
}
std::vector<std::size_t> loop_sizes(const FacingChain& chain) {
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < chain.loops(); ++i) result.push_back(chain.loop(i).size());
  return result;
}

TEST(FacingChain, IsTheDefinitionsOnCampaigns) {
  int with_multiplicity = 0, with_light_in_plane = 0;
  for (const char* base : {"mix", "soup-lattice", "soup-uniform"}) {
    const fuzz::Generator generator = fuzz::Generator::parse(base).value();
    for (std::uint64_t seed = 1; seed <= 400; ++seed) {
      const Scene scene = generator.make(seed).scene;
      const PreparedScene prepared = prepare(scene).value();
      for (const PreparedLight& light : prepared.lights) {
        if (light.has_area()) continue;
        ASSERT_EQ(problem_of(prepared, light.point), "") << base << ' ' << seed;
        const std::vector<Side> facing = facing_of(prepared, light.point);
        for (const ContourEdge& edge : facing_chain(prepared, facing).contour) {
          with_multiplicity += edge.multiplicity > 1 ? 1 : 0;
        }
        const test::RationalLight at(light.point);
        for (std::uint32_t i = 0; i < prepared.parts.size(); ++i) {
          const auto plane = test::plane_of(test::grid_loop(prepared, i));
          with_light_in_plane += at.side_of(plane) == 0 ? 1 : 0;
        }
      }
    }
  }
  EXPECT_GT(with_multiplicity, 20);
  EXPECT_GT(with_light_in_plane, 20);
}

TEST(FacingChain, IsTheDefinitionsOnScenesOfThePapers) {
  for (const auto& [name, n] : std::vector<std::pair<std::string, std::int64_t>>{
           {"city", 40}, {"quads", 60}, {"lattice", 60}, {"coplanar-tiles", 60}, {"grazing", 30}}) {
    for (const std::int64_t light : {0, 1}) {
      const Scene scene = generate(name, {{"n", n}, {"light", light}}).value();
      const PreparedScene prepared = prepare(scene).value();
      for (const PreparedLight& one : prepared.lights) {
        EXPECT_EQ(problem_of(prepared, one.point), "") << name << ' ' << light;
      }
    }
  }
}

TEST(FacingChain, OfABoxIsOneLoop) {
  EXPECT_THAT(loop_sizes(chain_of(ScenePen().box({0, 0, 0}, {2, 2, 2}).sun({1, 2, 3}).take())),
              ElementsAre(6));
  // The light is in the planes of four faces: they do not face it.
  const FacingChain above = chain_of(ScenePen().box({0, 0, 0}, {2, 2, 2}).sun({0, 0, 1}).take());
  EXPECT_THAT(loop_sizes(above), ElementsAre(4));
  EXPECT_EQ(above.facing_edges, 4u);
  EXPECT_EQ(above.contour_share(), 1);
  // Within it no face faces the light.
  EXPECT_EQ(chain_of(ScenePen().box({0, 0, 0}, {2, 2, 2}).lamp({1, 1, 1}).take()).loops(), 0u);
}

TEST(FacingChain, CountsBothSidesOfAClosedMesh) {
  const FacingChain chain =
      chain_of(ScenePen().two_sided(true).box({0, 0, 0}, {2, 2, 2}).sun({1, 2, 3}).take());
  EXPECT_THAT(multiplicities(chain), ElementsAre(2, 2, 2, 2, 2, 2));
  EXPECT_THAT(loop_sizes(chain), ElementsAre(6, 6));
  EXPECT_EQ(chain.facing_edges, 24u);
  EXPECT_EQ(chain.contour_share(), 0.5);
}

TEST(FacingChain, IsLongerWhereEdgesMeetInT) {
  // A square, and two halves beside it: of the long edge and its halves none cancels.
  const FacingChain chain = chain_of(ScenePen()
                                         .polygon({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}})
                                         .polygon({{2, 0, 0}, {4, 0, 0}, {4, 1, 0}, {2, 1, 0}})
                                         .polygon({{2, 1, 0}, {4, 1, 0}, {4, 2, 0}, {2, 2, 0}})
                                         .sun({0, 0, 1})
                                         .take());
  EXPECT_EQ(chain.contour.size(), 10u);
  EXPECT_EQ(chain.facing_edges, 12u);
}

TEST(FacingChain, LeavesOutWhatCastsNothing) {
  const FacingChain chain = chain_of(ScenePen()
                                         .polygon({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}})
                                         .casts(false)
                                         .polygon({{2, 0, 0}, {4, 0, 0}, {4, 2, 0}, {2, 2, 0}})
                                         .sun({0, 0, 1})
                                         .take());
  EXPECT_THAT(loop_sizes(chain), ElementsAre(4));
}

TEST(FacingChain, TurnsThroughTheFacingSideWhereLoopsMeet) {
  // Two squares that touch in a vertex are two loops, and with a third beside both one loop.
  const FacingChain two = chain_of(ScenePen()
                                       .polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}})
                                       .polygon({{1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}})
                                       .sun({0, 0, 1})
                                       .take());
  EXPECT_THAT(loop_sizes(two), ElementsAre(4, 4));
  // The same of two triangles each, in an order in which the other square's edge comes first.
  const FacingChain halves = chain_of(ScenePen()
                                          .polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}})
                                          .polygon({{1, 1, 0}, {2, 1, 0}, {2, 2, 0}})
                                          .polygon({{1, 1, 0}, {2, 2, 0}, {1, 2, 0}})
                                          .polygon({{0, 0, 0}, {1, 1, 0}, {0, 1, 0}})
                                          .sun({0, 0, 1})
                                          .take());
  EXPECT_THAT(loop_sizes(halves), ElementsAre(4, 4));
  const FacingChain joined = chain_of(ScenePen()
                                          .polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}})
                                          .polygon({{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}})
                                          .polygon({{1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}})
                                          .sun({0, 0, 1})
                                          .take());
  EXPECT_THAT(loop_sizes(joined), ElementsAre(8));
}

}  // namespace
}  // namespace gnomon
