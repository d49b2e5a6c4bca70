// SPDX-License-Identifier: LGPL-3.0-or-later
// Planes of shadow volumes for kernel `plane`: what each was made from, its integers, and its
// doubles for the filter.
//
// A plane is its provenance: three input vertices (a support plane, or a face of a volume; nearly
// all are), or explicit integers without a common divisor where 128 bits do not hold them as they
// are (planes through corners of a cut light, along a direction, and of axes). Planes [0, planes)
// are the scene's support planes, [planes, planes + edges) name input edges and have no integers,
// and all others are a stack of each fork's own, above those that forks share.
//
// Guarantee: every bound is proven (VolumeBounds). Coordinates are scaled to [0, 1] and normals so
// that the largest component is in [1/2, 1). Reference: docs/exactness.md, "Shadow volumes".
#ifndef GNOMON_KERNEL_IMPLICIT_VOLUME_PLANES_H
#define GNOMON_KERNEL_IMPLICIT_VOLUME_PLANES_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "gnomon/kernel/geometry.h"
#include "gnomon/kernel/precision_plan.h"
#include "kernel/concept/plane_takeover.h"
#include "kernel/concept/shared_stack.h"
#include "kernel/implicit/exact_geometry.h"
#include "kernel/implicit/filter_bounds.h"
#include "kernel/implicit/plane_provenance.h"
#include "kernel/implicit/scaled_doubles.h"
#include "kernel/numbers/double_double.h"
#include "kernel/signs/corner.h"

namespace gnomon {

class VolumePlanes {
 public:
  const Geometry& geometry() const { return *shared_->geometry; }
  SceneEdges edges() const { return {shared_->plane_count}; }

  std::uint32_t plane_mark() const { return static_cast<std::uint32_t>(own_.size()); }
  void release_planes(std::uint32_t mark) {
    own_.truncate(mark);
    std::size_t kept = explicit_.size(), wide = wide_.size();
    while (kept > 0 && explicit_[kept - 1].owner >= mark) {
      if (explicit_[--kept].is_wide()) --wide;
    }
    if (kept == explicit_.size()) return;
    explicit_.truncate(kept);
    wide_.truncate(wide);
  }

  /// As TakesPlanes has them.
  void reserve_planes(std::size_t more) {
    if (own_.size() > 0)
      explicit_.reserve(explicit_.size() + explicit_.size() * more / own_.size());
    own_.reserve(own_.size() + more);
  }
  void share_planes() {
    own_.share();
    explicit_.share();
    wide_.share();
  }
  PlaneShift take_planes(VolumePlanes fork);

  /// A plane and its doubles, to test many vertices against.
  struct LoadedPlane {
    std::array<double, 3> n;
    double d;
    PlaneRef plane;
  };
  [[gnu::always_inline]] LoadedPlane load(PlaneRef ref) const {
    const Plane& plane = plane_at(ref.index());
    return {plane.n, plane.d, ref};
  }
  /// The value of a plane at an input vertex, in a measure of the plane's own that is at most 1:
  /// off by at most 4u of itself, unless it has underflowed. Requires: not the name of an input
  /// edge.
  double value_at(PlaneRef ref, VertexId v) const {
    const double value = accurate_value(plane_at(ref.index()), v);
    return ref.flipped() ? -value : value;
  }
  /// n . v - d of the plane's integers at input vertices: each off by at most 2^-104 of itself, or,
  /// beyond 2^900, perhaps infinite, but of the right sign. Requires: not the index of an input
  /// edge.
  void values_at(std::uint32_t plane, std::span<const VertexId> vertices,
                 std::span<DoubleDouble> values) const;
  /// What a plane was made from. Requires: not the name of an input edge.
  const VolumePlaneSource& source_of(PlaneRef ref) const { return plane_at(ref.index()).source; }

 protected:
  explicit VolumePlanes(const Geometry& geometry);

  /// n . x - d with the largest |n_k| in [1/2, 1), |d| < 3; the error of each n_k is at most 2u
  /// |n_k|, and that of d VolumeBounds::kOffset. 48 bytes.
  struct Plane {
    std::array<double, 3> n{};
    double d = 0;
    VolumePlaneSource source;

    bool is_explicit() const { return source.is_explicit(); }
    double value(const std::array<double, 3>& x) const {
      return n[0] * x[0] + n[1] * x[1] + n[2] * x[2] - d;
    }
  };
  /// Positions of at most so many bits, and explicit planes below 2^126, are computed with integers
  /// of fixed width: 128 bits less the sign and one for a sum.
  static constexpr unsigned kNarrowBits = 126;

  bool is_input_edge(PlaneRef ref) const {
    return ref.index() - shared_->plane_count < shared_->edge_count;
  }
  EdgeEnds ends_of(PlaneRef edge) const {
    return geometry().edges[edge.index() - shared_->plane_count];
  }
  /// Requires: not the name of an input edge.
  const Plane& plane_at(std::uint32_t index) const {
    const Shared& shared = *shared_;
    return index < shared.plane_count ? shared.supports[index]
                                      : own_[index - shared.plane_count - shared.edge_count];
  }
  /// Numbers below this one never change their plane.
  std::uint32_t first_own() const { return shared_->plane_count + shared_->edge_count; }

  /// Bits of the grid; whether positions fit into 64 bits; or at least into kNarrowBits.
  unsigned grid_bits() const { return shared_->b; }
  bool is_narrow() const { return shared_->narrow; }
  bool is_fixed() const { return shared_->fixed; }
  double grid_scale() const { return shared_->grid_scale; }
  const DoubleDouble& origin(int axis) const { return shared_->origin[axis]; }
  const DoubleDouble& step() const { return shared_->step; }

  // --- Positions. ---

  /// In grid units times 2^-b, each off by at most u of itself (2u on wide grids: GMP truncates).
  std::array<double, 3> input_point(VertexId v) const { return input_point(*shared_, v); }
  /// Requires: the grid is narrow for std::int64_t, and fixed and not narrow for Int128.
  template <class Position>
  Vector3<Position> position_of(VertexId v) const {
    return position_of<Position>(*shared_, v);
  }
  /// Calls f.template operator()<Position>() with the type in which positions are kept, for use
  /// with integers `Int`.
  template <class Int, class F>
  auto with_position(const F& f) const {
    if constexpr (std::is_same_v<Int, mpz_class>) {
      return f.template operator()<mpz_class>();
    } else if constexpr (std::is_same_v<Int, std::int64_t>) {
      return f.template operator()<std::int64_t>();
    } else {
      return is_narrow() ? f.template operator()<std::int64_t>() : f.template operator()<Int128>();
    }
  }

  // --- New planes; not valid() if the normal is zero. ---

  PlaneRef add_through(const std::array<VertexId, 3>& vertices);
  /// Makes it primitive.
  PlaneRef add_explicit(ExactPlane<mpz_class> plane);
  /// As it is. Requires: below 2^kNarrowBits, and the grid is fixed.
  PlaneRef add_narrow(const ExactPlane<Int128>& plane);

  // --- Integers. ---

  unsigned normal_bits(const Plane& plane) const {
    return plane.is_explicit() ? integers(plane).bits : support_normal_bits(grid_bits());
  }
  /// Magnitude of the value at a vertex.
  unsigned value_bits(const Plane& plane) const {
    return plane.is_explicit() ? volume_value_bits(integers(plane).bits, grid_bits())
                               : support_value_bits(grid_bits());
  }
  template <class Factor>
  Vector3<Factor> exact_normal(const Plane& plane) const;
  /// n . v - d, for the normal as exact_normal() gives it.
  template <class Value, class Factor>
  Value exact_value(const Plane& plane, const Vector3<Factor>& normal, VertexId v) const;
  /// The sum of the magnitudes of several normals, the largest of them, and the most by which a
  /// value of one of the planes is longer than its normal.
  struct Widths {
    unsigned normals = 0, largest_normal = 0, rest = 0;
  };
  void count_widths(const Plane& plane, Widths& widths) const {
    const unsigned n = normal_bits(plane);
    widths.normals += n;
    widths.largest_normal = std::max(widths.largest_normal, n);
    widths.rest = std::max(widths.rest, value_bits(plane) - n);
  }
  /// (n . v - d) 2^-b of the doubles' normal: off by at most 2u of itself.
  double accurate_value(const Plane& plane, VertexId v) const;

 private:
  /// A plane through a point of the scene's box, by integers: |d| and every |n . x - d| with x in
  /// the box are at most 3 D times the largest |n_k|.
  struct Explicit {
    ExactPlane<Int128> plane;       // below 2^kNarrowBits
    std::uint32_t wide = kNotWide;  // or an index into wide_
    unsigned bits = 0;              // of the largest |n_k|
    std::uint32_t owner = 0;        // its index in own_

    bool is_wide() const { return wide != kNotWide; }
  };
  static constexpr std::uint32_t kNotWide = 0xffffffffu;
  /// What forks have in common.
  struct Shared {
    const Geometry* geometry = nullptr;
    std::uint32_t plane_count = 0, edge_count = 0;
    unsigned b = 0;                          // bits of the grid
    bool narrow = false;                     // positions fit into 64 bits
    bool fixed = false;                      // or into kNarrowBits
    double grid_scale = 0;                   // 2^-b, if fixed
    std::vector<Vector3<Int128>> positions;  // if fixed and not narrow
    std::vector<Plane> supports;
    std::array<DoubleDouble, 3> origin;  // of the grid, scene units
    DoubleDouble step;                   // scene units per grid unit
  };

  template <class Position>
  static Vector3<Position> position_of(const Shared& shared, VertexId v) {
    if constexpr (std::is_same_v<Position, Int128>) {
      return shared.positions[v];
    } else {
      return ExactGeometry<Position>(*shared.geometry).position(v);
    }
  }
  static std::array<double, 3> input_point(const Shared& shared, VertexId v) {
    if (!shared.narrow) return long_input_point(shared, v);
    const std::int64_t* at = shared.geometry->grid.narrow_point(v);
    const double scale = shared.grid_scale;
    return {to_double(at[0]) * scale, to_double(at[1]) * scale, to_double(at[2]) * scale};
  }
  static std::array<double, 3> long_input_point(const Shared& shared, VertexId v);
  static bool plane_through(const Shared& shared, const std::array<VertexId, 3>& vertices,
                            Plane& plane);
  const Explicit& integers(const Plane& plane) const { return explicit_[plane.source.number()]; }
  PlaneRef push(const Plane& plane) {
    own_.push_back(plane);
    return PlaneRef(first_own() + static_cast<std::uint32_t>(own_.size()) - 1);
  }

  std::shared_ptr<const Shared> shared_;
  SharedStack<Plane> own_;
  SharedStack<Explicit> explicit_;
  SharedStack<ExactPlane<mpz_class>> wide_;
};

template <class Factor>
Vector3<Factor> VolumePlanes::exact_normal(const Plane& plane) const {
  if (plane.is_explicit()) {
    const auto convert = [](const auto& n) -> Vector3<Factor> {
      return {integer_from<Factor>(n[0]), integer_from<Factor>(n[1]), integer_from<Factor>(n[2])};
    };
    const Explicit& exact = integers(plane);
    return exact.is_wide() ? convert(wide_[exact.wide].n) : convert(exact.plane.n);
  }
  return with_position<Factor>([&]<class Position>() {
    const std::array<std::uint32_t, 3>& v = plane.source.vertices;
    const Vector3<Position> a = position_of<Position>(v[0]);
    return cross<Factor>(difference(position_of<Position>(v[1]), a),
                         difference(position_of<Position>(v[2]), a));
  });
}

template <class Value, class Factor>
Value VolumePlanes::exact_value(const Plane& plane, const Vector3<Factor>& normal,
                                VertexId v) const {
  return with_position<Factor>([&]<class Position>() -> Value {
    const Vector3<Position> x = position_of<Position>(v);
    if (!plane.is_explicit()) {
      return dot<Value>(normal, difference(x, position_of<Position>(plane.source.vertices[0])));
    }
    const Explicit& given = integers(plane);
    const Value d = given.is_wide() ? integer_from<Value>(wide_[given.wide].d)
                                    : integer_from<Value>(given.plane.d);
    return Value(dot<Value>(normal, x) - d);
  });
}

}  // namespace gnomon

#endif  // GNOMON_KERNEL_IMPLICIT_VOLUME_PLANES_H
