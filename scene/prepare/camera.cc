// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/scene/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace gnomon {
namespace {

using Vector = std::array<double, 3>;

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector times(double s, const Vector& v) { return {s * v[0], s * v[1], s * v[2]}; }
Vector unit(const Vector& v) { return times(1 / std::hypot(v[0], v[1], v[2]), v); }
double largest(const Vector& v) {
  return std::max({std::fabs(v[0]), std::fabs(v[1]), std::fabs(v[2])});
}

struct Axes {
  Vector right, up, forward;  // of unit length
};

Axes axes_of(const CameraView& view) {
  constexpr double kAlong = 1e-9;  // sine of the angle between up and the view
  Axes axes;
  axes.forward = unit(minus(view.look_at, view.eye));
  const double size = std::hypot(view.up[0], view.up[1], view.up[2]);
  const Vector up = size > 0 ? times(1 / size, view.up) : Vector{0, 0, 1};
  Vector right = cross(axes.forward, up);
  for (const Vector& other : {Vector{0, 1, 0}, Vector{1, 0, 0}}) {
    if (largest(right) < kAlong) right = cross(axes.forward, other);
  }
  axes.right = unit(right);
  axes.up = cross(axes.right, axes.forward);
  return axes;
}

Expected<void> check_raster(std::uint32_t width, std::uint32_t height) {
  if (width == 0 || height == 0) {
    return fail(ErrorCode::kUsage, "a picture without samples",
                "a width and a height of at least 1");
  }
  if (std::uint64_t{width} * height > ImageFrame::kMostSamples) {
    return fail(
        ErrorCode::kLimit,
        "a picture of " + std::to_string(width) + " x " + std::to_string(height) + " samples",
        "at most " + std::to_string(ImageFrame::kMostSamples));
  }
  return {};
}

Expected<void> check_frame(const ExactCamera& camera) {
  if (auto raster = check_raster(camera.width, camera.height); !raster) return raster;
  std::array<std::array<std::int64_t, 3>, 3> rows;
  std::size_t row = 0;
  for (const auto* vector : {&camera.right, &camera.up, &camera.forward}) {
    for (std::size_t k = 0; k < 3; ++k) {
      rows[row][k] = (*vector)[k];
      if (std::abs(rows[row][k]) > ImageFrame::kLargestComponent) {
        return fail(ErrorCode::kUsage,
                    "a camera's vector with a component of " + std::to_string(rows[row][k]),
                    "at most " + std::to_string(ImageFrame::kLargestComponent));
      }
    }
    ++row;
  }
  const auto& [r, u, f] = rows;
  const std::int64_t volume = r[0] * (u[1] * f[2] - u[2] * f[1]) -
                              r[1] * (u[0] * f[2] - u[2] * f[0]) +
                              r[2] * (u[0] * f[1] - u[1] * f[0]);
  if (volume == 0) {
    return fail(ErrorCode::kUsage,
                "the camera's right, up and forward, as integers of 16 bits, lie in a plane",
                "a field of view that is not so small or so wide");
  }
  return {};
}

}  // namespace

Expected<ExactCamera> make_camera(const Position& eye, const CameraView& view) {
  if (!(view.field_of_view > 0 && view.field_of_view < 180)) {
    return fail(ErrorCode::kUsage, "a field of view of " + std::to_string(view.field_of_view),
                "degrees, above 0 and below 180");
  }
  if (view.eye == view.look_at) {
    return fail(ErrorCode::kUsage, "the eye is at the point that it looks at",
                "two different points");
  }
  if (auto raster = check_raster(view.width, view.height); !raster) {
    return tl::unexpected(std::move(raster.error()));
  }
  const Axes axes = axes_of(view);
  const double slope = std::tan(view.field_of_view * std::numbers::pi / 360);
  const double longer = std::max(view.width, view.height);
  const Vector right = times(slope * view.width / longer, axes.right);
  const Vector up = times(slope * view.height / longer, axes.up);
  const double scale = ImageFrame::kLargestComponent /
                       std::max({largest(right), largest(up), largest(axes.forward)});
  const auto rounded = [&](const Vector& v) {
    std::array<std::int32_t, 3> result;
    for (std::size_t k = 0; k < 3; ++k) {
      result[k] = static_cast<std::int32_t>(std::lround(scale * v[k]));
    }
    return result;
  };
  ExactCamera camera{eye,        rounded(right), rounded(up), rounded(axes.forward),
                     view.width, view.height};
  if (auto checked = check_frame(camera); !checked) {
    return tl::unexpected(std::move(checked.error()));
  }
  return camera;
}

double fitting_field_of_view(const PreparedScene& scene, const CameraView& view) {
  constexpr double kMargin = 0.93, kWidest = 75;
  const Axes axes = axes_of(view);
  const double longer = std::max(view.width, view.height);
  double slope = 1e-3;
  for (const VertexId v : scene.loop_vertices) {
    const Vector d = minus(scene.geometry.positions[v], view.eye);
    const double depth = dot(d, axes.forward);
    if (!(depth > 0)) return kWidest;
    slope = std::max({slope, std::fabs(dot(d, axes.right)) / depth * longer / view.width,
                      std::fabs(dot(d, axes.up)) / depth * longer / view.height});
  }
  return std::min(kWidest, 2 * std::atan(slope / kMargin) * 180 / std::numbers::pi);
}

Expected<PreparedView> prepare_view(Scene scene, const ExactCamera& camera) {
  if (auto checked = check_frame(camera); !checked) {
    return tl::unexpected(std::move(checked.error()));
  }
  Light eye;
  eye.id = "eye";
  eye.position = camera.eye;
  scene.lights.push_back(std::move(eye));
  auto prepared = prepare(scene);
  if (!prepared) return tl::unexpected(std::move(prepared.error()));
  PreparedView view;
  view.frame.eye = prepared->lights.back().point;
  view.frame.right = camera.right;
  view.frame.up = camera.up;
  view.frame.forward = camera.forward;
  view.frame.width = camera.width;
  view.frame.height = camera.height;
  prepared->lights.pop_back();
  view.scene = *std::move(prepared);
  return view;
}

}  // namespace gnomon
