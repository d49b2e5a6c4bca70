// SPDX-License-Identifier: LGPL-3.0-or-later
#include "kernel/implicit/implicit_volume_space.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <limits>
#include <utility>

#include "kernel/signs/fp_environment.h"
#include "kernel/signs/nearest_double.h"

namespace gnomon {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Doubles of a made vertex that are off by more are computed again from the integers.
constexpr double kWorstError = 0x1p-40;
/// Of normals in doubles; below, offsets are computed from the integers.
constexpr double kLeastDeterminant = 0x1p-6;

double largest(const std::array<double, 3>& v) {
  return std::max({std::fabs(v[0]), std::fabs(v[1]), std::fabs(v[2])});
}
double dot(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
std::array<double, 3> cross(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// 2^-k with magnitude * 2^-k in [1/2, 1). Requires: magnitude is in [1, 2^1000).
double normalizer(double magnitude) {
  const std::uint64_t biased = std::bit_cast<std::uint64_t>(magnitude) >> 52;
  return std::bit_cast<double>((std::uint64_t{2045} - biased) << 52);
}

unsigned bits_of(const mpz_class& value) {
  return sgn(value) == 0 ? 0 : static_cast<unsigned>(mpz_sizeinbase(value.get_mpz_t(), 2));
}
unsigned bits_of(const Vector3<mpz_class>& v) {
  return std::max({bits_of(v[0]), bits_of(v[1]), bits_of(v[2])});
}
unsigned bits_of(Int128 value) {
  const UInt128 magnitude = static_cast<UInt128>(value < 0 ? -value : value);
  const auto high = static_cast<std::uint64_t>(magnitude >> 64);
  return static_cast<unsigned>(high != 0 ? 64 + std::bit_width(high)
                                         : std::bit_width(static_cast<std::uint64_t>(magnitude)));
}
unsigned bits_of(const Vector3<Int128>& v) {
  return std::max({bits_of(v[0]), bits_of(v[1]), bits_of(v[2])});
}
template <class Int>
bool is_zero(const Vector3<Int>& v) {
  return v[0] == 0 && v[1] == 0 && v[2] == 0;
}
bool is_zero(const Vector3<mpz_class>& v) {
  return sgn(v[0]) == 0 && sgn(v[1]) == 0 && sgn(v[2]) == 0;
}

Vector3<mpz_class> grid_position(const Geometry& geometry, VertexId v) {
  return ExactGeometry<mpz_class>(geometry).position(v);
}

/// Off by at most u of itself, 2u beyond 128 bits. Requires: at most 1000 bits.
double to_double(std::int64_t value) { return static_cast<double>(value); }
double to_double(Int128 value) { return static_cast<double>(value); }
template <std::size_t Limbs>
double to_double(const WideInteger<Limbs>& value) {
  return to_double_scaled(value, 0);
}
template <class Int>
double largest_double(const Vector3<Int>& n) {
  return largest(std::array<double, 3>{to_double(n[0]), to_double(n[1]), to_double(n[2])});
}

}  // namespace

template <class Stats>
ImplicitVolumeSpace<Stats>::ImplicitVolumeSpace(const SceneSpace& scene, const KernelOptions&) {
  auto made = std::make_shared<Shared>();
  Shared& shared = *made;
  const Geometry& geometry = scene.geometry();
  shared.geometry = &geometry;
  shared.plane_count = static_cast<std::uint32_t>(geometry.planes.size());
  shared.edge_count = static_cast<std::uint32_t>(geometry.edges.size());
  shared.b = geometry.grid.bits();
  shared.narrow = geometry.grid.is_narrow();
  shared.fixed = shared.b <= kNarrowBits;
  if (shared.fixed) shared.grid_scale = std::ldexp(1.0, -static_cast<int>(shared.b));
  if (shared.fixed && !shared.narrow) {
    shared.positions.reserve(geometry.positions.size());
    for (VertexId v = 0; v < geometry.grid.size(); ++v) {
      shared.positions.push_back({integer_from<Int128>(geometry.grid.wide(v, 0)),
                                  integer_from<Int128>(geometry.grid.wide(v, 1)),
                                  integer_from<Int128>(geometry.grid.wide(v, 2))});
    }
  }
  for (int k = 0; k < 3; ++k) shared.origin[k] = double_double(geometry.origin[k]);
  shared.step = double_double(geometry.step);
  shared.supports.resize(geometry.planes.size());
  tbb::parallel_for(std::size_t{0}, shared.supports.size(), [&](std::size_t id) {
    const SupportTriple& triple = geometry.planes[id];
    plane_through(shared, {triple.a, triple.b, triple.c}, shared.supports[id]);
  });
  shared_ = std::move(made);
}

template <class Stats>
ImplicitVolumeSpace<Stats> ImplicitVolumeSpace<Stats>::fork() const {
  ImplicitVolumeSpace result = *this;
  result.stats_ = {};
  return result;
}

template <class Stats>
template <class Position>
Vector3<Position> ImplicitVolumeSpace<Stats>::position_of(const Shared& shared, VertexId v) {
  if constexpr (std::is_same_v<Position, std::int64_t>) {
    const std::int64_t* at = shared.geometry->grid.narrow_point(v);
    return {at[0], at[1], at[2]};
  } else if constexpr (std::is_same_v<Position, Int128>) {
    return shared.positions[v];
  } else {
    return grid_position(*shared.geometry, v);
  }
}

template <class Stats>
template <class Int, class F>
auto ImplicitVolumeSpace<Stats>::with_position(const Shared& shared, const F& f) {
  if constexpr (std::is_same_v<Int, mpz_class>) {
    return f.template operator()<mpz_class>();
  } else if constexpr (std::is_same_v<Int, std::int64_t>) {
    return f.template operator()<std::int64_t>();
  } else {
    return shared.narrow ? f.template operator()<std::int64_t>() : f.template operator()<Int128>();
  }
}

/// Each off by at most u of itself (2u on wide grids: GMP truncates).
template <class Stats>
std::array<double, 3> ImplicitVolumeSpace<Stats>::input_point(const Shared& shared, VertexId v) {
  const auto scaled = [&](const auto& at) -> std::array<double, 3> {
    return {to_double(at[0]) * shared.grid_scale, to_double(at[1]) * shared.grid_scale,
            to_double(at[2]) * shared.grid_scale};
  };
  if (shared.narrow) return scaled(shared.geometry->grid.narrow_point(v));
  if (shared.fixed) return scaled(shared.positions[v]);
  std::array<double, 3> x;
  for (int k = 0; k < 3; ++k) x[k] = to_double_scaled(shared.geometry->grid.wide(v, k), shared.b);
  return x;
}

template <class Stats>
typename ImplicitVolumeSpace<Stats>::Vertex ImplicitVolumeSpace<Stats>::input_vertex(
    VertexId v) const {
  Vertex vertex;
  vertex.x = input_point(*shared_, v);
  vertex.bound = rounded_up(vertex_bound(shared_->b <= 53 ? 0 : 2 * kUnit, 1));
  vertex.source = v;
  return vertex;
}

// The normal is exact before it is rounded once; d is computed from it in doubles: n . a with
// factors off by 2u each and roundings of 8u, 20u in all.
template <class Stats>
bool ImplicitVolumeSpace<Stats>::plane_through(const Shared& shared,
                                               const std::array<VertexId, 3>& vertices,
                                               Plane& plane) {
  plane.source = vertices;
  const auto set_normal = [&]<class Int, class Position>() {
    const Vector3<Position> a = position_of<Position>(shared, vertices[0]);
    const Vector3<Int> n =
        gnomon::cross<Int>(difference(position_of<Position>(shared, vertices[1]), a),
                           difference(position_of<Position>(shared, vertices[2]), a));
    plane.n = {to_double(n[0]), to_double(n[1]), to_double(n[2])};
  };
  if (shared.b <= 31) {
    set_normal.template operator()<std::int64_t, std::int64_t>();
  } else if (shared.narrow) {
    set_normal.template operator()<Int128, std::int64_t>();
  } else if (shared.fixed) {
    set_normal.template operator()<WideInteger<4>, Int128>();
  } else {
    const Vector3<mpz_class> a = grid_position(*shared.geometry, vertices[0]),
                             b = grid_position(*shared.geometry, vertices[1]),
                             c = grid_position(*shared.geometry, vertices[2]);
    const Vector3<mpz_class> n = gnomon::cross(difference(b, a), difference(c, a));
    const unsigned bits = bits_of(n);
    for (int k = 0; k < 3; ++k) plane.n[k] = to_double_scaled(n[k], bits);
    plane.d = dot(plane.n, input_point(shared, vertices[0]));
    return bits != 0;
  }
  const double magnitude = largest(plane.n);
  if (magnitude == 0) return false;
  const double scale = normalizer(magnitude);
  for (double& x : plane.n) x *= scale;
  plane.d = dot(plane.n, input_point(shared, vertices[0]));
  return true;
}

template <class Stats>
PlaneRef ImplicitVolumeSpace<Stats>::add_plane(const Corner<Vertex>& a, const Corner<Vertex>& b,
                                               const Corner<Vertex>& c) {
  const std::array<const Corner<Vertex>*, 3> corners = {&a, &b, &c};
  int made = 0, last_made = 0, last_input = 0;
  for (int i = 0; i < 3; ++i) {
    if (corners[i]->vertex.source == kMadeVertex) {
      ++made;
      last_made = i;
    } else {
      last_input = i;
    }
  }
  if (made == 0) return add_through({a.vertex.source, b.vertex.source, c.vertex.source});
  if (shared_->narrow && made == 1) {
    const auto added =
        add_through_made(corners[(last_made + 1) % 3]->vertex.source,
                         corners[(last_made + 2) % 3]->vertex.source, *corners[last_made]);
    if (added) return *added;
  }
  if (shared_->narrow && made == 2) {
    const auto added = add_through_edge(*corners[last_input], *corners[(last_input + 1) % 3],
                                        *corners[(last_input + 2) % 3]);
    if (added) return *added;
  }
  // With points X / w and w > 0: (w_a X_b - w_b X_a) x (w_a X_c - w_c X_a) is a positive multiple
  // of the normal, and d = n . X_a / w_a.
  const Homogeneous<mpz_class> p = homogeneous(a), q = homogeneous(b), r = homogeneous(c);
  Vector3<mpz_class> u, v;
  for (int k = 0; k < 3; ++k) {
    u[k] = p.w * q.x[k] - q.w * p.x[k];
    v[k] = p.w * r.x[k] - r.w * p.x[k];
  }
  ExactPlane<mpz_class> plane{gnomon::cross(u, v), {}};
  plane.d = gnomon::dot(plane.n, p.x);
  for (mpz_class& x : plane.n) x *= p.w;
  return add_explicit(std::move(plane));
}

// A made corner on an input edge that starts at one of the vertices lies on the way to the other
// end. Otherwise, with the corner X / w: (q - p) x (X - w p).
template <class Stats>
std::optional<PlaneRef> ImplicitVolumeSpace<Stats>::add_through_made(VertexId p, VertexId q,
                                                                     const Corner<Vertex>& made) {
  for (const PlaneRef ref : {made.before, made.after}) {
    if (!is_input_edge(ref)) continue;
    const EdgeEnds ends = ends_of(ref);
    for (const auto [near, far] : {std::array{ends.a, ends.b}, std::array{ends.b, ends.a}}) {
      if (near == p || near == q) return add_through({p, q, far});
    }
  }
  const unsigned b = shared_->b;
  const PointMemo& memo = made_point(made);
  if (memo.bits + b + 2 > kNarrowBits) return std::nullopt;
  const ExactGeometry<std::int64_t> exact(*shared_->geometry);
  const Vector3<std::int64_t> origin = exact.position(p), u = difference(exact.position(q), origin);
  Vector3<Int128> v;
  for (int k = 0; k < 3; ++k) v[k] = memo.narrow.x[k] - memo.narrow.w * origin[k];
  // n below 2^(b + 1) times v, and n . p below 3 2^b times that.
  if (bits_of(v) + 2 * b + 4 > kNarrowBits) return std::nullopt;
  ExactPlane<Int128> plane{gnomon::cross<Int128>(u, v), {}};
  plane.d = gnomon::dot<Int128>(plane.n, origin);
  return add_narrow(plane);
}

// The edge is an input edge, or the line in which two planes A and B meet; the plane through p and
// that line is A(p) B - B(p) A or its opposite. Which one, doubles tell: those of differences of
// points off by e are off by 2 e and u, of their cross products by 4.1 times that and 3u, and of
// the product with the normal by 13 times that and 20u.
template <class Stats>
std::optional<PlaneRef> ImplicitVolumeSpace<Stats>::add_through_edge(const Corner<Vertex>& p,
                                                                     const Corner<Vertex>& q,
                                                                     const Corner<Vertex>& r) {
  PlaneRef edge;
  for (const PlaneRef ref : {q.before, q.after}) {
    if (ref.same_plane(r.before) || ref.same_plane(r.after)) edge = ref;
  }
  if (!edge.valid() || q.support != r.support) return std::nullopt;
  const VertexId v = p.vertex.source;
  PlaneRef added;
  if (is_input_edge(edge)) {
    const EdgeEnds ends = ends_of(edge);
    added = add_through({v, ends.a, ends.b});
  } else {
    const Plane& first = plane_at(q.support);
    const Plane& second = plane_at(edge.index());
    if (first.is_explicit() || second.is_explicit() ||
        volume_value_bits(cut_once_normal_bits(shared_->b), shared_->b) > kNarrowBits) {
      return std::nullopt;
    }
    const Vector3<Int128> m = exact_normal<Int128>(first), n = exact_normal<Int128>(second);
    const Int128 at_first = exact_value<Int128>(first, m, v),
                 at_second = exact_value<Int128>(second, n, v);
    ExactPlane<Int128> plane;
    for (int k = 0; k < 3; ++k) plane.n[k] = at_first * n[k] - at_second * m[k];
    const ExactGeometry<std::int64_t> exact(*shared_->geometry);
    plane.d = gnomon::dot<Int128>(plane.n, exact.position(v));
    added = add_narrow(plane);
  }
  if (!added.valid()) return added;
  std::array<double, 3> to_q, to_r;
  for (int k = 0; k < 3; ++k) {
    to_q[k] = q.vertex.x[k] - p.vertex.x[k];
    to_r[k] = r.vertex.x[k] - p.vertex.x[k];
  }
  const double turn = dot(own_.back().n, cross(to_q, to_r));
  const double error = error_of(p.vertex) + error_of(q.vertex) + error_of(r.vertex);
  if (std::fabs(turn) > 64 * (error + kUnit)) return turn > 0 ? added : -added;
  release_planes(plane_mark() - 1);
  return std::nullopt;
}

template <class Stats>
PlaneRef ImplicitVolumeSpace<Stats>::add_plane(const Corner<Vertex>& a, const Corner<Vertex>& b,
                                               const LightPoint& light) {
  if (shared_->narrow && light.directional && a.vertex.source != kMadeVertex &&
      b.vertex.source != kMadeVertex && bits_of(light.grid) <= 62 &&
      bits_of(light.grid) + 2 * shared_->b + 4 <= kNarrowBits) {
    const ExactGeometry<std::int64_t> exact(*shared_->geometry);
    const Vector3<std::int64_t> origin = exact.position(a.vertex.source),
                                direction = {light.grid[0].get_si(), light.grid[1].get_si(),
                                             light.grid[2].get_si()};
    ExactPlane<Int128> plane{
        gnomon::cross<Int128>(difference(exact.position(b.vertex.source), origin), direction), {}};
    plane.d = gnomon::dot<Int128>(plane.n, origin);
    return add_narrow(plane);
  }
  const Homogeneous<mpz_class> p = homogeneous(a), q = homogeneous(b);
  Vector3<mpz_class> u, v;
  for (int k = 0; k < 3; ++k) {
    u[k] = p.w * q.x[k] - q.w * p.x[k];
    v[k] = light.directional ? light.grid[k] : mpz_class(p.w * light.grid[k] - p.x[k]);
  }
  ExactPlane<mpz_class> plane{gnomon::cross(u, v), {}};
  plane.d = gnomon::dot(plane.n, p.x);
  for (mpz_class& x : plane.n) x *= p.w;
  return add_explicit(std::move(plane));
}

// value 2^b = m 2^e with an integer m below 2^53.
template <class Stats>
PlaneRef ImplicitVolumeSpace<Stats>::add_axis_plane(int axis, double value) {
  assert(value >= 0 && value <= 1);
  int exponent = 0;
  const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(value, &exponent), 53));
  exponent += static_cast<int>(shared_->b) - 53;
  const auto k = static_cast<std::size_t>(axis);
  if (shared_->fixed && exponent > -static_cast<int>(kNarrowBits)) {
    ExactPlane<Int128> plane{};
    plane.n[k] = Int128{1} << std::max(0, -exponent);
    plane.d = Int128{mantissa} << std::max(0, exponent);
    return add_narrow(plane);
  }
  ExactPlane<mpz_class> plane;
  plane.n[k] = mpz_class(1) << static_cast<unsigned>(std::max(0, -exponent));
  plane.d = integer_from<mpz_class>(mantissa) << static_cast<unsigned>(std::max(0, exponent));
  return add_explicit(std::move(plane));
}

template <class Stats>
PlaneRef ImplicitVolumeSpace<Stats>::add_narrow(const ExactPlane<Int128>& exact) {
  if (is_zero(exact.n)) return {};
  Plane plane;
  for (int k = 0; k < 3; ++k) plane.n[k] = to_double(exact.n[k]);
  const double scale = normalizer(largest(plane.n));
  for (double& x : plane.n) x *= scale;
  plane.d = to_double(exact.d) * scale * shared_->grid_scale;
  plane.source = {static_cast<std::uint32_t>(explicit_.size()), kExplicit, kExplicit};
  explicit_.push_back({exact, kNotWide, bits_of(exact.n), static_cast<std::uint32_t>(own_.size())});
  own_.push_back(plane);
  return last_plane();
}

template <class Stats>
PlaneRef ImplicitVolumeSpace<Stats>::add_explicit(ExactPlane<mpz_class> exact) {
  if (is_zero(exact.n)) return {};
  mpz_class divisor = exact.d;
  for (const mpz_class& x : exact.n) divisor = gcd(divisor, x);
  if (divisor > 1) {
    for (mpz_class& x : exact.n) mpz_divexact(x.get_mpz_t(), x.get_mpz_t(), divisor.get_mpz_t());
    mpz_divexact(exact.d.get_mpz_t(), exact.d.get_mpz_t(), divisor.get_mpz_t());
  }
  const unsigned bits = bits_of(exact.n);
  if (shared_->fixed && std::max(bits, bits_of(exact.d)) <= kNarrowBits) {
    ExactPlane<Int128> plane;
    for (int k = 0; k < 3; ++k) plane.n[k] = integer_from<Int128>(exact.n[k]);
    plane.d = integer_from<Int128>(exact.d);
    return add_narrow(plane);
  }
  Plane plane;
  for (int k = 0; k < 3; ++k) plane.n[k] = to_double_scaled(exact.n[k], bits);
  plane.d = to_double_scaled(exact.d, long{bits} + shared_->b);
  plane.source = {static_cast<std::uint32_t>(explicit_.size()), kExplicit, kExplicit};
  explicit_.push_back({{},
                       static_cast<std::uint32_t>(wide_.size()),
                       bits,
                       static_cast<std::uint32_t>(own_.size())});
  wide_.push_back(std::move(exact));
  own_.push_back(plane);
  return last_plane();
}

template <class Stats>
typename ImplicitVolumeSpace<Stats>::template Homogeneous<mpz_class>
ImplicitVolumeSpace<Stats>::homogeneous(const Corner<Vertex>& corner) {
  if (corner.vertex.source != kMadeVertex) {
    return {grid_position(*shared_->geometry, corner.vertex.source), 1};
  }
  return made_point(corner).point;
}

template <class Stats>
const typename ImplicitVolumeSpace<Stats>::PointMemo& ImplicitVolumeSpace<Stats>::made_point(
    const Corner<Vertex>& corner) {
  const std::array<std::uint32_t, 3> key = {corner.support, corner.before.index(),
                                            corner.after.index()};
  if (points_.empty()) points_.resize(kPointMemos);
  PointMemo& memo = points_[(key[0] * 31u + key[1] * 7u + key[2]) % kPointMemos];
  if (memo.key == key) return memo;
  Homogeneous<mpz_class>& point = memo.point;
  with_exact_point(corner, true, some_pivot(corner), [&]<class Int>(const ExactPoint<Int>& exact) {
    if constexpr (std::is_same_v<Int, mpz_class>) {
      const Vector3<mpz_class> origin = grid_position(*shared_->geometry, exact.origin);
      point.w = exact.w;
      for (int k = 0; k < 3; ++k) point.x[k] = origin[k] * exact.w + exact.x[k];
    }
  });
  mpz_class divisor = point.w;
  for (const mpz_class& x : point.x) divisor = gcd(divisor, x);
  if (sgn(point.w) < 0) divisor = -divisor;
  for (mpz_class& x : point.x) mpz_divexact(x.get_mpz_t(), x.get_mpz_t(), divisor.get_mpz_t());
  mpz_divexact(point.w.get_mpz_t(), point.w.get_mpz_t(), divisor.get_mpz_t());
  memo.bits = std::max(bits_of(point.x), bits_of(point.w));
  if (memo.bits <= kNarrowBits) {
    for (int k = 0; k < 3; ++k) memo.narrow.x[k] = integer_from<Int128>(point.x[k]);
    memo.narrow.w = integer_from<Int128>(point.w);
  }
  // Planes added here may go, and their numbers with them.
  const std::uint32_t lasting = shared_->plane_count + shared_->edge_count;
  memo.key = key;
  if (std::max({key[0], key[1], key[2]}) >= lasting) memo.key[0] = kMadeVertex;
  return memo;
}

// --- Integers. ---

template <class Stats>
template <class Factor>
Vector3<Factor> ImplicitVolumeSpace<Stats>::exact_normal(const Plane& plane) const {
  if (plane.is_explicit()) {
    const auto convert = [](const auto& n) -> Vector3<Factor> {
      return {integer_from<Factor>(n[0]), integer_from<Factor>(n[1]), integer_from<Factor>(n[2])};
    };
    const Explicit& exact = explicit_[plane.source[0]];
    return exact.is_wide() ? convert(wide_[exact.wide].n) : convert(exact.plane.n);
  }
  return with_position<Factor>(*shared_, [&]<class Position>() {
    const Vector3<Position> a = position_of<Position>(*shared_, plane.source[0]);
    return gnomon::cross<Factor>(difference(position_of<Position>(*shared_, plane.source[1]), a),
                                 difference(position_of<Position>(*shared_, plane.source[2]), a));
  });
}

template <class Stats>
template <class Value, class Factor>
Value ImplicitVolumeSpace<Stats>::exact_value(const Plane& plane, const Vector3<Factor>& normal,
                                              VertexId v) const {
  return with_position<Factor>(*shared_, [&]<class Position>() -> Value {
    const Vector3<Position> x = position_of<Position>(*shared_, v);
    if (!plane.is_explicit()) {
      return gnomon::dot<Value>(normal,
                                difference(x, position_of<Position>(*shared_, plane.source[0])));
    }
    const Explicit& given = explicit_[plane.source[0]];
    const Value d = given.is_wide() ? integer_from<Value>(wide_[given.wide].d)
                                    : integer_from<Value>(given.plane.d);
    return Value(gnomon::dot<Value>(normal, x) - d);
  });
}

template <class Stats>
template <class Predicate>
Sign ImplicitVolumeSpace<Stats>::decide(unsigned factor_bits, unsigned width_bits,
                                        const Predicate& predicate) {
  const IntegerWidth width =
      shared_->fixed ? narrowest_width(width_bits) : IntegerWidth::kUnbounded;
  stats_.count(exact_stage(width));
  const Sign sign = with_widths(width, std::max(factor_bits, shared_->b), predicate);
  if (sign == Sign::kZero) stats_.count_zero();
  return sign;
}

template <class Stats>
Side ImplicitVolumeSpace<Stats>::undecided_side(PlaneRef ref, const Corner<Vertex>& corner) {
  const std::uint32_t index = ref.index();
  const auto identity = [&] {
    stats_.count(Stage::kIdentity);
    return Side::kOn;
  };
  if (index == corner.before.index() || index == corner.after.index() || index == corner.support) {
    return identity();
  }
  const Plane& plane = plane_at(index);
  if (!plane.is_explicit()) {
    if (corner.vertex.source != kMadeVertex) {
      if (plane.has(corner.vertex.source)) return identity();
    } else {
      // Which of the three vertices that define the plane define each of the corner's.
      const auto shared_with = [&](PlaneRef other) {
        const auto mask = [&](const auto& has) {
          return unsigned{has(plane.source[0])} | unsigned{has(plane.source[1])} << 1 |
                 unsigned{has(plane.source[2])} << 2;
        };
        if (is_input_edge(other)) {
          const EdgeEnds ends = ends_of(other);
          return mask([&](VertexId v) { return v == ends.a || v == ends.b; });
        }
        const Plane& meeting = plane_at(other.index());
        if (meeting.is_explicit()) return 0u;
        return mask([&](VertexId v) { return meeting.has(v); });
      };
      const unsigned before = shared_with(corner.before), after = shared_with(corner.after),
                     support = shared_with(PlaneRef(corner.support));
      const bool on_edge = (is_input_edge(corner.before) && std::popcount(before) == 2) ||
                           (is_input_edge(corner.after) && std::popcount(after) == 2);
      // All three: it is the same plane once more.
      const bool same = before == 7 || after == 7 || support == 7;
      if (same || on_edge || std::popcount(before & after) == 2 ||
          std::popcount(before & support) == 2 || std::popcount(after & support) == 2) {
        return identity();
      }
    }
  }
  const Sign sign = exact_side(plane, corner);
  return side_of(ref.flipped() ? -sign : sign);
}

template <class Stats>
Sign ImplicitVolumeSpace<Stats>::exact_side_of_input(const Plane& plane, VertexId v) {
  return decide(normal_bits(plane), value_bits(plane) + 1, [&]<class Factor, class Int>() {
    return sign_of(exact_value<Int>(plane, exact_normal<Factor>(plane), v));
  });
}

template <class Stats>
Sign ImplicitVolumeSpace<Stats>::exact_side(const Plane& plane, const Corner<Vertex>& corner) {
  if (corner.vertex.source != kMadeVertex) return exact_side_of_input(plane, corner.vertex.source);
  const bool before_is_edge = is_input_edge(corner.before);
  if (before_is_edge || is_input_edge(corner.after)) {
    const EdgeEnds ends = ends_of(before_is_edge ? corner.before : corner.after);
    const Plane& cut = plane_at((before_is_edge ? corner.after : corner.before).index());
    // With values P of the cut and Q at the ends u, v: the point is (P(v) u - P(u) v) over
    // P(v) - P(u), so that Q there is (P(v) Q(u) - P(u) Q(v)) over the same.
    return decide(
        std::max(normal_bits(plane), normal_bits(cut)),
        volume_edge_bits(value_bits(plane), value_bits(cut)), [&]<class Factor, class Int>() {
          using Value = Product<Int, Factor, Factor>;
          const Vector3<Factor> p = exact_normal<Factor>(cut), q = exact_normal<Factor>(plane);
          const Value p_u = exact_value<Value>(cut, p, ends.a),
                      p_v = exact_value<Value>(cut, p, ends.b),
                      q_u = exact_value<Value>(plane, q, ends.a),
                      q_v = exact_value<Value>(plane, q, ends.b);
          return sign_of(Int(multiply<Int>(p_v, q_u) - multiply<Int>(p_u, q_v))) *
                 sign_of(Value(p_v - p_u));
        });
  }
  Meet meet = meet_of(corner);
  // The values at a vertex that defines many of the planes are zero.
  int most = -1;
  const auto consider = [&](const Plane& candidate) {
    if (candidate.is_explicit()) return;
    for (const VertexId v : candidate.source) {
      int count = !plane.is_explicit() && plane.has(v) ? 1 : 0;
      for (const Plane* other : meet.planes) {
        count += !other->is_explicit() && other->has(v) ? 1 : 0;
      }
      if (count > most) {
        most = count;
        meet.pivot = v;
      }
    }
  };
  consider(plane);
  consider(*meet.planes[1]);
  consider(*meet.planes[2]);
  if (most < 2) consider(*meet.planes[0]);
  unsigned normals = normal_bits(plane), factor_bits = normals, rest = value_bits(plane) - normals;
  for (const Plane* other : meet.planes) {
    const unsigned n = normal_bits(*other);
    normals += n;
    factor_bits = std::max(factor_bits, n);
    rest = std::max(rest, value_bits(*other) - n);
  }
  return decide(factor_bits, volume_meet_bits(normals + rest),
                [&]<class Factor, class Int>() { return side_of_meet<Factor, Int>(plane, meet); });
}

template <class Stats>
template <class Factor, class Int>
Sign ImplicitVolumeSpace<Stats>::side_of_meet(const Plane& plane, const Meet& meet) const {
  using Value = Product<Int, Factor, Factor>;
  std::array<Vector3<Factor>, 3> n;
  std::array<Value, 3> values;
  for (std::size_t i = 0; i < 3; ++i) {
    n[i] = exact_normal<Factor>(*meet.planes[i]);
    values[i] = exact_value<Value>(*meet.planes[i], n[i], meet.pivot);
  }
  const Vector3<Factor> t = exact_normal<Factor>(plane);
  return sign_at_meet<Int>(n, values, t, exact_value<Value>(plane, t, meet.pivot));
}

template <class Stats>
template <class F>
void ImplicitVolumeSpace<Stats>::with_exact_point(const Corner<Vertex>& corner, bool unbounded,
                                                  VertexId pivot, const F& f) const {
  const auto call = [&](unsigned factor_bits, unsigned width_bits, const auto& make) {
    const IntegerWidth width =
        shared_->fixed && !unbounded ? narrowest_width(width_bits) : IntegerWidth::kUnbounded;
    with_widths(width, std::max(factor_bits, shared_->b),
                [&]<class Factor, class Int>() { f(make.template operator()<Factor, Int>()); });
  };
  const bool before_is_edge = is_input_edge(corner.before);
  if (before_is_edge || is_input_edge(corner.after)) {
    // u + P(u) (v - u) / (P(u) - P(v)).
    const EdgeEnds ends = ends_of(before_is_edge ? corner.before : corner.after);
    const Plane& cut = plane_at((before_is_edge ? corner.after : corner.before).index());
    call(normal_bits(cut), value_bits(cut) + shared_->b + 1, [&]<class Factor, class Int>() {
      const Vector3<Factor> p = exact_normal<Factor>(cut);
      const Int at_u = exact_value<Int>(cut, p, ends.a), at_v = exact_value<Int>(cut, p, ends.b);
      ExactPoint<Int> point;
      point.origin = ends.a;
      point.w = at_u - at_v;
      with_position<Factor>(*shared_, [&]<class Position>() {
        const Vector3<Position> step = difference(position_of<Position>(*shared_, ends.b),
                                                  position_of<Position>(*shared_, ends.a));
        for (int k = 0; k < 3; ++k) point.x[k] = multiply<Int>(at_u, step[k]);
      });
      return point;
    });
    return;
  }
  Meet meet = meet_of(corner);
  meet.pivot = pivot;
  unsigned normals = 0, factor_bits = 0, rest = 0;
  for (const Plane* plane : meet.planes) {
    const unsigned n = normal_bits(*plane);
    normals += n;
    factor_bits = std::max(factor_bits, n);
    rest = std::max(rest, value_bits(*plane) - n);
  }
  // A value and a cross product of two: three terms of two products. The determinant has less.
  call(factor_bits, std::max(normals + rest, normals + 1) + 1 + 2 + 1,
       [&]<class Factor, class Int>() {
         using Value = Product<Int, Factor, Factor>;
         using Cross = Product<Int, Factor, Factor>;
         const std::array<Vector3<Factor>, 3> n = {exact_normal<Factor>(*meet.planes[0]),
                                                   exact_normal<Factor>(*meet.planes[1]),
                                                   exact_normal<Factor>(*meet.planes[2])};
         ExactPoint<Int> point;
         point.origin = meet.pivot;
         for (std::size_t i = 0; i < 3; ++i) {
           const Vector3<Cross> minors = gnomon::cross<Cross>(n[(i + 1) % 3], n[(i + 2) % 3]);
           const Value value = exact_value<Value>(*meet.planes[i], n[i], meet.pivot);
           for (std::size_t k = 0; k < 3; ++k) {
             point.x[k] = Int(point.x[k] - multiply<Int>(value, minors[k]));
           }
           if (i == 0) point.w = gnomon::dot<Int>(n[0], minors);
         }
         return point;
       });
}

// --- Points. ---

template <class Stats>
VertexId ImplicitVolumeSpace<Stats>::some_pivot(const Corner<Vertex>& corner) const {
  for (const PlaneRef ref : {PlaneRef(corner.support), corner.before, corner.after}) {
    if (is_input_edge(ref)) continue;
    const Plane& plane = plane_at(ref.index());
    if (!plane.is_explicit()) return plane.source[0];
  }
  return 0;
}

// Quotients of integers converted once, 2u each and u: x / w is off by 5u of itself, the origin by
// 2u, and both are in [-1, 1].
template <class Stats>
typename ImplicitVolumeSpace<Stats>::Vertex ImplicitVolumeSpace<Stats>::repaired(
    const Corner<Vertex>& corner) const {
  Vertex vertex;
  with_exact_point(corner, false, some_pivot(corner), [&]<class Int>(const ExactPoint<Int>& point) {
    vertex.x = input_point(*shared_, point.origin);
    long shift = 0;
    if constexpr (std::is_same_v<Int, mpz_class>) shift = long{bits_of(point.w)};
    const double w = to_double_scaled(point.w, shift);
    for (int k = 0; k < 3; ++k) {
      vertex.x[k] += to_double_scaled(point.x[k], shift + shared_->b) / w;
    }
  });
  const double magnitude = std::max(1.0, largest(vertex.x));
  vertex.bound = rounded_up(vertex_bound(16 * kUnit * magnitude, 1.01 * magnitude));
  return vertex;
}

template <class Stats>
typename ImplicitVolumeSpace<Stats>::Vertex ImplicitVolumeSpace<Stats>::crossing(
    PlaneRef ref, PlaneRef edge, bool, const Corner<Vertex>& from, const Corner<Vertex>&) const {
  const Plane& t = plane_at(ref.index());
  Vertex vertex;
  double error = kInfinity;
  if (is_input_edge(edge)) {
    // With values f and g of the ends, each off by v: the parameter f / (f - g) is off by at most
    // 1.7 v / |f - g| if that is more than 8 v.
    const EdgeEnds ends = ends_of(edge);
    const std::array<double, 3> u = input_point(*shared_, ends.a),
                                v = input_point(*shared_, ends.b);
    const double f = dot(t.n, u) - t.d, g = dot(t.n, v) - t.d, gap = std::fabs(f - g);
    const double value_error = vertex_bound(2 * kUnit, 1);
    if (gap > 8 * value_error) {
      const double parameter = f / (f - g);
      double span = 0;
      for (int k = 0; k < 3; ++k) {
        const double step = v[k] - u[k];
        vertex.x[k] = u[k] + parameter * step;
        span = std::max(span, std::fabs(step));
      }
      error = 1.01 * (span + 4 * kUnit) * (1.7 * value_error / gap + 4 * kUnit) + 8 * kUnit;
    }
  } else {
    // From any point x: with the residuals r_i of the planes there, the point where they meet is
    // x + (r_0 n_1 x n_2 + r_1 n_2 x n_0 + r_2 n_0 x n_1) / (n_0 . n_1 x n_2).
    const Plane& s = plane_at(from.support);
    const Plane& e = plane_at(edge.index());
    const std::array<double, 3>& x = from.vertex.x;
    const std::array<double, 3> st = cross(s.n, t.n), et = cross(e.n, t.n), se = cross(s.n, e.n);
    const double det = dot(se, t.n), size = std::fabs(det);
    const double at_s = s.d - dot(s.n, x), at_e = dot(e.n, x) - e.d, at_t = t.d - dot(t.n, x);
    const double inverse = 1 / det;
    double most = 0, moved = 0;
    for (int k = 0; k < 3; ++k) {
      const double step = (at_s * et[k] + at_e * st[k] + at_t * se[k]) * inverse;
      vertex.x[k] = x[k] + step;
      most = std::max(most, std::fabs(et[k]) + std::fabs(st[k]) + std::fabs(se[k]));
      moved = std::max(moved, std::fabs(step));
    }
    const double magnitude = std::max(1.0, largest(x));
    const double residuals = std::fabs(at_s) + std::fabs(at_e) + std::fabs(at_t);
    if (size > 0x1p-30) {
      error = 1.01 *
                  (kPlaneError * magnitude * most + 19 * kUnit * residuals + 67 * kUnit * moved) /
                  size +
              4 * kUnit * (magnitude + moved);
    }
  }
  if (error < kWorstError) {
    const double magnitude = std::max(1.0, 1.01 * largest(vertex.x));
    vertex.bound = rounded_up(vertex_bound(error, magnitude));
    return vertex;
  }
  return repaired(Corner<Vertex>{edge, vertex, ref, from.support});
}

template <class Stats>
std::array<Ball, 3> ImplicitVolumeSpace<Stats>::position(const Corner<Vertex>& corner) const {
  const Vertex& vertex = corner.vertex;
  std::array<Ball, 3> point;
  if (vertex.source != kMadeVertex) {
    const double error = shared_->b <= 53 ? 0 : 2 * kUnit;
    for (int k = 0; k < 3; ++k) {
      point[k] = Ball(vertex.x[k], error * vertex.x[k] + (shared_->b <= 53 ? 0 : Ball::kTiny));
    }
    return point;
  }
  const double error = error_of(vertex);
  for (int k = 0; k < 3; ++k) point[k] = Ball(vertex.x[k], error);
  return point;
}

template <class Stats>
double ImplicitVolumeSpace<Stats>::accurate_value(const Plane& plane, VertexId v) const {
  double result = 0;
  const auto compute = [&]<class Factor, class Int>() {
    const Vector3<Factor> n = exact_normal<Factor>(plane);
    const Int value = exact_value<Int>(plane, n, v);
    // By the same power of two as the normal's doubles, which may be rounded up to the next one.
    if (plane.is_explicit() && explicit_[plane.source[0]].is_wide()) {
      result = to_double_scaled(value, long{explicit_[plane.source[0]].bits} + shared_->b);
      return;
    }
    if constexpr (std::is_same_v<Int, mpz_class>) {
      result = to_double_scaled(value, long{bits_of(n)} + shared_->b);
    } else {
      const double magnitude = plane.is_explicit()
                                   ? largest_double(explicit_[plane.source[0]].plane.n)
                                   : largest_double(n);
      result = to_double_scaled(value, 0) * normalizer(magnitude) * shared_->grid_scale;
    }
  };
  with_widths(shared_->fixed ? narrowest_width(value_bits(plane) + 1) : IntegerWidth::kUnbounded,
              std::max(normal_bits(plane), shared_->b), compute);
  return result;
}

template <class Stats>
std::array<Ball, 3> ImplicitVolumeSpace<Stats>::exact_offset(VertexId origin,
                                                             const Corner<Vertex>& corner) const {
  std::array<Ball, 3> result;
  with_exact_point(corner, false, origin, [&]<class Int>(const ExactPoint<Int>& point) {
    long shift = 0;
    if constexpr (std::is_same_v<Int, mpz_class>) shift = long{bits_of(point.w)};
    const double w = to_double_scaled(point.w, shift);
    const std::array<Ball, 3> from = input_offset(origin, point.origin);
    for (int k = 0; k < 3; ++k) {
      const double step = to_double_scaled(point.x[k], shift + shared_->b) / w;
      result[k] = from[k] + Ball(step, 5.1 * kUnit * std::fabs(step) + Ball::kTiny);
    }
  });
  return result;
}

template <class Stats>
std::array<Ball, 3> ImplicitVolumeSpace<Stats>::input_offset(VertexId from, VertexId to) const {
  std::array<Ball, 3> result;
  if (from == to) return result;
  const auto set = [&](const auto& step, double least) {
    for (int k = 0; k < 3; ++k) {
      double x;
      if constexpr (std::is_same_v<std::decay_t<decltype(step[k])>, mpz_class>) {
        x = to_double_scaled(step[k], shared_->b);
      } else {
        x = to_double(step[k]) * shared_->grid_scale;
      }
      result[k] = Ball(x, 2 * kUnit * std::fabs(x) + least);
    }
  };
  const auto by = [&]<class Position>(double least) {
    set(difference(position_of<Position>(*shared_, to), position_of<Position>(*shared_, from)),
        least);
  };
  if (shared_->narrow) {
    by.template operator()<std::int64_t>(0);
  } else if (shared_->fixed) {
    by.template operator()<Int128>(0);
  } else {
    by.template operator()<mpz_class>(Ball::kTiny);
  }
  return result;
}

// With values v_i at the origin, off by 2u each, and cross products c_i of normals, off by 12.2u
// and at most 2: v_0 c_0 + v_1 c_1 + v_2 c_2 is off by 24.2u (|v_0| + |v_1| + |v_2|), and the
// determinant by 66u (see crossing()).
template <class Stats>
std::array<Ball, 3> ImplicitVolumeSpace<Stats>::offset(VertexId origin,
                                                       const Corner<Vertex>& corner) const {
  if (corner.vertex.source != kMadeVertex) return input_offset(origin, corner.vertex.source);
  std::array<Ball, 3> result;
  const bool before_is_edge = is_input_edge(corner.before);
  if (before_is_edge || is_input_edge(corner.after)) {
    const EdgeEnds ends = ends_of(before_is_edge ? corner.before : corner.after);
    const Plane& cut = plane_at((before_is_edge ? corner.after : corner.before).index());
    const double at_a = accurate_value(cut, ends.a), at_b = accurate_value(cut, ends.b);
    // Of different signs: 2u each, two roundings.
    const double t = at_a / (at_a - at_b);
    if (!(std::fabs(at_a) + std::fabs(at_b) > 0x1p-900)) return exact_offset(origin, corner);
    const std::array<Ball, 3> from = input_offset(origin, ends.a),
                              step = input_offset(ends.a, ends.b);
    const Ball parameter(t, 6.1 * kUnit * std::fabs(t) + Ball::kTiny);
    for (int k = 0; k < 3; ++k) result[k] = from[k] + parameter * step[k];
    return result;
  }
  const Meet meet = meet_of(corner);
  const std::array<double, 3>&p = meet.planes[0]->n, &q = meet.planes[1]->n, &r = meet.planes[2]->n;
  const std::array<double, 3> qr = cross(q, r), rp = cross(r, p), pq = cross(p, q);
  const double det = dot(p, qr), size = std::fabs(det);
  if (!(size > kLeastDeterminant)) return exact_offset(origin, corner);
  std::array<double, 3> v;
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    v[i] = -accurate_value(*meet.planes[i], origin);
    sum += std::fabs(v[i]);
  }
  if (!(sum > 0x1p-800) && sum != 0) return exact_offset(origin, corner);
  const double inverse = 1 / det;
  for (int k = 0; k < 3; ++k) {
    const double step = (v[0] * qr[k] + v[1] * rp[k] + v[2] * pq[k]) * inverse;
    const double magnitude = std::fabs(step);
    result[k] = Ball(step, 1.01 * kUnit * (25 * sum + 67 * magnitude) / size +
                               4 * kUnit * magnitude + Ball::kTiny);
  }
  return result;
}

template <class Stats>
std::array<mpq_class, 3> ImplicitVolumeSpace<Stats>::exact_position(
    const Corner<Vertex>& corner) const {
  const Geometry& geometry = *shared_->geometry;
  std::array<mpq_class, 3> result;
  if (corner.vertex.source != kMadeVertex) {
    for (int k = 0; k < 3; ++k) result[k] = geometry.grid.at(corner.vertex.source, k);
  } else {
    with_exact_point(corner, true, some_pivot(corner),
                     [&]<class Int>(const ExactPoint<Int>& point) {
                       if constexpr (std::is_same_v<Int, mpz_class>) {
                         for (int k = 0; k < 3; ++k) {
                           result[k] = mpq_class(point.x[k], point.w);
                           result[k].canonicalize();
                           result[k] += geometry.grid.at(point.origin, k);
                         }
                       }
                     });
  }
  for (int k = 0; k < 3; ++k) result[k] = geometry.origin[k] + geometry.step * result[k];
  return result;
}

// The same in pairs of doubles: every factor errs by less than 2^-100 of itself; the bound is 2^-94
// of the magnitudes of the terms. A coordinate that all points of one of the planes (or of the
// edge) have is that of an input vertex: much of a scene stands on z = 0, which no bound can tell.
template <class Stats>
std::array<double, 3> ImplicitVolumeSpace<Stats>::nearest_position(
    const Corner<Vertex>& corner) const {
  const Shared& shared = *shared_;
  const Geometry& geometry = *shared.geometry;
  if (corner.vertex.source != kMadeVertex) return geometry.positions[corner.vertex.source];
  std::array<double, 3> result;
  std::array<bool, 3> known{};
  if (shared.fixed) {
    const auto same = [&](VertexId a, VertexId b, VertexId c) {
      for (int k = 0; k < 3; ++k) {
        const bool agree = shared.narrow
                               ? geometry.grid.narrow(a, k) == geometry.grid.narrow(b, k) &&
                                     geometry.grid.narrow(a, k) == geometry.grid.narrow(c, k)
                               : shared.positions[a][k] == shared.positions[b][k] &&
                                     shared.positions[a][k] == shared.positions[c][k];
        if (!agree) continue;
        result[k] = geometry.positions[a][k];
        known[k] = true;
      }
    };
    for (const PlaneRef ref : {PlaneRef(corner.support), corner.before, corner.after}) {
      if (is_input_edge(ref)) {
        const EdgeEnds ends = ends_of(ref);
        same(ends.a, ends.b, ends.b);
      } else if (const Plane& plane = plane_at(ref.index()); !plane.is_explicit()) {
        same(plane.source[0], plane.source[1], plane.source[2]);
      }
    }
  }
  bool all = true;
  with_exact_point(corner, false, some_pivot(corner), [&]<class Int>(const ExactPoint<Int>& point) {
    const DoubleDouble w = double_double(point.w);
    for (int k = 0; k < 3; ++k) {
      if (known[k]) continue;
      const DoubleDouble at = shared.narrow ? double_double(geometry.grid.narrow(point.origin, k))
                                            : double_double(geometry.grid.wide(point.origin, k));
      const DoubleDouble step = double_double(point.x[k]) / w;
      const double most = std::fabs(shared.origin[k].high) +
                          (std::fabs(at.high) + std::fabs(step.high)) * shared.step.high;
      const std::optional<double> nearest =
          gnomon::nearest_double(shared.origin[k] + (at + step) * shared.step, 0x1p-94 * most);
      known[k] = nearest.has_value();
      all = all && known[k];
      if (nearest) result[k] = *nearest;
    }
  });
  if (all) return result;
  const std::array<mpq_class, 3> exact = exact_position(corner);
  for (int k = 0; k < 3; ++k) {
    if (!known[k]) result[k] = gnomon::nearest_double(exact[k]);
  }
  return result;
}

template class ImplicitVolumeSpace<NoStats>;
template class ImplicitVolumeSpace<CountStats>;

}  // namespace gnomon
