// SPDX-License-Identifier: GPL-3.0-or-later
// What an eye sees: all methods on all exact kernels equal the oracle, whatever casts no shadow;
// and a picture of visible fragments, painted in any order, is the painter's.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "exact_check.h"
#include "fuzz/generate/families.h"
#include "gnomon/algorithms/painters_order.h"
#include "gnomon/scene/generate.h"
#include "method_variants.h"
#include "scene/base/random.h"

namespace gnomon::test {
namespace {

using Vector = std::array<double, 3>;

/// The point lights of the scene become eyes; its other lights go. Every third polygon casts none.
Scene seen(Scene scene) {
  std::erase_if(scene.lights, [](const Light& light) { return !light.is_point(); });
  for (Light& light : scene.lights) light.is_eye = true;
  for (std::size_t i = 0; i < scene.polygons.size(); i += 3) scene.polygons[i].casts = false;
  return scene;
}

class Visible : public testing::TestWithParam<fuzz::Family> {};

TEST_P(Visible, MethodsKernelsAndOracleAgree) {
  if (GetParam().name == "MixedMagnitudes") GTEST_SKIP() << "thousands of digits";
  constexpr unsigned kScenes = 4, kTries = 40;
  unsigned checked = 0;
  for (std::uint64_t seed = 72000; seed < 72000 + kTries && checked < kScenes; ++seed) {
    const auto scene = Case::make(seen(GetParam().make(seed)));
    if (!scene || scene->scene().lights.empty()) continue;
    ++checked;
    ASSERT_EQ(check_methods(*scene), "") << "seed " << seed << "\n" << text_of(scene->scene());
  }
}

INSTANTIATE_TEST_SUITE_P(Families, Visible, testing::ValuesIn(fuzz::families()),
                         [](const auto& info) { return info.param.name; });

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// How far a ray from the eye is inside of a convex piece: positive inside, negative outside.
double depth_inside(const OrderedPiece& piece, const Vector& eye, const Vector& direction) {
  std::vector<Vector> to;
  for (const Vector& point : piece.loop) {
    to.push_back({point[0] - eye[0], point[1] - eye[1], point[2] - eye[2]});
  }
  double least = HUGE_VAL, most = -HUGE_VAL;
  Vector area{};
  for (std::size_t i = 0; i < to.size(); ++i) {
    const Vector normal = cross(to[i], to[(i + 1) % to.size()]);
    const double value =
        dot(normal, direction) / std::sqrt(dot(normal, normal) * dot(direction, direction));
    least = std::min(least, value);
    most = std::max(most, value);
    for (std::size_t k = 0; k < 3; ++k) area[k] += normal[k];
  }
  const double inside = std::max(least, -most);
  const bool is_ahead = dot(area, to[0]) * dot(area, direction) > 0;
  return is_ahead ? inside : std::min(inside, -1.0);
}

/// The part on top where a ray meets the picture; nothing near a border.
std::optional<std::optional<std::uint32_t>> on_top(const std::vector<OrderedPiece>& pieces,
                                                   const Vector& eye, const Vector& direction) {
  constexpr double kNearBorder = 1e-7;
  std::optional<std::uint32_t> top;
  for (const OrderedPiece& piece : pieces) {
    const double inside = depth_inside(piece, eye, direction);
    if (!(std::fabs(inside) > kNearBorder)) return std::nullopt;
    if (inside > 0) top = piece.part;
  }
  return top;
}

std::vector<OrderedPiece> visible_pieces(const PreparedScene& scene, const MethodSelection& method,
                                         Random& random) {
  ShadowOptions options = with_method(options_for(KernelId::kPlane), method);
  options.output.exact_points = options.output.exact_fractions = false;
  options.output.points = true;
  const auto result = compute_shadows(scene, options);
  std::vector<OrderedPiece> pieces;
  if (!result) return pieces;
  const LightResult& eye = result->lights[0];
  for (const PartResult& part : eye.parts) {
    for (std::uint32_t f = 0; f < part.fragment_count; ++f) {
      const Fragment& fragment = eye.fragments[part.first_fragment + f];
      if (fragment.state != LightState::kLit) continue;
      const auto first = eye.points.begin() + fragment.first;
      pieces.push_back({part.part, {first, first + fragment.count}});
    }
  }
  random.shuffle(std::span(pieces));
  return pieces;
}

TEST(VisiblePicture, IsThePaintersInAnyOrder) {
  for (const char* name : {"pinwheel", "crossing-sticks"}) {
    SCOPED_TRACE(name);
    auto scene = generate(name, {}, 3);
    ASSERT_TRUE(scene);
    scene->two_sided = true;
    for (Polygon& polygon : scene->polygons) polygon.two_sided.reset();
    Random random(5);
    const auto& vertices = scene->vertices;
    const auto nearest = [&](std::size_t v) {
      return Vector{vertices[v][0].nearest(), vertices[v][1].nearest(), vertices[v][2].nearest()};
    };
    Vector low = nearest(0), high = nearest(0);
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], nearest(v)[k]);
        high[k] = std::max(high[k], nearest(v)[k]);
      }
    }
    const auto point_in = [&](std::int64_t from, std::int64_t to) {
      Vector point;
      for (std::size_t k = 0; k < 3; ++k) {
        const double share = static_cast<double>(random.between(64 * from, 64 * to)) / 64;
        point[k] = low[k] + share * (high[k] - low[k]);
      }
      return point;
    };
    std::uint64_t judged = 0, covered = 0;
    for (const Vector& eye : {point_in(2, 3), point_in(-2, -1), point_in(0, 1)}) {
      Light light;
      light.id = "eye";
      light.is_eye = true;
      light.position = {Number(eye[0]), Number(eye[1]), Number(eye[2])};
      scene->lights = {light};
      const auto prepared = prepare(*scene);
      ASSERT_TRUE(prepared);
      const std::vector<OrderedPiece> painted = back_to_front(*prepared, eye);
      for (const MethodSelection& method : method_variants()) {
        if (!method_info(method.id).makes_fragments) continue;
        if (method.values.cover == Cover::kOverlay) continue;  // lit is not told
        SCOPED_TRACE(text_of(method));
        const std::vector<OrderedPiece> visible = visible_pieces(*prepared, method, random);
        ASSERT_FALSE(visible.empty());
        for (int i = 0; i < 200; ++i) {
          const Vector target = point_in(0, 1);
          Vector direction;
          for (std::size_t k = 0; k < 3; ++k) direction[k] = target[k] - eye[k];
          if (dot(direction, direction) == 0) continue;
          const auto expected = on_top(painted, eye, direction);
          const auto found = on_top(visible, eye, direction);
          if (!expected || !found) continue;
          ++judged;
          covered += expected->has_value();
          ASSERT_EQ(*expected, *found);
        }
      }
    }
    EXPECT_GT(judged, 5000u);
    EXPECT_GT(covered, 500u);
  }
}

}  // namespace
}  // namespace gnomon::test
