// SPDX-License-Identifier: LGPL-3.0-or-later
// What OutlineUnion's files share and its header need not tell.
#ifndef GNOMON_ALGORITHMS_AREA_CONTOUR_OUTLINE_TRIM_H
#define GNOMON_ALGORITHMS_AREA_CONTOUR_OUTLINE_TRIM_H

#include <cstdint>

#include "algorithms/area_contour/outline_union.h"

namespace gnomon::area_contour {

/// A choice: where a line meets an edge of the receiver is known well enough to so much of that.
inline constexpr double kKnownShare = 0x1p-24;

/// What lines leave of a stretch of a line. It begins at the greatest of the places at which one of
/// them lets it begin; those that may be the greatest are known if they are at most two.
struct OutlineUnion::Trim {
  bool is_certain = true;

  void add(const Trimming& by) {
    const std::uint32_t line = by.is_known ? by.line : kNoLine;
    if (by.begins) {
      begin_at(by.place, by.radius, line);
    } else {
      end_at(by.place, by.radius, line);
    }
  }

  void begin_at(double place, double error, std::uint32_t line) {
    low_.add(place + error, place - error, line);
  }
  void end_at(double place, double error, std::uint32_t line) {
    high_.add(place - error, place + error, line);
  }
  /// The same by the bounds of the place.
  void begin_between(double outer, double inner, std::uint32_t line) {
    low_.add(inner, outer, line);
  }
  void end_between(double inner, double outer, std::uint32_t line) {
    high_.add(inner, outer, line);
  }
  /// Of a stretch that was trimmed.
  void put(Stretch& stretch) const {
    low_.put(stretch.low);
    high_.put(stretch.high);
    stretch.is_certain = is_certain;
  }

 private:
  struct Greater {
    static bool is_inside(double a, double b) { return a > b; }
  };
  struct Less {
    static bool is_inside(double a, double b) { return a < b; }
  };
  /// The innermost places.
  template <class Order>
  struct Innermost {
    double first, second, third, first_outer, outer;
    std::uint32_t line = kNoLine, second_line = kNoLine;

    explicit Innermost(double beyond)
        : first(beyond), second(beyond), third(beyond), first_outer(beyond), outer(beyond) {}
    void add(double end_inner, double end_outer, std::uint32_t end_line) {
      if (Order::is_inside(end_outer, outer)) outer = end_outer;
      if (Order::is_inside(end_inner, first)) {
        third = second;
        second = first;
        second_line = line;
        first = end_inner;
        first_outer = end_outer;
        line = end_line;
      } else if (Order::is_inside(end_inner, second)) {
        third = second;
        second = end_inner;
        second_line = end_line;
      } else if (Order::is_inside(end_inner, third)) {
        third = end_inner;
      }
    }
    void put(End& end) const {
      end = {first, outer, line, kNoLine};
      // Another one may reach as far.
      if (line == kNoLine || Order::is_inside(first_outer, second)) return;
      const bool is_one_of_two = second_line != kNoLine && Order::is_inside(outer, third);
      end.line = is_one_of_two ? line : kNoLine;
      end.other = is_one_of_two ? second_line : kNoLine;
    }
  };
  Innermost<Greater> low_{-kInfinity};
  Innermost<Less> high_{kInfinity};
};

}  // namespace gnomon::area_contour

#endif  // GNOMON_ALGORITHMS_AREA_CONTOUR_OUTLINE_TRIM_H
