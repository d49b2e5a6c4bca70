// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/shadow_polygons/clip_planes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace gnomon {

namespace {

using Integers = std::array<mpz_class, 3>;

/// Bits by which the grid is made finer: one step along `forward` is then a thousandth of the
/// distance at most.
unsigned finer_by(double step_of_forward, double near, double far) {
  unsigned bits = 0;
  for (const double distance : {near, far}) {
    if (distance <= 0) continue;
    bits = std::max(bits, static_cast<unsigned>(std::max(
                              0.0, std::ceil(std::log2(1024 * step_of_forward / distance)))));
  }
  return bits;
}

Integers corner(const Integers& eye, const ImageFrame& frame, const mpz_class& steps, int right,
                int up) {
  Integers result;
  for (std::size_t k = 0; k < 3; ++k) {
    result[k] = eye[k] + steps * frame.forward[k] + right * frame.right[k] + up * frame.up[k];
  }
  return result;
}

/// All that is on the grid, which is to be finer and to begin lower.
struct GridContents {
  std::vector<mpz_class> coordinates;
  std::vector<Integers*> lights;

  void make_finer(unsigned bits) {
    for (mpz_class& x : coordinates) x <<= bits;
    for (Integers* light : lights) {
      for (mpz_class& x : *light) x <<= bits;
    }
  }
  /// Moves the origin so that no coordinate of a vertex is negative; returns by how much.
  mpz_class make_positive() {
    mpz_class least = 0;
    for (const mpz_class& x : coordinates) least = std::min(least, x);
    for (const Integers* light : lights) {
      for (const mpz_class& x : *light) least = std::min(least, x);
    }
    for (mpz_class& x : coordinates) x -= least;
    for (Integers* light : lights) {
      for (mpz_class& x : *light) x -= least;
    }
    return least;
  }
};

}  // namespace

ClippedScene with_clip_planes(const PreparedScene& scene, const ImageFrame& frame, double near,
                              double far) {
  ClippedScene result{scene, frame, {}};
  Geometry& geometry = result.scene.geometry;
  GridContents contents;
  for (VertexId v = 0; v < geometry.grid.size(); ++v) {
    for (int k = 0; k < 3; ++k) contents.coordinates.push_back(geometry.grid.at(v, k));
  }
  contents.lights.push_back(&result.frame.eye.grid);
  for (PreparedLight& light : result.scene.lights) {
    if (light.is_point()) contents.lights.push_back(&light.point.grid);
  }
  const auto& f = frame.forward;
  const double forward = geometry.step.get_d() * std::hypot(f[0], f[1], f[2]);
  const unsigned bits = finer_by(forward, near, far);
  contents.make_finer(bits);
  geometry.step >>= bits;
  const Integers eye = result.frame.eye.grid;
  const auto add_plane = [&](double distance) {
    if (distance <= 0) return PlaneRef();
    const mpz_class steps(
        std::max(1.0, std::round(std::ldexp(distance / forward, static_cast<int>(bits)))));
    const auto first = static_cast<VertexId>(contents.coordinates.size() / 3);
    // Counter-clockwise seen from the eye.
    for (const auto& [right, up] : {std::pair{0, 0}, {1, 0}, {0, 1}}) {
      for (const mpz_class& x : corner(eye, frame, steps, right, up))
        contents.coordinates.push_back(x);
    }
    geometry.planes.push_back({first, first + 1, first + 2});
    return PlaneRef(static_cast<PlaneId>(geometry.planes.size() - 1));
  };
  result.planes.near = add_plane(near);
  result.planes.far = add_plane(far);
  const mpz_class moved = contents.make_positive();
  for (mpq_class& x : geometry.origin) x += geometry.step * moved;
  const std::size_t known = geometry.positions.size();
  geometry.grid = GridPositions::from(std::move(contents.coordinates));
  result.scene.position_bits = geometry.grid.bits();
  for (VertexId v = static_cast<VertexId>(known); v < geometry.grid.size(); ++v) {
    std::array<double, 3>& position = geometry.positions.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      position[k] =
          mpq_class(geometry.origin[k] + geometry.step * geometry.grid.at(v, static_cast<int>(k)))
              .get_d();
    }
    ++geometry.light_vertices;
  }
  return result;
}

}  // namespace gnomon
