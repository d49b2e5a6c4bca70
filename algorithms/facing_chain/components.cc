// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/algorithms/components.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "algorithms/facing_chain/edge_ring.h"
#include "scene/geometry/joined_sets.h"
#include "scene/geometry/loop_geometry.h"

namespace gnomon {

namespace {

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
/// lies: by long doubles with a bound, and where that does not suffice by integers.
class OrientedPlane {
 public:
  OrientedPlane(const GridPositions& grid, SupportTriple triple, bool flipped)
      : grid_(grid), triple_(triple), sign_(flipped ? -1 : 1) {
    if (!grid.is_narrow()) return;
    const auto along = difference(triple.b), across = difference(triple.c);
    for (int k = 0; k < 3; ++k) {
      const int u = (k + 1) % 3, v = (k + 2) % 3;
      normal_[k] = along[u] * across[v] - along[v] * across[u];
    }
    // With s and t the largest components of the two edges and r that of a vertex's difference, all
    // of them exact: a component of the normal is off by at most 4 u s t for u = 2^-64, and below
    // 2 s t; three products with r, two sums: below 3 r (4 u s t) + 5 u (6 r s t) < 2^6 u r s t.
    error_bound_ = 0x1p-58L * largest(along) * largest(across);
  }

  int side(VertexId vertex) const {
    if (grid_.is_narrow()) {
      const auto d = difference(vertex);
      const long double value = normal_[0] * d[0] + normal_[1] * d[1] + normal_[2] * d[2];
      if (std::abs(value) > error_bound_ * largest(d)) return value > 0 ? sign_ : -sign_;
    }
    const Vector from = point<mpz_class>(grid_, triple_.a);
    const Vector normal =
        cross(point<mpz_class>(grid_, triple_.b) - from, point<mpz_class>(grid_, triple_.c) - from);
    return sign_ * sgn(dot(normal, point<mpz_class>(grid_, vertex) - from));
  }

 private:
  using Difference = std::array<long double, 3>;

  Difference difference(VertexId vertex) const {
    Difference result;
    for (int k = 0; k < 3; ++k) {
      result[k] = static_cast<long double>(grid_.narrow(vertex, k) - grid_.narrow(triple_.a, k));
    }
    return result;
  }
  static long double largest(const Difference& d) {
    return std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])});
  }

  const GridPositions& grid_;
  SupportTriple triple_;
  int sign_;
  Difference normal_{};
  long double error_bound_ = 0;
};

/// Which parts make one component.
scene_detail::JoinedSets joined_parts(const PreparedScene& scene, const EdgeUsers& users) {
  scene_detail::JoinedSets sets(scene.parts.size());
  for (EdgeId edge = 0; edge < scene.geometry.edges.size(); ++edge) {
    const auto around = users.of(edge);
    if (around.size() == 2) {
      sets.join(around[0].part, around[1].part);
    } else if (around.size() > 2) {
      for (const auto& [i, j] :
           pairs_around(scene.geometry.grid, scene.geometry.edges[edge], around)) {
        sets.join(around[i].part, around[j].part);
      }
    }
  }
  return sets;
}

class ConvexityTest {
 public:
  ConvexityTest(const PreparedScene& scene, const EdgeUsers& users,
                const std::vector<std::uint32_t>& component_of)
      : scene_(scene), users_(users), component_of_(component_of) {}

  /// Requires: the component is closed.
  bool is_convex(const Component& component) const {
    // Nearly all that are not convex have a reflex edge, and that takes no time.
    for (const std::uint32_t part : component.parts) {
      if (has_reflex_edge(part)) return false;
    }
    return has_all_vertices_behind(component);
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
  bool has_all_vertices_behind(const Component& component) const {
    std::vector<std::pair<PlaneId, bool>> planes;
    std::vector<VertexId> vertices;
    for (const std::uint32_t index : component.parts) {
      const Part& part = scene_.parts[index];
      planes.emplace_back(part.plane, part.flipped);
      const auto loop = scene_.loop(part);
      vertices.insert(vertices.end(), loop.begin(), loop.end());
    }
    sort_and_drop_repeated(planes);
    sort_and_drop_repeated(vertices);
    bool has_volume = false;
    for (const auto& [plane, flipped] : planes) {
      const OrientedPlane own(scene_.geometry.grid, scene_.geometry.planes[plane], flipped);
      for (const VertexId vertex : vertices) {
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

/// The first edge of the component along which its parts do not run equally often each way, and
/// there the first part that runs the way of most.
void find_unpaired(const PreparedScene& scene, const EdgeUsers& users,
                   const std::vector<std::uint32_t>& component_of, Component& component) {
  component.is_closed = true;
  for (const std::uint32_t index : component.parts) {
    for (const PlaneRef edge : scene.edges(scene.parts[index])) {
      int sum = 0;
      for (const EdgePart& user : users.of(edge.index())) {
        if (component_of[user.part] != component_of[index]) continue;
        sum += user.flipped == edge.flipped() ? 1 : -1;
      }
      if (sum <= 0) continue;
      component.is_closed = false;
      component.unpaired = {edge.index(), index};
      return;
    }
  }
}

std::string position_text(const Geometry& geometry, VertexId vertex) {
  std::string text;
  for (const double coordinate : geometry.positions[vertex]) {
    char digits[32];
    text += text.empty() ? '(' : ',';
    text.append(digits, std::to_chars(digits, digits + sizeof digits, coordinate).ptr);
  }
  return text + ')';
}

}  // namespace

std::vector<Component> find_components(const PreparedScene& scene) {
  const EdgeUsers users(scene);
  scene_detail::JoinedSets sets = joined_parts(scene, users);
  std::vector<Component> components;
  std::vector<std::uint32_t> component_of(scene.parts.size());
  for (std::uint32_t i = 0; i < scene.parts.size(); ++i) {
    const std::uint32_t first = sets.first(i);
    if (first == i) {
      component_of[i] = static_cast<std::uint32_t>(components.size());
      components.emplace_back();
    } else {
      component_of[i] = component_of[first];
    }
    components[component_of[i]].parts.push_back(i);
  }
  const ConvexityTest test(scene, users, component_of);
  for (Component& component : components) {
    find_unpaired(scene, users, component_of, component);
    component.is_convex = component.is_closed && test.is_convex(component);
  }
  return components;
}

std::string unpaired_edge_text(const Scene& scene, const PreparedScene& prepared,
                               const UnpairedEdge& unpaired) {
  const EdgeEnds ends = prepared.geometry.edges[unpaired.edge];
  return "edge " + position_text(prepared.geometry, ends.a) + "-" +
         position_text(prepared.geometry, ends.b) + " of polygon " +
         scene.polygons[prepared.parts[unpaired.part].polygon].id + " has no partner";
}

}  // namespace gnomon
