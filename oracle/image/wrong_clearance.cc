// SPDX-License-Identifier: GPL-3.0-or-later
// (a) The ray passes a part at a distance s from its border, in front of what is seen: the nearest
//     point of the border lies on an edge, in the half nearer to one of its ends, and moving that
//     end by at most 2 s carries the edge across the ray.
// (b) The same for the border of the part that is seen, from inside.
// (c) The ray meets a part at a distance s behind what is seen, along the normal of the latter: of
//     any triangulation of that part the triangle that is met has a corner of weight at least 1/3,
//     and moving it by 3 s moves the part behind.
#include "oracle/image/wrong_clearance.h"

#include <algorithm>
#include <cmath>

namespace gnomon::oracle {
namespace {

Double3 minus(const Double3& a, const Double3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
double length(const Double3& v) { return std::hypot(v[0], v[1], v[2]); }

double distance_to_segment(const Double3& p, const Double3& a, const Double3& b) {
  const Double3 way = minus(b, a), from = minus(p, a);
  const double square = dot_of(way, way);
  const double t = square > 0 ? std::clamp(dot_of(from, way) / square, 0.0, 1.0) : 0;
  return length({from[0] - t * way[0], from[1] - t * way[1], from[2] - t * way[2]});
}

/// A part in doubles, scene units.
struct Shape {
  std::vector<Double3> loop;
  Double3 normal{};
};

Shape shape_of(const PreparedScene& scene, const Part& part) {
  Shape shape;
  for (const VertexId v : scene.loop(part)) shape.loop.push_back(scene.geometry.positions[v]);
  const Double3 u = minus(shape.loop[1], shape.loop[0]), w = minus(shape.loop[2], shape.loop[0]);
  shape.normal = {u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]};
  const double size = length(shape.normal);
  if (size > 0) {
    for (double& x : shape.normal) x /= size;
  }
  return shape;
}

double distance_to_border(const Shape& shape, const Double3& p) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < shape.loop.size(); ++k) {
    least = std::min(
        least, distance_to_segment(p, shape.loop[k], shape.loop[(k + 1) % shape.loop.size()]));
  }
  return least;
}

bool holds(const Shape& shape, const Double3& p) {
  for (std::size_t k = 0; k < shape.loop.size(); ++k) {
    const Double3 way = minus(shape.loop[(k + 1) % shape.loop.size()], shape.loop[k]);
    const Double3 from = minus(p, shape.loop[k]);
    const Double3 turn{way[1] * from[2] - way[2] * from[1], way[2] * from[0] - way[0] * from[2],
                       way[0] * from[1] - way[1] * from[0]};
    if (dot_of(turn, shape.normal) < 0) return false;
  }
  return true;
}

}  // namespace

std::optional<double> clearance_of_view(const SampledView& view, const SeenParts& seen,
                                        const Seen& at, const SampleRay& ray) {
  const PreparedScene& scene = view.scene();
  Double3 eye;
  for (std::size_t k = 0; k < 3; ++k) {
    eye[k] = mpq_class(scene.geometry.origin[k] + scene.geometry.step * view.eye()[k]).get_d();
  }
  const auto hit = [&](const Shape& shape, double& t) {
    t = -dot_of(shape.normal, minus(eye, shape.loop[0])) / dot_of(shape.normal, ray.d);
    return Double3{eye[0] + t * ray.d[0], eye[1] + t * ray.d[1], eye[2] + t * ray.d[2]};
  };
  double least = std::numeric_limits<double>::infinity(), t_seen = least;
  Shape own;
  Double3 x{};
  if (at.part != Seen::kNothing) {
    own = shape_of(scene, scene.parts[at.part]);
    x = hit(own, t_seen);
    least = 2 * distance_to_border(own, x);
  }
  for (std::uint32_t p = 0; p < scene.parts.size(); ++p) {
    if (p == at.part || !seen.faces_eye(p)) continue;
    const Shape shape = shape_of(scene, scene.parts[p]);
    double t = 0;
    const Double3 y = hit(shape, t);
    if (!(t > 0) || !std::isfinite(t)) continue;
    if (!holds(shape, y)) {
      if (t <= t_seen) least = std::min(least, 2 * distance_to_border(shape, y));
    } else if (at.part != Seen::kNothing) {
      least = std::min(least, 3 * std::fabs(dot_of(own.normal, minus(y, x))));
    }
  }
  if (!std::isfinite(least)) return std::nullopt;
  return least * (1 + 1e-6);
}

}  // namespace gnomon::oracle
