// SPDX-License-Identifier: GPL-3.0-or-later
// Which kernel, method and thickness somebody's scene requires, from measurements on that scene.
#ifndef GNOMON_COMPARISON_ADVICE_H
#define GNOMON_COMPARISON_ADVICE_H

#include <optional>
#include <string>
#include <vector>

#include "comparison/tradeoff.h"

namespace gnomon::comparison {

struct AdvicePlan {
  std::string scene;        // SceneSource::parse()
  double tolerance = 1e-9;  // wrong share of a polygon, and width by the scene's diagonal
  double budget = 60;       // seconds of the clock for all of it
  /// Scenes of at most so many polygons are judged whole; larger ones by exact points.
  std::uint64_t certify_up_to = 2000;
};

/// What is measured of one kind of lights, and what follows.
struct Advice {
  LightsAsked lights = LightsAsked::kPoint;
  Tradeoff runs;
  const TradeoffRow* cheapest = nullptr;        // that is right; none: nothing was
  const TradeoffRow* exact = nullptr;           // the cheapest exact one
  std::vector<ThicknessRange> double_is_right;  // by the method of the cheapest double
  bool by_points = false;                       // of the cheapest: not proven
  bool out_of_time = false;                     // not all was tried
};

/// Whether a row is right within a tolerance, as far as it was judged.
bool is_within(const Measurement& measurement, double tolerance);

/// One for each kind of lights that the scene has. Errors: of the scene; of starting processes;
/// kInterrupted.
Expected<std::vector<Advice>> advise(const AdvicePlan& plan, const RunProgram& program,
                                     const CompareControl& control = {});

/// Five lines.
std::string advice_text(const AdvicePlan& plan, const Advice& advice);

}  // namespace gnomon::comparison

#endif  // GNOMON_COMPARISON_ADVICE_H
