// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/area_contour/box_groups.h"

#include <algorithm>
#include <cmath>

namespace gnomon::area_contour {
namespace {

// As in caster_tree.cc: coordinates are off by 2^-53 and at most 1; a line through two points at
// least kShortest apart is off by less than 2^-50 / kShortest anywhere. kRoom is for single
// precision.
constexpr double kMargin = 1e-12, kShortest = 1e-3, kRoom = 0x1p-20;

}  // namespace

void BoxGroup::set(std::uint32_t lane, const Box& box) {
  for (std::size_t k = 0; k < 3; ++k) {
    ends[k][lane] = static_cast<float>(box.low[k] - kRoom);
    ends[kHigh + k][lane] = static_cast<float>(box.high[k] + kRoom);
  }
}

Box BoxGroup::box(std::uint32_t lane) const {
  Box box;
  for (std::size_t k = 0; k < 3; ++k) {
    box.low[k] = ends[k][lane];
    box.high[k] = ends[kHigh + k][lane];
  }
  return box;
}

GroupShaft::GroupShaft(const Box& from, const Box& to) {
  for (std::size_t k = 0; k < 3; ++k) {
    low_[k] = static_cast<float>(std::min(from.low[k], to.low[k]) - kRoom);
    high_[k] = static_cast<float>(std::max(from.high[k], to.high[k]) + kRoom);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) add_tangents(axis, from, to);
}

void GroupShaft::add_tangents(std::size_t axis, const Box& from, const Box& to) {
  const std::size_t next = (axis + 1) % 3;
  for (int corner = 0; corner < 4; ++corner) {
    const bool high_u = (corner & 1) != 0, high_v = (corner & 2) != 0;
    const double u = high_u ? from.high[axis] : from.low[axis];
    const double v = high_v ? from.high[next] : from.low[next];
    const double du = (high_u ? to.high[axis] : to.low[axis]) - u;
    const double dv = (high_v ? to.high[next] : to.low[next]) - v;
    const double square = du * du + dv * dv;
    if (!(square > kShortest * kShortest)) continue;
    const double inverse = 1 / std::sqrt(square);
    for (const double sign : {1.0, -1.0}) {
      const double nu = sign * -dv * inverse, nv = sign * du * inverse;
      // A tangent has both rectangles, and so their outermost corners, on one side.
      if ((nu > 0) != high_u && nu != 0) continue;
      if ((nv > 0) != high_v && nv != 0) continue;
      const double d = nu * u + nv * v;
      const double room = kRoom + kMargin * (1 + std::fabs(d));
      const auto end_of = [](double n, std::size_t k) {
        return static_cast<std::uint32_t>(n > 0 ? k : BoxGroup::kHigh + k);
      };
      tangents_[count_++] = {static_cast<float>(nu), static_cast<float>(nv),
                             static_cast<float>(d + room), end_of(nu, axis), end_of(nv, next)};
      break;
    }
  }
}

BoxGroups::BoxGroups(const BoxTree& tree, std::span<const double> largest) {
  const std::span<const BoxTree::Node> nodes = tree.nodes();
  if (nodes.empty()) return;
  const auto is_small = [&](std::uint32_t node) {
    return nodes[node].end - nodes[node].begin <= BoxGroup::kSize;
  };
  std::vector<std::uint32_t> tops = {0};  // by group, its node
  for (std::uint32_t number = 0; number < tops.size(); ++number) {
    const std::uint32_t top = tops[number];
    BoxGroup group{};
    for (std::size_t k = 0; k < 3; ++k) {
      std::ranges::fill(group.ends[k], 2.0F);
      std::ranges::fill(group.ends[BoxGroup::kHigh + k], -2.0F);
    }
    if (is_small(top)) {
      group.is_of_members = 1;
      group.first = nodes[top].begin;
      for (std::uint32_t i = 0; const std::uint32_t member : tree.members(nodes[top])) {
        group.set(i++, tree.box(member));
      }
      groups_.push_back(group);
      continue;
    }
    std::array<std::uint32_t, BoxGroup::kSize> below = {top};
    std::uint32_t count = 1;
    for (int level = 0; level < 3; ++level) {
      std::array<std::uint32_t, BoxGroup::kSize> next{};
      std::uint32_t more = 0;
      for (const std::uint32_t node : std::span(below).first(count)) {
        next[more++] = is_small(node) ? node : node + 1;
        if (!is_small(node)) next[more++] = nodes[node].right;
      }
      below = next;
      count = more;
    }
    for (std::uint32_t i = 0; i < count; ++i) {
      group.set(i, nodes[below[i]].box);
      group.largest[i] = std::nextafter(static_cast<float>(largest[below[i]]), 2.0F);
      group.child[i] = static_cast<std::uint32_t>(tops.size());
      tops.push_back(below[i]);
    }
    groups_.push_back(group);
  }
}

}  // namespace gnomon::area_contour
