// SPDX-License-Identifier: GPL-3.0-or-later
// The precision plan's promise: a predicate that it gives to 128 or 512 bits cannot overflow there.
// Each width is driven to its last bit with the largest operands that the plan lets through, and
// compared with unbounded integers; one bit more, and the plan chooses the next width.
#include <gtest/gtest.h>

#include <string>

#include "gnomon/kernel/exact_integer.h"
#include "gnomon/kernel/precision_plan.h"
#include "triangle_soup.h"

namespace gnomon::test {
namespace {

mpz_class widened(const Int128& value) { return to_mpz(WideInteger<2>(value)); }
template <std::size_t Limbs>
mpz_class widened(const WideInteger<Limbs>& value) {
  return to_mpz(value);
}

template <class Int>
Vector3<Int> narrowed(const Integers& v) {
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

template <class Int>
void check_side_of_input_vertex(unsigned n_bits, unsigned q_bits) {
  Random random(n_bits);
  for (int round = 0; round < 2000; ++round) {
    const Integers n = extreme(random, n_bits), q = extreme(random, q_bits);
    ASSERT_EQ(widened(gnomon::dot(narrowed<Int>(n), narrowed<Int>(q))), test::dot(n, q));
  }
}

template <class Int>
void check_side_of_crossing(unsigned n, unsigned m, unsigned l) {
  Random random(n + m + l);
  for (int round = 0; round < 2000; ++round) {
    const Integers a = extreme(random, n), b = extreme(random, m), c = extreme(random, l);
    const mpz_class exact = test::dot(a, test::cross(b, c));
    const Vector3<Int> x = narrowed<Int>(a), y = narrowed<Int>(b), z = narrowed<Int>(c);
    ASSERT_EQ(widened(gnomon::dot(x, gnomon::cross(y, z))), exact);
    ASSERT_EQ(static_cast<int>(sign_of_determinant(x, y, z)), sgn(exact));
  }
}

TEST(IntegerWidth, ChangesAtItsLimit) {
  EXPECT_EQ(width_for(1), IntegerWidth::k128);
  EXPECT_EQ(width_for(128), IntegerWidth::k128);
  EXPECT_EQ(width_for(129), IntegerWidth::k512);
  EXPECT_EQ(width_for(512), IntegerWidth::k512);
  EXPECT_EQ(width_for(513), IntegerWidth::kUnbounded);
  EXPECT_EQ(width_name(IntegerWidth::k512), "512");
}

TEST(IntegerWidth, SideOfInputVertexAtTheLastBit) {
  ASSERT_EQ(side_of_input_vertex_bits(84, 41), 128u);
  check_side_of_input_vertex<Int128>(84, 41);
  check_side_of_input_vertex<Int128>(63, 62);
  ASSERT_EQ(side_of_input_vertex_bits(340, 169), 512u);
  check_side_of_input_vertex<Int512>(340, 169);
}

TEST(IntegerWidth, SideOfCrossingAtTheLastBit) {
  ASSERT_EQ(side_of_crossing_bits(41, 41, 42), 128u);
  check_side_of_crossing<Int128>(41, 41, 42);
  check_side_of_crossing<Int128>(42, 41, 41);
  check_side_of_crossing<Int128>(1, 61, 62);
  ASSERT_EQ(side_of_crossing_bits(169, 169, 170), 512u);
  check_side_of_crossing<Int512>(169, 169, 170);
  check_side_of_crossing<Int512>(2, 253, 253);
}

TEST(IntegerWidth, ShadowPlaneAtTheLastBit) {
  // |x y - z w| < 2^(2B+1) for |x|, ... < 2^B; with a sign, 2 B + 2 bits.
  Random random(7);
  for (const unsigned bits : {10u, 31u, 62u, 63u}) {
    for (int round = 0; round < 2000; ++round) {
      const Integers a = extreme(random, bits), b = extreme(random, bits),
                     exact = test::cross(a, b);
      const Vector3<Int128> n = gnomon::cross(narrowed<Int128>(a), narrowed<Int128>(b));
      for (std::size_t k = 0; k < 3; ++k) {
        ASSERT_EQ(widened(n[k]), exact[k]);
        ASSERT_LE(mpz_sizeinbase(exact[k].get_mpz_t(), 2), shadow_plane_bits(bits));
      }
    }
  }
}

/// Bits that the values of a predicate need, over extreme scenes of b bits.
template <class Predicate>
unsigned measured_bits(unsigned b, const Predicate& predicate) {
  Random random(b);
  std::size_t most = 0;
  for (int round = 0; round < 3000; ++round) {
    std::array<Integers, 12> p;
    for (Integers& point : p) {
      for (mpz_class& x : point) x = random_coordinate(random, SoupKind::kCorners, b);
    }
    const mpz_class value = predicate(p);
    most = std::max(most, mpz_sizeinbase(value.get_mpz_t(), 2) + 1);
  }
  return static_cast<unsigned>(most);
}

unsigned planned_bits(const std::string& name, unsigned b) {
  for (const PredicateBits& predicate : precision_plan(false, b, 0)) {
    if (predicate.name == name) return predicate.bits;
  }
  ADD_FAILURE() << "no predicate " << name;
  return 0;
}

TEST(PrecisionPlan, HoldsEveryValueAndIsNotFarFromIt) {
  const auto normal = [](const Integers& a, const Integers& b, const Integers& c) {
    return cross(minus(b, a), minus(c, a));
  };
  for (const unsigned b : {4u, 17u, 20u, 41u, 53u, 62u}) {
    const auto check = [&](const std::string& name, unsigned needed) {
      EXPECT_LE(needed, planned_bits(name, b)) << name << ", b = " << b;
      EXPECT_GE(needed + 8, planned_bits(name, b)) << name << ", b = " << b;
    };
    check("support normal",
          measured_bits(b, [&](const auto& p) { return normal(p[0], p[1], p[2])[0]; }));
    check("support plane at a vertex", measured_bits(b, [&](const auto& p) {
            return dot(normal(p[0], p[1], p[2]), minus(p[3], p[0]));
          }));
    const auto q = [](const auto& p, int i) { return minus(p[11], p[i]); };
    check("shadow plane",
          measured_bits(b, [&](const auto& p) { return cross(q(p, 0), q(p, 1))[2]; }));
    check("side of input vertex",
          measured_bits(b, [&](const auto& p) { return dot(cross(q(p, 0), q(p, 1)), q(p, 2)); }));
    check("side of crossing", measured_bits(b, [&](const auto& p) {
            return dot(cross(q(p, 0), q(p, 1)),
                       cross(cross(q(p, 2), q(p, 3)), cross(q(p, 4), q(p, 5))));
          }));
  }
}

TEST(PrecisionPlan, GrowsWithTheBits) {
  for (const bool directional : {false, true}) {
    for (unsigned b = 1; b < 80; ++b) {
      const auto less = precision_plan(directional, b, 10),
                 more = precision_plan(directional, b + 1, 10);
      ASSERT_EQ(less.size(), more.size());
      for (std::size_t i = 0; i < less.size(); ++i) {
        EXPECT_LT(less[i].bits, more[i].bits);
        EXPECT_EQ(less[i].width, width_for(less[i].bits));
      }
    }
  }
}

}  // namespace
}  // namespace gnomon::test
