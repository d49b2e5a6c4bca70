// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/run/decision_effects.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace gnomon {
namespace {

using SideKey = std::pair<std::uint32_t, Side>;

std::map<SideKey, SideShares> shares_of(const LightResult& light) {
  std::map<SideKey, SideShares> shares;
  for (std::size_t i = 0; i < light.parts.size(); ++i) {
    const PartResult& part = light.parts[i];
    SideShares& own = shares[{part.part, part.side}];
    own.lit = part.lit.middle();
    own.shadow = part.shadow.middle();
    if (light.area_fractions.empty()) continue;
    own.penumbra = light.area_fractions[i].penumbra.middle();
    own.umbra = light.area_fractions[i].umbra.middle();
  }
  return shares;
}

std::array<double, 4> in_order(const SideShares& shares) {
  return {shares.lit, shares.shadow, shares.penumbra, shares.umbra};
}

double change(const SideShares& before, const SideShares& after) {
  const auto a = in_order(before), b = in_order(after);
  double most = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    // What is not a number is no share that was there before.
    const double difference = std::fabs(a[k] - b[k]);
    most = difference <= 1 ? std::max(most, difference) : 1;
  }
  return most;
}

bool changes_class(const SideShares& before, const SideShares& after) {
  const auto a = in_order(before), b = in_order(after);
  for (std::size_t k = 0; k < a.size(); ++k) {
    if ((a[k] > kUnchangedShare) != (b[k] > kUnchangedShare)) return true;
  }
  return false;
}

}  // namespace

void add_changes(const LightResult& before, const LightResult& after, RunEffect& effect) {
  auto sides = shares_of(after);
  const auto old = shares_of(before);
  for (const auto& [key, shares] : old) sides.try_emplace(key);
  for (const auto& [key, now] : sides) {
    const auto found = old.find(key);
    const SideShares then = found == old.end() ? SideShares{} : found->second;
    const double by = change(then, now);
    if (by <= kUnchangedShare) continue;
    ++effect.changed;
    effect.classes = effect.classes || changes_class(then, now);
    if (!effect.most || by > change(effect.most->before, effect.most->after)) {
      effect.most = ChangedSide{before.light, key.first, key.second, then, now};
    }
  }
}

std::vector<DecisionGroup> grouped(std::span<const DifferingDecision> decisions,
                                   const PreparedScene& scene) {
  using Key = std::tuple<Predicate, std::optional<std::uint32_t>, std::optional<std::uint32_t>>;
  std::map<Key, DecisionGroup> groups;
  for (const DifferingDecision& decision : decisions) {
    const auto part = part_of(decision, scene);
    DecisionGroup& group = groups[{decision.predicate, decision.light, part}];
    group.predicate = decision.predicate;
    group.light = decision.light;
    group.part = part;
    ++group.decisions;
    group.times += decision.times;
    if (decision.exact == Side::kOn) {
      ++group.on;
      continue;
    }
    const bool first = group.decisions - group.on == 1;
    group.least = first ? decision.ulps : std::min(group.least, decision.ulps);
    group.most = first ? decision.ulps : std::max(group.most, decision.ulps);
  }
  std::vector<DecisionGroup> sorted;
  for (const auto& [key, group] : groups) sorted.push_back(group);
  std::ranges::stable_sort(sorted, std::ranges::greater{}, &DecisionGroup::decisions);
  return sorted;
}

}  // namespace gnomon
