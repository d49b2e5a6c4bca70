// SPDX-License-Identifier: GPL-3.0-or-later
#include "answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace gnomon::bench {
namespace {

class Fnv1a {
 public:
  void add(std::string_view text) {
    for (const char c : text) {
      hash_ ^= static_cast<unsigned char>(c);
      hash_ *= 0x100000001b3u;
    }
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325u;
};

}  // namespace

ExactAnswers exact_answers(const ShadowResult& result) {
  ExactAnswers answers;
  Fnv1a hash;
  for (const LightResult& light : result.lights) {
    for (const PartResult& part : light.parts) {
      hash.add(fmt::format("{} {} {}\n", light.light, part.part, part.exact_lit.get_str()));
      answers.lit.push_back(part.exact_lit.get_d());
      if (part.exact_lit + part.exact_shadow != 1) answers.sums_to_one = false;
    }
  }
  answers.checksum = fmt::format("{:016x}", hash.value());
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

ShadowResult shadows_or_stop(const PreparedScene& scene, const ShadowOptions& options) {
  Expected<ShadowResult> result = compute_shadows(scene, options);
  if (!result) {
    fmt::print(stderr, "gnomon_bench: {}\n", to_string(result.error()));
    std::exit(2);
  }
  return std::move(*result);
}

}  // namespace gnomon::bench
