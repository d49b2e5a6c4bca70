// SPDX-License-Identifier: GPL-3.0-or-later
// Where each kernel begins to fail along an axis of difficulty (extreme_scenes.h), how, and what
// exactness costs there.
#ifndef GNOMON_COMPARISON_EXTREMES_H
#define GNOMON_COMPARISON_EXTREMES_H

#include <optional>
#include <string>
#include <vector>

#include "comparison/extreme_scenes.h"
#include "comparison/tradeoff.h"

namespace gnomon::comparison {

struct ExtremesPlan {
  std::vector<const ExtremeAxis*> axes;
  std::optional<int> from, to, steps;  // of each axis: within its own; how many, evenly
  bool sheared = false, bisect = false;
  /// What is run on each scene; its scenes are not read.
  TradeoffPlan runs;
};

/// One axis by one kernel, thickness and method; or by several that are one but for their name.
struct ExtremeCurve {
  const ExtremeAxis* axis = nullptr;
  std::string system, kernel;
  std::optional<double> thickness;
  bool exact = false;
  std::vector<int> steps;            // in order
  std::vector<const Row*> rows;      // of these steps
  std::optional<int> first_failure;  // the first step that is not right
  std::optional<int> last_right;     // before that
};

struct Extremes {
  Tradeoff runs;  // rows by axis, method, kernel, thickness and step
  std::vector<ExtremeCurve> curves;
};

/// What is wrong with a row, in a word or two: "width", "misclassified", "lost", "crashed",
/// "time limit"; empty if nothing is.
std::string failure_of(const Row& row);

/// The steps that are tried of an axis. Errors: kUsage, for a range that it does not have.
Expected<std::vector<int>> steps_of(const ExtremeAxis& axis, const ExtremesPlan& plan);

/// Runs all of it but what the log has; with `bisect` also steps between the last right one and the
/// first failure, until they are neighbours. Errors: those of find_tradeoff().
Expected<Extremes> find_extremes(const ExtremesPlan& plan, const RunProgram& program, RunLog& log,
                                 const CompareControl& control = {});

}  // namespace gnomon::comparison

#endif  // GNOMON_COMPARISON_EXTREMES_H
