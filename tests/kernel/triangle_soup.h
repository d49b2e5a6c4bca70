// SPDX-License-Identifier: GPL-3.0-or-later
// Geometry for tests of predicates, made directly on the grid so that its bits can be chosen:
// triangles with integer corners, each with its own support plane, on grids from 2 bits to
// thousands.
#ifndef GNOMON_TESTS_KERNEL_TRIANGLE_SOUP_H
#define GNOMON_TESTS_KERNEL_TRIANGLE_SOUP_H

#include <gmpxx.h>

#include <array>
#include <map>
#include <vector>

#include "gnomon/kernel/geometry.h"
#include "kernel/signs/corner.h"
#include "kernel/signs/nearest_double.h"
#include "scene/base/random.h"

namespace gnomon::test {

using Integers = std::array<mpz_class, 3>;
using Rationals = std::array<mpq_class, 3>;

template <class T>
T dot(const std::array<T, 3>& a, const std::array<T, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class T>
std::array<T, 3> cross(const std::array<T, 3>& a, const std::array<T, 3>& b) {
  return {T(a[1] * b[2] - a[2] * b[1]), T(a[2] * b[0] - a[0] * b[2]), T(a[0] * b[1] - a[1] * b[0])};
}
template <class T>
std::array<T, 3> minus(const std::array<T, 3>& a, const std::array<T, 3>& b) {
  return {T(a[0] - b[0]), T(a[1] - b[1]), T(a[2] - b[2])};
}

class TriangleSoup {
 public:
  /// Degenerate triangles are left out. Requires: corners are not negative.
  TriangleSoup(const std::vector<std::array<Integers, 3>>& triangles, int exponent_of_step) {
    std::map<Integers, VertexId> ids;
    std::map<std::pair<VertexId, VertexId>, EdgeId> edges;
    std::vector<mpz_class> coordinates;
    mpz_class one = 1;
    geometry_.step = exponent_of_step < 0 ? mpq_class(one, one << -exponent_of_step)
                                          : mpq_class(one << exponent_of_step);
    for (const std::array<Integers, 3>& triangle : triangles) {
      const Integers n = cross(minus(triangle[1], triangle[0]), minus(triangle[2], triangle[0]));
      if (n[0] == 0 && n[1] == 0 && n[2] == 0) continue;
      std::array<VertexId, 3> loop{};
      for (int i = 0; i < 3; ++i) {
        const auto [place, is_new] =
            ids.try_emplace(triangle[i], static_cast<VertexId>(ids.size()));
        loop[i] = place->second;
        if (is_new) {
          std::array<double, 3> nearest;
          for (int k = 0; k < 3; ++k) {
            coordinates.push_back(triangle[i][k]);
            nearest[k] = nearest_double(geometry_.step * triangle[i][k]);
          }
          geometry_.positions.push_back(nearest);
        }
      }
      for (int i = 0; i < 3; ++i) {
        const VertexId a = loop[i], b = loop[(i + 1) % 3];
        const auto [place, is_new] =
            edges.try_emplace(std::minmax(a, b), static_cast<EdgeId>(geometry_.edges.size()));
        if (is_new) geometry_.edges.push_back({std::min(a, b), std::max(a, b)});
        loop_edges_.push_back(PlaneRef(place->second, a > b));
      }
      loops_.push_back(loop);
      geometry_.planes.push_back({loop[0], loop[1], loop[2]});
    }
    geometry_.grid = GridPositions::from(std::move(coordinates));
  }

  const Geometry& geometry() const { return geometry_; }
  std::uint32_t size() const { return static_cast<std::uint32_t>(loops_.size()); }
  const std::array<VertexId, 3>& loop(std::uint32_t triangle) const { return loops_[triangle]; }
  /// Edge from vertex i to i + 1 of a triangle: index() is the edge.
  PlaneRef edge(std::uint32_t triangle, std::uint32_t i) const {
    return loop_edges_[3 * triangle + i];
  }
  Integers at(VertexId v) const {
    return {geometry_.grid.at(v, 0), geometry_.grid.at(v, 1), geometry_.grid.at(v, 2)};
  }
  /// n . x - d of a triangle's support plane, by the definition.
  mpq_class value(PlaneId plane, const Rationals& x) const {
    const SupportTriple& t = geometry_.planes[plane];
    const Integers a = at(t.a), n = cross(minus(at(t.b), a), minus(at(t.c), a));
    mpq_class sum = 0;
    for (int k = 0; k < 3; ++k) sum += n[k] * (x[k] - a[k]);
    return sum;
  }

 private:
  Geometry geometry_;
  std::vector<std::array<VertexId, 3>> loops_;
  std::vector<PlaneRef> loop_edges_;
};

/// How the corners of a soup are chosen.
enum class SoupKind : std::uint8_t {
  kLattice,  // 0..3 times a power of two: everything coincides
  kNear,     // the same, moved by at most one grid unit
  kFull,     // all bits random
  kCorners,  // 0, 1, 2^b - 2 or 2^b - 1
  kMixed,    // random exponents below b
};
inline constexpr std::array kSoupKinds = {SoupKind::kLattice, SoupKind::kNear, SoupKind::kFull,
                                          SoupKind::kCorners, SoupKind::kMixed};

inline mpz_class random_bits(Random& random, unsigned bits) {
  mpz_class value = 0;
  for (unsigned done = 0; done < bits; done += 32) {
    value = (value << 32) + static_cast<unsigned long>(random.below(std::uint64_t{1} << 32));
  }
  return value & ((mpz_class(1) << bits) - 1);
}

/// A coordinate in [0, 2^bits - 1].
inline mpz_class random_coordinate(Random& random, SoupKind kind, unsigned bits) {
  const mpz_class top = (mpz_class(1) << bits) - 1;
  switch (kind) {
    case SoupKind::kLattice:
      return mpz_class(static_cast<unsigned long>(random.below(4))) << (bits < 2 ? 0 : bits - 2);
    case SoupKind::kNear: {
      mpz_class value = mpz_class(static_cast<unsigned long>(random.below(4)))
                        << (bits < 2 ? 0 : bits - 2);
      value += static_cast<long>(random.between(-1, 1));
      return value < 0 ? mpz_class(0) : value > top ? top : value;
    }
    case SoupKind::kFull:
      return random_bits(random, bits);
    case SoupKind::kCorners:
      switch (random.below(4)) {
        case 0:
          return 0;
        case 1:
          return 1;
        case 2:
          return top - 1;
        default:
          return top;
      }
    case SoupKind::kMixed: {
      if (random.chance(1, 5)) return 0;
      const auto length = static_cast<unsigned>(random.below(bits) + 1);
      return random_bits(random, std::min(length, 60u)) << (length > 60 ? length - 60 : 0);
    }
  }
  return 0;
}

/// `count` random triangles on a grid of at most `bits` bits; one vertex reaches the last bit.
inline TriangleSoup random_soup(Random& random, SoupKind kind, unsigned bits, int count,
                                int exponent_of_step = 0) {
  std::vector<std::array<Integers, 3>> triangles(static_cast<std::size_t>(count));
  for (auto& triangle : triangles) {
    for (Integers& corner : triangle) {
      for (mpz_class& x : corner) x = random_coordinate(random, kind, bits);
    }
  }
  triangles[0][0][0] = (mpz_class(1) << bits) - 1;
  return TriangleSoup(triangles, exponent_of_step);
}

/// A cluster of `bits` bits, and one vertex 2^far away that makes all of it tiny on the scene's
/// scale: where products of the cluster's coordinates underflow.
inline TriangleSoup clustered_soup(Random& random, SoupKind kind, unsigned bits, unsigned far) {
  std::vector<std::array<Integers, 3>> triangles(6);
  for (auto& triangle : triangles) {
    for (Integers& corner : triangle) {
      for (mpz_class& x : corner) x = random_coordinate(random, kind, bits);
    }
  }
  triangles.push_back({{{0, 0, 0}, {mpz_class(1) << far, 0, 1}, {0, mpz_class(1) << far, 0}}});
  return TriangleSoup(triangles, 0);
}

inline Rationals rationals(const Integers& x) { return {x[0], x[1], x[2]}; }

inline LightPoint light_at(const Geometry& geometry, const Integers& grid, bool directional) {
  LightPoint light;
  light.directional = directional;
  light.grid = grid;
  for (std::size_t k = 0; k < 3; ++k) {
    light.nearest[k] = directional
                           ? grid[k].get_d()
                           : mpq_class(geometry.origin[k] + geometry.step * grid[k]).get_d();
  }
  return light;
}

/// Not zero if directional; within the grid otherwise.
inline LightPoint small_light(Random& random, const Geometry& geometry, unsigned bits,
                              bool directional) {
  Integers grid;
  do {
    for (mpz_class& x : grid) {
      x = random_coordinate(random, SoupKind::kFull, bits);
      if (directional && random.chance(1, 2)) x = -x;
      if (random.chance(1, 6)) x = 0;
    }
  } while (directional && grid == Integers{0, 0, 0});
  if (directional) {
    const mpz_class common = gcd(gcd(grid[0], grid[1]), grid[2]);
    for (mpz_class& x : grid) x /= common;
  }
  return light_at(geometry, grid, directional);
}

/// The same soup elsewhere: origin moved, positions with it.
inline Geometry moved(Geometry geometry, const Rationals& origin) {
  for (std::size_t k = 0; k < 3; ++k) {
    geometry.origin[k] += origin[k];
    for (VertexId v = 0; v < geometry.positions.size(); ++v) {
      geometry.positions[v][k] = nearest_double(
          mpq_class(geometry.origin[k] + geometry.step * geometry.grid.at(v, static_cast<int>(k))));
    }
  }
  return geometry;
}

/// In rationals, so that nothing is rounded.
inline bool encloses(double middle, double error, const mpq_class& exact) {
  return abs(mpq_class(middle) - exact) <= mpq_class(error);
}

}  // namespace gnomon::test

#endif  // GNOMON_TESTS_KERNEL_TRIANGLE_SOUP_H
