// SPDX-License-Identifier: LGPL-3.0-or-later
// Which fragments Mutation::kSliversDropped leaves out.
#ifndef GNOMON_ALGORITHMS_PARTITION_SLIVER_H
#define GNOMON_ALGORITHMS_PARTITION_SLIVER_H

#include <algorithm>
#include <array>
#include <cmath>

#include "algorithms/partition/loop_store.h"
#include "kernel/concept/kernel_concept.h"

namespace gnomon {

/// A fragment with a made vertex and on average narrower than kSliver times the distance of its
/// farthest vertices. In doubles: a mistake need not be exact.
template <MeasuredSpace Space>
bool is_sliver(const Space& space, const LoopView<typename Space::Vertex>& loop) {
  constexpr double kSliver = 1.0 / 64;
  bool made = false;
  double longest = 0;
  std::array<double, 3> area{}, first{}, before{};
  for (std::uint32_t i = 0; i < loop.size(); ++i) {
    made = made || loop.vertices[i].source == kMadeVertex;
    const std::array<Ball, 3> ball = space.position(loop.corner(i));
    const std::array<double, 3> point{ball[0].middle, ball[1].middle, ball[2].middle};
    if (i == 0) first = point;
    std::array<double, 3> step{}, last{};
    for (std::size_t k = 0; k < 3; ++k) {
      step[k] = point[k] - first[k];
      last[k] = before[k] - first[k];
    }
    longest = std::max(longest, step[0] * step[0] + step[1] * step[1] + step[2] * step[2]);
    for (std::size_t k = 0; i > 1 && k < 3; ++k) {
      const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
      area[k] += last[u] * step[v] - last[v] * step[u];
    }
    before = point;
  }
  return made && std::hypot(area[0], area[1], area[2]) / 2 < kSliver * longest;
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PARTITION_SLIVER_H
