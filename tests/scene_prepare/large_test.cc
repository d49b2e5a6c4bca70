// SPDX-License-Identifier: GPL-3.0-or-later
// Large scenes are prepared on many threads: the same result on any number of them. And the widths
// of integers that preparation chooses between, each at its last bit and one past it.
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "builder.h"
#include "gnomon/scene/generate.h"
#include "scene/base/random.h"

namespace gnomon::test {
namespace {

Expected<PreparedScene> prepare_on(int threads, const Scene& scene) {
  // More threads than the machine has cores, if need be.
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  return arena.execute([&] { return prepare(scene); });
}

/// The first member that differs, or nothing.
std::string first_difference(const PreparedScene& a, const PreparedScene& b) {
  const Geometry &g = a.geometry, &h = b.geometry;
  if (g.positions != h.positions) return "positions";
  if (g.grid.size() != h.grid.size() || g.grid.bits() != h.grid.bits()) return "grid size";
  for (VertexId v = 0; v < g.grid.size(); ++v) {
    if (grid_point(a, v) != grid_point(b, v)) return "grid";
  }
  if (g.step != h.step || g.origin != h.origin) return "step or origin";
  if (g.edges != h.edges) return "edges";
  const auto same_triple = [](const SupportTriple& s, const SupportTriple& t) {
    return s.a == t.a && s.b == t.b && s.c == t.c;
  };
  if (!std::equal(g.planes.begin(), g.planes.end(), h.planes.begin(), h.planes.end(),
                  same_triple)) {
    return "planes";
  }
  if (a.loop_vertices != b.loop_vertices || a.loop_edges != b.loop_edges) return "loops";
  const auto same_part = [](const Part& s, const Part& t) {
    return s.polygon == t.polygon && s.first == t.first && s.count == t.count &&
           s.plane == t.plane && s.flipped == t.flipped && s.two_sided == t.two_sided &&
           s.casts == t.casts;
  };
  if (!std::equal(a.parts.begin(), a.parts.end(), b.parts.begin(), b.parts.end(), same_part)) {
    return "parts";
  }
  if (a.first_part != b.first_part || a.vertex_of_input != b.vertex_of_input) return "indices";
  const auto same_note = [](const PreparationNote& s, const PreparationNote& t) {
    return s.polygon == t.polygon && s.repair == t.repair && s.detail == t.detail;
  };
  if (!std::equal(a.notes.begin(), a.notes.end(), b.notes.begin(), b.notes.end(), same_note)) {
    return "notes";
  }
  if (a.position_bits != b.position_bits || a.direction_bits != b.direction_bits) return "bits";
  return {};
}

/// Vertices of its own for every corner, in an order that has nothing to do with space.
Scene with_vertices_of_their_own(const Scene& scene) {
  Scene result = scene;
  result.vertices.clear();
  for (Polygon& polygon : result.polygons) {
    for (VertexId& v : polygon.loop) {
      result.vertices.push_back(scene.vertices[v]);
      v = static_cast<VertexId>(result.vertices.size() - 1);
    }
  }
  return result;
}

TEST(Threads, DoNotChangeTheResult) {
  const Scene city = *generate("city", {{"n", 8000}, {"shuffle", 1}}, 1);
  // Quadrilaterals that are not planar, in several runs of polygons: parts and notes must be
  // strung together in order.
  const Scene terrain = *generate("terrain", {{"n", 150}}, 1);
  const Scene soup = with_vertices_of_their_own(terrain);
  for (const Scene* scene : {&city, &terrain, &soup}) {
    SCOPED_TRACE(scene->name);
    const auto alone = prepare_on(1, *scene);
    ASSERT_TRUE(alone) << to_string(alone.error());
    for (const int threads : {2, 3, 8}) {
      const auto together = prepare_on(threads, *scene);
      ASSERT_TRUE(together) << to_string(together.error());
      EXPECT_EQ(first_difference(*alone, *together), "") << threads << " threads";
    }
  }
  // The soup has the terrain's vertices, but for the order of their numbers.
  const auto a = prepare(terrain), b = prepare(soup);
  EXPECT_EQ(a->geometry.positions.size(), 151u * 151u);
  EXPECT_EQ(b->geometry.positions.size(), 151u * 151u);
  EXPECT_EQ(first_flaw(*b, soup), "");
}

TEST(Threads, TheFirstErrorIsReported) {
  Scene scene = *generate("city", {{"n", 8000}}, 1);
  for (const std::size_t p : {9'000u, 17'000u, 39'000u}) {
    auto& loop = scene.polygons[p].loop;
    std::swap(loop[1], loop[2]);  // a bow tie
    const auto id = "'" + scene.polygons[9'000].id + "'";
    for (const int threads : {1, 2, 8}) {
      const auto prepared = prepare_on(threads, scene);
      ASSERT_FALSE(prepared);
      EXPECT_EQ(prepared.error().code, ErrorCode::kGeometry);
      EXPECT_NE(prepared.error().what.find(id), std::string::npos) << prepared.error().what;
    }
  }
  for (const std::size_t p : {30'000u, 5'000u}) {
    scene.polygons[p].loop[3] = static_cast<VertexId>(scene.vertices.size());
    for (const int threads : {1, 2, 8}) {
      const auto prepared = prepare_on(threads, scene);
      ASSERT_FALSE(prepared);
      EXPECT_EQ(prepared.error().code, ErrorCode::kIndex);
      EXPECT_EQ(prepared.error().where.pointer, "/polygons/" + std::to_string(p) + "/loop");
    }
  }
}

/// A grid that needs all of `bits` bits, with polygons as large as it allows: planar and off plane
/// by one unit, in one plane from both sides, tilted in every way.
Scene extreme_scene(unsigned bits, std::uint64_t seed) {
  const mpz_class top = (mpz_class(1) << bits) - 1;
  Random random(seed);
  Scene scene;
  const auto vertex = [&](const Exact3& p) {
    Position position;
    for (std::size_t k = 0; k < 3; ++k) position[k] = Number::from_dyadic(p[k], -20);
    scene.vertices.push_back(position);
    return static_cast<VertexId>(scene.vertices.size() - 1);
  };
  const auto polygon = [&](const std::vector<VertexId>& loop) {
    Polygon polygon;
    polygon.id = std::to_string(scene.polygons.size());
    polygon.loop = loop;
    scene.polygons.push_back(std::move(polygon));
  };
  const auto corner_of_box = [&] {
    Exact3 p;
    for (mpz_class& c : p) c = random.chance(1, 2) ? top : mpz_class(0);
    return p;
  };
  const auto near = [&](Exact3 p) {
    for (mpz_class& c : p) c += (c == 0 ? 1 : -1) * mpz_class(long(random.below(2)));
    return vertex(p);
  };
  polygon({vertex({0, 0, 0}), vertex({top, 0, 0}), vertex({0, top, top})});
  polygon({vertex({0, 0, 0}), vertex({top, 0, 0}), vertex({top, top, top}), vertex({0, top, 0})});
  for (int i = 0; i < 60; ++i) {
    const std::vector<VertexId> loop{near(corner_of_box()), near(corner_of_box()),
                                     near(corner_of_box())};
    polygon(loop);
    polygon({loop[2], loop[1], loop[0]});
  }
  for (int i = 0; i < 20; ++i) {
    // A square seen along axis k, tilted across the box, and the same with a corner off its plane
    // by a unit.
    const auto k = static_cast<std::size_t>(random.below(3)), u = (k + 1) % 3, v = (k + 2) % 3;
    const mpz_class low = static_cast<long>(random.below(2)), high = top - low;
    std::array<Exact3, 4> corners;
    for (std::size_t j = 0; j < 4; ++j) {
      corners[j][u] = j == 1 || j == 2 ? top : mpz_class(0);
      corners[j][v] = j >= 2 ? top : mpz_class(0);
      corners[j][k] = j == 1 || j == 2 ? high : low;
    }
    std::vector<VertexId> loop;
    for (const Exact3& corner : corners) loop.push_back(vertex(corner));
    polygon(loop);
    ++corners[3][k];
    loop[3] = vertex(corners[3]);
    polygon(loop);
  }
  return scene;
}

TEST(Widths, EachAtItsLastBitAndOnePast) {
  // 64 bits hold a quadrilateral's determinants on grids of 19 bits, 128 on 41, 256 on 83.
  for (const unsigned bits :
       {2u, 17u, 18u, 19u, 20u, 21u, 39u, 40u, 41u, 42u, 61u, 62u, 63u, 82u, 83u, 84u, 85u, 130u}) {
    const Scene scene = extreme_scene(bits, bits);
    const auto prepared = prepare(scene);
    ASSERT_TRUE(prepared) << bits << " bits: " << to_string(prepared.error());
    EXPECT_EQ(prepared->position_bits, bits);
    EXPECT_EQ(first_flaw(*prepared, scene), "") << bits << " bits";
    for (std::uint32_t p = 0; p < scene.polygons.size(); ++p) {
      EXPECT_EQ(part_area_sum(*prepared, p), input_area(*prepared, scene, p))
          << bits << " bits, polygon " << p;
    }
    const auto notes =
        std::count_if(prepared->notes.begin(), prepared->notes.end(),
                      [](const PreparationNote& n) { return n.repair == Repair::kNotPlanar; });
    EXPECT_EQ(notes, 21) << bits << " bits";
  }
}

}  // namespace
}  // namespace gnomon::test
