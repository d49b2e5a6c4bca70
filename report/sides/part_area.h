// SPDX-License-Identifier: GPL-3.0-or-later
// Areas of parts and polygons: exact up to one square root, and the doubles nearest to them and to
// fractions of them. Most of these come from pairs of doubles; rationals decide the rest.
#ifndef GNOMON_REPORT_SIDES_PART_AREA_H
#define GNOMON_REPORT_SIDES_PART_AREA_H

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <vector>

#include "gnomon/algorithms/shadow_result.h"
#include "gnomon/scene/prepare.h"

namespace gnomon::report {

/// Twice the part's area vector on the scene's grid, in the orientation of its own front.
std::array<mpz_class, 3> doubled_area_vector(const PreparedScene& scene, const Part& part);
/// Bounds of the part's area in scene units squared; [0, infinity] beyond the range of doubles.
Interval part_area(const PreparedScene& scene, const Part& part);
/// Whether the areas of a scene's box and of what is seen in it are far from the ends of the range
/// of doubles.
bool areas_fit_doubles(const PreparedScene& scene);
/// Bounds of the part's area in a unit that all parts of a scene have in common, for ratios: scene
/// units squared if areas fit doubles, else the square over the scene's box.
Interval comparable_area(const PreparedScene& scene, const Part& part);
/// The double nearest to the part's area, scene units squared.
double nearest_area(const PreparedScene& scene, const Part& part);
/// The part's area, to far more digits than a double has.
mpq_class precise_area(const PreparedScene& scene, const Part& part);
/// The area of a polygon's parts, to far more digits than a double has.
mpq_class precise_area(const PreparedScene& scene, std::uint32_t polygon);

/// The areas of all polygons, which all lights of a scene share. Every double is the nearest one,
/// in scene units squared.
class PolygonAreas {
 public:
  /// Keeps a reference to the scene.
  explicit PolygonAreas(const PreparedScene& scene);

  double nearest(std::uint32_t polygon) const;
  /// To a fraction of the area. Requires: it is finite.
  double nearest(std::uint32_t polygon, double fraction) const;
  double nearest(std::uint32_t polygon, const mpq_class& fraction) const;

 private:
  const PreparedScene& scene_;
  struct Area {
    double high, low;  // an unevaluated sum (kernel/numbers/double_double.h), or not a number
    bool exact;        // `high` is the area
  };
  std::vector<Area> areas_;
};

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_SIDES_PART_AREA_H
