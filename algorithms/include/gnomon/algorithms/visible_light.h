// SPDX-License-Identifier: LGPL-3.0-or-later
// The part of an area light that is visible from a point, exactly: the 1992 paper's "analytic
// visibility for penumbra vertices". The light polygon is clipped by the shadow volumes that the
// casters between would have for a point light in the point.
//
// Exactness: every decision is exact (doubles with bounds first, integers where these do not
// decide), the fragments are exact. Regularised: what has no area is not visible and hides nothing.
// Degree: docs/illumination.md.
#ifndef GNOMON_ALGORITHMS_VISIBLE_LIGHT_H
#define GNOMON_ALGORITHMS_VISIBLE_LIGHT_H

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "gnomon/kernel/sign.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

struct VisibleLight {
  /// Convex loops in scene units, counter-clockwise seen from the light's front; they do not
  /// overlap.
  std::vector<std::vector<std::array<mpq_class, 3>>> fragments;
  /// Of the light's area: what is in front of the receiver's plane (A_R), and what of it is
  /// visible. Both 0 for a point that is not in front of the light's plane.
  mpq_class in_front, visible;
};

class LightVisibility {
 public:
  /// Keeps a reference to the scene. Requires: an area light.
  LightVisibility(const PreparedScene& scene, std::uint32_t light);
  ~LightVisibility();
  LightVisibility(LightVisibility&&) noexcept;
  LightVisibility& operator=(LightVisibility&&) noexcept;

  /// What the part's side sees of the light in a point of its plane (scene units). `inwards` as in
  /// Illuminator::at. Thread-safe.
  VisibleLight at(std::uint32_t part, Side side, const std::array<mpq_class, 3>& point,
                  const std::array<mpq_class, 3>* inwards = nullptr) const;
  /// Whether the point is in the deep umbra: nothing of A_R is visible, whatever hides it. Exact.
  bool is_deep_umbra(std::uint32_t part, Side side, const std::array<mpq_class, 3>& point,
                     const std::array<mpq_class, 3>* inwards = nullptr) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_VISIBLE_LIGHT_H
