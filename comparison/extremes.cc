// SPDX-License-Identifier: GPL-3.0-or-later
#include "comparison/extremes.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace gnomon::comparison {

namespace {

/// Which axis a row is of, and which step. Requires: the row of an extreme.
struct StepOfRow {
  const ExtremeAxis* axis = nullptr;
  int step = 0;
};

using CurveKey = std::tuple<const ExtremeAxis*, std::string, std::string, double>;

class Sweep {
 public:
  Sweep(const ExtremesPlan& plan, const RunProgram& program, RunLog& log,
        const CompareControl& control)
      : plan_(plan), program_(program), log_(log), control_(control) {}

  Expected<Extremes> operator()() {
    for (const ExtremeAxis* axis : plan_.axes) {
      const auto steps = steps_of(*axis, plan_);
      if (!steps) return tl::unexpected(steps.error());
      for (const int step : *steps) add_scene(*axis, step);
    }
    if (auto done = run(); !done) return tl::unexpected(done.error());
    while (plan_.bisect && !extremes_.runs.interrupted && add_scenes_between()) {
      if (auto done = run(); !done) return tl::unexpected(done.error());
    }
    return std::move(extremes_);
  }

 private:
  void add_scene(const ExtremeAxis& axis, int step) {
    const std::string name = extreme_name(axis, step, plan_.sheared);
    if (!steps_.emplace(name, StepOfRow{&axis, step}).second) return;
    scenes_.push_back(*SceneSource::parse(name));
  }

  // All scenes; what the log has is not run again.
  Expected<void> run() {
    TradeoffPlan plan = plan_.runs;
    plan.scenes = scenes_;
    plan.stages = true;
    auto found = find_tradeoff(plan, program_, log_, control_);
    if (!found) return tl::unexpected(found.error());
    extremes_.runs = std::move(*found);
    make_curves();
    return {};
  }

  void make_curves() {
    std::map<CurveKey, std::map<int, const Row*>> series;
    std::vector<CurveKey> order;
    for (const TradeoffRow& row : extremes_.runs.rows) {
      const StepOfRow& at = steps_.at(row.request.scene);
      const CurveKey key{at.axis, row.request.system, row.request.kernel,
                         row.request.thickness.value_or(-1)};
      auto& rows = series[key];
      if (rows.empty()) order.push_back(key);
      rows[at.step] = &row;
    }
    std::ranges::stable_sort(order, {}, [&](const CurveKey& key) {
      return std::ranges::find(plan_.axes, std::get<0>(key)) - plan_.axes.begin();
    });
    extremes_.curves.clear();
    for (const CurveKey& key : order) extremes_.curves.push_back(curve_of(series[key]));
  }

  ExtremeCurve curve_of(const std::map<int, const Row*>& rows) const {
    ExtremeCurve curve;
    const Row& first = *rows.begin()->second;
    curve.axis = steps_.at(first.request.scene).axis;
    curve.system = first.request.system;
    curve.kernel = first.request.kernel;
    curve.thickness = first.request.thickness;
    for (const auto& [step, row] : rows) {
      curve.steps.push_back(step);
      curve.rows.push_back(row);
      curve.exact = curve.exact || row->measurement.exact;
      if (curve.first_failure) continue;
      if (failure_of(*row).empty()) {
        curve.last_right = step;
      } else {
        curve.first_failure = step;
      }
    }
    return curve;
  }

  bool add_scenes_between() {
    std::set<std::pair<const ExtremeAxis*, int>> more;
    for (const ExtremeCurve& curve : extremes_.curves) {
      if (!curve.first_failure || !curve.last_right) continue;
      if (*curve.first_failure - *curve.last_right < 2) continue;
      more.emplace(curve.axis, *curve.last_right + (*curve.first_failure - *curve.last_right) / 2);
    }
    for (const auto& [axis, step] : more) add_scene(*axis, step);
    return !more.empty();
  }

  const ExtremesPlan& plan_;
  const RunProgram& program_;
  RunLog& log_;
  const CompareControl& control_;
  std::vector<SceneSource> scenes_;
  std::map<std::string, StepOfRow> steps_;  // by the scene's name
  Extremes extremes_;
};

}  // namespace

std::string failure_of(const Row& row) {
  const Measurement& measurement = row.measurement;
  if (measurement.end != RunEnd::kMeasured) return std::string(name_of(measurement.end));
  if (!measurement.judgement) return "not judged";
  const Judgement& judgement = *measurement.judgement;
  if (measurement.exact ? judgement.confirms : judgement.verdict != "failed") return {};
  constexpr double kTolerance = 1e-9;  // of certify
  if (judgement.worst_share > kTolerance) {
    std::string text = judgement.breaks.substr(0, judgement.breaks.find(':'));
    if (judgement.lost > 0) text += ", lost regions";
    return text.empty() ? "share" : text;
  }
  return judgement.width > kTolerance * judgement.diagonal ? "width" : "other";
}

Expected<std::vector<int>> steps_of(const ExtremeAxis& axis, const ExtremesPlan& plan) {
  const int from = plan.from.value_or(axis.first), to = plan.to.value_or(axis.last);
  if (from > to || from < axis.first || to > axis.last) {
    return fail(ErrorCode::kUsage,
                "axis " + std::string(axis.name) + " has no steps from " + std::to_string(from) +
                    " to " + std::to_string(to),
                std::to_string(axis.first) + " to " + std::to_string(axis.last));
  }
  std::vector<int> steps;
  if (plan.steps) {
    const int count = std::min(*plan.steps, to - from + 1);
    for (int i = 0; i < count; ++i) {
      steps.push_back(count == 1 ? from : from + (to - from) * i / (count - 1));
    }
  } else {
    for (int step = from; step <= to; step += axis.stride) steps.push_back(step);
    if (steps.back() != to) steps.push_back(to);
  }
  return steps;
}

Expected<Extremes> find_extremes(const ExtremesPlan& plan, const RunProgram& program, RunLog& log,
                                 const CompareControl& control) {
  return Sweep(plan, program, log, control)();
}

}  // namespace gnomon::comparison
