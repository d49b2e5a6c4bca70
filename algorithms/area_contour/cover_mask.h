// SPDX-License-Identifier: LGPL-3.0-or-later
// Which cells of a receiver are covered by one outline each: what lies in such cells alone adds
// nothing to the union of the outlines, and where all cells are covered, so is the receiver.
//
// Guarantee: a cell is marked only if all of it, with a margin, is inside of an outline that was
// added, or outside of the receiver. Proof: cover_mask.cc.
#ifndef GNOMON_ALGORITHMS_AREA_CONTOUR_COVER_MASK_H
#define GNOMON_ALGORITHMS_AREA_CONTOUR_COVER_MASK_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "algorithms/area_contour/receiver_chart.h"

namespace gnomon::area_contour {

/// A rectangle of a chart; empty by default.
struct ChartBox {
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double low[2] = {kInfinity, kInfinity}, high[2] = {-kInfinity, -kInfinity};

  static constexpr ChartBox everything() {
    return {{-kInfinity, -kInfinity}, {kInfinity, kInfinity}};
  }
  bool is_empty() const { return !(low[0] <= high[0] && low[1] <= high[1]); }
  void clip(const ChartBox& other) {
    for (int k = 0; k < 2; ++k) {
      low[k] = low[k] > other.low[k] ? low[k] : other.low[k];
      high[k] = high[k] < other.high[k] ? high[k] : other.high[k];
    }
  }
  double area() const { return (high[0] - low[0]) * (high[1] - low[1]); }
};

class CoverMask {
 public:
  /// Marks what is outside of the receiver.
  void begin(const ReceiverChart& receiver);
  /// Marks what is inside of a convex outline. `box`: holds it.
  void add(std::span<const OutlineLine> lines, const ChartBox& box);
  /// Whether what of a rectangle is on the receiver is in marked cells. `box`: of the true points,
  /// as wide as these are known, and then by margin() more.
  bool holds(const ChartBox& box) const;
  /// Whether all of the receiver is in marked cells.
  bool is_full() const;

  /// The receiver's rectangle.
  const ChartBox& box() const { return box_; }
  double margin() const { return margin_; }

 private:
  static constexpr int kCells = 32;              // along each axis
  static constexpr std::size_t kMostLines = 32;  // of an outline; one with more is not marked
  struct Line {
    double a, b, c;  // inside where a x + b y + c > 0
  };
  void mark(std::span<const Line> lines, int first, int last);
  int cell_of(double x, int axis) const;

  std::array<std::uint32_t, kCells> rows_{};
  ChartBox box_;
  double size_[2] = {}, inverse_[2] = {};  // of a cell
  double slack_ = 0, margin_ = 0;
};

}  // namespace gnomon::area_contour

#endif  // GNOMON_ALGORITHMS_AREA_CONTOUR_COVER_MASK_H
