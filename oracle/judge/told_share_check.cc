// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/judge/told_share_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gnomon/scene/rational_text.h"
#include "oracle/judge/share_check.h"

namespace gnomon::oracle {

namespace {

/// A number of the file, or the sum of two of them, and what it must be.
struct Demand {
  std::string what;    // "lit", "penumbra + umbra"
  std::string text;    // the number as written
  mpq_class claimed;   // of the polygon; `is_area`: scene units squared
  mpq_class rounding;  // how far off it may be
  bool is_area = false;
  bool is_double = false;
  bool at_most = false;  // it may be less than the truth, but not negative
  AreaShare truth;
};

/// How far a demand is from being met.
struct Distance {
  Enclosure fraction;  // of the polygon
  bool zero = true;    // it is met exactly, as far as is known
  bool fails = false;  // it is certainly farther than it may be
};

Distance distance_of_exact(const mpq_class& claimed, const mpq_class& truth, bool at_most,
                           const mpq_class& allowed) {
  mpq_class off = claimed - truth;
  if (off < 0) off = at_most ? std::max(mpq_class(0), mpq_class(-claimed)) : mpq_class(-off);
  return {enclose(off), off == 0, off > allowed};
}

Distance distance_of_enclosed(const Enclosure& claimed, const Enclosure& truth, bool at_most,
                              const Enclosure& allowed) {
  const Enclosure over = claimed - truth;
  const Enclosure under = at_most ? Enclosure{0, 0} - claimed : truth - claimed;
  Distance distance;
  distance.fraction =
      not_negative({std::max(over.lower, under.lower), std::max(over.upper, under.upper)});
  distance.zero = !(distance.fraction.lower > 0);
  if (distance.zero) distance.fraction = {};
  distance.fails = distance.fraction.lower > allowed.upper;
  return distance;
}

class ToldShareCheck {
 public:
  ToldShareCheck(const SideShares& truth, const ComparisonOptions& options)
      : truth_(truth), options_(options) {}

  Distance distance(const Demand& demand) const {
    if (demand.is_area) return distance_of_area(demand);
    const mpq_class allowed = std::max(rounding_of(demand), mpq_class(tolerance_of(demand)));
    if (demand.truth.exact) {
      return distance_of_exact(demand.claimed, *demand.truth.exact, demand.at_most, allowed);
    }
    return distance_of_enclosed(enclose(demand.claimed), demand.truth.fraction, demand.at_most,
                                enclose(allowed));
  }

  std::string sentence(const Demand& demand) const {
    std::string truth = demand.is_area ? fmt::format("{:.17g}", demand.truth.area.middle())
                        : demand.truth.exact
                            ? text_for_people(*demand.truth.exact)
                            : fmt::format("{:.17g}", demand.truth.fraction.middle());
    if (demand.at_most) truth = "at most " + truth;
    const double whole = demand.is_area ? truth_.area.upper : 1;
    const double allowed = std::max(rounding_of(demand).get_d(), tolerance_of(demand) * whole);
    return fmt::format("{}{} told as {}, truly {}; {:.3g} off is allowed", demand.what,
                       demand.is_area ? " area" : "", demand.text, truth, allowed);
  }

 private:
  Distance distance_of_area(const Demand& demand) const {
    const double tolerance = tolerance_of(demand);
    const Enclosure allowed =
        greater_of(Enclosure{tolerance, tolerance} * truth_.area, enclose(rounding_of(demand)));
    Distance distance =
        distance_of_enclosed(enclose(demand.claimed), demand.truth.area, demand.at_most, allowed);
    if (truth_.area.lower > 0) {
      distance.fraction = not_negative(distance.fraction / truth_.area);
    }
    return distance;
  }

  /// By its digits, unless a tolerance is asked for.
  mpq_class rounding_of(const Demand& demand) const {
    return options_.share_tolerance ? mpq_class(0) : demand.rounding;
  }
  /// Of the polygon.
  double tolerance_of(const Demand& demand) const {
    constexpr double kMost = 1e9;  // infinity is no rational
    if (options_.share_tolerance) return std::min(*options_.share_tolerance, kMost);
    return demand.is_double ? options_.double_tolerance : 0;
  }

  const SideShares& truth_;
  const ComparisonOptions& options_;
};

/// All that the claimed shares must meet.
std::vector<Demand> demands_of(const ClaimedPolygon& candidate, const SideShares& truth,
                               bool whole_umbra) {
  AreaShare not_lit;
  not_lit.zero = truth.lit.exact == mpq_class(1);
  not_lit.fraction = not_negative(Enclosure{1, 1} - truth.lit.fraction);
  not_lit.area = not_negative(truth.area - truth.lit.area);
  if (truth.lit.exact) not_lit.exact = 1 - *truth.lit.exact;
  std::vector<Demand> demands;
  std::vector<const ToldShare*> dark;
  for (const ToldShare& share : candidate.told) {
    Demand& demand = demands.emplace_back();
    demand.what = name_of(share.state);
    constexpr std::size_t kMostText = 40;
    demand.text = share.text.substr(0, kMostText);
    demand.claimed = share.value;
    demand.rounding = share.rounding;
    demand.is_area = share.is_area;
    demand.is_double = share.is_double;
    switch (share.state) {
      case LightState::kLit:
        demand.truth = truth.lit;
        continue;
      case LightState::kShadow:
        demand.truth = truth.shadow;
        continue;
      case LightState::kPenumbra:
        demand.truth = truth.penumbra;
        break;
      case LightState::kUmbra:
        demand.truth = truth.umbra;
        break;
    }
    if (!whole_umbra) continue;
    demand.truth = not_lit;
    demand.at_most = true;
    dark.push_back(&share);
  }
  if (dark.size() == 2 && dark[0]->is_area == dark[1]->is_area) {
    demands.push_back({"penumbra + umbra", text_for_people(dark[0]->value + dark[1]->value),
                       dark[0]->value + dark[1]->value, dark[0]->rounding + dark[1]->rounding,
                       dark[0]->is_area, dark[0]->is_double || dark[1]->is_double, false, not_lit});
  }
  return demands;
}

}  // namespace

PolygonComparison compare_told_shares(const ExactAnswer& answer, std::uint32_t light,
                                      const AnswerEntry& entry, const ClaimedPolygon& candidate,
                                      const ClaimedTerms& terms, const ComparisonOptions& options) {
  PolygonComparison result;
  result.polygon = answer.scene().polygons[entry.polygon].id;
  result.side = entry.side;
  result.told_shares = candidate.told.size();
  // Where the digits ask for it, or where it costs little.
  constexpr std::size_t kSmallScene = 1000;
  const auto is_fine = [](const ToldShare& share) {
    constexpr double kFine = 1e-12;
    return !share.is_area && !share.is_double && share.rounding < kFine;
  };
  const bool exact = options.share_tolerance || std::ranges::any_of(candidate.told, is_fine) ||
                     answer.prepared().parts.size() <= kSmallScene;
  const SideShares truth = true_shares(answer, light, entry, exact);
  result.lit = truth.lit;
  result.shadow = truth.shadow;
  result.penumbra = truth.penumbra;
  result.umbra = truth.umbra;
  const bool whole_umbra = answer.is_area(light) && !terms.per_caster_umbra;
  const ToldShareCheck check(truth, options);
  for (const Demand& demand : demands_of(candidate, truth, whole_umbra)) {
    const Distance off = check.distance(demand);
    if (off.zero) continue;
    AreaShare wrong{off.fraction, off.fraction * truth.area, {}, false};
    const bool worse = off.fraction.upper > result.misclassified.fraction.upper;
    if (worse || result.misclassified.zero) result.misclassified = wrong;
    if (!off.fails) continue;
    ++result.regions;
    if (!result.judged_misclassified.zero && !worse) continue;
    result.judged_misclassified = wrong;
    Witness witness = witness_of_side(answer, light, entry);
    witness.block = terms.block;
    witness.text = check.sentence(demand);
    result.worst = {{wrong, std::move(witness), false}};
  }
  return result;
}

}  // namespace gnomon::oracle
