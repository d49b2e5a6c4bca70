// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/area_contour/outline_union.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "algorithms/area_contour/outline_trim.h"
#include "kernel/signs/ball.h"

namespace gnomon::area_contour {
namespace {

/// Choices, not bounds: of a share, and of that for an edge among many.
constexpr double kOpen = 0x1p-31, kLeastOpen = 0x1p-43;

}  // namespace

void OutlineUnion::Walk::add(double dx, double dy, double middle, double radius) {
  x += dx * middle;
  y += dy * middle;
  const double length = std::fabs(dx) + std::fabs(dy);
  error += length * radius + 4 * Ball::kUnit * (length * middle + std::fabs(x) + std::fabs(y));
}

bool OutlineUnion::Walk::is_closed() const {
  return std::fabs(x) <= error && std::fabs(y) <= error;
}

void OutlineUnion::begin(const ReceiverChart& receiver, ExactLines& exact) {
  receiver_ = &receiver;
  exact_ = &exact;
  slack_ = kSlack * receiver.reach;
  most_error_ = 0;
  blocks_.clear();
  sides_.assign(1, {});  // of what fills up blocks
  outlines_.clear();
  bordering_.clear();
}

OutlineLine OutlineUnion::line_of(std::uint32_t line) const {
  const LineBlock& block = blocks_[line / 4];
  const std::uint32_t k = line % 4;
  const auto [before, behind] = sides_of(block.sides[k]);
  return {block.a[k], block.b[k], block.c[k], block.error[k], block.plane[k], before, behind};
}

OutlineUnion::Edge OutlineUnion::edge_on(std::uint32_t line, std::uint32_t outline, double from,
                                         double to) const {
  const LineBlock& block = blocks_[line / 4];
  const std::uint32_t k = line % 4;
  return {line, outline, block.a[k], block.b[k], block.c[k], block.error[k], from, to};
}

/// Coordinates of what meets the receiver are below 4 reach, so that single precision rounds them
/// by at most 2^-22 of it.
OutlineUnion::Box OutlineUnion::box_of(double low_x, double low_y, double high_x,
                                       double high_y) const {
  const double margin = 0x1p-20 * receiver_->reach;
  return {{static_cast<float>(low_x - margin), static_cast<float>(low_y - margin)},
          {static_cast<float>(high_x + margin), static_cast<float>(high_y + margin)}};
}

/// Errors of lines are far below the margin.
OutlineUnion::Box OutlineUnion::box_of(const Edge& edge) const {
  const double x0 = -edge.c * edge.a, y0 = -edge.c * edge.b;
  const double x[] = {x0 + edge.from * edge.b, x0 + edge.to * edge.b},
               y[] = {y0 - edge.from * edge.a, y0 - edge.to * edge.a};
  return box_of(std::min(x[0], x[1]), std::min(y[0], y[1]), std::max(x[0], x[1]),
                std::max(y[0], y[1]));
}

/// The stretch of the receiver's edge behind a corner that an outline holds, in shares of the edge.
bool OutlineUnion::cover_border(std::uint32_t corner, const Outline& outline,
                                Stretch& stretch) const {
  const ReceiverChart& receiver = *receiver_;
  const std::uint32_t next = receiver.next(corner);
  Trim trim;
  for (std::uint32_t i = 4 * outline.first; i < 4 * outline.end; ++i) {
    const LineBlock& block = blocks_[i / 4];
    const auto [before, behind] = sides_of(block.sides[i % 4]);
    const bool from_behind = has(behind, corner), to_behind = has(behind, next);
    if (!from_behind && !to_behind) continue;
    if (!has(before, from_behind ? next : corner)) return false;
    const auto [share, radius] = share_of_border(i, corner);
    if (from_behind) {
      trim.begin_at(share, radius, i);
    } else {
      trim.end_at(share, radius, i);
    }
  }
  trim.put(stretch);
  return stretch.may_be();
}

/// Where a line that crosses an edge of the receiver, or nearly does, meets it. By integers if
/// doubles say little.
OutlineUnion::BorderShare OutlineUnion::share_of_border(std::uint32_t number,
                                                        std::uint32_t corner) const {
  const ReceiverChart& receiver = *receiver_;
  const std::uint32_t next = receiver.next(corner);
  const LineBlock& block = blocks_[number / 4];
  const double a = block.a[number % 4], b = block.b[number % 4], c = block.c[number % 4];
  const auto distance = [&](std::uint32_t k) {
    return std::fabs(a * receiver.corners[k][0] + b * receiver.corners[k][1] + c);
  };
  const double here = distance(corner), both = here + distance(next);
  const double radius = 4 * (block.error[number % 4] + 2 * receiver.error + slack_) / both;
  if (radius < kKnownShare) return {here / both, radius + 8 * Ball::kUnit};
  const OutlineLine line = line_of(number);
  // Two sums and a quotient of numbers that are off by 4u: below 16u, unless they underflow.
  const double exact = exact_->distance_of(line, corner);
  const double sum = exact + exact_->distance_of(line, next);
  if (!(sum > 0x1p-900)) return {0.5, 0.5};
  return {exact / sum, 16 * Ball::kUnit};
}

/// Along the longest edge of the receiver, from the middle of its heights.
void OutlineUnion::set_frame() {
  const ReceiverChart& receiver = *receiver_;
  double longest = 0;
  for (std::uint32_t k = 0; k < receiver.size(); ++k) {
    const std::array<double, 2>&p = receiver.corners[k], &q = receiver.corners[receiver.next(k)];
    const double dx = q[0] - p[0], dy = q[1] - p[1], length = std::sqrt(dx * dx + dy * dy);
    if (!(length > longest)) continue;
    longest = length;
    frame_.x = dx / length;
    frame_.y = dy / length;
  }
  frame_.middle = 0;
  double low = kInfinity, high = -kInfinity;
  for (const std::array<double, 2>& corner : receiver.corners) {
    low = std::min(low, frame_.height(corner[0], corner[1]));
    high = std::max(high, frame_.height(corner[0], corner[1]));
  }
  frame_.middle = low + (high - low) / 2;
  frame_.most = (high - low) / 2 + 2 * receiver.error + slack_;
}

// The border's integral over true stretches lies between sums over those that certainly are seen
// and those that perhaps are, in this sense: what the second have besides the first is partly in
// it, and its heights are at most `most`. So it is off the middle of both by at most half of the
// difference in length times that. A line's points are off by at most its error, across; then so
// are heights, and the way along by its turn.
//
/// Adds stretches of a line, of which a length of 1 goes so far along the receiver, to the area.
void OutlineUnion::add_integral(double along, double along_error, double height_error,
                                const Lengths& lengths) {
  const double integral =
      lengths.certain_integral + (lengths.perhaps_integral - lengths.certain_integral) / 2;
  const double radius = std::max(0.0, lengths.perhaps - lengths.certain) / 2;
  const double far = std::fabs(along) + along_error;
  sum_ -= along * integral;
  error_ += far * (frame_.most + height_error) * radius +
            (far * height_error + frame_.most * along_error) * lengths.perhaps +
            8 * Ball::kUnit * far * frame_.most * lengths.perhaps + Ball::kUnit * std::fabs(sum_);
}

void OutlineUnion::add_borders() {
  const ReceiverChart& receiver = *receiver_;
  const double reach = receiver.reach;
  const double error = 4 * (receiver.error + 2 * Ball::kUnit * reach);
  const Stretch whole{{0, 0}, {1, 1}};
  for (std::uint32_t k = 0; k < receiver.size(); ++k) {
    covers_.clear();
    bool hidden = false;
    for (const Bordering& bordering : bordering_) {
      Stretch stretch;
      if (!has(bordering.edges, k)) continue;
      if (!cover_border(k, outlines_[bordering.outline], stretch)) continue;
      if (stretch.certainly_is() && stretch.low.inner <= 0 && stretch.high.inner >= 1) {
        hidden = true;
        break;
      }
      covers_.push_back(stretch);
    }
    if (covers_.empty() && !hidden) {  // nothing holds any of it
      some_left_ = true;
      continue;
    }
    const std::array<double, 2>&p = receiver.corners[k], &q = receiver.corners[receiver.next(k)];
    const double height = frame_.height(p[0], p[1]);
    const Carrier carrier{kNoLine, k, height, frame_.height(q[0], q[1]) - height};
    const Lengths rest = hidden ? Lengths{} : rest_of(carrier, whole);
    some_left_ = some_left_ || rest.perhaps > 0;
    // What is covered of the border is the union's border.
    const double all = carrier.integral(0, 1);
    add_integral(frame_.along(q[0] - p[0], q[1] - p[1]), error, error,
                 {std::max(0.0, 1 - rest.perhaps), 1 - rest.certain, all - rest.perhaps_integral,
                  all - rest.certain_integral});
    const double middle = 1 - (rest.certain + rest.perhaps) / 2;
    walk_.add(q[0] - p[0], q[1] - p[1], middle, std::fabs(rest.perhaps - rest.certain) / 2);
    walk_.error += 4 * receiver.error;
  }
}

/// Adds what covers leave of an edge, of which a part may be at hand.
void OutlineUnion::add_rest(const Edge& edge) {
  if (is_hidden(edge)) return;
  Stretch stretch = own_stretch(edge);
  if (edge.from > stretch.low.outer) {  // there cells meet
    if (stretch.low.inner <= edge.from) stretch.low = {edge.from, edge.from};
    stretch.low.outer = edge.from;
  }
  if (edge.to < stretch.high.outer) {
    if (stretch.high.inner >= edge.to) stretch.high = {edge.to, edge.to};
    stretch.high.outer = edge.to;
  }
  const Carrier carrier{edge.line, 0, frame_.height(-edge.c * edge.a, -edge.c * edge.b),
                        frame_.x * -edge.a - frame_.y * edge.b};
  const Lengths rest = rest_of(carrier, stretch);
  if (!(rest.perhaps > 0)) return;
  some_left_ = true;
  // The line's direction is off by its error over the receiver's size, at most.
  const double turned = 4 * (edge.error + slack_) / receiver_->reach;
  add_integral(frame_.along(edge.b, -edge.a), turned, edge.error + slack_, rest);
  walk_.add(edge.b, -edge.a, (rest.certain + rest.perhaps) / 2,
            (rest.perhaps - rest.certain) / 2 + turned * rest.perhaps);
}

UnionShare OutlineUnion::share() {
  const ReceiverChart& receiver = *receiver_;
  sum_ = error_ = 0;
  some_left_ = false;
  walk_ = {};
  last_hider_ = 0;
  set_frame();
  double area = 0;
  for (std::uint32_t k = 0; k < receiver.size(); ++k) {
    const std::array<double, 2>&p = receiver.corners[k], &q = receiver.corners[receiver.next(k)];
    area += (p[0] * q[1] - p[1] * q[0]) / 2;
  }
  const double reach = receiver.reach, n = receiver.size();
  const double area_error = n * (2 * reach * (receiver.error + 2 * Ball::kUnit * reach) +
                                 n * Ball::kUnit * reach * reach);
  sharpen_above_ = std::max(kLeastOpen, kOpen / static_cast<double>(outlines_.size())) * area;
  add_cells();
  add_borders();
  UnionShare result;
  result.hidden = !some_left_;
  result.covered = sum_ / area;
  const double least = area - area_error;
  result.error = least > 0 ? (error_ + std::fabs(result.covered) * area_error) / least +
                                 8 * Ball::kUnit * std::fabs(result.covered)
                           : kInfinity;
  if (!(result.error < kInfinity) || !walk_.is_closed()) {
    result.error = kInfinity;
    result.hidden = false;
  }
  return result;
}

}  // namespace gnomon::area_contour
