// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/binding/run_options.h"

#include <tbb/info.h>

#include <algorithm>
#include <utility>

#include "gnomon/algorithms/method.h"
#include "gnomon/algorithms/method_options.h"
#include "gnomon/kernel/kernel_choice.h"

namespace gnomon::python {

unsigned usable_jobs(unsigned jobs) {
  return std::min(jobs, static_cast<unsigned>(tbb::info::default_concurrency()));
}

Expected<ShadowOptions> shadow_options(const RunNames& names, const std::atomic<bool>& stop) {
  auto kernel = parse_kernel_choice(names.kernel);
  if (!kernel) return tl::unexpected(std::move(kernel.error()));
  ShadowOptions options;
  options.kernel.id = kernel->kernel;
  options.kernel.identity = kernel->identity;
  if (kernel->thin) options.kernel.thickness = 0;
  options.tuning.jobs = usable_jobs(names.jobs);
  options.control.interrupted = &stop;
  // Left alone, compute_shadows() takes the method that is best for what is asked.
  if (names.algorithm == "auto") return options;
  auto method = parse_method(names.algorithm);
  if (!method) {
    method.error().what = "--algorithm " + method.error().what;
    method.error().expected += ", auto";
    return tl::unexpected(std::move(method.error()));
  }
  const LightKinds takes = method_info(method->id).lights;
  if (takes.point) options.method.point = method->id;
  if (takes.area) options.method.area = method->id;
  options.method.options = method->values;
  return options;
}

}  // namespace gnomon::python
