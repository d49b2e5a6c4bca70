// SPDX-License-Identifier: LGPL-3.0-or-later
// Form factors (view factors) with obstruction: what share of the diffuse radiation that leaves a
// polygon's side arrives at the sky or at another polygon; as well, how much of a uniform sky's
// light reaches the side. 1 / (pi A) times the integral over the side's area A, and over the
// directions to what is visible of the target, of the cosine to the side's normal.
//
// The sky is all directions with a positive component along `up`, infinitely far away. What casts
// is as for shadows (docs: semantics): polygons coplanar with the receiver or with the target hide
// nothing, and a side of a caster stops what starts in front of it.
//
// Exactness: certified bounds, lower <= true <= upper, in doubles with margins (docs:
// form-factors); `value` lies within them and is closer, most often by far. Unobstructed factors
// have bounds of some 1e-12. Source: J. H. Lambert, Photometria (1760); E. M. Sparrow, A new and
// simpler formulation for radiative angle factors, J. Heat Transfer 85 (1963), for contour
// integrals.
#ifndef GNOMON_ALGORITHMS_FORM_FACTOR_H
#define GNOMON_ALGORITHMS_FORM_FACTOR_H

#include <array>
#include <atomic>
#include <cstdint>

#include "gnomon/kernel/error.h"
#include "gnomon/kernel/sign.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

struct FormFactorOptions {
  double tolerance = 5e-2;          // of upper - lower
  std::uint64_t most_cells = 2000;  // of one side; then the bounds are what they are
  std::array<double, 3> up{0, 0, 1};
  const std::atomic<bool>* interrupted = nullptr;
};

struct FormFactor {
  double value = 0;
  double lower = 0, upper = 0;
  double unobstructed = 0;  // the same if nothing cast
  std::uint64_t cells = 0;  // triangles that the side was cut into
  bool within_tolerance = true;
};

/// From one side (kFront or kBack) of a polygon. Requires: an index into Scene::polygons. A dropped
/// polygon has 0. Errors: kUsage (`up` is no direction), kInterrupted. Cost: cells times the
/// casters that may reach between cell and target; half the tolerance takes four times the cells.
Expected<FormFactor> sky_factor(const PreparedScene& scene, std::uint32_t polygon, Side side,
                                const FormFactorOptions& options);

/// From one side of a polygon to another polygon, to its front, and to its back too if it is
/// two-sided. Errors: kInterrupted. From a polygon to itself: 0, unless it is bent.
Expected<FormFactor> view_factor(const PreparedScene& scene, std::uint32_t from, Side side,
                                 std::uint32_t to, const FormFactorOptions& options);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_FORM_FACTOR_H
