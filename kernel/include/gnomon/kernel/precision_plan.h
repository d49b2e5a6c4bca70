// SPDX-License-Identifier: LGPL-3.0-or-later
// The precision plan: how many bits each exact predicate needs on a given scene, and the narrowest
// integers that hold it. *Model only what the scene requires.*
//
// Input: b, the bits of the scene's grid positions (in [0, D], D = 2^b - 1; a point light is a
// position, and counts), and e, the bits of the components of directions to lights on their own
// grid (in [-E, E], E = 2^e - 1). Everything is a constant expression in these two. The bounds are
// derived in docs/exactness.md, predicate by predicate; they hold for every intermediate of the
// evaluation order that the kernels use. "Magnitude bits" m: |x| < 2^m. "Signed bits": those of a
// two's complement integer that holds it, m + 1.
#ifndef GNOMON_KERNEL_PRECISION_PLAN_H
#define GNOMON_KERNEL_PRECISION_PLAN_H

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

namespace gnomon {

/// What the exact stage computes with.
enum class IntegerWidth : std::uint8_t { k64, k128, k256, k512, k1024, kUnbounded };

/// The narrowest integers of so many signed bits.
constexpr IntegerWidth narrowest_width(unsigned signed_bits) {
  return signed_bits <= 64     ? IntegerWidth::k64
         : signed_bits <= 128  ? IntegerWidth::k128
         : signed_bits <= 256  ? IntegerWidth::k256
         : signed_bits <= 512  ? IntegerWidth::k512
         : signed_bits <= 1024 ? IntegerWidth::k1024
                               : IntegerWidth::kUnbounded;
}
/// "64", "128", ..., "GMP".
std::string_view width_name(IntegerWidth width);

// --- In space. Every bound is for planes through three grid positions. ---

/// Magnitude of a component of a support normal (b - a) x (c - a): twice the area of a triangle in
/// a D x D square, D^2.
constexpr unsigned support_normal_bits(unsigned b) { return 2 * b; }
/// Magnitude of a support plane's value n . (x - a) at a position, and of its offset n . a: six
/// times the volume of a tetrahedron in a cube, 2 D^3.
constexpr unsigned support_value_bits(unsigned b) { return 3 * b + 1; }
/// Signed bits of that value.
constexpr unsigned side_of_support_bits(unsigned b) { return support_value_bits(b) + 1; }
/// Signed bits of P(v) Q(u) - P(u) Q(v), the side of Q of the point where the edge u, v meets P:
/// two products of two values.
constexpr unsigned edge_against_plane_bits(unsigned b) { return 2 * support_value_bits(b) + 2; }
/// Signed bits of the determinant of four planes (n, d) by its offsets: four products of an offset
/// (2 D^3) and a determinant of normals (4 D^6), 32 D^9.
constexpr unsigned four_planes_bits(unsigned b) { return 9 * b + 6; }

// --- Shadow volumes: planes of any magnitude n of the normal's components, through some point of
// the scene's box, so that |n . x - d| at a point of the box is at most 3 * 2^n D. ---

/// Magnitude of n . x - d, and of d.
constexpr unsigned volume_value_bits(unsigned n, unsigned b) { return n + b + 2; }
/// Magnitude of the normal of a plane through an edge (of a caster or of the light) and a corner of
/// the other that one support plane cut off: P(u) m - P(v) l with areas l, m, 4 D^5; the same for
/// the plane through a vertex and the line in which two support planes meet.
constexpr unsigned cut_once_normal_bits(unsigned b) { return 5 * b + 2; }
/// Two support planes meet on the light's in a corner X / w seen from a vertex, with three products
/// of a value (2 D^3) and a cross product of normals (2 D^4): 12 D^7. (b - a) x X: 24 D^8.
constexpr unsigned cut_twice_normal_bits(unsigned b) { return 8 * b + 5; }
/// A plane along a direction of components below 2^e: 2 D E.
constexpr unsigned directional_normal_bits(unsigned b, unsigned e) { return b + e + 1; }
/// Signed bits of P(v) Q(u) - P(u) Q(v), by the magnitudes of the values.
constexpr unsigned volume_edge_bits(unsigned p, unsigned q) { return p + q + 2; }
/// Signed bits of the side that a point of three planes has of a fourth: four products of a value
/// and of a determinant of the other three normals. `most` is the largest sum of the magnitudes of
/// one plane's value and the others' normals.
constexpr unsigned volume_meet_bits(unsigned most) { return most + 2 + 2 + 1; }

// --- In light space. ---

/// Magnitude of a component of q(v): D for a point light (a difference of two positions), 2 D E for
/// a directional one (x d_z - z d_x).
constexpr unsigned light_space_bits(bool directional, unsigned b, unsigned e) {
  return directional ? b + e + 1 : b;
}
/// Magnitude of q x q' of any two vectors with components below 2^B: |x y - z w| < 2^(2B+1).
constexpr unsigned shadow_plane_bits(unsigned B) { return 2 * B + 1; }

/// Magnitudes of the components of a plane through the light: x and y, and z. They differ for
/// directional lights, whose q has two long components and a short one.
struct LightPlaneBits {
  unsigned xy = 0, z = 0;
  constexpr unsigned largest() const { return std::max(xy, z); }
};

/// The shadow plane of an input edge. Point light: q_a x q_b, twice the area of a triangle, D^2.
/// Directional light, with the common factor |d_z| taken out: 2 D E, 2 D E, 3 D^2 E
/// (exact_shadow_plane.h).
constexpr LightPlaneBits edge_plane_bits(bool directional, unsigned b, unsigned e) {
  if (directional) return {b + e + 1, 2 * b + e + 2};
  return {2 * b, 2 * b};
}
/// The plane through the light and the line in which two support planes meet (a trace of a scene
/// split, a cut of two supports). Point light: P_j(L) n_i - P_i(L) n_j, 4 D^5. Directional light
/// with H = n . d, 3 D^2 E: H_i n_j - H_j n_i = d x (n_j x n_i), 4 D^4 E, and H_j d_i - H_i d_j,
/// 12 D^5 E.
constexpr LightPlaneBits cut_plane_bits(bool directional, unsigned b, unsigned e) {
  if (directional) return {4 * b + e + 2, 5 * b + e + 4};
  return {5 * b + 2, 5 * b + 2};
}
/// Signed bits of the side that the input vertex c has of the edge plane of a, b: det(q_a, q_b,
/// q_c), 2 D^3, or for a directional light d . ((b - a) x (c - a)), 3 D^2 E.
constexpr unsigned side_of_edge_bits(bool directional, unsigned b, unsigned e) {
  return directional ? 2 * b + e + 3 : 3 * b + 2;
}
/// Signed bits of n . q where |n_k| < 2^n, |q_k| < 2^q: three products.
constexpr unsigned side_of_input_vertex_bits(unsigned n, unsigned q) { return n + q + 2 + 1; }
/// The same for the input vertices of a light: q_z is D or d_z.
constexpr unsigned side_of_input_vertex_bits(LightPlaneBits n, bool directional, unsigned b,
                                             unsigned e) {
  const unsigned q = light_space_bits(directional, b, e);
  return std::max(n.xy + q, n.z + (directional ? e : q)) + 2 + 1;
}
/// Signed bits of n . (m x l), components below 2^n, 2^m, 2^l. A determinant with |entries| <= 1 is
/// at most 4 (Hadamard), and so are the partial sums of two of its three terms of at most 2.
constexpr unsigned side_of_crossing_bits(unsigned n, unsigned m, unsigned l) {
  return n + m + l + 2 + 1;
}
/// The same where the z are larger by up to 2^s: scaling that column by 2^-s gives the case above.
constexpr unsigned side_of_crossing_bits(LightPlaneBits n, LightPlaneBits m, LightPlaneBits l) {
  unsigned s = 0;
  for (const LightPlaneBits& plane : {n, m, l}) {
    s = std::max(s, plane.z > plane.xy ? plane.z - plane.xy : 0);
  }
  return n.xy + m.xy + l.xy + s + 2 + 1;
}

struct PredicateBits {
  std::string_view name;
  unsigned degree = 0;            // in positions
  unsigned direction_degree = 0;  // in the direction to the light
  unsigned bits = 0;              // signed, all intermediates
  IntegerWidth width = IntegerWidth::kUnbounded;
};

/// The plan of a scene for its point lights, or for its directional ones; point plans ignore e.
/// Traces of scene splits and cuts of two supports count as "cuts"; a plane of a balanced prefix
/// has coefficients of b bits.
constexpr std::array<PredicateBits, 13> precision_plan(bool directional, unsigned b, unsigned e) {
  const LightPlaneBits edge = edge_plane_bits(directional, b, e),
                       cut = cut_plane_bits(directional, b, e), prefix{b, b};
  const auto of = [&](std::string_view name, unsigned degree, unsigned direction_degree,
                      unsigned bits) {
    return PredicateBits{name, degree, directional ? direction_degree : 0, bits,
                         narrowest_width(bits)};
  };
  const auto crossing = [](LightPlaneBits n, LightPlaneBits m, LightPlaneBits l) {
    return side_of_crossing_bits(n, m, l);
  };
  // Of a directional light's planes, x and y have one degree less in positions.
  const unsigned d = directional ? 1 : 0;
  return {{
      of("support normal", 2, 0, support_normal_bits(b) + 1),
      of("input vertex against support plane", 3, 0, side_of_support_bits(b)),
      of("scene split: edge against support plane", 6, 0, edge_against_plane_bits(b)),
      of("scene split: four support planes", 9, 0, four_planes_bits(b)),
      of("shadow plane of an edge", 2, 1, edge.largest() + 1),
      of("cut of two support planes", 5, 1, cut.largest() + 1),
      of("input vertex against shadow plane", 3 - d, 1, side_of_edge_bits(directional, b, e)),
      of("crossing against shadow plane", 6 - 2 * d, 3, crossing(edge, edge, edge)),
      of("crossing against prefix plane", 4 - d, 2, crossing(edge, edge, prefix)),
      of("crossing: 1 cut; depth at a crossing", 9 - 2 * d, 3, crossing(edge, edge, cut)),
      of("crossing: 2 cuts", 12 - 2 * d, 3, crossing(edge, cut, cut)),
      of("crossing: 3 cuts", 15 - 2 * d, 3, crossing(cut, cut, cut)),
      of("depth at an input vertex", 3, 0, side_of_support_bits(b)),
  }};
}

/// How often support planes cut the corners of a light that planes of volumes go through. Edges and
/// areas stay those of input polygons.
enum class LightCuts : std::uint8_t { kNone, kOnce, kTwice };

/// The plan of shadow volumes of area lights, whose planes go through edges of casters and corners
/// of the light, or through edges of the light and vertices of casters. The corners that are asked
/// about are of receivers, cut by such planes.
constexpr std::array<PredicateBits, 4> volume_precision_plan(LightCuts cuts, unsigned b) {
  const unsigned normal = cuts == LightCuts::kNone   ? support_normal_bits(b)
                          : cuts == LightCuts::kOnce ? cut_once_normal_bits(b)
                                                     : cut_twice_normal_bits(b);
  const unsigned degree = cuts == LightCuts::kNone ? 2 : cuts == LightCuts::kOnce ? 5 : 8;
  const unsigned value =
      cuts == LightCuts::kNone ? support_value_bits(b) : volume_value_bits(normal, b);
  const auto of = [](std::string_view name, unsigned in_positions, unsigned bits) {
    return PredicateBits{name, in_positions, 0, bits, narrowest_width(bits)};
  };
  return {{
      of("plane of a volume", degree, normal + 1),
      of("input vertex against plane of a volume", degree + 1, value + 1),
      of("edge cut by a volume against another", 2 * degree + 2, volume_edge_bits(value, value)),
      of("point of two volumes against a third", 3 * degree + 3,
         volume_meet_bits(support_normal_bits(b) + 2 * normal + value)),
  }};
}

}  // namespace gnomon

#endif  // GNOMON_KERNEL_PRECISION_PLAN_H
