// SPDX-License-Identifier: GPL-3.0-or-later
// Several lights in a pipeline: for each light, the fragments whose set holds it have exactly the
// lit area that the light has alone, on every exact kernel; and the fragments tile every side.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "gnomon/algorithms/shadows.h"
#include "gnomon/scene/generate.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {
namespace {

using Point = std::array<mpq_class, 3>;

/// Twice the vector area: fractions of one plane's areas are ratios of any component.
Point vector_area(const std::vector<Point>& points, std::uint32_t first, std::uint32_t count) {
  Point sum;
  for (std::uint32_t i = 1; i + 1 < count; ++i) {
    Point u, v;
    for (int k = 0; k < 3; ++k) {
      u[k] = points[first + i][k] - points[first][k];
      v[k] = points[first + i + 1][k] - points[first][k];
    }
    for (int k = 0; k < 3; ++k) {
      sum[k] += u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
    }
  }
  return sum;
}

struct SceneCase {
  const char* generator;
  std::map<std::string, std::int64_t> parameters;
  std::uint64_t seed;
};

class Pipeline : public testing::TestWithParam<KernelId> {};

TEST_P(Pipeline, SetsOfLightsAgreeWithEachLightAlone) {
  const std::vector<SceneCase> cases = {{"solids", {}, 1},
                                        {"room", {}, 1},
                                        {"table-chair", {}, 1},
                                        {"lattice", {{"light", 2}}, 3},
                                        {"lattice", {{"light", 2}}, 4},
                                        {"slanted-through", {}, 1},
                                        {"touching-boxes", {{"light", 2}}, 2}};
  for (const SceneCase& item : cases) {
    SCOPED_TRACE(std::string(item.generator) + " " + std::to_string(item.seed));
    const auto scene = generate(item.generator, item.parameters, item.seed);
    ASSERT_TRUE(scene) << to_string(scene.error());
    const auto prepared = prepare(*scene);
    ASSERT_TRUE(prepared) << to_string(prepared.error());
    ShadowOptions options;
    options.kernel.id = GetParam();
    options.output.exact_fractions = true;
    options.output.exact_points = true;
    options.output.combined = true;
    const auto result = compute_shadows(*prepared, options);
    ASSERT_TRUE(result) << to_string(result.error());

    // Area of the whole side and of what each light reaches, as fractions of the part.
    std::map<std::pair<std::uint32_t, Side>, mpq_class> whole;
    std::map<std::tuple<std::uint32_t, Side, std::size_t>, mpq_class> lit;
    for (const CombinedFragment& fragment : result->combined) {
      const Part& part = prepared->parts[fragment.part];
      std::vector<Point> loop;
      for (const VertexId v : prepared->loop(part)) {
        Point p;
        for (int k = 0; k < 3; ++k) {
          p[k] = prepared->geometry.origin[k] +
                 prepared->geometry.step * prepared->geometry.grid.at(v, k);
        }
        loop.push_back(p);
      }
      const Point part_area = vector_area(loop, 0, part.count);
      const Point area = vector_area(result->combined_exact_points, fragment.first, fragment.count);
      const int axis = part_area[0] != 0 ? 0 : part_area[1] != 0 ? 1 : 2;
      // Counter-clockwise seen from the side that it belongs to.
      const int turn = fragment.side == Side::kBack ? -1 : 1;
      const mpq_class fraction = turn * area[axis] / part_area[axis];
      EXPECT_GT(fraction, 0);
      whole[{fragment.part, fragment.side}] += fraction;
      for (std::size_t light = 0; light < result->lights.size(); ++light) {
        if (fragment.lit_by >> light & 1) lit[{fragment.part, fragment.side, light}] += fraction;
      }
    }
    for (const auto& [side, fraction] : whole) EXPECT_EQ(fraction, 1) << "part " << side.first;
    for (std::size_t light = 0; light < result->lights.size(); ++light) {
      const LightResult& own = result->lights[light];
      for (std::size_t i = 0; i < own.parts.size(); ++i) {
        const PartResult& part = own.parts[i];
        const mpq_class combined = lit[{part.part, part.side, light}];
        EXPECT_EQ(combined, own.exact_fractions[i].lit)
            << "part " << part.part << " light " << light;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(ExactKernels, Pipeline,
                         testing::Values(KernelId::kPlane, KernelId::kEpeck, KernelId::kRational),
                         [](const auto& parameter) {
                           return std::string(kernel_info(parameter.param).name);
                         });

TEST(PipelineLimits, TooManyFragmentsIsAnError) {
  const auto scene = generate("quads", {{"n", 100}}, 1);
  ASSERT_TRUE(scene);
  const auto prepared = prepare(*scene);
  ASSERT_TRUE(prepared);
  ShadowOptions options;
  options.method.point = MethodId::kSectors;
  options.limits.fragments = 50;
  const auto result = compute_shadows(*prepared, options);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kLimit);
}

}  // namespace
}  // namespace gnomon
