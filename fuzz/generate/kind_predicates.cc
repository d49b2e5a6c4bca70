// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/generate/kind_predicates.h"

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "fuzz/scene/scene_coordinates.h"

namespace gnomon::fuzz {
namespace {

using Z3 = std::array<mpz_class, 3>;
using Loop = std::vector<Z3>;

Z3 minus(const Z3& a, const Z3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Z3 cross(const Z3& a, const Z3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
mpz_class dot(const Z3& a, const Z3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
bool is_zero(const Z3& a) { return a[0] == 0 && a[1] == 0 && a[2] == 0; }
mpz_class square(const Z3& a) { return dot(a, a); }

/// The largest extent along an axis.
mpz_class extent_of(const Loop& points) {
  mpz_class extent = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [low, high] = std::minmax_element(
        points.begin(), points.end(), [k](const Z3& a, const Z3& b) { return a[k] < b[k]; });
    const mpz_class size = (*high)[k] - (*low)[k];
    if (size > extent) extent = size;
  }
  return extent;
}

mpz_class largest(const Z3& a) {
  const mpz_class x = abs(a[0]), y = abs(a[1]), z = abs(a[2]);
  return std::max({x, y, z});
}

struct Face {
  Loop loop;
  Z3 normal;            // its area vector, twice
  bool planar = true;   // exactly
  bool convex = false;  // and planar, without holes

  const Z3& corner(std::size_t i) const { return loop[i % loop.size()]; }
  /// Positive in front of the plane.
  int side(const Z3& p) const { return sgn(dot(normal, minus(p, loop[0]))); }
  /// Of a point in the plane: 1 in the interior, 0 on the border, -1 outside. Requires: convex.
  int within(const Z3& p) const {
    int least = 1;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Z3 edge = minus(corner(i + 1), loop[i]);
      least = std::min(least, sgn(dot(normal, cross(edge, minus(p, loop[i])))));
    }
    return least;
  }
  bool holds_inside(const Z3& p) const { return convex && side(p) == 0 && within(p) > 0; }
  bool coplanar_with(const Face& other) const {
    return planar && other.planar &&
           std::ranges::all_of(other.loop, [&](const Z3& p) { return side(p) == 0; });
  }
};

Face face_of(Loop loop, bool holes) {
  Face face;
  face.loop = std::move(loop);
  for (std::size_t i = 1; i + 1 < face.loop.size(); ++i) {
    const Z3 n = cross(minus(face.loop[i], face.loop[0]), minus(face.loop[i + 1], face.loop[0]));
    for (std::size_t k = 0; k < 3; ++k) face.normal[k] += n[k];
  }
  face.planar = std::ranges::all_of(face.loop, [&](const Z3& p) { return face.side(p) == 0; });
  // Every corner on the inner side of every edge: convex, if it does not run round twice.
  face.convex = face.planar && !holes && !is_zero(face.normal) &&
                std::ranges::all_of(face.loop, [&](const Z3& p) { return face.within(p) >= 0; });
  return face;
}

/// Convex coplanar faces: no edge line of either has the other on its outer side.
bool overlap(const Face& a, const Face& b) {
  if (!a.convex || !b.convex || !a.coplanar_with(b)) return false;
  const auto separates = [](const Face& by, const Face& other) {
    for (std::size_t i = 0; i < by.loop.size(); ++i) {
      const Z3 edge = minus(by.corner(i + 1), by.loop[i]);
      if (std::ranges::all_of(other.loop, [&](const Z3& p) {
            return sgn(dot(by.normal, cross(edge, minus(p, by.loop[i])))) <= 0;
          })) {
        return true;
      }
    }
    return false;
  };
  return !separates(a, b) && !separates(b, a);
}

bool same_corners(const Face& a, const Face& b) {
  return a.loop.size() == b.loop.size() &&
         std::is_permutation(a.loop.begin(), a.loop.end(), b.loop.begin());
}

bool collinear(const Z3& a, const Z3& b, const Z3& c) {
  return is_zero(cross(minus(b, a), minus(c, a)));
}
/// Strictly between a and b.
bool inside_edge(const Z3& p, const Z3& a, const Z3& b) {
  if (!collinear(a, b, p)) return false;
  return sgn(dot(minus(p, a), minus(b, p))) > 0;
}
/// Edges on one line with a part in common, but not both ends.
bool edges_overlap(const Z3& a, const Z3& b, const Z3& c, const Z3& d) {
  if (!collinear(a, b, c) || !collinear(a, b, d)) return false;
  const bool same = (a == c && b == d) || (a == d && b == c);
  return !same && (inside_edge(c, a, b) || inside_edge(d, a, b) || inside_edge(a, c, d) ||
                   inside_edge(b, c, d));
}

/// An edge of `a` goes through the interior of `b`.
bool pierces(const Face& a, const Face& b) {
  if (!b.convex) return false;
  for (std::size_t i = 0; i < a.loop.size(); ++i) {
    const Z3 &p = a.loop[i], &q = a.corner(i + 1);
    const int side = b.side(p);
    if (side == 0 || b.side(q) != -side) continue;
    bool through = true;
    for (std::size_t k = 0; k < b.loop.size() && through; ++k) {
      const Z3 n = cross(minus(b.loop[k], p), minus(b.corner(k + 1), p));
      const int turn = sgn(dot(n, minus(q, p)));
      through = turn == -side;
    }
    if (through) return true;
  }
  return false;
}

/// Longest edge squared over area vector squared: the aspect of what has nearly no width.
bool is_thin(const Face& face, bool needle) {
  mpz_class shortest = -1, longest = 0;
  for (std::size_t i = 0; i < face.loop.size(); ++i) {
    const mpz_class length = square(minus(face.corner(i + 1), face.loop[i]));
    if (shortest < 0 || length < shortest) shortest = length;
    if (length > longest) longest = length;
  }
  static const mpz_class kAspectSquared("1000000000000");
  if (square(face.normal) * kAspectSquared >= longest * longest) return false;
  return needle ? shortest * kAspectSquared < longest : shortest * 10000 > longest;
}

/// Distance from p to the face, squared and divided by the face's extent squared, is less than
/// 2^-56, and not 0.
bool is_near(const Face& face, const Z3& p) {
  const mpz_class extent = extent_of(face.loop), reach = extent * extent;
  const auto small = [&](const mpz_class& numerator, const mpz_class& denominator) {
    return (numerator << 56) < reach * denominator;
  };
  if (face.convex && face.side(p) == 0 && face.within(p) >= 0) return false;
  for (std::size_t i = 0; i < face.loop.size(); ++i) {
    const Z3 &a = face.loop[i], edge = minus(face.corner(i + 1), a), d = minus(p, a);
    if (small(square(d), 1)) return true;
    const mpz_class along = dot(d, edge), length = square(edge);
    if (along > 0 && along < length && small(square(cross(d, edge)), length)) return true;
  }
  if (!face.convex || face.within(p) <= 0) return false;
  const mpz_class height = dot(face.normal, minus(p, face.loop[0]));
  return small(height * height, square(face.normal));
}

/// A light that is a point, in the finite (weight 1) or not (0).
struct Apex {
  Z3 p;
  int weight = 1;

  Z3 from(const Z3& v) const { return weight == 1 ? minus(p, v) : p; }
  int side(const Face& face) const { return sgn(dot(face.normal, from(face.loop[0]))); }
  /// The plane through the apex and two points; positive values on one side.
  Z3 plane(const Z3& a, const Z3& b) const { return cross(from(a), minus(b, a)); }
};

/// c is exactly in front of or behind the inside of the edge from a to b.
bool on_shadow_edge(const Apex& apex, const Z3& a, const Z3& b, const Z3& c) {
  const Z3 m = apex.plane(a, b);
  if (is_zero(m) || sgn(dot(m, minus(c, a))) != 0) return false;
  const Z3 qa = apex.from(a), qb = apex.from(b), qc = apex.from(c);
  if (apex.weight == 1) {
    const Z3 n = cross(qa, qb);
    return sgn(dot(n, cross(qa, qc))) > 0 && sgn(dot(n, cross(qc, qb))) > 0 && !collinear(a, b, c);
  }
  const Z3 ac = cross(apex.p, minus(c, a)), cb = cross(apex.p, minus(b, c));
  return sgn(dot(m, ac)) > 0 && sgn(dot(m, cb)) > 0 && !collinear(a, b, c);
}

bool on_shadow_vertex(const Apex& apex, const Z3& a, const Z3& c) {
  if (a == c) return false;
  if (apex.weight == 0) return is_zero(cross(apex.p, minus(c, a)));
  const Z3 qa = apex.from(a), qc = apex.from(c);
  return !is_zero(qa) && !is_zero(qc) && is_zero(cross(qa, qc)) && sgn(dot(qa, qc)) > 0;
}

/// Where edges of a and b cross as seen from the apex: 1 if a is nearer to it there, -1 if b is, 0
/// if none cross with one strictly nearer.
int nearer(const Apex& apex, const Face& a, const Face& b) {
  for (std::size_t i = 0; i < a.loop.size(); ++i) {
    for (std::size_t k = 0; k < b.loop.size(); ++k) {
      const Z3 &p = a.loop[i], &q = a.corner(i + 1), &r = b.loop[k], &s = b.corner(k + 1);
      const Z3 pq = apex.plane(p, q), rs = apex.plane(r, s);
      const int r_side = sgn(dot(pq, minus(r, p))), s_side = sgn(dot(pq, minus(s, p)));
      const int p_side = sgn(dot(rs, minus(p, r))), q_side = sgn(dot(rs, minus(q, r)));
      if (r_side * s_side >= 0 || p_side * q_side >= 0) continue;
      if (apex.weight == 1) {
        // Both cross; on the same side of the apex?
        Z3 middle_a, middle_b;
        const mpz_class wp = abs(dot(rs, minus(q, r))), wq = abs(dot(rs, minus(p, r)));
        const mpz_class wr = abs(dot(pq, minus(s, p))), ws = abs(dot(pq, minus(r, p)));
        for (std::size_t c = 0; c < 3; ++c) {
          middle_a[c] = (wp * apex.from(p)[c] + wq * apex.from(q)[c]) * (wr + ws);
          middle_b[c] = (wr * apex.from(r)[c] + ws * apex.from(s)[c]) * (wp + wq);
        }
        if (sgn(dot(middle_a, middle_b)) <= 0) continue;
        const int order = cmp(square(middle_a), square(middle_b));
        if (order != 0) return order < 0 ? 1 : -1;
        continue;
      }
      Z3 middle;
      const mpz_class wp = abs(dot(rs, minus(q, r))), wq = abs(dot(rs, minus(p, r)));
      const mpz_class wr = abs(dot(pq, minus(s, p))), ws = abs(dot(pq, minus(r, p)));
      for (std::size_t c = 0; c < 3; ++c) {
        middle[c] = (wp * p[c] + wq * q[c]) * (wr + ws) - (wr * r[c] + ws * s[c]) * (wp + wq);
      }
      const int order = sgn(dot(middle, apex.p));
      if (order != 0) return order;
    }
  }
  return 0;
}

/// Six faces that are the sides of their common box, in any order.
bool is_box(std::span<const Face> faces, Z3& low, Z3& high) {
  Loop all;
  for (const Face& face : faces) {
    if (face.loop.size() != 4) return false;
    all.insert(all.end(), face.loop.begin(), face.loop.end());
  }
  low = high = all[0];
  for (const Z3& p : all) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (p[k] < low[k]) low[k] = p[k];
      if (p[k] > high[k]) high[k] = p[k];
    }
  }
  unsigned seen = 0;
  for (const Face& face : faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      for (const bool top : {false, true}) {
        const Z3& at = top ? high : low;
        const bool here =
            std::ranges::all_of(face.loop, [&](const Z3& p) { return p[k] == at[k]; });
        if (here) seen |= 1u << (2 * k + (top ? 1 : 0));
      }
    }
  }
  return seen == 63;
}

bool differ_by_one_ulp(const Position& a, const Position& b) {
  int ulps = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = a[k].nearest(), y = b[k].nearest();
    if (x == y) continue;
    if (std::nextafter(x, y) != y) return false;
    ++ulps;
  }
  return ulps == 1;
}

}  // namespace

struct KindChecker::View {
  const Scene& scene;
  std::vector<Face> faces;
  std::vector<Face> panels;
  std::vector<Apex> apexes;
  mpz_class extent;  // of all polygons
  Loop corners;      // of all polygons

  explicit View(const Scene& of) : scene(of) {
    std::vector<const Number*> numbers;
    const auto add = [&](const Position& position) {
      for (const Number& number : position) numbers.push_back(&number);
    };
    for (const Polygon& polygon : of.polygons) {
      for (const VertexId v : polygon.loop) add(of.vertices[v]);
    }
    for (const Light& light : of.lights) {
      if (light.type == LightType::kPoint) add(light.position);
      for (const Position& corner : light.loop) add(corner);
    }
    const GridValues grid = on_grid(numbers, of.numbers);
    std::size_t next = 0;
    const auto take = [&]() -> Z3 {
      next += 3;
      return {grid.values[next - 3], grid.values[next - 2], grid.values[next - 1]};
    };
    for (const Polygon& polygon : of.polygons) {
      Loop loop;
      for (std::size_t i = 0; i < polygon.loop.size(); ++i) loop.push_back(take());
      corners.insert(corners.end(), loop.begin(), loop.end());
      faces.push_back(face_of(std::move(loop), !polygon.holes.empty()));
    }
    for (const Light& light : of.lights) {
      if (light.type == LightType::kPoint) apexes.push_back({take(), 1});
      if (light.type == LightType::kArea) {
        Loop loop;
        for (std::size_t i = 0; i < light.loop.size(); ++i) loop.push_back(take());
        panels.push_back(face_of(std::move(loop), false));
      }
    }
    for (const Light& light : of.lights) {
      if (light.type != LightType::kDirectional) continue;
      const std::array<const Number*, 3> direction = {&light.position[0], &light.position[1],
                                                      &light.position[2]};
      const GridValues own = on_grid(direction, of.numbers);
      apexes.push_back({{own.values[0], own.values[1], own.values[2]}, 0});
    }
    if (!corners.empty()) extent = extent_of(corners);
  }

  template <class Test>
  bool any_face(const Test& test) const {
    return std::ranges::any_of(faces, test);
  }
  /// Of two different polygons, in both orders.
  template <class Test>
  bool any_pair(const Test& test) const {
    for (std::size_t i = 0; i < faces.size(); ++i) {
      for (std::size_t k = 0; k < faces.size(); ++k) {
        if (i != k && test(faces[i], faces[k])) return true;
      }
    }
    return false;
  }
  template <class Test>
  bool any_apex(int weight, const Test& test) const {
    return std::ranges::any_of(apexes, [&](const Apex& apex) {
      return apex.weight == weight &&
             std::ranges::any_of(faces, [&](const Face& face) { return test(apex, face); });
    });
  }
  /// Of an area light and a polygon.
  template <class Test>
  bool any_panel(const Test& test) const {
    for (const Face& panel : panels) {
      for (const Face& face : faces) {
        if (test(panel, face)) return true;
      }
    }
    return false;
  }
  template <class Test>
  static bool any_corner(const Face& face, const Test& test) {
    return std::ranges::any_of(face.loop, test);
  }
  template <class Test>
  static bool any_edge(const Face& face, const Test& test) {
    for (std::size_t i = 0; i < face.loop.size(); ++i) {
      if (test(face.loop[i], face.corner(i + 1))) return true;
    }
    return false;
  }
  template <class Test>
  static bool any_edges(const Face& a, const Face& b, const Test& test) {
    return any_edge(a, [&](const Z3& p, const Z3& q) {
      return any_edge(b, [&](const Z3& r, const Z3& s) { return test(p, q, r, s); });
    });
  }
  static bool share_edge(const Face& a, const Face& b) {
    return any_edges(a, b, [](const Z3& p, const Z3& q, const Z3& r, const Z3& s) {
      return (p == r && q == s) || (p == s && q == r);
    });
  }
  static bool share_vertex(const Face& a, const Face& b) {
    return any_corner(a, [&](const Z3& p) { return std::ranges::find(b.loop, p) != b.loop.end(); });
  }
  static bool share_part_of_edge(const Face& a, const Face& b) {
    return any_edges(a, b, edges_overlap);
  }
  /// A vertex of a in the interior of b, of which a is not coplanar.
  static bool vertex_in_face(const Face& a, const Face& b) {
    return !b.coplanar_with(a) && any_corner(a, [&](const Z3& p) { return b.holds_inside(p); });
  }
  /// The angle of a direction with a face's plane is not 0 and less than 2^-28.
  static bool grazes(const Face& face, const Z3& direction) {
    const mpz_class height = dot(face.normal, direction);
    return height != 0 && (height * height << 56) < square(face.normal) * square(direction);
  }

  bool nested_boxes() const {
    std::vector<std::array<Z3, 2>> boxes;
    for (std::size_t i = 0; i + 6 <= faces.size(); ++i) {
      std::array<Z3, 2> box;
      if (is_box(std::span(faces).subspan(i, 6), box[0], box[1])) boxes.push_back(box);
    }
    for (const auto& outer : boxes) {
      for (const auto& inner : boxes) {
        bool inside = true;
        for (std::size_t k = 0; k < 3; ++k) {
          inside = inside && outer[0][k] < inner[0][k] && inner[1][k] < outer[1][k];
        }
        if (inside) return true;
      }
    }
    return false;
  }

  bool cyclic_overlap() const {
    for (const Apex& apex : apexes) {
      const std::size_t n = faces.size();
      std::vector<bool> before(n * n);
      for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < i; ++k) {
          const int order = nearer(apex, faces[i], faces[k]);
          before[i * n + k] = order > 0;
          before[k * n + i] = order < 0;
        }
      }
      for (std::size_t by = 0; by < n; ++by) {
        for (std::size_t i = 0; i < n; ++i) {
          for (std::size_t k = 0; k < n; ++k) {
            if (before[i * n + by] && before[by * n + k]) before[i * n + k] = true;
          }
        }
      }
      for (std::size_t i = 0; i < n; ++i) {
        if (before[i * n + i]) return true;
      }
    }
    return false;
  }

  /// Binary exponents of the smallest and largest magnitudes that are not 0.
  std::optional<std::array<long, 2>> magnitudes(bool lights) const {
    std::optional<std::array<long, 2>> range;
    const auto add = [&](const Position& position) {
      for (const Number& number : position) {
        if (number.is_zero()) continue;
        const mpq_class value = number.exact();
        const long exponent = static_cast<long>(mpz_sizeinbase(value.get_num_mpz_t(), 2)) -
                              static_cast<long>(mpz_sizeinbase(value.get_den_mpz_t(), 2));
        if (!range) range = {exponent, exponent};
        (*range)[0] = std::min((*range)[0], exponent);
        (*range)[1] = std::max((*range)[1], exponent);
      }
    };
    for (const Polygon& polygon : scene.polygons) {
      for (const VertexId v : polygon.loop) add(scene.vertices[v]);
    }
    for (const Light& light : scene.lights) {
      if (!lights) break;
      if (light.type == LightType::kPoint) add(light.position);
      for (const Position& corner : light.loop) add(corner);
    }
    return range;
  }

  bool nextafter() const {
    if (scene.numbers == NumberMeaning::kDecimal) return false;
    std::vector<const Position*> points;
    for (const Polygon& polygon : scene.polygons) {
      for (const VertexId v : polygon.loop) points.push_back(&scene.vertices[v]);
    }
    for (const Light& light : scene.lights) {
      if (light.type == LightType::kPoint) points.push_back(&light.position);
      for (const Position& corner : light.loop) points.push_back(&corner);
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        if (differ_by_one_ulp(*points[i], *points[k])) return true;
      }
    }
    return false;
  }

  bool holds(Kind kind) const;
};

bool KindChecker::View::holds(Kind kind) const {
  switch (kind) {
    case Kind::kSoupUniform:
    case Kind::kSoupClustered:
    case Kind::kSoupLattice:
    case Kind::kScene:
    case Kind::kFile:
    case Kind::kFirstFamily:
      return true;
    case Kind::kSoupMixedSizes: {
      mpz_class least = -1, most = 0;
      for (const Face& face : faces) {
        const mpz_class size = extent_of(face.loop);
        if (least < 0 || size < least) least = size;
        if (size > most) most = size;
      }
      return (least << 16) < most;
    }
    case Kind::kOneSided:
    case Kind::kTwoSided:
      return std::ranges::all_of(scene.polygons, [&](const Polygon& polygon) {
        return scene.is_two_sided(polygon) == (kind == Kind::kTwoSided);
      });
    case Kind::kNonConvex: {
      for (std::size_t i = 0; i < faces.size(); ++i) {
        if (scene.polygons[i].holes.empty() && faces[i].planar && !faces[i].convex) return true;
      }
      return false;
    }
    case Kind::kHoles:
      return std::ranges::any_of(scene.polygons,
                                 [](const Polygon& polygon) { return !polygon.holes.empty(); });
    case Kind::kAlmostPlanar:
      return any_face([](const Face& face) { return !face.planar; });
    case Kind::kSliver:
    case Kind::kNeedle:
      return any_face([&](const Face& face) { return is_thin(face, kind == Kind::kNeedle); });
    case Kind::kCoplanar:
      return any_pair([](const Face& a, const Face& b) { return a.coplanar_with(b); });
    case Kind::kOverlap:
      return any_pair(overlap);
    case Kind::kDuplicate:
      return any_pair(same_corners);
    case Kind::kBackToBack:
      return any_pair([](const Face& a, const Face& b) {
        return sgn(dot(a.normal, b.normal)) < 0 && overlap(a, b);
      });
    case Kind::kSharedEdge:
      return any_pair(share_edge);
    case Kind::kSharedVertex:
      return any_pair(share_vertex);
    case Kind::kTJunction:
      return any_pair([](const Face& a, const Face& b) {
        return any_corner(a, [&](const Z3& p) {
          return any_edge(b, [&](const Z3& r, const Z3& s) { return inside_edge(p, r, s); });
        });
      });
    case Kind::kEdgeOverlap:
      return any_pair(share_part_of_edge);
    case Kind::kVertexInFace:
      return any_pair(vertex_in_face);
    case Kind::kEdgeInFace:
      return any_pair([](const Face& a, const Face& b) {
        return !b.coplanar_with(a) && any_edge(a, [&](const Z3& p, const Z3& q) {
          return b.holds_inside(p) && b.holds_inside(q);
        });
      });
    case Kind::kCrossing:
      return any_pair(pierces);
    case Kind::kNestedBoxes:
      return nested_boxes();
    case Kind::kNextafter:
      return nextafter();
    case Kind::kNearParallel:
      return any_pair([](const Face& a, const Face& b) {
        const mpz_class sine = square(cross(a.normal, b.normal));
        return sine != 0 && (sine << 56) < square(a.normal) * square(b.normal);
      });
    case Kind::kLightInPlane:
    case Kind::kSunInPlane:
      return any_apex(kind == Kind::kLightInPlane ? 1 : 0, [](const Apex& apex, const Face& face) {
        return face.planar && apex.side(face) == 0;
      });
    case Kind::kLightOnFace:
      return any_apex(1,
                      [](const Apex& apex, const Face& face) { return face.holds_inside(apex.p); });
    case Kind::kLightOnEdge:
      return any_apex(1, [](const Apex& apex, const Face& face) {
        return any_edge(face, [&](const Z3& p, const Z3& q) { return inside_edge(apex.p, p, q); });
      });
    case Kind::kLightOnEdgeLine:
      return any_apex(1, [](const Apex& apex, const Face& face) {
        return any_edge(face, [&](const Z3& p, const Z3& q) {
          return collinear(p, q, apex.p) && !inside_edge(apex.p, p, q) && apex.p != p &&
                 apex.p != q;
        });
      });
    case Kind::kLightAtVertex:
      return any_apex(1, [](const Apex& apex, const Face& face) {
        return std::ranges::find(face.loop, apex.p) != face.loop.end();
      });
    case Kind::kLightFar:
      return std::ranges::any_of(apexes, [&](const Apex& apex) {
        return apex.weight == 1 && std::ranges::all_of(corners, [&](const Z3& p) {
                 return largest(minus(apex.p, p)) > extent * 1000000;
               });
      });
    case Kind::kLightNear:
      return any_apex(1, [](const Apex& apex, const Face& face) { return is_near(face, apex.p); });
    case Kind::kGrazingLight:
    case Kind::kGrazingSun:
      return any_apex(kind == Kind::kGrazingLight ? 1 : 0, [](const Apex& apex, const Face& face) {
        return grazes(face, apex.from(face.loop[0]));
      });
    case Kind::kSunAlongEdge:
      return any_apex(0, [](const Apex& apex, const Face& face) {
        return any_edge(face, [&](const Z3& p, const Z3& q) {
          return p != q && is_zero(cross(apex.p, minus(q, p)));
        });
      });
    case Kind::kShadowEdges:
      return std::ranges::any_of(apexes, [&](const Apex& apex) {
        return any_pair([&](const Face& a, const Face& b) {
          return any_edge(a, [&](const Z3& p, const Z3& q) {
            const Z3 m = apex.plane(p, q);
            if (is_zero(m)) return false;
            return any_edge(b, [&](const Z3& r, const Z3& s) {
              return sgn(dot(m, minus(r, p))) == 0 && sgn(dot(m, minus(s, p))) == 0 &&
                     !(collinear(p, q, r) && collinear(p, q, s));
            });
          });
        });
      });
    case Kind::kShadowVertexOnEdge:
      return std::ranges::any_of(apexes, [&](const Apex& apex) {
        return any_pair([&](const Face& a, const Face& b) {
          return any_corner(a, [&](const Z3& c) {
            return any_edge(
                b, [&](const Z3& p, const Z3& q) { return on_shadow_edge(apex, p, q, c); });
          });
        });
      });
    case Kind::kShadowVertices:
      return std::ranges::any_of(apexes, [&](const Apex& apex) {
        return any_pair([&](const Face& a, const Face& b) {
          return any_corner(a, [&](const Z3& p) {
            return any_corner(b, [&](const Z3& q) { return on_shadow_vertex(apex, p, q); });
          });
        });
      });
    case Kind::kCyclicOverlap:
      return cyclic_overlap();
    case Kind::kAreaVertex:
      return any_panel(share_vertex);
    case Kind::kAreaEdge:
      return any_panel(share_edge);
    case Kind::kAreaEdgeOverlap:
      return any_panel(share_part_of_edge);
    case Kind::kAreaInPlane:
      return any_panel(
          [](const Face& panel, const Face& face) { return face.coplanar_with(panel); });
    case Kind::kAreaOnCaster:
      return any_panel(overlap);
    case Kind::kAreaInside:
      return any_panel([](const Face& panel, const Face& face) {
        const auto all_inside = [](const Face& a, const Face& b) {
          return std::ranges::all_of(a.loop, [&](const Z3& p) { return b.holds_inside(p); });
        };
        return all_inside(panel, face) || all_inside(face, panel);
      });
    case Kind::kAreaVertexInFace:
      return any_panel(vertex_in_face);
    case Kind::kAreaTouched:
      return any_panel(
          [](const Face& panel, const Face& face) { return vertex_in_face(face, panel); });
    case Kind::kAreaStraddled:
      return any_panel([](const Face& panel, const Face& face) {
        return face.planar && any_corner(panel, [&](const Z3& p) { return face.side(p) > 0; }) &&
               any_corner(panel, [&](const Z3& p) { return face.side(p) < 0; });
      });
    case Kind::kAreaCut:
      return any_panel([](const Face& panel, const Face& face) {
        return pierces(panel, face) || pierces(face, panel);
      });
    case Kind::kAreaVertexInPlane:
      return any_panel([](const Face& panel, const Face& face) {
        return face.planar && !face.coplanar_with(panel) &&
               any_corner(panel, [&](const Z3& p) { return face.side(p) == 0; });
      });
    case Kind::kAreaEdgeInPlane:
      return any_panel([](const Face& panel, const Face& face) {
        return face.planar && !face.coplanar_with(panel) &&
               any_edge(panel, [&](const Z3& p, const Z3& q) {
                 return face.side(p) == 0 && face.side(q) == 0;
               });
      });
    case Kind::kAreaParallelEdge:
      return any_panel([](const Face& panel, const Face& face) {
        return any_edges(panel, face, [](const Z3& p, const Z3& q, const Z3& r, const Z3& s) {
          return p != q && r != s && is_zero(cross(minus(q, p), minus(s, r))) &&
                 !collinear(p, q, r);
        });
      });
    case Kind::kAreaGrazing:
      return any_panel([](const Face& panel, const Face& face) {
        return any_corner(panel, [&](const Z3& p) { return grazes(face, minus(p, face.loop[0])); });
      });
    case Kind::kAreaSliver:
      return std::ranges::any_of(
          panels, [](const Face& panel) { return is_thin(panel, false) || is_thin(panel, true); });
    case Kind::kAreaSmall:
      return std::ranges::any_of(
          panels, [&](const Face& panel) { return (extent_of(panel.loop) << 20) < extent; });
    case Kind::kAreaHuge:
      return std::ranges::any_of(
          panels, [&](const Face& panel) { return extent_of(panel.loop) > extent << 10; });
    case Kind::kMixedMagnitudes: {
      const auto range = magnitudes(true);
      return range && (*range)[1] - (*range)[0] > 64;
    }
    case Kind::kScaledUp: {
      const auto range = magnitudes(false);
      return range && (*range)[1] >= 300;
    }
    case Kind::kScaledDown: {
      const auto range = magnitudes(false);
      return range && (*range)[1] <= -300;
    }
    case Kind::kLargeOffset:
      return !corners.empty() &&
             std::ranges::all_of(corners, [&](const Z3& p) { return largest(p) > extent << 18; });
    case Kind::kDecimals: {
      if (scene.numbers != NumberMeaning::kDecimal) return false;
      return std::ranges::any_of(scene.vertices, [](const Position& p) {
        return !(p[0].is_double() && p[1].is_double() && p[2].is_double());
      });
    }
  }
  return true;
}

KindChecker::KindChecker(const Scene& scene) : view_(std::make_unique<const View>(scene)) {}
KindChecker::~KindChecker() = default;

bool KindChecker::holds(Kind kind) const { return kind > Kind::kFirstFamily || view_->holds(kind); }

}  // namespace gnomon::fuzz
