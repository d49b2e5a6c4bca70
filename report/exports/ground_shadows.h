// SPDX-License-Identifier: GPL-3.0-or-later
// Shadows on level ground as GeoJSON, for maps: one feature for each polygon, light and class that
// is not lit, a MultiPolygon of convex pieces seen from above, in the scene's own x and y. A
// reference system that the scene's "extra" names (CityJSON) is written as `crs`.
#ifndef GNOMON_REPORT_EXPORTS_GROUND_SHADOWS_H
#define GNOMON_REPORT_EXPORTS_GROUND_SHADOWS_H

#include <span>

#include "report/exports/result_pieces.h"
#include "report/text/text_sink.h"

namespace gnomon::report {

/// Of the sides that look up of polygons all of whose vertices have exactly one height.
void write_ground_shadows(TextSink& sink, const Scene& scene, const PreparedScene& prepared,
                          const ShadowResult& result, std::span<const ResultPiece> pieces);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_EXPORTS_GROUND_SHADOWS_H
