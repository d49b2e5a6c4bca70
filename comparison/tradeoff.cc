// SPDX-License-Identifier: GPL-3.0-or-later
#include "comparison/tradeoff.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "gnomon/algorithms/method.h"
#include "gnomon/algorithms/method_options.h"
#include "gnomon/kernel/kernel_choice.h"
#include "report/text/number_text.h"

namespace gnomon::comparison {

namespace {

/// The thicknesses with which a kernel is run.
std::vector<std::optional<double>> thicknesses_of(const TradeoffPlan& plan,
                                                  const std::string& kernel) {
  const auto choice = parse_kernel_choice(kernel);
  const bool swept = choice && kernel_info(choice->kernel).has_thickness && !choice->thin &&
                     !plan.thicknesses.empty();
  if (!swept) return {std::nullopt};
  return {plan.thicknesses.begin(), plan.thicknesses.end()};
}

/// The runs of one scene and kind of lights.
void add_runs(const TradeoffPlan& plan, RunRequest request, std::uint64_t polygons,
              std::vector<Planned>& all) {
  const std::vector<std::string> systems =
      plan.systems.empty() ? systems_for(request.lights) : plan.systems;
  const std::vector<std::string> unchanged = {""};
  for (const std::string& system : systems) {
    // Of several scenes some may have other lights.
    const auto method = parse_method(system);
    if (method && !(request.lights == LightsAsked::kArea ? method_info(method->id).lights.area
                                                         : method_info(method->id).lights.point)) {
      continue;
    }
    request.system = system;
    for (const std::string& kernel : plan.kernels) {
      request.kernel = kernel;
      for (const std::optional<double> thickness : thicknesses_of(plan, kernel)) {
        request.thickness = thickness;
        for (const std::string& change : plan.changes.empty() ? unchanged : plan.changes) {
          request.change = change;
          all.push_back({request, polygons});
        }
      }
    }
  }
}

/// Rows of one scene that can be chosen between.
using Group = std::tuple<std::string, std::optional<std::uint64_t>, LightsAsked, std::string>;
Group group_of(const RunRequest& request) {
  return {request.scene, request.size, request.lights, request.change};
}

void mark_front(std::vector<TradeoffRow>& rows) {
  std::map<Group, std::vector<TradeoffRow*>> groups;
  for (TradeoffRow& row : rows) {
    if (row.measurement.timed() && error_of(row.measurement)) {
      groups[group_of(row.request)].push_back(&row);
    }
  }
  for (auto& [group, members] : groups) {
    std::ranges::stable_sort(members, {}, [](const TradeoffRow* row) {
      return std::pair(row->measurement.seconds, *error_of(row->measurement));
    });
    double least = std::numeric_limits<double>::infinity();
    for (TradeoffRow* row : members) {
      const double error = *error_of(row->measurement);
      row->on_front = error < least;
      least = std::min(least, error);
    }
  }
}

bool is_right(const Measurement& measurement) {
  return measurement.judgement && measurement.judgement->verdict != "failed";
}

}  // namespace

std::vector<double> usual_thicknesses() {
  return {0, 1e-15, 1e-14, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3};
}

std::optional<double> error_of(const Measurement& measurement) {
  if (!measurement.judgement) return std::nullopt;
  return std::max(measurement.judgement->worst_share, measurement.judgement->wrong);
}

Expected<std::vector<Planned>> tradeoff_runs(const TradeoffPlan& plan) {
  std::vector<Planned> all;
  const auto add = [&](const Scene& scene, RunRequest request) {
    for (const LightsAsked lights : {LightsAsked::kPoint, LightsAsked::kArea}) {
      const bool area = lights == LightsAsked::kArea;
      const bool has = std::ranges::any_of(
          scene.lights, [&](const Light& light) { return light.has_area() == area; });
      if (!has || (plan.only && *plan.only != lights)) continue;
      request.lights = lights;
      request.points = plan.points;
      request.stages = plan.stages;
      request.repeat = plan.repeat;
      request.certify_up_to = plan.certify_up_to;
      add_runs(plan, request, scene.polygons.size(), all);
    }
  };
  if (auto done = for_each_scene(plan.scenes, plan.sizes, plan.seed, add); !done) {
    return tl::unexpected(std::move(done.error()));
  }
  return all;
}

Expected<Tradeoff> find_tradeoff(const TradeoffPlan& plan, const RunProgram& program, RunLog& log,
                                 const CompareControl& control) {
  const auto all = tradeoff_runs(plan);
  if (!all) return tl::unexpected(all.error());
  Tradeoff tradeoff;
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  for (const auto& [request, polygons] : *all) {
    const double spent = std::chrono::duration<double>(Clock::now() - start).count();
    if (plan.budget && spent > *plan.budget) {
      tradeoff.out_of_time = true;
      break;
    }
    if (control.progress) control.progress(request, tradeoff.rows.size(), all->size());
    std::optional<Measurement> before = log.find(request);
    const bool is_new = !before;
    auto measured = before ? Expected<Measurement>(std::move(*before))
                           : run_in_process(program, request, plan.limits, control.interrupted);
    if (!measured) {
      if (measured.error().code != ErrorCode::kInterrupted) {
        return tl::unexpected(measured.error());
      }
      tradeoff.interrupted = true;
      break;
    }
    if (is_new) {
      if (auto added = log.add(request, *measured); !added) return tl::unexpected(added.error());
    }
    TradeoffRow& row = tradeoff.rows.emplace_back();
    row.request = request;
    row.polygons = polygons;
    row.measurement = std::move(*measured);
    row.command = tradeoff_command_of(request, plan.limits);
  }
  mark_front(tradeoff.rows);
  std::vector<const Row*> rows;
  for (const TradeoffRow& row : tradeoff.rows) rows.push_back(&row);
  tradeoff.contradictions = contradictions_of(rows);
  return tradeoff;
}

std::string tradeoff_command_of(const RunRequest& request, const RunLimits& limits) {
  std::string text = command_of(request, limits);
  constexpr std::string_view kCompare = "gnomon compare";
  text.replace(0, kCompare.size(), "gnomon tradeoff");
  if (request.thickness) text += " --try " + report::shortest(*request.thickness);
  if (!request.change.empty()) text += " --change '" + request.change + '\'';
  return text;
}

std::vector<ThicknessVerdict> thickness_verdicts(const Tradeoff& tradeoff) {
  std::vector<ThicknessVerdict> verdicts;
  bool goes_on = false;  // the range that is last
  for (const TradeoffRow& row : tradeoff.rows) {
    if (!row.request.thickness) continue;
    const double thickness = *row.request.thickness;
    const auto is_of = [&](const ThicknessVerdict& verdict) {
      return verdict.scene == row.request.scene && verdict.kernel == row.request.kernel &&
             verdict.system == row.request.system && verdict.lights == row.request.lights;
    };
    if (verdicts.empty() || !is_of(verdicts.back())) {
      verdicts.push_back({row.request.scene,
                          row.request.kernel,
                          row.request.system,
                          row.request.lights,
                          0,
                          0,
                          {},
                          {}});
      goes_on = false;
    }
    ThicknessVerdict& verdict = verdicts.back();
    ++verdict.tried;
    verdict.judged += row.measurement.judgement.has_value();
    const bool right = is_right(row.measurement);
    if (right) {
      verdict.right_ones.push_back(thickness);
      if (goes_on) {
        verdict.right.back().to = thickness;
      } else {
        verdict.right.push_back({thickness, thickness});
      }
    }
    goes_on = right;
  }
  return verdicts;
}

std::vector<ThicknessScore> thickness_scores(const std::vector<ThicknessVerdict>& verdicts) {
  std::map<double, std::size_t> right;
  for (const ThicknessVerdict& verdict : verdicts) {
    for (const double thickness : verdict.right_ones) ++right[thickness];
  }
  std::vector<ThicknessScore> scores;
  for (const auto& [thickness, count] : right) scores.push_back({thickness, count});
  const auto far = [](const ThicknessScore& score) {
    return score.thickness > 0 ? std::fabs(std::log(score.thickness / kDefaultThickness))
                               : std::numeric_limits<double>::infinity();
  };
  std::ranges::sort(scores, [&](const ThicknessScore& a, const ThicknessScore& b) {
    return a.right != b.right ? a.right > b.right : far(a) < far(b);
  });
  return scores;
}

}  // namespace gnomon::comparison
