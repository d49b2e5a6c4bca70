// SPDX-License-Identifier: LGPL-3.0-or-later
// Direct diffuse illumination of single points, with a certified bound of its error: the 1992
// paper's contour integral over the parts of an area light that are visible from the point, and the
// cosine law for point and directional lights.
//
// Guarantee: what is visible is decided exactly (visible_light.h); the integral is evaluated first
// in doubles that carry bounds, and where these do not suffice with MPFR at growing precision on
// exact coordinates, until the relative error asked for is met. Docs: illumination.md. Reference:
// Chin & Feiner, Fast object-precision shadow generation for area light sources using BSP trees
// (1992), "Diffuse illumination equation"; T. Nishita, E. Nakamae, SIGGRAPH 1985.
#ifndef GNOMON_ALGORITHMS_ILLUMINATION_H
#define GNOMON_ALGORITHMS_ILLUMINATION_H

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <memory>

#include "gnomon/kernel/sign.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

/// |true value - value| <= error_bound, proven. Unit: that of the light's intensity, times
/// 1: area light, I/2 sum alpha cos(beta), which is pi I under a sky of light;
/// scene units^-2: point light, I cos(theta) / r^2; 1: directional light, I cos(theta).
struct Illumination {
  double value = 0;
  double error_bound = 0;
};

/// How the answers of one Illuminator came about; see Illuminator::counts.
struct IlluminationCounts {
  std::uint64_t in_doubles = 0;    // the integral in doubles met the error asked for
  std::uint64_t in_mpfr = 0;       // MPFR had to do it
  std::uint64_t dark = 0;          // nothing visible: exactly 0
  std::uint64_t exact_signs = 0;   // decisions that doubles could not make
  std::uint64_t signs = 0;         // all decisions of the clipping
  std::uint64_t casters = 0;       // casters that the clipping looked at
  std::uint64_t largest_bits = 0;  // precision of MPFR
};

class Illuminator {
 public:
  /// The smallest relative error that a double can promise; smaller ones are taken as this.
  static constexpr double kLeastRelativeError = 0x1p-51;

  /// Keeps a reference to the scene. `light` is an index into PreparedScene::lights. Cost: O(n log
  /// n) for n parts. Requires: intensity finite and not negative, relative_error positive.
  Illuminator(const PreparedScene& scene, std::uint32_t light, double intensity,
              double relative_error = 1e-9);
  ~Illuminator();
  Illuminator(Illuminator&&) noexcept;
  Illuminator& operator=(Illuminator&&) noexcept;

  /// Illumination of a point of a part's plane (scene units, exact), seen from that side.
  /// `unobstructed`: the point is lit, casters need not be asked. The result's error_bound is at
  /// most relative_error times the true value. A value too small for a double (below 2^-1022) has
  /// an absolute bound only. Thread-safe.
  ///
  /// `inwards`, if given, another point of the plane: the answer is the limit from that side, along
  /// the straight line from `inwards` to `point`. It differs from the answer at the point itself
  /// only where a caster touches the receiver there (the foot of a wall: casters do not shadow the
  /// points of their own planes). A vertex of a convex fragment takes a point inside the fragment.
  Illumination at(std::uint32_t part, Side side, const std::array<mpq_class, 3>& point,
                  bool unobstructed, const std::array<mpq_class, 3>* inwards = nullptr) const;

  /// Sums over all calls so far.
  IlluminationCounts counts() const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_ILLUMINATION_H
