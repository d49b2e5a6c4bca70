// SPDX-License-Identifier: LGPL-3.0-or-later
#include "kernel/signs/fp_environment.h"

#include <cfenv>
#include <limits>

namespace gnomon {

Expected<void> check_fp_environment() {
  if (std::fegetround() != FE_TONEAREST) {
    return fail(ErrorCode::kUsage, "the floating-point rounding mode is not round-to-nearest",
                "fesetround(FE_TONEAREST) in every thread that calls the library");
  }
  // volatile: the compiler must not fold what the processor's mode decides.
  volatile double smallest = std::numeric_limits<double>::min();
  volatile double half = smallest / 2;
  volatile double back = half * 2;
  if (half == 0 || back != smallest) {
    return fail(ErrorCode::kUsage, "subnormal numbers are flushed to zero",
                "flush-to-zero and denormals-are-zero off in every thread that calls the library");
  }
  return {};
}

}  // namespace gnomon
