// SPDX-License-Identifier: LGPL-3.0-or-later
// The functions that CMake has compiled for each kernel (kernel_run.cc.in), as a table by KernelId.
#ifndef GNOMON_ALGORITHMS_RUN_ON_EVERY_KERNEL_H
#define GNOMON_ALGORITHMS_RUN_ON_EVERY_KERNEL_H

#include <array>
#include <cstddef>

#include "gnomon/kernel/kernel_list.h"

namespace gnomon {

// Only their names are needed here: no function below has a kernel in its signature.
#define GNOMON_KERNEL(id, name, kernel, ...) struct kernel;
#include "gnomon/kernel/kernels.def"

inline constexpr std::size_t kKernelCount = 0
#define GNOMON_KERNEL(...) +1
#include "gnomon/kernel/kernels.def"
    ;

/// Which kernels a function was compiled for.
enum class CompiledFor : std::uint8_t { kEveryKernel, kRoundedKernels };

/// `Run<Kernel>::run` of every kernel, by KernelId. Null for kernels that it was not compiled for,
/// or that were left out of the build.
template <template <class> class Run, CompiledFor kernels = CompiledFor::kEveryKernel>
constexpr auto on_every_kernel() {
  using Function = decltype(&Run<ImplicitKernel>::run);
  const auto function = []<class Kernel, bool kExact>() -> Function {
    if constexpr (kExact && kernels == CompiledFor::kRoundedKernels) {
      return nullptr;
    } else {
      return &Run<Kernel>::run;
    }
  };
  return std::array<Function, kKernelCount>{
#define GNOMON_KERNEL(id, name, kernel, header, exact, ...) \
  function.template operator()<kernel, exact>(),
#ifdef GNOMON_NO_CGAL_KERNELS
#define GNOMON_CGAL_KERNEL(...) nullptr,
#endif
#include "gnomon/kernel/kernels.def"
  };
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_RUN_ON_EVERY_KERNEL_H
