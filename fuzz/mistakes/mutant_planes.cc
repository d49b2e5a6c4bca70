// SPDX-License-Identifier: GPL-3.0-or-later
#include "algorithms/svbsp/by_svbsp.inl.h"
#include "fuzz/mistakes/mutant_kernels.h"
#include "fuzz/mistakes/mutant_space.h"

namespace gnomon::fuzz {

MethodFunction planes_from_fragments_function(MethodId method, KernelId kernel) {
  return method == MethodId::kSvbsp ? BySvbsp<FragmentPlanesKernel>::run
                                    : method_function(method, kernel);
}

}  // namespace gnomon::fuzz
