// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/contour/strip_plan.h"

#include <algorithm>

#include "algorithms/contour/strip_layers.h"

namespace gnomon {
namespace {

// Below this number of boxes a plan costs more than it saves.
constexpr std::uint32_t kFewBoxes = 128;
// So many boxes a strip at most, where there are many, for the sake of threads and caches.
constexpr std::uint32_t kMostBoxes = 8192;
// So many at least: what a query tests at one go.
constexpr std::uint32_t kLeastBoxes = 16;

/// Which share of the sorted values, the box's own apart, lies between two values.
float share_between(const std::vector<float>& sorted, float low, float high) {
  const std::uint32_t begin = count_while(sorted, [low](float value) { return value < low; });
  const std::uint32_t end = count_while(sorted, [high](float value) { return value <= high; });
  return static_cast<float>(end - begin - 1) / static_cast<float>(sorted.size());
}

}  // namespace

/// One box of each of `count` ranges, at a place that looks random, for boxes may lie in rows.
void StripPlan::take_sample(const ChartBoxes& boxes, std::uint32_t count) {
  const std::uint64_t n = boxes.size();
  sample_.resize(count);
  low_u_.resize(count);
  low_v_.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint64_t begin = i * n / count, end = (i + 1) * n / count;
    const std::uint32_t scattered = i * 0x9e3779b9u >> 8;
    sample_[i] = static_cast<std::uint32_t>(begin + scattered % (end - begin));
    low_u_[i] = boxes.low_u[sample_[i]];
    low_v_[i] = boxes.low_v[sample_[i]];
  }
  std::ranges::sort(low_u_);
  std::ranges::sort(low_v_);
}

/// The number of strips, among powers of two, for which sorting and sweeping cost least.
std::uint32_t StripPlan::best_number(std::uint32_t boxes) {
  // What it costs to put a box into a strip, in tests of eight targets.
  constexpr float kEntryCost = 10;
  const auto count = static_cast<float>(boxes);
  float mean_u = 0;
  for (const float share : share_u_) mean_u += share;
  mean_u /= static_cast<float>(share_u_.size());
  std::uint32_t best = 1;
  float best_cost = 0;
  for (std::uint32_t strips = 1; strips == 1 || strips <= boxes / kLeastBoxes; strips *= 2) {
    float entries = 0;  // a box
    for (const float share : share_v_) {
      entries += 1 + std::min(static_cast<float>(strips) * share, float{kMostStrips});
    }
    entries /= static_cast<float>(share_v_.size());
    const float tests = count / static_cast<float>(strips) * mean_u / 8;
    const float cost = entries * (kEntryCost + tests);
    if (strips > 1 && cost >= best_cost) continue;
    best = strips;
    best_cost = cost;
  }
  return std::max(best, boxes / kMostBoxes);
}

void StripPlan::make(const ChartBoxes& boxes) {
  borders_.clear();
  const std::uint32_t n = boxes.size();
  if (n < kFewBoxes) return;
  std::uint32_t size = n < 65536 ? kFewBoxes : 8 * kFewBoxes;
  take_sample(boxes, size);
  share_u_.resize(size);
  share_v_.resize(size);
  for (std::uint32_t i = 0; i < size; ++i) {
    const std::uint32_t box = sample_[i];
    share_u_[i] = share_between(low_u_, boxes.low_u[box], boxes.high_u[box]);
    share_v_[i] = share_between(low_v_, boxes.low_v[box], boxes.high_v[box]);
  }
  const std::uint32_t strips = best_number(n);
  // A quantile is uncertain by the root of what the sample has in a strip.
  if (size < 8 * strips && size < n) {
    size = std::min(n, 8 * strips);
    take_sample(boxes, size);
  }
  for (std::uint64_t i = 1; i < strips; ++i) {
    const float border = low_v_[i * size / strips];
    if (border > (borders_.empty() ? low_v_.front() : borders_.back())) borders_.push_back(border);
  }
}

}  // namespace gnomon
