// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/algorithms/illumination.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "algorithms/illumination/contour_integral.h"
#include "algorithms/illumination/light_view.h"
#include "algorithms/illumination/visible_pieces.h"
#include "kernel/signs/nearest_double.h"

namespace gnomon {
namespace {

/// The integer times 2^-shift: one rounding.
Ball ball_of(const mpz_class& value, long shift) {
  return rounded_ball(to_double_scaled(value, shift));
}

long bits_of(const ExactVector& vector) {
  std::size_t bits = 1;
  for (const mpz_class& c : vector) bits = std::max(bits, mpz_sizeinbase(c.get_mpz_t(), 2));
  return static_cast<long>(bits);
}

Illumination times(const Ball& value, double intensity) {
  const Ball result = value * Ball(intensity);
  return {result.middle, result.radius};
}

}  // namespace

struct Illuminator::Data {
  Data(const PreparedScene& scene, std::uint32_t light, double strength, double error)
      : view(scene, light),
        intensity(strength),
        relative_error(std::max(error, kLeastRelativeError)) {}

  LightView view;
  double intensity, relative_error;
  std::atomic<std::uint64_t> in_doubles{0}, in_mpfr{0}, dark{0}, exact_signs{0}, signs{0},
      casters{0}, largest_bits{0};

  void count(const SignCounts& counts) {
    signs.fetch_add(counts.all, std::memory_order_relaxed);
    exact_signs.fetch_add(counts.exact, std::memory_order_relaxed);
  }
  bool suffices(const Ball& value) const {
    return value.is_finite() && value.radius <= relative_error / 2 * (value.middle - value.radius);
  }
  Illumination area(const Part& part, Side side, Apex apex, bool unobstructed, const Apex* inwards);
  Illumination point(const Part& part, Side side, const Apex& apex, bool unobstructed,
                     const Apex* inwards);
  bool is_lit(const Part& part, Side side, const Apex& apex, const Apex* inwards,
              SignCounts& counts);
};

Illumination Illuminator::Data::area(const Part& part, Side side, Apex apex, bool unobstructed,
                                     const Apex* inwards) {
  LightPieces pieces(view);
  const std::uint32_t eye = pieces.add_apex(std::move(apex));
  std::uint32_t second = 0;
  if (inwards != nullptr) second = pieces.add_apex(*inwards);
  const std::uint32_t* towards = inwards == nullptr ? nullptr : &second;
  bool visible = clip_to_receiver(pieces, view, part, side, eye);
  if (visible && !unobstructed) {
    casters.fetch_add(subtract_casters(pieces, view, part, side, eye, towards),
                      std::memory_order_relaxed);
    visible = !pieces.empty();
  }
  Illumination result;
  if (visible) {
    // Enclosures of vertices are wide after many cuts: exact coordinates may do, rounded once.
    Ball quick = contour_integral(pieces, view, part, side, eye);
    if (!suffices(quick)) {
      pieces.refine();
      quick = contour_integral(pieces, view, part, side, eye);
    }
    if (suffices(quick)) {
      in_doubles.fetch_add(1, std::memory_order_relaxed);
      result = times(quick, intensity);
    } else {
      std::uint64_t bits = 0;
      in_mpfr.fetch_add(1, std::memory_order_relaxed);
      result = times(contour_integral_mpfr(pieces, view, part, side, eye, relative_error, bits),
                     intensity);
      std::uint64_t known = largest_bits.load(std::memory_order_relaxed);
      while (known < bits && !largest_bits.compare_exchange_weak(known, bits)) {
      }
    }
  } else {
    dark.fetch_add(1, std::memory_order_relaxed);
  }
  count(pieces.counts);
  return result;
}

bool Illuminator::Data::is_lit(const Part& part, Side side, const Apex& apex, const Apex* inwards,
                               SignCounts& counts) {
  const PreparedLight& light = view.light();
  const PreparedScene& scene = view.scene();
  const bool directional = light.point.directional;
  const ExactVector& target = view.origin();
  const PairPoint& near = view.origin_pairs();
  std::vector<std::uint32_t> found;
  view.find_casters(apex, part.plane, part.flipped == (side == Side::kFront), found);
  casters.fetch_add(found.size(), std::memory_order_relaxed);
  for (const std::uint32_t index : found) {
    const LightView::Caster& caster = view.casters()[index];
    const Part& other = scene.parts[caster.part];
    Sign at_apex = view.side_of(other.plane, apex, counts);
    const bool touches = at_apex == Sign::kZero;
    if (touches && inwards != nullptr) at_apex = view.side_of(other.plane, *inwards, counts);
    if (other.flipped) at_apex = -at_apex;
    if (at_apex == Sign::kZero) continue;
    const bool front = at_apex == Sign::kNegative;
    if (front ? !caster.front : !caster.back) continue;
    bool hides = true;
    for (const PlaneRef edge : scene.edges(other)) {
      const Apex* from = &apex;
      if (touches) {
        const ExactVector normal = view.exact_edge_plane(edge.index(), apex).normal;
        if (sgn(normal[0]) == 0 && sgn(normal[1]) == 0 && sgn(normal[2]) == 0) from = inwards;
      }
      ++counts.all;
      const VertexId a = scene.geometry.edges[edge.index()].a;
      const BallVector to_target =
          directional ? BallVector{rounded_ball(near[0].high), rounded_ball(near[1].high),
                                   rounded_ball(near[2].high)}
                      : difference_of(near, view.pairs(a), 1);
      Sign sign = certain_sign(dot(view.edge_normal(edge.index(), *from), to_target));
      if (sign == Sign::kZero) {
        ++counts.exact;
        const LightView::ExactPlane plane = view.exact_edge_plane(edge.index(), *from);
        mpz_class value = dot(plane.normal, target);
        if (!directional) value -= plane.offset;
        sign = sign_of(value);
      }
      if (edge.flipped() == front) sign = -sign;
      // The caster is closed: light that grazes an edge is stopped, so that none leaks between two
      // casters that share it.
      if (sign == Sign::kNegative) {
        hides = false;
        break;
      }
    }
    if (hides) return false;
  }
  return true;
}

Illumination Illuminator::Data::point(const Part& part, Side side, const Apex& apex,
                                      bool unobstructed, const Apex* inwards) {
  const PreparedLight& light = view.light();
  const LightView::ExactPlane plane = view.exact_plane(part.plane);
  ExactVector to_light;  // times a weight
  for (std::size_t k = 0; k < 3; ++k) {
    to_light[k] = light.point.directional
                      ? light.point.grid[k]
                      : mpz_class(apex.weight * light.point.grid[k] - apex.point[k]);
  }
  mpz_class height = dot(plane.normal, to_light);
  if (part.flipped == (side == Side::kFront)) height = -height;
  if (sgn(height) <= 0) {
    dark.fetch_add(1, std::memory_order_relaxed);
    return {};
  }
  if (!unobstructed) {
    SignCounts counts;
    const bool lit = is_lit(part, side, apex, inwards, counts);
    count(counts);
    if (!lit) {
      dark.fetch_add(1, std::memory_order_relaxed);
      return {};
    }
  }
  in_doubles.fetch_add(1, std::memory_order_relaxed);
  // cos = N . d / (|N| |d|), scaled by powers of two so that nothing overflows.
  const long normal_bits = bits_of(plane.normal), bits = bits_of(to_light);
  BallVector normal, direction;
  for (std::size_t k = 0; k < 3; ++k) {
    normal[k] = ball_of(plane.normal[k], normal_bits);
    direction[k] = ball_of(to_light[k], bits);
  }
  const Ball square = dot(direction, direction);
  const Ball cosine = ball_of(height, normal_bits + bits) /
                      (square_root(dot(normal, normal)) * square_root(square));
  if (light.point.directional) return times(cosine, intensity);
  // r^2 = square (2^bits step / weight)^2; its root comes as one rational, so that it stays in
  // range.
  mpq_class unit(mpz_class(1) << static_cast<mp_bitcnt_t>(bits), apex.weight);
  unit.canonicalize();
  const Ball size = enclose(mpq_class(unit * view.scene().geometry.step));
  return times(cosine / square / size / size, intensity);
}

Illuminator::Illuminator(const PreparedScene& scene, std::uint32_t light, double intensity,
                         double relative_error)
    : data_(std::make_unique<Data>(scene, light, intensity, relative_error)) {}
Illuminator::~Illuminator() = default;
Illuminator::Illuminator(Illuminator&&) noexcept = default;
Illuminator& Illuminator::operator=(Illuminator&&) noexcept = default;

Illumination Illuminator::at(std::uint32_t part, Side side, const std::array<mpq_class, 3>& point,
                             bool unobstructed, const std::array<mpq_class, 3>* inwards) const {
  const PreparedScene& scene = data_->view.scene();
  Apex apex = Apex::from(scene.geometry, point);
  Apex second;
  if (inwards != nullptr) second = Apex::from(scene.geometry, *inwards);
  const Apex* towards = inwards == nullptr ? nullptr : &second;
  if (data_->view.light().has_area()) {
    return data_->area(scene.parts[part], side, std::move(apex), unobstructed, towards);
  }
  return data_->point(scene.parts[part], side, apex, unobstructed, towards);
}

IlluminationCounts Illuminator::counts() const {
  IlluminationCounts result;
  result.in_doubles = data_->in_doubles;
  result.in_mpfr = data_->in_mpfr;
  result.dark = data_->dark;
  result.exact_signs = data_->exact_signs;
  result.signs = data_->signs;
  result.casters = data_->casters;
  result.largest_bits = data_->largest_bits;
  return result;
}

}  // namespace gnomon
