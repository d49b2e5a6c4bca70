// SPDX-License-Identifier: GPL-3.0-or-later
// The oracle's second way for an area light: what one point of a polygon sees of it, by the
// definition itself. From a point p, a caster hides of A_R those points a for which the open
// segment from p to a meets it; with p strictly behind the caster's blocking side these are the a
// in front of it for which the segment meets its plane inside its edges: one convex polygon in the
// light's plane. Shares nothing with the regions (area_regions.h): no volume, no chart, no plane
// that was chosen for light and caster.
//
// Exactness: exact, in rational numbers. A point at which the class may change is said to be on a
// boundary; such a point may also lie inside a class.
#ifndef GNOMON_ORACLE_AREA_VISIBILITY_H
#define GNOMON_ORACLE_AREA_VISIBILITY_H

#include <gmpxx.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "gnomon/kernel/sign.h"
#include "gnomon/result/claims.h"
#include "gnomon/scene/prepare.h"

namespace gnomon::oracle {

struct AreaPointVisibility {
  LightState state = LightState::kLit;  // kLit, kPenumbra or kUmbra
  bool behind_light = false;  // umbra because p is not in front of the light, or R sees none of it
  bool on_boundary = false;   // nearby the class may be another
  /// The visible fraction jumps here: the point lies on a caster that it may be in front of or
  /// behind, or in the light's own plane. Elsewhere the fraction is continuous.
  bool jumps = false;
  /// One that hides all of A_R, else one that hides most of it.
  std::optional<std::uint32_t> caster;
  // Fractions of the area of A; they add up to the share of A_R in A. Set only if asked for.
  mpq_class hidden, visible;
  /// Fractions of A hidden by each caster that hides some, in order of parts.
  std::vector<std::pair<std::uint32_t, mpq_class>> by_caster;
  /// Deep umbra: no part of A_R is visible. Set only if asked for.
  bool deep() const { return visible == 0; }
};

class AreaVisibility {
 public:
  /// Requires: an area light. Keeps nothing of its arguments.
  AreaVisibility(const PreparedScene& scene, const PreparedLight& light);
  ~AreaVisibility();
  AreaVisibility(AreaVisibility&&) noexcept;

  /// `point` in scene units, on the plane of `receiver`, seen from `side`. Cost: all casters, and
  /// for `fractions` the square of those that hide something. Thread-safe.
  AreaPointVisibility at(std::uint32_t receiver, Side side, const RationalPoint& point,
                         bool fractions = true) const;
  /// The same with some casters alone, in order of parts.
  AreaPointVisibility at(std::uint32_t receiver, Side side, const RationalPoint& point,
                         bool fractions, std::span<const std::uint32_t> casters) const;
  /// The same if one of the casters had another convex loop in its plane, as one has that stands in
  /// for what an input that is off by a little would have been.
  AreaPointVisibility at_if_moved(std::uint32_t receiver, Side side, const RationalPoint& point,
                                  std::span<const std::uint32_t> casters, std::uint32_t moved,
                                  const std::vector<RationalPoint>& loop) const;
  /// Whether certainly no part of A_R is visible from any point of a convex polygon on that side:
  /// what each caster hides from all its corners it hides from all of it, and these parts together
  /// cover A_R. False says nothing. A polygon on or behind the light's plane is no answer's concern
  /// here: false. Casters that share edges, or meet in T-junctions, count as one sheet.
  bool hides_all_from(std::uint32_t receiver, Side side,
                      const std::vector<RationalPoint>& polygon) const;

 private:
  struct Data;
  struct Moved;

  AreaPointVisibility look(std::uint32_t receiver, Side side, const RationalPoint& point,
                           bool fractions, std::span<const std::uint32_t> casters,
                           const Moved* moved) const;

  std::unique_ptr<Data> data_;
};

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_AREA_VISIBILITY_H
