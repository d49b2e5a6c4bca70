// SPDX-License-Identifier: GPL-3.0-or-later
#include "comparison/answer_checksum.h"

#include <fmt/format.h>

#include <cstddef>

#include "report/text/number_text.h"
#include "scene/base/text_hash.h"

namespace gnomon::comparison {

namespace {

/// `lit` and `penumbra` say the fraction of a part, and of its penumbra, as text.
template <class Lit, class Penumbra>
std::string checksum(const ShadowResult& result, const Lit& lit, const Penumbra& penumbra) {
  TextHash hash;
  for (const LightResult& light : result.lights) {
    for (std::size_t i = 0; i < light.parts.size(); ++i) {
      const PartResult& part = light.parts[i];
      hash.add(fmt::format("{} {} {}\n", light.light, part.part, lit(part)));
      if (!light.area_fractions.empty()) hash.add(penumbra(light.area_fractions[i]) + "\n");
    }
  }
  return fmt::format("{:016x}", hash.value());
}

}  // namespace

std::string exact_checksum(const ShadowResult& result) {
  return checksum(
      result, [](const PartResult& part) { return part.exact_lit.get_str(); },
      [](const AreaFractions& area) { return area.exact_penumbra.get_str(); });
}

std::string rounded_checksum(const ShadowResult& result) {
  return checksum(
      result, [](const PartResult& part) { return report::shortest(part.lit.middle()); },
      [](const AreaFractions& area) { return report::shortest(area.penumbra.middle()); });
}

}  // namespace gnomon::comparison
