// SPDX-License-Identifier: GPL-3.0-or-later
#include "answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "comparison/answer_checksum.h"
#include "scenes.h"

namespace gnomon::bench {
namespace {

bool overlap(const Interval& a, const Interval& b) {
  return a.lower <= b.upper && b.lower <= a.upper;
}

/// The methods that are chosen by name and whose lights are wanted, in the order of the table.
std::vector<NamedAlgorithm> named_methods(bool (*wanted)(LightKinds)) {
  std::vector<NamedAlgorithm> found;
  for (const Method& method : methods()) {
    if (method.chosen_by_name && wanted(method.lights)) {
      found.push_back({std::string(method.name), method.id});
    }
  }
  return found;
}

}  // namespace

ExactAnswers exact_answers(const ShadowResult& result) {
  ExactAnswers answers;
  answers.checksum = comparison::exact_checksum(result);
  for (const LightResult& light : result.lights) {
    for (const ExactFractions& part : light.exact_fractions) {
      answers.lit.push_back(part.lit.get_d());
      const mpq_class sum = part.lit + part.shadow + part.penumbra + part.umbra;
      if (sum != 1) answers.sums_to_one = false;
    }
  }
  return answers;
}

Deviation deviation(const ShadowResult& result, const ExactAnswers& exact) {
  Deviation found;
  std::size_t i = 0;
  for (const LightResult& light : result.lights) {
    for (const PartResult& part : light.parts) {
      const double lit = part.lit.middle();
      const double error = std::fabs(lit - exact.lit[i++]);
      found.sum += lit;
      // NaN is wrong too.
      if (!(error <= kWrongBeyond)) ++found.wrong_parts;
      found.largest = std::isnan(error) ? INFINITY : std::max(found.largest, error);
    }
  }
  return found;
}

std::uint64_t total_fragments(const ShadowResult& result) {
  std::uint64_t total = 0;
  for (const LightResult& light : result.lights) total += light.fragment_total;
  return total;
}

bool enclosures_overlap(const ShadowResult& a, const ShadowResult& b) {
  for (std::size_t i = 0; i < a.lights.size(); ++i) {
    for (std::size_t k = 0; k < a.lights[i].parts.size(); ++k) {
      if (!overlap(a.lights[i].parts[k].lit, b.lights[i].parts[k].lit)) return false;
    }
    for (std::size_t k = 0; k < a.lights[i].area_fractions.size(); ++k) {
      const AreaFractions &left = a.lights[i].area_fractions[k],
                          &right = b.lights[i].area_fractions[k];
      if (!overlap(left.penumbra, right.penumbra) || !overlap(left.umbra, right.umbra)) {
        return false;
      }
    }
  }
  return true;
}

double lit_area(const LightResult& light, const std::vector<double>& areas) {
  double sum = 0;
  for (const PartResult& part : light.parts) sum += part.lit.middle() * areas[part.part];
  return sum;
}

const std::vector<NamedAlgorithm>& algorithms() {
  static const std::vector<NamedAlgorithm> kAlgorithms =
      named_methods([](LightKinds lights) { return lights.point && !lights.area; });
  return kAlgorithms;
}

const std::vector<NamedAlgorithm>& area_algorithms() {
  static const std::vector<NamedAlgorithm> kAlgorithms =
      named_methods([](LightKinds lights) { return lights.area; });
  return kAlgorithms;
}

std::size_t default_algorithm() {
  const ShadowResult result = shadows_or_stop(make_scene("quads", {{"n", 4}}), {});
  for (std::size_t i = 0; i < algorithms().size(); ++i) {
    if (algorithms()[i].name == result.algorithm) return i;
  }
  return 0;
}

ShadowResult shadows_or_stop(const PreparedScene& scene, const ShadowOptions& options) {
  Expected<ShadowResult> result = compute_shadows(scene, options);
  if (!result) {
    fmt::print(stderr, "gnomon_bench: {}\n", to_string(result.error()));
    std::exit(2);
  }
  return std::move(*result);
}

}  // namespace gnomon::bench
