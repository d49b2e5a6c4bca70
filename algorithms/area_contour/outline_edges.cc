// SPDX-License-Identifier: LGPL-3.0-or-later
// Outlines as they are added: what the receiver and their own lines leave of each line, four lines
// at a time.
#include <algorithm>
#include <bit>
#include <cmath>

#include "algorithms/area_contour/four_doubles.h"
#include "algorithms/area_contour/outline_trim.h"
#include "algorithms/area_contour/outline_union.h"

namespace gnomon::area_contour {
namespace {

/// Of each corner what a mask says of the next one.
CornerMask at_next(CornerMask mask, std::uint32_t corners) {
  return mask >> 1 | (mask & 1) << (corners - 1);
}

}  // namespace

/// Stretches of the four lines of a block. The places at either end: the least and the greatest.
struct alignas(32) OutlineUnion::FourStretches {
  double low_outer[4], low_inner[4], high_inner[4], high_outer[4];

  Stretch of(std::uint32_t k) const {
    return {{low_inner[k], low_outer[k]}, {high_inner[k], high_outer[k]}};
  }
};

/// Which edges of the receiver a line meets, or in which corners, is told by the sides of the
/// corners. It runs with its outline on the left, so that it leaves the receiver where corners, in
/// their order, go over to the outline's side.
[[gnu::always_inline]] inline void OutlineUnion::in_receiver(std::uint32_t number,
                                                             FourStretches& stretches) const {
  const ReceiverChart& receiver = *receiver_;
  const LineBlock& block = blocks_[number];
  /// Of the receiver's edges that lines meet: the corners at their beginnings and ends.
  struct alignas(32) {
    double x[4] = {}, y[4] = {}, next_x[4] = {}, next_y[4] = {};
    std::int64_t is_met[4] = {};   // that at its end: all bits
    std::uint32_t corner[4] = {};  // at its beginning
  } met[2];                        // where lines enter, and where they leave
  for (std::uint32_t i = 0; i < 4; ++i) {
    const auto [before, behind] = sides_of(block.sides[i]);
    if (behind == 0) continue;  // no line
    for (const bool leaves : {false, true}) {
      const CornerMask here = leaves ? behind : before;
      const auto k =
          static_cast<std::uint32_t>(std::countr_zero(here & ~at_next(here, receiver.size())));
      const std::uint32_t next = receiver.next(k);
      auto& at = met[leaves ? 1 : 0];
      at.corner[i] = k;
      at.x[i] = receiver.corners[k][0];
      at.y[i] = receiver.corners[k][1];
      at.next_x[i] = receiver.corners[next][0];
      at.next_y[i] = receiver.corners[next][1];
      at.is_met[i] = ((leaves ? before : behind) >> next & 1) != 0 ? 0 : -1;
    }
  }
  const Doubles &a = row(block.a), &b = row(block.b), &c = row(block.c);
  const double place_error = 2 * receiver.error + slack_;
  const Doubles error = row(block.error) + 2 * receiver.error + slack_;
  for (const bool leaves : {false, true}) {
    const auto& at = met[leaves ? 1 : 0];
    const Doubles &x = row(at.x), &y = row(at.y), &next_x = row(at.next_x),
                  &next_y = row(at.next_y);
    const Doubles from = x * b - y * a, to = next_x * b - next_y * a, length = to - from;
    const Doubles value = a * x + b * y + c, next_value = a * next_x + b * next_y + c;
    const Doubles here = value < 0 ? -value : value,
                  there = next_value < 0 ? -next_value : next_value;
    const Doubles both = here + there, known = 4 * error / both;
    const bool is_known = all(known < kKnownShare);  // of no line it is no number
    Doubles share = here / both, share_error = known + 0x1p-49;
    for (std::uint32_t i = 0; i < 4 && !is_known; ++i) {
      if (known[i] < kKnownShare || sides_of(block.sides[i]).behind == 0) continue;
      const BorderShare own = share_of_border(4 * number + i, at.corner[i]);
      share[i] = own.share;
      share_error[i] = own.radius;
    }
    const Doubles spread = (length < 0 ? -length : length) * share_error;
    const Bits& is_met = *reinterpret_cast<const Bits*>(at.is_met);
    const Doubles radius = is_met ? place_error : place_error + spread;
    const Doubles place = is_met ? to : from + share * length;
    row(leaves ? stretches.high_inner : stretches.low_outer) = place - radius;
    row(leaves ? stretches.high_outer : stretches.low_inner) = place + radius;
  }
}

/// By integers. A line that cuts the stretch is added to what trims it.
OutlineUnion::Near OutlineUnion::resolve(std::uint32_t line, std::uint32_t by,
                                         Trim& trimmed) const {
  const OutlineLine own = line_of(line), other = line_of(by);
  if (exact_->is_known_same(own, other)) return Near::kSame;
  const auto [low, high] = exact_->sides_at_ends(other, own);
  if (low == Side::kOn && high == Side::kOn) return Near::kSame;
  if (low != Side::kBack && high != Side::kBack) return Near::kInside;
  if (low != Side::kFront && high != Side::kFront) return Near::kOutside;
  const Ball place = exact_->place_on(own, other);
  if (!place.is_finite()) {
    trimmed.is_certain = false;
  } else if (low == Side::kBack) {
    trimmed.begin_between(place.lower(), place.upper(), by);
  } else {
    trimmed.end_between(place.lower(), place.upper(), by);
  }
  return Near::kCuts;
}

/// False if certainly nothing is left of the edge.
bool OutlineUnion::cut_by_own(const Outline& outline, std::uint32_t line, Stretch& stretch) {
  FourStretches in;
  in_receiver(line / 4, in);
  stretch = in.of(line % 4);
  Edge own = edge_on(line, 0, 0, 0);
  own.from = stretch.low.outer;
  own.to = stretch.high.outer;
  const bool is_left = trim(own, outline);
  Trim trimmed;
  for (const Trimming& by : trimmings_) {
    if (by.line == line) continue;
    if (!by.is_near) {
      trimmed.add(by);
      continue;
    }
    const Near near = resolve(line, by.line, trimmed);
    if (near == Near::kOutside) return false;
    if (near != Near::kSame) continue;
    // Of one line that is given twice the first is the edge; two that look away from each other
    // have nothing between them.
    const OutlineLine other = line_of(by.line);
    is_flat_ = own.a * other.a + own.b * other.b < 0;
    if (by.line < line || is_flat_) return false;
    twins_.push_back(by.line);
  }
  if (!is_left) return false;
  Stretch cut;
  trimmed.put(cut);
  stretch.is_certain = cut.is_certain;
  // Where the receiver's border may end the edge as well as a line, the place has no name.
  if (cut.low.inner > stretch.low.outer) {
    stretch.low = cut.low.outer > stretch.low.inner
                      ? cut.low
                      : End{std::max(stretch.low.inner, cut.low.inner),
                            std::max(stretch.low.outer, cut.low.outer)};
  }
  if (cut.high.inner < stretch.high.outer) {
    stretch.high = cut.high.outer < stretch.high.inner
                       ? cut.high
                       : End{std::min(stretch.high.inner, cut.high.inner),
                             std::min(stretch.high.outer, cut.high.outer)};
  }
  return stretch.may_be();
}

bool OutlineUnion::is_twin(std::uint32_t line) const {
  return std::ranges::find(twins_, line) != twins_.end();
}

/// Which lines of a block, of those that `near` names, another one of their outline is known to be.
/// The later one of each two is a twin; two that look away from each other have nothing between
/// them.
unsigned OutlineUnion::find_same(std::uint32_t line, std::uint32_t number, unsigned near) {
  const OutlineLine other = line_of(line);
  unsigned same = 0;
  for (; near != 0; near &= near - 1) {
    const auto k = static_cast<std::uint32_t>(std::countr_zero(near));
    const OutlineLine own = line_of(4 * number + k);
    if (!exact_->is_known_same(own, other)) continue;
    same |= 1u << k;
    is_flat_ = is_flat_ || own.a * other.a + own.b * other.b < 0;
    const std::uint32_t later = std::max(line, 4 * number + k);
    if (!is_twin(later)) twins_.push_back(later);
  }
  return same;
}

/// Cuts the lines of a block by the others of their outline, as cut_by_own() does, and says of
/// which that has to be asked, since another one may be the same line. So it is for names of ends
/// that more than one line may make.
[[gnu::always_inline]] inline unsigned OutlineUnion::find_ends(const Outline& outline,
                                                               std::uint32_t count,
                                                               std::uint32_t number) {
  constexpr Bits kLanes = {0x1, 0x2, 0x4, 0x8};
  constexpr Bits kNoLines = {kUnnamed, kUnnamed, kUnnamed, kUnnamed};
  constexpr Doubles kBeyond = {kInfinity, kInfinity, kInfinity, kInfinity};
  LineBlock& own = blocks_[number];
  FourStretches in;
  in_receiver(number, in);
  const Doubles &least = row(in.low_outer), &most = row(in.high_outer);
  const long first_line = 4 * static_cast<long>(outline.first);
  const long place_of_own = 4 * static_cast<long>(number) - first_line;
  const Bits places = {place_of_own, place_of_own + 1, place_of_own + 2, place_of_own + 3};
  const Doubles &own_a = row(own.a), &own_b = row(own.b), &own_c = row(own.c);
  const Doubles own_error = row(own.error) + slack_;
  Bits missed = places >= static_cast<long>(count), near = {};
  for (const std::uint32_t twin : twins_) missed |= places == static_cast<long>(twin) - first_line;
  // As Trim has it, but of the innermost places only two.
  Doubles low_outer = -kBeyond, low = -kBeyond, outer_of_low = -kBeyond, second_low = -kBeyond;
  Doubles high_outer = kBeyond, high = kBeyond, outer_of_high = kBeyond, second_high = kBeyond;
  Bits low_line = kNoLines, high_line = kNoLines;
  for (std::uint32_t i = 0; i < count; ++i) {
    const LineBlock& block = blocks_[outline.first + i / 4];
    const double a = block.a[i % 4], b = block.b[i % 4];
    const Doubles start = block.c[i % 4] - own_c * (a * own_a + b * own_b);
    const Doubles slope = a * own_b - b * own_a;
    const Doubles error = block.error[i % 4] + own_error;
    const Doubles first = start + slope * least, last = start + slope * most;
    Bits cuts = ~((first > error) & (last > error)) & (places != static_cast<long>(i));
    if (!any(cuts)) continue;
    missed |= cuts & (first < -error) & (last < -error);
    if (all(missed)) break;  // whatever the others do
    // Of what is missed nothing is left, whatever it lies along.
    const Bits is_near =
        cuts & ~missed & (first >= -error) & (first <= error) & (last >= -error) & (last <= error);
    if (any(is_near)) {
      const long found = find_same(4 * outline.first + i, number, lanes_of(is_near & kLanes));
      const Bits same = (kLanes & found) != 0;
      near |= is_near & ~same;
      cuts &= ~same;
      missed |= same & (places > static_cast<long>(i));
      if (is_twin(4 * outline.first + i)) continue;  // the line that it is cuts, too
    }
    const Doubles place = -start / slope, quotient = error / slope;
    const Doubles half = quotient < 0 ? -quotient : quotient;
    const Doubles radius = half + 0x1p-49 * ((place < 0 ? -place : place) + half);
    const Doubles before = place - radius, behind = place + radius;
    // Else they may be parallel, and the place none.
    const Bits crosses = (slope < 0 ? -slope : slope) * receiver_->reach > 8 * error;
    const Bits line = crosses ? static_cast<long>(i < kAsk ? i : kAsk) : long{kUnnamed};
    const Bits begins = cuts & (slope > 0), ends = cuts & ~(slope > 0);
    const Bits is_low = begins & (behind > low), is_high = ends & (before < high);
    low_outer = (begins & (before > low_outer)) ? before : low_outer;
    second_low = is_low ? low : (begins & (behind > second_low)) ? behind : second_low;
    low = is_low ? behind : low;
    outer_of_low = is_low ? before : outer_of_low;
    low_line = is_low ? line : low_line;
    high_outer = (ends & (behind < high_outer)) ? behind : high_outer;
    second_high = is_high ? high : (ends & (before < second_high)) ? before : second_high;
    high = is_high ? before : high;
    outer_of_high = is_high ? behind : outer_of_high;
    high_line = is_high ? line : high_line;
    missed |= low_outer >= high_outer;
  }
  low_line = ((low_line != kUnnamed) & (second_low >= outer_of_low)) ? long{kAsk} : low_line;
  high_line = ((high_line != kUnnamed) & (second_high <= outer_of_high)) ? long{kAsk} : high_line;
  // Where the receiver's border may end the edge as well as a line, the place has no name.
  const Doubles &least_in = row(in.low_inner), &most_in = row(in.high_inner);
  const Bits low_alone = (low > least) & (low_outer > least_in),
             high_alone = (high < most) & (high_outer < most_in);
  row(own.inner_from) = (low_alone | (low > least_in)) ? low : least_in;
  row(own.inner_to) = (high_alone | (high < most_in)) ? high : most_in;
  low_line = low_alone ? low_line : long{kUnnamed};
  high_line = high_alone ? high_line : long{kUnnamed};
  for (std::size_t k = 0; k < 4; ++k) {
    own.from_line[k] = static_cast<std::uint8_t>(low_line[k]);
    own.to_line[k] = static_cast<std::uint8_t>(high_line[k]);
  }
  row(own.from) = missed ? 0.0 : low_outer > least ? low_outer : least;
  row(own.to) = missed ? 0.0 : high_outer < most ? high_outer : most;
  return lanes_of(near & kLanes & (places < static_cast<long>(count)));
}

/// What the receiver and the lines of its outline leave of an edge's line.
OutlineUnion::Stretch OutlineUnion::own_stretch(const Edge& edge) {
  const LineBlock& block = blocks_[edge.line / 4];
  const std::uint32_t k = edge.line % 4;
  const int from_line = block.from_line[k], to_line = block.to_line[k];
  if (from_line == kAsk || to_line == kAsk) {
    Stretch stretch;
    cut_by_own(outlines_[edge.outline], edge.line, stretch);
    return stretch;
  }
  const std::uint32_t first = 4 * outlines_[edge.outline].first;
  const auto number = [&](int line) {
    return line == kUnnamed ? kNoLine : first + static_cast<std::uint32_t>(line);
  };
  return {{block.inner_from[k], block.from[k], number(from_line)},
          {block.inner_to[k], block.to[k], number(to_line)}};
}

/// Drops the lines of an outline that have no edge, and those that an earlier one is, too.
/// Requires: some edge certainly is, so that the outline has an area. What the other lines leave of
/// the receiver is convex, and a line without an edge meets it in a point at most: so all of it
/// lies on one side of the line, and since some does on the outline's, all of it is the outline.
/// That holds of one line after another, since each leaves the outline as it was.
void OutlineUnion::drop_lines(Outline& outline, std::uint32_t count) {
  std::array<std::uint8_t, 256> places;
  std::uint32_t kept = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const LineBlock& block = blocks_[outline.first + i / 4];
    const std::uint32_t k = i % 4;
    const bool is_edge = block.from[k] < block.to[k];
    if (i < kAsk) places[i] = static_cast<std::uint8_t>(is_edge ? kept : kAsk);
    if (is_edge && kept < i) blocks_[outline.first + kept / 4].take(kept % 4, block, k);
    if (is_edge) ++kept;
  }
  if (kept == count) return;
  outline.end = outline.first + (kept + 3) / 4;
  const auto rename = [&](std::uint8_t& line) {
    if (line < kAsk) line = places[line];
  };
  for (std::uint32_t i = 0; i < 4 * (outline.end - outline.first); ++i) {
    LineBlock& block = blocks_[outline.first + i / 4];
    if (i < kept) {
      rename(block.from_line[i % 4]);
      rename(block.to_line[i % 4]);
    } else {
      block.fill(i % 4);
    }
  }
  blocks_.resize(outline.end);
}

/// Finds the edges of an outline, and a rectangle around them; leaves only lines that have edges if
/// one certainly is. False if it has none, or no area.
GNOMON_FOR_AVX2 bool OutlineUnion::find_edges(Outline& outline, std::uint32_t count,
                                              double (&low)[2], double (&high)[2]) {
  constexpr Doubles kBeyond = {kInfinity, kInfinity, kInfinity, kInfinity};
  Doubles low_x = kBeyond, low_y = kBeyond, high_x = -kBeyond, high_y = -kBeyond;
  constexpr Bits kLanes = {0x1, 0x2, 0x4, 0x8};
  Bits has_certain = {};
  std::uint32_t edges = 0;
  twins_.clear();
  for (std::uint32_t i = outline.first; i < outline.end; ++i) {
    LineBlock& block = blocks_[i];
    unsigned left = find_ends(outline, count, i);
    for (; left != 0 && !is_flat_; left &= left - 1) {
      const auto k = static_cast<std::uint32_t>(std::countr_zero(left));
      Stretch stretch;
      const bool is_left = !is_twin(4 * i + k) && cut_by_own(outline, 4 * i + k, stretch);
      block.from[k] = is_left ? stretch.low.outer : 0;
      block.to[k] = is_left ? stretch.high.outer : 0;
      block.inner_from[k] = block.inner_to[k] = 0;
      block.from_line[k] = kAsk;
    }
    if (is_flat_) return false;
    const Doubles &a = row(block.a), &b = row(block.b), &c = row(block.c);
    const Doubles &from = row(block.from), &to = row(block.to);
    const Bits is_edge = from < to;
    const Doubles x = -c * a, y = -c * b;
    const Doubles from_x = x + from * b, from_y = y - from * a, to_x = x + to * b,
                  to_y = y - to * a;
    const Doubles least_x = from_x < to_x ? from_x : to_x, most_x = from_x < to_x ? to_x : from_x;
    const Doubles least_y = from_y < to_y ? from_y : to_y, most_y = from_y < to_y ? to_y : from_y;
    low_x = (is_edge & (least_x < low_x)) ? least_x : low_x;
    low_y = (is_edge & (least_y < low_y)) ? least_y : low_y;
    high_x = (is_edge & (most_x > high_x)) ? most_x : high_x;
    high_y = (is_edge & (most_y > high_y)) ? most_y : high_y;
    edges += static_cast<std::uint32_t>(std::popcount(lanes_of(is_edge & kLanes)));
    has_certain |= is_edge & (row(block.inner_from) < row(block.inner_to));
  }
  // Where no block is spared it would cost more, but for lines that are others, too.
  const bool is_worth = (edges + 3) / 4 < outline.end - outline.first || !twins_.empty();
  if (is_worth && any(has_certain)) drop_lines(outline, count);
  low[0] = least_of(low_x);
  low[1] = least_of(low_y);
  high[0] = most_of(high_x);
  high[1] = most_of(high_y);
  return edges != 0;
}

/// Of the receiver's edges those of which an outline may hold some, by the corners behind them.
CornerMask OutlineUnion::edges_of_border(std::span<const OutlineLine> lines) const {
  const std::uint32_t n = receiver_->size();
  CornerMask edges = ~CornerMask{0} >> (kMostCorners - n);
  for (const OutlineLine& line : lines) {
    const CornerMask next_before = at_next(line.before, n), next_behind = at_next(line.behind, n);
    edges &= (~line.behind & ~next_behind) | (line.behind & next_before) |
             (~line.behind & next_behind & line.before);
  }
  return edges;
}

/// What fills up a block.
void OutlineUnion::LineBlock::fill(std::uint32_t k) {
  a[k] = b[k] = error[k] = 0;
  c[k] = kFar;
  from[k] = to[k] = 0;
  sides[k] = 0;
}

void OutlineUnion::LineBlock::take(std::uint32_t k, const LineBlock& block, std::uint32_t i) {
  a[k] = block.a[i];
  b[k] = block.b[i];
  c[k] = block.c[i];
  error[k] = block.error[i];
  from[k] = block.from[i];
  to[k] = block.to[i];
  inner_from[k] = block.inner_from[i];
  inner_to[k] = block.inner_to[i];
  from_line[k] = block.from_line[i];
  to_line[k] = block.to_line[i];
  sides[k] = block.sides[i];
  plane[k] = block.plane[i];
}

/// A number for what lines have on their sides: the bits of few corners, else a place in sides_,
/// which begins with what fills up blocks.
inline std::uint16_t OutlineUnion::number_of(const Sides& sides) {
  if (receiver_->size() <= kFewCorners) {
    return static_cast<std::uint16_t>(sides.before | sides.behind << kFewCorners);
  }
  const auto known = std::ranges::find_if(sides_, [&](const Sides& other) {
    return other.before == sides.before && other.behind == sides.behind;
  });
  const auto number = static_cast<std::uint16_t>(known - sides_.begin());
  if (known == sides_.end()) sides_.push_back(sides);
  return number;
}

void OutlineUnion::add(std::span<const OutlineLine> lines) {
  const ReceiverChart& receiver = *receiver_;
  const auto count = static_cast<std::uint32_t>(lines.size());
  const auto number = static_cast<std::uint32_t>(outlines_.size());
  Outline outline;
  outline.first = static_cast<std::uint32_t>(blocks_.size());
  outline.end = outline.first + (count + 3) / 4;
  blocks_.resize(outline.end);
  CornerMask outside = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    // The first one, mostly the caster's own plane, is the least likely to have an edge.
    const OutlineLine& line = lines[i + 1 < count ? i + 1 : 0];
    LineBlock& block = blocks_[outline.first + i / 4];
    const std::uint32_t k = i % 4;
    block.a[k] = line.a;
    block.b[k] = line.b;
    block.c[k] = line.c;
    block.error[k] = line.error;
    block.plane[k] = line.plane;
    block.sides[k] = number_of({line.before, line.behind});
    most_error_ = std::max(most_error_, line.error);
    outside |= line.behind;
  }
  for (std::uint32_t k = count % 4; k != 0 && k < 4; ++k) blocks_[outline.end - 1].fill(k);
  double low[2], high[2];
  is_flat_ = false;
  if (!find_edges(outline, count, low, high)) {  // nothing of the receiver is inside
    blocks_.resize(outline.first);
    return;
  }
  for (std::uint32_t k = 0; k < receiver.size(); ++k) {
    if ((outside >> k & 1) != 0) continue;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      low[axis] = std::min(low[axis], receiver.corners[k][axis]);
      high[axis] = std::max(high[axis], receiver.corners[k][axis]);
    }
  }
  outline.box = box_of(low[0], low[1], high[0], high[1]);
  outlines_.push_back(outline);
  if (const CornerMask edges = edges_of_border(lines); edges != 0) {
    bordering_.push_back({number, edges});
  }
}

}  // namespace gnomon::area_contour
