// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/intent/near_planes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "scene/base/parallel.h"

namespace gnomon::scene_detail {

namespace {

/// Parts that differ more in direction are in different planes however small they are.
constexpr double kLeastCosine = 0.9998;  // 1.1 degrees

struct PartPlane {
  Vector normal;  // unit, of the part's front
  Vector point;   // the loop's first
};

/// For a quick look: most parts that meet are at an angle.
struct PartDirection {
  double x, y, z;  // the unit normal
  double area;
};

PartPlane plane_of(const PreparedScene& scene, const LocalPoints& points, const Part& part) {
  const auto loop = scene.loop(part);
  const Vector area = points.area_vector(loop);
  return {(1 / length_of(area)) * area, points[loop[0]]};
}

PartDirection direction_of_part(const PreparedScene& scene, const LocalPoints& points,
                                const Part& part) {
  const Vector area = points.area_vector(scene.loop(part));
  const auto x = static_cast<double>(area.x), y = static_cast<double>(area.y),
             z = static_cast<double>(area.z);
  const double length = std::sqrt(x * x + y * y + z * z);
  return {x / length, y / length, z / length, length / 2};
}

/// The part of the first loop whose projection along the second's normal lies in the second: both
/// are convex.
std::vector<Vector> overlap_of(const PreparedScene& scene, const LocalPoints& points,
                               const Part& part, const Part& other, const PartPlane& plane) {
  std::vector<Vector> loop, next;
  for (const VertexId vertex : scene.loop(part)) loop.push_back(points[vertex]);
  const auto clip = scene.loop(other);
  for (std::size_t i = 0; i < clip.size() && !loop.empty(); ++i) {
    const Vector from = points[clip[i]];
    const Vector inwards =
        cross_of(plane.normal, points[clip[i + 1 == clip.size() ? 0 : i + 1]] - from);
    next.clear();
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Vector &a = loop[k], &b = loop[k + 1 == loop.size() ? 0 : k + 1];
      const long double at_a = dot_of(inwards, a - from), at_b = dot_of(inwards, b - from);
      if (at_a >= 0) next.push_back(a);
      if ((at_a > 0 && at_b < 0) || (at_a < 0 && at_b > 0)) {
        next.push_back(a + (at_a / (at_a - at_b)) * (b - a));
      }
    }
    std::swap(loop, next);
  }
  return loop;
}

long double area_of(const std::vector<Vector>& loop) {
  Vector sum;
  for (std::size_t i = 2; i < loop.size(); ++i) {
    sum = sum + cross_of(loop[i - 1] - loop[0], loop[i] - loop[0]);
  }
  return length_of(sum) / 2;
}

class NearPlanes {
 public:
  NearPlanes(const PreparedScene& scene, const LocalPoints& points, double near)
      : scene_(scene), points_(points), near_(near), directions_(scene.parts.size()) {
    for_each_piece(directions_.size(), kPieceOfPolygons, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        directions_[i] = direction_of_part(scene_, points_, scene_.parts[i]);
      }
    });
  }

  /// Appends the pair of two parts whose boxes meet, if they are one.
  void look_at(std::uint32_t i, std::uint32_t j, std::vector<NearlyCoplanarPair>& pairs) const {
    const Part &a = scene_.parts[i], &b = scene_.parts[j];
    if (a.plane == b.plane || a.polygon == b.polygon) return;
    const PartDirection &n = directions_[i], &m = directions_[j];
    if (std::abs(n.x * m.x + n.y * m.y + n.z * m.z) < kLeastCosine) return;
    const bool first_is_smaller = n.area <= m.area;
    measure(first_is_smaller ? i : j, first_is_smaller ? j : i, pairs);
  }

 private:
  void measure(std::uint32_t small, std::uint32_t large,
               std::vector<NearlyCoplanarPair>& pairs) const {
    const Part& part = scene_.parts[small];
    const PartPlane own = plane_of(scene_, points_, part),
                    plane = plane_of(scene_, points_, scene_.parts[large]);
    const auto overlap = overlap_of(scene_, points_, part, scene_.parts[large], plane);
    if (overlap.size() < 3) return;
    long double distance = 0;
    for (const Vector& point : overlap) {
      const long double at = dot_of(plane.normal, point - plane.point);
      if (!(std::abs(at) <= near_)) return;
      if (std::abs(at) > std::abs(distance)) distance = at;
    }
    // Neighbours overlap by slivers where an edge is not quite the other's.
    long double longest = 0;
    for (const Vector& point : overlap) {
      longest = std::max(longest, length_of(point - overlap[0]));
    }
    const long double area = area_of(overlap);
    if (!(area > 4 * near_ * longest)) return;
    constexpr long double kDegrees = 180 / std::numbers::pi_v<long double>;
    const long double sine = length_of(cross_of(own.normal, plane.normal));
    pairs.push_back({part.polygon, scene_.parts[large].polygon, static_cast<double>(distance),
                     static_cast<double>(std::asin(std::min(sine, 1.0L)) * kDegrees),
                     static_cast<double>(area)});
  }

  const PreparedScene& scene_;
  const LocalPoints& points_;
  const long double near_;
  std::vector<PartDirection> directions_;
};

/// One pair for two polygons, whatever their parts are.
void join_parts(std::vector<NearlyCoplanarPair>& pairs) {
  const auto name = [](const NearlyCoplanarPair& pair) {
    return std::pair(std::min(pair.polygon, pair.other), std::max(pair.polygon, pair.other));
  };
  std::ranges::stable_sort(pairs, {}, name);
  std::size_t kept = 0;
  for (const NearlyCoplanarPair& pair : pairs) {
    NearlyCoplanarPair* const last = kept == 0 ? nullptr : &pairs[kept - 1];
    if (last == nullptr || name(*last) != name(pair)) {
      pairs[kept++] = pair;
      continue;
    }
    const double overlap = last->overlap + pair.overlap;
    const double angle = std::max(last->angle, pair.angle);
    if (std::abs(pair.distance) > std::abs(last->distance)) *last = pair;
    last->overlap = overlap;
    last->angle = angle;
  }
  pairs.resize(kept);
}

}  // namespace

std::vector<Box> boxes_of_parts(const PreparedScene& scene, const LocalPoints& points,
                                double near) {
  std::vector<Box> boxes(scene.parts.size());
  for_each_piece(boxes.size(), kPieceOfPolygons, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      boxes[i] = Box::empty();
      for (const VertexId vertex : scene.loop(scene.parts[i])) {
        const Vector point = points[vertex];
        for (int k = 0; k < 3; ++k) {
          const auto at = static_cast<double>(point[k]);
          boxes[i].add(k, at - near, at + near);
        }
      }
    }
  });
  return boxes;
}

std::vector<NearlyCoplanarPair> find_nearly_coplanar(const PreparedScene& scene,
                                                     const LocalPoints& points,
                                                     const std::vector<Box>& boxes,
                                                     const BoxTree& tree, double near) {
  const NearPlanes planes(scene, points, near);
  std::vector<NearlyCoplanarPair> all;
  for (auto& piece :
       map_pieces(boxes.size(), kPieceOfPolygons, [&](std::size_t begin, std::size_t end) {
         std::vector<NearlyCoplanarPair> pairs;
         for (std::size_t i = begin; i < end; ++i) {
           const auto self = static_cast<std::uint32_t>(i);
           tree.for_each_that_meets(boxes[i], [&](std::uint32_t other) {
             if (other > self) planes.look_at(self, other, pairs);
           });
         }
         return pairs;
       })) {
    all.insert(all.end(), piece.begin(), piece.end());
  }
  join_parts(all);
  return all;
}

}  // namespace gnomon::scene_detail
