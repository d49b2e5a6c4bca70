// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/area_contour/shadow_boxes.h"

#include <algorithm>
#include <cmath>

#include "algorithms/area_contour/four_doubles.h"

namespace gnomon::area_contour {
namespace {

/// Choices, not bounds: casters that are nearer to the light's height, and places that are known
/// worse, are not asked.
constexpr double kLeastGap = 0x1p-16, kMostWidth = 0x1p-24;

}  // namespace

void ShadowProjection::begin(const ReceiverChart& receiver, const Point3& n, double d, double error,
                             std::span<const Point3> light, double extra) {
  n_ = n;
  d_ = d;
  error_ = error;
  extra_ = extra;
  u_ = receiver.u();
  v_ = receiver.v();
  origin_ = receiver.origin();
  light_.clear();
  for (std::size_t i = 0; i < (light.size() + 3) / 4 * 4; ++i) {
    if (i % 4 == 0) light_.emplace_back();
    const Point3& corner = light[std::min(i, light.size() - 1)];  // the last one fills up
    Seen& seen = light_.back();
    seen.u[i % 4] = corner[u_];
    seen.v[i % 4] = corner[v_];
    seen.height[i % 4] = n[0] * corner[0] + n[1] * corner[1] + n[2] * corner[2] - d;
  }
}

// Let e bound the error of heights (error_ is at least 64u), g the gap h(a) - h(o), coordinates in
// [0, 1] and off by 2u. Then t is off by (e + 2 e |t|) / g and roundings of 4u |t|, and a place, of
// three operations on numbers of at most 1 + |t|, by that and 8u (1 + |t|): altogether by less than
// 4 e (1 + |t|) / g, for g at most 2.
GNOMON_FOR_AVX2 ShadowBoxes ShadowProjection::boxes(std::span<const Point3> caster) const {
  ShadowBoxes result;
  double highest = -1, least = 1;
  for (const Point3& corner : caster) {
    const double height = n_[0] * corner[0] + n_[1] * corner[1] + n_[2] * corner[2] - d_;
    highest = std::max(highest, height);
    least = std::min(least, height);
  }
  if (highest < -error_) {
    result.place = ShadowBoxes::Place::kBehind;
    return result;
  }
  if (highest > error_) result.place = ShadowBoxes::Place::kInFront;
  // By light's corner, four at a time: of the penumbra the least and the greatest places, of the
  // umbra the greatest of the least ones and the least of the greatest.
  constexpr Doubles kFar = {1e300, 1e300, 1e300, 1e300};
  Doubles least_u = kFar, least_v = kFar, most_u = -kFar, most_v = -kFar;
  Doubles low_u = -kFar, low_v = -kFar, high_u = kFar, high_v = kFar;
  Doubles gaps = {2, 2, 2, 2}, ratios = {0, 0, 0, 0};
  for (const Seen& light : light_) {
    Doubles own_low_u = kFar, own_low_v = kFar, own_high_u = -kFar, own_high_v = -kFar;
    const Doubles &light_u = row(light.u), &light_v = row(light.v),
                  &light_height = row(light.height);
    for (const Point3& corner : caster) {
      const double height = n_[0] * corner[0] + n_[1] * corner[1] + n_[2] * corner[2] - d_;
      const Doubles apart = light_height - height, t = height / apart;
      const Doubles u = corner[u_] + (corner[u_] - light_u) * t,
                    v = corner[v_] + (corner[v_] - light_v) * t;
      own_low_u = u < own_low_u ? u : own_low_u;
      own_high_u = u > own_high_u ? u : own_high_u;
      own_low_v = v < own_low_v ? v : own_low_v;
      own_high_v = v > own_high_v ? v : own_high_v;
      const Doubles size = t < 0 ? -t : t;
      gaps = apart < gaps ? apart : gaps;
      ratios = size > ratios ? size : ratios;
    }
    least_u = own_low_u < least_u ? own_low_u : least_u;
    least_v = own_low_v < least_v ? own_low_v : least_v;
    most_u = own_high_u > most_u ? own_high_u : most_u;
    most_v = own_high_v > most_v ? own_high_v : most_v;
    low_u = own_low_u > low_u ? own_low_u : low_u;
    low_v = own_low_v > low_v ? own_low_v : low_v;
    high_u = own_high_u < high_u ? own_high_u : high_u;
    high_v = own_high_v < high_v ? own_high_v : high_v;
  }
  const double gap = least_of(gaps), largest = most_of(ratios);
  const ChartBox penumbra{{least_of(least_u), least_of(least_v)},
                          {most_of(most_u), most_of(most_v)}};
  const ChartBox umbra{{most_of(low_u), most_of(low_v)}, {least_of(high_u), least_of(high_v)}};
  if (!(gap > kLeastGap)) return result;
  const double error = 4 * error_ * (1 + largest) / gap;
  if (!(error < kMostWidth)) return result;
  const double origin[] = {origin_[u_], origin_[v_]};
  for (int k = 0; k < 2; ++k) {
    result.penumbra.low[k] = penumbra.low[k] - origin[k] - error - extra_;
    result.penumbra.high[k] = penumbra.high[k] - origin[k] + error + extra_;
    result.umbra.low[k] = umbra.low[k] - origin[k] - error - extra_;
    result.umbra.high[k] = umbra.high[k] - origin[k] + error + extra_;
  }
  return result;
}

}  // namespace gnomon::area_contour
