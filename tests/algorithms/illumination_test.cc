// SPDX-License-Identifier: GPL-3.0-or-later
// Visible parts of area lights against segment tests of random points of the light, and
// illumination against two opponents that share nothing with it: the contour integral in MPFR
// intervals over the exact visible fragments, and Gauss quadrature of cos cos / r^2 over them.
#include "gnomon/algorithms/illumination.h"

#include <gtest/gtest.h>
#include <mpfr.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "algorithms/illumination/contour_integral.h"
#include "gnomon/algorithms/shadows.h"
#include "gnomon/algorithms/visible_light.h"
#include "gnomon/oracle/area_visibility.h"
#include "gnomon/scene/generate.h"
#include "gnomon/scene/read.h"
#include "light_soup.h"
#include "scene/base/random.h"

namespace gnomon {
namespace {

using namespace test;

TEST(VisibleLight, IsWhatSegmentTestsSee) {
  Random random(11);
  std::size_t visible = 0, hidden = 0, pieces = 0;
  for (int round = 0; round < 400; ++round) {
    const PreparedScene scene = soup(random, 6 + round % 8, 2 + round % 5);
    const BruteView brute(scene);
    const LightVisibility visibility(scene, 0);
    for (std::uint32_t part = 0; part < scene.parts.size(); ++part) {
      const Side side =
          scene.parts[part].two_sided && random.chance(1, 2) ? Side::kBack : Side::kFront;
      const ExactPoint3 p = mix(brute.faces[part].loop, random, 4);
      const VisibleLight found = visibility.at(part, side, p);
      EXPECT_LE(found.visible, found.in_front);
      EXPECT_LE(found.in_front, 1);
      EXPECT_EQ(visibility.is_deep_umbra(part, side, p), found.fragments.empty());
      EXPECT_EQ(sgn(found.visible) == 0, found.fragments.empty());
      pieces += found.fragments.size();
      for (int sample = 0; sample < 12; ++sample) {
        const ExactPoint3 a = mix(brute.light, random, 40);
        const int truth = brute.sees(part, side, p, a);
        if (truth == 0 || BruteView::place(brute.light, brute.light_normal, a) <= 0) continue;
        int inside = 0, border = 0;
        for (const auto& fragment : found.fragments) {
          const int where = BruteView::place(fragment, brute.light_normal, a);
          inside += where > 0;
          border += where == 0;
        }
        if (border > 0) continue;
        EXPECT_EQ(inside, truth > 0 ? 1 : 0) << "round " << round << ", part " << part;
        ++(truth > 0 ? visible : hidden);
      }
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(visible, 3000u);
  EXPECT_GT(hidden, 3000u);
  EXPECT_GT(pieces, 2000u);
}

TEST(VisibleLight, LimitTowardsAPointIsWhatIsSeenNearIt) {
  // Close to `inwards` from the point, as far as the light's fraction goes, is the limit.
  Random random(12);
  std::size_t different = 0;
  for (int round = 0; round < 300; ++round) {
    const PreparedScene scene = soup(random, 8, 2);
    const BruteView brute(scene);
    const LightVisibility visibility(scene, 0);
    for (std::uint32_t part = 0; part < scene.parts.size(); ++part) {
      const ExactPoint3 p = mix(brute.faces[part].loop, random, 3);
      const ExactPoint3 to = mix(brute.faces[part].loop, random, 9);
      ExactPoint3 near;
      const mpq_class tiny(1, 1000000000000);
      for (std::size_t k = 0; k < 3; ++k) near[k] = p[k] + tiny * (to[k] - p[k]);
      if (BruteView::height(brute.light_normal, brute.light[0], p) <= 0) continue;
      const mpq_class limit = visibility.at(part, Side::kFront, p, &to).visible;
      const mpq_class there = visibility.at(part, Side::kFront, near).visible;
      EXPECT_LT(std::fabs(mpq_class(limit - there).get_d()), 1e-8) << round << ", " << part;
      different += limit != visibility.at(part, Side::kFront, p).visible;
    }
  }
  EXPECT_GT(different, 20u);
}

// --- Opponent 1: the contour integral in MPFR intervals of 300 bits ---

class Real {
 public:
  static constexpr mpfr_prec_t kBits = 300;
  Real() { mpfr_init2(value_, kBits), mpfr_set_zero(value_, 1); }
  Real(const Real& other) : Real() { mpfr_set(value_, other.value_, MPFR_RNDN); }
  Real& operator=(const Real& other) {
    mpfr_set(value_, other.value_, MPFR_RNDN);
    return *this;
  }
  ~Real() { mpfr_clear(value_); }
  mpfr_ptr get() { return value_; }
  mpfr_srcptr get() const { return value_; }

 private:
  mpfr_t value_;
};

struct RealInterval {
  Real low, high;
  RealInterval() = default;
  explicit RealInterval(const mpq_class& q) {
    mpfr_set_q(low.get(), q.get_mpq_t(), MPFR_RNDD);
    mpfr_set_q(high.get(), q.get_mpq_t(), MPFR_RNDU);
  }
  template <class F>
  static RealInterval corners(const RealInterval& a, const RealInterval& b, const F& f) {
    RealInterval result;
    bool first = true;
    for (const Real* x : {&a.low, &a.high}) {
      for (const Real* y : {&b.low, &b.high}) {
        Real down, up;
        f(down.get(), x->get(), y->get(), MPFR_RNDD);
        f(up.get(), x->get(), y->get(), MPFR_RNDU);
        if (first || mpfr_cmp(down.get(), result.low.get()) < 0) result.low = down;
        if (first || mpfr_cmp(up.get(), result.high.get()) > 0) result.high = up;
        first = false;
      }
    }
    return result;
  }
  friend RealInterval operator+(const RealInterval& a, const RealInterval& b) {
    RealInterval r;
    mpfr_add(r.low.get(), a.low.get(), b.low.get(), MPFR_RNDD);
    mpfr_add(r.high.get(), a.high.get(), b.high.get(), MPFR_RNDU);
    return r;
  }
  friend RealInterval operator*(const RealInterval& a, const RealInterval& b) {
    return corners(a, b, mpfr_mul);
  }
  friend RealInterval operator/(const RealInterval& a, const RealInterval& b) {
    return corners(a, b, mpfr_div);
  }
};
RealInterval root(const RealInterval& a) {
  RealInterval r;
  mpfr_sqrt(r.low.get(), a.low.get(), MPFR_RNDD);
  mpfr_sqrt(r.high.get(), a.high.get(), MPFR_RNDU);
  return r;
}

RealInterval contour(const std::vector<std::vector<ExactPoint3>>& fragments, const ExactPoint3& p,
                     const ExactPoint3& normal) {
  RealInterval sum;
  for (const auto& fragment : fragments) {
    for (std::size_t i = 0; i < fragment.size(); ++i) {
      const ExactPoint3 a = minus(fragment[i], p);
      const ExactPoint3 b = minus(fragment[(i + 1) % fragment.size()], p);
      const ExactPoint3 c = cross_of(b, a);
      const mpq_class square = dot_of(c, c);
      if (sgn(square) == 0) continue;
      const RealInterval sine = root(RealInterval(square));
      const RealInterval angle =
          RealInterval::corners(sine, RealInterval(dot_of(a, b)), mpfr_atan2);
      sum = sum + angle * RealInterval(dot_of(normal, c)) /
                      (sine * root(RealInterval(dot_of(normal, normal))));
    }
  }
  return sum * RealInterval(mpq_class(1, 2));
}

/// Whether [value - bound, value + bound] meets the interval, which is as good as a point.
void expect_encloses(const Illumination& found, const RealInterval& truth,
                     const std::string& what) {
  const mpq_class low = mpq_class(found.value) - mpq_class(found.error_bound);
  const mpq_class high = mpq_class(found.value) + mpq_class(found.error_bound);
  EXPECT_LE(mpfr_cmp_q(truth.low.get(), high.get_mpq_t()), 0) << what;
  EXPECT_GE(mpfr_cmp_q(truth.high.get(), low.get_mpq_t()), 0) << what;
}

// --- Opponent 2: Gauss quadrature on triangles, halved until two levels agree ---

long double integrand(const std::array<long double, 3>& x, const std::array<long double, 3>& n,
                      const std::array<long double, 3>& m) {
  // x from the point to the light; n, m unit normals.
  const long double square = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
  return -(n[0] * x[0] + n[1] * x[1] + n[2] * x[2]) * (m[0] * x[0] + m[1] * x[1] + m[2] * x[2]) /
         (square * square);
}

long double quadrature(const std::vector<std::vector<ExactPoint3>>& fragments, const ExactPoint3& p,
                       const ExactPoint3& normal, const ExactPoint3& light_normal, int level) {
  using Point = std::array<long double, 3>;
  const auto unit = [](const ExactPoint3& v) {
    Point u{v[0].get_d(), v[1].get_d(), v[2].get_d()};
    const long double length = std::sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
    for (long double& c : u) c /= length;
    return u;
  };
  const Point n = unit(normal), m = unit(light_normal);
  // Collapsed Gauss-Legendre, five points a direction.
  const long double nodes[5] = {0.04691007703066800360L, 0.23076534494715845448L, 0.5L,
                                0.76923465505284154552L, 0.95308992296933199640L};
  const long double weights[5] = {0.11846344252809454376L, 0.23931433524968323402L,
                                  0.28444444444444444444L, 0.23931433524968323402L,
                                  0.11846344252809454376L};
  long double sum = 0;
  for (const auto& fragment : fragments) {
    std::vector<Point> loop;
    for (const ExactPoint3& v : fragment) {
      const ExactPoint3 d = minus(v, p);
      loop.push_back({d[0].get_d(), d[1].get_d(), d[2].get_d()});
    }
    for (std::size_t i = 2; i < loop.size(); ++i) {
      const Point a = loop[0], b = loop[i - 1], c = loop[i];
      const Point e{b[0] - a[0], b[1] - a[1], b[2] - a[2]},
          f{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
      const Point x{e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2],
                    e[0] * f[1] - e[1] * f[0]};
      const long double twice = std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
      const int cells = 1 << level;
      for (int iu = 0; iu < cells; ++iu) {
        for (int iv = 0; iv < cells; ++iv) {
          for (int ju = 0; ju < 5; ++ju) {
            for (int jv = 0; jv < 5; ++jv) {
              // (u, v) in the unit square; the triangle's point is a + u (e + v (f - e)).
              const long double u = (iu + nodes[ju]) / cells, v = (iv + nodes[jv]) / cells;
              Point at;
              for (std::size_t k = 0; k < 3; ++k) {
                at[k] = a[k] + u * (e[k] + v * (f[k] - e[k]));
              }
              sum += twice * u * weights[ju] * weights[jv] / cells / cells * integrand(at, n, m);
            }
          }
        }
      }
    }
  }
  return sum;
}

ExactPoint3 facing(const BruteView& brute, std::uint32_t part, Side side) {
  ExactPoint3 normal = brute.faces[part].normal;
  if (side == Side::kBack) {
    for (mpq_class& c : normal) c = -c;
  }
  return normal;
}

TEST(ContourIntegral, ArcTangentIsWithinItsBound) {
  Real exact, error;
  double worst = 0;
  const auto check = [&](double t) {
    mpfr_set_d(exact.get(), t, MPFR_RNDN);
    mpfr_atan(exact.get(), exact.get(), MPFR_RNDN);
    if (t == 0) {
      mpfr_set_ui(exact.get(), 1, MPFR_RNDN);
    } else {
      mpfr_div_d(exact.get(), exact.get(), t, MPFR_RNDN);
    }
    mpfr_d_sub(error.get(), arc_tangent_over(t), exact.get(), MPFR_RNDN);
    mpfr_div(error.get(), error.get(), exact.get(), MPFR_RNDN);
    worst = std::max(worst, std::fabs(mpfr_get_d(error.get(), MPFR_RNDN)));
  };
  for (int k = 0; k <= 40000; ++k) check(k / 40000.0);
  for (int k = 0; k < 1100; ++k) check(std::ldexp(0.999, -k));
  for (int k = 1; k <= 16; ++k) {
    for (const double t : {k / 16.0, std::nextafter(k / 16.0, 0), std::nextafter(k / 16.0, 1)}) {
      check(t);
    }
  }
  EXPECT_LT(worst, kArcTangentError);
}

TEST(ContourIntegral, AngleOverSineEncloses) {
  Random random(13);
  const auto number = [&](bool sign) {
    const double x = std::ldexp(1 + std::ldexp(static_cast<double>(random.below(1u << 30)), -30),
                                static_cast<int>(random.between(-40, 2)));
    return sign && random.chance(1, 2) ? -x : x;
  };
  for (int round = 0; round < 20000; ++round) {
    const double s = number(false), c = number(true);
    const double ds = s * std::ldexp(1.0, -static_cast<int>(random.between(2, 50)));
    const double dc = std::fabs(c) * std::ldexp(1.0, -static_cast<int>(random.between(2, 50)));
    const Ball found = angle_over(Ball(s, ds), Ball(c, dc));
    for (const double at_s : {s - ds, s, s + ds}) {
      for (const double at_c : {c - dc, c, c + dc}) {
        Real angle, x;
        mpfr_set_d(x.get(), at_c, MPFR_RNDN);
        mpfr_set_d(angle.get(), at_s, MPFR_RNDN);
        mpfr_atan2(angle.get(), angle.get(), x.get(), MPFR_RNDN);
        mpfr_div_d(angle.get(), angle.get(), at_s, MPFR_RNDN);
        const double off = mpfr_get_d(angle.get(), MPFR_RNDN) - found.middle;
        EXPECT_LE(std::fabs(off), found.radius * (1 + 1e-14)) << s << " " << c;
      }
    }
    if (HasFailure()) return;
  }
}

TEST(Illumination, OfSoupsIsInTheEnclosures) {
  Random random(14);
  std::size_t compared = 0, integrated = 0;
  for (int round = 0; round < 200; ++round) {
    const PreparedScene scene = soup(random, 5 + round % 8, 2 + round % 6);
    const BruteView brute(scene);
    const LightVisibility visibility(scene, 0);
    const double asked = std::pow(10.0, -static_cast<double>(random.between(3, 15)));
    const Illuminator illuminator(scene, 0, 2.0, asked);
    for (std::uint32_t part = 0; part < scene.parts.size(); ++part) {
      const Side side =
          scene.parts[part].two_sided && random.chance(1, 2) ? Side::kBack : Side::kFront;
      const ExactPoint3 p = mix(brute.faces[part].loop, random, 4);
      const VisibleLight visible = visibility.at(part, side, p);
      Illumination found = illuminator.at(part, side, p, false);
      EXPECT_LE(found.error_bound, asked * found.value * (1 + 1e-9));
      if (visible.fragments.empty()) {
        EXPECT_EQ(found.value, 0);
        continue;
      }
      found.value /= 2;
      found.error_bound /= 2;
      const ExactPoint3 normal = facing(brute, part, side);
      expect_encloses(found, contour(visible.fragments, p, normal),
                      std::to_string(round) + ", " + std::to_string(part));
      ++compared;
      const long double coarse = quadrature(visible.fragments, p, normal, brute.light_normal, 2);
      const long double fine = quadrature(visible.fragments, p, normal, brute.light_normal, 3);
      if (std::fabs(coarse - fine) < 1e-10L * fine) {
        EXPECT_NEAR(static_cast<double>(fine / static_cast<long double>(found.value)), 1,
                    1e-9 + 2 * asked);
        ++integrated;
      }
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(compared, 400u);
  EXPECT_GT(integrated, 200u);
}

/// The floor is z = 0; the light hangs over it.
PreparedScene floor_and(const std::vector<Triple>& light,
                        const std::vector<std::vector<Triple>>& casters = {}, double size = 1) {
  LightSceneBuilder builder;
  builder.polygon({{-size, -size, 0}, {size, -size, 0}, {size, size, 0}, {-size, size, 0}});
  for (const auto& caster : casters) builder.polygon(caster, true);
  builder.area(light);
  return builder.build();
}

void expect_relative_error(const PreparedScene& scene, const Triple& at, double asked,
                           const std::string& what, IlluminationCounts* counts = nullptr) {
  const BruteView brute(scene);
  const ExactPoint3 p = exactly(at);
  const VisibleLight visible = LightVisibility(scene, 0).at(0, Side::kFront, p);
  const Illuminator illuminator(scene, 0, 1.0, asked);
  const Illumination found = illuminator.at(0, Side::kFront, p, false);
  ASSERT_FALSE(visible.fragments.empty()) << what;
  EXPECT_GT(found.value, 0) << what;
  EXPECT_LE(found.error_bound, asked * found.value * (1 + 1e-9)) << what;
  expect_encloses(found, contour(visible.fragments, p, brute.faces[0].normal), what);
  if (counts != nullptr) *counts = illuminator.counts();
}

TEST(Illumination, MeetsTheErrorAskedForInHardPlaces) {
  for (const double asked : {1e-6, 1e-9, 1e-12, 1e-15}) {
    const std::string error = ", asked " + std::to_string(-std::log10(asked));
    // Far lights: up to 1e6 diameters and more.
    for (const double far : {16.0, 1e3, 1e6, 1e9}) {
      const PreparedScene scene =
          floor_and({{0, 0, far}, {0, 1, far}, {1, 1, far}, {1, 0, far}}, {}, 2);
      expect_relative_error(scene, {0.25, 0.125, 0}, asked, "far " + std::to_string(far) + error);
    }
    // Near: a millionth of its size away, in the middle, at an edge, at a corner.
    for (const double near : {1e-3, 1e-6, 1e-9}) {
      const PreparedScene scene =
          floor_and({{0, 0, near}, {0, 1, near}, {1, 1, near}, {1, 0, near}}, {}, 2);
      for (const Triple& at : {Triple{0.5, 0.5, 0},
                               {0, 0.5, 0},
                               {1e-7, 0.5, 0},
                               {0, 0, 0},
                               {1.0, 1.0000001, 0},
                               {1.5, 1.25, 0}}) {
        expect_relative_error(scene, at, asked, "near " + std::to_string(near) + error);
      }
    }
    // Grazing: the light stands on the floor far away, or just looks over the horizon.
    for (const double high : {1e-2, 1e-6, 1e-12}) {
      const PreparedScene scene =
          floor_and({{1, 0, -1}, {1, 0, high}, {1, 1, high}, {1, 1, -1}}, {}, 8);
      expect_relative_error(scene, {0, 0, 0}, asked, "grazing " + std::to_string(high) + error);
      expect_relative_error(scene, {-7, 3, 0}, asked, "grazing " + std::to_string(high) + error);
    }
    // Slivers: a caster that leaves open a strip, or a needle between two casters.
    for (const double open : {1e-3, 1e-6, 1e-12}) {
      const PreparedScene strip = floor_and(
          {{0, 0, 2}, {0, 1, 2}, {1, 1, 2}, {1, 0, 2}},
          {{{-1, -1, 1}, {0.5 - open / 2, -1, 1}, {0.5 - open / 2, 2, 1}, {-1, 2, 1}}}, 2);
      expect_relative_error(strip, {0, 0, 0}, asked, "strip " + std::to_string(open) + error);
      const PreparedScene needle =
          floor_and({{0, 0, 2}, {0, 1, 2}, {1, 1, 2}, {1, 0, 2}},
                    {{{-1, -1, 1}, {0.25, -1, 1}, {0.25 + open, 2, 1}, {-1, 2, 1}},
                     {{0.25 + open, -1, 1}, {3, -1, 1}, {3, 2, 1}, {0.25 + open, 2, 1}}},
                    2);
      expect_relative_error(needle, {0, 0, 0}, asked, "needle " + std::to_string(open) + error);
    }
  }
}

TEST(Illumination, OfAWholeSkyIsPi) {
  // A light so near that it is nearly a half-space of light.
  const PreparedScene scene =
      floor_and({{-1e6, -1e6, 1e-6}, {-1e6, 1e6, 1e-6}, {1e6, 1e6, 1e-6}, {1e6, -1e6, 1e-6}});
  const Illuminator illuminator(scene, 0, 1.0, 1e-12);
  EXPECT_NEAR(illuminator.at(0, Side::kFront, exactly({0, 0, 0}), true).value, std::acos(-1.0),
              1e-12);
}

TEST(Illumination, InTheLightsOwnPlaneIsNothing) {
  // A wall through the middle of a light that looks up. Its points in the light's plane receive
  // nothing; what those above them receive goes to 0 beside the light, and on it to half of half a
  // sky.
  LightSceneBuilder builder;
  builder.polygon({{0, -8, -8}, {0, 8, -8}, {0, 8, 8}, {0, -8, 8}});  // looks to +x
  builder.area({{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}});
  const PreparedScene scene = builder.build();
  const Illuminator illuminator(scene, 0, 1.0);
  const auto at = [&](double y, double z) {
    return illuminator.at(0, Side::kFront, exactly({0, y, z}), false).value;
  };
  const double half_pi = std::acos(0.0);
  for (const double y : {-3.0, -2.0, 0.0, 0.5, 7.0}) {
    EXPECT_EQ(at(y, 0), 0) << y;
    EXPECT_EQ(at(y, -1), 0) << y;
  }
  for (const double z : {0x1p-10, 0x1p-20, 0x1p-40}) {
    EXPECT_NEAR(at(0.5, z), half_pi, 4 * z) << z;
    EXPECT_GT(at(3, z), 0) << z;
    EXPECT_LT(at(3, z), 4 * z) << z;
  }
}

TEST(Illumination, OfPointAndDirectionalLights) {
  LightSceneBuilder builder;
  builder.polygon({{-8, -8, 0}, {8, -8, 0}, {8, 8, 0}, {-8, 8, 0}});
  builder.polygon({{1, 1, 2}, {2, 1, 2}, {2, 2, 2}, {1, 2, 2}});  // looks up
  builder.polygon({{2, 1, 2}, {3, 1, 2}, {3, 2, 2}, {2, 2, 2}});  // shares an edge with it
  builder.light(LightType::kPoint, {0, 0, 4});
  builder.light(LightType::kDirectional, {0, 3, 4});
  const PreparedScene scene = builder.build();
  const Illuminator lamp(scene, 0, 5.0), sun(scene, 1, 5.0);
  const auto at = [&](const Illuminator& illuminator, const Triple& p) {
    const Illumination found = illuminator.at(0, Side::kFront, exactly(p), false);
    EXPECT_LE(found.error_bound, 1e-14 * found.value);
    EXPECT_EQ(illuminator.at(0, Side::kBack, exactly(p), true).value, 0);
    return found.value;
  };
  EXPECT_NEAR(at(lamp, {0, 0, 0}), 5.0 / 16, 1e-15);
  EXPECT_NEAR(at(lamp, {-3, 0, 0}), 5.0 * 0.8 / 25, 1e-15);
  EXPECT_EQ(at(lamp, {3, 3, 0}), 0);
  EXPECT_EQ(at(lamp, {4, 3, 0}), 0);  // through the shared edge: no leak
  EXPECT_GT(at(lamp, {7, 3, 0}), 0);
  EXPECT_NEAR(at(sun, {-3, 0, 0}), 4.0, 1e-14);
  EXPECT_EQ(at(sun, {1.5, 0, 0}), 0);
  EXPECT_EQ(at(sun, {2, 0, 0}), 0);
  EXPECT_GT(at(sun, {2, 1, 0}), 0);
}

/// A point inside that hardly lies on a plane of the scene.
ExactPoint3 odd_point(const ExactPoint3* loop, std::uint32_t count) {
  ExactPoint3 sum;
  long total = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const long weight = 1009 + 89 * static_cast<long>(i) + 7 * static_cast<long>(i * i);
    for (std::size_t k = 0; k < 3; ++k) sum[k] += weight * loop[i][k];
    total += weight;
  }
  for (mpq_class& c : sum) c /= total;
  return sum;
}

/// What the classes of fragments say about their vertices, seen from inside, and about a point
/// inside. Counts fragments of each class.
void expect_classes(const PreparedScene& scene, const std::string& what,
                    std::array<std::size_t, 3>& fragments) {
  ShadowOptions options;
  options.output.exact_points = true;
  options.lights = {0};
  const auto shadows = compute_shadows(scene, options);
  ASSERT_TRUE(shadows);
  const LightResult& light = shadows->lights[0];
  const LightVisibility visibility(scene, 0);
  for (const PartResult& part : light.parts) {
    for (std::uint32_t f = 0; f < part.fragment_count; ++f) {
      const Fragment& fragment = light.fragments[part.first_fragment + f];
      const ExactPoint3* loop = light.exact_points.data() + fragment.first;
      const ExactPoint3 inside = odd_point(loop, fragment.count);
      const VisibleLight from_inside = visibility.at(part.part, part.side, inside);
      switch (fragment.state) {
        case LightState::kLit:
          EXPECT_EQ(from_inside.visible, from_inside.in_front) << what;
          EXPECT_GT(from_inside.visible, 0) << what;
          ++fragments[0];
          break;
        case LightState::kPenumbra:
          EXPECT_LT(from_inside.visible, from_inside.in_front) << what;
          ++fragments[1];
          break;
        case LightState::kUmbra:
        case LightState::kShadow:
          EXPECT_EQ(from_inside.visible, 0) << what;
          ++fragments[2];
          break;
      }
      if (fragment.state == LightState::kPenumbra) continue;
      for (std::uint32_t i = 0; i < fragment.count; ++i) {
        const VisibleLight seen = visibility.at(part.part, part.side, loop[i], &inside);
        if (fragment.state == LightState::kLit) {
          EXPECT_EQ(seen.visible, seen.in_front) << what << ", part " << part.part;
        } else {
          EXPECT_EQ(seen.visible, 0) << what << ", part " << part.part;
        }
      }
    }
  }
}

TEST(VisibleLight, HasTheFractionsOfTheOracle) {
  Random random(18);
  std::size_t partial = 0;
  for (int round = 0; round < 150; ++round) {
    const PreparedScene scene = soup(random, 5 + round % 8, 2 + round % 5);
    const BruteView brute(scene);
    const LightVisibility visibility(scene, 0);
    const oracle::AreaVisibility oracle(scene, scene.lights[0]);
    for (std::uint32_t part = 0; part < scene.parts.size(); ++part) {
      const Side side =
          scene.parts[part].two_sided && random.chance(1, 2) ? Side::kBack : Side::kFront;
      const ExactPoint3 p = mix(brute.faces[part].loop, random, 5);
      const VisibleLight found = visibility.at(part, side, p);
      const oracle::AreaPointVisibility truth = oracle.at(part, side, p);
      if (truth.behind_light) {
        EXPECT_EQ(found.visible, 0);
        continue;
      }
      EXPECT_EQ(found.visible, truth.visible) << round << ", " << part;
      EXPECT_EQ(found.in_front, truth.visible + truth.hidden) << round << ", " << part;
      partial += sgn(truth.visible) > 0 && sgn(truth.hidden) > 0;
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(partial, 150u);
}

TEST(VisibleLight, OfRealScenesHasTheFractionsOfTheOracle) {
  std::size_t compared = 0;
  for (const char* name : {"radiance-cornell", "radiance-desk"}) {
    if (std::string(GNOMON_SHARED_SCENES).empty()) GTEST_SKIP() << "no shared scenes";
    const auto read = read_scene(std::string(GNOMON_SHARED_SCENES) + "/json/" + name + ".json");
    ASSERT_TRUE(read) << to_string(read.error());
    const auto prepared = prepare(read->scene);
    ASSERT_TRUE(prepared);
    for (std::uint32_t light = 0; light < prepared->lights.size(); ++light) {
      if (!prepared->lights[light].has_area()) continue;
      const BruteView brute(*prepared);
      const LightVisibility visibility(*prepared, light);
      const oracle::AreaVisibility oracle(*prepared, prepared->lights[light]);
      Random random(19);
      for (int i = 0; i < 150; ++i) {
        const auto part = static_cast<std::uint32_t>(random.below(prepared->parts.size()));
        const ExactPoint3 p = mix(brute.faces[part].loop, random, 50);
        const VisibleLight found = visibility.at(part, Side::kFront, p);
        const oracle::AreaPointVisibility truth = oracle.at(part, Side::kFront, p);
        if (truth.behind_light) continue;
        EXPECT_EQ(found.visible, truth.visible) << name << ", " << part;
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 100u);
}

TEST(VisibleLight, AgreesWithTheClassesOfFragmentsInsideAndAtTheirVertices) {
  std::array<std::size_t, 3> fragments{};
  Random random(16);
  for (int round = 0; round < 250; ++round) {
    expect_classes(soup(random, 4 + round % 10, 2 + round % 4), std::to_string(round), fragments);
    if (HasFailure()) return;
  }
  EXPECT_GT(fragments[0], 500u);
  EXPECT_GT(fragments[1], 500u);
  EXPECT_GT(fragments[2], 200u);
}

TEST(Illumination, OfPointAndDirectionalLightsInSoups) {
  // The closed segment test in rationals, and cos / r^2 in long doubles.
  Random random(17);
  std::size_t lit = 0, dark = 0;
  for (int round = 0; round < 400; ++round) {
    const bool directional = round % 2 == 0;
    const int power = std::array{0, 0, 0, 200, -200}[static_cast<std::size_t>(round % 5)];
    const PreparedScene scene = soup(random, 5 + round % 8, 2 + round % 4, std::ldexp(1.0, power),
                                     directional ? LightType::kDirectional : LightType::kPoint);
    const BruteView brute(scene);
    const Illuminator illuminator(scene, 0, 3.0);
    ExactPoint3 light;
    for (std::size_t k = 0; k < 3; ++k) {
      const mpz_class& grid = scene.lights[0].point.grid[k];
      light[k] = directional ? mpq_class(grid)
                             : mpq_class(scene.geometry.origin[k] + scene.geometry.step * grid);
    }
    for (std::uint32_t part = 0; part < scene.parts.size(); ++part) {
      const Side side =
          scene.parts[part].two_sided && random.chance(1, 2) ? Side::kBack : Side::kFront;
      const ExactPoint3 p = mix(brute.faces[part].loop, random, 5);
      const ExactPoint3 to_light = directional ? light : minus(light, p);
      const mpq_class own = dot_of(facing(brute, part, side), to_light);
      bool is_lit = sgn(own) > 0;
      for (const BruteView::Face& face : brute.faces) {
        const mpq_class rise = dot_of(face.normal, to_light);
        const mpq_class height = dot_of(face.normal, minus(p, face.loop[0]));
        if (sgn(rise) * sgn(height) >= 0) continue;
        const mpq_class t = -height / rise;
        if (!directional && t >= 1) continue;
        if (sgn(rise) < 0 && !face.two_sided) continue;
        ExactPoint3 meet;
        for (std::size_t k = 0; k < 3; ++k) meet[k] = p[k] + t * to_light[k];
        if (BruteView::place(face.loop, face.normal, meet) >= 0) is_lit = false;
      }
      const Illumination found = illuminator.at(part, side, p, false);
      EXPECT_EQ(found.value > 0, is_lit) << round << ", " << part;
      if (!is_lit) {
        ++dark;
        continue;
      }
      ++lit;
      const mpq_class square = dot_of(to_light, to_light);
      const ExactPoint3& normal = brute.faces[part].normal;
      // (cos / r^2)^2, exactly.
      mpq_class truth = 9 * own * own / dot_of(normal, normal) / square;
      if (!directional) truth /= square * square;
      const mpq_class error = mpq_class(found.value) * mpq_class(found.value) / truth - 1;
      EXPECT_LT(std::fabs(error.get_d()), 1e-14);
      EXPECT_LT(found.error_bound, 1e-14 * found.value);
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(lit, 400u);
  EXPECT_GT(dark, 400u);
}

TEST(Illumination, DoesNotDependOnTheScale) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    std::vector<double> values;
    for (const int power : {0, -60, 60, -400, 400}) {
      Random random(seed), points(seed);
      const PreparedScene scene = soup(random, 10, 3, std::ldexp(1.0, power));
      const BruteView brute(scene);
      const Illuminator illuminator(scene, 0, 1.0, 1e-12);
      for (std::uint32_t part = 0; part < scene.parts.size(); ++part) {
        const ExactPoint3 p = mix(brute.faces[part].loop, points, 5);
        const double value = illuminator.at(part, Side::kFront, p, false).value;
        if (power == 0) {
          values.push_back(value);
        } else {
          EXPECT_EQ(value, values[part]) << seed << ", " << power << ", " << part;
        }
      }
    }
  }
}

TEST(Illumination, TimeOfRooms) {
  for (const char* name : {"paper-room", "room", "city"}) {
    if (generator_by_name(name) == nullptr) continue;
    const auto scene = generate(name);
    ASSERT_TRUE(scene);
    Scene lit = *scene;
    const auto prepared_first = prepare(lit);
    ASSERT_TRUE(prepared_first);
    const Geometry& g = prepared_first->geometry;
    Triple low = g.positions[0], high = low;
    for (std::size_t v = 0; v + g.light_vertices < g.positions.size(); ++v) {
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], g.positions[v][k]);
        high[k] = std::max(high[k], g.positions[v][k]);
      }
    }
    Light light;
    light.id = "panel";
    light.type = LightType::kArea;
    const auto number = [&](std::size_t k, double t) {
      return Number(std::round(1024 * (low[k] + t * (high[k] - low[k]))) / 1024);
    };
    const Number z = number(2, 0.96875);
    light.loop = {{number(0, 0.375), number(1, 0.375), z},
                  {number(0, 0.375), number(1, 0.625), z},
                  {number(0, 0.625), number(1, 0.625), z},
                  {number(0, 0.625), number(1, 0.375), z}};
    lit.lights = {light};
    const auto prepared = prepare(lit);
    ASSERT_TRUE(prepared);
    const BruteView brute(*prepared);
    const Illuminator illuminator(*prepared, 0, 1.0);
    Random random(15);
    std::size_t points = 0;
    const auto start = std::chrono::steady_clock::now();
    for (; points < 2000; ++points) {
      const auto part = static_cast<std::uint32_t>(random.below(prepared->parts.size()));
      illuminator.at(part, Side::kFront, mix(brute.faces[part].loop, random, 100), false);
    }
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const IlluminationCounts counts = illuminator.counts();
    std::printf(
        "%s: %zu parts, %.1f us a point; %llu dark, %llu in doubles, %llu in MPFR (%llu bits); "
        "%.1f casters a point, %.1f signs, %.2f %% exact\n",
        name, prepared->parts.size(), 1e6 * seconds / static_cast<double>(points),
        static_cast<unsigned long long>(counts.dark),
        static_cast<unsigned long long>(counts.in_doubles),
        static_cast<unsigned long long>(counts.in_mpfr),
        static_cast<unsigned long long>(counts.largest_bits),
        static_cast<double>(counts.casters) / static_cast<double>(points),
        static_cast<double>(counts.signs) / static_cast<double>(points),
        100.0 * static_cast<double>(counts.exact_signs) / static_cast<double>(counts.signs));
    EXPECT_EQ(counts.dark + counts.in_doubles + counts.in_mpfr, points);

    // At vertices of penumbra fragments many signs are exactly zero.
    ShadowOptions options;
    options.output.exact_points = true;
    const auto shadows = compute_shadows(*prepared, options);
    ASSERT_TRUE(shadows);
    const LightResult& result = shadows->lights[0];
    const Illuminator at_vertices(*prepared, 0, 1.0);
    double busy = 0;
    points = 0;
    for (const PartResult& part : result.parts) {
      for (std::uint32_t f = 0; f < part.fragment_count && points < 2000; ++f) {
        const Fragment& fragment = result.fragments[part.first_fragment + f];
        if (fragment.state != LightState::kPenumbra) continue;
        const ExactPoint3* loop = result.exact_points.data() + fragment.first;
        const ExactPoint3 inside = odd_point(loop, fragment.count);
        const auto begin = std::chrono::steady_clock::now();
        for (std::uint32_t i = 0; i < fragment.count; ++i, ++points) {
          at_vertices.at(part.part, part.side, loop[i], false, &inside);
        }
        busy += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      }
    }
    const IlluminationCounts at = at_vertices.counts();
    std::printf(
        "  vertices of penumbra fragments: %.1f us each; %llu dark, %llu in MPFR; %.1f "
        "casters, %.1f signs, %.2f %% exact\n",
        1e6 * busy / static_cast<double>(points), static_cast<unsigned long long>(at.dark),
        static_cast<unsigned long long>(at.in_mpfr),
        static_cast<double>(at.casters) / static_cast<double>(points),
        static_cast<double>(at.signs) / static_cast<double>(points),
        100.0 * static_cast<double>(at.exact_signs) / static_cast<double>(at.signs));
  }
}

}  // namespace
}  // namespace gnomon
