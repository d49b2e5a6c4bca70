// SPDX-License-Identifier: GPL-3.0-or-later
// The kernel `plane` in three dimensions against rational arithmetic: triangles are clipped by
// support planes, again and again, and every side that the kernel tells, for input vertices, for
// edges met by a plane and for three planes, is compared with the vertex's exact coordinates. A
// filter that certifies a wrong sign, a wrong identity or an integer that overflows shows here.
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "kernel/implicit/implicit_scene_space.h"
#include "triangle_soup.h"

namespace gnomon::test {
namespace {

using Space = ImplicitSceneSpace<CountStats>;

struct TrackedVertex {
  Space::Vertex vertex;
  Rationals exact;
  PlaneRef after;  // plane of the edge that starts here
};

class Clipper {
 public:
  Clipper(const TriangleSoup& soup, Space& space, std::uint32_t triangle)
      : soup_(soup), space_(space), support_(triangle) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      const VertexId v = soup.loop(triangle)[i];
      const Integers at = soup.at(v);
      const PlaneRef edge = soup.edge(triangle, i);
      loop_.push_back({space.input_vertex(v),
                       {at[0], at[1], at[2]},
                       space.edges().of_edge(edge.index(), edge.flipped())});
    }
  }

  std::size_t size() const { return loop_.size(); }
  Corner<Space::Vertex> corner(std::size_t i) const {
    return {loop_[(i + loop_.size() - 1) % loop_.size()].after, loop_[i].vertex, loop_[i].after,
            support_};
  }

  /// Side of every vertex; a failure for each that is wrong.
  std::vector<Side> sides(PlaneRef plane) {
    std::vector<Side> sides;
    for (std::size_t i = 0; i < loop_.size(); ++i) {
      sides.push_back(space_.side_of_plane(plane, corner(i)));
      int truth = sgn(soup_.value(plane.index(), loop_[i].exact));
      if (plane.flipped()) truth = -truth;
      EXPECT_EQ(static_cast<int>(sides.back()), truth) << "vertex " << i;
    }
    return sides;
  }

  /// Keeps what is in front of the plane. False if that has no area.
  bool clip(PlaneRef plane) {
    const std::vector<Side> side = sides(plane);
    const std::size_t n = loop_.size();
    std::vector<TrackedVertex> kept;
    bool front = false;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t j = (i + 1) % n;
      front = front || side[i] == Side::kFront;
      if (side[i] != Side::kBack) {
        kept.push_back(loop_[i]);
        // The cut starts at a vertex on the plane whose next vertex is behind.
        if (side[i] == Side::kOn && side[j] == Side::kBack) kept.back().after = plane;
      }
      if (static_cast<int>(side[i]) * static_cast<int>(side[j]) == -1) {
        const bool leaving = side[i] == Side::kFront;
        TrackedVertex made;
        made.vertex = space_.crossing(plane, loop_[i].after, leaving, corner(i), corner(j));
        made.after = leaving ? plane : loop_[i].after;
        const mpq_class at_i = soup_.value(plane.index(), loop_[i].exact),
                        at_j = soup_.value(plane.index(), loop_[j].exact), t = at_i / (at_i - at_j);
        for (int k = 0; k < 3; ++k) {
          made.exact[k] = loop_[i].exact[k] + t * (loop_[j].exact[k] - loop_[i].exact[k]);
        }
        kept.push_back(std::move(made));
      }
    }
    if (!front || kept.size() < 3) return false;
    loop_ = std::move(kept);
    return true;
  }

 private:
  const TriangleSoup& soup_;
  Space& space_;
  PlaneId support_;
  std::vector<TrackedVertex> loop_;
};

/// Two planes that are one, by proportional coefficients: the geometry of a scene has none.
bool is_same_plane(const TriangleSoup& soup, PlaneId a, PlaneId b) {
  for (const VertexId v : soup.loop(b)) {
    const Integers at = soup.at(v);
    if (soup.value(a, {at[0], at[1], at[2]}) != 0) return false;
  }
  return true;
}

/// All triangles, each clipped by up to three random planes, all sides asked after every cut.
StageCounts check_soup(const TriangleSoup& soup, Random& random) {
  Space space(soup.geometry(), {});
  for (std::uint32_t triangle = 0; triangle < soup.size(); ++triangle) {
    Clipper clipper(soup, space, triangle);
    std::vector<PlaneId> cutters;
    for (int cut = 0; cut < 4; ++cut) {
      for (PlaneId plane = 0; plane < soup.size(); ++plane) {
        bool known = is_same_plane(soup, triangle, plane);
        for (const PlaneId cutter : cutters) known = known || is_same_plane(soup, cutter, plane);
        if (known && plane != triangle) continue;
        clipper.sides(PlaneRef(plane, random.chance(1, 2)));
      }
      const auto plane = static_cast<PlaneId>(random.below(soup.size()));
      bool used = is_same_plane(soup, triangle, plane);
      for (const PlaneId cutter : cutters) used = used || is_same_plane(soup, cutter, plane);
      if (used) continue;
      if (!clipper.clip(PlaneRef(plane, random.chance(1, 2)))) break;
      cutters.push_back(plane);
    }
    if (testing::Test::HasFailure()) break;
  }
  return space.stage_counts();
}

class SceneSpace : public testing::TestWithParam<unsigned> {};

TEST_P(SceneSpace, EverySideIsTrue) {
  const unsigned bits = GetParam();
  Random random(bits);
  StageCounts counts;
  for (const SoupKind kind : kSoupKinds) {
    const int rounds = bits > 200 ? 4 : 20;
    for (int round = 0; round < rounds; ++round) {
      const int exponent = static_cast<int>(random.between(-1000, 1000));
      const TriangleSoup soup = random_soup(random, kind, bits, 6, exponent);
      counts += check_soup(soup, random);
      ASSERT_FALSE(HasFailure()) << "kind " << static_cast<int>(kind) << " round " << round;
    }
  }
  EXPECT_GT(counts.identity, 0u);
  EXPECT_GT(counts.filter, 0u);
  EXPECT_GT(counts.exactly_zero, 0u);
  // Which integers had to answer is decided by the bits alone: three kinds of vertices. On the
  // smallest grids the filter decides all about the third kind.
  const std::set<IntegerWidth> planned = {narrowest_width(side_of_support_bits(bits)),
                                          narrowest_width(edge_against_plane_bits(bits)),
                                          narrowest_width(four_planes_bits(bits))};
  for (std::size_t i = 0; i < counts.by_width().size(); ++i) {
    const auto width = static_cast<IntegerWidth>(i);
    if (counts.by_width()[i] > 0) {
      EXPECT_TRUE(planned.contains(width)) << width_name(width);
    } else if (bits > 10) {
      EXPECT_FALSE(planned.contains(width)) << width_name(width);
    }
  }
}

// The last grids whose predicates fit 64, 128, 256, 512 and 1024 bits, and one bit more: 20, 42,
// 84, 170, 340 (3 factors), 10, 20, 42, 84, 170 (6), 6, 13, 27, 56, 113 (9); 62 is the last that is
// stored in 64 bits.
INSTANTIATE_TEST_SUITE_P(Bits, SceneSpace,
                         testing::Values(3u, 6u, 7u, 10u, 11u, 13u, 14u, 20u, 21u, 27u, 28u, 42u,
                                         43u, 53u, 56u, 57u, 62u, 63u, 84u, 85u, 113u, 114u, 170u,
                                         171u, 340u, 341u, 1100u, 2100u),
                         testing::PrintToStringParamName());

TEST(SceneSpaceStages, EachStageAnswersWhatIsItsOwn) {
  // A floor, a wall through its middle, and a triangle that touches the floor at (1, 1, 0).
  const TriangleSoup soup({{{{0, 0, 0}, {8, 0, 0}, {0, 8, 0}}},
                           {{{2, 0, 0}, {2, 8, 0}, {2, 0, 8}}},
                           {{{1, 1, 0}, {3, 5, 8}, {7, 1, 8}}}},
                          0);
  Space space(soup.geometry(), {});
  const auto corner = [&](std::uint32_t triangle, std::uint32_t i, Space::Vertex& vertex) {
    vertex = space.input_vertex(soup.loop(triangle)[i]);
    const auto name = [&](std::uint32_t k) {
      const PlaneRef edge = soup.edge(triangle, k % 3);
      return space.edges().of_edge(edge.index(), edge.flipped());
    };
    return Corner<Space::Vertex>{name(i + 2), vertex, name(i), triangle};
  };
  Space::Vertex vertex;
  EXPECT_EQ(space.side_of_plane(PlaneRef(0), corner(0, 1, vertex)), Side::kOn);
  EXPECT_EQ(space.stage_counts().identity, 1u);
  EXPECT_EQ(space.side_of_plane(PlaneRef(0), corner(2, 1, vertex)), Side::kFront);
  EXPECT_EQ(space.side_of_plane(PlaneRef(0, true), corner(2, 1, vertex)), Side::kBack);
  EXPECT_EQ(space.stage_counts().filter, 2u);
  EXPECT_EQ(space.side_of_plane(PlaneRef(0), corner(2, 0, vertex)), Side::kOn);
  EXPECT_EQ(space.stage_counts().exact64, 1u);
  EXPECT_EQ(space.stage_counts().exactly_zero, 1u);
  EXPECT_EQ(space.stage_counts().total(), 4u);
}

/// Where products of two, three, six and nine factors reach the end of the doubles.
TEST(SceneSpaceUnderflow, EverySideIsTrue) {
  Random random(77);
  for (const unsigned far :
       {119u, 179u, 180u, 184u, 215u, 269u, 355u, 359u, 365u, 535u, 541u, 1070u}) {
    for (const SoupKind kind : {SoupKind::kLattice, SoupKind::kNear, SoupKind::kFull}) {
      for (int round = 0; round < 6; ++round) {
        const unsigned bits = std::array{6u, 20u, 50u}[random.below(3)];
        const TriangleSoup soup = clustered_soup(random, kind, bits, far + bits);
        check_soup(soup, random);
        ASSERT_FALSE(testing::Test::HasFailure()) << "2^" << far;
      }
    }
  }
}

}  // namespace
}  // namespace gnomon::test
