// SPDX-License-Identifier: GPL-3.0-or-later
#include "contest.h"

#include <functional>

#include "answers.h"

namespace gnomon::bench {

ShadowOptions options_for(MethodId method, KernelId kernel, bool identity) {
  ShadowOptions options;
  options.method.point = method;
  options.kernel.id = kernel;
  options.kernel.identity = identity;
  options.tuning.jobs = 1;
  return options;
}

void Contest::run(int rounds) {
  results_.resize(options_.size());
  std::vector<std::function<void()>> work;
  for (std::size_t i = 0; i < options_.size(); ++i) {
    work.emplace_back([this, i] { results_[i] = shadows_or_stop(scene_, options_[i]); });
  }
  times_ = interleaved(work, rounds);
}

}  // namespace gnomon::bench
