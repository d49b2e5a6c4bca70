// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/judge/border_fragments.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace gnomon::oracle {

namespace {

bool same(const PlanarPoint& a, const PlanarPoint& b) { return a.x == b.x && a.y == b.y; }

long double distance_to_segment(const PlanarPoint& a, const PlanarPoint& b,
                                const PlanarPoint& point) {
  const long double dx = b.x - a.x, dy = b.y - a.y;
  const long double squared = dx * dx + dy * dy;
  long double t = squared > 0 ? ((point.x - a.x) * dx + (point.y - a.y) * dy) / squared : 0;
  t = std::clamp(t, 0.0L, 1.0L);
  return std::hypot(point.x - (a.x + t * dx), point.y - (a.y + t * dy));
}

/// How far a loop leaves the border of its hull on its way around; nothing known (infinite) if it
/// does not pass the hull's corners once each, in their order.
long double way_around(const PlanarLoop& loop, const PlanarLoop& hull) {
  constexpr long double kNever = std::numeric_limits<long double>::infinity();
  const auto first =
      std::ranges::find_if(loop, [&](const PlanarPoint& p) { return same(p, hull[0]); });
  if (first == loop.end()) return kNever;
  const auto start = static_cast<std::size_t>(first - loop.begin());
  std::size_t corner = 0;
  long double most = 0;
  for (std::size_t i = 1; i < loop.size(); ++i) {
    const PlanarPoint& point = loop[(start + i) % loop.size()];
    if (same(point, hull[corner])) continue;
    const std::size_t next = corner + 1;
    if (next < hull.size() && same(point, hull[next])) {
      corner = next;
      continue;
    }
    most = std::max(most, distance_to_segment(hull[corner], hull[next % hull.size()], point));
  }
  return corner + 1 == hull.size() ? most : kNever;
}

}  // namespace

Extent extent_of(const PlanarLoop& loop, const PlanarLine& line) {
  Extent extent{line.at(loop[0]), line.at(loop[0])};
  for (const PlanarPoint& point : loop) {
    const long double value = line.at(point);
    extent.low = std::min(extent.low, value);
    extent.high = std::max(extent.high, value);
  }
  return extent;
}

long double length_along(const PlanarLoop& loop, const PlanarLine& line) {
  return extent_of(loop, {-line.b, line.a, 0}).size();
}

BorderFragment border_fragment(const ClaimedFragment& claimed, PlanarLoop loop) {
  BorderFragment fragment;
  fragment.claimed = &claimed;
  if (area_of(loop) < 0) std::ranges::reverse(loop);
  fragment.loop = hull_of(loop);
  fragment.lines = lines_of(fragment.loop);
  const PlanarBox box = box_of(loop);
  fragment.length = (box.high.x - box.low.x) + (box.high.y - box.low.y);
  fragment.thickness = fragment.length;
  long double outside = 0;
  for (const PlanarLine& line : fragment.lines) {
    const Extent extent = extent_of(loop, line);
    fragment.thickness = std::min(fragment.thickness, extent.size());
    outside = std::max(outside, -extent.low);
  }
  if (fragment.loop.size() < 3) {
    // On one line, or all but: the two ends tell which.
    const auto [low, high] = std::ranges::minmax_element(
        loop, [](const auto& a, const auto& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
    const PlanarLine line = line_through(*low, *high);
    fragment.thickness = extent_of(loop, line).size();
    return fragment;
  }
  fragment.slack = std::max(outside, way_around(loop, fragment.loop));
  fragment.regular = std::isfinite(fragment.slack);
  return fragment;
}

}  // namespace gnomon::oracle
