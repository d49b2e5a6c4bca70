// SPDX-License-Identifier: LGPL-3.0-or-later
// The parts of the scene BSP that no kernel is needed for: choice of roots, and traversal.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "algorithms/scene_bsp/scene_bsp.h"

namespace gnomon {
namespace {

// Measured on cities and soups of 1,000 to 100,000 polygons: more candidates or a larger sample
// cost more time than the splits they avoid.
constexpr std::size_t kCandidates = 8;
constexpr std::size_t kSample = 48;
constexpr double kSplitCost = 6;

}  // namespace

RootChooser::RootChooser(const Geometry& geometry, std::uint64_t seed) : state_(seed) {
  planes_.reserve(geometry.planes.size());
  for (const SupportTriple& triple : geometry.planes) {
    const auto& a = geometry.positions[triple.a];
    const auto& b = geometry.positions[triple.b];
    const auto& c = geometry.positions[triple.c];
    std::array<double, 3> u, v;
    for (int k = 0; k < 3; ++k) {
      u[k] = b[k] - a[k];
      v[k] = c[k] - a[k];
    }
    std::array<double, 4> plane{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                                u[0] * v[1] - u[1] * v[0], 0};
    plane[3] = plane[0] * a[0] + plane[1] * a[1] + plane[2] * a[2];
    planes_.push_back(plane);
  }
}

std::uint64_t RootChooser::random() {  // splitmix64
  std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

std::size_t RootChooser::choose(std::span<const std::uint32_t> candidates,
                                std::span<const Box> boxes, std::span<const PlaneId> planes) {
  const std::size_t n = candidates.size();
  if (n <= 2) return 0;
  const std::size_t tries = std::min(n, kCandidates), sample = std::min(n, kSample);
  std::size_t best = 0;
  double best_cost = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < tries; ++t) {
    const std::size_t index = n <= kCandidates ? t : random() % n;
    const std::array<double, 4>& plane = planes_[planes[candidates[index]]];
    std::size_t front = 0, back = 0, splits = 0;
    for (std::size_t s = 0; s < sample; ++s) {
      const std::size_t other = n <= kSample ? s : random() % n;
      const Box& box = boxes[candidates[other]];
      // The box's extreme values of n . x - d; a tolerance of rounding size keeps touching boxes
      // whole.
      double low = -plane[3], high = -plane[3], size = std::fabs(plane[3]);
      for (int k = 0; k < 3; ++k) {
        const double a = plane[k] * box.low[k], b = plane[k] * box.high[k];
        low += std::min(a, b);
        high += std::max(a, b);
        size += std::max(std::fabs(a), std::fabs(b));
      }
      const double slack = 16 * std::numeric_limits<double>::epsilon() * size;
      if (high <= slack && low >= -slack) continue;
      if (low >= -slack)
        ++front;
      else if (high <= slack)
        ++back;
      else
        ++splits;
    }
    const double imbalance = std::fabs(static_cast<double>(front) - static_cast<double>(back));
    const double cost = kSplitCost * static_cast<double>(splits) + imbalance;
    if (cost < best_cost) {
      best_cost = cost;
      best = index;
    }
  }
  return best;
}

std::vector<std::uint32_t> outside_first(const PreparedScene& scene,
                                         std::span<const std::uint32_t> parts) {
  const auto& positions = scene.geometry.positions;
  Box box;
  for (const Part& part : scene.parts) {
    for (const VertexId v : scene.loop(part)) box.add(positions[v]);
  }
  std::vector<std::pair<double, std::uint32_t>> sorted;
  sorted.reserve(parts.size());
  for (const std::uint32_t part : parts) {
    double farthest = 0;
    for (const VertexId v : scene.loop(scene.parts[part])) {
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        // Twice the way from the middle.
        const double way = (positions[v][k] - box.low[k]) - (box.high[k] - positions[v][k]);
        sum += way * way;
      }
      farthest = std::max(farthest, sum);
    }
    sorted.emplace_back(-farthest, part);
  }
  std::ranges::stable_sort(sorted, {}, &std::pair<double, std::uint32_t>::first);
  std::vector<std::uint32_t> result;
  result.reserve(parts.size());
  for (const auto& [way, part] : sorted) result.push_back(part);
  return result;
}

std::vector<std::uint32_t> front_to_back(std::span<const BspNode> nodes,
                                         const std::function<Sign(PlaneId)>& side_of_node) {
  std::vector<std::uint32_t> order;
  order.reserve(nodes.size());
  struct Frame {
    std::int32_t node;
    bool emit;
  };
  std::vector<Frame> stack;
  if (!nodes.empty()) stack.push_back({0, false});
  while (!stack.empty()) {
    const Frame frame = stack.back();
    stack.pop_back();
    if (frame.emit) {
      order.push_back(static_cast<std::uint32_t>(frame.node));
      continue;
    }
    const BspNode& node = nodes[static_cast<std::size_t>(frame.node)];
    // If the viewpoint is in the node's plane, neither half can hide anything of the other.
    const bool front_first = side_of_node(node.plane) != Sign::kNegative;
    const std::int32_t near = front_first ? node.front : node.back;
    const std::int32_t far = front_first ? node.back : node.front;
    if (far != BspNode::kEmpty) stack.push_back({far, false});
    stack.push_back({frame.node, true});
    if (near != BspNode::kEmpty) stack.push_back({near, false});
  }
  return order;
}

}  // namespace gnomon
