// SPDX-License-Identifier: LGPL-3.0-or-later
// Spans of a row of samples: along a row every sign that image_space.h answers is one of a linear
// function of the column, so that it changes at most once. The place is guessed in doubles and
// confirmed by two signs; a guess that is not confirmed is followed by bisection.
//
// Exactness: exact on exact kernels, whatever the guess. On rounded ones signs may change more
// often; then one of the changes is found.
#ifndef GNOMON_ALGORITHMS_PIXELS_ROW_SEARCH_H
#define GNOMON_ALGORITHMS_PIXELS_ROW_SEARCH_H

#include <cmath>
#include <cstdint>

namespace gnomon {

/// Columns [begin, end).
struct Span {
  std::uint32_t begin = 0, end = 0;
  bool empty() const { return begin >= end; }
  std::uint32_t size() const { return empty() ? 0 : end - begin; }
};

/// The first column whose answer is not that of span.begin. Requires: `holds(i)` answers
/// differently at the first and the last column of the span. `guess`: a column, or anything.
template <class Holds>
std::uint32_t change_in(Span span, double guess, const Holds& holds, bool at_begin) {
  std::uint32_t low = span.begin, high = span.end - 1;  // the answers differ at these two
  const double column = std::ceil(guess);
  if (column > low && column < high) {
    const auto i = static_cast<std::uint32_t>(column);
    if (holds(i) == at_begin) {
      low = i;
      if (holds(i + 1) == at_begin) {
        low = i + 1;
      } else {
        return i + 1;
      }
    } else {
      high = i;
      if (holds(i - 1) != at_begin) {
        high = i - 1;
      } else {
        return i;
      }
    }
  }
  while (high - low > 1) {
    const std::uint32_t middle = low + (high - low) / 2;
    (holds(middle) == at_begin ? low : high) = middle;
  }
  return high;
}

/// The part of the span where `holds(i)`, which changes at most once along it.
template <class Holds>
Span part_where(Span span, const Holds& holds, double guess) {
  if (span.empty()) return span;
  const bool at_begin = holds(span.begin);
  const bool at_end = span.size() == 1 ? at_begin : holds(span.end - 1);
  if (at_begin == at_end) return at_begin ? span : Span{span.begin, span.begin};
  const std::uint32_t change = change_in(span, guess, holds, at_begin);
  return at_begin ? Span{span.begin, change} : Span{change, span.end};
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PIXELS_ROW_SEARCH_H
