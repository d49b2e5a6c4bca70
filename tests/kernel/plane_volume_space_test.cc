// SPDX-License-Identifier: GPL-3.0-or-later
// The kernel `plane` with planes of shadow volumes against rational arithmetic: triangles are
// clipped by planes through vertices of others, through corners that support planes cut off a
// light, along directions and across axes, again and again; every side, every position and every
// enclosure is compared with the exact point.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "kernel/concept/kernel_concept.h"
#include "kernel/implicit/implicit_volume_space.h"
#include "kernel/signs/nearest_double.h"
#include "triangle_soup.h"

namespace gnomon::test {
namespace {

using Space = ImplicitVolumeSpace<CountStats>;
static_assert(VolumeSpaceModel<Space> && MeasuredSpace<Space>);

/// n . x - d in rationals.
struct RationalPlane {
  Rationals n;
  mpq_class d;
  mpq_class at(const Rationals& x) const { return dot(n, x) - d; }
};

RationalPlane through(const Rationals& a, const Rationals& b, const Rationals& c) {
  RationalPlane plane{cross(minus(b, a), minus(c, a)), 0};
  plane.d = dot(plane.n, a);
  return plane;
}

bool is_zero(const Rationals& v) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }

bool is_parallel(const RationalPlane& p, const RationalPlane& q) {
  return is_zero(cross(p.n, q.n));
}

struct TrackedVertex {
  Space::Vertex vertex;
  Rationals exact;
  PlaneRef after;
};

/// The bound of the filter: the doubles' value is that of the exact plane, scaled as its normal in
/// doubles is, up to the bound that the vertex carries.
void check_filter(const Space::LoadedPlane& loaded, const RationalPlane& exact,
                  const TrackedVertex& vertex, const mpq_class& scale) {
  std::size_t largest = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (std::fabs(loaded.n[k]) > std::fabs(loaded.n[largest])) largest = k;
  }
  EXPECT_GE(std::fabs(loaded.n[largest]), 0.5);
  EXPECT_LE(std::fabs(loaded.n[largest]), 1);
  EXPECT_LE(std::fabs(loaded.d), 3);
  const std::array<double, 3>& x = vertex.vertex.x;
  const double value = loaded.n[0] * x[0] + loaded.n[1] * x[1] + loaded.n[2] * x[2] - loaded.d;
  // That component is itself off by 2u.
  const mpq_class truth =
      exact.at(vertex.exact) * scale * mpq_class(loaded.n[largest]) / exact.n[largest];
  EXPECT_LE(abs(mpq_class(value) - truth), mpq_class(static_cast<double>(vertex.vertex.bound)) +
                                               mpq_class(0x1.01p-52) * abs(truth))
      << "bound " << vertex.vertex.bound;
}

/// A loop, with the exact points beside it.
class Tracked {
 public:
  Tracked(const TriangleSoup& soup, const Space& space, std::uint32_t triangle)
      : support_(triangle), scale_(1, mpz_class(1) << soup.geometry().grid.bits()) {
    scale_.canonicalize();
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
  const TrackedVertex& operator[](std::size_t i) const { return loop_[i]; }
  Corner<Space::Vertex> corner(std::size_t i) const {
    return {loop_[(i + loop_.size() - 1) % loop_.size()].after, loop_[i].vertex, loop_[i].after,
            support_};
  }

  /// Side of every vertex; a failure for each that is wrong.
  std::vector<Side> sides(Space& space, PlaneRef plane, const RationalPlane& exact) const {
    std::vector<Side> sides;
    const auto loaded = space.load(plane);
    for (std::size_t i = 0; i < loop_.size(); ++i) {
      sides.push_back(space.side_of_plane(loaded, corner(i)));
      int truth = sgn(exact.at(loop_[i].exact));
      if (plane.flipped()) truth = -truth;
      EXPECT_EQ(static_cast<int>(sides.back()), truth) << "vertex " << i;
      EXPECT_EQ(space.side_of_plane(-plane, corner(i)), opposite(sides.back()));
      if (++asked_ % 8 == 0) check_filter(loaded, exact, loop_[i], scale_);
    }
    return sides;
  }

  /// Keeps what is in front of the plane. False if that has no area; the loop is then as it was.
  bool clip(Space& space, PlaneRef plane, const RationalPlane& exact) {
    const std::vector<Side> side = sides(space, plane, exact);
    const std::size_t n = loop_.size();
    std::vector<TrackedVertex> kept;
    bool front = false;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t j = (i + 1) % n;
      front = front || side[i] == Side::kFront;
      if (side[i] != Side::kBack) {
        kept.push_back(loop_[i]);
        if (side[i] == Side::kOn && side[j] == Side::kBack) kept.back().after = plane;
      }
      if (static_cast<int>(side[i]) * static_cast<int>(side[j]) == -1) {
        const bool leaving = side[i] == Side::kFront;
        TrackedVertex made;
        made.vertex = space.crossing(plane, loop_[i].after, leaving, corner(i), corner(j));
        made.after = leaving ? plane : loop_[i].after;
        const mpq_class at_i = exact.at(loop_[i].exact), at_j = exact.at(loop_[j].exact),
                        t = at_i / (at_i - at_j);
        for (int k = 0; k < 3; ++k) {
          made.exact[k] = loop_[i].exact[k] + t * (loop_[j].exact[k] - loop_[i].exact[k]);
        }
        kept.push_back(std::move(made));
      }
    }
    if (!front || kept.size() < 3 || testing::Test::HasFailure()) return false;
    loop_ = std::move(kept);
    return true;
  }

  /// Where the space says the corners are.
  void check_positions(const TriangleSoup& soup, const Space& space, bool nearest) const {
    const Geometry& geometry = soup.geometry();
    const mpq_class& scale = scale_;
    mpq_class extent = 0;
    for (const VertexId v : soup.loop(support_)) {
      const Integers step = minus(soup.at(v), soup.at(soup.loop(support_)[0]));
      for (const mpz_class& x : step) extent = std::max(extent, mpq_class(abs(x) * scale));
    }
    const double size = extent.get_d();
    for (std::size_t i = 0; i < loop_.size(); ++i) {
      const Rationals& exact = loop_[i].exact;
      const std::array<Ball, 3> point = space.position(corner(i));
      const Rationals position = space.exact_position(corner(i));
      const std::array<Ball, 3> offset = space.offset(soup.loop(support_)[0], corner(i));
      std::array<double, 3> rounded{};
      if (nearest) rounded = space.nearest_position(corner(i));
      for (std::size_t k = 0; k < 3; ++k) {
        const mpq_class fraction = exact[k] * scale;
        ASSERT_TRUE(point[k].is_finite());
        EXPECT_LE(abs(mpq_class(point[k].middle) - fraction), mpq_class(point[k].radius))
            << "radius " << point[k].radius;
        EXPECT_LE(point[k].radius, 0x1p-39);
        const mpq_class there = geometry.origin[k] + geometry.step * exact[k];
        EXPECT_EQ(position[k], there);
        const mpq_class step = fraction - scale * soup.at(soup.loop(support_)[0])[k];
        EXPECT_LE(abs(mpq_class(offset[k].middle) - step), mpq_class(offset[k].radius))
            << "radius " << offset[k].radius;
        if (nearest) {
          EXPECT_EQ(rounded[k], nearest_double(there));
        }
      }
      for (const Ball& x : offset) EXPECT_LE(x.radius, 0x1p-36 * size + 8 * Ball::kTiny);
    }
  }

 private:
  PlaneId support_;
  mpq_class scale_;  // 2^-b
  mutable unsigned asked_ = 0;
  std::vector<TrackedVertex> loop_;
};

/// Planes of every kind, made in a space and in rationals.
class Planes {
 public:
  Planes(const TriangleSoup& soup, Space& space, Random& random)
      : soup_(&soup), space_(&space), random_(&random) {}

  PlaneRef ref(std::size_t i) const { return refs_[i]; }
  const RationalPlane& exact(std::size_t i) const { return exact_[i]; }
  std::size_t size() const { return refs_.size(); }

  void add_supports() {
    for (PlaneId plane = 0; plane < soup_->size(); ++plane) {
      const auto& loop = soup_->loop(plane);
      add(PlaneRef(plane), through(point(loop[0]), point(loop[1]), point(loop[2])));
    }
  }
  void add_through_vertices() {
    const VertexId a = vertex(), b = vertex(), c = vertex();
    if (a == b || b == c || a == c) return;
    const Space::Vertex u = space_->input_vertex(a), v = space_->input_vertex(b),
                        w = space_->input_vertex(c);
    add_checked(space_->add_plane(lone(u), lone(v), lone(w)),
                through(point(a), point(b), point(c)));
  }
  void add_along_direction() {
    const VertexId a = vertex(), b = vertex();
    if (a == b) return;
    LightPoint light;
    light.directional = true;
    Rationals direction;
    for (std::size_t k = 0; k < 3; ++k) {
      light.grid[k] = static_cast<long>(random_->between(-9, 9));
      if (random_->chance(1, 4)) light.grid[k] = random_bits(*random_, 53);
      direction[k] = light.grid[k];
    }
    const Space::Vertex u = space_->input_vertex(a), v = space_->input_vertex(b);
    RationalPlane exact{cross(minus(point(b), point(a)), direction), 0};
    exact.d = dot(exact.n, point(a));
    add_checked(space_->add_plane(lone(u), lone(v), light), exact);
  }
  void add_axis_plane() {
    const int axis = static_cast<int>(random_->below(3));
    const double value =
        random_->chance(1, 3)
            ? static_cast<double>(random_->below(9)) / 8
            : std::ldexp(static_cast<double>(random_->below(std::uint64_t{1} << 53)), -53);
    RationalPlane exact;
    exact.n[static_cast<std::size_t>(axis)] = 1;
    exact.d = mpq_class(value) * (mpz_class(1) << soup_->geometry().grid.bits());
    add(space_->add_axis_plane(axis, value), exact);
  }
  /// Through an edge or a vertex and the corners of a light that support planes cut.
  void add_through_cut_light() {
    const auto light = static_cast<std::uint32_t>(random_->below(soup_->size()));
    Tracked loop(*soup_, *space_, light);
    for (int cut = 0; cut < 3; ++cut) {
      const auto support = static_cast<PlaneId>(random_->below(soup_->size()));
      if (is_parallel(exact_[support], exact_[light])) continue;
      Tracked before = loop;
      if (!loop.clip(*space_, PlaneRef(support, false), exact_[support])) loop = before;
    }
    for (int round = 0; round < 3; ++round) {
      const std::size_t i = random_->below(loop.size()), j = (i + 1) % loop.size();
      const VertexId a = vertex(), b = vertex();
      const Space::Vertex u = space_->input_vertex(a), v = space_->input_vertex(b);
      if (random_->chance(1, 2)) {
        add_checked(space_->add_plane(lone(u), loop.corner(i), loop.corner(j)),
                    through(point(a), loop[i].exact, loop[j].exact));
      } else if (a != b) {
        add_checked(space_->add_plane(lone(u), lone(v), loop.corner(i)),
                    through(point(a), point(b), loop[i].exact));
      }
    }
  }

 private:
  static Corner<Space::Vertex> lone(const Space::Vertex& vertex) {
    return {{}, vertex, {}, 0xffffffffu};
  }
  VertexId vertex() const {
    const auto& loop = soup_->loop(static_cast<std::uint32_t>(random_->below(soup_->size())));
    return loop[random_->below(3)];
  }
  Rationals point(VertexId v) const {
    const Integers at = soup_->at(v);
    return {at[0], at[1], at[2]};
  }
  void add(PlaneRef ref, const RationalPlane& exact) {
    EXPECT_TRUE(ref.valid());
    // Kept in the orientation of its number.
    refs_.push_back(ref);
    exact_.push_back(exact);
    if (!ref.flipped()) return;
    for (mpq_class& x : exact_.back().n) x = -x;
    exact_.back().d = -exact_.back().d;
  }
  void add_checked(PlaneRef ref, const RationalPlane& exact) {
    EXPECT_EQ(ref.valid(), !is_zero(exact.n));
    if (ref.valid()) add(ref, exact);
  }

  const TriangleSoup* soup_;
  Space* space_;
  Random* random_;
  std::vector<PlaneRef> refs_;
  std::vector<RationalPlane> exact_;
};

enum class Kinds : std::uint8_t { kAll, kThroughVertices };

StageCounts check_soup(const TriangleSoup& soup, Random& random, int extra = 6,
                       Kinds kinds = Kinds::kAll) {
  const ImplicitSceneSpace<CountStats> scene(soup.geometry(), {});
  Space space(scene, {});
  Planes planes(soup, space, random);
  planes.add_supports();
  for (int i = 0; i < extra; ++i) {
    planes.add_through_vertices();
    planes.add_through_vertices();
    if (kinds == Kinds::kThroughVertices) continue;
    planes.add_along_direction();
    planes.add_axis_plane();
    planes.add_through_cut_light();
  }
  for (std::uint32_t triangle = 0; triangle < soup.size(); ++triangle) {
    Tracked loop(soup, space, triangle);
    for (int cut = 0; cut < 4; ++cut) {
      for (std::size_t i = 0; i < planes.size(); ++i) {
        loop.sides(space, planes.ref(i), planes.exact(i));
      }
      loop.check_positions(soup, space, true);
      if (testing::Test::HasFailure()) return space.stage_counts();
      const std::size_t i = random.below(planes.size());
      loop.clip(space, planes.ref(i), planes.exact(i));
    }
  }
  return space.stage_counts();
}

class ImplicitVolumes : public testing::TestWithParam<unsigned> {};

TEST_P(ImplicitVolumes, EverySideIsTrue) {
  const unsigned bits = GetParam();
  Random random(bits);
  StageCounts counts;
  for (const SoupKind kind : kSoupKinds) {
    const int rounds = bits > 200 ? 2 : 6;
    for (int round = 0; round < rounds; ++round) {
      const int exponent = static_cast<int>(random.between(-1000, 900 - static_cast<int>(bits)));
      const TriangleSoup soup = random_soup(random, kind, bits, 6, std::max(exponent, -1000));
      counts += check_soup(soup, random);
      ASSERT_FALSE(HasFailure()) << "kind " << static_cast<int>(kind) << " round " << round;
    }
  }
  EXPECT_GT(counts.identity, 0u);
  EXPECT_GT(counts.filter, 0u);
  EXPECT_GT(counts.exactly_zero, 0u);
}

INSTANTIATE_TEST_SUITE_P(Bits, ImplicitVolumes,
                         testing::Values(3u, 6u, 7u, 10u, 11u, 13u, 14u, 17u, 20u, 21u, 27u, 28u,
                                         31u, 32u, 42u, 43u, 53u, 54u, 56u, 57u, 62u, 63u, 64u, 84u,
                                         113u, 171u, 340u),
                         testing::PrintToStringParamName());

// Which integers had to answer is decided by the bits alone, while all planes go through input
// vertices.
TEST(ImplicitVolumesStages, AreThoseOfThePlan) {
  for (const unsigned bits : {6u, 13u, 14u, 20u, 21u, 42u, 57u, 63u, 70u, 84u, 114u, 126u, 127u}) {
    Random random(1000 + bits);
    StageCounts counts;
    for (const SoupKind kind : {SoupKind::kLattice, SoupKind::kNear, SoupKind::kFull}) {
      counts += check_soup(random_soup(random, kind, bits, 6), random, 6, Kinds::kThroughVertices);
      ASSERT_FALSE(testing::Test::HasFailure()) << bits << " bits";
    }
    const auto plan = volume_precision_plan(LightCuts::kNone, bits);
    for (std::size_t i = 0; i < counts.by_width().size(); ++i) {
      const auto width = static_cast<IntegerWidth>(i);
      bool planned = false;
      for (std::size_t k = 1; k < plan.size(); ++k) {
        planned = planned || width == (bits <= 126 ? plan[k].width : IntegerWidth::kUnbounded);
      }
      if (counts.by_width()[i] > 0) {
        EXPECT_TRUE(planned) << width_name(width) << ", b = " << bits;
      }
    }
  }
}

// A fork has the planes so far, and what either adds later is its own.
TEST(ImplicitVolumesForks, AreApart) {
  Random random(3);
  const TriangleSoup soup = random_soup(random, SoupKind::kFull, 20, 6);
  const ImplicitSceneSpace<CountStats> scene(soup.geometry(), {});
  Space space(scene, {});
  Planes planes(soup, space, random);
  planes.add_supports();
  for (int i = 0; i < 6; ++i) planes.add_through_vertices();
  planes.add_axis_plane();
  Space fork = space.fork();
  EXPECT_EQ(fork.plane_mark(), space.plane_mark());
  EXPECT_EQ(fork.stage_counts().total(), 0u);
  const std::uint32_t mark = space.plane_mark();
  Planes more(soup, fork, random);
  more.add_supports();
  for (int i = 0; i < 20; ++i) {
    planes.add_axis_plane();
    planes.add_through_cut_light();
    more.add_through_cut_light();
    more.add_axis_plane();
  }
  for (std::uint32_t triangle = 0; triangle < soup.size(); ++triangle) {
    const Tracked loop(soup, space, triangle);
    for (std::size_t i = 0; i < planes.size(); ++i) {
      loop.sides(space, planes.ref(i), planes.exact(i));
    }
    for (std::size_t i = 0; i < more.size(); ++i) loop.sides(fork, more.ref(i), more.exact(i));
  }
  space.release_planes(mark);
  EXPECT_EQ(space.plane_mark(), mark);
  const std::size_t kept = soup.size() + mark;
  for (std::size_t i = 0; i < kept; ++i) {
    Tracked(soup, space, 0).sides(space, planes.ref(i), planes.exact(i));
  }
  Planes again(soup, space, random);
  again.add_supports();
  for (int i = 0; i < 6; ++i) again.add_through_cut_light();
  for (std::size_t i = 0; i < again.size(); ++i) {
    Tracked(soup, space, 0).sides(space, again.ref(i), again.exact(i));
  }
}

TEST(ImplicitVolumesUnderflow, EverySideIsTrue) {
  Random random(78);
  for (const unsigned far : {119u, 180u, 269u, 359u, 541u, 1070u}) {
    for (const SoupKind kind : {SoupKind::kLattice, SoupKind::kNear, SoupKind::kFull}) {
      for (int round = 0; round < 2; ++round) {
        const unsigned bits = std::array{6u, 20u, 50u}[random.below(3)];
        check_soup(clustered_soup(random, kind, bits, far + bits), random, 2);
        ASSERT_FALSE(testing::Test::HasFailure()) << "2^" << far;
      }
    }
  }
}

}  // namespace
}  // namespace gnomon::test
