// SPDX-License-Identifier: GPL-3.0-or-later
// Embree: shadow rays from the light to points on the polygons that face it, until the relative
// standard error of the whole lit area is 1e-4. Every triangle of every receiver is cut into k^2
// equal ones, about as large everywhere; two points in each tell the variance. A first pass says
// how many are needed (the error of such a sampling falls as n^-3/4). Only polygons that cast are
// built in. One thread, packets of eight coherent rays.
#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "machine.h"
#include "peers/light_view.h"
#include "peers/peer.h"
#include "scene/base/random.h"
#include "table.h"

namespace gnomon::bench {
namespace {

constexpr double kRelativeError = 1e-4;
/// Rays end this share of their length before the receiver, so as not to hit it.
constexpr float kClearance = 1e-5f;
constexpr double kFirstStrata = 1 << 16;

struct Triangle {
  Point<double> a, u, v;  // a, a + u, a + v; the light is the origin
  double area;            // scene units squared
};

class EmbreeScene {
 public:
  explicit EmbreeScene(const LightView& view, const std::vector<Point<double>>& positions)
      : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
    std::vector<std::uint32_t> indices;
    for (const std::uint32_t part : view.facing()) {
      if (!view.casts(part)) continue;
      const auto loop = view.loop(part);
      for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
        indices.insert(indices.end(), {loop[0], loop[i], loop[i + 1]});
      }
    }
    RTCGeometry mesh = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), positions.size()));
    auto* triangles = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), indices.size() / 3));
    if (vertices == nullptr || triangles == nullptr) stop();
    for (const Point<double>& position : positions) {
      for (const double coordinate : position) *vertices++ = static_cast<float>(coordinate);
    }
    std::copy(indices.begin(), indices.end(), triangles);
    rtcCommitGeometry(mesh);
    rtcAttachGeometry(scene_, mesh);
    rtcReleaseGeometry(mesh);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
    rtcCommitScene(scene_);
    if (rtcGetDeviceError(device_) != RTC_ERROR_NONE) stop();
    rtcInitIntersectContext(&context_);
    context_.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  }
  ~EmbreeScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  /// Whether each of the points is lit, as 0 or 1.
  void trace(const std::array<Point<float>, 8>& points, std::array<int, 8>& lit) {
    RTCRay8 rays{};
    alignas(32) std::array<int, 8> valid;
    for (std::size_t i = 0; i < 8; ++i) {
      rays.dir_x[i] = points[i][0];
      rays.dir_y[i] = points[i][1];
      rays.dir_z[i] = points[i][2];
      rays.tfar[i] = 1 - kClearance;
      rays.mask[i] = ~0u;
      valid[i] = -1;
    }
    rtcOccluded8(valid.data(), scene_, &context_, &rays);
    // An occluded ray ends at minus infinity.
    for (std::size_t i = 0; i < 8; ++i) lit[i] = rays.tfar[i] >= 0 ? 1 : 0;
  }

 private:
  [[noreturn]] static void stop() {
    fmt::print(stderr, "gnomon_bench: Embree could not build the scene\n");
    std::exit(2);
  }

  RTCDevice device_;
  RTCScene scene_;
  RTCIntersectContext context_{};
};

struct Estimate {
  double lit_area = 0, variance = 0;
  std::uint64_t rays = 0;
};

double uniform(Random& random) { return static_cast<double>(random.next() >> 11) * 0x1p-53; }

/// `strata_of`: into so many triangles a side each one is cut.
template <class StrataOf>
Estimate sample(EmbreeScene& scene, const std::vector<Triangle>& triangles,
                const StrataOf& strata_of, Random& random) {
  Estimate estimate;
  std::array<Point<float>, 8> points{};
  std::array<int, 8> lit{};
  std::array<double, 4> areas{};  // of the strata in the packet: two rays each
  std::size_t filled = 0;
  const auto flush = [&] {
    if (filled == 0) return;
    scene.trace(points, lit);
    for (std::size_t i = 0; i < filled; ++i) {
      const int first = lit[2 * i], second = lit[2 * i + 1];
      estimate.lit_area += areas[i] * (first + second) / 2;
      if (first != second) estimate.variance += areas[i] * areas[i] / 4;
    }
    estimate.rays += 2 * filled;
    filled = 0;
  };
  for (const Triangle& triangle : triangles) {
    const std::int64_t k = strata_of(triangle);
    const double side = 1 / static_cast<double>(k), area = triangle.area * side * side;
    for (std::int64_t row = 0; row < k; ++row) {
      // Upright and, between them, inverted triangles.
      for (std::int64_t column = 0; column < 2 * (k - row) - 1; ++column) {
        const bool inverted = column % 2 == 1;
        for (std::size_t ray = 0; ray < 2; ++ray) {
          double s = uniform(random), t = uniform(random);
          if ((s + t > 1) != inverted) {
            s = 1 - s;
            t = 1 - t;
          }
          s = (s + static_cast<double>(column / 2)) * side;
          t = (t + static_cast<double>(row)) * side;
          for (std::size_t axis = 0; axis < 3; ++axis) {
            points[2 * filled + ray][axis] =
                static_cast<float>(triangle.a[axis] + s * triangle.u[axis] + t * triangle.v[axis]);
          }
        }
        areas[filled] = area;
        if (++filled == 4) flush();
      }
    }
  }
  flush();
  return estimate;
}

/// Positions as seen from the lamp.
std::vector<Point<double>> seen_from_lamp(const PreparedScene& scene, std::uint32_t light) {
  std::vector<Point<double>> positions;
  for (const std::array<double, 3>& position : scene.geometry.positions) {
    positions.push_back(minus(position, scene.lights[light].point.nearest));
  }
  return positions;
}

/// Those of all parts that face the lamp.
std::vector<Triangle> triangles_of(const LightView& view,
                                   const std::vector<Point<double>>& positions) {
  std::vector<Triangle> triangles;
  for (const std::uint32_t part : view.facing()) {
    const auto loop = view.loop(part);
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
      Triangle triangle{positions[loop[0]], minus(positions[loop[i]], positions[loop[0]]),
                        minus(positions[loop[i + 1]], positions[loop[0]]), 0};
      const Point<double> normal = cross(triangle.u, triangle.v);
      triangle.area = std::sqrt(dot(normal, normal)) / 2;
      triangles.push_back(triangle);
    }
  }
  return triangles;
}

}  // namespace

PeerResult run_embree_rays(const PreparedScene& scene, std::uint32_t light) {
  const double start = cpu_seconds();
  const LightView view(scene, light);
  const std::vector<Point<double>> positions = seen_from_lamp(scene, light);
  EmbreeScene embree(view, positions);
  Random random(1);
  // Two rays in each of 32^2 triangles, and a quadrangle is two of these.
  const auto strata = [](const Triangle&) { return std::int64_t{32}; };
  const Estimate estimate = sample(embree, triangles_of(view, positions), strata, random);
  PeerResult result;
  result.lit_area = estimate.lit_area;
  result.seconds = cpu_seconds() - start;
  result.work = grouped(estimate.rays) + " rays";
  return result;
}

PeerResult run_embree(const PreparedScene& scene, std::uint32_t light) {
  const double start = cpu_seconds();
  const LightView view(scene, light);
  const std::vector<Point<double>> positions = seen_from_lamp(scene, light);
  EmbreeScene embree(view, positions);
  const std::vector<Triangle> triangles = triangles_of(view, positions);
  double total_area = 0;
  for (const Triangle& triangle : triangles) total_area += triangle.area;
  Random random(1);
  double strata = kFirstStrata;
  std::uint64_t rays = 0;
  PeerResult result;
  for (;;) {
    const double stratum_area = total_area / strata;
    const auto strata_of = [&](const Triangle& triangle) {
      return static_cast<std::int64_t>(std::ceil(std::sqrt(triangle.area / stratum_area)));
    };
    const Estimate estimate = sample(embree, triangles, strata_of, random);
    rays += estimate.rays;
    const double error = std::sqrt(estimate.variance) / estimate.lit_area;
    if (estimate.lit_area == 0 || error <= kRelativeError) {
      result.lit_area = estimate.lit_area;
      break;
    }
    // A little more than is needed, so that the next pass is the last.
    strata *= 1.1 * std::pow(error / kRelativeError, 4.0 / 3);
  }
  result.seconds = cpu_seconds() - start;
  result.work = grouped(rays) + " rays";
  return result;
}

}  // namespace gnomon::bench
