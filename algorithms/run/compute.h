// SPDX-License-Identifier: LGPL-3.0-or-later
// The run behind compute_shadows(), with the choices that only tests of the judges vary: the rules
// of the definition, and the functions that run a method on a kernel.
#ifndef GNOMON_ALGORITHMS_RUN_COMPUTE_H
#define GNOMON_ALGORITHMS_RUN_COMPUTE_H

#include "algorithms/partition/run_task.h"
#include "algorithms/run/methods.h"

namespace gnomon {

using MethodLookup = MethodFunction (*)(MethodId, KernelId);

/// The lights asked for, or all. Errors: kUsage (no such light, a thickness outside [0, 1), a
/// floating-point environment without IEEE semantics).
Expected<LightList> select_lights(const PreparedScene& scene, const ShadowOptions& options);

/// The method that point and directional lights, or area lights, take under these options.
/// `together`: they are classified together.
MethodId method_of(LightType light, const ShadowOptions& options, bool together);

/// As compute_shadows().
Expected<ShadowResult> compute_with(const PreparedScene& scene, const ShadowOptions& options,
                                    const Rules& rules, MethodLookup lookup = method_function);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_RUN_COMPUTE_H
