// SPDX-License-Identifier: LGPL-3.0-or-later
// What other outlines hold of an edge, four of their lines at a time.
#include <algorithm>
#include <bit>

#include "algorithms/area_contour/four_doubles.h"
#include "algorithms/area_contour/outline_trim.h"
#include "algorithms/area_contour/outline_union.h"

namespace gnomon::area_contour {
/// Leaves in trimmings_ what lines of an outline do to a stretch of a line, but those that have all
/// of it inside. False if one certainly leaves nothing: near ones before it are left then, too.
///
/// A line's value at a place t of the stretch is start + slope t. It is off by the errors of both
/// lines, and by its roundings, which are less than the slack.
GNOMON_FOR_AVX2 bool OutlineUnion::trim(const Edge& own, const Outline& outline) {
  constexpr Bits kFirst = {0x1, 0x2, 0x4, 0x8}, kSecond = {0x10, 0x20, 0x40, 0x80};
  trimmings_.clear();
  const double own_error = own.error + slack_;
  for (std::uint32_t i = outline.first; i < outline.end; ++i) {
    const LineBlock& block = blocks_[i];
    const Doubles &a = row(block.a), &b = row(block.b);
    const Doubles start = row(block.c) - own.c * (a * own.a + b * own.b);
    const Doubles slope = a * own.b - b * own.a;
    const Doubles error = row(block.error) + own_error;
    const Doubles first = start + slope * own.from, last = start + slope * own.to;
    const Bits inside = (first > error) & (last > error);
    const Bits outside = (first < -error) & (last < -error);
    const unsigned lanes = lanes_of((~inside & kFirst) | (outside & kSecond));
    if (lanes == 0) continue;
    const unsigned missing = lanes >> 4, open = lanes & 15;
    if (missing != 0 && (open & ((missing & -missing) - 1)) == 0) return false;
    const unsigned near = lanes_of((first >= -error) & (first <= error) & (last >= -error) &
                                   (last <= error) & kFirst);
    if (missing != 0) {
      for (unsigned left = near & ((missing & -missing) - 1); left != 0; left &= left - 1) {
        Trimming by;
        by.line = 4 * i + static_cast<std::uint32_t>(std::countr_zero(left));
        by.is_near = true;
        trimmings_.push_back(by);
      }
      return false;
    }
    const Doubles place = -start / slope, quotient = error / slope;
    const Doubles half = quotient < 0 ? -quotient : quotient;
    const Doubles radius = half + 0x1p-49 * ((place < 0 ? -place : place) + half);
    // Else they may be parallel, and the place none.
    const Bits crosses = (slope < 0 ? -slope : slope) * receiver_->reach > 8 * error;
    const unsigned turns = lanes_of(((slope > 0) & kFirst) | (crosses & kSecond));
    for (unsigned left = open; left != 0; left &= left - 1) {
      const auto k = static_cast<std::uint32_t>(std::countr_zero(left));
      trimmings_.push_back({place[k], radius[k], 4 * i + k, (near >> k & 1) != 0,
                            (turns >> k & 1) != 0, (turns >> k & 16) != 0});
    }
  }
  return true;
}

/// How much of an edge lies in a stretch of its line that another outline holds.
inline OutlineUnion::Cover OutlineUnion::cover_between(const Edge& edge, const Stretch& stretch) {
  return stretch.low.outer < edge.to && stretch.high.outer > edge.from && stretch.may_be()
             ? Cover::kSome
             : Cover::kNothing;
}

/// What cover() says, for all kinds of lines.
OutlineUnion::Cover OutlineUnion::cover_slowly(const Edge& edge, std::uint32_t other,
                                               Stretch& stretch) {
  if (!trim(edge, outlines_[other])) return Cover::kNothing;
  if (trimmings_.empty()) return Cover::kAll;
  Trim trimmed;
  for (const Trimming& by : trimmings_) {
    if (!by.is_near) {
      trimmed.add(by);
      continue;
    }
    const Near near = resolve(edge.line, by.line, trimmed);
    if (near == Near::kOutside) return Cover::kNothing;
    if (near != Near::kSame) continue;
    // One line: on the other side it hides, on this one if it acts before.
    const OutlineLine line = line_of(by.line);
    if (line.a * edge.a + line.b * edge.b > 0 && other > edge.outline) return Cover::kNothing;
  }
  trimmed.put(stretch);
  return cover_between(edge, stretch);
}

/// Blocks of lines that do not have all of an edge inside.
struct OutlineUnion::OpenLines {
  static constexpr int kMost = 4;
  struct alignas(32) Block {
    double start[4], slope[4], error[4];
    unsigned lanes;
    std::uint32_t number;
  } blocks[kMost];
  int count;
};

/// An edge for four lines at a time.
struct alignas(32) OutlineUnion::EdgeLanes {
  double a[4], b[4], c[4], error[4], from[4], to[4];

  EdgeLanes(const Edge& edge, double slack) {
    for (int k = 0; k < 4; ++k) {
      a[k] = edge.a;
      b[k] = edge.b;
      c[k] = edge.c;
      error[k] = edge.error + slack;
      from[k] = edge.from;
      to[k] = edge.to;
    }
  }
};

/// How much of an edge another outline holds on its outer side. The values are those of trim().
/// kSome: it may be some of it, as `open` tells. kUnknown: that is for cover_slowly().
[[gnu::always_inline]] inline OutlineUnion::Cover OutlineUnion::find_open(const EdgeLanes& edge,
                                                                          std::uint32_t other,
                                                                          OpenLines& open) const {
  constexpr Bits kFirst = {0x1, 0x2, 0x4, 0x8}, kSecond = {0x10, 0x20, 0x40, 0x80};
  int count = 0;
  const Outline& outline = outlines_[other];
  const Doubles &own_a = row(edge.a), &own_b = row(edge.b);
  for (std::uint32_t i = outline.first; i < outline.end; ++i) {
    const LineBlock& block = blocks_[i];
    const Doubles &a = row(block.a), &b = row(block.b);
    const Doubles start = row(block.c) - row(edge.c) * (a * own_a + b * own_b);
    const Doubles slope = a * own_b - b * own_a;
    const Doubles error = row(block.error) + row(edge.error);
    const Doubles first = start + slope * row(edge.from), last = start + slope * row(edge.to);
    const Bits inside = (first > error) & (last > error);
    const Bits outside = (first < -error) & (last < -error);
    const unsigned lanes = lanes_of((~inside & kFirst) | (outside & kSecond));
    if (lanes == 0) continue;
    if (lanes >> 4 != 0) return Cover::kNothing;
    const Bits near = (first >= -error) & (first <= error) & (last >= -error) & (last <= error);
    if (any(near) || count == OpenLines::kMost) return Cover::kUnknown;
    OpenLines::Block& at = open.blocks[count++];
    row(at.start) = start;
    row(at.slope) = slope;
    row(at.error) = error;
    at.lanes = lanes;
    at.number = i;
  }
  open.count = count;
  return count == 0 ? Cover::kAll : Cover::kSome;
}

/// Where what an outline holds of an edge's line ends.
GNOMON_FOR_AVX2 OutlineUnion::Cover OutlineUnion::cover(const Edge& edge, const OpenLines& open,
                                                        Stretch& stretch) const {
  constexpr Bits kFirst = {0x1, 0x2, 0x4, 0x8}, kSecond = {0x10, 0x20, 0x40, 0x80};
  const double reach = receiver_->reach;
  Trim trimmed;
  for (int i = 0; i < open.count; ++i) {
    const OpenLines::Block& at = open.blocks[i];
    const Doubles &slope = row(at.slope), &error = row(at.error);
    const Doubles place = -row(at.start) / slope, quotient = error / slope;
    const Doubles half = quotient < 0 ? -quotient : quotient;
    const Doubles radius = half + 0x1p-49 * ((place < 0 ? -place : place) + half);
    const Doubles least = place - radius, most = place + radius;
    // Else they may be parallel, and the place none.
    const Bits crosses = (slope < 0 ? -slope : slope) * reach > 8 * error;
    const unsigned turns = lanes_of(((slope > 0) & kFirst) | (crosses & kSecond));
    for (unsigned left = at.lanes; left != 0; left &= left - 1) {
      const auto k = static_cast<std::uint32_t>(std::countr_zero(left));
      const std::uint32_t line = (turns >> k & 16) != 0 ? 4 * at.number + k : kNoLine;
      if ((turns >> k & 1) != 0) {
        trimmed.begin_between(least[k], most[k], line);
      } else {
        trimmed.end_between(least[k], most[k], line);
      }
    }
  }
  trimmed.put(stretch);
  return cover_between(edge, stretch);
}

/// Notes what an outline holds of an edge, unless another one certainly holds that, too: then it
/// takes nothing of what certainly is seen, nor of what perhaps is. True if it is all of the edge.
bool OutlineUnion::hides_or_note(const Edge& edge, std::uint32_t other, const OpenLines* open) {
  Stretch stretch;
  const Cover cover =
      open != nullptr ? this->cover(edge, *open, stretch) : cover_slowly(edge, other, stretch);
  if (cover == Cover::kNothing) return false;
  if (cover == Cover::kAll ||
      (stretch.certainly_is() && stretch.low.inner <= edge.from && stretch.high.inner >= edge.to)) {
    last_hider_ = other;
    return true;
  }
  if (covers_.empty() || !covers_.front().certainly_holds(stretch)) {
    covers_.push_back(stretch);
    // The first one is the longest.
    if (stretch.length() > covers_.front().length()) std::swap(covers_.front(), covers_.back());
  }
  return false;
}

/// Whether another outline certainly holds all of an edge; else notes what it holds of it.
[[gnu::always_inline]] inline bool OutlineUnion::hides(const Edge& edge, const EdgeLanes& lanes,
                                                       std::uint32_t other) {
  if (other == edge.outline) return false;
  OpenLines open;
  const Cover found = find_open(lanes, other, open);
  if (found == Cover::kNothing) return false;
  if (found == Cover::kAll) {
    last_hider_ = other;
    return true;
  }
  return hides_or_note(edge, other, found == Cover::kSome ? &open : nullptr);
}

/// Adds what outlines of the cell leave of an edge. It meets only those whose box meets its own and
/// has corners on both sides of its line. Values there are sums of three numbers below 8 reach, off
/// by less than 2^-19 of that.
GNOMON_FOR_AVX2 void OutlineUnion::add_edge(const Edge& edge) {
  const EdgeLanes lanes(edge, slack_);
  covers_.clear();
  if (hides(edge, lanes, last_hider_)) return;
  covers_.clear();
  const Box box = box_of(edge);
  const float a = static_cast<float>(edge.a), b = static_cast<float>(edge.b);
  const float margin = 0x1p-16F * static_cast<float>(receiver_->reach);
  const float low_c = static_cast<float>(edge.c) - margin,
              high_c = static_cast<float>(edge.c) + margin;
  // Which corner of a box is the farthest to the line's right.
  const int right_x = a > 0 ? 0 : 1, right_y = b > 0 ? 0 : 1;
  for (const BoxBlock& block : leaf_) {
    const Floats least = a * row(block.x[right_x]) + b * row(block.y[right_y]) + low_c;
    const Floats most = a * row(block.x[1 - right_x]) + b * row(block.y[1 - right_y]) + high_c;
    const FloatBits meets = (row(block.x[0]) <= box.high[0]) & (row(block.x[1]) >= box.low[0]) &
                            (row(block.y[0]) <= box.high[1]) & (row(block.y[1]) >= box.low[1]) &
                            (least <= 0) & (most >= 0);
    for (unsigned left = lanes_of(meets); left != 0; left &= left - 1) {
      if (hides(edge, lanes, block.outline[std::countr_zero(left)])) return;
    }
  }
  add_rest(edge);
}

}  // namespace gnomon::area_contour
