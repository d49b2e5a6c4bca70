// SPDX-License-Identifier: GPL-3.0-or-later
// What a result says on request besides classes and shares, as further keys of its JSON (docs:
// formats, "More in a result"): areas by number of casters, centroids, sums of groups, form
// factors.
#ifndef GNOMON_REPORT_JSON_EXTRAS_JSON_H
#define GNOMON_REPORT_JSON_EXTRAS_JSON_H

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/algorithms/caster_counts.h"
#include "gnomon/algorithms/form_factor.h"
#include "gnomon/scene/groups.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"
#include "report/json/json_writer.h"
#include "report/sides/part_area.h"
#include "report/sides/part_weights.h"
#include "report/sides/polygon_sides.h"

namespace gnomon::report {

/// A form factor of a polygon's side: to the sky, or to another polygon.
struct SideFactor {
  std::uint32_t polygon = 0;
  Side side = Side::kFront;
  std::uint32_t to = 0;  // of a view factor
  FormFactor factor;
};

/// What was asked for; what is empty is not written.
struct ResultExtras {
  std::vector<CasterCounts> counts;  // one for each light of the result
  bool centroids = false;            // needs points, exact ones of an exact kernel
  std::vector<PolygonGroup> groups;
  std::array<double, 3> up{0, 0, 1};
  std::vector<SideFactor> sky, view_factors;
};

class ExtrasWriter {
 public:
  /// Keeps references to all of it. `exact`: exact fractions were asked for and are there.
  ExtrasWriter(JsonWriter& json, const Scene& scene, const PreparedScene& prepared,
               const ResultExtras& extras, const PolygonAreas& areas, const PartWeights& weights,
               bool exact)
      : json_(json),
        scene_(scene),
        prepared_(prepared),
        extras_(extras),
        areas_(areas),
        weights_(weights),
        exact_(exact) {}

  /// Members of the object of one side. `index`: of the light in the result.
  void write_side(const LightResult& light, std::size_t index, const ClassifiedSide& side);
  /// Members of the object of one light.
  void write_light(const LightResult& light);
  /// Members of the result.
  void write_result();

 private:
  void write_fraction(const Interval& share, const std::optional<mpq_class>& exact);
  void write_counts(const CasterCounts& counts, const ClassifiedSide& side);
  void write_centroid(const LightResult& light, const ClassifiedSide& side);
  void write_factors(std::string_view name, const std::vector<SideFactor>& factors, bool with_to);

  JsonWriter& json_;
  const Scene& scene_;
  const PreparedScene& prepared_;
  const ResultExtras& extras_;
  const PolygonAreas& areas_;
  const PartWeights& weights_;
  bool exact_;
};

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_JSON_EXTRAS_JSON_H
