// SPDX-License-Identifier: LGPL-3.0-or-later
// What every method of image space is given to do, and where it puts its samples: the signature
// behind the rows of image space in the table of methods.
#ifndef GNOMON_ALGORITHMS_PIXELS_PIXEL_TASK_H
#define GNOMON_ALGORITHMS_PIXELS_PIXEL_TASK_H

#include <cstdint>
#include <span>

#include "algorithms/partition/rules.h"
#include "gnomon/algorithms/pixels.h"

namespace gnomon {

/// The picture as a method fills it. Rows are independent: different threads may fill different
/// ones.
class PixelSink {
 public:
  /// `part` and `lit_by` of a row, a sample each; at first nothing is seen.
  struct Row {
    std::span<std::uint32_t> part;
    std::span<std::uint64_t> lit_by;
  };

  /// `with_casters`: Pixels::casters is wanted.
  PixelSink(Pixels& pixels, bool with_casters) : pixels_(pixels) {
    const std::size_t samples = std::size_t{pixels.width} * pixels.height;
    pixels.part.assign(samples, Pixels::kNoPart);
    pixels.lit_by.assign(samples, 0);
    if (with_casters) pixels.casters.assign(samples * pixels.lights.size(), 0);
  }
  Row row(std::uint32_t j) {
    const std::size_t first = pixels_.index({0, j});
    return {std::span(pixels_.part).subspan(first, pixels_.width),
            std::span(pixels_.lit_by).subspan(first, pixels_.width)};
  }
  /// Pixels::casters of a row under the task's l-th light; empty if they are not wanted.
  std::span<std::int32_t> casters(std::uint32_t j, std::size_t l) {
    if (pixels_.casters.empty()) return {};
    const std::size_t first = l * pixels_.part.size() + pixels_.index({0, j});
    return std::span(pixels_.casters).subspan(first, pixels_.width);
  }

 private:
  Pixels& pixels_;
};

struct PixelTask {
  const PreparedScene& scene;
  const ImageFrame& frame;
  const PixelOptions& options;
  const Rules& rules;
  /// Point and directional ones, at most 64; bit b of a sample is of the b-th.
  const std::vector<std::uint32_t>& lights;
  PixelSink& sink;

  bool interrupted() const {
    const std::atomic<bool>* flag = options.control.interrupted;
    return flag != nullptr && flag->load(std::memory_order_relaxed);
  }
};

/// What a method says besides its samples.
struct PixelWork {
  WorkCounts work;
  StageCounts stages;
  double table_seconds = 0, lookup_seconds = 0;  // as Pixels has them
};

/// A method of image space on a kernel. Errors: kInterrupted, kGeometry.
using PixelFunction = Expected<PixelWork> (*)(const PixelTask&);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PIXELS_PIXEL_TASK_H
