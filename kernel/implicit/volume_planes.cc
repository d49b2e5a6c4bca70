// SPDX-License-Identifier: LGPL-3.0-or-later
// Makes planes of shadow volumes from three vertices or from integers, with their doubles.
#include "kernel/implicit/volume_planes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "kernel/implicit/scaled_doubles.h"
#include "kernel/signs/fp_environment.h"

namespace gnomon {

VolumePlanes::VolumePlanes(const Geometry& geometry) {
  auto made = std::make_shared<Shared>();
  Shared& shared = *made;
  shared.geometry = &geometry;
  shared.plane_count = static_cast<std::uint32_t>(geometry.planes.size());
  shared.edge_count = static_cast<std::uint32_t>(geometry.edges.size());
  shared.b = geometry.grid.bits();
  shared.narrow = geometry.grid.is_narrow();
  shared.fixed = shared.b <= kNarrowBits;
  if (shared.fixed) shared.grid_scale = std::ldexp(1.0, -static_cast<int>(shared.b));
  if (shared.fixed && !shared.narrow) {
    const ExactGeometry<Int128> exact(geometry);
    shared.positions.reserve(geometry.positions.size());
    for (VertexId v = 0; v < geometry.grid.size(); ++v) {
      shared.positions.push_back(exact.position(v));
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

std::array<double, 3> VolumePlanes::long_input_point(const Shared& shared, VertexId v) {
  std::array<double, 3> x;
  for (int k = 0; k < 3; ++k) {
    x[k] = shared.fixed ? to_double(shared.positions[v][k]) * shared.grid_scale
                        : to_double_scaled(shared.geometry->grid.wide(v, k), shared.b);
  }
  return x;
}

// The normal is exact before it is rounded once: area lights have planes through nearly collinear
// points, whose normals from rounded differences would have no correct bit. False: it is zero.
bool VolumePlanes::plane_through(const Shared& shared, const std::array<VertexId, 3>& vertices,
                                 Plane& plane) {
  plane.source.vertices = vertices;
  bool some = false;
  const auto set_normal = [&]<class Int, class Position>() {
    const Vector3<Position> a = position_of<Position>(shared, vertices[0]);
    const Vector3<Int> n = cross<Int>(difference(position_of<Position>(shared, vertices[1]), a),
                                      difference(position_of<Position>(shared, vertices[2]), a));
    some = to_normalized(n, {0, 0, 0}, plane.n);
  };
  if (shared.b <= 31) {
    set_normal.template operator()<std::int64_t, std::int64_t>();
  } else if (shared.narrow) {
    set_normal.template operator()<Int128, std::int64_t>();
  } else if (shared.fixed) {
    set_normal.template operator()<WideInteger<4>, Int128>();
  } else {
    set_normal.template operator()<mpz_class, mpz_class>();
  }
  if (some) plane.d = dot(plane.n, input_point(shared, vertices[0]));
  return some;
}

PlaneRef VolumePlanes::add_through(const std::array<VertexId, 3>& vertices) {
  Plane plane;
  if (!plane_through(*shared_, vertices, plane)) return {};
  return push(plane);
}

PlaneRef VolumePlanes::add_narrow(const ExactPlane<Int128>& exact) {
  if (is_zero(exact.n)) return {};
  Plane plane;
  plane.n = to_doubles(exact.n);
  const double scale = normalizer(largest(plane.n));
  for (double& x : plane.n) x *= scale;
  plane.d = to_double(exact.d) * scale * grid_scale();
  plane.source = VolumePlaneSource::of_integers(explicit_.size());
  explicit_.push_back({exact, kNotWide, bits_of(exact.n), plane_mark()});
  return push(plane);
}

PlaneRef VolumePlanes::add_explicit(ExactPlane<mpz_class> exact) {
  if (is_zero(exact.n)) return {};
  mpz_class divisor = exact.d;
  for (const mpz_class& x : exact.n) divisor = gcd(divisor, x);
  if (divisor > 1) {
    for (mpz_class& x : exact.n) mpz_divexact(x.get_mpz_t(), x.get_mpz_t(), divisor.get_mpz_t());
    mpz_divexact(exact.d.get_mpz_t(), exact.d.get_mpz_t(), divisor.get_mpz_t());
  }
  const unsigned bits = bits_of(exact.n);
  if (is_fixed() && std::max(bits, bits_of(exact.d)) <= kNarrowBits) {
    ExactPlane<Int128> plane;
    for (int k = 0; k < 3; ++k) plane.n[k] = integer_from<Int128>(exact.n[k]);
    plane.d = integer_from<Int128>(exact.d);
    return add_narrow(plane);
  }
  Plane plane;
  for (int k = 0; k < 3; ++k) plane.n[k] = to_double_scaled(exact.n[k], bits);
  plane.d = to_double_scaled(exact.d, long{bits} + grid_bits());
  plane.source = VolumePlaneSource::of_integers(explicit_.size());
  explicit_.push_back({{}, static_cast<std::uint32_t>(wide_.size()), bits, plane_mark()});
  wide_.push_back(std::move(exact));
  return push(plane);
}

PlaneShift VolumePlanes::take_planes(VolumePlanes fork) {
  const PlaneShift shift{first_own(), plane_mark()};
  const auto first_wide = static_cast<std::uint32_t>(wide_.size());
  std::vector<Plane> planes = fork.own_.take();
  for (Explicit& given : fork.explicit_.take()) {
    planes[given.owner].source = VolumePlaneSource::of_integers(explicit_.size());
    given.owner += shift.by;
    if (given.is_wide()) given.wide += first_wide;
    explicit_.push_back(given);
  }
  for (const Plane& plane : planes) own_.push_back(plane);
  for (ExactPlane<mpz_class>& plane : fork.wide_.take()) wide_.push_back(std::move(plane));
  return shift;
}

double VolumePlanes::accurate_value(const Plane& plane, VertexId v) const {
  double result = 0;
  const auto compute = [&]<class Factor, class Int>() {
    const Vector3<Factor> n = exact_normal<Factor>(plane);
    const Int value = exact_value<Int>(plane, n, v);
    // By the same power of two as the normal's doubles, which may be rounded up to the next one.
    if (plane.is_explicit() && integers(plane).is_wide()) {
      result = to_double_scaled(value, long{integers(plane).bits} + grid_bits());
      return;
    }
    if constexpr (std::is_same_v<Int, mpz_class>) {
      result = to_double_scaled(value, long{bits_of(n)} + grid_bits());
    } else {
      const Double3 normal =
          plane.is_explicit() ? to_doubles(integers(plane).plane.n) : to_doubles(n);
      result = to_double_scaled(value, 0) * normalizer(largest(normal)) * grid_scale();
    }
  };
  with_widths(width_of(is_fixed(), value_bits(plane) + 1),
              std::max(normal_bits(plane), grid_bits()), compute);
  return result;
}

void VolumePlanes::values_at(std::uint32_t index, std::span<const VertexId> vertices,
                             std::span<DoubleDouble> values) const {
  const Plane& plane = plane_at(index);
  with_widths(width_of(is_fixed(), value_bits(plane) + 1),
              std::max(normal_bits(plane), grid_bits()), [&]<class Factor, class Int>() {
                const Vector3<Factor> n = exact_normal<Factor>(plane);
                for (std::size_t i = 0; i < vertices.size(); ++i) {
                  values[i] = double_double(exact_value<Int>(plane, n, vertices[i]));
                }
              });
}

}  // namespace gnomon
