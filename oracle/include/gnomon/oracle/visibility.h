// SPDX-License-Identifier: GPL-3.0-or-later
// The oracle's second way: whether one point of a polygon is lit, by the definition itself:
// intersect the open segment from the point to the light with every caster, in rational numbers, in
// space. Shares nothing with the regions (point_regions.h): no chart, no cone, no clipping.
//
// Exactness: exact. A point on the border between light and shadow is said to be on it.
#ifndef GNOMON_ORACLE_VISIBILITY_H
#define GNOMON_ORACLE_VISIBILITY_H

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "gnomon/result/claims.h"
#include "gnomon/scene/prepare.h"

namespace gnomon::oracle {

enum class Visibility : std::uint8_t {
  kLit,       // no caster touches the segment
  kShadow,    // the segment passes through the inside of a caster
  kBoundary,  // it touches casters only along their edges, or the point itself lies on one
};

struct PointVisibility {
  Visibility visibility = Visibility::kLit;
  std::optional<std::uint32_t> caster;  // part that shadows or touches
};

class VisibilityTest {
 public:
  /// Requires: a point or directional light. Keeps a reference to the scene.
  VisibilityTest(const PreparedScene& scene, const PreparedLight& light);
  ~VisibilityTest();
  VisibilityTest(VisibilityTest&&) noexcept;

  /// `point` in scene units, on `receiver`'s plane. If the receiver has no side that faces the
  /// light and receives: kShadow without a caster. Cost: all casters. Thread-safe.
  PointVisibility at(std::uint32_t receiver, const RationalPoint& point) const;
  /// The same among these parts alone. Cost: their number.
  PointVisibility among(std::span<const std::uint32_t> casters, std::uint32_t receiver,
                        const RationalPoint& point) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
  std::vector<std::uint32_t> all_;
};

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_VISIBILITY_H
