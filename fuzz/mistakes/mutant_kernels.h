// SPDX-License-Identifier: GPL-3.0-or-later
// What methods run on the kernels with a mistake, in the form of the table of methods. Each mutant
// is the kernel `double` but for its mistake.
#ifndef GNOMON_FUZZ_MISTAKES_MUTANT_KERNELS_H
#define GNOMON_FUZZ_MISTAKES_MUTANT_KERNELS_H

#include "algorithms/run/methods.h"

namespace gnomon::fuzz {

/// The planes of fragments are made by svbsp alone: other methods run on the sound kernel.
MethodFunction planes_from_fragments_function(MethodId method, KernelId kernel);
MethodFunction vertices_per_side_function(MethodId method, KernelId kernel);

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_MISTAKES_MUTANT_KERNELS_H
