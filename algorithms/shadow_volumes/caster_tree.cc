// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/shadow_volumes/caster_tree.h"

#include <algorithm>
#include <cmath>

#include "algorithms/partition/in_parallel.h"
#include "kernel/implicit/scaled_doubles.h"

namespace gnomon {
namespace {

// Coordinates are off by 2^-53 and at most 1 (an axis plane of a far light: still 1). A line
// through two points at least kShortest apart then is off by less than 2^-50 / kShortest anywhere.
constexpr double kMargin = 1e-12, kShortest = 1e-3;

double diagonal_of(const Box& box) {
  return std::hypot(box.high[0] - box.low[0], box.high[1] - box.low[1], box.high[2] - box.low[2]);
}

double length_of(const Double3& v) { return std::sqrt(dot(v, v)); }

std::vector<Box> boxes_of_parts(const Geometry& geometry, const PreparedScene& scene,
                                unsigned jobs) {
  constexpr std::uint32_t kGrain = 2048;
  std::vector<Box> boxes(scene.parts.size());
  in_parallel(jobs, static_cast<std::uint32_t>(boxes.size()), kGrain,
              [&](std::uint32_t begin, std::uint32_t end) {
                for (std::uint32_t part = begin; part < end; ++part) {
                  for (const VertexId vertex : scene.loop(scene.parts[part])) {
                    boxes[part].add(grid_fraction(geometry.grid, vertex));
                  }
                }
              });
  return boxes;
}

}  // namespace

std::array<double, 3> grid_fraction(const GridPositions& grid, VertexId vertex) {
  std::array<double, 3> point{};
  if (!grid.is_narrow()) {
    for (int k = 0; k < 3; ++k) {
      point[static_cast<std::size_t>(k)] = to_double_scaled(grid.wide(vertex, k), grid.bits());
    }
    return point;
  }
  const double unit = 1 / static_cast<double>(std::uint64_t{1} << grid.bits());
  for (int k = 0; k < 3; ++k) {
    point[static_cast<std::size_t>(k)] = static_cast<double>(grid.narrow(vertex, k)) * unit;
  }
  return point;
}

void Shaft::add_plane(int u, int v, double nu, double nv, double d) {
  planes_[count_++] = {u, v, nu, nv, d + kMargin * (1 + std::fabs(d))};
}

// In each coordinate plane the hull of two rectangles is bounded by sides of the rectangles and by
// lines through corresponding corners of both.
void Shaft::add_tangents(const Box& receiver, const Box& light) {
  for (int u = 0; u < 3; ++u) {
    const int v = (u + 1) % 3;
    const auto side = [](const Box& box, int axis, bool high) {
      const auto k = static_cast<std::size_t>(axis);
      return high ? box.high[k] : box.low[k];
    };
    for (int corner = 0; corner < 4; ++corner) {
      const bool high_u = (corner & 1) != 0, high_v = (corner & 2) != 0;
      const double ru = side(receiver, u, high_u), rv = side(receiver, v, high_v);
      const double du = side(light, u, high_u) - ru, dv = side(light, v, high_v) - rv;
      const double length = std::hypot(du, dv);
      if (!(length > kShortest)) continue;
      for (const double sign : {1.0, -1.0}) {
        const double nu = sign * -dv / length, nv = sign * du / length;
        // A tangent has both rectangles, and so their outermost corners, on one side.
        if ((nu > 0) != high_u && nu != 0) continue;
        if ((nv > 0) != high_v && nv != 0) continue;
        add_plane(u, v, nu, nv, nu * ru + nv * rv);
        break;
      }
    }
  }
}

Shaft::Shaft(const Box& receiver, const Box& light) {
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    add_plane(k, k, 1, 0, std::max(receiver.high[i], light.high[i]));
    add_plane(k, k, -1, 0, -std::min(receiver.low[i], light.low[i]));
  }
  add_tangents(receiver, light);
}

Shaft::Shaft(const Box& receiver, const std::array<double, 3>& direction) {
  const double length = std::hypot(direction[0], direction[1], direction[2]);
  if (!(length > 0) || !std::isfinite(length)) return;
  // Where the shaft leaves the unit cube that holds the scene.
  Box far = receiver;
  for (std::size_t k = 0; k < 3; ++k) {
    const double move = 4 * direction[k] / length;
    far.low[k] += move;
    far.high[k] += move;
  }
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (direction[i] <= 0) add_plane(k, k, 1, 0, receiver.high[i]);
    if (direction[i] >= 0) add_plane(k, k, -1, 0, -receiver.low[i]);
  }
  add_tangents(receiver, far);
}

bool Shaft::may_meet(const Box& box) const {
  for (std::size_t i = 0; i < count_; ++i) {
    const Plane& plane = planes_[i];
    const auto u = static_cast<std::size_t>(plane.u), v = static_cast<std::size_t>(plane.v);
    // The corner of the box that is deepest inside.
    double value = plane.nu * (plane.nu > 0 ? box.low[u] : box.high[u]);
    if (plane.nv != 0) value += plane.nv * (plane.nv > 0 ? box.low[v] : box.high[v]);
    if (value > plane.d) return false;
  }
  return true;
}

UmbraReach::UmbraReach(std::span<const std::array<double, 3>> light, const Box& receiver)
    : receiver_(receiver) {
  std::array<double, 3> middle{};
  double square = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    middle[k] = (receiver.low[k] + receiver.high[k]) / 2;
    square += (receiver.high[k] - receiver.low[k]) * (receiver.high[k] - receiver.low[k]);
  }
  const double radius = std::sqrt(square) / 2 + 4 * kMargin;
  // A ray from p to a corner turns by at most asin(sine) where p moves in the receiver's ball.
  struct Ray {
    Double3 direction;
    double sine, cosine;
  };
  std::vector<Ray> rays;
  rays.reserve(light.size());
  for (const Double3& corner : light) {
    const Double3 to = {corner[0] - middle[0], corner[1] - middle[1], corner[2] - middle[2]};
    const double length = length_of(to);
    if (!(length > 2 * radius)) continue;
    const double sine = radius / length;
    rays.push_back({{to[0] / length, to[1] / length, to[2] / length},
                    sine,
                    std::sqrt((1 - sine) * (1 + sine))});
  }
  for (std::size_t i = 0; i < rays.size(); ++i) {
    for (std::size_t j = i + 1; j < rays.size(); ++j) {
      const auto& [a, sine_a, cosine_a] = rays[i];
      const auto& [b, sine_b, cosine_b] = rays[j];
      const double sine = length_of(cross(a, b)), cosine = dot(a, b);
      // Of both turns, each below 30 degrees; then of the angle less both.
      const double sine_off = sine_a * cosine_b + cosine_a * sine_b,
                   cosine_off = cosine_a * cosine_b - sine_a * sine_b;
      const double sine_left = sine * cosine_off - cosine * sine_off,
                   cosine_left = cosine * cosine_off + sine * sine_off;
      // Where the angle is not acute, a right one is less.
      if (sine_left > 0) sine_ = std::max(sine_, cosine_left > 0 ? sine_left : 1);
    }
  }
}

bool UmbraReach::may_reach(const Box& caster) const {
  return may_reach(caster, diagonal_of(caster));
}

bool UmbraReach::may_reach(const Box& box, double size) const {
  if (sine_ == 0) return true;
  double gap = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double apart =
        std::max({receiver_.low[k] - box.high[k], box.low[k] - receiver_.high[k], 0.0});
    gap += apart * apart;
  }
  return size + kMargin >= std::sqrt(gap) * sine_ * (1 - kMargin);
}

CasterTree::CasterTree(const Geometry& geometry, const PreparedScene& scene,
                       std::span<const std::uint32_t> parts, unsigned jobs)
    : tree_(boxes_of_parts(geometry, scene, jobs), {parts.begin(), parts.end()}, jobs),
      largest_(tree_.nodes().size(), 0) {
  const std::span<const BoxTree::Node> nodes = tree_.nodes();
  for (std::size_t i = nodes.size(); i-- > 0;) {  // children come after their parents
    if (nodes[i].right != 0) {
      largest_[i] = std::max(largest_[i + 1], largest_[nodes[i].right]);
      continue;
    }
    for (const std::uint32_t part : tree_.members(nodes[i])) {
      largest_[i] = std::max(largest_[i], diagonal_of(box(part)));
    }
  }
}

void CasterTree::find(const Shaft& shaft, std::vector<std::uint32_t>& parts) const {
  const auto first = static_cast<std::ptrdiff_t>(parts.size());
  tree_.find([&](const BoxTree::Node& node, std::uint32_t) { return shaft.may_meet(node.box); },
             [&](std::uint32_t part) { return shaft.may_meet(box(part)); }, parts);
  std::sort(parts.begin() + first, parts.end());
}

void CasterTree::find(const Shaft& shaft, const UmbraReach& reach,
                      std::vector<std::uint32_t>& parts) const {
  const auto first = static_cast<std::ptrdiff_t>(parts.size());
  tree_.find(
      [&](const BoxTree::Node& node, std::uint32_t index) {
        return shaft.may_meet(node.box) && reach.may_reach(node.box, largest_[index]);
      },
      [&](std::uint32_t part) { return shaft.may_meet(box(part)) && reach.may_reach(box(part)); },
      parts);
  std::sort(parts.begin() + first, parts.end());
}

}  // namespace gnomon
