// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/kinds/exact_face.h"

#include <utility>

namespace gnomon::fuzz {

mpz_class extent_of(const Loop& points) {
  mpz_class extent = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [low, high] =
        std::minmax_element(points.begin(), points.end(),
                            [k](const Integers& a, const Integers& b) { return a[k] < b[k]; });
    const mpz_class size = (*high)[k] - (*low)[k];
    if (size > extent) extent = size;
  }
  return extent;
}

mpz_class largest(const Integers& a) {
  const mpz_class x = abs(a[0]), y = abs(a[1]), z = abs(a[2]);
  return std::max({x, y, z});
}

mpz_class squared_length(const Integers& a) { return dot(a, a); }

Face face_of(Loop loop, bool holes) {
  Face face;
  face.loop = std::move(loop);
  for (std::size_t i = 1; i + 1 < face.loop.size(); ++i) {
    const Integers n =
        cross(minus(face.loop[i], face.loop[0]), minus(face.loop[i + 1], face.loop[0]));
    for (std::size_t k = 0; k < 3; ++k) face.normal[k] += n[k];
  }
  face.planar =
      std::ranges::all_of(face.loop, [&](const Integers& p) { return face.side(p) == 0; });
  // Every corner on the inner side of every edge: convex, if it does not run round twice.
  face.convex =
      face.planar && !holes && !is_zero(face.normal) &&
      std::ranges::all_of(face.loop, [&](const Integers& p) { return face.within(p) >= 0; });
  return face;
}

bool collinear(const Integers& a, const Integers& b, const Integers& c) {
  return is_zero(cross(minus(b, a), minus(c, a)));
}

bool inside_edge(const Integers& p, const Integers& a, const Integers& b) {
  if (!collinear(a, b, p)) return false;
  return sgn(dot(minus(p, a), minus(b, p))) > 0;
}

bool edges_overlap(const Integers& a, const Integers& b, const Integers& c, const Integers& d) {
  if (!collinear(a, b, c) || !collinear(a, b, d)) return false;
  const bool same = (a == c && b == d) || (a == d && b == c);
  return !same && (inside_edge(c, a, b) || inside_edge(d, a, b) || inside_edge(a, c, d) ||
                   inside_edge(b, c, d));
}

bool is_thin(const Face& face, bool needle) {
  mpz_class shortest = -1, longest = 0;
  for (std::size_t i = 0; i < face.loop.size(); ++i) {
    const mpz_class length = squared_length(minus(face.corner(i + 1), face.loop[i]));
    if (shortest < 0 || length < shortest) shortest = length;
    if (length > longest) longest = length;
  }
  static const mpz_class kAspectSquared("1000000000000");
  if (squared_length(face.normal) * kAspectSquared >= longest * longest) return false;
  return needle ? shortest * kAspectSquared < longest : shortest * 10000 > longest;
}

bool is_near(const Face& face, const Integers& p) {
  const mpz_class extent = extent_of(face.loop), reach = extent * extent;
  const auto small = [&](const mpz_class& numerator, const mpz_class& denominator) {
    return (numerator << 56) < reach * denominator;
  };
  if (face.convex && face.side(p) == 0 && face.within(p) >= 0) return false;
  for (std::size_t i = 0; i < face.loop.size(); ++i) {
    const Integers &a = face.loop[i], edge = minus(face.corner(i + 1), a), d = minus(p, a);
    if (small(squared_length(d), 1)) return true;
    const mpz_class along = dot(d, edge), length = squared_length(edge);
    if (along > 0 && along < length && small(squared_length(cross(d, edge)), length)) return true;
  }
  if (!face.convex || face.within(p) <= 0) return false;
  const mpz_class height = dot(face.normal, minus(p, face.loop[0]));
  return small(height * height, squared_length(face.normal));
}

bool grazes(const Face& face, const Integers& direction) {
  const mpz_class height = dot(face.normal, direction);
  return height != 0 &&
         (height * height << 56) < squared_length(face.normal) * squared_length(direction);
}

bool overlap(const Face& a, const Face& b) {
  if (!a.convex || !b.convex || !a.coplanar_with(b)) return false;
  const auto separates = [](const Face& by, const Face& other) {
    for (std::size_t i = 0; i < by.loop.size(); ++i) {
      const Integers edge = minus(by.corner(i + 1), by.loop[i]);
      if (std::ranges::all_of(other.loop, [&](const Integers& p) {
            return sgn(dot(by.normal, cross(edge, minus(p, by.loop[i])))) <= 0;
          })) {
        return true;
      }
    }
    return false;
  };
  return !separates(a, b) && !separates(b, a);
}

bool have_the_same_corners(const Face& a, const Face& b) {
  return a.loop.size() == b.loop.size() &&
         std::is_permutation(a.loop.begin(), a.loop.end(), b.loop.begin());
}

bool share_edge(const Face& a, const Face& b) {
  return any_edges(a, b,
                   [](const Integers& p, const Integers& q, const Integers& r, const Integers& s) {
                     return (p == r && q == s) || (p == s && q == r);
                   });
}
bool share_vertex(const Face& a, const Face& b) {
  return any_corner(
      a, [&](const Integers& p) { return std::ranges::find(b.loop, p) != b.loop.end(); });
}
bool share_part_of_edge(const Face& a, const Face& b) { return any_edges(a, b, edges_overlap); }

bool vertex_in_face(const Face& a, const Face& b) {
  return !b.coplanar_with(a) && any_corner(a, [&](const Integers& p) { return b.holds_inside(p); });
}

bool pierces(const Face& a, const Face& b) {
  if (!b.convex) return false;
  for (std::size_t i = 0; i < a.loop.size(); ++i) {
    const Integers &p = a.loop[i], &q = a.corner(i + 1);
    const int side = b.side(p);
    if (side == 0 || b.side(q) != -side) continue;
    bool through = true;
    for (std::size_t k = 0; k < b.loop.size() && through; ++k) {
      const Integers n = cross(minus(b.loop[k], p), minus(b.corner(k + 1), p));
      const int turn = sgn(dot(n, minus(q, p)));
      through = turn == -side;
    }
    if (through) return true;
  }
  return false;
}

}  // namespace gnomon::fuzz
