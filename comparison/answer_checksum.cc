// SPDX-License-Identifier: GPL-3.0-or-later
#include "comparison/answer_checksum.h"

#include <fmt/format.h>

#include <cstddef>

#include "report/text/number_text.h"
#include "scene/base/text_hash.h"

namespace gnomon::comparison {

namespace {

/// `lit` and `penumbra` say the fraction of one of a light's parts, and of its penumbra, as text.
template <class Lit, class Penumbra>
std::string checksum(const ShadowResult& result, const Lit& lit, const Penumbra& penumbra) {
  TextHash hash;
  for (const LightResult& light : result.lights) {
    for (std::size_t i = 0; i < light.parts.size(); ++i) {
      const PartResult& part = light.parts[i];
      hash.add(fmt::format("{} {} {}\n", light.light, part.part, lit(light, i)));
      if (!light.area_fractions.empty()) hash.add(penumbra(light, i) + "\n");
    }
  }
  return fmt::format("{:016x}", hash.value());
}

}  // namespace

std::string exact_checksum(const ShadowResult& result) {
  return checksum(
      result,
      [](const LightResult& light, std::size_t i) {
        return light.exact_fractions[i].lit.get_str();
      },
      [](const LightResult& light, std::size_t i) {
        return light.exact_fractions[i].penumbra.get_str();
      });
}

std::string rounded_checksum(const ShadowResult& result) {
  return checksum(
      result,
      [](const LightResult& light, std::size_t i) {
        return report::shortest(light.parts[i].lit.middle());
      },
      [](const LightResult& light, std::size_t i) {
        return report::shortest(light.area_fractions[i].penumbra.middle());
      });
}

}  // namespace gnomon::comparison
