// SPDX-License-Identifier: GPL-3.0-or-later
// The same shadows by several choices of method and kernel, timed in turn in this process.
#ifndef GNOMON_BENCH_CONTEST_H
#define GNOMON_BENCH_CONTEST_H

#include <cstddef>
#include <vector>

#include "gnomon/algorithms/shadow_result.h"
#include "gnomon/algorithms/shadows.h"
#include "gnomon/scene/prepare.h"
#include "timing.h"

namespace gnomon::bench {

/// One thread.
ShadowOptions options_for(MethodId method, KernelId kernel, bool identity = false);

/// Keeps each choice's last result.
class Contest {
 public:
  explicit Contest(const PreparedScene& scene) : scene_(scene) {}
  void enter(const ShadowOptions& options) { options_.push_back(options); }
  void run(int rounds);

  double cpu(std::size_t i) const { return median(times_[i].cpu); }
  double wall(std::size_t i) const { return median(times_[i].wall); }
  double ratio(std::size_t i, std::size_t j) const {
    return median_ratio(times_[i].cpu, times_[j].cpu);
  }
  double wall_ratio(std::size_t i, std::size_t j) const {
    return median_ratio(times_[i].wall, times_[j].wall);
  }
  const ShadowResult& result(std::size_t i) const { return results_[i]; }

 private:
  const PreparedScene& scene_;
  std::vector<ShadowOptions> options_;
  std::vector<ShadowResult> results_;
  std::vector<Times> times_;
};

}  // namespace gnomon::bench

#endif  // GNOMON_BENCH_CONTEST_H
