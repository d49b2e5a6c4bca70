// SPDX-License-Identifier: GPL-3.0-or-later
// One run of a comparison, in the process that it has for itself: make the scene, classify it on
// one thread until the clock has seen enough, once more for the answer, and let the oracle judge
// it.
#ifndef GNOMON_COMPARISON_RUN_MEASUREMENT_H
#define GNOMON_COMPARISON_RUN_MEASUREMENT_H

#include <functional>
#include <string_view>

#include "comparison/measurement.h"

namespace gnomon::comparison {

/// `told` hears of the measurement whenever more of it is known: after the clock, after the
/// checksum, after the verdict. The last word is returned. Never an error: what cannot be run is
/// refused.
Measurement measure(const RunRequest& request,
                    const std::function<void(const Measurement&)>& told = {});

/// The exit status of a process that had too little memory.
inline constexpr int kOutOfMemoryStatus = 3;

/// The main function of a run's process: reads the request, prints measurements to standard output,
/// a line each. Returns the exit status.
int measurement_main(std::string_view request);

}  // namespace gnomon::comparison

#endif  // GNOMON_COMPARISON_RUN_MEASUREMENT_H
