// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/illumination/edge_lines.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "algorithms/partition/exact_line.h"

namespace gnomon {

EdgeLines::EdgeLines(const Geometry& geometry)
    : ends_(geometry.edges), edges_(geometry.edges.size()) {
  const GridPositions& grid = geometry.grid;
  const mpz_class one = 1;
  const auto point = [&](VertexId vertex) {
    return std::array<mpz_class, 3>{grid.at(vertex, 0), grid.at(vertex, 1), grid.at(vertex, 2)};
  };
  std::vector<ExactLine> lines(ends_.size());
  tbb::parallel_for(std::size_t{0}, ends_.size(), [&](std::size_t edge) {
    lines[edge] = line_through(point(ends_[edge].a), one, point(ends_[edge].b), one);
  });
  const std::vector<std::vector<std::uint32_t>> on_line = group_equal_lines(lines);
  tbb::parallel_for(std::size_t{0}, on_line.size(), [&](std::size_t line) {
    // Along the first axis on which the line's points differ.
    const ExactLine& own = lines[on_line[line].front()];
    int axis = 0;
    while (own.numbers[static_cast<std::size_t>(axis)] == 0) ++axis;
    const auto before = [&](VertexId a, VertexId b) {
      return grid.is_narrow() ? grid.narrow(a, axis) < grid.narrow(b, axis)
                              : grid.wide(a, axis) < grid.wide(b, axis);
    };
    std::vector<VertexId> ranked;
    for (const EdgeId edge : on_line[line]) {
      ranked.push_back(ends_[edge].a);
      ranked.push_back(ends_[edge].b);
    }
    std::ranges::sort(ranked, before);
    ranked.erase(std::ranges::unique(ranked).begin(), ranked.end());
    const auto rank_of = [&](VertexId vertex) {
      return static_cast<std::uint32_t>(std::ranges::lower_bound(ranked, vertex, before) -
                                        ranked.begin());
    };
    for (const EdgeId edge : on_line[line]) {
      const std::uint32_t a = rank_of(ends_[edge].a), b = rank_of(ends_[edge].b);
      edges_[edge] = {static_cast<std::uint32_t>(line), std::min(a, b), std::max(a, b), a > b};
    }
  });
}

}  // namespace gnomon
