// SPDX-License-Identifier: LGPL-3.0-or-later
// What one run changed of the result of another, side by side.
#ifndef GNOMON_ALGORITHMS_RUN_DECISION_EFFECTS_H
#define GNOMON_ALGORITHMS_RUN_DECISION_EFFECTS_H

#include <span>

#include "gnomon/algorithms/explain.h"

namespace gnomon {

/// Classes and shares of all sides under one light; adds to `effect`.
void add_changes(const LightResult& before, const LightResult& after, RunEffect& effect);

/// Decisions by predicate, light and part; the largest group first.
std::vector<DecisionGroup> grouped(std::span<const DifferingDecision> decisions,
                                   const PreparedScene& scene);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_RUN_DECISION_EFFECTS_H
