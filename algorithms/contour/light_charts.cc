// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/contour/light_charts.h"

#include <algorithm>
#include <cmath>

namespace gnomon {

namespace {

/// Keeps the part of a loop of directions on which f is not negative.
template <class F>
void keep_front(std::vector<Direction>& loop, std::vector<Direction>& work, const F& f) {
  work.clear();
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Direction& a = loop[i];
    const Direction& b = loop[i + 1 == loop.size() ? 0 : i + 1];
    const double at_a = f(a), at_b = f(b);
    if (at_a >= 0) work.push_back(a);
    if ((at_a > 0 && at_b < 0) || (at_a < 0 && at_b > 0)) {
      const double t = at_a / (at_a - at_b);
      work.push_back(
          {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])});
    }
  }
  loop.swap(work);
}

/// Perpendicular to a loop; of the corners that make it longest.
Direction normal_of(std::span<const Direction> corners) {
  Direction best{0, 0, 0};
  double longest = 0;
  const auto difference = [](const Direction& a, const Direction& b) {
    return Direction{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  };
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const Direction normal =
        cross_product(difference(corners[i - 1], corners[0]), difference(corners[i], corners[0]));
    const double size = dot_product(normal, normal);
    if (size > longest) {
      longest = size;
      best = normal;
    }
  }
  return best;
}

}  // namespace

void BoxArrays::push(const std::array<double, 4>& box, std::uint32_t owner) {
  low_u.push_back(static_cast<float>(box[0]));
  low_v.push_back(static_cast<float>(box[1]));
  high_u.push_back(static_cast<float>(box[2]));
  high_v.push_back(static_cast<float>(box[3]));
  owners.push_back(owner);
}

// A face is clipped a little wider than it is, and boxes are widened: both by far more than the
// roundings of corners of some size. A corner that a cut has left near the lamp may be off by much
// of itself, and then the box is the whole face.
void LightCharts::add_to_faces(std::span<const Direction> corners, std::uint32_t owner) {
  constexpr double kWider = 1 + 0x1p-10, kMargin = 0x1p-20, kLeastSize = 0x1p-20;
  double most = 0;
  for (const Direction& r : corners) {
    most = std::max({most, std::fabs(r[0]), std::fabs(r[1]), std::fabs(r[2])});
  }
  // Of a polygon whose plane the lamp is nearly in, roundings may be as far as the lamp; all other
  // points of a polygon are much farther from it than roundings are.
  constexpr double kLeastDistance = 0x1p-30;
  const Direction normal = normal_of(corners);
  const double distance = std::fabs(dot_product(normal, corners[0]));
  const double length = std::sqrt(dot_product(normal, normal));
  const bool known =
      most < std::numeric_limits<double>::infinity() && distance > kLeastDistance * most * length;
  for (int face = 0; face < 6; ++face) {
    const int w = face / 2, u = (w + 1) % 3, v = (w + 2) % 3;
    const double sign = face % 2 == 0 ? 1 : -1;
    std::array<double, 4> box{-1, -1, 1, 1};
    if (known) {
      clipped_.assign(corners.begin(), corners.end());
      for (const int axis : {u, v}) {
        for (const double side : {1.0, -1.0}) {
          keep_front(clipped_, loop_work_,
                     [&](const Direction& r) { return sign * r[w] * kWider + side * r[axis]; });
        }
      }
      if (clipped_.empty()) continue;
      std::array<double, 4> found{1, 1, -1, -1};
      bool small = false;
      for (const Direction& r : clipped_) {
        const double depth = sign * r[w];
        if (!(depth > kLeastSize * most)) {
          small = true;
          break;
        }
        found[0] = std::min(found[0], r[u] / depth);
        found[1] = std::min(found[1], r[v] / depth);
        found[2] = std::max(found[2], r[u] / depth);
        found[3] = std::max(found[3], r[v] / depth);
      }
      if (!small) {
        box = {std::max(-1.0, found[0] - kMargin), std::max(-1.0, found[1] - kMargin),
               std::min(1.0, found[2] + kMargin), std::min(1.0, found[3] + kMargin)};
        if (box[0] > box[2] || box[1] > box[3]) continue;  // in the widened border alone
      }
    }
    faces_[static_cast<std::size_t>(face)].push(box, owner);
  }
}

}  // namespace gnomon
