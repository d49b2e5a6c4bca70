// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/ridge_edges/separate_loops.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "scene/base/vectors.h"

namespace gnomon {

namespace {

/// One end of a stretch at a ray. What leaves the ray goes along normal x ray, or against it for a
/// stretch that comes in; such directions turn about the ray as the normals do.
struct StretchEnd {
  std::uint32_t stretch = 0;
  bool incoming = false;
  std::uint32_t inner = 0;  // of the stretch
  DirectionVector turn;     // the normal, or its opposite for an incoming one
};

/// 0 for the first half of a turn, its start included, 1 for the second.
int half_of(const DirectionVector& start, const DirectionVector& turn, const DirectionVector& ray) {
  const int sign = sgn(dot(cross(start, turn), ray));
  if (sign != 0) return sign > 0 ? 0 : 1;
  return dot(start, turn) > 0 ? 0 : 1;
}

/// Clockwise as the light sees it. Of stretches that run along one another the innermost comes
/// first where they leave and last where they come in, since that is where its depth begins and
/// ends.
void sort_around(std::vector<StretchEnd>& ends, const DirectionVector& ray) {
  const DirectionVector start = ends.front().turn;
  std::ranges::sort(ends, [&](const StretchEnd& a, const StretchEnd& b) {
    const int half_a = half_of(start, a.turn, ray), half_b = half_of(start, b.turn, ray);
    if (half_a != half_b) return half_a > half_b;
    if (const int sign = sgn(dot(cross(a.turn, b.turn), ray)); sign != 0) return sign < 0;
    return a.incoming ? a.inner > b.inner : a.inner < b.inner;
  });
}

/// Pairs each incoming end with an outgoing one. Clockwise around the ray an incoming end enters a
/// depth of facing polygons and an outgoing one leaves it, like brackets: those that match bound
/// the same depth.
void match(std::vector<StretchEnd>& ends, const DirectionVector& ray,
           std::vector<std::uint32_t>& next) {
  if (ends.size() == 2) {
    const StretchEnd &in = ends[0].incoming ? ends[0] : ends[1],
                     &out = ends[0].incoming ? ends[1] : ends[0];
    next[in.stretch] = out.stretch;
    return;
  }
  sort_around(ends, ray);
  // From the place where the fewest depths are open, every bracket closes one that was opened.
  std::ptrdiff_t open = 0, fewest = 0, start = 0;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    open += ends[i].incoming ? 1 : -1;
    if (open < fewest) {
      fewest = open;
      start = static_cast<std::ptrdiff_t>(i) + 1;
    }
  }
  std::rotate(ends.begin(), ends.begin() + start, ends.end());
  std::vector<std::uint32_t> opened;
  for (const StretchEnd& end : ends) {
    if (end.incoming) {
      opened.push_back(end.stretch);
    } else {
      next[opened.back()] = end.stretch;
      opened.pop_back();
    }
  }
}

}  // namespace

std::vector<StretchLoop> separate_loops(std::span<const Stretch> stretches, const RidgeArcs& arcs) {
  std::vector<std::vector<StretchEnd>> at_ray(arcs.rays().size());
  for (std::uint32_t i = 0; i < stretches.size(); ++i) {
    DirectionVector turn = arcs.arcs()[stretches[i].edge].normal.exact;
    at_ray[stretches[i].from_ray].push_back({i, false, stretches[i].inner, turn});
    for (mpz_class& c : turn) c = -c;
    at_ray[stretches[i].to_ray].push_back({i, true, stretches[i].inner, std::move(turn)});
  }
  std::vector<std::uint32_t> next(stretches.size(), 0);
  for (std::size_t ray = 0; ray < at_ray.size(); ++ray) {
    if (!at_ray[ray].empty()) match(at_ray[ray], arcs.rays()[ray].exact, next);
  }
  std::vector<StretchLoop> loops;
  std::vector<bool> taken(stretches.size(), false);
  for (std::uint32_t first = 0; first < stretches.size(); ++first) {
    if (taken[first]) continue;
    StretchLoop& loop = loops.emplace_back();
    for (std::uint32_t at = first; !taken[at]; at = next[at]) {
      taken[at] = true;
      loop.push_back(at);
    }
  }
  return loops;
}

}  // namespace gnomon
