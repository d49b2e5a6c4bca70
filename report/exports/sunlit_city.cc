// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/exports/sunlit_city.h"

#include <algorithm>
#include <cmath>

#include "report/sides/part_area.h"
#include "report/sides/polygon_sides.h"
#include "scene/files/writers.h"

namespace gnomon::report {

Expected<std::string> sunlit_city(const Scene& scene, const PreparedScene& prepared,
                                  const ShadowResult& result) {
  CitySunlit sunlit;
  const PolygonAreas areas(prepared);
  for (std::uint32_t polygon = 0; polygon < scene.polygons.size(); ++polygon) {
    sunlit.areas.push_back(areas.nearest(polygon));
  }
  for (const LightResult& light : result.lights) {
    auto& under = sunlit.lights.emplace_back();
    under.name = light_name(scene, prepared, light);
    under.shares.assign(scene.polygons.size(), 0);
    for (const ClassifiedSide& side : classified_sides(prepared, light, false)) {
      const double lit = side.lit.middle();
      double& share = under.shares[side.polygon];
      if (std::isfinite(lit)) share = std::max(share, lit);
    }
  }
  return write_sunlit_cityjson(scene, sunlit);
}

}  // namespace gnomon::report
