// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/illumination/contour_integral.h"

#include <mpfr.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace gnomon {
namespace {

constexpr double kHalfPi = 0x1.921fb54442d18p+0;  // nearest double, error below u

/// arctan(k / 8), nearest doubles; a test recomputes them.
constexpr std::array<double, 9> kArcTangents = {
    0.0,
    0x1.fd5ba9aac2f6ep-4,
    0x1.f5b75f92c80ddp-3,
    0x1.6f61941e4def1p-2,
    0x1.dac670561bb4fp-2,
    0x1.1e00babdefeb4p-1,
    0x1.4978fa3269ee1p-1,
    0x1.700a7c5784634p-1,
    0x1.921fb54442d18p-1,
};

/// arctan(r) / r for |r| <= 1/16: the series up to r^12; what is left is below 2^-59.
double series(double r) {
  const double x = r * r;
  return 1 +
         x * (-1.0 / 3 + x * (1.0 / 5 + x * (-1.0 / 7 + x * (1.0 / 9 + x * (-1.0 / 11 + x / 13)))));
}

/// arctan(t) for any t, from its absolute value: Lipschitz constant 1.
Ball arc_tangent(const Ball& t) {
  // Only called with |middle| <= 1.
  const double middle = t.middle * arc_tangent_over(std::fabs(t.middle));
  return {middle,
          (t.radius + (kArcTangentError + Ball::kUnit) * std::fabs(middle)) * Ball::kInflate +
              Ball::kTiny};
}

Ball norm(const BallVector& a) { return square_root(dot(a, a)); }

/// MPFR number of one precision.
class Real {
 public:
  explicit Real(mpfr_prec_t bits) { mpfr_init2(value_, bits); }
  ~Real() { mpfr_clear(value_); }
  Real(const Real&) = delete;
  Real& operator=(const Real&) = delete;
  mpfr_ptr get() { return value_; }

 private:
  mpfr_t value_;
};

/// What MPFR needs of an edge, exactly: angle between a and b, and the cosine.
struct ExactEdge {
  mpz_class dot;     // a . b
  mpz_class square;  // |a x b|^2
  mpz_class height;  // N . (b x a)
};

}  // namespace

Ball square_root(const Ball& x) {
  const double most = x.middle + x.radius;
  if (!(most > 0)) return {0, std::sqrt(std::max(0.0, most)) + Ball::kTiny};
  if (!(x.middle > x.radius)) {
    const double half = std::sqrt(most) / 2;
    return {half, (half + 4 * Ball::kUnit * half) * Ball::kInflate + Ball::kTiny};
  }
  // |sqrt(y) - sqrt(m)| <= |y - m| / sqrt(m).
  const double root = std::sqrt(x.middle);
  return {root, (x.radius / root + 2 * Ball::kUnit * root) * Ball::kInflate + Ball::kTiny};
}

double arc_tangent_over(double t) {
  const int k = static_cast<int>(std::lround(8 * t));
  if (k == 0) return series(t);
  // arctan(t) = arctan(c) + arctan((t - c) / (1 + t c)); t - c is exact, the argument within 1/16.
  const double c = k / 8.0;
  const double r = (t - c) / (1 + t * c);
  return (kArcTangents[static_cast<std::size_t>(k)] + r * series(r)) / t;
}

Ball angle_over(const Ball& s, const Ball& c) {
  if (c.middle > 0 && s.middle <= c.middle) {
    const Ball t = s / c;
    if (!t.is_finite()) return t;
    const double at = std::clamp(t.middle, 0.0, 1.0);
    // |d/dt arctan(t)/t| < 0.325 everywhere; 1/2 also covers the clamping, as t is not negative.
    const double ratio = arc_tangent_over(at);
    const double moved = t.radius + std::fabs(t.middle - at);
    return Ball(ratio, (moved / 2 + kArcTangentError * ratio) * Ball::kInflate) / c;
  }
  const Ball half_pi(kHalfPi, Ball::kUnit);
  if (std::fabs(c.middle) <= s.middle) {
    const Ball t = c / s;
    return t.is_finite() ? (half_pi - arc_tangent(t)) / s : t;
  }
  const Ball t = s / -c;
  if (!t.is_finite() || !(t.middle >= 0) || !(t.middle <= 1)) return Ball() / Ball();
  return (half_pi + half_pi - arc_tangent(t)) / s;
}

Ball contour_integral(LightPieces& pieces, const LightView& view, const Part& part, Side side,
                      std::uint32_t apex) {
  const Apex& eye = pieces.apex(apex);
  BallVector normal = view.normal(part.plane);
  const Ball length = norm(normal);
  // Seen from its front the light runs counter-clockwise, which is clockwise about the direction of
  // the light: the sum has the opposite sign.
  const bool flip = part.flipped == (side == Side::kFront);
  for (Ball& c : normal) c = (flip ? c : -c) / length;
  const BallVector to_origin = difference_of(view.origin_pairs(), eye.near, eye.reach);
  const BallVector& e1 = view.near_axis(0);
  const BallVector& e2 = view.near_axis(1);

  Ball sum;
  for (const LightPieces::Piece& piece : pieces.pieces()) {
    const std::size_t n = piece.vertices.size();
    for (std::size_t i = 0; i < n; ++i) {
      const std::array<Ball, 2>& from = pieces.near(piece.vertices[i]);
      const std::array<Ball, 2>& to = pieces.near(piece.vertices[i + 1 == n ? 0 : i + 1]);
      const Ball ds = to[0] - from[0], dt = to[1] - from[1];
      BallVector a, step;
      for (std::size_t k = 0; k < 3; ++k) {
        a[k] = to_origin[k] + from[0] * e1[k] + from[1] * e2[k];
        step[k] = ds * e1[k] + dt * e2[k];
      }
      const BallVector product = cross(a, step);
      sum = sum + angle_over(norm(product), dot(a, a) + dot(a, step)) * dot(normal, product);
    }
  }
  return Ball(0.5) * sum;
}

Ball contour_integral_mpfr(LightPieces& pieces, const LightView& view, const Part& part, Side side,
                           std::uint32_t apex, double relative_error, std::uint64_t& used_bits) {
  const Apex& eye = pieces.apex(apex);
  ExactVector normal = view.exact_plane(part.plane).normal;
  if (part.flipped == (side == Side::kFront)) {
    for (mpz_class& c : normal) c = -c;
  }
  const mpz_class normal_square = dot(normal, normal);
  // From p = P / W to a0 + s e1 + t e2, times W w: w (W a0 - P) + W (s w e1 + t w e2).
  ExactVector to_origin;
  for (std::size_t k = 0; k < 3; ++k) {
    to_origin[k] = eye.weight * view.origin()[k] - eye.point[k];
  }
  std::vector<ExactEdge> edges;
  for (const LightPieces::Piece& piece : pieces.pieces()) {
    std::vector<ExactVector> rays;
    for (const std::uint32_t vertex : piece.vertices) {
      const ExactVector& at = pieces.exact(vertex);
      ExactVector ray;
      for (std::size_t k = 0; k < 3; ++k) {
        ray[k] =
            at[2] * to_origin[k] + eye.weight * (at[0] * view.axis(0)[k] + at[1] * view.axis(1)[k]);
      }
      rays.push_back(std::move(ray));
    }
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const ExactVector& a = rays[i];
      const ExactVector& b = rays[i + 1 == rays.size() ? 0 : i + 1];
      const ExactVector product = cross(b, a);
      ExactEdge edge{dot(a, b), dot(product, product), dot(normal, product)};
      if (sgn(edge.height) != 0) edges.push_back(std::move(edge));
    }
  }

  for (mpfr_prec_t bits = 128;; bits *= 2) {
    used_bits = static_cast<std::uint64_t>(bits);
    Real sum(bits), total(bits), angle(bits), s(bits), c(bits), scale(bits);
    mpfr_set_zero(sum.get(), 1);
    mpfr_set_zero(total.get(), 1);
    for (const ExactEdge& edge : edges) {
      mpfr_set_z(s.get(), edge.square.get_mpz_t(), MPFR_RNDN);
      mpfr_sqrt(s.get(), s.get(), MPFR_RNDN);
      mpfr_set_z(c.get(), edge.dot.get_mpz_t(), MPFR_RNDN);
      mpfr_atan2(angle.get(), s.get(), c.get(), MPFR_RNDN);
      const mpz_class squares = edge.square * normal_square;
      mpfr_set_z(scale.get(), squares.get_mpz_t(), MPFR_RNDN);
      mpfr_sqrt(scale.get(), scale.get(), MPFR_RNDN);
      mpfr_mul_z(angle.get(), angle.get(), edge.height.get_mpz_t(), MPFR_RNDN);
      mpfr_div(angle.get(), angle.get(), scale.get(), MPFR_RNDN);
      mpfr_add(sum.get(), sum.get(), angle.get(), MPFR_RNDN);
      mpfr_abs(angle.get(), angle.get(), MPFR_RNDN);
      mpfr_add(total.get(), total.get(), angle.get(), MPFR_RNDU);
    }
    // Each term errs by at most 16 units of 2^-bits, each partial sum by one of its own size.
    mpfr_mul_ui(total.get(), total.get(), 18 + edges.size(), MPFR_RNDU);
    mpfr_mul_2si(total.get(), total.get(), -static_cast<long>(bits), MPFR_RNDU);
    mpfr_mul_d(scale.get(), sum.get(), relative_error / 4, MPFR_RNDD);
    if (mpfr_cmp(total.get(), scale.get()) > 0) continue;
    mpfr_div_2ui(sum.get(), sum.get(), 1, MPFR_RNDN);
    mpfr_div_2ui(total.get(), total.get(), 1, MPFR_RNDU);
    const double value = mpfr_get_d(sum.get(), MPFR_RNDN);
    const double error = mpfr_get_d(total.get(), MPFR_RNDU);
    return {value, (error + Ball::kUnit * value) * Ball::kInflate + 0x1p-1074};
  }
}

}  // namespace gnomon
