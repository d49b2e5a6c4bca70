// SPDX-License-Identifier: LGPL-3.0-or-later
// The decisions of kernel `plane` at the samples of a picture, down the ladder of stages.
#include "kernel/implicit/implicit_image_space.h"

#include <algorithm>
#include <cmath>

#include "gnomon/kernel/image_precision.h"
#include "gnomon/kernel/precision_plan.h"
#include "kernel/implicit/filter_bounds.h"

namespace gnomon {
namespace {

constexpr double kUnit = Ball::kUnit;
/// Of n . d, times the largest component of d.
constexpr double kAlongError = 16 * kUnit;
/// Of the bracket, times that component and |Q(E)| + |P(E)|.
constexpr double kBracketError = 32 * kUnit;

}  // namespace

template <class Stats>
ImplicitImageSpace<Stats>::ImplicitImageSpace(const Geometry& geometry, const ImageFrame& frame,
                                              const KernelOptions&)
    : geometry_(&geometry),
      frame_(frame),
      scale_bits_(geometry.grid.bits()),
      grid_bits_(scale_bits_),
      sample_bits_(frame.direction_bits()) {
  for (const mpz_class& x : frame.eye.grid) grid_bits_ = std::max(grid_bits_, bits_of(x));
  for (std::size_t k = 0; k < 3; ++k) moves_[0][k] = frame.right[k];
  for (std::size_t k = 0; k < 3; ++k) moves_[1][k] = frame.up[k];
  planes_.reserve(geometry.planes.size());
  for (PlaneId id = 0; id < geometry.planes.size(); ++id) {
    Source source;
    source.support = id;
    add(planes_, source);
  }
  sample_ = {0, 1};
  look_along({0, 0});
}

template <class Stats>
ImageLight ImplicitImageSpace<Stats>::add_light(const LightPoint& light) {
  if (light.directional) {
    direction_bits_ = std::max(direction_bits_, bits_of(light.grid));
  } else {
    grid_bits_ = std::max(grid_bits_, bits_of(light.grid));
    // Differences of points of the grid and a far lamp below it.
    const auto is_below = [](const LightPoint& other) {
      return !other.directional &&
             std::ranges::any_of(other.grid, [](const mpz_class& x) { return sgn(x) < 0; });
    };
    if (is_below(light) && std::ranges::none_of(lights_, is_below)) ++grid_bits_;
  }
  lights_.push_back(light);
  return {static_cast<std::uint32_t>(lights_.size() - 1)};
}

template <class Stats>
PlaneRef ImplicitImageSpace<Stats>::add_shadow_plane(ImageLight light, VertexId a, VertexId b) {
  Source source;
  source.kind = Source::Kind::kShadow;
  source.light = light;
  source.from = ImagePoint::at(a);
  source.to = ImagePoint::at(b);
  return PlaneRef(add(planes_, source));
}

template <class Stats>
PlaneRef ImplicitImageSpace<Stats>::add_grid_plane(const GridPlane& plane) {
  Source source;
  source.kind = Source::Kind::kGrid;
  source.support = static_cast<PlaneId>(grid_planes_.size());
  grid_planes_.push_back(plane);
  return PlaneRef(add(planes_, source));
}

template <class Stats>
RayPlaneRef ImplicitImageSpace<Stats>::add_ray_plane(ImagePoint from, ImagePoint to) {
  Source source;
  source.kind = Source::Kind::kRay;
  source.from = from;
  source.to = to;
  return {add(ray_planes_, source), false};
}

template <class Stats>
template <class Int>
auto ImplicitImageSpace<Stats>::exact(const Source& source) const -> ExactSource<Int> {
  const ExactGeometry<Int> exact(*geometry_);
  if (source.kind == Source::Kind::kSupport) {
    return {exact.template normal<Int>(source.support),
            exact.position(geometry_->planes[source.support].a),
            {}};
  }
  if (source.kind == Source::Kind::kGrid) {
    const GridPlane& plane = grid_planes_[source.support];
    return {integers<Int>(plane.n), {}, integer_from<Int>(plane.d)};
  }
  if (source.kind == Source::Kind::kShadow) {
    const Vector3<Int> a = point<Int>(source.from), b = point<Int>(source.to);
    const LightPoint& light = lights_[source.light.index];
    const Vector3<Int> at = integers<Int>(light.grid);
    return {cross(light.directional ? at : difference(at, a), difference(b, a)), a, {}};
  }
  const Vector3<Int> eye = integers<Int>(frame_.eye.grid);
  const auto seen = [&](const ImagePoint& of) {
    return is_direction(of) ? point<Int>(of) : difference(point<Int>(of), eye);
  };
  return {cross(seen(source.to), seen(source.from)), eye, {}};
}

/// Of the largest component of its normal.
template <class Stats>
unsigned ImplicitImageSpace<Stats>::grid_plane_bits(const Source& source) const {
  return bits_of(grid_planes_[source.support].n);
}

/// Signed bits of the plane's value at a position, and of its offset.
template <class Stats>
unsigned ImplicitImageSpace<Stats>::value_bits(const Plane& plane) const {
  if (plane.source.kind == Source::Kind::kGrid) {
    // Three products, a difference, a sign.
    return std::max(grid_plane_bits(plane.source) + grid_bits_ + 2,
                    bits_of(grid_planes_[plane.source.support].d)) +
           2;
  }
  return plane.has_direction ? 2 * grid_bits_ + direction_bits_ + 3
                             : side_of_support_bits(grid_bits_);
}

template <class Stats>
unsigned ImplicitImageSpace<Stats>::coverage_bits(const Plane& plane) const {
  if (plane.source.kind == Source::Kind::kGrid) {
    // Its offset is read with it.
    return std::max(grid_plane_bits(plane.source) + sample_bits_ + 2, value_bits(plane));
  }
  return plane.has_direction ? image_coverage_bits(grid_bits_, direction_bits_, sample_bits_)
                             : image_coverage_bits(grid_bits_, sample_bits_);
}

template <class Stats>
std::uint32_t ImplicitImageSpace<Stats>::add(std::vector<Plane>& planes, const Source& source) {
  Plane plane;
  plane.source = source;
  plane.has_direction = source.kind == Source::Kind::kShadow
                            ? lights_[source.light.index].directional
                            : source.kind == Source::Kind::kRay &&
                                  (is_direction(source.from) || is_direction(source.to));
  // All of n is multiplied by one power of two, and values by 2^-b besides.
  const long shift = 2L * scale_bits_, value_shift = 3L * scale_bits_;
  with_width(narrowest_width(value_bits(plane) + 1), [&]<class Int>() {
    const ExactSource<Int> of = exact<Int>(source);
    const Int at_eye = of.value(integers<Int>(frame_.eye.grid));
    const Int offset = Int(dot(of.n, of.base) + of.d);
    plane.eye_sign = sign_of(at_eye);
    for (std::size_t k = 0; k < 3; ++k) plane.guess.n[k] = to_double_scaled(of.n[k], shift);
    plane.guess.at_eye = to_double_scaled(at_eye, value_shift);
    plane.d = to_double_scaled(offset, value_shift);
  });
  const double size = largest(plane.guess.n);
  // Scaling by a power of two is exact only while nothing is subnormal.
  plane.usable = size >= 0x1p-900 && size < 0x1p900 &&
                 (plane.eye_sign == Sign::kZero || std::fabs(plane.guess.at_eye) >= 0x1p-900);
  if (plane.usable) {
    const double scale = normalizer(size);
    for (double& n : plane.guess.n) n *= scale;
    plane.guess.at_eye *= scale;
    plane.d *= scale;
  }
  planes.push_back(plane);
  return static_cast<std::uint32_t>(planes.size() - 1);
}

template <class Stats>
auto ImplicitImageSpace<Stats>::look_along(ImageSample sample) -> const Direction& {
  if (sample == sample_) return direction_;
  sample_ = sample;
  direction_.exact = frame_.direction(sample);
  for (std::size_t k = 0; k < 3; ++k) {
    direction_.nearest[k] = static_cast<double>(direction_.exact[k]);
  }
  direction_.largest = largest(direction_.nearest);
  return direction_;
}

template <class Stats>
Sign ImplicitImageSpace<Stats>::side_of_light(PlaneRef ref, ImageLight light) {
  const Plane& plane = planes_[ref.index()];
  const LightPoint& of = lights_[light.index];
  unsigned bits = of.directional ? 2 * grid_bits_ + direction_bits_ + 3 : value_bits(plane);
  if (plane.source.kind == Source::Kind::kGrid) {
    bits = std::max(grid_plane_bits(plane.source) + direction_bits_ + 3, value_bits(plane));
  }
  const Sign sign = stages_.exact(narrowest_width(bits), 0, [&]<class, class Int>() {
    const ExactSource<Int> source = exact<Int>(plane.source);
    const Vector3<Int> at = integers<Int>(of.grid);
    return sign_of(of.directional ? dot(source.n, at) : source.value(at));
  });
  return turned(sign, ref.flipped());
}

template <class Stats>
Side ImplicitImageSpace<Stats>::side_of_vertex(PlaneRef ref, VertexId vertex) {
  const Plane& plane = planes_[ref.index()];
  const GridPositions& grid = geometry_->grid;
  Double3 x;
  for (int k = 0; k < 3; ++k) {
    x[static_cast<std::size_t>(k)] = grid.is_narrow()
                                         ? to_double_scaled(grid.narrow(vertex, k), scale_bits_)
                                         : to_double_scaled(grid.wide(vertex, k), scale_bits_);
  }
  const double bound = plane.usable ? SceneBounds::value(SceneBounds::kInputError) : kUnknownError;
  return stages_.filtered(dot(plane.guess.n, x) - plane.d, bound, ref.flipped(), [&] {
    const Sign sign = stages_.exact(narrowest_width(value_bits(plane)), 0, [&]<class, class Int>() {
      const ExactSource<Int> source = exact<Int>(plane.source);
      return sign_of(source.value(ExactGeometry<Int>(*geometry_).position(vertex)));
    });
    return side_of(turned(sign, ref.flipped()));
  });
}

template <class Stats>
Sign ImplicitImageSpace<Stats>::heading(PlaneRef ref, ImageSample sample) {
  return turned(along(planes_[ref.index()], sample), ref.flipped());
}

template <class Stats>
Sign ImplicitImageSpace<Stats>::covers(RayPlaneRef ref, ImageSample sample) {
  return turned(along(ray_planes_[ref.index], sample), ref.flipped);
}

template <class Stats>
Sign ImplicitImageSpace<Stats>::along(const Plane& plane, ImageSample sample) {
  const Direction& d = look_along(sample);
  const double bound = plane.usable ? kAlongError * d.largest : kUnknownError;
  return static_cast<Sign>(stages_.filtered(dot(plane.guess.n, d.nearest), bound, false, [&] {
    Sign sign = exact_along(plane, d.exact);
    for (const auto& move : moves_) {
      if (sign == Sign::kZero) sign = exact_along(plane, move);
    }
    return side_of(sign);
  }));
}

template <class Stats>
Sign ImplicitImageSpace<Stats>::exact_along(const Plane& plane,
                                            const std::array<std::int64_t, 3>& d) {
  return stages_.exact(narrowest_width(coverage_bits(plane)), 0, [&]<class, class Int>() {
    return sign_of(dot(exact<Int>(plane.source).n, along_of<Int>(d)));
  });
}

template <class Stats>
Sign ImplicitImageSpace<Stats>::side_at_sample(PlaneRef of, PlaneRef on, ImageSample sample) {
  if (of.same_plane(on)) return stages_.known(Sign::kZero);
  const Plane &q = planes_[of.index()], &p = planes_[on.index()];
  const Direction& d = look_along(sample);
  const double q_eye = q.guess.at_eye, p_eye = p.guess.at_eye;
  const double value = dot(p.guess.n, d.nearest) * q_eye - dot(q.guess.n, d.nearest) * p_eye;
  const double bound = q.usable && p.usable
                           ? kBracketError * d.largest * (std::fabs(q_eye) + std::fabs(p_eye))
                           : kUnknownError;
  // The ray meets P, so that n . d has the opposite sign of P(E).
  const bool turn = (p.eye_sign == Sign::kPositive) != of.flipped();
  return static_cast<Sign>(stages_.filtered(value, bound, turn, [&] {
    const Sign sign = exact_bracket(q, p, d.exact) * -p.eye_sign;
    return side_of(turned(sign == Sign::kZero ? moved(q, p) : sign, of.flipped()));
  }));
}

/// The side of Q to which the sample on P goes when it is moved along R, else along U.
template <class Stats>
Sign ImplicitImageSpace<Stats>::moved(const Plane& q, const Plane& p) {
  for (const auto& move : moves_) {
    const Sign sign = exact_bracket(q, p, move);
    if (sign == Sign::kZero) continue;
    return sign * (frame_.ties == TieRule::kPlaneStays ? -p.eye_sign : exact_along(p, move));
  }
  return Sign::kZero;
}

template <class Stats>
unsigned ImplicitImageSpace<Stats>::bracket_bits(const Plane& q, const Plane& p) const {
  if (q.source.kind == Source::Kind::kGrid || p.source.kind == Source::Kind::kGrid) {
    // The difference of two products.
    return std::max(coverage_bits(p) + value_bits(q), coverage_bits(q) + value_bits(p)) + 1;
  }
  return q.has_direction && p.has_direction
             ? image_order_bits(grid_bits_, direction_bits_, sample_bits_)
         : q.has_direction || p.has_direction
             ? image_side_bits(grid_bits_, direction_bits_, sample_bits_)
             : image_side_bits(grid_bits_, sample_bits_);
}

template <class Stats>
Sign ImplicitImageSpace<Stats>::exact_bracket(const Plane& q, const Plane& p,
                                              const std::array<std::int64_t, 3>& d) {
  return stages_.exact(narrowest_width(bracket_bits(q, p)), 0, [&]<class, class Int>() {
    const ExactSource<Int> first = exact<Int>(q.source), second = exact<Int>(p.source);
    const Vector3<Int> eye = integers<Int>(frame_.eye.grid), along = along_of<Int>(d);
    return sign_of(Int(Int(dot(second.n, along) * first.value(eye)) -
                       Int(dot(first.n, along) * second.value(eye))));
  });
}

template class ImplicitImageSpace<NoStats>;
template class ImplicitImageSpace<CountStats>;

}  // namespace gnomon
