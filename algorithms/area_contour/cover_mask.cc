// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/area_contour/cover_mask.h"

#include <algorithm>
#include <cmath>

#include "algorithms/area_contour/outline_union.h"

namespace gnomon::area_contour {
namespace {

constexpr std::uint32_t kAll = 0xffffffffu;

/// Cells [first, last] of a row.
std::uint32_t cells(int first, int last) {
  return first > last ? 0 : (kAll << first) & (kAll >> (31 - last));
}

}  // namespace

// A cell's place is computed from the receiver's, off by a few units in the last place of `reach`
// (box_.low + k size_, each term at most 2 reach, rounded three times: below 2^-50 reach). So is
// the place at which a line begins (inside()), of terms that are at most 3 reach. slack_, 2^-47
// reach, is eight times as much as both, and is taken off every line twice; so where a cell is told
// to be inside, all of it is, with 2^-47 reach to spare around it. A box that is wider than what it
// is of by margin_, 2^-48 reach, therefore has all true points in cells that are looked at, or so
// near to them that they are inside of the same outlines.
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
    for (int row = 0; row < kCells; ++row) {
      rows_[static_cast<std::size_t>(row)] |= inside(row, {&line, 1});
    }
  }
}

/// The cells of a row that are inside of all lines at both of the row's ends, and so all along.
std::uint32_t CoverMask::inside(int row, std::span<const Line> lines) const {
  const double y0 = box_.low[1] + row * size_[1], y1 = box_.low[1] + (row + 1) * size_[1];
  double from = 0, to = kCells;  // in cells
  for (const Line& line : lines) {
    const double rest = line.c + std::min(line.b * y0, line.b * y1) + line.a * box_.low[0];
    const double slope = line.a * size_[0];
    if (line.a > 0) {
      from = std::max(from, -rest / slope);
    } else if (line.a < 0) {
      to = std::min(to, -rest / slope);
    } else if (!(rest > 0)) {
      return 0;
    }
  }
  if (!(from < to)) return 0;
  return cells(static_cast<int>(std::ceil(from)), static_cast<int>(std::floor(to)) - 1);
}

void CoverMask::add(std::span<const OutlineLine> lines, const ChartBox& box) {
  std::array<Line, 32> own;
  const bool is_small = box.high[0] - box.low[0] < size_[0] || box.high[1] - box.low[1] < size_[1];
  if (is_small || lines.size() > own.size()) return;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    own[i] = {lines[i].a, lines[i].b, lines[i].c - lines[i].error - 2 * slack_};
  }
  const int last = cell_of(box.high[1], 1);
  for (int row = cell_of(box.low[1], 1); row <= last; ++row) {
    rows_[static_cast<std::size_t>(row)] |= inside(row, {own.data(), lines.size()});
  }
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
