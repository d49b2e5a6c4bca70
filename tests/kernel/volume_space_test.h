// SPDX-License-Identifier: GPL-3.0-or-later
// What area lights ask of a kernel (VolumeSpaceModel), on every kernel: sides of planes through
// three points, along directions, across axes; crossings and positions; identity; the stack of
// planes. The truth is kept beside the kernel in rationals, on the grid's integers.
//
// Two suites: VolumeSpace is for all kernels, with numbers so small that even float is exact, or
// with what identity alone must know; ExactVolumeSpace for exact ones, with made points of every
// kind. One body; sources instantiate it with the kernels that they can compile (epeck needs CGAL's
// compiler flags, hence its own program).
#ifndef GNOMON_TESTS_KERNEL_VOLUME_SPACE_TEST_H
#define GNOMON_TESTS_KERNEL_VOLUME_SPACE_TEST_H

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <thread>
#include <utility>
#include <vector>

#include "kernel/concept/kernel_concept.h"
#include "kernel/concept/plane_takeover.h"
#include "kernel/signs/nearest_double.h"
#include "triangle_soup.h"

namespace gnomon::test {

inline bool is_zero(const Rationals& v) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }

/// n . x - d, in grid units.
struct TruePlane {
  Rationals n;
  mpq_class d;

  static TruePlane from(Rationals normal, const Rationals& point) {
    TruePlane plane{std::move(normal), 0};
    plane.d = dot(plane.n, point);
    return plane;
  }
  static TruePlane through(const Rationals& a, const Rationals& b, const Rationals& c) {
    return from(cross(minus(b, a), minus(c, a)), a);
  }
  static TruePlane axis(const Geometry& geometry, int axis, double value) {
    TruePlane plane;
    plane.n[static_cast<std::size_t>(axis)] = 1;
    plane.d = mpq_class(value) * (mpz_class(1) << geometry.grid.bits());
    return plane;
  }
  mpq_class value(const Rationals& x) const { return dot(n, x) - d; }
  /// Of the plane as `ref` has it.
  Side side(PlaneRef ref, const Rationals& x) const {
    const Side own = static_cast<Side>(sgn(value(x)));
    return ref.flipped() ? opposite(own) : own;
  }
};

/// A loop of a volume space, with the exact points beside it.
template <class Space>
struct VolumeLoop {
  using Vertex = typename Space::Vertex;
  std::vector<Vertex> vertices;
  std::vector<Rationals> exact;
  std::vector<PlaneRef> edges;
  PlaneId support = 0;

  VolumeLoop() = default;
  VolumeLoop(const TriangleSoup& soup, const Space& space, std::uint32_t triangle)
      : support(triangle) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      const VertexId v = soup.loop(triangle)[i];
      const PlaneRef edge = soup.edge(triangle, i);
      vertices.push_back(space.input_vertex(v));
      exact.push_back(rationals(soup.at(v)));
      edges.push_back(space.edges().of_edge(edge.index(), edge.flipped()));
    }
  }

  std::uint32_t size() const { return static_cast<std::uint32_t>(vertices.size()); }
  LoopView<Vertex> view() const { return {vertices, edges, support, 0}; }
  Corner<Vertex> corner(std::uint32_t i) const { return view().corner(i); }

  std::vector<Side> sides(Space& space, PlaneRef plane) const {
    std::vector<Side> result;
    for (std::uint32_t i = 0; i < size(); ++i) {
      result.push_back(space.side_of_plane(plane, corner(i)));
    }
    return result;
  }
  std::vector<Side> true_sides(PlaneRef ref, const TruePlane& plane) const {
    std::vector<Side> result;
    for (const Rationals& x : exact) result.push_back(plane.side(ref, x));
    return result;
  }
  /// What is in front of the plane, by true sides; no vertices if that has no area.
  VolumeLoop clipped(const Space& space, PlaneRef ref, const TruePlane& plane) const {
    const std::vector<Side> side = true_sides(ref, plane);
    VolumeLoop result;
    result.support = support;
    const LoopView<Vertex> loop = view();
    bool front = false;
    for (std::uint32_t i = 0; i < size(); ++i) {
      const std::uint32_t j = loop.next(i);
      const Side here = side[i], there = side[j];
      front = front || here == Side::kFront;
      if (here != Side::kBack) {
        result.push(vertices[i], exact[i],
                    here == Side::kOn && there == Side::kBack ? ref : edges[i]);
      }
      if (here != Side::kOn && there == opposite(here)) {
        const bool leaving = here == Side::kFront;
        const mpq_class at = plane.value(exact[i]), t = at / (at - plane.value(exact[j]));
        Rationals x;
        for (std::size_t k = 0; k < 3; ++k) x[k] = exact[i][k] + t * (exact[j][k] - exact[i][k]);
        result.push(space.crossing(ref, edges[i], leaving, corner(i), corner(j)), x,
                    leaving ? ref : edges[i]);
      }
    }
    if (!front) result.vertices.clear();
    return result;
  }

 private:
  void push(const Vertex& vertex, const Rationals& x, PlaneRef edge) {
    vertices.push_back(vertex);
    exact.push_back(x);
    edges.push_back(edge);
  }
};

template <class Space>
using VolumeLoops = std::vector<VolumeLoop<Space>>;

template <class Space>
VolumeLoops<Space> loops_of(const TriangleSoup& soup, const Space& space) {
  VolumeLoops<Space> loops;
  for (std::uint32_t i = 0; i < soup.size(); ++i) loops.emplace_back(soup, space, i);
  return loops;
}

/// Planes of a space, with the true ones beside them.
template <class Space>
class VolumePlanes {
 public:
  using Entry = std::pair<PlaneRef, TruePlane>;

  VolumePlanes(const TriangleSoup& soup, Space& space, Random& random)
      : soup_(&soup), space_(&space), random_(&random), loops_(loops_of(soup, space)) {
    for (PlaneId plane = 0; plane < soup.size(); ++plane) {
      const auto& x = loops_[plane].exact;
      entries_.emplace_back(PlaneRef(plane), TruePlane::through(x[0], x[1], x[2]));
    }
  }

  const std::vector<Entry>& entries() const { return entries_; }
  /// The soup's triangles.
  const VolumeLoops<Space>& loops() const { return loops_; }
  const Entry& some() const { return entries_[random_->below(entries_.size())]; }

  /// Requires: corner i of a loop without added planes.
  using Place = std::pair<const VolumeLoop<Space>*, std::uint32_t>;
  void add_through(const Place& a, const Place& b, const Place& c) {
    add(space_->add_plane(at(a), at(b), at(c)),
        TruePlane::through(true_at(a), true_at(b), true_at(c)));
  }
  void add_through_vertices() { add_through(vertex(), vertex(), vertex()); }
  void add_along_direction(unsigned bits) {
    const LightPoint light = small_light(*random_, soup_->geometry(), bits, true);
    const Place a = vertex(), b = vertex();
    add(space_->add_plane(at(a), at(b), light),
        TruePlane::from(cross(minus(true_at(b), true_at(a)), rationals(light.grid)), true_at(a)));
  }
  void add_axis_plane(double value) {
    const auto axis = static_cast<int>(random_->below(3));
    add(space_->add_axis_plane(axis, value), TruePlane::axis(soup_->geometry(), axis, value));
  }
  /// Through corners of a triangle that support planes have cut, and vertices.
  void add_through_cut_light() {
    VolumeLoop<Space> light = loops_[random_->below(loops_.size())];
    for (int cut = 0; cut < 3; ++cut) {
      const auto& [ref, plane] = entries_[random_->below(soup_->size())];
      VolumeLoop<Space> front = light.clipped(*space_, ref, plane);
      if (front.size() >= 3) light = std::move(front);
    }
    const auto i = static_cast<std::uint32_t>(random_->below(light.size()));
    const std::uint32_t j = light.view().next(i);
    add_through(vertex(), vertex(), {&light, i});
    add_through({&light, j}, {&light, i}, vertex());
  }

 private:
  Place vertex() const {
    return {&loops_[random_->below(loops_.size())], static_cast<std::uint32_t>(random_->below(3))};
  }
  static Corner<typename Space::Vertex> at(const Place& place) {
    return place.first->corner(place.second);
  }
  static const Rationals& true_at(const Place& place) { return place.first->exact[place.second]; }
  void add(PlaneRef ref, TruePlane plane) {
    ASSERT_EQ(ref.valid(), !is_zero(plane.n));
    if (!ref.valid()) return;
    // A reference may be to the opposite of the plane by that number.
    if (ref.flipped()) {
      for (mpq_class& x : plane.n) x = -x;
      plane.d = -plane.d;
    }
    entries_.emplace_back(PlaneRef(ref.index()), std::move(plane));
  }

  const TriangleSoup* soup_;
  Space* space_;
  Random* random_;
  VolumeLoops<Space> loops_;
  std::vector<Entry> entries_;
};

// --- All kernels. ---

template <class Space>
class VolumeSpace : public testing::Test {
 public:
  using Scene = typename Space::SceneSpace;
  static constexpr bool kExact = Space::kExact;
  static constexpr KernelOptions kOptions{.identity = true, .thickness = 0};
  /// Without identity, so that a rounded kernel has to compute.
  static constexpr KernelOptions kPlain{};
  /// Bits of soups on which even float decides about input vertices exactly: 3 b + 2 <= 24.
  static std::vector<unsigned> sizes() {
    return kExact ? std::vector<unsigned>{3, 7, 20, 21, 42, 53, 62, 63, 84, 200}
                  : std::vector<unsigned>{3, 7};
  }

  /// Checks the sides of all planes that the corners of a loop have.
  void check_sides(Space& space, const VolumePlanes<Space>& planes, const VolumeLoop<Space>& loop) {
    for (const auto& [ref, plane] : planes.entries()) {
      const std::vector<Side> truth = loop.true_sides(ref, plane);
      ASSERT_EQ(loop.sides(space, ref), truth)
          << space.edges().planes << " planes, number " << ref.index();
      for (const Side side : truth) zeros += side == Side::kOn ? 1 : 0;
      const std::vector<Side> reverse = loop.true_sides(-ref, plane);
      ASSERT_EQ(loop.sides(space, -ref), reverse);
    }
  }
  int zeros = 0;
};
TYPED_TEST_SUITE_P(VolumeSpace);

TYPED_TEST_P(VolumeSpace, ModelsTheConcept) {
  static_assert(VolumeSpaceModel<TypeParam>);
  static_assert(MeasuredSpace<TypeParam>);
}

TYPED_TEST_P(VolumeSpace, SidesOfInputVerticesAreTrue) {
  using Space = TypeParam;
  Random random(21);
  for (const KernelOptions& options : {TestFixture::kOptions, TestFixture::kPlain}) {
    for (const unsigned bits : TestFixture::sizes()) {
      for (const SoupKind kind : kSoupKinds) {
        for (int round = 0; round < (Space::kExact ? 2 : 8); ++round) {
          const TriangleSoup soup = random_soup(random, kind, bits, 5);
          const typename Space::SceneSpace scene(soup.geometry(), options);
          Space space(scene, options);
          VolumePlanes<Space> planes(soup, space, random);
          for (int i = 0; i < 10; ++i) {
            planes.add_through_vertices();
            planes.add_along_direction(i % 2 == 0 ? 3 : bits);
            planes.add_axis_plane(static_cast<double>(random.below(9)) / 8);
          }
          for (const VolumeLoop<Space>& loop : planes.loops()) {
            this->check_sides(space, planes, loop);
            if (this->HasFailure()) return;
          }
        }
      }
    }
  }
  EXPECT_GT(this->zeros, 1000);
}

TYPED_TEST_P(VolumeSpace, FrontIsWhereThePlaneIsCounterClockwise) {
  using Space = TypeParam;
  // A triangle in z = 0 seen from above, and one beside it that has a vertex on each side.
  const TriangleSoup soup(
      {{{{0, 0, 1}, {3, 0, 1}, {0, 3, 1}}}, {{{1, 1, 0}, {1, 1, 3}, {3, 3, 1}}}}, 0);
  const typename Space::SceneSpace scene(soup.geometry(), TestFixture::kPlain);
  Space space(scene, TestFixture::kPlain);
  const VolumeLoop<Space> floor(soup, space, 0), other(soup, space, 1);
  const auto a = floor.corner(0), b = floor.corner(1), c = floor.corner(2);
  const std::vector<Side> above{Side::kBack, Side::kFront, Side::kOn},
      below{Side::kFront, Side::kBack, Side::kOn};
  EXPECT_EQ(other.sides(space, space.add_plane(a, b, c)), above);
  EXPECT_EQ(other.sides(space, space.add_plane(b, c, a)), above);
  EXPECT_EQ(other.sides(space, space.add_plane(b, a, c)), below);
  EXPECT_EQ(other.sides(space, -space.add_plane(b, a, c)), above);
  EXPECT_EQ(other.sides(space, PlaneRef(0)), above);
  // Along y: a, b and a point far along it are counter-clockwise seen from above.
  const auto along = [&](const Integers& direction) {
    return other.sides(space, space.add_plane(a, b, light_at(soup.geometry(), direction, true)));
  };
  EXPECT_EQ(along({0, 1, 0}), above);
  EXPECT_EQ(along({0, -1, 0}), below);
  EXPECT_EQ(along({1, 1, 0}), above);
  // In z the plane is y = 0, and (b - a) x to_light = (3, 0, 0) x (0, 0, 1) = (0, -3, 0).
  EXPECT_EQ(along({0, 0, 1}), (std::vector<Side>{Side::kBack, Side::kBack, Side::kBack}));
  // The grid has 2 bits: 1 is a quarter of its extent.
  EXPECT_EQ(other.sides(space, space.add_axis_plane(2, 0.25)), above);
  EXPECT_EQ(other.sides(space, -space.add_axis_plane(2, 0.25)), below);
  EXPECT_EQ(other.sides(space, space.add_axis_plane(0, 0.75)),
            (std::vector<Side>{Side::kBack, Side::kBack, Side::kOn}));
}

TYPED_TEST_P(VolumeSpace, PointsOnALineMakeNoPlane) {
  using Space = TypeParam;
  // Vertices on the line x = y = z and off it.
  const TriangleSoup soup(
      {{{{0, 0, 0}, {1, 1, 1}, {3, 0, 0}}}, {{{2, 2, 2}, {3, 3, 3}, {0, 3, 0}}}}, 0);
  const typename Space::SceneSpace scene(soup.geometry(), TestFixture::kOptions);
  Space space(scene, TestFixture::kOptions);
  const VolumeLoop<Space> one(soup, space, 0), two(soup, space, 1);
  const std::uint32_t mark = space.plane_mark();
  const auto a = one.corner(0), b = one.corner(1), c = two.corner(0), off = one.corner(2);
  EXPECT_FALSE(space.add_plane(a, b, c).valid());
  EXPECT_FALSE(space.add_plane(a, off, a).valid());
  EXPECT_FALSE(space.add_plane(off, off, a).valid());
  const LightPoint along = light_at(soup.geometry(), {-1, -1, -1}, true);
  EXPECT_FALSE(space.add_plane(a, c, along).valid());
  EXPECT_FALSE(space.add_plane(b, b, along).valid());
  EXPECT_EQ(space.plane_mark(), mark);
  EXPECT_TRUE(space.add_plane(a, b, off).valid());
  EXPECT_TRUE(space.add_plane(a, off, along).valid());
}

TYPED_TEST_P(VolumeSpace, CutsOnTheLatticeAreTrue) {
  using Space = TypeParam;
  // A floor; a wall over its line x = 4, of which one vertex touches the floor inside and one on
  // its border; a roof with made points straight above the floor's. All halves are whole, so that
  // even float has the made points exactly.
  const TriangleSoup soup({{{{0, 0, 0}, {8, 0, 0}, {0, 8, 0}}},
                           {{{4, 0, 0}, {4, 2, 0}, {4, 0, 8}}},
                           {{{0, 0, 4}, {0, 8, 4}, {8, 0, 4}}},
                           {{{0, 0, 0}, {4, 4, 4}, {4, 4, 0}}}},
                          0);
  for (const KernelOptions& options : {TestFixture::kOptions, TestFixture::kPlain}) {
    const typename Space::SceneSpace scene(soup.geometry(), options);
    Space space(scene, options);
    Random random(22);
    VolumePlanes<Space> planes(soup, space, random);
    const auto& loops = planes.loops();
    const auto [wall, wall_plane] = planes.entries()[1];
    const VolumeLoop<Space> floor = loops[0].clipped(space, wall, wall_plane),
                            roof = loops[2].clipped(space, -wall, wall_plane);
    ASSERT_EQ(floor.size(), 3u);
    ASSERT_EQ(roof.size(), 4u);
    EXPECT_EQ(floor.exact[2], (Rationals{4, 4, 0}));
    for (std::uint32_t i = 0; i < roof.size(); ++i) {
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t next = roof.view().next(i);
        planes.add_through({&roof, i}, {&roof, next}, {&floor, k});
        planes.add_through({&roof, i}, {&loops[1], k}, {&loops[3], k});
      }
    }
    planes.add_axis_plane(0.25);
    ASSERT_FALSE(this->HasFailure());
    for (const VolumeLoop<Space>* loop : {&floor, &roof, &loops[0], &loops[1], &loops[3]}) {
      this->check_sides(space, planes, *loop);
      for (std::uint32_t i = 0; i < loop->size(); ++i) {
        const Rationals& x = loop->exact[i];
        const auto corner = loop->corner(i);
        EXPECT_EQ(space.exact_position(corner), x);
        const std::array<double, 3> nearest = space.nearest_position(corner);
        const std::array<Ball, 3> fraction = space.position(corner);
        for (std::size_t k = 0; k < 3; ++k) {
          EXPECT_EQ(nearest[k], x[k].get_d());
          // The grid has 4 bits.
          EXPECT_TRUE(encloses(fraction[k].middle, fraction[k].radius, x[k] / 16));
        }
      }
    }
  }
  EXPECT_GT(this->zeros, 100);
}

/// On numbers that every rounded kernel rounds: what is made from what must be known.
TYPED_TEST_P(VolumeSpace, IdentityKnowsWhatMadeWhat) {
  using Space = TypeParam;
  Random random(23);
  int planes = 0, made = 0;
  for (int round = 0; round < 60; ++round) {
    const TriangleSoup soup = random_soup(random, SoupKind::kFull, 53, 5, -50);
    const typename Space::SceneSpace scene(soup.geometry(), TestFixture::kOptions);
    Space space(scene, TestFixture::kOptions);
    const VolumeLoops<Space> loops = loops_of(soup, space);
    const TruePlane cut_plane =
        TruePlane::through(loops[1].exact[0], loops[1].exact[1], loops[1].exact[2]);
    // Support planes: of the loop, of the edges that they cut, and the vertices that define them.
    EXPECT_EQ(loops[0].sides(space, PlaneRef(0)), std::vector<Side>(3, Side::kOn));
    const VolumeLoop<Space> light = loops[0].clipped(space, PlaneRef(1, true), cut_plane);
    for (std::uint32_t i = 0; i < light.size(); ++i) {
      if (light.vertices[i].source != kMadeVertex) continue;
      ++made;
      EXPECT_EQ(space.side_of_plane(PlaneRef(0), light.corner(i)), Side::kOn);
      EXPECT_EQ(space.side_of_plane(PlaneRef(1), light.corner(i)), Side::kOn);
    }
    // A plane has the points that it was made from, input vertices and made points.
    for (std::uint32_t i = 0; i < light.size(); ++i) {
      const VolumeLoop<Space>& caster = loops[2];
      const PlaneRef plane = space.add_plane(caster.corner(0), caster.corner(1), light.corner(i));
      ASSERT_TRUE(plane.valid());
      ++planes;
      EXPECT_EQ(space.side_of_plane(plane, caster.corner(0)), Side::kOn);
      EXPECT_EQ(space.side_of_plane(-plane, caster.corner(1)), Side::kOn);
      EXPECT_NE(space.side_of_plane(plane, caster.corner(2)), Side::kOn);
      EXPECT_EQ(space.side_of_plane(plane, light.corner(i)), Side::kOn);
      // What is cut from an edge that the plane passes through is on it, and what the plane cuts.
      for (PlaneId cutter = 3; cutter < soup.size(); ++cutter) {
        const TruePlane at = TruePlane::through(loops[cutter].exact[0], loops[cutter].exact[1],
                                                loops[cutter].exact[2]);
        const VolumeLoop<Space> cut = caster.clipped(space, PlaneRef(cutter), at);
        for (std::uint32_t k = 0; k < cut.size(); ++k) {
          const auto corner = cut.corner(k);
          const PlaneRef edge = caster.edges[0];
          if (!corner.before.same_plane(edge) && !corner.after.same_plane(edge)) continue;
          EXPECT_EQ(space.side_of_plane(plane, corner), Side::kOn);
        }
      }
      const TruePlane truth = TruePlane::through(caster.exact[0], caster.exact[1], light.exact[i]);
      const VolumeLoop<Space> piece = loops[3].clipped(space, plane, truth);
      for (std::uint32_t k = 0; k < piece.size(); ++k) {
        if (piece.vertices[k].source == kMadeVertex) {
          EXPECT_EQ(space.side_of_plane(-plane, piece.corner(k)), Side::kOn);
        }
      }
    }
    const LightPoint direction = small_light(random, soup.geometry(), 7, true);
    const PlaneRef along = space.add_plane(loops[2].corner(0), loops[2].corner(1), direction);
    ASSERT_TRUE(along.valid());
    EXPECT_EQ(space.side_of_plane(along, loops[2].corner(0)), Side::kOn);
    EXPECT_EQ(space.side_of_plane(along, loops[2].corner(1)), Side::kOn);
    if (this->HasFailure()) return;
  }
  EXPECT_GT(made, 20);
  EXPECT_GT(planes, 60);
}

TYPED_TEST_P(VolumeSpace, ForksAreIndependentAndPlanesAreAStack) {
  using Space = TypeParam;
  const TriangleSoup soup(
      {{{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}}}, {{{1, 0, 0}, {1, 3, 0}, {1, 0, 3}}}}, 0);
  const typename Space::SceneSpace scene(soup.geometry(), TestFixture::kOptions);
  Space space(scene, TestFixture::kOptions);
  const VolumeLoop<Space> loop(soup, space, 0);
  // x = 1 and y = 1 on a grid of 2 bits.
  const std::vector<Side> by_x{Side::kBack, Side::kFront, Side::kBack},
      by_y{Side::kBack, Side::kBack, Side::kFront}, by_wall{Side::kBack, Side::kFront, Side::kBack};
  const std::uint32_t empty = space.plane_mark();
  const PlaneRef shared = space.add_axis_plane(0, 0.25);
  EXPECT_EQ(shared.index(), space.edges().planes + soup.geometry().edges.size());
  ASSERT_EQ(loop.sides(space, shared), by_x);
  Space fork = space.fork();
  EXPECT_EQ(fork.plane_mark(), space.plane_mark());
  EXPECT_EQ(loop.sides(fork, shared), by_x);
  EXPECT_EQ(&fork.geometry(), &space.geometry());

  const std::uint32_t mark = space.plane_mark();
  const PlaneRef own = space.add_axis_plane(0, 0.25);
  const PlaneRef forks = fork.add_axis_plane(1, 0.25);
  EXPECT_EQ(own, forks);  // each has its own numbers
  EXPECT_EQ(loop.sides(space, own), by_x);
  EXPECT_EQ(loop.sides(fork, forks), by_y);

  space.release_planes(mark);
  EXPECT_EQ(space.plane_mark(), mark);
  EXPECT_EQ(space.add_axis_plane(1, 0.25), own);
  EXPECT_EQ(loop.sides(space, own), by_y);
  // Many at once, then none.
  const VolumeLoop<Space> wall(soup, space, 1);
  for (int i = 0; i < 100; ++i) {
    const PlaneRef plane = space.add_plane(wall.corner(0), wall.corner(1), wall.corner(2));
    ASSERT_TRUE(plane.valid());
    ASSERT_EQ(loop.sides(space, plane), by_wall);
  }
  EXPECT_EQ(loop.sides(space, shared), by_x);
  space.release_planes(empty);
  EXPECT_EQ(space.plane_mark(), empty);
  EXPECT_EQ(space.add_axis_plane(1, 0.25), shared);
  EXPECT_EQ(loop.sides(space, shared), by_y);
  EXPECT_EQ(loop.sides(fork, shared), by_x);
  EXPECT_EQ(loop.sides(fork, forks), by_y);
}

/// The same on many threads, each with its own planes; for the thread sanitizer, too.
TYPED_TEST_P(VolumeSpace, ForksServeThreads) {
  using Space = TypeParam;
  if constexpr (!Space::kParallel) {
    GTEST_SKIP() << "forks of this kernel are for one thread";
  } else {
    Random random(24);
    const TriangleSoup soup = random_soup(random, SoupKind::kLattice, 7, 12);
    const typename Space::SceneSpace scene(soup.geometry(), TestFixture::kOptions);
    Space space(scene, TestFixture::kOptions);
    VolumePlanes<Space> planes(soup, space, random);
    for (int i = 0; i < 20; ++i) planes.add_through_vertices();
    const auto work = [&](std::uint64_t seed) {
      Random own_random(seed);
      Space fork = space.fork();
      std::vector<Side> sides;
      for (int i = 0; i < 20; ++i) {
        const auto& loop = planes.loops()[own_random.below(soup.size())];
        const auto& other = planes.loops()[own_random.below(soup.size())];
        const PlaneRef plane =
            fork.add_plane(loop.corner(0), loop.corner(1),
                           other.corner(static_cast<std::uint32_t>(own_random.below(3))));
        for (const auto& face : planes.loops()) {
          if (plane.valid()) std::ranges::copy(face.sides(fork, plane), std::back_inserter(sides));
          std::ranges::copy(face.sides(fork, planes.entries()[i].first), std::back_inserter(sides));
        }
      }
      return sides;
    };
    std::array<std::vector<Side>, 4> results;
    {
      std::vector<std::jthread> threads;
      for (std::size_t t = 0; t < results.size(); ++t) {
        threads.emplace_back([&, t] { results[t] = work(100 + t); });
      }
    }
    for (std::size_t t = 0; t < results.size(); ++t) EXPECT_EQ(results[t], work(100 + t));
  }
}

REGISTER_TYPED_TEST_SUITE_P(VolumeSpace, ModelsTheConcept, SidesOfInputVerticesAreTrue,
                            FrontIsWhereThePlaneIsCounterClockwise, PointsOnALineMakeNoPlane,
                            CutsOnTheLatticeAreTrue, IdentityKnowsWhatMadeWhat,
                            ForksAreIndependentAndPlanesAreAStack, ForksServeThreads);

// --- Exact kernels. ---

template <class Space>
class ExactVolumeSpace : public VolumeSpace<Space> {};
TYPED_TEST_SUITE_P(ExactVolumeSpace);

/// Triangles clipped by planes of every kind, again and again; all sides asked after every cut.
TYPED_TEST_P(ExactVolumeSpace, SidesOfMadePointsAreTrue) {
  using Space = TypeParam;
  Random random(31);
  int made = 0;
  for (const unsigned bits : TestFixture::sizes()) {
    for (const SoupKind kind : kSoupKinds) {
      const TriangleSoup soup = random_soup(random, kind, bits, 6);
      const typename Space::SceneSpace scene(soup.geometry(), TestFixture::kOptions);
      Space space(scene, TestFixture::kOptions);
      VolumePlanes<Space> planes(soup, space, random);
      for (int i = 0; i < 4; ++i) {
        planes.add_through_vertices();
        planes.add_along_direction(i % 2 == 0 ? 3 : bits);
        planes.add_through_cut_light();
        planes.add_axis_plane(std::ldexp(static_cast<double>(random.below(1u << 20)), -20));
        planes.add_axis_plane(static_cast<double>(random.below(9)) / 8);
      }
      if (this->HasFailure()) return;
      for (VolumeLoop<Space> loop : planes.loops()) {
        for (int cut = 0; cut < 4; ++cut) {
          const auto& [ref, plane] = planes.some();
          VolumeLoop<Space> front = loop.clipped(space, random.chance(1, 2) ? ref : -ref, plane);
          if (front.size() < 3) continue;
          loop = std::move(front);
          this->check_sides(space, planes, loop);
          if (this->HasFailure()) return;
        }
        for (const auto& vertex : loop.vertices) made += vertex.source == kMadeVertex ? 1 : 0;
      }
    }
  }
  EXPECT_GT(made, 200);
  EXPECT_GT(this->zeros, 1000);
}

/// A face of a volume: its support and its edges are added planes through three vertices.
TYPED_TEST_P(ExactVolumeSpace, FacesOfAddedPlanesAreCut) {
  using Space = TypeParam;
  Random random(32);
  int cuts = 0;
  for (const unsigned bits : {3u, 7u, 20u, 53u, 63u}) {
    for (const SoupKind kind : kSoupKinds) {
      const TriangleSoup soup = random_soup(random, kind, bits, 6);
      const typename Space::SceneSpace scene(soup.geometry(), TestFixture::kOptions);
      Space space(scene, TestFixture::kOptions);
      VolumePlanes<Space> planes(soup, space, random);
      for (int i = 0; i < 10; ++i) planes.add_through_vertices();
      for (int round = 0; round < 12; ++round) {
        // The edge of one triangle and a vertex of another, with a fourth vertex off that plane.
        const auto& one = planes.loops()[random.below(soup.size())];
        const auto& two = planes.loops()[random.below(soup.size())];
        const auto& three = planes.loops()[random.below(soup.size())];
        const std::array<Corner<typename Space::Vertex>, 3> corners{one.corner(0), one.corner(1),
                                                                    two.corner(2)};
        const std::array<Rationals, 3> points{one.exact[0], one.exact[1], two.exact[2]};
        const TruePlane support = TruePlane::through(points[0], points[1], points[2]);
        const mpq_class above = support.value(three.exact[0]);
        if (is_zero(support.n) || above == 0) continue;
        VolumeLoop<Space> face;
        const PlaneRef ref = space.add_plane(corners[0], corners[1], corners[2]);
        ASSERT_TRUE(ref.valid());
        face.support = ref.index();
        for (std::size_t i = 0; i < 3; ++i) {
          const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
          PlaneRef edge = space.add_plane(corners[i], corners[j], three.corner(0));
          ASSERT_TRUE(edge.valid());
          // The interior is in front.
          if (TruePlane::through(points[i], points[j], three.exact[0]).value(points[k]) < 0) {
            edge = -edge;
          }
          face.vertices.push_back(corners[i].vertex);
          face.exact.push_back(points[i]);
          face.edges.push_back(edge);
        }
        for (int cut = 0; cut < 3; ++cut) {
          this->check_sides(space, planes, face);
          if (this->HasFailure()) return;
          const auto& [cutter, plane] = planes.some();
          VolumeLoop<Space> front = face.clipped(space, cutter, plane);
          if (front.size() < 3) continue;
          face = std::move(front);
          ++cuts;
        }
        this->check_sides(space, planes, face);
        if (this->HasFailure()) return;
      }
    }
  }
  EXPECT_GT(cuts, 100);
}

/// The floor of the grid's box, or of a part of it: corners where three axis planes meet.
TYPED_TEST_P(ExactVolumeSpace, BoxesAreCut) {
  using Space = TypeParam;
  Random random(34);
  int cuts = 0;
  for (const unsigned bits : {3u, 20u, 53u, 63u, 84u}) {
    for (const SoupKind kind : kSoupKinds) {
      const TriangleSoup soup = random_soup(random, kind, bits, 6);
      const typename Space::SceneSpace scene(soup.geometry(), TestFixture::kOptions);
      Space space(scene, TestFixture::kOptions);
      VolumePlanes<Space> planes(soup, space, random);
      for (int i = 0; i < 6; ++i) {
        planes.add_through_vertices();
        planes.add_along_direction(3);
        planes.add_axis_plane(static_cast<double>(random.below(9)) / 8);
      }
      const mpz_class extent = mpz_class(1) << soup.geometry().grid.bits();
      for (const double low : {0.0, 0.125, 0.375}) {
        const double high = 1 - low;
        const std::array<PlaneRef, 2> x{space.add_axis_plane(0, low),
                                        -space.add_axis_plane(0, high)},
            y{space.add_axis_plane(1, low), -space.add_axis_plane(1, high)};
        const PlaneRef floor = space.add_axis_plane(2, low);
        VolumeLoop<Space> face;
        face.support = floor.index();
        face.edges = {y[0], x[1], y[1], x[0]};
        for (const auto& [u, v] : {std::pair{low, low}, {high, low}, {high, high}, {low, high}}) {
          face.vertices.push_back(space.axis_point({u, v, low}));
          face.exact.push_back(
              {mpq_class(u) * extent, mpq_class(v) * extent, mpq_class(low) * extent});
        }
        for (int cut = 0; cut < 4; ++cut) {
          this->check_sides(space, planes, face);
          if (this->HasFailure()) return;
          for (std::uint32_t i = 0; i < face.size(); ++i) {
            const Rationals point = space.exact_position(face.corner(i));
            for (std::size_t k = 0; k < 3; ++k) {
              ASSERT_EQ(point[k], soup.geometry().step * face.exact[i][k]);
            }
          }
          const auto& [cutter, plane] = planes.some();
          VolumeLoop<Space> front = face.clipped(space, cutter, plane);
          if (front.size() < 3) continue;
          face = std::move(front);
          ++cuts;
        }
      }
    }
  }
  EXPECT_GT(cuts, 50);
}

TYPED_TEST_P(ExactVolumeSpace, PositionsAreCertifiedExactAndNearest) {
  using Space = TypeParam;
  Random random(33);
  for (const unsigned bits : {3u, 20u, 53u, 63u, 200u}) {
    for (const int exponent : {0, -40, 30, -700}) {
      const TriangleSoup soup = random_soup(random, SoupKind::kFull, bits, 6, exponent);
      const Rationals origin{mpq_class(-1, 3), mpq_class(5), mpq_class(1, 1024)};
      const Geometry geometry = exponent < -100 ? soup.geometry() : moved(soup.geometry(), origin);
      const typename Space::SceneSpace scene(geometry, TestFixture::kOptions);
      Space space(scene, TestFixture::kOptions);
      VolumePlanes<Space> planes(soup, space, random);
      for (int i = 0; i < 4; ++i) {
        planes.add_through_vertices();
        planes.add_axis_plane(0.375);
      }
      const mpq_class extent = mpz_class(1) << geometry.grid.bits();
      for (VolumeLoop<Space> loop : planes.loops()) {
        for (int cut = 0; cut < 3; ++cut) {
          const auto& [ref, plane] = planes.some();
          VolumeLoop<Space> front = loop.clipped(space, ref, plane);
          if (front.size() >= 3) loop = std::move(front);
        }
        for (std::uint32_t i = 0; i < loop.size(); ++i) {
          const auto corner = loop.corner(i);
          const Rationals point = space.exact_position(corner);
          const std::array<double, 3> nearest = space.nearest_position(corner);
          const std::array<Ball, 3> fraction = space.position(corner);
          for (std::size_t k = 0; k < 3; ++k) {
            const mpq_class truth = geometry.origin[k] + geometry.step * loop.exact[i][k];
            ASSERT_EQ(point[k], truth);
            if (corner.vertex.source == kMadeVertex) {
              ASSERT_EQ(nearest[k], nearest_double(truth));
            } else {
              ASSERT_EQ(nearest[k], geometry.positions[corner.vertex.source][k]);
            }
            ASSERT_TRUE(
                encloses(fraction[k].middle, fraction[k].radius, loop.exact[i][k] / extent));
            ASSERT_LT(fraction[k].radius, 0x1p-38);
          }
          if constexpr (requires { space.offset(VertexId{}, corner); }) {
            const VertexId from = soup.loop(loop.support)[0];
            const std::array<Ball, 3> offset = space.offset(from, corner);
            for (std::size_t k = 0; k < 3; ++k) {
              const mpq_class step = (loop.exact[i][k] - soup.at(from)[k]) / extent;
              ASSERT_TRUE(encloses(offset[k].middle, offset[k].radius, step));
            }
          }
        }
      }
    }
  }
}

/// Planes of every kind that a fork has added keep what they are where a space takes them over that
/// has planes of its own, and so do those that were there.
TYPED_TEST_P(ExactVolumeSpace, PlanesOfForksAreTakenOver) {
  using Space = TypeParam;
  if constexpr (!TakesPlanes<Space>) {
    GTEST_SKIP() << "planes of this kernel are for one thread";
  } else {
    Random random(31);
    unsigned asked = 0;
    for (const SoupKind kind : kSoupKinds) {
      for (const unsigned bits : {5u, 30u, 70u, 150u}) {
        const TriangleSoup soup = random_soup(random, kind, bits, 8);
        const typename Space::SceneSpace scene(soup.geometry(), TestFixture::kOptions);
        Space space(scene, TestFixture::kOptions);
        const auto add_all = [&](VolumePlanes<Space>& planes) {
          for (int i = 0; i < 4; ++i) {
            planes.add_through_vertices();
            planes.add_through_cut_light();
            planes.add_along_direction(bits);
            planes.add_axis_plane(0.375);
          }
        };
        VolumePlanes<Space> own(soup, space, random);
        add_all(own);
        Space empty = space.fork();
        empty.release_planes(0);
        std::vector<std::pair<PlaneRef, TruePlane>> all = own.entries();
        for (int fork = 0; fork < 2; ++fork) {
          Space forked = empty.fork();
          VolumePlanes<Space> planes(soup, forked, random);
          add_all(planes);
          const std::uint32_t count = forked.plane_mark(), before = space.plane_mark();
          space.reserve_planes(count);
          const PlaneShift shift = space.take_planes(std::move(forked));
          EXPECT_EQ(space.plane_mark(), before + count);
          for (const auto& [ref, plane] : planes.entries()) all.emplace_back(shift(ref), plane);
        }
        for (const auto& [ref, plane] : all) {
          for (const VolumeLoop<Space>& loop : own.loops()) {
            for (std::uint32_t i = 0; i < loop.size(); ++i) {
              ASSERT_EQ(space.side_of_plane(ref, loop.corner(i)), plane.side(ref, loop.exact[i]));
              ++asked;
            }
          }
          // Cut by it, and asked of another plane.
          const auto& [other, other_plane] = all[random.below(all.size())];
          const VolumeLoop<Space> cut = own.loops()[0].clipped(space, ref, plane);
          for (std::uint32_t i = 0; i < cut.size(); ++i) {
            ASSERT_EQ(space.side_of_plane(other, cut.corner(i)),
                      other_plane.side(other, cut.exact[i]));
          }
        }
        space.release_planes(0);
        EXPECT_EQ(space.plane_mark(), 0u);
      }
    }
    EXPECT_GT(asked, 10'000u);
  }
}

REGISTER_TYPED_TEST_SUITE_P(ExactVolumeSpace, PlanesOfForksAreTakenOver, SidesOfMadePointsAreTrue,
                            FacesOfAddedPlanesAreCut, BoxesAreCut,
                            PositionsAreCertifiedExactAndNearest);

}  // namespace gnomon::test

#endif  // GNOMON_TESTS_KERNEL_VOLUME_SPACE_TEST_H
