// SPDX-License-Identifier: LGPL-3.0-or-later
// What components and convex shells are found with: parts along edges, parts joined by them, and
// whether they are convex. Exactness: all is decided by signs of integers.
#ifndef GNOMON_ALGORITHMS_FACING_CHAIN_JOINED_PARTS_H
#define GNOMON_ALGORITHMS_FACING_CHAIN_JOINED_PARTS_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/facing_chain/edge_ring.h"
#include "gnomon/scene/prepare.h"
#include "scene/base/exact_int.h"
#include "scene/geometry/loop_geometry.h"

namespace gnomon::joined_parts {

using scene_detail::Int128;
using scene_detail::point;
using Vector = scene_detail::Vec3<mpz_class>;

/// The parts along each edge.
class EdgeUsers {
 public:
  explicit EdgeUsers(const PreparedScene& scene) : first_(scene.geometry.edges.size() + 1, 0) {
    for (const PlaneRef edge : scene.loop_edges) ++first_[edge.index() + 1];
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    users_.resize(scene.loop_edges.size());
    std::vector<std::uint32_t> place(first_.begin(), first_.end() - 1);
    for (std::uint32_t i = 0; i < scene.parts.size(); ++i) {
      const auto loop = scene.loop(scene.parts[i]);
      const auto edges = scene.edges(scene.parts[i]);
      for (std::size_t k = 0; k < edges.size(); ++k) {
        users_[place[edges[k].index()]++] = {i, loop[(k + 2) % loop.size()], edges[k].flipped()};
      }
    }
  }
  std::span<const EdgePart> of(EdgeId edge) const {
    return {users_.data() + first_[edge], first_[edge + 1] - first_[edge]};
  }

 private:
  std::vector<std::uint32_t> first_;  // by edge, into users_
  std::vector<EdgePart> users_;
};

/// A support plane with its front as one of its parts has it, and on which side of it a vertex
/// lies: by integers of 128 bits if they hold it, else by long doubles with a bound, and where that
/// does not suffice by larger integers.
class OrientedPlane {
 public:
  OrientedPlane(const GridPositions& grid, SupportTriple triple, bool flipped)
      : grid_(grid),
        triple_(triple),
        sign_(flipped ? -1 : 1),
        is_short_(grid.is_narrow() && grid.bits() <= kShortBits) {
    if (is_short_) {
      short_normal_ = normal<Int128, std::int64_t>();
    } else if (grid.is_narrow()) {
      normal_ = normal<long double, long double>();
      // With s and t the largest components of the two edges and r that of a vertex's difference,
      // all of them exact: a component of the normal is off by at most 4 u s t for u = 2^-64, and
      // below 2 s t; three products with r, two sums: below 3 r (4 u s t) + 5 u (6 r s t)
      // < 2^6 u r s t.
      error_bound_ = 0x1p-58L * largest(difference<long double>(triple_.b)) *
                     largest(difference<long double>(triple_.c));
    }
  }

  int side(VertexId vertex) const {
    if (is_short_) {
      const auto d = difference<std::int64_t>(vertex);
      const Int128 value =
          short_normal_[0] * d[0] + short_normal_[1] * d[1] + short_normal_[2] * d[2];
      return value > 0 ? sign_ : value < 0 ? -sign_ : 0;
    }
    if (grid_.is_narrow()) {
      const auto d = difference<long double>(vertex);
      const long double value = normal_[0] * d[0] + normal_[1] * d[1] + normal_[2] * d[2];
      if (std::abs(value) > error_bound_ * largest(d)) return value > 0 ? sign_ : -sign_;
    }
    return sign_ * sgn(dot(wide_normal(),
                           point<mpz_class>(grid_, vertex) - point<mpz_class>(grid_, triple_.a)));
  }
  /// Whether the three vertices are on a line.
  bool is_line() const {
    if (!is_short_) return wide_normal().is_zero();
    return short_normal_[0] == 0 && short_normal_[1] == 0 && short_normal_[2] == 0;
  }

 private:
  // Of b bits, differences are below 2^b, a normal's components below 2^(2 b + 1), and values below
  // 2^(3 b + 3).
  static constexpr unsigned kShortBits = 41;
  template <class Number>
  using Difference = std::array<Number, 3>;

  template <class Number>
  Difference<Number> difference(VertexId vertex) const {
    Difference<Number> result;
    for (int k = 0; k < 3; ++k) {
      result[k] = static_cast<Number>(grid_.narrow(vertex, k) - grid_.narrow(triple_.a, k));
    }
    return result;
  }
  template <class Product, class Number>
  Difference<Product> normal() const {
    const auto along = difference<Number>(triple_.b), across = difference<Number>(triple_.c);
    Difference<Product> result;
    for (int k = 0; k < 3; ++k) {
      const int u = (k + 1) % 3, v = (k + 2) % 3;
      result[k] = Product{along[u]} * across[v] - Product{along[v]} * across[u];
    }
    return result;
  }
  Vector wide_normal() const {
    const Vector from = point<mpz_class>(grid_, triple_.a);
    return cross(point<mpz_class>(grid_, triple_.b) - from,
                 point<mpz_class>(grid_, triple_.c) - from);
  }
  static long double largest(const Difference<long double>& d) {
    return std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])});
  }

  const GridPositions& grid_;
  SupportTriple triple_;
  int sign_;
  bool is_short_;
  Difference<Int128> short_normal_{};
  Difference<long double> normal_{};
  long double error_bound_ = 0;
};

/// Components, by their first parts, and the component of each part.
struct Partition {
  std::vector<std::uint32_t> component_of;
  std::vector<std::uint32_t> members;  // component by component
  std::vector<std::uint32_t> first;    // of each component's, and the end

  std::size_t size() const { return first.size() - 1; }
  /// Ascending.
  std::span<const std::uint32_t> parts(std::size_t component) const {
    return std::span(members).subspan(first[component], first[component + 1] - first[component]);
  }
};

Partition partition_of(const PreparedScene& scene, const EdgeUsers& users);

class ConvexityTest {
 public:
  ConvexityTest(const PreparedScene& scene, const EdgeUsers& users,
                const std::vector<std::uint32_t>& component_of)
      : scene_(scene), users_(users), component_of_(component_of) {}

  /// Whether all vertices, those of the parts, are behind or on all planes of parts, and some are
  /// behind one.
  bool is_convex(const std::vector<std::uint32_t>& parts,
                 const std::vector<VertexId>& vertices) const {
    // Nearly all that are not convex have a reflex edge, which is found sooner where vertices are
    // many.
    constexpr std::size_t kFew = 16;
    const auto has_reflex = [&](std::uint32_t part) { return has_reflex_edge(part); };
    if (vertices.size() > kFew && std::ranges::any_of(parts, has_reflex)) return false;
    return has_all_vertices_behind(parts, vertices);
  }
  std::vector<VertexId> vertices_of(const std::vector<std::uint32_t>& parts) const {
    std::vector<VertexId> vertices;
    for (const std::uint32_t part : parts) {
      const auto loop = scene_.loop(scene_.parts[part]);
      vertices.insert(vertices.end(), loop.begin(), loop.end());
    }
    sort_and_drop_repeated(vertices);
    return vertices;
  }

 private:
  OrientedPlane plane_of(const Part& part) const {
    return {scene_.geometry.grid, scene_.geometry.planes[part.plane], part.flipped};
  }

  bool has_reflex_edge(std::uint32_t index) const {
    const Part& part = scene_.parts[index];
    const OrientedPlane plane = plane_of(part);
    for (const PlaneRef edge : scene_.edges(part)) {
      for (const EdgePart& other : users_.of(edge.index())) {
        if (other.part != index && component_of_[other.part] == component_of_[index] &&
            plane.side(other.off_edge) > 0) {
          return true;
        }
      }
    }
    return false;
  }

  /// By the definition. If all vertices are behind or on all planes, then six times the signed
  /// volume, seen from a vertex, is a sum of products of areas and distances from planes: positive
  /// if one vertex is behind one plane, and zero if the component is flat.
  bool has_all_vertices_behind(const std::vector<std::uint32_t>& parts,
                               const std::vector<VertexId>& vertices) const {
    std::vector<std::uint32_t> by_plane = parts;
    const auto plane_of_part = [&](std::uint32_t index) {
      return std::pair(scene_.parts[index].plane, scene_.parts[index].flipped);
    };
    std::ranges::sort(by_plane, {}, plane_of_part);
    by_plane.erase(std::unique(by_plane.begin(), by_plane.end(),
                               [&](std::uint32_t a, std::uint32_t b) {
                                 return plane_of_part(a) == plane_of_part(b);
                               }),
                   by_plane.end());
    bool has_volume = false;
    for (const std::uint32_t index : by_plane) {
      const Part& part = scene_.parts[index];
      const OrientedPlane own = plane_of(part);
      const auto loop = scene_.loop(part);
      for (const VertexId vertex : vertices) {
        if (std::find(loop.begin(), loop.end(), vertex) != loop.end()) continue;  // on it
        const int side = own.side(vertex);
        if (side > 0) return false;
        has_volume = has_volume || side < 0;
      }
    }
    return has_volume;
  }

  template <class T>
  static void sort_and_drop_repeated(std::vector<T>& all) {
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
  }

  const PreparedScene& scene_;
  const EdgeUsers& users_;
  const std::vector<std::uint32_t>& component_of_;
};

}  // namespace gnomon::joined_parts

#endif  // GNOMON_ALGORITHMS_FACING_CHAIN_JOINED_PARTS_H
