// SPDX-License-Identifier: GPL-3.0-or-later
// Hidden lines against the oracle, from eyes and lights in generic and in degenerate places: parts
// of all edges exactly, points inside of them, counts handed on and anew, polygons in any order;
// and every kind of tie by hand.
#include "gnomon/algorithms/hidden_lines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "exact_space.h"
#include "fuzz/check/seven_eyes.h"
#include "fuzz/generate/families.h"
#include "fuzz/generate/generator.h"
#include "fuzz/generate/scene_pen.h"
#include "gnomon/algorithms/facing_sides.h"
#include "gnomon/oracle/line_counts.h"
#include "gnomon/scene/generate.h"
#include "gnomon/scene/read.h"
#include "scene/base/random.h"

namespace gnomon {
namespace {

using fuzz::ScenePen;
using testing::IsEmpty;

Scene seen_from(Scene scene, const Position& eye) {
  Light light;
  light.id = "the eye";
  light.position = eye;
  light.is_eye = true;
  scene.lights.push_back(std::move(light));
  return scene;
}

std::vector<EdgeId> all_edges(const PreparedScene& scene) {
  std::vector<EdgeId> edges(scene.geometry.edges.size());
  std::iota(edges.begin(), edges.end(), 0u);
  return edges;
}

std::string parts_text(const auto& parts) {
  std::string text;
  for (const auto& part : parts) {
    text += ' ' + std::to_string(part.hidden_by) + " to " + part.end.get_str() + ';';
  }
  return text;
}

/// What the checks came across, so that a campaign can say that it met everything.
struct Met {
  std::uint64_t breakpoints = 0, counted = 0, handed_on = 0, points = 0, borders = 0;
};

/// Parts against the oracle's; the point in the middle of each and a random one against segments.
std::string problem_of(const PreparedScene& scene, const PreparedLight& light,
                       const std::vector<EdgeId>& edges, Random& random, Met& met) {
  const HiddenLines lines = hidden_lines(scene, light, edges).value();
  const HiddenLines anew =
      hidden_lines(scene, light, edges, {.count_every_start = true, .interrupted = nullptr})
          .value();
  const oracle::LineCounts truth(scene, light);
  met.breakpoints += lines.breakpoints;
  met.counted += lines.counted;
  met.handed_on += lines.handed_on;
  if (anew.handed_on != 0) return "counts are handed on that were not to be";
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const std::vector<LinePart>& parts = lines.lines[i].parts;
    const std::string where = "edge " + std::to_string(edges[i]) + ':' + parts_text(parts);
    if (lines.lines[i].edge != edges[i]) return "another edge than that asked for";
    const std::vector<oracle::CountedPart> right = truth.parts(edges[i]);
    if (parts_text(right) != parts_text(parts)) return where + ", the oracle:" + parts_text(right);
    if (parts_text(anew.lines[i].parts) != parts_text(parts)) {
      return where + ", counted anew:" + parts_text(anew.lines[i].parts);
    }
    mpq_class from = 0;
    for (const LinePart& part : parts) {
      // Borders of polygons that the edge passes behind, one into the next, are single points.
      bool is_judged = false;
      for (int attempt = 0; attempt < 6 && (attempt < 2 || !is_judged); ++attempt) {
        const mpq_class share(attempt == 0 ? 1 : random.between(1, 1008), attempt == 0 ? 2 : 1009);
        const mpq_class t = from + share * (part.end - from);
        const auto count = truth.count_at(edges[i], t);
        ++(count ? met.points : met.borders);
        if (!count) continue;
        is_judged = true;
        if (*count != part.hidden_by) {
          return where + ", at " + t.get_str() + " the segment meets " + std::to_string(*count);
        }
      }
      if (!is_judged) return where + ", and every point is on a border";
      from = part.end;
    }
  }
  return {};
}

/// From all point and directional lights, each as a light and, of points, as an eye.
std::string problem_of_lights(Scene scene, Random& random, Met& met) {
  const std::size_t lights = scene.lights.size();
  for (std::size_t l = 0; l < lights; ++l) {
    if (scene.lights[l].is_point()) scene = seen_from(std::move(scene), scene.lights[l].position);
  }
  const auto prepared = prepare(scene);
  if (!prepared) return {};
  for (const PreparedLight& light : prepared->lights) {
    if (light.has_area()) continue;
    const std::string problem = problem_of(*prepared, light, all_edges(*prepared), random, met);
    if (!problem.empty()) return scene.lights[light.light].id + ", " + problem;
  }
  return {};
}

class HiddenLinesFamily : public testing::TestWithParam<fuzz::Family> {};

TEST_P(HiddenLinesFamily, AreTheOracles) {
  const bool has_thousands_of_digits = GetParam().name == "MixedMagnitudes";
  Random random(11);
  Met met;
  for (std::uint64_t seed = 0; seed < (has_thousands_of_digits ? 3u : 30u); ++seed) {
    const Scene scene = GetParam().make(seed);
    const auto prepared = prepare(scene);
    if (!prepared) continue;
    ASSERT_EQ(problem_of_lights(scene, random, met), "") << "seed " << seed;
    if (has_thousands_of_digits) continue;
    for (const fuzz::NamedEye& eye :
         fuzz::seven_eyes(*prepared, 16, static_cast<std::uint32_t>(seed))) {
      const auto view = prepare(seen_from(scene, eye.camera.eye));
      ASSERT_TRUE(view);
      ASSERT_EQ(problem_of(*view, view->lights.back(), all_edges(*view), random, met), "")
          << "seed " << seed << ", eye " << eye.name;
    }
  }
  EXPECT_GT(met.points, 0u);
}

INSTANTIATE_TEST_SUITE_P(Families, HiddenLinesFamily, testing::ValuesIn(fuzz::families()),
                         [](const auto& info) { return info.param.name; });

TEST(HiddenLines, OfCampaignsAreTheOracles) {
  Random random(12);
  Met met;
  for (const char* base : {"mix", "soup-lattice", "soup-uniform", "mix+any"}) {
    const fuzz::Generator generator = fuzz::Generator::parse(base).value();
    for (std::uint64_t seed = 1; seed <= 250; ++seed) {
      ASSERT_EQ(problem_of_lights(generator.make(seed).scene, random, met), "")
          << base << ' ' << seed;
    }
  }
  EXPECT_GT(met.breakpoints, 1000u);
  EXPECT_GT(met.counted, 1000u);
  EXPECT_GT(met.handed_on, 10000u);
  EXPECT_LT(20 * met.borders, met.points);
}

TEST(HiddenLines, OfGeneratedScenesAreTheOracles) {
  Random random(13);
  Met met;
  for (const auto& [name, n] :
       std::vector<std::pair<std::string, std::int64_t>>{{"city", 40},
                                                         {"quads", 30},
                                                         {"lattice", 24},
                                                         {"coplanar-tiles", 30},
                                                         {"touching-boxes", 16},
                                                         {"nested-boxes", 16},
                                                         {"pinwheel", 3}}) {
    const Scene made = gnomon::generate(name, {{"n", n}}, 1).value();
    const Position eye{Number(61.0), Number(-47.0), Number(83.0)};
    ASSERT_EQ(problem_of_lights(seen_from(made, eye), random, met), "") << name;
  }
  EXPECT_GT(met.handed_on, 5 * met.counted);
}

/// The scenes of a directory that are small enough for all edges and polygons to be paired.
std::vector<std::string> small_scenes(const std::filesystem::path& directory) {
  std::vector<std::string> files;
  if (!std::filesystem::is_directory(directory)) return files;
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    if (entry.path().extension() == ".json" && entry.file_size() < 12'000) {
      files.push_back(entry.path().string());
    }
  }
  std::ranges::sort(files);
  return files;
}

TEST(HiddenLines, OfExamplesAndSharedScenesAreTheOracles) {
  std::vector<std::string> files = small_scenes(GNOMON_EXAMPLES);
  ASSERT_FALSE(files.empty());
  const std::string shared = GNOMON_SHARED_SCENES;
  if (!shared.empty()) std::ranges::copy(small_scenes(shared + "/json"), std::back_inserter(files));
  Random random(14);
  Met met;
  for (const std::string& file : files) {
    const auto read = read_scene(file);
    if (!read || !prepare(read->scene)) continue;
    Scene scene = read->scene;
    scene.lights.clear();
    const PreparedScene plain = prepare(scene).value();
    for (const fuzz::NamedEye& eye : fuzz::seven_eyes(plain, 16)) {
      const PreparedScene view = prepare(seen_from(scene, eye.camera.eye)).value();
      const PreparedLight& from = view.lights.back();
      std::vector<EdgeId> edges;
      for (const OutlineEdge& edge : outline_edges(view, facing_sides(view, from.point))) {
        edges.push_back(edge.edge);
      }
      ASSERT_EQ(problem_of(view, from, edges, random, met), "") << file << ", eye " << eye.name;
    }
  }
  EXPECT_GT(met.breakpoints, 100u);
}

/// Edges by the places of their ends, each with its parts from the lesser end.
using PlacedLines = std::map<std::pair<std::string, std::string>, std::string>;

PlacedLines placed_lines(const PreparedScene& scene, const PreparedLight& light) {
  std::vector<EdgeId> edges;
  for (const OutlineEdge& edge : outline_edges(scene, facing_sides(scene, light.point))) {
    edges.push_back(edge.edge);
  }
  const auto place = [&](VertexId vertex) {
    std::string text;
    for (int axis = 0; axis < 3; ++axis)
      text += scene.geometry.grid.at(vertex, axis).get_str() + ' ';
    return text;
  };
  PlacedLines placed;
  const HiddenLines found = hidden_lines(scene, light, edges).value();
  for (const HiddenLine& line : found.lines) {
    std::pair ends{place(scene.geometry.edges[line.edge].a),
                   place(scene.geometry.edges[line.edge].b)};
    std::vector<LinePart> parts = line.parts;
    if (ends.second < ends.first) {
      std::swap(ends.first, ends.second);
      std::vector<LinePart> turned;
      for (std::size_t i = parts.size(); i-- > 0;) {
        turned.push_back({1 - (i == 0 ? mpq_class(0) : parts[i - 1].end), parts[i].hidden_by});
      }
      parts = std::move(turned);
    }
    placed[ends] = parts_text(parts);
  }
  return placed;
}

TEST(HiddenLines, DoNotDependOnTheOrderOfPolygons) {
  Random random(15);
  for (const char* base : {"soup-lattice", "scene:city", "scene:coplanar-tiles", "mix"}) {
    const fuzz::Generator generator = fuzz::Generator::parse(base).value();
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
      const Scene made = generator.make(seed).scene;
      const Position eye{Number(9.0), Number(-7.0), Number(8.0)};
      Scene scene = seen_from(made, eye);
      const auto prepared = prepare(scene);
      if (!prepared) continue;
      const PlacedLines before = placed_lines(*prepared, prepared->lights.back());
      random.shuffle(std::span(scene.polygons));
      const PreparedScene after = prepare(scene).value();
      ASSERT_EQ(placed_lines(after, after.lights.back()), before) << base << ' ' << seed;
    }
  }
}

// By hand. The eye is high above the origin, so that the picture is a map.

struct MapScene {
  PreparedScene scene;

  MapScene(ScenePen& pen, const fuzz::Triple& eye)
      : scene(prepare(seen_from(pen.scene(), pen.position(eye))).value()) {}

  /// The parts of the edge between two places, from the first to the second.
  std::string parts(const fuzz::Triple& from, const fuzz::Triple& to) const {
    const PreparedLight& light = scene.lights.back();
    const auto is_at = [&](VertexId vertex, const fuzz::Triple& place) {
      const auto& at = scene.geometry.positions[vertex];
      return at[0] == static_cast<double>(place[0]) && at[1] == static_cast<double>(place[1]) &&
             at[2] == static_cast<double>(place[2]);
    };
    for (const EdgeId edge : all_edges(scene)) {
      const EdgeEnds ends = scene.geometry.edges[edge];
      const bool forward = is_at(ends.a, from) && is_at(ends.b, to);
      if (!forward && !(is_at(ends.a, to) && is_at(ends.b, from))) continue;
      std::vector<LinePart> parts =
          hidden_lines(scene, light, std::array{edge}).value().lines[0].parts;
      std::string text;
      if (forward) return parts_text(parts);
      for (std::size_t i = parts.size(); i-- > 0;) {
        const mpq_class end = 1 - (i == 0 ? mpq_class(0) : parts[i - 1].end);
        text += ' ' + std::to_string(parts[i].hidden_by) + " to " + end.get_str() + ';';
      }
      return text;
    }
    return "no such edge";
  }
};

/// A square parallel to the ground.
std::vector<fuzz::Triple> square(std::int64_t x, std::int64_t y, std::int64_t size,
                                 std::int64_t z) {
  return {{x, y, z}, {x + size, y, z}, {x + size, y + size, z}, {x, y + size, z}};
}

TEST(HiddenLinesTies, APolygonHidesWhatIsBehindIt) {
  ScenePen pen;
  // From (0, 0, 8) the square at height 4 covers [-4, 4] of the ground.
  pen.polygon(square(-2, -2, 4, 4)).polygon({{-8, 1, 0}, {8, 1, 0}, {8, 6, 0}, {-8, 6, 0}});
  const MapScene map(pen, {0, 0, 8});
  EXPECT_EQ(map.parts({-8, 1, 0}, {8, 1, 0}), " 0 to 1/4; 1 to 3/4; 0 to 1;");
  EXPECT_EQ(map.parts({-8, 6, 0}, {8, 6, 0}), " 0 to 1;");
  EXPECT_EQ(map.parts({-2, -2, 4}, {2, -2, 4}), " 0 to 1;");
}

TEST(HiddenLinesTies, TwoThatShareAnEdgeCountOnceAlongIt) {
  ScenePen pen;
  // Their common edge x = 0 is right in front of the ground's edge x = 0.
  pen.polygon({{-2, -2, 4}, {0, -2, 4}, {0, 2, 4}, {-2, 2, 4}})
      .polygon({{0, -2, 4}, {2, -2, 4}, {2, 2, 4}, {0, 2, 4}})
      .polygon({{0, -8, 0}, {8, -8, 0}, {8, 8, 0}, {0, 8, 0}});
  const MapScene map(pen, {0, 0, 8});
  EXPECT_EQ(map.parts({0, -8, 0}, {0, 8, 0}), " 0 to 1/4; 1 to 3/4; 0 to 1;");
}

TEST(HiddenLinesTies, TheBorderOfAPolygonHides) {
  ScenePen pen;
  pen.polygon({{0, -2, 4}, {2, -2, 4}, {2, 2, 4}, {0, 2, 4}})
      .polygon({{0, -8, 0}, {8, -8, 0}, {8, 8, 0}, {0, 8, 0}});
  const MapScene map(pen, {0, 0, 8});
  EXPECT_EQ(map.parts({0, -8, 0}, {0, 8, 0}), " 0 to 1/4; 1 to 3/4; 0 to 1;");
}

TEST(HiddenLinesTies, AVertexRightInFrontBreaksNothing) {
  ScenePen pen;
  // The corner (0, 2, 4) of a square is in front of the ground's edge y = 4; nothing else of it is.
  pen.polygon({{0, -2, 4}, {2, 0, 4}, {0, 2, 4}, {-2, 0, 4}})
      .polygon({{-8, 4, 0}, {8, 4, 0}, {8, 7, 0}, {-8, 7, 0}});
  const MapScene map(pen, {0, 0, 8});
  EXPECT_EQ(map.parts({-8, 4, 0}, {8, 4, 0}), " 0 to 1;");
}

TEST(HiddenLinesTies, AnEdgeGoesThroughAPolygon) {
  ScenePen pen;
  // A wall stands half below the floor, and does not hide its own edges.
  pen.polygon(square(-4, -4, 8, 0))
      .two_sided(true)
      .polygon({{-2, 1, -2}, {2, 1, -2}, {2, 1, 2}, {-2, 1, 2}});
  const MapScene map(pen, {0, 0, 8});
  EXPECT_EQ(map.parts({2, 1, -2}, {2, 1, 2}), " 1 to 1/2; 0 to 1;");
  EXPECT_EQ(map.parts({-2, 1, -2}, {2, 1, -2}), " 1 to 1;");
}

TEST(HiddenLinesTies, AnEdgeOnAPolygonIsNotHiddenByIt) {
  ScenePen pen;
  // Tiles in one plane that overlap, an edge that ends on a polygon, and one in its plane.
  pen.polygon(square(-4, -4, 8, 0))
      .polygon(square(-1, -1, 2, 0))
      .two_sided(true)
      .polygon({{1, 3, 0}, {3, 3, 0}, {2, 3, 2}});
  const MapScene map(pen, {0, -9, 8});
  EXPECT_EQ(map.parts({-1, -1, 0}, {1, -1, 0}), " 0 to 1;");
  EXPECT_EQ(map.parts({1, 3, 0}, {3, 3, 0}), " 0 to 1;");
  EXPECT_EQ(map.parts({1, 3, 0}, {2, 3, 2}), " 0 to 1;");
}

TEST(HiddenLinesTies, AClosedBoxHidesItsFarEdgesOnce) {
  ScenePen pen;
  pen.box({-2, -2, 0}, {2, 2, 4});
  const MapScene map(pen, {9, 10, 11});
  EXPECT_EQ(map.parts({-2, -2, 0}, {2, -2, 0}), " 1 to 1;");
  EXPECT_EQ(map.parts({-2, -2, 0}, {-2, -2, 4}), " 1 to 1;");
  EXPECT_EQ(map.parts({2, 2, 0}, {2, 2, 4}), " 0 to 1;");
  EXPECT_EQ(map.parts({-2, -2, 4}, {2, -2, 4}), " 0 to 1;") << "the contour";
}

TEST(HiddenLinesTies, CuttingAPolygonChangesNoCount) {
  const auto parts_behind = [](bool cut) {
    ScenePen pen;
    if (cut) {
      pen.polygon({{-2, -2, 4}, {2, -2, 4}, {2, 0, 4}, {-2, 0, 4}})
          .polygon({{-2, 0, 4}, {0, 0, 4}, {0, 2, 4}, {-2, 2, 4}})
          .polygon({{0, 0, 4}, {2, 0, 4}, {2, 2, 4}, {0, 2, 4}});
    } else {
      pen.polygon(square(-2, -2, 4, 4));
    }
    pen.polygon({{0, -8, 0}, {8, -8, 0}, {8, 8, 0}, {0, 8, 0}})
        .polygon({{-8, 0, 1}, {8, 0, 1}, {8, 8, 1}, {-8, 8, 1}})
        .polygon({{-7, -6, 0}, {7, 5, 0}, {-7, 7, 0}});
    const MapScene map(pen, {0, 0, 8});
    return std::vector{map.parts({0, -8, 0}, {0, 8, 0}), map.parts({-8, 0, 1}, {8, 0, 1}),
                       map.parts({-7, -6, 0}, {7, 5, 0})};
  };
  EXPECT_EQ(parts_behind(true), parts_behind(false));
}

TEST(HiddenLinesTies, AnEdgeTowardsTheLightCountsClosedPolygons) {
  ScenePen pen;
  // The edge x = y = 0 runs to the lamp at (0, 0, 8); the squares have an edge or a corner on it.
  pen.two_sided(true)
      .polygon({{0, 0, 0}, {4, 0, 0}, {0, 0, 4}})
      .polygon(square(0, -1, 2, 1))
      .polygon(square(0, 0, 2, 2))
      .polygon(square(-1, -1, 2, 3));
  const MapScene map(pen, {0, 0, 8});
  EXPECT_EQ(map.parts({0, 0, 0}, {0, 0, 4}), " 3 to 1/4; 2 to 1/2; 1 to 3/4; 0 to 1;");
}

TEST(OutlineEdges, AreThoseOfThePolygonAsItIs) {
  // An L is cut into convex parts; its outline is its six edges.
  ScenePen pen;
  pen.polygon({{0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {2, 2, 0}, {2, 4, 0}, {0, 4, 0}})
      .polygon({{0, 0, 0}, {0, -4, 0}, {4, -4, 0}, {4, 0, 0}});
  const MapScene map(pen, {1, 1, 8});
  const std::vector<OutlineEdge> edges =
      outline_edges(map.scene, facing_sides(map.scene, map.scene.lights.back().point));
  EXPECT_GT(map.scene.parts.size(), 2u);
  ASSERT_EQ(edges.size(), 9u);
  const auto shared = std::ranges::count_if(edges, [](const OutlineEdge& edge) {
    return edge.polygons == std::vector<std::uint32_t>{0, 1};
  });
  EXPECT_EQ(shared, 1);
  // From below nothing faces.
  const MapScene below(pen, {1, 1, -8});
  EXPECT_THAT(
      outline_edges(below.scene, facing_sides(below.scene, below.scene.lights.back().point)),
      IsEmpty());
}

TEST(HiddenLines, StopWhenInterrupted) {
  const PreparedScene scene =
      prepare(ScenePen().box({0, 0, 0}, {2, 2, 2}).lamp({5, 6, 7}).take()).value();
  const std::atomic<bool> stop = true;
  HiddenLineOptions options;
  options.interrupted = &stop;
  const auto lines = hidden_lines(scene, scene.lights[0], all_edges(scene), options);
  ASSERT_FALSE(lines);
  EXPECT_EQ(lines.error().code, ErrorCode::kInterrupted);
}

}  // namespace
}  // namespace gnomon
