// SPDX-License-Identifier: LGPL-3.0-or-later
// Where did a rounded kernel first go wrong? Runs the whole algorithm on the kernel under test and
// on `plane` in lock-step and stops at the first decision on which they differ (kernel_pair.h).
#ifndef GNOMON_ALGORITHMS_EXPLAIN_H
#define GNOMON_ALGORITHMS_EXPLAIN_H

#include <optional>
#include <string>

#include "gnomon/algorithms/shadows.h"
#include "gnomon/kernel/differing_decision.h"

namespace gnomon {

struct FirstDifference {
  DifferingDecision decision;
  std::optional<std::uint32_t> light;  // index into PreparedScene::lights; none: the scene BSP
};

/// Nothing if every decision of the run agrees. Errors: those of compute_shadows; kUsage for an
/// exact kernel. Uses `kernel`, `identity`, `thickness`, `prefix`, `seed` and `lights` of the
/// options.
Expected<std::optional<FirstDifference>> explain(const PreparedScene& scene,
                                                 const ShadowOptions& options);

/// One or two sentences: what was asked, what each kernel answered, of which vertex and plane.
/// Vertices in "input vertex N" and "edge A-B" count the prepared scene's distinct positions.
std::string to_sentence(const FirstDifference& difference, const PreparedScene& scene,
                        const std::string& kernel, const std::vector<std::string>& light_names);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_EXPLAIN_H
