// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/judge/share_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "gnomon/scene/rational_text.h"
#include "oracle/geometry/group_overlay.h"

namespace gnomon::oracle {

namespace {

std::string told(const std::optional<LightState>& whole) {
  return whole ? std::string("all ") + name_of(*whole) : "partly lit";
}

/// How far a share is outside of claimed bounds.
Enclosure distance(const ClaimedShare& claimed, const AreaShare& lit) {
  if (!std::isfinite(claimed.lower) || !std::isfinite(claimed.upper)) return {1, 1};
  if (lit.exact) {
    const mpq_class below = mpq_class(claimed.lower) - *lit.exact;
    const mpq_class above = *lit.exact - mpq_class(claimed.upper);
    return enclose(std::max(mpq_class(0), std::max(below, above)));
  }
  const Enclosure below = Enclosure{claimed.lower, claimed.lower} - lit.fraction;
  const Enclosure above = lit.fraction - Enclosure{claimed.upper, claimed.upper};
  // Where the bounds of the truth leave it open the claim has the benefit of the doubt.
  const double least = std::max({0.0, below.lower, above.lower});
  return least > 0 ? Enclosure{least, std::max(below.upper, above.upper)} : Enclosure{};
}

Enclosure largest(Enclosure a, Enclosure b) { return b.upper > a.upper ? b : a; }

std::optional<mpq_class> sum_of(const std::optional<mpq_class>& a,
                                const std::optional<mpq_class>& b) {
  if (!a || !b) return a ? a : b;
  return mpq_class(*a + *b);
}

/// What is not lit under an area light.
AreaShare dark_share(const TrueFractions& truth) {
  AreaShare dark{truth.penumbra.fraction + truth.umbra.fraction,
                 truth.penumbra.area + truth.umbra.area,
                 {},
                 truth.penumbra.zero && truth.umbra.zero};
  if (truth.penumbra.exact && truth.umbra.exact) {
    dark.exact = mpq_class(*truth.penumbra.exact + *truth.umbra.exact);
  }
  return dark;
}

}  // namespace

ShareError share_error(const ClaimedPolygon& claimed, const AreaShare& lit,
                       const AreaShare& shadow) {
  ShareError error;
  error.found = claimed.share.whole;
  if (shadow.zero) error.truth = LightState::kLit;
  if (lit.zero) error.truth = LightState::kShadow;
  Enclosure wrong = distance(claimed.share, lit);
  const std::optional<mpq_class> dark =
      sum_of(claimed.shadow_fraction, sum_of(claimed.penumbra_fraction, claimed.umbra_fraction));
  for (const auto& [own, truth] : {std::pair{&claimed.lit_fraction, &lit}, {&dark, &shadow}}) {
    if (*own && truth->exact) {
      wrong = largest(wrong, enclose(abs(mpq_class(**own - *truth->exact))));
    }
  }
  bool zero = wrong.is_zero();
  if (error.found != error.truth) {
    zero = false;
    if (error.found == LightState::kLit) wrong = largest(wrong, shadow.fraction);
    if (error.found == LightState::kShadow) wrong = largest(wrong, lit.fraction);
    if (!error.found) wrong = largest(wrong, {0, claimed.share.upper - claimed.share.lower});
  }
  if (zero) return error;
  error.wrong.zero = false;
  error.wrong.fraction = wrong;
  error.wrong.area = wrong * (lit.area + shadow.area);
  const std::string share =
      claimed.lit_fraction ? text_for_people(*claimed.lit_fraction)
      : claimed.share.lower == claimed.share.upper
          ? fmt::format("{:.17g}", claimed.share.lower)
          : fmt::format("{:.17g} to {:.17g}", claimed.share.lower, claimed.share.upper);
  error.text = fmt::format(
      "found {}, share {}, truly {}, share {}", told(error.found), share, told(error.truth),
      lit.exact ? text_for_people(*lit.exact) : fmt::format("{:.17g}", lit.fraction.middle()));
  return error;
}

SideShares true_shares(const ExactAnswer& answer, std::uint32_t light, const AnswerEntry& entry,
                       bool exact) {
  const PreparedScene& prepared = answer.prepared();
  // Shares are of all parts of the polygon: those that this side does not show the light are dark.
  std::vector<std::vector<std::uint32_t>> parts;
  for (const ReceiverGroup& group : entry.groups) parts.push_back(group.parts);
  const std::vector<Enclosure> weights = areas_in_ratio(prepared, parts);
  constexpr std::array kMembers{&TrueFractions::lit, &TrueFractions::shadow,
                                &TrueFractions::penumbra, &TrueFractions::umbra};
  AreaShare TrueFractions::*const dark =
      answer.is_area(light) ? &TrueFractions::umbra : &TrueFractions::shadow;
  std::array<ShareSum, kMembers.size()> sums;
  SideShares result;
  for (std::size_t g = 0; g < entry.groups.size(); ++g) {
    const ReceiverGroup& group = entry.groups[g];
    const Enclosure whole = weights[g];
    result.area = result.area + group_area(prepared, group.parts);
    TrueFractions own;
    if (group.faces && !group.optional) {
      own = answer.group_fractions(light, group, exact);
    } else {
      for (const auto member : kMembers) (own.*member).exact = 0;
      own.*dark = {{1, 1}, whole, mpq_class(1), false};
    }
    for (std::size_t k = 0; k < kMembers.size(); ++k) {
      (own.*kMembers[k]).area = (own.*kMembers[k]).fraction * whole;
      sums[k].add(own.*kMembers[k], whole);
    }
  }
  for (std::size_t k = 0; k < kMembers.size(); ++k) {
    AreaShare& share = result.*kMembers[k];
    share = sums[k].result();
    share.area = not_negative(share.fraction * result.area);
  }
  return result;
}

Witness witness_of_side(const ExactAnswer& answer, std::uint32_t light, const AnswerEntry& entry) {
  const PreparedScene& prepared = answer.prepared();
  Witness witness;
  witness.light = answer.scene().lights[prepared.lights[light].light].id;
  witness.polygon = answer.scene().polygons[entry.polygon].id;
  witness.side = entry.side;
  witness.kind = ErrorKind::kMisclassified;
  const auto loop = prepared.loop(prepared.parts[entry.groups.front().parts.front()]);
  const Geometry& geometry = prepared.geometry;
  for (int k = 0; k < 3; ++k) {
    mpz_class sum = 0;
    for (const VertexId vertex : loop) sum += geometry.grid.at(vertex, k);
    witness.point[k] = geometry.origin[k] + geometry.step * mpq_class(sum, loop.size());
    witness.point[k].canonicalize();
    witness.nearest[k] = enclose(witness.point[k]).middle();
  }
  return witness;
}

PolygonComparison compare_shares(const ExactAnswer& answer, std::uint32_t light,
                                 const AnswerEntry& entry, const ClaimedPolygon& candidate) {
  PolygonComparison result;
  result.polygon = answer.scene().polygons[entry.polygon].id;
  result.side = entry.side;
  const SideShares truth = true_shares(answer, light, entry, candidate.lit_fraction.has_value());
  result.lit = truth.lit;
  result.shadow = truth.shadow;
  const ShareError error =
      share_error(candidate, truth.lit, answer.is_area(light) ? dark_share(truth) : truth.shadow);
  result.misclassified = result.judged_misclassified = error.wrong;
  if (error.wrong.zero) return result;
  result.regions = 1;
  Witness witness = witness_of_side(answer, light, entry);
  witness.found = error.found;
  witness.truth = error.truth;
  witness.text = error.text;
  result.worst.push_back({error.wrong, std::move(witness), false});
  return result;
}

}  // namespace gnomon::oracle
