// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/kernel/precision_plan.h"

namespace gnomon {

std::string_view width_name(IntegerWidth width) {
  switch (width) {
    case IntegerWidth::k64:
      return "64";
    case IntegerWidth::k128:
      return "128";
    case IntegerWidth::k256:
      return "256";
    case IntegerWidth::k512:
      return "512";
    case IntegerWidth::k1024:
      return "1024";
    case IntegerWidth::kUnbounded:
      return "GMP";
  }
  return "?";
}

std::vector<PredicateBits> precision_plan(bool directional, unsigned b, unsigned e) {
  const unsigned q = light_space_bits(directional, b, e);
  const unsigned n = shadow_plane_bits(q);
  // A trace is P_j(L) n_i - P_i(L) n_j: support normals 2b + 1, values 3b + 3; for a direction H_i
  // d_j - H_j d_i with H below 2b + e + 3 bits (docs/exactness.md).
  const unsigned trace = directional ? 5 * b + e + 7 : 5 * b + 5;
  std::vector<PredicateBits> plan = {
      {"support normal", 2, 2 * b + 2, IntegerWidth::k128},
      {"support plane at a vertex", 3, 3 * b + 5, IntegerWidth::k128},
      {"scene split: edge against plane", 6, 6 * b + 10, IntegerWidth::k128},
      {"scene split: four planes", 9, 9 * b + 16, IntegerWidth::k128},
      {"shadow plane", 2, n + 1, IntegerWidth::k128},
      {"side of input vertex", 3, side_of_input_vertex_bits(n, q), IntegerWidth::k128},
      {"side of crossing", 6, side_of_crossing_bits(n, n, n), IntegerWidth::k128},
      {"side of crossing, 1 scene split", 9, side_of_crossing_bits(n, n, trace),
       IntegerWidth::k128},
      {"side of crossing, 2 scene splits", 12, side_of_crossing_bits(n, trace, trace),
       IntegerWidth::k128},
      {"side of crossing, 3 scene splits", 15, side_of_crossing_bits(trace, trace, trace),
       IntegerWidth::k128},
  };
  for (PredicateBits& predicate : plan) predicate.width = width_for(predicate.bits);
  return plan;
}

}  // namespace gnomon
