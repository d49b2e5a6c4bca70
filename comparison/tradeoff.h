// SPDX-License-Identifier: GPL-3.0-or-later
// Speed against accuracy on somebody's own scenes: every kernel, with planes of several
// thicknesses where it has one, by every method; each in a process of its own (comparison.h), its
// time beside what is wrong with its answer.
#ifndef GNOMON_COMPARISON_TRADEOFF_H
#define GNOMON_COMPARISON_TRADEOFF_H

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "comparison/comparison.h"
#include "comparison/run_log.h"

namespace gnomon::comparison {

struct TradeoffPlan {
  std::vector<SceneSource> scenes;
  std::vector<std::uint64_t> sizes;  // polygons; empty: each scene as it is by default
  std::vector<std::string> systems;  // empty: all that take the lights
  std::vector<std::string> kernels;  // parse_kernel_choice()
  /// Of kernels that have a thickness, besides those whose name fixes it ("double+thin").
  std::vector<double> thicknesses;
  std::vector<std::string> changes;  // of scene_change.h; empty: the scenes as they are
  std::uint64_t seed = 1, repeat = 0, certify_up_to = kCertifyUpTo;
  bool points = false;              // RunRequest::points
  bool stages = false;              // RunRequest::stages
  std::optional<LightsAsked> only;  // else every kind that a scene has
  std::optional<double> budget;     // seconds of the clock, after which nothing more is begun
  RunLimits limits;
};

/// 0, and every power of ten from 1e-15 to 1e-3.
std::vector<double> usual_thicknesses();

struct TradeoffRow : Row {
  /// Nothing on the same scene is both as fast and as accurate, and better in one of the two.
  bool on_front = false;
};

/// What is wrong with an answer, as one number: the greatest share of a polygon that is wrong; 0 of
/// an answer that is identical to the exact one. Nothing if it was not judged.
std::optional<double> error_of(const Measurement& measurement);

/// A range of thicknesses that were tried one after another and were all right.
struct ThicknessRange {
  double from = 0, to = 0;
};

/// Of one scene, kernel and method: with which thicknesses its answer is within tolerance.
struct ThicknessVerdict {
  std::string scene, kernel, system;
  LightsAsked lights = LightsAsked::kPoint;
  std::size_t tried = 0, judged = 0;
  std::vector<ThicknessRange> right;
  std::vector<double> right_ones;
};

/// How many scenes are right with one thickness.
struct ThicknessScore {
  double thickness = 0;
  std::size_t right = 0;
};

struct Tradeoff {
  std::vector<TradeoffRow> rows;
  bool interrupted = false, out_of_time = false;  // rows that were not reached are missing
  std::vector<std::string> contradictions;        // as of comparisons
};

/// The runs of a plan: by scene, size, lights, method, kernel, thickness and change. A scene with
/// both kinds of lights is run with each. Errors: those of planned_runs().
Expected<std::vector<Planned>> tradeoff_runs(const TradeoffPlan& plan);

/// Runs all of it but what the log has, to which each run is added. Errors: those of
/// tradeoff_runs(), run_in_process() and the log; an interrupted one is none.
Expected<Tradeoff> find_tradeoff(const TradeoffPlan& plan, const RunProgram& program, RunLog& log,
                                 const CompareControl& control = {});

/// `gnomon tradeoff` with the words that make this row again.
std::string tradeoff_command_of(const RunRequest& request, const RunLimits& limits);

std::vector<ThicknessVerdict> thickness_verdicts(const Tradeoff& tradeoff);
/// Best first; of equally good ones the one nearest to the default, as a ratio.
std::vector<ThicknessScore> thickness_scores(const std::vector<ThicknessVerdict>& verdicts);

}  // namespace gnomon::comparison

#endif  // GNOMON_COMPARISON_TRADEOFF_H
