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

}  // namespace
}  // namespace gnomon::test
