// SPDX-License-Identifier: LGPL-3.0-or-later
// Exact answers about lines of a receiver, where the bounds of doubles leave them open.
//
// A line is known by its values at the receiver's corners, as pairs of doubles of integers: where
// it crosses another line, or an edge of the receiver, follows from these, and so do sides, however
// near two lines are to one. What even pairs leave open, integers tell.
//
// Exactness: sides are exact; places are enclosed. Tests: tests/algorithms/outline_union_test.cc.
#ifndef GNOMON_ALGORITHMS_AREA_CONTOUR_EXACT_LINES_H
#define GNOMON_ALGORITHMS_AREA_CONTOUR_EXACT_LINES_H

#include <array>
#include <cmath>
#include <cstdint>

#include "algorithms/area_contour/receiver_chart.h"
#include "gnomon/kernel/sign.h"
#include "kernel/numbers/double_double.h"
#include "kernel/signs/ball.h"

namespace gnomon::area_contour {

class ExactLines {
 public:
  virtual ~ExactLines() = default;

  /// Whether two lines are known to be one, by what they were made from or by two vertices that
  /// both go through. False: they may be.
  virtual bool is_known_same(const OutlineLine& a, const OutlineLine& b) = 0;
  /// On which side of a line is a corner of the receiver.
  Side side_of_corner(const OutlineLine& line, std::uint32_t corner) {
    return side_of(value_at(line, corner).high);
  }
  /// How far a corner is from a line, in some measure of that line that is at most 1: off by less
  /// than 4u of itself, unless it has underflowed.
  virtual double distance_of(const OutlineLine& line, std::uint32_t corner) = 0;
  /// On which side of `line` is the point where two others meet. Requires: they cross.
  virtual Side side_of_meet(const OutlineLine& line, const OutlineLine& a,
                            const OutlineLine& b) = 0;
  /// The same for the point where a line meets the receiver's edge that follows that corner.
  /// Requires: it crosses it.
  Side side_at_border(const OutlineLine& line, const OutlineLine& a, std::uint32_t corner);
  /// On which sides of a line are the points in which another one enters and leaves the receiver.
  /// On it are both only if the two are one.
  std::array<Side, 2> sides_at_ends(const OutlineLine& line, const OutlineLine& along);
  /// Where another line meets a line, sharply: along the direction (b, -a) of that, as seen from
  /// the chart's origin. Requires: they cross.
  Ball place_on(const OutlineLine& line, const OutlineLine& by);

 protected:
  explicit ExactLines(const ReceiverChart& chart) : chart_(chart) {}
  const ReceiverChart& chart() const { return chart_; }

  /// An integer, the value of a line at a corner of the receiver in a measure of the line's own:
  /// off by at most 2^-104 of itself, not finite beyond 2^900, and of the right sign.
  virtual DoubleDouble value_at(const OutlineLine& line, std::uint32_t corner) = 0;
  /// side_at_border() and place_on() from integers.
  virtual Side exact_side_at_border(const OutlineLine& line, const OutlineLine& a,
                                    std::uint32_t corner) = 0;
  virtual Ball exact_place_on(const OutlineLine& line, const OutlineLine& by) = 0;

 private:
  /// The value of a line at a point of the border, times a positive number: off by at most `error`,
  /// which is not finite where nothing is known.
  struct BorderValue {
    double value = 0, error = 0;
    double factor = 1;  // that number, off by 2u

    bool has_sign() const { return std::fabs(value) > error || (value == 0 && error == 0); }
  };
  static Side side_of(double value) {
    return value > 0 ? Side::kFront : value < 0 ? Side::kBack : Side::kOn;
  }
  BorderValue value_at_border(const OutlineLine& line, const OutlineLine& a, std::uint32_t corner);
  template <class AtCorner, class AtEdge>
  void for_ends(const OutlineLine& line, const AtCorner& at_corner, const AtEdge& at_edge) const;

  const ReceiverChart& chart_;
};

}  // namespace gnomon::area_contour

#endif  // GNOMON_ALGORITHMS_AREA_CONTOUR_EXACT_LINES_H
