// SPDX-License-Identifier: LGPL-3.0-or-later
// The points of corners of light space from integers: accurate doubles, enclosures, rationals.
#include "kernel/implicit/light_positions.h"

#include "kernel/implicit/scaled_doubles.h"
#include "kernel/signs/fp_environment.h"

namespace gnomon {

LightPositions::LightPositions(const ScenePlanes& scene, const LightPoint& light)
    : LightPlanes(scene, light) {
  auto frame = std::make_shared<Frame>();
  const GridPositions& grid = geometry().grid;
  const unsigned b = light.directional ? grid.bits() : std::max(grid.bits(), integers().light_bits);
  if (integers().narrow) {
    frame->grid_scale = std::ldexp(1.0, -static_cast<int>(integers().q_bits));
  }
  const unsigned shift = integers().is_parallel() ? integers().light_bits : grid.bits();
  if (is_far()) {
    frame->nearness =
        std::ldexp(1.0, static_cast<int>(grid.bits()) - static_cast<int>(integers().light_bits));
  }
  for (int k = 0; k < 3; ++k) {
    const double value = to_double_scaled(light.grid[k], shift);
    frame->light[k] = Ball(value, 2 * Ball::kUnit * std::fabs(value) + Ball::kTiny);
    frame->origin[k] = double_double(geometry().origin[k]);
    const mpq_class zero = -geometry().origin[k] / geometry().step;
    const bool on_grid =
        zero.get_den() == 1 && bits_of(zero.get_num()) <= b && sgn(zero) >= 0 && b <= 63;
    if (on_grid) frame->zero[k] = zero.get_num().get_si();
  }
  frame->step = double_double(geometry().step);
  frame_ = std::move(frame);
}

/// For with_widths(): planes that meet in a made corner, and its support normal.
unsigned LightPositions::factor_bits(const Corner<Vertex>& corner) const {
  return std::max({plane_bits(corner.before), plane_bits(corner.after),
                   support_normal_bits(geometry().grid.bits()) + 1});
}

/// Of the ray of a made corner, or of L - A: planes of a prefix have so few bits that it may be the
/// longer.
unsigned LightPositions::ray_bits(const Corner<Vertex>& corner) const {
  return std::max(plane_bits(corner.before) + plane_bits(corner.after) + 2, integers().q_bits);
}

// --- Far lamps; their doubles are in far_positions.cc. ---

template <class Normal, class Int, class Ray>
std::array<Int, 4> LightPositions::far_quotients(const Vector3<Ray>& ray, PlaneId support) const {
  using Position = PositionFor<Int>;
  const ExactGeometry<Position> exact(geometry());
  const Vector3<Normal> n = exact.template normal<Normal>(support);
  const Vector3<Position> a = exact.position(geometry().planes[support].a);
  const Vector3<Position> l = integers().position<Position>();
  const Int height = dot<Int>(n, difference(l, a)), slope = dot<Int>(n, ray);
  std::array<Int, 4> result;
  for (std::size_t k = 0; k < 3; ++k) {
    result[k] = Int(multiply<Int>(l[k], slope) - multiply<Int>(height, ray[k]));
  }
  result[3] = slope;
  return result;
}

template <class Factor, class Int>
LightPositions::PairPoint LightPositions::pair_far_point(const Corner<Vertex>& corner) const {
  const std::array<Int, 4> quotients =
      far_quotients<Factor, Int>(exact_ray<Factor, Int>(corner), corner.support);
  const DoubleDouble under = double_double(quotients[3]);
  PairPoint point;
  for (std::size_t k = 0; k < 3; ++k) {
    point.x[k] = double_double(quotients[k]) / under;
    point.terms[k] = std::fabs(point.x[k].high);
  }
  return point;
}

// --- In a frame of the support plane. ---

// q = h r / (n . r) of the ray r, the plane's normal n and its value h at the light, up to one
// common factor; for a directional light r / r_z. Each factor is rounded once, so that nothing
// cancels; unbounded integers may be beyond doubles, and give their powers of two away first.
template <class Normal, class Int, class Ray>
PlanarPoint LightPositions::quotient_on_plane(const Vector3<Ray>& ray, PlaneId support) const {
  const auto [u, v] = is_far() ? kept_under_far(depth(support)) : kept_axes(depth(support));
  std::array<double, 4> value;
  long power;
  if (is_far()) {
    const std::array<Int, 4> quotients = far_quotients<Normal, Int>(ray, support);
    const Int &first = quotients[static_cast<std::size_t>(u)],
              &second = quotients[static_cast<std::size_t>(v)];
    const long top = std::max(excess_bits(first), excess_bits(second)),
               low = excess_bits(quotients[3]);
    value = {to_double_scaled(first, top), to_double_scaled(second, top),
             to_double_scaled(quotients[3], low), 1};
    power = top - low - static_cast<long>(geometry().grid.bits());
  } else if (is_directional()) {
    const long top = std::max(excess_bits(ray[0]), excess_bits(ray[1])), low = excess_bits(ray[2]);
    value = {to_double_scaled(ray[0], top), to_double_scaled(ray[1], top),
             to_double_scaled(ray[2], low), 1};
    power = top - low - stretch();
  } else {
    using Position = PositionFor<Int>;
    const ExactGeometry<Position> exact(geometry());
    const Vector3<Normal> n = exact.template normal<Normal>(support);
    const Vector3<Position> a = exact.position(geometry().planes[support].a);
    const Int height = dot<Int>(n, difference(integers().position<Position>(), a));
    const Int slope = dot<Int>(n, ray);
    const long top = std::max(excess_bits(ray[u]), excess_bits(ray[v])), low = excess_bits(slope),
               far = excess_bits(height);
    value = {to_double_scaled(ray[u], top), to_double_scaled(ray[v], top),
             to_double_scaled(slope, low), to_double_scaled(height, far)};
    power = top - low + far - static_cast<long>(integers().q_bits);
  }
  PlanarPoint point;
  point.x = std::ldexp(value[0] / value[2] * value[3], static_cast<int>(power));
  point.y = std::ldexp(value[1] / value[2] * value[3], static_cast<int>(power));
  const double most = std::max(std::fabs(point.x), std::fabs(point.y));
  point.error = most < 0x1p900 ? LightBounds::kAccurate * most + 0x1p-900 : kUnknownError;
  return point;
}

PlanarPoint LightPositions::accurate_planar_point(const Corner<Vertex>& corner) const {
  const VertexId input = corner.vertex.source;
  if (input != kMadeVertex) {
    if (is_far()) return far_planar_point(corner);
    if (integers().narrow && !is_directional()) return input_planar_point(corner);
    return quotient_on_plane<mpz_class, mpz_class>(integers().q<mpz_class>(input), corner.support);
  }
  const unsigned normal_bits = 2 * geometry().grid.bits() + 1;
  PlanarPoint point;
  with_widths(width_of(is_narrow_corner(corner), ray_bits(corner) + normal_bits + 3 + far_bits()),
              factor_bits(corner), [&]<class Factor, class Int>() {
                point =
                    quotient_on_plane<Factor, Int>(exact_ray<Factor, Int>(corner), corner.support);
              });
  return point;
}

// As quotient_on_plane().
template <class Normal, class Int, class Ray>
PlanarPair LightPositions::pair_quotient(const Vector3<Ray>& ray, PlaneId support) const {
  const auto [u, v] = is_far() ? kept_under_far(depth(support)) : kept_axes(depth(support));
  const auto is_moderate = [](double x) { return std::fabs(x) < 0x1p800; };
  PlanarPair point;
  point.error = kUnknownError;
  DoubleDouble over{1, 0}, under;
  long power = -stretch();
  std::array<DoubleDouble, 2> r = {double_double(ray[0]), double_double(ray[1])};
  if (is_far()) {
    const std::array<Int, 4> quotients = far_quotients<Normal, Int>(ray, support);
    under = double_double(quotients[3]);
    r = {double_double(quotients[static_cast<std::size_t>(u)]),
         double_double(quotients[static_cast<std::size_t>(v)])};
    power = -static_cast<long>(geometry().grid.bits());
  } else if (is_directional()) {
    under = double_double(ray[2]);
  } else {
    using Position = PositionFor<Int>;
    const ExactGeometry<Position> exact(geometry());
    const Vector3<Normal> n = exact.template normal<Normal>(support);
    const Vector3<Position> a = exact.position(geometry().planes[support].a);
    over = double_double(dot<Int>(n, difference(integers().position<Position>(), a)));
    under = double_double(dot<Int>(n, ray));
    r = {double_double(ray[u]), double_double(ray[v])};
    power = -static_cast<long>(integers().q_bits);
  }
  if (!is_moderate(over.high) || !is_moderate(under.high) || under.high == 0) return point;
  const DoubleDouble factor = over / under;
  const double most = std::max(std::fabs(r[0].high), std::fabs(r[1].high));
  const double size = most * std::fabs(factor.high);
  // Nothing underflows on the way, which bounds of pairs do not cover.
  if (!is_moderate(most) || !is_moderate(size) || !(std::fabs(factor.high) > 0x1p-800))
    return point;
  if (size != 0 && !(size > 0x1p-700)) return point;
  const double scale = std::ldexp(1.0, static_cast<int>(power));
  const auto scaled = [&](const DoubleDouble& value) {
    const DoubleDouble product = value * factor;
    return DoubleDouble{product.high * scale, product.low * scale};
  };
  point.x = scaled(r[0]);
  point.y = scaled(r[1]);
  // Of the smaller coordinate what underflows is far below that.
  point.error =
      LightBounds::kAccuratePair * std::max(std::fabs(point.x.high), std::fabs(point.y.high)) +
      0x1p-1000;
  return point;
}

PlanarPair LightPositions::pair_planar_point(const Corner<Vertex>& corner) const {
  const VertexId input = corner.vertex.source;
  if (input != kMadeVertex) {
    if (is_far() && geometry().grid.is_narrow()) {
      const auto [u, v] = kept_under_far(depth(corner.support));
      const double scale = std::ldexp(1.0, -static_cast<int>(geometry().grid.bits()));
      const auto along = [&](int axis) {
        const DoubleDouble pair = double_double(geometry().grid.narrow(input, axis));
        return DoubleDouble{pair.high * scale, pair.low * scale};
      };
      return {along(u), along(v), 0};
    }
    if (!integers().narrow || is_directional()) {
      return pair_quotient<mpz_class, mpz_class>(integers().q<mpz_class>(input), corner.support);
    }
    const auto [u, v] = kept_axes(depth(corner.support));
    const std::int64_t* x = geometry().grid.narrow_point(input);
    const auto offset = [&](int axis) {
      const DoubleDouble pair = double_double(integers().narrow_light[axis] - x[axis]);
      return DoubleDouble{pair.high * frame_->grid_scale, pair.low * frame_->grid_scale};
    };
    return {offset(u), offset(v), 0};
  }
  const unsigned normal_bits = 2 * geometry().grid.bits() + 1;
  PlanarPair point;
  with_widths(width_of(is_narrow_corner(corner), ray_bits(corner) + normal_bits + 3 + far_bits()),
              factor_bits(corner), [&]<class Factor, class Int>() {
                point = pair_quotient<Factor, Int>(exact_ray<Factor, Int>(corner), corner.support);
              });
  return point;
}

// --- In the scene. ---

// On the ray r the support plane i is met where P_i(v) = 0. Point light: v = L - s r with
// s = P_i(L) / (n_i . r). Directional: U = r_x / r_z and V = r_y / r_z are x - z d_x / d_z and
// y - z d_y / d_z, so that z = (o - n_x U - n_y V) d_z / H and x, y follow.
std::array<Ball, 3> LightPositions::position(const Corner<Vertex>& corner) const {
  const Vertex& vertex = corner.vertex;
  std::array<Ball, 3> point;
  if (vertex.source != kMadeVertex) {
    const ScenePlanes::Vertex input = scene().input_vertex(vertex.source);
    for (int k = 0; k < 3; ++k) {
      point[k] = Ball(input.x[k], input.error * input.x[k] + Ball::kTiny);
    }
    return point;
  }
  const std::array<Ball, 4> plane = scene().plane_enclosure(corner.support);
  const std::array<Ball, 3>& l = frame_->light;
  std::array<Ball, 3> r;
  for (int k = 0; k < 3; ++k) r[k] = Ball(vertex.ray[k], static_cast<double>(vertex.bound));
  Ball height = plane[0] * l[0] + plane[1] * l[1] + plane[2] * l[2];
  if (is_far()) {
    // As far_point().
    const auto [x, y, z] = integers().axes;
    const Ball nearness(frame_->nearness);
    height = height - nearness * plane[3];
    const Ball g = (plane[3] * r[2] - plane[x] * r[0] - plane[y] * r[1]) / height;
    const Ball t = r[2] + nearness * g;
    point[x] = (r[0] + g * l[x]) / t;
    point[y] = (r[1] + g * l[y]) / t;
    point[z] = g * l[z] / t;
    return point;
  }
  if (!is_directional()) {
    height = height - plane[3];
    const Ball s = height / (plane[0] * r[0] + plane[1] * r[1] + plane[2] * r[2]);
    for (int k = 0; k < 3; ++k) point[k] = l[k] - s * r[k];
    return point;
  }
  const auto [x, y, z] = integers().axes;
  // q_x / q_z = (x d_z - z d_x) / d_z is in grid units; the stretch of z makes it units of 2^b.
  const Ball u = r[0] / r[2], v = r[1] / r[2];
  point[z] = (plane[3] - plane[x] * u - plane[y] * v) * l[z] / height;
  point[x] = u + point[z] * l[x] / l[z];
  point[y] = v + point[z] * l[y] / l[z];
  return point;
}

std::array<mpq_class, 3> LightPositions::exact_position(const Corner<Vertex>& corner) const {
  std::array<mpq_class, 3> point = exact_grid_position(corner);
  for (int k = 0; k < 3; ++k) point[k] = geometry().origin[k] + geometry().step * point[k];
  return point;
}

// The formulas of position().
std::array<mpq_class, 3> LightPositions::exact_grid_position(const Corner<Vertex>& corner) const {
  std::array<mpq_class, 3> point;
  if (corner.vertex.source != kMadeVertex) {
    for (int k = 0; k < 3; ++k) point[k] = geometry().grid.at(corner.vertex.source, k);
    return point;
  }
  const Vector3<mpz_class> r = exact_ray<mpz_class, mpz_class>(corner);
  const ExactPlane<mpz_class> plane = ExactGeometry<mpz_class>(geometry()).plane(corner.support);
  const Vector3<mpz_class>& l = integers().light.grid;
  if (!is_directional()) {
    const mpz_class height = dot(plane.n, l) - plane.d;
    mpq_class s(height, dot(plane.n, r));
    s.canonicalize();
    for (int k = 0; k < 3; ++k) point[k] = l[k] - s * r[k];
    return point;
  }
  const auto [x, y, z] = integers().axes;
  mpq_class u(r[0], r[2]), v(r[1], r[2]);
  u.canonicalize();
  v.canonicalize();
  const mpz_class height = dot(plane.n, l);
  point[z] = (plane.d - plane.n[x] * u - plane.n[y] * v) * l[z] / height;
  point[x] = u + point[z] * l[x] / l[z];
  point[y] = v + point[z] * l[y] / l[z];
  return point;
}

// Whether coordinate `axis` of a made corner is exactly 0, which no bound can tell: much of a scene
// stands on z = 0. A point light's L - h r / (n . r) is G if (L - G) (n . r) = h r.
bool LightPositions::is_zero(const Corner<Vertex>& corner, int axis) const {
  const std::optional<std::int64_t> zero = frame_->zero[axis];
  if (!zero || !is_narrow_corner(corner) || is_directional()) return false;
  const unsigned b = std::max(geometry().grid.bits(), integers().q_bits);
  const unsigned bits = plane_bits(corner.before) + plane_bits(corner.after) + 2;
  bool result = false;
  const auto test = [&]<class Factor, class Int>() {
    if constexpr (!std::is_same_v<Int, mpz_class>) {
      const ExactGeometry<std::int64_t> exact(geometry());
      const Vector3<Factor> n = exact.normal<Factor>(corner.support);
      const Vector3<std::int64_t> a = exact.position(geometry().planes[corner.support].a);
      const Vector3<std::int64_t> l = integers().position<std::int64_t>();
      const auto r = exact_ray<Factor, Int>(corner);
      const Int left = multiply<Int>(l[axis] - *zero, dot<Int>(n, r));
      const Int right = multiply<Int>(dot<Int>(n, difference(l, a)), r[axis]);
      result = sign_of(Int(left - right)) == Sign::kZero;
    }
  };
  with_widths(narrowest_width(bits + 3 * b + 6), factor_bits(corner), test);
  return result;
}

// The formula of position() for a point light, in pairs of doubles.
template <class Factor, class Int>
LightPositions::PairPoint LightPositions::pair_point(const Corner<Vertex>& corner) const {
  using Position = PositionFor<Int>;
  const ExactGeometry<Position> exact(geometry());
  const Vector3<Factor> n = exact.template normal<Factor>(corner.support);
  const Vector3<Position> a = exact.position(geometry().planes[corner.support].a);
  const Vector3<Position> l = integers().position<Position>();
  const auto r = exact_ray<Factor, Int>(corner);
  const DoubleDouble s =
      double_double(dot<Int>(n, difference(l, a))) / double_double(dot<Int>(n, r));
  PairPoint point;
  for (int k = 0; k < 3; ++k) {
    const DoubleDouble at = double_double(l[k]), step = s * double_double(r[k]);
    point.x[k] = at - step;
    point.terms[k] = std::fabs(at.high) + std::fabs(step.high);
  }
  return point;
}

// The same for a directional light.
template <class Factor, class Int>
LightPositions::PairPoint LightPositions::pair_point_along(const Corner<Vertex>& corner) const {
  using Position = PositionFor<Int>;
  const ExactGeometry<Position> exact(geometry());
  const Vector3<Factor> n = exact.template normal<Factor>(corner.support);
  const Vector3<Position> a = exact.position(geometry().planes[corner.support].a);
  const Vector3<Position> l = integers().position<Position>();
  const auto r = exact_ray<Factor, Int>(corner);
  const auto [x, y, z] = integers().axes;
  const DoubleDouble u = double_double(r[0]) / double_double(r[2]);
  const DoubleDouble v = double_double(r[1]) / double_double(r[2]);
  const DoubleDouble dz = double_double(l[z]), scale = dz / double_double(dot<Int>(n, l));
  const DoubleDouble d = double_double(dot<Int>(n, a));
  const DoubleDouble nu = double_double(n[x]) * u, nv = double_double(n[y]) * v;
  const DoubleDouble dx = double_double(l[x]) / dz, dy = double_double(l[y]) / dz;
  PairPoint point;
  point.x[z] = (d - nu - nv) * scale;
  point.terms[z] =
      (std::fabs(d.high) + std::fabs(nu.high) + std::fabs(nv.high)) * std::fabs(scale.high);
  point.x[x] = u + point.x[z] * dx;
  point.terms[x] = std::fabs(u.high) + point.terms[z] * std::fabs(dx.high);
  point.x[y] = v + point.x[z] * dy;
  point.terms[y] = std::fabs(v.high) + point.terms[z] * std::fabs(dy.high);
  return point;
}

std::optional<std::array<double, 3>> LightPositions::nearest_position(
    const Corner<Vertex>& corner) const {
  if (corner.vertex.source != kMadeVertex) return geometry().positions[corner.vertex.source];
  // Of a direction or a position, and of a normal.
  const unsigned longest = std::max(2 * geometry().grid.bits() + 1, integers().light_bits + 1);
  PairPoint point;
  with_widths(width_of(is_narrow_corner(corner), ray_bits(corner) + longest + 3 + 2 * far_bits()),
              factor_bits(corner), [&]<class Factor, class Int>() {
                point = is_far()           ? pair_far_point<Factor, Int>(corner)
                        : is_directional() ? pair_point_along<Factor, Int>(corner)
                                           : pair_point<Factor, Int>(corner);
              });
  std::array<double, 3> result;
  for (int k = 0; k < 3; ++k) {
    const DoubleDouble& origin = frame_->origin[k];
    const DoubleDouble offset = point.x[k] * frame_->step;
    const double most = point.terms[k] * std::fabs(frame_->step.high) + std::fabs(origin.high);
    const std::optional<double> nearest =
        gnomon::nearest_double(origin + offset, kPairError * most);
    if (nearest) {
      result[k] = *nearest;
    } else if (is_zero(corner, k)) {
      result[k] = 0;
    } else {
      return std::nullopt;
    }
  }
  return result;
}

}  // namespace gnomon
