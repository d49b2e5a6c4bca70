// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/form_factors/factor_cells.h"

#include <algorithm>
#include <queue>
#include <utility>

#include "algorithms/form_factors/line_integral.h"

namespace gnomon {

namespace {

/// What roundings add to a factor beyond the bounds that are computed.
constexpr double kRounding = 1e-12;

struct Cell {
  CellTriangle corners{};
  std::vector<std::uint32_t> blocks;  // that may hide something from it
  FactorSums sums;

  double gap() const { return sums.upper - sums.lower; }
  bool operator<(const Cell& other) const { return gap() < other.gap(); }
};

std::array<CellTriangle, 2> halves(const CellTriangle& cell) {
  std::size_t longest = 0;
  double most = -1;
  for (std::size_t k = 0; k < 3; ++k) {
    const double size = length(cell[(k + 1) % 3] - cell[k]);
    if (size > most) {
      most = size;
      longest = k;
    }
  }
  const Vector &a = cell[longest], &b = cell[(longest + 1) % 3], &c = cell[(longest + 2) % 3];
  const Vector middle = 0.5 * (a + b);
  return {CellTriangle{a, middle, c}, CellTriangle{middle, b, c}};
}

class FactorCells {
 public:
  explicit FactorCells(const FactorTask& task)
      : task_(task), at_infinity_(!task.target.empty() && task.target[0][0].w == 0) {}

  Cell make(const CellTriangle& corners, const std::vector<std::uint32_t>& blocks) const {
    Cell cell;
    cell.corners = corners;
    std::vector<TargetPiece> seen_by_all = task_.target, seen_by_some = task_.target;
    for (const std::uint32_t block : blocks) {
      const HiddenSets hidden = hidden_sets(task_.blocks[block], corners);
      if (!hidden.from_any || !may_reach(task_.target, *hidden.from_any)) continue;
      cell.blocks.push_back(block);
      take_away(seen_by_all, *hidden.from_any, Leaves::kLess);
      if (hidden.from_all) take_away(seen_by_some, *hidden.from_all, Leaves::kMore);
    }
    const double area = area_of(corners);
    const Bounded all = exchange(corners, area, task_.target);
    const double slack = kRounding * area;
    cell.sums.unobstructed = all.value;
    if (cell.blocks.empty()) {
      cell.sums.value = all.value;
      cell.sums.lower = all.value - all.error - slack;
      cell.sums.upper = all.value + all.error + slack;
    } else {
      const Bounded least = exchange(corners, area, seen_by_all);
      const Bounded most = exchange(corners, area, seen_by_some);
      cell.sums.lower = least.value - least.error - slack;
      cell.sums.upper = std::min(most.value + most.error, all.value + all.error) + slack;
      if (seen_by_some.empty()) cell.sums.upper = 0;
      cell.sums.value = area * at_centre(cell);
    }
    cell.sums.lower = std::max(cell.sums.lower, 0.0);
    cell.sums.value = std::clamp(cell.sums.value, cell.sums.lower, cell.sums.upper);
    cell.sums.cells = 1;
    return cell;
  }

 private:
  /// Area times form factor from a triangle to pieces.
  Bounded exchange(const CellTriangle& corners, double area,
                   const std::vector<TargetPiece>& pieces) const {
    Bounded sum;
    for (const TargetPiece& piece : pieces) {
      if (at_infinity_) {
        // Seen alike from everywhere.
        sum.value += area * point_factor(piece, corners[0], task_.normal);
        continue;
      }
      std::vector<Vector> loop;
      for (const TargetPoint& point : piece) loop.push_back(point.x);
      const Bounded own = exchange_area(corners, loop);
      sum.value += own.value;
      sum.error += own.error;
    }
    return sum;
  }

  /// The factor of the cell's centre.
  double at_centre(const Cell& cell) const {
    const Vector centre = 1.0 / 3 * (cell.corners[0] + cell.corners[1] + cell.corners[2]);
    std::vector<TargetPiece> seen = task_.target;
    for (const std::uint32_t block : cell.blocks) {
      if (const auto cone = hidden_from(task_.blocks[block], centre)) {
        take_away(seen, *cone, Leaves::kNearest);
      }
    }
    double sum = 0;
    for (const TargetPiece& piece : seen) sum += point_factor(piece, centre, task_.normal);
    return sum;
  }

  const FactorTask& task_;
  bool at_infinity_;
};

}  // namespace

double area_of(std::span<const Vector> loop) {
  Vector sum{};
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    sum = sum + cross(loop[i] - loop[0], loop[i + 1] - loop[0]);
  }
  return length(sum) / 2;
}

FactorSums factor_sums(const FactorTask& task, double gap, std::uint64_t most_cells,
                       const std::atomic<bool>* interrupted) {
  FactorSums sums;
  if (task.target.empty()) return sums;
  const FactorCells cells(task);
  std::vector<std::uint32_t> blocks(task.blocks.size());
  for (std::uint32_t i = 0; i < blocks.size(); ++i) blocks[i] = i;
  std::priority_queue<Cell> open;
  double width = 0;
  const auto add = [&](Cell cell) {
    width += cell.gap();
    open.push(std::move(cell));
  };
  for (std::size_t i = 1; i + 1 < task.loop.size(); ++i) {
    add(cells.make({task.loop[0], task.loop[i], task.loop[i + 1]}, blocks));
  }
  while (width > gap && open.size() < most_cells && !open.top().blocks.empty() &&
         !(interrupted != nullptr && interrupted->load(std::memory_order_relaxed))) {
    const Cell cell = open.top();
    open.pop();
    width -= cell.gap();
    for (const CellTriangle& half : halves(cell.corners)) add(cells.make(half, cell.blocks));
  }
  sums.cells = open.size();
  for (; !open.empty(); open.pop()) {
    const FactorSums& own = open.top().sums;
    sums.value += own.value;
    sums.lower += own.lower;
    sums.upper += own.upper;
    sums.unobstructed += own.unobstructed;
  }
  return sums;
}

}  // namespace gnomon
