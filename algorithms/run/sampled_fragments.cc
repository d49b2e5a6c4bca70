// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/run/sampled_fragments.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon {
namespace {

template <class T>
std::array<T, 3> minus(const std::array<T, 3>& a, const std::array<T, 3>& b) {
  return {T(a[0] - b[0]), T(a[1] - b[1]), T(a[2] - b[2])};
}
template <class T>
T dot(const std::array<T, 3>& a, const std::array<T, 3>& b) {
  return T(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
}
template <class T>
std::array<T, 3> cross(const std::array<T, 3>& a, const std::array<T, 3>& b) {
  return {T(a[1] * b[2] - a[2] * b[1]), T(a[2] * b[0] - a[0] * b[2]), T(a[0] * b[1] - a[1] * b[0])};
}
std::array<double, 3> rounded(const std::array<mpq_class, 3>& v) {
  return {v[0].get_d(), v[1].get_d(), v[2].get_d()};
}

/// Twice the area of a, b, p in two coordinates: positive where p is on the left of the way from a
/// to b.
template <class Point>
auto turn(const Point& a, const Point& b, const Point& p, std::size_t x, std::size_t y) {
  using Number = std::decay_t<decltype(a[0])>;
  return Number(Number(b[x] - a[x]) * Number(p[y] - a[y]) -
                Number(b[y] - a[y]) * Number(p[x] - a[x]));
}

}  // namespace

SampledFragments::SampledFragments(const PreparedScene& scene, const ImageFrame& frame,
                                   const ShadowResult& result)
    : scene_(scene), frame_(frame), result_(result), planes_(scene.parts.size()) {
  for (std::size_t k = 0; k < 3; ++k) {
    eye_[k] = scene.geometry.origin[k] + scene.geometry.step * frame.eye.grid[k];
  }
}

const SampledFragments::PlaneOf& SampledFragments::plane_of(std::uint32_t index) {
  PlaneOf& plane = planes_[index];
  if (plane.made) return plane;
  plane.made = true;
  const Part& part = scene_.parts[index];
  const Geometry& geometry = scene_.geometry;
  const auto at = [&](VertexId v) {
    Exact point;
    for (std::size_t k = 0; k < 3; ++k) {
      point[k] = geometry.origin[k] + geometry.step * geometry.grid.at(v, static_cast<int>(k));
    }
    return point;
  };
  const SupportTriple& triple = geometry.planes[part.plane];
  const Exact a = at(triple.a);
  plane.normal = cross(minus(at(triple.b), a), minus(at(triple.c), a));
  if (part.flipped) {
    for (mpq_class& n : plane.normal) n = -n;
  }
  plane.at_eye = dot(plane.normal, minus(eye_, a));
  plane.nearest_normal = rounded(plane.normal);
  plane.nearest_at_eye = plane.at_eye.get_d();
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (abs(plane.normal[k]) > abs(plane.normal[axis])) axis = k;
  }
  plane.x = static_cast<int>((axis + 1) % 3);
  plane.y = static_cast<int>((axis + 2) % 3);
  if (sgn(plane.normal[axis]) < 0) std::swap(plane.x, plane.y);
  return plane;
}

SampledFragments::Seen SampledFragments::point_at(const PlaneOf& plane, ImageSample sample) const {
  const ImageFrame::Direction d = frame_.direction(sample);
  Seen seen;
  if (result_.exact) {
    Exact along;
    for (std::size_t k = 0; k < 3; ++k) along[k] = static_cast<long>(d[k]);
    const mpq_class t = -plane.at_eye / dot(plane.normal, along);
    for (std::size_t k = 0; k < 3; ++k) seen.exact[k] = eye_[k] + t * along[k];
    seen.nearest = rounded(seen.exact);
    return seen;
  }
  std::array<double, 3> along;
  for (std::size_t k = 0; k < 3; ++k) along[k] = static_cast<double>(d[k]);
  const double t = -plane.nearest_at_eye / dot(plane.nearest_normal, along);
  for (std::size_t k = 0; k < 3; ++k) seen.nearest[k] = frame_.eye.nearest[k] + t * along[k];
  return seen;
}

double SampledFragments::depth_in(const LightResult& light, const Fragment& fragment,
                                  const PlaneOf& plane, bool back, const Seen& seen) const {
  double least = std::numeric_limits<double>::infinity();
  const std::size_t x = static_cast<std::size_t>(back ? plane.y : plane.x);
  const std::size_t y = static_cast<std::size_t>(back ? plane.x : plane.y);
  for (std::uint32_t i = 0; i < fragment.count; ++i) {
    const auto& a = light.points[fragment.first + i];
    const auto& b = light.points[fragment.first + (i + 1) % fragment.count];
    const double length = std::hypot(b[x] - a[x], b[y] - a[y]);
    if (length > 0) least = std::min(least, turn(a, b, seen.nearest, x, y) / length);
  }
  return least;
}

bool SampledFragments::holds(const LightResult& light, const Fragment& fragment,
                             const PlaneOf& plane, bool back, const Seen& seen) const {
  const std::size_t x = static_cast<std::size_t>(back ? plane.y : plane.x);
  const std::size_t y = static_cast<std::size_t>(back ? plane.x : plane.y);
  for (std::uint32_t i = 0; i < fragment.count; ++i) {
    const std::uint32_t from = fragment.first + i, to = fragment.first + (i + 1) % fragment.count;
    const auto &a = light.points[from], &b = light.points[to], &p = seen.nearest;
    const double value = turn(a, b, p, x, y);
    if (result_.exact) {
      // Coordinates are off by u of themselves, u = 2^-53, so that each difference is by 2u of the
      // largest and u of itself; the rest is for the products and their difference.
      double largest = 0, size = 0;
      for (const std::size_t k : {x, y}) {
        largest = std::max({largest, std::fabs(a[k]), std::fabs(b[k]), std::fabs(p[k])});
        size += std::fabs(b[k] - a[k]) + std::fabs(p[k] - a[k]);
      }
      constexpr double kUnit = 0x1p-53;
      if (std::fabs(value) <= 16 * kUnit * (largest + size) * (size + kUnit * largest)) {
        if (turn(light.exact_points[from], light.exact_points[to], seen.exact, x, y) < 0) {
          return false;
        }
        continue;
      }
    }
    if (value < 0) return false;
  }
  return true;
}

bool SampledFragments::reaches(const LightResult& light, const PartResult& of, const PlaneOf& plane,
                               const Seen& seen) const {
  const bool back = of.side == Side::kBack;
  const Fragment* found = nullptr;
  const Fragment* nearest = nullptr;
  double depth = -std::numeric_limits<double>::infinity();
  for (std::uint32_t f = 0; f < of.fragment_count; ++f) {
    const Fragment& fragment = light.fragments[of.first_fragment + f];
    if (holds(light, fragment, plane, back, seen)) {
      found = &fragment;
      if (light.cover == Cover::kPartition) break;
    } else if (!result_.exact) {
      const double own = depth_in(light, fragment, plane, back, seen);
      if (own > depth) {
        depth = own;
        nearest = &fragment;
      }
    }
  }
  if (found != nullptr) return found->state == LightState::kLit;
  if (light.background) return *light.background == LightState::kLit;
  return nearest != nullptr && nearest->state == LightState::kLit;
}

std::uint64_t SampledFragments::lights_at(std::uint32_t part, ImageSample sample) {
  const PlaneOf& plane = plane_of(part);
  const Side seen_side = sgn(plane.at_eye) > 0 ? Side::kFront : Side::kBack;
  std::uint64_t bits = 0;
  Seen seen;
  bool computed = false;
  for (std::size_t l = 0; l < result_.lights.size(); ++l) {
    const LightResult& light = result_.lights[l];
    const PartResult& of = light.parts[part];
    if (of.reason != ShadowReason::kNone || of.side != seen_side) continue;
    if (!computed) seen = point_at(plane, sample);
    computed = true;
    if (reaches(light, of, plane, seen)) bits |= std::uint64_t{1} << l;
  }
  return bits;
}

}  // namespace gnomon
