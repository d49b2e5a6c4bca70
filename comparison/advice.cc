// SPDX-License-Identifier: GPL-3.0-or-later
#include "comparison/advice.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <numeric>
#include <utility>

#include "gnomon/kernel/kernel_choice.h"
#include "report/text/number_text.h"

namespace gnomon::comparison {

namespace {

using report::percent;
using report::rounded;
using report::shortest;

/// Candidates from the cheapest on, as a rule: what is not reached in time is told.
TradeoffPlan runs_of(const AdvicePlan& plan, LightsAsked lights, const SceneSource& scene) {
  TradeoffPlan runs;
  runs.scenes = {scene};
  runs.systems = lights == LightsAsked::kArea ? std::vector<std::string>{"receiver", "merged"}
                                              : std::vector<std::string>{"contour", "sectors"};
  runs.kernels = {"plane", "double", "float", "longdouble"};
  runs.thicknesses = {0, 1e-14, kDefaultThickness, 1e-9};
  runs.certify_up_to = plan.certify_up_to;
  runs.points = true;
  runs.stages = true;
  runs.only = lights;
  return runs;
}

void conclude(const AdvicePlan& plan, Advice& advice) {
  for (const TradeoffRow& row : advice.runs.rows) {
    const Measurement& measurement = row.measurement;
    if (!measurement.timed() || !is_within(measurement, plan.tolerance)) continue;
    const auto is_cheaper = [&](const TradeoffRow* than) {
      return than == nullptr || measurement.seconds < than->measurement.seconds;
    };
    if (is_cheaper(advice.cheapest)) advice.cheapest = &row;
    if (measurement.exact && is_cheaper(advice.exact)) advice.exact = &row;
  }
  // What is as fast but for chance, and needs no word about thickness, is easier to type.
  constexpr double kAsFast = 1.1;
  for (const TradeoffRow& row : advice.runs.rows) {
    if (advice.cheapest == nullptr || advice.cheapest == advice.exact) break;
    if (row.request.thickness == kDefaultThickness && is_within(row.measurement, plan.tolerance) &&
        row.measurement.seconds <= kAsFast * advice.cheapest->measurement.seconds) {
      advice.cheapest = &row;
      break;
    }
  }
  if (advice.cheapest != nullptr) {
    advice.by_points = advice.cheapest->measurement.judgement->by_points;
  }
}

/// What to type for a row.
std::string command_for(const AdvicePlan& plan, const TradeoffRow& row) {
  std::string text = "gnomon shadows " + plan.scene + " --kernel " + row.request.kernel +
                     " --algorithm " + row.request.system;
  if (row.request.thickness && *row.request.thickness != kDefaultThickness) {
    text += " --thickness " + shortest(*row.request.thickness);
  }
  return text;
}

std::string name_of_row(const TradeoffRow& row) {
  std::string text = row.request.kernel + " by " + row.request.system;
  if (row.request.thickness) text += ", thickness " + shortest(*row.request.thickness);
  return text;
}

std::string milliseconds(double seconds) {
  constexpr double kMilli = 1000;
  return rounded(seconds * kMilli, 3) + " ms";
}

std::string how_it_is_known(const Advice& advice, const AdvicePlan& plan) {
  const Judgement& judgement = *advice.cheapest->measurement.judgement;
  if (judgement.by_points) {
    return "not proven: exact points were right, of more polygons than the " +
           report::grouped(plan.certify_up_to) + " that are compared whole";
  }
  return "proven by the oracle: worst share wrong " +
         (judgement.worst_share == 0 ? std::string("0") : rounded(judgement.worst_share, 2));
}

std::string bits_text(const Measurement& exact) {
  static constexpr const char* kWidths[] = {"64", "128", "256", "512", "1,024", "more (GMP)"};
  const DecidedBy& by = exact.decided_by;
  const auto all = std::accumulate(by.begin(), by.end(), std::uint64_t{0});
  const auto integers = std::accumulate(by.begin() + 2, by.end(), std::uint64_t{0});
  std::string text = std::to_string(exact.position_bits) + " bits a coordinate";
  if (all == 0) return text;
  text += "; " + percent(static_cast<double>(integers) / static_cast<double>(all)) +
          " of the decisions need integers";
  for (std::size_t i = by.size(); i-- > 2;) {
    if (by[i] == 0) continue;
    text += std::string(", of ") + kWidths[i - 2] + " bits at most";
    break;
  }
  return text;
}

/// With which of the thicknesses that were tried double is right, by each method.
std::string thickness_text(const Advice& advice, double tolerance) {
  std::string text, system;
  for (const TradeoffRow& row : advice.runs.rows) {
    if (row.request.kernel != "double" || !row.request.thickness) continue;
    if (row.request.system != system) {
      system = row.request.system;
      text += (text.empty() ? "double by " : "; by ") + system + ':';
    }
    text += ' ' + shortest(*row.request.thickness) +
            (is_within(row.measurement, tolerance) ? " right" : " wrong") + ',';
  }
  if (text.empty()) return "double was not tried";
  text.pop_back();
  std::string::size_type at = 0;
  while ((at = text.find(",;", at)) != std::string::npos) text.erase(at, 1);
  return text;
}

}  // namespace

bool is_within(const Measurement& measurement, double tolerance) {
  if (!measurement.judgement) return false;
  const Judgement& judgement = *measurement.judgement;
  if (measurement.exact) return judgement.confirms;
  if (judgement.by_points) return judgement.verdict != "failed";
  return judgement.worst_share <= tolerance &&
         judgement.width <= std::max(tolerance, 1e-9) * judgement.diagonal;
}

Expected<std::vector<Advice>> advise(const AdvicePlan& plan, const RunProgram& program,
                                     const CompareControl& control) {
  using Clock = std::chrono::steady_clock;
  const auto source = SceneSource::parse(plan.scene);
  if (!source) return tl::unexpected(source.error());
  const auto scene = source->make({}, 1);
  if (!scene) return tl::unexpected(scene.error());
  if (scene->lights.empty()) {
    return fail(ErrorCode::kUsage, plan.scene + ": there is no light", "a scene with one");
  }
  const auto start = Clock::now();
  std::vector<Advice> all;
  for (const LightsAsked lights : {LightsAsked::kPoint, LightsAsked::kArea}) {
    const bool area = lights == LightsAsked::kArea;
    if (std::ranges::none_of(scene->lights,
                             [&](const Light& light) { return light.has_area() == area; })) {
      continue;
    }
    TradeoffPlan runs = runs_of(plan, lights, *source);
    const double spent = std::chrono::duration<double>(Clock::now() - start).count();
    runs.budget = std::max(1.0, plan.budget - spent);
    runs.limits.seconds = *runs.budget;
    RunLog log;
    auto found = find_tradeoff(runs, program, log, control);
    if (!found) return tl::unexpected(found.error());
    if (found->interrupted) return fail(ErrorCode::kInterrupted, "interrupted");
    Advice& advice = all.emplace_back();
    advice.lights = lights;
    advice.runs = std::move(*found);
    advice.out_of_time = advice.runs.out_of_time;
    conclude(plan, advice);
  }
  return all;
}

std::string advice_text(const AdvicePlan& plan, const Advice& advice) {
  std::string text;
  if (advice.cheapest == nullptr) {
    text += "Right:     nothing that was tried in " + shortest(plan.budget) + " s\n";
  } else {
    text += "Right:     " + name_of_row(*advice.cheapest) + ", " +
            milliseconds(advice.cheapest->measurement.seconds) + " (" +
            how_it_is_known(advice, plan) + ")\n";
  }
  if (advice.exact == nullptr) {
    text += "Exact:     not reached\nBits:      not known\n";
  } else {
    text += "Exact:     " + name_of_row(*advice.exact) + ", " +
            milliseconds(advice.exact->measurement.seconds);
    if (advice.cheapest != nullptr && advice.cheapest != advice.exact) {
      text += ", " +
              rounded(advice.exact->measurement.seconds / advice.cheapest->measurement.seconds, 2) +
              " times as long";
    }
    text += "\nBits:      " + bits_text(advice.exact->measurement) + '\n';
  }
  text += "Thickness: " + thickness_text(advice, plan.tolerance) + '\n';
  const TradeoffRow* const choice = advice.cheapest != nullptr ? advice.cheapest : advice.exact;
  text += "Type:      " +
          (choice != nullptr ? command_for(plan, *choice) : "gnomon certify " + plan.scene) +
          (advice.out_of_time ? "   (out of time: not all was tried)" : "") + '\n';
  return text;
}

}  // namespace gnomon::comparison
