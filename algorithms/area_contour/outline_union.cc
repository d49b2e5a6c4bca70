// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/area_contour/outline_union.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel/signs/ball.h"

namespace gnomon::area_contour {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kUnit = Ball::kUnit;

/// A choice, not a bound.
constexpr double kSharpenAbove = 0x1p-24;

/// The border of the covered part, as a walk that must come back to where it began: whoever has
/// lost a piece of it does not. Of the union that this thread is at.
struct Walk {
  double x = 0, y = 0, error = 0;
  void add(double dx, double dy, double middle, double radius) {
    x += dx * middle;
    y += dy * middle;
    const double length = std::fabs(dx) + std::fabs(dy);
    error += length * radius + 4 * kUnit * (length * middle + std::fabs(x) + std::fabs(y));
  }
  bool is_closed() const { return std::fabs(x) <= error && std::fabs(y) <= error; }
};
thread_local Walk walk;

bool has(CornerMask mask, std::uint32_t corner) { return (mask >> corner & 1) != 0; }

}  // namespace

/// What lines leave of a stretch of a line. It begins at the greatest of the places at which one of
/// them lets it begin; those that may be the greatest are known if they are at most two.
struct OutlineUnion::Trim {
  double from = 0, to = 0;  // of the stretch, outer ends
  bool is_certain = true;

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

void OutlineUnion::begin(const ReceiverChart& receiver, ExactLines& exact) {
  receiver_ = &receiver;
  exact_ = &exact;
  slack_ = kSlack * receiver.reach;
  lines_.clear();
  outlines_.clear();
  edges_.clear();
}

OutlineUnion::Box OutlineUnion::box_of(const OutlineLine& line, double from, double to) const {
  const double x0 = -line.c * line.a, y0 = -line.c * line.b, margin = line.error + slack_;
  const double x[] = {x0 + from * line.b, x0 + to * line.b},
               y[] = {y0 - from * line.a, y0 - to * line.a};
  return {{std::min(x[0], x[1]) - margin, std::min(y[0], y[1]) - margin},
          {std::max(x[0], x[1]) + margin, std::max(y[0], y[1]) + margin}};
}

/// Which edges of the receiver the line meets, or in which corners, is told by the sides of the
/// corners. It runs with its outline on the left, so that it leaves the receiver where corners, in
/// their order, go over to the outline's side.
OutlineUnion::Stretch OutlineUnion::in_receiver(const OutlineLine& line) const {
  const ReceiverChart& receiver = *receiver_;
  const double error = line.error + 2 * receiver.error + slack_;
  Stretch stretch;
  const auto along = [&](std::uint32_t k) {
    return receiver.corners[k][0] * line.b - receiver.corners[k][1] * line.a;
  };
  const auto distance = [&](std::uint32_t k) {
    return std::fabs(line.a * receiver.corners[k][0] + line.b * receiver.corners[k][1] + line.c);
  };
  const double place_error = 2 * receiver.error + slack_;
  for (std::uint32_t k = 0; k < receiver.size(); ++k) {
    const std::uint32_t next = receiver.next(k);
    const bool leaves = has(line.behind, k) && !has(line.behind, next);
    const bool enters = has(line.before, k) && !has(line.before, next);
    if (!leaves && !enters) continue;
    double place = along(next), radius = place_error;
    if (has(leaves ? line.before : line.behind, next)) {  // else the corner is on the line
      const double here = distance(k), there = distance(next), both = here + there;
      const double from = along(k), length = place - from;
      const double share = both > 8 * error ? here / both : 0.5;
      radius += std::fabs(length) * (both > 8 * error ? std::min(4 * error / both, 1.0) : 0.5);
      place = from + share * length;
    }
    if (leaves) {
      stretch.high = {place - radius, place + radius};
    } else {
      stretch.low = {place + radius, place - radius};
    }
  }
  return stretch;
}

/// Trims a stretch of one line by the half-plane of another. False if nothing is left. What may be
/// the same line leaves it uncertain.
bool OutlineUnion::trim(std::uint32_t own_line, std::uint32_t by_line, Trim& trim) const {
  const OutlineLine &own = lines_[own_line], &by = lines_[by_line];
  const double start = by.c - own.c * (by.a * own.a + by.b * own.b);
  const double slope = by.a * own.b - by.b * own.a;
  const double error = own.error + by.error + slack_;
  const double first = start + slope * trim.from, last = start + slope * trim.to;
  if (first > error && last > error) return true;
  if (first < -error && last < -error) return false;
  if (std::fabs(first) <= error && std::fabs(last) <= error) {
    trim.is_certain = false;
    return true;
  }
  const double place = -start / slope, half = std::fabs(error / slope);
  const double radius = half + 0x1p-49 * (std::fabs(place) + half);
  // Else they may be parallel, and the place none.
  const bool cross = std::fabs(slope) * receiver_->reach > 8 * error;
  if (slope > 0) {
    trim.begin_at(place, radius, cross ? by_line : kNoLine);
  } else {
    trim.end_at(place, radius, cross ? by_line : kNoLine);
  }
  return true;
}

bool OutlineUnion::is_one(std::uint32_t a, std::uint32_t b) const {
  return lines_[a].name == lines_[b].name || exact_->is_same(lines_[a], lines_[b]);
}

/// False if certainly nothing is left of the edge.
bool OutlineUnion::cut_by_own(const Outline& outline, std::uint32_t line, Stretch& stretch) {
  const OutlineLine& own = lines_[line];
  stretch = in_receiver(own);
  Trim trim;
  trim.from = stretch.low.outer;
  trim.to = stretch.high.outer;
  for (std::uint32_t i = outline.first; i < outline.first + outline.count; ++i) {
    if (i == line) continue;
    const bool was_certain = trim.is_certain;
    trim.is_certain = true;
    if (!this->trim(line, i, trim)) return false;
    const bool is_near = !trim.is_certain;
    trim.is_certain = was_certain;
    if (!is_near) continue;
    if (!is_one(line, i)) {
      trim.is_certain = false;
      continue;
    }
    // Of one line that is given twice the first is the edge; two that look away from each other
    // have nothing between them.
    is_flat_ = own.a * lines_[i].a + own.b * lines_[i].b < 0;
    if (i < line || is_flat_) return false;
  }
  const Stretch cut = trim.stretch();
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

void OutlineUnion::add(std::span<const OutlineLine> lines) {
  const ReceiverChart& receiver = *receiver_;
  Outline outline{static_cast<std::uint32_t>(lines_.size()),
                  static_cast<std::uint32_t>(lines.size()),
                  {{kInfinity, kInfinity}, {-kInfinity, -kInfinity}}};
  lines_.insert(lines_.end(), lines.begin(), lines.end());
  const auto number = static_cast<std::uint32_t>(outlines_.size());
  const auto grow = [&](const Box& box) {
    for (int k = 0; k < 2; ++k) {
      outline.box.low[k] = std::min(outline.box.low[k], box.low[k]);
      outline.box.high[k] = std::max(outline.box.high[k], box.high[k]);
    }
  };
  const std::size_t first_edge = edges_.size();
  is_flat_ = false;
  for (std::uint32_t i = outline.first; i < outline.first + outline.count; ++i) {
    Edge edge{i, number, {}, {}};
    const bool is_left = cut_by_own(outline, i, edge.stretch);
    if (is_flat_) break;
    if (!is_left) continue;
    edge.box = box_of(lines_[i], edge.stretch.low.outer, edge.stretch.high.outer);
    grow(edge.box);
    edges_.push_back(edge);
  }
  if (edges_.size() == first_edge || is_flat_) {  // nothing of the receiver is inside
    edges_.resize(first_edge);
    lines_.resize(outline.first);
    return;
  }
  CornerMask outside = 0;
  for (const OutlineLine& line : lines) outside |= line.behind;
  for (std::uint32_t k = 0; k < receiver.size(); ++k) {
    if (has(outside, k)) continue;
    const std::array<double, 2>& corner = receiver.corners[k];
    const double margin = receiver.error;
    grow({{corner[0] - margin, corner[1] - margin}, {corner[0] + margin, corner[1] + margin}});
  }
  outlines_.push_back(outline);
}

/// The stretch of an edge that another outline holds on its outer side; false if there is none.
bool OutlineUnion::cover(const Edge& edge, std::uint32_t other, Stretch& stretch) const {
  const OutlineLine& own = lines_[edge.line];
  const Outline& outline = outlines_[other];
  Trim trim;
  trim.from = edge.stretch.low.outer;
  trim.to = edge.stretch.high.outer;
  for (std::uint32_t i = outline.first; i < outline.first + outline.count; ++i) {
    const OutlineLine& by = lines_[i];
    const bool was_certain = trim.is_certain;
    trim.is_certain = true;
    if (!this->trim(edge.line, i, trim)) return false;
    const bool is_near = !trim.is_certain;
    trim.is_certain = was_certain;
    if (!is_near) continue;
    if (!is_one(edge.line, i)) {
      trim.is_certain = false;
      continue;
    }
    // One line: on the other side it hides, on this one if it acts before.
    if (by.a * own.a + by.b * own.b > 0 && other > edge.outline) return false;
  }
  stretch = trim.stretch();
  return stretch.low.outer < trim.to && stretch.high.outer > trim.from && stretch.may_be();
}

/// The stretch of the receiver's edge behind a corner that an outline holds, in shares of the edge.
bool OutlineUnion::cover_border(std::uint32_t corner, const Outline& outline,
                                Stretch& stretch) const {
  const ReceiverChart& receiver = *receiver_;
  const std::uint32_t next = receiver.next(corner);
  Trim trim;
  for (std::uint32_t i = outline.first; i < outline.first + outline.count; ++i) {
    const OutlineLine& line = lines_[i];
    const bool from_behind = has(line.behind, corner), to_behind = has(line.behind, next);
    if (!from_behind && !to_behind) continue;
    if (!has(line.before, from_behind ? next : corner)) return false;
    const auto distance = [&](std::uint32_t k) {
      return std::fabs(line.a * receiver.corners[k][0] + line.b * receiver.corners[k][1] + line.c);
    };
    const double here = distance(corner), both = here + distance(next);
    const double error = line.error + 2 * receiver.error + slack_;
    const bool is_known = both > 8 * error;
    const double share = is_known ? here / both : 0.5;
    const double radius = (is_known ? 4 * error / both : 0.5) + 8 * kUnit;
    if (from_behind) {
      trim.begin_at(share, radius, i);
    } else {
      trim.end_at(share, radius, i);
    }
  }
  stretch = trim.stretch();
  return stretch.may_be();
}

/// Whether there may be something between the place where a cover ends, or the stretch begins, and
/// one where the next begins, or the stretch ends (`is_end`). Where the bounds leave that open,
/// integers tell if they can: the first place is inside of a later cover, or beyond the stretch.
bool OutlineUnion::has_gap(const Carrier& carrier, const End& before, const End& after,
                           bool is_end) const {
  if (after.inner <= before.inner) return false;
  if (after.outer > before.outer || !before.is_known() || !after.is_known()) return true;
  const OutlineLine &ends = lines_[before.line], &begins = lines_[after.line];
  if (before.line == after.line || ends.name == begins.name) return false;
  const Side side = carrier.line == kNoLine
                        ? exact_->side_at_border(begins, ends, carrier.corner)
                        : exact_->side_of_meet(begins, lines_[carrier.line], ends);
  return side == (is_end ? Side::kFront : Side::kBack);
}

/// The end of a stretch as that of what is outside of it.
OutlineUnion::End OutlineUnion::outside(const End& end) {
  return {end.outer, end.inner, end.line, end.other, end.begins};
}

/// What certainly is seen: neither a cover nor one that perhaps is.
void OutlineUnion::find_certain(const Stretch& stretch, Lengths& rest) {
  certain_gaps_.clear();
  if (!stretch.certainly_is()) return;
  std::ranges::sort(covers_, {}, [](const Stretch& cover) { return cover.low.outer; });
  End at = outside(stretch.low);
  for (const Stretch& cover : covers_) {
    if (at.outer >= stretch.high.inner) return;
    if (cover.low.outer > at.outer) {
      if (cover.low.outer >= stretch.high.inner) break;
      rest.certain += cover.low.outer - at.outer;
      certain_gaps_.push_back({at, cover.low});
    }
    if (cover.high.outer > at.outer) at = cover.high;
  }
  if (at.outer >= stretch.high.inner) return;
  rest.certain += stretch.high.inner - at.outer;
  certain_gaps_.push_back({at, outside(stretch.high)});
}

/// What perhaps is seen: no cover that is certain.
void OutlineUnion::find_perhaps(const Carrier& carrier, const Stretch& stretch, Lengths& rest) {
  perhaps_gaps_.clear();
  std::ranges::sort(covers_, {}, [](const Stretch& cover) { return cover.low.inner; });
  // Up to here all is covered. The stretch begins where a cover of what is before it would end.
  End at = outside(stretch.low);
  const End end = outside(stretch.high);
  for (const Stretch& cover : covers_) {
    if (!cover.certainly_is()) continue;
    if (at.inner >= end.inner) return;
    if (cover.low.inner >= end.inner) break;
    if (has_gap(carrier, at, cover.low, false)) {
      rest.perhaps += cover.low.inner - at.inner;
      perhaps_gaps_.push_back({at, cover.low});
    }
    if (cover.high.inner > at.inner) at = cover.high;
  }
  if (!has_gap(carrier, at, end, true)) return;
  rest.perhaps += end.inner - at.inner;
  perhaps_gaps_.push_back({at, end});
}

/// Measures gaps between sharper places, where it is certain which they are between: no other cover
/// may reach in. What is outside of the stretch is among the covers here.
void OutlineUnion::sharpen(const Carrier& carrier, Lengths& rest) {
  const auto is_place = [](const End& a, const End& b) {
    return a.line == b.line && a.other == b.other && a.inner == b.inner && a.outer == b.outer;
  };
  const auto is_same = [&](const Gap& a, const Gap& b) {
    return is_place(a.before, b.before) && is_place(a.after, b.after);
  };
  if (carrier.line == kNoLine || !std::ranges::equal(certain_gaps_, perhaps_gaps_, is_same)) return;
  const auto is_alone = [&](const Gap& gap) {
    return std::ranges::none_of(covers_, [&](const Stretch& cover) {
      return cover.low.outer < gap.after.inner && cover.high.outer > gap.before.inner &&
             !is_place(cover.low, gap.after) && !is_place(cover.high, gap.before);
    });
  };
  Lengths sharp;
  // Of a place: the least and the greatest.
  using Bounds = std::array<double, 2>;
  const auto sharper = [&](std::uint32_t line) -> Bounds {
    const Ball place = exact_->place_on(lines_[carrier.line], lines_[line]);
    return {place.lower(), place.upper()};
  };
  const auto bounds = [&](const End& end, bool is_sharp) -> Bounds {
    const Bounds known{std::min(end.inner, end.outer), std::max(end.inner, end.outer)};
    if (!is_sharp || end.line == kNoLine || known[0] == known[1]) return known;
    Bounds place = sharper(end.line);
    if (end.other != kNoLine) {
      const Bounds other = sharper(end.other);
      for (std::size_t i = 0; i < 2; ++i) {
        place[i] = end.begins ? std::max(place[i], other[i]) : std::min(place[i], other[i]);
      }
    }
    // Where cells meet before the place, or behind it, the stretch ends there.
    return {std::fmin(std::fmax(place[0], known[0]), known[1]),
            std::fmax(std::fmin(place[1], known[1]), known[0])};
  };
  for (const Gap& gap : perhaps_gaps_) {
    const bool is_sharp = is_alone(gap);
    const auto [first, after_first] = bounds(gap.before, is_sharp);
    const auto [before_last, last] = bounds(gap.after, is_sharp);
    sharp.certain += std::max(0.0, before_last - after_first);
    sharp.perhaps += last - first;
  }
  rest.certain = std::max(rest.certain, sharp.certain);
  rest.perhaps = std::min(rest.perhaps, sharp.perhaps);
}

/// What the covers leave of a stretch.
OutlineUnion::Lengths OutlineUnion::rest_of(const Carrier& carrier, const Stretch& stretch) {
  Lengths rest;
  find_certain(stretch, rest);
  find_perhaps(carrier, stretch, rest);
  if (is_sharp_) {
    covers_.push_back({{-kInfinity, -kInfinity}, outside(stretch.low)});
    covers_.push_back({outside(stretch.high), {kInfinity, kInfinity}});
    sharpen(carrier, rest);
  }
  const double rounding = 2 * kUnit * static_cast<double>(covers_.size() + 4);
  rest.perhaps += rounding * rest.perhaps;
  rest.certain = std::max(0.0, rest.certain - rounding * rest.certain);
  return rest;
}

/// Adds a stretch of a line whose distance from the origin is `height` to twice the area.
void OutlineUnion::add_integral(double height, double height_error, const Lengths& lengths) {
  const double middle = lengths.certain + (lengths.perhaps - lengths.certain) / 2;
  const double radius = (lengths.perhaps - lengths.certain) / 2;
  sum_ += height * middle;
  error_ += (std::fabs(height) + height_error) * radius + height_error * lengths.perhaps +
            8 * kUnit * std::fabs(height) * lengths.perhaps + kUnit * std::fabs(sum_);
}

void OutlineUnion::add_borders() {
  const ReceiverChart& receiver = *receiver_;
  const double reach = receiver.reach;
  const double height_error = 4 * reach * (receiver.error + 2 * kUnit * reach);
  const Stretch whole{{0, 0}, {1, 1}};
  for (std::uint32_t k = 0; k < receiver.size(); ++k) {
    covers_.clear();
    bool hidden = false;
    for (const Outline& outline : outlines_) {
      Stretch stretch;
      if (!cover_border(k, outline, stretch)) continue;
      if (stretch.certainly_is() && stretch.low.inner <= 0 && stretch.high.inner >= 1) {
        hidden = true;
        break;
      }
      covers_.push_back(stretch);
    }
    const Lengths rest = hidden ? Lengths{} : rest_of({kNoLine, k}, whole);
    some_left_ = some_left_ || rest.perhaps > 0;
    const std::array<double, 2>&p = receiver.corners[k], &q = receiver.corners[receiver.next(k)];
    // What is covered of the border is the union's border.
    add_integral(p[0] * q[1] - p[1] * q[0], height_error,
                 {std::max(0.0, 1 - rest.perhaps), 1 - rest.certain});
    const double middle = 1 - (rest.certain + rest.perhaps) / 2;
    walk.add(q[0] - p[0], q[1] - p[1], middle, std::fabs(rest.perhaps - rest.certain) / 2);
    walk.error += 4 * receiver.error;
  }
}

/// Whether another outline certainly holds all of an edge; else notes what it holds of it.
bool OutlineUnion::hides(const Edge& edge, std::uint32_t other) {
  if (other == edge.outline || !edge.box.meets(outlines_[other].box)) return false;
  Stretch stretch;
  if (!cover(edge, other, stretch)) return false;
  if (stretch.certainly_is() && stretch.low.inner <= edge.stretch.low.outer &&
      stretch.high.inner >= edge.stretch.high.outer) {
    last_hider_ = other;
    return true;
  }
  covers_.push_back(stretch);
  return false;
}

/// Adds what other outlines leave of an edge.
void OutlineUnion::add_edge(const Edge& edge, std::span<const std::uint32_t> others) {
  if (hides(edge, last_hider_)) return;
  covers_.clear();
  for (const std::uint32_t other : others) {
    if (hides(edge, other)) return;
  }
  const Lengths rest = rest_of({edge.line, 0}, edge.stretch);
  if (!(rest.perhaps > 0)) return;
  some_left_ = true;
  const OutlineLine& line = lines_[edge.line];
  add_integral(line.c, line.error + slack_, rest);
  // The line's direction is off by its error over the receiver's size, at most.
  const double turned = 4 * (line.error + slack_) / receiver_->reach;
  walk.add(line.b, -line.a, (rest.certain + rest.perhaps) / 2,
           (rest.perhaps - rest.certain) / 2 + turned * rest.perhaps);
}

UnionShare OutlineUnion::integrate() {
  const ReceiverChart& receiver = *receiver_;
  sum_ = error_ = 0;
  some_left_ = false;
  walk = {};
  last_hider_ = 0;
  add_cells();
  add_borders();
  double area = 0;
  for (std::uint32_t k = 0; k < receiver.size(); ++k) {
    const std::array<double, 2>&p = receiver.corners[k], &q = receiver.corners[receiver.next(k)];
    area += p[0] * q[1] - p[1] * q[0];
  }
  const double reach = receiver.reach, n = receiver.size();
  const double area_error =
      n * (4 * reach * (receiver.error + 2 * kUnit * reach) + n * kUnit * reach * reach);
  UnionShare result;
  result.hidden = !some_left_;
  result.covered = sum_ / area;
  const double least = area - area_error;
  result.error = least > 0 ? (error_ + std::fabs(result.covered) * area_error) / least +
                                 8 * kUnit * std::fabs(result.covered)
                           : kInfinity;
  if (!(result.error < kInfinity) || !walk.is_closed()) {
    result.error = kInfinity;
    result.hidden = false;
  }
  return result;
}

UnionShare OutlineUnion::share() {
  is_sharp_ = false;
  UnionShare result = integrate();
  if (result.hidden || result.error < kSharpenAbove) return result;
  is_sharp_ = true;
  return integrate();
}

}  // namespace gnomon::area_contour
