// SPDX-License-Identifier: LGPL-3.0-or-later
// The precision plan: how many bits each exact predicate needs on a given scene, and the narrowest
// integers that hold it. *Model only what the scene requires.*
//
// Input: b, the bits of the scene's grid positions (in [0, 2^b - 1]), and e, the bits of the
// components of directions to lights on their own grid. The bounds are derived in
// docs/exactness.md, predicate by predicate; they hold for every intermediate of the evaluation
// order that the kernels use, so they are slightly larger than what the value alone would need.
#ifndef GNOMON_KERNEL_PRECISION_PLAN_H
#define GNOMON_KERNEL_PRECISION_PLAN_H

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace gnomon {

/// What the exact stage computes with.
enum class IntegerWidth : std::uint8_t { k64, k128, k256, k512, k1024, kUnbounded };

constexpr IntegerWidth width_for(unsigned signed_bits) {
  return signed_bits <= 128   ? IntegerWidth::k128
         : signed_bits <= 512 ? IntegerWidth::k512
                              : IntegerWidth::kUnbounded;
}
std::string_view width_name(IntegerWidth width);

/// Bits of the magnitude of a component of q(v): b for a point light (a difference of two
/// positions), b + e + 1 for a directional one (x d_z - z d_x).
constexpr unsigned light_space_bits(bool directional, unsigned b, unsigned e) {
  return directional ? b + e + 1 : b;
}
/// Shadow plane q x q of two vectors with components below 2^B: |x y - z w| < 2^(2B+1).
constexpr unsigned shadow_plane_bits(unsigned B) { return 2 * B + 1; }
/// Signed bits of n . q where |n_k| < 2^n, |q_k| < 2^q: three products.
constexpr unsigned side_of_input_vertex_bits(unsigned n, unsigned q) { return n + q + 2 + 1; }
/// Signed bits of n . (m x l), components below 2^n, 2^m, 2^l: six products.
constexpr unsigned side_of_crossing_bits(unsigned n, unsigned m, unsigned l) {
  return n + m + l + 3 + 1;
}

struct PredicateBits {
  std::string_view name;
  unsigned degree = 0;  // in positions (point light) as in docs/exactness.md
  unsigned bits = 0;    // signed, all intermediates
  IntegerWidth width = IntegerWidth::kUnbounded;
};

/// The plan of one scene. `directional` plans use e; point plans ignore it.
std::vector<PredicateBits> precision_plan(bool directional, unsigned b, unsigned e);

}  // namespace gnomon

#endif  // GNOMON_KERNEL_PRECISION_PLAN_H
