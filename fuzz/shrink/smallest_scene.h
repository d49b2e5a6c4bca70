// SPDX-License-Identifier: GPL-3.0-or-later
// The smallest scene so far that fails alike, and the one way to a smaller one: an attempt. It asks
// the predicate as seldom as it can, counts, and stops when its time is over.
#ifndef GNOMON_FUZZ_SHRINK_SMALLEST_SCENE_H
#define GNOMON_FUZZ_SHRINK_SMALLEST_SCENE_H

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string_view>
#include <unordered_set>
#include <utility>

#include "fuzz/shrink/coordinate_range.h"
#include "fuzz/shrink/shrink.h"

namespace gnomon::fuzz {

class SmallestScene {
 public:
  SmallestScene(Scene scene, const StillFails& fails, const ShrinkOptions& options);

  const Scene& best() const { return best_; }
  const ShrinkOptions& options() const { return options_; }
  /// Its time is over, or the caller interrupted it.
  bool stopped() const { return stopped_; }
  std::uint64_t accepted() const { return result_.accepted; }

  /// Is the candidate smaller, and does it fail? Then it is the best from here on. `any_size`: also
  /// if it is larger.
  bool attempt(Scene candidate, bool any_size = false);
  /// The same for a scene whose unused vertices and doubled positions are to go; where tidying does
  /// away with the failure, as it is.
  bool attempt_tidy(Scene candidate);

  /// Runs a step whose attempts count for the pass of this name, unless it has stopped.
  template <class Step>
  void in(std::string_view name, const Step& step) {
    if (stopped_) return;
    pass_ = &*std::ranges::find(result_.passes, name, &ShrinkPass::name);
    step(*this);
  }

  ShrinkResult take_result(std::uint64_t rounds, bool locally_minimal);

 private:
  using Clock = std::chrono::steady_clock;
  bool out_of_time() const;
  bool is_in_range(const Scene& scene) const;

  const StillFails& fails_;
  const ShrinkOptions& options_;
  const Clock::time_point start_;
  Scene best_;
  SceneSize size_;
  ShrinkResult result_;
  ShrinkPass* pass_ = nullptr;
  std::unordered_set<std::uint64_t> tried_;
  CoordinateRange range_;
  bool stopped_ = false;
};

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_SHRINK_SMALLEST_SCENE_H
