// SPDX-License-Identifier: GPL-3.0-or-later
// Image spaces: the tie rule by hand, and exact spaces against samples that are really moved.
#ifndef GNOMON_TESTS_KERNEL_IMAGE_SPACE_TEST_H
#define GNOMON_TESTS_KERNEL_IMAGE_SPACE_TEST_H

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "gnomon/scene/camera.h"
#include "kernel/concept/image_space.h"
#include "scene/base/random.h"

namespace gnomon::test {

using Corners = std::vector<std::array<int, 3>>;

inline Position at(const std::array<int, 3>& x) {
  return {Number(x[0]), Number(x[1]), Number(x[2])};
}

/// Loops as two-sided polygons, seen from an eye at integers.
inline PreparedView view_of(const std::vector<Corners>& loops, const std::array<int, 3>& eye,
                            ExactCamera camera) {
  Scene scene;
  for (const Corners& loop : loops) {
    Polygon polygon;
    polygon.id = std::to_string(scene.polygons.size());
    for (const auto& corner : loop) {
      polygon.loop.push_back(static_cast<VertexId>(scene.vertices.size()));
      scene.vertices.push_back(at(corner));
    }
    scene.polygons.push_back(polygon);
  }
  camera.eye = at(eye);
  auto view = prepare_view(std::move(scene), camera);
  EXPECT_TRUE(view) << to_string(view.error());
  return *std::move(view);
}

/// Right, up and forward along x, y and z.
inline ExactCamera along_z(std::uint32_t width = 1, std::uint32_t height = 1) {
  return {{}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, width, height};
}

template <class Space>
class ImageSpaceOf : public testing::Test {};
TYPED_TEST_SUITE_P(ImageSpaceOf);

// E = 0, P: -2x + z = 1, Q: x = 0, d = (0, 0, 1), R = (1, 0, 0): moved to the right the sample is
// in front of Q. P turns around when R takes the place of d in all of the formula.
TYPED_TEST_P(ImageSpaceOf, ATieLeavesThePlaneOfTheSampleAsItIs) {
  const PreparedView view =
      view_of({{{0, -1, 1}, {1, 0, 3}, {0, 1, 1}}, {{0, 0, 1}, {0, 2, 4}, {0, -2, 4}}}, {0, 0, 0},
              along_z());
  ImageFrame frame = view.frame;
  TypeParam space(view.scene.geometry, frame, {});
  PlaneRef q(view.scene.parts[1].plane);
  if (space.side_of_vertex(q, view.scene.loop(view.scene.parts[0])[1]) == Side::kBack) q = -q;
  const PlaneRef p(view.scene.parts[0].plane);
  EXPECT_EQ(space.side_at_sample(q, p, {0, 0}), Sign::kPositive);
  EXPECT_EQ(space.side_at_sample(-q, p, {0, 0}), Sign::kNegative);
  EXPECT_EQ(space.side_at_sample(q, -p, {0, 0}), Sign::kPositive);
  EXPECT_EQ(space.side_at_sample(p, p, {0, 0}), Sign::kZero);
  frame.ties = TieRule::kPlaneTurns;
  TypeParam turning(view.scene.geometry, frame, {});
  EXPECT_EQ(turning.side_at_sample(q, p, {0, 0}), Sign::kNegative);
}

// Two triangles with a common edge through the middle of the picture, and one with an edge along R:
// U decides.
TYPED_TEST_P(ImageSpaceOf, OneOfTwoNeighboursCoversASample) {
  const PreparedView view = view_of({{{0, -3, 4}, {0, 3, 4}, {-3, 0, 4}},
                                     {{0, 3, 4}, {0, -3, 4}, {3, 0, 4}},
                                     {{-3, 0, 5}, {0, 3, 5}, {3, 0, 5}}},
                                    {0, 0, 0}, along_z());
  TypeParam space(view.scene.geometry, view.frame, {});
  const auto edge = [&](std::uint32_t part, std::size_t k) {
    const auto loop = view.scene.loop(view.scene.parts[part]);
    return space.add_ray_plane(ImagePoint::at(loop[k]), ImagePoint::at(loop[(k + 1) % 3]));
  };
  const RayPlaneRef left = edge(0, 0), right = edge(1, 0), below = edge(2, 2);
  EXPECT_EQ(space.covers(left, {0, 0}) * space.covers(right, {0, 0}), Sign::kNegative);
  EXPECT_EQ(space.covers(-left, {0, 0}), space.covers(right, {0, 0}));
  // Moved along R it stays on the edge, moved along U it comes to the side of the third corner.
  const RayPlaneRef other = edge(2, 0);
  EXPECT_EQ(space.covers(below, {0, 0}), space.covers(other, {0, 0}));
}

TYPED_TEST_P(ImageSpaceOf, ARayLeavesAPlaneThatHoldsTheEye) {
  const PreparedView view = view_of({{{0, 0, 0}, {0, 2, 4}, {0, -2, 4}}}, {0, 0, 0}, along_z());
  TypeParam space(view.scene.geometry, view.frame, {});
  const PlaneRef q(view.scene.parts[0].plane);
  EXPECT_EQ(space.side_of_eye(q), Sign::kZero);
  EXPECT_NE(space.heading(q, {0, 0}), Sign::kZero);
  EXPECT_EQ(space.heading(q, {0, 0}), -space.heading(-q, {0, 0}));
}

TYPED_TEST_P(ImageSpaceOf, ShadowPlanesHaveTheInsideInFront) {
  for (const bool directional : {false, true}) {
    // Counter-clockwise seen from above, where the light is.
    const PreparedView view =
        view_of({{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{-9, -9, -8}, {9, -9, -8}, {9, 9, -8}}},
                {1, 1, 9}, along_z());
    TypeParam space(view.scene.geometry, view.frame, {});
    LightPoint light = view.frame.eye;
    if (directional) {
      light.directional = true;
      light.nearest = {0, 0, 1};
      light.grid = {0, 0, 1};
    }
    const ImageLight added = space.add_light(light);
    const auto loop = view.scene.loop(view.scene.parts[0]);
    for (std::size_t k = 0; k < 3; ++k) {
      const PlaneRef plane = space.add_shadow_plane(added, loop[k], loop[(k + 1) % 3]);
      EXPECT_EQ(space.side_of_vertex(plane, loop[(k + 2) % 3]), Side::kFront);
      EXPECT_EQ(space.side_of_vertex(plane, loop[k]), Side::kOn);
      EXPECT_EQ(space.side_of_vertex(plane, view.scene.loop(view.scene.parts[1])[1]),
                k == 0   ? Side::kBack
                : k == 1 ? Side::kFront
                         : Side::kFront)
          << k;
      const PlaneRef support(view.scene.parts[0].plane, view.scene.parts[0].flipped);
      EXPECT_EQ(space.side_of_light(support, added), Sign::kPositive);
    }
  }
}

/// A plane by its coefficients is the same plane as by its points, and is turned as they say.
TYPED_TEST_P(ImageSpaceOf, APlaneOfTheGridIsWhatItsCoefficientsSay) {
  const PreparedView view = view_of(
      {{{-9, -9, 8}, {9, -9, 8}, {9, 9, 10}, {-9, 9, 10}}, {{-1, -3, 4}, {2, 3, 7}, {-2, 2, 5}}},
      {0, 0, 0}, along_z(9, 9));
  TypeParam space(view.scene.geometry, view.frame, {});
  const PlaneRef on(view.scene.parts[0].plane), same(view.scene.parts[1].plane);
  const SupportTriple& triple = view.scene.geometry.planes[same.index()];
  const auto at = [&](VertexId v) {
    const GridPositions& grid = view.scene.geometry.grid;
    return std::array<mpz_class, 3>{grid.at(v, 0), grid.at(v, 1), grid.at(v, 2)};
  };
  const auto a = at(triple.a), b = at(triple.b), c = at(triple.c);
  GridPlane plane;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
    plane.n[k] = (b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]);
    plane.d += plane.n[k] * a[k];
  }
  for (const int factor : {1, 7, -3}) {
    GridPlane scaled = plane;
    for (mpz_class& n : scaled.n) n *= factor;
    scaled.d *= factor;
    const PlaneRef added = space.add_grid_plane(scaled);
    const PlaneRef other = factor > 0 ? same : -same;
    EXPECT_EQ(space.side_of_eye(added), space.side_of_eye(other));
    for (std::uint32_t i = 0; i < 9; ++i) {
      for (std::uint32_t j = 0; j < 9; ++j) {
        EXPECT_EQ(space.side_at_sample(added, on, {i, j}), space.side_at_sample(other, on, {i, j}));
        EXPECT_EQ(space.heading(added, {i, j}), space.heading(other, {i, j}));
      }
    }
    for (const VertexId v : view.scene.loop(view.scene.parts[0])) {
      EXPECT_EQ(space.side_of_vertex(added, v), space.side_of_vertex(other, v));
    }
  }
}

REGISTER_TYPED_TEST_SUITE_P(ImageSpaceOf, APlaneOfTheGridIsWhatItsCoefficientsSay,
                            ATieLeavesThePlaneOfTheSampleAsItIs, OneOfTwoNeighboursCoversASample,
                            ARayLeavesAPlaneThatHoldsTheEye, ShadowPlanesHaveTheInsideInFront);

/// Exact spaces alone: every answer is that of a sample that is moved by 2^-60 of R and 2^-120 of
/// U, in integers.
template <class Space>
class ExactImageSpaceOf : public testing::Test {};
TYPED_TEST_SUITE_P(ExactImageSpaceOf);

using Big3 = std::array<mpz_class, 3>;

inline Big3 moved_direction(const ImageFrame& frame, ImageSample sample) {
  const ImageFrame::Direction d = frame.direction(sample);
  Big3 result;
  for (std::size_t k = 0; k < 3; ++k) {
    result[k] = (mpz_class(static_cast<long>(d[k])) << 120) + (mpz_class(frame.right[k]) << 60) +
                frame.up[k];
  }
  return result;
}
inline Big3 minus(const Big3& a, const Big3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Big3 cross_of(const Big3& a, const Big3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline mpz_class dot_of(const Big3& a, const Big3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

TYPED_TEST_P(ExactImageSpaceOf, AnswersAsTheMovedSampleDoes) {
  Random random(7);
  int ties = 0, asked = 0;
  for (int scene = 0; scene < 60; ++scene) {
    const auto small = [&] {
      return std::array<int, 3>{static_cast<int>(random.between(-2, 2)),
                                static_cast<int>(random.between(-2, 2)),
                                static_cast<int>(random.between(-2, 2))};
    };
    std::vector<Corners> loops;
    while (loops.size() < 4) {
      const Corners loop{small(), small(), small()};
      Big3 a, u, v;
      for (std::size_t k = 0; k < 3; ++k) {
        a[k] = loop[0][k];
        u[k] = loop[1][k] - loop[0][k];
        v[k] = loop[2][k] - loop[0][k];
      }
      if (cross_of(u, v) != Big3{0, 0, 0}) loops.push_back(loop);
    }
    const PreparedView view = view_of(loops, small(), along_z(4, 4));
    const Geometry& geometry = view.scene.geometry;
    TypeParam space(geometry, view.frame, {});
    const auto grid = [&](VertexId v) {
      return Big3{geometry.grid.at(v, 0), geometry.grid.at(v, 1), geometry.grid.at(v, 2)};
    };
    const Big3& eye = view.frame.eye.grid;
    // Far beyond the vertices, so that the grid of all has more bits than theirs; and a sun.
    std::array<LightPoint, 2> lights;
    lights[0].grid = {100, 37, 900};
    lights[1].directional = true;
    lights[1].grid = {2, -1, 3};
    std::array<ImageLight, 2> added{space.add_light(lights[0]), space.add_light(lights[1])};
    const auto normal = [&](PlaneId id) {
      const SupportTriple& t = geometry.planes[id];
      return cross_of(minus(grid(t.b), grid(t.a)), minus(grid(t.c), grid(t.a)));
    };
    const auto at_eye = [&](PlaneId id) {
      return dot_of(normal(id), minus(eye, grid(geometry.planes[id].a)));
    };
    for (std::uint32_t s = 0; s < 16; ++s) {
      const ImageSample sample{s % 4, s / 4};
      const Big3 d = moved_direction(view.frame, sample);
      Big3 plain;
      for (std::size_t k = 0; k < 3; ++k) {
        plain[k] = static_cast<long>(view.frame.direction(sample)[k]);
      }
      for (PlaneId p = 0; p < geometry.planes.size(); ++p) {
        EXPECT_EQ(static_cast<int>(space.side_of_eye(PlaneRef(p))), sgn(at_eye(p)));
        EXPECT_EQ(static_cast<int>(space.heading(PlaneRef(p), sample)), sgn(dot_of(normal(p), d)));
        if (sgn(dot_of(normal(p), plain)) * sgn(at_eye(p)) >= 0) continue;  // not met
        for (PlaneId q = 0; q < geometry.planes.size(); ++q) {
          const mpz_class bracket =
              dot_of(normal(p), d) * at_eye(q) - dot_of(normal(q), d) * at_eye(p);
          ++asked;
          ties += dot_of(normal(p), plain) * at_eye(q) == dot_of(normal(q), plain) * at_eye(p);
          ASSERT_EQ(static_cast<int>(space.side_at_sample(PlaneRef(q), PlaneRef(p), sample)),
                    sgn(bracket) * sgn(dot_of(normal(p), plain)))
              << "scene " << scene << " sample " << s << " planes " << q << " on " << p;
        }
      }
      for (const Part& part : view.scene.parts) {
        const auto loop = view.scene.loop(part);
        for (std::size_t k = 0; k < loop.size(); ++k) {
          const VertexId a = loop[k], b = loop[(k + 1) % loop.size()];
          const RayPlaneRef plane = space.add_ray_plane(ImagePoint::at(a), ImagePoint::at(b));
          const Big3 n = cross_of(minus(grid(b), eye), minus(grid(a), eye));
          ASSERT_EQ(static_cast<int>(space.covers(plane, sample)), sgn(dot_of(n, d)));
          for (std::size_t l = 0; l < 2; ++l) {
            const PlaneRef shadow = space.add_shadow_plane(added[l], a, b);
            const Big3 to_light =
                lights[l].directional ? Big3(lights[l].grid) : minus(lights[l].grid, grid(a));
            const Big3 m = cross_of(to_light, minus(grid(b), grid(a)));
            const mpz_class m_eye = dot_of(m, minus(eye, grid(a)));
            for (PlaneId p = 0; p < geometry.planes.size(); ++p) {
              if (sgn(dot_of(normal(p), plain)) * sgn(at_eye(p)) >= 0) continue;
              const mpz_class bracket = dot_of(normal(p), d) * m_eye - dot_of(m, d) * at_eye(p);
              ASSERT_EQ(static_cast<int>(space.side_at_sample(shadow, PlaneRef(p), sample)),
                        sgn(bracket) * sgn(dot_of(normal(p), plain)))
                  << "light " << l;
            }
            for (const VertexId v : view.scene.loop_vertices) {
              ASSERT_EQ(static_cast<int>(space.side_of_vertex(shadow, v)),
                        sgn(dot_of(m, minus(grid(v), grid(a)))));
            }
            const ImagePoint of = ImagePoint::of(added[l]);
            const Big3 seen =
                lights[l].directional ? Big3(lights[l].grid) : minus(lights[l].grid, eye);
            const RayPlaneRef wedge = space.add_ray_plane(of, ImagePoint::at(a));
            ASSERT_EQ(static_cast<int>(space.covers(wedge, sample)),
                      sgn(dot_of(cross_of(minus(grid(a), eye), seen), d)));
          }
        }
      }
    }
  }
  // The scenes are small so that ties are common.
  EXPECT_GT(ties, asked / 50);
}

REGISTER_TYPED_TEST_SUITE_P(ExactImageSpaceOf, AnswersAsTheMovedSampleDoes);

}  // namespace gnomon::test

#endif  // GNOMON_TESTS_KERNEL_IMAGE_SPACE_TEST_H
