// SPDX-License-Identifier: GPL-3.0-or-later
// What a result says, in a form that can be compared: a checksum over the exact fractions of all
// parts (not over fragments, which may be cut differently), and how far a rounded result is
// off.
#ifndef GNOMON_BENCH_ANSWERS_H
#define GNOMON_BENCH_ANSWERS_H

#include <cstdint>
#include <string>
#include <vector>

#include "gnomon/algorithms/shadow_result.h"
#include "gnomon/algorithms/shadows.h"

namespace gnomon::bench {

/// Rounded parts that differ from the exact fraction by more than this are counted.
inline constexpr double kWrongBeyond = 1e-9;

struct ExactAnswers {
  std::string checksum;     // FNV-1a, 64 bits, of "light part p/q", and of penumbras, of every part
  std::vector<double> lit;  // nearest doubles, light by light
  bool sums_to_one = true;  // all classes together are exactly 1 for every part
};
/// Requires: the result was computed with exact_fractions on an exact kernel.
ExactAnswers exact_answers(const ShadowResult& result);

struct Deviation {
  std::uint64_t wrong_parts = 0;
  double largest = 0;  // of |fraction - exact fraction|
  double sum = 0;      // of the lit fractions
};
Deviation deviation(const ShadowResult& result, const ExactAnswers& exact);

std::uint64_t total_fragments(const ShadowResult& result);

/// Whether the certified bounds of both overlap for every part of every light.
bool enclosures_overlap(const ShadowResult& a, const ShadowResult& b);
/// Lit area of each light's parts together, in the unit of `areas` (one a part).
double lit_area(const LightResult& light, const std::vector<double>& areas);

/// The algorithms by name, in the order of the tables.
struct NamedAlgorithm {
  std::string name;
  MethodId algorithm;
};
const std::vector<NamedAlgorithm>& algorithms();
/// The methods for area lights.
const std::vector<NamedAlgorithm>& area_algorithms();
/// Index into algorithms() of the one that runs where none is asked for.
std::size_t default_algorithm();

/// compute_shadows; ends the program with a message on an error.
ShadowResult shadows_or_stop(const PreparedScene& scene, const ShadowOptions& options);

}  // namespace gnomon::bench

#endif  // GNOMON_BENCH_ANSWERS_H
