// SPDX-License-Identifier: LGPL-3.0-or-later
// What OutlineUnion's files share and its header need not tell.
#ifndef GNOMON_ALGORITHMS_AREA_CONTOUR_OUTLINE_TRIM_H
#define GNOMON_ALGORITHMS_AREA_CONTOUR_OUTLINE_TRIM_H

#include <cstdint>

#include "algorithms/area_contour/outline_union.h"

namespace gnomon::area_contour {

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
    low_.add({place + error, place - error, line, kNoLine, true},
             [](double a, double b) { return a > b; });
  }
  void end_at(double place, double error, std::uint32_t line) {
    high_.add({place - error, place + error, line}, [](double a, double b) { return a < b; });
  }
  /// Of a stretch that was trimmed.
  Stretch stretch() const {
    return {low_.end([](double a, double b) { return a >= b; }),
            high_.end([](double a, double b) { return a <= b; }), is_certain};
  }

 private:
  /// The innermost places.
  struct Innermost {
    End first, second;
    double third, outer;

    explicit Innermost(double beyond)
        : first{beyond, beyond}, second{beyond, beyond}, third(beyond), outer(beyond) {}
    template <class IsInside>
    void add(const End& end, const IsInside& is_inside) {
      if (is_inside(end.outer, outer)) outer = end.outer;
      if (is_inside(end.inner, first.inner)) {
        third = second.inner;
        second = first;
        first = end;
      } else if (is_inside(end.inner, second.inner)) {
        third = second.inner;
        second = end;
      } else if (is_inside(end.inner, third)) {
        third = end.inner;
      }
    }
    template <class Reaches>
    End end(const Reaches& reaches) const {
      End result{first.inner, outer, first.line, kNoLine, first.begins};
      if (first.line != kNoLine && reaches(second.inner, first.outer)) {
        const bool is_one_of_two = second.line != kNoLine && !reaches(third, outer);
        result.other = second.line;
        if (!is_one_of_two) result.line = result.other = kNoLine;
      }
      return result;
    }
  };
  Innermost low_{-kInfinity}, high_{kInfinity};
};

}  // namespace gnomon::area_contour

#endif  // GNOMON_ALGORITHMS_AREA_CONTOUR_OUTLINE_TRIM_H
