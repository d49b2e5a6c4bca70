// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/geometry/planar_loop.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gnomon::oracle {

namespace {

/// Twice the area of a triangle; positive if counter-clockwise. From the edges that meet in `b`:
/// what rounding leaves open is then less than the last place of one edge away from the line of the
/// other, however short that is, so that this line points where the loop does and not anywhere.
long double turn(const PlanarPoint& a, const PlanarPoint& b, const PlanarPoint& c) {
  return (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x);
}

bool all_outside(const PlanarLoop& loop, const PlanarLine& line) {
  return std::ranges::all_of(loop, [&](const PlanarPoint& p) { return line.at(p) <= 0; });
}

}  // namespace

PlanarBox box_of(const PlanarLoop& loop, long double margin) {
  PlanarBox box{loop[0], loop[0]};
  for (const PlanarPoint& point : loop) {
    box.low = {std::min(box.low.x, point.x), std::min(box.low.y, point.y)};
    box.high = {std::max(box.high.x, point.x), std::max(box.high.y, point.y)};
  }
  return {{box.low.x - margin, box.low.y - margin}, {box.high.x + margin, box.high.y + margin}};
}

PlanarBox box_of(const PlanarPoint& a, const PlanarPoint& b) {
  return {{std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}};
}

bool is_finite(const PlanarLoop& loop) {
  return std::ranges::all_of(
      loop, [](const PlanarPoint& p) { return std::isfinite(p.x) && std::isfinite(p.y); });
}

PlanarLine line_through(const PlanarPoint& a, const PlanarPoint& b) {
  // Squares of what a scene can hold neither overflow nor underflow in this precision.
  const long double dx = b.x - a.x, dy = b.y - a.y;
  const long double length = std::sqrt(dx * dx + dy * dy);
  if (!(length > 0)) return {};
  PlanarLine line{(a.y - b.y) / length, (b.x - a.x) / length, 0};
  line.c = -(line.a * a.x + line.b * a.y);
  return line;
}

std::vector<PlanarLine> lines_of(const PlanarLoop& loop) {
  std::vector<PlanarLine> lines;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const PlanarLine line = line_through(loop[i], loop[(i + 1) % loop.size()]);
    if (line.a != 0 || line.b != 0) lines.push_back(line);
  }
  return lines;
}

PlanarLoop hull_of(PlanarLoop points) {
  const auto before = [](const PlanarPoint& a, const PlanarPoint& b) {
    return a.x < b.x || (a.x == b.x && a.y < b.y);
  };
  std::ranges::sort(points, before);
  PlanarLoop hull;
  // The lower side from left to right, then the upper side back.
  for (int side = 0; side < 2; ++side) {
    const std::size_t first = hull.size();
    for (const PlanarPoint& point : points) {
      while (hull.size() >= first + 2 && !(turn(hull.end()[-2], hull.back(), point) > 0)) {
        hull.pop_back();
      }
      hull.push_back(point);
    }
    if (!hull.empty()) hull.pop_back();
    std::ranges::reverse(points);
  }
  return hull;
}

long double area_of(const PlanarLoop& loop) {
  long double sum = 0;
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) sum += turn(loop[0], loop[i], loop[i + 1]);
  return sum / 2;
}

long double perimeter_of(const PlanarLoop& loop) {
  long double sum = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const PlanarPoint &a = loop[i], &b = loop[(i + 1) % loop.size()];
    const long double dx = b.x - a.x, dy = b.y - a.y;
    sum += std::sqrt(dx * dx + dy * dy);
  }
  return sum;
}

bool is_wider(const PlanarLoop& loop, long double width) {
  // Corners that cuts have made may be in the order that rounding gave them.
  PlanarLoop middles = hull_of(loop);
  if (middles.size() < 3) return false;
  for (const PlanarLine& line : lines_of(middles)) {
    middles = cut(middles, line.grown(-width / 2));
    if (middles.empty()) return false;
  }
  return true;
}

long double strip_width_of(const PlanarLoop& points) {
  long double least = std::numeric_limits<long double>::infinity();
  for (const PlanarLine& line : lines_of(hull_of(points))) {
    long double low = 0, high = 0;  // the line's own points
    for (const PlanarPoint& point : points) {
      low = std::min(low, line.at(point));
      high = std::max(high, line.at(point));
    }
    least = std::min(least, high - low);
  }
  return least;
}

PlanarLoop cut(const PlanarLoop& loop, const PlanarLine& line) {
  PlanarLoop result;
  bool inside = false, outside = false;
  for (const PlanarPoint& point : loop) {
    const long double value = line.at(point);
    inside = inside || value > 0;
    outside = outside || value < 0;
  }
  if (!inside) return result;
  if (!outside) return loop;
  result.reserve(loop.size() + 1);
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const PlanarPoint &a = loop[i], &b = loop[(i + 1) % loop.size()];
    const long double here = line.at(a), there = line.at(b);
    if (here >= 0) result.push_back(a);
    if ((here > 0 && there < 0) || (here < 0 && there > 0)) {
      const long double t = here / (here - there);
      result.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
    }
  }
  return result;
}

std::vector<PlanarLoop> without(std::vector<PlanarLoop> loops, std::span<const PlanarLine> bounds) {
  std::vector<PlanarLoop> left;
  for (PlanarLoop& loop : loops) {
    // A loop that is apart stays whole.
    const bool apart = std::ranges::any_of(
        bounds, [&](const PlanarLine& bound) { return all_outside(loop, bound); });
    if (apart) {
      left.push_back(std::move(loop));
      continue;
    }
    for (const PlanarLine& bound : bounds) {
      PlanarLoop outer = cut(loop, bound.opposite());
      if (outer.size() >= 3) left.push_back(std::move(outer));
      loop = cut(loop, bound);
      if (loop.empty()) break;
    }
  }
  return left;
}

}  // namespace gnomon::oracle
