// SPDX-License-Identifier: GPL-3.0-or-later
// Far lamps: what kernel `plane` decides and how much of it by integers must not grow with their
// distance, and shares go over into those of a sun. Counts are the same on every machine, which
// times are not.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "gnomon/algorithms/shadows.h"
#include "gnomon/scene/generate.h"
#include "gnomon/scene/prepare.h"

namespace gnomon::test {
namespace {

constexpr std::array<double, 3> kDirection{0.3, -0.4, 0.87};

/// A city under a lamp that stands 2^k times its size away, or a sun of the same direction.
PreparedScene city(int k, bool sun = false) {
  Scene scene = generate("city", {{"n", 60}}).value();
  Light light;
  light.id = "light";
  light.type = sun ? LightType::kDirectional : LightType::kPoint;
  const std::array<double, 3> middle{100, 80, 0};
  for (std::size_t n = 0; n < 3; ++n) {
    light.position[n] =
        Number(sun ? kDirection[n] : middle[n] + 200 * std::ldexp(kDirection[n], k));
  }
  scene.lights = {light};
  return prepare(scene).value();
}

ShadowResult shadows_of(const PreparedScene& scene, MethodId method, KernelId kernel,
                        bool exact_fractions = false) {
  ShadowOptions options;
  options.method.point = method;
  options.kernel.id = kernel;
  options.output.stage_counts = kernel == KernelId::kPlane;
  options.output.exact_fractions = exact_fractions;
  options.tuning.jobs = 1;
  return compute_shadows(scene, options).value();
}

class FarLamp : public testing::TestWithParam<MethodId> {};

TEST_P(FarLamp, CostsNoMoreThanANearOne) {
  const ShadowResult near = shadows_of(city(8), GetParam(), KernelId::kPlane);
  for (const int k : {14, 20, 36, 50, 51, 53, 100, 200, 500}) {
    const StageCounts far = shadows_of(city(k), GetParam(), KernelId::kPlane).stages;
    EXPECT_LE(static_cast<double>(far.total()), 1.15 * static_cast<double>(near.stages.total()))
        << k;
    EXPECT_LE(static_cast<double>(far.exact()), 1.25 * static_cast<double>(near.stages.exact()))
        << k;
    // What is as wide as the lamp is far: crossings by sectors, a few corners by contour.
    const std::uint64_t wide = far.exact512 + far.exact1024 + far.unbounded;
    EXPECT_LE(static_cast<double>(wide),
              (GetParam() == MethodId::kContour ? 0.003 : 0.06) * static_cast<double>(far.total()))
        << k;
  }
}

TEST_P(FarLamp, IsASunInTheLimit) {
  const ShadowResult sun = shadows_of(city(0, true), GetParam(), KernelId::kPlane);
  for (const KernelId kernel : {KernelId::kPlane, KernelId::kDouble}) {
    for (const int k : {60, 500}) {
      const ShadowResult lamp = shadows_of(city(k), GetParam(), kernel);
      ASSERT_EQ(lamp.lights[0].parts.size(), sun.lights[0].parts.size());
      for (std::size_t i = 0; i < sun.lights[0].parts.size(); ++i) {
        EXPECT_NEAR(lamp.lights[0].parts[i].lit.middle(), sun.lights[0].parts[i].lit.middle(), 1e-9)
            << k << ' ' << i;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, FarLamp, testing::Values(MethodId::kContour, MethodId::kSectors),
                         [](const auto& info) {
                           return std::string(info.param == MethodId::kContour ? "contour"
                                                                               : "sectors");
                         });

TEST(FarLamps, MethodsAgreeToTheLastDigit) {
  for (const int k : {13, 40, 53, 120}) {
    const PreparedScene scene = city(k);
    const ShadowResult by_sectors = shadows_of(scene, MethodId::kSectors, KernelId::kPlane, true);
    for (const auto& [method, kernel] : {std::pair{MethodId::kContour, KernelId::kPlane},
                                         std::pair{MethodId::kContour, KernelId::kRational},
                                         std::pair{MethodId::kSvbsp, KernelId::kPlane}}) {
      const ShadowResult other = shadows_of(scene, method, kernel, true);
      for (std::size_t i = 0; i < scene.parts.size(); ++i) {
        ASSERT_EQ(other.lights[0].exact_fractions[i].lit,
                  by_sectors.lights[0].exact_fractions[i].lit)
            << k << ' ' << i;
      }
    }
  }
}

/// The grid starts at the vertices, not at a lamp far below them, and has their bits.
TEST(FarLamps, LeaveTheGridToTheVertices) {
  const PreparedScene near = city(3), far = city(100);
  EXPECT_LE(far.geometry.grid.bits(), near.geometry.grid.bits());
  EXPECT_TRUE(far.geometry.grid.is_narrow());
  const std::array<mpz_class, 3>& lamp = far.lights[0].point.grid;
  EXPECT_LT(lamp[1], 0);
  for (std::size_t k = 0; k < 3; ++k) {
    const mpq_class at = far.geometry.origin[k] + far.geometry.step * mpq_class(lamp[k]);
    EXPECT_EQ(at.get_d(), far.lights[0].point.nearest[k]);
  }
}

/// A polygon all but edge-on, and so much smaller than the scene that the third component of the
/// difference of two rays underflows unless it is scaled at once.
TEST(FarLamps, SeeSmallPolygonsOfLargeScenes) {
  Scene scene;
  const double wide = 1.2407335761280267e67, thin = 1.349401336733507e-79;
  const auto put = [&](double x, double y, double z) {
    scene.vertices.push_back({Number(x), Number(y), Number(z)});
  };
  put(-wide, 0, 0);
  put(0, 0, 0);
  put(0, 0, 1);
  put(0, thin, 1);
  put(-9.263367138985296e77, 0, -1.8092513943330656e75);
  for (const std::vector<VertexId>& loop :
       {std::vector<VertexId>{0, 1, 3}, std::vector<VertexId>{0, 2, 3},
        std::vector<VertexId>{0, 4, 1}}) {
    Polygon& polygon = scene.polygons.emplace_back();
    polygon.id = std::to_string(scene.polygons.size());
    polygon.loop = loop;
    polygon.two_sided = true;
  }
  Light& lamp = scene.lights.emplace_back();
  lamp.id = "lamp";
  lamp.type = LightType::kPoint;
  lamp.position = {Number(0.0), Number(1.8432038655162537e87), Number(0.0)};
  const PreparedScene prepared = prepare(scene).value();
  const ShadowResult contour = shadows_of(prepared, MethodId::kContour, KernelId::kPlane);
  const ShadowResult sectors = shadows_of(prepared, MethodId::kSectors, KernelId::kRational, true);
  for (std::size_t i = 0; i < prepared.parts.size(); ++i) {
    const Interval& lit = contour.lights[0].parts[i].lit;
    const mpq_class& exact = sectors.lights[0].exact_fractions[i].lit;
    EXPECT_LE(mpq_class(lit.lower), exact) << i;
    EXPECT_GE(mpq_class(lit.upper), exact) << i;
  }
}

}  // namespace
}  // namespace gnomon::test
