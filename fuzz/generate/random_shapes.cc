// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/generate/random_shapes.h"

#include <algorithm>

namespace gnomon::fuzz {

Triple point_in(Random& random, std::int64_t low, std::int64_t high) {
  return {random.between(low, high), random.between(low, high), random.between(low, high)};
}

Triple direction(Random& random, std::int64_t size) {
  Triple d{};
  while (is_zero(d)) d = point_in(random, -size, size);
  return d;
}

void choose_flags(ScenePen& pen, Random& random) {
  pen.two_sided(random.chance(3, 5)).casts(!random.chance(1, 8));
}

std::vector<Triple> shape(Random& random, std::int64_t low, std::int64_t high) {
  for (;;) {
    const Triple p = point_in(random, low, high), q = point_in(random, low, high),
                 r = point_in(random, low, high);
    if (is_zero(cross(q - p, r - p))) continue;
    switch (random.below(3)) {
      case 0:
        return {p, q, r};
      case 1:
        return {p, q, q + r - p, r};
      default:
        return {p, p + 2 * (q - p), p + 2 * (q - p) + (r - p), p + (q - p) + 2 * (r - p),
                p + 2 * (r - p)};
    }
  }
}

void add_lattice(ScenePen& pen, Random& random, std::int64_t count, std::int64_t size) {
  std::vector<Triple> last;
  for (std::int64_t i = 0; i < count; ++i) {
    choose_flags(pen, random);
    std::vector<Triple> loop = shape(random, 0, size);
    if (!last.empty() && random.chance(1, 3)) {
      // Something in common with the one before: a vertex, an edge, a plane, a T-junction.
      switch (random.below(4)) {
        case 0:
          loop[0] = last[0];
          break;
        case 1:
          loop[0] = last[0], loop[1] = last[1];
          break;
        case 2:
          loop = {last[0], last[1] + (last[1] - last[0]), last[2]};
          break;
        default:
          loop = {2 * last[0], last[0] + last[1], 2 * last[0] + loop[2]};
      }
      if (loop.size() > 3) loop.resize(3);
      if (is_zero(cross(loop[1] - loop[0], loop[2] - loop[0]))) continue;
    }
    if (random.chance(1, 4)) std::reverse(loop.begin(), loop.end());
    pen.polygon(loop);
    last = loop;
  }
  if (pen.scene().polygons.empty()) pen.polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
}

}  // namespace gnomon::fuzz
