// SPDX-License-Identifier: LGPL-3.0-or-later
// From sums to classes and shares, and exact subtraction for what the bounds leave open. Bodies of
// contour_run.h.
#ifndef GNOMON_ALGORITHMS_CONTOUR_CONTOUR_CLASSES_H
#define GNOMON_ALGORITHMS_CONTOUR_CONTOUR_CLASSES_H

#include <algorithm>
#include <utility>
#include <vector>

#include "algorithms/contour/contour_run.h"

namespace gnomon {

/// Whether the bounds leave open a polygon's class or much of its share.
template <SectorSpaceModel Space, class Numbers>
bool ContourRun<Space, Numbers>::is_open(std::uint32_t i) const {
  if constexpr (!Numbers::kCertified) {
    return false;
  } else {
    // Bounds add up: a polygon has some five integrals, and more among more neighbours.
    const double widest =
        8 * rays_.rough() * (1 + static_cast<double>(pairs_.neighbours(i).size()) / 16);
    const Sum& sum = sums_[i];
    if (sum.flags & kContourOpen) return true;
    const bool lit = sum.flags & kHoldsLit, shadow = sum.flags & kHoldsShadow;
    if (!lit && (sum.flags & kPerhapsLit)) return true;
    if (!shadow && (sum.flags & kPerhapsShadow)) return true;
    if (!lit || !shadow) return false;
    const Ball share = share_of(i);
    // An enclosure that reaches beyond 0 or 1 is cut off there, and its middle moves by as much. No
    // sum of a proof is outside of them; one that is would be a fault of ours.
    constexpr double kCutOff = 64 * Ball::kUnit;
    const bool is_cut = share.middle < share.radius || share.middle > 1 - share.radius;
    return share.radius > (is_cut ? kCutOff : widest) || share.middle < -share.radius ||
           share.middle > 1 + share.radius;
  }
}

/// The share of a polygon whose sum is certified. What is taken from it, and what its own border
/// adds unless all of that is seen, is in units of its whole border, which are off by the bound of
/// the scale. Roundings of numbers of size 1 are counted, as are those of the ends.
template <SectorSpaceModel Space, class Numbers>
Ball ContourRun<Space, Numbers>::share_of(std::uint32_t i) const {
  const Sum& sum = sums_[i];
  const double value = sum.middle(), error = sum.radius();
  const double share = sum.flags & kOwnWhole ? 1 + value : value;
  return {share,
          error + 1.01 * measure_.relative_error[i] * (std::fabs(value) + error) + 4 * Ball::kUnit};
}

template <SectorSpaceModel Space, class Numbers>
void ContourRun<Space, Numbers>::set_classes() {
  const auto parts = static_cast<std::uint32_t>(scene_.parts.size());
  result_.parts.resize(parts);
  if (options_.output.exact_fractions) result_.exact_fractions.resize(parts);
  in_parallel(jobs_, parts, kGrain, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t index = begin; index < end; ++index) {
      PartResult& part = result_.parts[index];
      part.part = index;
      part.side = facing_->facing[index].side;
      part.reason = facing_->facing[index].reason;
      part.lit = {0, 0};
      part.shadow = {1, 1};
      if (options_.output.exact_fractions) result_.exact_fractions[index].shadow = 1;
    }
  });
  in_parallel(jobs_, polygons_.size(), kGrain, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i < end; ++i) set_class(i);
  });
}

template <SectorSpaceModel Space, class Numbers>
void ContourRun<Space, Numbers>::set_class(std::uint32_t i) {
  const std::uint32_t index = polygons_.polygons[i].part;
  PartResult& part = result_.parts[index];
  const Sum& sum = sums_[i];
  if (!(sum.flags & kHoldsLit)) return;
  const bool shadow = sum.flags & kHoldsShadow;
  if (!shadow) {
    part.lit = {1, 1};
    part.shadow = {0, 0};
  } else {
    if constexpr (Numbers::kCertified) {
      const Ball share = share_of(i);
      part.lit = {std::max(0.0, share.middle - share.radius),
                  std::min(1.0, share.middle + share.radius)};
    } else if constexpr (Numbers::kExact) {
      const double value = sum.value.get_d();  // truncated: within one unit in the last place
      part.lit = {std::max(0.0, value - 2 * Ball::kUnit), std::min(1.0, value + 2 * Ball::kUnit)};
    } else {
      const auto value = static_cast<double>(sum.value);
      part.lit = {value, value};
    }
    // 1 - x rounds by half a unit.
    const double slack = Numbers::kTrust == Trust::kRounded ? 0 : Ball::kUnit;
    part.shadow = {std::max(0.0, 1 - part.lit.upper - slack),
                   std::min(1.0, 1 - part.lit.lower + slack)};
    if (Numbers::kTrust == Trust::kRounded) part.shadow = {1 - part.lit.lower, 1 - part.lit.lower};
  }
  if constexpr (Numbers::kExact) {
    if (options_.output.exact_fractions) {
      ExactFractions& fractions = result_.exact_fractions[index];
      fractions.lit = shadow ? mpq_class(sum.value) : mpq_class(1);
      fractions.shadow = 1 - fractions.lit;
    }
  }
}

/// Exact subtraction for what is open: the sectors method on these polygons and what may shadow
/// them.
template <SectorSpaceModel Space, class Numbers>
RunOutcome ContourRun<Space, Numbers>::find_open_ones(Space space,
                                                      const std::function<void(double)>& progress) {
  if constexpr (Numbers::kCertified) {
    std::vector<std::uint8_t> takes_part(polygons_.size());  // 1: casts; 2: receives
    bool some = false;
    for (std::uint32_t i = 0; i < polygons_.size(); ++i) {
      if (!is_open(i)) continue;
      some = true;
      takes_part[i] |= 2;
      for (const std::uint32_t j : pairs_.neighbours(i)) {
        if (polygons_.polygons[j].casts) takes_part[j] |= 1;
      }
    }
    if (!some) return RunOutcome::kDone;
    std::vector<std::uint32_t> parts;
    std::vector<std::uint8_t> receives;
    for (std::uint32_t i = 0; i < polygons_.size(); ++i) {
      if (takes_part[i] == 0) continue;
      parts.push_back(polygons_.polygons[i].part);
      receives.push_back(takes_part[i] & 2);
      result_.work[Counter::kOpenPolygons] += takes_part[i] >> 1;
    }
    SectorRun<Space> exact(scene_, run_options_, rules_, scene_space_, result_.light,
                           std::move(space), std::move(*facing_), LeafMethod::kSubtract,
                           Cover::kPartition, {parts, receives});
    const RunOutcome outcome = exact.run({});
    if (outcome != RunOutcome::kDone) return outcome;
    stages_ += exact.stage_counts();
    const LightResult found = exact.finish();
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (receives[i] == 0) continue;
      PartResult& part = result_.parts[parts[i]];
      part = found.parts[parts[i]];
      if (part.lit.upper <= 0) {  // of pieces that several casters hide
        part.lit = {0, 0};
        part.shadow = {1, 1};
      }
    }
  }
  if (progress) progress(1);
  return RunOutcome::kDone;
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_CONTOUR_CLASSES_H
