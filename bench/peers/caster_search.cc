// SPDX-License-Identifier: GPL-3.0-or-later
#include "peers/caster_search.h"

#include <algorithm>
#include <limits>

namespace gnomon::bench {
namespace {

/// Boxes are widened by this much (chart units, or relative for depths); rounding is off by less.
constexpr double kMargin = 1e-9;
constexpr std::uint32_t kLeafSize = 4;

bool overlap(double low, double high, double other_low, double other_high) {
  return low <= other_high && other_low <= high;
}

}  // namespace

CasterSearch::CasterSearch(const LightView& view) : view_(view) {
  Box box;
  for (const std::uint32_t part : view.facing()) {
    if (!view.casts(part)) continue;
    for (int face = 0; face < 6; ++face) {
      if (box_on_face(part, face, box)) faces_[static_cast<std::size_t>(face)].boxes.push_back(box);
    }
  }
  for (Hierarchy& hierarchy : faces_) build(hierarchy);
}

bool CasterSearch::box_on_face(std::uint32_t part, int face, Box& box) {
  const auto axis = static_cast<std::size_t>(face / 2), first = (axis + 1) % 3,
             second = (axis + 2) % 3;
  const double sign = face % 2 == 0 ? 1 : -1;
  loop_.clear();
  for (const VertexId vertex : view_.loop(part)) {
    const Point<double>& ray = view_.ray(vertex);
    loop_.push_back({ray[first], ray[second], sign * ray[axis]});
  }
  // The face's pyramid: depth * (1 + margin) >= |first|, |second|.
  for (int side = 0; side < 4; ++side) {
    const auto coordinate = static_cast<std::size_t>(side / 2);
    const double direction = side % 2 == 0 ? 1 : -1;
    const auto value = [&](const Point<double>& p) {
      return p[2] * (1 + kMargin) + direction * p[coordinate];
    };
    clipped_.clear();
    for (std::size_t i = 0; i < loop_.size(); ++i) {
      const Point<double>&a = loop_[i], &b = loop_[i + 1 == loop_.size() ? 0 : i + 1];
      const double at_a = value(a), at_b = value(b);
      if (at_a >= 0) clipped_.push_back(a);
      if ((at_a > 0 && at_b < 0) || (at_a < 0 && at_b > 0)) {
        const double t = at_a / (at_a - at_b);
        clipped_.push_back(
            {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])});
      }
    }
    std::swap(loop_, clipped_);
    if (loop_.empty()) return false;
  }
  box.low.fill(std::numeric_limits<double>::infinity());
  box.high.fill(-std::numeric_limits<double>::infinity());
  box.nearest = std::numeric_limits<double>::infinity();
  box.farthest = 0;
  box.part = part;
  for (const Point<double>& p : loop_) {
    if (!(p[2] > 0)) continue;
    for (std::size_t k = 0; k < 2; ++k) {
      box.low[k] = std::min(box.low[k], p[k] / p[2] - kMargin);
      box.high[k] = std::max(box.high[k], p[k] / p[2] + kMargin);
    }
    box.nearest = std::min(box.nearest, p[2] * (1 - kMargin));
    box.farthest = std::max(box.farthest, p[2] * (1 + kMargin));
  }
  return box.farthest > 0;
}

void CasterSearch::build(Hierarchy& hierarchy) {
  if (hierarchy.boxes.empty()) return;
  hierarchy.nodes.push_back({{}, 0, static_cast<std::uint32_t>(hierarchy.boxes.size())});
  for (std::size_t at = 0; at < hierarchy.nodes.size(); ++at) {
    const std::uint32_t first = hierarchy.nodes[at].first, count = hierarchy.nodes[at].count;
    const auto begin = hierarchy.boxes.begin() + first;
    Box bounds = *begin;
    for (auto box = begin; box != begin + count; ++box) {
      for (std::size_t k = 0; k < 2; ++k) {
        bounds.low[k] = std::min(bounds.low[k], box->low[k]);
        bounds.high[k] = std::max(bounds.high[k], box->high[k]);
      }
      bounds.nearest = std::min(bounds.nearest, box->nearest);
    }
    hierarchy.nodes[at].bounds = bounds;
    if (count <= kLeafSize) continue;
    const std::size_t k = bounds.high[0] - bounds.low[0] > bounds.high[1] - bounds.low[1] ? 0 : 1;
    const std::uint32_t half = count / 2;
    std::nth_element(begin, begin + half, begin + count, [k](const Box& a, const Box& b) {
      return a.low[k] + a.high[k] < b.low[k] + b.high[k];
    });
    hierarchy.nodes[at].first = static_cast<std::uint32_t>(hierarchy.nodes.size());
    hierarchy.nodes[at].count = 0;
    hierarchy.nodes.push_back({{}, first, half});
    hierarchy.nodes.push_back({{}, first + half, count - half});
  }
}

void CasterSearch::query(const Hierarchy& hierarchy, const Box& box,
                         std::vector<std::uint32_t>& found) {
  if (hierarchy.nodes.empty()) return;
  const auto meets = [&box](const Box& other) {
    return other.nearest <= box.farthest &&
           overlap(box.low[0], box.high[0], other.low[0], other.high[0]) &&
           overlap(box.low[1], box.high[1], other.low[1], other.high[1]);
  };
  pending_.assign(1, 0);
  while (!pending_.empty()) {
    const Node& node = hierarchy.nodes[pending_.back()];
    pending_.pop_back();
    if (!meets(node.bounds)) continue;
    if (node.count == 0) {
      pending_.push_back(node.first);
      pending_.push_back(node.first + 1);
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      if (meets(hierarchy.boxes[i])) found.push_back(hierarchy.boxes[i].part);
    }
  }
}

bool CasterSearch::may_shadow(std::uint32_t receiver, std::uint32_t caster) const {
  // Coplanar polygons do not shadow each other.
  if (view_.scene().parts[receiver].plane == view_.scene().parts[caster].plane) return false;
  const auto receiver_loop = view_.loop(receiver), caster_loop = view_.loop(caster);
  const LitPlane<double>&own = view_.plane(receiver), &other = view_.plane(caster);
  // The caster wholly behind the receiver's plane, or the receiver wholly before the caster's.
  const auto all = [this](std::span<const VertexId> loop, const auto& outside) {
    return std::all_of(loop.begin(), loop.end(),
                       [&](VertexId vertex) { return outside(view_.ray(vertex)); });
  };
  constexpr double kBound = LightView::kBound;
  if (all(caster_loop, [&](const Point<double>& x) { return own.at(x) < -kBound; }) ||
      all(receiver_loop, [&](const Point<double>& x) { return other.at(x) > kBound; })) {
    return false;
  }
  const auto separates = [&](std::span<const VertexId> edges, std::span<const VertexId> loop) {
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const Point<double> inward =
          cross(view_.ray(edges[i]), view_.ray(edges[i + 1 == edges.size() ? 0 : i + 1]));
      if (all(loop, [&](const Point<double>& x) { return dot(inward, x) < -kBound; })) return true;
    }
    return false;
  };
  return !separates(caster_loop, receiver_loop) && !separates(receiver_loop, caster_loop);
}

void CasterSearch::casters_of(std::uint32_t receiver, std::vector<std::uint32_t>& casters) {
  casters.clear();
  Box box;
  for (int face = 0; face < 6; ++face) {
    const Hierarchy& hierarchy = faces_[static_cast<std::size_t>(face)];
    if (!hierarchy.nodes.empty() && box_on_face(receiver, face, box)) {
      query(hierarchy, box, casters);
    }
  }
  std::sort(casters.begin(), casters.end());
  casters.erase(std::unique(casters.begin(), casters.end()), casters.end());
  std::erase_if(casters, [&](std::uint32_t caster) {
    return caster == receiver || !may_shadow(receiver, caster);
  });
}

}  // namespace gnomon::bench
