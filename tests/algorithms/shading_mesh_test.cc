// SPDX-License-Identifier: GPL-3.0-or-later
// What shading_mesh.h promises, checked by brute force on exact rationals.
#include "gnomon/algorithms/shading_mesh.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "gnomon/algorithms/shadows.h"
#include "gnomon/scene/read.h"

namespace gnomon {
namespace {

using Rational = std::array<mpq_class, 3>;

/// An L-shaped floor (two parts), a wall that stands on it and shares an edge with it, a slanted
/// sheet that is lit from both sides, a table top, a panel and a lamp.
constexpr const char* kRoom = R"({"format": "gnomon-scene", "version": 1,
  "vertices": [[0,0,0],[8,0,0],[8,3,0],[3,3,0],[3,8,0],[0,8,0],
               [0,0,5],[0,8,5],
               [1,1,2],[3,1,2],[3,2.5,2],[1,2.5,2],
               [5,0.5,0],[7,1,3],[6,2,2.5]],
  "polygons": [{"id": "floor", "loop": [0,1,2,3,4,5]},
               {"id": "wall", "loop": [0,5,7,6]},
               {"id": "top", "loop": [8,9,10,11], "two_sided": true},
               {"id": "sheet", "loop": [12,13,14], "two_sided": true}],
  "lights": [{"id": "panel", "type": "area", "loop": [[2,2,4],[2,3,4],[3,3,4],[3,2,4]]},
             {"id": "lamp", "type": "point", "position": [6.5,2.5,4.5]},
             {"id": "strip", "type": "area", "loop": [[6,1,4],[6,2,4.25],[6.5,2,4.25]]}]})";

struct Solved {
  PreparedScene prepared;
  ShadowResult result;
};

Solved solve(const char* text, std::vector<std::uint32_t> lights) {
  auto read = parse_scene(text, "room.json");
  EXPECT_TRUE(read) << (read ? "" : to_string(read.error()));
  auto prepared = prepare(read->scene);
  EXPECT_TRUE(prepared);
  ShadowOptions options;
  options.lights = lights;
  options.output.exact_points = true;
  options.output.combined = lights.size() > 1;
  auto result = compute_shadows(*prepared, options);
  EXPECT_TRUE(result) << (result ? "" : to_string(result.error()));
  return {*std::move(prepared), *std::move(result)};
}

PointShade bright(const ShadeRequest& asked) {
  const double x = asked.point[0].get_d() - 2.5, y = asked.point[1].get_d() - 2.5,
               z = asked.point[2].get_d() - 4;
  return {(asked.unobstructed ? 2.0 : 1.0) * (asked.light + 1) / (1 + x * x + y * y + z * z),
          1e-12};
}

ShadingMesh mesh_of(const Solved& solved, const ShadingOptions& options,
                    const ShadeFunction& shade = bright) {
  auto mesh = make_shading_mesh(solved.prepared, solved.result, shade, options);
  EXPECT_TRUE(mesh) << (mesh ? "" : to_string(mesh.error()));
  return *std::move(mesh);
}

ShadingOptions with_grid(const char* lit, const char* penumbra) {
  ShadingOptions options;
  options.lit_step = mpq_class(lit);
  options.penumbra_step = mpq_class(penumbra);
  return options;
}

Rational operator-(const Rational& a, const Rational& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Rational cross(const Rational& a, const Rational& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
mpq_class dot(const Rational& a, const Rational& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

std::vector<Rational> rationals(const ShadingMesh& mesh) {
  std::vector<Rational> points;
  for (const ExactPoint& point : mesh.exact_points) points.push_back(point.rational());
  return points;
}

/// The sum of cross products round a loop: twice its area along its normal.
Rational area_vector(const std::vector<Rational>& loop) {
  Rational sum;
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    const Rational n = cross(loop[i] - loop[0], loop[i + 1] - loop[0]);
    for (std::size_t k = 0; k < 3; ++k) sum[k] += n[k];
  }
  return sum;
}

std::vector<Rational> part_loop(const PreparedScene& scene, std::uint32_t part) {
  std::vector<Rational> loop;
  for (const VertexId vertex : scene.loop(scene.parts[part])) {
    Rational point;
    for (int k = 0; k < 3; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      point[axis] =
          scene.geometry.origin[axis] + scene.geometry.step * scene.geometry.grid.at(vertex, k);
    }
    loop.push_back(point);
  }
  return loop;
}

/// Vertices of a face of the same plane, inside an edge of another, that the other lacks.
std::size_t t_vertices(const ShadingMesh& mesh, const PreparedScene& scene) {
  const std::vector<Rational> points = rationals(mesh);
  std::map<PlaneId, std::set<std::uint32_t>> vertices;
  for (const MeshFace& face : mesh.faces) {
    for (const MeshCorner& corner : mesh.loop(face)) {
      vertices[scene.parts[face.part].plane].insert(corner.vertex);
    }
  }
  std::size_t found = 0;
  std::set<std::tuple<PlaneId, std::uint32_t, std::uint32_t>> done;
  for (const MeshFace& face : mesh.faces) {
    const auto loop = mesh.loop(face);
    const PlaneId plane = scene.parts[face.part].plane;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t a = loop[i].vertex, b = loop[(i + 1) % loop.size()].vertex;
      if (!done.emplace(plane, std::min(a, b), std::max(a, b)).second) continue;
      const Rational ab = points[b] - points[a];
      for (const std::uint32_t v : vertices[plane]) {
        if (v == a || v == b) continue;
        // Doubles first: far off the box of the edge is off the edge.
        bool near = true;
        for (std::size_t k = 0; k < 3; ++k) {
          const double x = mesh.points[v][k];
          near = near && x >= std::min(mesh.points[a][k], mesh.points[b][k]) &&
                 x <= std::max(mesh.points[a][k], mesh.points[b][k]);
        }
        if (!near) continue;
        const Rational av = points[v] - points[a];
        const mpq_class along = dot(ab, av);
        if (cross(ab, av) == Rational{} && along > 0 && along < dot(ab, ab)) ++found;
      }
    }
  }
  return found;
}

void check_mesh(const ShadingMesh& mesh, const Solved& solved) {
  const PreparedScene& scene = solved.prepared;
  EXPECT_EQ(t_vertices(mesh, scene), 0u);
  const std::vector<Rational> points = rationals(mesh);
  std::map<std::pair<std::uint32_t, Side>, Rational> areas;
  std::map<std::tuple<std::uint32_t, Side, std::uint32_t, int>, mpq_class> class_areas;
  std::set<Rational> distinct(points.begin(), points.end());
  EXPECT_EQ(distinct.size(), points.size());
  std::vector<bool> used(points.size(), false);
  for (const MeshFace& face : mesh.faces) {
    std::vector<Rational> loop;
    for (const MeshCorner& corner : mesh.loop(face)) {
      loop.push_back(points[corner.vertex]);
      used[corner.vertex] = true;
      EXPECT_EQ(mesh.samples[corner.sample].vertex, corner.vertex);
    }
    const Rational n = area_vector(loop);
    EXPECT_GT(dot(n, n), 0);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Rational& a = loop[i];
      const Rational& b = loop[(i + 1) % loop.size()];
      const Rational& c = loop[(i + 2) % loop.size()];
      EXPECT_GE(dot(cross(b - a, c - b), n), 0) << "not convex";
      EXPECT_NE(a, b);
    }
    Rational& sum = areas[{face.part, face.side}];
    for (std::size_t k = 0; k < 3; ++k) sum[k] += n[k];
    Rational whole = area_vector(part_loop(scene, face.part));
    const mpq_class fraction = abs(dot(n, whole) / dot(whole, whole));
    for (std::uint32_t light = 0; light < mesh.lights.size(); ++light) {
      const int state = (face.lit_by >> light & 1) != 0        ? 0
                        : (face.penumbra_of >> light & 1) != 0 ? 1
                                                               : 2;
      class_areas[{face.part, face.side, light, state}] += fraction;
    }
  }
  EXPECT_EQ(std::count(used.begin(), used.end(), false), 0);
  std::size_t sides = 0;
  for (std::uint32_t part = 0; part < scene.parts.size(); ++part) {
    for (const Side side : {Side::kFront, Side::kBack}) {
      if (side == Side::kBack && !scene.parts[part].two_sided) continue;
      ++sides;
      Rational whole = area_vector(part_loop(scene, part));
      if (side == Side::kBack) {
        for (mpq_class& x : whole) x = -x;
      }
      const Rational found = areas[{part, side}];
      EXPECT_EQ(found, whole) << "part " << part;
    }
  }
  EXPECT_EQ(areas.size(), sides);
}

TEST(ShadingMesh, SidesAreTiledWithoutTVertices) {
  for (const std::vector<std::uint32_t>& lights :
       {std::vector<std::uint32_t>{0}, {1}, {2}, {0, 1, 2}}) {
    SCOPED_TRACE(testing::PrintToString(lights));
    const Solved solved = solve(kRoom, lights);
    check_mesh(mesh_of(solved, {}), solved);
    check_mesh(mesh_of(solved, with_grid("1", "1/2")), solved);
    check_mesh(mesh_of(solved, with_grid("2/3", "3/10")), solved);
    check_mesh(mesh_of(solved, with_grid("0", "7/10")), solved);
  }
}

TEST(ShadingMesh, AdaptiveMeshesHaveNoTVerticesEither) {
  for (const std::vector<std::uint32_t>& lights : {std::vector<std::uint32_t>{0}, {0, 1, 2}}) {
    const Solved solved = solve(kRoom, lights);
    ShadingOptions options;
    options.tolerance = 0.02;
    options.max_depth = 5;
    const ShadingMesh mesh = mesh_of(solved, options);
    EXPECT_GT(mesh.stats.depth, 1u);
    check_mesh(mesh, solved);
  }
}

/// What the shade of every call depended on, and what the mesh makes of it.
TEST(ShadingMesh, VerticesAreComputedOnceByTheRulesOfThePaper) {
  // The sheet lifted off the floor: where it touches, faces have vertices of their own.
  std::string lifted = kRoom;
  lifted.replace(lifted.find("[5,0.5,0]"), 9, "[5,0.5,0.125]");
  const Solved solved = solve(lifted.c_str(), {0, 1, 2});
  const PreparedScene& scene = solved.prepared;
  using Call = std::tuple<std::uint32_t, std::uint32_t, Rational>;  // light, oriented plane, point
  const auto plane_of = [&](std::uint32_t part, Side side) {
    const bool back = scene.parts[part].flipped != (side == Side::kBack);
    return 2 * scene.parts[part].plane + (back ? 1 : 0);
  };
  std::mutex mutex;
  std::map<Call, bool> calls;
  const ShadingMesh mesh = mesh_of(solved, with_grid("1", "1/2"), [&](const ShadeRequest& asked) {
    const std::scoped_lock lock(mutex);
    const Call call(asked.light, plane_of(asked.part, asked.side), asked.point);
    EXPECT_TRUE(calls.emplace(call, asked.unobstructed).second) << "twice";
    return PointShade{asked.unobstructed ? 2.0 : 1.0, 0x1p-30};
  });
  const std::vector<Rational> points = rationals(mesh);
  std::size_t shared_lit_penumbra = 0, shared_with_umbra = 0;
  for (std::uint32_t light = 0; light < 3; ++light) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::array<bool, 3>> nodes;
    std::array<std::uint64_t, 3> corners{};
    const auto state_of = [&](const MeshFace& face) -> std::size_t {
      return (face.lit_by >> light & 1) != 0 ? 0 : (face.penumbra_of >> light & 1) != 0 ? 1 : 2;
    };
    for (const MeshFace& face : mesh.faces) {
      for (const MeshCorner& corner : mesh.loop(face)) {
        nodes[{corner.vertex, plane_of(face.part, face.side)}][state_of(face)] = true;
        ++corners[state_of(face)];
      }
    }
    std::array<std::uint64_t, 3> computed{};
    for (const auto& [node, states] : nodes) {
      const auto call = calls.find(Call(light, node.second, points[node.first]));
      EXPECT_EQ(call != calls.end(), states[0] || states[1]);
      if (call != calls.end()) {
        EXPECT_EQ(call->second, states[0]);
      }
      computed[0] += states[0] ? 1 : 0;
      computed[1] += !states[0] && states[1] ? 1 : 0;
      computed[2] += states[2] ? 1 : 0;
      shared_lit_penumbra += states[0] && states[1] ? 1 : 0;
      shared_with_umbra += states[2] && (states[0] || states[1]) ? 1 : 0;
    }
    for (const MeshFace& face : mesh.faces) {
      for (const MeshCorner& corner : mesh.loop(face)) {
        const auto& states = nodes[{corner.vertex, plane_of(face.part, face.side)}];
        const double expected = state_of(face) == 2 ? 0.0 : states[0] ? 2.0 : 1.0;
        EXPECT_EQ(mesh.values[corner.sample * 3 + light], expected);
      }
    }
    const LightShadingStats& stats = mesh.stats.lights[light];
    EXPECT_EQ(stats.light, light);
    EXPECT_EQ((std::array{stats.lit, stats.penumbra, stats.umbra}), corners);
    EXPECT_EQ(
        (std::array{stats.illuminated_lit, stats.illuminated_penumbra, stats.illuminated_umbra}),
        computed);
    EXPECT_EQ(stats.largest_error, 0x1p-30);
  }
  EXPECT_GT(shared_lit_penumbra, 0u);
  EXPECT_GT(shared_with_umbra, 0u);
}

/// A wall, seen from both sides, in the middle of a floor under a panel: neither side of its foot
/// is dark, and neither has what the other has.
constexpr const char* kFoot = R"({"format": "gnomon-scene", "version": 1,
  "vertices": [[0,0,0],[8,0,0],[8,8,0],[0,8,0],[4,2,0],[4,6,0],[4,6,2],[4,2,2]],
  "polygons": [{"id": "floor", "loop": [0,1,2,3]},
               {"id": "wall", "loop": [4,5,6,7], "two_sided": true}],
  "lights": [{"id": "panel", "type": "area", "loop": [[2.5,3,6],[2.5,5,6],[5,5,6],[5,3,6]]}]})";

TEST(ShadingMesh, TheFootOfAWallHasAValueOnEachSide) {
  const Solved solved = solve(kFoot, {0});
  std::mutex mutex;
  std::set<std::pair<Rational, Rational>> own;
  const ShadeFunction shade = [&](const ShadeRequest& asked) {
    if (asked.inwards == nullptr) return PointShade{1, 0};
    const std::scoped_lock lock(mutex);
    EXPECT_FALSE(asked.unobstructed);
    EXPECT_EQ(asked.point[0], 4);
    EXPECT_TRUE(own.emplace(asked.point, *asked.inwards).second) << "twice";
    return PointShade{asked.inwards->front() < 4 ? 3.0 : 2.0, 0};
  };
  ShadingOptions options = with_grid("1", "1/2");
  for (const double tolerance : {0.0, 0.05}) {
    own.clear();
    options.tolerance = tolerance;
    options.max_depth = 2;
    const ShadingMesh mesh = mesh_of(solved, options, shade);
    check_mesh(mesh, solved);
    EXPECT_FALSE(own.empty());
    std::array<std::size_t, 2> feet{};
    for (const MeshFace& face : mesh.faces) {
      if (face.part != 0 || face.penumbra_of == 0) continue;
      double mean = 0;
      for (const MeshCorner& corner : mesh.loop(face)) {
        mean += mesh.points[corner.vertex][0] / face.count;
      }
      for (const MeshCorner& corner : mesh.loop(face)) {
        const auto& point = mesh.points[corner.vertex];
        const bool at_foot = point[0] == 4 && point[1] >= 2 && point[1] <= 6;
        EXPECT_EQ(mesh.values[corner.sample], !at_foot ? 1 : mean < 4 ? 3 : 2);
        if (at_foot) ++feet[mean < 4 ? 0 : 1];
      }
    }
    EXPECT_GT(feet[0], 0u);
    EXPECT_GT(feet[1], 0u);
  }
}

TEST(ShadingMesh, ShadeIsTheAmbientTermAndAllLights) {
  const Solved solved = solve(kRoom, {0, 1, 2});
  ShadingOptions options;
  options.ambient = 0.25;
  const ShadingMesh mesh = mesh_of(solved, options);
  for (std::uint32_t s = 0; s < mesh.samples.size(); ++s) {
    EXPECT_DOUBLE_EQ(mesh.shade(s),
                     0.25 + mesh.values[3 * s] + mesh.values[3 * s + 1] + mesh.values[3 * s + 2]);
  }
}

TEST(ShadingMesh, DoesNotDependOnTheThreads) {
  const Solved solved = solve(kRoom, {0, 1, 2});
  ShadingOptions options = with_grid("1", "1/2");
  options.tolerance = 0.01;
  options.max_depth = 3;
  std::vector<ShadingMesh> meshes;
  for (const std::size_t threads : {1, 2, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    meshes.push_back(mesh_of(solved, options));
  }
  for (const ShadingMesh& mesh : meshes) {
    EXPECT_EQ(mesh.exact_points, meshes[0].exact_points);
    EXPECT_EQ(mesh.points, meshes[0].points);
    EXPECT_EQ(mesh.values, meshes[0].values);
    ASSERT_EQ(mesh.faces.size(), meshes[0].faces.size());
    ASSERT_EQ(mesh.corners.size(), meshes[0].corners.size());
    for (std::size_t c = 0; c < mesh.corners.size(); ++c) {
      EXPECT_EQ(mesh.corners[c].vertex, meshes[0].corners[c].vertex);
      EXPECT_EQ(mesh.corners[c].sample, meshes[0].corners[c].sample);
    }
  }
}

TEST(ShadingMesh, PointsAreTheNearestDoubles) {
  const Solved solved = solve(kRoom, {0});
  const ShadingMesh mesh = mesh_of(solved, with_grid("1/3", "1/7"));
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    const Rational exact = mesh.exact_points[p].rational();
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = mesh.points[p][k];
      const mpq_class error = abs(exact[k] - mpq_class(x));
      for (const double other : {std::nextafter(x, -INFINITY), std::nextafter(x, INFINITY)}) {
        EXPECT_LE(error, abs(exact[k] - mpq_class(other)));
      }
    }
  }
}

TEST(ShadingMesh, AdaptiveSubdivisionConverges) {
  const Solved solved = solve(kRoom, {0});
  std::size_t before = 0;
  double before_error = INFINITY;
  for (const double tolerance : {0.1, 0.03, 0.01}) {
    ShadingOptions options;
    options.tolerance = tolerance;
    options.max_depth = 9;
    const ShadingMesh mesh = mesh_of(solved, options);
    EXPECT_GT(mesh.faces.size(), before);
    before = mesh.faces.size();
    double largest = 0, worst = 0;
    for (const double value : mesh.values) largest = std::max(largest, value);
    for (const MeshFace& face : mesh.faces) {
      if (face.lit_by == 0) continue;  // the stand-in jumps where the penumbra begins
      const auto loop = mesh.loop(face);
      for (const auto& [a, b, c] : triangulate(mesh, face)) {
        Rational centre;
        double mean = 0;
        for (const std::uint32_t corner : {a, b, c}) {
          const Rational point = mesh.exact_points[loop[corner].vertex].rational();
          for (std::size_t k = 0; k < 3; ++k) centre[k] += point[k] / 3;
          mean += mesh.values[loop[corner].sample] / 3;
        }
        worst = std::max(
            worst, std::fabs(bright({0, 0, Side::kFront, centre, true, nullptr}).value - mean));
      }
    }
    EXPECT_LE(worst, 2 * tolerance * largest);
    EXPECT_LT(worst, before_error);
    before_error = worst;
  }
}

TEST(ShadingMesh, WhatIsLinearIsNotCut) {
  const Solved solved = solve(kRoom, {0});
  ShadingOptions options;
  options.tolerance = 1e-6;
  const ShadingMesh mesh = mesh_of(solved, options, [](const ShadeRequest& asked) {
    return PointShade{3 + asked.point[0].get_d() + asked.point[1].get_d() / 2, 0};
  });
  EXPECT_EQ(mesh.stats.faces, mesh.stats.fragments);
  EXPECT_EQ(mesh.stats.depth, 0u);
}

TEST(ShadingMesh, TrianglesCoverFacesWithoutSlivers) {
  const Solved solved = solve(kRoom, {0, 1, 2});
  for (const ShadingMesh& mesh : {mesh_of(solved, {}), mesh_of(solved, with_grid("1", "3/10"))}) {
    const std::vector<Rational> points = rationals(mesh);
    std::size_t with_collinear_corners = 0;
    for (const MeshFace& face : mesh.faces) {
      const auto loop = mesh.loop(face);
      const auto triangles = triangulate(mesh, face);
      EXPECT_EQ(triangles.size(), loop.size() - 2);
      std::vector<Rational> all;
      for (const MeshCorner& corner : loop) all.push_back(points[corner.vertex]);
      const Rational n = area_vector(all);
      for (std::size_t i = 0; i < all.size(); ++i) {
        const Rational ab = all[(i + 1) % all.size()] - all[i];
        const Rational bc = all[(i + 2) % all.size()] - all[(i + 1) % all.size()];
        with_collinear_corners += cross(ab, bc) == Rational{} ? 1 : 0;
      }
      Rational sum;
      std::set<std::uint32_t> used;
      for (const auto& triangle : triangles) {
        const Rational part = area_vector({all[triangle[0]], all[triangle[1]], all[triangle[2]]});
        EXPECT_GT(dot(part, n), 0);
        for (std::size_t k = 0; k < 3; ++k) sum[k] += part[k];
        used.insert(triangle.begin(), triangle.end());
      }
      EXPECT_EQ(sum, n);
      EXPECT_EQ(used.size(), loop.size());
    }
    EXPECT_GT(with_collinear_corners, 10u);
  }
}

TEST(ShadingMesh, LinesAreWhereTheDoublesOfASceneAre) {
  constexpr const char* kTenths = R"({"format": "gnomon-scene", "version": 1,
    "vertices": [[0.3,0.1,0],[0.8,0.1,0],[0.8,0.7,0],[0.3,0.7,0]],
    "polygons": [{"loop": [0,1,2,3]}],
    "lights": [{"type": "area", "loop": [[0,0,1],[0,1,1],[1,1,1],[1,0,1]]}]})";
  const Solved solved = solve(kTenths, {0});
  ShadingOptions options = with_grid("1/10", "1/10");
  EXPECT_EQ(mesh_of(solved, options).faces.size(), 30u);
  // The nearest doubles of 0.3 and 0.8 are no tenths: slivers beside the border.
  options.round_lines = false;
  EXPECT_GT(mesh_of(solved, options).faces.size(), 30u);
}

TEST(ShadingMesh, Errors) {
  Solved solved = solve(kRoom, {0});
  const auto error_of = [&](const ShadingOptions& options) {
    const auto mesh = make_shading_mesh(solved.prepared, solved.result, bright, options);
    return mesh ? std::string("none") : mesh.error().what;
  };
  ShadingOptions options = with_grid("1/1000000", "1");
  EXPECT_EQ(error_of(options), "the grid cuts the scene into more than 4000000 faces");
  options = with_grid("1/100000000000000", "1");
  EXPECT_EQ(error_of(options), "the grid's step is too small for coordinates this large");
  std::atomic<bool> interrupted = true;
  options = {};
  options.interrupted = &interrupted;
  EXPECT_EQ(error_of(options), "interrupted while shading");
  solved.result.exact = false;
  solved.result.kernel = "double";
  EXPECT_EQ(error_of({}), "kernel double rounds: its fragments do not fit");
  solved.result.exact = true;
  solved.result.lights[0].exact_points.clear();
  EXPECT_EQ(error_of({}),
            "the result has no exact points of fragments that are shared by all lights");
}

}  // namespace
}  // namespace gnomon
