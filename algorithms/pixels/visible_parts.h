// SPDX-License-Identifier: LGPL-3.0-or-later
// The visible parts of a picture, row by row: what every method of image space draws before it asks
// for light.
#ifndef GNOMON_ALGORITHMS_PIXELS_VISIBLE_PARTS_H
#define GNOMON_ALGORITHMS_PIXELS_VISIBLE_PARTS_H

#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/partition/insertion_order.h"
#include "algorithms/pixels/part_balls.h"
#include "algorithms/pixels/visible_row.h"

namespace gnomon {

template <ImageSpaceModel Space>
class VisibleParts {
 public:
  /// In the order that the task's options name.
  VisibleParts(ImageScene<Space>& scene, const PixelTask& task, const PartBalls& balls)
      : scene_(scene), balls_(balls) {
    std::vector<std::uint32_t> seen;
    for (std::uint32_t p = 0; p < task.scene.parts.size(); ++p) {
      if (scene.facing_eye(p).valid()) seen.push_back(p);
    }
    order_ = in_order(task.options.options.order, task.scene, task.frame.eye, seen);
  }

  /// Requires: nothing is drawn in the row.
  void draw_row(std::uint32_t row, std::span<std::uint32_t> seen, WorkCounts& work) {
    draw_row(row, seen, work, [](std::uint32_t, Span) {});
  }
  /// Calls drawn(part, span) for each span of a part that nothing drawn before hides; a part that
  /// is drawn later may.
  template <class Drawn>
  void draw_row(std::uint32_t row, std::span<std::uint32_t> seen, WorkCounts& work,
                const Drawn& drawn) {
    for (const std::uint32_t part : order_) {
      if (balls_.misses_row(part, row)) continue;
      const Span span = covered_span(scene_, part, row);
      if (span.empty()) continue;
      ++work[Counter::kSpans];
      covered_ += span.size();
      draw_span(scene_, part, span, row, seen, work, [&](Span own) { drawn(part, own); });
    }
  }

  /// Pairs of a sample and a part that covers it, so far.
  std::uint64_t covered() const { return covered_; }

 private:
  ImageScene<Space>& scene_;
  const PartBalls& balls_;
  std::vector<std::uint32_t> order_;
  std::uint64_t covered_ = 0;
};

/// use(part, span) of each longest span of a row that shows one part, from left to right.
template <class Use>
void for_each_run(std::span<const std::uint32_t> seen, const Use& use) {
  for (Span run; run.begin < seen.size(); run.begin = run.end) {
    const std::uint32_t part = seen[run.begin];
    while (run.end < seen.size() && seen[run.end] == part) ++run.end;
    if (part != Pixels::kNoPart) use(part, run);
  }
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PIXELS_VISIBLE_PARTS_H
