// SPDX-License-Identifier: LGPL-3.0-or-later
// The floating-point environment that proven error bounds need: round to nearest, no flush to zero,
// no denormals-are-zero, and a compiler that keeps IEEE semantics.
#ifndef GNOMON_KERNEL_SIGNS_FP_ENVIRONMENT_H
#define GNOMON_KERNEL_SIGNS_FP_ENVIRONMENT_H

#ifdef __FAST_MATH__
#error "Gnomon proves its error bounds for IEEE arithmetic: compile without -ffast-math"
#endif

#include "gnomon/kernel/error.h"

namespace gnomon {

/// Checks the calling thread. Errors: kUsage, saying which of the conditions does not hold.
Expected<void> check_fp_environment();

}  // namespace gnomon

#endif  // GNOMON_KERNEL_SIGNS_FP_ENVIRONMENT_H
