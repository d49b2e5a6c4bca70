// SPDX-License-Identifier: LGPL-3.0-or-later
// The way from a vertex to a far lamp in doubles: the apex of an edge's plane (edge_planes.h).
#ifndef GNOMON_ALGORITHMS_CONTOUR_FAR_APEX_H
#define GNOMON_ALGORITHMS_CONTOUR_FAR_APEX_H

#include <array>
#include <cmath>
#include <cstdint>

#include "algorithms/contour/numbers.h"
#include "kernel/implicit/light_integers.h"
#include "kernel/implicit/scaled_doubles.h"

namespace gnomon::contour_detail {

/// Of a far lamp: the way to it from vertices of a narrow grid, times 2^-light_bits, along its
/// axes.
class FarApex {
 public:
  FarApex(const LightIntegers& light, const Vector<double>& to_light)
      : light_(light),
        to_light_(to_light),
        nearness_(std::ldexp(1.0, -static_cast<int>(light.light_bits))) {
    const std::array<int, 3> axes{light.axes.x, light.axes.y, light.axes.z};
    constexpr unsigned kShort = 62, kDoubleBits = 53;
    for (std::size_t k = 0; k < 3; ++k) {
      const mpz_class& x = light.light.grid[static_cast<std::size_t>(axes[k])];
      axes_[k] = axes[k];
      if (bits_of(x) <= kShort) {
        how_[k] = How::kShort;
        short_[k] = x.get_si();
      } else {
        how_[k] = light.grid_bits() <= kDoubleBits ? How::kDoubles : How::kIntegers;
      }
    }
  }
  /// Each component off by 3.1u of itself: by u; by 2u and u, since the lamp's has 62 bits at least
  /// and the vertex's 53 at most; by 2u.
  Vector<double> operator()(VertexId v) const {
    const std::int64_t* p = light_.geometry->grid.narrow_point(v);
    Vector<double> result;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int64_t x = p[axes_[k]];
      switch (how_[k]) {
        case How::kShort:
          // |x| < 2^63 - 1 and |l| < 2^62: their difference may have 64 bits.
          result[k] = static_cast<double>(Int128{short_[k]} - x) * nearness_;
          break;
        case How::kDoubles:
          result[k] = to_light_[k] - static_cast<double>(x) * nearness_;
          break;
        case How::kIntegers:
          result[k] =
              to_double_scaled(mpz_class(light_.light.grid[static_cast<std::size_t>(axes_[k])] -
                                         static_cast<long>(x)),
                               static_cast<long>(light_.light_bits));
      }
    }
    return result;
  }

 private:
  enum class How : std::uint8_t { kShort, kDoubles, kIntegers };
  const LightIntegers& light_;
  Vector<double> to_light_;
  double nearness_;  // of a grid's step
  std::array<int, 3> axes_{};
  std::array<How, 3> how_{};
  std::array<std::int64_t, 3> short_{};
};

}  // namespace gnomon::contour_detail

#endif  // GNOMON_ALGORITHMS_CONTOUR_FAR_APEX_H
