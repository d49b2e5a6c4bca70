// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/area_contour/cover_mask.h"

#include <algorithm>
#include <cmath>

#include "algorithms/area_contour/four_doubles.h"
#include "algorithms/area_contour/outline_union.h"

namespace gnomon::area_contour {
namespace {

constexpr std::uint32_t kAll = 0xffffffffu;

/// Lines that are nearer to a row's direction are taken to lie along it.
constexpr double kLeastAcross = 0x1p-60;

/// Cells [first, last] of a row.
std::uint32_t cells(int first, int last) {
  return first > last ? 0 : (kAll << first) & (kAll >> (31 - last));
}

}  // namespace

// A cell's place is computed from the receiver's, off by a few units in the last place of `reach`
// (box_.low + k size_, each term at most 2 reach, rounded three times: below 2^-50 reach). So is
// the place at which a line begins (mark()), times its slope: of four terms that are at most 3
// reach, with three roundings each and three of the sums, below 2^-48 reach; and a line that is
// taken to lie along rows differs by less than 2^-58 reach. slack_, 2^-47 reach, is more than all,
// and is taken off every line twice; so where a cell is told to be inside, all of it is, with
// 2^-47 reach to spare around it. A box that is wider than what it is of by margin_, 2^-48 reach,
// therefore has all true points in cells that are looked at, or so near to them that they are
// inside of the same outlines.
void CoverMask::begin(const ReceiverChart& receiver) {
  box_ = {};
  for (const auto& corner : receiver.corners) {
    for (int k = 0; k < 2; ++k) {
      box_.low[k] = std::min(box_.low[k], corner[static_cast<std::size_t>(k)] - receiver.error);
      box_.high[k] = std::max(box_.high[k], corner[static_cast<std::size_t>(k)] + receiver.error);
    }
  }
  slack_ = kSlack * receiver.reach;
  margin_ = slack_ / 2;
  for (int k = 0; k < 2; ++k) {
    box_.low[k] -= margin_;
    box_.high[k] += margin_;
    size_[k] = (box_.high[k] - box_.low[k]) / kCells;
    inverse_[k] = 1 / size_[k];
  }
  rows_.fill(0);
  for (std::uint32_t i = 0; i < receiver.size(); ++i) {
    const auto &p = receiver.corners[i], &q = receiver.corners[receiver.next(i)];
    const double dx = q[0] - p[0], dy = q[1] - p[1];
    // An edge along an axis has nothing of the rectangle outside.
    if (std::fabs(dx) <= 4 * receiver.error || std::fabs(dy) <= 4 * receiver.error) continue;
    // Corners are counter-clockwise: outside is on the right.
    const double length = std::sqrt(dx * dx + dy * dy), a = dy / length, b = -dx / length;
    const double error = 8 * receiver.error * receiver.reach / length + 2 * slack_;
    const Line line{a, b, -a * p[0] - b * p[1] - error};
    mark({&line, 1}, 0, kCells - 1);
  }
}

/// Marks the cells of rows [first, last] that are inside of all lines at both of their row's ends,
/// and so all along. Where in a row a line begins, or ends, what is inside is linear in the row.
GNOMON_FOR_AVX2 void CoverMask::mark(std::span<const Line> lines, int first, int last) {
  struct Place {
    double at_zero, by_row;
    enum : std::uint8_t { kBegins, kEnds, kAlong } kind;
  };
  std::array<Place, kMostLines> places;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Line& line = lines[i];
    const double rest = line.c + line.a * box_.low[0];
    if (std::fabs(line.a) < kLeastAcross) {
      const double by_row = line.b * size_[1];
      places[i] = {rest + line.b * box_.low[1] + std::min(0.0, by_row), by_row, Place::kAlong};
      continue;
    }
    const double slope = -1 / (line.a * size_[0]);
    const bool begins = line.a > 0;
    const double by_row = line.b * slope * size_[1];
    const double at_zero = rest * slope + line.b * slope * box_.low[1];
    places[i] = {at_zero + (begins ? std::max(0.0, by_row) : std::min(0.0, by_row)), by_row,
                 begins ? Place::kBegins : Place::kEnds};
  }
  for (int row = first; row <= last; row += 4) {
    const double at = row;
    const Doubles rows = {at, at + 1, at + 2, at + 3};
    Doubles from = {0, 0, 0, 0}, to = {kCells, kCells, kCells, kCells};
    for (const Place& own : std::span(places).first(lines.size())) {
      const Doubles place = own.at_zero + own.by_row * rows;
      if (own.kind == Place::kBegins) {
        from = place > from ? place : from;
      } else if (own.kind == Place::kEnds) {
        to = place < to ? place : to;
      } else {
        to = place > 0 ? to : from - 1;
      }
    }
    for (int k = 0; k < 4 && row + k <= last; ++k) {
      if (!(to[k] - from[k] >= 1)) continue;
      const int begin = static_cast<int>(from[k]);
      rows_[static_cast<std::size_t>(row + k)] |=
          cells(begin < from[k] ? begin + 1 : begin, static_cast<int>(to[k]) - 1);
    }
  }
}

void CoverMask::add(std::span<const OutlineLine> lines, const ChartBox& box) {
  std::array<Line, kMostLines> own;
  const bool is_small = box.high[0] - box.low[0] < size_[0] || box.high[1] - box.low[1] < size_[1];
  if (is_small || lines.size() > own.size()) return;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    own[i] = {lines[i].a, lines[i].b, lines[i].c - lines[i].error - 2 * slack_};
  }
  mark({own.data(), lines.size()}, cell_of(box.low[1], 1), cell_of(box.high[1], 1));
}

int CoverMask::cell_of(double x, int axis) const {
  const double place = (x - box_.low[axis]) * inverse_[axis];
  return static_cast<int>(std::clamp(place, 0.0, kCells - 1.0));
}

bool CoverMask::holds(const ChartBox& box) const {
  const std::uint32_t asked = cells(cell_of(box.low[0], 0), cell_of(box.high[0], 0));
  const int last = cell_of(box.high[1], 1);
  for (int row = cell_of(box.low[1], 1); row <= last; ++row) {
    if ((asked & ~rows_[static_cast<std::size_t>(row)]) != 0) return false;
  }
  return true;
}

bool CoverMask::is_full() const {
  return std::ranges::all_of(rows_, [](std::uint32_t row) { return row == kAll; });
}

}  // namespace gnomon::area_contour
