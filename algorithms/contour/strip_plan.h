// SPDX-License-Identifier: LGPL-3.0-or-later
// How a chart is cut into strips of v for the search of pairs. Borders are quantiles of the low
// ends of a sample of the boxes, so that strips hold about equally many whatever the boxes' places
// and sizes; their number makes the expected work least.
//
// Answers never depend on the plan, since only the order of two values of v counts: a box lies in
// the strips from that of its low v to that of its high v, and two boxes that overlap are reported
// in the strip of the greater of their low v, which both lie in.
#ifndef GNOMON_ALGORITHMS_CONTOUR_STRIP_PLAN_H
#define GNOMON_ALGORITHMS_CONTOUR_STRIP_PLAN_H

#include <cstddef>
#include <cstdint>
#include <vector>

#include "algorithms/contour/chart_boxes.h"

namespace gnomon {

/// How many of the values `holds` is true for, which is so for the first ones. No branch depends on
/// the values.
template <class Holds>
std::uint32_t count_while(const std::vector<float>& values, const Holds& holds) {
  const float* at = values.data();
  for (std::size_t n = values.size(); n > 0;) {
    const std::size_t half = (n + 1) / 2;
    at += half & (std::size_t{0} - static_cast<std::size_t>(holds(at[half - 1])));
    n -= half;
  }
  return static_cast<std::uint32_t>(at - values.data());
}

class StripPlan {
 public:
  void make(const ChartBoxes& boxes);

  std::uint32_t strips() const { return static_cast<std::uint32_t>(borders_.size()) + 1; }
  /// The number of borders that are not above v.
  std::uint32_t strip_of(float v) const {
    return count_while(borders_, [v](float border) { return border <= v; });
  }

 private:
  void take_sample(const ChartBoxes& boxes, std::uint32_t count);
  std::uint32_t best_number(std::uint32_t boxes);

  std::vector<std::uint32_t> sample_;  // boxes
  std::vector<float> low_u_, low_v_;   // of the sample, sorted
  std::vector<float> share_u_, share_v_;
  std::vector<float> borders_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_STRIP_PLAN_H
