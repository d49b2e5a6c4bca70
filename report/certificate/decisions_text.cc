// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "report/certificate/decisions.h"
#include "report/text/number_text.h"

namespace gnomon::report {

namespace {

std::string counted(std::uint64_t count, const std::string& one) {
  return grouped(count) + ' ' + one + (count == 1 ? "" : "s");
}

std::string light_name(const NamedScene& named, std::uint32_t light) {
  return named.scene->lights[named.prepared->lights[light].light].id;
}
std::string polygon_name(const NamedScene& named, std::uint32_t part) {
  return named.scene->polygons[named.prepared->parts[part].polygon].id;
}

std::string size_text(const DecisionGroup& group) {
  std::string text;
  if (group.on < group.decisions) {
    text = rounded(group.least, 3);
    if (group.least < group.most) text += " to " + rounded(group.most, 3);
    text += " ulp";
  }
  if (group.on > 0) text += (text.empty() ? "" : ", ") + grouped(group.on) + " exactly 0";
  return text;
}

std::string group_text(const DecisionGroup& group, const Explanation& explanation,
                       const NamedScene& named) {
  std::string text = std::string(name_of(group.predicate));
  text += group.light ? ", light " + light_name(named, *group.light) : ", all lights";
  if (group.part) text += ", polygon " + polygon_name(named, *group.part);
  return text + ": " + counted(group.decisions, "decision") + " (" +
         counted(group.times, "answer") + " of " +
         grouped(explanation.asked[static_cast<std::size_t>(group.predicate)]) + "), " +
         size_text(group);
}

std::string shares_text(const SideShares& before, const SideShares& after) {
  std::string text;
  const auto add = [&](const char* name, double then, double now) {
    if (!(std::fabs(then - now) <= kUnchangedShare)) {
      text += (text.empty() ? "" : ", ") + std::string(name) + ' ' + rounded(then) + " becomes " +
              rounded(now);
    }
  };
  add("lit", before.lit, after.lit);
  add("shadow", before.shadow, after.shadow);
  add("penumbra", before.penumbra, after.penumbra);
  add("umbra", before.umbra, after.umbra);
  return text;
}

std::string effect_text(const RunEffect& effect, const NamedScene& named) {
  std::string text;
  if (!effect.ended) text = "does not end";
  if (effect.changed == 0) return text.empty() ? "changes nothing" : text;
  text += (text.empty() ? "" : ", ") + std::string("changes ") + counted(effect.changed, "side") +
          (effect.classes ? " (classes)" : " (shares)");
  const ChangedSide& most = *effect.most;
  return text + ", most polygon " + polygon_name(named, most.part) +
         (most.side == Side::kFront ? " (front)" : " (back)") + " under light " +
         light_name(named, most.light) + ": " + shares_text(most.before, most.after);
}

}  // namespace

std::vector<std::string> decisions_text(const Explanation& explanation, const std::string& kernel,
                                        const NamedScene& named) {
  constexpr std::size_t kMostGroups = 8, kMostFlips = 8;
  if (explanation.decisions.empty()) return {};
  std::vector<std::string> notes;
  std::uint64_t asked = 0;
  for (const std::uint64_t count : explanation.asked) asked += count;
  notes.push_back("decisions that differ: " + grouped(explanation.decisions.size()) + ", in " +
                  grouped(explanation.times()) + " of " + counted(asked, "answer"));
  for (std::size_t i = 0; i < explanation.groups.size() && i < kMostGroups; ++i) {
    notes.push_back("  " + group_text(explanation.groups[i], explanation, named));
  }
  if (explanation.groups.size() > kMostGroups) {
    notes.push_back("  and " + counted(explanation.groups.size() - kMostGroups, "group") +
                    " more (--json)");
  }
  if (explanation.flipped.empty() && !explanation.kernel.changes()) return notes;
  const auto matters = static_cast<std::uint64_t>(std::ranges::count_if(
      explanation.flipped, [](const FlippedDecision& flip) { return flip.effect.changes(); }));
  notes.push_back(
      "flipped alone on the exact run, largest first: " + grouped(explanation.flipped.size()) +
      " of " + grouped(explanation.decisions.size()) + "; " + grouped(matters) +
      (matters == 1 ? " changes" : " change") + " the result" +
      (explanation.cannot_be_flipped == 0
           ? ""
           : "; " + grouped(explanation.cannot_be_flipped) + " cannot be flipped alone"));
  std::vector<std::string> lights;
  for (const Light& light : named.scene->lights) lights.push_back(light.id);
  std::size_t told = 0;
  for (const FlippedDecision& flip : explanation.flipped) {
    if (!flip.effect.changes() || told++ >= kMostFlips) continue;
    const DifferingDecision& decision = explanation.decisions[flip.decision];
    notes.push_back("  " + rounded(decision.ulps, 3) + " ulp, " + effect_text(flip.effect, named) +
                    ". " + to_sentence(decision, *named.prepared, kernel, lights));
  }
  if (told > kMostFlips) notes.push_back("  and " + grouped(told - kMostFlips) + " more (--json)");
  notes.push_back("all of them together: " + effect_text(explanation.together, named));
  notes.push_back(kernel + " itself: " + effect_text(explanation.kernel, named));
  return notes;
}

}  // namespace gnomon::report
