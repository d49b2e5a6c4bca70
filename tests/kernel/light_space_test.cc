// SPDX-License-Identifier: GPL-3.0-or-later
// The kernel `plane` in light space against integers: triangles seen from a light are clipped by
// each other's shadow planes, by prefix planes and by traces of support planes, and every side that
// the kernel tells is compared with the vertex's exact direction. That is found without cross
// products: a point of a clipped edge is a positive combination of the edge's two ends.
#include <gtest/gtest.h>

#include <numeric>
#include <string>
#include <vector>

#include "kernel/implicit/implicit_light_space.h"
#include "triangle_soup.h"

namespace gnomon::test {
namespace {

using Scene = ImplicitSceneSpace<CountStats>;
using Space = ImplicitLightSpace<CountStats>;

/// q by its definition (orientation.h), of a homogeneous point x / w with w > 0.
Integers q_of(const LightPoint& light, const Integers& x, const mpz_class& w) {
  const Integers& l = light.grid;
  if (!light.directional) {
    return {l[0] * w - x[0], l[1] * w - x[1], l[2] * w - x[2]};
  }
  std::size_t largest = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (abs(l[k]) > abs(l[largest])) largest = k;
  }
  const std::size_t a = (largest + 1) % 3, b = (largest + 2) % 3;
  return {x[a] * l[largest] - x[largest] * l[a], x[b] * l[largest] - x[largest] * l[b],
          l[largest] * w};
}

mpz_class value_at_light(const TriangleSoup& soup, PlaneId plane, const LightPoint& light) {
  const auto& loop = soup.loop(plane);
  const Integers a = soup.at(loop[0]);
  const Integers n = cross(minus(soup.at(loop[1]), a), minus(soup.at(loop[2]), a));
  return light.directional ? dot(n, light.grid) : dot(n, minus(light.grid, a));
}

void make_primitive(Integers& v) {
  mpz_class common = gcd(gcd(v[0], v[1]), v[2]);
  if (common > 1) {
    for (mpz_class& x : v) x /= common;
  }
}

struct TrackedVertex {
  Space::Vertex vertex;
  Integers exact;        // direction in q coordinates, up to a positive factor
  Integers homogeneous;  // position on the grid times w
  mpz_class w;
  PlaneRef after;
};

struct TrackedPlane {
  PlaneRef ref;
  Integers n;
};

class Cone {
 public:
  Cone(const TriangleSoup& soup, const LightPoint& light, Scene& scene, Space& space,
       std::uint32_t triangle)
      : space_(space), support_(triangle) {
    const bool reversed = sgn(value_at_light(soup, triangle, light)) < 0;
    for (std::uint32_t i = 0; i < 3; ++i) {
      const VertexId v = soup.loop(triangle)[reversed ? 2 - i : i];
      TrackedVertex vertex;
      vertex.vertex = space.import_vertex(scene.input_vertex(v));
      vertex.homogeneous = soup.at(v);
      vertex.w = 1;
      vertex.exact = q_of(light, vertex.homogeneous, 1);
      loop_.push_back(std::move(vertex));
    }
    for (std::uint32_t i = 0; i < 3; ++i) {
      const PlaneRef edge = soup.edge(triangle, reversed ? (4 - i) % 3 : i);
      loop_[i].after =
          space.import_edge(scene.edges().of_edge(edge.index(), edge.flipped()), triangle, reversed,
                            loop_[i].vertex, loop_[(i + 1) % 3].vertex);
      edges_.push_back({loop_[i].after, cross(loop_[i].exact, loop_[(i + 1) % 3].exact)});
    }
  }

  const std::vector<TrackedPlane>& edges() const { return edges_; }
  const std::vector<TrackedVertex>& vertices() const { return loop_; }
  Corner<Space::Vertex> corner(std::size_t i) const {
    return {loop_[(i + loop_.size() - 1) % loop_.size()].after, loop_[i].vertex, loop_[i].after,
            support_};
  }
  std::vector<Side> sides(const TrackedPlane& plane) {
    std::vector<Side> sides;
    for (std::size_t i = 0; i < loop_.size(); ++i) {
      sides.push_back(space_.side_of_plane(plane.ref, corner(i)));
      EXPECT_EQ(static_cast<int>(sides.back()), sgn(dot(plane.n, loop_[i].exact)))
          << "vertex " << i << " of " << loop_.size();
    }
    return sides;
  }

  bool clip(const TrackedPlane& plane) {
    const std::vector<Side> side = sides(plane);
    const std::size_t n = loop_.size();
    std::vector<TrackedVertex> kept;
    bool front = false;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t j = (i + 1) % n;
      front = front || side[i] == Side::kFront;
      if (side[i] != Side::kBack) {
        kept.push_back(loop_[i]);
        if (side[i] == Side::kOn && side[j] == Side::kBack) kept.back().after = plane.ref;
      }
      if (static_cast<int>(side[i]) * static_cast<int>(side[j]) == -1) {
        const bool leaving = side[i] == Side::kFront;
        TrackedVertex made;
        made.vertex = space_.crossing(plane.ref, loop_[i].after, leaving, corner(i), corner(j));
        made.after = leaving ? plane.ref : loop_[i].after;
        const mpz_class at_i = abs(dot(plane.n, loop_[i].exact)),
                        at_j = abs(dot(plane.n, loop_[j].exact));
        for (std::size_t k = 0; k < 3; ++k) {
          made.exact[k] = at_j * loop_[i].exact[k] + at_i * loop_[j].exact[k];
        }
        make_primitive(made.exact);
        kept.push_back(std::move(made));
      }
    }
    if (!front || kept.size() < 3) return false;
    loop_ = std::move(kept);
    return true;
  }

 private:
  Space& space_;
  PlaneId support_;
  std::vector<TrackedVertex> loop_;
  std::vector<TrackedPlane> edges_;
};

bool is_parallel(const Integers& a, const Integers& b) {
  const Integers c = cross(a, b);
  return c[0] == 0 && c[1] == 0 && c[2] == 0;
}

StageCounts check_soup(const TriangleSoup& soup, const LightPoint& light, Random& random,
                       unsigned bits) {
  Scene scene(soup.geometry(), {});
  Space space(scene, light, {});
  std::vector<Cone> cones;
  std::vector<TrackedPlane> planes;
  std::vector<std::uint32_t> owner;  // the triangle whose trace a plane is, else kMadeVertex
  for (std::uint32_t i = 0; i < soup.size(); ++i) {
    EXPECT_EQ(static_cast<int>(space.light_side(i)), sgn(value_at_light(soup, i, light)));
    if (value_at_light(soup, i, light) == 0) continue;
    cones.emplace_back(soup, light, scene, space, i);
    for (const TrackedPlane& edge : cones.back().edges()) planes.push_back(edge);
  }
  for (int i = 0; i < 3; ++i) {
    PrefixPlane prefix;
    for (mpz_class& x : prefix.n) {
      x = random_coordinate(random, SoupKind::kMixed, bits) * (random.chance(1, 2) ? 1 : -1);
    }
    if (prefix.n == Integers{0, 0, 0}) continue;
    planes.push_back({space.add_prefix_plane(prefix), prefix.n});
  }
  for (const Cone& cone : cones) {
    for (int attempt = 0; attempt < 2; ++attempt) {
      Cone clipped = cone;
      std::vector<Integers> used;
      for (int cut = 0; cut < 3; ++cut) {
        for (const TrackedPlane& plane : planes) {
          const bool flip = random.chance(1, 2);
          TrackedPlane asked = plane;
          if (flip) {
            asked.ref = -asked.ref;
            for (mpz_class& x : asked.n) x = -x;
          }
          clipped.sides(asked);
        }
        TrackedPlane plane = planes[random.below(planes.size())];
        bool known = false;
        for (const Integers& n : used) known = known || is_parallel(n, plane.n);
        for (const TrackedPlane& edge : cone.edges()) {
          known = known || (is_parallel(edge.n, plane.n) && !edge.ref.same_plane(plane.ref));
        }
        if (known) continue;
        if (!clipped.clip(plane)) break;
        used.push_back(plane.n);
      }
      if (testing::Test::HasFailure()) return space.stage_counts();
    }
  }
  return space.stage_counts();
}

/// The trace of one polygon's plane on another must tell the same sides as the plane itself.
void check_traces(const TriangleSoup& soup, const LightPoint& light) {
  Scene scene(soup.geometry(), {});
  Space space(scene, light, {});
  for (std::uint32_t i = 0; i < soup.size(); ++i) {
    if (value_at_light(soup, i, light) == 0) continue;
    const Cone cone(soup, light, scene, space, i);
    for (PlaneId cut = 0; cut < soup.size(); ++cut) {
      for (const bool flipped : {false, true}) {
        const bool reversed = sgn(value_at_light(soup, i, light)) < 0;
        const auto& loop = soup.loop(i);
        // Coplanar triangles have no trace; their geometry would share one plane.
        bool coplanar = true;
        for (const VertexId v : loop) {
          const Integers at = soup.at(v);
          coplanar = coplanar && soup.value(cut, {at[0], at[1], at[2]}) == 0;
        }
        if (coplanar) continue;
        const PlaneRef trace =
            space.import_edge(PlaneRef(cut, flipped), i, reversed, cone.vertices()[0].vertex,
                              cone.vertices()[1].vertex);
        for (std::size_t k = 0; k < 3; ++k) {
          const Integers at = soup.at(loop[reversed ? 2 - k : k]);
          const int truth = sgn(soup.value(cut, {at[0], at[1], at[2]})) * (flipped ? -1 : 1);
          ASSERT_EQ(static_cast<int>(space.side_of_plane(trace, cone.corner(k))), truth)
              << "plane " << cut << " on triangle " << i;
        }
      }
    }
  }
}

LightPoint random_light(Random& random, SoupKind kind, unsigned bits, bool directional) {
  LightPoint light;
  light.directional = directional;
  do {
    for (mpz_class& x : light.grid) {
      x = random_coordinate(random, kind, bits);
      if (directional && random.chance(1, 2)) x = -x;
      if (random.chance(1, directional ? 5 : 30)) x = 0;
    }
  } while (light.grid == Integers{0, 0, 0} && directional);
  if (directional) make_primitive(light.grid);
  return light;
}

struct Parameters {
  unsigned bits;
  bool directional;
};

class LightSpace : public testing::TestWithParam<Parameters> {};

TEST_P(LightSpace, EverySideIsTrue) {
  const auto [bits, directional] = GetParam();
  Random random(bits + (directional ? 1000 : 0));
  StageCounts counts;
  for (const SoupKind kind : kSoupKinds) {
    const int rounds = bits > 200 ? 3 : 25;
    for (int round = 0; round < rounds; ++round) {
      const TriangleSoup soup = random_soup(random, kind, bits, 6);
      const LightPoint light = random_light(random, kind, bits, directional);
      counts += check_soup(soup, light, random, bits);
      ASSERT_FALSE(HasFailure()) << "kind " << static_cast<int>(kind) << " round " << round;
    }
  }
  EXPECT_GT(counts.identity, 0u);
  EXPECT_GT(counts.filter, 0u);
  EXPECT_GT(counts.exactly_zero, 0u);
}

TEST_P(LightSpace, TracesAreTheirPlanes) {
  const auto [bits, directional] = GetParam();
  Random random(bits + (directional ? 3000 : 2000));
  for (const SoupKind kind : kSoupKinds) {
    for (int round = 0; round < (bits > 200 ? 2 : 12); ++round) {
      const TriangleSoup soup = random_soup(random, kind, bits, 5);
      check_traces(soup, random_light(random, kind, bits, directional));
      ASSERT_FALSE(HasFailure()) << "kind " << static_cast<int>(kind) << " round " << round;
    }
  }
}

std::vector<Parameters> all_parameters() {
  std::vector<Parameters> all;
  for (const bool directional : {false, true}) {
    // 20 and 41 are the last that fit 128 bits for a point light (6 and 3 factors), 62 the last
    // that fit 64-bit coordinates.
    for (const unsigned bits :
         {3u, 9u, 10u, 20u, 21u, 30u, 31u, 41u, 42u, 53u, 61u, 62u, 63u, 300u, 1100u, 2100u}) {
      all.push_back({bits, directional});
    }
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Bits, LightSpace, testing::ValuesIn(all_parameters()),
                         [](const auto& info) {
                           return (info.param.directional ? "Directional" : "Point") +
                                  std::to_string(info.param.bits);
                         });

/// Where products of two, three, six and nine factors reach the end of the doubles.
TEST(LightSpaceUnderflow, EverySideIsTrue) {
  Random random(77);
  for (const unsigned far :
       {119u, 179u, 180u, 184u, 215u, 269u, 355u, 359u, 365u, 535u, 541u, 1070u}) {
    for (const SoupKind kind : {SoupKind::kLattice, SoupKind::kNear, SoupKind::kFull}) {
      for (int round = 0; round < 6; ++round) {
        const unsigned bits = std::array{6u, 20u, 50u}[random.below(3)];
        const TriangleSoup soup = clustered_soup(random, kind, bits, far + bits);
        for (const bool directional : {false, true}) {
          const LightPoint light = random_light(random, kind, bits, directional);
          check_soup(soup, light, random, bits);
          check_traces(soup, light);
        }
        ASSERT_FALSE(testing::Test::HasFailure()) << "2^" << far;
      }
    }
  }
}

}  // namespace
}  // namespace gnomon::test
