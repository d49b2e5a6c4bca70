// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/svbsp/balanced_prefix.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "algorithms/partition/box.h"
#include "algorithms/partition/chart_split.h"
#include "algorithms/partition/kd_tree.h"

namespace gnomon {
namespace {

constexpr std::size_t kFewest = 64;  // parts below which a prefix costs more than it gives
constexpr std::size_t kLeafSize = 8;

using Point = std::array<double, 3>;

/// Keeps the part of a convex polygon of directions with n . q >= 0 (Sutherland & Hodgman).
void clip(std::vector<Point>& polygon, const Point& n, std::vector<Point>& workspace) {
  workspace.clear();
  const auto value = [&](const Point& p) { return n[0] * p[0] + n[1] * p[1] + n[2] * p[2]; };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point& p = polygon[i];
    const Point& r = polygon[(i + 1) % polygon.size()];
    const double at_p = value(p), at_r = value(r);
    if (at_p >= 0) workspace.push_back(p);
    if ((at_p < 0) != (at_r < 0)) {
      const double t = at_p / (at_p - at_r);
      workspace.push_back(
          {p[0] + t * (r[0] - p[0]), p[1] + t * (r[1] - p[1]), p[2] + t * (r[2] - p[2])});
    }
  }
  polygon.swap(workspace);
}

class Planner {
 public:
  Planner(const PreparedScene& scene, const LightPoint& light) : scene_(scene), light_(light) {
    if (light.directional) {
      double largest = 0;
      for (int k = 0; k < 3; ++k) largest = std::max(largest, std::fabs(light.nearest[k]));
      for (int k = 0; k < 3; ++k) direction_[k] = light.nearest[k] / largest;
    }
    const Geometry& geometry = scene.geometry;
    for (int k = 0; k < 3; ++k) origin_[k] = geometry.origin[k].get_d();
    bits_ = geometry.grid.bits();
    extent_ = mpq_class(geometry.step * mpq_class(mpz_class(1) << bits_)).get_d();
    axes_ = LightAxes::of(light);
  }

  PrefixTree plan(std::span<const std::uint32_t> parts) {
    if (light_.directional) {
      const int z = direction_[axes_.z] < 0 ? -1 : 1;
      grow(parts, {}, {0, 1, 2, z}, PrefixNode::kLeaf, true);
    } else {
      plan_sectors(parts);
    }
    return std::move(tree_);
  }

 private:
  // Cuts light space into the four wedges between the planes x = y and x = -y: in each of them,
  // either |x| or |y| is the larger one.
  void plan_sectors(std::span<const std::uint32_t> parts) {
    const std::int32_t a = add({{1, -1, 0}}, PrefixNode::kLeaf, true);  // x > y in front
    for (const bool a_front : {true, false}) {
      const std::int32_t b = add({{1, 1, 0}}, a, a_front);  // x > -y in front
      for (const bool b_front : {true, false}) {
        const bool x_rules = a_front == b_front;
        const int sign = a_front ? (b_front ? 1 : -1) : (b_front ? 1 : -1);
        const int major = x_rules ? 0 : 1;
        std::vector<Point> wedge = {{a_front ? 1.0 : -1.0, a_front ? -1.0 : 1.0, 0},
                                    {b_front ? 1.0 : -1.0, b_front ? 1.0 : -1.0, 0}};
        plan_wedge(parts, wedge, major, sign, b, b_front);
      }
    }
  }

  // Cuts a wedge by the planes z = s and z = -s, where s = sign * component `major` is the largest
  // of
  // +-x and +-y, and grows a tree in each of the three regions.
  void plan_wedge(std::span<const std::uint32_t> parts, const std::vector<Point>& wedge, int major,
                  int sign, std::int32_t parent, bool front) {
    PrefixPlane above, below;
    above.n[major] = sign;
    above.n[2] = -1;  // s - z
    below.n[major] = sign;
    below.n[2] = 1;  // s + z
    const auto real = [](const PrefixPlane& p, double factor) {
      return Point{factor * p.n[0].get_d(), factor * p.n[1].get_d(), factor * p.n[2].get_d()};
    };
    const std::int32_t first = add(above, parent, front);
    auto region = wedge;
    region.push_back(real(above, -1));  // z > s: around the z axis
    grow(parts, region, {0, 1, 2, 1}, first, false);
    const std::int32_t second = add(below, first, true);
    region = wedge;
    region.push_back(real(below, -1));  // -z > s
    grow(parts, region, {0, 1, 2, -1}, second, false);
    region = wedge;
    region.push_back(real(above, 1));
    region.push_back(real(below, 1));
    grow(parts, region, {2, 1 - major, major, sign}, second, true);
  }

  std::int32_t add(const PrefixPlane& plane, std::int32_t parent, bool front) {
    const auto index = static_cast<std::int32_t>(tree_.nodes.size());
    PrefixNode node;
    node.plane = plane;
    tree_.nodes.push_back(node);
    if (parent != PrefixNode::kLeaf) {
      PrefixNode& above = tree_.nodes[static_cast<std::size_t>(parent)];
      (front ? above.front : above.back) = index;
    }
    return index;
  }

  Point direction_to(VertexId v) const {
    const auto& scene_units = scene_.geometry.positions[v];
    Point p;
    if (!light_.directional) {
      for (int k = 0; k < 3; ++k) p[k] = light_.nearest[k] - scene_units[k];
      return p;
    }
    for (int k = 0; k < 3; ++k) p[k] = (scene_units[k] - origin_[k]) / extent_;
    const auto [x, y, z] = axes_;
    const Point& d = direction_;
    return {p[x] * d[z] - p[z] * d[x], p[y] * d[z] - p[z] * d[y], d[z]};
  }

  /// The boxes of the parts' directions from the light, clipped to the region, in its chart; the
  /// third axis is not used.
  std::vector<Box> chart_boxes(std::span<const std::uint32_t> parts,
                               const std::vector<Point>& region, const LightChart& chart) const {
    const auto [u, v, w, sign] = chart;
    std::vector<Box> boxes;
    std::vector<Point> polygon, workspace;
    for (const std::uint32_t index : parts) {
      polygon.clear();
      for (const VertexId vertex : scene_.loop(scene_.parts[index])) {
        polygon.push_back(direction_to(vertex));
      }
      for (const auto& n : region) {
        if (!polygon.empty()) clip(polygon, n, workspace);
      }
      Box box;
      for (const Point& p : polygon) {
        if (sign * p[w] > 0) box.add(Point{p[u] / p[w], p[v] / p[w], 0});
      }
      if (box.low[0] <= box.high[0] && std::isfinite(box.low[0]) && std::isfinite(box.high[0]) &&
          std::isfinite(box.low[1]) && std::isfinite(box.high[1])) {
        boxes.push_back(box);
      }
    }
    return boxes;
  }

  /// A k-d tree of the region's chart.
  void grow(std::span<const std::uint32_t> parts, const std::vector<Point>& region,
            const LightChart& chart, std::int32_t parent, bool front) {
    // Values below 8 keep the coefficients of planes small.
    const KdRules rules{
        .axes = 2, .least = -8, .most = 8, .touching_counts = false, .leaf_size = kLeafSize};
    grow_kd_tree(
        chart_boxes(parts, region, chart), rules, parent, front,
        [&](const KdSplit& split, std::int32_t above, bool is_front) {
          const ChartSplit chart_split{
              split.axis, split.value,
              static_cast<std::int64_t>(std::ldexp(split.value, KdSplit::kBits)), KdSplit::kBits};
          return add(plane_of(chart_split, chart, light_.directional, bits_), above, is_front);
        });
  }

  const PreparedScene& scene_;
  const LightPoint& light_;
  Point direction_{};  // scaled so that the largest component is +-1
  Point origin_{};
  double extent_ = 1;
  unsigned bits_ = 0;
  LightAxes axes_;
  PrefixTree tree_;
};

}  // namespace

PrefixTree plan_prefix(const PreparedScene& scene, const LightPoint& light,
                       std::span<const std::uint32_t> parts) {
  if (parts.size() < kFewest) return {};
  return Planner(scene, light).plan(parts);
}

}  // namespace gnomon
