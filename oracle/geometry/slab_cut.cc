// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/geometry/slab_cut.h"

#include <utility>

namespace gnomon::oracle {

namespace {

Fraction middle_of(const Fraction& a, const Fraction& b) {
  return {a.numerator * b.denominator + b.numerator * a.denominator,
          2 * a.denominator * b.denominator};
}

/// y of a line that is not vertical, at x: exactly.
Fraction height_at(const ChartLine& line, const Fraction& x) {
  Fraction y{line.a * x.numerator + line.c * x.denominator, line.b * x.denominator};
  if (y.denominator < 0) {
    y.denominator = -y.denominator;
  } else {
    y.numerator = -y.numerator;
  }
  return y;
}

}  // namespace

/// Orders the vertices, and tells each edge where it begins and ends.
void SlabCut::find_stops() {
  std::vector<std::uint32_t> vertices;
  for (const SlabEdge& edge : edges_) vertices.insert(vertices.end(), {edge.left, edge.right});
  std::ranges::sort(vertices);
  const auto repeated = std::ranges::unique(vertices);
  vertices.erase(repeated.begin(), repeated.end());
  std::vector<std::uint32_t> order = vertices;
  const auto compared = [&](std::uint32_t a, std::uint32_t b) {
    return overlay_->order_along(direction_.q, -direction_.p, a, b);
  };
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) { return compared(a, b) < 0; });
  std::vector<Stop> stop_of(vertices.size());
  for (const std::uint32_t vertex : order) {
    if (stops_.empty() || compared(stops_.back(), vertex) != 0) stops_.push_back(vertex);
    const auto place = std::ranges::lower_bound(vertices, vertex) - vertices.begin();
    stop_of[static_cast<std::size_t>(place)] = stops_.size() - 1;
  }
  const auto stop_at = [&](std::uint32_t vertex) {
    const auto place = std::ranges::lower_bound(vertices, vertex) - vertices.begin();
    return stop_of[static_cast<std::size_t>(place)];
  };
  for (SlabEdge& edge : edges_) {
    edge.first = stop_at(edge.left);
    edge.last = stop_at(edge.right);
    if (edge.first <= edge.last) continue;
    std::swap(edge.left, edge.right);
    std::swap(edge.first, edge.last);
  }
}

/// Whether an edge is above another one that begins where it does or before, and ends later.
bool SlabCut::is_above(const SlabEdge& edge, const SlabEdge& other) const {
  const int side = overlay_->turn(other.left, other.right, edge.left);
  return (side != 0 ? side : overlay_->turn(other.left, other.right, edge.right)) > 0;
}

const ChartLine& SlabCut::line_of(std::size_t edge) {
  SlabEdge& own = edges_[edge];
  if (!own.line) {
    own.line = line_through(direction_.turn(overlay_->point(own.left)),
                            direction_.turn(overlay_->point(own.right)));
  }
  return *own.line;
}

ChartPoint SlabCut::corner(std::size_t edge, Stop stop) {
  const Fraction x = x_of(stop);
  return direction_.turn_back(x, height_at(line_of(edge), x));
}

ChartPoint SlabCut::middle(std::size_t below, std::size_t above, Stop stop) {
  const Fraction x = middle_of(x_of(stop), x_of(stop + 1));
  return direction_.turn_back(
      x, middle_of(height_at(line_of(below), x), height_at(line_of(above), x)));
}

}  // namespace gnomon::oracle
