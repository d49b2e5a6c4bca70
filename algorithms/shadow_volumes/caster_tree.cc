// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/shadow_volumes/caster_tree.h"

#include <algorithm>
#include <cmath>

#include "kernel/numbers/exact_integer.h"

namespace gnomon {
namespace {

// Coordinates are off by 2^-53 and at most 1 (an axis plane of a far light: still 1). A line
// through two points at least kShortest apart then is off by less than 2^-50 / kShortest anywhere.
constexpr double kMargin = 1e-12, kShortest = 1e-3;

double diagonal_of(const Box& box) {
  return std::hypot(box.high[0] - box.low[0], box.high[1] - box.low[1], box.high[2] - box.low[2]);
}

}  // namespace

std::array<double, 3> grid_fraction(const GridPositions& grid, VertexId vertex) {
  std::array<double, 3> point{};
  for (int k = 0; k < 3; ++k) {
    point[static_cast<std::size_t>(k)] =
        grid.is_narrow() ? std::ldexp(static_cast<double>(grid.narrow(vertex, k)),
                                      -static_cast<int>(grid.bits()))
                         : to_double_scaled(grid.wide(vertex, k), grid.bits());
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
  for (std::size_t i = 0; i < light.size(); ++i) {
    for (std::size_t j = i + 1; j < light.size(); ++j) {
      std::array<double, 3> a{}, b{};
      for (std::size_t k = 0; k < 3; ++k) {
        a[k] = light[i][k] - middle[k];
        b[k] = light[j][k] - middle[k];
      }
      const double to_a = std::hypot(a[0], a[1], a[2]), to_b = std::hypot(b[0], b[1], b[2]);
      if (!(to_a > 2 * radius) || !(to_b > 2 * radius)) continue;
      const double angle =
          std::atan2(std::hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                                a[0] * b[1] - a[1] * b[0]),
                     a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
      // A ray turns by at most this where p moves in the receiver's ball.
      const double smallest = angle - std::asin(radius / to_a) - std::asin(radius / to_b);
      if (smallest > 0) sine_ = std::max(sine_, std::sin(std::min(smallest, 1.5)));
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
                       std::span<const std::uint32_t> parts)
    : boxes_(scene.parts.size()), order_(parts.begin(), parts.end()) {
  for (std::uint32_t part = 0; part < scene.parts.size(); ++part) {
    for (const VertexId vertex : scene.loop(scene.parts[part])) {
      boxes_[part].add(grid_fraction(geometry.grid, vertex));
    }
  }
  build();
}

void CasterTree::build() {
  struct Task {
    std::uint32_t begin, end, parent;  // parent: whose right child it is
  };
  constexpr std::uint32_t kNoParent = 0xffffffffu;
  if (order_.empty()) return;
  std::vector<Task> tasks{{0, static_cast<std::uint32_t>(order_.size()), kNoParent}};
  while (!tasks.empty()) {
    const Task task = tasks.back();
    tasks.pop_back();
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    if (task.parent != kNoParent) nodes_[task.parent].right = index;
    Node node;
    node.begin = task.begin;
    node.end = task.end;
    Box middles;
    const auto middle = [&](std::uint32_t part, std::size_t k) {
      return boxes_[part].low[k] + boxes_[part].high[k];
    };
    for (std::uint32_t i = task.begin; i < task.end; ++i) {
      const std::uint32_t part = order_[i];
      node.box.add(boxes_[part]);
      node.largest = std::max(node.largest, diagonal_of(boxes_[part]));
      middles.add(std::array{middle(part, 0), middle(part, 1), middle(part, 2)});
    }
    nodes_.push_back(node);
    if (task.end - task.begin <= kLeaf) continue;
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k) {
      if (middles.high[k] - middles.low[k] > middles.high[axis] - middles.low[axis]) axis = k;
    }
    const std::uint32_t half = task.begin + (task.end - task.begin) / 2;
    const auto begin = order_.begin();
    std::nth_element(begin + task.begin, begin + half, begin + task.end,
                     [&](std::uint32_t a, std::uint32_t b) {
                       const double x = middle(a, axis), y = middle(b, axis);
                       return x < y || (x == y && a < b);
                     });
    tasks.push_back({half, task.end, index});
    tasks.push_back({task.begin, half, kNoParent});  // next: the left child follows
  }
}

template <class MayBe>
void CasterTree::search(const MayBe& may_be, std::vector<std::uint32_t>& parts) const {
  if (nodes_.empty()) return;
  const std::size_t first = parts.size();
  // Left children are reached by going on, so that the stack holds right children only: as deep as
  // the tree, which halves.
  std::array<std::uint32_t, 64> stack{};
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const std::uint32_t index = stack[--depth];
    const Node& node = nodes_[index];
    if (!may_be(node.box, node.largest)) continue;
    if (node.right != 0) {
      stack[depth++] = node.right;
      stack[depth++] = index + 1;
      continue;
    }
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      const Box& box = boxes_[order_[i]];
      if (may_be(box, diagonal_of(box))) parts.push_back(order_[i]);
    }
  }
  std::sort(parts.begin() + static_cast<std::ptrdiff_t>(first), parts.end());
}

void CasterTree::find(const Shaft& shaft, std::vector<std::uint32_t>& parts) const {
  search([&](const Box& box, double) { return shaft.may_meet(box); }, parts);
}

void CasterTree::find(const Shaft& shaft, const UmbraReach& reach,
                      std::vector<std::uint32_t>& parts) const {
  search([&](const Box& box,
             double size) { return shaft.may_meet(box) && reach.may_reach(box, size); },
         parts);
}

}  // namespace gnomon
