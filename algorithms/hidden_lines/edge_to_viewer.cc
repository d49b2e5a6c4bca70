// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/hidden_lines/edge_to_viewer.h"

#include <algorithm>

namespace gnomon {

namespace {

/// The value at t of a linear function with these values at 0 and 1.
mpq_class between(const mpz_class& at_start, const mpz_class& at_end, const mpq_class& t) {
  return at_start + t * mpq_class(at_end - at_start);
}

bool hides(const SeenSurface& surface, const SeenPart& seen, EdgeEnds edge, const mpq_class& t) {
  if (between(surface.exact_side(seen, edge.a), surface.exact_side(seen, edge.b), t) >= 0) {
    return false;
  }
  for (std::uint32_t k = 0; k < surface.edge_count(seen); ++k) {
    const DirectedEdge own = surface.edge(seen, k);
    if (between(surface.signs().exact_bracket(own.from, own.to, edge.a),
                surface.signs().exact_bracket(own.from, own.to, edge.b), t) > 0) {
      return false;
    }
  }
  return true;
}

/// Adds where the function is zero, if that is inside of the edge.
void add_zero(const mpz_class& at_start, const mpz_class& at_end, std::vector<mpq_class>& places) {
  if (sgn(at_start) * sgn(at_end) >= 0) return;
  mpq_class t(at_start, at_start - at_end);
  t.canonicalize();
  places.push_back(std::move(t));
}

}  // namespace

std::vector<LinePart> parts_to_viewer(const SeenSurface& surface, EdgeEnds edge,
                                      const PreparedLight& light) {
  std::vector<mpq_class> places{1};
  for (const SeenPart& seen : surface.parts()) {
    add_zero(surface.exact_side(seen, edge.a), surface.exact_side(seen, edge.b), places);
  }
  if (!light.point.directional) {
    const GridPositions& grid = surface.scene().geometry.grid;
    for (int axis = 0; axis < 3; ++axis) {
      const mpz_class& at = light.point.grid[static_cast<std::size_t>(axis)];
      add_zero(grid.at(edge.a, axis) - at, grid.at(edge.b, axis) - at, places);
    }
  }
  std::ranges::sort(places);
  std::vector<LinePart> parts;
  mpq_class from = 0;
  for (const mpq_class& to : places) {
    if (to == from) continue;
    const mpq_class middle = (from + to) / 2;
    const auto count = static_cast<std::uint32_t>(std::ranges::count_if(
        surface.parts(), [&](const SeenPart& seen) { return hides(surface, seen, edge, middle); }));
    if (!parts.empty() && parts.back().hidden_by == count) {
      parts.back().end = to;
    } else {
      parts.push_back({to, count});
    }
    from = to;
  }
  return parts;
}

}  // namespace gnomon
