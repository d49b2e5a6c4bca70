// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/check/border_check.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace gnomon::fuzz {

namespace {

using oracle::AreaShare;
using oracle::PolygonComparison;

struct NamedShare {
  const char* name;
  AreaShare PolygonComparison::*share;
};

constexpr std::array kErrors = {
    NamedShare{"misclassified", &PolygonComparison::misclassified},
    NamedShare{"uncovered", &PolygonComparison::uncovered},
    NamedShare{"overlapping", &PolygonComparison::overlapping},
    NamedShare{"outside", &PolygonComparison::outside},
};
constexpr std::array kTruths = {
    NamedShare{"lit", &PolygonComparison::lit},
    NamedShare{"shadow", &PolygonComparison::shadow},
};

/// Empty if what borders bound holds what was measured.
std::string broken_bound(const PolygonComparison& bounds, const PolygonComparison& measured) {
  for (const auto& [name, share] : kErrors) {
    const AreaShare &bound = bounds.*share, &truth = measured.*share;
    if (truth.fraction.lower > bound.fraction.upper || (bound.zero && !truth.zero)) {
      return fmt::format("{} is at least {:.17g} of the polygon, bounded by {:.17g}", name,
                         truth.fraction.lower, bound.zero ? 0 : bound.fraction.upper);
    }
  }
  for (const auto& [name, share] : kTruths) {
    const oracle::Enclosure &bound = (bounds.*share).fraction, &truth = (measured.*share).fraction;
    if (truth.lower > bound.upper || truth.upper < bound.lower) {
      return fmt::format("{} is in [{:.17g}, {:.17g}], bounded by [{:.17g}, {:.17g}]", name,
                         truth.lower, truth.upper, bound.lower, bound.upper);
    }
  }
  if (measured.width.lower > bounds.width.upper) {
    return fmt::format("a region is {:.17g} wide, bounded by {:.17g}", measured.width.lower,
                       bounds.width.upper);
  }
  if (measured.off_plane.lower > bounds.off_plane.upper) {
    return fmt::format("a vertex is {:.17g} off its plane, bounded by {:.17g}",
                       measured.off_plane.lower, bounds.off_plane.upper);
  }
  return {};
}

std::optional<BorderContradiction> contradiction(const oracle::Report& proven,
                                                 const oracle::Report& measured) {
  if (proven.verdict != measured.verdict) {
    return BorderContradiction{
        "verdict",
        {},
        {},
        fmt::format("{} by borders, {} by measuring (tolerance {:.3g}, width {:.3g})",
                    name_of(proven.verdict), name_of(measured.verdict), measured.tolerance,
                    measured.width)};
  }
  for (std::size_t l = 0; l < proven.lights.size(); ++l) {
    for (std::size_t i = 0; i < proven.lights[l].polygons.size(); ++i) {
      const PolygonComparison& bounds = proven.lights[l].polygons[i];
      if (!bounds.by_borders) continue;
      std::string text = broken_bound(bounds, measured.lights[l].polygons[i]);
      if (!text.empty()) {
        return BorderContradiction{"bounds", proven.lights[l].id, bounds.polygon, std::move(text)};
      }
    }
  }
  return std::nullopt;
}

}  // namespace

Expected<std::optional<BorderContradiction>> border_contradiction(const JudgedScene& scene,
                                                                  const Claims& claims,
                                                                  std::uint64_t seed) {
  constexpr std::uint64_t kTolerances = 15, kWidths = 12;
  const auto power = [](std::uint64_t from) {
    return std::pow(10.0, -2 - static_cast<double>(from));
  };
  oracle::CertifyOptions options;
  options.tolerance = power(seed % kTolerances);
  const std::uint64_t rest = seed / kTolerances;
  // Every other time the width that people have who ask for none.
  if (rest % 2 == 0) options.width = power(rest / 2 % kWidths) * scene.diagonal();
  Expected<oracle::Report> measured = scene.judge(claims, options);
  if (!measured) return tl::unexpected(std::move(measured.error()));
  options.borders = true;
  Expected<oracle::Report> proven = scene.judge(claims, options);
  if (!proven) return tl::unexpected(std::move(proven.error()));
  return contradiction(*proven, *measured);
}

}  // namespace gnomon::fuzz
