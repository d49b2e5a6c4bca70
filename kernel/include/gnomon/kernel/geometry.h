// SPDX-License-Identifier: LGPL-3.0-or-later
// The geometry that a kernel works on, as plain arrays: positions (nearest doubles, and exactly as
// integers on one grid), undirected edges, support planes by three of their vertices, and a light
// as one homogeneous point. Made once per scene by scene/prepare.h, never changed afterwards.
//
// Exactness: position v is exactly origin + step * grid.at(v). Every predicate of the toolkit is a
// homogeneous polynomial in position differences and light directions, so that its sign is the same
// on the grid's integers as on the scene's numbers.
#ifndef GNOMON_KERNEL_GEOMETRY_H
#define GNOMON_KERNEL_GEOMETRY_H

#include <gmpxx.h>

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace gnomon {

using VertexId = std::uint32_t;
using EdgeId = std::uint32_t;
using PlaneId = std::uint32_t;

/// Integer coordinates of all vertices: 64-bit where they fit, GMP integers otherwise.
class GridPositions {
 public:
  /// Coordinates in [0, 2^bits - 1]. `wide` is used if bits() > kNarrowBits.
  static constexpr unsigned kNarrowBits = 63;

  GridPositions() = default;
  /// Takes 3 n coordinates x0 y0 z0 x1 ..., all non-negative.
  static GridPositions from(std::vector<mpz_class> coordinates);
  /// The same from 64-bit coordinates, without a copy. Requires: all in [0, 2^kNarrowBits - 1].
  static GridPositions from_narrow(std::vector<std::int64_t> coordinates) {
    std::uint64_t all = 0;
    for (std::int64_t coordinate : coordinates) all |= static_cast<std::uint64_t>(coordinate);
    GridPositions result;
    result.bits_ = static_cast<unsigned>(std::bit_width(all));
    result.narrow_ = std::move(coordinates);
    return result;
  }

  std::size_t size() const { return (is_narrow() ? narrow_.size() : wide_.size()) / 3; }
  unsigned bits() const { return bits_; }
  bool is_narrow() const { return bits_ <= kNarrowBits; }
  /// Requires: is_narrow().
  std::int64_t narrow(VertexId vertex, int axis) const {
    return narrow_[3 * std::size_t{vertex} + axis];
  }
  /// Where the three coordinates of a vertex lie. Requires: is_narrow().
  const std::int64_t* narrow_point(VertexId vertex) const {
    return narrow_.data() + 3 * std::size_t{vertex};
  }
  /// Requires: !is_narrow().
  const mpz_class& wide(VertexId vertex, int axis) const {
    return wide_[3 * std::size_t{vertex} + axis];
  }
  mpz_class at(VertexId vertex, int axis) const {
    return is_narrow() ? mpz_class(static_cast<long>(narrow(vertex, axis))) : wide(vertex, axis);
  }

 private:
  unsigned bits_ = 0;  // of the largest coordinate
  std::vector<std::int64_t> narrow_;
  std::vector<mpz_class> wide_;
};

struct EdgeEnds {
  VertexId a = 0, b = 0;  // a < b
  friend bool operator==(EdgeEnds, EdgeEnds) = default;
};

/// Three vertices of the loops in one plane, not collinear, counter-clockwise seen from the plane's
/// front.
struct SupportTriple {
  VertexId a = 0, b = 0, c = 0;
};

/// Positions are distinct; edges and planes are distinct as sets of points (planes: up to
/// orientation).
struct Geometry {
  std::vector<std::array<double, 3>> positions;  // nearest doubles, scene units
  /// The last so many positions are of lights alone: no part of the scene's diagonal.
  std::uint32_t light_vertices = 0;
  GridPositions grid;
  mpq_class step;                   // scene units per grid unit, positive
  std::array<mpq_class, 3> origin;  // scene position of the grid's (0, 0, 0)
  std::vector<EdgeEnds> edges;
  std::vector<SupportTriple> planes;

  /// Positions without those of lights alone.
  std::span<const std::array<double, 3>> polygon_positions() const {
    return {positions.data(), positions.size() - light_vertices};
  }
};

/// A point light (position, 1) or a directional one (to_light, 0).
struct LightPoint {
  bool directional = false;
  std::array<double, 3> nearest{};  // position in scene units, or to_light
  std::array<mpz_class, 3> grid;    // position on the scene's grid, or to_light as a primitive
                                    // integer vector (its own grid), same direction
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_GEOMETRY_H
