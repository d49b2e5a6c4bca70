// SPDX-License-Identifier: GPL-3.0-or-later
// The shadow of one caster on the support plane of one receiver, as a convex loop in a chart of
// that plane: the caster is clipped to what lies between the receiver's plane and the light, and
// projected through the light. The chart drops the axis of the largest normal component, which
// keeps ratios of areas.
//
// Exactness: with rationals everything is exact; with doubles it is as one would write it.
#ifndef GNOMON_BENCH_PEERS_SHADOW_PROJECTION_H
#define GNOMON_BENCH_PEERS_SHADOW_PROJECTION_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "peers/light_view.h"

namespace gnomon::bench {

template <class Number>
using ChartPoint = std::array<Number, 2>;
template <class Number>
using ChartLoop = std::vector<ChartPoint<Number>>;

/// Twice the area; positive if counter-clockwise.
template <class Number>
Number twice_area(const ChartLoop<Number>& loop) {
  Number sum(0);
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    sum += (loop[i][0] - loop[0][0]) * (loop[i + 1][1] - loop[0][1]) -
           (loop[i][1] - loop[0][1]) * (loop[i + 1][0] - loop[0][0]);
  }
  return sum;
}

template <class Number>
class ShadowProjection {
 public:
  using Loop = std::vector<Point<Number>>;

  /// Whether shadows are cut off at the receiver's border, or only where they would be unbounded.
  enum class Clip { kWhereUnbounded, kAtReceiver };

  /// `receiver`: relative to the light, in the order of LightView::loop.
  ShadowProjection(const LitPlane<Number>& plane, Loop receiver, Clip clip)
      : plane_(plane), receiver_(std::move(receiver)), clip_(clip) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Number size = plane_.normal[k] < 0 ? Number(-plane_.normal[k]) : plane_.normal[k];
      if (k == 0 || size > largest_) {
        largest_ = size;
        axis_ = k;
      }
    }
    for (const Point<Number>& point : receiver_) chart_receiver_.push_back(drop_axis(point));
    make_counter_clockwise(chart_receiver_);
  }

  /// Counter-clockwise.
  const ChartLoop<Number>& receiver() const { return chart_receiver_; }

  /// Counter-clockwise; false if the caster casts no shadow of positive area here.
  bool shadow_of(const Loop& caster, ChartLoop<Number>& shadow) {
    loop_ = caster;
    if (!clip([this](const Point<Number>& x) { return plane_.at(x); })) return false;
    // Beyond the plane through the light that is parallel to the receiver, projection has a pole.
    const bool unbounded = std::any_of(loop_.begin(), loop_.end(), [this](const Point<Number>& x) {
      return !(dot(plane_.normal, x) < plane_.offset / 64);
    });
    if (unbounded || clip_ == Clip::kAtReceiver) {
      for (std::size_t i = 0; i < receiver_.size(); ++i) {
        const Point<Number> inward =
            cross(receiver_[i], receiver_[i + 1 == receiver_.size() ? 0 : i + 1]);
        if (!clip([&inward](const Point<Number>& x) { return dot(inward, x); })) return false;
      }
    }
    shadow.clear();
    for (const Point<Number>& point : loop_) {
      const Number stretch(plane_.offset / dot(plane_.normal, point));
      shadow.push_back(drop_axis(
          {Number(point[0] * stretch), Number(point[1] * stretch), Number(point[2] * stretch)}));
    }
    return make_counter_clockwise(shadow);
  }

 private:
  /// Keeps what has a value of at least zero; false if no area is left.
  template <class Value>
  bool clip(const Value& value) {
    values_.clear();
    bool positive = false, negative = false;
    for (const Point<Number>& point : loop_) {
      values_.push_back(value(point));
      positive = positive || values_.back() > 0;
      negative = negative || values_.back() < 0;
    }
    if (!positive) return false;
    if (!negative) return true;
    clipped_.clear();
    for (std::size_t i = 0; i < loop_.size(); ++i) {
      const std::size_t j = i + 1 == loop_.size() ? 0 : i + 1;
      if (values_[i] >= 0) clipped_.push_back(loop_[i]);
      if ((values_[i] > 0 && values_[j] < 0) || (values_[i] < 0 && values_[j] > 0)) {
        const Number t(values_[i] / (values_[i] - values_[j]));
        const Point<Number> along = minus(loop_[j], loop_[i]);
        clipped_.push_back({Number(loop_[i][0] + t * along[0]), Number(loop_[i][1] + t * along[1]),
                            Number(loop_[i][2] + t * along[2])});
      }
    }
    std::swap(loop_, clipped_);
    return loop_.size() >= 3;
  }

  ChartPoint<Number> drop_axis(const Point<Number>& point) const {
    return {point[(axis_ + 1) % 3], point[(axis_ + 2) % 3]};
  }

  static bool make_counter_clockwise(ChartLoop<Number>& loop) {
    const Number area = twice_area(loop);
    if (area < 0) std::reverse(loop.begin(), loop.end());
    return area != 0;
  }

  LitPlane<Number> plane_;
  Loop receiver_;
  Clip clip_;
  std::size_t axis_ = 0;
  Number largest_{};
  ChartLoop<Number> chart_receiver_;
  Loop loop_, clipped_;         // workspace
  std::vector<Number> values_;  // workspace
};

}  // namespace gnomon::bench

#endif  // GNOMON_BENCH_PEERS_SHADOW_PROJECTION_H
