// SPDX-License-Identifier: GPL-3.0-or-later
// The precision plan's promise: a predicate that it gives to integers of some width cannot overflow
// there. Each width is driven to its last bit, with the largest operands that the plan lets
// through, and compared with unbounded integers; one bit more, and the plan chooses the next width,
// because the values would no longer fit.
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <string>

#include "gnomon/kernel/precision_plan.h"
#include "kernel/implicit/exact_geometry.h"
#include "kernel/implicit/exact_predicates.h"
#include "kernel/implicit/exact_shadow_plane.h"
#include "kernel/numbers/exact_integer.h"
#include "triangle_soup.h"

namespace gnomon::test {
namespace {

/// Bits of a two's complement integer that holds the value.
unsigned signed_bits(const mpz_class& value) {
  const mpz_class magnitude = value < 0 ? mpz_class(-value - 1) : value;
  return magnitude == 0 ? 1 : static_cast<unsigned>(mpz_sizeinbase(magnitude.get_mpz_t(), 2)) + 1;
}

mpz_class to_gmp(std::int64_t value) { return static_cast<long>(value); }
mpz_class to_gmp(const Int128& value) { return to_mpz(WideInteger<2>(value)); }
template <std::size_t Limbs>
mpz_class to_gmp(const WideInteger<Limbs>& value) {
  return to_mpz(value);
}
const mpz_class& to_gmp(const mpz_class& value) { return value; }

template <class Int>
Vector3<Int> vector_from(const Integers& v) {
  return {integer_from<Int>(v[0]), integer_from<Int>(v[1]), integer_from<Int>(v[2])};
}

/// Magnitudes below 2^bits: mostly the very largest, with every pattern of signs.
Integers extreme(Random& random, unsigned bits) {
  Integers v;
  for (mpz_class& x : v) {
    x = (mpz_class(1) << bits) - 1;
    if (random.chance(1, 6)) x -= static_cast<unsigned long>(random.below(3));
    if (random.chance(1, 10)) x = random_bits(random, bits);
    if (random.chance(1, 2)) x = -x;
  }
  return v;
}

constexpr std::array<IntegerWidth, 5> kFixedWidths = {IntegerWidth::k64, IntegerWidth::k128,
                                                      IntegerWidth::k256, IntegerWidth::k512,
                                                      IntegerWidth::k1024};
constexpr unsigned bits_of(IntegerWidth width) { return 64u << static_cast<unsigned>(width); }

TEST(IntegerWidth, ChangesAtItsLimit) {
  EXPECT_EQ(narrowest_width(1), IntegerWidth::k64);
  for (const IntegerWidth width : kFixedWidths) {
    const auto next = static_cast<IntegerWidth>(static_cast<unsigned>(width) + 1);
    EXPECT_EQ(narrowest_width(bits_of(width)), width);
    EXPECT_EQ(narrowest_width(bits_of(width) + 1), next);
    EXPECT_EQ(with_width(width, []<class Int>() { return 64 * kLimbsOf<Int>; }), bits_of(width));
    EXPECT_EQ(width_name(width), std::to_string(bits_of(width)));
  }
  EXPECT_EQ(narrowest_width(1u << 20), IntegerWidth::kUnbounded);
  EXPECT_EQ(width_name(IntegerWidth::kUnbounded), "GMP");
}

// --- The two determinants, on any operands of so many bits. ---

/// n . q in Int, and the most bits that a value had.
template <class Int>
unsigned check_side_of_input_vertex(unsigned n_bits, unsigned q_bits) {
  Random random(n_bits);
  unsigned most = 0;
  for (int round = 0; round < 2000; ++round) {
    const Integers n = extreme(random, n_bits), q = extreme(random, q_bits);
    const mpz_class exact = test::dot(n, q);
    const mpz_class computed = to_gmp(gnomon::dot(vector_from<Int>(n), vector_from<Int>(q)));
    if (computed != exact) {
      ADD_FAILURE() << computed << " is not " << exact;
      break;
    }
    most = std::max(most, signed_bits(exact));
  }
  return most;
}

template <class Int>
unsigned check_side_of_crossing(unsigned n, unsigned m, unsigned l) {
  Random random(n + m + l);
  unsigned most = 0;
  for (int round = 0; round < 2000; ++round) {
    const Integers a = extreme(random, n), b = extreme(random, m), c = extreme(random, l);
    const mpz_class exact = test::dot(a, test::cross(b, c));
    const Vector3<Int> x = vector_from<Int>(a), y = vector_from<Int>(b), z = vector_from<Int>(c);
    const mpz_class computed = to_gmp(determinant<Int>(x, y, z));
    if (computed != exact || static_cast<int>(sign_of_determinant(x, y, z)) != sgn(exact)) {
      ADD_FAILURE() << computed << " is not " << exact;
      break;
    }
    most = std::max(most, signed_bits(exact));
  }
  return most;
}

TEST(IntegerWidth, SideOfInputVertexAtTheLastBit) {
  for (const IntegerWidth width : kFixedWidths) {
    const unsigned bits = bits_of(width), q = bits / 3, n = bits - 3 - q;
    ASSERT_EQ(narrowest_width(side_of_input_vertex_bits(n, q)), width);
    ASSERT_GT(narrowest_width(side_of_input_vertex_bits(n, q + 1)), width);
    const unsigned most =
        with_width(width, [&]<class Int>() { return check_side_of_input_vertex<Int>(n, q); });
    EXPECT_EQ(most, bits);
    // One past: the values need the next width.
    EXPECT_EQ(check_side_of_input_vertex<mpz_class>(n, q + 1), bits + 1);
  }
}

TEST(IntegerWidth, SideOfCrossingAtTheLastBit) {
  for (const IntegerWidth width : kFixedWidths) {
    const unsigned bits = bits_of(width), third = (bits - 3) / 3;
    for (const std::array<unsigned, 3>& split :
         {std::array{third, third, bits - 3 - 2 * third}, std::array{10u, third, bits - 13 - third},
          std::array{bits - 13 - third, 10u, third}}) {
      const auto [n, m, l] = split;
      ASSERT_EQ(narrowest_width(side_of_crossing_bits(n, m, l)), width);
      ASSERT_GT(narrowest_width(side_of_crossing_bits(n + 1, m, l)), width);
      const unsigned most =
          with_width(width, [&]<class Int>() { return check_side_of_crossing<Int>(n, m, l); });
      EXPECT_EQ(most, bits);
      EXPECT_EQ(check_side_of_crossing<mpz_class>(n + 1, m, l), bits + 1);
    }
  }
}

/// Four planes by their normals (below 2^n) and their values at one point (below 2^v).
struct FourPlanes {
  std::array<Integers, 4> n;
  std::array<mpz_class, 4> values;

  mpz_class minor(std::size_t i, std::size_t j, std::size_t k) const {
    return test::dot(n[i], test::cross(n[j], n[k]));
  }
  mpz_class value() const {
    return values[3] * minor(0, 1, 2) - values[0] * minor(3, 1, 2) - values[1] * minor(3, 2, 0) -
           values[2] * minor(3, 0, 1);
  }
  int sign() const { return sgn(value()) * sgn(minor(0, 1, 2)); }
};

FourPlanes extreme_planes(Random& random, unsigned n, unsigned v) {
  FourPlanes planes;
  for (Integers& normal : planes.n) normal = extreme(random, n);
  for (mpz_class& value : planes.values) value = extreme(random, v)[0];
  if (random.chance(1, 4)) {
    // Each minor of rows of a Hadamard matrix is 4 2^(3n), and values of the right signs add them.
    const mpz_class most = (mpz_class(1) << n) - 1;
    planes.n = {Integers{most, most, most}, Integers{most, -most, -most},
                Integers{-most, most, -most}, Integers{-most, -most, most}};
    const mpz_class largest = (mpz_class(1) << v) - 1;
    planes.values = {largest, largest, largest, largest};
    if (sgn(planes.minor(0, 1, 2)) < 0) planes.values[3] = -largest;
    if (sgn(planes.minor(3, 1, 2)) > 0) planes.values[0] = -largest;
    if (sgn(planes.minor(3, 2, 0)) > 0) planes.values[1] = -largest;
    if (sgn(planes.minor(3, 0, 1)) > 0) planes.values[2] = -largest;
  }
  if (random.chance(1, 4)) planes.values[random.below(4)] = 0;
  return planes;
}

/// The most bits that a value had, and how many signs were wrong.
template <class Factor, class Int>
std::pair<unsigned, int> check_meets(unsigned n, unsigned v) {
  using Value = Product<Int, Factor, Factor>;
  Random random(n + v);
  unsigned most = 0;
  int wrong = 0;
  for (int round = 0; round < 2000; ++round) {
    const FourPlanes planes = extreme_planes(random, n, v);
    const std::array<Vector3<Factor>, 3> normals = {vector_from<Factor>(planes.n[0]),
                                                    vector_from<Factor>(planes.n[1]),
                                                    vector_from<Factor>(planes.n[2])};
    const std::array<Value, 3> values = {integer_from<Value>(planes.values[0]),
                                         integer_from<Value>(planes.values[1]),
                                         integer_from<Value>(planes.values[2])};
    const Sign sign = sign_at_meet<Int>(normals, values, vector_from<Factor>(planes.n[3]),
                                        integer_from<Value>(planes.values[3]));
    wrong += static_cast<int>(sign) != planes.sign() ? 1 : 0;
    most = std::max(most, signed_bits(planes.value()));
  }
  return {most, wrong};
}

TEST(IntegerWidth, SideOfMeetAtTheLastBit) {
  for (const IntegerWidth width : kFixedWidths) {
    const unsigned bits = bits_of(width);
    // Values of at least as many bits as normals; the last one takes what is left.
    const unsigned n = (bits - 5) / 5, v = bits - 5 - 3 * n;
    ASSERT_EQ(narrowest_width(volume_meet_bits(3 * n + v)), width);
    ASSERT_GT(narrowest_width(volume_meet_bits(3 * n + v + 1)), width);
    const auto [most, wrong] = with_widths(
        width, n, [&]<class Factor, class Int>() { return check_meets<Factor, Int>(n, v); });
    EXPECT_EQ(most, bits);
    EXPECT_EQ(wrong, 0);
    // One past: the values need the next width, and signs are wrong without it.
    const auto [most_past, wrong_unbounded] = check_meets<mpz_class, mpz_class>(n, v + 1);
    EXPECT_EQ(most_past, bits + 1);
    EXPECT_EQ(wrong_unbounded, 0);
  }
  EXPECT_GT((check_meets<Int256, Int256>(50, 102).second), 0);
}

// What happens if the plan is not asked: the sign of a true value one bit too large is wrong.
template <class Int>
void expect_wrong_signs_past_the_last_bit() {
  constexpr unsigned kThird = (Int::kBits - 3) / 3;
  Random random(Int::kBits);
  int wrong = 0;
  for (int round = 0; round < 2000; ++round) {
    const Integers a = extreme(random, Int::kBits - 3 - 2 * kThird + 1),
                   b = extreme(random, kThird), c = extreme(random, kThird);
    const mpz_class exact = test::dot(a, test::cross(b, c));
    const Sign sign =
        sign_of_determinant(vector_from<Int>(a), vector_from<Int>(b), vector_from<Int>(c));
    const bool fits = signed_bits(exact) <= Int::kBits;
    if (fits) {
      EXPECT_EQ(static_cast<int>(sign), sgn(exact));
    } else {
      wrong += static_cast<int>(sign) != sgn(exact) ? 1 : 0;
    }
  }
  EXPECT_GT(wrong, 0);
}

TEST(IntegerWidth, SignsAreWrongPastTheLastBit) {
  expect_wrong_signs_past_the_last_bit<Int256>();
  expect_wrong_signs_past_the_last_bit<Int512>();
  expect_wrong_signs_past_the_last_bit<Int1024>();
}

// --- Predicates on positions of a grid of b bits. ---

/// Positions with coordinates at the ends of [0, 2^b - 1], rarely within.
Integers corner(Random& random, unsigned b) {
  Integers v;
  for (mpz_class& x : v) {
    x = random.chance(1, 2) ? mpz_class((mpz_class(1) << b) - 1) : mpz_class(0);
    if (random.chance(1, 40)) x = random_bits(random, b);
  }
  return v;
}

struct Extremes {
  std::array<Integers, 12> p;
  Integers light, direction;
};

Extremes random_extremes(Random& random, unsigned b, unsigned e) {
  Extremes x;
  for (Integers& p : x.p) p = corner(random, b);
  x.light = corner(random, b);
  if (random.chance(1, 20)) {
    // Shadow planes whose normals are the rows of a Hadamard matrix: 4 D^6.
    const mpz_class most = (mpz_class(1) << b) - 1;
    const Integers u = {most, most, 0}, v = {0, most, most}, w = {most, 0, most};
    x.light = {0, 0, 0};
    x.p[0] = x.p[2] = u;
    x.p[1] = x.p[4] = v;
    x.p[3] = x.p[5] = w;
  }
  do {
    x.direction = extreme(random, e);
  } while (x.direction[2] == 0);
  return x;
}

/// The last b for which a predicate fits each fixed width: Int agrees with GMP there, some value
/// needs `slack` bits less than planned, and at b + 1 some value does not fit any more where
/// nothing is slack.
void check_at_the_limits(
    const std::function<unsigned(unsigned)>& planned_bits, unsigned slack,
    const std::function<mpz_class(const Extremes&)>& exact,
    const std::function<void(const Extremes&, unsigned b, IntegerWidth, const mpz_class&)>& check,
    unsigned e = 12) {
  for (const IntegerWidth width : kFixedWidths) {
    unsigned b = 1;
    while (planned_bits(b + 1) <= bits_of(width)) ++b;
    ASSERT_EQ(narrowest_width(planned_bits(b)), width);
    ASSERT_GT(narrowest_width(planned_bits(b + 1)), width);
    Random random(b);
    unsigned most = 0, most_past = 0;
    for (int round = 0; round < 4000; ++round) {
      const Extremes x = random_extremes(random, b, e);
      const mpz_class value = exact(x);
      most = std::max(most, signed_bits(value));
      check(x, b, width, value);
      most_past = std::max(most_past, signed_bits(exact(random_extremes(random, b + 1, e))));
      ASSERT_FALSE(testing::Test::HasFailure()) << "b = " << b;
    }
    EXPECT_LE(most, planned_bits(b));
    EXPECT_GE(most + slack, planned_bits(b)) << "b = " << b;
    if (slack == 0) {
      EXPECT_GT(most_past, bits_of(width)) << "b = " << b;
    }
  }
}

Integers normal_of(const Integers& a, const Integers& b, const Integers& c) {
  return cross(minus(b, a), minus(c, a));
}
mpz_class value_of(const Extremes& x, int plane, int vertex) {
  return dot(normal_of(x.p[plane], x.p[plane + 1], x.p[plane + 2]), minus(x.p[vertex], x.p[plane]));
}

TEST(PlanAtItsLimits, SupportPlaneAtAnInputVertex) {
  check_at_the_limits(
      side_of_support_bits, 0, [](const Extremes& x) { return value_of(x, 0, 3); },
      [](const Extremes& x, unsigned, IntegerWidth width, const mpz_class& exact) {
        Geometry geometry;
        std::vector<mpz_class> coordinates;
        for (int i = 0; i < 4; ++i) {
          coordinates.insert(coordinates.end(), x.p[i].begin(), x.p[i].end());
        }
        geometry.grid = GridPositions::from(std::move(coordinates));
        geometry.planes = {{0, 1, 2}};
        with_width(width, [&]<class Int>() {
          EXPECT_EQ(to_gmp(ExactGeometry<Int>(geometry).value(0, 3)), exact);
        });
      });
}

TEST(PlanAtItsLimits, InputVertexAgainstShadowPlane) {
  for (const bool directional : {false, true}) {
    const auto exact = [=](const Extremes& x) {
      if (directional) return dot(x.direction, normal_of(x.p[0], x.p[1], x.p[2]));
      return dot(minus(x.light, x.p[0]), cross(minus(x.light, x.p[1]), minus(x.light, x.p[2])));
    };
    check_at_the_limits(
        [=](unsigned b) { return side_of_edge_bits(directional, b, 12); }, directional ? 1 : 0,
        exact,
        [=](const Extremes& x, unsigned b, IntegerWidth width, const mpz_class& value) {
          with_widths(width, b, [&]<class Position, class Int>() {
            const Sign sign = side_of_shadow_plane<Int>(
                directional, vector_from<Position>(directional ? x.direction : x.light),
                vector_from<Position>(x.p[0]), vector_from<Position>(x.p[1]),
                vector_from<Position>(x.p[2]));
            EXPECT_EQ(static_cast<int>(sign), sgn(value));
          });
        });
  }
}

template <class Plane, class Position>
Vector3<Plane> edge_plane(bool directional, const Extremes& x, int i) {
  const auto a = vector_from<Position>(x.p[i]), b = vector_from<Position>(x.p[i + 1]);
  return directional ? directional_shadow_plane<Plane>(vector_from<Position>(x.direction), a, b)
                     : point_shadow_plane<Plane>(vector_from<Position>(x.light), a, b);
}

TEST(PlanAtItsLimits, CrossingAgainstShadowPlane) {
  for (const bool directional : {false, true}) {
    check_at_the_limits(
        [=](unsigned b) {
          const LightPlaneBits edge = edge_plane_bits(directional, b, 12);
          return side_of_crossing_bits(edge, edge, edge);
        },
        directional ? 3 : 0,
        [=](const Extremes& x) {
          const auto plane = [&](int i) {
            return edge_plane<mpz_class, mpz_class>(directional, x, i);
          };
          return dot(plane(0), cross(plane(2), plane(4)));
        },
        [=](const Extremes& x, unsigned b, IntegerWidth width, const mpz_class& exact) {
          const unsigned factor = edge_plane_bits(directional, b, 12).largest();
          with_widths(width, factor, [&]<class Plane, class Int>() {
            const Sign sign = sign_of_determinant<Int>(edge_plane<Plane, Plane>(directional, x, 0),
                                                       edge_plane<Plane, Plane>(directional, x, 2),
                                                       edge_plane<Plane, Plane>(directional, x, 4));
            EXPECT_EQ(static_cast<int>(sign), sgn(exact));
          });
        });
  }
}

TEST(PlanAtItsLimits, EdgeAgainstSupportPlane) {
  check_at_the_limits(
      edge_against_plane_bits, 2,
      [](const Extremes& x) {
        return mpz_class(value_of(x, 0, 10) * value_of(x, 3, 11) -
                         value_of(x, 0, 11) * value_of(x, 3, 10));
      },
      [](const Extremes& x, unsigned b, IntegerWidth width, const mpz_class& exact) {
        with_widths(width, support_value_bits(b), [&]<class Value, class Int>() {
          const auto value = [&](int plane, int vertex) {
            return integer_from<Value>(value_of(x, plane, vertex));
          };
          EXPECT_EQ(to_gmp(Int(multiply<Int>(value(0, 10), value(3, 11)) -
                               multiply<Int>(value(0, 11), value(3, 10)))),
                    exact);
        });
      });
}

// The planes and sides without the common factor are those of q, which orientation.h defines.
TEST(ExactShadowPlane, IsThatOfTheMapQ) {
  Random random(5);
  for (int round = 0; round < 4000; ++round) {
    const unsigned b = std::array{3u, 17u, 40u, 62u}[random.below(4)];
    Extremes x = random_extremes(random, b, 1 + static_cast<unsigned>(random.below(60)));
    for (Integers& p : x.p) {
      if (random.chance(1, 2)) p = {random_bits(random, b), random_bits(random, b), 0};
    }
    const Integers& d = x.direction;
    const auto q = [&](const Integers& v) -> Integers {
      return {v[0] * d[2] - v[2] * d[0], v[1] * d[2] - v[2] * d[1], d[2]};
    };
    const Integers plane = edge_plane<mpz_class, mpz_class>(true, x, 0),
                   factored = cross(q(x.p[0]), q(x.p[1]));
    for (int k = 0; k < 3; ++k) ASSERT_EQ(plane[k] * abs(d[2]), factored[k]);
    ASSERT_EQ(static_cast<int>(side_of_shadow_plane<mpz_class>(true, d, x.p[0], x.p[1], x.p[2])),
              sgn(dot(factored, q(x.p[2]))));
    const auto from_light = [&](int i) { return minus(x.light, x.p[i]); };
    ASSERT_EQ(
        static_cast<int>(side_of_shadow_plane<mpz_class>(false, x.light, x.p[0], x.p[1], x.p[2])),
        sgn(dot(cross(from_light(0), from_light(1)), from_light(2))));
  }
}

// --- The plan as a table. ---

using Values = std::map<std::string, std::vector<mpz_class>>;

/// Every value that the plan bounds, for one choice of extreme positions.
Values values_of(const Extremes& x, bool directional, unsigned b) {
  struct Plane {
    Integers n;
    mpz_class d;
  };
  const auto support = [&](int i) -> Plane {
    const Integers n = normal_of(x.p[i], x.p[i + 1], x.p[i + 2]);
    return {n, dot(n, x.p[i])};
  };
  const auto cut = [&](int first, int second) -> Integers {
    const Plane i = support(first), j = support(second);
    Integers result;
    if (directional) {
      const mpz_class hi = dot(i.n, x.direction), hj = dot(j.n, x.direction);
      for (int k = 0; k < 2; ++k) result[k] = hi * j.n[k] - hj * i.n[k];
      result[2] = hj * i.d - hi * j.d;
    } else {
      const mpz_class hi = dot(i.n, x.light) - i.d, hj = dot(j.n, x.light) - j.d;
      for (int k = 0; k < 3; ++k) result[k] = hj * i.n[k] - hi * j.n[k];
    }
    return result;
  };
  const auto edge = [&](int i) -> Integers {
    return edge_plane<mpz_class, mpz_class>(directional, x, i);
  };
  const mpz_class largest = (mpz_class(1) << b) - 1;
  const Integers prefix = {largest, 0, -largest}, prefix_v = {0, -largest, -largest};
  const auto det = [](const Integers& l, const Integers& m, const Integers& n) {
    return dot(l, cross(m, n));
  };
  const Integers a = edge(0), c = edge(2), f = edge(4), s = cut(0, 3), t = cut(6, 9), r = cut(1, 7);
  const Plane p0 = support(0), p1 = support(3), p2 = support(6), p3 = support(9);
  const mpz_class four = p0.d * det(p1.n, p2.n, p3.n) - p1.d * det(p2.n, p3.n, p0.n) +
                         p2.d * det(p3.n, p0.n, p1.n) - p3.d * det(p0.n, p1.n, p2.n);
  const mpz_class input = directional ? dot(x.direction, normal_of(x.p[0], x.p[1], x.p[2]))
                                      : dot(edge(0), minus(x.light, x.p[2]));
  const mpz_class at_vertex = value_of(x, 0, 3);
  return {
      {"support normal", {p0.n[0], p0.n[1], p0.n[2]}},
      {"input vertex against support plane", {at_vertex, p0.d}},
      {"scene split: edge against support plane",
       {value_of(x, 0, 10) * value_of(x, 3, 11) - value_of(x, 0, 11) * value_of(x, 3, 10)}},
      {"scene split: four support planes", {four}},
      {"shadow plane of an edge", {a[0], a[1], a[2]}},
      {"cut of two support planes", {s[0], s[1], s[2]}},
      {"input vertex against shadow plane", {input}},
      {"crossing against shadow plane", {det(a, c, f)}},
      {"crossing against prefix plane", {det(a, c, prefix), det(a, c, prefix_v)}},
      {"crossing: 1 cut; depth at a crossing", {det(a, c, s)}},
      {"crossing: 2 cuts", {det(a, s, t)}},
      {"crossing: 3 cuts", {det(r, s, t)}},
      {"depth at an input vertex", {at_vertex}},
  };
}

TEST(PrecisionPlan, HoldsEveryValueAndIsNotFarFromIt) {
  for (const bool directional : {false, true}) {
    for (const unsigned b : {4u, 17u, 20u, 41u, 53u, 62u}) {
      const unsigned e = directional ? 53 : 1;
      std::map<std::string, unsigned> most;
      Random random(b);
      for (int round = 0; round < 4000; ++round) {
        const Extremes x = random_extremes(random, b, e);
        for (const auto& [name, values] : values_of(x, directional, b)) {
          for (const mpz_class& value : values) {
            most[name] = std::max(most[name], signed_bits(value));
          }
        }
      }
      const auto plan = precision_plan(directional, b, e);
      ASSERT_EQ(plan.size(), most.size());
      for (const PredicateBits& predicate : plan) {
        const std::string name(predicate.name);
        ASSERT_TRUE(most.contains(name)) << name;
        EXPECT_LE(most[name], predicate.bits) << name << ", b = " << b;
        // Bounds are products of bounds: the more factors, the further off.
        const unsigned slack = 1 + (predicate.degree + predicate.direction_degree) / 2;
        EXPECT_GE(most[name] + slack, predicate.bits)
            << name << ", b = " << b << (directional ? ", directional" : ", point");
      }
    }
  }
}

// The planes of volumes on extreme grids: through corners that no, one or two support planes cut
// off a light, as the kernel makes them primitive or not.
TEST(PrecisionPlan, BoundsThePlanesOfVolumes) {
  for (const unsigned b : {5u, 17u, 53u}) {
    Random random(b);
    std::array<unsigned, 3> most{};
    for (int round = 0; round < 8000; ++round) {
      const Extremes x = random_extremes(random, b, 12);
      // Light 0 (p0, p1, p2), cut by planes 3 and 6; the caster's edge is p9, p10.
      const auto value = [&](int plane, int vertex) { return value_of(x, plane, vertex); };
      const Integers l = normal_of(x.p[0], x.p[1], x.p[2]), p = normal_of(x.p[3], x.p[4], x.p[5]),
                     q = normal_of(x.p[6], x.p[7], x.p[8]), edge = minus(x.p[10], x.p[9]);
      const auto raise = [&](std::size_t cuts, const Integers& n) {
        for (const mpz_class& c : n) most[cuts] = std::max(most[cuts], signed_bits(c));
      };
      raise(0, normal_of(x.p[9], x.p[10], x.p[0]));
      const mpz_class u = value(3, 0), v = value(3, 1);
      if (sgn(u) * sgn(v) < 0) {
        Integers corner;  // relative to p9, times P(u) - P(v)
        for (int k = 0; k < 3; ++k) {
          corner[k] = u * (x.p[1][k] - x.p[9][k]) - v * (x.p[0][k] - x.p[9][k]);
        }
        raise(1, cross(edge, corner));
      }
      Integers line;  // through p9 and where the light and plane 3 meet
      for (int k = 0; k < 3; ++k) line[k] = value(0, 9) * p[k] - value(3, 9) * l[k];
      raise(1, line);
      Integers corner;
      const Integers pq = cross(p, q), ql = cross(q, l), lp = cross(l, p);
      for (int k = 0; k < 3; ++k) {
        corner[k] = -value(0, 9) * pq[k] - value(3, 9) * ql[k] - value(6, 9) * lp[k];
      }
      raise(2, cross(edge, corner));
    }
    for (const LightCuts cuts : {LightCuts::kNone, LightCuts::kOnce, LightCuts::kTwice}) {
      const auto i = static_cast<std::size_t>(cuts);
      EXPECT_LE(most[i], volume_precision_plan(cuts, b)[0].bits) << "b = " << b;
      EXPECT_GE(most[i] + 2 + 2 * i, volume_precision_plan(cuts, b)[0].bits) << "b = " << b;
    }
  }
}

TEST(PrecisionPlan, GrowsWithTheBits) {
  for (const LightCuts cuts : {LightCuts::kNone, LightCuts::kOnce, LightCuts::kTwice}) {
    for (unsigned b = 1; b < 80; ++b) {
      const auto less = volume_precision_plan(cuts, b), more = volume_precision_plan(cuts, b + 1);
      for (std::size_t i = 0; i < less.size(); ++i) EXPECT_LT(less[i].bits, more[i].bits);
    }
  }
  for (const bool directional : {false, true}) {
    for (unsigned b = 1; b < 80; ++b) {
      const auto less = precision_plan(directional, b, 10),
                 more = precision_plan(directional, b + 1, 10);
      for (std::size_t i = 0; i < less.size(); ++i) {
        EXPECT_LT(less[i].bits, more[i].bits);
        EXPECT_EQ(less[i].width, narrowest_width(less[i].bits));
      }
    }
  }
}

}  // namespace
}  // namespace gnomon::test
