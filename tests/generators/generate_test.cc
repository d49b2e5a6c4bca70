// SPDX-License-Identifier: GPL-3.0-or-later
// Polygon counts of the papers, the same scene everywhere, and: every generated scene can be
// prepared.
#include "gnomon/scene/generate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <set>

#include "builder.h"
#include "scene/base/random.h"

namespace gnomon::test {
namespace {

Scene make(const std::string& name, const std::map<std::string, std::int64_t>& parameters = {},
           std::uint64_t seed = 1) {
  auto scene = generate(name, parameters, seed);
  EXPECT_TRUE(scene) << name << ": " << (scene ? "" : to_string(scene.error()));
  return scene ? *scene : Scene{};
}

std::uint64_t checksum(const Scene& scene) {
  std::uint64_t sum = 14695981039346656037u;
  const auto add = [&](std::uint64_t word) { sum = (sum ^ word) * 1099511628211u; };
  for (const Position& p : scene.vertices) {
    for (const Number& n : p) add(std::bit_cast<std::uint64_t>(n.nearest()));
  }
  for (const Polygon& p : scene.polygons) {
    for (const VertexId v : p.loop) add(v);
    for (const auto& hole : p.holes) {
      for (const VertexId v : hole) add(v);
    }
  }
  return sum;
}

TEST(Counts, AreThoseOfThePapers) {
  const auto polygons = [](const std::string& name,
                           const std::map<std::string, std::int64_t>& p = {}) {
    return make(name, p).polygons.size();
  };
  EXPECT_EQ(polygons("solids"), 27u);
  EXPECT_EQ(make("solids").lights.size(), 3u);
  EXPECT_EQ(polygons("tetra-staircase"), 126u);
  EXPECT_EQ(polygons("table-chair"), 65u);
  EXPECT_EQ(make("table-chair").lights.size(), 2u);
  EXPECT_EQ(polygons("room"), 106u);
  EXPECT_EQ(make("room").lights.size(), 2u);
  EXPECT_EQ(polygons("tetra"), 258u);
  EXPECT_EQ(polygons("tetra", {{"level", 5}}), 1026u);
  for (const auto& [level, count] :
       std::map<std::int64_t, std::size_t>{{3, 65}, {4, 257}, {5, 1025}}) {
    EXPECT_EQ(polygons("tetra", {{"level", level}, {"ground", 1}}), count);
  }
  for (const std::int64_t n : {12, 17, 138, 200, 318}) {
    EXPECT_EQ(polygons("slater-room", {{"n", n}}), static_cast<std::size_t>(n));
  }
  std::int64_t room = 0;  // in the order of Slater's Table 1
  for (const std::size_t count : {138u, 174u, 192u, 210u, 228u, 264u, 246u, 264u, 282u, 318u}) {
    const std::map<std::string, std::int64_t> row = {{"room", ++room}};
    EXPECT_EQ(polygons("slater-room", row), count);
    EXPECT_EQ(make("slater-room", row).lights.size(), 1u);
  }
  std::int64_t kind = 0;
  for (const std::size_t count : {26u, 38u, 26u, 194u, 330u, 330u, 128u}) {
    EXPECT_EQ(polygons("closed", {{"kind", kind++}}), count);
  }
  EXPECT_EQ(polygons("cubes", {{"n", 50}}), 300u);
  EXPECT_EQ(polygons("slater-figure-6"), 3u);
  EXPECT_EQ(polygons("svbsp-figure-2"), 3u);
  EXPECT_EQ(polygons("plates1"), 14u);
  EXPECT_EQ(polygons("room1992"), 149u);
  EXPECT_EQ(polygons("room1992", {{"lights", 2}}), 151u);
  EXPECT_EQ(polygons("room1992", {{"lights", 2}, {"playpen", 0}}), 70u);
  EXPECT_EQ(make("room1992", {{"lights", 2}}).lights.size(), 2u);
  EXPECT_EQ(polygons("figure-4f"), 4u);
  EXPECT_EQ(polygons("figure-6"), 3u);
  EXPECT_EQ(polygons("solids-field", {{"n", 8}}), 53u);
  EXPECT_EQ(polygons("panel-contacts", {{"n", 5}}), 6u);
  EXPECT_EQ(polygons("city", {{"n", 24000}}), 120001u);
  EXPECT_EQ(polygons("quads", {{"n", 50}}), 51u);
  EXPECT_EQ(polygons("comb", {{"n", 5}}), 7u);
  EXPECT_EQ(polygons("stairs", {{"n", 5}}), 22u);
  EXPECT_EQ(polygons("nested-boxes", {{"n", 5}}), 26u);
  EXPECT_EQ(polygons("coplanar-tiles", {{"n", 5}}), 6u);
  EXPECT_GE(polygons("sub-objects", {{"n", 50}}), 201u);
  EXPECT_LE(polygons("sub-objects", {{"n", 50}}), 401u);
  EXPECT_EQ(polygons("radial-fan", {{"n", 5}}), 6u);
}

TEST(Counts, EveryGeneratorIsDescribed) {
  std::set<std::string> names;
  for (const GeneratorInfo& info : generators()) {
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    EXPECT_FALSE(info.summary.empty()) << info.name;
    EXPECT_FALSE(info.source.empty()) << info.name;
    EXPECT_EQ(generator_by_name(info.name)->name, info.name);
    for (const GeneratorParameter& p : info.parameters) {
      EXPECT_LE(p.minimum, p.default_value) << info.name << " " << p.name;
      EXPECT_GE(p.maximum, p.default_value) << info.name << " " << p.name;
      EXPECT_FALSE(p.meaning.empty());
    }
  }
}

TEST(Counts, BadRequestsAreUsageErrors) {
  EXPECT_EQ(generate("no-such-scene").error().code, ErrorCode::kUsage);
  EXPECT_EQ(generate("city", {{"m", 3}}).error().code, ErrorCode::kUsage);
  EXPECT_EQ(generate("city", {{"n", 0}}).error().code, ErrorCode::kUsage);
}

TEST(Counts, SlatersLampsAreInsideOutsideOrBoth) {
  const auto places = [](std::int64_t room, std::int64_t lights) {
    std::vector<double> x;
    for (const Light& lamp : make("slater-room", {{"room", room}, {"lights", lights}}).lights) {
      x.push_back(lamp.position[0].nearest());
    }
    return x;
  };
  for (const std::int64_t room : {1, 10}) {
    const std::vector<double> both = places(room, 2);
    ASSERT_EQ(both.size(), 2u);
    EXPECT_GT(both[0], 0);
    EXPECT_LT(both[1], -6);  // beyond the wall
    EXPECT_EQ(places(room, 1), std::vector<double>{both[0]});
    EXPECT_EQ(places(room, 3), std::vector<double>{both[1]});
  }
}

TEST(Counts, CubesAreFarToNear) {
  for (const std::int64_t near_first : {0, 1}) {
    const Scene scene = make("cubes", {{"n", 60}, {"near_first", near_first}});
    const Position& lamp = scene.lights.front().position;
    double before = near_first == 0 ? 1e300 : 0;
    for (std::size_t cube = 0; cube < scene.polygons.size(); cube += 6) {
      std::array<double, 3> middle{};  // of the bottom's and the top's corners, times 8
      for (const std::size_t face : {cube, cube + 1}) {
        for (const VertexId v : scene.polygons[face].loop) {
          EXPECT_LT(scene.vertices[v][2].nearest(), lamp[2].nearest());
          for (std::size_t k = 0; k < 3; ++k) middle[k] += scene.vertices[v][k].nearest();
        }
      }
      double distance = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const double way = middle[k] / 8 - lamp[k].nearest();
        distance += way * way;
      }
      if (near_first == 0) {
        EXPECT_LE(distance, before);
      } else {
        EXPECT_GE(distance, before);
      }
      before = distance;
    }
  }
}

TEST(Counts, ParametersMayHaveWords) {
  const GeneratorInfo& info = *generator_by_name("closed");
  EXPECT_EQ(parameter_value(info, "kind", "torus"), 6);
  EXPECT_EQ(parameter_value(info, "kind", "6"), 6);
  EXPECT_EQ(parameter_value(info, "kind", "sphere"), std::nullopt);
  EXPECT_EQ(parameter_value(info, "n", "torus"), std::nullopt);
  EXPECT_EQ(parameter_value(info, "n", "-3"), -3);
  EXPECT_EQ(parameter_value(info, "n", "3x"), std::nullopt);
  EXPECT_EQ(parameter_value(info, "n", ""), std::nullopt);
  for (const GeneratorInfo& any : generators()) {
    for (const GeneratorParameter& p : any.parameters) {
      if (p.words.empty()) continue;
      EXPECT_EQ(static_cast<std::int64_t>(p.words.size()), p.maximum - p.minimum + 1) << any.name;
    }
  }
  const auto beyond = generate("closed", {{"kind", 8}});
  ASSERT_FALSE(beyond);
  EXPECT_NE(to_string(beyond.error()).find("block-on-block|holed"), std::string::npos);
}

/// Ids are unique, lights exist, the scene is prepared without a flaw, and nothing that should be
/// planar and convex was repaired.
void expect_sound(const GeneratorInfo& info, const std::map<std::string, std::int64_t>& parameters,
                  std::uint64_t seed) {
  SCOPED_TRACE(info.name + " seed " + std::to_string(seed));
  const Scene scene = make(info.name, parameters, seed);
  EXPECT_EQ(scene.name, info.name);
  EXPECT_FALSE(scene.lights.empty());
  std::set<std::string> ids;
  for (const Polygon& p : scene.polygons) EXPECT_TRUE(ids.insert(p.id).second) << p.id;
  const auto prepared = prepare(scene);
  ASSERT_TRUE(prepared) << to_string(prepared.error());
  EXPECT_EQ(first_flaw(*prepared, scene), "");
  const bool needs_repair =
      info.name == "holed-wall" || info.name == "spiral" || info.name == "terrain";
  if (needs_repair) {
    EXPECT_FALSE(prepared->notes.empty());
  } else {
    EXPECT_TRUE(prepared->notes.empty())
        << scene.polygons[prepared->notes[0].polygon].id << ": " << prepared->notes[0].detail;
  }
  for (std::uint32_t p = 0; p < scene.polygons.size(); ++p) {
    EXPECT_EQ(part_area_sum(*prepared, p), input_area(*prepared, scene, p)) << scene.polygons[p].id;
  }
}

TEST(Sound, Defaults) {
  for (const GeneratorInfo& info : generators()) expect_sound(info, {}, 1);
}

TEST(Sound, SmallFamiliesByManySeeds) {
  for (const GeneratorInfo& info : generators()) {
    if (!info.small) continue;
    for (std::uint64_t seed = 2; seed < 60; ++seed) expect_sound(info, {}, seed);
  }
}

TEST(Sound, Variants) {
  const auto check = [](const std::string& name,
                        const std::map<std::string, std::int64_t>& parameters) {
    expect_sound(*generator_by_name(name), parameters, 3);
  };
  check("radial-fan", {{"kind", 1}});
  check("radial-fan", {{"kind", 2}, {"n", 7}});
  check("spiral", {{"n", 1}});
  check("spiral", {{"n", 2}});
  check("spiral", {{"n", 60}});
  check("holed-wall", {{"n", 100}});
  check("needles", {{"thinness", 40}});
  check("near-coplanar", {{"closeness", 44}});
  check("tetra", {{"level", 1}});
  for (std::int64_t kind = 0; kind < 8; ++kind) check("closed", {{"kind", kind}});
  check("closed", {{"kind", 7}, {"n", 100}});
  for (std::int64_t room = 1; room <= 10; ++room)
    check("slater-room", {{"room", room}, {"lights", 2}});
  check("lattice", {{"n", 200}, {"size", 2}, {"light", 2}});
}

std::size_t area_lights(const Scene& scene) {
  return static_cast<std::size_t>(std::ranges::count(scene.lights, LightType::kArea, &Light::type));
}

bool has_parameter(const GeneratorInfo& info, const std::string& name) {
  return std::ranges::find(info.parameters, name, &GeneratorParameter::name) !=
         info.parameters.end();
}

TEST(AreaLights, EveryFamilyThatChoosesItsLightHasThem) {
  for (const GeneratorInfo& info : generators()) {
    if (!has_parameter(info, "area")) {
      EXPECT_FALSE(has_parameter(info, "light")) << info.name;
      continue;
    }
    for (std::uint64_t seed = 1; seed < (info.small ? 30 : 3); ++seed) {
      expect_sound(info, {{"area", 1}}, seed);
    }
    const Scene alone = make(info.name, {{"area", 1}});
    const Scene mixed = make(info.name, {{"area", 2}});
    EXPECT_EQ(area_lights(alone), alone.lights.size()) << info.name;
    EXPECT_EQ(area_lights(mixed), area_lights(alone)) << info.name;
    EXPECT_GT(mixed.lights.size(), area_lights(mixed)) << info.name;
    EXPECT_EQ(alone.lights.front().id, "panel");
    EXPECT_EQ(alone.polygons.size(), mixed.polygons.size());
  }
}

TEST(AreaLights, HaveTheSizeThatWasAskedFor) {
  for (const std::int64_t percent : {1, 50}) {
    const Scene scene = make("quads", {{"n", 10}, {"area", 1}, {"area_size", percent}});
    const auto& loop = scene.lights.front().loop;
    const double width = loop[2][0].nearest() - loop[0][0].nearest();
    EXPECT_NEAR(width, 65536.0 * static_cast<double>(percent) / 100, 2);
    // It looks down: clockwise seen from above.
    EXPECT_GT(loop[1][1].nearest(), loop[0][1].nearest());
  }
}

/// How many of `points` are before and behind the plane of `loop`, by plain arithmetic.
struct Sides {
  std::size_t front = 0, back = 0, on = 0;
};
Sides sides_of(const std::vector<Exact3>& loop, const std::vector<Exact3>& points) {
  const Exact3 normal = plain_cross(loop[0], loop[1], loop[2]);
  Sides sides;
  for (const Exact3& p : points) {
    mpz_class value = 0;
    for (std::size_t k = 0; k < 3; ++k) value += normal[k] * (p[k] - loop[0][k]);
    ++(value > 0 ? sides.front : value < 0 ? sides.back : sides.on);
  }
  return sides;
}

TEST(AreaLights, ContactsComeInEveryKind) {
  std::size_t at_vertex = 0, at_edge = 0, in_plane = 0, cuts = 0, is_cut = 0;
  for (std::uint64_t seed = 1; seed < 40; ++seed) {
    const auto prepared = prepare(make("panel-contacts", {}, seed));
    ASSERT_TRUE(prepared);
    const auto& light = prepared->lights.front().area_loop;
    for (const Part& part : prepared->parts) {
      std::vector<Exact3> loop;
      for (const VertexId v : prepared->loop(part)) loop.push_back(grid_point(*prepared, v));
      const auto shared = std::ranges::count_if(
          loop, [&](const Exact3& p) { return std::ranges::find(light, p) != light.end(); });
      at_vertex += shared == 1;
      at_edge += shared == 2;
      const Sides of_light = sides_of(loop, light), of_part = sides_of(light, loop);
      in_plane += of_light.on == light.size();
      cuts += of_light.front > 0 && of_light.back > 0;
      is_cut += of_part.front > 0 && of_part.back > 0;
    }
  }
  for (const std::size_t count : {at_vertex, at_edge, in_plane, cuts, is_cut}) {
    EXPECT_GT(count, 15u);
  }
}

TEST(Random, IsTheSameEverywhere) {
  Random random(1);
  EXPECT_EQ(random.next(), 12966619160104079557u);
  EXPECT_EQ(random.next(), 9600361134598540522u);
  Random other(1);
  EXPECT_EQ(Random(1).next(), other.next());
  std::array<int, 6> counts{};
  for (int i = 0; i < 60000; ++i) ++counts[random.below(6)];
  for (const int c : counts) EXPECT_NEAR(c, 10000, 500);
  for (int i = 0; i < 1000; ++i) {
    const std::int64_t v = random.between(-3, 5);
    EXPECT_TRUE(v >= -3 && v <= 5);
  }
}

TEST(Random, SeedsGiveDifferentScenesAndTheSameSeedTheSame) {
  for (const char* name : {"city", "quads", "lattice", "slater-room", "holed-wall", "needles"}) {
    EXPECT_EQ(checksum(make(name, {}, 7)), checksum(make(name, {}, 7))) << name;
    EXPECT_NE(checksum(make(name, {}, 7)), checksum(make(name, {}, 8))) << name;
  }
}

}  // namespace
}  // namespace gnomon::test
