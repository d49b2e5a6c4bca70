// SPDX-License-Identifier: LGPL-3.0-or-later
// The chart of a receiver: two coordinates of three, as seen from its first corner; and the lines
// in which planes of volumes meet it there.
//
// Exactness: every bound is proven, from those of kernel `plane`'s doubles (VolumeBounds).
#ifndef GNOMON_ALGORITHMS_AREA_CONTOUR_RECEIVER_CHART_H
#define GNOMON_ALGORITHMS_AREA_CONTOUR_RECEIVER_CHART_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "gnomon/kernel/orientation.h"

namespace gnomon::area_contour {

using Point3 = std::array<double, 3>;

/// The receiver's corners as a set of bits, by their numbers in the chart.
using CornerMask = std::uint64_t;
inline constexpr std::uint32_t kMostCorners = 64;
inline bool has(CornerMask mask, std::uint32_t corner) { return (mask >> corner & 1) != 0; }

/// A line of the chart that passes through the receiver: a x + b y + c with (a, b) of length 1, its
/// outline where that is positive. For every point of the receiver the value is within `error` of
/// the true distance times a factor, the same for all; and the direction is off by at most `error`
/// over the receiver's reach.
struct OutlineLine {
  double a = 0, b = 0, c = 0, error = 0;
  PlaneRef plane;                     // with the outline in front
  CornerMask before = 0, behind = 0;  // corners strictly on the outline's side, and on the other
};

/// A plane as kernel `plane` has it: n . x - d, each n_k off by at most 2u of itself and below 1,
/// for the plane's own orientation.
struct PlaneDoubles {
  Point3 n{};
  double d = 0;
  PlaneRef plane;
  const Point3* point = nullptr;  // a point that it goes through, as exact as corners are
};

struct ReceiverChart {
  /// Corners counter-clockwise, off by at most `error` in each coordinate. The first one is (0, 0).
  std::vector<std::array<double, 2>> corners;
  double error = 0;
  double reach = 0;       // no corner is farther from the origin
  bool reversed = false;  // corner i > 0 is corner n - i of the receiver's loop

  std::uint32_t size() const { return static_cast<std::uint32_t>(corners.size()); }
  std::uint32_t next(std::uint32_t i) const { return i + 1 == size() ? 0 : i + 1; }

  /// The two coordinates.
  std::size_t u() const { return u_; }
  std::size_t v() const { return v_; }
  /// The first corner in space: the chart is what the two coordinates are beyond it.
  const Point3& origin() const { return origin_; }

  /// `n`: of the receiver's plane, as PlaneDoubles has it. `loop`: its corners in [0, 1], each
  /// coordinate off by at most `input_error`. `plane_error`: bounds the error of n . x - d of any
  /// plane at them. False if doubles say too little of so small or so thin a receiver.
  bool make(const Point3& n, const std::vector<Point3>& loop, double input_error,
            double plane_error);
  /// The line in which a plane meets the receiver. False if doubles say too little
  /// of it.
  bool add_line(const PlaneDoubles& plane, CornerMask before, CornerMask behind,
                std::vector<OutlineLine>& lines) const;

 private:
  Point3 origin_{};
  std::size_t u_ = 0, v_ = 1, dropped_ = 2;
  double slope_u_ = 0, slope_v_ = 0;  // of the dropped coordinate
  double input_error_ = 0, plane_error_ = 0;
};

}  // namespace gnomon::area_contour

#endif  // GNOMON_ALGORITHMS_AREA_CONTOUR_RECEIVER_CHART_H
