// SPDX-License-Identifier: GPL-3.0-or-later
// A scene as seen from one point light: positions relative to it, and which parts face it. What
// every peer starts from.
//
// Exactness: `facing` is exact; coordinates are exact differences on the grid, scaled by one power
// of two into [-1, 1] and rounded once.
#ifndef GNOMON_BENCH_PEERS_LIGHT_VIEW_H
#define GNOMON_BENCH_PEERS_LIGHT_VIEW_H

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "gnomon/scene/prepare.h"

namespace gnomon::bench {

template <class Number>
using Point = std::array<Number, 3>;

template <class Number>
Point<Number> minus(const Point<Number>& a, const Point<Number>& b) {
  return {Number(a[0] - b[0]), Number(a[1] - b[1]), Number(a[2] - b[2])};
}
template <class Number>
Point<Number> cross(const Point<Number>& a, const Point<Number>& b) {
  return {Number(a[1] * b[2] - a[2] * b[1]), Number(a[2] * b[0] - a[0] * b[2]),
          Number(a[0] * b[1] - a[1] * b[0])};
}
template <class Number>
Number dot(const Point<Number>& a, const Point<Number>& b) {
  return Number(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
}

/// normal . x - offset, positive on the light's side; the light is the origin.
template <class Number>
struct LitPlane {
  Point<Number> normal{};
  Number offset{};
  Number at(const Point<Number>& x) const { return Number(dot(normal, x) - offset); }
};

class LightView {
 public:
  /// Rounded determinants of three rays, and values of rounded planes, are off by less than this.
  static constexpr double kBound = 0x1p-45;

  /// Requires: scene.lights[light] is a point light.
  LightView(const PreparedScene& scene, std::uint32_t light);

  const PreparedScene& scene() const { return *scene_; }
  /// Parts with a side that is seen from the light, in order: they receive.
  std::span<const std::uint32_t> facing() const { return facing_; }
  bool faces(std::uint32_t part) const { return faces_[part] != 0; }
  bool casts(std::uint32_t part) const { return faces(part) && scene_->parts[part].casts; }
  /// Vertices in the order in which r_a x r_b of consecutive rays points inward. Requires: faces().
  std::span<const VertexId> loop(std::uint32_t part) const {
    const Part& p = scene_->parts[part];
    return {loops_.data() + p.first, p.count};
  }
  const Point<double>& ray(VertexId vertex) const { return rays_[vertex]; }
  /// On the grid, relative to the light, unscaled.
  Point<mpz_class> exact_ray(VertexId vertex) const;
  /// Support plane in scaled coordinates. Requires: faces().
  const LitPlane<double>& plane(std::uint32_t part) const { return planes_[part]; }

 private:
  void look_at(std::uint32_t part);

  const PreparedScene* scene_;
  const LightPoint* light_;
  std::vector<Point<double>> rays_;
  std::vector<VertexId> loops_;
  std::vector<std::uint32_t> facing_;
  std::vector<std::uint8_t> faces_;
  std::vector<LitPlane<double>> planes_;
};

}  // namespace gnomon::bench

#endif  // GNOMON_BENCH_PEERS_LIGHT_VIEW_H
