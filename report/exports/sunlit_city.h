// SPDX-License-Identifier: GPL-3.0-or-later
// A scene as CityJSON with what the lights reach as attributes of its objects, for GIS programs.
#ifndef GNOMON_REPORT_EXPORTS_SUNLIT_CITY_H
#define GNOMON_REPORT_EXPORTS_SUNLIT_CITY_H

#include <string>

#include "gnomon/algorithms/shadow_result.h"
#include "gnomon/kernel/error.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"

namespace gnomon::report {

/// Of a polygon with two sides the one that is lit more counts; what was dropped, or is no number,
/// is 0. Errors: those of writing a city model.
Expected<std::string> sunlit_city(const Scene& scene, const PreparedScene& prepared,
                                  const ShadowResult& result);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_EXPORTS_SUNLIT_CITY_H
