// SPDX-License-Identifier: GPL-3.0-or-later
// What the sectors algorithm asks of a light space (SectorSpaceModel), on every kernel: sides of
// support planes, cuts of one support plane by another, charts, forks. Vertices are input vertices
// and crossings with cuts; the truth is found in rationals from the kernel's own exact positions.
//
// One body; sources instantiate it with the kernels that they can compile (epeck needs CGAL's
// compiler flags, hence its own program).
#ifndef GNOMON_TESTS_KERNEL_SECTOR_SPACE_TEST_H
#define GNOMON_TESTS_KERNEL_SECTOR_SPACE_TEST_H

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <thread>
#include <type_traits>
#include <vector>

#include "kernel/concept/kernel_concept.h"
#include "kernel/coordinate/coordinate_space.h"
#include "triangle_soup.h"

namespace gnomon::test {

/// A triangle in light space, counter-clockwise seen from the light.
template <class Space>
struct Loop {
  std::vector<typename Space::Vertex> vertices;
  std::vector<PlaneRef> edges;
  PlaneId support = 0;

  LoopView<typename Space::Vertex> view() const { return {vertices, edges, support, 0}; }

  /// Requires: the light is not in the triangle's plane.
  static Loop import(const TriangleSoup& soup, typename Space::SceneSpace& scene, Space& space,
                     std::uint32_t triangle) {
    Loop loop;
    loop.support = triangle;
    const bool reversed = space.light_side(triangle) == Sign::kNegative;
    for (std::uint32_t i = 0; i < 3; ++i) {
      const VertexId v = soup.loop(triangle)[reversed ? 2 - i : i];
      loop.vertices.push_back(space.import_vertex(scene.input_vertex(v)));
    }
    for (std::uint32_t i = 0; i < 3; ++i) {
      const PlaneRef edge = soup.edge(triangle, reversed ? (4 - i) % 3 : i);
      const auto& from = loop.vertices[i];
      const auto& to = loop.vertices[(i + 1) % 3];
      const PlaneRef plane = space.import_edge(scene.edges().of_edge(edge.index(), edge.flipped()),
                                               triangle, reversed, from, to);
      loop.edges.push_back(space.shadow_plane(plane, from, to));
    }
    return loop;
  }

  std::vector<Side> sides(Space& space, PlaneRef plane) const {
    std::vector<Side> result;
    for (std::uint32_t i = 0; i < view().size(); ++i) {
      result.push_back(space.side_of_plane(plane, view().corner(i)));
    }
    return result;
  }

  /// What is in front of the plane.
  Loop clipped(Space& space, PlaneRef plane, const std::vector<Side>& side) const {
    Loop result;
    result.support = support;
    const LoopView<typename Space::Vertex> loop = view();
    for (std::uint32_t i = 0; i < loop.size(); ++i) {
      const Side here = side[i], there = side[loop.next(i)];
      if (here != Side::kBack) {
        result.vertices.push_back(vertices[i]);
        result.edges.push_back(here == Side::kOn && there == Side::kBack ? plane : edges[i]);
      }
      if (here != Side::kOn && there == opposite(here)) {
        result.vertices.push_back(space.crossing(plane, edges[i], here == Side::kFront,
                                                 loop.corner(i), loop.corner(loop.next(i))));
        result.edges.push_back(here == Side::kFront ? plane : edges[i]);
      }
    }
    return result;
  }
};

/// Position in grid units.
template <class Space>
Rationals grid_position(const Space& space, const Geometry& geometry,
                        const Corner<typename Space::Vertex>& corner) {
  Rationals x = space.exact_position(corner);
  for (std::size_t k = 0; k < 3; ++k) x[k] = (x[k] - geometry.origin[k]) / geometry.step;
  return x;
}

inline bool meet_in_line(const TriangleSoup& soup, PlaneId a, PlaneId b) {
  const auto normal = [&](PlaneId plane) {
    const SupportTriple& t = soup.geometry().planes[plane];
    return cross(minus(soup.at(t.b), soup.at(t.a)), minus(soup.at(t.c), soup.at(t.a)));
  };
  return cross(normal(a), normal(b)) != Integers{0, 0, 0};
}

template <class Space>
class SectorSpace : public testing::Test {
 public:
  using SceneSpace = typename Space::SceneSpace;
  static constexpr bool kExact = Space::kExact;
  static constexpr KernelOptions kOptions{.identity = true, .thickness = 0};
  /// Bits of soups on which even float decides about input vertices exactly: 3 b + 2 <= 24.
  static std::vector<unsigned> sizes() {
    return kExact ? std::vector<unsigned>{3, 7, 20, 21, 53, 62, 63, 200}
                  : std::vector<unsigned>{3, 7};
  }
  /// Of steps for which the kernel holds 21-bit positions without rounding: the last are subnormal.
  static std::vector<int> exponents() {
    if (kExact) return {-3000, -1200, -1074, -1040, -1000, -600, 500, 960, 1000, 1100, 3000};
    if (std::is_same_v<Space, CoordinateLightSpace<float>>) return {-149, -130, -100, 50, 100};
    return {-1074, -1060, -1030, -1000, -600, 500, 960, 1002};
  }
};
TYPED_TEST_SUITE_P(SectorSpace);

TYPED_TEST_P(SectorSpace, ModelsTheConcept) { static_assert(SectorSpaceModel<TypeParam>); }

TYPED_TEST_P(SectorSpace, SidesOfSupportPlanesAreTrue) {
  using Space = TypeParam;
  Random random(1);
  int zeros = 0, made = 0;
  for (const unsigned bits : TestFixture::sizes()) {
    for (const SoupKind kind : kSoupKinds) {
      for (int round = 0; round < 8; ++round) {
        const TriangleSoup soup = random_soup(random, kind, bits, 5);
        const Geometry& geometry = soup.geometry();
        typename Space::SceneSpace scene(geometry, TestFixture::kOptions);
        Space space(scene, small_light(random, geometry, bits, round % 2 == 0),
                    TestFixture::kOptions);
        const auto check = [&](const Loop<Space>& loop) {
          const auto view = loop.view();
          for (std::uint32_t i = 0; i < view.size(); ++i) {
            const bool input = view.vertices[i].source != kMadeVertex;
            if (!input && !Space::kExact) continue;
            made += input ? 0 : 1;
            const Rationals x = grid_position(space, geometry, view.corner(i));
            for (PlaneId plane = 0; plane < soup.size(); ++plane) {
              const int truth = sgn(soup.value(plane, x));
              zeros += truth == 0 ? 1 : 0;
              ASSERT_EQ(static_cast<int>(space.side_of_support(plane, view.corner(i))), truth)
                  << bits << " bits, plane " << plane << ", triangle " << loop.support;
            }
          }
        };
        for (std::uint32_t i = 0; i < soup.size(); ++i) {
          if (space.light_side(i) == Sign::kZero) continue;
          const Loop<Space> loop = Loop<Space>::import(soup, scene, space, i);
          check(loop);
          for (PlaneId j = 0; j < soup.size(); ++j) {
            if (!meet_in_line(soup, i, j)) continue;
            const PlaneRef cut = space.cut_of_supports(i, j);
            const std::vector<Side> sides = loop.sides(space, cut);
            check(loop.clipped(space, cut, sides));
          }
        }
        if (this->HasFatalFailure()) return;
      }
    }
  }
  EXPECT_GT(zeros, 0);
  EXPECT_EQ(made > 0, Space::kExact);
}

TYPED_TEST_P(SectorSpace, CutsAreOnBothSupportPlanes) {
  using Space = TypeParam;
  Random random(2);
  int crossings = 0;
  for (const unsigned bits : TestFixture::sizes()) {
    for (const SoupKind kind : kSoupKinds) {
      for (int round = 0; round < 8; ++round) {
        const TriangleSoup soup = random_soup(random, kind, bits, 5);
        const Geometry& geometry = soup.geometry();
        typename Space::SceneSpace scene(geometry, TestFixture::kOptions);
        Space space(scene, small_light(random, geometry, bits, round % 2 == 0),
                    TestFixture::kOptions);
        for (std::uint32_t i = 0; i < soup.size(); ++i) {
          if (space.light_side(i) == Sign::kZero) continue;
          const Loop<Space> loop = Loop<Space>::import(soup, scene, space, i);
          for (PlaneId j = 0; j < soup.size(); ++j) {
            if (!meet_in_line(soup, i, j)) continue;
            for (const bool flipped : {false, true}) {
              const PlaneRef plane = space.cut_of_supports(i, j);
              const PlaneRef cut = flipped ? -plane : plane;
              const std::vector<Side> sides = loop.sides(space, cut);
              for (std::uint32_t k = 0; k < 3; ++k) {
                const Side side = space.side_of_support(j, loop.view().corner(k));
                ASSERT_EQ(sides[k], flipped ? opposite(side) : side);
              }
              const Loop<Space> piece = loop.clipped(space, cut, sides);
              const auto view = piece.view();
              for (std::uint32_t k = 0; k < view.size(); ++k) {
                const auto corner = view.corner(k);
                ASSERT_EQ(space.side_of_support(i, corner), Side::kOn);
                if (!corner.before.same_plane(cut) && !corner.after.same_plane(cut)) continue;
                ASSERT_EQ(space.side_of_support(j, corner), Side::kOn);
                ASSERT_EQ(space.side_of_plane(cut, corner), Side::kOn);
                // Another cut of the same two planes is the same plane.
                ASSERT_EQ(space.side_of_plane(space.cut_of_supports(i, j), corner), Side::kOn);
                if (view.vertices[k].source != kMadeVertex) continue;
                ++crossings;
                if constexpr (Space::kExact) {
                  const Rationals x = grid_position(space, geometry, corner);
                  ASSERT_EQ(sgn(soup.value(i, x)), 0);
                  ASSERT_EQ(sgn(soup.value(j, x)), 0);
                }
              }
            }
          }
        }
        if (this->HasFatalFailure()) return;
      }
    }
  }
  EXPECT_GT(crossings, 100);
}

TYPED_TEST_P(SectorSpace, EdgePlanesAreTheEdges) {
  using Space = TypeParam;
  Random random(3);
  const TriangleSoup soup = random_soup(random, SoupKind::kFull, 7, 12);
  const auto edges = static_cast<EdgeId>(soup.geometry().edges.size());
  typename Space::SceneSpace scene(soup.geometry(), TestFixture::kOptions);
  const LightPoint light = small_light(random, soup.geometry(), 7, false);
  Space ahead(scene, light, TestFixture::kOptions), lazy(scene, light, TestFixture::kOptions);
  ahead.make_edge_planes(edges / 2, edges);
  ahead.make_edge_planes(0, edges / 2);
  Space fork = ahead.fork();
  for (std::uint32_t i = 0; i < soup.size(); ++i) {
    if (ahead.light_side(i) == Sign::kZero) continue;
    const Loop<Space> from_fork = Loop<Space>::import(soup, scene, fork, i);
    const Loop<Space> made = Loop<Space>::import(soup, scene, lazy, i);
    for (std::uint32_t k = 0; k < 3; ++k) {
      // Interior in front, and the plane is the edge's, made ahead or not.
      EXPECT_EQ(from_fork.sides(fork, from_fork.edges[k]), made.sides(lazy, made.edges[k]));
      EXPECT_EQ(from_fork.sides(fork, from_fork.edges[k])[(k + 2) % 3], Side::kFront);
      EXPECT_LT(from_fork.edges[k].index(), edges);
    }
  }
  EXPECT_EQ(fork.plane_mark(), ahead.plane_mark());
}

TYPED_TEST_P(SectorSpace, ForksAreIndependentAndPlanesAreAStack) {
  using Space = TypeParam;
  // A triangle in z = 0 seen from (1, 1, 4); planes x = 1 and y = 1 through the light.
  const TriangleSoup soup(
      {{{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}}}, {{{1, 0, 0}, {1, 3, 0}, {1, 0, 3}}}}, 0);
  typename Space::SceneSpace scene(soup.geometry(), TestFixture::kOptions);
  Space space(scene, light_at(soup.geometry(), {1, 1, 4}, false), TestFixture::kOptions);
  space.make_edge_planes(0, static_cast<EdgeId>(soup.geometry().edges.size()));
  const Loop<Space> loop = Loop<Space>::import(soup, scene, space, 0);
  const PrefixPlane x_below{{1, 0, 0}}, y_below{{0, 1, 0}};  // q_x = 1 - x > 0, q_y = 1 - y > 0
  const std::vector<Side> by_x{Side::kFront, Side::kBack, Side::kFront},
      by_y{Side::kFront, Side::kFront, Side::kBack},
      by_cut{Side::kFront, Side::kBack, Side::kFront};

  const PlaneRef shared = space.add_prefix_plane(x_below);
  ASSERT_EQ(loop.sides(space, shared), by_x);
  Space fork = space.fork();
  EXPECT_EQ(fork.plane_mark(), space.plane_mark());
  EXPECT_EQ(loop.sides(fork, shared), by_x);

  const std::uint32_t mark = space.plane_mark();
  const PlaneRef own = space.add_prefix_plane(x_below);
  const PlaneRef forks = fork.add_prefix_plane(y_below);
  EXPECT_EQ(own, forks);  // each has its own numbers
  EXPECT_EQ(loop.sides(space, own), by_x);
  EXPECT_EQ(loop.sides(fork, forks), by_y);

  space.release_planes(mark);
  EXPECT_EQ(space.plane_mark(), mark);
  EXPECT_EQ(space.add_prefix_plane(y_below), own);
  EXPECT_EQ(loop.sides(space, own), by_y);
  space.release_planes(mark);
  // Plane 1 is x = 1 with its front at x > 1: (1,3,0)-(1,0,0) x (1,0,3)-(1,0,0) = (9, 0, 0).
  const PlaneRef cut = space.cut_of_supports(0, 1);
  EXPECT_EQ(cut, own);
  EXPECT_EQ(loop.sides(space, -cut), by_cut);
  EXPECT_EQ(space.side_of_support(1, loop.view().corner(1)), Side::kFront);
  EXPECT_EQ(loop.sides(fork, forks), by_y);
  EXPECT_EQ(loop.sides(space, shared), by_x);
}

/// u, v and z by their definition from a position in grid units.
struct ExactChartPoint {
  mpq_class u, v, z, w;
};
inline ExactChartPoint exact_chart_point(const Geometry& geometry, const LightPoint& light,
                                         const LightChart& chart, const Rationals& x) {
  ExactChartPoint point;
  if (!light.directional) {
    Rationals q;
    for (std::size_t k = 0; k < 3; ++k) q[k] = light.grid[k] - x[k];
    point.w = q[static_cast<std::size_t>(chart.w)] * chart.sign;
    if (point.w == 0) return point;
    point.u = q[static_cast<std::size_t>(chart.u)] / q[static_cast<std::size_t>(chart.w)];
    point.v = q[static_cast<std::size_t>(chart.v)] / q[static_cast<std::size_t>(chart.w)];
    point.z = 1 / abs(q[static_cast<std::size_t>(chart.w)]);
    return point;
  }
  const LightAxes axes = LightAxes::of(light);
  const auto ax = static_cast<std::size_t>(axes.x), ay = static_cast<std::size_t>(axes.y),
             az = static_cast<std::size_t>(axes.z);
  const mpz_class extent = mpz_class(1) << geometry.grid.bits();
  point.w = sgn(light.grid[az]) * chart.sign;
  point.u = (x[ax] - x[az] * light.grid[ax] / light.grid[az]) / extent;
  point.v = (x[ay] - x[az] * light.grid[ay] / light.grid[az]) / extent;
  point.z = x[az] * sgn(light.grid[az]);
  return point;
}

/// The unit of depths is a kernel's own, a power of two times the grid's, and so is the zero for a
/// directional light: the first depths tell them, all must agree.
class DepthScale {
 public:
  explicit DepthScale(bool has_own_zero) : has_zero_(!has_own_zero) {}

  bool agrees(const ChartPoint& point, const mpq_class& truth) {
    if (!has_zero_) {
      has_zero_ = true;
      zero_ = point.z;
      zero_truth_ = truth;
      zero_error_ = point.z_error;
      return true;
    }
    const mpq_class found = mpq_class(point.z) - zero_, expected = truth - zero_truth_;
    const mpq_class error = mpq_class(point.z_error) + zero_error_;
    if (unit_ == 0) {
      if (abs(found) < 8 * error || expected == 0) return abs(found) <= 8 * error;
      if (sgn(found) != sgn(expected)) return false;
      const mpq_class ratio = found / expected;
      const long power = std::lround(log2_of(ratio.get_num()) - log2_of(ratio.get_den()));
      unit_ = power < 0 ? mpq_class(1, mpz_class(1) << -power) : mpq_class(mpz_class(1) << power);
    }
    return abs(found - unit_ * expected) <= error;
  }

 private:
  static double log2_of(const mpz_class& value) {
    long exponent = 0;
    const double mantissa = mpz_get_d_2exp(&exponent, value.get_mpz_t());
    return std::log2(mantissa) + static_cast<double>(exponent);
  }

  bool has_zero_;
  mpq_class zero_ = 0, zero_truth_ = 0, zero_error_ = 0, unit_ = 0;
};

/// Whether a directional light's depths are in units of 1 / |d_z| times a power of two.
template <class Space>
inline constexpr bool kDepthsPerDirection = false;

/// Checks charts of all loops of a soup and of cuts; counts the points with a finite error.
template <class Space>
void check_charts(Random& random, const TriangleSoup& soup, const Geometry& geometry,
                  const LightPoint& light, bool must_be_finite, int& finite) {
  typename Space::SceneSpace scene(geometry, SectorSpace<Space>::kOptions);
  Space space(scene, light, SectorSpace<Space>::kOptions);
  std::vector<LightChart> charts;
  if (light.directional) {
    charts.push_back({0, 1, 2, sgn(light.grid[static_cast<std::size_t>(LightAxes::of(light).z)])});
  } else {
    for (const int sign : {1, -1}) {
      for (int w = 0; w < 3; ++w) charts.push_back({(w + 1) % 3, (w + 2) % 3, w, sign});
    }
  }
  DepthScale depths(light.directional);
  const auto check = [&](const Loop<Space>& loop) {
    for (std::uint32_t i = 0; i < loop.view().size(); ++i) {
      const auto corner = loop.view().corner(i);
      const Rationals x = grid_position(space, geometry, corner);
      const std::array<Ball, 3> position = space.position(corner);
      const bool has_position =
          position[0].is_finite() && position[1].is_finite() && position[2].is_finite();
      for (const LightChart& chart : charts) {
        const ChartPoint point = space.chart_point(chart, corner);
        if (!has_position) {  // a rounded crossing divided by zero
          ASSERT_FALSE(Space::kExact && must_be_finite && !kDepthsPerDirection<Space>);
          if (!Space::kExact) {
            ASSERT_EQ(point.uv_error, std::numeric_limits<double>::infinity());
            continue;
          }
        }
        ExactChartPoint truth = exact_chart_point(geometry, light, chart, x);
        if (kDepthsPerDirection<Space> && light.directional) {
          truth.z /= abs(light.grid[static_cast<std::size_t>(LightAxes::of(light).z)]);
        }
        if (std::isfinite(point.uv_error)) {
          ASSERT_FALSE(std::isnan(point.u) || std::isnan(point.v));
        }
        if (std::isfinite(point.z_error)) {
          ASSERT_FALSE(std::isnan(point.z));
        }
        ASSERT_GE(point.uv_error, 0);
        ASSERT_FALSE(point.z_error < 0);  // what is not a number says nothing
        if (truth.w <= 0) {
          ASSERT_EQ(point.uv_error, std::numeric_limits<double>::infinity());
          ASSERT_EQ(point.z_error, std::numeric_limits<double>::infinity());
          continue;
        }
        if (std::isfinite(point.uv_error)) {
          ++finite;
          ASSERT_TRUE(encloses(point.u, point.uv_error, truth.u))
              << point.u << " +- " << point.uv_error << " is not " << truth.u.get_d();
          ASSERT_TRUE(encloses(point.v, point.uv_error, truth.v))
              << point.v << " +- " << point.uv_error << " is not " << truth.v.get_d();
        }
        // From coordinates; a plane's error is relative to its slope.
        if (must_be_finite && !kDepthsPerDirection<Space>) {
          ASSERT_LT(point.uv_error, 1e-12 * (1 + std::fabs(point.u) + std::fabs(point.v)));
          ASSERT_LE(point.z_error, 1e-12 * std::fabs(point.z) + 1e-300);
        }
        if (std::isfinite(point.z_error)) {
          ASSERT_TRUE(depths.agrees(point, truth.z))
              << point.z << " +- " << point.z_error << " is not " << truth.z.get_d();
        }
      }
    }
  };
  for (std::uint32_t i = 0; i < soup.size(); ++i) {
    const Loop<Space> loop = Loop<Space>::import(soup, scene, space, i);
    check(loop);
    const auto j = static_cast<PlaneId>(random.below(soup.size()));
    if (testing::Test::HasFatalFailure() || !meet_in_line(soup, i, j)) continue;
    const PlaneRef cut = space.cut_of_supports(i, j);
    check(loop.clipped(space, cut, loop.sides(space, cut)));
    if (testing::Test::HasFatalFailure()) return;
  }
}

TYPED_TEST_P(SectorSpace, ChartPointsEncloseTheTruth) {
  using Space = TypeParam;
  Random random(4);
  int finite = 0;
  // Rounded kernels' light is exact as a float up to 24 bits.
  for (const unsigned bits : {7u, 20u}) {
    for (const SoupKind kind : kSoupKinds) {
      for (int round = 0; round < 12; ++round) {
        const TriangleSoup soup =
            random_soup(random, kind, bits, 4, static_cast<int>(random.between(-30, 30)));
        const mpq_class step = soup.geometry().step;
        Rationals origin;
        for (mpq_class& x : origin) x = step * static_cast<long>(random.between(-65536, 65536));
        const Geometry geometry = moved(soup.geometry(), origin);
        const LightPoint light = small_light(random, geometry, bits, round % 2 == 0);
        check_charts<Space>(random, soup, geometry, light, true, finite);
        if (this->HasFatalFailure()) return;
      }
    }
  }
  EXPECT_GT(finite, 1000);
}

/// Where the doubles end: whatever is said there is true, or nothing is said.
TYPED_TEST_P(SectorSpace, ChartPointsAreTrueAtEveryMagnitude) {
  using Space = TypeParam;
  Random random(5);
  int finite = 0;
  for (const int exponent : TestFixture::exponents()) {
    for (const SoupKind kind : kSoupKinds) {
      for (int round = 0; round < 4; ++round) {
        const TriangleSoup soup = random_soup(random, kind, 20, 3, exponent);
        const LightPoint light = small_light(random, soup.geometry(), 20, round % 2 == 0);
        check_charts<Space>(random, soup, soup.geometry(), light, false, finite);
        ASSERT_FALSE(this->HasFatalFailure()) << "step 2^" << exponent;
      }
    }
  }
  EXPECT_GT(finite, 100);
  if constexpr (Space::kExact) {
    for (const unsigned bits : {53u, 62u, 63u, 300u, 1100u, 2100u}) {
      for (const SoupKind kind : kSoupKinds) {
        for (int round = 0; round < 4; ++round) {
          const TriangleSoup soup = random_soup(random, kind, bits, 3);
          // As far as the scene is large, or much farther, or nearer than it is small.
          const unsigned lamp_bits = round < 2 ? bits : round == 2 ? 3 : 2 * bits;
          const LightPoint light = small_light(random, soup.geometry(), lamp_bits, round % 2 == 0);
          check_charts<Space>(random, soup, soup.geometry(), light, false, finite);
          ASSERT_FALSE(this->HasFatalFailure()) << bits << " bits";
        }
      }
    }
  }
}

TYPED_TEST_P(SectorSpace, WithoutIdentityPlanesAreComputed) {
  using Space = TypeParam;
  if constexpr (Space::kExact) {
    GTEST_SKIP() << "an exact kernel knows by identity";
  } else {
    constexpr KernelOptions kPlain{.identity = false, .thickness = 0};
    const TriangleSoup soup(
        {{{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}}}, {{{1, 0, 0}, {1, 3, 0}, {1, 0, 3}}}}, 0);
    typename Space::SceneSpace scene(soup.geometry(), kPlain);
    Space space(scene, light_at(soup.geometry(), {1, 1, 4}, false), kPlain);
    EXPECT_FALSE(space.knows_identity());
    space.make_edge_planes(0, static_cast<EdgeId>(soup.geometry().edges.size()));
    const auto a = scene.input_vertex(soup.loop(0)[0]), b = scene.input_vertex(soup.loop(0)[1]);
    const PlaneRef edge = soup.edge(0, 0);
    EXPECT_FALSE(
        space.import_edge(scene.edges().of_edge(edge.index(), edge.flipped()), 0, false, a, b)
            .valid());
    const std::uint32_t mark = space.plane_mark();
    const Loop<Space> loop = Loop<Space>::import(soup, scene, space, 0);
    EXPECT_EQ(space.plane_mark(), mark + 3);
    Space fork = space.fork();
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::vector<Side> sides = loop.sides(fork, loop.edges[k]);
      EXPECT_EQ(sides[k], Side::kOn);
      EXPECT_EQ(sides[(k + 1) % 3], Side::kOn);
      EXPECT_EQ(sides[(k + 2) % 3], Side::kFront);
    }
    EXPECT_EQ(fork.side_of_support(1, loop.view().corner(0)), Side::kBack);
    EXPECT_EQ(fork.side_of_support(1, loop.view().corner(1)), Side::kFront);
    EXPECT_EQ(fork.side_of_support(0, loop.view().corner(2)), Side::kOn);
    const PlaneRef cut = space.cut_of_supports(0, 1);
    const Loop<Space> piece = loop.clipped(space, cut, loop.sides(space, cut));
    ASSERT_EQ(piece.vertices.size(), 3u);  // x >= 1: (1, 0, 0), (3, 0, 0), (1, 2, 0)
    for (std::uint32_t k = 0; k < 3; ++k) {
      EXPECT_EQ(space.side_of_support(1, piece.view().corner(k)),
                piece.vertices[k].source == kMadeVertex ? Side::kOn : Side::kFront);
    }
  }
}

TYPED_TEST_P(SectorSpace, ForksRunInParallel) {
  using Space = TypeParam;
  if constexpr (!Space::kParallel) {
    GTEST_SKIP() << "not a parallel kernel";
  } else {
    Random random(6);
    const TriangleSoup soup = random_soup(random, SoupKind::kFull, 7, 40);
    const auto edges = static_cast<EdgeId>(soup.geometry().edges.size());
    typename Space::SceneSpace scene(soup.geometry(), TestFixture::kOptions);
    Space space(scene, small_light(random, soup.geometry(), 7, false), TestFixture::kOptions);
    const auto together = [](const auto& first, const auto& second) {
      std::thread thread(first);
      second();
      thread.join();
    };
    together([&] { space.make_edge_planes(0, edges / 2); },
             [&] { space.make_edge_planes(edges / 2, edges); });
    const auto all_sides = [&](Space& fork) {
      std::vector<Side> all;
      for (std::uint32_t i = 0; i < soup.size(); ++i) {
        if (fork.light_side(i) == Sign::kZero) continue;
        const Loop<Space> loop = Loop<Space>::import(soup, scene, fork, i);
        for (PlaneId j = 0; j < soup.size(); ++j) {
          if (!meet_in_line(soup, i, j)) continue;
          const std::uint32_t mark = fork.plane_mark();
          const PlaneRef cut = fork.cut_of_supports(i, j);
          const Loop<Space> piece = loop.clipped(fork, cut, loop.sides(fork, cut));
          for (std::uint32_t k = 0; k < piece.view().size(); ++k) {
            all.push_back(fork.side_of_support((j + 1) % soup.size(), piece.view().corner(k)));
          }
          fork.release_planes(mark);
        }
      }
      return all;
    };
    Space first = space.fork(), second = space.fork();
    std::vector<Side> from_first, from_second;
    together([&] { from_first = all_sides(first); }, [&] { from_second = all_sides(second); });
    EXPECT_GT(from_first.size(), 100u);
    EXPECT_EQ(from_first, from_second);
    EXPECT_EQ(from_first, all_sides(space));
  }
}

REGISTER_TYPED_TEST_SUITE_P(SectorSpace, ModelsTheConcept, SidesOfSupportPlanesAreTrue,
                            CutsAreOnBothSupportPlanes, EdgePlanesAreTheEdges,
                            ForksAreIndependentAndPlanesAreAStack, ChartPointsEncloseTheTruth,
                            ChartPointsAreTrueAtEveryMagnitude, WithoutIdentityPlanesAreComputed,
                            ForksRunInParallel);

}  // namespace gnomon::test

#endif  // GNOMON_TESTS_KERNEL_SECTOR_SPACE_TEST_H
