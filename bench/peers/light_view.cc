// SPDX-License-Identifier: GPL-3.0-or-later
#include "peers/light_view.h"

#include <algorithm>
#include <cmath>

#include "kernel/numbers/exact_integer.h"

namespace gnomon::bench {

LightView::LightView(const PreparedScene& scene, std::uint32_t light)
    : scene_(&scene),
      light_(&scene.lights[light].point),
      loops_(scene.loop_vertices),
      faces_(scene.parts.size(), 0),
      planes_(scene.parts.size()) {
  const GridPositions& grid = scene.geometry.grid;
  std::size_t bits = scene.position_bits;
  for (const mpz_class& at : light_->grid) {
    bits = std::max(bits, mpz_sizeinbase(at.get_mpz_t(), 2));
  }
  const auto shift = static_cast<long>(bits) + 1;
  rays_.resize(grid.size());
  const bool small = bits <= GridPositions::kNarrowBits && grid.is_narrow();
  for (VertexId v = 0; v < rays_.size(); ++v) {
    for (int k = 0; k < 3; ++k) {
      const mpz_class& at = light_->grid[static_cast<std::size_t>(k)];
      rays_[v][static_cast<std::size_t>(k)] =
          small ? std::ldexp(static_cast<double>(grid.narrow(v, k) - at.get_si()),
                             -static_cast<int>(shift))
                : to_double_scaled(mpz_class(grid.at(v, k) - at), shift);
    }
  }
  for (std::uint32_t part = 0; part < scene.parts.size(); ++part) look_at(part);
}

Point<mpz_class> LightView::exact_ray(VertexId vertex) const {
  const GridPositions& grid = scene_->geometry.grid;
  return {grid.at(vertex, 0) - light_->grid[0], grid.at(vertex, 1) - light_->grid[1],
          grid.at(vertex, 2) - light_->grid[2]};
}

void LightView::look_at(std::uint32_t part) {
  const Part& p = scene_->parts[part];
  const std::span<VertexId> loop{loops_.data() + p.first, p.count};
  // Negative: the loop is counter-clockwise seen from the light, for rays lead away from it.
  const double volume = dot(rays_[loop[0]], cross(rays_[loop[1]], rays_[loop[2]]));
  int sign = volume > kBound ? 1 : volume < -kBound ? -1 : 0;
  if (sign == 0) {
    sign = static_cast<int>(
        sign_of_determinant<mpz_class>(exact_ray(loop[0]), exact_ray(loop[1]), exact_ray(loop[2])));
  }
  if (sign == 0 || (sign > 0 && !p.two_sided)) return;
  faces_[part] = 1;
  facing_.push_back(part);
  if (sign < 0) std::reverse(loop.begin(), loop.end());
  // Newell's sum, from the first vertex; clockwise seen from the light, so it points away.
  Point<double> away{};
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    const Point<double> corner =
        cross(minus(rays_[loop[i]], rays_[loop[0]]), minus(rays_[loop[i + 1]], rays_[loop[0]]));
    for (std::size_t k = 0; k < 3; ++k) away[k] += corner[k];
  }
  LitPlane<double>& plane = planes_[part];
  plane.normal = {-away[0], -away[1], -away[2]};
  plane.offset = dot(plane.normal, rays_[loop[0]]);
}

}  // namespace gnomon::bench
