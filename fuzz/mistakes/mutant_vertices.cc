// SPDX-License-Identifier: GPL-3.0-or-later
#include "algorithms/run/receiver_run.h"
#include "algorithms/sectors/sector_run.h"
#include "algorithms/svbsp/by_svbsp.inl.h"
#include "fuzz/mistakes/mutant_kernels.h"
#include "fuzz/mistakes/mutant_space.h"

namespace gnomon::fuzz {

MethodFunction vertices_per_side_function(MethodId method, KernelId) {
  switch (method) {
    case MethodId::kSectors:
    case MethodId::kTwoPass:
    case MethodId::kBlots:
      return BySectors<SplitVerticesKernel>::run;
    case MethodId::kSvbsp:
      return BySvbsp<SplitVerticesKernel>::run;
    default:
      return ByReceiver<SplitVerticesKernel>::run;
  }
}

}  // namespace gnomon::fuzz
