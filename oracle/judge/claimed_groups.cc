// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/judge/claimed_groups.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "gnomon/oracle/enclosure.h"
#include "oracle/geometry/group_overlay.h"

namespace gnomon::oracle {

double nearly_as_near(const PreparedScene& prepared, const ClaimedFragment& fragment,
                      double radius) {
  const double seen = std::ldexp(1.0, static_cast<int>(prepared.position_bits) - 30);
  return fragment.exact ? seen : seen + 2 * radius / prepared.geometry.step.get_d();
}

bool contains(const std::vector<ChartPoint>& convex, const ChartPoint& point) {
  for (std::size_t i = 0; i < convex.size(); ++i) {
    if (orientation(convex[i], convex[(i + 1) % convex.size()], point) <= 0) return false;
  }
  return true;
}

std::size_t group_for(const ExactAnswer& answer, const AnswerEntry& entry,
                      const std::vector<Chart>& charts, const ClaimedFragment& fragment,
                      double radius) {
  if (entry.groups.size() == 1) return 0;
  const PreparedScene& prepared = answer.prepared();
  std::vector<HomogeneousPoint> points;
  RationalPoint centre;
  for (const RationalPoint& point : fragment.loop) {
    points.push_back(to_grid(prepared.geometry, point));
    for (int k = 0; k < 3; ++k) centre[k] += point[k];
  }
  if (fragment.loop.empty()) return 0;
  for (mpq_class& coordinate : centre) coordinate /= fragment.loop.size();
  const HomogeneousPoint middle = to_grid(prepared.geometry, centre);
  std::vector<double> distances;
  for (const Chart& chart : charts) {
    const Integers3& normal = chart.support().normal;
    const double length = enclose_square_root(mpq_class(dot(normal, normal))).middle();
    double most = 0;
    for (const HomogeneousPoint& point : points) {
      most =
          std::max(most, enclose_ratio(value_at(chart.support(), point), point.w).upper / length);
    }
    distances.push_back(most);
  }
  const double nearest = *std::min_element(distances.begin(), distances.end());
  const double near = nearest + nearly_as_near(prepared, fragment, radius);
  std::size_t best = entry.groups.size();
  for (std::size_t g = 0; g < entry.groups.size(); ++g) {
    if (distances[g] > near) continue;
    const ChartPoint point = charts[g].project(middle);
    for (std::uint32_t part : entry.groups[g].parts) {
      std::vector<ChartPoint> loop;
      for (const Integers3& vertex : grid_loop(prepared, part))
        loop.push_back(charts[g].at(vertex));
      if (orientation(loop[0], loop[1], loop[2]) < 0) std::reverse(loop.begin(), loop.end());
      if (contains(loop, point) &&
          (best == entry.groups.size() || distances[g] < distances[best])) {
        best = g;
      }
    }
  }
  if (best < entry.groups.size()) return best;
  return static_cast<std::size_t>(std::min_element(distances.begin(), distances.end()) -
                                  distances.begin());
}

}  // namespace gnomon::oracle
