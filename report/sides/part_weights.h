// SPDX-License-Identifier: GPL-3.0-or-later
// The shares of a polygon from those of its parts, by the areas of the parts: found once a scene,
// for all of its lights.
//
// Exactness: parts of one plane weigh exactly, as areas in one plane are proportional to any
// component of their area vectors; others by enclosures of their areas. Bounds of parts become
// bounds of the polygon, a few units in the last place wider however many parts there are. What all
// parts are, or none of them is, the polygon is: exactly 1 or 0, in whatever planes they lie.
#ifndef GNOMON_REPORT_SIDES_PART_WEIGHTS_H
#define GNOMON_REPORT_SIDES_PART_WEIGHTS_H

#include <gmpxx.h>

#include <cstdint>
#include <span>
#include <vector>

#include "gnomon/algorithms/shadow_result.h"
#include "gnomon/oracle/enclosure.h"
#include "gnomon/scene/prepare.h"

namespace gnomon::report {

inline oracle::Enclosure to_enclosure(const Interval& interval) {
  return {interval.lower, interval.upper};
}
inline Interval to_interval(const oracle::Enclosure& enclosure) {
  return {enclosure.lower, enclosure.upper};
}

/// All parts of the polygon lie in one plane.
bool is_coplanar(const PreparedScene& scene, std::uint32_t polygon);

/// Of the polygon's area, for each of its parts; they add up to 1. Requires: it is coplanar.
std::vector<mpq_class> exact_weights(const PreparedScene& scene, std::uint32_t polygon);

class PartWeights {
 public:
  PartWeights() = default;
  /// Of all polygons with several parts; or of one of them alone.
  explicit PartWeights(const PreparedScene& scene);
  PartWeights(const PreparedScene& scene, std::uint32_t polygon);

  /// The polygon's share from those of its parts, in order. Requires: several parts.
  Interval sum(std::uint32_t polygon, std::span<const Interval> shares) const;

 private:
  void add(const PreparedScene& scene, std::uint32_t polygon);

  struct Weights {
    std::uint32_t polygon = 0;
    bool coplanar = true;
    std::uint32_t first = 0;  // into parts_
  };
  std::vector<Weights> polygons_;  // with several parts, ascending
  std::vector<Interval>
      parts_;  // shares of the polygon's area, or areas in any unit if it is not coplanar
};

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_SIDES_PART_WEIGHTS_H
