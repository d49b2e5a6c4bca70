// SPDX-License-Identifier: GPL-3.0-or-later
// Areas from pairs of doubles are the doubles nearest to what rationals say, ties included.
#include "report/sides/part_area.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "gnomon/scene/generate.h"
#include "gnomon/scene/prepare.h"
#include "kernel/signs/nearest_double.h"

namespace gnomon::report {
namespace {

void expect_nearest(const PreparedScene& scene) {
  const PolygonAreas areas(scene);
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> unit(0, 1);
  for (std::uint32_t polygon = 0; polygon + 1 < scene.first_part.size(); ++polygon) {
    const mpq_class area = precise_area(scene, polygon);
    ASSERT_EQ(areas.nearest(polygon), nearest_double(area)) << polygon;
    for (const double fraction : {unit(engine), unit(engine), 0.5, 0x1p-60, -0.25, 1.0, 0.0}) {
      ASSERT_EQ(areas.nearest(polygon, fraction), nearest_double(fraction * area))
          << polygon << ' ' << fraction;
    }
    const mpq_class third(1, 3);
    ASSERT_EQ(areas.nearest(polygon, third), nearest_double(third * area)) << polygon;
  }
}

PreparedScene prepared(Scene scene) {
  Expected<PreparedScene> result = prepare(scene);
  if (!result) throw std::runtime_error(to_string(result.error()));
  return *std::move(result);
}

using Corner = std::array<double, 3>;

Scene scene_of(const std::vector<std::vector<Corner>>& polygons) {
  Scene scene;
  for (const std::vector<Corner>& corners : polygons) {
    Polygon polygon;
    polygon.id = std::to_string(scene.polygons.size());
    for (const Corner& corner : corners) {
      polygon.loop.push_back(static_cast<VertexId>(scene.vertices.size()));
      scene.vertices.push_back({Number(corner[0]), Number(corner[1]), Number(corner[2])});
    }
    scene.polygons.push_back(std::move(polygon));
  }
  return scene;
}

TEST(PolygonAreas, OfGeneratedScenes) {
  for (const char* name : {"quads", "city", "lattice", "needles", "grazing", "comb"}) {
    const Expected<Scene> scene = generate(name, {}, 5);
    ASSERT_TRUE(scene) << name;
    expect_nearest(prepared(*scene));
  }
}

TEST(PolygonAreas, OfCoordinatesOfEveryWidth) {
  std::mt19937_64 engine(11);
  std::uniform_real_distribution<double> unit(-1, 1);
  // 53 bits need integers of 128 bits, numbers of many magnitudes rationals.
  for (const int spread : {0, 10, 60, 200}) {
    std::vector<std::vector<Corner>> polygons;
    for (int i = 0; i < 60; ++i) {
      std::vector<Corner> corners(3);
      const int exponent = spread == 0 ? 0 : static_cast<int>(engine() % spread) - spread / 2;
      for (Corner& corner : corners) {
        for (double& x : corner) x = std::ldexp(unit(engine), exponent);
      }
      polygons.push_back(corners);
    }
    expect_nearest(prepared(scene_of(polygons)));
  }
}

TEST(PolygonAreas, TiesAreDecidedByRationals) {
  // Areas of 2^53 + 1 and 2^53 + 3: halfway between two doubles, to the even one.
  constexpr double kSide = 0x1p27;
  const PreparedScene scene = prepared(scene_of({
      {{0, 0, 0}, {0x1p26, 0, 0}, {0x1p26, kSide, 0}, {1, kSide, 0}, {0, kSide + 1, 0}},
      {{0, 0, 1}, {3, 0, 1}, {3, 3002399751580331, 1}, {0, 3002399751580331, 1}},
      {{0, 0, 2}, {1, 0, 2}, {1, 9007199254740993.0 - 1, 2}, {0, 9007199254740993.0 + 1, 2}},
  }));
  const PolygonAreas areas(scene);
  EXPECT_EQ(precise_area(scene, 1), mpq_class("9007199254740993"));
  EXPECT_EQ(areas.nearest(1), 9007199254740992.0);
  expect_nearest(scene);
}

TEST(PolygonAreas, FarFromOne) {
  for (const int exponent : {-1000, -500, -460, -400, 400, 460, 500}) {
    const double unit = std::ldexp(1.0, exponent);
    expect_nearest(prepared(scene_of({{{0, 0, 0}, {unit, 0, unit}, {unit, 3 * unit, 2 * unit}},
                                      {{0, 0, 0}, {unit, 0, 0}, {0, unit, 0}}})));
  }
}

}  // namespace
}  // namespace gnomon::report
