// SPDX-License-Identifier: LGPL-3.0-or-later
// The other half of the table of methods: what each runs on each kernel.
#ifndef GNOMON_ALGORITHMS_RUN_METHODS_H
#define GNOMON_ALGORITHMS_RUN_METHODS_H

#include "algorithms/partition/run_task.h"
#include "algorithms/pixels/pixel_task.h"
#include "gnomon/algorithms/method.h"
#include "gnomon/kernel/kernel_list.h"

namespace gnomon {

/// Null for a kernel that was left out of the build. Requires: not kAutomatic.
MethodFunction method_function(MethodId method, KernelId kernel);
/// Of a method of image space, in the same way. Null for one of object space.
PixelFunction pixel_function(MethodId method, KernelId kernel);
/// The same on the kernel of watched runs (kernel/watched/), whatever the kernel. Null for a method
/// that rounded kernels run in numbers of their own, so that no space sees their decisions.
MethodFunction watched_function(MethodId method, KernelId kernel);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_RUN_METHODS_H
