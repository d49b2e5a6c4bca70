// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/angular_table/near_chart.h"

#include <cmath>

#include "scene/base/vectors.h"

namespace gnomon {

namespace {

struct NearPlane {
  NearPoint n, at;
};

NearPlane plane_of(const PreparedScene& scene, std::uint32_t part) {
  const SupportTriple& triple = scene.geometry.planes[scene.parts[part].plane];
  const auto& positions = scene.geometry.positions;
  const NearPoint a = positions[triple.a];
  return {cross(minus(positions[triple.b], a), minus(positions[triple.c], a)), a};
}

}  // namespace

NearPoint near_point(const PreparedScene& scene, const ImageFrame& frame, std::uint32_t part,
                     ImageSample sample) {
  const NearPlane plane = plane_of(scene, part);
  const ImageFrame::Direction d = frame.direction(sample);
  const NearPoint along{static_cast<double>(d[0]), static_cast<double>(d[1]),
                        static_cast<double>(d[2])};
  const NearPoint& eye = frame.eye.nearest;
  const double far = dot(plane.n, minus(plane.at, eye)) / dot(plane.n, along);
  return {eye[0] + far * along[0], eye[1] + far * along[1], eye[2] + far * along[2]};
}

NearChart::NearChart(const Geometry& geometry, const TableChart& chart, const LightPoint& light)
    : light_(light.nearest) {
  const std::array<const GridPlane*, 3> functions = {&chart.across, &chart.upwards, &chart.ahead};
  for (std::size_t k = 0; k < 3; ++k) {
    // A position is origin + step times its place on the grid.
    mpq_class d = geometry.step * functions[k]->d;
    for (std::size_t i = 0; i < 3; ++i) {
      d += geometry.origin[i] * functions[k]->n[i];
      n_[k][i] = functions[k]->n[i].get_d();
    }
    d_[k] = d.get_d();
  }
}

double NearChart::distance(const NearPoint& x) const {
  const NearPoint way = minus(x, light_);
  return std::sqrt(dot(way, way));
}

double NearChart::distance_of_plane(const PreparedScene& scene, std::uint32_t part, double s,
                                    double t) const {
  // The direction with these s and t, by the dual basis.
  const NearPoint of_s = cross(n_[1], n_[2]), of_t = cross(n_[2], n_[0]),
                  of_1 = cross(n_[0], n_[1]);
  NearPoint direction;
  for (std::size_t k = 0; k < 3; ++k) direction[k] = s * of_s[k] + t * of_t[k] + of_1[k];
  const NearPlane plane = plane_of(scene, part);
  const double far = dot(plane.n, minus(plane.at, light_)) / dot(plane.n, direction);
  return std::fabs(far) * std::sqrt(dot(direction, direction));
}

double linear_in_angle(double low, double first, double high, double second, double s) {
  const double begin = std::atan(low), end = std::atan(high);
  if (!(end > begin)) return first;
  return first + (second - first) * ((std::atan(s) - begin) / (end - begin));
}

}  // namespace gnomon
