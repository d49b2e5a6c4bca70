// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/angular_table/polygon_contact.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "scene/base/vectors.h"

namespace gnomon {

namespace {

DirectionVector position(const PreparedScene& scene, VertexId v) {
  const GridPositions& grid = scene.geometry.grid;
  return {grid.at(v, 0), grid.at(v, 1), grid.at(v, 2)};
}

/// Outwards from the part's front.
DirectionVector normal_of(const PreparedScene& scene, const Part& part) {
  const SupportTriple& triple = scene.geometry.planes[part.plane];
  const DirectionVector a = position(scene, triple.a);
  DirectionVector n =
      cross(minus(position(scene, triple.b), a), minus(position(scene, triple.c), a));
  if (part.flipped) {
    for (mpz_class& c : n) c = -c;
  }
  return n;
}

std::vector<DirectionVector> corners_of(const PreparedScene& scene, const Part& part) {
  std::vector<DirectionVector> corners;
  for (const VertexId v : scene.loop(part)) corners.push_back(position(scene, v));
  return corners;
}

/// Across the edges of a part in its plane, inwards: the value is positive inside.
struct InwardEdges {
  InwardEdges(const PreparedScene& scene, const Part& part) : corners(corners_of(scene, part)) {
    const DirectionVector n = normal_of(scene, part);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const DirectionVector& to = corners[i + 1 == corners.size() ? 0 : i + 1];
      inwards.push_back(cross(n, minus(to, corners[i])));
    }
  }
  mpz_class value(std::size_t edge, const DirectionVector& x) const {
    return dot(inwards[edge], minus(x, corners[edge]));
  }
  std::vector<DirectionVector> corners, inwards;
};

bool has_all_outside(const InwardEdges& edges, const std::vector<DirectionVector>& other) {
  for (std::size_t k = 0; k < edges.corners.size(); ++k) {
    if (std::ranges::all_of(other, [&](const auto& x) { return edges.value(k, x) <= 0; })) {
      return true;
    }
  }
  return false;
}

/// A point x / w.
struct Homogeneous {
  DirectionVector x;
  mpz_class w;
};

/// Does the segment between two points of the part's plane meet the part's inside?
bool meets_inside(const InwardEdges& edges, const Homogeneous& first, const Homogeneous& second) {
  // The segment is first + l (second - first); lower and upper bound of l, open where an edge set
  // them.
  mpq_class low = 0, high = 1;
  bool low_open = false, high_open = false;
  const auto value = [&](std::size_t k, const Homogeneous& point) {
    mpq_class result(
        dot(edges.inwards[k], point.x) - point.w * dot(edges.inwards[k], edges.corners[k]),
        point.w);
    result.canonicalize();
    return result;
  };
  for (std::size_t k = 0; k < edges.corners.size(); ++k) {
    const mpq_class at_first = value(k, first), at_second = value(k, second);
    if (at_first <= 0 && at_second <= 0) return false;
    if (at_first > 0 && at_second > 0) continue;
    const mpq_class at = at_first / (at_first - at_second);
    if (at_first <= 0 && at >= low) {
      low = at;
      low_open = true;
    } else if (at_first > 0 && at <= high) {
      high = at;
      high_open = true;
    }
  }
  return low < high || (low == high && !low_open && !high_open);
}

}  // namespace

bool overlap_in_plane(const PreparedScene& scene, const Part& first, const Part& second) {
  const InwardEdges a(scene, first), b(scene, second);
  return !has_all_outside(a, b.corners) && !has_all_outside(b, a.corners);
}

bool comes_behind(const PreparedScene& scene, const Part& part, const Part& face) {
  if (part.plane == face.plane) return false;
  const DirectionVector n = normal_of(scene, face);
  const DirectionVector base = position(scene, scene.geometry.planes[face.plane].a);
  const std::vector<DirectionVector> corners = corners_of(scene, part);
  std::vector<mpz_class> sides;
  for (const DirectionVector& x : corners) sides.push_back(dot(n, minus(x, base)));
  const auto is_behind = [](const mpz_class& side) { return side < 0; };
  const auto is_not_in_front = [](const mpz_class& side) { return side <= 0; };
  if (std::ranges::none_of(sides, is_behind) || std::ranges::all_of(sides, is_behind)) return false;
  // Where the part's border meets the face's plane: its corners there, and cuts of its edges.
  std::vector<Homogeneous> meets;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::size_t j = i + 1 == corners.size() ? 0 : i + 1;
    if (sides[i] == 0) meets.push_back({corners[i], 1});
    if (is_not_in_front(sides[i]) == is_not_in_front(sides[j]) || sides[i] == 0 || sides[j] == 0) {
      continue;
    }
    const mpz_class of_i = abs(sides[j]), of_j = abs(sides[i]);
    Homogeneous cut{{}, of_i + of_j};
    for (std::size_t k = 0; k < 3; ++k) cut.x[k] = of_i * corners[i][k] + of_j * corners[j][k];
    meets.push_back(std::move(cut));
  }
  if (meets.empty()) return false;
  return meets_inside(InwardEdges(scene, face), meets.front(), meets.back());
}

bool is_on_part(const PreparedScene& scene, const Part& part, const DirectionVector& point) {
  const InwardEdges edges(scene, part);
  const auto from = [&](const DirectionVector& x) {
    DirectionVector way;
    for (std::size_t k = 0; k < 3; ++k) way[k] = point[k] - 3 * x[k];
    return way;
  };
  if (dot(normal_of(scene, part), from(edges.corners.front())) != 0) return false;
  for (std::size_t k = 0; k < edges.corners.size(); ++k) {
    if (dot(edges.inwards[k], from(edges.corners[k])) < 0) return false;
  }
  return true;
}

namespace {

/// The crossings of the ray from a point, each +1 where it comes out of a front and -1 where it
/// goes into one; none if it meets the border of a part.
std::optional<int> crossings_of_ray(const PreparedScene& scene,
                                    std::span<const std::uint32_t> parts,
                                    const DirectionVector& point, const DirectionVector& along) {
  int sum = 0;
  for (const std::uint32_t p : parts) {
    const Part& part = scene.parts[p];
    const DirectionVector n = normal_of(scene, part);
    const int turn = sgn(dot(n, along));
    const auto from_point = [&](const DirectionVector& x) {
      DirectionVector way;
      for (std::size_t k = 0; k < 3; ++k) way[k] = 3 * x[k] - point[k];
      return way;
    };
    const std::vector<DirectionVector> corners = corners_of(scene, part);
    const int ahead = sgn(dot(n, from_point(corners.front())));
    if (turn == 0) {
      if (ahead == 0) return std::nullopt;
      continue;
    }
    if (ahead * turn <= 0) continue;
    bool inside = true;
    for (std::size_t i = 0; i < corners.size() && inside; ++i) {
      const DirectionVector a = from_point(corners[i]);
      const DirectionVector b = from_point(corners[i + 1 == corners.size() ? 0 : i + 1]);
      const int side = sgn(dot(cross(a, b), along)) * turn;
      if (side == 0) return std::nullopt;
      inside = side > 0;
    }
    if (inside) sum += turn;
  }
  return sum;
}

}  // namespace

int winding_number(const PreparedScene& scene, std::span<const std::uint32_t> parts,
                   const DirectionVector& point) {
  // A plane holds at most two of these directions, so that one of them meets no edge.
  for (long k = 1;; ++k) {
    const DirectionVector along{1, k, mpz_class(k) * k};
    if (const auto sum = crossings_of_ray(scene, parts, point, along)) return *sum;
  }
}

WindingBeside winding_beside(const PreparedScene& scene, std::span<const std::uint32_t> parts,
                             const Part& part) {
  // The middle of its first three corners is inside of a convex part; the part itself, which holds
  // the point, is no crossing.
  const std::vector<DirectionVector> corners = corners_of(scene, part);
  DirectionVector point;
  for (std::size_t k = 0; k < 3; ++k) point[k] = corners[0][k] + corners[1][k] + corners[2][k];
  const DirectionVector n = normal_of(scene, part);
  for (long k = 1;; ++k) {
    const DirectionVector along{1, k, mpz_class(k) * k};
    const auto sum = crossings_of_ray(scene, parts, point, along);
    if (sum) return {*sum, dot(n, along) > 0};
  }
}

int sign_of_volume(const PreparedScene& scene, std::span<const std::uint32_t> parts) {
  mpz_class volume = 0;
  for (const std::uint32_t p : parts) {
    const std::vector<DirectionVector> corners = corners_of(scene, scene.parts[p]);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
      volume += dot(cross(corners[0], corners[i]), corners[i + 1]);
    }
  }
  return sgn(volume);
}

}  // namespace gnomon
